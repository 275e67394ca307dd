#include "engines/grain/core.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

#include "engines/grain/contact_force.hpp"
#include "engines/grain/fingerprint.hpp"

namespace grain {
namespace {

template <class Real>
void fill(Array<Vec<Real>>& array, const std::vector<double>& x, const std::vector<double>& y,
          std::size_t size) {
  array.assign(size, {});
  for (std::size_t i = 0; i < std::min(size, x.size()); ++i)
    array[i] = {static_cast<Real>(x[i]), static_cast<Real>(y[i])};
}

template <class Real>
void fill(Array<Real>& array, const std::vector<double>& values, std::size_t size) {
  array.assign(size, Real(0));
  std::ranges::transform(values, array.begin(), [](double v) { return static_cast<Real>(v); });
}

double smallestRadius(const Disks& disks) {
  return disks.size() == 0 ? 1.0 : *std::ranges::min_element(disks.radius);
}

/// How far apart bodies may be in contact [m]: it grows with R₁₂ < a_i.
template <class Real>
double adhesionRange(const Setup& setup) {
  if (setup.law.cohesion != CohesionLaw::jkr || setup.disks.size() == 0) return 0.0;
  const double largest = *std::ranges::max_element(setup.disks.radius);
  double range = 0.0;
  const auto look = [&](const ContactLaw& law) {
    const auto own = generalLaw<Real>(law, setup.dt, setup.rotation);
    range = std::max(range, 1.001 * static_cast<double>(jkrRange(own, static_cast<Real>(largest))));
  };
  if (setup.materials)
    std::ranges::for_each(setup.materials->laws, look);
  else
    look(setup.law);
  return range;
}

void demand(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(what);
}

/// @throws std::invalid_argument naming what a law cannot be
void requireSound(const ContactLaw& law) {
  const bool rigid = law.normal == NormalLaw::rigid;
  demand(!rigid || law.rolling == RollingLaw::none, "impulses know no resistance to rolling");
  demand(!rigid || law.cohesion == CohesionLaw::none, "impulses know no cohesion");
  demand(law.rolling != RollingLaw::spring || law.kr > 0.0,
         "a rolling spring needs a stiffness > 0");
  demand(law.cohesion != CohesionLaw::jkr || (law.normal == NormalLaw::hertz && law.w > 0.0),
         "JKR needs Hertz' law and a work of adhesion > 0");
  demand(law.cohesion != CohesionLaw::elastoPlastic ||
             (law.normal == NormalLaw::linear && law.kUnload >= law.kn && law.kc >= 0.0),
         "an elasto-plastic contact needs the linear law, k2 >= kn and kc >= 0");
}

/// @throws std::invalid_argument where the laws of materials are not what Setup asks for
void requireSound(const Materials& materials, const Setup& setup) {
  const auto within = [&](const std::vector<std::int32_t>& of, std::size_t size) {
    return of.size() == size && std::ranges::all_of(of, [&](std::int32_t material) {
             return material >= 0 && static_cast<std::size_t>(material) < materials.count;
           });
  };
  demand(within(materials.ofDisk, setup.disks.size()) &&
             within(materials.ofWall, setup.walls.size()) &&
             materials.laws.size() == materials.count * materials.count,
         "each disk and wall has a material, and each two of these a law");
  for (const ContactLaw& law : materials.laws) {
    requireSound(law);
    const ContactLaw& all = setup.law;
    demand(all.gn > 0.0 || law.gn == 0.0, "materials have no dashpots where the law has none");
    demand(all.friction() || !law.friction(), "materials have no friction where the law has none");
  }
}

MotionEffects motionEffects(const Setup& setup) {
  MotionEffects effects;
  effects.rotation = turnsDisks(setup.law) && setup.rotation;
  effects.predict = dampingVelocity(setup.law) == DampingVelocity::predicted;
  effects.gravity = setup.gravityX != 0.0 || setup.gravityY != 0.0;
  effects.plate = setup.bottom.has_value();
  effects.plateSpin = setup.bottom && setup.bottom->spin;
  return effects;
}

}  // namespace

template <class Real>
Core<Real>::Core(Setup setup)
    : law_(generalLaw<Real>(setup.law, setup.dt, setup.rotation)),
      integrator_(setup.law.conventions.integrator),
      dt_(setup.dt),
      moving_(setup.disks.size()),
      fingerprint_(fingerprint(setup)),
      motionConstants_{
          static_cast<Real>(setup.law.conventions.integrator == Integrator::velocityVerlet
                                ? 0.5 * setup.dt
                                : setup.dt),
          static_cast<Real>(setup.dt),
          static_cast<Real>(0.5 * setup.dt),
          static_cast<Real>(setup.gravityX),
          static_cast<Real>(setup.gravityY),
          {setup.bottom.value_or(BottomPlate{}), setup.dt}},
      mass_(setup.disks.mass),
      inertia_(setup.disks.inertia),
      kernels_(kernels<Real>()),
      maxOverlap_(setup.maxOverlap > 0.0 ? setup.maxOverlap
                                         : std::numeric_limits<double>::infinity()),
      lists_(moving_, partCount(setup.threads, moving_),
             {hasSprings(law_), law_.rolling == RollingLaw::spring, remembers(law_),
              remembersRest(law_)},
             Skin(setup.skin, smallestRadius(setup.disks)), maxOverlap_,
             adhesionRange<Real>(setup)),
      team_(partCount(setup.threads, moving_)),
      reports_(partCount(setup.threads, moving_)),
      touching_(partCount(setup.threads, moving_)),
      impactLaw_{setup.law.en, setup.law.et0, setup.law.friction() ? setup.law.mu : 0.0} {
  if (!(dt_ > 0.0)) throw std::invalid_argument("the time step must be > 0 s");
  if (law_.normal == NormalLaw::rigid && integrator_ != Integrator::semiImplicitEuler)
    throw std::invalid_argument("impulses need semi-implicit Euler steps");
  requireSound(setup.law);
  if (setup.materials) requireSound(*setup.materials, setup);
  const MotionEffects effects = motionEffects(setup);
  motion_ = kernels_.motion[indexOf(effects)];
  const bool materials = setup.materials.has_value();
  contacts_ = materials ? kernels_.generalMaterialContacts : kernels_.generalContacts;
  planes_ = materials ? kernels_.materialPlanes : kernels_.generalPlanes;
  if (const auto variant = contactVariant(law_); variant && !setup.generalKernels) {
    const auto& contacts = materials ? kernels_.materialContacts : kernels_.contacts;
    if (const auto own = kernelOf(contacts, *variant)) contacts_ = own;
    if (const auto own = kernelOf(kernels_.planes, *variant); own && !materials) planes_ = own;
  }

  if (materials) buildMaterials(setup);
  buildWalls(std::move(setup.walls));
  allocate(setup.disks, effects);
  if (setup.ledger) ledger_ = std::make_unique<LedgerObserver<Real>>(*this, setup);
  start();
}

template <class Real>
void Core<Real>::buildMaterials(const Setup& setup) {
  const Materials& materials = *setup.materials;
  materials_ = static_cast<std::int32_t>(materials.count);
  for (const ContactLaw& law : materials.laws) {
    laws_.push_back(generalLaw<Real>(lawOfPair(law), setup.dt, setup.rotation));
    impactLaws_.push_back({law.en, law.et0, law.friction() ? law.mu : 0.0});
  }
  material_.assign(materials.ofDisk.begin(), materials.ofDisk.end());
  for (const bool planes : {false, true})
    for (std::size_t w = 0; w < setup.walls.size(); ++w) {
      const Wall& wall = setup.walls[w];
      material_.insert(material_.end(), planes ? wall.planes.size() : wall.diskX.size(),
                       materials.ofWall[w]);
    }
}

template <class Real>
void Core<Real>::buildWalls(std::vector<Wall> walls) {
  std::size_t next = moving_;
  for (Wall& wall : walls) {
    wallBegin_.push_back(next);
    next += wall.diskX.size();
    for (std::size_t member = 0; member < wall.planes.size(); ++member)
      placedPlanes_.push_back({walls_.size(), member, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}});
    walls_.emplace_back(std::move(wall));
  }
  wallBegin_.push_back(next);
  reached_.resize(walls_.size());
  for (PlacedPlane& placed : placedPlanes_) {
    placed.plane = walls_[placed.wall].plane(placed.member);
    if (lists_.springs().sliding) placed.spring.assign(moving_, Real(0));
    if (lists_.springs().rolling) placed.angle.assign(moving_, Real(0));
    if (lists_.springs().memory) placed.memory.assign(moving_, Real(0));
    if (lists_.springs().rest) placed.rest.assign(moving_, Real(0));
  }
}

template <class Real>
void Core<Real>::allocate(const Disks& disks, const MotionEffects& effects) {
  const std::size_t all = wallBegin_.back();
  idAtIndex_.resize(moving_);
  std::iota(idAtIndex_.begin(), idAtIndex_.end(), 0);
  indexOfId_ = idAtIndex_;
  std::vector<double> radius = disks.radius, inverseMass, inverseInertia;
  for (const MovingWall& wall : walls_)
    radius.insert(radius.end(), wall.radii().begin(), wall.radii().end());
  for (const double mass : disks.mass) inverseMass.push_back(1.0 / mass);

  fill(position_, disks.x, disks.y, all);
  fill(radius_, radius, all);
  fill(inverseMass_, inverseMass, all);
  fill(velocity_, disks.vx, disks.vy, effects.predict ? moving_ : all);
  if (effects.predict) dashpotVelocity_.assign(all, {});
  force_.assign(moving_, {});
  if (effects.rotation) {
    for (const double inertia : disks.inertia) inverseInertia.push_back(1.0 / inertia);
    fill(inverseInertia_, inverseInertia, all);
    fill(spin_, disks.spin, effects.predict ? moving_ : all);
    torque_.assign(moving_, Real(0));
    if (effects.predict) seenSpin_.assign(all, Real(0));
  }
  if (effects.plate || effects.gravity) fill(gravityForce_, disks.mass, moving_);
  if (effects.plate) plateSpring_.assign(moving_, {});
  if constexpr (hasLocalCoordinates<Real>) {
    const double largest = radius.empty() ? 1.0 : *std::ranges::max_element(radius);
    square_ = static_cast<Real>(std::exp2(std::ceil(std::log2(2.0 * largest))));
    origin_.assign(all, {});
    const double square = static_cast<double>(square_);
    for (std::size_t i = 0; i < moving_; ++i) {
      const Vec<double> corner{std::floor(disks.x[i] / square) * square,
                               std::floor(disks.y[i] / square) * square};
      origin_[i] = {static_cast<Real>(corner.x), static_cast<Real>(corner.y)};
      position_[i] = {static_cast<Real>(disks.x[i] - corner.x),
                      static_cast<Real>(disks.y[i] - corner.y)};
    }
  }
}

/// At t = 0 the velocities are given, so nothing is predicted and no damping is implicit.
template <class Real>
void Core<Real>::start() {
  renumber();
  addForcesOfStart(false);
  if (ledger_) ledger_->begin();
  if (integrator_ == Integrator::positionVerlet) {
    halfKick_ = 0.5 * dt_;  // from here on velocities live half a step before positions
    kick(static_cast<Real>(-halfKick_));
  }
}

/// @param underWay  implicit damping is half a step ahead, as in the middle of a run
template <class Real>
void Core<Real>::addForcesOfStart(bool underWay) {
  MotionConstants<Real> still = motionConstants_;
  still.kick = still.drift = still.ahead = Real(0);
  std::swap(still, motionConstants_);
  advanceDisks();
  std::swap(still, motionConstants_);
  const Real halfStep = std::exchange(law_.halfStep, underWay ? law_.halfStep : Real(0));
  addForces(true);
  law_.halfStep = halfStep;
}

template <class Real>
void Core<Real>::findNeighbours() {
  recorded_ = false;
  known_.reset();
  placeWalls(Which::all);
  guarded([&] { lists_.rebuild(places(), travel(), team_); });
  findReachedWallDisks();
  rememberChoice();
}

template <class Real>
Places Core<Real>::places() {
  if constexpr (!hasLocalCoordinates<Real>) {
    return {position_, radius_, {}};
  } else {
    places_.resize(position_.size());
    placeRadius_.assign(radius_.begin(), radius_.end());
    for (std::size_t i = 0; i < position_.size(); ++i)
      places_[i] = {static_cast<double>(origin_[i].x) + static_cast<double>(position_[i].x),
                    static_cast<double>(origin_[i].y) + static_cast<double>(position_[i].y)};
    return {places_, placeRadius_, origin_};
  }
}

template <class Real>
ContactView<Real> Core<Real>::contactView() {
  return {position_.data(),    velocitySeen().data(),  spinSeen().data(), radius_.data(),
          inverseMass_.data(), inverseInertia_.data(), force_.data(),     torque_.data(),
          material_.data(),    laws_.data(),           materials_};
}

template <class Real>
MotionView<Real> Core<Real>::motionView() {
  return {position_.data(),
          velocity_.data(),
          spin_.data(),
          dashpotVelocity_.data(),
          seenSpin_.data(),
          force_.data(),
          torque_.data(),
          inverseMass_.data(),
          inverseInertia_.data(),
          gravityForce_.data(),
          radius_.data(),
          plateSpring_.data(),
          positionsAtListBuild_.data(),
          allowanceSquare_.data()};
}

/// Before the team begins: its parts share these arrays.
template <class Real>
void Core<Real>::makeRoomForRecords() {
  for (PlacedPlane& placed : placedPlanes_)
    for (Array<Real>* array :
         {&placed.overlap, &placed.normal, &placed.tangential, &placed.sliding})
      array->resize(moving_);
  if (law_.rolling == RollingLaw::none) return;
  for (PlacedPlane& placed : placedPlanes_)
    for (Array<Real>* array : {&placed.rolling, &placed.rollingSlides}) array->resize(moving_);
}

template <class Real>
PlaneView<Real> Core<Real>::planeView(PlacedPlane& placed, bool record) {
  const Plane& plane = placed.plane;
  const WallState& wall = walls_[placed.wall].state();
  const auto real = [](double v) { return static_cast<Real>(v); };
  return {
      plane.x,
      plane.y,
      real(plane.nx),
      real(plane.ny),
      real(wall.x),
      real(wall.y),
      real(wall.vx),
      real(wall.vy),
      real(wall.spin),
      origin_.empty() ? nullptr : origin_.data(),
      {placed.spring.empty() ? nullptr : placed.spring.data(),
       placed.angle.empty() ? nullptr : placed.angle.data(),
       placed.memory.empty() ? nullptr : placed.memory.data(),
       placed.rest.empty() ? nullptr : placed.rest.data()},
      record ? placed.overlap.data() : nullptr,
      record ? placed.normal.data() : nullptr,
      record ? placed.tangential.data() : nullptr,
      record ? placed.sliding.data() : nullptr,
      record ? placed.rolling.data() : nullptr,
      record ? placed.rollingSlides.data() : nullptr,
      material_.empty()
          ? 0
          : material_[position_.size() + static_cast<std::size_t>(&placed - placedPlanes_.data())]};
}

}  // namespace grain
