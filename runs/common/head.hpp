#pragma once

#include <string>
#include <string_view>

#include "cases/case.hpp"
#include "results/head.hpp"

namespace crossgrain::inline runs {

/// Now, as ISO 8601 in UTC.
std::string timeStamp();

/// What all results begin with.
ResultsHead headOf(std::string_view kind, const Case& setup, const std::string& command);

}  // namespace crossgrain::inline runs
