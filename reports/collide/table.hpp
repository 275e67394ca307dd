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

/// How a sweep came out.
enum class SweepOutcome { held, fellShort, notJudged, refused, failed };
constexpr auto namesOf(SweepOutcome) {
  return std::array<std::string_view, 5>{"held", "fell short", "not judged", "refused", "failed"};
}
SweepOutcome outcomeOf(const CollisionCurve& curve);

/// How the sweeps of all engines came out.
struct CollideCount {
  int held = 0, fellShort = 0, notJudged = 0, refused = 0, failed = 0;
  int judged() const { return held + fellShort; }
};
CollideCount countOf(const CollideResults& results);

/// Why no sweep was judged, in a clause; empty if one was. Nothing judged is no success.
std::string nothingJudged(const CollideResults& results);

/// A number of a list; absent where it is beyond its end or not finite.
std::optional<double> numberAt(const std::vector<double>& list, std::size_t place);

/// "mu 0.44", "tension cut"; absent for a constant that is not finite.
std::optional<std::string> lawWords(const std::string& option, const LawValue& value);

}  // namespace crossgrain::reports
