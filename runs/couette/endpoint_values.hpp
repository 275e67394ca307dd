#pragma once

#include <optional>
#include <span>
#include <string>

#include "cases/case.hpp"
#include "cases/endpoints.hpp"
#include "runs/couette/paired_rings.hpp"

namespace crossgrain::inline runs {

/// An endpoint of one finished run, from its profiles by the case's first method; absent where
/// there is nothing to measure. [unit of the endpoint]
std::optional<double> endpointOf(const EndpointSpec& endpoint, const Case& setup,
                                 const CouetteRun& run);

/// Of one engine's finished runs, by packing index.
Numbers endpointByPacking(const EndpointSpec& endpoint, const Case& setup, const Runs& runs,
                          std::size_t packings);

/// Area mean over the rings that have the field [its unit].
std::optional<double> cellMean(const Case& setup, const CouetteRun& run, std::string_view field);

}  // namespace crossgrain::inline runs
