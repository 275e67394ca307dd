// Several reports in one folder, and the page that leads to them.
#include "reports/site/site.hpp"

#include <gtest/gtest.h>

#include "reports/flow/endpoint_text.hpp"
#include "reports/flow/overview.hpp"
#include "reports/report.hpp"
#include "reports/site/history.hpp"
#include "results/schema.hpp"
#include "support/files.hpp"
#include "tests/reports/report_text.hpp"
#include "tests/reports/sample_results.hpp"
#include "tests/support/temporary_folder.hpp"

namespace crossgrain::reports {
namespace {

EngineRow engine(const char* name, const char* mirrors = "") {
  return {name, "", "", mirrors, EngineStatus::ran, ""};
}

/// Two questions; ours answers them so.
SiteReport siteReportOf(const char* kind, CellState first, CellState second) {
  SiteReport report;
  report.folder = kind;
  report.digest.head.kind = kind;
  report.digest.head.setup.name = "quick";
  report.digest.engines = {engine("ours"), engine("theirs"), engine("mirror", "theirs")};
  Overview& overview = report.digest.overview;
  overview.columns = {{"slide", "", ""}, {"spin", "", ""}};
  OverviewCell one, two;
  one.state = first;
  two.state = second;
  overview.rows = {{"ours", true, {one, two}}, {"mirror", true, {one, two}}};
  return report;
}

TEST(SiteOverview, EachReport_HasItsMostSevereAnswer) {
  using enum CellState;
  const std::vector<SiteReport> reports = {
      siteReportOf("collide", good, bad), siteReportOf("compare", undecided, modelDifference),
      siteReportOf("stability", good, notMeasured), siteReportOf("thesis", bad, good)};
  const Overview overview = siteOverview(reports);
  ASSERT_EQ(overview.columns.size(), 4u);
  EXPECT_EQ(overview.columns[0].name, "collide quick");
  EXPECT_EQ(overview.columns[0].anchor, "collide/report.html");
  ASSERT_EQ(overview.rows.size(), 3u);
  const std::vector<OverviewCell>& ours = overview.rows[0].cells;
  EXPECT_EQ(ours[0].state, bad);
  EXPECT_EQ(ours[0].shown, "1 of 2 failed");
  EXPECT_EQ(ours[0].words, "spin");
  EXPECT_EQ(ours[1].state, undecided);
  EXPECT_EQ(ours[2].state, good);
  EXPECT_EQ(ours[2].shown, "1 of 1 passed");
  // A refuted claim is a finding about the thesis.
  EXPECT_EQ(ours[3].state, figure);
  EXPECT_EQ(ours[3].shown, "1 of 2 reproduced");
  // It took part, and no row is its.
  EXPECT_EQ(overview.rows[1].cells[0].state, figure);
  EXPECT_EQ(overview.conclusion,
            (std::vector<std::string>{
                "Failed: ours in collide quick.",
                "Undecided: ours in compare quick; each report has what would decide."}));
  EXPECT_EQ(siteOverview({reports[2]}).conclusion,
            std::vector<std::string>{"All passed or decided: ours."});
}

TEST(EngineOverview, EachReport_HasAnswersWithTheWayToThem) {
  using enum CellState;
  std::vector<SiteReport> reports = {siteReportOf("collide", good, bad),
                                     siteReportOf("compare", undecided, modelDifference),
                                     siteReportOf("thesis", bad, bad)};
  reports[0].digest.overview.rows[0].cells[1].anchor = "scores";
  reports[1].digest.overview.columns[0].name = "averages";  // a question of its own
  const Overview ours = engineOverview(reports, "ours");
  ASSERT_EQ(ours.rows.size(), 3u);
  ASSERT_EQ(ours.columns.size(), 3u);
  EXPECT_EQ(ours.columns[2].name, "averages");
  const auto statesOf = [&](std::size_t row) {
    std::vector<CellState> states;
    for (const OverviewCell& cell : ours.rows[row].cells) states.push_back(cell.state);
    return states;
  };
  EXPECT_EQ(statesOf(0), (std::vector{good, bad, notApplicable}));
  EXPECT_EQ(statesOf(1), (std::vector{notApplicable, modelDifference, undecided}));
  EXPECT_EQ(ours.rows[0].cells[1].anchor, "collide/report.html#scores");
  EXPECT_EQ(ours.rows[0].cells[0].anchor, "");
  EXPECT_EQ(ours.rows[1].anchor, "compare/report.html");
  // Claims of the thesis are not the engine's.
  EXPECT_EQ(
      ours.conclusion,
      (std::vector<std::string>{
          "Failed: 1 question (collide quick).",
          "Borderline or undecided: 1 question (compare quick).",
          "Model difference: true to the law that it declares: 1 question (compare quick)."}));
  EXPECT_EQ(engineOverview({siteReportOf("collide", good, good)}, "ours").conclusion,
            std::vector<std::string>{"Passed: 2 questions (collide quick)."});
  const Overview theirs = engineOverview(reports, "theirs");  // no row is its
  EXPECT_TRUE(theirs.rows.empty());
  EXPECT_EQ(theirs.conclusion,
            std::vector<std::string>{"Nothing is judged of it in these reports."});
}

SiteReport madeBy(const char* build, const char* started, CellState state, double margins) {
  SiteReport report = siteReportOf("compare", state, CellState::good);
  report.folder = std::string("made-by-") + build;
  report.digest.head.version = "0.3.0";
  report.digest.head.build = build;
  report.digest.head.started = started;
  for (OverviewRow& row : report.digest.overview.rows) row.cells[0].value = margins;
  return report;
}

TEST(History, TwoVersions_ShowWhatChanged) {
  using enum CellState;
  std::vector<SiteReport> reports = {madeBy("new", "2026-02-01", bad, 2.0),
                                     siteReportOf("collide", good, good),
                                     madeBy("old", "2026-01-01", good, 0.5)};
  reports[0].digest.values = {{"ours", "mean of spin", {figure, 3.0, "rad/s", "3 rad/s"}}};
  reports[2].digest.values = {{"ours", "mean of spin", {figure, 4.0, "rad/s", "4 rad/s"}}};
  std::vector<History> histories = historiesOf(reports);
  ASSERT_EQ(histories.size(), 1u);  // collisions have one report only
  const History& history = histories[0];
  EXPECT_EQ(history.name, "compare quick");
  EXPECT_EQ(stampOf(history.reports[0]->digest.head), "0.3.0 (old)");
  ASSERT_EQ(history.rows.size(), 5u);
  std::vector<std::string> engines;
  for (const HistoryRow& row : history.rows) engines.push_back(row.engine);
  EXPECT_EQ(engines, (std::vector<std::string>{"ours", "ours", "ours", "mirror", "mirror"}))
      << "an engine's rows stand together";
  EXPECT_EQ(history.rows[2].question, "mean of spin");
  EXPECT_EQ(changeOf(history.rows[0]), "passed → failed");
  EXPECT_EQ(changeOf(history.rows[1]), "");  // no number
  EXPECT_EQ(changeOf(history.rows[2]), "−25 %");
  EXPECT_EQ(sentencesOf(history),
            std::vector<std::string>{"2 answers changed from the first to the last: ours, slide "
                                     "(passed → failed) and mirror, slide (passed → failed)."});
  reports[0] = madeBy("new", "2026-02-01", good, 0.5);
  reports[0].digest.head.setup.toml = "other";
  histories = historiesOf(reports);
  EXPECT_EQ(changeOf(histories[0].rows[0]), "same");
  EXPECT_EQ(sentencesOf(histories[0]),
            (std::vector<std::string>{
                "No answer changed from the first to the last.",
                "The case is not the same in all of them: a change may be the case's."}));
}

TEST(History, OneVersion_HasNone) {
  using enum CellState;
  std::vector<SiteReport> reports = {madeBy("one", "2026-01-01", good, 1.0),
                                     madeBy("one", "2026-01-02", bad, 2.0)};
  EXPECT_TRUE(historiesOf(reports).empty());
  reports[1].digest.engines[1].version = "2";  // another engine is another version, too
  EXPECT_EQ(historiesOf(reports).size(), 1u);
  // What one report alone has did not change.
  reports[0].digest.overview = {};
  const auto histories = historiesOf(reports);
  for (const HistoryRow& row : histories.at(0).rows) EXPECT_EQ(changeOf(row), "");
}

TEST(History, Endpoints_HaveTheirMeans) {
  const CompareResults results = sample::compareResults(4, 10);
  const auto values = compareValues(results);
  ASSERT_FALSE(results.endpoints.rows.empty());
  const EndpointRow& row = results.endpoints.rows.front();
  const auto of = [&](const std::string& engine) {
    return std::ranges::find_if(values, [&](const DigestValue& value) {
      return value.engine == engine && value.quantity == "mean of " + endpointWords(row.endpoint);
    });
  };
  ASSERT_NE(of(row.a), values.end());
  ASSERT_NE(of(row.b), values.end());
  EXPECT_EQ(of(row.a)->cell.state, CellState::figure);
  EXPECT_DOUBLE_EQ(of(row.a)->cell.value.value(), row.reference.value());
  EXPECT_DOUBLE_EQ(of(row.b)->cell.value.value(), *row.reference + row.difference.value());
}

TEST(EnginePages, Names_AreFitForAnAddressEachOnce) {
  EXPECT_EQ(enginePages({engine("yade"), engine("my engine"), engine("my/engine")}),
            (std::vector<std::string>{"engine-yade.html", "engine-my-engine.html",
                                      "engine-my-engine-2.html"}));
}

TEST(SiteFolders, Names_AreFitForAnAddressEachOnce) {
  EXPECT_EQ(siteFolders({"out/two/", "out/two", "a b#c", ".hidden", "µ"}),
            (std::vector<std::string>{"two", "two-2", "a-b-c", "-hidden", "-"}));
}

TEST(Site, Index_LeadsToEachReport) {
  const TemporaryFolder folder;
  const auto site = folder.path() / "site";
  writeSite(
      {{"a/one", toJson(sample::lockstepResults())}, {"b/one", toJson(sample::stabilityResults())}},
      site);
  const std::string index = readFile(site / "index.html").value();
  for (const char* page : {"one/report.html", "one-2/report.html"}) {
    EXPECT_TRUE(has(index, std::string("href=\"") + page + "\"")) << page;
    EXPECT_TRUE(std::filesystem::exists(site / page)) << page;
    EXPECT_TRUE(has(readFile(site / "junit.xml").value(),
                    std::string("classname=\"") +
                        std::string(page).substr(0, std::string(page).find('/')) + "\""));
  }
  const std::string engine = readFile(site / "engine-grain.html").value();
  EXPECT_TRUE(has(index, "href=\"engine-grain.html\""));
  EXPECT_TRUE(has(engine, "href=\"one-2/report.html#"));
  EXPECT_FALSE(has(engine, "{{"));
  EXPECT_TRUE(has(index, "href=\"one-2/stability.csv\""));
  EXPECT_TRUE(std::filesystem::exists(site / "one-2/stability.csv"));
  EXPECT_FALSE(has(index, "{{"));
  EXPECT_TRUE(has(readFile(site / "summary.md").value(), "# crossgrain: 2 reports"));
}

}  // namespace
}  // namespace crossgrain::reports
