#pragma once

#include <nlohmann/json.hpp>

namespace crossgrain::reports {

/// What templates are filled from is JSON of the page's own; nothing of the results is.
using Json = nlohmann::json;

}  // namespace crossgrain::reports
