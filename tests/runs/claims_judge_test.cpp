// Rows of claims: of which engines and readings, what they rest on, and the claims of collisions
// and of the model.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "cases/loader.hpp"
#include "claims_world.hpp"
#include "runs/thesis/claims_cosserat.hpp"
#include "runs/thesis/claims_judges.hpp"
#include "runs/thesis/reasons.hpp"

namespace crossgrain::test {
namespace {

std::vector<ClaimRow> judged(const ThesisResults& results) {
  return judgeClaims(results, shippedRules());
}

/// A world whose legs say what their case is, the law with it.
ThesisResults worldWithLaw() {
  ThesisResults results = world(1);
  const auto cases = std::filesystem::path(CROSSGRAIN_CASES);
  const Case setup = loadCase(cases / "couette/nu-0.804.toml").front();
  for (ThesisLeg& leg : results.legs) leg.caseToml = setup.resolvedToml;
  return results;
}

void replaceIn(std::string& text, const std::string& part, const std::string& with) {
  const auto at = text.find(part);
  ASSERT_NE(at, std::string::npos) << text;
  text.replace(at, part.size(), with);
}

TEST(ClaimRows, EveryClaimHasARowForEachEngineThatHasRunsAndForNoneWhereThereAreNone) {
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
  results = ThesisResults();
  std::set<std::string> all;
  for (const ClaimRow& row : judged(results)) {
    all.insert(row.id);
    EXPECT_EQ(row.verdict, ClaimVerdict::undecided) << row.id;
    EXPECT_FALSE(row.why.empty()) << row.id;
    EXPECT_FALSE(row.figures.empty()) << row.id;
  }
  EXPECT_EQ(all.size(), 27u);
}

TEST(ClaimRows, AMirrorThatCarriesAnEngineHasItsPackingsAndNoRowsOfItsOwn) {
  ThesisResults results = world(3);
  for (ThesisRun& run : results.runs) run.engine = run.packing == 0 ? "engine" : "mirror";
  results.carriers.push_back({"engine", "mirror", true, {}, 3, ""});
  const std::vector<ClaimRow> rows = judged(results);
  EXPECT_FALSE(
      std::ranges::any_of(rows, [](const ClaimRow& row) { return row.engine == "mirror"; }));
  EXPECT_EQ(rowOf(rows, "C5").carrier, "mirror");
  EXPECT_EQ(rowOf(rows, "C5").why, rowOf(judged(world(3)), "C5").why);
  results.carriers.front().carries = false;
  EXPECT_TRUE(std::ranges::any_of(judged(results), [](const ClaimRow& row) {
    return row.engine == "mirror" && row.carrier.empty();
  }));
}

TEST(ClaimRows, FirstFigureIsTheOneThatTheRuleNamesFirst) {
  const ClaimRow row = rowOf(judged(world()), "C5");
  EXPECT_EQ(row.figures.front().name, "C⁻¹");
  EXPECT_EQ(row.figures.front().low, 4.0);
  EXPECT_NEAR(row.figures.front().value.value(), 5.5, 0.1);
  EXPECT_TRUE(row.figures.front().standardError);
  EXPECT_EQ(row.plot, "figure 6.5");
}

TEST(ClaimRows, AnotherReadingHasRowsOfItsOwnForClaimsThatItMattersTo) {
  const std::vector<ClaimRow> rows = judged(world());
  EXPECT_EQ(rowOf(rows, "C5", "wall spacing 7 mm").legs, std::vector<std::string>{"spacing-7mm"});
  EXPECT_FALSE(std::ranges::any_of(rows, [](const ClaimRow& row) {
    return row.id == "C3" && row.reading.starts_with("wall spacing");
  }));
  const std::vector<std::string> legs = rowOf(rows, "C5").legs;
  EXPECT_EQ(std::ranges::find(legs, "spacing-7mm"), legs.end());
}

TEST(ClaimRows, LegsOfOtherMassesAndRadiiAreReadingsAndWithoutRunsNone) {
  ThesisResults results = worldWithLaw();
  ThesisLeg light = worldLeg(worldLabels[8], "light", "mass"),
            wide = worldLeg(worldLabels[8], "wide", "radius");
  light.caseToml = wide.caseToml = results.legs.front().caseToml;
  replaceIn(light.caseToml, "large_mass = 0.00049", "large_mass = 0.000404");
  wide.cell.smallRadius = 0.00371;
  results.legs.push_back(light);
  results.legs.push_back(wide);
  const std::vector<Reading> readings = readingsOf(results);
  std::vector<std::string> words;
  for (const Reading& each : readings) words.push_back(each.words);
  EXPECT_EQ(words, (std::vector<std::string>{
                       "default: wall spacing 2.5 mm, large mass 0.49 g, small radius 3.7 mm, "
                       "Ω = 0.1 /s",
                       "wall spacing 7 mm", "large mass 0.404 g", "small radius 3.71 mm"}));
  EXPECT_FALSE(std::ranges::any_of(
      judged(results), [](const ClaimRow& row) { return row.reading.starts_with("large mass"); }));
}

TEST(ClaimRows, OneRunIsJudgedByTheErrorWithinItAndSaysSo) {
  ThesisResults results = world(1);
  std::erase_if(results.runs, [](const ThesisRun& run) {
    return run.leg.starts_with("nu-") && run.leg != "nu-0.804-410";
  });
  const ClaimRow row = rowOf(judged(results), "C5");
  EXPECT_NE(row.why.find("the error is within it"), std::string::npos) << row.why;
  EXPECT_EQ(row.legs, std::vector<std::string>{"nu-0.804-410"});
}

TEST(ClaimRows, OneRunThatIsFarOffLeavesTheClaimOpenAndTellsHowManyWouldDecide) {
  ThesisResults results = world();
  changeOne(results, [](ThesisRun& run, const ThesisLeg&) { setFit(run, "dilation_decay", 0.03); });
  const ClaimRow row = rowOf(judged(results), "C5");
  EXPECT_EQ(row.verdict, ClaimVerdict::undecided) << row.why;
  EXPECT_NE(row.why.find("runs would"), std::string::npos) << row.why;
}

TEST(ClaimRows, RunsThatDoNotCarryAreLeftOutWhereTheRuleSaysSo) {
  ThesisResults results = world();
  changeOne(results, [](ThesisRun& run, const ThesisLeg&) {
    scaleField(run, "stress_pp", 100.0);
    run.run.regime->wheelContacts = 0.2;
  });
  EXPECT_EQ(rowOf(judged(results), "C15").verdict, ClaimVerdict::reproduced);
  changeOne(results, [](ThesisRun& run, const ThesisLeg&) { run.run.regime->wheelContacts = 2.0; });
  EXPECT_NE(rowOf(judged(results), "C15").verdict, ClaimVerdict::reproduced);
}

TEST(ClaimRows, HowManyRunsCouldNotBeFittedIsSaid) {
  ThesisResults results = world();
  changeOne(results, [](ThesisRun& run, const ThesisLeg&) { run.run.fits.clear(); });
  const ClaimRow row = rowOf(judged(results), "C5");
  EXPECT_NE(row.why.find("(25 of 27 runs)"), std::string::npos) << row.why;
}

TEST(ClaimRows, RunsThatFailedAreNone) {
  ThesisResults results = world();
  for (ThesisRun& run : results.runs) run.run.status = RunStatus::failed;
  for (const ClaimRow& row : judged(results)) EXPECT_EQ(row.verdict, ClaimVerdict::undecided);
}

// One seed gives one packing: two legs that follow it for different times are one sample.
TEST(ClaimRows, APackingThatTwoLegsFollowCountsOnce) {
  ThesisResults results = world();
  const ClaimRow before = rowOf(judged(results), "C6");
  ThesisLeg longer = results.legs[8];
  longer.name = "time-0.804";
  longer.families = {"time"};
  results.legs.push_back(longer);
  for (int packing = 0; packing < 3; ++packing) results.runs.push_back(worldRun(longer, packing));
  const ClaimRow after = rowOf(judged(results), "C6");
  EXPECT_EQ(before.figures.front().standardError, after.figures.front().standardError);
}

TEST(ClaimRows, TheCriticalDensityIsAQuestionOfTime) {
  const ClaimRow row = rowOf(judged(world()), "C6");
  const auto valueOf = [&](const std::string& name) {
    return std::ranges::find(row.figures, name, &ClaimFigure::name)->value;
  };
  EXPECT_FALSE(valueOf("critical ν̄ after 1 rotation"));  // all carry
  EXPECT_NEAR(valueOf("share of packings that carry after 1 rotation").value(), 1.0, 1e-12);
  EXPECT_NEAR(valueOf("critical ν̄ after 20 rotations").value(), 0.793, 0.0015);
  EXPECT_LT(valueOf("share of packings that carry after 20 rotations").value(), 0.9);
}

TEST(ClaimRows, TheSameResultsGiveTheSameRows) {
  const ThesisResults results = world(2);
  const std::vector<ClaimRow> once = judged(results), again = judged(results);
  ASSERT_EQ(once.size(), again.size());
  for (std::size_t k = 0; k < once.size(); ++k) EXPECT_EQ(once[k].why, again[k].why);
}

TEST(ClaimsOfCollisions, OnlyASpringReversesAndSlidingNeedsTheRightRestitution) {
  const std::vector<ClaimRow> rows = judged(worldWithLaw());
  const ClaimRow printed = rowOf(rows, "C1", "tension allowed"),
                 cut = rowOf(rows, "C1", "tension cut");
  const auto valueOf = [](const ClaimRow& row, const std::string& name) {
    return std::ranges::find(row.figures, name, &ClaimFigure::name)->value.value();
  };
  EXPECT_LT(valueOf(printed, "lowest Ψ_f of the spring"), -0.4);  // facts: −0.47
  EXPECT_GT(valueOf(printed, "lowest Ψ_f of Coulomb's law"), -1e-6);
  // Facts: the constant is 1.770 with the bound µ max(f_n, 0), tension or not; 3(1 + e_n)µ is that
  // of a cut law (e_n = 0.3408) and 1.613 of one with tension (0.2223).
  EXPECT_NEAR(valueOf(printed, "Ψ_f less the asymptote, Coulomb's law"), 1.613 - 1.770, 0.002);
  EXPECT_NEAR(valueOf(cut, "Ψ_f less the asymptote, Coulomb's law"), 0.0, 0.002);
  EXPECT_EQ(printed.verdict, ClaimVerdict::refuted) << printed.why;
}

TEST(ClaimsOfCollisions, WithoutFrictionNothingSlidesOrReverses) {
  ThesisResults results = worldWithLaw();
  for (ThesisLeg& leg : results.legs) replaceIn(leg.caseToml, "mu = 0.44", "mu = 1e-9");
  const ClaimRow row = rowOf(judged(results), "C1", "tension cut");
  EXPECT_EQ(row.verdict, ClaimVerdict::refuted) << row.why;
  EXPECT_NE(row.why.find("lowest Ψ_f of the spring"), std::string::npos);
}

TEST(ClaimsOfCollisions, SchemesDifferByLittleAtTheThesisStepAndByMoreAtALongOne) {
  const ClaimRow row = rowOf(judged(worldWithLaw()), "C2", "head-on");
  EXPECT_EQ(row.verdict, ClaimVerdict::reproduced) << row.why;
  ClaimRules rules = shippedRules();
  for (ClaimRule& rule : rules.claims)
    if (rule.id == "C2") rule.numbers.front().value = 5.0;
  EXPECT_EQ(rowOf(judgeClaims(worldWithLaw(), rules), "C2", "head-on").verdict,
            ClaimVerdict::refuted);
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
TEST(ClaimsOfCollisions, ReasonsTellTheTimeStepAtWhichTheFigureLiesInItsBand) {
  const double constant = 3.0 * 1.34 * 0.44;
  const auto sliding = [=](double psi) { return std::max(0.0, psi - constant); };
  const auto reversing = [=](double psi) { return std::max(-0.8 * psi, psi - constant); };
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
  ASSERT_EQ(row.verdict, ClaimVerdict::refuted);
  EXPECT_EQ(row.reasons,
            (std::vector<std::string>{
                "The whole claim is reproduced at 200 steps per contact.",
                "lowest Ψ_f of Coulomb's law lies in its band at 200 steps per contact (0)."}));
}

TEST(ClaimsOfCollisions, AnEnginesSweepsAreJudgedAsTheLawIs) {
  const double constant = 3.0 * 1.34 * 0.44;
  const auto sliding = [=](double psi) { return std::max(0.0, psi - constant); };
  const auto reversing = [=](double psi) { return std::max(-0.8 * psi, psi - constant); };
  CollideResults collisions;
  collisions.variants = {sweepOf("coulomb", sliding), sweepOf("viscous", sliding),
                         sweepOf("spring", reversing)};
  EXPECT_EQ(rowOf(judgeCollisions(collisions, shippedRules()), "C1", "tension cut").verdict,
            ClaimVerdict::reproduced);
  collisions.variants[0] = sweepOf("coulomb", reversing);
  const ClaimRow row = rowOf(judgeCollisions(collisions, shippedRules()), "C1", "tension cut");
  EXPECT_EQ(row.verdict, ClaimVerdict::refuted) << row.why;
  EXPECT_EQ(rowOf(judgeCollisions(collisions, shippedRules()), "C1", "tension allowed").verdict,
            ClaimVerdict::undecided);
}

/// A model whose u decays as the world's v_φ does, over H.
CosseratFields modelOf(double outerCouple) {
  CosseratFields model;
  for (int k = 0; k <= 100; ++k) {
    const double xi = 0.01 * k, x = xi * 0.1492 / 0.0074;
    model.xi.push_back(xi);
    model.s.push_back(0.17);
    model.q.push_back(0.15);
    model.m.push_back(0.21 + (outerCouple - 0.21) * xi);
    model.u.push_back(std::exp(-x / 1.5));
    model.omega.push_back(std::exp(-1.46 * x));
  }
  return model;
}

ClaimRow rowOfModel(const ThesisResults& results, const std::optional<CosseratFields>& model) {
  const ClaimRules rules = shippedRules();
  const std::vector<Reading> readings = readingsOf(results);
  const ClaimScope scope{results, rules, rules.of("C24"), "engine", readings.front()};
  Evidence evidence(scope);
  judgeCosserat(scope, evidence, model);
  return evidence.row();
}

TEST(ClaimOfTheModel, HoldsWhereItFitsAndItsCoupleStressGrowsAgainstTheRuns) {
  const ClaimRow row = rowOfModel(world(), modelOf(0.23));
  EXPECT_EQ(row.verdict, ClaimVerdict::reproduced) << row.why;
}

TEST(ClaimOfTheModel, IsRefutedWhereTheCoupleStressFallsOrTheVelocityDoesNotFit) {
  EXPECT_EQ(rowOfModel(world(), modelOf(0.1)).verdict, ClaimVerdict::refuted);
  CosseratFields slow = modelOf(0.23);
  for (double& u : slow.u) u = std::sqrt(std::sqrt(u));
  const ClaimRow row = rowOfModel(world(), slow);
  EXPECT_EQ(row.verdict, ClaimVerdict::refuted);
  EXPECT_NE(row.why.find("rms of ln(u/v_φ)"), std::string::npos) << row.why;
}

// Facts, section 4: m(0) = 0.21358, m(1) = 0.23443, u = 0.2443, 0.04563 at ξ = 0.1, 0.2.
TEST(ClaimOfTheModel, IsHeldAgainstTheModelAsPrinted) {
  const auto& model = cosseratAsPrinted();
  ASSERT_TRUE(model);
  EXPECT_NEAR(model->m.back() / model->m.front(), 0.23443 / 0.21358, 1e-4);
  EXPECT_NEAR(model->u[40], 0.2443, 1e-4);
  EXPECT_NEAR(model->u[80], 0.04563, 1e-5);
  const ClaimRow row = rowOf(judged(world()), "C24");
  for (const ClaimFigure& figure : row.figures) EXPECT_TRUE(figure.value) << figure.name;
}

TEST(ClaimOfTheModel, IsUndecidedWithoutTheModelOrTheRuns) {
  EXPECT_EQ(rowOfModel(world(), {}).verdict, ClaimVerdict::undecided);
  ThesisResults results = world();
  results.runs.clear();
  EXPECT_EQ(rowOfModel(results, modelOf(0.23)).verdict, ClaimVerdict::undecided);
}

}  // namespace
/// Thesis-facts, section 4: s(0) = tan 9.8°, q(0) = 0.14957, m(0) = 0.21358, m(1) = 0.23443,
/// u/u₀ = 0.2443 at ξ = 0.1.
TEST(CosseratAsPrinted, HasTheReferenceValues) {
  const auto& model = cosseratAsPrinted();
  ASSERT_TRUE(model);
  EXPECT_NEAR(model->s.front(), std::tan(9.8 * std::numbers::pi / 180.0), 1e-9);
  EXPECT_NEAR(model->q.front(), 0.14957, 5e-6);
  EXPECT_NEAR(model->m.front(), 0.21358, 5e-6);
  EXPECT_NEAR(model->m.back(), 0.23443, 5e-6);
  ASSERT_DOUBLE_EQ(model->xi[40], 0.1);
  EXPECT_NEAR(model->u[40] / model->u[0], 0.2443, 5e-5);
}

}  // namespace crossgrain::test
