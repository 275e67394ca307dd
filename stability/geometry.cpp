#include <algorithm>
#include <cmath>
#include <numeric>

#include "stability/recording.hpp"

namespace crossgrain::inline stability {

double smallestDiameter(const Scene& scene) {
  return 2.0 * std::ranges::min(scene.disks.radius);
}

std::vector<Plane> planesAt(const Scene& scene, double t) {
  std::vector<Plane> planes;
  for (const WallBody& body : scene.bodies) {
    const BodyState now = stateAt(body.motion, body.centre, t);
    for (const Plane& plane : body.planes) planes.push_back(planeAt(now, body.centre, plane));
  }
  return planes;
}

std::vector<Vec2> wallDisksAt(const Scene& scene, double t) {
  std::vector<Vec2> positions;
  for (const WallBody& body : scene.bodies) {
    const BodyState now = stateAt(body.motion, body.centre, t);
    for (const Vec2& reference : body.diskPosition)
      positions.push_back(memberPosition(now, body.centre, reference));
  }
  return positions;
}

namespace {

/// Calls visit(i, j), i < j, for every two discs whose extents in x overlap, at least one of them
/// among the first `moving`: those of walls may overlap each other.
template <class Visit>
void sweepPairs(const std::vector<Vec2>& position, const std::vector<double>& radius,
                std::size_t moving, Visit&& visit) {
  const auto left = [&](std::size_t i) { return position[i].x() - radius[i]; };
  std::vector<std::size_t> order(position.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, left);
  for (std::size_t a = 0; a < order.size(); ++a) {
    const double right = position[order[a]].x() + radius[order[a]];
    for (std::size_t b = a + 1; b < order.size() && left(order[b]) <= right; ++b)
      if (const auto [i, j] = std::minmax(order[a], order[b]); i < moving) visit(i, j);
  }
}

void addPlaneOverlaps(const Scene& scene, const std::vector<Vec2>& position, double t,
                      std::vector<Overlap>& found) {
  const std::vector<Plane> planes = planesAt(scene, t);
  const std::size_t firstPlane = scene.disks.size() + scene.wallDiskCount();
  for (std::size_t i = 0; i < scene.disks.size(); ++i)
    for (std::size_t p = 0; p < planes.size(); ++p) {
      const double radius = scene.disks.radius[i];
      const double depth = radius - (position[i] - planes[p].point).dot(planes[p].normal);
      if (depth > 0.0)
        found.push_back({i, firstPlane + p, depth, radius, radius, planes[p].normal});
    }
}

}  // namespace

std::vector<Overlap> overlapsOf(const Scene& scene, const std::vector<Vec2>& position, double t) {
  std::vector<Vec2> place = position;
  std::vector<double> radius = scene.disks.radius;
  const std::vector<Vec2> walls = wallDisksAt(scene, t);
  place.insert(place.end(), walls.begin(), walls.end());
  for (const WallBody& body : scene.bodies)
    radius.insert(radius.end(), body.diskRadius.begin(), body.diskRadius.end());

  std::vector<Overlap> found;
  sweepPairs(place, radius, scene.disks.size(), [&](std::size_t i, std::size_t j) {
    const Vec2 apart = place[i] - place[j];
    const double depth = radius[i] + radius[j] - apart.norm();
    if (depth > 0.0)
      found.push_back({i, j, depth, std::min(radius[i], radius[j]),
                       radius[i] * radius[j] / (radius[i] + radius[j]), apart.normalized()});
  });
  addPlaneOverlaps(scene, position, t, found);
  return found;
}

}  // namespace crossgrain::inline stability
