// Rows of claims: of which engines and interpretations, what they rest on, and the claims of
// collisions and of the model.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "cases/loader.hpp"
#include "claims_world.hpp"
#include "continuum/cosserat.hpp"

namespace crossgrain::test {
namespace {

std::vector<ClaimRow> judged(const ThesisResults& results) {
  return judgeClaims(results, shippedRules());
}

/// A world whose cases say what their case is, the law with it.
ThesisResults worldWithLaw() {
  ThesisResults results = world(1);
  const auto cases = std::filesystem::path(CROSSGRAIN_CASES);
  const Case whole = loadCase(cases / "couette/nu-0.804.toml").front();
  for (ThesisCase& setup : results.cases) setup.caseToml = whole.resolvedToml;
  return results;
}

/// The value of a figure of a claim by its name.
std::optional<double> figureOf(const ClaimRow& row, const std::string& name) {
  return std::ranges::find(row.figures, name, &ClaimFigure::name)->value;
}

void replaceIn(std::string& text, const std::string& part, const std::string& with) {
  const auto at = text.find(part);
  ASSERT_NE(at, std::string::npos) << text;
  text.replace(at, part.size(), with);
}

TEST(ClaimRows, EveryEngineWithRuns_HasARowForEachClaim) {
  ThesisResults results = world(1);
  const std::size_t before = results.runs.size();
  for (std::size_t k = 0; k < before; ++k) {
    results.runs.push_back(results.runs[k]);
    results.runs.back().engine = "other";
  }
  std::set<std::string> here, there, nowhere;
  for (const ClaimRow& row : judged(results))
    (row.engine == "engine" ? here : row.engine == "other" ? there : nowhere).insert(row.id);
  EXPECT_EQ(here.size(), 25u);
  EXPECT_EQ(there, here);
  EXPECT_EQ(nowhere, (std::set<std::string>{"C1", "C2"}));
}

TEST(ClaimRows, NoRunsOrFailedOnes_AreUndecidedForEveryClaimThatCanBeTested) {
  const std::set<std::string> untestable = {"C1", "C25"};
  ThesisResults failed = world(1);
  for (ThesisRun& run : failed.runs) run.run.status = Status::failed;
  for (const ThesisResults& results : {ThesisResults(), failed}) {
    std::set<std::string> all;
    for (const ClaimRow& row : judged(results)) {
      all.insert(row.id);
      EXPECT_EQ(row.verdict,
                untestable.contains(row.id) ? Verdict::notApplicable : Verdict::undecided)
          << row.id;
      EXPECT_FALSE(row.why.empty() || row.figures.empty()) << row.id;
    }
    EXPECT_EQ(all.size(), 27u);
  }
}

// 1.5 days over today's CPU time was "reproduced" or "refuted", as machines and programs are today.
TEST(ClaimRows, CostIn2003_CannotBeTestedByAnyRun) {
  ThesisResults results = world();
  for (const double slower : {1.0, 50.0, 1e-4}) {
    changeAll(results,
              [&](ThesisRun& run, const ThesisCase&) { run.run.stats->cpuSeconds *= slower; });
    const ClaimRow row = rowOf(judged(results), "C25");
    EXPECT_EQ(row.verdict, Verdict::notApplicable) << row.why;
    EXPECT_TRUE(row.why.starts_with("cannot be tested: 1.5 days over")) << row.why;
    EXPECT_TRUE(figureOf(row, "CPU hours a rotation at 0.1 /s"));  // it is reported all the same
  }
}

TEST(ClaimRows, AcceptedMirror_AddsPackingsToItsPeer) {
  ThesisResults results = world(3);
  for (ThesisRun& run : results.runs) run.engine = run.packing == 0 ? "engine" : "mirror";
  results.surrogates.push_back({"engine", "mirror", true, {}, 3, ""});
  const std::vector<ClaimRow> rows = judged(results);
  EXPECT_FALSE(
      std::ranges::any_of(rows, [](const ClaimRow& row) { return row.engine == "mirror"; }));
  EXPECT_EQ(rowOf(rows, "C5").mirror, "mirror");
  EXPECT_EQ(rowOf(rows, "C5").why, rowOf(judged(world(3)), "C5").why);
  results.surrogates.front().accepted = false;
  EXPECT_TRUE(std::ranges::any_of(judged(results), [](const ClaimRow& row) {
    return row.engine == "mirror" && row.mirror.empty();
  }));
}

TEST(ClaimRows, FirstFigure_IsTheRulesFirst) {
  const ClaimRow row = rowOf(judged(world()), "C5");
  EXPECT_EQ(row.figures.front().name, "C⁻¹");
  EXPECT_EQ(row.figures.front().low, 4.0);
  EXPECT_NEAR(row.figures.front().value.value(), 5.5, 0.1);
  EXPECT_TRUE(row.figures.front().standardError);
  EXPECT_EQ(row.plot, "figure 6.5");
}

TEST(ClaimRows, OtherInterpretation_HasRowsOfItsOwn) {
  const std::vector<ClaimRow> rows = judged(world());
  EXPECT_EQ(rowOf(rows, "C5", "wall spacing 7 mm").cases, std::vector<std::string>{"spacing-7mm"});
  EXPECT_FALSE(std::ranges::any_of(rows, [](const ClaimRow& row) {
    return row.id == "C3" && row.interpretation.starts_with("wall spacing");
  }));
  const std::vector<std::string> cases = rowOf(rows, "C5").cases;
  EXPECT_EQ(std::ranges::find(cases, "spacing-7mm"), cases.end());
}

TEST(ClaimRows, OtherMassesAndRadiiWithoutRuns_HaveNoRows) {
  ThesisResults results = worldWithLaw();
  ThesisCase light = worldCase(table32[8], "light", "mass"),
             wide = worldCase(table32[8], "wide", "radius");
  light.caseToml = wide.caseToml = results.cases.front().caseToml;
  replaceIn(light.caseToml, "large_mass = 0.00049", "large_mass = 0.000404");
  wide.cell.smallRadius = 0.00371;
  results.cases.push_back(light);
  results.cases.push_back(wide);
  const std::vector<Interpretation> interpretations = interpretationsOf(results);
  std::vector<std::string> words;
  for (const Interpretation& each : interpretations) words.push_back(each.label);
  EXPECT_EQ(words, (std::vector<std::string>{
                       "default: wall spacing 2.5 mm, large mass 0.49 g, small radius 3.7 mm, "
                       "Ω = 0.1 /s",
                       "wall spacing 7 mm", "large mass 0.404 g", "small radius 3.71 mm"}));
  EXPECT_FALSE(std::ranges::any_of(judged(results), [](const ClaimRow& row) {
    return row.interpretation.starts_with("large mass");
  }));
}

TEST(ClaimRows, OneRun_IsJudgedByTheErrorWithinIt) {
  ThesisResults results = world(1);
  std::erase_if(results.runs, [](const ThesisRun& run) {
    return run.setup.starts_with("nu-") && run.setup != "nu-0.804-410";
  });
  const ClaimRow row = rowOf(judged(results), "C5");
  EXPECT_NE(row.why.find("the error is within it"), std::string::npos) << row.why;
  EXPECT_EQ(row.cases, std::vector<std::string>{"nu-0.804-410"});
}

TEST(ClaimRows, OneRunFarOff_IsUndecidedWithTheNumberOfRunsNeeded) {
  ThesisResults results = world();
  changeOne(results,
            [](ThesisRun& run, const ThesisCase&) { setFit(run, "dilation_decay", 0.03); });
  const ClaimRow row = rowOf(judged(results), "C5");
  EXPECT_EQ(row.verdict, Verdict::undecided) << row.why;
  EXPECT_NE(row.why.find("runs would"), std::string::npos) << row.why;
}

TEST(ClaimRows, RunsThatDoNotCarry_AreLeftOut) {
  ThesisResults results = world();
  changeOne(results, [](ThesisRun& run, const ThesisCase&) {
    scaleField(run, "stress_pp", 100.0);
    run.run.regime->wheelContacts = 0.2;
  });
  EXPECT_EQ(rowOf(judged(results), "C15").verdict, Verdict::pass);
  changeOne(results,
            [](ThesisRun& run, const ThesisCase&) { run.run.regime->wheelContacts = 2.0; });
  EXPECT_NE(rowOf(judged(results), "C15").verdict, Verdict::pass);
}

// One seed gives one packing: two cases that follow it for different times are one sample.
TEST(ClaimRows, PackingOfTwoCases_CountsOnce) {
  ThesisResults results = world();
  const ClaimRow before = rowOf(judged(results), "C6");
  ThesisCase longer = results.cases[8];
  longer.name = "time-0.804";
  longer.families = {"time"};
  results.cases.push_back(longer);
  for (int packing = 0; packing < 3; ++packing) results.runs.push_back(worldRun(longer, packing));
  const ClaimRow after = rowOf(judged(results), "C6");
  EXPECT_EQ(before.figures.front().standardError, after.figures.front().standardError);
}

TEST(ClaimRows, CriticalDensity_DependsOnTime) {
  const ClaimRow row = rowOf(judged(world()), "C6");
  EXPECT_FALSE(figureOf(row, "critical ν̄ after 1 rotation"));  // all carry
  EXPECT_NEAR(figureOf(row, "share of packings that carry after 1 rotation").value(), 1.0, 1e-12);
  EXPECT_NEAR(figureOf(row, "critical ν̄ after 20 rotations").value(), 0.793, 0.0015);
  EXPECT_LT(figureOf(row, "share of packings that carry after 20 rotations").value(), 0.9);
}

TEST(ClaimsOfCollisions, PrintedLaws_OnlyASpringReverses) {
  const std::vector<ClaimRow> rows = judged(worldWithLaw());
  const ClaimRow printed = rowOf(rows, "C1", "tension allowed"),
                 cut = rowOf(rows, "C1", "tension cut");
  EXPECT_LT(figureOf(printed, "lowest Ψ_f of the spring").value(), -0.4);  // facts: −0.47
  EXPECT_GT(figureOf(printed, "lowest Ψ_f of Coulomb's law").value(), -1e-6);
  // Facts: the constant is 1.770 with the bound µ max(f_n, 0), tension or not; 3(1 + e_n)µ is that
  // of a cut law (e_n = 0.3408) and 1.613 of one with tension (0.2223).
  EXPECT_NEAR(figureOf(printed, "Ψ_f less the asymptote, Coulomb's law").value(), 1.613 - 1.770,
              0.002);
  EXPECT_NEAR(figureOf(cut, "Ψ_f less the asymptote, Coulomb's law").value(), 0.0, 0.002);
  // Figure 4.3 has Ψ_i up to 4 on an axis that ends at Ψ_f = 1.5: it is not of these constants.
  for (const ClaimRow& row : {printed, cut}) {
    EXPECT_EQ(row.verdict, Verdict::notApplicable) << row.why;
    EXPECT_TRUE(row.why.starts_with("reproduced: lowest Ψ_f of the spring")) << row.why;
    EXPECT_NE(row.why.find("cannot be tested: Ψ_f less the asymptote, Coulomb's law is"),
              std::string::npos)
        << row.why;
    EXPECT_NE(row.why.find("the axis of figure 4.3 ends at Ψ_f = 1.5"), std::string::npos);
  }
}

TEST(ClaimsOfCollisions, WithoutFriction_Refuted) {
  ThesisResults results = worldWithLaw();
  for (ThesisCase& setup : results.cases) replaceIn(setup.caseToml, "mu = 0.44", "mu = 1e-9");
  const ClaimRow row = rowOf(judged(results), "C1", "tension cut");
  EXPECT_EQ(row.verdict, Verdict::fail) << row.why;
  EXPECT_NE(row.why.find("lowest Ψ_f of the spring"), std::string::npos);
}

TEST(ClaimsOfCollisions, Schemes_DifferAtALongStepOnly) {
  const ClaimRow row = rowOf(judged(worldWithLaw()), "C2", "head-on");
  EXPECT_EQ(row.verdict, Verdict::pass) << row.why;
  ClaimRules rules = shippedRules();
  for (ClaimRule& rule : rules.claims)
    if (rule.id == "C2") rule.numbers.front().value = 5.0;
  EXPECT_EQ(rowOf(judgeClaims(worldWithLaw(), rules), "C2", "head-on").verdict, Verdict::fail);
}

/// What slides on, less the asymptote of a law that cuts tension; and what a spring turns back.
double sliding(double psi) {
  return std::max(0.0, psi - 3.0 * 1.34 * 0.44);
}
double reversing(double psi) {
  return std::max(-0.8 * psi, psi - 3.0 * 1.34 * 0.44);
}

CollisionVariant sweepOf(const std::string& law, const std::function<double(double)>& after) {
  CollisionVariant variant;
  variant.law = {{"tangential", law}, {"tension", "cut"}, {"mu", 0.44}};
  CollisionCurve curve;
  curve.engine = "engine";
  curve.stepsPerContact = 50.0;
  curve.points.columns[QuantityId::psiF].emplace();
  curve.points.columns[QuantityId::en].emplace();
  for (double psi = 0.0; psi < 4.01; psi += 0.5) {
    curve.points.psi.push_back(psi);
    curve.points.columns[QuantityId::psiF]->push_back(after(psi));
    curve.points.columns[QuantityId::en]->push_back(0.34);
  }
  variant.curves = {curve};
  return variant;
}

/// Coulomb's law reverses at the thesis' step and does not at a finer one.
TEST(ClaimsOfCollisions, FinerStepInItsBand_IsTheReason) {
  ThesisResults results;
  CollideResults& collisions = results.collisions.emplace();
  collisions.variants = {sweepOf("coulomb", reversing), sweepOf("viscous", sliding),
                         sweepOf("spring", reversing)};
  for (CollisionVariant& variant : collisions.variants) {
    const bool coulomb = &variant == collisions.variants.data();
    CollisionCurve finer =
        coulomb ? sweepOf("coulomb", sliding).curves.front() : variant.curves.front();
    finer.stepsPerContact = 200.0;
    variant.curves.push_back(finer);
  }
  std::vector<ClaimRow> rows = judgeCollisions(collisions, shippedRules());
  addReasons(results, shippedRules(), {}, rows);
  const ClaimRow row = rowOf(rows, "C1", "tension cut");
  ASSERT_EQ(row.verdict, Verdict::fail);
  EXPECT_EQ(row.reasons,
            (std::vector<std::string>{
                "lowest Ψ_f of Coulomb's law lies in its band at 200 steps per contact (0)."}));
}

TEST(ClaimsOfCollisions, SweepsOfAnEngine_AreJudgedAsTheLaw) {
  CollideResults collisions;
  collisions.variants = {sweepOf("coulomb", sliding), sweepOf("viscous", sliding),
                         sweepOf("spring", reversing)};
  EXPECT_EQ(rowOf(judgeCollisions(collisions, shippedRules()), "C1", "tension cut").verdict,
            Verdict::notApplicable);
  collisions.variants[0] = sweepOf("coulomb", reversing);
  const ClaimRow row = rowOf(judgeCollisions(collisions, shippedRules()), "C1", "tension cut");
  EXPECT_EQ(row.verdict, Verdict::fail) << row.why;
  EXPECT_EQ(rowOf(judgeCollisions(collisions, shippedRules()), "C1", "tension allowed").verdict,
            Verdict::notApplicable);
}

/// Runs whose velocity and spin are those of the model as printed, and whose couple stress decays.
ThesisResults worldOfTheModel() {
  ThesisResults results = world();
  const CosseratSolution model = solveCosserat({}).solution.value();
  changeAll(results, [&](ThesisRun& run, const ThesisCase& setup) {
    const double gap = (setup.cell.outerRadius - setup.cell.innerRadius) / setup.cell.diameter;
    const double scale = 0.004 * (1.0 + 0.01 * run.packing);
    setField(run, setup, "azimuthal_velocity",
             [&](double x) { return scale * model.at(x / gap).u; });
    setField(run, setup, "spin", [&](double x) { return -scale * model.at(x / gap).omega; });
  });
  return results;
}

TEST(ClaimOfTheModel, RunsThatFollowIt_AreReproduced) {
  const ClaimRow row = rowOf(judged(worldOfTheModel()), "C24");
  EXPECT_EQ(row.verdict, Verdict::pass) << row.why;
  // Facts, section 4: m(0) = 0.21358, m(1) = 0.23443.
  const auto couple = std::ranges::find(row.figures, "model_couple", &ClaimFigure::key);
  EXPECT_NEAR(couple->value.value(), 0.23443 / 0.21358, 1e-4);
}

TEST(ClaimOfTheModel, RunsThatDecayMoreSlowly_AreRefuted) {
  ThesisResults results = worldOfTheModel();
  changeAll(results, [](ThesisRun& run, const ThesisCase&) {
    for (std::size_t ring = 0; ring < worldRings; ++ring) {
      double& v = *fieldAt(run, "azimuthal_velocity", ring);
      v = std::pow(v, 0.25);
    }
  });
  const ClaimRow row = rowOf(judged(results), "C24");
  EXPECT_EQ(row.verdict, Verdict::fail);
  EXPECT_NE(row.why.find("rms of ln(u/v_φ)"), std::string::npos) << row.why;
}

}  // namespace
}  // namespace crossgrain::test
