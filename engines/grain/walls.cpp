#include "engines/grain/walls.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace grain {

MovingWall::MovingWall(Wall wall) : wall_(std::move(wall)), start_(wall_.motion(0.0)) {
  for (std::size_t k = 0; k < diskCount(); ++k)
    reach_ = std::max(reach_, std::hypot(wall_.diskX[k] - start_.x, wall_.diskY[k] - start_.y));
  moveTo(0.0);
}

double MovingWall::moveTo(double t) {
  const WallState before = std::exchange(now_, wall_.motion(t));
  cos_ = std::cos(now_.angle);
  sin_ = std::sin(now_.angle);
  const double arm = reach_ + std::max(std::abs(before.radialShift), std::abs(now_.radialShift));
  return std::hypot(now_.x - before.x, now_.y - before.y) +
         std::abs(now_.angle - before.angle) * arm +
         std::abs(now_.radialShift - before.radialShift);
}

WallPoint MovingWall::disk(std::size_t k) const {
  const double dx = wall_.diskX[k] - start_.x;
  const double dy = wall_.diskY[k] - start_.y;
  const double distance =
      now_.radialShift == 0.0 && now_.radialVelocity == 0.0 ? 0.0 : std::sqrt(dx * dx + dy * dy);
  const double scale = distance > 0.0 ? 1.0 + now_.radialShift / distance : 1.0;
  const double rx = scale * (cos_ * dx - sin_ * dy);
  const double ry = scale * (sin_ * dx + cos_ * dy);
  const double radial = distance > 0.0 ? now_.radialVelocity / (distance * scale) : 0.0;
  return {now_.x + rx, now_.y + ry, now_.vx - now_.spin * ry + radial * rx,
          now_.vy + now_.spin * rx + radial * ry};
}

Plane MovingWall::plane(std::size_t k) const {
  const Plane& at0 = wall_.planes[k];
  const double dx = at0.x - start_.x;
  const double dy = at0.y - start_.y;
  return {now_.x + cos_ * dx - sin_ * dy, now_.y + sin_ * dx + cos_ * dy,
          cos_ * at0.nx - sin_ * at0.ny, sin_ * at0.nx + cos_ * at0.ny};
}

double MovingWall::speed() const {
  return std::hypot(now_.vx, now_.vy) +
         std::abs(now_.spin) * (reach_ + std::abs(now_.radialShift)) +
         std::abs(now_.radialVelocity);
}

}  // namespace grain
