#pragma once

#include "adapters/engine.hpp"
#include "adapters/worker/json.hpp"
#include "results/collision_score.hpp"
#include "results/head.hpp"

/// results.json of kind "collide": sweeps of collisions, compared with the oracle.
namespace crossgrain::inline results {

/// Names in files of how far a sweep came; second: whether all pairs parted.
inline constexpr support::EnumNames<std::pair<Status, bool>, 7> sweepStatusNames{
    {{{Status::finished, true}, "finished"},
     {{Status::finished, false}, "incomplete"},
     {{Status::refused, true}, "refused"},
     {{Status::refused, false}, "refused"},
     {{Status::failed, true}, "failed"},
     {{Status::failed, false}, "failed"},
     {{Status::notRun, true}, "not_run"}}};

/// One engine's sweep at one time step.
struct CollisionCurve {
  std::string engine;
  double dt = 0.0;                        ///< [s]
  std::optional<double> stepsPerContact;  ///< absent of rigid disks
  Status status = Status::finished;
  std::string reason;
  std::optional<EffectiveParameters> effective;
  std::optional<Stats> stats;
  CollisionPoints points;                 ///< none of what was refused or failed
  CurveScore score;                       ///< against the scene's law
  std::optional<DeclaredScore> declared;  ///< absent where the engine declares the scene's law
  std::optional<SchemeScore> ownScheme;   ///< measured at the largest time step of a variant
  std::optional<CollisionCauses> causes;  ///< likewise; absent where it does not differ

  bool allParted() const;  ///< but those that stick by the oracle
  bool complete() const { return status == Status::finished && allParted(); }
  /// "incomplete" where a sweep has finished and some pairs did not part.
  std::string statusName() const;

  /// Kept by itself, with the others of its engine and variant, as soon as it is there.
  void fields(auto& io) {
    io("engine", engine, aName);
    FIELDS(io, dt, stepsPerContact);
    std::pair how(status, allParted());
    io("status", how, sweepStatusNames);
    status = how.first;
    io("reason", reason);
    io("realised", effective);
    io.present("stats", stats);
    FIELDS(io, points, score, declared);
    PRESENT_FIELDS(io, ownScheme, causes);
  }
};

/// How a sweep compares with the law that its engine declares and with the scene's: passes both;
/// a model difference fails the scene's law and passes its own, with conventions that the case lets
/// it have; fails the law that it declares, or its own scheme, or the scene's where nothing is
/// known of its own. One that was refused does not apply, one that failed fails.
Verdict verdictOf(const CollisionCurve& curve);
/// As files have it; of one that failed that.
std::string outcomeName(const CollisionCurve& curve);

/// The score against the law that the engine declares; the scene's where that is the same, or
/// nothing is known of its own.
const CurveScore& declaredScore(const CollisionCurve& curve);

/// The larger of both deviations from the own scheme; absent where there is no discrete oracle.
std::optional<double> ownDeviation(const CollisionCurve& curve);

/// A point of the sweep at which the oracle's outcome is no reference: the law has no limit of
/// small time steps there, or jumps beside it; of convex bodies the hypotheses of restitution
/// differ.
struct NoLimitPoint {
  double psi = 0.0;       ///< Ψ_i
  double vn = 0.0;        ///< [m/s]
  double psiAfter = 0.0;  ///< Ψ_f, one of the outcomes there
  std::string reason;
  std::optional<double> orientation, spin;  ///< as CollisionTable has them

  void fields(auto& io) {
    io("psi_i", psi);
    io("v_n", vn);
    io("psi_f", psiAfter);
    io("reason", reason);
    io.present("orientation", orientation);
    io.present("spin_before", spin);
  }
};

/// A sweep of convex bodies, besides.
struct ConvexSweep {
  std::string bodies;  ///< in words
  /// Over which of them its figures are: "psi_i", "orientation" or "spin_before".
  std::string axis;
  /// Outcomes by Poisson's and by Stronge's restitution, at the points of CollisionVariant::oracle,
  /// which is Newton's.
  CollisionTable poisson, stronge;
  /// Of each point of all curves, a name of impactKindNames; where hypotheses end in two, both.
  std::vector<std::string> kinds;

  void fields(auto& io) { FIELDS(io, bodies, axis, poisson, stronge, kinds); }
};

/// Ψ_f = −e_t0 Ψ_i of a rigid law while it sticks.
struct StickingLimit {
  std::optional<double> et0;  ///< absent of soft laws

  void fields(auto& io) { io("e_t0", et0); }
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
  std::optional<std::string> space;       ///< of spheres in space: their spins and turn, in words
  CollisionTable reference;  ///< the oracle at the points of all curves, where it has a limit
  std::vector<NoLimitPoint> noLimit;
  std::optional<ConvexSweep> convex;  ///< of convex bodies
  std::vector<CollisionCurve> curves;

  void fields(auto& io) {
    io("case", name, aName);
    FIELDS(io, variant, law, sticking, slidingConstant, oracle, oracleReason, reference, noLimit,
           curves);
    PRESENT_FIELDS(io, effects, space, convex);
    io("e_n_closed", closedEn);
  }
};

struct CollideResults {
  ResultsHead head;
  std::optional<double> elapsed;  ///< [s]
  std::vector<EngineRow> engines;
  std::vector<CollisionVariant> variants;
  std::vector<ConvergenceOrder> orders;

  void fields(auto& io) {
    head.fields(io);
    io.present("elapsed_s", elapsed);
    FIELDS(io, engines, variants, orders);
  }
};

/// The quantity furthest beyond its limit.
struct WorstQuantity {
  double times = 0.0;       ///< error/limit
  std::string_view symbol;  ///< the quantity's

  void take(const CurveScore& score);
  std::string words() const;  ///< "Ψ_f 3.1 × its limit"; empty where none is beyond
};

/// A mirror that runs because its peer does.
bool runsBesideItsPeer(const CollideResults& results, const std::string& engine);

/// Sweeps by how they came out.
struct SweepCount {
  int held = 0, modelDifference = 0, beyondLimits = 0, notJudged = 0, refused = 0, failed = 0;
  /// Of sweeps that are judged: points, and those judged by more than a gain of energy.
  std::size_t points = 0, judgedPoints = 0;

  void add(const CollisionCurve& curve);
  int judged() const { return held + modelDifference + beyondLimits; }
};

/// Of all engines, but for mirrors that run beside their peers: they say what a peer should do, and
/// are not asked themselves. One that failed counts as failed.
SweepCount countOf(const CollideResults& results);

/// Why no sweep was judged, in a clause; empty if one was. Nothing judged is no success.
std::string nothingJudged(const CollideResults& results);

}  // namespace crossgrain::inline results
