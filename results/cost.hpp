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

/// How far an engine's own limit of small steps lies from what the case's law gives: no time step
/// lessens it.
struct CostModel {
  std::string engine;
  CostKind kind = CostKind::collision;
  std::string measure;
  double error = 0.0;            ///< in the unit of the points' errors
  double low = 0.0, high = 0.0;  ///< between which it lies
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
/// What changing a constant does to an average, of the in-house engine over all packings, in the
/// unit of the points' errors.
struct CostResponse {
  std::string measure, constant;
  double change = 0.0;                    ///< of the constant, relative
  std::optional<double> response, bound;  ///< as measured; the upper end of its interval
};

struct CostAverages {
  std::vector<StatisticalFall> falls;
  std::vector<CostResponse> responses;
};

/// What accuracy costs: results of kind "cost" (docs/results.md).
struct CostResults : CouetteFrame {
  std::optional<double> elapsed;  ///< [s]
  std::vector<EngineRow> engines;
  std::vector<PackingRow> packings;

  std::optional<double> budget;            ///< for all that was measured [s]
  std::optional<double> budgetForTheRest;  ///< for what did not fit, all else kept [s]
  std::vector<CostPoint> points;           ///< by kind, engine and setting
  std::vector<CostReference> references;
  std::vector<CostModel> models;
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
  std::vector<CostCell> cells;
};

nlohmann::json toJson(const CostResults& results);
/// @throws FieldError
CostResults costFromJson(const nlohmann::json& json);

}  // namespace crossgrain::inline results
