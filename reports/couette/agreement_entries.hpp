#pragma once

#include <string>
#include <vector>

#include "reports/couette/engine_runs.hpp"

/// Finding rows of a comparison's agreement. A pair is the same whichever engine is named first.
namespace crossgrain::reports {

using Agreement = std::vector<AgreementRow>;

/// Every field that is compared, in the order of the results.
std::vector<std::string> fieldsOf(const Agreement& agreement);

/// The row of that pair and field, or null.
const AgreementRow* rowOf(const Agreement& agreement, const std::string& a, const std::string& b,
                          const std::string& field);

/// Whether the pair is compared in any field.
bool compared(const Agreement& agreement, const std::string& a, const std::string& b);

/// Engines that are compared with the reference in their own name.
std::vector<std::string> peersOf(const Agreement& agreement,
                                 const std::vector<EngineRuns>& engines);

}  // namespace crossgrain::reports
