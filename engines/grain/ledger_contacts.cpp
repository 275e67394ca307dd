#include "engines/grain/contact_force.hpp"
#include "engines/grain/core.hpp"

namespace grain {

/// One contact as the ledger reads it.
struct ContactKinematics {
  double nx = 0.0, ny = 0.0;
  double leverI = 0.0, leverJ = 0.0;  ///< of the force
  double armI = 0.0, armJ = 0.0;      ///< of the spins in v_t
  HalfKicks normal, tangential;       ///< relative velocities half way through the kicks
  HalfKicks slip;         ///< v_t of the law then; the force does its work on tangential
  double seenSlip = 0.0;  ///< v_t that the law saw
  HalfKicks rolling;      ///< ω_r half way through the kicks
  double seenRolling = 0.0, wallSpin = 0.0;

  double along(const BodyMotion& i, const BodyMotion& j) const {
    return (i.vx - j.vx) * nx + (i.vy - j.vy) * ny;
  }
  double across(const BodyMotion& i, const BodyMotion& j) const {
    return (i.vy - j.vy) * nx - (i.vx - j.vx) * ny - (leverI * i.spin + leverJ * j.spin);
  }
  double slipOf(const BodyMotion& i, const BodyMotion& j) const {
    return (i.vy - j.vy) * nx - (i.vx - j.vx) * ny - (armI * i.spin + armJ * j.spin);
  }
};

namespace {

HalfKicks times(double force, const HalfKicks& velocity) {
  return {force * velocity.closing, force * velocity.opening};
}

}  // namespace

/// As the law saw it.
template <class Real>
GRAIN_INLINE BodyMotion LedgerObserver<Real>::seen(std::size_t place) const {
  const Vec<Real> velocity = core_.velocitySeen()[place];
  BodyMotion motion{static_cast<double>(velocity.x), static_cast<double>(velocity.y), 0.0};
  if (core_.law_.rotation) motion.spin = static_cast<double>(core_.spinSeen()[place]);
  return motion;
}

/// Of a wall's disk; the spin is that which friction sees.
template <class Real>
BodyMotion LedgerObserver<Real>::diskMotion(std::size_t wallDisk) const {
  const WallPoint point = core_.wallDisk(wallDisk);
  return {point.vx, point.vy,
          core_.law_.rotation ? core_.walls_[core_.wallOf(wallDisk)].state().spin : 0.0};
}

template <class Real>
double LedgerObserver<Real>::wallSpinOf(std::size_t j) const {
  const std::size_t wall =
      j < core_.diskCount() ? core_.wallOf(j) : core_.placedPlanes_[j - core_.diskCount()].wall;
  return core_.walls_[wall].state().spin;
}

/// Of the point of a plane that a contact touches.
template <class Real>
BodyMotion LedgerObserver<Real>::planeMotion(const Contact& contact) const {
  const auto j = static_cast<std::size_t>(contact.j);
  const WallState& wall = core_.walls_[core_.placedPlanes_[j - core_.diskCount()].wall].state();
  const auto i = static_cast<std::size_t>(contact.i);
  const auto own = static_cast<double>(core_.radius_[i]);
  const double reach = planePoint(core_.law_, own, own - contact.overlap);
  const auto number = static_cast<std::size_t>(core_.idAtIndex_[i]);
  const double armX = core_.x(number) - reach * contact.nx - wall.x;
  const double armY = core_.y(number) - reach * contact.ny - wall.y;
  return {wall.vx - wall.spin * armY, wall.vy + wall.spin * armX, 0.0};
}

/// @param wall  the motion of its point that is touched; null: j moves as well
template <class Real>
GRAIN_INLINE ContactKinematics LedgerObserver<Real>::kinematicsOf(const Contact& contact,
                                                                  const BodyMotion* wall) const {
  const auto i = static_cast<std::size_t>(contact.i);
  const auto j = static_cast<std::size_t>(contact.j);
  const auto own = static_cast<double>(core_.radius_[i]);
  ContactKinematics touch;
  touch.nx = contact.nx;
  touch.ny = contact.ny;
  if (core_.law_.rotation && j < core_.diskCount()) {
    const auto other = static_cast<double>(core_.radius_[j]);
    touch.leverI = armOf(core_.law_.lever, own, other, contact.overlap);
    touch.leverJ = armOf(core_.law_.lever, other, own, contact.overlap);
    touch.armI = armOf(core_.law_.velocityLever, own, other, contact.overlap);
    touch.armJ = armOf(core_.law_.velocityLever, other, own, contact.overlap);
  } else if (core_.law_.rotation) {
    const double height = own - contact.overlap;
    touch.leverI = planeArmOf(core_.law_.lever, core_.law_.planeLever, own, height);
    touch.armI = planeArmOf(core_.law_.velocityLever, core_.law_.planeLever, own, height);
  }
  const auto parts = [&](auto&& of) {
    return HalfKicks{of(closing_.of(i), wall != nullptr ? *wall : closing_.of(j)),
                     of(opening_.of(i), wall != nullptr ? *wall : opening_.of(j))};
  };
  touch.normal = parts([&](const auto& a, const auto& b) { return touch.along(a, b); });
  touch.tangential = parts([&](const auto& a, const auto& b) { return touch.across(a, b); });
  touch.slip = parts([&](const auto& a, const auto& b) { return touch.slipOf(a, b); });
  touch.seenSlip = touch.slipOf(seen(i), wall != nullptr ? *wall : seen(j));
  if (!core_.rolls()) return touch;
  if (wall != nullptr) touch.wallSpin = wallSpinOf(j);
  const auto relative = [&](const BodyMotion& a, auto&& ofJ) {
    return a.spin - (wall != nullptr ? touch.wallSpin : ofJ().spin);
  };
  touch.rolling = {relative(closing_.of(i), [&] { return closing_.of(j); }),
                   relative(opening_.of(i), [&] { return opening_.of(j); })};
  touch.seenRolling = relative(seen(i), [&] { return seen(j); });
  return touch;
}

template <class Real>
void LedgerObserver<Real>::accountContact(const Contact& contact) {
  const auto j = static_cast<std::size_t>(contact.j);
  if (j < core_.moving_) return accountContact(contact, kinematicsOf(contact, nullptr), nullptr);
  const BodyMotion wall = j < core_.diskCount() ? diskMotion(j) : planeMotion(contact);
  accountContact(contact, kinematicsOf(contact, &wall), &wall);
}

/// @param wall  the motion of its point that is touched; null: j moves as well
template <class Real>
void LedgerObserver<Real>::accountContact(const Contact& contact, const ContactKinematics& touch,
                                          const BodyMotion* wall) {
  if (!tallies_) return accountForces(contact, touch, wall);
  HalfKicks loss;
  sums_.tally(&loss);
  accountForces(contact, touch, wall);
  sums_.tally(nullptr);
  const auto numberOf = [this](std::int32_t place) {
    const auto at = static_cast<std::size_t>(place);
    return at < core_.moving_ ? core_.idAtIndex_[at] : place;
  };
  const std::int32_t i = numberOf(contact.i), j = numberOf(contact.j);
  losses_.push_back({std::min(i, j), std::max(i, j), loss});
}

/// The same, nothing kept of the contact itself.
template <class Real>
void LedgerObserver<Real>::accountForces(const Contact& contact, const ContactKinematics& touch,
                                         const BodyMotion* wall) {
  const ContactMotion<Real> motion = core_.geometryOf(contact);
  const GeneralLaw<Real>& law = core_.lawOf(contact);
  Real memory = static_cast<Real>(contact.memory);
  // A lagging k₂ is that of no δ_max that the contact still knows: undamped, the force itself is
  // it.
  const bool lags = remembersRest(law) && !law.normalDamping;
  const auto body =
      lags ? contact.normalForce : static_cast<double>(bodyForce(law, motion, memory));
  const auto energy = static_cast<double>(bodyEnergy(law, motion, memory));
  sums_.ledger.elasticNormal += energy;
  sums_.lose(&EnergyLedger::lostNormalDamping, times(contact.normalForce - body, touch.normal));
  if (core_.lists_.springs().memory) {
    SpringAccount& account = sums_.nextSpring(LedgerSums::Spring::body);
    account.i = contact.i;
    account.j = contact.j;
    account.sliding = core_.law_.cohesion == CohesionLaw::elastoPlastic;
    account.energy = energy;
    sums_.settleSpring(LedgerSums::Spring::body, times(body, touch.normal));
  }
  if (wall != nullptr) {
    const BodyMotion still{};
    const double power = -(contact.normalForce * touch.along(still, *wall) +
                           contact.tangentialForce * touch.across(still, *wall)) +
                         contact.rollingTorque * touch.wallSpin;
    sums_.workOfWall({power, power});
  }
  if (core_.rolls()) accountRolling(contact, touch);
  if (core_.law_.tangential == TangentialLaw::none) return;
  // Where v_t has another arm than f_t, the force does work on a velocity that the law does not
  // see.
  sums_.gain({contact.tangentialForce * (touch.tangential.closing - touch.slip.closing),
              contact.tangentialForce * (touch.tangential.opening - touch.slip.opening)});
  if (core_.lists_.springs().sliding) {
    accountSpring(contact, touch, static_cast<double>(tangentialStiffness(law, motion)));
  } else {
    sums_.lose(contact.sliding ? &EnergyLedger::lostSliding : &EnergyLedger::lostTangentialDamping,
               times(contact.tangentialForce, touch.slip));
  }
}

/// ξ is kept as the next evaluation will begin with it; what carries the force of this one is ξ
/// without the part of v_t dt that was added since.
template <class Real>
GRAIN_INLINE void LedgerObserver<Real>::accountSpring(const Contact& contact,
                                                      const ContactKinematics& touch,
                                                      double stiffness) {
  const bool remembersForce = core_.law_.history == History::force;
  double part = 0.0;  // of v_t dt
  if (core_.law_.stretch == SpringUpdate::after && !contact.sliding) part = 1.0;
  if (core_.law_.stretch == SpringUpdate::midpoint) part = 0.5;
  const double unit = remembersForce ? 1.0 : stiffness;
  const double stretch = contact.spring - part * static_cast<double>(core_.law_.dt) *
                                              touch.seenSlip * (remembersForce ? stiffness : 1.0);
  SpringAccount& account = sums_.nextSpring(LedgerSums::Spring::sliding);
  account.i = contact.i;
  account.j = contact.j;
  account.sliding = contact.sliding;
  account.modulus = !remembersForce ? stiffness : stiffness > 0.0 ? 1.0 / stiffness : 0.0;
  account.square = stretch * stretch;
  account.energy = 0.5 * account.modulus * account.square;
  sums_.ledger.elasticTangential += account.energy;
  sums_.settleSpring(LedgerSums::Spring::sliding, times(-unit * stretch, touch.slip));
  const bool slid = contact.sliding && !core_.law_.resetSpringOnly;
  sums_.lose(slid ? &EnergyLedger::lostSliding : &EnergyLedger::lostTangentialDamping,
             times(contact.tangentialForce + unit * stretch, touch.slip));
}

/// The same of θ.
template <class Real>
void LedgerObserver<Real>::accountRolling(const Contact& contact, const ContactKinematics& touch) {
  const auto lost =
      contact.rollingSlides ? &EnergyLedger::lostRolling : &EnergyLedger::lostRollingDamping;
  if (core_.law_.rolling != RollingLaw::spring)
    return sums_.lose(lost, times(contact.rollingTorque, touch.rolling));
  double part = 0.0;  // of ω_r dt
  if (core_.law_.stretch == SpringUpdate::after && !contact.rollingSlides) part = 1.0;
  if (core_.law_.stretch == SpringUpdate::midpoint) part = 0.5;
  const double angle =
      contact.angle - part * static_cast<double>(core_.law_.dt) * touch.seenRolling;
  SpringAccount& account = sums_.nextSpring(LedgerSums::Spring::rolling);
  account.i = contact.i;
  account.j = contact.j;
  account.sliding = contact.rollingSlides;
  account.modulus =
      static_cast<double>(core_.lawOf(contact).kr * core_.rollingLengths(contact).square);
  account.square = angle * angle;
  account.energy = 0.5 * account.modulus * account.square;
  sums_.ledger.elasticRolling += account.energy;
  const double ofSpring = -account.modulus * angle;
  sums_.settleSpring(LedgerSums::Spring::rolling, times(ofSpring, touch.rolling));
  sums_.lose(core_.law_.conventions.rollingReset == SpringReset::springOnly
                 ? &EnergyLedger::lostRollingDamping
                 : lost,
             times(contact.rollingTorque - ofSpring, touch.rolling));
}

}  // namespace grain
