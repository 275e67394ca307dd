#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/common/blocks.hpp"
#include "results/collision.hpp"

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
Names shortfalls(const Tally& tally);

/// Table: collisions.csv, one row per collision; a sweep without any is one row with its status,
/// its reason and no numbers. Checks: one for each sweep and quantity that the case has a limit
/// for.
Report reportOf(const CollideResults& results);

/// An engine per row, a group of quantities per column: the largest error as a share of its limit;
/// and who passes, what causes differences, what is next.
Overview collideOverview(const CollideResults& results);

/// collision_1, collision_2, … in the order of the cases, each with its collision_1_energy.
std::vector<Figure> collideFigures(const CollideResults& results);

/// "✗ 3 of 4": how an engine's sweeps in some variants came out.
Verdict stateOf(const Tally& tally);
/// "4 of 24 passed", "refused"
std::string headline(const Tally& tally);

/// The tables of one case: a row per variant; per variant and mirror; per engine and time step.
Table variantTable(const CollideResults& results, const CaseGroup& group);
Table mirrorTable(const CaseGroup& group, const std::vector<EngineRow>& engines);
Table scoreTable(const CaseGroup& group);

}  // namespace crossgrain::reports
