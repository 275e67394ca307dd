#include "engines/grain/spheres.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <string>

#include "engines/grain/fingerprint.hpp"
#include "engines/grain/kernels.hpp"
#include "engines/grain/pair_lists.hpp"

namespace grain {
namespace {

using Vector = Vec3<double>;

void demand(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(what);
}

/// v turned by an angle about its axis (Rodrigues' formula).
Vector turnedBy(const Vector& angle, const Vector& v) {
  const double size = length(angle);
  if (size == 0.0) return v;
  const Vector axis = (1.0 / size) * angle;
  const double c = std::cos(size), s = std::sin(size);
  return c * v + s * cross(axis, v) + ((1.0 - c) * dot(axis, v)) * axis;
}

double rangeOf(const GeneralLaw<double>& law, const std::vector<double>& radius) {
  if (law.cohesion != Cohesion::jkr || radius.empty()) return 0.0;
  return jkrRange(law, *std::ranges::max_element(radius));  // of a wall, the farthest
}

}  // namespace

Spheres::Spheres(SpheresSetup setup)
    : setup_(std::move(setup)),
      fingerprint_(fingerprint(setup_)),
      law_(generalLaw<double>(setup_.law, setup_.dt, setup_.rotation)),
      kernels_(kernels<double>().space),
      range_(rangeOf(law_, setup_.radius)),
      lists_(
          setup_.mass.size(), setup_.box.value_or(SpaceBox{}),
          Skin(setup_.skin, setup_.radius.empty() ? 1.0 : *std::ranges::min_element(setup_.radius)),
          range_) {
  demand(setup_.dt > 0.0, "the time step must be > 0 s");
  demand(setup_.law.normal != Normal::impulse, "spheres have no impulses");
  placeSpheres();
  moveWalls();
  updateNeighbours();
  // At t = 0 the velocities are given: nothing is predicted, and no damping is implicit.
  const double halfStep = std::exchange(law_.halfStep, 0.0);
  addForces();
  law_.halfStep = halfStep;
  if (setup_.integrator == Integrator::positionVerlet) {
    halfKick_ = 0.5 * setup_.dt;  // from here on velocities live half a step before positions
    kick(-halfKick_);
  }
}

void Spheres::placeSpheres() {
  const bool predicts = setup_.law.damping == Damping::predicted &&
                        setup_.integrator != Integrator::semiImplicitEuler;
  for (std::size_t i = 0; i < size(); ++i) {
    position_.push_back(quadOf(setup_.position[i], setup_.radius[i]));
    velocity_.push_back(quadOf(setup_.velocity[i]));
    spin_.push_back(quadOf(setup_.spin[i]));
    inverseMass_.push_back(1.0 / setup_.mass[i]);
    inverseInertia_.push_back(1.0 / setup_.inertia[i]);
  }
  for (std::size_t w = 0; w < setup_.walls.size(); ++w) {
    const SpaceWall& wall = setup_.walls[w];
    wallBegin_.push_back(position_.size());
    wallCentre_.push_back(wall.motion(0.0).centre);
    for (std::size_t k = 0; k < wall.radius.size(); ++k)
      position_.push_back(quadOf(wall.position[k], wall.radius[k]));
    for (std::size_t member = 0; member < wall.planes.size(); ++member)
      planes_.push_back({w, member, 0.0, {}, {}, {}, {}, {}, {}});
  }
  for (std::size_t w = 0; w < setup_.walls.size(); ++w)
    for (const SpaceWall::Cylinder& each : setup_.walls[w].cylinders)
      planes_.push_back({w, 0, each.radius, {}, each.point, each.axis, {}, {}, {}});
  for (PlacedPlane& plane : planes_) {
    plane.kept.resize(size());
    plane.results.resize(size());
    plane.touches.resize(size());
  }
  wallBegin_.push_back(position_.size());
  for (auto* array : {&velocity_, &spin_, &force_, &torque_}) array->resize(position_.size());
  inverseMass_.resize(position_.size());
  inverseInertia_.resize(position_.size());
  if (predicts) {
    seenVelocity_ = velocity_;
    seenSpin_ = spin_;
  }
  beginForces();
}

/// With gravity; the motion kernel does so in every step.
void Spheres::beginForces() {
  for (std::size_t i = 0; i < position_.size(); ++i) {
    force_[i] = i < size() ? quadOf(setup_.mass[i] * setup_.gravity) : Quad{};
    torque_[i] = {};
  }
  for (PlacedPlane& plane : planes_) plane.force = plane.torque = {};
}

Vector Spheres::velocity(std::size_t i) const {
  return vectorOf(velocity_[i]) + (halfKick_ * inverseMass_[i]) * vectorOf(force_[i]);
}

Vector Spheres::spin(std::size_t i) const {
  if (!law_.rotation) return vectorOf(spin_[i]);
  return vectorOf(spin_[i]) + (halfKick_ * inverseInertia_[i]) * vectorOf(torque_[i]);
}

void Spheres::advance(std::uint64_t steps) {
  for (; steps > 0; --steps) step();
}

void Spheres::kick(double dt) {
  for (std::size_t i = 0; i < size(); ++i) {
    add(velocity_[i], vectorOf(force_[i]), dt * inverseMass_[i]);
    if (law_.rotation) add(spin_[i], vectorOf(torque_[i]), dt * inverseInertia_[i]);
  }
}

SpaceMotionView Spheres::motionView() {
  return {position_.data(),
          velocity_.data(),
          law_.rotation ? spin_.data() : nullptr,
          seenVelocity_.empty() ? nullptr : seenVelocity_.data(),
          seenSpin_.empty() ? nullptr : seenSpin_.data(),
          force_.data(),
          torque_.data(),
          inverseMass_.data(),
          inverseInertia_.data(),
          setup_.mass.data(),
          chosen_.data(),
          allowanceSquare_.data()};
}

void Spheres::step() {
  const double dt = setup_.dt;
  const bool verlet = setup_.integrator == Integrator::velocityVerlet;
  const SpaceMotionReport moved =
      kernels_.motion({verlet ? 0.5 * dt : dt, dt, 0.5 * dt, setup_.gravity}, motionView(), size());
  outdated_ = !(moved.excess <= 0.0) || !std::isfinite(moved.squares);
  ++steps_;
  moveWalls();
  if (outdated_) updateNeighbours();
  addForces();
  if (verlet) kick(0.5 * dt);
}

void Spheres::moveWalls() {
  const auto cylinders = std::ranges::find_if(planes_, &PlacedPlane::isCylinder);
  auto plane = planes_.begin(), cylinder = cylinders;
  for (std::size_t w = 0; w < setup_.walls.size(); ++w) {
    const SpaceWall& wall = setup_.walls[w];
    const SpaceWall::State now = wall.motion(time());
    const Vector centre = wallCentre_[w];
    const bool turns = !isZero(now.angle);
    const auto place = [&](const Vector& point) {
      return now.centre + (turns ? turnedBy(now.angle, point - centre) : point - centre);
    };
    for (; cylinder != planes_.end() && cylinder->wall == w; ++cylinder) {
      cylinder->now = now;
      cylinder->force = cylinder->torque = {};
    }
    for (; plane != cylinders && plane->wall == w; ++plane) {
      const SpaceWall::Plane& member = wall.planes[plane->member];
      plane->now = now;
      plane->point = place(member.point);
      plane->normal = turnedBy(now.angle, member.normal);
      plane->force = plane->torque = {};
    }
    for (std::size_t k = 0; k < wall.radius.size(); ++k) {
      const std::size_t i = wallBegin_[w] + k;
      const Vector at = place(wall.position[k]);
      position_[i] = quadOf(at, wall.radius[k]);
      if (!isZero(now.spin) || vectorOf(velocity_[i]) != now.velocity ||
          !isZero(vectorOf(spin_[i]))) {
        velocity_[i] = quadOf(now.velocity + cross(now.spin, at - now.centre));
        spin_[i] = quadOf(now.spin);
      }
      force_[i] = torque_[i] = {};
      if (!seenVelocity_.empty()) {
        seenVelocity_[i] = velocity_[i];
        seenSpin_[i] = spin_[i];
      }
      if (i >= chosen_.size()) continue;
      const Vector moved = at - vectorOf(chosen_[i]);
      if (!(dot(moved, moved) <= allowanceSquare_[i])) outdated_ = true;
    }
  }
}

void Spheres::updateNeighbours() {
  findTravel();
  try {
    lists_.update(position_, travel_, steps_ - chosenAt_);
  } catch (const NotFinite& lost) {
    throw std::runtime_error("the position of sphere " + std::to_string(lost.disk) +
                             " is not finite at t = " + std::to_string(time()) + " s");
  }
  rememberChoice();
}

void Spheres::findTravel() {
  travel_.resize(position_.size());
  for (std::size_t i = 0; i < position_.size(); ++i)
    travel_[i] = setup_.dt * length(vectorOf(velocity_[i]));
}

void Spheres::rememberChoice() {
  chosen_ = position_;
  allowanceSquare_.resize(position_.size());
  for (std::size_t i = 0; i < position_.size(); ++i) {
    const double sure = 0.999 * lists_.allowances()[i];
    allowanceSquare_[i] = sure * sure;
  }
  chosenAt_ = steps_;
  outdated_ = sampled_ = false;
}

SpaceView Spheres::view() {
  return {position_.data(),       seenVelocities().data(), seenSpins().data(), inverseMass_.data(),
          inverseInertia_.data(), force_.data(),           torque_.data()};
}

void Spheres::addForces() {
  const double most = setup_.maxOverlap > 0.0 ? setup_.maxOverlap : 1e300;
  const auto begin = std::chrono::steady_clock::now();
  const SpaceReport report =
      kernels_.pairs(law_, setup_.conventions, view(), lists_.near(), range_, most);
  if (!std::exchange(sampled_, true))  // one step in some measures for the lists what a pair costs
    lists_.pairsTook(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  if (report.deep) reportDeep();
  evaluations_ += report.touching;
  for (PlacedPlane& plane : planes_) addPlane(plane);
}

void Spheres::addPlane(PlacedPlane& plane) {
  for (std::size_t i = 0; i < size(); ++i) {
    const Place place = placeOn(plane, i);
    const double a = position_[i].w, height = place.height;
    SpaceMemory<double>& kept = plane.kept[i];
    bool touches = a - height > 0.0;
    if (law_.cohesion == Cohesion::jkr) {
      kept.memory = isBonded(law_, a - height, a, kept.memory);
      touches = kept.memory > 0.0;
    }
    if (!touches && plane.touches[i] != 0) kept = {};
    plane.touches[i] = touches;
    if (!touches) continue;
    if (setup_.maxOverlap > 0.0 && !(a - height <= setup_.maxOverlap * a)) {
      plane.results[i].overlap = a - height;
      reportDeep();
    }
    ++evaluations_;
    const Meeting<double> meeting = meetingOn(plane, i, place);
    const MeetingForce<double> force = meetingForce(law_, setup_.conventions, meeting, kept);
    plane.results[i] = {meeting.overlap, force.normal, force.sliding, force.tangential,
                        force.rolling};
    add(force_[i], force.force, 1.0);
    if (law_.rotation) add(torque_[i], force.torqueI, 1.0);
    plane.force -= force.force;
    plane.torque -= cross(armOn(plane, i, place), force.force) + force.rolling;
  }
}

Spheres::Place Spheres::placeOn(const PlacedPlane& plane, std::size_t i) const {
  const Vector from = vectorOf(position_[i]) - plane.point;
  const double along = dot(from, plane.normal);
  if (!plane.isCylinder()) return {plane.normal, along};
  const Vector aside = from - along * plane.normal;
  const double distance = length(aside);
  // On the axis there is no normal, and contact only of a sphere as large as the cylinder.
  return {distance > 0.0 ? (-1.0 / distance) * aside : Vector{}, plane.radius - distance};
}

/// From the centre of the plane's wall to where it meets sphere i [m].
Vector Spheres::armOn(const PlacedPlane& plane, std::size_t i, const Place& place) const {
  const double away = planePoint(law_, position_[i].w, place.height);
  return vectorOf(position_[i]) - away * place.normal - plane.now.centre;
}

Meeting<double> Spheres::meetingOn(const PlacedPlane& plane, std::size_t i,
                                   const Place& place) const {
  const double a = position_[i].w, height = place.height;
  Meeting<double> meeting{};
  meeting.normal = place.normal;
  meeting.velocity = vectorOf(seenVelocities()[i]) -
                     (plane.now.velocity + cross(plane.now.spin, armOn(plane, i, place)));
  meeting.spinI = vectorOf(seenSpins()[i]);
  meeting.overlap = a - height;
  meeting.radiusI = a;
  meeting.leverI = planeArmOf(law_.lever, law_.planeLever, a, height);
  meeting.armI = planeArmOf(law_.velocityLever, law_.planeLever, a, height);
  meeting.inverseMass = meeting.inverseMassI = inverseMass_[i];
  meeting.inverseInertiaI = inverseInertia_[i];
  return meeting;
}

std::string Spheres::nameOfPlane(std::size_t p) const {
  const auto first = std::ranges::find_if(planes_, &PlacedPlane::isCylinder) - planes_.begin();
  const auto flat = static_cast<std::size_t>(first);
  return p < flat ? "plane " + std::to_string(p) : "cylinder " + std::to_string(p - flat);
}

void Spheres::reportDeep() {
  for (const SpaceContact& contact : contacts()) {
    const auto i = static_cast<std::size_t>(contact.i), j = static_cast<std::size_t>(contact.j);
    double smallest = position_[i].w;
    if (j < position_.size()) smallest = std::min(smallest, position_[j].w);
    if (contact.overlap <= setup_.maxOverlap * smallest) continue;
    const std::string partner = j < size()             ? "sphere " + std::to_string(j)
                                : j < position_.size() ? "wall sphere " + std::to_string(j - size())
                                                       : nameOfPlane(j - position_.size());
    throw std::runtime_error("sphere " + std::to_string(i) + " and " + partner + " overlap by " +
                             std::to_string(contact.overlap / smallest) +
                             " of the smaller radius at t = " + std::to_string(time()) + " s");
  }
  throw std::runtime_error("two spheres have no distance at t = " + std::to_string(time()) + " s");
}

std::vector<SpaceContact> Spheres::contacts() {
  std::vector<SpaceContact> found;
  const auto add = [&](std::int32_t i, std::size_t j, const Vector& normal,
                       const SpaceResult& result) {
    found.push_back({i, static_cast<std::int32_t>(j), normal, result.overlap, result.normal,
                     result.tangential, result.rolling, result.sliding > 0.0});
  };
  const SpacePairs pairs = lists_.near();
  for (std::size_t p = 0; p < pairs.count; ++p)
    if (pairs.touches[p] != 0)
      add(pairs.i[p], static_cast<std::size_t>(pairs.j[p]), pairs.kept[p].normal, pairs.results[p]);
  for (std::size_t p = 0; p < planes_.size(); ++p)
    for (std::size_t i = 0; i < size(); ++i)
      if (planes_[p].touches[i] != 0)
        add(static_cast<std::int32_t>(i), position_.size() + p, planes_[p].kept[i].normal,
            planes_[p].results[i]);
  std::ranges::sort(found, {}, [](const SpaceContact& c) { return std::pair(c.i, c.j); });
  return found;
}

std::pair<Vector, Vector> Spheres::wallLoad(std::size_t w) const {
  const Vector centre = wallState(w).centre;
  Vector force{}, torque{};
  for (std::size_t i = wallBegin_[w]; i < wallBegin_[w + 1]; ++i) {
    force += vectorOf(force_[i]);
    torque += cross(vectorOf(position_[i]) - centre, vectorOf(force_[i])) + vectorOf(torque_[i]);
  }
  for (const PlacedPlane& plane : planes_) {
    if (plane.wall != w) continue;
    force += plane.force;
    torque += plane.torque;
  }
  return {force, torque};
}

}  // namespace grain
