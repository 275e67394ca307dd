#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "results/cost_analysis.hpp"
#include "results/cost_chaos.hpp"
#include "results/cost_point.hpp"
#include "results/couette_frame.hpp"
#include "results/engine_row.hpp"

namespace crossgrain::inline results {

/// What the points of one kind of error are held against.
struct CostReference {
  CostKind kind = CostKind::collision;
  std::string engine, setting;
  std::optional<double> error = {};  ///< of its own, in the unit of the points' errors
  std::string note;
};

/// What it takes before the first step [s].
struct Startup {
  std::string engine;
  double start = 0.0, load = 0.0;
};

/// The statistical part of averages over the first part of the runs.
struct StatisticalFall {
  std::string engine, measure;
  double rotations = 0.0;
  double statistical = 0.0;
};
struct CostAverages {
  std::vector<StatisticalFall> falls;
};

/// What accuracy costs: results of kind "cost" (reports/README.md).
struct CostResults : CouetteFrame {
  std::optional<double> elapsed;  ///< [s]
  std::vector<EngineRow> engines;
  std::vector<PackingRow> packings;

  std::optional<double> budget;            ///< for all that was measured [s]
  std::optional<double> budgetForTheRest;  ///< for what did not fit, all else kept [s]
  std::vector<CostPoint> points;           ///< by kind, engine and setting
  std::vector<CostReference> references;
  std::optional<ChaosStudy> trajectory;  ///< if trajectories were compared
  CostAverages averages;
  std::vector<Startup> startup;
  /// Order claimed for "ENGINE INTEGRATOR", and for "ENGINE" that of the one it has by itself.
  std::map<std::string, int> theory;
  /// For other reasons than a step beyond the stability limit: one line each.
  std::vector<std::string> engineFailures;

  // Worked out from the points.
  std::vector<OrderFit> orders;
  std::vector<Front> fronts;
  std::vector<Cheapest> cheapest;
  std::vector<Advice> advice;
};

nlohmann::json toJson(const CostResults& results);
/// @throws FieldError
CostResults costFromJson(const nlohmann::json& json);

}  // namespace crossgrain::inline results
