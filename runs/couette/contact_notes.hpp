#pragma once

#include <nlohmann/json.hpp>

namespace crossgrain::inline runs {

/// What it means that contacts are pairs which transmit a force (averaging/contact_rule.hpp):
/// coordination as it is and as it would be with every pair that an engine lists, engine by engine.
/// An array of one note, or of none where no run shows contacts.
nlohmann::json contactNotes(const nlohmann::json& results);

}  // namespace crossgrain::inline runs
