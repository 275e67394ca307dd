#include "runs/thesis/claims_scope.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace crossgrain::inline runs {

namespace {

using reports::LegSettings, reports::OpenChoice, reports::openChoices;
using reports::referenceLeg, reports::sameBut, reports::sameSetting, reports::settingsOf;
using reports::wordsOf, reports::wordsOfRate;

Reading defaultReading(const ThesisResults& results, const LegSettings& reference) {
  Reading reading;
  reading.words = "default: ";
  for (const OpenChoice& open : openChoices) {
    if (open.value == &LegSettings::largeMass && reference.largeMass == 0.0) continue;  // not said
    reading.words += wordsOf(open, reference) + ", ";
  }
  reading.words += wordsOfRate(reference);
  for (const ThesisLeg& leg : results.legs) {
    if (!sameBut(nullptr, false, settingsOf(leg), reference)) continue;
    if (isOf(leg, "packings")) reading.ladder.push_back(&leg);
    if (isOf(leg, "packings") || isOf(leg, "time")) reading.timed.push_back(&leg);
  }
  return reading;
}

void addReadings(const ThesisResults& results, const OpenChoice& open, const LegSettings& reference,
                 std::vector<Reading>& readings) {
  std::map<std::pair<double, double>, Reading> byValue;
  for (const ThesisLeg& leg : results.legs) {
    const LegSettings settings = settingsOf(leg);
    if (!isOf(leg, open.key) || sameSetting(settings.*open.value, reference.*open.value) ||
        !sameBut(&open, true, settings, reference))
      continue;
    Reading& reading = byValue[{settings.*open.value, settings.omega}];
    reading.key = open.key;
    reading.words = wordsOf(open, settings);
    if (!sameSetting(settings.omega, reference.omega))
      reading.words += ", " + wordsOfRate(settings);
    reading.ladder.push_back(&leg);
    reading.timed.push_back(&leg);
  }
  for (auto& [value, reading] : byValue) readings.push_back(std::move(reading));
}

std::string labelWords(double from, double to) {
  return std::isinf(to) ? fmt::format("ν̄ from {:g}", from)
                        : fmt::format("ν̄ from {:g} to {:g}", from, to);
}

}  // namespace

std::vector<Reading> readingsOf(const ThesisResults& results) {
  const ThesisLeg* const first = referenceLeg(results);
  if (!first) return {Reading{"", "default", {}, {}}};
  const LegSettings reference = settingsOf(*first);
  std::vector<Reading> readings{defaultReading(results, reference)};
  for (const OpenChoice& open : openChoices) addReadings(results, open, reference, readings);
  return readings;
}

RunSet ClaimScope::runsOf(const std::vector<const ThesisLeg*>& legs, std::string words) const {
  RunSet set;
  set.words = std::move(words);
  for (const ThesisLeg* leg : legs) {
    std::set<int> own;
    const auto add = [&](const std::string& name) {
      for (const ThesisRun& run : results.runs)
        if (run.engine == name && run.leg == leg->name && run.run.finished() &&
            own.insert(run.packing).second)
          set.runs.push_back({leg, &run});
    };
    add(engine);
    if (!carrier.empty()) add(carrier);
    if (own.empty()) set.without.push_back(leg->name);
  }
  return set;
}

RunSet ClaimScope::labels(double from, double to, std::string words) const {
  std::vector<const ThesisLeg*> legs;
  for (const ThesisLeg* leg : reading.ladder)
    if (leg->label >= from && leg->label < to) legs.push_back(leg);
  return runsOf(legs, fmt::format("runs {} ({})", words, labelWords(from, to)));
}

RunSet ClaimScope::flow() const {
  return labels(common("flow_from"), common("flow_to"), "of shear flow");
}

RunSet ClaimScope::upward() const {
  return labels(common("flow_from"), std::numeric_limits<double>::infinity(),
                "of shear flow and above");
}

RunSet ClaimScope::blocked() const {
  return labels(common("blocked_from"), std::numeric_limits<double>::infinity(),
                "of blocked labels");
}

RunSet ClaimScope::at(double label) const {
  const double half = common("same_label");
  RunSet set = labels(label - half, label + half, "");
  set.words = fmt::format("runs at ν̄ = {:g}", label);
  return set;
}

RunSet ClaimScope::family(std::string_view name) const {
  std::vector<const ThesisLeg*> legs;
  for (const ThesisLeg& leg : results.legs)
    if (isOf(leg, name)) legs.push_back(&leg);
  return runsOf(legs, fmt::format("runs of the family \"{}\"", name));
}

RunSet ClaimScope::timed() const {
  RunSet all = runsOf(reading.timed, "runs of the families \"packings\" and \"time\"");
  all.runs = reports::longestOfEachPacking(all.runs);
  return all;
}

RunSet ClaimScope::carrying(RunSet from) const {
  const double fewest = common("wheel_contacts");
  const std::size_t before = from.runs.size();
  std::erase_if(from.runs, [&](const LegRun& at) {
    const auto contacts = wheelContactsOf(at);
    return !contacts || *contacts < fewest;
  });
  from.words += fmt::format(" that carry ({} of {})", from.runs.size(), before);
  return from;
}

std::optional<double> wheelContactsOf(const LegRun& at) {
  const CouetteRun& run = at.run->run;
  if (run.regime && run.regime->wheelContacts) return run.regime->wheelContacts;
  const auto found = std::ranges::find(run.head, "wheel_contacts", &HeadNumber::name);
  return found == run.head.end() ? std::nullopt : found->value;
}

std::string rotationsOf(const std::vector<LegRun>& runs) {
  std::set<std::pair<double, double>> windows;
  for (const LegRun& at : runs)
    windows.insert({at.leg->settleRotations, at.leg->settleRotations + at.leg->averagedRotations});
  std::vector<std::string> words;
  for (const auto& [from, to] : windows) words.push_back(fmt::format("{:g} to {:g}", from, to));
  return fmt::format("{}", fmt::join(words, ", "));
}

}  // namespace crossgrain::inline runs
