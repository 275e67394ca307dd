#pragma once

// Disks or spheres, walls and contacts as the protocol has them, for engines in C++17.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "crossgrain_walls.hpp"
#include "crossgrain_worker.hpp"

namespace crossgrain_worker {

/// A convex body in its own frame, whose origin is its centre of mass and whose axes are principal:
/// all within `rounding` of the hull of `vertices` (adapters/shape.hpp).
template <int D>
struct ShapeOf {
  std::string kind;
  std::vector<VectorOf<D>> vertices;  ///< in the plane counter-clockwise [m]
  double rounding;                    ///< [m]

  /// In the plane a rectangle with sharp corners.
  bool isBox() const {
    if constexpr (D == 3) return kind == "box";
    const VectorOf<D> half = halfSides();
    return rounding == 0.0 && vertices.size() == 4 &&
           std::all_of(vertices.begin(), vertices.end(), [&](VectorOf<D> vertex) {
             return norm(absolute(vertex) - half) <= 1e-12 * norm(half);
           });
  }
  VectorOf<D> halfSides() const { return absolute(vertices.front()); }
  /// Half the distance between the two vertices of a capsule or cylinder [m].
  double halfLength() const { return norm(vertices.front()); }
  /// Corners in space, of a polygon those of a prism that reaches `half` to both sides of its
  /// plane.
  std::vector<Vector3> corners(double half) const {
    if constexpr (D == 3) {
      return vertices;
    } else {
      std::vector<Vector3> prism;
      for (const double z : {-half, half})
        for (const Vector& vertex : vertices) prism.push_back({vertex.x, vertex.y, z});
      return prism;
    }
  }
};

template <int D>
struct DiskOf {
  double radius, mass, inertia;    ///< [m], [kg], [kg m²]; inertia INFINITY: its spin stays
  VectorOf<D> position, velocity;  ///< [m], [m/s]
  SpinOf<D> spin;                  ///< [rad/s]
  // Of a convex body, whose radius is that of the circle or sphere around it:
  std::shared_ptr<const ShapeOf<D>> shape = {};
  OrientationOf<D> turn = noTurn<D>();
  Vector3 moments = {};  ///< of inertia about its axes, in the plane about z [kg m²]
};
using Disk = DiskOf<2>;

template <int D = 2>
std::vector<DiskOf<D>> disksOf(const Arrays& arrays) {
  const auto position = vectorsOf<D>(arrays.at("disks.position")),
             velocity = vectorsOf<D>(arrays.at("disks.velocity"));
  std::vector<SpinOf<D>> spin;
  if constexpr (D == 2)
    spin = arrays.at("disks.spin");
  else
    spin = vectorsOf<D>(arrays.at("disks.spin"));
  std::vector<DiskOf<D>> disks;
  for (std::size_t i = 0; i < position.size(); ++i)
    disks.push_back({arrays.at("disks.radius")[i], arrays.at("disks.mass")[i],
                     arrays.at("disks.inertia")[i], position[i], velocity[i], spin[i]});
  return disks;
}

/// Gives disks the shapes that a scene has.
template <int D>
void addShapes(std::vector<DiskOf<D>>& disks, const Json& scene, const Arrays& arrays) {
  if (!scene.contains("shapes")) return;
  std::vector<std::shared_ptr<const ShapeOf<D>>> shapes;
  for (const Json& shape : scene.at("shapes"))
    shapes.push_back(std::make_shared<const ShapeOf<D>>(
        ShapeOf<D>{shape.at("kind"), shape.at("vertices").get<std::vector<VectorOf<D>>>(),
                   shape.at("rounding")}));
  const std::vector<double>& turn = arrays.at("disks.turn");
  std::vector<Vector3> moments;
  if constexpr (D == 3) moments = vectorsOf<3>(arrays.at("disks.moments"));
  for (std::size_t i = 0; i < disks.size(); ++i) {
    DiskOf<D>& disk = disks[i];
    if (const double shape = arrays.at("disks.shape")[i]; shape >= 0.0)
      disk.shape = shapes.at(static_cast<std::size_t>(shape));
    if constexpr (D == 2) {
      disk.turn = turn[i];
      disk.moments.z = disk.inertia;
    } else {
      std::copy_n(&turn[4 * i], 4, disk.turn.begin());
      disk.moments = moments[i];
    }
  }
}

template <int D = 2>
std::vector<BodyOf<D>> bodiesOf(const Json& scene, const Arrays& arrays) {
  std::vector<BodyOf<D>> bodies;
  for (const Json& body : scene.at("bodies")) {
    const std::string name = "bodies." + std::to_string(bodies.size()) + ".disk_";
    bodies.emplace_back(body, arrays.at(name + "position"), arrays.at(name + "radius"));
  }
  return bodies;
}

/// The scene's box: which directions are periodic, and how long it is along these.
template <int D>
class BoxOf {
 public:
  BoxOf() = default;
  explicit BoxOf(const Json& scene) {
    if (!scene.contains("box")) return;
    const Json& box = scene.at("box");
    for (std::size_t k = 0; k < D; ++k)
      if (box.at("periodic").at(k))
        length_[k] = box.at("high").at(k).get<double>() - box.at("low").at(k).get<double>();
  }

  /// Of the images of the difference of two places the shortest.
  VectorOf<D> nearest(VectorOf<D> difference) const {
    shorten(difference.x, 0);
    shorten(difference.y, 1);
    if constexpr (D == 3) shorten(difference.z, 2);
    return difference;
  }

 private:
  void shorten(double& along, std::size_t k) const {
    if (length_[k] > 0.0) along -= length_[k] * std::round(along / length_[k]);
  }

  std::array<double, D> length_{};  ///< 0 where it is not periodic [m]
};

/// Ids of walls: which body each wall disk, plane and cylinder belongs to. Disks come first, then
/// wall disks, then planes, then cylinders.
class WallIds {
 public:
  template <int D>
  WallIds(std::size_t disks, const std::vector<BodyOf<D>>& bodies) : disks_(disks) {
    for (std::size_t b = 0; b < bodies.size(); ++b)
      for (std::size_t k = 0; k < bodies[b].radius.size(); ++k) owner_.push_back({b, k});
    planes_ = disks_ + owner_.size();
    for (std::size_t b = 0; b < bodies.size(); ++b)
      for (std::size_t p = 0; p < bodies[b].planes.size(); ++p) owner_.push_back({b, p});
    cylinders_ = disks_ + owner_.size();
    for (std::size_t b = 0; b < bodies.size(); ++b)
      for (std::size_t c = 0; c < bodies[b].cylinders.size(); ++c) owner_.push_back({b, c});
  }

  bool isWall(std::size_t id) const { return id >= disks_; }
  bool isWallDisk(std::size_t id) const { return isWall(id) && id < planes_; }
  bool isPlane(std::size_t id) const { return id >= planes_ && id < cylinders_; }
  bool isCylinder(std::size_t id) const { return id >= cylinders_; }
  std::size_t body(std::size_t wall) const { return owner_[wall - disks_].first; }
  /// Number of a wall disk, plane or cylinder in its body.
  std::size_t part(std::size_t wall) const { return owner_[wall - disks_].second; }

 private:
  std::size_t disks_, planes_, cylinders_;
  std::vector<std::pair<std::size_t, std::size_t>> owner_;
};

/// Contacts of a snapshot, one after the other: the arrays that all of them have.
template <int D>
class ContactColumnsOf {
 public:
  /// @param normal  from j to i  @param overlap  [m]
  /// @param fn, ft  on i along the normal and along z × normal, or normal to it in space [N]
  void add(std::int32_t i, std::int32_t j, VectorOf<D> normal, double overlap, double fn,
           TangentOf<D> ft) {
    i_.push_back(i);
    j_.push_back(j);
    append(normal_, normal);
    overlap_.push_back(overlap);
    fn_.push_back(fn);
    append(ft_, ft);
  }

  void writeTo(ArrayFile& arrays) const {
    arrays.add("contacts.i", i_);
    arrays.add("contacts.j", j_);
    arrays.add("contacts.normal", normal_);
    arrays.add("contacts.overlap", overlap_);
    arrays.add("contacts.normal_force", fn_);
    arrays.add("contacts.tangential_force", ft_);
  }

 private:
  std::vector<std::int32_t> i_, j_;
  std::vector<double> normal_, overlap_, fn_, ft_;
};
using ContactColumns = ContactColumnsOf<2>;

}  // namespace crossgrain_worker
