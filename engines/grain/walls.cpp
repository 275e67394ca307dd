#include "engines/grain/walls.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace grain {

MovingWall::MovingWall(Wall wall) : wall_(std::move(wall)), start_(wall_.motion(0.0)) {
  for (std::size_t k = 0; k < diskCount(); ++k) {
    const double dx = wall_.diskX[k] - start_.x;
    const double dy = wall_.diskY[k] - start_.y;
    offsets_.push_back({dx, dy, std::sqrt(dx * dx + dy * dy)});
    reach_ = std::max(reach_, std::hypot(dx, dy));
  }
  moveTo(0.0);
}

double MovingWall::moveTo(double t) {
  const WallState before = std::exchange(now_, wall_.motion(t));
  radial_ = now_.radialShift != 0.0 || now_.radialVelocity != 0.0;
  cos_ = std::cos(now_.angle);
  sin_ = std::sin(now_.angle);
  const double arm = reach_ + std::max(std::abs(before.radialShift), std::abs(now_.radialShift));
  return std::hypot(now_.x - before.x, now_.y - before.y) +
         std::abs(now_.angle - before.angle) * arm +
         std::abs(now_.radialShift - before.radialShift);
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
