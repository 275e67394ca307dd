#pragma once

#include <vector>

#include "studies/collide/sweep.hpp"

namespace crossgrain::inline studies {

/// Two bodies of a flow and collisions of them.
struct PairCurve {
  Case collision;                      ///< of the two, under their law; named as in pairsOf()
  std::vector<CollisionStart> starts;  ///< head on with spins, Ψ_i = 0 … psi_max at one speed
  OracleCurve oracle;                  ///< of that law
};

/// Collisions that stand for a flow: of every two sizes and materials that meet in it, those with
/// wall disks and planes too, alike ones once; in the sizes and at the speeds of Cost::impacts, or
/// at Cost::speed. The first, of a cell of two small disks, has
/// `cost.psi_count` of Ψ_i; the others have nine at most. Their step is the case's.
std::vector<Case> collisionsOf(const Case& setup);

/// The first of them, by the case's own name.
Case collisionOf(const Case& setup);

/// Reference of all collisions of one case: the case's own law, also where a setting changes the
/// law, so that an error says how far a setting is off the case.
struct CollisionReference {
  std::vector<PairCurve> pairs;
};
CollisionReference collisionReference(const Case& setup);

/// In how many steps, all a little shorter than the setting's, its collisions are followed.
inline constexpr int cycleSteps = 8;

/// The j-th of them [s]: N + j/8 steps in a contact where the setting takes N = t_c/dt, of N < 10
/// N (1 + j/80).
///
/// Phases and steps that suffice: a scheme sees a contact first at the end of the step in which it
/// begins, s dt after the touch with s in (0, 1], and for the last time s′ dt before it ends, s′ in
/// [0, 1); each force acts for dt about its instant. So the contact of the scheme is
/// (s + s′ − 1) dt too short. A dashpot jumps at both ends, by the same γ_n v_n relative to the
/// velocity there, and the rest of the force is 0 there; hence, with m₁₂ and to first order,
///   Δe_n/e_n = (γ_n dt/m₁₂) (s + s′ − 1).
/// A contact lasts n − 1 + s + s′ = t_c/dt steps: with f the fraction of t_c/dt, s + s′ = f for a
/// share f of the phases s and 1 + f for the others. Over phases the error is f − 1 or f in units
/// of γ_n dt/m₁₂: its mean is 0, its rms √(f (1 − f)), at most 1/2 at f = 1/2, and its largest
/// max(f, 1 − f), up to 1. With a whole number of steps a contact f is near 0 or 1 and only phases
/// at a step's edge err, by the largest amount; as constants and speeds are never those of a whole
/// number, a step is judged by the largest rms of its cycle of f. Eight steps of a cycle miss
/// f = 1/2 by 1/16 at most, which lowers the rms by 0.8 %. Further cycles, of smaller steps, err
/// less, as dt. Of pairs under one law the lightest err most, as dt/m₁₂.
double cycleStep(double step, double contactTime, int j);

/// Where in a step the k-th collision begins: Weyl's sequence k/((1 + √5)/2) mod 1, which is spread
/// evenly over (0, 1), its edges too, whatever range of k is taken.
double phaseOf(std::size_t k);

/// Outcomes of collisions side by side in one scene for each law.
struct PairOutcomes {
  std::vector<Outcomes> of;  ///< by pair, by start
  double dt = 0.0;           ///< that the engine took [s]
  double seconds = 0.0;      ///< that steps took, of all scenes [s]
  std::uint64_t steps = 0;   ///< of the scene that takes most of them
};

/// Runs all collisions of a reference once. The pairs of one law share a scene, far apart; wall
/// disks are a body that stands still.
/// @param collisions  of the reference's pairs, in their order, as a setting has them
/// @param step   the engine's [s]; `collisions` say the same
/// @param first  which phaseOf() the first collision has; each further one has the next
/// @throws EngineFailure, UnsupportedScene, BadInput
PairOutcomes runPairs(Engine& engine, const EngineEntry& entry, const std::vector<Case>& collisions,
                      const CollisionReference& reference, double step, std::size_t first);

/// The law that the engine declares for a pair; absent where its constants are not known.
std::optional<ContactLaw> lawDeclared(Engine& engine, const EngineEntry& entry,
                                      const Case& collision,
                                      const std::vector<CollisionStart>& starts);

}  // namespace crossgrain::inline studies
