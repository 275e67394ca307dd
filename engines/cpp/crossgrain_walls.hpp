#pragma once

// Prescribed motion of wall bodies: the closed forms of adapters/motion.hpp, in plain C++17.

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "crossgrain_vector.hpp"

namespace crossgrain_worker {

struct Plane {
  Vector point, normal;
};

/// A rigid body of wall disks and planes at any time.
class Body {
 public:
  Body(const nlohmann::json& description, const std::vector<double>& diskPosition,
       std::vector<double> diskRadius)
      : motion_(description.at("motion")),
        kind_(motion_.at("kind")),
        start_(vectorOf(description.at("centre"))),
        radius(std::move(diskRadius)) {
    for (std::size_t k = 0; k < radius.size(); ++k)
      offset_.push_back(Vector{diskPosition[2 * k], diskPosition[2 * k + 1]} - start_);
    for (const auto& plane : description.at("planes"))
      planesAtStart_.push_back({vectorOf(plane.at("point")), vectorOf(plane.at("normal"))});
    at(0.0);
  }

  /// Puts everything where it is at time t.
  void at(double t) {
    const double w = motion_.at("frequency"), rate = motion_.at("angular_velocity");
    const Vector amplitude = vectorOf(motion_.at("amplitude"));
    centre = start_;
    velocity = {};
    angle = spin = 0.0;
    double shift = 0.0, outward = 0.0;
    if (kind_ == "rotating") {
      angle = rate * t;
      spin = rate;
    } else if (kind_ == "translating") {
      velocity = vectorOf(motion_.at("velocity"));
      centre = start_ + t * velocity;
    } else if (kind_ == "oscillating") {
      centre = start_ + std::sin(w * t) * amplitude;
      velocity = w * std::cos(w * t) * amplitude;
    } else if (kind_ == "radial") {
      const double speed = motion_.at("radial_velocity"), end = motion_.at("radial_end");
      shift = speed * std::min(t, end);
      outward = t < end ? speed : 0.0;
    }
    const double c = std::cos(angle), s = std::sin(angle);
    const auto turn = [&](Vector a) { return Vector{c * a.x - s * a.y, s * a.x + c * a.y}; };
    position.clear();
    diskVelocity.clear();
    planes.clear();
    for (const Vector& start : offset_) {
      const double apart = std::hypot(start.x, start.y);
      const double scale = apart > 0.0 ? 1.0 + shift / apart : 1.0;
      const Vector arm = scale * turn(start);
      const double stretch = apart > 0.0 ? outward / (scale * apart) : 0.0;
      position.push_back(centre + arm);
      diskVelocity.push_back(velocity + stretch * arm + spin * turned(arm));
    }
    for (const Plane& plane : planesAtStart_)
      planes.push_back({centre + turn(plane.point - start_), turn(plane.normal)});
  }

  /// Velocity of the body's material at a place, as planes have it.
  Vector velocityAt(Vector place) const { return velocity + spin * turned(place - centre); }

  bool moves() const { return kind_ != "fixed"; }

  /// As an entry of a snapshot's `bodies`, without loads.
  nlohmann::json pose() const {
    return {{"centre", {centre.x, centre.y}},
            {"angle", angle},
            {"velocity", {velocity.x, velocity.y}},
            {"angular_velocity", spin}};
  }

 private:
  static Vector vectorOf(const nlohmann::json& pair) { return {pair.at(0), pair.at(1)}; }

  nlohmann::json motion_;
  std::string kind_;
  Vector start_;
  std::vector<Vector> offset_;
  std::vector<Plane> planesAtStart_;

 public:
  Vector centre, velocity;
  double angle = 0.0, spin = 0.0;
  std::vector<double> radius;                  ///< of the wall disks [m]
  std::vector<Vector> position, diskVelocity;  ///< of the wall disks
  /// They turn and shift with the body; in radial motion they stay.
  std::vector<Plane> planes;
};

}  // namespace crossgrain_worker
