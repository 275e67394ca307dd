#pragma once

#include <string>
#include <vector>

#include "reports/common/view.hpp"
#include "reports/cost/points.hpp"
#include "results/cost.hpp"

/// The tables of a study of cost, as views for the page, and what they say in sentences.
namespace crossgrain::reports {

/// "Which setting … is decided for 31 of 36 against …"
std::string decidedInWords(const CostResults& results);

/// The engine that reaches a target of the case's law for the least time; null: none does.
const CostCell* cheapestOf(const CostResults& results, CostKind kind, double target);

/// A sentence on each target: in each kind of error the engine that reaches it for the least time.
std::vector<std::string> accuracyInWords(const CostResults& results);

/// A group per kind of error: a row per engine and basis, a target per column.
Json accuracyGroups(const CostResults& results, const std::vector<CostEngine>& engines);
Json accuracyTargets(const CostResults& results);

/// The accuracies that settings were looked for, coarsest first.
std::vector<double> costTargets(const CostResults& results);

/// One line on each target: the engine that reaches it in collisions and averages with the least
/// time.
std::string targetInWords(const CostResults& results, double target);

/// "Finding: ENGINE, INTEGRATOR: order 2 is claimed and not met: collision Ψ_f 1.02 ± 0.05, …."
std::vector<std::string> unmetOrders(const CostResults& results);

/// An engine per row, a target per column: the recommended setting.
Json adviceRows(const CostResults& results, const std::vector<CostEngine>& engines);

/// {engine, wants, setting, fragment} of each setting that some engine reaches something with.
Json fragmentViews(const CostResults& results, const std::vector<CostEngine>& engines);

/// A group per kind and measure: an engine per row, a target per column.
Json cheapestGroups(const CostResults& results, const std::vector<CostEngine>& engines);

Json orderRows(const CostResults& results);

/// A group per kind, {kind, measures, rows}: a row per engine and setting that is no time step.
Json knobGroups(const CostResults& results, const std::vector<CostEngine>& engines);

/// What failed, was refused or could not be afforded, alike reasons together.
Json notRunRows(const CostResults& results);

Json startupRows(const CostResults& results);
Json referenceRows(const CostResults& results);

}  // namespace crossgrain::reports
