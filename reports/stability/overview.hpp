#pragma once

#include <string>

#include "results/overview.hpp"
#include "results/stability.hpp"

namespace crossgrain::reports {

/// The family of hard cases that a measure belongs to: "energy", "rest". Of one that is not known
/// here its own name.
std::string familyOf(const std::string& measure);

/// Whether these are cases told otherwise (runs/stability/transforms.hpp), not hard ones.
bool areTransforms(const StabilityResults& results);

/// An engine per row, a family of hard cases per column: runs that stayed stable, of those judged.
Overview stabilityOverview(const StabilityResults& results);

}  // namespace crossgrain::reports
