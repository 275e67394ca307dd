#include "reports/common/junit.hpp"

#include "reports/conformance/report.hpp"

namespace crossgrain::reports {

std::string conformanceJunit(const ConformanceResults& results) {
  using Outcome = JUnitCase::Outcome;
  // In the order of ConformanceOutcome.
  constexpr Outcome outcomes[] = {Outcome::passed, Outcome::failed, Outcome::skipped,
                                  Outcome::error};
  std::vector<JUnitCase> cases;
  for (const ConformanceRow& row : results.rows)
    cases.push_back({results.engine.name + " " + row.part, row.name,
                     outcomes[static_cast<std::size_t>(row.outcome)], row.detail, row.seconds});
  return junitXml("conformance", cases);
}

}  // namespace crossgrain::reports
