#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "engines/box2d/model.hpp"

namespace box2d_granular {

/// Everything that can touch, by id, in double precision.
struct Members {
  explicit Members(const Model& model);

  /// Puts one wall's disks and planes where its pose has them.
  void place(std::size_t wall, const Pose& pose);

  bool isPlane(std::int32_t id) const { return static_cast<std::size_t>(id) >= position.size(); }
  bool isWall(std::int32_t id) const { return static_cast<std::size_t>(id) >= disks; }
  std::size_t wallOf(std::int32_t id) const { return wall[static_cast<std::size_t>(id) - disks]; }
  const Plane& planeOf(std::int32_t id) const {
    return plane[static_cast<std::size_t>(id) - position.size()];
  }

  std::size_t disks;              ///< number of moving disks
  std::vector<Vector> position;   ///< disks, then wall disks [m]
  std::vector<Vector> velocity;   ///< likewise [m/s]
  std::vector<double> spin;       ///< likewise [rad/s]
  std::vector<double> radius;     ///< likewise [m]
  std::vector<double> turn;       ///< of moving disks; empty where all are round [rad]
  std::vector<Plane> plane;       ///< as they stand now
  std::vector<Pose> pose;         ///< of each wall
  std::vector<std::size_t> wall;  ///< of each wall disk and plane, by id − disks

 private:
  struct Reference {
    Vector centre;
    std::vector<Vector> disk;   ///< relative to the centre
    std::vector<Plane> planes;  ///< likewise
    std::size_t firstDisk, firstPlane;
  };
  std::vector<Reference> reference_;
};

/// How i and j lie: n points from j to i, δ > 0 where they overlap.
struct PairGeometry {
  Vector normal;
  double overlap;  ///< δ [m]
};

inline PairGeometry pairGeometry(const Members& members, std::int32_t i, std::int32_t j) {
  const auto a = static_cast<std::size_t>(i);
  const auto b = static_cast<std::size_t>(j);
  if (members.isPlane(j)) {
    const Plane& plane = members.planeOf(j);
    return {plane.normal, members.radius[a] - dot(members.position[a] - plane.point, plane.normal)};
  }
  const Vector branch = members.position[a] - members.position[b];
  const double distance = std::sqrt(dot(branch, branch));
  return {{branch.x / distance, branch.y / distance},
          members.radius[a] + members.radius[b] - distance};
}

}  // namespace box2d_granular
