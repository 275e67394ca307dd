#pragma once

#include <algorithm>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "reports/common/figure.hpp"
#include "results/compare.hpp"

namespace crossgrain::reports {

/// An engine's part of a study, or a variant's of an engine: its runs and their means. The study
/// must outlive it.
struct EngineRuns : EngineRow {
  LineStyle style;                             ///< a mirror has its peer's, dashed and open
  std::vector<const FlowRun*> runs, finished;  ///< in the order of the results
  const CouetteEnsemble* ensemble = nullptr;   ///< null with fewer than two finished runs
  bool isSingle = false;       ///< one finished run beside means of others: no result of its engine
  std::string surrogate = {};  ///< the mirror whose runs its verdicts rest on; empty: its own runs
  std::string standsFor = {};  ///< of such a mirror: the engine

  /// Whether verdicts on an engine rest on its runs.
  bool isResult() const { return !isSingle && (mirrors.empty() || !standsFor.empty()); }

  /// Of the ensemble, else of the only finished run; empty without one.
  const std::vector<Profile>& profiles() const;
  const std::vector<Distribution>& distributions() const;
  const std::vector<FitRow>& fits() const;
  const std::vector<HeadNumber>& head() const;
  /// Of the first run that got as far as loading the scene, or null.
  const EffectiveParameters* effective() const;
  /// How many snapshots each of its finished runs is averaged over: "21", "9 to 21"; empty where
  /// their series are not here.
  std::string snapshots() const;

  /// Sets runs, finished and ensemble: of that engine, with that effect switched off (empty: none).
  void takeRuns(const std::vector<FlowRun>& all, const std::vector<CouetteEnsemble>& ensembles,
                const std::string& engine, const std::string& without);
};

using Engines = std::vector<EngineRuns>;

/// In the results' order: the reference first. Runs with an effect switched off are left out.
Engines engineRuns(const FlowStudy& study, const std::vector<CouetteEnsemble>& ensembles);
/// The same with `isSingle`, `surrogate` and `standsFor`.
Engines engineRuns(const CompareResults& results);

/// Those that isIt.
Engines only(const Engines& engines, const auto& isIt) {
  Engines some;
  std::ranges::copy_if(engines, std::back_inserter(some), isIt);
  return some;
}

/// Curve of an engine in its style; a mirror that stands for an engine is named so.
Curve curveOf(const EngineRuns& engine, std::vector<Point> points = {}, double width = 1.5);

/// Sums over an engine's finished runs, of stepping alone.
struct EngineCost {
  std::optional<double> steps, wall, cpu, simulated;  ///< [-], [s], [s], [s]

  /// CPU time that a second of the scene takes [-].
  std::optional<double> cpuPerSecond() const;
};
EngineCost costOf(const EngineRuns& engine);

/// Absent where one of both is, or b is 0.
std::optional<double> quotient(std::optional<double> a, std::optional<double> b);

}  // namespace crossgrain::reports
