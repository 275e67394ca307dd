#include "studies/lockstep/changed_cases.hpp"

#include <fmt/format.h>

#include "studies/lockstep/terms.hpp"

namespace crossgrain::inline studies {

void changeConstant(ContactLaw& law, const std::string& constant, double by) {
  if (constant == "mu")
    law.mu *= 1.0 + by;
  else
    changeReference(law, by);
}

std::vector<ChangedCase> changedCases(const Case& setup) {
  std::vector<std::string> constants = {referencePerturbationOf(setup.law)};
  if (setup.law.mu > 0.0) constants.emplace_back("mu");
  std::vector<ChangedCase> cases;
  for (const std::string& constant : constants) {
    cases.push_back({constant, fmt::format("{}+{:g}%", constant, 100.0 * responseChange), setup});
    changeConstant(cases.back().setup.law, constant, responseChange);
  }
  return cases;
}

}  // namespace crossgrain::inline studies
