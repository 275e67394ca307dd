#pragma once

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <optional>
#include <string>

#include "adapters/shape.hpp"

/// Checks of convex bodies as people write them.
namespace crossgrain {

/// The orientation that a quaternion says; absent unless that has length 1.
inline std::optional<TurnOf<3>> writtenTurn(const Eigen::Quaterniond& written) {
  if (!isUnit(written)) return std::nullopt;
  const Eigen::Quaterniond unit = written.normalized();
  return TurnOf<3>(unit.w(), unit.x(), unit.y(), unit.z());
}

/// Why no body of that mass and reach has that moment of inertia, a clause; empty: one may. No part
/// of it is beyond its reach.
inline std::string inertiaFault(double inertia, double mass, double reach) {
  const double most = mass * reach * reach;
  if (inertia <= most) return {};
  return fmt::format("is more than a body of {:g} kg that reaches {:g} m can have, {:g} kg m²",
                     mass, reach, most);
}

}  // namespace crossgrain
