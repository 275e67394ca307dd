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

/// Values that a variant is swept over, of the points of a table, and their name on an axis,
/// "orientation [°]".
const std::vector<double>& axisOf(const CollisionVariant& variant, const CollisionTable& table);
const char* axisWords(const CollisionVariant& variant);

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
/// Of convex bodies: how each impact goes, and what it ends in; no rows of others.
Table kindTable(const CaseGroup& group);

/// A difference of one quantity of an engine's sweep from the in-house engine's, and its causes,
/// where it is largest.
struct WorstDifference {
  const CollisionVariant* variant;
  const CollisionCurve* curve;
  QuantityId quantity;
  std::size_t point;  ///< of the sweep
  double limits;      ///< size in limits; without one in the unit of the quantity's errors
};

/// Of one quantity of a curve of that variant; absent where it has no causes of it, or no
/// difference.
std::optional<WorstDifference> worstDifference(const CollisionVariant* variant,
                                               const CollisionCurve& curve, QuantityId quantity);

/// Of all quantities of all curves, sweep by sweep.
std::vector<WorstDifference> differencesIn(const std::vector<const CollisionVariant*>& variants);
/// Of each engine the largest in limits, the largest first.
std::vector<WorstDifference> largestOfEngines(std::vector<WorstDifference> all);

/// The largest cause in words, "spring update".
std::string largestCause(const WorstDifference& worst);

/// "tangential rebound Ψ_f of mine is 0.14 lower than grain's at Ψ_i = 0.35: spring update 0.139,
/// …"
/// @param place    of the sweep; empty: not said
/// @param isFirst  of some: it says what the in-house engine is there
std::string differenceSentence(const WorstDifference& worst, const std::string& place,
                               bool isFirst);

/// Causes of what engines' sweeps of a case differ by: of each engine where it differs most in
/// limits, or all: a row for each quantity of each engine and variant.
Table causesTable(const CaseGroup& group, bool all);
/// Laws that are not those declared, and what is not attributed; or what acts on each other.
Names causesNotes(const CaseGroup& group, bool ofInteractions);

/// Ψ_i, the difference and its parts: causes.csv.
std::string causesCsv(const CollideResults& results);

/// Differences as lines over Ψ_i, their parts as stacked bands: a panel for each engine that
/// differs, where it does so most.
Figure causesFigure(const CaseGroup& group, const std::string& name);

}  // namespace crossgrain::reports
