#pragma once

#include <optional>
#include <span>

#include "cases/case.hpp"
#include "results/endpoints.hpp"

namespace crossgrain::inline runs {

/// Of a comparison: fewer than two engines, no margins, no endpoint of two engines, or fewer
/// packings than a verdict needs. Absent where any test was made, undecided or not.
/// @param named  engines that the user named, without the mirrors that came along
std::optional<NothingJudged> nothingJudged(const Case& setup, std::span<const EndpointRow> rows,
                                           std::size_t named);

}  // namespace crossgrain::inline runs
