#pragma once

#include <nlohmann/json.hpp>

#include "adapters/engine.hpp"
#include "results/collision_score.hpp"
#include "results/engine_row.hpp"
#include "results/head.hpp"

/// results.json of kind "collide": sweeps of collisions, held against the oracle.
namespace crossgrain::inline results {

/// How far a sweep came.
enum class SweepStatus {
  finished,
  incomplete,  ///< some pairs did not part
  refused,
  failed
};
constexpr auto namesOf(SweepStatus) {
  return std::array<std::string_view, 4>{"finished", "incomplete", "refused", "failed"};
}

/// One engine's sweep at one time step.
struct CollisionCurve {
  std::string engine;
  double dt = 0.0;                        ///< [s]
  std::optional<double> stepsPerContact;  ///< absent of rigid disks
  SweepStatus status = SweepStatus::finished;
  std::string reason;
  std::optional<EffectiveParameters> effective;
  std::optional<Stats> stats;
  CollisionPoints points;                 ///< none of what was refused or failed
  CurveScore score;                       ///< against the scene's law
  std::optional<DeclaredScore> declared;  ///< absent where the engine declares the scene's law
  std::optional<SchemeScore> ownScheme;   ///< looked at at the largest time step of a variant
};

/// A point of the sweep at which the oracle's outcome is no reference: the law has no limit of
/// small time steps there, or jumps beside it.
struct NoLimitPoint {
  double psi = 0.0;       ///< Ψ_i
  double vn = 0.0;        ///< [m/s]
  double psiAfter = 0.0;  ///< Ψ_f, one of the outcomes there
  std::string reason;
};

/// Ψ_f = −e_t0 Ψ_i of a rigid law while it sticks.
struct StickingLimit {
  std::optional<double> et0;  ///< absent of soft laws
};

/// One variant of a case: its law, what the oracle says, and what engines made of it.
struct CollisionVariant {
  std::string name;  ///< the case's; empty: that of the head
  std::string variant;
  LawDescription law;                               ///< options and constants that matter to it
  std::optional<std::vector<std::string>> effects;  ///< that it calls for; absent: not known
  std::optional<double> closedEn;                   ///< e_n in closed form
  StickingLimit sticking;
  std::optional<double> slidingConstant;  ///< Ψ_f = Ψ_i − it, while it slides
  CollisionTable oracle;                  ///< on a fine grid
  std::string oracleReason;               ///< why there is none
  CollisionTable reference;  ///< the oracle at the points of all curves, where it has a limit
  std::vector<NoLimitPoint> noLimit;
  std::vector<CollisionCurve> curves;
};

struct CollideResults {
  ResultsHead head;
  std::optional<double> elapsed;  ///< [s]
  std::vector<EngineRow> engines;
  std::vector<CollisionVariant> variants;
  std::vector<ConvergenceOrder> orders;
};

nlohmann::json toJson(const CollideResults& results);
/// @throws FieldError
CollideResults collideFromJson(const nlohmann::json& json);

}  // namespace crossgrain::inline results
