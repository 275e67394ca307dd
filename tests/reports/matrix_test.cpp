#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <sstream>

#include "reports/collide/report.hpp"
#include "reports/common/engines.hpp"
#include "reports/common/labels.hpp"
#include "reports/common/overview.hpp"
#include "reports/cost/report.hpp"
#include "reports/effects/report.hpp"
#include "reports/flow/endpoint_text.hpp"
#include "reports/flow/figures.hpp"
#include "reports/flow/overview.hpp"
#include "reports/flow/report.hpp"
#include "reports/lockstep/report.hpp"
#include "reports/regression/regression.hpp"
#include "reports/render/html.hpp"
#include "reports/stability/report.hpp"
#include "results/json_fields.hpp"
#include "tests/reports/report_text.hpp"
#include "tests/reports/sample_results.hpp"

namespace crossgrain::reports {
namespace {

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// State and number of a cell.
std::string shown(const OverviewCell& cell) {
  return fmt::format("{} {}", nameOf(cell.state), cell.shown);
}

const OverviewRow& rowOf(const Overview& overview, const std::string& name) {
  const auto found = std::ranges::find(overview.rows, name, &OverviewRow::name);
  if (found == overview.rows.end()) throw std::runtime_error("no row " + name);
  return *found;
}

Overview made(std::size_t rows, std::size_t columns) {
  Overview overview;
  for (std::size_t k = 0; k < columns; ++k)
    overview.columns.push_back({fmt::format("question {}", k + 1), "", ""});
  for (std::size_t k = 0; k < rows; ++k) {
    OverviewRow row{fmt::format("engine-{}", k + 1), true, {}};
    for (std::size_t c = 0; c < columns; ++c)
      row.cells.push_back({c == 0 ? CellState::good : CellState::bad, 0.3, "margins", "0.3 µm"});
    overview.rows.push_back(std::move(row));
  }
  overview.conclusion = {"One.", "Two."};
  return overview;
}

TEST(Endpoints, OfAnAssemblyGoByTheirNames) {
  EXPECT_EQ(endpointSymbol("stress_ratio", true), "σ_rφ/σ_rr");
  EXPECT_EQ(endpointSymbol("stress_ratio", false), "stress ratio");
}

TEST(OverviewText, IsAlignedWhateverTheLettersTake) {
  const auto lines = linesOf(overviewText(made(2, 2), {}));
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_EQ(lines[0], "engine    question 1  question 2");
  EXPECT_EQ(lines[1], "engine-1  ✓ 0.3 µm    ✗ 0.3 µm");
  EXPECT_EQ(lines[4], "Two.");
}

TEST(OverviewText, HasColoursWhereTheyAreWantedOnly) {
  EXPECT_FALSE(has(overviewText(made(1, 1), {160, false}), "\033"));
  EXPECT_TRUE(has(overviewText(made(1, 1), {160, true}), "\033[32m✓ 0.3 µm"));
}

TEST(OverviewText, HasAtMostTwentyFiveLinesAndSaysWhatIsLeftOut) {
  for (const std::size_t rows : {1u, 21u, 22u, 23u, 100u})
    for (const std::size_t width : {40u, 80u, 160u})
      EXPECT_LE(linesOf(overviewText(made(rows, 9), {width, false})).size(), mostOverviewLines)
          << rows << " " << width;
  EXPECT_TRUE(has(overviewText(made(100, 1), {}), "… and 79 more rows: in the report"));
  EXPECT_FALSE(has(overviewText(made(22, 1), {}), ": in the report"));
}

TEST(OverviewText, LeavesOutColumnsWhereTheirBlocksAreTooMany) {
  for (const std::size_t rows : {1u, 2u, 9u})
    for (const std::size_t width : {1u, 20u, 40u}) {
      const std::string text = overviewText(made(rows, 27), {width, false});
      EXPECT_LE(linesOf(text).size(), mostOverviewLines) << rows << " " << width;
      EXPECT_TRUE(has(text, "more columns: in the report")) << rows << " " << width;
      EXPECT_TRUE(has(text, "question 1"));
    }
}

TEST(OverviewMarkdown, ManyQuestionsAreRows) {
  const std::string text = overviewMarkdown(made(2, mostColumns + 1), "t");
  EXPECT_TRUE(has(text, "\n| question 11 | ✗ 0.3 µm | ✗ 0.3 µm |\n"));
}

TEST(OverviewText, KeepsToTheWidthOfTheTerminal) {
  for (const std::string& line : linesOf(overviewText(made(3, 9), {60, false})))
    EXPECT_LE(line.size(), 60u + 6u) << line;  // marks and µ take bytes more than places
}

TEST(OverviewMarkdown, IsATableWhateverTheNames) {
  Overview overview = made(1, 1);
  overview.rows[0].name = "a|b_c";
  const std::string text = overviewMarkdown(overview, "compare: <x>");
  EXPECT_TRUE(has(text, "# compare: \\<x\\>\n\n| engine | question 1 |\n|---|---|\n"));
  EXPECT_TRUE(has(text, "| a\\|b\\_c | ✓ 0.3 µm |\n\nOne.\n\nTwo.\n"));
}

TEST(CompareOverview, HasTheWorstEndpointAndSurrogates) {
  const Overview overview = compareOverview(sample::compareResults(4, 30));
  ASSERT_EQ(overview.columns[1].name, "largest difference from grain");
  EXPECT_EQ(shown(rowOf(overview, "grain").cells[1]), "not_applicable ");
  EXPECT_EQ(shown(rowOf(overview, "yade").cells[1]), "good 0.200 margins");
  EXPECT_EQ(rowOf(overview, "yade").cells[1].words, "spin at the wheel");
  // Not its mirror's own rows: its runs are yade's.
  EXPECT_EQ(rowOf(overview, "grain~yade").cells[1].words, "surrogate of yade");
  const OverviewCell& alarmed = rowOf(overview, "box2d-impulse").cells[1];
  EXPECT_EQ(shown(alarmed), "bad 1.10 margins");
  EXPECT_EQ(alarmed.words, "ALARM: pressure; on 1 packing in another regime");
  EXPECT_EQ(shown(rowOf(overview, "yade").cells[3]), "bad 1 of 4");
  EXPECT_EQ(shown(rowOf(overview, "grain").cells[3]), "good 0 of 4");
  EXPECT_EQ(shown(rowOf(overview, "odd-one").cells[3]), "not_applicable refused");
}

/// Two engines; the second disagrees on one of two endpoints.
CompareResults disagreeing() {
  CompareResults results;
  results.engines = {{"ours", "", "", "", EngineStatus::ran, ""},
                     {"theirs", "", "", "", EngineStatus::ran, ""}};
  for (const auto& [endpoint, answer] :
       {std::pair("pressure", Answer::disagree), std::pair("coordination", Answer::noDifference)}) {
    EndpointRow row;
    row.a = "ours";
    row.b = "theirs";
    row.endpoint = endpoint;
    row.answer = answer;
    row.distance = answer == Answer::disagree ? 3.0 : 0.1;
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

TEST(CompareOverview, NamesTheLawAsCauseOnlyWhereThatIsShown) {
  CompareResults results = disagreeing();
  EXPECT_EQ(shown(rowOf(compareOverview(results), "theirs").cells[1]), "bad 3.00 margins");
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
  EXPECT_EQ(shown(rowOf(same, "theirs").cells[0]), "good 0.0100 × limit");
  EXPECT_EQ(shown(rowOf(same, "theirs").cells[1]), "model_difference 3.00 margins");
  EXPECT_EQ(same.conclusion[1],
            "Causes of differences: theirs differs by the law that it declares.");

  results.lockstep->rows = {lockstepRow(Equivalence::differs)};
  results.lockstep->rows[0].term = NamedTerm{"gt", 0.02, 0.1};
  const Overview other = compareOverview(results);
  EXPECT_EQ(shown(rowOf(other, "theirs").cells[0]), "bad 20.0 × limit");
  EXPECT_EQ(shown(rowOf(other, "theirs").cells[1]), "bad 3.00 margins");
  EXPECT_EQ(
      other.conclusion[1],
      "Causes of differences: theirs does not have the law that it declares (deviation found: "
      "the tangential damping).");
}

/// A mirror of "theirs", and what it answers to it where the two peers disagree.
void addMirror(CompareResults& results, Answer answer) {
  results.engines.push_back({"mirror", "", "", "theirs", EngineStatus::ran, ""});
  EndpointRow row = results.endpoints.rows[0];
  row.a = "mirror";
  row.kind = PairKind::mirrorImplementation;
  row.answer = answer;
  results.endpoints.rows.push_back(row);
}

TEST(CompareOverview, AMirrorThatAgreesWithItsPeerIsAModelDifference) {
  CompareResults results = disagreeing();
  addMirror(results, Answer::undecided);
  EXPECT_FALSE(isModelDifference(results, results.engines[1]));
  results.endpoints.rows.back().answer = Answer::smallDifference;
  EXPECT_TRUE(isModelDifference(results, results.engines[1]));
}

TEST(CompareOverview, DisagreementWithItsMirrorIsNoModelDifference) {
  CompareResults results = disagreeing();
  results.lockstep.emplace();
  results.lockstep->rows = {lockstepRow(Equivalence::sameLaw)};
  EXPECT_TRUE(isModelDifference(results, results.engines[1]));

  addMirror(results, Answer::disagree);
  EXPECT_FALSE(isModelDifference(results, results.engines[1]));
  EXPECT_EQ(compareOverview(results).conclusion[1],
            "Causes of differences: theirs disagrees with its own mirror in " +
                endpointWords(results.endpoints.rows[0].endpoint) + ".");
}

TEST(CompareOverview, NamesTheNextStep) {
  CompareResults results = disagreeing();
  EXPECT_TRUE(has(compareConclusion(results).back(), "Next: compare the margins with"));
  results.endpoints.rows[1].answer = Answer::undecided;
  results.endpoints.rows[1].needs = 12;
  EXPECT_EQ(compareConclusion(results).back(),
            "Next: more packings, about 12 for the coordination of theirs against ours; the case "
            "plans no further interim analysis ([looks] in its file).");
  results.endpoints.looks.planned = {{8, 0.01}};
  EXPECT_TRUE(
      has(compareConclusion(results).back(), "ours; the same command with a larger --budget"));
  for (EndpointRow& row : results.endpoints.rows) row.answer = Answer::noDifference;
  EXPECT_EQ(compareConclusion(results),
            (std::vector<std::string>{"Against ours: theirs agreed on both endpoints.",
                                      "Nothing is left to decide at these margins."}));
  results.endpoints.alarms = {{"ours", "theirs", PairKind::peer, "all disks are gone"}};
  EXPECT_EQ(compareConclusion(results).back(),
            "Next: see the alarm on theirs: all disks are gone.");
  results.nothingJudged = NothingJudged{"the case has no margins", false};
  EXPECT_EQ(compareConclusion(results).back(), "Nothing was judged: the case has no margins.");
}

/// Some of the endpoints of some pairs, answered at random; sometimes nothing was judged.
CompareResults randomResults(std::mt19937& random) {
  const auto upTo = [&](int most) { return std::uniform_int_distribution(0, most)(random); };
  const auto margins = [&] { return std::uniform_real_distribution(-6.0, 6.0)(random); };
  CompareResults results;
  for (const char* name : {"ours", "second", "third"})
    results.engines.push_back({name, "", "", "", EngineStatus::ran, ""});
  if (upTo(3) == 0) results.nothingJudged = NothingJudged{"2 packings of both engines", false};
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = a + 1; b < 3; ++b)
      for (const char* endpoint : {"pressure", "coordination", "mean_spin", "spin_at_wheel"}) {
        if (upTo(4) == 0) continue;
        EndpointRow row;
        row.a = results.engines[a].name;
        row.b = results.engines[b].name;
        row.endpoint = endpoint;
        row.answer = results.nothingJudged ? Answer::undecided : static_cast<Answer>(upTo(4));
        row.distance = margins();
        if (row.answer == Answer::undecided && upTo(3) > 0) row.needs = 5 + upTo(200);
        results.endpoints.rows.push_back(row);
      }
  SurrogateEngine own{"second", "mirror", 1e-4, 16, 0, {}, {}, true};
  for (const char* endpoint : {"pressure", "coordination", "mean_spin"})
    own.spotCheck.push_back({endpoint, margins(), 0.5 + std::abs(margins()), 0.01 * upTo(100), {}});
  results.endpoints.surrogates = {own};
  return results;
}

TEST(CompareSentences, TheFarthestEndpointIsNamed) {
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

TEST(CompareSentences, ThePairThatIsNextIsOpenAndOneOfThoseShown) {
  std::mt19937 random(2);
  int named = 0;
  for (int k = 0; k < 300; ++k) {
    const CompareResults results = randomResults(random);
    const std::string next = compareConclusion(results).back();
    const auto isOpen = [](const EndpointRow& row) { return row.answer == Answer::undecided; };
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
    rowOf(compareOverview(results), row->b);  // throws where the matrix does not have it
  }
  EXPECT_GT(named, 100);
}

TEST(CompareSentences, DoNotContradictEachOther) {
  std::mt19937 random(3);
  int judgedNothing = 0;
  for (int k = 0; k < 300; ++k) {
    const CompareResults results = randomResults(random);
    const Overview overview = compareOverview(results);
    const std::string head = fmt::format("{}", fmt::join(overview.conclusion, " "));
    const bool open = std::ranges::any_of(results.endpoints.rows, [](const EndpointRow& row) {
      return row.answer == Answer::undecided;
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
      EXPECT_TRUE(row.cells[1].state == CellState::notMeasured ||
                  row.cells[1].state == CellState::notApplicable);
  }
  EXPECT_GT(judgedNothing, 30);
}

TEST(CompareReport, TheTableHasTheMatrixMarkOfTheSameAnswer) {
  CompareResults results = disagreeing();
  results.lockstep.emplace();
  results.lockstep->rules.referencePerturbation = "kn";
  results.lockstep->rows = {lockstepRow(Equivalence::sameLaw)};
  const std::string text = textOf(compareReport(results));
  EXPECT_TRUE(has(text, "≠ disagree by the declared law // 3.00 margins")) << text;
  EXPECT_FALSE(has(text, "| ✗ disagree"));
}

TEST(DifferenceFigures, WhatLiesBeyondTheAxisIsMarkedWithItsNumber) {
  CompareResults results = disagreeing();
  results.rings.rTilde = {0.5, 1.5, 2.5};
  AgreementRow row;
  row.a = "ours";
  row.b = "theirs";
  row.field = "spin";
  for (const double margins : {0.5, 87.0, -6.0}) {
    AgreementRing ring;
    ring.ring = row.rings.size();
    ring.difference = 2.0 * margins;
    ring.margin = 2.0;
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

TEST(ProfileFigures, ASingleRunBesideMeansIsPaleAndItsMirrorIsNamed) {
  CompareResults results = disagreeing();
  results.rings.rTilde = {0.5, 1.5};
  results.engines.push_back({"mirror", "", "", "theirs", EngineStatus::ran, ""});
  Profile profile;
  profile.method = "slicing";
  profile.field = "spin";
  profile.mean = {1.0, 0.5};
  profile.standardError = {0.1, 0.1};
  for (const auto& [name, runs] : {std::pair("ours", 2), std::pair("theirs", 1), {"mirror", 2}}) {
    for (int k = 0; k < runs; ++k) {
      FlowRun run;
      run.engine = name;
      run.packing = k;
      run.profiles = {profile};
      results.runs.push_back(run);
    }
    if (runs > 1) {
      CouetteEnsemble mean;
      mean.engine = name;
      mean.profiles = {profile};
      results.ensemble.push_back(mean);
    }
  }
  results.endpoints.surrogates = {{"theirs", "mirror", 1e-4, 16, 0, {}, {}, true}};
  const auto engines = engineRuns(results);
  const auto figures = profileFigures(results, engines);
  const auto figure = std::ranges::find(figures, "profile_spin", &Figure::name);
  ASSERT_NE(figure, figures.end());
  const auto& curves = figure->panels.at(0).curves;
  ASSERT_EQ(curves.size(), 3u);
  EXPECT_EQ(curves[1].name, "theirs, one run");
  EXPECT_NE(curves[1].style.colour, engines[1].style.colour);
  EXPECT_FALSE(curves[1].points.at(0).error);
  EXPECT_EQ(curves[2].name, "mirror");
  EXPECT_EQ(curves[2].style.colour, engines[2].style.colour);
  EXPECT_TRUE(curves[2].points.at(0).error);
  EXPECT_TRUE(has(describeBars(engines), "theirs (its verdicts rest on mirror)"));
}

TEST(CollideOverview, HasTheLargestShareOfALimitByLaw) {
  CollideResults results = sample::collideResults();
  const Overview overview = collideOverview(results);
  ASSERT_EQ(overview.columns[0].name, "cases passed");
  ASSERT_EQ(overview.columns[1].name,
            "tangential rebound Ψ_f");  // no engine has scores of the others
  // 12/50² at t_c/50, half of it is told, the limit is 0.01.
  EXPECT_EQ(shown(rowOf(overview, "grain").cells[1]), "good 0.24 × limit");
  EXPECT_EQ(shown(rowOf(overview, "yade").cells[1]), "bad 1.2 × limit");
  EXPECT_EQ(rowOf(overview, "yade").cells[1].anchor, "case_1");
  EXPECT_EQ(shown(rowOf(overview, "grain").cells[0]), "good 6 of 6");
  EXPECT_EQ(rowOf(overview, "odd-one").cells[0].state, CellState::bad);
  EXPECT_EQ(
      overview.conclusion[0],
      "Passed every sweep: grain; failed: box2d-impulse (2 of 2 sweeps) and yade (2 of 6); not "
      "judged: odd-one.");
  EXPECT_EQ(overview.conclusion[1], "Fails most often: tangential rebound Ψ_f.");
  EXPECT_EQ(overview.conclusion.back(), "Next: see why sweeps failed, in the table of scores.");

  for (CollisionVariant& variant : results.variants)
    for (CollisionCurve& curve : variant.curves)
      if (curve.engine == "yade") {
        DeclaredScore& declared = curve.declared.emplace();
        declared.law = {{"tension", std::string("cut")}};
        declared.reference = DeclaredReference::oracle;
        declared.score.verdict = Verdict::pass;
        QuantityScore& psi = declared.score.of[QuantityId::psiF].emplace();
        psi.max = 0.001;
        psi.limit = 0.01;
        psi.held = true;
      }
  const Overview declared = collideOverview(results);
  EXPECT_EQ(shown(rowOf(declared, "yade").cells[1]), "model_difference 1.2 × limit");
  // Four of yade's sweeps hold in spite of it, two differ: it explains nothing.
  EXPECT_EQ(declared.conclusion[1], "Fails most often: tangential rebound Ψ_f.");
  for (CollisionVariant& variant : results.variants)
    for (CollisionCurve& curve : variant.curves)
      if (curve.engine == "yade" && curve.score.verdict == Verdict::pass)
        curve.declared->law.clear();
  EXPECT_EQ(collideOverview(results).conclusion[1],
            "Laws differ most by: tension cut (yade); fails most often: tangential rebound Ψ_f.");
}

TEST(CollideOverview, ConclusionIsShortForManyEngines) {
  const std::vector<std::string> conclusion =
      collideOverview(sample::manyCollideResults()).conclusion;
  EXPECT_LE(conclusion.size(), 3u);
  for (const std::string& sentence : conclusion) EXPECT_LE(sentence.size(), 240u) << sentence;
  EXPECT_TRUE(
      has(conclusion[0], "box2d-impulse-3 (2 of 2), yade (2 of 6), yade-2 (2 of 6) and 1 more."));
}

TEST(StabilityOverview, CountsRunsByFamily) {
  const Overview overview = stabilityOverview(sample::stabilityResults());
  ASSERT_EQ(overview.columns.size(), 1u);
  EXPECT_EQ(overview.columns[0].name, "energy");
  EXPECT_EQ(shown(rowOf(overview, "grain").cells[0]), "borderline 2 of 3");
  EXPECT_EQ(shown(rowOf(overview, "odd-one").cells[0]), "bad 1 of 2");
  EXPECT_EQ(rowOf(overview, "odd-one").cells[0].words, "pile");
  EXPECT_EQ(rowOf(overview, "odd-one").cells[0].anchor, "case_1");
  EXPECT_EQ(overview.conclusion[1], "Unstable: odd-one in pile.");
}

TEST(StabilityOverview, OfTransformsNamesWhatDiffers) {
  StabilityResults results;
  results.engines = {{"mine", "", "", "", EngineStatus::ran, ""},
                     {"theirs", "", "", "", EngineStatus::ran, ""}};
  for (const auto& [measure, variant] :
       {std::pair("turned", "turned by 1 rad"), std::pair("renumbered", "renumbered")}) {
    HardCase one;
    one.name = "cell";
    one.variant = variant;
    one.measure = measure;
    results.cases.push_back(one);
    for (const EngineRow& engine : results.engines) {
      StabilityRun run;
      run.engine = engine.name;
      run.name = "cell";
      run.variant = variant;
      run.measure = measure;
      run.verdict = Verdict::pass;
      results.runs.push_back(run);
    }
  }
  EXPECT_TRUE(areTransforms(results));
  EXPECT_EQ(stabilityOverview(results).conclusion[0], "mine and theirs: both runs the same.");
  results.runs[1].verdict = Verdict::fail;
  const Overview overview = stabilityOverview(results);
  ASSERT_EQ(overview.columns.size(), 2u);
  EXPECT_EQ(shown(rowOf(overview, "theirs").cells[0]), "bad 0 of 1");
  EXPECT_EQ(shown(rowOf(overview, "theirs").cells[1]), "good 1 of 1");
  EXPECT_EQ(overview.conclusion[0], "mine: both runs the same; theirs: 1 of 2 runs the same.");
  EXPECT_EQ(overview.conclusion[1],
            "Different after a transformation: theirs with cell turned by 1 rad.");
  EXPECT_FALSE(areTransforms(sample::stabilityResults()));
}

TEST(CostOverview, HasSettingAndTimeForEachAccuracy) {
  const Overview overview = costOverview(sample::costResults());
  ASSERT_FALSE(overview.columns.empty());
  EXPECT_EQ(overview.columns[0].name, "collisions 10\u00a0%");
  const OverviewCell& first = rowOf(overview, "grain").cells[0];
  EXPECT_EQ(first.state, CellState::good);
  EXPECT_FALSE(first.shown.empty());
  EXPECT_TRUE(has(first.words, "t_c/"));
  EXPECT_LE(overview.conclusion.size(), 3u);
  EXPECT_TRUE(has(overview.conclusion.back(), "--budget 1400s measures the "));
}

TEST(EffectsOverview, HasAnEffectPerRow) {
  const Overview overview = effectsOverview(sample::effectsResults(4));
  EXPECT_EQ(overview.rowsAre, "without");
  EXPECT_EQ(shown(rowOf(overview, "friction").cells[0]), "figure 50.0 %");
  EXPECT_EQ(rowOf(overview, "friction").cells[1].state, CellState::modelDifference);
  EXPECT_EQ(shown(rowOf(overview, "tension").cells[0]), "not_applicable refused");
  EXPECT_TRUE(has(overview.conclusion[0], "friction changes a profile"));
}

TEST(LockstepOverview, NamesTheDeviationFound) {
  LockstepResults results;
  results.engines = {{"theirs", "", "", "", EngineStatus::ran, ""}};
  results.lockstep.rules = {1e-10, 1e-3, 1e-3, "kn", 0.05};
  results.lockstep.rows = {lockstepRow(Equivalence::differs)};
  results.lockstep.rows[0].term = NamedTerm{"kn", -0.02, 0.1};
  EXPECT_EQ(shown(lockstepOverview(results).rows[0].cells[0]), "bad 2.00 % of kₙ");
  results.lockstep.rows[0].term = NamedTerm{"mu", -0.02, 0.1};
  const Overview overview = lockstepOverview(results);
  EXPECT_EQ(shown(overview.rows[0].cells[0]), "bad 20.0 × limit");
  EXPECT_EQ(shown(overview.rows[0].cells[4]), "bad −2.00 %");
  EXPECT_EQ(overview.conclusion[0], "theirs is another law than it declares.");
  EXPECT_EQ(overview.conclusion.size(), 3u);
}

TEST(DiffOverview, NamesWhatHasChanged) {
  DiffResults results;
  results.rules.referencePerturbation = "kn";
  DiffRow same;
  same.engine = "one";
  same.verdict = same.windowsVerdict = same.collisionsVerdict = Equivalence::sameBits;
  DiffRow other = same;
  other.engine = "two";
  other.verdict = other.collisionsVerdict = Equivalence::differs;
  other.collisions = {{"case", "", "psi_f", 3, 9, 0.1, 0.05, 1.0, 0.1}};
  results.rows = {same, other};
  const Overview overview = diffOverview(results);
  EXPECT_EQ(shown(rowOf(overview, "one").cells[1]), "good same bits");
  EXPECT_EQ(shown(rowOf(overview, "two").cells[1]), "bad 5.00 %");
  EXPECT_EQ(overview.conclusion[0], "one: same bits; two: differs.");
  EXPECT_EQ(overview.conclusion[1], "Next: where the change of two is meant, keep a new baseline.");
}

EngineRow named(const char* name, const char* mirrors = "") {
  return {name, "", "", mirrors, EngineStatus::ran, ""};
}

TEST(EngineStyles, AreTheSameInEveryReport) {
  const auto two = engineStyles({named("grain"), named("box2d-penalty")});
  const auto three = engineStyles({named("my-own"), named("yade"), named("box2d-penalty")});
  EXPECT_EQ(two[1], three[2]);
  EXPECT_EQ(engineStyles({named("my-own")})[0], three[0]);
}

TEST(EngineStyles, AMirrorHasItsPeersColourDashedWhetherOrNotThatIsThere) {
  const LineStyle peer = engineStyles({named("yade")})[0];
  for (const LineStyle& mirror : {engineStyles({named("grain-as-yade")})[0],
                                  engineStyles({named("grain"), named("x", "yade")})[1]}) {
    EXPECT_EQ(mirror.colour, peer.colour);
    EXPECT_TRUE(mirror.dashed);
    EXPECT_NE(mirror.pointType, peer.pointType);
  }
}

TEST(EngineStyles, NoTwoOfAReportLookAlike) {
  std::vector<EngineRow> engines;
  for (int k = 0; k < 20; ++k) engines.push_back(named(fmt::format("engine-{}", k).c_str()));
  const auto styles = engineStyles(engines);
  for (std::size_t a = 0; a < styles.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) EXPECT_FALSE(styles[a] == styles[b]) << a << " " << b;
}

TEST(DifferenceFigures, AreInMarginsWithTheirBand) {
  CompareResults results;
  results.engines = {named("ours"), named("theirs")};
  results.rings.rTilde = {0.5, 1.5};
  AgreementRow row;
  row.a = "theirs";  // the reference is second: the sign is turned
  row.b = "ours";
  row.field = "stress_rr";
  AgreementRing ring;
  ring.difference = 4.0;
  ring.low = 3.0;
  ring.high = 5.0;
  ring.margin = 2.0;
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

TEST(MatrixHtml, ManyRows_HaveLimitedLines) {
  Overview overview;
  overview.columns = {{"slide", "", ""}};
  overview.rows.assign(mostRows, OverviewRow{"ours", true, {OverviewCell{}}});
  const auto isTall = [&](bool wrapped) {
    return has(htmlMatrix(overview, {}, wrapped), "overview tall");
  };
  EXPECT_FALSE(isTall(false));
  overview.rows.push_back(overview.rows.front());
  EXPECT_TRUE(isTall(false));
  EXPECT_FALSE(isTall(true));
}

}  // namespace
}  // namespace crossgrain::reports
