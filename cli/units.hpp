#pragma once

#include <string>

namespace crossgrain::inline cli {

/// The value of --budget, "90s", "10m", "1h" [s]. @throws BadInput
double secondsOf(const std::string& budget);

/// The value of --want, "1%" or "1e-3", as a share: 0.01, 0.001. @throws BadInput
double fractionOf(const std::string& target);

}  // namespace crossgrain::inline cli
