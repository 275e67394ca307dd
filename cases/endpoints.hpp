#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "cases/case.hpp"

namespace crossgrain::inline cases {

/// A number of a run over time, besides its fields: a column of series.csv.
struct RegionNumber {
  std::string_view name, unit, definition;
  bool ofContacts = false;  ///< absent without a contact, which is no gap in what was seen
};

/// Of disks with their centres in the averaged part, or, of contacts, of the whole scene.
std::span<const RegionNumber> regionNumbers(int dimension = 2);

/// Of one disk, wherever it is.
std::span<const RegionNumber> diskNumbers(int dimension = 2);

/// Of one wall, or of one of its planes: what the disks do to it.
std::span<const RegionNumber> wallNumbers(int dimension = 2);
inline constexpr std::string_view normalForce = "normal_force";

/// Quantities of ready-made endpoints alone: half the trace of the stress of rings in the plane,
/// which have no such field; and the contacts of a disk over the whole scene, which are those of no
/// bin.
inline constexpr std::string_view planePressure = "pressure",
                                  sceneCoordination = "scene_coordination";

/// Ready-made ones of shear between two rings, in the order of reports: [averaging.endpoints] names
/// them. Means over the cell: see Reduction.
std::span<const Endpoint> endpointTable();

/// @throws std::invalid_argument if there is no endpoint of that name
const Endpoint& endpointNamed(std::string_view name);

/// One of the case's, or of the table. @throws as above
const Endpoint& endpointNamed(const Case& setup, std::string_view name);

}  // namespace crossgrain::inline cases
