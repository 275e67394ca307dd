// Collisions: C1 and C2.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "adapters/law_options.hpp"
#include "cases/loader.hpp"
#include "oracle/collision_oracle.hpp"
#include "oracle/discrete_impact.hpp"
#include "oracle/impact.hpp"
#include "reports/thesis/law_sweeps.hpp"
#include "runs/thesis/claims.hpp"
#include "runs/thesis/claims_judges.hpp"

namespace crossgrain::inline runs {
namespace {

using reports::LawSweep, reports::LawSweeps, reports::Point, reports::lawSweeps;

struct TensionReading {
  Tension tension;
  const char* name;  ///< in case files
  const char* words;
};
constexpr TensionReading tensionReadings[] = {
    {Tension::allow, "allow", "tension allowed, as printed"}, {Tension::cut, "cut", "tension cut"}};

constexpr double largestPsi = 4.0;  // of figure 4.3
constexpr int psiCount = 40;
/// A tenth of the rim's speed at 1 /s: closed forms freeze the normal and err by O(v t_c/a) [m/s].
constexpr double approachSpeed = 0.01;

CollidingPair smallPair(const Case& setup) {
  const Particles& of = setup.particles;
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
      sweep.points.push_back({psi, oracleOutcome(law, pair, {psi, approachSpeed}).psi, {}});
    }
  }
  return sweeps;
}

std::optional<Estimate> lowestOf(const LawSweep& sweep) {
  if (sweep.points.empty()) return std::nullopt;
  return exactly(std::ranges::min(sweep.points, {}, &Point::y).y);
}

/// The largest distance from Ψ_i − 3(1 + e_n)µ beyond that many units of Ψ_i, with its sign.
std::optional<Estimate> offAsymptote(const LawSweep& sweep, double mu, double from) {
  std::optional<double> largest;
  for (const Point& at : sweep.points) {
    if (at.x < from) continue;
    const double off = at.y - (at.x - 3.0 * (1.0 + sweep.en) * mu);
    if (!largest || std::abs(off) > std::abs(*largest)) largest = off;
  }
  if (!largest) return std::nullopt;
  return exactly(*largest);
}

void putSweeps(const LawSweeps& sweeps, double mu, double slidingFrom, Evidence& evidence) {
  for (const char* const law : {"spring", "coulomb", "viscous", "spring_dashpot"}) {
    const auto found = sweeps.find(law);
    const bool known = found != sweeps.end();
    const std::string missing = fmt::format("there is no sweep of the law \"{}\"", law);
    evidence.put(law, known ? lowestOf(found->second) : std::nullopt, missing);
    const std::string sliding = fmt::format("sliding_{}", law);
    if (sliding == "sliding_spring_dashpot") continue;  // figure 4.3 has no such curve
    evidence.put(sliding, known ? offAsymptote(found->second, mu, slidingFrom) : std::nullopt,
                 missing);
  }
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

void putSchemes(const Case& setup, const ClaimRule& rule, Evidence& evidence) {
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
  evidence.put("restitution", exactly(restitution), "");
  evidence.put("duration", exactly(duration), "");
}

constexpr const char* noLaw = "no leg says what the law is";

/// The case of the leg of reference; absent where it says no whole case.
std::optional<Case> referenceCase(const ThesisResults& results) {
  const Reading reference = readingsOf(results).front();
  if (reference.ladder.empty() || reference.ladder.front()->caseToml.empty()) return std::nullopt;
  Case setup;
  setup.resolvedToml = reference.ladder.front()->caseToml;
  return caseWith(setup, "");
}

}  // namespace

std::vector<ClaimRow> judgeCollisionLaws(const ThesisResults& results, const ClaimRules& rules) {
  std::vector<ClaimRow> rows;
  const std::optional<Case> setup = referenceCase(results);
  const auto add = [&](const char* id, const Reading& reading, const auto& judge) {
    const ClaimRule& rule = rules.of(id);
    const ClaimScope scope{results, rules, rule, "-", reading};
    Evidence evidence(scope);
    if (setup) {
      judge(rule, evidence);
    } else {
      for (const ClaimBand& band : rule.figures) evidence.put(band.name, {}, noLaw);
    }
    rows.push_back(evidence.row());
  };
  for (const TensionReading& each : tensionReadings)
    add("C1", {"tension", each.words, {}, {}}, [&](const ClaimRule& rule, Evidence& evidence) {
      ContactLaw law = setup->law;
      law.conventions.tension = each.tension;
      putSweeps(sweepsOf(law, smallPair(*setup)), law.mu, rule.number("sliding_from"), evidence);
    });
  add("C2", {"", "head-on impacts at the thesis' step", {}, {}},
      [&](const ClaimRule& rule, Evidence& evidence) { putSchemes(*setup, rule, evidence); });
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
  const double mu = reports::lawFriction(collisions);
  std::vector<ClaimRow> rows;
  for (const std::string& engine : engines)
    for (const TensionReading& each : tensionReadings) {
      const Reading reading{"tension", each.words, {}, {}};
      const ClaimScope scope{none, rules, rule, engine, reading};
      Evidence evidence(scope);
      putSweeps(lawSweeps(collisions, engine, each.name, steps), mu, rule.number("sliding_from"),
                evidence);
      rows.push_back(evidence.row());
    }
  return rows;
}

}  // namespace crossgrain::inline runs
