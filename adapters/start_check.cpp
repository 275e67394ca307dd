#include "adapters/start_check.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "adapters/sweep.hpp"

namespace crossgrain {
namespace {

/// Disks, then wall disks.
struct AllDisks {
  std::vector<Vec2> position;
  std::vector<double> radius;

  explicit AllDisks(const Scene& scene) : position(scene.disks.position), radius(scene.radii()) {
    for (const WallBody& body : scene.bodies)
      position.insert(position.end(), body.diskPosition.begin(), body.diskPosition.end());
  }
};

std::optional<DeepStart> deepInPlane(const Scene& scene,
                                     const std::function<double(double, double)>& limit) {
  std::size_t id = scene.disks.size() + scene.wallDiskCount();
  for (const WallBody& body : scene.bodies)
    for (const Plane& plane : body.planes) {
      for (std::size_t i = 0; i < scene.disks.size(); ++i) {
        const double radius = scene.disks.radius[i];
        const double overlap =
            radius - (scene.disks.position[i] - plane.point).dot(plane.normal.normalized());
        if (overlap > limit(radius, radius))
          return DeepStart{i, id, scene.disks.position[i], overlap, false};
      }
      ++id;
    }
  return std::nullopt;
}

}  // namespace

std::optional<std::size_t> firstNotFinite(const Scene& scene) {
  const AllDisks all(scene);
  const auto lost =
      std::ranges::find_if(all.position, [](const Vec2& p) { return !p.allFinite(); });
  if (lost == all.position.end()) return std::nullopt;
  return static_cast<std::size_t>(lost - all.position.begin());
}

std::optional<DeepStart> deepStart(const Scene& scene,
                                   const std::function<double(double, double)>& limit) {
  const AllDisks all(scene);
  const std::size_t disks = scene.disks.size();
  std::optional<DeepStart> first;
  sweepPairs(all.position, all.radius, disks, [&](std::size_t i, std::size_t j) {
    if (first) return;
    const double distance = (all.position[i] - all.position[j]).norm();
    const double overlap = all.radius[i] + all.radius[j] - distance;
    if (distance == 0.0 || overlap > limit(all.radius[i], all.radius[j]))
      first = {i, j, all.position[i], overlap, distance == 0.0};
  });
  if (first) return first;
  return deepInPlane(scene, limit);
}

std::string startFault(const Scene& scene) {
  if (const auto lost = firstNotFinite(scene))
    return fmt::format("the position of {} is not finite", nameOfId(scene, *lost));
  const auto deep = deepStart(scene, [](double a, double b) { return std::min(a, b); });
  if (!deep) return {};
  const std::string who =
      fmt::format("{} and {}", nameOfId(scene, deep->i), nameOfId(scene, deep->j));
  const std::string where = fmt::format("({:g}, {:g}) m", deep->place.x(), deep->place.y());
  if (deep->sameCentre) return fmt::format("{} have the same centre, {}", who, where);
  return fmt::format(
      "{} overlap by {:.3g} m at the start, near {}: more than the smaller radius, so that a "
      "centre lies inside",
      who, deep->overlap, where);
}

}  // namespace crossgrain
