#include "oracle/collision_quantities.hpp"

#include <array>

namespace crossgrain::inline oracle {

namespace {

using Outcome = CollisionOutcome;
using Pair = CollidingPair;

std::optional<double> share(std::optional<double> energy, const Outcome& outcome) {
  if (!energy || !(outcome.end.energyBefore > 0.0)) return std::nullopt;
  return *energy / outcome.end.energyBefore;
}

template <double EnergySplit::*part>
std::optional<double> partLost(const Outcome& outcome, const Pair&, double) {
  const auto& lost = outcome.end.lost;
  return share(lost ? std::optional((*lost).*part) : std::nullopt, outcome);
}

template <double ForceWork::*part>
std::optional<double> workOf(const Outcome& outcome, const Pair&, double) {
  return share(outcome.work ? std::optional((*outcome.work).*part) : std::nullopt, outcome);
}

template <auto member>
std::optional<double> own(const Outcome& outcome, const Pair&, double) {
  return outcome.end.*member;
}

template <int side>
std::optional<double> spin(const Outcome& outcome, const Pair& pair, double vn) {
  return pair.radius[side] * outcome.end.spin[side] / vn;
}

std::optional<double> energyLost(const Outcome& outcome, const Pair&, double) {
  return share(outcome.end.energyBefore - outcome.end.energyAfter, outcome);
}

constexpr std::array quantities = {
    CollisionQuantity{"psi_f", own<&CollisionEnd::psi>},
    CollisionQuantity{"e_n", own<&CollisionEnd::en>},
    CollisionQuantity{"beta", own<&CollisionEnd::beta>},
    CollisionQuantity{"e_t", own<&CollisionEnd::et>},
    CollisionQuantity{"centre_psi_f", own<&CollisionEnd::centrePsi>},
    CollisionQuantity{"rebound_angle", own<&CollisionEnd::reboundAngle>},
    CollisionQuantity{"spin_i", spin<0>},
    CollisionQuantity{"spin_j", spin<1>},
    CollisionQuantity{"duration", own<&CollisionEnd::duration>},
    CollisionQuantity{"max_overlap", own<&CollisionEnd::maxOverlap>},
    CollisionQuantity{"energy_lost", energyLost, true},
    CollisionQuantity{"lost_normal_damping", workOf<&ForceWork::normal>, true},
    CollisionQuantity{"lost_tangential", workOf<&ForceWork::tangential>, true},
    CollisionQuantity{"lost_tangential_damping", partLost<&EnergySplit::tangentialDamping>, true},
    CollisionQuantity{"lost_stiffening", partLost<&EnergySplit::stiffening>, true},
    CollisionQuantity{"lost_sliding", partLost<&EnergySplit::sliding>, true},
    CollisionQuantity{"lost_stored", partLost<&EnergySplit::stored>, true},
};

}  // namespace

CollisionOutcome outcomeOf(const CollisionEnd& end) {
  CollisionOutcome outcome{end, std::nullopt};
  if (end.lost)
    outcome.work = {end.lost->normalDamping, end.lost->tangentialDamping + end.lost->stiffening +
                                                 end.lost->sliding + end.lost->stored};
  return outcome;
}

std::span<const CollisionQuantity> collisionQuantities() {
  return quantities;
}

}  // namespace crossgrain::inline oracle
