// Conclusions of a comparison: causes and next steps by rule, and sentences that are true of random
// results.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "reports/common/engines.hpp"
#include "reports/common/text.hpp"
#include "reports/flow/endpoint_text.hpp"
#include "reports/flow/report.hpp"
#include "results/schema.hpp"
#include "tests/reports/report_text.hpp"
#include "tests/reports/sample_results.hpp"
#include "tests/support/refusal.hpp"

namespace crossgrain::reports {
namespace {

/// Two engines; the second disagrees on one of two endpoints.
CompareResults disagreeing() {
  CompareResults results;
  results.engines = {{"ours", "", "", "", Status::finished, ""},
                     {"theirs", "", "", "", Status::finished, ""}};
  for (const auto& [endpoint, answer] :
       {std::pair("pressure", Verdict::fail), std::pair("coordination", Verdict::pass)}) {
    EndpointRow row;
    row.a = "ours";
    row.b = "theirs";
    row.endpoint = endpoint;
    row.verdict = answer;
    row.distance = answer == Verdict::fail ? 3.0 : 0.1;
    results.endpoints.rows.push_back(row);
  }
  return results;
}

LockstepRow lockstepRow(Equivalence verdict) {
  LockstepRow row;
  row.engine = "theirs";
  row.verdict = verdict;
  row.equivalent = verdict == Equivalence::differs ? 0.02 : 1e-5;
  return row;
}

TEST(CompareOverview, Disagreement_NamesTheLawAsCauseOnlyWhereThatIsShown) {
  CompareResults results = disagreeing();
  EXPECT_EQ(shown(rowNamed(compareOverview(results), "theirs").cells[1]), "bad 3.00 margins");
  EXPECT_EQ(compareConclusion(results)[0],
            "Against ours: theirs disagreed on pressure and agreed on 1 of 2 endpoints.");
  EXPECT_EQ(
      compareConclusion(results)[1],
      "Causes of differences: no mirror shows whether the difference of theirs comes from its "
      "law or its implementation.");

  results.lockstep.emplace();
  results.lockstep->rules = {1e-10, 1e-3, 1e-3, "kn", 0.05};
  results.lockstep->rows = {lockstepRow(Equivalence::sameLaw)};
  const Overview same = compareOverview(results);
  EXPECT_EQ(shown(rowNamed(same, "theirs").cells[0]), "good 0.0100 × limit");
  EXPECT_EQ(shown(rowNamed(same, "theirs").cells[1]), "model_difference 3.00 margins");
  EXPECT_EQ(same.conclusion[1],
            "Causes of differences: theirs differs by the law that it declares.");

  results.lockstep->rows = {lockstepRow(Equivalence::differs)};
  results.lockstep->rows[0].term = NamedTerm{"gt", 0.02, 0.1};
  const Overview other = compareOverview(results);
  EXPECT_EQ(shown(rowNamed(other, "theirs").cells[0]), "bad 20.0 × limit");
  EXPECT_EQ(shown(rowNamed(other, "theirs").cells[1]), "bad 3.00 margins");
  EXPECT_EQ(
      other.conclusion[1],
      "Causes of differences: theirs does not have the law that it declares (deviation found: "
      "the tangential damping).");
}

TEST(CompareOverview, FilesOfAnotherLaw_AreSaidInTheMatrixAndTheConclusion) {
  CompareResults results = disagreeing();
  const std::string before = fmt::format("{}", fmt::join(compareConclusion(results), " "));
  EXPECT_FALSE(has(before, "not those of the case's law"));
  for (const bool another : {true, false}) {
    FlowRun run;
    run.engine = "theirs";
    run.packing = another ? 0 : 1;
    run.hasOtherLaw = another;
    results.runs.push_back(run);
  }
  const Overview overview = compareOverview(results);
  EXPECT_EQ(shown(rowNamed(overview, "theirs").cells[0]), "model_difference in 1 of 2 runs");
  const VerdictWords* const meaning =
      findBy(overview.states, Verdict::modelDifference, &VerdictWords::verdict);
  ASSERT_TRUE(meaning);
  EXPECT_TRUE(meaning->words.starts_with("result files of another law")) << meaning->words;
  EXPECT_EQ(
      compareConclusion(results)[1],
      "Forces in 1 of 2 runs of theirs are not those of the case's law: the notes say where.");
}

CausePart part(double mean, double half) {
  return {mean, mean - half, mean + half};
}

/// Of the disagreement of 30 N/m², by a relative margin of a tenth of 100 N/m².
PairCauses measuredCauses(CompareResults& results) {
  EndpointRow& row = results.endpoints.rows[0];
  row.margin = 0.1;
  row.marginRelative = true;
  row.reference = 100.0;
  row.look = 1;
  PairCauses pair;
  pair.a = "ours";
  pair.b = "theirs";
  pair.remainder = "implementation";
  pair.differences = {{"tension", "allow", "cut"}, {"spring_update", "after", "before"}};
  pair.endpoints = {{"pressure",
                     "N/m²",
                     8,
                     part(30.0, 2.0),
                     {part(3.0, 4.0), part(22.0, 2.0)},
                     part(0.0, 0.0),
                     part(5.0, 1.0)}};
  return pair;
}

TEST(CompareCauses, SizeFirst_NamesWhatIsSeen) {
  CompareResults results = disagreeing();
  results.causes = {measuredCauses(results)};
  const Overview overview = compareOverview(results);
  EXPECT_EQ(overview.conclusion[1],
            "Pressure of theirs is 30.0 % higher than ours's on 8 packings: spring update 22.0, "
            "implementation 5.0, rest 3.0 (1 margin = 10.0 %).");
  EXPECT_EQ(rowNamed(overview, "theirs").cells[1].words, "pressure, most by spring update");
  const std::string csv = causesCsv(results);
  test::expectSays(csv, {"ours,theirs,pressure,N/m²,8,tension,allow,cut,yes,3,-1,7,no,\n"});
  results.causes[0].differences[1].declared = false;
  test::expectSays(compareOverview(results).conclusion[1], {"spring update 22.0 (not declared), "});
}

TEST(CompareCauses, ProfileThatWasAskedFor_IsDrawnAndListed) {
  CompareResults results = disagreeing();
  PairCauses pair = measuredCauses(results);
  for (const std::size_t bin : {0, 1}) {
    EndpointCauses& own = pair.profile.emplace_back(pair.endpoints[0]);
    own.endpoint = "stress_rr";
    own.bin = bin;
  }
  pair.profile[1].parts[1] = part(22.0, 30.0);
  results.causes = {pair};
  results.rings.rTilde = {0.5, 1.5};
  test::expectSays(causesCsv(results),
                   {"ours,theirs,stress_rr,N/m²,8,spring_update,after,before,yes,22,-8,52,no,1\n"});
  const std::vector<Figure> figures = profileCausesFigures(results);
  ASSERT_EQ(figures.size(), 1u);
  EXPECT_EQ(figures[0].name, "causes_stress_rr");
  // The part is drawn in the bin whose interval leaves out 0; all else is the rest.
  const std::vector<Curve>& curves = figures[0].panels.at(0).curves;
  ASSERT_EQ(curves.size(), 3u);
  EXPECT_EQ(curves[0].name, "spring update");
  EXPECT_DOUBLE_EQ(*curves[0].points[0].error, 11.0);
  EXPECT_DOUBLE_EQ(*curves[0].points[1].error, 0.0);
  EXPECT_EQ(curves[1].name, "rest");
  EXPECT_DOUBLE_EQ(*curves[1].points[0].error, 4.0);
  EXPECT_DOUBLE_EQ(*curves[1].points[1].error, 15.0);
  EXPECT_DOUBLE_EQ(*curves[2].points[0].error, 2.0);
}

TEST(CompareCauses, IntervalsThatHold0_AreNotNamed) {
  CompareResults results = disagreeing();
  PairCauses pair = measuredCauses(results);
  for (CausePart& own : pair.endpoints[0].parts) own = part(*own.mean, 30.0);
  pair.endpoints[0].remainder = part(5.0, 6.0);
  results.causes = {pair};
  const Overview overview = compareOverview(results);
  EXPECT_EQ(overview.conclusion[1],
            "Pressure of theirs is 30.0 % higher than ours's on 8 packings: no cause is shown (1 "
            "margin = 10.0 %).");
  EXPECT_EQ(rowNamed(overview, "theirs").cells[1].words, "pressure");
}

TEST(CompareCauses, WhatWasNotRun_SaysWhatItTakes) {
  CompareResults results = disagreeing();
  PairCauses pair = measuredCauses(results);
  pair.endpoints.clear();
  pair.missing = 40.0;
  results.causes = {pair};
  EXPECT_EQ(compareOverview(results).conclusion[1],
            "Causes of the differences of theirs were not measured: they take about 40.0 s; "
            "--causes asks for them.");
  results.causes[0].reason = "theirs has another normal law, whose constants it does not report";
  EXPECT_EQ(compareOverview(results).conclusion[1],
            "The differences of theirs against ours are not attributed: theirs has another normal "
            "law, whose constants it does not report.");
  results.causes.push_back(results.causes[0]);
  results.causes[1].b = "third";
  EXPECT_EQ(compareOverview(results).conclusion[1],
            "The differences of theirs against ours and third against ours are not attributed: "
            "theirs has another normal law, whose constants it does not report.");
}

/// Of one law, rigid contacts differ by their solvers alone: no run of mixtures, no other law.
TEST(CompareCauses, OneLaw_IsTheSolver) {
  CompareResults results = disagreeing();
  PairCauses pair = measuredCauses(results);
  pair.differences.clear();
  pair.endpoints[0].parts.clear();
  pair.endpoints[0].remainder = pair.endpoints[0].whole;
  pair.remainder = "solver";
  results.causes = {pair};
  const Overview overview = compareOverview(results);
  EXPECT_EQ(overview.conclusion[1],
            "Pressure of theirs is 30.0 % higher than ours's on 8 packings: solver 30.0 (1 margin "
            "= 10.0 %).");
  EXPECT_EQ(overview.conclusion.back(),
            "Next: compare the margins with the accuracy that is needed.");
  const std::string page = wholeTextOf(compareReport(results));
  EXPECT_EQ(page.find("mixtures"), std::string::npos);
  EXPECT_EQ(page.find("rest "), std::string::npos) << page;
}

/// A mirror of "theirs", and what it answers to it where the two peers disagree.
void addMirror(CompareResults& results, Verdict answer) {
  results.engines.push_back({"mirror", "", "", "theirs", Status::finished, ""});
  EndpointRow row = results.endpoints.rows[0];
  row.a = "mirror";
  row.kind = PairKind::mirrorImplementation;
  row.verdict = answer;
  results.endpoints.rows.push_back(row);
}

TEST(CompareOverview, MirrorAgreesWithItsPeer_IsAModelDifference) {
  CompareResults results = disagreeing();
  addMirror(results, Verdict::undecided);
  EXPECT_FALSE(isModelDifference(results, results.engines[1]));
  results.endpoints.rows.back().verdict = Verdict::pass;
  EXPECT_TRUE(isModelDifference(results, results.engines[1]));
}

TEST(CompareOverview, MirrorDisagreesWithItsPeer_IsNoModelDifference) {
  CompareResults results = disagreeing();
  results.lockstep.emplace();
  results.lockstep->rows = {lockstepRow(Equivalence::sameLaw)};
  EXPECT_TRUE(isModelDifference(results, results.engines[1]));

  addMirror(results, Verdict::fail);
  EXPECT_FALSE(isModelDifference(results, results.engines[1]));
  EXPECT_EQ(compareOverview(results).conclusion[1],
            "Causes of differences: theirs disagrees with its own mirror in " +
                endpointWords(results.endpoints.rows[0].endpoint) + ".");
}

TEST(CompareOverview, Conclusion_NamesTheNextStep) {
  CompareResults results = disagreeing();
  EXPECT_TRUE(has(compareConclusion(results).back(), "Next: compare the margins with"));
  results.endpoints.rows[1].verdict = Verdict::undecided;
  results.endpoints.rows[1].needs = 12;
  EXPECT_EQ(compareConclusion(results).back(),
            "Next: more packings, about 12 for the coordination of theirs against ours; the case "
            "plans no further interim analysis ([looks] in its file).");
  results.endpoints.looks.planned = {{8, 0.01}};
  EXPECT_TRUE(
      has(compareConclusion(results).back(), "ours; the same command with a larger --budget"));
  for (EndpointRow& row : results.endpoints.rows) row.verdict = Verdict::pass;
  EXPECT_EQ(compareConclusion(results),
            (std::vector<std::string>{"Against ours: theirs agreed on both endpoints.",
                                      "Nothing is left to decide at these margins."}));
  results.endpoints.alarms = {{"ours", "theirs", PairKind::peer, "all disks are gone"}};
  EXPECT_EQ(compareConclusion(results).back(),
            "Next: see the alarm on theirs: all disks are gone.");
  results.nothingJudged = NothingJudged{"the case has no margins", false};
  EXPECT_EQ(compareConclusion(results).back(), "Nothing was judged: the case has no margins.");
}

/// Five peers beside the reference: the terminal's form counts them, the report's names each.
TEST(CompareOverview, ManyEngines_AreCountedInTheBriefConclusion) {
  CompareResults results = disagreeing();
  EXPECT_EQ(compareConclusion(results, true), compareConclusion(results)) << "one peer";
  const Endpoints pair = results.endpoints.rows;
  const auto add = [&](const std::string& name, Verdict first, Verdict second) {
    results.engines.push_back({name, "", "", "", Status::finished, ""});
    for (EndpointRow row : pair) {
      row.b = name;
      row.verdict = row.endpoint == "pressure" ? first : second;
      results.endpoints.rows.push_back(row);
    }
  };
  add("equal", Verdict::pass, Verdict::pass);
  add("open", Verdict::pass, Verdict::undecided);
  add("far", Verdict::fail, Verdict::fail);
  add("other", Verdict::fail, Verdict::borderline);
  add("fourth", Verdict::notMeasured, Verdict::fail);
  const Names whole = compareConclusion(results), brief = compareConclusion(results, true);
  EXPECT_TRUE(whole.front().starts_with("Against ours: theirs disagreed on pressure and agreed"))
      << whole.front();
  EXPECT_EQ(brief.front(),
            "Against ours: 1 of 6 engines agreed on both endpoints; 1 left some borderline, "
            "undecided or absent; 4 disagreed on some: far on 2, theirs on 1, other on 1 and 1 "
            "more.");
  EXPECT_EQ(brief.back(), whole.back());
  for (const char* name : {"theirs", "far", "other", "fourth"}) {
    PairCauses& causes = results.causes.emplace_back(measuredCauses(results));
    causes.b = name;
    if (results.causes.size() > 2) causes.reason = fmt::format("{} has no law", name);
  }
  const Names cut = compareConclusion(results, true);
  ASSERT_EQ(cut.size(), 6u) << fmt::format("{}", fmt::join(cut, "\n"));
  EXPECT_EQ(cut[4], "… and 1 more sentence on causes: in the report");
  EXPECT_EQ(compareConclusion(results).size(), 6u);
}

/// Some of the endpoints of some pairs, answered at random; sometimes nothing was judged.
CompareResults randomResults(std::mt19937& random) {
  const auto upTo = [&](int most) { return std::uniform_int_distribution(0, most)(random); };
  const auto margins = [&] { return std::uniform_real_distribution(-6.0, 6.0)(random); };
  CompareResults results;
  for (const char* name : {"ours", "second", "third"})
    results.engines.push_back({name, "", "", "", Status::finished, ""});
  if (upTo(3) == 0) results.nothingJudged = NothingJudged{"2 packings of each engine", false};
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = a + 1; b < 3; ++b)
      for (const char* endpoint : {"pressure", "coordination", "mean_spin", "spin_at_wheel"}) {
        if (upTo(4) == 0) continue;
        EndpointRow row;
        row.a = results.engines[a].name;
        row.b = results.engines[b].name;
        row.endpoint = endpoint;
        row.verdict = results.nothingJudged ? Verdict::undecided
                                            : std::array{Verdict::pass, Verdict::borderline,
                                                         Verdict::fail, Verdict::undecided}
                                                  .at(static_cast<std::size_t>(upTo(3)));
        row.distance = margins();
        if (row.verdict == Verdict::undecided && upTo(3) > 0) row.needs = 5 + upTo(200);
        results.endpoints.rows.push_back(row);
      }
  SurrogateEngine own{"second", "mirror", 1e-4, 16, 0, {}, {}, true};
  for (const char* endpoint : {"pressure", "coordination", "mean_spin"})
    own.spotCheck.push_back({endpoint, margins(), 0.5 + std::abs(margins()), 0.01 * upTo(100), {}});
  results.endpoints.surrogates = {own};
  return results;
}

TEST(CompareSentences, SpotCheck_NamesTheFarthestEndpoint) {
  std::mt19937 random(1);
  for (int k = 0; k < 300; ++k) {
    const CompareResults results = randomResults(random);
    const SurrogateEngine& own = results.endpoints.surrogates.front();
    const auto farthest = std::ranges::max_element(
        own.spotCheck, {},
        [](const SpotCheckNumber& number) { return std::abs(*number.difference); });
    EXPECT_TRUE(has(describe(own), "margins of " + spaced(farthest->endpoint))) << describe(own);
  }
}

/// No row says "law verified" beside a run that shows another law.
TEST(CompareSentences, LateFault_IsInTheMatrix) {
  std::mt19937 random(3);
  CompareResults results = randomResults(random);
  LockstepRow row{.engine = "second", .verdict = Equivalence::sameLaw, .equivalent = 1e-10};
  results.lockstep.emplace().rows = {row};
  results.lockstep->rules.sameLaw = 1e-3;
  SurrogateEngine& own = results.endpoints.surrogates.front();
  const auto cell = [&] { return rowNamed(compareOverview(results), "second").cells.front(); };
  EXPECT_EQ(cell().verdict, Verdict::pass);
  own.inUse = false;
  own.alarm = "18 windows differ";
  own.observed = true;
  EXPECT_EQ(cell().verdict, Verdict::undecided);
  own.late.differs = true;
  own.late.beyond = 9;
  own.late.read = 18;
  own.late.equivalents = {{"kn", 0.58}};
  EXPECT_EQ(cell().verdict, Verdict::fail);
  EXPECT_EQ(cell().shown, "58.0 % of kₙ");
  EXPECT_TRUE(cell().words.starts_with("differs in 9 of 18 windows of its own run"))
      << cell().words;
}

TEST(CompareSentences, NextPair_IsUndecidedAndOneOfThoseShown) {
  std::mt19937 random(2);
  int named = 0;
  for (int k = 0; k < 300; ++k) {
    const CompareResults results = randomResults(random);
    const std::string next = compareConclusion(results).back();
    const auto isOpen = [](const EndpointRow& row) { return row.verdict == Verdict::undecided; };
    const bool shownIsOpen =
        std::ranges::any_of(results.endpoints.rows,
                            [&](const EndpointRow& row) { return isOpen(row) && row.a == "ours"; });
    if (!has(next, ", about ")) continue;
    ++named;
    const auto row = std::ranges::find_if(results.endpoints.rows, [&](const EndpointRow& each) {
      return each.needs &&
             has(next, fmt::format("about {} for the {} of {} against {};", *each.needs,
                                   endpointWords(each.endpoint), each.b, each.a));
    });
    ASSERT_NE(row, results.endpoints.rows.end()) << next;
    EXPECT_TRUE(isOpen(*row)) << next;
    EXPECT_EQ(shownIsOpen, row->a == "ours") << next;
    rowNamed(compareOverview(results), row->b);  // throws where the matrix does not have it
  }
  EXPECT_GT(named, 100);
}

TEST(CompareSentences, RandomResults_DoNotContradictEachOther) {
  std::mt19937 random(3);
  int judgedNothing = 0;
  for (int k = 0; k < 300; ++k) {
    const CompareResults results = randomResults(random);
    const Overview overview = compareOverview(results);
    const std::string head = fmt::format("{}", fmt::join(overview.conclusion, " "));
    const bool open = std::ranges::any_of(results.endpoints.rows, [](const EndpointRow& row) {
      return row.verdict == Verdict::undecided;
    });
    EXPECT_FALSE(open && has(head, "Nothing is left to decide")) << head;
    if (!results.nothingJudged) {
      EXPECT_FALSE(has(head, "Nothing was judged")) << head;
      continue;
    }
    ++judgedNothing;
    EXPECT_TRUE(has(head, "Nothing was judged")) << head;
    for (const char* verdict : {"agree", "undecided", "borderline"})
      EXPECT_FALSE(has(head, verdict)) << head;
    for (const OverviewRow& row : overview.rows)
      EXPECT_TRUE(row.cells[1].verdict == Verdict::notMeasured ||
                  row.cells[1].verdict == Verdict::notApplicable);
  }
  EXPECT_GT(judgedNothing, 30);
}

TEST(DifferenceFigures, BeyondTheAxis_IsMarkedWithItsNumber) {
  CompareResults results = disagreeing();
  results.rings.rTilde = {0.5, 1.5, 2.5};
  AgreementRow row{.a = "ours", .b = "theirs", .field = "spin"};
  for (const double margins : {0.5, 87.0, -6.0}) {
    AgreementRing ring{.ring = row.rings.size(), .difference = 2.0 * margins, .margin = 2.0};
    row.rings.push_back(ring);
  }
  results.agreement = {row};
  const Figure figure = differenceFigures(results, engineRuns(results)).at(0);
  const Panel& panel = figure.panels.at(0);
  ASSERT_EQ(panel.curves.size(), 3u);
  EXPECT_EQ(panel.curves[1].points.at(0).label, "87.0");
  EXPECT_EQ(panel.curves[2].points.at(0).label, "−6.00");
  for (const std::size_t k : {1u, 2u}) EXPECT_TRUE(isSeen(panel, panel.curves[k]));
  EXPECT_TRUE(has(figure.caption, "beyond 5 margins"));
}

TEST(DifferenceFigures, Differences_AreInMarginsWithTheirBand) {
  CompareResults results = disagreeing();
  results.rings.rTilde = {0.5, 1.5};
  AgreementRow row;
  row.a = "theirs";  // the reference is second: the sign is turned
  row.b = "ours";
  row.field = "stress_rr";
  AgreementRing ring{.difference = 4.0, .low = 3.0, .high = 5.0, .margin = 2.0};
  row.rings = {ring};
  ring.ring = 1;
  ring.margin.reset();
  row.rings.push_back(ring);
  results.agreement = {row};
  const auto figures = differenceFigures(results, engineRuns(results));
  ASSERT_EQ(figures.size(), 1u);
  EXPECT_EQ(figures[0].name, "difference_stress_rr");
  const Panel& panel = figures[0].panels[0];
  EXPECT_EQ(panel.band->high, 1.0);
  ASSERT_EQ(panel.curves.size(), 1u);
  EXPECT_EQ(panel.curves[0].name, "theirs");
  ASSERT_EQ(panel.curves[0].points.size(), 1u);  // a ring without a margin has no place
  EXPECT_EQ(panel.curves[0].points[0].y, -2.0);
  EXPECT_EQ(*panel.curves[0].points[0].error, 0.5);
}

TEST(ProfileFigures, SingleRunBesideMeans_IsDrawnByItselfAndItsMirrorIsNamed) {
  CompareResults results = disagreeing();
  results.rings.rTilde = {0.5, 1.5};
  results.engines.push_back({"mirror", "", "", "theirs", Status::finished, ""});
  Profile profile;
  profile.method = "slicing";
  profile.field = "volume_fraction";
  profile.mean = {1.0, 0.5};
  profile.standardError = {0.1, 0.1};
  for (const auto& [name, runs] : {std::pair("ours", 2), std::pair("theirs", 1), {"mirror", 2}}) {
    for (int k = 0; k < runs; ++k) {
      FlowRun run{.engine = name, .packing = k, .profiles = {profile}};
      results.runs.push_back(run);
    }
    if (runs > 1) {
      CouetteEnsemble mean{.engine = name, .profiles = {profile}};
      results.ensemble.push_back(mean);
    }
  }
  results.endpoints.surrogates = {{"theirs", "mirror", 1e-4, 16, 0, {}, {}, true}};
  const auto engines = engineRuns(results);
  const auto figures = profileFigures(results, engines);
  const auto namesIn = [&](const std::string& name) {
    std::vector<std::string> names;
    const auto figure = std::ranges::find(figures, name, &Figure::name);
    if (figure == figures.end()) return names;
    for (const Curve& curve : figure->panels.at(0).curves) {
      names.push_back(curve.name);
      EXPECT_TRUE(curve.points.front().error.has_value());
    }
    return names;
  };
  const std::vector<std::string> means = {"ours", "mirror for theirs"};
  EXPECT_EQ(namesIn("overview"), means);
  EXPECT_EQ(namesIn("profile_volume_fraction"), means);
  EXPECT_EQ(namesIn("single_runs"), (std::vector<std::string>{"theirs", "mirror"}));
  EXPECT_EQ(rowNamed(compareOverview(results), "theirs").cells.back().words,
            "the packings are run by mirror");
  EXPECT_EQ(rowNamed(compareOverview(results), "ours").cells.back().words, "");
  EXPECT_TRUE(has(describeBars(engines),
                  "Mirrors stand for engines that are evaluated through "
                  "them: mirror of theirs. Single runs of theirs are not"))
      << describeBars(engines);
}

}  // namespace
}  // namespace crossgrain::reports
