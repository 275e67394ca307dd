#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace crossgrain::inline support {

/// Fate of an engine, or of one of its runs.
enum class Status {
  finished,
  failed,   ///< it died, hung, or answered what is no answer
  refused,  ///< it lacks what the scene calls for, and says so
  notRun    ///< there was no time, or not asked for
};
constexpr auto namesOf(Status) {
  return std::array<std::string_view, 4>{"finished", "failed", "refused", "not_run"};
}

/// Verdict of a comparison with a limit. In the order of severity: of several, the last is the one
/// that a summary has to show.
enum class Verdict {
  notApplicable,  ///< the question does not arise: the reference against itself, a law it lacks
  notMeasured,    ///< this command or this run has no number for it
  pass,
  modelDifference,  ///< true to the law that the engine declares, which is not the scene's
  borderline,       ///< about the limit
  undecided,        ///< more measurements would decide
  fail
};
constexpr auto namesOf(Verdict) {
  return std::array<std::string_view, 7>{
      "not_applicable", "not_measured", "pass", "model_difference",
      "borderline",     "undecided",    "fail"};
}

/// The one that a summary of both has to show.
constexpr Verdict moreSevere(Verdict a, Verdict b) {
  return std::max(a, b);
}

/// Whether anything was compared: what is not is never passed.
constexpr bool isJudged(Verdict verdict) {
  return verdict > Verdict::notMeasured;
}

}  // namespace crossgrain::inline support
