#include "reports/common/junit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "reports/collide/report.hpp"
#include "reports/collide/table.hpp"
#include "reports/common/numbers.hpp"
#include "results/json_fields.hpp"

namespace crossgrain::reports {

namespace {

using Outcome = JUnitCase::Outcome;

/// By name.
std::vector<CollisionQuantity> sortedQuantities() {
  std::vector<CollisionQuantity> sorted(scoredQuantities().begin(), scoredQuantities().end());
  std::ranges::sort(sorted, {}, &CollisionQuantity::name);
  return sorted;
}

/// Quantities that any sweep of this variant was judged by.
std::vector<QuantityId> judgedQuantities(const CollisionVariant& variant) {
  std::vector<QuantityId> judged;
  for (const CollisionCurve& curve : variant.curves)
    for (const CollisionQuantity& quantity : sortedQuantities())
      if (const auto& score = curve.score.of[quantity.id];
          score && score->limit && std::ranges::find(judged, quantity.id) == judged.end())
        judged.push_back(quantity.id);
  return judged;
}

/// "0.0031 of the range against a limit of 0.001 (why)"
std::string errorOf(const QuantityScore& score) {
  const std::string why = score.why.value_or("");
  return fmt::format(
      "largest error {:.4g}{} against a limit of {:.4g}{}", finite(score.max).value_or(0.0),
      score.unitIs == ErrorUnitKind::absolute ? ""
                                              : fmt::format(" of the {}", nameOf(score.unitIs)),
      score.limit.value_or(0.0), why.empty() ? "" : " (" + why + ")");
}

/// One quantity against one law.
JUnitCase judged(const std::string& name, const std::optional<QuantityScore>& score) {
  JUnitCase one{"", name};
  if (score && score->held) {
    one.outcome = *score->held ? Outcome::passed : Outcome::failed;
    if (one.outcome == Outcome::failed) one.message = errorOf(*score);
  } else {
    one.outcome = Outcome::skipped;
    one.message = "not measured, or not known of the reference";
  }
  return one;
}

/// Whether what a curve is short of the scene's law by is its model's: it holds to the law that it
/// declares, or is that law.
bool isOfTheModel(const DeclaredScore& declared, QuantityId quantity) {
  const auto& own = declared.score.of[quantity];
  return declared.reference == DeclaredReference::itself || (own && own->held == true);
}

/// Against the scene's law; where the engine declares another one, also against that.
std::vector<JUnitCase> judgedSweep(const CollisionCurve& curve, const std::string& sweep,
                                   QuantityId quantity) {
  const std::string name = fmt::format("{}: {}", sweep, collisionQuantity(quantity).name);
  JUnitCase scene = judged(name, curve.score.of[quantity]);
  if (!curve.declared) return {scene};
  const DeclaredScore& declared = *curve.declared;
  if (scene.outcome == Outcome::failed && isOfTheModel(declared, quantity)) {
    scene.outcome = Outcome::skipped;
    scene.message = "model difference: " + scene.message;
  }
  if (declared.reference == DeclaredReference::itself) return {scene};
  return {scene, judged(name + ", declared law", declared.score.of[quantity])};
}

JUnitCase judgedScheme(const SchemeScore& own, const std::string& sweep) {
  JUnitCase one{"", sweep + ": own scheme"};
  const std::string figures = fmt::format("deviates by {:.2g} d and {:.2g} of the speed",
                                          own.position.value_or(0.0), own.velocity.value_or(0.0));
  if (!own.held) {
    one.outcome = Outcome::skipped;
    one.message = figures + ", " + own.reason;
  } else if (!*own.held) {
    one.outcome = Outcome::failed;
    one.message = fmt::format("{} against a limit of {:g}", figures, own.limit.value_or(0.0));
  }
  return one;
}

/// Sweeps that ran; where pairs did not part, that is a failure of its own.
std::vector<JUnitCase> sweepCases(const CollisionVariant& variant, const CollisionCurve& curve) {
  const auto dt = finite(curve.dt);
  const std::string sweep = curve.engine + (dt ? fmt::format(", dt {:.4g} s", *dt) : std::string());
  if (curve.status == SweepStatus::failed) return {{"", sweep, Outcome::error, curve.reason}};
  if (curve.status == SweepStatus::refused)
    return {{"", curve.engine, Outcome::skipped, curve.reason}};
  std::vector<JUnitCase> cases;
  for (const QuantityId quantity : judgedQuantities(variant))
    std::ranges::move(judgedSweep(curve, sweep, quantity), std::back_inserter(cases));
  if (ownDeviation(curve)) cases.push_back(judgedScheme(*curve.ownScheme, sweep));
  if (curve.status == SweepStatus::incomplete)
    cases.push_back({"", sweep + ": all pairs part", Outcome::failed, curve.reason});
  if (cases.empty())
    cases.push_back({"", sweep, Outcome::skipped, "not judged: the case has no limits"});
  cases.front().seconds = junitSeconds(curve.stats);
  return cases;
}

}  // namespace

std::string collideJunit(const CollideResults& results) {
  std::vector<JUnitCase> cases;
  for (const CollisionVariant& variant : results.variants)
    for (const CollisionCurve& curve : variant.curves)
      for (JUnitCase& one : sweepCases(variant, curve)) {
        one.group = junitGroup(variant.name, variant.variant);
        cases.push_back(std::move(one));
      }
  return junitXml("collide", cases);
}

}  // namespace crossgrain::reports
