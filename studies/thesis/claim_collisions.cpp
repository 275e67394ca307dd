// Claims of collisions, C1 and C2: of the law itself in continuous time and by time-stepping
// schemes, and of engines' sweeps.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "law/law_options.hpp"
#include "cases/loader.hpp"
#include "oracle/collision_oracle.hpp"
#include "oracle/discrete_impact.hpp"
#include "oracle/impact.hpp"
#include "results/thesis_runs.hpp"
#include "studies/thesis/claims.hpp"

namespace crossgrain::inline studies {
namespace {

struct TensionChoice {
  Tension tension;
  const char *name, *label;  ///< the first in case files
};
constexpr TensionChoice tensionChoices[] = {
    {Tension::allow, "allow", "tension allowed, as printed"}, {Tension::cut, "cut", "tension cut"}};

constexpr double largestPsi = 4.0;  // of figure 4.3
constexpr int psiCount = 40;
/// A tenth of the rim's speed at 1 /s: closed forms freeze the normal and err by O(v t_c/a) [m/s].
constexpr double approachSpeed = 0.01;

CollidingPair smallPair(const Case& setup) {
  const Particles& of = couetteIn(setup).particles;
  const double inertia = of.inertiaFactor * of.smallMass * of.smallRadius * of.smallRadius;
  return {{of.smallRadius, of.smallRadius}, {of.smallMass, of.smallMass}, {inertia, inertia}};
}

/// In continuous time.
LawSweeps sweepsOf(ContactLaw law, const CollidingPair& pair) {
  LawSweeps sweeps;
  using enum TangentialLaw;
  for (const TangentialLaw tangential : {coulomb, viscous, spring, springDashpot}) {
    law.tangential = tangential;
    LawSweep& sweep = sweeps[std::string(lawOptionValue(law, "tangential"))];
    sweep.en = restitutionOfLinearLaw(law, pair.reducedMass());
    for (int k = 0; k <= psiCount; ++k) {
      const double psi = largestPsi * k / psiCount;
      sweep.points.push_back({psi, oracleOutcome(law, pair, {psi, approachSpeed}).psi});
    }
  }
  return sweeps;
}

/// The largest distance from Ψ_i − 3(1 + e_n)µ beyond that many units of Ψ_i, with its sign.
std::optional<Estimate> distanceFromAsymptote(const LawSweep& sweep, double mu, double from) {
  std::optional<double> largest;
  for (const LawSweep::Point& at : sweep.points) {
    if (at.psi < from) continue;
    const double distance = at.after - (at.psi - 3.0 * (1.0 + sweep.en) * mu);
    if (!largest || std::abs(distance) > std::abs(*largest)) largest = distance;
  }
  if (!largest) return std::nullopt;
  return exactly(*largest);
}

using Found = std::map<std::string, Evidence>;  // by figure

Found ofSweeps(const LawSweeps& sweeps, double mu, double slidingFrom) {
  Found figures;
  for (const std::string law : {"spring", "coulomb", "viscous", "spring_dashpot"}) {
    const auto found = sweeps.find(law);
    const bool known = found != sweeps.end() && !found->second.points.empty();
    const std::string missing = fmt::format("there is no sweep of the law \"{}\"", law);
    figures[law] = {known ? std::optional(exactly(found->second.lowest())) : std::nullopt, missing};
    if (law == "spring_dashpot") continue;  // figure 4.3 has no such curve
    figures["sliding_" + law] = {
        known ? distanceFromAsymptote(found->second, mu, slidingFrom) : std::nullopt, missing};
  }
  return figures;
}

/// A head-on impact by a scheme, averaged over where within a step it begins.
struct SchemeImpact {
  double en = 0.0, duration = 0.0;
};

SchemeImpact impactBy(ContactLaw law, Integrator integrator, double reducedMass, double dt) {
  law.conventions.integrator = integrator;
  constexpr int phases = 20;
  SchemeImpact mean;
  for (int phase = 0; phase < phases; ++phase) {
    const double gap = approachSpeed * dt * (phase + 0.5) / phases;
    const auto steps = static_cast<std::size_t>(3.0 * contactTime(law, reducedMass) / dt);
    const auto motion = discreteImpact(law, {gap, -approachSpeed, reducedMass, dt}, steps);
    const auto touch = std::ranges::find_if(motion, [](const auto& at) { return at.gap < 0.0; });
    const auto apart =
        std::find_if(touch, motion.end(), [](const auto& at) { return at.gap > 0.0; });
    if (apart == motion.end()) return {};  // overdamped: they do not part
    mean.en += apart->halfStep / approachSpeed / phases;
    mean.duration += static_cast<double>(apart - touch) * dt / phases;
  }
  return mean;
}

Found ofSchemes(const Case& setup, const ClaimRule& rule) {
  const double reducedMass = smallPair(setup).reducedMass();
  const double dt = contactTime(setup.law, reducedMass) / rule.number("steps_per_contact");
  const SchemeImpact reference = impactBy(setup.law, Integrator::positionVerlet, reducedMass, dt);
  double restitution = 0.0, duration = 0.0;
  for (const Integrator other : {Integrator::velocityVerlet, Integrator::semiImplicitEuler}) {
    const SchemeImpact impact = impactBy(setup.law, other, reducedMass, dt);
    const double en = impact.en - reference.en;
    const double time = impact.duration / reference.duration - 1.0;
    if (std::abs(en) > std::abs(restitution)) restitution = en;
    if (std::abs(time) > std::abs(duration)) duration = time;
  }
  return {{"restitution", {exactly(restitution)}}, {"duration", {exactly(duration)}}};
}

/// The reference case; absent where nobody says all of it.
std::optional<Case> referenceSetup(const ThesisResults& results) {
  const Interpretation reference = interpretationsOf(results).front();
  if (reference.judged.empty() || reference.judged.front()->caseToml.empty()) return std::nullopt;
  Case setup;
  setup.resolvedToml = reference.judged.front()->caseToml;
  return caseWith(setup, "");
}

}  // namespace

std::vector<ClaimRow> judgeLaw(const ThesisResults& results, const ClaimRules& rules) {
  std::vector<ClaimRow> rows;
  const std::optional<Case> setup = referenceSetup(results);
  const auto add = [&](const char* id, const Interpretation& interpretation, const auto& judge) {
    const ClaimScope scope{results, rules, rules.of(id), "-", interpretation};
    Found found;
    if (setup)
      found = judge(scope.rule);
    else
      for (const ClaimBand& band : scope.rule.figures)
        found[band.name] = {{}, "no case says what the law is"};
    rows.push_back(claimRow(scope, found));
  };
  for (const TensionChoice& each : tensionChoices)
    add("C1", {"tension", each.label, {}, {}}, [&](const ClaimRule& rule) {
      ContactLaw law = setup->law;
      law.conventions.tension = each.tension;
      return ofSweeps(sweepsOf(law, smallPair(*setup)), law.mu, rule.number("sliding_from"));
    });
  add("C2", {"", "head-on impacts at the thesis' step", {}, {}},
      [&](const ClaimRule& rule) { return ofSchemes(*setup, rule); });
  return rows;
}

std::vector<ClaimRow> judgeCollisions(const CollideResults& collisions, const ClaimRules& rules,
                                      std::optional<double> wanted) {
  const ThesisResults none;
  const ClaimRule& rule = rules.of("C1");
  const double steps = wanted.value_or(rules.of("C2").number("steps_per_contact"));
  std::set<std::string> engines;
  for (const CollisionVariant& variant : collisions.variants)
    for (const CollisionCurve& curve : variant.curves) engines.insert(curve.engine);
  std::vector<ClaimRow> rows;
  for (const std::string& engine : engines)
    for (const TensionChoice& each : tensionChoices) {
      const Interpretation interpretation{"tension", each.label, {}, {}};
      const ClaimScope scope{none, rules, rule, engine, interpretation};
      rows.push_back(
          claimRow(scope, ofSweeps(lawSweeps(collisions, engine, each.name, steps),
                                   lawFriction(collisions), rule.number("sliding_from"))));
    }
  return rows;
}

}  // namespace crossgrain::inline studies
