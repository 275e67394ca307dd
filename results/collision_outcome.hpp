#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "results/collision.hpp"

namespace crossgrain::inline results {

/// How a sweep compares with the law that its engine declares and with the scene's.
enum class SweepOutcome {
  held,  ///< passes both
  /// Fails the scene's law and passes its own: conventions that the case lets it have
  modelDifference,
  /// Fails the law that it declares, or its own scheme; or the scene's, and nothing is known of its
  /// own
  beyondLimits,
  notJudged,
  refused,
  failed
};
constexpr auto namesOf(SweepOutcome) {
  return std::array<std::string_view, 6>{"held",       "model difference", "fell short",
                                         "not judged", "refused",          "failed"};
}
SweepOutcome outcomeOf(const CollisionCurve& curve);

/// The score against the law that the engine declares; the scene's where that is the same, or
/// nothing is known of its own.
const CurveScore& declaredScore(const CollisionCurve& curve);

/// The larger of both deviations; absent where there is no discrete oracle.
std::optional<double> ownDeviation(const CollisionCurve& curve);

/// A mirror that runs because its peer does.
bool runsBesideItsPeer(const CollideResults& results, const std::string& engine);

/// How the sweeps of all engines came out, but for mirrors that run beside their peers: they say
/// what a peer should do, and are not asked themselves. One that failed counts as failed.
struct CollideCount {
  int held = 0, modelDifference = 0, beyondLimits = 0, notJudged = 0, refused = 0, failed = 0;
  int judged() const { return held + modelDifference + beyondLimits; }
};
CollideCount countOf(const CollideResults& results);

/// Why no sweep was judged, in a clause; empty if one was. Nothing judged is no success.
std::string nothingJudged(const CollideResults& results);

}  // namespace crossgrain::inline results
