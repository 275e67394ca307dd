#include "cases/collision_scene.hpp"

#include <algorithm>
#include <cmath>

namespace crossgrain {

Scene collisionScene(const Case& setup, const std::vector<CollisionStart>& starts, double dt) {
  const Collision& pair = setup.collision;
  const double reach = pair.radius[0] + pair.radius[1];
  const double spacing = 3.0 * std::max(2.0 * std::max(pair.radius[0], pair.radius[1]), reach);
  const auto columns =
      static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(starts.size()))));

  Scene scene;
  scene.name = setup.name;
  scene.law = setup.law;
  scene.bottom = setup.bottom;
  scene.precision = setup.run.precision;
  scene.dt = dt;
  const double massSum = pair.mass[0] + pair.mass[1];
  for (std::size_t k = 0; k < starts.size(); ++k) {
    const double middle = 0.5 * static_cast<double>(columns - 1);
    const Vec2 centre((static_cast<double>(k % columns) - middle) * spacing,
                      (static_cast<double>(k / columns) - middle) * spacing);
    const auto [psi, vn] = starts[k];
    const double distance = reach + pair.startPhase * dt * vn;
    const double spin = -psi * vn / reach;  // v_t = −(a_i + a_j) ω
    for (const int side : {0, 1}) {
      const double sign = side == 0 ? 1.0 : -1.0;
      const double share = pair.mass[1 - side] / massSum;
      scene.disks.radius.push_back(pair.radius[side]);
      scene.disks.mass.push_back(pair.mass[side]);
      scene.disks.inertia.push_back(pair.inertiaFactor * pair.mass[side] * pair.radius[side] *
                                    pair.radius[side]);
      scene.disks.position.push_back(centre + Vec2(sign * share * distance, 0.0));
      scene.disks.velocity.emplace_back(-sign * share * vn, 0.0);
      scene.disks.spin.push_back(spin);
    }
  }
  return scene;
}

std::optional<CollisionEnd> collisionEnd(const Scene& scene, const Snapshot& after,
                                         std::size_t pair, const CollisionStart& start) {
  const std::size_t i = 2 * pair;
  const std::size_t j = i + 1;
  const double reach = scene.disks.radius[i] + scene.disks.radius[j];
  const Vec2 apart = after.position[i] - after.position[j];
  const Vec2 velocity = after.velocity[i] - after.velocity[j];
  // |apart + velocity τ| = reach, the later root τ ≤ 0 being the moment of separation.
  const double a = velocity.squaredNorm();
  const double b = apart.dot(velocity);
  const double c = apart.squaredNorm() - reach * reach;
  if (b <= 0.0 || c < 0.0) return std::nullopt;
  // An engine that lets disks part a hair outside contact never had them at `reach`: then the
  // closest approach of the flight line is the best instant there is.
  const double root = std::sqrt(std::max(b * b - a * c, 0.0));
  const double tau = (root - b) / a;
  const Vec2 normal = (apart + tau * velocity).normalized();
  const double spins = after.spin ? scene.disks.radius[i] * (*after.spin)[i] +
                                        scene.disks.radius[j] * (*after.spin)[j]
                                  : scene.disks.radius[i] * scene.disks.spin[i] +
                                        scene.disks.radius[j] * scene.disks.spin[j];
  return CollisionEnd{velocity.dot(normal) / start.vn,
                      (velocity.dot(perpendicular(normal)) - spins) / start.vn};
}

}  // namespace crossgrain
