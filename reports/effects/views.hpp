#pragma once

#include <string>
#include <vector>

#include "reports/effects/variants.hpp"

/// Variants of a study of effects in words.
namespace crossgrain::reports {

/// "takes 12.1 ± 0.4 % of a step"
std::string costInWords(const VariantSummary& variant);

/// Whether the time that switching it off saves stands out of its error.
bool costsTime(const VariantSummary& variant);

/// "told apart from no change without it: azimuthal velocity in ring 3, −34 % (−45 to −23 %)", or
/// from where on this run could have seen a change; empty where there are too few packings to tell.
std::string changesInWords(const VariantSummary& variant);

/// The table of one engine: effects by what they cost, contacts, and each field that is judged.
Json effectTable(const EffectsResults& results, const std::string& engine);

}  // namespace crossgrain::reports
