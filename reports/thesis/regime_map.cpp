#include "reports/thesis/regime_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "averaging/regime.hpp"
#include "reports/common/csv_row.hpp"
#include "reports/thesis/leg_choices.hpp"

namespace crossgrain::reports {

namespace {

/// "default, Ω = 0.1 /s"
std::string wordsOfGroup(const LegSettings& of, const LegSettings& reference) {
  std::string words;
  for (const OpenChoice& open : openChoices)
    if (!sameSetting(of.*open.value, reference.*open.value)) words += wordsOf(open, of) + ", ";
  if (words.empty()) words = "default, ";
  return words + wordsOfRate(of);
}

bool carries(const ThesisSpan& span) {
  return span.wheelContacts && *span.wheelContacts >= fewestWheelContacts;
}

}  // namespace

std::vector<StateGroup> stateGroups(const ThesisResults& results, const std::string& engine) {
  std::vector<StateGroup> groups;
  const ThesisLeg* const first = referenceLeg(results);
  if (!first) return groups;
  const LegSettings reference = settingsOf(*first);
  groups.push_back({wordsOfGroup(reference, reference), {}, {}});
  for (const ThesisLeg& leg : results.legs) {
    const LegSettings own = settingsOf(leg);
    if (!sameLaw(own, reference)) continue;
    const std::string words = wordsOfGroup(own, reference);
    auto group = std::ranges::find(groups, words, &StateGroup::words);
    if (group == groups.end()) group = groups.insert(groups.end(), {words, {}, {}});
    for (const ThesisRun* run : finishedRuns(results, leg, engine))
      group->runs.push_back({&leg, run});
  }
  for (StateGroup& group : groups) group.packings = longestOfEachPacking(group.runs);
  std::erase_if(groups, [](const StateGroup& group) { return group.runs.empty(); });
  return groups;
}

std::vector<StateRow> stateRows(const StateGroup& group) {
  struct Seen {
    std::vector<std::optional<double>> contacts, pressure;
    int carry = 0;
  };
  std::map<std::pair<long, int>, Seen> seen;  // by ν̄ in thousandths
  for (const LegRun& at : group.packings)
    for (const int rotations : mapRotations) {
      const ThesisSpan* const span = spanAt(*at.run, rotations);
      if (!span || !span->wheelContacts) continue;
      Seen& own = seen[{std::lround(1e3 * at.leg->label), rotations}];
      own.contacts.push_back(span->wheelContacts);
      own.pressure.push_back(span->outerPressure);
      own.carry += carries(*span);
    }
  std::vector<StateRow> rows;
  for (const auto& [key, own] : seen)
    rows.push_back({1e-3 * static_cast<double>(key.first), key.second,
                    static_cast<int>(own.contacts.size()), own.carry, meanOfRuns(own.contacts),
                    meanOfRuns(own.pressure)});
  return rows;
}

std::vector<CriticalRow> criticalRows(const StateGroup& group) {
  std::vector<CriticalRow> rows;
  for (const int rotations : mapRotations) {
    std::vector<Carrying> packings;
    for (const LegRun& at : group.packings)
      if (const ThesisSpan* const span = spanAt(*at.run, rotations); span && span->wheelContacts)
        packings.push_back({at.leg->label, carries(*span)});
    if (packings.empty()) continue;
    rows.push_back({rotations, static_cast<int>(packings.size()),
                    static_cast<int>(std::ranges::count_if(packings, &Carrying::carries)),
                    halfCarry(packings, farthestCritical)});
  }
  return rows;
}

std::string regimeMapCsv(const ThesisResults& results) {
  std::string table =
      "engine,group,nu,after_rotations,packings,carry,wheel_contacts,wheel_contacts_stderr,"
      "outer_pressure,outer_pressure_stderr,critical_nu,critical_nu_stderr\n";
  const std::optional<double> none;
  const auto count = [](int number) { return static_cast<std::size_t>(number); };
  for (const std::string& engine : enginesWithRuns(results))
    for (const StateGroup& group : stateGroups(results, engine)) {
      for (const StateRow& of : stateRows(group))
        table += row(engine, group.words, fmt::format("{:.3f}", of.nu), count(of.rotations),
                     count(of.packings), count(of.carry), of.contacts.mean, of.contacts.error,
                     of.pressure.mean, of.pressure.error, none, none);
      for (const CriticalRow& of : criticalRows(group)) {
        const bool known = of.critical.has_value();
        table +=
            row(engine, group.words, none, count(of.rotations), count(of.packings), count(of.carry),
                none, none, none, none, known ? std::optional(of.critical->nu) : none,
                known ? std::optional(of.critical->standardError) : none);
      }
    }
  return table;
}

}  // namespace crossgrain::reports
