#pragma once

#include <string>
#include <vector>

#include "reports/cost/points.hpp"

/// The tables of a study of cost, and what they say in sentences.
namespace crossgrain::reports {

/// The wanted accuracies, coarsest first.
std::vector<double> costWants(const Json& results);

/// One line on each want: the engine that reaches it in collisions and averages with the least
/// time.
std::string wantInWords(const Json& results, double want);

/// "Finding: ENGINE, INTEGRATOR: order 2 is claimed and not met: collision Ψ_f 1.02 ± 0.05, …."
std::vector<std::string> unmetOrders(const Json& results);

/// An engine per row, a want per column: the recommended setting.
Json adviceRows(const Json& results, const std::vector<EngineResults>& engines);

/// {engine, settings [{wants, label, fragment}]} of each engine that reaches something.
Json fragmentViews(const Json& results, const std::vector<EngineResults>& engines);

/// A group per kind and measure: an engine per row, a want per column.
Json cheapestGroups(const Json& results, const std::vector<EngineResults>& engines);

Json orderRows(const Json& results);

/// A group per kind, {kind, measures, rows}: a row per engine and setting that is no time step.
Json knobGroups(const Json& results, const std::vector<EngineResults>& engines);

/// What failed, was refused or could not be afforded, alike reasons together.
Json notRunRows(const Json& results);

Json startupRows(const Json& results);
Json referenceRows(const Json& results);

}  // namespace crossgrain::reports
