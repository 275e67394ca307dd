#pragma once

#include <vector>

#include "cases/case.hpp"
#include "results/compare.hpp"

namespace crossgrain::inline studies {

/// What is far outside any margin, whether or not a test can prove it: an endpoint whose mean lies
/// more than 10 margins off (chaos scatters single packings by at most 3) and is not already called
/// a disagreement; an endpoint that one of two engines lacks on most packings; disks that are gone;
/// another regime on most packings.
std::vector<AlarmRow> alarmsOf(const Case& setup, const CompareResults& results,
                               const std::vector<EndpointRow>& rows);

}  // namespace crossgrain::inline studies
