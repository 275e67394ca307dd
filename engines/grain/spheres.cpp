#include "engines/grain/spheres.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>
#include <tuple>

namespace grain {
namespace {

void demand(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(what);
}

void requireSound(const Law& law) {
  demand(law.normal == Normal::linear && law.damper == Damper::constant,
         "spheres have the linear law with constant dampers");
  demand(!law.friction() || law.springs(), "spheres have tangential springs, or no friction");
  demand(law.rolling == Rolling::none && law.cohesion == Cohesion::none,
         "spheres have no rolling resistance and no cohesion");
}

}  // namespace

Spheres::Spheres(SpheresSetup setup)
    : setup_(std::move(setup)),
      law_(generalLaw<double>(setup_.law, setup_.dt, setup_.rotation)),
      predicts_(setup_.law.damping == Damping::predicted &&
                setup_.integrator != Integrator::semiImplicitEuler) {
  demand(setup_.dt > 0.0, "the time step must be > 0 s");
  requireSound(setup_.law);
  const std::size_t count = size();
  if (setup_.skin == 0.0 && count > 0) setup_.skin = 0.5 * *std::ranges::min_element(setup_.radius);
  force_.resize(count);
  torque_.resize(count);
  seenVelocity_.resize(count);
  seenSpin_.resize(count);
  for (std::size_t w = 0; w < setup_.walls.size(); ++w)
    for (std::size_t member = 0; member < setup_.walls[w].planes.size(); ++member)
      planes_.push_back({w, member, {}, setup_.walls[w].planes[member].normal, {}});
  placePlanes();
  listPairs();
  // At t = 0 the velocities are given: nothing is predicted, and no damping is implicit.
  seeVelocities(0.0);
  const double halfStep = std::exchange(law_.halfStep, 0.0);
  addForces();
  law_.halfStep = halfStep;
  if (setup_.integrator == Integrator::positionVerlet) {
    halfKick_ = 0.5 * setup_.dt;  // from here on velocities live half a step before positions
    kick(-halfKick_);
  }
}

Vec3<double> Spheres::velocity(std::size_t i) const {
  return setup_.velocity[i] + (halfKick_ / setup_.mass[i]) * force_[i];
}

Vec3<double> Spheres::spin(std::size_t i) const {
  if (!law_.rotation) return setup_.spin[i];
  return setup_.spin[i] + (halfKick_ / setup_.inertia[i]) * torque_[i];
}

void Spheres::advance(std::uint64_t steps) {
  for (; steps > 0; --steps) step();
}

void Spheres::kick(double dt) {
  for (std::size_t i = 0; i < size(); ++i) {
    setup_.velocity[i] += (dt / setup_.mass[i]) * force_[i];
    if (law_.rotation) setup_.spin[i] += (dt / setup_.inertia[i]) * torque_[i];
  }
}

void Spheres::step() {
  const double dt = setup_.dt;
  const bool verlet = setup_.integrator == Integrator::velocityVerlet;
  kick(verlet ? 0.5 * dt : dt);
  for (std::size_t i = 0; i < size(); ++i) setup_.position[i] += dt * setup_.velocity[i];
  seeVelocities(predicts_ ? 0.5 * dt : 0.0);
  ++steps_;
  placePlanes();
  if (listIsOld()) listPairs();
  addForces();
  if (verlet) kick(0.5 * dt);
}

/// What dashpots and springs see: v, or v + a·ahead with the acceleration of the last evaluation.
void Spheres::seeVelocities(double ahead) {
  for (std::size_t i = 0; i < size(); ++i) {
    seenVelocity_[i] = setup_.velocity[i] + (ahead / setup_.mass[i]) * force_[i];
    seenSpin_[i] = setup_.spin[i] + (ahead / setup_.inertia[i]) * torque_[i];
  }
}

void Spheres::placePlanes() {
  for (PlacedPlane& placed : planes_) {
    const SpaceWall& wall = setup_.walls[placed.wall];
    const SpaceWall::State now = wall.motion(time());
    placed.point = wall.planes[placed.member].point + (now.centre - wall.motion(0.0).centre);
    placed.velocity = now.velocity;
  }
}

void Spheres::addForces() {
  for (std::size_t i = 0; i < size(); ++i) {
    force_[i] = setup_.mass[i] * setup_.gravity;
    torque_[i] = {};
  }
  for (Pair& pair : pairs_) addPair(pair);
}

Spheres::Meeting Spheres::meetSphere(const Pair& pair) const {
  const auto i = static_cast<std::size_t>(pair.i), j = static_cast<std::size_t>(pair.j);
  const double a = setup_.radius[i], b = setup_.radius[j];
  const Vec3<double> apart = setup_.position[i] - setup_.position[j];
  const double distance = length(apart), overlap = a + b - distance;
  return {(1.0 / distance) * apart,
          seenVelocity_[i] - seenVelocity_[j],
          overlap,
          armOf(law_.lever, a, b, overlap),
          armOf(law_.lever, b, a, overlap),
          armOf(law_.velocityLever, a, b, overlap),
          armOf(law_.velocityLever, b, a, overlap)};
}

Spheres::Meeting Spheres::meetPlane(Pair& pair) const {
  const auto i = static_cast<std::size_t>(pair.i);
  const PlacedPlane& plane = planes_[static_cast<std::size_t>(-1 - pair.j)];
  const double a = setup_.radius[i];
  const double height = dot(setup_.position[i] - plane.point, plane.normal);
  pair.place = setup_.position[i] - planePoint(law_, a, height) * plane.normal;
  return {plane.normal, seenVelocity_[i] - plane.velocity,
          a - height,   planeArmOf(law_.lever, law_.planeLever, a, height),
          0.0,          planeArmOf(law_.velocityLever, law_.planeLever, a, height),
          0.0};
}

/// The law of space_law.hpp, and its equal and opposite force.
void Spheres::addPair(Pair& pair) {
  const bool plane = pair.j < 0;
  const auto i = static_cast<std::size_t>(pair.i), j = static_cast<std::size_t>(pair.j);
  const Meeting meeting = plane ? meetPlane(pair) : meetSphere(pair);
  const bool began = !pair.touches;
  pair.overlap = meeting.overlap;
  pair.touches = meeting.overlap > 0.0;
  if (!pair.touches) {
    pair.spring = {};
    return;
  }
  requireShallow(pair);
  ++evaluations_;
  const Vec3<double>& n = meeting.normal;
  const Vec3<double> spinJ = plane ? Vec3<double>{} : seenSpin_[j];
  if (!began && law_.tangential != Tangential::none) {
    const SpaceConventions& how = setup_.conventions;
    pair.spring = turnedSpring(how.turn, pair.spring, pair.normal, n);
    const Vec3<double>& about = how.turn == SpringTurn::firstOrder ? pair.normal : n;
    if (how.twist == SpringTwist::meanSpin && law_.rotation)
      pair.spring = twistedSpring(how.turn, pair.spring, about,
                                  0.5 * setup_.dt * dot(seenSpin_[i] + spinJ, about));
  }
  pair.normal = n;

  ContactMotion<double> motion{};
  motion.overlap = meeting.overlap;
  motion.normalVelocity = dot(meeting.velocity, n);
  Vec3<double> slip = meeting.velocity - motion.normalVelocity * n;
  if (law_.rotation) slip -= cross(meeting.armI * seenSpin_[i] + meeting.armJ * spinJ, n);
  motion.normalCompliance = 1.0 / setup_.mass[i];
  motion.tangentialCompliance = meeting.armI * meeting.leverI / setup_.inertia[i];
  if (!plane) {
    motion.normalCompliance += 1.0 / setup_.mass[j];
    motion.tangentialCompliance += meeting.armJ * meeting.leverJ / setup_.inertia[j];
  }
  motion.normalCompliance *= law_.halfStep;
  motion.tangentialCompliance =
      motion.normalCompliance + (law_.rotation ? law_.halfStep * motion.tangentialCompliance : 0.0);

  const SpaceForce<double> found = spaceForce(law_, motion, slip, pair.spring);
  pair.normalForce = found.normal;
  pair.tangential = found.tangential;
  pair.sliding = found.sliding;
  const Vec3<double> force = found.normal * n + found.tangential;
  const Vec3<double> couple = cross(n, found.tangential);
  force_[i] += force;
  torque_[i] -= meeting.leverI * couple;
  if (plane) return;
  force_[j] -= force;
  torque_[j] -= meeting.leverJ * couple;
}

void Spheres::requireShallow(const Pair& pair) const {
  const auto i = static_cast<std::size_t>(pair.i);
  double smaller = setup_.radius[i];
  if (pair.j >= 0) smaller = std::min(smaller, setup_.radius[static_cast<std::size_t>(pair.j)]);
  // Coincident centres have no normal.
  const bool deep = setup_.maxOverlap > 0.0 && pair.overlap > setup_.maxOverlap * smaller;
  if (!deep && std::isfinite(pair.overlap)) return;
  const std::string partner =
      pair.j >= 0 ? "sphere " + std::to_string(pair.j) : "plane " + std::to_string(-1 - pair.j);
  throw std::runtime_error("sphere " + std::to_string(pair.i) + " and " + partner + " overlap by " +
                           std::to_string(pair.overlap / smaller) +
                           " of the smaller radius at t = " + std::to_string(time()) + " s");
}

bool Spheres::listIsOld() const {
  const double sure = 0.499 * setup_.skin;
  for (std::size_t i = 0; i < size(); ++i) {
    const Vec3<double> moved = setup_.position[i] - positionsAtList_[i];
    if (!(dot(moved, moved) < sure * sure)) return true;
  }
  return false;
}

/// All that are nearer than the skin, found by a sweep along x, and every sphere with every plane.
void Spheres::listPairs() {
  const std::vector<Pair> known = std::move(pairs_);
  pairs_.clear();
  std::vector<std::int32_t> order(size());
  std::iota(order.begin(), order.end(), 0);
  const auto low = [&](std::int32_t i) {
    return setup_.position[static_cast<std::size_t>(i)].x -
           setup_.radius[static_cast<std::size_t>(i)];
  };
  for (std::size_t i = 0; i < size(); ++i)
    if (!std::isfinite(dot(setup_.position[i], setup_.position[i])))
      throw std::runtime_error("the position of sphere " + std::to_string(i) + " is not finite");
  std::ranges::sort(order, {}, low);
  const auto add = [&](std::int32_t i, std::int32_t j) {
    Pair& pair = pairs_.emplace_back();
    pair.i = i;
    pair.j = j;
  };
  for (std::size_t k = 0; k < order.size(); ++k) {
    const auto i = static_cast<std::size_t>(order[k]);
    for (std::size_t next = k + 1; next < order.size(); ++next) {
      const auto j = static_cast<std::size_t>(order[next]);
      if (low(order[next]) > setup_.position[i].x + setup_.radius[i] + setup_.skin) break;
      const Vec3<double> apart = setup_.position[i] - setup_.position[j];
      const double near = setup_.radius[i] + setup_.radius[j] + setup_.skin;
      if (dot(apart, apart) < near * near)
        add(std::min(order[k], order[next]), std::max(order[k], order[next]));
    }
    for (std::size_t p = 0; p < planes_.size(); ++p)
      add(order[k], -1 - static_cast<std::int32_t>(p));
  }
  const auto byNumbers = [](const Pair& pair) { return std::tuple(pair.i, pair.j); };
  std::ranges::sort(pairs_, {}, byNumbers);
  for (auto old = known.begin(); Pair & pair : pairs_) {
    while (old != known.end() && byNumbers(*old) < byNumbers(pair)) ++old;
    if (old != known.end() && byNumbers(*old) == byNumbers(pair)) pair = *old;
  }
  positionsAtList_ = setup_.position;
  ++rebuilds_;
}

std::vector<SpaceContact> Spheres::contacts() const {
  std::vector<SpaceContact> found;
  for (const Pair& pair : pairs_) {
    if (!pair.touches) continue;
    const std::int32_t j = pair.j >= 0 ? pair.j : static_cast<std::int32_t>(size()) + (-1 - pair.j);
    found.push_back(
        {pair.i, j, pair.normal, pair.overlap, pair.normalForce, pair.tangential, pair.sliding});
  }
  std::ranges::sort(found, {}, [](const SpaceContact& c) { return std::tuple(c.i, c.j); });
  return found;
}

std::pair<Vec3<double>, Vec3<double>> Spheres::wallLoad(std::size_t w) const {
  const Vec3<double> centre = wallState(w).centre;
  Vec3<double> force{}, torque{};
  for (const Pair& pair : pairs_) {
    if (pair.j >= 0 || !pair.touches || planes_[static_cast<std::size_t>(-1 - pair.j)].wall != w)
      continue;
    const Vec3<double> own = pair.normalForce * pair.normal + pair.tangential;
    force -= own;
    torque -= cross(pair.place - centre, own);
  }
  return {force, torque};
}

}  // namespace grain
