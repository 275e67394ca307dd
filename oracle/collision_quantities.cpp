#include "oracle/collision_quantities.hpp"

namespace crossgrain::inline oracle {

namespace {

using Outcome = CollisionOutcome;

template <double EnergySplit::*part>
std::optional<double> partLost(const Outcome& outcome) {
  const auto& lost = outcome.end.lost;
  return lost ? std::optional((*lost).*part) : std::nullopt;
}

template <double ForceWork::*part>
std::optional<double> workOf(const Outcome& outcome) {
  return outcome.work ? std::optional((*outcome.work).*part) : std::nullopt;
}

/// Of the dashpot alone where that is known: a body may take energy of its own.
std::optional<double> normalDamping(const Outcome& outcome) {
  if (outcome.end.lost) return outcome.end.lost->normalDamping;
  return outcome.work ? std::optional(outcome.work->normal) : std::nullopt;
}

template <std::optional<double> EnergySplit::*part>
std::optional<double> furtherLost(const Outcome& outcome) {
  return outcome.end.lost ? (*outcome.end.lost).*part : std::nullopt;
}

template <auto member>
std::optional<double> own(const Outcome& outcome) {
  return outcome.end.*member;
}

std::optional<double> psiOut(const Outcome& outcome) {
  const auto& out = outcome.end.outOfPlane;
  return out ? std::optional(out->psi) : std::nullopt;
}

template <auto member, int side>
std::optional<double> spinOut(const Outcome& outcome) {
  const auto& out = outcome.end.outOfPlane;
  return out ? std::optional(((*out).*member)[side]) : std::nullopt;
}

template <int side>
std::optional<double> spin(const Outcome& outcome) {
  return outcome.end.spin[side];
}

template <double ConvexEnd::*part>
std::optional<double> ofConvex(const Outcome& outcome) {
  const auto& convex = outcome.end.convex;
  return convex ? std::optional((*convex).*part) : std::nullopt;
}

std::optional<double> energyLost(const Outcome& outcome) {
  return outcome.end.energyBefore - outcome.end.energyAfter;
}

using Id = QuantityId;
using Scored = CollisionQuantity::Scored;
using InFiles = CollisionQuantity::InFiles;
using End = CollisionEnd;
using Split = EnergySplit;
using Out = EndOutOfPlane;
constexpr auto asItIs = Scored::asItIs;
constexpr auto fraction = Scored::energyFraction;

constexpr std::array<CollisionQuantity, quantityCount> quantities = {{
    {Id::psiF, "psi_f", "Ψ_f", "", 0, own<&End::psi>, asItIs, InFiles::exact},
    {Id::en, "e_n", "e_n", "", 0, own<&End::en>, asItIs, InFiles::exact},
    {Id::beta, "beta", "β", "", 1, own<&End::beta>},
    {Id::et, "e_t", "e_t", "", 3, own<&End::et>},
    {Id::centrePsiF, "centre_psi_f", "centres' v_t", "", 2, own<&End::centrePsi>},
    {Id::reboundAngle, "rebound_angle", "angle", "rad", 4, own<&End::reboundAngle>},
    {Id::spinI, "spin_i", "ω_i", "rad/s", 5, spin<0>, Scored::surfaceSpeedI},
    {Id::spinJ, "spin_j", "ω_j", "rad/s", 6, spin<1>, Scored::surfaceSpeedJ},
    {Id::duration, "duration", "duration", "s", 7, own<&End::duration>, Scored::byLargest},
    {Id::maxOverlap, "max_overlap", "overlap", "m", 8, own<&End::maxOverlap>, Scored::byLargest},
    {Id::energyLost, "energy_lost", "energy lost", "J", 0, energyLost, fraction, InFiles::no},
    {Id::lostNormalDamping, "lost_normal_damping", "normal", "J", 11, normalDamping, fraction},
    {Id::lostTangential, "lost_tangential", "tangential", "J", 15, workOf<&ForceWork::tangential>,
     fraction},
    {Id::lostTangentialDamping, "lost_tangential_damping", "sticking", "J", 12,
     partLost<&Split::tangentialDamping>, fraction},
    {Id::lostStiffening, "lost_stiffening", "stiffening", "J", 16, partLost<&Split::stiffening>,
     fraction},
    {Id::lostSliding, "lost_sliding", "sliding", "J", 13, partLost<&Split::sliding>, fraction},
    {Id::lostStored, "lost_stored", "stored", "J", 14, partLost<&Split::stored>, fraction},
    {Id::lostRollingDamping, "lost_rolling_damping", "rolling damping", "J", 17,
     furtherLost<&Split::rollingDamping>, fraction},
    {Id::lostRolling, "lost_rolling", "rolling", "J", 18, furtherLost<&Split::rolling>, fraction},
    {Id::lostPlastic, "lost_plastic", "yield", "J", 19, furtherLost<&Split::plastic>, fraction},
    {Id::lostDetachment, "lost_detachment", "detachment", "J", 20, furtherLost<&Split::detachment>,
     fraction},
    {Id::psiFOut, "psi_f_out", "Ψ_f·b", "", 21, psiOut},
    {Id::spinINormal, "spin_i_normal", "ω_i·n", "rad/s", 22, spinOut<&Out::spinNormal, 0>,
     Scored::surfaceSpeedI},
    {Id::spinITangent, "spin_i_tangent", "ω_i·s", "rad/s", 23, spinOut<&Out::spinTangent, 0>,
     Scored::surfaceSpeedI},
    {Id::spinJNormal, "spin_j_normal", "ω_j·n", "rad/s", 24, spinOut<&Out::spinNormal, 1>,
     Scored::surfaceSpeedJ},
    {Id::spinJTangent, "spin_j_tangent", "ω_j·s", "rad/s", 25, spinOut<&Out::spinTangent, 1>,
     Scored::surfaceSpeedJ},
    {Id::centreNormal, "centre_v_n", "centres' v_n", "", 26, ofConvex<&ConvexEnd::centreNormal>},
    {Id::energyGained, "energy_gained", "energy gained", "J", 27, ofConvex<&ConvexEnd::gained>,
     fraction, InFiles::nineDigits, 0.0},
    {Id::energyBefore, "energy_before", "energy before", "J", 9, own<&End::energyBefore>,
     Scored::never},
    {Id::energyAfter, "energy_after", "energy after", "J", 10, own<&End::energyAfter>,
     Scored::never},
}};

constexpr bool areInOrder() {
  for (std::size_t k = 0; k < quantities.size(); ++k)
    if (quantities[k].id != static_cast<QuantityId>(k)) return false;
  return true;
}
static_assert(areInOrder());

constexpr std::size_t scoredCount = static_cast<std::size_t>(QuantityId::energyBefore);
static_assert(quantities[scoredCount - 1].scored != Scored::never &&
              quantities[scoredCount].scored == Scored::never);

}  // namespace

std::optional<double> CollisionQuantity::scoredValue(const CollisionOutcome& outcome,
                                                     const CollidingPair& pair, double vn) const {
  const auto itself = valueOf(outcome);
  if (!itself) return std::nullopt;
  switch (scored) {
    case Scored::asItIs:
    case Scored::byLargest:
      return itself;
    case Scored::surfaceSpeedI:
      return pair.radius[0] * *itself / vn;
    case Scored::surfaceSpeedJ:
      return pair.radius[1] * *itself / vn;
    case Scored::energyFraction:
      if (outcome.end.energyBefore > 0.0) return *itself / outcome.end.energyBefore;
      break;
    case Scored::never:
      break;
  }
  return std::nullopt;
}

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

std::span<const CollisionQuantity> scoredQuantities() {
  return collisionQuantities().first(scoredCount);
}

const CollisionQuantity& collisionQuantity(QuantityId id) {
  return quantities[static_cast<std::size_t>(id)];
}

}  // namespace crossgrain::inline oracle
