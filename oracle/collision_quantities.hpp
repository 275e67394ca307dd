#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "oracle/collision_end.hpp"

namespace crossgrain::inline oracle {

/// What a contact's two forces took out of the motion, from the first touch to the last [J].
struct ForceWork {
  double normal = 0.0;      ///< −∫ f_n v_n dt
  double tangential = 0.0;  ///< −∫ f_t v_t dt, sticking and sliding together
};

/// A collision's end and, where it was watched, what its forces did.
struct CollisionOutcome {
  CollisionEnd end;
  std::optional<ForceWork> work;
};

/// With the work that the end's own account of the energy implies: a spring's gain over a whole
/// contact is what it stores in the end.
CollisionOutcome outcomeOf(const CollisionEnd& end);

/// One of the numbers that a sweep is scored in.
struct CollisionQuantity {
  std::string_view name;  ///< as in [collision.margins] and results.json's "score"
  /// psi_f, e_n, beta, e_t, centre_psi_f [-]; rebound_angle [rad]; spin_i, spin_j: a ω/v_n [-];
  /// duration [s]; max_overlap [m]; energy_lost and its parts lost_…: in units of the energy
  /// before [-]. Absent where the collision has none.
  std::optional<double> (*value)(const CollisionOutcome&, const CollidingPair&, double vn);
  bool isShare = false;  ///< of the energy before: errors need no other unit
};

/// All of them; the two that every sweep has, psi_f and e_n, first.
std::span<const CollisionQuantity> collisionQuantities();

}  // namespace crossgrain::inline oracle
