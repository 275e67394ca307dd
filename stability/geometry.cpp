#include <algorithm>
#include <cmath>

#include "adapters/sweep.hpp"
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
