// Endpoints of runs, and answers on them where a mirror carries the packings.
#include "studies/flow/endpoint_table.hpp"
#include "studies/flow/surrogates.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "adapters/snapshot_source.hpp"
#include "cases/couette.hpp"
#include "studies/flow/endpoint_values.hpp"
#include "studies/lockstep/terms.hpp"
#include "tests/studies/flow_runs.hpp"

namespace crossgrain {
namespace {

/// A cell of two rings between 1 m and 3 m: areas 3π and 5π, so weights 3/8 and 5/8.
Case twoRings() {
  Case setup;
  couetteIn(setup).cell.innerRadius = 1.0;
  couetteIn(setup).cell.outerRadius = 3.0;
  couetteIn(setup).cell.height = 1.0;
  couetteIn(setup).particles.smallRadius = 0.1;
  couetteIn(setup).times.rings = 2;
  setup.preparation.packings = 4;
  setFlowOfCell(setup);
  return setup;
}

FlowRun runOf(const std::string& engine, int packing, double pressure, double spin = -1.0) {
  FlowRun run = test::flowRun(
      engine, packing,
      {test::sliced("stress_rr", {2.0 * pressure, 2.0 * pressure}),
       test::sliced("stress_pp", {0.0, 0.0}),
       test::sliced("stress_rp", {0.4 * pressure, 0.8 * pressure}),
       test::sliced("azimuthal_velocity", {0.8, std::nullopt}), test::sliced("spin", {spin, 0.6}),
       test::sliced("volume_fraction", {0.6, 0.8})});
  run.series = RunSeries{{"t_s", {1.0, 2.0}}, {"coordination", {3.0, 4.0}}};
  return run;
}

/// Nor a sum over contacts that the files do not list: 0 N would be a value.
TEST(EndpointTable, ForceOnAWallOfFilesWithoutItsContacts_IsAbsent) {
  Case setup;
  Endpoint own{.name = "load", .quantity = std::string(normalForce), .wall = 0};
  setup.region.emplace();
  setup.endpoints = {own};
  FlowRun run;
  run.engine = "files";
  const auto why = [&] { return notShown(endpointNamed(setup, "load"), setup, run); };
  EXPECT_EQ(why(), "");
  run.remarks = {std::string(noWallContacts) + ": stress lacks them"};
  EXPECT_EQ(why(), "no contacts with walls in its files");
}

TEST(Endpoints, Values_AreAreaMeansRatiosAndTheRingAtTheWheel) {
  const Case setup = twoRings();
  const FlowRun run = runOf("a", 0, 100.0);
  const auto value = [&](const char* name) { return endpointOf(endpointNamed(name), setup, run); };
  EXPECT_NEAR(*value("pressure"), 100.0, 1e-12);
  // (3·0.4 + 5·0.8)/8 of the pressure over twice the pressure.
  EXPECT_NEAR(*value("stress_ratio"), 0.325, 1e-12);
  EXPECT_EQ(*value("stress_anisotropy"), 0.0);
  EXPECT_EQ(*value("coordination"), 3.5);
  EXPECT_EQ(*value("mean_velocity"), 0.8);  // a ring without disks has no velocity, and no weight
  // Over disks: 3·0.6 and 5·0.8 of their area lie in the two rings.
  EXPECT_NEAR(*value("mean_spin"), (1.8 * -1.0 + 4.0 * 0.6) / 5.8, 1e-12);
  EXPECT_EQ(*value("velocity_at_wheel"), 0.8);
  EXPECT_EQ(*value("volume_fraction_at_wheel"), 0.6);
  EXPECT_EQ(*value("spin_at_wheel"), -1.0);
  FlowRun bare = runOf("a", 0, 0.0);
  EXPECT_FALSE(endpointOf(endpointNamed("pressure"), setup, bare));
  EXPECT_FALSE(endpointOf(endpointNamed("stress_ratio"), setup, bare));
  bare.profiles.clear();
  bare.series.reset();
  for (const Endpoint& endpoint : endpointTable())
    EXPECT_FALSE(endpointOf(endpoint, setup, bare)) << endpoint.name;
}

Case judging(const std::string& endpoint, const Margin& margin) {
  Case setup = twoRings();
  setup.averaging.endpoints[endpoint] = margin;
  setFlowOfCell(setup);
  return setup;
}

const ComparedPair plain = {"a", "b"};

/// By "mirror", from which it differs as so much of k_n would, and late as so much of each would.
EndpointFindings byMirror(double equivalent, const std::vector<EquivalentChange>& late,
                          const std::vector<EndpointResponse>& responses = {}) {
  EndpointFindings known;
  known.responses = responses;
  SurrogateEngine& own = known.surrogates.emplace_back();
  own.inUse = true;
  own.engine = "b";
  own.mirror = "mirror";
  own.equivalent = equivalent;
  own.late.equivalents = late;
  return known;
}

TEST(EndpointTable, RelativeMargin_ComparesRatios) {
  // b is 10 % above a on packings that differ by a factor of eight: no scatter in the ratio.
  std::vector<FlowRun> runs;
  for (const int packing : {0, 1, 2, 3}) {
    runs.push_back(runOf("a", packing, 100.0 * std::exp2(packing)));
    runs.push_back(runOf("b", packing, 110.0 * std::exp2(packing)));
  }
  const Case setup = judging("pressure", {0.25, true, "because", ""});
  const auto rows = endpointRows(setup, runs, {plain}, interimPlanOf(setup), 4, {});
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].verdict, Verdict::pass);
  EXPECT_NEAR(*rows[0].distance, std::log(1.1) / std::log(1.25), 1e-9);
  EXPECT_NEAR(*rows[0].reference, 375.0, 1e-9);
  EXPECT_NEAR(*rows[0].difference, 37.5, 1e-9);
}

std::vector<FlowRun> spins(const std::string& engine, const std::vector<double>& values) {
  std::vector<FlowRun> runs;
  for (std::size_t k = 0; k < values.size(); ++k)
    runs.push_back(runOf(engine, static_cast<int>(k), 100.0, values[k]));
  return runs;
}

void append(std::vector<FlowRun>& to, const std::vector<FlowRun>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

TEST(EndpointTable, Mirror_TakesItsBoundOffTheMargin) {
  auto runs = spins("a", {-1.0, -1.1, -0.9, -1.0});
  append(runs, spins("mirror", {-1.1, -1.2, -1.0, -1.1}));
  append(runs, spins("b", {-7.0}));  // the engine itself: one run, which carries no verdict
  const Case setup = judging("spin_at_wheel", {0.2, false, "because", ""});
  // 10 % of k_n do at most two margins, of µ 0.4: B = 1e-3/0.1 · 2 + max(1e-4 · 2, 2e-3 · 0.4)/0.1.
  const std::vector<EndpointResponse> responses = {{"spin_at_wheel", "kn", 0.1, 0.5, 2.0, 1.0, 4},
                                                   {"spin_at_wheel", "mu", 0.1, 0.1, 0.4, 1.0, 4}};
  const std::vector<EquivalentChange> late = {{"kn", 1e-4}, {"mu", 2e-3}};
  const auto rowsOf = [&](const EndpointFindings& known) {
    return endpointRows(setup, runs, {plain}, interimPlanOf(setup), 4, known);
  };
  const auto rows = rowsOf(byMirror(1e-3, late, responses));
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].b, "b");
  EXPECT_EQ(rows[0].surrogateB, "mirror");
  EXPECT_EQ(rows[0].surrogateA, "");
  EXPECT_NEAR(*rows[0].reach, 0.008, 1e-12);
  EXPECT_NEAR(*rows[0].bound, 0.028, 1e-12);
  EXPECT_EQ(rows[0].verdict, Verdict::pass);
  EXPECT_NEAR(*rows[0].distance, -0.5, 1e-9);
  EXPECT_NEAR(*rows[0].distanceHigh, -0.5 + 0.028, 1e-9);
  // Without responses of the averages no row rests on the mirror's runs.
  EXPECT_TRUE(rowsOf(byMirror(1e-3, late)).empty());
  // Nor does one without the changes that begin late.
  EXPECT_TRUE(rowsOf(byMirror(1e-3, {}, responses)).empty());
  // A bound beyond the margin leaves nothing to agree within, whichever windows it is from.
  for (const EndpointFindings& loose : {byMirror(0.05, {{"kn", 1e-4}}, responses),
                                        byMirror(1e-12, {{"kn", 1e-4}, {"mu", 0.25}}, responses)})
    EXPECT_EQ(rowsOf(loose)[0].verdict, Verdict::undecided);
}

TEST(EndpointTable, SpotCheck_ReachBeyondAMargin_RefusesTheMirror) {
  const Case setup = judging("spin_at_wheel", {0.2, false, "because", ""});
  const std::vector<EndpointResponse> responses = {{"spin_at_wheel", "kn", 0.1, 0.5, 2.0, 1.0, 4}};
  const auto judged = [&](const LateWindows& late) {
    SurrogateEngine own;
    own.inUse = true;
    judgeLateWindows(setup, responses, late, own);
    return own;
  };
  // 10 % of k_n do two margins at most: 4.9 % of it 0.98, 5.1 % 1.02.
  LateWindows late{1, {0.0}, 0.1, {{"kn", 0.049}}, ""};
  EXPECT_TRUE(judged(late).inUse);
  EXPECT_EQ(judged(late).alarm, "");
  late.equivalents[0].change = 0.051;
  EXPECT_FALSE(judged(late).inUse);
  EXPECT_NE(judged(late).alarm.find("1 margins"), std::string::npos) << judged(late).alarm;
  EXPECT_FALSE(judged({1, {}, 0.1, {}, "it shows no forces"}).inUse);
}

TEST(EndpointTable, Undecided_HasTheNumberOfPackingsNeeded) {
  auto runs = spins("a", {0, 0, 0, 0, 0, 0, 0, 0});
  append(runs, spins("b", {2, -2, 2, -2, 2, -2, 2, -2}));
  Case setup = judging("spin_at_wheel", {1.0, false, "because", ""});
  setup.preparation.packings = 8;
  const auto rows = endpointRows(setup, runs, {plain}, interimPlanOf(setup), 8, {});
  EXPECT_EQ(rows[0].verdict, Verdict::undecided);
  ASSERT_TRUE(rows[0].needs && rows[0].needsAtMost);
  const double sd = std::sqrt(32.0 / 7.0);
  const auto range = packingsFor(0.0, sd, 7, 1.0, 0.05);
  EXPECT_EQ(*rows[0].needs, range->low);
  EXPECT_EQ(*rows[0].needsAtMost, *range->high);
}

TEST(InterimPlan, PackingsOfTheCase_GiveTheAnalyses) {
  Case setup = twoRings();
  setup.looks.count = 4;
  setup.preparation.packings = 8;
  EXPECT_EQ(interimPlanOf(setup).packings, (std::vector{8, 16, 24, 32}));
  setup.preparation.packings = 3;  // too few for a verdict
  EXPECT_EQ(interimPlanOf(setup).packings, std::vector{3});
  couetteIn(setup).particles.file = "packing.h5";
  EXPECT_EQ(interimPlanOf(setup).packings, std::vector{1});
  Case assembly;
  assembly.source = Assembly();
  assembly.region.emplace();
  assembly.looks.count = 2;
  assemblyIn<2>(assembly).starts.files = {"a.csv", "b.csv", "c.csv", "d.csv"};
  EXPECT_EQ(interimPlanOf(assembly).packings, std::vector{4});
  assemblyIn<2>(assembly).starts.velocityRms = 0.1;  // any number of packings
  assembly.preparation.packings = 6;
  EXPECT_EQ(interimPlanOf(assembly).packings, (std::vector{6, 12}));
}

TEST(EndpointTable, RatiosOfOtherSign_AreLostAndHideNoDisagreement) {
  Case setup = judging("pressure", {0.1, true, "because", ""});
  setup.averaging.endpoints["spin_at_wheel"] = {0.1, false, "because", ""};
  setFlowOfCell(setup);
  const Numbers spin = {-1.0, -1.1, -0.9, -1.0}, far = {1.0, 0.9, 1.1, 1.05};
  const auto rowsWith = [&](const Numbers& pressure) {
    return endpointRows(setup, {{"pressure", pressure, pressure}, {"spin_at_wheel", spin, far}},
                        {"a", "b"}, interimPlanOf(setup));
  };
  const auto rows = rowsWith({-2.0, -2.0, -2.0, -2.0});
  EXPECT_EQ(rows[0].verdict, Verdict::pass);  // a margin of |−2|
  EXPECT_EQ(rows[0].reference, -2.0);
  EXPECT_EQ(rows[1].verdict, Verdict::fail);
  const auto some = rowsWith({2.0, 2.0, 4.0, 0.0});
  EXPECT_EQ(some[0].packings, 3);
  EXPECT_EQ(some[0].lost, 1);
  EXPECT_NEAR(*some[0].reference, 8.0 / 3.0, 1e-14);  // of those that are tested
  EXPECT_NE(some[0].reason.find("0 or of another sign"), std::string::npos);
  EXPECT_EQ(some[1].verdict, Verdict::fail);
  for (const Numbers& none : {Numbers{2.0, -2.0, 4.0, 0.0}, Numbers{0.0, 0.0, 0.0, 0.0}}) {
    const auto lost = rowsWith(none);
    EXPECT_EQ(lost[0].verdict, Verdict::undecided);
    EXPECT_EQ(lost[0].packings, 0);
    EXPECT_EQ(lost[0].lost, 4);
    EXPECT_NE(lost[0].reason.find("relative margin"), std::string::npos) << lost[0].reason;
    EXPECT_EQ(lost[1].verdict, Verdict::fail);
  }
}

TEST(EndpointTable, RelativeMarginOfANegativeReference_IsOfItsSize) {
  Case setup = judging("pressure", {0.1, true, "because", ""});
  const Numbers discharge = {-270.0, -260.0, -280.0, -275.0};
  const auto rowOf = [&](double factor) {
    Numbers other = discharge;
    for (auto& value : other) *value *= factor;
    return endpointRows(setup, {{"pressure", discharge, other}}, {"a", "b"}, interimPlanOf(setup))
        .front();
  };
  const EndpointRow close = rowOf(1.05), far = rowOf(1.3), back = rowOf(0.7);
  EXPECT_EQ(close.verdict, Verdict::pass);
  EXPECT_NEAR(*close.difference, 0.05 * -271.25, 1e-9);  // b − a, as of any other endpoint
  EXPECT_NEAR(*close.distance, -std::log(1.05) / std::log(1.1), 1e-12);
  EXPECT_LE(*close.low, *close.high);
  EXPECT_EQ(far.verdict, Verdict::fail);
  EXPECT_LT(*far.distance, 0.0);
  EXPECT_EQ(back.verdict, Verdict::fail);
  EXPECT_GT(*back.difference, 0.0);
  EXPECT_EQ(rowOf(-1.0).packings, 0);  // of another sign: nothing to divide
}

/// One disk at that height in every snapshot of both runs of one start.
std::vector<FlowRun> heights(const std::string& engine, double first, double second) {
  std::vector<FlowRun> runs;
  for (const double y : {first, second}) {
    FlowRun run = test::flowRun(engine, static_cast<int>(runs.size()));
    run.series = RunSeries{{"t_s", {1.0, 2.0}}, {"disk_0_y", {0.0, y}}};
    runs.push_back(std::move(run));
  }
  return runs;
}

TEST(EndpointTable, ClosedForm_JudgesEveryEngineOnOneStart) {
  Case setup;
  setup.source = Assembly();
  Endpoint apex;
  apex.name = "apex";
  apex.quantity = "y";
  apex.disk = 0;
  apex.reduction = Reduction::maximum;
  apex.expected = 2.0;
  apex.unit = "m";
  setup.region.emplace();
  setup.endpoints = {apex};
  setup.averaging.endpoints["apex"] = {0.1, false, "because", ""};
  EXPECT_EQ(flowPackings(setup), 2);
  auto runs = heights("a", 2.05, 2.05);
  append(runs, heights("b", 2.3, 2.3));
  append(runs, heights("noisy", 2.0, 2.0 + 1e-15));
  const auto rows = closedFormRows(setup, runs, {"a", "b", "noisy"}, {plain});
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0].kind, PairKind::closedForm);
  EXPECT_EQ(rows[0].verdict, Verdict::pass);
  EXPECT_NEAR(*rows[0].distance, 0.5, 1e-12);
  EXPECT_EQ(rows[0].reference, 2.0);
  EXPECT_EQ(rows[1].verdict, Verdict::fail);
  EXPECT_NEAR(*rows[1].distance, 3.0, 1e-12);
  EXPECT_EQ(rows[2].verdict,
            Verdict::undecided);  // never judged by a run that is another each time
  EXPECT_NE(rows[2].reason.find("run twice"), std::string::npos);
  EXPECT_FALSE(rows[2].difference);
  EXPECT_EQ(rows[3].verdict, Verdict::fail);  // a and b, 2.5 margins apart
  EXPECT_NEAR(*rows[3].difference, 0.25, 1e-12);
  // Without a reference each is compared with the median of the others that have a value.
  append(runs, heights("c", 2.1, 2.1));
  ComparedPair neutral{medianName, "b"};
  neutral.others = {"a", "noisy", "c"};
  const EndpointRow ofMedian = closedFormRows(setup, runs, {}, {neutral}).at(0);
  EXPECT_NEAR(*ofMedian.reference, 2.075, 1e-12);
  EXPECT_NEAR(*ofMedian.distance, 2.25, 1e-12);
  neutral.others = {"a", "noisy"};
  EXPECT_EQ(closedFormRows(setup, runs, {}, {neutral}).at(0).verdict, Verdict::undecided);
  // A run that failed is no second one.
  runs[1].status = Status::failed;
  EXPECT_EQ(closedFormRows(setup, runs, {"a"}, {})[0].verdict, Verdict::undecided);
}

TEST(EndpointTable, SpotCheck_IsComparedWithChaos) {
  const Case setup = judging("spin_at_wheel", {0.5, false, "because", ""});
  // Two responses of the same 8 packings: 7 degrees of freedom, rms scatter 0.5 margins.
  const std::vector<EndpointResponse> responses = {{"spin_at_wheel", "kn", 0.1, 3.0, 4.0, 0.7, 8},
                                                   {"spin_at_wheel", "mu", 0.1, 2.0, 3.0, 0.1, 8},
                                                   {"pressure", "mu", 0.1, 2.0, 3.0, 9.0, 8}};
  const auto number = [&](double own) {
    const auto spotCheck =
        spotCheckOf(setup, runOf("b", 0, 100.0, own), runOf("m", 0, 100.0, 0.0), responses);
    EXPECT_EQ(spotCheck.size(), 1u);
    return spotCheck.front();
  };
  EXPECT_NEAR(*number(0.2).floor, 0.5, 1e-12);
  EXPECT_NEAR(*number(0.2).difference, 0.4, 1e-12);
  EXPECT_NEAR(*number(0.2).chance, chanceOfOneAsFar(0.4, 0.5, 7, 1), 1e-12);
  EXPECT_LT(*number(2.0).chance, 1e-3);
  // t(7, 2.5 %) = 2.365: half of it in units of the margin, and its chance is 5 %.
  EXPECT_NEAR(*number(0.2).reach, 0.5 * 2.364624252, 1e-6);
  EXPECT_NEAR(*number(0.5 * *number(0.2).reach).chance, 0.05, 1e-9);
  EXPECT_FALSE(spotCheckOf(setup, runOf("b", 0, 1.0), runOf("m", 0, 1.0), {}).front().chance);
}

TEST(EndpointTable, ConstantsOfTheLaw_AreChangedByATenth) {
  Case setup = twoRings();
  setup.law.kn = 350.0;
  setup.law.mu = 0.4;
  const auto both = changedCases(setup);
  ASSERT_EQ(both.size(), 2u);
  EXPECT_EQ(both[0].name, "kn+10%");
  EXPECT_NEAR(both[0].setup.law.kn, 385.0, 1e-9);
  EXPECT_EQ(both[0].setup.law.mu, 0.4);
  EXPECT_EQ(both[1].constant, "mu");
  EXPECT_NEAR(both[1].setup.law.mu, 0.44, 1e-12);
  setup.law.mu = 0.0;
  EXPECT_EQ(changedCases(setup).size(), 1u);
}

TEST(EndpointTable, Response_IsBoundedByItsInterval) {
  const Case setup = judging("spin_at_wheel", {0.5, false, "because", ""});
  const auto own = spins("a", {-1.0, -1.0, -1.0, -1.0}),
             changed = spins("a", {-0.9, -0.7, -0.9, -0.7});
  const EndpointResponse found = responseTo(
      setup, finishedRuns(own, "a"), finishedRuns(changed, "a"), "spin_at_wheel", "kn", 0.1, 4);
  EXPECT_NEAR(*found.difference, 0.4, 1e-12);
  // t(3, 2.5 %) = 3.182, se = 0.1·√(4/3)/2.
  EXPECT_NEAR(*found.scatter, 0.1 * std::sqrt(4.0 / 3.0) / 0.5, 1e-12);
  EXPECT_NEAR(*found.bound, 0.4 + 3.182446305284263 * 0.1 * std::sqrt(4.0 / 3.0) / 2.0 / 0.5, 1e-6);
}

std::vector<FlowRun> pressuresOf(const std::string& engine, const std::vector<double>& pressures) {
  std::vector<FlowRun> runs;
  for (std::size_t k = 0; k < pressures.size(); ++k)
    runs.push_back(runOf(engine, static_cast<int>(k), pressures[k]));
  return runs;
}

/// With a margin of 5 % of the pressure.
EndpointRow judgedFiles(std::vector<FlowRun> ours, const std::vector<FlowRun>& theirs) {
  ours.insert(ours.end(), theirs.begin(), theirs.end());
  const Case setup = judging("pressure", {0.05, true, "", ""});
  ComparedPair pair = plain;
  pair.ofFiles = true;
  return endpointRows(setup, ours, {pair}, interimPlanAt(4, 1, 0.05), 4, {}).front();
}

TEST(FileRuns, AsManyAsPackings_ArePairedInTheirOrder) {
  // Packings differ by hundreds, pairs by one percent.
  const auto row = judgedFiles(pressuresOf("a", {100, 200, 300, 400, 500}),
                               pressuresOf("b", {101, 202, 303, 404, 505}));
  EXPECT_FALSE(row.unpaired);
  EXPECT_EQ(row.packings, 5);
  EXPECT_EQ(row.verdict, Verdict::pass);
}

TEST(FileRuns, OtherNumbers_AreIndependentSamples) {
  const auto row = judgedFiles(pressuresOf("a", {100, 101, 102, 103, 104}),
                               pressuresOf("b", {101, 102, 103, 102, 101, 103, 102}));
  ASSERT_TRUE(row.unpaired);
  EXPECT_EQ(row.unpaired->basis, Basis::independent);
  EXPECT_EQ(row.unpaired->a, 5);
  EXPECT_EQ(row.unpaired->b, 7);
  EXPECT_EQ(row.lost, 0);
  EXPECT_EQ(row.verdict, Verdict::pass);
  // The same files against ten times the scatter of packings: nothing can be said.
  const auto open = judgedFiles(pressuresOf("a", {60, 80, 102, 125, 150}),
                                pressuresOf("b", {101, 102, 103, 102, 101, 103, 102}));
  EXPECT_EQ(open.verdict, Verdict::undecided);
  // More runs of b would not narrow it: of a are nearly all of s²/n + u²/m.
  EXPECT_GT(open.unpaired->shareOfA.value(), 0.98);
}

TEST(FileRuns, OneAgainstMany_HasTheScatterOfTheMany) {
  const auto row =
      judgedFiles(pressuresOf("a", {100, 101, 102, 103, 104}), pressuresOf("b", {102}));
  ASSERT_TRUE(row.unpaired);
  EXPECT_EQ(row.unpaired->basis, Basis::oneScatter);
  EXPECT_NEAR(row.unpaired->shareOfA.value(), (1.0 / 5.0) / (1.0 / 5.0 + 1.0), 1e-15);
  EXPECT_EQ(row.verdict, Verdict::pass);
  EXPECT_EQ(
      judgedFiles(pressuresOf("a", {100, 101, 102, 103, 104}), pressuresOf("b", {150})).verdict,
      Verdict::fail);
}

TEST(FileRuns, OneOfEach_RestsOnTheirOwnErrors) {
  auto ours = pressuresOf("a", {100}), theirs = pressuresOf("b", {101});
  EXPECT_EQ(judgedFiles(ours, theirs).verdict, Verdict::undecided);
  ours[0].endpointErrors = {{"pressure", 0.6, 8.0}};
  theirs[0].endpointErrors = {{"pressure", 0.808, 8.0}};
  const auto row = judgedFiles(ours, theirs);
  ASSERT_TRUE(row.unpaired);
  EXPECT_EQ(row.unpaired->basis, Basis::oneRunEach);
  EXPECT_FALSE(row.unpaired->shareOfA);
  EXPECT_EQ(row.verdict, Verdict::pass);
  // Relative errors .006 and .008 are .01 together, of 2·.01⁴/(.006⁴ + .008⁴)·4 = 14.84 degrees of
  // freedom, whose 95 % point is 1.754.
  EXPECT_NEAR(*row.high, 100.0 * (1.01 * std::exp(0.01754) - 1.0), 0.01);
}

/// The same as files, some of which have no contacts.
std::vector<FlowRun> filesOf(std::vector<FlowRun> runs, const std::vector<std::size_t>& bare) {
  for (FlowRun& run : runs) run.stats.reset();
  for (const std::size_t k : bare) {
    runs[k].head.clear();
    std::erase_if(runs[k].profiles,
                  [](const Profile& profile) { return profile.field.starts_with("stress"); });
  }
  return runs;
}

TEST(FileRuns, WithoutContacts_HaveNoVerdictOnWhatIsMadeOfThem) {
  const auto row = judgedFiles(pressuresOf("a", {100, 101, 102, 103}),
                               filesOf(pressuresOf("b", {1, 1, 1, 1}), {0, 1, 2, 3}));
  EXPECT_EQ(row.verdict, Verdict::notMeasured);
  EXPECT_EQ(row.answer(), "absent");
  EXPECT_EQ(row.reason, "b: no contacts in its files");
  EXPECT_EQ(row.lost, 0);
  EXPECT_FALSE(row.distance);
}

TEST(FileRuns, WithoutContactsOfWalls_HaveNoVerdictOnWhatIsMadeOfContacts) {
  std::vector<FlowRun> files = filesOf(pressuresOf("b", {100, 101, 102, 103}), {});
  for (FlowRun& run : files) run.remarks.emplace_back(noWallContacts);
  const auto row = judgedFiles(pressuresOf("a", {100, 101, 102, 103}), files);
  EXPECT_EQ(row.verdict, Verdict::notMeasured);
  EXPECT_EQ(row.reason, "b: no contacts with walls in its files");
}

TEST(FileRuns, WithContactsInSome_AreJudgedByThose) {
  // Without the second of b's runs the others are no longer the same ones as a's.
  const auto row = judgedFiles(pressuresOf("a", {100, 101, 102, 103, 102}),
                               filesOf(pressuresOf("b", {101, 7, 102, 103, 102}), {1}));
  ASSERT_TRUE(row.unpaired);
  EXPECT_EQ(row.unpaired->basis, Basis::independent);
  EXPECT_EQ(row.unpaired->a, 5);
  EXPECT_EQ(row.unpaired->b, 4);
  EXPECT_EQ(row.lost, 0);
  EXPECT_EQ(row.verdict, Verdict::pass);
  EXPECT_EQ(row.reason, "b: no contacts in its files of 1 of 5 runs");
}

TEST(FileRuns, Undecided_SaysWhy) {
  auto ours = pressuresOf("a", {100}), theirs = pressuresOf("b", {101});
  EXPECT_EQ(judgedFiles(ours, theirs).reason,
            "a has a single run of 2 snapshots, whose own error takes 16");
  ours[0].endpointErrors = {{"pressure", 0.6, 0.8}};
  theirs[0].endpointErrors = {{"pressure", 0.808, 0.8}};
  EXPECT_EQ(judgedFiles(ours, theirs).reason,
            "each single run holds about 2.5 independent values, and a verdict takes 4");
  EXPECT_EQ(judgedFiles(pressuresOf("a", {100, 101}), pressuresOf("b", {101, 102})).reason,
            "2 and 2 runs, and a verdict takes 5 together");
  EXPECT_EQ(
      judgedFiles(pressuresOf("a", {60, 80, 102, 125, 150}), pressuresOf("b", {101, 102})).reason,
      "the interval reaches past the margin");
}

TEST(Neutral, FilesWithoutContacts_LeaveTheOthersToThemselves) {
  std::vector<FlowRun> runs;
  for (const char* name : {"a", "b", "c"}) append(runs, pressuresOf(name, {100, 101, 102, 103}));
  append(runs, filesOf(pressuresOf("d", {7, 7, 7, 7}), {0, 1, 2, 3}));
  const auto against = [&](const std::string& engine, const std::vector<std::string>& others) {
    ComparedPair pair{medianName, engine};
    pair.others = others;
    return endpointRows(judging("pressure", {0.05, true, "", ""}), runs, {pair},
                        interimPlanAt(4, 1, 0.05), 4, {})
        .front();
  };
  EXPECT_EQ(against("d", {"a", "b", "c"}).verdict, Verdict::notMeasured);
  const EndpointRow a = against("a", {"b", "c", "d"});
  EXPECT_EQ(a.verdict, Verdict::pass);
  EXPECT_EQ(a.lost, 0);
  EXPECT_EQ(a.reason, "d: no contacts in its files");
  // One other is no median.
  EXPECT_EQ(against("a", {"b", "d"}).verdict, Verdict::notMeasured);
}

TEST(Neutral, MedianIsOfTheOthersPackingByPacking) {
  // Of 100, 104 and 90: 102 at the first packing of c, which has 101; so -1 %, and so on.
  const std::vector<std::vector<double>> pressures = {
      {100, 200, 300, 400}, {104, 208, 312, 416}, {102, 204, 306, 408}};
  std::vector<FlowRun> runs;
  const char* const names[] = {"a", "b", "c"};
  for (std::size_t e = 0; e < 3; ++e)
    for (FlowRun& run : pressuresOf(names[e], pressures[e])) runs.push_back(std::move(run));
  const auto against = [&](const std::string& engine, const std::vector<std::string>& others) {
    ComparedPair pair{medianName, engine};
    pair.others = others;
    const auto rows = endpointRows(judging("pressure", {0.05, true, "", ""}), runs, {pair},
                                   interimPlanAt(4, 1, 0.05), 4, {});
    return rows.empty() ? EndpointRow{} : rows.front();
  };
  const EndpointRow c = against("c", {"a", "b"});
  EXPECT_EQ(c.a, "median");
  EXPECT_EQ(c.packings, 4);
  EXPECT_NEAR(*c.difference, 0.0, 1e-9);  // the mean of two others is their median
  EXPECT_EQ(c.verdict, Verdict::pass);
  const EndpointRow a = against("a", {"b", "c"});
  EXPECT_NEAR(*a.difference / *a.reference, 100.0 / 103.0 - 1.0, 1e-9);
  // One that finished nothing is no part of it, and one alone is no median.
  EXPECT_NEAR(*against("a", {"b", "c", "none"}).difference, *a.difference, 1e-9);
  EXPECT_TRUE(against("a", {"b", "none"}).a.empty());
}

TEST(Neutral, MedianByPacking) {
  const std::vector<Numbers> three = {{1.0, 5.0, std::nullopt}, {2.0, 7.0, 3.0}, {9.0, 6.0, {}}};
  EXPECT_EQ(medianByPacking(three), (Numbers{2.0, 6.0, std::nullopt}));
}

/// The median of n engines moves by no more than any of them did, so that B is the largest.
TEST(Neutral, MirrorsBoundTheMedianByTheLargest) {
  std::vector<FlowRun> runs;
  for (const char* name : {"a", "mirror", "c"})
    for (FlowRun& run : pressuresOf(name, {100, 200, 300, 400})) runs.push_back(std::move(run));
  const std::vector<EndpointResponse> responses = {{"pressure", "kn", 0.1, 1.0, 2.0, 0.5, 4}};
  EndpointFindings known = byMirror(0.01, {{"kn", 0.0}}, responses);
  ComparedPair pair{medianName, "a"};
  pair.others = {"b", "c"};
  const auto rows = endpointRows(judging("pressure", {0.05, true, "", ""}), runs, {pair},
                                 interimPlanAt(4, 1, 0.05), 4, known);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].surrogateA, "mirror");
  EXPECT_NEAR(*rows[0].bound, 0.01 / 0.1 * 2.0, 1e-12);
}

}  // namespace
}  // namespace crossgrain
