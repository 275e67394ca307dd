#pragma once

#include <optional>

#include "cases/case.hpp"
#include "results/run.hpp"

namespace crossgrain::inline runs {

/// An endpoint that the case makes up itself, of one finished run; absent where there is nothing to
/// measure. [unit of the endpoint]
std::optional<double> ownEndpointOf(const OwnEndpoint& endpoint, const Case& setup,
                                    const CouetteRun& run);

}  // namespace crossgrain::inline runs
