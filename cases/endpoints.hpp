#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "cases/case.hpp"

namespace crossgrain::inline cases {

/// One number of a run that carries a verdict between engines: few of them, so that a test can find
/// something, and each says another thing of the flow. Rings show where a difference is.
struct EndpointSpec {
  std::string_view name;        ///< "pressure"
  std::string_view words;       ///< "pressure"
  std::string_view symbol;      ///< marks as in reports/common/labels.hpp
  std::string_view unit;        ///< "-": a number
  std::string_view definition;  ///< in words
  /// Engines are compared by their ratio, on logarithms, and the margin is relative: of what has
  /// one sign in every run and spreads over packings by factors. Else by the difference.
  bool byRatio;
};

/// Of a Couette cell, in the order of reports. Means over the cell: see Reduction.
std::span<const EndpointSpec> endpointTable();

/// @throws std::invalid_argument if there is no endpoint of that name
const EndpointSpec& endpointSpec(std::string_view name);

/// Those that the case has margins for, in the order of reports. What an assembly makes up itself
/// are views of the case, which must outlive them.
std::vector<EndpointSpec> endpointsOf(const Case& setup);

/// One of them, with or without a margin. @throws as above
EndpointSpec endpointSpec(const Case& setup, std::string_view name);

}  // namespace crossgrain::inline cases
