// Several reports in one folder, and the page that leads to them.
#include "reports/site/site.hpp"

#include <gtest/gtest.h>

#include "reports/report.hpp"
#include "results/schema.hpp"
#include "support/files.hpp"
#include "tests/reports/has.hpp"
#include "tests/reports/sample_results.hpp"
#include "tests/support/temporary_folder.hpp"

namespace crossgrain::reports {
namespace {

EngineRow engine(const char* name, const char* mirrors = "") {
  return {name, "", "", mirrors, EngineStatus::ran, ""};
}

/// Two questions; ours answers them so.
SiteReport reportOf(const char* kind, CellState first, CellState second) {
  SiteReport report;
  report.folder = kind;
  report.digest.head.kind = kind;
  report.digest.head.setup.name = "quick";
  report.digest.engines = {engine("ours"), engine("theirs"), engine("mirror", "theirs")};
  Overview& overview = report.digest.overview.emplace();
  overview.columns = {{"slide", "", ""}, {"spin", "", ""}};
  OverviewCell one, two;
  one.state = first;
  two.state = second;
  overview.rows = {{"ours", true, {one, two}}, {"mirror", true, {one, two}}};
  return report;
}

TEST(SiteOverview, TellsTheGravestAnswerOfEachReport) {
  using enum CellState;
  const std::vector<SiteReport> reports = {
      reportOf("collide", good, bad), reportOf("compare", undecided, modelDifference),
      reportOf("stability", good, notMeasured), reportOf("thesis", bad, good)};
  const Overview overview = siteOverview(reports);
  ASSERT_EQ(overview.columns.size(), 4u);
  EXPECT_EQ(overview.columns[0].name, "collide quick");
  EXPECT_EQ(overview.columns[0].anchor, "collide/report.html");
  ASSERT_EQ(overview.rows.size(), 3u);
  const std::vector<OverviewCell>& ours = overview.rows[0].cells;
  EXPECT_EQ(ours[0].state, bad);
  EXPECT_EQ(ours[0].shown, "1 of 2");
  EXPECT_EQ(ours[0].words, "spin");
  EXPECT_EQ(ours[1].state, undecided);
  EXPECT_EQ(ours[2].state, good);
  EXPECT_EQ(ours[2].shown, "1 of 1");
  // A refuted claim is a finding about the thesis.
  EXPECT_EQ(ours[3].state, figure);
  EXPECT_EQ(ours[3].shown, "1 of 2");
  // It took part, and no row is its.
  EXPECT_EQ(overview.rows[1].cells[0].state, figure);
  EXPECT_EQ(overview.conclusion,
            (std::vector<std::string>{
                "Falls short: ours in collide quick.",
                "Undecided: ours in compare quick; each report says what would decide."}));
  EXPECT_EQ(siteOverview({reports[2]}).conclusion,
            std::vector<std::string>{"Nothing is open, and nothing falls short, of ours."});
}

TEST(EngineOverview, HasTheAnswersOfEachReportWithTheWayToThem) {
  using enum CellState;
  std::vector<SiteReport> reports = {reportOf("collide", good, bad),
                                     reportOf("compare", undecided, modelDifference),
                                     reportOf("thesis", bad, bad)};
  reports[0].digest.overview->rows[0].cells[1].anchor = "scores";
  reports[1].digest.overview->columns[0].name = "averages";  // a question of its own
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
          "Falls short: 1 question (collide quick).",
          "Borderline or undecided: 1 question (compare quick).",
          "Differs by its model, true to the law that it declares: 1 question (compare quick)."}));
  EXPECT_EQ(engineOverview({reportOf("collide", good, good)}, "ours").conclusion,
            std::vector<std::string>{"Holds: 2 questions (collide quick)."});
  const Overview theirs = engineOverview(reports, "theirs");  // no row is its
  EXPECT_TRUE(theirs.rows.empty());
  EXPECT_EQ(theirs.conclusion,
            std::vector<std::string>{"Nothing is judged of it in these reports."});
}

TEST(EnginePages, HaveNamesForAnAddressEachOnce) {
  EXPECT_EQ(enginePages({engine("yade"), engine("my engine"), engine("my/engine")}),
            (std::vector<std::string>{"engine-yade.html", "engine-my-engine.html",
                                      "engine-my-engine-2.html"}));
}

TEST(SiteFolders, AreTheirsEachOnceAndFitForAnAddress) {
  EXPECT_EQ(siteFolders({"out/two/", "out/two", "a b#c", ".hidden", "µ"}),
            (std::vector<std::string>{"two", "two-2", "a-b-c", "-hidden", "-"}));
}

TEST(Site, HasAnIndexThatLeadsToEachReport) {
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
