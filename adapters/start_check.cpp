#include "adapters/start_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "adapters/near_pairs.hpp"

namespace crossgrain {
namespace {

/// Disks, then wall disks.
template <int D>
struct AllDisks {
  std::vector<VecOf<D>> position;
  std::vector<double> radius;

  explicit AllDisks(const SceneOf<D>& scene)
      : position(scene.disks.position), radius(scene.radii()) {
    for (const auto& body : scene.bodies)
      position.insert(position.end(), body.diskPosition.begin(), body.diskPosition.end());
  }
};

/// The shortest way from the centre of a body out of it: the radius of one that is round [m].
template <int D>
double thinnest(const SceneOf<D>& scene, const std::vector<double>& radius, std::size_t i) {
  if (i >= scene.disks.size() || !scene.isConvex(i)) return radius[i];
  const ShapeOf<D> centre = roundShape<D>(0.0);
  return overlapOf<D>({&scene.shapeOf(i)}, {&centre});
}

template <int D>
std::optional<DeepStartOf<D>> deepInWall(const SceneOf<D>& scene,
                                         const std::function<double(double, double)>& limit) {
  std::size_t id = scene.disks.size() + scene.wallDiskCount();
  std::optional<DeepStartOf<D>> found;
  /// @param planeFor  what a disk at a place meets
  const auto check = [&](auto&& planeFor) {
    for (std::size_t i = 0; i < scene.disks.size() && !found; ++i) {
      const PlaneOf<D> plane = planeFor(scene.disks.position[i]);
      const double overlap = overlapWithPlane<D>(scene, i, scene.disks.position[i],
                                                 {plane.point, plane.normal.normalized()});
      if (overlap <= 0.0) continue;
      const double radius = thinnest(scene, scene.disks.radius, i), allowed = limit(radius, radius);
      if (overlap > allowed) found = {i, id, scene.disks.position[i], overlap, allowed, false};
    }
    ++id;
  };
  for (const auto& body : scene.bodies)
    for (const PlaneOf<D>& plane : body.planes) check([&](const auto&) { return plane; });
  if constexpr (D == 3)
    for (const auto& body : scene.bodies)
      for (const Cylinder& cylinder : body.cylinders)
        check([&](const Vec3& place) { return tangentPlane(cylinder, place); });
  return found;
}

}  // namespace

template <int D>
std::optional<std::size_t> firstNotFinite(const SceneOf<D>& scene) {
  const AllDisks<D> all(scene);
  const auto lost =
      std::ranges::find_if(all.position, [](const VecOf<D>& p) { return !p.allFinite(); });
  if (lost == all.position.end()) return std::nullopt;
  return static_cast<std::size_t>(lost - all.position.begin());
}
template std::optional<std::size_t> firstNotFinite<2>(const Scene&);
template std::optional<std::size_t> firstNotFinite<3>(const SpaceScene&);

template <int D>
std::optional<DeepStartOf<D>> deepStart(const SceneOf<D>& scene,
                                        const std::function<double(double, double)>& limit) {
  const AllDisks<D> all(scene);
  const std::vector<VecOf<D>>& position = all.position;
  const std::vector<double>& radius = all.radius;
  std::optional<DeepStartOf<D>> first;
  nearPairs<D>(position, radius, scene.disks.size(), scene.box, [&](std::size_t i, std::size_t j) {
    if (first) return;
    VecOf<D> apart = position[i] - position[j];
    if (scene.box) apart = scene.box->nearest(apart);
    const double distance = apart.norm();
    const double overlap = overlapOfPair(scene, i, j, apart);
    if (distance > 0.0 && overlap <= 0.0) return;
    const double allowed = limit(thinnest(scene, radius, i), thinnest(scene, radius, j));
    if (distance == 0.0 || overlap > allowed)
      first = {i, j, position[i], overlap, allowed, distance == 0.0};
  });
  if (first) return first;
  return deepInWall(scene, limit);
}
template std::optional<DeepStart> deepStart<2>(const Scene&,
                                               const std::function<double(double, double)>&);
template std::optional<DeepStartOf<3>> deepStart<3>(const SpaceScene&,
                                                    const std::function<double(double, double)>&);

template <int D>
std::string startFault(const SceneOf<D>& scene) {
  if (const auto lost = firstNotFinite(scene))
    return fmt::format("the position of {} is not finite", nameOfId(scene, *lost));
  const auto deep = deepStart<D>(scene, [](double a, double b) { return std::min(a, b); });
  if (!deep) return {};
  const std::string who =
      fmt::format("{} and {}", nameOfId(scene, deep->i), nameOfId(scene, deep->j));
  const std::string where = fmt::format("({:g}) m", fmt::join(deep->place, ", "));
  if (deep->sameCentre) return fmt::format("{} have the same centre, {}", who, where);
  return fmt::format(
      "{} overlap by {:.3g} m at the start, near {}: more than the smaller radius, so that a "
      "centre lies inside",
      who, deep->overlap, where);
}
template std::string startFault<2>(const Scene&);
template std::string startFault<3>(const SpaceScene&);

}  // namespace crossgrain
