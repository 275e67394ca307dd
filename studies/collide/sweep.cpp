#include "studies/collide/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <map>
#include <numbers>
#include <string>

#include "adapters/declared_law.hpp"
#include "adapters/pair_table.hpp"
#include "adapters/registry.hpp"
#include "cases/time_step.hpp"
#include "law/law_options.hpp"
#include "oracle/collision_end.hpp"
#include "oracle/impact.hpp"
#include "studies/collide/causes.hpp"
#include "studies/collide/collide.hpp"
#include "studies/collide/contact_account.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline studies {

LawDescription describeLaw(const ContactLaw& law) {
  LawDescription words;
  for (const LawOption& option : lawOptions())
    if (mattersTo(law, option.name))
      words[std::string(option.name)] = std::string(option.values[option.get(law)]);
  const PairCoefficients has = coefficientsOf(law);
  const std::pair<const char*, double> constants[] = {
      {"kn", has.kn}, {"gn", has.gn}, {"kt", has.kt}, {"gt", has.gt}, {"mu", has.mu}};
  for (const auto& [name, value] : constants)
    if (value > 0.0) words[name] = value;
  for (const LawConstant& constant : lawConstants())
    if (constant.part != LawPart::contact && hasPart(law, constant.part) &&
        law.*constant.value > 0.0)
      words[std::string(constant.name)] = law.*constant.value;
  if (!law.soft()) words["e_n"] = law.en;
  if (!law.soft() && has.mu > 0.0) words["e_t0"] = law.et0;
  if (law.normal == NormalLaw::polynomial) words["kn3"] = law.kn3;
  return words;
}

LawDescription lawDifference(const ContactLaw& law, const ContactLaw& from) {
  const LawDescription before = describeLaw(from);
  LawDescription difference = describeLaw(law);
  std::erase_if(difference, [&](const auto& word) {
    const auto found = before.find(word.first);
    return found != before.end() && found->second == word.second;
  });
  // Another normal law has constants of its own; where it is the same one, what is gone is 0.
  if (law.normal != from.normal) return difference;
  for (const auto& [name, value] : before)
    if (std::holds_alternative<double>(value) && !describeLaw(law).contains(name))
      difference[name] = 0.0;
  return difference;
}

namespace {

/// The case's margin of Ψ_f [-]; absent without one.
std::optional<double> marginOfPsi(const Case& setup, const OracleCurve& oracle) {
  const auto margin = collisionIn(setup).margins.find("psi_f");
  if (margin == collisionIn(setup).margins.end()) return std::nullopt;
  if (!margin->second.relative) return margin->second.value;
  std::vector<double> psi;
  for (const auto& end : oracle.ends)
    if (end && end->parted) psi.push_back(end->psi);
  return margin->second.value * errorUnit(psi, oracleIsGoodTo).value;
}

/// Margins by which Ψ_f moves at a jump at least.
constexpr double steepest = 3.0;

/// Where Ψ_f moves by more than three margins while Ψ_i moves by one. Sticking and sliding move it
/// by one at most; the rest is room for what is steep but smooth in between.
void findJumps(const Case& setup, const std::vector<CollisionStart>& starts, OracleCurve& oracle) {
  const auto margin = marginOfPsi(setup, oracle);
  const bool springs = setup.law.springs() || setup.law.rolling == RollingLaw::spring;
  if (!margin || !springs || !setup.law.soft()) return;
  for (std::size_t k = 0; k < starts.size(); ++k) {
    throwIfInterrupted();
    if (!oracle.ends[k] || !oracle.ends[k]->parted || !oracle.unsure[k].empty()) continue;
    for (const double side : {-1.0, 1.0}) {
      CollisionStart beside = starts[k];
      beside.psi += side * *margin;
      try {
        const CollisionEnd end = oracleOutcome(setup.law, collidingPair(setup), beside);
        const double there = end.parted ? end.psi : std::numeric_limits<double>::infinity();
        if (std::abs(there - oracle.ends[k]->psi) > steepest * *margin)
          oracle.unsure[k] = fmt::format(
              "the law jumps within the margin of psi_f: psi_f is {:.4g} here and {:.4g} at psi_i "
              "= {:.4g}",
              oracle.ends[k]->psi, there, beside.psi);
      } catch (const std::invalid_argument&) {  // nothing is known beside it
      }
    }
  }
}

}  // namespace

OracleCurve oracleCurve(const Case& setup, const std::vector<CollisionStart>& starts) {
  OracleCurve curve;
  for (const CollisionStart& start : starts) {
    throwIfInterrupted();
    std::string& unsure = curve.unsure.emplace_back();
    try {
      if (collisionIn(setup).isConvex()) {
        const ConvexOutcomes& of = curve.convex.emplace_back(convexOutcomes(setup, start));
        curve.ends.push_back(of.newton ? of.newton : of.poisson);
        if (!of.judged) unsure = "Newton's, Poisson's and Stronge's restitution differ";
        continue;
      }
      const CollisionEnd end = oracleOutcome(setup.law, collidingPair(setup), start);
      curve.ends.emplace_back(end);
      if (end.noLimit)
        unsure = jumpsAtTouch(setup.law, collidingPair(setup), start)
                     ? "no limit of small time steps: the law jumps at this psi_i = mu gn/gt, "
                       "sticking from the first touch on, and slipping, end elsewhere"
                     : "no limit of small time steps: a slip ends while its bound falls, and the "
                       "outcome goes on varying with log(dt), however small dt is";
    } catch (const std::exception& none) {
      curve.ends.emplace_back();
      unsure = curve.reason = none.what();
    }
  }
  findJumps(setup, starts, curve);
  return curve;
}

OracleCurve atStep(OracleCurve oracle, const Case& setup, const std::vector<CollisionStart>& starts,
                   double dt) {
  const auto margin = marginOfPsi(setup, oracle);
  if (!margin) return oracle;
  for (std::size_t k = 0; k < starts.size(); ++k) {
    throwIfInterrupted();
    if (!oracle.ends[k] || !oracle.ends[k]->parted || !oracle.unsure[k].empty() ||
        !stepMissesSlip(setup.law, collidingPair(setup), starts[k], dt))
      continue;
    CollisionStart late = starts[k];
    late.late = dt;
    const double here = oracle.ends[k]->psi;
    const double there = oracleOutcome(setup.law, collidingPair(setup), late).psi;
    if (std::abs(there - here) > steepest * *margin)
      oracle.unsure[k] = fmt::format(
          "beside the law's jump at psi_i = mu gn/gt: it slips from the first touch on, psi_f "
          "{:.4g}; "
          "evaluated first within a step of {:.3g} s it sticks, psi_f {:.4g}",
          here, dt, there);
  }
  return oracle;
}

const OracleCurve& DeclaredOracles::of(const Case& setup,
                                       const std::vector<CollisionStart>& starts) {
  const auto found =
      std::ranges::find(known_, setup.law, [](const auto& one) { return one.first; });
  if (found != known_.end()) return *found->second;
  known_.emplace_back(setup.law, std::make_unique<OracleCurve>(oracleCurve(setup, starts)));
  return *known_.back().second;
}

namespace {

/// To nine digits.
double shortened(double value) {
  return std::strtod(fmt::format("{:.9g}", value).c_str(), nullptr);
}

/// As files have it; absent where no outcome has the quantity.
std::optional<std::vector<std::optional<double>>> columnOf(const CollisionQuantity& quantity,
                                                           const Outcomes& outcomes) {
  std::vector<std::optional<double>> column;
  for (const auto& outcome : outcomes) {
    auto value = outcome ? quantity.valueOf(*outcome) : std::nullopt;
    if (value && quantity.inFiles == CollisionQuantity::InFiles::nineDigits)
      value = shortened(*value);
    column.push_back(value);
  }
  if (std::ranges::none_of(column, [](const auto& value) { return bool(value); }))
    return std::nullopt;
  return column;
}

}  // namespace

CollisionTable tableOf(const std::vector<CollisionStart>& starts, const Outcomes& outcomes,
                       bool convex) {
  CollisionTable table;
  for (const CollisionStart& start : starts) {
    table.psi.push_back(start.psi);
    table.vn.push_back(start.vn);
  }
  if (convex)
    for (const CollisionStart& start : starts) {
      table.orientation.push_back(shortened(start.orientation * 180.0 / std::numbers::pi));
      table.spin.push_back(start.spin);
    }
  for (const CollisionQuantity& quantity : collisionQuantities())
    if (quantity.inFiles != CollisionQuantity::InFiles::no)
      table.columns[quantity.id] = columnOf(quantity, outcomes);
  const auto noLimit = [](const auto& outcome) { return outcome && outcome->end.noLimit; };
  if (std::ranges::any_of(outcomes, noLimit))
    for (const auto& outcome : outcomes) table.noLimit.push_back(noLimit(outcome));
  return table;
}

double sweepEnd(const Case& setup, double dt, double engineStep) {
  const double contact = impactTimes(setup).longest;
  // One that coheres is over when the oracle says so, too.
  const double contacts = setup.law.coheres() ? longestContact : 2.5;
  return dt + contacts * contact + 20.0 * engineStep;
}

Outcomes outcomesOf(const OracleCurve& oracle) {
  Outcomes outcomes;
  for (const auto& end : oracle.ends)
    outcomes.push_back(end ? std::optional(outcomeOf(*end)) : std::nullopt);
  return outcomes;
}

Outcomes referenceOf(const OracleCurve& oracle) {
  Outcomes outcomes = outcomesOf(oracle);
  for (std::size_t k = 0; k < outcomes.size(); ++k)
    if (!oracle.unsure[k].empty()) outcomes[k].reset();
  return outcomes;
}

namespace {

/// Reads a pair's flight after the collision. @param under  the scene with the engine's own
/// law: where a bond lets go is a convention
std::optional<CollisionEnd> endOfPair(const Case&, const Scene& under, const Snapshot& after,
                                      std::size_t pair, const CollisionStart& start) {
  return collisionEnd(under, after, pair, start);
}
std::optional<CollisionEnd> endOfPair(const Case& setup, const SpaceScene& under,
                                      const SpaceSnapshot& after, std::size_t pair,
                                      const CollisionStart& start) {
  return collisionEnd(under, after, pair, start, turnOf(setup));
}

/// The sweep's outcomes; those of a run that is watched also with overlaps and work.
/// @param law  as the engine runs it
template <int D>
Outcomes runOutcomes(Engine& engine, const Capabilities& can, const Case& setup,
                     const SceneOf<D>& scene, const ContactLaw& law,
                     const EffectiveParameters& effective,
                     const std::vector<CollisionStart>& starts, bool watch) {
  const double end = sweepEnd(setup, scene.dt, effective.dt);
  const ContactRecording<D> watched{scene, collidingPair(setup), law, effective, can.slidingFlags};
  std::vector<std::optional<ContactAccount>> accounts(starts.size());
  const bool convex = collisionIn(setup).isConvex();
  if (watch && can.instantContacts && !convex)
    accounts = recordContacts(engine, watched, end);
  else
    engine.advance(end);
  SceneOf<D> under = scene;
  under.law = law;
  const SnapshotOf<D> after = snapshotOf<D>(engine, ContactReport::none);
  Outcomes outcomes;
  for (std::size_t k = 0; k < starts.size(); ++k) {
    const auto parted = convex ? convexEndOf<D>(setup, after, k, starts[k])
                               : endOfPair(setup, under, after, k, starts[k]);
    outcomes.push_back(parted ? std::optional(CollisionOutcome{*parted, {}}) : std::nullopt);
    if (!parted || !accounts[k]) continue;
    outcomes[k]->end.maxOverlap = accounts[k]->maxOverlap;
    outcomes[k]->end.lost = accounts[k]->split;
    outcomes[k]->work = accounts[k]->work;
  }
  return outcomes;
}

}  // namespace

template <int D>
Outcomes inHouseOutcomes(const Case& setup, SceneOf<D> scene,
                         const std::vector<CollisionStart>& starts, bool watch) {
  const auto engine = engineRegistry().front().make();
  scene.precision = Precision::float64;
  const EffectiveParameters effective = loadOn(*engine, scene, {});
  return runOutcomes(*engine, engine->capabilities(), setup, scene, scene.law, effective, starts,
                     watch);
}
template Outcomes inHouseOutcomes(const Case&, Scene, const std::vector<CollisionStart>&, bool);
template Outcomes inHouseOutcomes(const Case&, SpaceScene, const std::vector<CollisionStart>&,
                                  bool);

namespace {

/// The same under the law that another engine declares, at the step that it takes.
template <int D>
Outcomes mirrorOutcomes(const Case& setup, const SceneOf<D>& asRun, const ContactLaw& law,
                        double dt, const std::vector<CollisionStart>& starts, bool watch) {
  SceneOf<D> scene = asRun;
  scene.law = law;
  scene.dt = dt;
  return inHouseOutcomes(setup, std::move(scene), starts, watch);
}

/// More than any outcome differs by, of the speed of approach; files have no infinity.
constexpr double anything = 1e9;

/// Places x that are kept in single precision are rounded by u |x| in each step, u = 2⁻²⁴, and what
/// moves at one velocity always to one side. The two of a pair then part from their velocities by
/// w = 2 u |x|/dt at most, which e_n v_n is slowest to outweigh: e_n is off by (1 + e_n) w/v_n, Ψ_f
/// by K µ times that (K µ = 1.3 for the thesis' disks), and a duration, which is known from 2.5 t_c
/// of flight, by 2.5 w/(e_n v_n) of t_c. 4 w/(e_n v_n) has room for all of these.
/// @returns it [-]; absent in double precision
template <int D>
std::optional<double> roundingOfPlaces(const SceneOf<D>& scene,
                                       const EffectiveParameters& effective,
                                       const std::vector<CollisionStart>& starts,
                                       const Outcomes& oracle) {
  if (effective.precision != toString(Precision::float32)) return std::nullopt;
  double farthest = 0.0, slowest = std::numeric_limits<double>::infinity();
  for (const auto& place : scene.disks.position)
    farthest = std::max(farthest, place.template lpNorm<Eigen::Infinity>());
  for (std::size_t k = 0; k < starts.size(); ++k)
    if (oracle[k] && oracle[k]->end.parted)
      slowest = std::min(slowest, oracle[k]->end.en * starts[k].vn);
  return 4.0 * std::numeric_limits<float>::epsilon() * farthest / (effective.dt * slowest);
}

/// One engine's curve and how it came about.
template <int D>
struct SweptCurve {
  const Case& setup;
  const std::vector<CollisionStart>& starts;
  const SceneOf<D>& asRun;
  const EffectiveParameters& effective;
  const Outcomes& found;
  bool watch;
  double step;              ///< that references are taken for: atStep() [s]
  const CurveScore& score;  ///< against the scene's law; also has what rounding does
};

/// Against the oracle. Integrator, damping velocity and spring update are conventions that no
/// solution in continuous time has, and others have no limit of small steps at all: where the curve
/// is short of the oracle, or there is none, the in-house engine decides, with the same conventions
/// at the same step. Absent where it is the scene's law.
template <int D>
std::optional<DeclaredScore> scoreDeclared(const SweptCurve<D>& swept, const EngineEntry& entry,
                                           const std::optional<ContactLaw>& law,
                                           DeclaredOracles& oracles) {
  DeclaredScore score;
  if (!law) {
    score.oracleReason = "it has another normal law, whose constants it does not report";
    return score;
  }
  score.law = lawDifference(*law, swept.setup.law);
  if (score.law.empty()) return std::nullopt;
  const bool convex = collisionIn(swept.setup).isConvex();
  if (convex && law->soft()) {
    score.oracleReason = "impacts of convex bodies have an oracle under rigid laws alone";
    return score;
  }
  Case declared = swept.setup;
  declared.law = *law;
  const OracleCurve oracle =
      atStep(oracles.of(declared, swept.starts), declared, swept.starts, swept.step);
  score.oracleReason = oracle.reason;
  const Outcomes reference = referenceOf(oracle);
  const bool known = mostAreKnown(reference);
  if (known) {
    score.reference = DeclaredReference::oracle;
    score.score = scoreSweep(declared, swept.starts, swept.found, reference, &swept.score,
                             swept.score.rounding);
    if (score.score.verdict != Verdict::fail) return score;
  }
  if (!entry.mirrors.empty()) {  // it would be compared with itself
    if (!known) score.reference = DeclaredReference::itself;
    return score;
  }
  if (!law->soft()) return score;
  // A force that jumps between steps has no limit, and rounding decides where it jumps.
  const bool jumps = !known && swept.score.rounding;
  CurveScore beside = scoreSweep(
      declared, swept.starts, swept.found,
      mirrorOutcomes(declared, swept.asRun, *law, swept.effective.dt, swept.starts, swept.watch),
      &swept.score, jumps ? anything : swept.score.rounding);
  if (known && beside.verdict != Verdict::pass) return score;
  score.reference = DeclaredReference::mirror;
  score.score = std::move(beside);
  return score;
}

/// Of a curve that fails at this step and not at a smaller one: quantities in which the
/// in-house engine is beyond the limit too, under the same law in the same steps, and the engine
/// within it of that one, are not judged. @returns whether that leaves nothing beyond a limit
template <int D>
bool leavesItToTheStep(const SweptCurve<D>& swept, const Outcomes& reference, CurveScore& score) {
  const Outcomes mirror = mirrorOutcomes(swept.setup, swept.asRun, swept.asRun.law,
                                         swept.effective.dt, swept.starts, swept.watch);
  const CurveScore ofMirror = scoreSweep(swept.setup, swept.starts, mirror, reference, &score);
  const CurveScore beside = scoreSweep(swept.setup, swept.starts, swept.found, mirror, &score);
  bool beyond = false;
  for (const CollisionQuantity& quantity : scoredQuantities()) {
    auto& one = score.of[quantity.id];
    if (!one || one->held != false) continue;
    const auto &steps = ofMirror.of[quantity.id], &left = beside.of[quantity.id];
    if (steps && steps->held == false && left && left->held == true)
      one->held.reset();
    else
      beyond = true;
  }
  if (!beyond) score.verdict = Verdict::notMeasured;
  return !beyond;
}

/// The scene as an engine declares to run it.
template <int D>
SceneOf<D> peerScene(SceneOf<D> asRun, const ContactLaw& law,
                     const EffectiveParameters& effective) {
  asRun.law = law;
  asRun.dt = effective.dt;
  return asRun;
}

template <int D>
CollisionCurve sweepIn(Engine& engine, const EngineEntry& entry, const Case& setup, double dt,
                       const std::vector<CollisionStart>& starts, const OracleCurve& limit,
                       bool watch, DeclaredOracles* declared, bool passesFiner) {
  const SceneOf<D> scene = sweepScene<D>(setup, starts, dt);
  const EffectiveParameters effective = loadScene(engine, entry, setup, scene);
  const Capabilities can = engine.capabilities();
  const SceneOf<D> asRun = sceneFor(can, entry, setup, scene).scene;
  const Outcomes found =
      runOutcomes(engine, can, setup, scene, asRun.law, effective, starts, watch);
  CollisionCurve curve;
  curve.engine = entry.name;
  curve.dt = effective.dt;
  const double contact = impactTimes(setup).shortest;  // 0 for rigid disks
  if (contact > 0.0) curve.stepsPerContact = contact / effective.dt;
  // An engine of impulses does not resolve a contact: its steps excuse nothing.
  const double step = std::min(dt, effective.dt);
  const bool convex = collisionIn(setup).isConvex();
  OracleCurve oracle = convex ? limit : atStep(limit, setup, starts, step);
  for (std::size_t k = 0; convex && k < starts.size(); ++k)
    if (oracle.convex[k].freeFlight < sweepEnd(setup, dt, effective.dt))
      oracle.unsure[k] = "in steps of the engine's own a second corner meets too soon";
  int missing = 0;
  std::vector<bool> sticks;
  for (std::size_t k = 0; k < found.size(); ++k) {
    sticks.push_back(oracle.ends[k] && !oracle.ends[k]->parted);
    missing += !found[k] && !sticks[k];
  }
  if (missing > 0)
    curve.reason = fmt::format("{} pairs did not {}", missing, convex ? "meet" : "part");
  curve.effective = effective;
  curve.stats = engine.stats();
  static_cast<CollisionTable&>(curve.points) = tableOf(starts, found, convex);
  curve.points.reason = oracle.unsure;
  if (std::ranges::find(sticks, true) != sticks.end()) curve.points.sticks = sticks;
  const Outcomes reference = referenceOf(oracle);
  if (const auto unknown = std::ranges::count_if(reference, [](const auto& one) { return !one; });
      unknown > 0)
    curve.reason += fmt::format("{}{} of {} points {}", missing > 0 ? "; " : "", unknown,
                                reference.size(), convex ? "are not judged" : "have no reference");
  const auto law = declaredLaw(can, asRun, effective, collidingPair(setup).reducedMass());
  const bool soft = law && law->soft();  // no place enters an impulse
  curve.score =
      scoreSweep(setup, starts, found, reference, nullptr,
                 soft ? roundingOfPlaces<D>(scene, effective, starts, reference) : std::nullopt);
  const SweptCurve<D> swept{setup, starts, asRun, effective, found, watch, step, curve.score};
  if (declared) curve.declared = scoreDeclared(swept, entry, law, *declared);
  if (declared && watch && law && entry.mirrors.empty() && !convex)
    curve.causes = causesOfSweep<D>(setup, starts, scene, peerScene(asRun, *law, effective), found,
                                    curve.score);
  if (passesFiner && soft && !curve.declared && missing == 0 &&
      curve.score.verdict == Verdict::fail && leavesItToTheStep(swept, reference, curve.score))
    curve.reason += fmt::format(
        "{}beyond a limit at this time step, as the in-house engine is under this law, "
        "and within it at a smaller one",
        curve.reason.empty() ? "" : "; ");
  if (const CurveScore& judged = declaredScore(curve); judged.isRounded())
    curve.reason +=
        fmt::format("{}beyond a limit by no more than {} precision can do by rounding places{}",
                    curve.reason.empty() ? "" : "; ", effective.precision,
                    *judged.rounding < anything
                        ? fmt::format(": {:.2g} of the speed of approach", *judged.rounding)
                        : ", which decide where the force of its law jumps between steps");
  return curve;
}

}  // namespace

EffectiveParameters loadSweep(Engine& engine, const EngineEntry& entry, const Case& setup,
                              double dt, const std::vector<CollisionStart>& starts) {
  return inDimensionOf(setup, [&]<int D>() {
    return loadScene(engine, entry, setup, sweepScene<D>(setup, starts, dt));
  });
}

Outcomes sweepOutcomes(Engine& engine, const EngineEntry& entry, const Case& setup, double dt,
                       const std::vector<CollisionStart>& starts) {
  return inDimensionOf(setup, [&]<int D>() {
    const SceneOf<D> scene = sweepScene<D>(setup, starts, dt);
    const EffectiveParameters effective = loadScene(engine, entry, setup, scene);
    const Capabilities can = engine.capabilities();
    const ContactLaw law = sceneFor(can, entry, setup, scene).scene.law;
    return runOutcomes(engine, can, setup, scene, law, effective, starts, /*watch=*/true);
  });
}

CollisionCurve runSweep(Engine& engine, const EngineEntry& entry, const Case& setup, double dt,
                        const std::vector<CollisionStart>& starts, const OracleCurve& limit,
                        bool watch, DeclaredOracles* declared, bool passesFiner) {
  const auto sweep = setup.dimension == 3 ? sweepIn<3> : sweepIn<2>;
  return sweep(engine, entry, setup, dt, starts, limit, watch, declared, passesFiner);
}

}  // namespace crossgrain::inline studies
