#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "results/json_fields.hpp"

namespace crossgrain::inline results {

/// Disks of a cell, or of a hard case, at one instant. A place that is not a number is not drawn.
struct CellPicture {
  std::vector<double> radius, x, y;              ///< of disks [m]
  std::vector<double> startR, startPhi;          ///< where they were at first [m], [rad]
  std::vector<double> wallX, wallY, wallRadius;  ///< of wall disks [m]
  /// Ids, disks first and then wall disks, and f_n [N]; absent where the engine shows no contacts.
  std::optional<std::vector<std::int64_t>> contactI, contactJ;
  std::optional<std::vector<double>> contactForce;
  std::optional<std::vector<std::array<double, 4>>> planes;  ///< x, y [m], normal
  std::optional<double> time;                                ///< [s]
  std::optional<double> rotation;                            ///< of the wheel since the hand-over
};

Json toJson(const CellPicture& picture);
/// @throws FieldError
CellPicture pictureFromJson(const Json& json);

}  // namespace crossgrain::inline results
