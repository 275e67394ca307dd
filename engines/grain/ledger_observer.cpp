#include <optional>
#include <tuple>
#include <utility>

#include "engines/grain/ledger_observer.hpp"

#include "engines/grain/contact_force.hpp"
#include "engines/grain/core.hpp"

namespace grain {

/// Velocity of a body's centre, or of a wall's point, and its spin.
struct BodyMotion {
  double vx = 0.0, vy = 0.0, spin = 0.0;
};

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

namespace {

/// Euler's scheme kicks once, after the forces; Verlet's by halves before and after.
LedgerSums::Scheme schemeOf(const Setup& setup) {
  const double dt = setup.dt;
  if (setup.integrator == Integrator::semiImplicitEuler) return {{0.0, dt}, {0.0, 0.5 * dt}};
  return {{0.5 * dt, 0.5 * dt}, {-0.25 * dt, 0.25 * dt}};
}

}  // namespace

template <class Real>
LedgerObserver<Real>::LedgerObserver(const Core<Real>& core, const Setup& setup)
    : core_(core),
      sums_(schemeOf(setup)),
      toForces_(setup.integrator == Integrator::semiImplicitEuler ? 0.0 : 0.5 * setup.dt),
      plateSpin_(setup.bottom && setup.bottom->spin && core.law_.rotation) {
  const std::size_t disks = setup.disks.x.size();
  for (std::size_t i = 0; i < disks; ++i) {
    middle_.x += setup.disks.x[i] / static_cast<double>(disks);
    middle_.y += setup.disks.y[i] / static_cast<double>(disks);
  }
  if (setup.bottom) {
    plateBefore_.resize(disks);
    plateAccounts_.resize(disks);
  }
}

template <class Real>
void LedgerObserver<Real>::beforeMotion() {
  for (std::size_t place = 0; place < core_.plateSpring_.size(); ++place)
    plateBefore_[static_cast<std::size_t>(core_.numberAt_[place])] = core_.plateSpring_[place];
}

template <class Real>
void LedgerObserver<Real>::begin() {
  account(0.0);
  sums_.begin();
}

template <class Real>
void LedgerObserver<Real>::afterForces() {
  account(toForces_);
}

/// @param time  from the stored velocities to that of the forces [s]
template <class Real>
void LedgerObserver<Real>::account(double time) {
  EnergyLedger& ledger = sums_.ledger;
  sums_.beginEvaluation();
  ledger.kinetic = ledger.elasticNormal = ledger.elasticTangential = 0.0;
  ledger.potential = ledger.plateSprings = 0.0;
  for (const Contact& contact : core_.contacts()) accountContact(contact, time);
  sums_.endSprings();
  for (std::size_t number = 0; number < core_.moving_; ++number) accountDisk(number, time);
}

/// Velocity and spin as stored, carried on by the acceleration for a time [s].
template <class Real>
BodyMotion LedgerObserver<Real>::carried(std::size_t place, double time) const {
  const double kick = time * static_cast<double>(core_.inverseMass_[place]);
  BodyMotion motion{static_cast<double>(core_.velocity_[place].x) + kick * core_.force_[place].x,
                    static_cast<double>(core_.velocity_[place].y) + kick * core_.force_[place].y,
                    0.0};
  if (core_.law_.rotation)
    motion.spin = static_cast<double>(core_.spin_[place]) +
                  time * static_cast<double>(core_.torque_[place] * core_.inverseInertia_[place]);
  return motion;
}

/// As the law saw it, of moving and wall disks.
template <class Real>
BodyMotion LedgerObserver<Real>::seen(std::size_t place) const {
  const bool predicted = !core_.seenVelocity_.empty();
  const Vec<Real> velocity = predicted ? core_.seenVelocity_[place] : core_.velocity_[place];
  BodyMotion motion{static_cast<double>(velocity.x), static_cast<double>(velocity.y), 0.0};
  if (core_.law_.rotation)
    motion.spin = static_cast<double>(predicted ? core_.seenSpin_[place] : core_.spin_[place]);
  return motion;
}

/// Of the point of a wall that a contact touches; the spin is that of a wall disk.
template <class Real>
BodyMotion LedgerObserver<Real>::wallMotion(const Contact& contact) const {
  const auto j = static_cast<std::size_t>(contact.j);
  if (j < core_.position_.size()) {
    const WallPoint point = core_.wallDisk(j);
    return {point.vx, point.vy,
            core_.law_.rotation ? core_.walls_[core_.wallOf(j)].state().spin : 0.0};
  }
  const WallState& wall =
      core_.walls_[core_.placedPlanes_[j - core_.position_.size()].wall].state();
  const auto i = static_cast<std::size_t>(contact.i);
  const double own = core_.ownRadius(contact);
  const double reach = planePoint(core_.law_, own, own - contact.overlap);
  const double armX = core_.x(i) - reach * contact.nx - wall.x;
  const double armY = core_.y(i) - reach * contact.ny - wall.y;
  return {wall.vx - wall.spin * armY, wall.vy + wall.spin * armX, 0.0};
}

template <class Real>
Touch LedgerObserver<Real>::touchOf(const Contact& contact, double time) const {
  const auto i = static_cast<std::size_t>(core_.placeOf_[static_cast<std::size_t>(contact.i)]);
  const auto number = static_cast<std::size_t>(contact.j);
  const std::size_t j =
      number < core_.moving_ ? static_cast<std::size_t>(core_.placeOf_[number]) : number;
  const double own = core_.ownRadius(contact);
  Touch touch;
  touch.nx = contact.nx;
  touch.ny = contact.ny;
  if (core_.law_.rotation && j < core_.position_.size()) {
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
  if (number >= core_.moving_) touch.wall = wallMotion(contact);
  const auto part = [&](double offset) {
    const BodyMotion of = carried(i, time + offset);
    const BodyMotion to = touch.wall ? *touch.wall : carried(j, time + offset);
    return std::tuple(touch.along(of, to), touch.across(of, to), touch.slipOf(of, to));
  };
  const LedgerSums::Scheme& scheme = sums_.scheme();
  std::tie(touch.normal.closing, touch.tangential.closing, touch.slip.closing) =
      part(scheme.offset.closing);
  std::tie(touch.normal.opening, touch.tangential.opening, touch.slip.opening) =
      part(scheme.offset.opening);
  touch.seenSlip = touch.slipOf(seen(i), touch.wall ? *touch.wall : seen(j));
  return touch;
}

template <class Real>
void LedgerObserver<Real>::accountContact(const Contact& contact, double time) {
  const Touch touch = touchOf(contact, time);
  ContactMotion<Real> motion{};
  motion.overlap = static_cast<Real>(contact.overlap);
  motion.radius = core_.pairRadius(contact);
  const auto elastic = static_cast<double>(elasticForce(core_.law_, motion));
  sums_.ledger.elasticNormal += static_cast<double>(storedEnergy(core_.law_, motion, Real(0)));
  sums_.lose(&EnergyLedger::lostNormalDamping, times(contact.normalForce - elastic, touch.normal));
  if (touch.wall) {
    const BodyMotion still{};
    const double power = -(contact.normalForce * touch.along(still, *touch.wall) +
                           contact.tangentialForce * touch.across(still, *touch.wall));
    sums_.workOfWall({power, power});
  }
  if (core_.law_.tangential == Tangential::none) return;
  // Where v_t has another arm than f_t, the force does work on a velocity that the law does not
  // see.
  sums_.gain({contact.tangentialForce * (touch.tangential.closing - touch.slip.closing),
              contact.tangentialForce * (touch.tangential.opening - touch.slip.opening)});
  if (core_.lists_.springs()) {
    accountSpring(contact, touch, static_cast<double>(tangentialStiffness(core_.law_, motion)));
  } else {
    sums_.lose(contact.sliding ? &EnergyLedger::lostSliding : &EnergyLedger::lostTangentialDamping,
               times(contact.tangentialForce, touch.slip));
  }
}

/// ξ is kept as the next evaluation will begin with it; what carries the force of this one is ξ
/// without the part of v_t dt that was added since.
template <class Real>
void LedgerObserver<Real>::accountSpring(const Contact& contact, const Touch& touch,
                                         double stiffness) {
  const bool remembersForce = core_.law_.history == History::force;
  double part = 0.0;  // of v_t dt
  if (core_.law_.stretch == Stretch::after && !contact.sliding) part = 1.0;
  if (core_.law_.stretch == Stretch::midpoint) part = 0.5;
  const double unit = remembersForce ? 1.0 : stiffness;
  const double stretch = contact.spring - part * static_cast<double>(core_.law_.dt) *
                                              touch.seenSlip * (remembersForce ? stiffness : 1.0);
  SpringAccount account;
  account.i = contact.i;
  account.j = contact.j;
  account.sliding = contact.sliding;
  account.modulus = !remembersForce ? stiffness : stiffness > 0.0 ? 1.0 / stiffness : 0.0;
  account.square = stretch * stretch;
  account.energy = 0.5 * account.modulus * account.square;
  sums_.ledger.elasticTangential += account.energy;
  sums_.spring(account, times(-unit * stretch, touch.slip));
  const bool slid = contact.sliding && !core_.law_.resetSpringOnly;
  sums_.lose(slid ? &EnergyLedger::lostSliding : &EnergyLedger::lostTangentialDamping,
             times(contact.tangentialForce + unit * stretch, touch.slip));
}

template <class Real>
void LedgerObserver<Real>::accountDisk(std::size_t number, double time) {
  EnergyLedger& ledger = sums_.ledger;
  const auto place = static_cast<std::size_t>(core_.placeOf_[number]);
  const BodyMotion now = carried(place, time);
  ledger.kinetic += 0.5 * core_.mass_[number] * (now.vx * now.vx + now.vy * now.vy) +
                    0.5 * core_.inertia_[number] * now.spin * now.spin;
  const auto gx = static_cast<double>(core_.motionConstants_.gravityX);
  const auto gy = static_cast<double>(core_.motionConstants_.gravityY);
  if (gx != 0.0 || gy != 0.0)
    ledger.potential -= core_.mass_[number] *
                        (gx * (core_.x(number) - middle_.x) + gy * (core_.y(number) - middle_.y));
  if (!core_.plateSpring_.empty()) accountPlate(number, time);
}

/// The plate's force anew, from the spring that it was made of.
template <class Real>
void LedgerObserver<Real>::accountPlate(std::size_t number, double time) {
  const BottomConstants<Real>& plate = core_.motionConstants_.plate;
  const auto place = static_cast<std::size_t>(core_.placeOf_[number]);
  const BodyMotion was = seen(place);
  const auto ux = static_cast<Real>(was.vx), uy = static_cast<Real>(was.vy);
  Vec<Real> spring = plateBefore_[number];
  const Real trialX = -plate.kb * spring.x - plate.gb * ux;
  const Real trialY = -plate.kb * spring.y - plate.gb * uy;
  const bool slides =
      squareRoot(trialX * trialX + trialY * trialY) > plate.pressure * core_.weighed_[place];
  const auto bottom = plateSpin_ ? bottomForce<true, Real> : bottomForce<false, Real>;
  const BottomForce<Real> force = bottom(plate, core_.weighed_[place], core_.radius_[place], ux, uy,
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
  sums_.ledger.plateSprings += account.energy;
  const LedgerSums::Scheme& scheme = sums_.scheme();
  TwoParts ofSpring, beyond;
  for (const auto part : {&TwoParts::closing, &TwoParts::opening}) {
    const BodyMotion u = carried(place, time + scheme.offset.*part);
    ofSpring.*part = springX * u.vx + springY * u.vy;
    beyond.*part = static_cast<double>(force.x) * u.vx + static_cast<double>(force.y) * u.vy +
                   static_cast<double>(force.torque) * u.spin - ofSpring.*part;
  }
  sums_.plateSpring(plateAccounts_[number], account, ofSpring);
  sums_.lose(&EnergyLedger::lostBottom, beyond);
}

template class LedgerObserver<double>;
template class LedgerObserver<float>;

}  // namespace grain
