#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "engines/grain/contact_force.hpp"
#include "engines/grain/core.hpp"

/// A run that begins as one that has come so far: with velocities between steps, stretched springs
/// and bonds.
namespace grain {

/// A step under way has v(t) − a dt/2 where the forces are evaluated. They need a, which needs
/// them: the error falls by about γ dt/m a round. Meanwhile tangential forces are the wanted ones,
/// so that no bound is met that is not the right one. Then, with the right velocities, springs
/// follow.
template <class Real>
void Core<Real>::beginUnderWay(const std::vector<Contact>& forces) {
  if (steps_ > 0 || ledger_)
    throw std::logic_error("a run begins as one under way at its start, where no ledger is kept");
  PairMap<const Contact*> wanted;
  for (const Contact& contact : forces) wanted[{contact.i, contact.j}] = &contact;
  // Euler's velocities are those that dashpots see. Predicted ones need the forces of the step
  // before; those of the start stand for them.
  const bool lags = integrator_ != Integrator::semiImplicitEuler && dashpotVelocity_.empty();
  const std::uint64_t evaluations = contactEvaluations_;
  kick(static_cast<Real>(halfKick_));
  const auto velocity = velocity_;  // of the start
  const auto spin = spin_;
  const auto goBack = [&](double by) {
    velocity_ = velocity;
    spin_ = spin;
    kick(static_cast<Real>(-by));
  };
  const auto evaluate = [&](const PairMap<Stretches>& springs) {
    setSprings(springs);
    known_.reset();
    std::ranges::fill(plateSpring_, Vec<Real>{});
    addForcesOfStart(lags);
  };
  PairMap<Stretches> memories;  // bonds and largest overlaps are as they were
  if (lists_.springs().memory)
    for (const Contact& contact : forces) memories[{contact.i, contact.j}].memory = contact.memory;
  constexpr int roundsOfVelocities = 20, mostOfSprings = 30;
  for (int round = 0; lags && round < roundsOfVelocities; ++round) {
    addMissing(wanted);
    goBack(0.5 * dt_);
    evaluate(memories);
  }
  PairMap<Stretches> springs = memories;
  for (int round = 0; round < mostOfSprings; ++round) {
    if (stretch(wanted, springs)) break;
    evaluate(springs);
  }
  contactEvaluations_ = evaluations;
  if (!lags || integrator_ == Integrator::velocityVerlet) goBack(halfKick_);
}

/// Adds to the disks' forces what contacts lack of their wanted tangential ones and torques.
template <class Real>
void Core<Real>::addMissing(const PairMap<const Contact*>& wanted) {
  for (const Contact& contact : contacts()) {
    const auto found = wanted.find({contact.i, contact.j});
    if (found == wanted.end()) continue;
    const double lacking = found->second->tangentialForce - contact.tangentialForce;
    const double torque = found->second->rollingTorque - contact.rollingTorque;
    const auto add = [&](std::int32_t number, double sign, double arm) {
      if (static_cast<std::size_t>(number) >= moving_) return;
      const std::size_t n = placeOf(number);
      if (law_.rotation) torque_[n] += static_cast<Real>(sign * torque);
      force_[n] += {static_cast<Real>(-sign * lacking * contact.ny),
                    static_cast<Real>(sign * lacking * contact.nx)};
      if (law_.rotation) torque_[n] -= static_cast<Real>(arm * lacking);
    };
    const double own = ownRadius(contact);
    if (static_cast<std::size_t>(contact.j) >= position_.size()) {
      add(contact.i, 1.0, planeArmOf(law_.lever, law_.planeLever, own, own - contact.overlap));
      continue;
    }
    const double other = static_cast<double>(radius_[placeOf(contact.j)]);
    add(contact.i, 1.0, armOf(law_.lever, own, other, contact.overlap));
    add(contact.j, -1.0, armOf(law_.lever, other, own, contact.overlap));
  }
}

namespace {

/// The load of a spring, as it is or is to be: a force, or a torque.
struct SpringLoad {
  double value;
  bool slides;
};

/// Brings a spring nearer to its wanted load. While it sticks, the load falls by `unit` with every
/// unit of the stretch: one step of Newton's method is exact. Where the dashpot alone takes it
/// beyond the bound, each step brings it nearer by a bound.
/// @return whether it has it
bool stretched(SpringLoad now, SpringLoad want, double unit, double& spring) {
  if (!(unit > 0.0)) return true;
  const bool sameWay = now.value * want.value >= 0.0;
  if (want.slides) {
    // It is to slip here, too, which leaves the spring as the law resets it, whatever it was: at
    // the bound itself rounding would decide, and a dashpot outside of the bound does not help.
    // Where it carries nothing, as in tension, any stretch is beyond the bound.
    if (now.slides && sameWay) return true;
    constexpr double least = 1e-30;  // [N] or [N m]
    spring = spring == 0.0 ? -(want.value == 0.0 ? least : 2.0 * want.value) / unit : 2.0 * spring;
    return false;
  }
  const bool atBound = now.slides && sameWay && std::abs(now.value) <= std::abs(want.value);
  const double scale = std::abs(want.value) + unit * std::abs(spring);
  if (atBound || std::abs(now.value - want.value) <= 1e-12 * scale) return true;
  spring += (now.value - want.value) / unit;
  return false;
}

}  // namespace

/// Brings the springs of each contact nearer to their wanted loads. @return whether all have them
template <class Real>
bool Core<Real>::stretch(const PairMap<const Contact*>& wanted, PairMap<Stretches>& springs) const {
  if (wanted.empty() || !lists_.springs().any()) return true;
  bool settled = true;
  for (const Contact& contact : contacts()) {
    const auto found = wanted.find({contact.i, contact.j});
    if (found == wanted.end()) continue;
    const Contact& want = *found->second;
    Stretches& own = springs[found->first];
    if (lists_.springs().sliding)
      settled &=
          stretched({contact.tangentialForce, contact.sliding},
                    {want.tangentialForce, want.sliding}, forcePerStretch(contact), own.spring);
    if (lists_.springs().rolling) {
      const Contact placed = byPlace(contact);
      settled &= stretched(
          {contact.rollingTorque, contact.rollingSlides}, {want.rollingTorque, want.rollingSlides},
          static_cast<double>(lawOf(placed).kr * rollingLengths(placed).square), own.angle);
    }
  }
  return settled;
}

/// Of a disk, a wall disk or a plane.
template <class Real>
std::size_t Core<Real>::placeOf(std::int32_t number) const {
  const auto n = static_cast<std::size_t>(number);
  return n < moving_ ? static_cast<std::size_t>(indexOfId_[n]) : n;
}

/// By how much f_t falls for each unit of ξ [N/m], of a remembered force 1.
template <class Real>
double Core<Real>::forcePerStretch(const Contact& contact) const {
  if (law_.history == History::force) return 1.0;
  const Contact placed = byPlace(contact);
  return static_cast<double>(tangentialStiffness(lawOf(placed), geometryOf(placed)));
}

/// @param springs  by numbers i < j; all others are relaxed
template <class Real>
void Core<Real>::setSprings(const PairMap<Stretches>& springs) {
  if (!lists_.springs().any()) return;
  std::vector<KeptSpring> pairs;
  for (PlacedPlane& placed : placedPlanes_)
    for (Array<Real>* array : {&placed.spring, &placed.angle, &placed.memory, &placed.rest})
      std::ranges::fill(*array, Real(0));
  for (const auto& [numbers, stretches] : springs) {
    const auto i = static_cast<std::int32_t>(placeOf(numbers.first));
    const std::size_t other = placeOf(numbers.second);
    if (other >= position_.size()) {
      PlacedPlane& placed = placedPlanes_[other - position_.size()];
      const auto place = static_cast<std::size_t>(i);
      if (lists_.springs().sliding) placed.spring[place] = static_cast<Real>(stretches.spring);
      if (lists_.springs().rolling) placed.angle[place] = static_cast<Real>(stretches.angle);
      if (lists_.springs().memory) placed.memory[place] = static_cast<Real>(stretches.memory);
      continue;
    }
    KeptSpring kept{i, static_cast<std::int32_t>(other), stretches.spring, stretches.angle,
                    stretches.memory};
    if (kept.j < kept.i) swapDisks(kept);
    pairs.push_back(kept);
  }
  lists_.restoreSprings(std::move(pairs), places(), travel(), team_);
  findReachedWallDisks();
  rememberChoice();
}

}  // namespace grain
