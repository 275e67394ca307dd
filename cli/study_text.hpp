#pragma once

#include <string>

#include "results/collision.hpp"
#include "results/compare.hpp"
#include "results/conformance.hpp"
#include "results/cost.hpp"
#include "results/effects.hpp"
#include "results/stability.hpp"
#include "studies/lockstep/identify.hpp"

/// Results as a command prints them above the matrix, which has a line for each engine.
namespace crossgrain::inline cli {

/// @param verbose  every row, and not only those that a reader acts on
std::string compareText(const CompareResults& results, bool verbose);
std::string averageText(const CompareResults& results, bool verbose);
std::string revText(const RevResults& results, bool verbose);
std::string collideText(const CollideResults& results, bool verbose);
std::string effectsText(const EffectsResults& results, bool verbose);
std::string stabilityText(const StabilityResults& results, bool verbose);
std::string lockstepText(const LockstepResults& results, bool verbose);
std::string conformanceText(const ConformanceResults& results, bool verbose);

/// Of what `identify` found about an engine.
std::string identifyText(const std::string& engine, const Identification& found);

}  // namespace crossgrain::inline cli
