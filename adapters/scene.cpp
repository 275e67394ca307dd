#include "adapters/scene.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace crossgrain {

std::string toString(Precision precision) {
  return std::string(precisionNames[static_cast<std::size_t>(precision)]);
}

Plane planeAt(BodyState now, const Vec2& referenceCentre, const Plane& reference) {
  now.radialShift = 0.0;
  const double c = std::cos(now.angle), s = std::sin(now.angle);
  const Vec2& n = reference.normal;
  return {memberPosition(now, referenceCentre, reference.point),
          {c * n.x() - s * n.y(), s * n.x() + c * n.y()}};
}

template <int D>
std::size_t SceneOf<D>::wallDiskCount() const {
  std::size_t count = 0;
  for (const auto& body : bodies) count += body.diskRadius.size();
  return count;
}

template <int D>
std::size_t SceneOf<D>::planeCount() const {
  std::size_t count = 0;
  for (const auto& body : bodies) count += body.planes.size();
  return count;
}

template <int D>
std::vector<double> SceneOf<D>::radii() const {
  std::vector<double> all = disks.radius;
  for (const auto& body : bodies)
    all.insert(all.end(), body.diskRadius.begin(), body.diskRadius.end());
  return all;
}

template <int D>
const ContactLaw& SceneOf<D>::lawOf(std::size_t i, std::size_t j) const {
  if (!materials) return law;
  const auto materialOf = [&](std::size_t id) {
    if (id < disks.size()) return materials->ofDisk[id];
    std::size_t first = disks.size();  // wall disks body by body, then planes body by body
    for (const bool planes : {false, true})
      for (std::size_t b = 0; b < bodies.size(); ++b) {
        first += planes ? bodies[b].planes.size() : bodies[b].diskRadius.size();
        if (id < first) return materials->ofBody[b];
      }
    throw std::out_of_range("an id that the scene does not have");
  };
  return materials->law(materialOf(i), materialOf(j));
}

template struct SceneOf<2>;
template struct SceneOf<3>;

std::string nameOfId(const Scene& scene, std::size_t id) {
  const std::size_t disks = scene.disks.size();
  if (id < disks) return fmt::format("disk {}", id);
  const std::size_t walls = scene.wallDiskCount();
  if (id < disks + walls) return fmt::format("wall disk {}", id - disks);
  return fmt::format("plane {}", id - disks - walls);
}

}  // namespace crossgrain
