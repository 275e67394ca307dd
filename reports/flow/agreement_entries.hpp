#pragma once

#include <string>
#include <vector>

#include "reports/flow/engine_runs.hpp"

/// Finding rows of a comparison. A pair is the same whichever engine is named first.
namespace crossgrain::reports {

using Agreement = std::vector<AgreementRow>;
using Endpoints = std::vector<EndpointRow>;

/// Every field that is compared ring by ring, and every endpoint, in the order of the results.
std::vector<std::string> fieldsOf(const Agreement& agreement);
std::vector<std::string> endpointsOf(const Endpoints& endpoints);

/// The row of that pair and field, or of that endpoint; or null.
const AgreementRow* rowOf(const Agreement& agreement, const std::string& a, const std::string& b,
                          const std::string& field);
const EndpointRow* rowOf(const Endpoints& endpoints, const std::string& a, const std::string& b,
                         const std::string& endpoint);

/// All rows of a pair.
std::vector<const EndpointRow*> rowsOf(const Endpoints& endpoints, const std::string& a,
                                       const std::string& b);

/// Engines that are compared with the case's expected values, in the order of the results.
std::vector<std::string> closedFormEngines(const Endpoints& endpoints);

/// Engines that are compared with the reference in their own name.
std::vector<std::string> peersOf(const Endpoints& endpoints,
                                 const std::vector<EngineRuns>& engines);

}  // namespace crossgrain::reports
