// The regime map: in what state packings are over volume fractions and rotations.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "averaging/regime.hpp"
#include "averaging/transition_density.hpp"
#include "reports/common/csv_row.hpp"
#include "reports/thesis/drawing.hpp"
#include "reports/thesis/report.hpp"

namespace crossgrain::reports {
namespace {

using Maybe = std::optional<double>;

/// After so many rotations states are reported; 8 is the thesis' longest run.
constexpr int mapRotations[] = {1, 2, 5, 8, 10, 20};
/// A critical ν̄ further outside of the packings' than half of Table 3.2's span is an extrapolation,
/// no figure: as the claim about it is judged.
constexpr double farthestCritical = 0.02;

/// One engine's finished runs of one interpretation, one rate and the thesis' law, whatever family
/// of cases they are of.
struct StateGroup {
  std::string label;              ///< "default, Ω = 0.1 /s", "wall spacing 7 mm, Ω = 0.1 /s"
  std::vector<CaseRun> runs;      ///< all
  std::vector<CaseRun> packings;  ///< the longest run of each packing
};

/// Packings of one group and ν̄ in the rotation that ends then; of those that were followed so far.
struct StateRow {
  double nu = 0.0;  ///< as Table 3.2 has it
  int rotations = 0;
  int packings = 0, carry = 0;  ///< carry: the wheel has a contact or more on average
  MeanOfRuns contacts;          ///< of the wheel's disks, at a time
  MeanOfRuns pressure;          ///< on the outer ring [N/m²]
};

/// All packings of a group.
struct CriticalRow {
  int rotations = 0;
  int packings = 0, carry = 0;
  std::optional<TransitionDensity> critical;  ///< absent: none follows
};

std::string groupLabel(const CaseSettings& of, const CaseSettings& reference) {
  std::string label;
  for (const OpenChoice& open : openChoices)
    if (!sameSetting(of.*open.value, reference.*open.value)) label += describe(open, of) + ", ";
  if (label.empty()) label = "default, ";
  return label + describeRate(of);
}

/// The reference case's interpretation and rate first, the others as their cases come.
std::vector<StateGroup> stateGroups(const ThesisResults& results, const std::string& engine) {
  std::vector<StateGroup> groups;
  const ThesisCase* const first = referenceCase(results);
  if (!first) return groups;
  const CaseSettings reference = settingsOf(*first);
  groups.push_back({groupLabel(reference, reference), {}, {}});
  for (const ThesisCase& setup : results.cases) {
    const CaseSettings own = settingsOf(setup);
    if (!sameLaw(own, reference)) continue;
    const std::string label = groupLabel(own, reference);
    auto group = std::ranges::find(groups, label, &StateGroup::label);
    if (group == groups.end()) group = groups.insert(groups.end(), {label, {}, {}});
    for (const CaseRun& at : finishedRuns(results, setup, engine)) group->runs.push_back(at);
  }
  for (StateGroup& group : groups) group.packings = longestOfEachPacking(group.runs);
  std::erase_if(groups, [](const StateGroup& group) { return group.runs.empty(); });
  return groups;
}

bool carries(const ThesisSpan& span) {
  return span.wheelContacts && *span.wheelContacts >= fewestWheelContacts;
}

/// By ν̄, then by rotations.
std::vector<StateRow> stateRows(const StateGroup& group) {
  struct Seen {
    std::vector<Maybe> contacts, pressure;
    int carry = 0;
  };
  std::map<std::pair<long, int>, Seen> seen;  // by ν̄ in thousandths
  for (const CaseRun& at : group.packings)
    for (const int rotations : mapRotations) {
      const ThesisSpan* const span = spanAt(*at.run, rotations);
      if (!span || !span->wheelContacts) continue;
      Seen& own = seen[{std::lround(1e3 * at.setup->label), rotations}];
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
    std::vector<LoadState> packings;
    for (const CaseRun& at : group.packings)
      if (const ThesisSpan* const span = spanAt(*at.run, rotations); span && span->wheelContacts)
        packings.push_back({at.setup->label, carries(*span)});
    if (packings.empty()) continue;
    rows.push_back({rotations, static_cast<int>(packings.size()),
                    static_cast<int>(std::ranges::count_if(packings, &LoadState::carries)),
                    transitionDensity(packings, farthestCritical)});
  }
  return rows;
}

}  // namespace

std::string regimeMapCsv(const ThesisResults& results) {
  std::string table =
      "engine,group,nu,after_rotations,packings,carry,wheel_contacts,wheel_contacts_stderr,"
      "outer_pressure,outer_pressure_stderr,critical_nu,critical_nu_stderr\n";
  const Maybe none;
  const auto count = [](int number) { return static_cast<std::size_t>(number); };
  for (const std::string& engine : enginesWithRuns(results))
    for (const StateGroup& group : stateGroups(results, engine)) {
      for (const StateRow& of : stateRows(group))
        table += row(engine, group.label, fmt::format("{:.3f}", of.nu), count(of.rotations),
                     count(of.packings), count(of.carry), of.contacts.mean, of.contacts.error,
                     of.pressure.mean, of.pressure.error, none, none);
      for (const CriticalRow& of : criticalRows(group))
        table +=
            row(engine, group.label, none, count(of.rotations), count(of.packings), count(of.carry),
                none, none, none, none, of.critical ? Maybe(of.critical->nu) : none,
                of.critical ? Maybe(of.critical->standardError) : none);
    }
  return table;
}

}  // namespace crossgrain::reports
