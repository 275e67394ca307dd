#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cases/case.hpp"
#include "results/compare.hpp"

/// Remarks on a comparison that no test makes.
namespace crossgrain::inline studies {

/// Alarms: values far outside any margin, whether or not a test can prove it: an endpoint whose
/// mean lies more than 10 margins off (chaos scatters single packings by at most 3) and is not
/// already called a disagreement; an endpoint that one of two engines lacks on most packings; disks
/// that are gone; another regime on most packings.
std::vector<AlarmRow> alarmsOf(const Case& setup, const CompareResults& results);

/// A note on what it means that contacts are pairs which transmit a force
/// (averaging/contact_rule.hpp): coordination as it is and as it would be with every pair that an
/// engine lists, engine by engine. One note, or none where no run shows contacts.
std::vector<std::string> contactNotes(const FlowStudy& study);

/// The first three, and how many more: "a.dump, b.dump, c.dump and 4 more".
std::string firstOf(const std::vector<std::string>& names, std::string_view between = ", ");

/// Notes on what files lack and what that costs, each once: of some of an engine's runs with their
/// names.
/// @param named  whether the engine is
std::vector<std::string> remarkNotes(std::span<const FlowRun> runs, bool named);

/// That, and what the verdicts on their runs rest on, pair by pair, and what that cannot
/// see.
std::vector<std::string> fileNotes(const CompareResults& results);

/// Sentences for the head of the report on the shear band: does each engine's v_φ in rings 1 to 3
/// lie within 15 % of the reference's, or within the bars that packings leave? Where it does not,
/// what its mirror has to say: a mirror that follows the peer away from the reference shows that
/// the model makes the difference, one that stays with the reference that it does not. None where
/// no engine is the reference.
std::vector<std::string> velocityNotes(const CompareResults& results);

}  // namespace crossgrain::inline studies
