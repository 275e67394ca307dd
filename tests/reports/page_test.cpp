#include <gtest/gtest.h>

#include <cstdlib>
#include <set>

#include "reports/collide/report.hpp"
#include "reports/collide/table.hpp"
#include "reports/common/figure_data.hpp"
#include "reports/common/svg.hpp"
#include "reports/common/svg_style.hpp"
#include "reports/couette/overview.hpp"
#include "reports/couette/report.hpp"
#include "reports/report.hpp"
#include "results/schema.hpp"
#include "support/bad_input.hpp"
#include "support/files.hpp"
#include "tests/reports/has.hpp"
#include "tests/reports/sample_results.hpp"
#include "tests/support/temporary_folder.hpp"

namespace crossgrain {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using reports::has;

/// One folder of results with its report, made once for all tests of a kind.
struct Written {
  explicit Written(const auto& results) {
    writeReport(results, folder.path());
    page = readFile(folder.path() / "report.html").value();
  }
  TemporaryFolder folder;
  std::string page;
};

const Written& compared() {
  static const Written written(sample::compareResults(4, 300));
  return written;
}

const Written& single() {
  static const Written written(sample::compareResults(1, 100));
  return written;
}

const Written& collided() {
  static const Written written(sample::collideResults());
  return written;
}

/// The page without its embedded images, whose words are not the page's.
std::string withoutImages(std::string page) {
  for (std::size_t at; (at = page.find("src=\"data:")) != std::string::npos;)
    page.erase(at, page.find('"', at + 5) + 1 - at);
  return page;
}

const char* const awkwardAsHtml =
    "odd &lt;b&gt;&quot;name&quot;&lt;/b&gt; &amp; `touch pwned` {x &apos;y&apos; _z";

TEST(Pages, AreSelfContainedAndWellFilled) {
  for (const Written* written : {&compared(), &single(), &collided()}) {
    const std::string page = withoutImages(written->page);
    EXPECT_FALSE(has(page, "{{")) << page.substr(page.find("{{"), 80);
    EXPECT_FALSE(has(page, "}}")) << page.substr(page.find("}}") - 80, 80);
    for (const char* outside : {"http:", "https:", "src=", "<link", "@import", "url("})
      EXPECT_FALSE(has(page, outside)) << outside;
    for (const char* notANumber : {"nan", "NaN", "-inf", "null"})
      EXPECT_FALSE(has(page, std::string(">") + notANumber)) << notANumber;
    EXPECT_TRUE(has(page, "</html>"));
  }
}

/// How many parts gnuplot named in a drawing.
std::size_t partsOf(const std::string& svg) {
  std::size_t parts = 0;
  for (std::size_t at = 0; (at = svg.find("id=\"gnuplot_plot_", at)) != std::string::npos; ++at)
    ++parts;
  return parts;
}

TEST(FigureData, NamesWhatIsInTheDrawings) {
  for (const Written* written : {&compared(), &collided()}) {
    const fs::path plots = written->folder.path() / "plots";
    const auto figures = written == &compared()
                             ? reports::compareFigures(sample::compareResults(4, 300))
                             : reports::collideFigures(sample::collideResults());
    for (const reports::Figure& figure : figures) {
      const std::string svg = readFile(plots / (figure.name + ".svg")).value();
      const auto data =
          reports::figureData(figure, readFile(plots / (figure.name + ".axes")).value(), {});
      ASSERT_FALSE(data.is_null()) << figure.name;
      std::size_t parts = 0;
      for (const json& panel : data["panels"])
        for (const json& curve : panel["curves"])
          for (const json& part : curve["parts"]) {
            ++parts;
            EXPECT_TRUE(has(svg, "id=\"gnuplot_plot_" + part.get<std::string>() + "\""))
                << figure.name << part;
          }
      EXPECT_EQ(parts, partsOf(svg)) << figure.name;
    }
  }
}

TEST(Pages, LinksLeadSomewhere) {
  for (const Written* written : {&compared(), &single(), &collided()}) {
    std::size_t links = 0;
    for (std::size_t at = 0; (at = written->page.find("href=\"#", at)) != std::string::npos;
         ++links) {
      at += 7;
      const std::string target = written->page.substr(at, written->page.find('"', at) - at);
      EXPECT_TRUE(has(written->page, " id=\"" + target + "\"")) << target;
    }
    EXPECT_GT(links, 20u);
  }
}

TEST(Pages, OpenWithTheMatrixAndItsConclusion) {
  for (const Written* written : {&compared(), &single(), &collided()}) {
    const std::size_t matrix = written->page.find("id=\"overview\"");
    ASSERT_NE(matrix, std::string::npos);
    EXPECT_LT(matrix, written->page.find("<nav>"));
    EXPECT_LT(written->page.find("class=\"lead\""), written->page.find("<summary>In words"));
    EXPECT_TRUE(fs::exists(written->folder.path() / "summary.md"));
    EXPECT_TRUE(readResults(written->folder.path()).contains("overview"));
  }
}

TEST(Pages, EscapeWhatUsersWrote) {
  for (const Written* written : {&compared(), &collided()}) {
    EXPECT_TRUE(has(written->page, awkwardAsHtml));
    EXPECT_FALSE(has(written->page, "<b>\"name\""));
    EXPECT_TRUE(has(written->page, "# a &lt; b &amp; c"));
    EXPECT_FALSE(fs::exists(written->folder.path() / "plots" / "pwned"));
  }
}

TEST(Pages, NameEveryEngine) {
  for (const char* engine : {"grain", "yade", "box2d-impulse", "grain~yade"})
    EXPECT_TRUE(has(compared().page, std::string("</span>") + engine + "</th>")) << engine;
  for (const char* engine : {"grain", "yade", "box2d-impulse"})
    EXPECT_TRUE(has(collided().page, std::string("</span>") + engine + "</th>")) << engine;
}

TEST(ComparePage, ShowsFailedAndRefusedRunsWithTheirReasons) {
  EXPECT_TRUE(has(compared().page,
                  "<tr><th>yade</th><td>1</td><td>failed</td><td class=\"why\">worker died at t = "
                  "0.31 s (signal 11) &lt;oops&gt;</td></tr>"));
  EXPECT_TRUE(has(compared().page, std::string("<tr><th>odd-one") +
                                       "</th><td>all</td><td>refused</td><td class=\"why\">it "
                                       "lacks &quot;bottom_friction&quot; &amp; &lt;more&gt;"));
}

TEST(ComparePage, CountsVerdictsInWords) {
  EXPECT_TRUE(has(compared().page, "yade against grain: 2 of 2 endpoints agree."));
  EXPECT_TRUE(has(compared().page,
                  "box2d-impulse against grain: 0 of 2 endpoints agree, 1 disagree (pressure), 1 "
                  "borderline (spin at wheel)."));
  EXPECT_TRUE(
      has(compared().page,
          "Against grain: 2 of 4 endpoints agree, 1 disagree (pressure), 1 borderline (spin "
          "at wheel)."));
  EXPECT_TRUE(has(compared().page, "yade: 1 of 4 runs did not finish."));
  EXPECT_TRUE(has(single().page, "0 of 2 endpoints agree, 2 undecided."));
  EXPECT_TRUE(has(single().page, "Fewer than 4 packings"));
  EXPECT_FALSE(has(compared().page, "Fewer than 4 packings:"));
}

TEST(ComparePage, ShowsLooksCarriersAndAlarms) {
  const std::string& page = compared().page;
  EXPECT_TRUE(has(page, "1 alarm. Against grain:"));
  EXPECT_TRUE(has(page,
                  "Alarm. box2d-impulse against grain: 30 % of the disks are gone from the "
                  "cell."));
  EXPECT_TRUE(
      has(page,
          "Looked at 4 packings (1 of 2 looks), 2.5 of 5 % chance of a false disagree spent; the "
          "budget."));
  EXPECT_TRUE(has(page,
                  "2 pairs; agree is held endpoint by endpoint, disagree over the endpoints of "
                  "each pair, at 5 % each."));
  EXPECT_TRUE(has(page, "by grain~yade, B = 0.00200 margins"));
  EXPECT_TRUE(
      has(page,
          "yade: by its mirror grain~yade (ε<sub>eq</sub> 1.00×10⁻⁵; 16 windows alike leave at "
          "most 19 % of states unlike)"));
  EXPECT_FALSE(has(page, "packings decide with 90 % chance<"));
  EXPECT_TRUE(has(single().page, "12 to 20 packings decide with 90 % chance<"));
}

TEST(ComparePage, SaysRegimesAndSteadinessBeforeAnyMean) {
  const std::string& page = compared().page;
  const auto named = page.find(
      "Packing 2 stands still on grain, yade, grain~yade; flows on "
      "box2d-impulse.");
  ASSERT_NE(named, std::string::npos);
  EXPECT_LT(named, page.find("yade against grain:"));
  EXPECT_TRUE(has(page, "Not in the same regime as grain: box2d-impulse on packing 2."));
  EXPECT_TRUE(has(page, "Not steady: on grain outer pressure falls by 40 ± 8 %"));
  EXPECT_TRUE(has(page, "No drift seen over the averaged time: yade (down to 15 %)"));
  EXPECT_TRUE(has(page,
                  "rotations 0.25 to 1.25 since the hand-over, 5.25 to 6.25 since the ring "
                  "had closed"));
  EXPECT_TRUE(has(page, "<h3 id=\"regimes\">Regimes<"));
  EXPECT_TRUE(has(page, "<h3 id=\"steady-or-not\">Steady or not<"));
}

TEST(ComparePage, VerdictsAreWordsAndSymbolsNotColoursAlone) {
  EXPECT_TRUE(has(compared().page, "✓ agree, no difference seen</b>"));
  EXPECT_TRUE(has(compared().page, "≈ borderline</b>"));
  EXPECT_TRUE(has(compared().page, "✗ disagree</b>"));
  EXPECT_TRUE(has(single().page, "? undecided</b>"));
}

TEST(ComparePage, CostIsSummedOverFinishedRuns) {
  // 7.85 s at dt = 4e-5 s are 196 250 steps a run; 4 runs of the first engine, 3 of the second.
  EXPECT_TRUE(has(compared().page, ">785\u202f000<"));
  EXPECT_TRUE(has(compared().page, ">588\u202f750<"));
  // 1.1e-4 s of wall time a step.
  EXPECT_TRUE(has(compared().page, "<th>wall time per step</th><td class=\"n words\">110</td>"));
}

TEST(ComparePage, ChecksOfOneNumberAreATable) {
  EXPECT_TRUE(has(compared().page,
                  "<td class=\"why\">σ<sub>rr</sub> at the ring &lt;outside&gt;</td>"
                  "<th>grain</th><td class=\"n\">41.5\u00a0±\u00a01.2</td>"
                  "<td class=\"n\">40.25\u00a0±\u00a00.50</td>"));
  EXPECT_FALSE(fs::exists(compared().folder.path() / "plots" / "check_2.svg"));
}

TEST(ComparePage, TellsEffectsThatAreLeftOutOrExtra) {
  EXPECT_TRUE(has(compared().page, "<td class=\"disagree\">✗ not simulated</td>"));
  EXPECT_TRUE(has(compared().page, "<td class=\"disagree\">+ though not called for</td>"));
}

TEST(ComparePage, BarsOfOnePackingAreLabelledConditional) {
  EXPECT_TRUE(has(single().page, "conditional on its one packing"));
  EXPECT_FALSE(has(compared().page, "conditional on its one packing"));
}

TEST(CollidePage, ScoresHeldAndFellShort) {
  EXPECT_TRUE(
      has(collided().page, "10 of 14 judged sweeps held within their limits; 4 fell short"));
  // The matrix: of the sample's first engine, 0.5 × 12/50² of the range at the coarsest step, and
  // Ψ_f of the impulse engine half of 0.03 where the limit is 0.01.
  EXPECT_TRUE(has(collided().page, "<td class=\"change agree\"><b>✓ 6 of 6</b></td>"));
  EXPECT_TRUE(has(collided().page,
                  "<td class=\"change disagree\"><b>✗ 2 of 2</b><small>Ψ<sub>f</sub> 1.5 × its "
                  "limit</small></td>"));
  EXPECT_TRUE(has(collided().page, "<b>✗ failed</b><small>worker hung &lt;120 s&gt;</small>"));
  EXPECT_TRUE(has(collided().page, "Ψ<sub>f</sub> 0.0024, order 2.003\u00a0±\u00a00.012"));
}

/// What engines simulate is held against the effects of the variant that they ran.
TEST(CollidePage, EffectsAreThoseOfEachVariant) {
  CollideResults results = sample::collideResults();
  const auto pageOf = [](const CollideResults& of) { return Written(of).page; };
  const std::string all = pageOf(results);
  for (const char* effect : {"normal damping", "friction", "rotation"})
    EXPECT_TRUE(has(all, std::string("<tr><th>") + effect +
                             "</th><td>called for</td><td class=\"\">✓ simulated</td>"))
        << effect;
  // The sample's engines simulate moving walls, which no collision calls for.
  EXPECT_TRUE(has(all,
                  "<tr><th>moving walls</th><td>–</td><td class=\"disagree\">+ though not "
                  "called for</td>"));
  results.variants[1].effects = {"normal_damping", "rotation"};
  const std::string one = pageOf(results);
  EXPECT_TRUE(has(one,
                  "<tr><th>friction</th><td>called for in 1 of 2 scenes</td><td "
                  "class=\"disagree\">✓ simulated; + though not called for in 3 of 6 runs</td>"))
      << one.substr(one.find("<tr><th>friction"), 300);
  for (CollisionVariant& variant : results.variants)
    variant.effects.reset();  // of an earlier version
  EXPECT_FALSE(has(pageOf(results), "though not called for"));
}

TEST(CollidePage, WhatAContactDoesNotHaveIsADash) {
  EXPECT_TRUE(has(collided().page,
                  "<td class=\"n\">0.44</td><td class=\"n\">–</td><td class=\"n\">–</td>"));
}

TEST(CollidePage, NothingJudgedIsNoSuccess) {
  CollideResults results = sample::collideResults();
  for (CollisionVariant& variant : results.variants)
    for (CollisionCurve& curve : variant.curves) {
      curve.score.verdict = CurveVerdict::notJudged;
      if (auto& psi = curve.score.of[QuantityId::psiF]) {
        psi->limit.reset();
        psi->held.reset();
      }
    }
  EXPECT_TRUE(has(Written(results).page,
                  "Nothing was judged: the case has no [collision.margins] for what was "
                  "measured."));
  EXPECT_EQ(countOf(results).judged(), 0);
  for (CollisionVariant& variant : results.variants) {
    variant.oracleReason = "no limit";
    for (CollisionCurve& curve : variant.curves) curve.score.of[QuantityId::psiF].reset();
  }
  EXPECT_EQ(nothingJudged(results), "there is no oracle to judge by: no limit");
  EXPECT_EQ(nothingJudged(sample::collideResults()), "");
}

TEST(CollidePage, TellsModelFromImplementation) {
  CollideResults results = sample::collideResults();
  for (CollisionVariant& variant : results.variants)
    for (CollisionCurve& curve : variant.curves)
      if (curve.engine == "yade") {
        DeclaredScore& declared = curve.declared.emplace();
        declared.law = {{"tension", "cut"}};
        declared.reference = DeclaredReference::oracle;
        declared.score = curve.score;
        declared.score.of[QuantityId::psiF]->max = 0.001;
        declared.score.of[QuantityId::psiF]->held = true;
        declared.score.verdict = CurveVerdict::held;
      }
  const std::string page = Written(results).page;
  EXPECT_TRUE(has(page, "differ by their model: they hold to the law that their engine declares"));
  EXPECT_TRUE(has(page, "<td class=\"change degraded\"><b>≠ 2, ✓ 4 of 6</b>"));
  EXPECT_TRUE(has(page, "Declared instead: yade: tension cut."));
  EXPECT_TRUE(has(page, "<th>declared</th>"));
  const CollideCount count = countOf(results);
  EXPECT_EQ(count.modelDifference, 2);
  EXPECT_EQ(count.fellShort, 2);
}

TEST(CollidePage, ShowsTheOwnScheme) {
  CollideResults results = sample::collideResults();
  SchemeScore& own = results.variants[0].curves[0].ownScheme.emplace();
  own.position = 2e-14;
  own.velocity = 1e-9;
  own.limit = 1e-12;
  own.held = false;
  const std::string page = Written(results).page;
  EXPECT_TRUE(has(page, "<small>own scheme 1×10⁻⁹</small>"));
  EXPECT_TRUE(has(page, "<td class=\"disagree\">✗ 1×10⁻⁹</td>"));
  EXPECT_EQ(outcomeOf(results.variants[0].curves[0]), SweepOutcome::fellShort);
}

/// A mirror beside its peer says what the peer should do; alone it is an engine like any other.
TEST(CollidePage, MirrorsBesideTheirPeersAreNotCounted) {
  CollideResults results = sample::collideResults();
  const int before = countOf(results).judged();
  results.engines[1].mirrors = "grain";
  EXPECT_EQ(countOf(results).judged(), before - 6);
  results.engines[1].mirrors = "somebody else";
  EXPECT_EQ(countOf(results).judged(), before);
}

TEST(CollidePage, NamesPointsWithoutALimitAndWhy) {
  CollideResults results = sample::collideResults();
  results.variants[1].noLimit = {{0.5573, 1e-4, 0.1, "the law jumps"}};
  EXPECT_TRUE(has(Written(results).page,
                  "Not judged: spring and dashpot, Ψ<sub>i</sub> = 0.5573: the law jumps."));
}

std::size_t rowsOfScores(const std::string& page) {
  std::size_t rows = 0;
  for (std::size_t table = page.find("<table class=\"scores\">"); table != std::string::npos;
       table = page.find("<table class=\"scores\">", table + 1)) {
    const std::string own = page.substr(table, page.find("</table>", table) - table);
    for (std::size_t at = own.find("<th class=\"name\">"); at != std::string::npos;
         at = own.find("<th class=\"name\">", at + 1))
      ++rows;
  }
  return rows;
}

TEST(CollidePage, HasScoresButOfWhatHeldBetweenTimeSteps) {
  // 2 variants × (3 + 3 + 1) curves, less the middle ones of two engines, and one that failed.
  const std::string& page = collided().page;
  EXPECT_EQ(rowsOfScores(page), 2u * 5u + 1u);
  EXPECT_TRUE(has(page, "<td class=\"agree\">✓ 0.0024<small>0.0012</small></td>"));
  CollideResults results = sample::collideResults();
  CollisionCurve& middle = results.variants[0].curves[2];
  ASSERT_EQ(middle.engine, "grain");
  middle.score.verdict = CurveVerdict::fellShort;
  EXPECT_EQ(rowsOfScores(Written(results).page), 2u * 5u + 2u) << "what fell short is there";
}

TEST(AveragePage, SaysWhatItIs) {
  const Written written(sample::averageResults());
  const std::string page = withoutImages(written.page);
  EXPECT_TRUE(has(page, "<p class=\"kicker\">crossgrain average</p>"));
  EXPECT_TRUE(
      has(page, "<p class=\"lead\">12 snapshots of grain averaged: 7 fields in 20 rings.</p>"))
      << page.substr(page.find("class=\"lead\""), 200);
  EXPECT_TRUE(has(page, "Nothing was run and nothing compared"));
  const std::size_t matrix = page.find("id=\"overview\"");
  ASSERT_NE(matrix, std::string::npos);
  EXPECT_TRUE(has(page.substr(matrix, 4000), "regime"));
  EXPECT_TRUE(has(page, "The case: its cell, rings and weights"));
  for (const char* claim : {"crossgrain compare", "could be compared",
                            "No engine reports any "
                            "deviation",
                            "not simulated", "What ran", "as it was run", "{{", "}}",
                            "agreement.csv", "after hand-over"})
    EXPECT_FALSE(has(page, claim)) << claim;
  EXPECT_TRUE(fs::exists(written.folder.path() / "profiles.csv"));
  EXPECT_FALSE(fs::exists(written.folder.path() / "agreement.csv"));
}

TEST(RevPage, SaysWhatItIs) {
  RevResults results = sample::revResults();
  const std::string page = withoutImages(Written(results).page);
  EXPECT_TRUE(has(page, "crossgrain rev"));
  // 0.1/0.7 apart in the narrowest ring, the same from 1 d on.
  results.curves[1].mean[0] = 0.8;
  const Overview overview = reports::revOverview(results);
  ASSERT_EQ(overview.rows.size(), 1u);
  EXPECT_EQ(overview.rows[0].name, "volume fraction");
  EXPECT_EQ(overview.rows[0].cells[1].shown, "≥ 1 d");
  EXPECT_EQ(overview.rows[0].cells[0].state, CellState::notMeasured);
  EXPECT_EQ(overview.conclusion[1], "Within 5 % of slicing in every field: centre from 1 d.");
  results.curves[1].mean[2] = 0.9;
  EXPECT_EQ(reports::revOverview(results).rows[0].cells[1].state, CellState::borderline);
  EXPECT_TRUE(has(reports::revOverview(results).conclusion[1],
                  "Further off at any width: centre (volume fraction)"));
  EXPECT_TRUE(has(page,
                  "3 snapshots of grain: 1 field under 2 weights, in rings of widths from 0.5 "
                  "to 2.2 d."));
  EXPECT_TRUE(has(page, "Nothing was run and nothing compared but ways of averaging"));
  // Under "near d" of the first method, and dashes where no width was there to meet at.
  EXPECT_TRUE(has(page, "<td class=\"n\">0.95 (1 %)</td><td class=\"n\">–</td>"));
}

TEST(Svg, LosesItsTop) {
  const std::string svg =
      "<svg \n width=\"560\" height=\"380\"\n viewBox=\"0 0 560 380\"\n><g/></svg>";
  EXPECT_EQ(reports::withoutTop(svg, 30),
            "<svg \n width=\"560\" height=\"350\"\n viewBox=\"0 30 560 350\"\n><g/></svg>");
  EXPECT_EQ(reports::withoutTop(svg, 0), svg);
}

/// Two engines in two panels, the second with an unnamed companion of its colour.
std::vector<reports::Figure> twoPanels() {
  using namespace reports;
  const LineStyle black{"#000000", 7, false}, red{"#d55e00", 5, false}, open{"#d55e00", 4, false};
  Panel panel;
  panel.curves = {{"ours", black, Draw::linesAndPoints, {{0.0, 1.0, {}}}},
                  {"theirs", red, Draw::linesAndPoints, {{0.0, 2.0, 0.5}}},
                  {"", open, Draw::points, {{0.5, 1.0, {}}}},
                  {"slope −2", {"#888888", 0, true}, Draw::lines, {{0.0, 1.0, {}}}}};
  Figure figure;
  figure.name = "one";
  figure.panels = {panel};
  Figure other = figure;
  other.name = "two";
  return {figure, other};
}

TEST(FigureData, FindsWhoseCurvesAre) {
  using namespace reports;
  const auto figures = twoPanels();
  const auto legend = sharedLegend(figures);
  ASSERT_EQ(legend.size(), 2u);  // a guide is nobody's
  const auto& curves = figures[0].panels[0].curves;
  EXPECT_EQ(ownerOf(curves[0], legend), 0);
  EXPECT_EQ(ownerOf(curves[1], legend), 1);
  EXPECT_EQ(ownerOf(curves[2], legend), 1);
  EXPECT_EQ(ownerOf(curves[3], legend), -1);
  EXPECT_TRUE(sharedLegend({figures[0]}).empty()) << "nothing is shared by one panel";

  const json data = figureData(figures[0], "80 540 60 300 0 1 0.5 2.5\n", legend);
  const json& panel = data["panels"][0];
  EXPECT_EQ(panel["box"], json({80.0, 540.0, 80.0, 320.0}));
  EXPECT_EQ(panel["curves"][1]["parts"], json({"2", "3"}));
  EXPECT_EQ(panel["curves"][1]["points"], json::parse("[[0.0, 2.0, 0.5]]"));
  EXPECT_TRUE(figureData(figures[0], "", legend).is_null());
  EXPECT_TRUE(figureData(figures[0], "80 540 60\n", legend).is_null());
}

TEST(FigureData, SaysOnceWhereAllPointsOfACurveAre) {
  using namespace reports;
  auto figures = twoPanels();
  auto& curves = figures[0].panels[0].curves;
  curves[0].points = {{0.0, 1.0, {}, "", "packing 7"}, {0.5, 2.0, 0.1, "", "packing 7"}};
  curves[1].points = {{0.0, 1.0, {}, "", "ring 1"}, {0.5, 2.0, {}, "", "ring 2"}};
  const json data = figureData(figures[0], "80 540 60 300 0 1 0.5 2.5\n", {});
  const json& told = data["panels"][0]["curves"];
  EXPECT_EQ(told[0]["place"], "packing 7");
  EXPECT_EQ(told[0]["points"], json::parse("[[0.0, 1.0], [0.5, 2.0, 0.1]]"));
  EXPECT_FALSE(told[1].contains("place"));
  EXPECT_EQ(told[1]["points"],
            json::parse(R"([[0.0, 1.0, null, "ring 1"], [0.5, 2.0, null, "ring 2"]])"));
  EXPECT_FALSE(told[2].contains("place"));
}

TEST(FigureData, SaysOnceWherePointsOfSeveralCurvesAre) {
  using namespace reports;
  auto figures = twoPanels();
  auto& curves = figures[0].panels[0].curves;
  curves[0].points = {{0.0, 1.0, {}}, {0.5, 2.0, {}}};
  curves[2].points = {{0.0, 3.0, {}}, {0.5, 4.0, {}}};
  const json panel = figureData(figures[0], "80 540 60 300 0 1 0.5 2.5\n", {})["panels"][0];
  EXPECT_EQ(panel["xs"], json::parse("[[0.0, 0.5], [0.0]]"));
  EXPECT_EQ(panel["curves"][0]["xs"], 0);
  EXPECT_EQ(panel["curves"][2]["xs"], 0);
  EXPECT_EQ(panel["curves"][2]["ys"], json::parse("[3.0, 4.0]"));
  EXPECT_FALSE(panel["curves"][2].contains("points"));
  EXPECT_EQ(panel["curves"][1]["points"], json::parse("[[0.0, 2.0, 0.5]]")) << "it has a bar";
  EXPECT_EQ(panel["curves"][3]["xs"], 1);
}

TEST(FigureData, HasWhatPointsAreMeansOf) {
  using namespace reports;
  auto figures = twoPanels();
  Panel& panel = figures[0].panels[0];
  panel.logY = true;
  panel.curves[0].points = {{0.0, 1.0, {}}, {0.5, -1.0, {}}, {1.0, 3.0, {}}};
  panel.curves[0].each = {{0.9, -1.0, 2.99999}, {1.1, -1.0, NAN}, {-1.0, 1.0, 3.0}};
  const json data = figureData(figures[0], "80 540 60 300 0 1 0.5 2.5\n", {});
  const json& curves = data["panels"][0]["curves"];
  // As long as the points that are told, and null where a log axis has no place.
  EXPECT_EQ(curves[0]["each"], json::parse("[[0.9, 3.0], [1.1, null], [null, 3.0]]"));
  EXPECT_EQ(curves[0]["ys"].size(), 2u);
  EXPECT_EQ(curves[0]["colour"], "#000000");
  EXPECT_FALSE(curves[1].contains("each"));
}

TEST(FigureData, LeavesOutAKeyThatThePageHas) {
  using namespace reports;
  auto figures = twoPanels();
  const std::string axes = "80 540 60 300 0 1 0.5 2.5\n";
  const auto legend = sharedLegend(figures);
  EXPECT_EQ(keyRoom(figures[0], axes, legend), 0) << "the guide's name would be lost";
  figures[0].panels[0].curves.pop_back();
  EXPECT_EQ(keyRoom(figures[0], axes, legend), 380 - 300 - 12);
  EXPECT_EQ(figureData(figures[0], axes, legend)["height"], 380 - 68);
  EXPECT_EQ(keyRoom(figures[0], axes, {}), 0);
  figures[0].panels[0].key = Key::none;
  EXPECT_EQ(keyRoom(figures[0], axes, legend), 0);
}

TEST(Svg, IsShortenedWithoutTouchingWords) {
  const std::string head = "<?xml version=\"1.0\"?>\n<svg><defs><path d='M0.25,1.33'/></defs>";
  EXPECT_EQ(reports::compactSvg(
                head + "\n<g fill=\"none\" stroke-linecap=\"butt\">\n</g>\n"
                       "\t<path stroke='rgb( 68,  0, 255)'  d='M118.76,3.04 L2.00,-0.51  '/>\n"
                       "<text>n1.25 of 0.125</text></svg>"),
            head + "<path stroke='#4400ff' d='M118.8,3 2,-0.5'/><text>n1.25 of 0.125</text></svg>");
}

TEST(Svg, LinesLoseThePointsOnStraightParts) {
  const std::string head = "<svg><defs></defs>";
  const auto path = [&](const std::string& points) {
    const std::string svg = reports::compactSvg(head + "<path d='" + points + "'/></svg>");
    const std::size_t from = svg.find(" d='") + 4;
    return svg.substr(from, svg.find('\'', from) - from);
  };
  EXPECT_EQ(path("M0.0,0.0 L1.0,1.0 L2.0,2.05 L3.0,3.0 L4.0,0.0"), "M0,0 3,3 4,0");
  EXPECT_EQ(path("M0.0,0.0 L1.0,1.0 L2.0,2.5 L3.0,3.0"), "M0,0 1,1 2,2.5 3,3");
  // An outline comes back, where a point on a straight line may be a corner.
  EXPECT_EQ(path("M0.0,0.0 L1.0,0.0 L2.0,0.0 L1.5,0.0 M5.0,5.0 L6.0,6.0"),
            "M0,0 1,0 2,0 1.5,0M5,5 6,6");
  EXPECT_EQ(path("M0,1 h2 M0,-1 v2"), "M0,1 h2 M0,-1 v2");
}

TEST(Svg, MarksOfOneColourSayItOnce) {
  const std::string head = "<svg><defs></defs>";
  const std::string group = "<g color=\"black\" stroke=\"currentColor\">";
  const std::string red = "<use href='#a' color='#ff0000'/>",
                    blue = "<use href='#a' color='#0000ff'/>", plain = "<use href='#a'/>";
  const auto compact = [&](const std::string& marks) {
    return reports::compactSvg(head + group + marks + "</g></svg>");
  };
  EXPECT_EQ(compact(red + red),
            head + "<g color=\"#ff0000\" stroke=\"currentColor\">" + plain + plain + "</g></svg>");
  for (const std::string& marks : {red + blue, red + plain, "<path d='M1,2'/>" + red})
    EXPECT_EQ(compact(marks), head + group + marks + "</g></svg>");
}

TEST(Svg, SaysOnceHowThingsLook) {
  const std::string line = "<path stroke='#444444' stroke-width=\"2\" d='M1,2'/>",
                    text = "<g transform=\"translate(1,2)\" font-size=\"13\"><text>a</text></g>";
  const std::string once = "<path stroke='#00ff00' d='M1,2'/>";
  const std::string head = "<svg viewBox=\"0 0 1 1\"><defs></defs>";
  const std::string found =
      reports::styledByClasses(head + line + line + line + text + text + text + once);
  EXPECT_EQ(
      found,
      std::string(
          "<svg viewBox=\"0 0 1 1\"><style>.a{stroke:#444444;stroke-width:2;}.b{font-size:13px;}"
          "</style><defs></defs>") +
          "<path class='a' d='M1,2'/><path class='a' d='M1,2'/><path class='a' d='M1,2'/>"
          "<g transform=\"translate(1,2)\" class='b'><text>a</text></g>"
          "<g transform=\"translate(1,2)\" class='b'><text>a</text></g>"
          "<g transform=\"translate(1,2)\" class='b'><text>a</text></g>" +
          once);
  EXPECT_EQ(reports::styledByClasses(head + line + line), head + line + line) << "not worth it";
}

TEST(Svg, IsAnAddressThatEndsNoAttributeAndNoTag) {
  EXPECT_EQ(reports::svgAddress("<a b=\"1\" c=\"it's\">say \"100 %\" & 'so'\n</a>"),
            "data:image/svg+xml,%3Ca b='1' c=%22it's%22%3Esay %22100 %25%22 %26 'so'%0A%3C/a%3E");
}

TEST(Plots, ExistAsSvgAndPdfWithScriptAndData) {
  const fs::path plots = compared().folder.path() / "plots";
  for (const char* name :
       {"overview", "profile_volume_fraction", "profile_azimuthal_velocity",
        "profile_azimuthal_velocity_log", "profile_spin", "profile_stress_rr", "profile_stress_pp",
        "profile_stress_rp", "profile_fabric_trace", "check_1", "series_wheel_torque",
        "series_outer_pressure", "series_coordination"})
    for (const char* kind : {".svg", ".pdf", ".gp", ".dat"}) {
      const auto content = readFile(plots / (std::string(name) + kind));
      ASSERT_TRUE(content.has_value()) << name << kind;
      EXPECT_GT(content->size(), 300u) << name << kind;
      const bool data = std::string(kind) == ".dat";
      EXPECT_TRUE(!data || !has(*content, "nan")) << name;
    }
  for (const char* name : {"collision_1.svg", "collision_1.pdf"})
    EXPECT_GT(fs::file_size(collided().folder.path() / "plots" / name), 1000u) << name;
  for (const char* name : {"origins_1_grain.svg", "origins_1_grain.pdf", "forces_2_yade.svg"})
    EXPECT_GT(fs::file_size(plots / name), 1000u) << name;
  for (const fs::path& folder : {plots, collided().folder.path() / "plots"})
    EXPECT_FALSE(fs::exists(folder / "gnuplot.log")) << "gnuplot had something to say";
}

TEST(Report, IsTheSameWhenRebuilt) {
  const fs::path dir = collided().folder.path();
  const TemporaryFolder again;
  writeReport(readResults(dir), again.path());
  for (const char* file : {"results.json", "collisions.csv", "report.html"})
    EXPECT_EQ(readFile(again.path() / file), readFile(dir / file)) << file;
}

TEST(Report, StandsResultsWithAlmostNothingInThem) {
  const TemporaryFolder folder;
  for (const char* kind : {"average", "effects", "rev", "collide"})
    EXPECT_NO_THROW(
        writeReport(json{{"schema", "crossgrain-results-1"}, {"kind", kind}}, folder.path()))
        << kind;
  json compared = {{"schema", "crossgrain-results-1"}, {"kind", "compare"}};
  EXPECT_THROW(writeReport(compared, folder.path()), BadInput);  // there is no reference
  compared["engines"].push_back({{"name", "one"}});
  EXPECT_NO_THROW(writeReport(compared, folder.path()));
  json standing = toJson(sample::compareResults(2, 10));
  standing["runs"][0]["picture"] = nullptr;
  standing["cell"]["omega"] = 0.0;
  EXPECT_NO_THROW(writeReport(standing, folder.path()));
}

TEST(Report, NamesWhatIsWrongInAFile) {
  const TemporaryFolder folder;
  const auto complaint = [&](const json& broken) -> std::string {
    try {
      writeReport(broken, folder.path());
    } catch (const BadInput& error) {
      return error.what();
    }
    return {};
  };
  const std::string file = (folder.path() / "results.json").string();
  const json whole = toJson(sample::compareResults(2, 10));
  json broken = whole;
  broken["runs"][0]["profiles"][0]["mean"] = "not a list";
  EXPECT_EQ(complaint(broken), file + ": runs.0.profiles.0.mean: is string, not a list");
  broken = whole;
  broken["runs"][0]["picture"]["x"] = nullptr;
  EXPECT_EQ(complaint(broken), file + ": runs.0.picture.x: is null, not a list");
  broken = whole;
  broken["engines"][1] = 7;
  EXPECT_EQ(complaint(broken), file + ": engines.1: is number, not an object");
}

TEST(Report, SaysWhatAFileHoldsThatItShouldNot) {
  const TemporaryFolder folder;
  json broken = toJson(sample::collideResults());
  broken["variants"][0]["curves"][1]["points"]["psi_f"][3] = "fast";
  try {
    writeReport(broken, folder.path());
    FAIL() << "written";
  } catch (const BadInput& error) {
    EXPECT_TRUE(has(error.what(),
                    "results.json: variants.0.curves.1.points.psi_f.3: is string, not a number"))
        << error.what();
  }
  EXPECT_FALSE(fs::exists(folder.path() / "results.json"));
}

/// Sets PATH for its lifetime.
class PathIs {
 public:
  explicit PathIs(const char* path) : old_(std::getenv("PATH")) { ::setenv("PATH", path, 1); }
  ~PathIs() { ::setenv("PATH", old_.c_str(), 1); }

 private:
  std::string old_;
};

TEST(Report, WithoutGnuplotEverythingElseIsThereAndOneLineSaysSo) {
  const TemporaryFolder folder;
  const PathIs nowhere("/nonexistent");
  std::string message;
  try {
    writeReport(sample::compareResults(1, 50), folder.path());
  } catch (const std::runtime_error& error) {
    message = error.what();
  }
  EXPECT_TRUE(message.starts_with("gnuplot cannot be started (No such file or directory)"));
  EXPECT_EQ(message.find('\n'), std::string::npos);
  const std::string page = readFile(folder.path() / "report.html").value();
  EXPECT_TRUE(has(page, "<p class=\"warning\">gnuplot cannot be started"));
  EXPECT_TRUE(fs::exists(folder.path() / "results.json"));
  EXPECT_TRUE(fs::exists(folder.path() / "profiles.csv"));
}

}  // namespace
}  // namespace crossgrain
