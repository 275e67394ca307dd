#include "runs/thesis/claims.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <utility>

#include "runs/thesis/claims_judges.hpp"

namespace crossgrain::inline runs {
namespace {

constexpr std::pair<std::string_view, ClaimJudge> judges[] = {
    {"C3", judgeBinning},
    {"C4", judgeDensityInTime},
    {"C5", judgeDilatedZone},
    {"C6", judgeCriticalDensity},
    {"C7", judgeVelocityDecay},
    {"C8", judgeSpinOscillation},
    {"C9", judgeRateIndependence},
    {"C10", judgeRadialVelocities},
    {"C11", judgeJointDistribution},
    {"C12", judgeFabricTrace},
    {"C13", judgeFabricAnisotropy},
    {"C14", judgeContactDirections},
    {"C15", judgeStressProfiles},
    {"C16", judgeDynamicStress},
    {"C17", judgeStressOverDensity},
    {"C18", judgeDeformation},
    {"C19", judgeAxes},
    {"C20", judgeBulkModulus},
    {"C21", judgeShearModulus},
    {"C22", judgeContinuumRotation},
    {"C23", judgeCoupleStress},
    {"C24", judgeCosseratModel},
    {"C25", judgeCost},
    {"C26", judgeOverlap},
    {"C27", judgeDivergence},
};

/// An engine, and the mirror that carries it.
struct Subject {
  std::string engine, carrier;
};

/// Engines that have runs, in their order; a mirror that carries has no rows of its own. "-" where
/// there are no runs, so that every claim has a row.
std::vector<Subject> subjectsOf(const ThesisResults& results) {
  std::vector<Subject> subjects;
  for (const ThesisRun& run : results.runs) {
    const auto carried = std::ranges::find_if(results.carriers, [&](const ThesisCarrier& each) {
      return each.carries && (each.engine == run.engine || each.mirror == run.engine);
    });
    const Subject subject = carried == results.carriers.end()
                                ? Subject{run.engine, ""}
                                : Subject{carried->engine, carried->mirror};
    if (std::ranges::find(subjects, subject.engine, &Subject::engine) == subjects.end())
      subjects.push_back(subject);
  }
  if (subjects.empty()) subjects.push_back({"-", ""});
  return subjects;
}

/// Whether a reading that is not the default has a row of its own.
bool wanted(const ClaimScope& scope) {
  return scope.rule.judgedUnder(scope.reading.key) &&
         !scope.runsOf(scope.reading.ladder, "").runs.empty();
}

}  // namespace

std::optional<ClaimRow> judgeClaim(const ThesisResults& results, const ClaimRules& rules,
                                   const std::string& id, const std::string& engine,
                                   const std::string& carrier, const Reading& reading) {
  const auto found = std::ranges::find(judges, id, [](const auto& each) { return each.first; });
  if (found == std::end(judges)) return std::nullopt;
  const ClaimScope scope{results, rules, rules.of(id), engine, reading, carrier};
  Evidence evidence(scope);
  found->second(scope, evidence);
  return evidence.row();
}

std::vector<ClaimRow> judgeClaims(const ThesisResults& results, const ClaimRules& rules) {
  std::vector<ClaimRow> rows = judgeCollisionLaws(results, rules);
  const std::vector<Reading> readings = readingsOf(results);
  for (const auto& [id, judge] : judges) {
    const ClaimRule& rule = rules.of(id);
    for (const auto& [engine, carrier] : subjectsOf(results))
      for (const Reading& reading : readings) {
        const ClaimScope scope{results, rules, rule, engine, reading, carrier};
        if (!reading.key.empty() && !wanted(scope)) continue;
        rows.push_back(*judgeClaim(results, rules, rule.id, engine, carrier, reading));
      }
  }
  return rows;
}

}  // namespace crossgrain::inline runs
