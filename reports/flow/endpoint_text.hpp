#pragma once

#include <string>
#include <vector>

#include "reports/flow/engine_runs.hpp"
#include "results/endpoints.hpp"

/// Verdicts on endpoints, in words, for the page and the command line alike; and where they stand.
namespace crossgrain::reports {

/// Name and symbol of an endpoint (cases/endpoints.hpp); of one that a case made up, its
/// name with blanks.
std::string endpointWords(const std::string& name);
/// @param ofCell  whether a cell was averaged: what an assembly calls "stress_ratio" is no
/// σ_rφ/σ_rr
std::string endpointSymbol(const std::string& name, bool ofCell);

/// "agree, no difference seen", "agree, small difference", "borderline", "disagree", "undecided"; a
/// dash where the files of one have no such number.
std::string wordOf(const EndpointRow& row);

/// "0.31 margins (0.05 to 0.57)"; empty where nothing was measured.
std::string describeDistance(const EndpointRow& row);

/// "24 to 60 packings decide with 90 % chance"; empty where that is not known, or all is decided.
std::string describeNeeds(const EndpointRow& row);

/// "0.0688 for 0.069 m": an engine's value beside the closed form's.
std::string describeValue(const EndpointRow& row);

/// "through grain-as-x, B = 0.002 margins"; empty: its own runs.
std::string describeSurrogate(const EndpointRow& row);

/// All of them in a line.
std::string describeAnswer(const EndpointRow& row);

/// Whether an engine is evaluated through its mirror, with its spot-check run and 3/n.
std::string describe(const SurrogateEngine& own);

std::string describe(const AlarmRow& alarm);

/// Interim analyses, the error probability spent, why there was no further one.
std::string describe(const InterimFindings& looks);

/// Finding rows of a comparison. A pair is the same whichever engine is named first.
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

/// An engine, or the median, as a sentence calls it; and the reference. @pre there is an engine
std::string called(const std::string& engine);
std::string referenceWords(const CompareResults& results);

/// Engines that are compared with the reference in their own name.
std::vector<std::string> peersOf(const CompareResults& results, const Engines& engines);

}  // namespace crossgrain::reports
