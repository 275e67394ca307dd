#include "adapters/start_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace crossgrain {
namespace {

/// Disks, then wall disks.
struct AllDisks {
  std::vector<Vec2> position;
  std::vector<double> radius;

  explicit AllDisks(const Scene& scene)
      : position(scene.disks.position), radius(scene.disks.radius) {
    for (const WallBody& body : scene.bodies) {
      position.insert(position.end(), body.diskPosition.begin(), body.diskPosition.end());
      radius.insert(radius.end(), body.diskRadius.begin(), body.diskRadius.end());
    }
  }
};

/// "disk 3", "wall disk 12": as the user knows it.
std::string nameOf(std::size_t id, std::size_t disks) {
  return id < disks ? fmt::format("disk {}", id) : fmt::format("wall disk {}", id - disks);
}

std::optional<DeepStart> deepInPlane(const Scene& scene,
                                     const std::function<double(double, double)>& limit) {
  std::size_t number = 0;
  for (const WallBody& body : scene.bodies)
    for (const Plane& plane : body.planes) {
      for (std::size_t i = 0; i < scene.disks.size(); ++i) {
        const double radius = scene.disks.radius[i];
        const double overlap =
            radius - (scene.disks.position[i] - plane.point).dot(plane.normal.normalized());
        if (overlap > limit(radius, radius))
          return DeepStart{nameOf(i, scene.disks.size()), fmt::format("plane {}", number),
                           scene.disks.position[i], overlap, false};
      }
      ++number;
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
  const auto left = [&](std::size_t i) { return all.position[i].x() - all.radius[i]; };
  // Sweep over x: only disks whose extents in x overlap are held against each other.
  std::vector<std::size_t> order(all.position.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, left);
  const std::size_t disks = scene.disks.size();
  for (std::size_t a = 0; a < order.size(); ++a) {
    const double right = all.position[order[a]].x() + all.radius[order[a]];
    for (std::size_t b = a + 1; b < order.size() && left(order[b]) <= right; ++b) {
      const auto [i, j] = std::minmax(order[a], order[b]);
      if (i >= disks) continue;  // disks of a wall may overlap each other
      const double distance = (all.position[i] - all.position[j]).norm();
      const double overlap = all.radius[i] + all.radius[j] - distance;
      if (distance == 0.0 || overlap > limit(all.radius[i], all.radius[j]))
        return DeepStart{nameOf(i, disks), nameOf(j, disks), all.position[i], overlap,
                         distance == 0.0};
    }
  }
  return deepInPlane(scene, limit);
}

std::string whyNoStart(const Scene& scene) {
  if (const auto lost = firstNotFinite(scene))
    return fmt::format("the position of {} is not finite", nameOf(*lost, scene.disks.size()));
  const auto deep = deepStart(scene, [](double a, double b) { return std::min(a, b); });
  if (!deep) return {};
  const std::string who = fmt::format("{} and {}", deep->first, deep->second);
  const std::string where = fmt::format("({:g}, {:g}) m", deep->place.x(), deep->place.y());
  if (deep->sameCentre) return fmt::format("{} have the same centre, {}", who, where);
  return fmt::format(
      "{} overlap by {:.3g} m at the start, near {}: more than the smaller radius, so that a "
      "centre lies inside",
      who, deep->overlap, where);
}

}  // namespace crossgrain
