#include <optional>
#include <tuple>
#include <utility>

#include "engines/grain/contact_force.hpp"
#include "engines/grain/core.hpp"

// What the ledger is told after each evaluation of the forces; its sums are in ledger.cpp.

namespace grain {

/// One contact as the ledger reads it.
struct Touch {
  double nx = 0.0, ny = 0.0;
  double leverI = 0.0, leverJ = 0.0;  ///< of the force
  double armI = 0.0, armJ = 0.0;      ///< of the spins in v_t
  std::optional<BodyMotion> wall;     ///< of its point that is touched
  TwoParts normal, tangential;        ///< relative velocities half way through the kicks
  TwoParts slip;          ///< v_t of the law then; the force does its work on tangential
  double seenSlip = 0.0;  ///< v_t that the law saw

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

TwoParts times(double force, const TwoParts& velocity) {
  return {force * velocity.closing, force * velocity.opening};
}

}  // namespace

template <class Real>
void Core<Real>::openLedger(const Setup& setup) {
  const double dt = setup.dt;
  if (integrator_ == Integrator::semiImplicitEuler)
    ledger_.emplace(LedgerSums::Scheme{{0.0, dt}, {0.0, 0.5 * dt}});
  else
    ledger_.emplace(LedgerSums::Scheme{{0.5 * dt, 0.5 * dt}, {-0.25 * dt, 0.25 * dt}});
  for (std::size_t i = 0; i < moving_; ++i) {
    middle_.x += setup.disks.x[i] / static_cast<double>(moving_);
    middle_.y += setup.disks.y[i] / static_cast<double>(moving_);
  }
  plateSpin_ = setup.bottom && setup.bottom->spin && law_.rotation;
  if (setup.bottom) {
    plateBefore_.resize(moving_);
    plateAccounts_.resize(moving_);
  }
}

/// Before the motion kernel stretches its springs.
template <class Real>
void Core<Real>::rememberPlate() {
  for (std::size_t place = 0; place < plateSpring_.size(); ++place)
    plateBefore_[static_cast<std::size_t>(numberAt_[place])] = plateSpring_[place];
}

/// @param time  from the stored velocities to that of the forces [s]
template <class Real>
void Core<Real>::account(double time) {
  EnergyLedger& ledger = ledger_->ledger;
  ledger_->beginEvaluation();
  ledger.kinetic = ledger.elasticNormal = ledger.elasticTangential = 0.0;
  ledger.potential = ledger.plateSprings = 0.0;
  for (const Contact& contact : contacts()) accountContact(contact, time);
  ledger_->endSprings();
  for (std::size_t number = 0; number < moving_; ++number) accountDisk(number, time);
}

/// Velocity and spin as stored, carried on by the acceleration for a time [s].
template <class Real>
BodyMotion Core<Real>::carried(std::size_t place, double time) const {
  const double kick = time * static_cast<double>(inverseMass_[place]);
  BodyMotion motion{static_cast<double>(velocity_[place].x) + kick * force_[place].x,
                    static_cast<double>(velocity_[place].y) + kick * force_[place].y, 0.0};
  if (law_.rotation)
    motion.spin = static_cast<double>(spin_[place]) +
                  time * static_cast<double>(torque_[place] * inverseInertia_[place]);
  return motion;
}

/// As the law saw it, of moving and wall disks.
template <class Real>
BodyMotion Core<Real>::seen(std::size_t place) const {
  const bool predicted = !seenVelocity_.empty();
  const Vec<Real> velocity = predicted ? seenVelocity_[place] : velocity_[place];
  BodyMotion motion{static_cast<double>(velocity.x), static_cast<double>(velocity.y), 0.0};
  if (law_.rotation) motion.spin = static_cast<double>(predicted ? seenSpin_[place] : spin_[place]);
  return motion;
}

/// Of the point of a wall that a contact touches; the spin is that of a wall disk.
template <class Real>
BodyMotion Core<Real>::wallMotion(const Contact& contact) const {
  const auto j = static_cast<std::size_t>(contact.j);
  if (j < position_.size()) {
    const WallPoint point = wallDisk(j);
    return {point.vx, point.vy, law_.rotation ? walls_[wallOf(j)].state().spin : 0.0};
  }
  const WallState& wall = walls_[placedPlanes_[j - position_.size()].wall].state();
  const auto i = static_cast<std::size_t>(contact.i);
  const double own = ownRadius(contact);
  const double reach = planePoint(law_, own, own - contact.overlap);
  const double armX = x(i) - reach * contact.nx - wall.x;
  const double armY = y(i) - reach * contact.ny - wall.y;
  return {wall.vx - wall.spin * armY, wall.vy + wall.spin * armX, 0.0};
}

template <class Real>
Touch Core<Real>::touchOf(const Contact& contact, double time) const {
  const auto i = static_cast<std::size_t>(placeOf_[static_cast<std::size_t>(contact.i)]);
  const auto number = static_cast<std::size_t>(contact.j);
  const std::size_t j = number < moving_ ? static_cast<std::size_t>(placeOf_[number]) : number;
  const double own = ownRadius(contact);
  Touch touch;
  touch.nx = contact.nx;
  touch.ny = contact.ny;
  if (law_.rotation && j < position_.size()) {
    const auto other = static_cast<double>(radius_[j]);
    touch.leverI = armOf(law_.lever, own, other, contact.overlap);
    touch.leverJ = armOf(law_.lever, other, own, contact.overlap);
    touch.armI = armOf(law_.velocityLever, own, other, contact.overlap);
    touch.armJ = armOf(law_.velocityLever, other, own, contact.overlap);
  } else if (law_.rotation) {
    const double height = own - contact.overlap;
    touch.leverI = planeArmOf(law_.lever, law_.planeLever, own, height);
    touch.armI = planeArmOf(law_.velocityLever, law_.planeLever, own, height);
  }
  if (number >= moving_) touch.wall = wallMotion(contact);
  const auto part = [&](double offset) {
    const BodyMotion of = carried(i, time + offset);
    const BodyMotion to = touch.wall ? *touch.wall : carried(j, time + offset);
    return std::tuple(touch.along(of, to), touch.across(of, to), touch.slipOf(of, to));
  };
  const LedgerSums::Scheme& scheme = ledger_->scheme();
  std::tie(touch.normal.closing, touch.tangential.closing, touch.slip.closing) =
      part(scheme.offset.closing);
  std::tie(touch.normal.opening, touch.tangential.opening, touch.slip.opening) =
      part(scheme.offset.opening);
  touch.seenSlip = touch.slipOf(seen(i), touch.wall ? *touch.wall : seen(j));
  return touch;
}

template <class Real>
void Core<Real>::accountContact(const Contact& contact, double time) {
  const Touch touch = touchOf(contact, time);
  ContactMotion<Real> motion{};
  motion.overlap = static_cast<Real>(contact.overlap);
  motion.radius = pairRadius(contact);
  const auto elastic = static_cast<double>(elasticForce(law_, motion));
  ledger_->ledger.elasticNormal += static_cast<double>(storedEnergy(law_, motion, Real(0)));
  ledger_->lose(&EnergyLedger::lostNormalDamping,
                times(contact.normalForce - elastic, touch.normal));
  if (touch.wall) {
    const BodyMotion still{};
    const double power = -(contact.normalForce * touch.along(still, *touch.wall) +
                           contact.tangentialForce * touch.across(still, *touch.wall));
    ledger_->workOfWall({power, power});
  }
  if (law_.tangential == Tangential::none) return;
  // Where v_t has another arm than f_t, the force does work on a velocity that the law does not
  // see.
  ledger_->gain({contact.tangentialForce * (touch.tangential.closing - touch.slip.closing),
                 contact.tangentialForce * (touch.tangential.opening - touch.slip.opening)});
  if (lists_.springs()) {
    accountSpring(contact, touch, static_cast<double>(tangentialStiffness(law_, motion)));
  } else {
    ledger_->lose(
        contact.sliding ? &EnergyLedger::lostSliding : &EnergyLedger::lostTangentialDamping,
        times(contact.tangentialForce, touch.slip));
  }
}

/// ξ is kept as the next evaluation will begin with it; what carries the force of this one is ξ
/// without the share of v_t dt that was added since.
template <class Real>
void Core<Real>::accountSpring(const Contact& contact, const Touch& touch, double stiffness) {
  const bool remembersForce = law_.history == History::force;
  double share = 0.0;  // of v_t dt
  if (law_.stretch == Stretch::after && !contact.sliding) share = 1.0;
  if (law_.stretch == Stretch::midpoint) share = 0.5;
  const double unit = remembersForce ? 1.0 : stiffness;
  const double stretch = contact.spring - share * static_cast<double>(law_.dt) * touch.seenSlip *
                                              (remembersForce ? stiffness : 1.0);
  SpringAccount account;
  account.i = contact.i;
  account.j = contact.j;
  account.sliding = contact.sliding;
  account.modulus = !remembersForce ? stiffness : stiffness > 0.0 ? 1.0 / stiffness : 0.0;
  account.square = stretch * stretch;
  account.energy = 0.5 * account.modulus * account.square;
  ledger_->ledger.elasticTangential += account.energy;
  ledger_->spring(account, times(-unit * stretch, touch.slip));
  const bool slid = contact.sliding && !law_.resetSpringOnly;
  ledger_->lose(slid ? &EnergyLedger::lostSliding : &EnergyLedger::lostTangentialDamping,
                times(contact.tangentialForce + unit * stretch, touch.slip));
}

template <class Real>
void Core<Real>::accountDisk(std::size_t number, double time) {
  EnergyLedger& ledger = ledger_->ledger;
  const auto place = static_cast<std::size_t>(placeOf_[number]);
  const BodyMotion now = carried(place, time);
  ledger.kinetic += 0.5 * mass_[number] * (now.vx * now.vx + now.vy * now.vy) +
                    0.5 * inertia_[number] * now.spin * now.spin;
  const auto gx = static_cast<double>(motionConstants_.gravityX);
  const auto gy = static_cast<double>(motionConstants_.gravityY);
  if (gx != 0.0 || gy != 0.0)
    ledger.potential -=
        mass_[number] * (gx * (x(number) - middle_.x) + gy * (y(number) - middle_.y));
  if (!plateSpring_.empty()) accountPlate(number, time);
}

/// The plate's force anew, from the spring that it was made of.
template <class Real>
void Core<Real>::accountPlate(std::size_t number, double time) {
  const BottomConstants<Real>& plate = motionConstants_.plate;
  const auto place = static_cast<std::size_t>(placeOf_[number]);
  const BodyMotion was = seen(place);
  const auto ux = static_cast<Real>(was.vx), uy = static_cast<Real>(was.vy);
  Vec<Real> spring = plateBefore_[number];
  const Real trialX = -plate.kb * spring.x - plate.gb * ux;
  const Real trialY = -plate.kb * spring.y - plate.gb * uy;
  const bool slides =
      squareRoot(trialX * trialX + trialY * trialY) > plate.pressure * weighed_[place];
  const auto bottom = plateSpin_ ? bottomForce<true, Real> : bottomForce<false, Real>;
  const BottomForce<Real> force = bottom(plate, weighed_[place], radius_[place], ux, uy,
                                         static_cast<Real>(was.spin), spring.x, spring.y);
  if (!slides) spring = plateBefore_[number];  // else it is set to what the force is

  const auto kb = static_cast<double>(plate.kb);
  const double springX = -kb * static_cast<double>(spring.x);
  const double springY = -kb * static_cast<double>(spring.y);
  SpringAccount account;
  account.sliding = slides;
  account.modulus = kb;
  account.square = static_cast<double>(spring.x) * static_cast<double>(spring.x) +
                   static_cast<double>(spring.y) * static_cast<double>(spring.y);
  account.energy = 0.5 * kb * account.square;
  ledger_->ledger.plateSprings += account.energy;
  const LedgerSums::Scheme& scheme = ledger_->scheme();
  TwoParts ofSpring, beyond;
  for (const auto part : {&TwoParts::closing, &TwoParts::opening}) {
    const BodyMotion u = carried(place, time + scheme.offset.*part);
    ofSpring.*part = springX * u.vx + springY * u.vy;
    beyond.*part = static_cast<double>(force.x) * u.vx + static_cast<double>(force.y) * u.vy +
                   static_cast<double>(force.torque) * u.spin - ofSpring.*part;
  }
  ledger_->plateSpring(plateAccounts_[number], account, ofSpring);
  ledger_->lose(&EnergyLedger::lostBottom, beyond);
}

template class Core<double>;
template class Core<float>;

}  // namespace grain
