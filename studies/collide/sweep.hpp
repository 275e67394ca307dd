#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "cases/case.hpp"
#include "cases/collision_scene.hpp"
#include "law/contact_law.hpp"
#include "oracle/collision_oracle.hpp"
#include "results/collision.hpp"
#include "results/collision_score.hpp"
#include "studies/collide/score.hpp"
#include "studies/core/engine_access.hpp"

namespace crossgrain::inline studies {

/// Options that matter to the law, and constants that it has.
LawDescription describeLaw(const ContactLaw& law);

/// Those in which a law differs from another; a constant that it lacks is 0. Empty: it is the same
/// law.
LawDescription lawDifference(const ContactLaw& law, const ContactLaw& from);

/// Of convex bodies, by the hypotheses of restitution.
struct ConvexOutcomes {
  std::optional<CollisionEnd> newton;  ///< absent where no impulse satisfies it
  CollisionEnd poisson, stronge;
  bool judged = false;      ///< all three agree
  std::string kind;         ///< of impactKindNames; where they end in two of them, both
  double freeFlight = 0.0;  ///< [s]
};

/// Outcome of the oracle for each start; absent where it has no outcome.
struct OracleCurve {
  std::vector<std::optional<CollisionEnd>> ends;
  std::string reason;  ///< why there is none
  /// Why there is no reference, in a clause; empty where there is one. The oracle has no outcome,
  /// or the law no limit of small time steps there, or its outcome jumps nearer to this Ψ_i than
  /// the case's margin of Ψ_f: an error of v_t that the margin allows after the contact decides,
  /// within it, on which side of the jump a scheme finds itself.
  std::vector<std::string> unsure;
  std::vector<ConvexOutcomes> convex = {};  ///< of convex bodies, whose ends are Newton's
};
OracleCurve oracleCurve(const Case& setup, const std::vector<CollisionStart>& starts);

/// The same for a sweep in steps of dt [s]: beside a jump of the law at the first touch (where
/// stepMissesSlip()) there is no reference either, if the law ends elsewhere by more than jumps are
/// found by where it is evaluated a step late. That scales with dt, and hides no sweep: what lacks
/// most of its references is not judged (mostAreKnown()).
OracleCurve atStep(OracleCurve oracle, const Case& setup, const std::vector<CollisionStart>& starts,
                   double dt);

/// Oracles of the laws that an engine declares for the starts of one case. The case's time steps
/// share them.
class DeclaredOracles {
 public:
  /// @param setup  the same at each call, but for its law
  const OracleCurve& of(const Case& setup, const std::vector<CollisionStart>& starts);

 private:
  std::vector<std::pair<ContactLaw, std::unique_ptr<OracleCurve>>> known_;
};

/// Loads all collisions of a sweep. @throws UnsupportedScene, EngineFailure
EffectiveParameters loadSweep(Engine& engine, const EngineEntry& entry, const Case& setup,
                              double dt, const std::vector<CollisionStart>& starts);

/// Long enough for every collision of a sweep to be over: contacts last about t_c, a rigid engine's
/// a few of its own steps [s].
double sweepEnd(const Case& setup, double dt, double engineStep);

Outcomes outcomesOf(const OracleCurve& oracle);

/// Those that an engine can be compared with.
Outcomes referenceOf(const OracleCurve& oracle);

/// Ψ_i, v_n and all that is known of the outcomes, with as many digits as files have. Of the
/// oracle's, `noLimit` marks points that have no limit of small time steps.
/// @param convex  with orientations and spins before, also where nothing is known of the outcome
CollisionTable tableOf(const std::vector<CollisionStart>& starts, const Outcomes& outcomes,
                       bool convex);

/// Outcome of each collision of a sweep, watched contact by contact for overlaps and work.
/// @throws EngineFailure, UnsupportedScene, BadInput
Outcomes sweepOutcomes(Engine& engine, const EngineEntry& entry, const Case& setup, double dt,
                       const std::vector<CollisionStart>& starts);

/// The in-house engine on the sweep, under the law of `scene` and at its step.
template <int D>
Outcomes inHouseOutcomes(const Case& setup, SceneOf<D> scene,
                         const std::vector<CollisionStart>& starts, bool watch);

/// One engine on one sweep.
/// @param watch  the contacts, step by step, for the largest overlap and the energy's whereabouts,
///               where the engine shows them; the outcome is the same
/// @param declared  to score the curve against the law that the engine declares, too; null: not
/// @param passesFiner  whether the engine's sweep at a smaller time step passes: what this one then
///                     is beyond a limit by together with the in-house engine, under the same law
///                     at the same step, is the step's doing and not judged
/// @throws EngineFailure, UnsupportedScene, BadInput
CollisionCurve runSweep(Engine& engine, const EngineEntry& entry, const Case& setup, double dt,
                        const std::vector<CollisionStart>& starts, const OracleCurve& oracle,
                        bool watch, DeclaredOracles* declared = nullptr, bool passesFiner = false);

}  // namespace crossgrain::inline studies
