#include <algorithm>
#include <cmath>

#include "engines/grain/spheres.hpp"

/// Walls in space: where they and their spheres are, and what happens at planes and cylinders.
namespace grain {
namespace {

using Vector = Vec3<double>;

/// v turned by an angle about its axis (Rodrigues' formula).
Vector turnedBy(const Vector& angle, const Vector& v) {
  const double size = length(angle);
  if (size == 0.0) return v;
  const Vector axis = (1.0 / size) * angle;
  const double c = std::cos(size), s = std::sin(size);
  return c * v + s * cross(axis, v) + ((1.0 - c) * dot(axis, v)) * axis;
}

}  // namespace

void Spheres::moveWalls() {
  const auto cylinders = std::ranges::find_if(planes_, &PlacedPlane::isCylinder);
  auto plane = planes_.begin(), cylinder = cylinders;
  for (std::size_t w = 0; w < setup_.walls.size(); ++w) {
    const SpaceWall& wall = setup_.walls[w];
    const SpaceWall::State now = wall.motion(time());
    wallPath_[w] += length(now.centre - wallNow_[w].centre) +
                    wallReach_[w] * length(now.angle - wallNow_[w].angle);
    wallSteady_[w] =
        isZero(now.spin) && isZero(wallNow_[w].spin) && now.velocity == wallNow_[w].velocity;
    wallNow_[w] = now;
    if (wallBegin_[w] < std::min(wallBegin_[w + 1], allowance_.size()) &&
        !(wallPath_[w] <= allowance_[wallBegin_[w]]))
      outdated_ = true;
    for (; cylinder != planes_.end() && cylinder->wall == w; ++cylinder) cylinder->now = now;
    for (; plane != cylinders && plane->wall == w; ++plane) {
      const SpaceWall::Plane& member = wall.planes[plane->member];
      plane->now = now;
      plane->point = wallPlace(w, member.point);
      plane->normal = turnedBy(now.angle, member.normal);
    }
  }
  auto index = reached_.begin();
  for (std::size_t w = 0; w < setup_.walls.size(); ++w) {
    const auto end =
        std::lower_bound(index, reached_.end(), static_cast<std::int32_t>(wallBegin_[w + 1]));
    const bool slides = wallSteady_[w] && isZero(wallNow_[w].angle);
    const Lanes centre(wallNow_[w].centre);
    for (; index != end; ++index) {
      const auto i = static_cast<std::size_t>(*index);
      if (slides) {
        Lanes at(wallArms_[i - size()]);
        at += centre;
        at.store(position_[i]);
      } else {
        placeWallSphere(w, i, wallSteady_[w]);
      }
      force_[i] = {};
      if (law_.rotation) torque_[i] = {};
    }
  }
}

/// Where a point of a wall at t = 0 is by now.
Vector Spheres::wallPlace(std::size_t w, const Vector& point) const {
  const SpaceWall::State& now = wallNow_[w];
  const Vector arm = point - wallCentre_[w];
  return now.centre + (isZero(now.angle) ? arm : turnedBy(now.angle, arm));
}

/// @param steady  its velocities are as they were
void Spheres::placeWallSphere(std::size_t w, std::size_t i, bool steady) {
  const SpaceWall::State& now = wallNow_[w];
  const Quad& arm = wallArms_[i - size()];
  if (isZero(now.angle)) {
    Lanes at(arm);
    at += Lanes(now.centre);
    at.store(position_[i]);
  } else {
    position_[i] = quadOf(now.centre + turnedBy(now.angle, vectorOf(arm)), arm.w);
  }
  if (steady) return;
  velocity_[i] = quadOf(now.velocity + cross(now.spin, vectorOf(position_[i]) - now.centre));
  if (law_.rotation) spin_[i] = quadOf(now.spin);
  if (seenVelocity_.empty()) return;
  seenVelocity_[i] = velocity_[i];
  if (law_.rotation) seenSpin_[i] = spin_[i];
}

Vector Spheres::wallPosition(std::size_t k) const {
  const std::size_t i = size() + k;
  const auto w =
      static_cast<std::size_t>(std::ranges::upper_bound(wallBegin_, i) - wallBegin_.begin() - 1);
  return wallPlace(w, setup_.walls[w].position[i - wallBegin_[w]]);
}

/// Contacts of spheres begin … end−1.
void Spheres::addPlane(PlacedPlane& plane, Share& share, std::size_t begin, std::size_t end) {
  const SpaceContactView contacts = plane.contacts.view();
  const SpaceConventions conventions = spaceConventions(setup_.law);
  for (std::size_t i = begin; i < end; ++i) {
    const Place place = placeOn(plane, i);
    const double a = position_[i].w, height = place.height;
    const GeneralLaw<double>& law = lawOf(plane, i);
    SpaceMemory<double> kept{};
    if (plane.touches[i] != 0) kept = contacts.memory(i);
    bool touches = a - height > 0.0;
    if (law.cohesion == CohesionLaw::jkr) {
      kept.memory = isBonded(law, a - height, a, kept.memory);
      touches = kept.memory > 0.0;
    }
    plane.touches[i] = touches;
    if (!touches) continue;
    if (setup_.maxOverlap > 0.0 && !(a - height <= setup_.maxOverlap * a)) share.deep = true;
    ++share.touching;
    const Meeting<double> meeting = meetingOn(plane, i, place);
    const MeetingForce<double> force = meetingForce(law, conventions, meeting, kept);
    contacts.set(i, kept,
                 {meeting.overlap, force.normal, force.sliding, force.tangential, force.rolling});
    add(force_[i], force.force, 1.0);
    if (law_.rotation) add(torque_[i], force.torqueI, 1.0);
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
  meeting.overlap = a - height;
  meeting.radiusI = a;
  meeting.inverseMass = meeting.inverseMassI = inverseMass_[i];
  if (!law_.rotation) return meeting;
  meeting.spinI = vectorOf(seenSpins()[i]);
  meeting.leverI = planeArmOf(law_.lever, law_.planeLever, a, height);
  meeting.armI = planeArmOf(law_.velocityLever, law_.planeLever, a, height);
  meeting.inverseInertiaI = inverseInertia_[i];
  return meeting;
}

std::pair<Vector, Vector> Spheres::wallLoad(std::size_t w) const {
  const Vector centre = wallState(w).centre;
  Vector force{}, torque{};
  for (std::size_t i = wallBegin_[w]; i < wallBegin_[w + 1]; ++i) {
    force += vectorOf(force_[i]);
    torque += cross(vectorOf(position_[i]) - centre, vectorOf(force_[i])) +
              (law_.rotation ? vectorOf(torque_[i]) : Vector{});
  }
  for (const PlacedPlane& plane : planes_) {
    if (plane.wall != w) continue;
    const SpaceContactView contacts = const_cast<PlacedPlane&>(plane).contacts.view();
    for (std::size_t i = 0; i < size(); ++i) {
      if (plane.touches[i] == 0) continue;
      const SpaceResult result = contacts.result(i);
      const Vector push = result.normal * contacts.touch[i].normal + result.tangential;
      force -= push;
      torque -= cross(armOn(plane, i, placeOn(plane, i)), push) + result.rolling;
    }
  }
  return {force, torque};
}

}  // namespace grain
