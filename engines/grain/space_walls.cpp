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
  auto plane = planes_.begin();
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
    for (; plane != cylinders && plane->wall == w; ++plane) {
      const SpaceWall::Plane& member = wall.planes[plane->member];
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

SpacePlane Spheres::viewOf(std::size_t plane, std::size_t begin, std::size_t end) {
  PlacedPlane& own = planes_[plane];
  const SpaceWall::State& now = wallNow_[own.wall];
  return {own.point,
          own.normal,
          own.radius,
          now.centre,
          now.velocity,
          now.spin,
          position_.size() + plane,
          begin,
          end,
          own.contacts.view(),
          own.touches.data()};
}

std::pair<Vector, Vector> Spheres::wallLoad(std::size_t w) const {
  const Vector centre = wallState(w).centre;
  Vector force{}, torque{};
  for (std::size_t i = wallBegin_[w]; i < wallBegin_[w + 1]; ++i) {
    force += vectorOf(force_[i]);
    torque += cross(vectorOf(position_[i]) - centre, vectorOf(force_[i])) +
              (law_.rotation ? vectorOf(torque_[i]) : Vector{});
  }
  for (std::size_t p = 0; p < planes_.size(); ++p) {
    if (planes_[p].wall != w) continue;
    const SpacePlane plane = const_cast<Spheres*>(this)->viewOf(p, 0, size());
    for (std::size_t i = 0; i < size(); ++i) {
      if (plane.touches[i] == 0) continue;
      const SpaceResult result = plane.contacts.result(i);
      const Vector push = result.normal * vectorOf(plane.contacts.touch[i]) + result.tangential;
      force -= push;
      torque -= cross(plane.armTo(law_, position_[i], plane.placeOf(position_[i])), push) +
                result.rolling;
    }
  }
  return {force, torque};
}

}  // namespace grain
