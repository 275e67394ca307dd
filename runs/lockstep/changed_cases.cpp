#include "runs/lockstep/changed_cases.hpp"

#include <fmt/format.h>

#include "runs/lockstep/terms.hpp"

namespace crossgrain::inline runs {

std::vector<ChangedCase> changedCases(const Case& setup) {
  const auto changed = [&](const std::string& constant) {
    return ChangedCase{constant, fmt::format("{}+{:g}%", constant, 100.0 * responseChange), setup};
  };
  std::vector<ChangedCase> cases = {changed(yardstickOf(setup.law))};
  changeYardstick(cases.front().setup.law, responseChange);
  if (setup.law.mu > 0.0) {
    cases.push_back(changed("mu"));
    cases.back().setup.law.mu *= 1.0 + responseChange;
  }
  return cases;
}

}  // namespace crossgrain::inline runs
