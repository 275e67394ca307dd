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

/// "mu 0.44", "tension cut"; absent for a constant that is not finite.
std::optional<std::string> lawWords(const std::string& option, const LawValue& value);

/// A quantity in plain words, its symbol beside them: "restitution e_n".
std::string quantityWords(const CollisionQuantity& quantity);

/// Sweeps of an engine in some variants, by outcome.
struct Tally : SweepCount {
  WorstQuantity worst, worstOfModel;
  std::string refusal, reason;         ///< the first
  std::optional<double> ownDeviation;  ///< the largest
  bool ownPassed = true;
};

Tally tallyOf(const std::vector<const CollisionVariant*>& variants, const std::string& engine);

/// Of sweeps that did not pass: the worst quantities, and the own scheme.
std::vector<std::string> shortfalls(const Tally& tally);

}  // namespace crossgrain::reports
