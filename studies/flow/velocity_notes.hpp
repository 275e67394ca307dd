#pragma once

#include <string>
#include <vector>

#include "results/compare.hpp"

namespace crossgrain::inline studies {

/// Sentences for the head of the report on the shear band: does each engine's v_φ in rings 1 to 3
/// lie within 15 % of the reference's, or within the bars that packings leave? Where it does not,
/// what its mirror has to say: a mirror that follows the peer away from the reference shows that
/// the model makes the difference, one that stays with the reference that it does not.
std::vector<std::string> velocityNotes(const FlowStudy& study);

}  // namespace crossgrain::inline studies
