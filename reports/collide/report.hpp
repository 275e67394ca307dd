#pragma once

#include <string>

#include "reports/common/json_view.hpp"

/// What is written of collisions.
namespace crossgrain::reports {

/// JUnit: a test for each sweep and quantity that the case has a limit for.
std::string collideJunit(const Json& results);

}  // namespace crossgrain::reports
