#include <algorithm>

#include "adapters/near_pairs.hpp"
#include "stability/recording.hpp"

namespace crossgrain::inline stability {

template <int D>
std::vector<PlaneOf<D>> planesAt(const SceneOf<D>& scene, double t) {
  std::vector<PlaneOf<D>> planes;
  for (const WallBodyOf<D>& body : scene.bodies) {
    const BodyStateOf<D> now = stateAt(body.motion, body.centre, t);
    for (const PlaneOf<D>& plane : body.planes)
      planes.push_back(planeAt<D>(now, body.centre, plane));
  }
  return planes;
}
template std::vector<Plane> planesAt<2>(const Scene&, double);
template std::vector<PlaneOf<3>> planesAt<3>(const SpaceScene&, double);

template <int D>
std::vector<VecOf<D>> wallDisksAt(const SceneOf<D>& scene, double t) {
  std::vector<VecOf<D>> positions;
  for (const WallBodyOf<D>& body : scene.bodies) {
    const BodyStateOf<D> now = stateAt(body.motion, body.centre, t);
    for (const VecOf<D>& reference : body.diskPosition)
      positions.push_back(memberPosition<D>(now, body.centre, reference));
  }
  return positions;
}
template std::vector<Vec2> wallDisksAt<2>(const Scene&, double);
template std::vector<Vec3> wallDisksAt<3>(const SpaceScene&, double);

template <int D>
std::vector<OverlapOf<D>> overlapsOf(const SceneOf<D>& scene, const std::vector<VecOf<D>>& position,
                                     double t, const std::vector<TurnOf<D>>* turn) {
  std::vector<VecOf<D>> place = position;
  const std::vector<double> radius = scene.radii();
  const std::vector<VecOf<D>> walls = wallDisksAt(scene, t);
  place.insert(place.end(), walls.begin(), walls.end());

  std::vector<OverlapOf<D>> found;
  const auto finite = [](const VecOf<D>& x) { return x.allFinite(); };
  if (std::ranges::all_of(place, finite))
    nearPairs<D>(place, radius, scene.disks.size(), scene.box, [&](std::size_t i, std::size_t j) {
      const VecOf<D> apart = apartIn<D>(scene, place[i] - place[j]);
      const double depth = scene.shapes.empty() ? radius[i] + radius[j] - apart.norm()
                                                : overlapOfPair(scene, i, j, apart, turn);
      if (depth > 0.0)
        found.push_back({i, j, depth, std::min(radius[i], radius[j]),
                         radius[i] * radius[j] / (radius[i] + radius[j]), apart.normalized()});
    });
  const auto addPlane = [&](std::size_t i, std::size_t id, const PlaneOf<D>& plane) {
    const double depth = overlapWithPlane(scene, i, position[i], plane, turn);
    if (depth > 0.0) found.push_back({i, id, depth, radius[i], radius[i], plane.normal});
  };
  const std::vector<PlaneOf<D>> planes = planesAt(scene, t);
  for (std::size_t i = 0; i < scene.disks.size(); ++i) {
    std::size_t id = radius.size();
    for (const PlaneOf<D>& plane : planes) addPlane(i, id++, plane);
    if constexpr (D == 3)
      for (const WallBodyOf<D>& body : scene.bodies)
        for (const Cylinder& cylinder : body.cylinders)
          addPlane(i, id++, tangentPlane(cylinder, position[i]));
  }
  return found;
}
template std::vector<OverlapOf<2>> overlapsOf<2>(const Scene&, const std::vector<Vec2>&, double,
                                                 const std::vector<double>*);
template std::vector<OverlapOf<3>> overlapsOf<3>(const SpaceScene&, const std::vector<Vec3>&,
                                                 double, const std::vector<Eigen::Vector4d>*);

}  // namespace crossgrain::inline stability
