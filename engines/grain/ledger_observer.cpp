#include "engines/grain/ledger_observer.hpp"

#include "engines/grain/contact_force.hpp"
#include "engines/grain/core.hpp"
#include "engines/grain/reorder.hpp"

namespace grain {

/// One contact as the ledger reads it.
struct Touch {
  double nx = 0.0, ny = 0.0;
  double leverI = 0.0, leverJ = 0.0;  ///< of the force
  double armI = 0.0, armJ = 0.0;      ///< of the spins in v_t
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
  for (auto* motions : {&closing_, &opening_, &seen_}) motions->resize(disks);
  if (setup.bottom) {
    plateBefore_.resize(disks);
    plateAccounts_.resize(disks);
  }
}

template <class Real>
void LedgerObserver<Real>::beforeMotion() {
  plateBefore_.assign(core_.plateSpring_.begin(), core_.plateSpring_.end());
}

template <class Real>
void LedgerObserver<Real>::renumber(std::span<const std::int32_t> order,
                                    std::span<const std::int32_t> newPlace,
                                    std::vector<std::byte>& scratch) {
  if (!plateAccounts_.empty()) {
    reorder(plateBefore_, order, scratch);
    reorder(plateAccounts_, order, scratch);
  }
  sums_.renumber(newPlace);
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
  const LedgerSums::Scheme& scheme = sums_.scheme();
  for (std::size_t place = 0; place < core_.moving_; ++place) {
    closing_[place] = carried(place, time + scheme.offset.closing);
    opening_[place] = carried(place, time + scheme.offset.opening);
    seen_[place] = seen(place);
  }
  if (core_.law_.normal == Normal::impulse)
    for (Contact contact : core_.contacts()) {
      for (std::int32_t* disk : {&contact.i, &contact.j})
        if (static_cast<std::size_t>(*disk) < core_.moving_)
          *disk = core_.placeOf_[static_cast<std::size_t>(*disk)];
      accountContact(contact);
    }
  else
    core_.forContactsByPlace([&](const Contact& contact) { accountContact(contact); });
  sums_.endSprings();
  for (std::size_t place = 0; place < core_.moving_; ++place) accountDisk(place, time);
}

/// Velocity and spin as stored, carried on by the acceleration for a time [s].
template <class Real>
GRAIN_INLINE BodyMotion LedgerObserver<Real>::carried(std::size_t place, double time) const {
  const double kick = time * static_cast<double>(core_.inverseMass_[place]);
  BodyMotion motion{static_cast<double>(core_.velocity_[place].x) + kick * core_.force_[place].x,
                    static_cast<double>(core_.velocity_[place].y) + kick * core_.force_[place].y,
                    0.0};
  if (core_.law_.rotation)
    motion.spin = static_cast<double>(core_.spin_[place]) +
                  time * static_cast<double>(core_.torque_[place] * core_.inverseInertia_[place]);
  return motion;
}

/// As the law saw it.
template <class Real>
GRAIN_INLINE BodyMotion LedgerObserver<Real>::seen(std::size_t place) const {
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
  if (j < core_.diskCount()) {
    const WallPoint point = core_.wallDisk(j);
    return {point.vx, point.vy,
            core_.law_.rotation ? core_.walls_[core_.wallOf(j)].state().spin : 0.0};
  }
  const WallState& wall = core_.walls_[core_.placedPlanes_[j - core_.diskCount()].wall].state();
  const auto i = static_cast<std::size_t>(contact.i);
  const auto own = static_cast<double>(core_.radius_[i]);
  const double reach = planePoint(core_.law_, own, own - contact.overlap);
  const auto number = static_cast<std::size_t>(core_.numberAt_[i]);
  const double armX = core_.x(number) - reach * contact.nx - wall.x;
  const double armY = core_.y(number) - reach * contact.ny - wall.y;
  return {wall.vx - wall.spin * armY, wall.vy + wall.spin * armX, 0.0};
}

/// @param wall  the motion of its point that is touched; null: j moves as well
template <class Real>
GRAIN_INLINE Touch LedgerObserver<Real>::touchOf(const Contact& contact,
                                                 const BodyMotion* wall) const {
  const auto i = static_cast<std::size_t>(contact.i);
  const auto j = static_cast<std::size_t>(contact.j);
  const auto own = static_cast<double>(core_.radius_[i]);
  Touch touch;
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
  const BodyMotion& closing = wall != nullptr ? *wall : closing_[j];
  const BodyMotion& opening = wall != nullptr ? *wall : opening_[j];
  touch.normal = {touch.along(closing_[i], closing), touch.along(opening_[i], opening)};
  touch.tangential = {touch.across(closing_[i], closing), touch.across(opening_[i], opening)};
  touch.slip = {touch.slipOf(closing_[i], closing), touch.slipOf(opening_[i], opening)};
  touch.seenSlip = touch.slipOf(seen_[i], wall != nullptr ? *wall : seen_[j]);
  return touch;
}

template <class Real>
GRAIN_INLINE void LedgerObserver<Real>::accountContact(const Contact& contact) {
  const bool atWall = static_cast<std::size_t>(contact.j) >= core_.moving_;
  const BodyMotion wall = atWall ? wallMotion(contact) : BodyMotion{};
  const Touch touch = touchOf(contact, atWall ? &wall : nullptr);
  ContactMotion<Real> motion{};
  motion.overlap = static_cast<Real>(contact.overlap);
  motion.radius =
      core_.pairRadius(static_cast<std::size_t>(contact.i), static_cast<std::size_t>(contact.j));
  const auto elastic = static_cast<double>(elasticForce(core_.law_, motion));
  sums_.ledger.elasticNormal += static_cast<double>(storedEnergy(core_.law_, motion, Real(0)));
  sums_.lose(&EnergyLedger::lostNormalDamping, times(contact.normalForce - elastic, touch.normal));
  if (atWall) {
    const BodyMotion still{};
    const double power = -(contact.normalForce * touch.along(still, wall) +
                           contact.tangentialForce * touch.across(still, wall));
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
GRAIN_INLINE void LedgerObserver<Real>::accountSpring(const Contact& contact, const Touch& touch,
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
GRAIN_INLINE void LedgerObserver<Real>::accountDisk(std::size_t place, double time) {
  EnergyLedger& ledger = sums_.ledger;
  const auto number = static_cast<std::size_t>(core_.numberAt_[place]);
  const BodyMotion now = carried(place, time);
  ledger.kinetic += 0.5 * core_.mass_[number] * (now.vx * now.vx + now.vy * now.vy) +
                    0.5 * core_.inertia_[number] * now.spin * now.spin;
  const auto gx = static_cast<double>(core_.motionConstants_.gravityX);
  const auto gy = static_cast<double>(core_.motionConstants_.gravityY);
  if (gx != 0.0 || gy != 0.0)
    ledger.potential -= core_.mass_[number] *
                        (gx * (core_.x(number) - middle_.x) + gy * (core_.y(number) - middle_.y));
  if (!core_.plateSpring_.empty()) accountPlate(place);
}

/// The plate's force anew, from the spring that it was made of.
template <class Real>
GRAIN_INLINE void LedgerObserver<Real>::accountPlate(std::size_t place) {
  const BottomConstants<Real>& plate = core_.motionConstants_.plate;
  const BodyMotion& was = seen_[place];
  const auto ux = static_cast<Real>(was.vx), uy = static_cast<Real>(was.vy);
  Vec<Real> spring = plateBefore_[place];
  const Real trialX = -plate.kb * spring.x - plate.gb * ux;
  const Real trialY = -plate.kb * spring.y - plate.gb * uy;
  const bool slides =
      squareRoot(trialX * trialX + trialY * trialY) > plate.pressure * core_.weighed_[place];
  const auto bottom = plateSpin_ ? bottomForce<true, Real> : bottomForce<false, Real>;
  const BottomForce<Real> force = bottom(plate, core_.weighed_[place], core_.radius_[place], ux, uy,
                                         static_cast<Real>(was.spin), spring.x, spring.y);
  if (!slides) spring = plateBefore_[place];  // else it is set to what the force is

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
  const auto ofSpring = [&](const BodyMotion& u) { return springX * u.vx + springY * u.vy; };
  const auto beyond = [&](const BodyMotion& u) {
    return static_cast<double>(force.x) * u.vx + static_cast<double>(force.y) * u.vy +
           static_cast<double>(force.torque) * u.spin - ofSpring(u);
  };
  sums_.plateSpring(plateAccounts_[place], account,
                    {ofSpring(closing_[place]), ofSpring(opening_[place])});
  sums_.lose(&EnergyLedger::lostBottom, {beyond(closing_[place]), beyond(opening_[place])});
}

template class LedgerObserver<double>;
template class LedgerObserver<float>;

}  // namespace grain
