#pragma once

#include <string>
#include <vector>

#include "reports/common/engines.hpp"
#include "reports/common/json_view.hpp"
#include "reports/common/pages.hpp"

/// The parts of the comparison's page.
namespace crossgrain::reports {

/// The table of engines: what ran, what it cost, what state it was in.
void addEngineTable(Json& view, const std::vector<EngineResults>& engines);

/// The state alone: of what was averaged and not run.
void addStateTable(Json& view, const std::vector<EngineResults>& engines);

/// The tables of fits and of checks of a single number.
void addFitsAndNumberChecks(Json& view, const std::vector<EngineResults>& engines);

/// Profiles, checks, series and distributions.
void addFigures(Json& view, const std::vector<EngineResults>& engines, const Illustrations& shown);

/// Engines and runs that did not run to the end, with their reasons.
void addTroubles(Json& view, const std::vector<EngineResults>& engines);

/// Verdicts against the reference, of all pairs, and model against implementation.
void addAgreement(Json& view, const Json& results, const std::vector<EngineResults>& engines);

/// The verdict in a line (lead) and a sentence or two on each engine (sentences).
void addSummary(Json& view, const Json& results, const std::vector<EngineResults>& engines);

}  // namespace crossgrain::reports
