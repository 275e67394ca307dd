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
  before_ = ahead_ = pose_;
}

WallPose MovingWall::poseAt(double t) const {
  const WallState at = wall_.motion(t);
  return {at, std::cos(at.angle), std::sin(at.angle),
          at.radialShift != 0.0 || at.radialVelocity != 0.0};
}

double MovingWall::moveTo(double t) {
  before_ = std::exchange(pose_, poseAt(t));
  const WallState& before = before_.now;
  const WallState& now = pose_.now;
  stoodStill_ = now == before;
  const double arm = reach_ + std::max(std::abs(before.radialShift), std::abs(now.radialShift));
  return std::hypot(now.x - before.x, now.y - before.y) + std::abs(now.angle - before.angle) * arm +
         std::abs(now.radialShift - before.radialShift);
}

Plane MovingWall::plane(std::size_t k) const {
  const Plane& at0 = wall_.planes[k];
  const WallPoint point = pose_.at({at0.x - start_.x, at0.y - start_.y, 0.0});
  return {point.x, point.y, pose_.cosine * at0.nx - pose_.sine * at0.ny,
          pose_.sine * at0.nx + pose_.cosine * at0.ny};
}

double MovingWall::speed() const {
  const WallState& now = pose_.now;
  return std::hypot(now.vx, now.vy) + std::abs(now.spin) * (reach_ + std::abs(now.radialShift)) +
         std::abs(now.radialVelocity);
}

void MovingWall::lookAhead(double t) {
  if (moves()) ahead_ = poseAt(t);
}

auto MovingWall::meanVelocities(const WallOffset& offset) const
    -> std::pair<MeanVelocity, MeanVelocity> {
  const auto mean = [&](const WallPose& from, const WallPose& to) -> MeanVelocity {
    const WallPoint a = from.at(offset), b = to.at(offset);
    return {0.5 * (a.vx + b.vx), 0.5 * (a.vy + b.vy), 0.5 * (from.now.spin + to.now.spin)};
  };
  return {mean(before_, pose_), mean(pose_, ahead_)};
}

WallOffset MovingWall::offsetOf(double x, double y) const {
  return {pose_.cosine * x + pose_.sine * y, pose_.cosine * y - pose_.sine * x, 0.0};
}

}  // namespace grain
