#pragma once

// Prescribed motion of wall bodies: the closed forms of adapters/motion.hpp, in plain C++17.

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "crossgrain_vector.hpp"

namespace crossgrain_worker {

/// As the protocol has numbers and vectors.
inline double toJson(double x) {
  return x;
}
inline nlohmann::json toJson(Vector v) {
  return {v.x, v.y};
}
inline nlohmann::json toJson(Vector3 v) {
  return {v.x, v.y, v.z};
}
inline void from_json(const nlohmann::json& list, Vector& v) {
  v = {list.at(0), list.at(1)};
}
inline void from_json(const nlohmann::json& list, Vector3& v) {
  v = {list.at(0), list.at(1), list.at(2)};
}

/// The vectors of an array.
template <int D = 2>
std::vector<VectorOf<D>> vectorsOf(const std::vector<double>& numbers) {
  std::vector<VectorOf<D>> list;
  for (std::size_t k = 0; k + D <= numbers.size(); k += D) {
    if constexpr (D == 2)
      list.push_back({numbers[k], numbers[k + 1]});
    else
      list.push_back({numbers[k], numbers[k + 1], numbers[k + 2]});
  }
  return list;
}

template <int D>
struct PlaneOf {
  VectorOf<D> point, normal;
};
using Plane = PlaneOf<2>;

/// Hollow, with spheres inside, of space alone; its body stands still or turns about its axis.
template <int D>
struct CylinderOf {
  VectorOf<D> point, axis;  ///< of length 1
  double radius;            ///< [m]

  struct Facing {
    VectorOf<D> normal;  ///< to the axis; on the axis itself there is none
    double distance;     ///< from the surface, R − s [m]
  };
  Facing facing(VectorOf<D> place) const {
    const VectorOf<D> apart = place - point, aside = apart - dot(apart, axis) * axis;
    const double s = norm(aside);
    return {s > 0.0 ? (-1.0 / s) * aside : VectorOf<D>{}, radius - s};
  }
};

/// A rigid body of wall disks, or spheres, planes and cylinders at any time.
template <int D>
class BodyOf {
 public:
  using Vector = VectorOf<D>;
  using Spin = SpinOf<D>;

  BodyOf(const nlohmann::json& description, const std::vector<double>& diskPosition,
         std::vector<double> diskRadius)
      : motion_(description.at("motion")),
        kind_(motion_.at("kind")),
        start_(description.at("centre").get<Vector>()),
        radius(std::move(diskRadius)) {
    for (const Vector& place : vectorsOf<D>(diskPosition)) offset_.push_back(place - start_);
    for (const auto& plane : description.at("planes"))
      planesAtStart_.push_back({plane.at("point").get<Vector>(), plane.at("normal").get<Vector>()});
    if (description.contains("cylinders"))
      for (const auto& cylinder : description.at("cylinders"))
        cylinders.push_back({cylinder.at("point").get<Vector>(), cylinder.at("axis").get<Vector>(),
                             cylinder.at("radius")});
    at(0.0);
  }

  /// Puts everything where it is at time t.
  void at(double t) {
    const double w = motion_.at("frequency");
    const Spin rate = motion_.at("angular_velocity").get<Spin>();
    const Vector amplitude = motion_.at("amplitude").get<Vector>();
    centre = start_;
    velocity = {};
    angle = spin = {};
    double shift = 0.0, outward = 0.0;
    if (kind_ == "rotating") {
      angle = t * rate;
      spin = rate;
    } else if (kind_ == "translating") {
      velocity = motion_.at("velocity").get<Vector>();
      centre = start_ + t * velocity;
    } else if (kind_ == "oscillating") {
      centre = start_ + std::sin(w * t) * amplitude;
      velocity = w * std::cos(w * t) * amplitude;
    } else if (kind_ == "radial") {
      const double speed = motion_.at("radial_velocity"), end = motion_.at("radial_end");
      shift = speed * std::min(t, end);
      outward = t < end ? speed : 0.0;
    }
    const TurnOf<D> turn(angle);
    position.clear();
    diskVelocity.clear();
    planes.clear();
    for (const Vector& start : offset_) {
      const double apart = norm(start);
      const double scale = apart > 0.0 ? 1.0 + shift / apart : 1.0;
      const Vector arm = scale * turn(start);
      const double stretch = apart > 0.0 ? outward / (scale * apart) : 0.0;
      position.push_back(centre + arm);
      diskVelocity.push_back(velocity + stretch * arm + cross(spin, arm));
    }
    for (const PlaneOf<D>& plane : planesAtStart_)
      planes.push_back({centre + turn(plane.point - start_), turn(plane.normal)});
  }

  /// Velocity of the body's material at a place, as planes and cylinders have it.
  Vector velocityAt(Vector place) const { return velocity + cross(spin, place - centre); }

  bool moves() const { return kind_ != "fixed"; }

  /// As an entry of a snapshot's `bodies`, without loads.
  nlohmann::json pose() const {
    return {{"centre", toJson(centre)},
            {"angle", toJson(angle)},
            {"velocity", toJson(velocity)},
            {"angular_velocity", toJson(spin)}};
  }

 private:
  nlohmann::json motion_;
  std::string kind_;
  Vector start_;
  std::vector<Vector> offset_;
  std::vector<PlaneOf<D>> planesAtStart_;

 public:
  Vector centre, velocity;
  Spin angle = {}, spin = {};
  std::vector<double> radius;                  ///< of the wall disks [m]
  std::vector<Vector> position, diskVelocity;  ///< of the wall disks
  /// They turn and shift with the body; in radial motion they stay.
  std::vector<PlaneOf<D>> planes;
  std::vector<CylinderOf<D>> cylinders;  ///< they stay where they are
};
using Body = BodyOf<2>;

}  // namespace crossgrain_worker
