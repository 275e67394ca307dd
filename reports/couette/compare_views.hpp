#pragma once

#include <string>
#include <vector>

#include "reports/common/details.hpp"
#include "reports/common/pages.hpp"
#include "reports/common/view.hpp"
#include "reports/couette/engine_runs.hpp"

/// The parts of the comparison's page.
namespace crossgrain::reports {

/// The table of engines: what ran, what it cost, what state it was in.
void addEngineTable(Json& view, const std::vector<EngineRuns>& engines);

/// The state alone: of what was averaged and not run.
void addStateTable(Json& view, const std::vector<EngineRuns>& engines);

/// The tables of fits and of checks of a single number.
void addFitsAndNumberChecks(Json& view, const std::vector<EngineRuns>& engines);

/// Profiles, checks, series and distributions.
void addFigures(Json& view, const std::vector<EngineRuns>& engines, const Illustrations& shown);

/// Engines and runs that did not run to the end, with their reasons.
void addTroubles(Json& view, const std::vector<EngineRuns>& engines);

/// Verdicts against the reference, of all pairs, and model against implementation.
void addAgreement(Json& view, const CompareResults& results,
                  const std::vector<EngineRuns>& engines);

/// The verdict in a line (lead) and a sentence or two on each engine (sentences).
void addSummary(Json& view, const CompareResults& results, const std::vector<EngineRuns>& engines);

/// Rings, weights and snapshots that the profiles are means over.
std::string averagesInWords(const CouetteFrame& frame);

/// What the engines made of the case's scene.
std::vector<RealisedScene> realisedOf(const CouetteFrame& frame,
                                      const std::vector<EngineRuns>& engines);

/// Heading, notes, machine, case text and command of a study.
Json studyView(const CouetteStudy& study, const Illustrations& shown);

}  // namespace crossgrain::reports
