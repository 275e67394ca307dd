#pragma once

#include "adapters/contact_law.hpp"
#include "results/collision_score.hpp"

namespace crossgrain::inline runs {

/// Options that matter to the law, and constants that it has.
LawWords lawInWords(const ContactLaw& law);

/// Those in which a law differs from another; a constant that it lacks is 0. Empty: it is the same
/// law.
LawWords lawDifference(const ContactLaw& law, const ContactLaw& from);

}  // namespace crossgrain::inline runs
