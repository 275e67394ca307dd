#include "runs/thesis/elsewhere.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "averaging/regime.hpp"

namespace crossgrain::inline runs {

OtherRuns::OtherRuns(const ThesisResults& results) {
  const std::vector<Reading> readings = readingsOf(results);
  addRegimes(results);
  addDensities(results, readings.front());
  addRatesAndTimes(results, readings.front());
}

void OtherRuns::addRegimes(const ThesisResults& results) {
  for (const Regime regime : {Regime::flowing, Regime::blocked, Regime::collisional}) {
    ThesisResults own;
    own.legs = results.legs;
    own.carriers = results.carriers;
    for (const ThesisRun& run : results.runs)
      if (run.run.regime && run.run.regime->regime == regime) own.runs.push_back(run);
    if (own.runs.empty() || own.runs.size() == results.runs.size()) continue;
    const ThesisResults& kept = ofRegimes_.emplace_back(std::move(own));
    all_.push_back({fmt::format("of runs that are {} alone", toString(regime)), &kept,
                    readingsOf(kept).front()});
  }
}

void OtherRuns::addDensities(const ThesisResults& results, const Reading& standard) {
  std::map<double, Reading> byLabel;
  const auto add = [&](const std::vector<const ThesisLeg*>& legs,
                       std::vector<const ThesisLeg*> Reading::*list) {
    for (const ThesisLeg* leg : legs) (byLabel[leg->label].*list).push_back(leg);
  };
  add(standard.ladder, &Reading::ladder);
  add(standard.timed, &Reading::timed);
  if (byLabel.size() < 2) return;
  for (auto& [label, reading] : byLabel) {
    reading.words = fmt::format("at ν̄ = {:.3f} alone", label);
    all_.push_back({reading.words, &results, reading});
  }
}

void OtherRuns::addRatesAndTimes(const ThesisResults& results, const Reading& standard) {
  if (standard.ladder.empty()) return;
  const reports::LegSettings reference = reports::settingsOf(*standard.ladder.front());
  const auto windowOf = [](const ThesisLeg& leg) {
    return std::pair(leg.settleRotations, leg.averagedRotations);
  };
  std::map<std::string, Reading> groups;
  for (const ThesisLeg& leg : results.legs) {
    const reports::LegSettings own = reports::settingsOf(leg);
    if ((!isOf(leg, "rate") && !isOf(leg, "time")) ||
        !reports::sameBut(nullptr, true, own, reference))
      continue;
    if (reports::sameSetting(own.omega, reference.omega) &&
        windowOf(leg) == windowOf(*standard.ladder.front()))
      continue;
    Reading& group =
        groups[fmt::format("at {}, rotations {:g} to {:g}", reports::wordsOfRate(own),
                           leg.settleRotations, leg.settleRotations + leg.averagedRotations)];
    group.ladder.push_back(&leg);
    group.timed.push_back(&leg);
  }
  for (auto& [words, reading] : groups) {
    reading.words = words;
    all_.push_back({words, &results, reading});
  }
}

}  // namespace crossgrain::inline runs
