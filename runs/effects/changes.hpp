#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "cases/case.hpp"

namespace crossgrain::inline runs {

/// What switching one thing off changes in the profiles of an engine: switched − whole case, ring
/// by ring, mean over the packings that both have finished; members of results.json's "legs":
/// - packings, stderr_kind "packings" (of paired differences, sd/√P) or "within_run" (one packing:
///   the two runs' own bars, which say nothing about other packings);
/// - fields: {field, unit, judged, verdict, rings {ring, reference, change, stderr, p, resolved,
///   low, high, smallest, verdict}}.
/// Fields with a margin in the case (all, if none has one) are judged: their rings are one family
/// of two-sided t tests under Holm's procedure, false alarms held to 1 − confidence, on ratios
/// where the margin is relative. p is adjusted; `resolved` says whether it is significant; low and
/// high are the ends of the interval that this rests on, which leaves out 0 exactly if it is;
/// `smallest` is the change that would just have been. All five are absent with fewer than 4
/// packings. `verdict` holds the change of a field, and of a ring, against its margin, as between
/// engines: "agree", "disagree", "undecided".
nlohmann::json effectChanges(const Case& setup, const nlohmann::json& runs,
                             const std::string& engine, const std::string& without);

}  // namespace crossgrain::inline runs
