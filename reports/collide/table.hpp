#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "results/collision.hpp"

/// Looking into the results of collisions.
namespace crossgrain::reports {

/// The variants of one case, in the results' order.
struct CaseGroup {
  std::string name;
  std::vector<const CollisionVariant*> variants;
};
std::vector<CaseGroup> casesOf(const CollideResults& results);

/// A variant's own case where the results hold several.
std::string caseOf(const CollideResults& results, const CollisionVariant& variant);

/// An engine's curve of the largest time step that has points; null without one.
const CollisionCurve* coarsestCurve(const CollisionVariant& variant, const std::string& engine);

/// An engine's curves of a variant, by descending time step.
std::vector<const CollisionCurve*> curvesOf(const CollisionVariant& variant,
                                            const std::string& engine);

/// How a sweep came out, by the law that its engine declares and by the scene's.
enum class SweepOutcome {
  held,  ///< passed by both
  /// Failed by the scene's law, passed by its own: conventions that the case lets it have
  modelDifference,
  /// Failed by the law that it declares, or by its own scheme; or by the scene's where its own is
  /// not known
  fellShort,
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

/// How the sweeps of all engines came out, but for mirrors that run beside their peers: they show
/// what a peer should do, and are not judged themselves. One that failed counts as failed.
struct CollideCount {
  int held = 0, modelDifference = 0, fellShort = 0, notJudged = 0, refused = 0, failed = 0;
  int judged() const { return held + modelDifference + fellShort; }
};
CollideCount countOf(const CollideResults& results);

/// Why no sweep was judged, in a clause; empty if one was. Nothing judged is no success.
std::string nothingJudged(const CollideResults& results);

/// "mu 0.44", "tension cut"; absent for a constant that is not finite.
std::optional<std::string> lawWords(const std::string& option, const LawValue& value);

/// A quantity in plain words, its symbol beside them: "restitution e_n".
std::string quantityWords(const CollisionQuantity& quantity);

}  // namespace crossgrain::reports
