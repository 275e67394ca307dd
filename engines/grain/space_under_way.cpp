#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include "engines/grain/spheres.hpp"

/// A run in space that begins as one that has come so far: as Core::beginUnderWay(), with vectors.
namespace grain {
namespace {

using Vector = Vec3<double>;

/// The load of a spring, as it is or is to be: a force, or a torque.
struct SpringLoad {
  Vector value;
  bool slides;
};

/// Brings a spring nearer to its wanted load. While it sticks, one step of Newton's method is
/// exact. Where it slips only the direction is the spring's: about twice the bound, the same step
/// turns it by twice what it is off.
/// @param guess  where to begin, for all but how the pair turns  @param begun  whether it has
/// @return whether it has it
bool stretched(const SpringLoad& now, const SpringLoad& want, double unit, const Vector& guess,
               bool& begun, Vector& spring) {
  if (!(unit > 0.0)) return true;
  const Vector off = now.value - want.value;
  const double scale = length(want.value) + unit * length(spring);
  if (now.slides >= want.slides && length(off) <= 1e-12 * scale) return true;
  constexpr double least = 1e-30;  // [m]: of a load of nothing any direction will do
  if (!std::exchange(begun, true))
    spring = dot(guess, guess) > 0.0 ? guess : Vector{least, least, least};
  else if (now.slides)
    spring += (2.0 / unit) * off;
  else if (want.slides)
    spring = 2.0 * spring;
  else
    spring += (1.0 / unit) * off;
  return false;
}

}  // namespace

void Spheres::beginUnderWay(const std::vector<SpaceContact>& forces) {
  if (steps_ > 0) throw std::logic_error("a run begins as one under way at its start");
  using Numbers = std::pair<std::int32_t, std::int32_t>;
  std::map<Numbers, const SpaceContact*> wanted;
  std::map<Numbers, SpaceMemory<double>> springs;
  std::map<Numbers, bool> begun;
  for (const SpaceContact& contact : forces) {
    wanted[{contact.i, contact.j}] = &contact;
    if (law_.cohesion == CohesionLaw::jkr) springs[{contact.i, contact.j}].memory = 1.0;
  }
  const bool lags =
      setup_.law.conventions.integrator != Integrator::semiImplicitEuler && seenVelocity_.empty();
  const std::uint64_t evaluations = evaluations_;
  kick(halfKick_);
  const auto velocity = velocity_, spin = spin_;  // of the start
  const auto goBack = [&](double by) {
    velocity_ = velocity;
    spin_ = spin;
    kick(-by);
  };
  const auto evaluate = [&] {
    const auto remember = [&](std::int32_t i, std::size_t j, const SpaceContactView& contacts,
                              std::size_t at, std::uint8_t& touches) {
      const std::int32_t a = idOf(i), b = idOf(static_cast<std::int32_t>(j));
      const auto found = springs.find({std::min(a, b), std::max(a, b)});
      const Vector normal = touches != 0 ? vectorOf(contacts.touch[at]) : Vector{};
      SpaceMemory<double> kept = found == springs.end() ? SpaceMemory<double>{} : found->second;
      kept.normal = normal;
      if (found != springs.end()) touches = 1;  // what it has is kept
      if (b < a) {
        kept.spring = -1.0 * kept.spring;
        kept.angle = -1.0 * kept.angle;
      }
      contacts.remember(at, kept, contacts.touch[at].w);
    };
    lists_.forNear([&](const SpacePairs& pairs) {
      for (std::size_t p = 0; p < pairs.count; ++p) {
        remember(pairs.i[p], static_cast<std::size_t>(pairs.j[p]), pairs.contacts, p,
                 pairs.touches[p]);
        if (pairs.touches[p] != 0) pairs.setTouches(p, true, 0.0);  // so that it is looked at
      }
    });
    for (std::size_t p = 0; p < planes_.size(); ++p)
      for (std::size_t i = 0; i < size(); ++i)
        remember(static_cast<std::int32_t>(i), position_.size() + p, planes_[p].contacts.view(), i,
                 planes_[p].touches[i]);
    beginForces();
    if (!seenVelocity_.empty()) {
      seenVelocity_ = velocity_;
      seenSpin_ = spin_;
    }
    addForcesAfter(lags ? law_.halfStep : 0.0);
  };
  const auto forWanted = [&](auto&& visit) {
    for (const SpaceContact& contact : contacts())
      if (const auto found = wanted.find({contact.i, contact.j}); found != wanted.end())
        visit(contact, *found->second);
  };
  constexpr int roundsOfVelocities = 20, mostOfSprings = 60;
  for (int round = 0; lags && round < roundsOfVelocities; ++round) {
    forWanted([&](const SpaceContact& now, const SpaceContact& want) {
      addLacking(now, want.tangentialForce - now.tangentialForce,
                 want.rollingTorque - now.rollingTorque);
    });
    goBack(0.5 * setup_.dt);
    evaluate();
  }
  const bool history =
      law_.tangential == TangentialLaw::spring || law_.tangential == TangentialLaw::springDashpot;
  for (int round = 0; history && round < mostOfSprings; ++round) {
    bool settled = true;
    forWanted([&](const SpaceContact& now, const SpaceContact& want) {
      SpaceMemory<double>& own = springs[{now.i, now.j}];
      const Meeting<double> meeting = meetingOf(now);
      const GeneralLaw<double>& law = lawOf(now);
      const auto [sliding, rolling] = loadPerStretch(law, meeting);
      const Vector guess = springFor(law, meeting, want, sliding);
      settled &= stretched({now.tangentialForce, now.sliding}, {want.tangentialForce, want.sliding},
                           sliding, guess, begun[{now.i, now.j}], own.spring);
      if (law_.rolling != RollingLaw::spring) return;
      bool always = true;  // at its bound nothing is known of the angle's direction
      settled &= stretched({now.rollingTorque, false}, {want.rollingTorque, false}, rolling, {},
                           always, own.angle);
    });
    if (settled) break;
    evaluate();
  }
  evaluations_ = evaluations;
  if (!lags || setup_.law.conventions.integrator == Integrator::velocityVerlet) goBack(halfKick_);
}

Meeting<double> Spheres::meetingOf(const SpaceContact& contact) {
  const std::size_t i = indexOf(static_cast<std::size_t>(contact.i)),
                    j = indexOf(static_cast<std::size_t>(contact.j));
  const SpaceView all = view(shares_[0].active);
  Meeting<double> meeting{};
  meeting.normal = contact.normal;
  meeting.overlap = contact.overlap;
  meeting.velocity = vectorOf(all.velocity[i]);
  meeting.radiusI = position_[i].w;
  meeting.inverseMassI = inverseMass_[i];
  if (law_.rotation) {
    meeting.spinI = vectorOf(all.spin[i]);
    meeting.inverseInertiaI = inverseInertia_[i];
  }
  if (j < position_.size()) {
    meeting.velocity -= vectorOf(all.velocity[j]);
    meeting.radiusJ = position_[j].w;
    meeting.inverseMassJ = inverseMass_[j];
    if (law_.rotation) {
      meeting.spinJ = vectorOf(all.spin[j]);
      meeting.inverseInertiaJ = inverseInertia_[j];
    }
    setArms(law_, meeting);
  } else {
    const double height = position_[i].w - contact.overlap;
    const SpacePlane plane = viewOf(j - position_.size(), 0, size());
    meeting.velocity -= plane.velocityAt(law_, position_[i], {contact.normal, height});
    setArms(law_, meeting, height);
  }
  meeting.inverseMass = meeting.inverseMassI + meeting.inverseMassJ;
  return meeting;
}

/// Adds a tangential force and a torque against rolling to those of a contact.
void Spheres::addLacking(const SpaceContact& contact, const Vector& force, const Vector& torque) {
  const Meeting<double> meeting = meetingOf(contact);
  const Vector couple = cross(contact.normal, force);
  const auto apply = [&](std::int32_t number, double sign, double lever) {
    const std::size_t n = indexOf(static_cast<std::size_t>(number));
    if (n >= size()) return;
    add(force_[n], force, sign);
    if (!law_.rotation) return;
    add(torque_[n], couple, -lever);
    add(torque_[n], torque, sign);
  };
  apply(contact.i, 1.0, meeting.leverI);
  apply(contact.j, -1.0, meeting.leverJ);
}

/// By how much f_t falls for each unit of ξ [N/m], of a remembered force 1; and M for each of θ.
std::pair<double, double> Spheres::loadPerStretch(const GeneralLaw<double>& law,
                                                  const Meeting<double>& meeting) const {
  const double sliding =
      law.history == History::force ? 1.0 : tangentialStiffness(law, motionOf(law, meeting));
  return {sliding, law.kr * rollingMotion(law, meeting.radiusI, meeting.radiusJ, 0.0).square};
}

/// A spring by which a contact has a wanted force, but for how the pair turns in the step; where it
/// slips, by which what is compared with the bound is along the force and twice as large.
Vector Spheres::springFor(const GeneralLaw<double>& law, const Meeting<double>& meeting,
                          const SpaceContact& want, double unit) const {
  const ContactMotion<double> motion = motionOf(law, meeting);
  const Vector slip = slipOf(law, meeting);
  Vector viscous{};
  if (law.tangential == TangentialLaw::springDashpot)
    viscous = -tangentialDamping(law, motion) * slip;
  const Vector& force = want.tangentialForce;
  const bool alone = want.sliding && law.dashpotOutsideBound;  // the dashpot has no part
  const Vector elastic = (want.sliding ? 2.0 : 1.0) * force - (alone ? Vector{} : viscous);
  const double growth = law.history == History::force ? tangentialStiffness(law, motion) : 1.0;
  return (-1.0 / unit) * elastic - (partBefore<double>(law.stretch) * growth * law.dt) * slip;
}

}  // namespace grain
