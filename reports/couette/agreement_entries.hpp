#pragma once

#include <string>
#include <vector>

#include "reports/common/engines.hpp"
#include "reports/common/json_view.hpp"

/// Finding entries of results["agreement"]. A pair is the same whichever engine is named first.
namespace crossgrain::reports {

/// Every field that is compared, in the order of the results.
std::vector<std::string> fieldsOf(const Json& results);

/// The entry of that pair and field, or null.
const Json& entryOf(const Json& results, const std::string& a, const std::string& b,
                    const std::string& field);

/// Whether the pair is compared in any field.
bool compared(const Json& results, const std::string& a, const std::string& b);

/// Engines that are compared with the reference in their own name.
std::vector<std::string> peersOf(const Json& results, const std::vector<EngineResults>& engines);

}  // namespace crossgrain::reports
