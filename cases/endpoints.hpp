#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "cases/case.hpp"

namespace crossgrain::inline cases {

/// Ready-made ones of shear between two rings, in the order of reports: [averaging.endpoints] names
/// them. Means over the cell: see Reduction.
std::span<const Endpoint> endpointTable();

/// @throws std::invalid_argument if there is no endpoint of that name
const Endpoint& endpointNamed(std::string_view name);

/// One of the case's, or of the table. @throws as above
const Endpoint& endpointNamed(const Case& setup, std::string_view name);

}  // namespace crossgrain::inline cases
