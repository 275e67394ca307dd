#pragma once

#include <string>
#include <vector>

#include "results/compare.hpp"

namespace crossgrain::inline studies {

/// What it means that contacts are pairs which transmit a force (averaging/contact_rule.hpp):
/// coordination as it is and as it would be with every pair that an engine lists, engine by engine.
/// One note, or none where no run shows contacts.
std::vector<std::string> contactNotes(const FlowStudy& study);

}  // namespace crossgrain::inline studies
