// Several reports in one folder, and the page that leads to them.
#include "reports/site/site.hpp"

#include <gtest/gtest.h>

#include <set>

#include "reports/flow/endpoint_text.hpp"
#include "reports/flow/overview.hpp"
#include "reports/report.hpp"
#include "results/schema.hpp"
#include "support/files.hpp"
#include "tests/reports/report_text.hpp"
#include "tests/reports/sample_results.hpp"
#include "tests/support/temporary_folder.hpp"

namespace crossgrain::reports {
namespace {

EngineRow engine(const char* name, const char* mirrors = "") {
  return {name, "", "", mirrors, Status::finished, ""};
}

/// Two questions; ours answers them so.
SiteReport siteReportOf(const char* kind, Verdict first, Verdict second) {
  SiteReport report;
  report.folder = kind;
  report.digest.head.kind = kind;
  report.digest.head.setup.name = "quick";
  report.digest.engines = {engine("ours"), engine("theirs"), engine("mirror", "theirs")};
  Overview& overview = report.digest.overview;
  overview.columns = {{"slide", "", ""}, {"spin", "", ""}};
  OverviewCell one, two;
  one.verdict = first;
  two.verdict = second;
  overview.rows = {{"ours", true, {one, two}}, {"mirror", true, {one, two}}};
  return report;
}

TEST(SiteOverview, HasTheMostSevereAnswerOfEachReport) {
  using enum Verdict;
  const std::vector<SiteReport> reports = {
      siteReportOf("collide", pass, fail), siteReportOf("compare", undecided, modelDifference),
      siteReportOf("stability", pass, notMeasured), siteReportOf("lockstep", borderline, pass)};
  const Overview overview = siteOverview(reports);
  ASSERT_EQ(overview.columns.size(), 4u);
  EXPECT_EQ(overview.columns[0].name, "collide quick");
  EXPECT_EQ(overview.columns[0].anchor, "collide/report.html");
  ASSERT_EQ(overview.rows.size(), 3u);
  const std::vector<OverviewCell>& ours = overview.rows[0].cells;
  EXPECT_EQ(ours[0].verdict, fail);
  EXPECT_EQ(ours[0].shown, "1 of 2 failed");
  EXPECT_EQ(ours[0].words, "spin");
  EXPECT_EQ(ours[1].verdict, undecided);
  EXPECT_EQ(ours[2].verdict, pass);
  EXPECT_EQ(ours[2].shown, "1 of 1 passed");
  // It took part, and no row is its.
  EXPECT_EQ(overview.rows[1].cells[0].verdict, std::nullopt);
  EXPECT_EQ(overview.conclusion,
            (std::vector<std::string>{
                "Failed: ours in collide quick.",
                "Borderline or undecided: ours in compare quick and lockstep quick; each report "
                "has what would decide."}));
  EXPECT_EQ(siteOverview({reports[2]}).conclusion,
            std::vector<std::string>{"Nothing failed or is open: ours."});
}

TEST(SiteOverview, HasReportsOfOneEngineEachInOneColumn) {
  using enum Verdict;
  const auto conformanceOf = [](const char* name, Verdict verdict) {
    SiteReport report = siteReportOf("conformance", verdict, pass);
    report.folder = name;
    report.digest.head.setup.name = name;
    report.digest.engines = {engine(name)};
    report.digest.overview.rows = {{name, true, report.digest.overview.rows[0].cells}};
    return report;
  };
  std::vector<SiteReport> reports = {siteReportOf("collide", pass, pass),
                                     conformanceOf("ours", fail), siteReportOf("cost", pass, pass),
                                     conformanceOf("theirs", pass)};
  const Overview overview = siteOverview(reports);
  ASSERT_EQ(overview.columns.size(), 3u);
  EXPECT_EQ(overview.columns[1].name, "conformance");
  ASSERT_EQ(overview.rows.size(), 3u);
  EXPECT_EQ(overview.rows[0].cells[1].verdict, fail);
  EXPECT_EQ(overview.rows[0].cells[1].anchor, "ours/report.html");
  EXPECT_EQ(overview.rows[1].cells[1].verdict, pass);
  EXPECT_EQ(overview.rows[1].cells[1].anchor, "theirs/report.html");
  EXPECT_EQ(overview.rows[2].cells[1].verdict, notApplicable);
  // Two of one engine are two columns, named by their folders.
  reports.push_back(conformanceOf("theirs", fail));
  reports.back().folder = "later";
  EXPECT_EQ(siteOverview(reports).columns.size(), 5u);
}

TEST(SiteOverview, TellsReportsOfOneNameApart) {
  using enum Verdict;
  std::vector<SiteReport> reports = {siteReportOf("collide", pass, fail),
                                     siteReportOf("collide", pass, fail)};
  reports[1].folder = "again";
  const Overview overview = siteOverview(reports);
  EXPECT_EQ(overview.columns[0].name, "collide quick (collide)");
  EXPECT_EQ(overview.columns[1].name, "collide quick (again)");
}

TEST(EngineOverview, HasTheAnswersOfEachReportWithTheWayToThem) {
  using enum Verdict;
  std::vector<SiteReport> reports = {siteReportOf("collide", pass, fail),
                                     siteReportOf("compare", undecided, modelDifference)};
  reports[0].digest.overview.rows[0].cells[1].anchor = "scores";
  reports[1].digest.overview.columns[0].name = "averages";  // a question of its own
  const Overview ours = engineOverview(reports, "ours");
  ASSERT_EQ(ours.rows.size(), 2u);
  ASSERT_EQ(ours.columns.size(), 3u);
  EXPECT_EQ(ours.columns[2].name, "averages");
  const auto statesOf = [&](std::size_t row) {
    std::vector<Verdict> states;
    for (const OverviewCell& cell : ours.rows[row].cells) states.push_back(cell.verdict.value());
    return states;
  };
  EXPECT_EQ(statesOf(0), (std::vector{pass, fail, notApplicable}));
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
          "Model difference (it follows the law that it declares): 1 question (compare quick)."}));
  EXPECT_EQ(engineOverview({siteReportOf("collide", pass, pass)}, "ours").conclusion,
            std::vector<std::string>{"Passed: 2 questions (collide quick)."});
  const Overview theirs = engineOverview(reports, "theirs");  // no row is its
  EXPECT_TRUE(theirs.rows.empty());
  EXPECT_EQ(theirs.conclusion, std::vector<std::string>{"These reports do not judge it."});
}

SiteReport madeBy(const char* build, const char* started, Verdict state, double margins) {
  SiteReport report = siteReportOf("compare", state, Verdict::pass);
  report.folder = std::string("made-by-") + build;
  report.digest.head.version = "0.3.0";
  report.digest.head.build = build;
  report.digest.head.started = started;
  for (OverviewRow& row : report.digest.overview.rows) row.cells[0].value = margins;
  return report;
}

TEST(History, FollowsACaseFromOneVersionToTheNext) {
  using enum Verdict;
  std::vector<SiteReport> reports = {madeBy("new", "2026-02-01", fail, 2.0),
                                     siteReportOf("collide", pass, pass),
                                     madeBy("old", "2026-01-01", pass, 0.5)};
  reports[0].digest.values = {{"ours", "mean of spin", {std::nullopt, 3.0, "rad/s", "3 rad/s"}}};
  reports[2].digest.values = {{"ours", "mean of spin", {std::nullopt, 4.0, "rad/s", "4 rad/s"}}};
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
  reports[0] = madeBy("new", "2026-02-01", pass, 0.5);
  reports[0].changedCase = "law.mu: 0.44 → 0.5, compared with out/old";
  histories = historiesOf(reports);
  EXPECT_EQ(changeOf(histories[0].rows[0]), "same");
  EXPECT_EQ(sentencesOf(histories[0]),
            (std::vector<std::string>{
                "No answer changed from the first to the last.",
                "The case is not the same in all of them (made-by-new: law.mu: 0.44 → 0.5, "
                "compared with out/old): an answer may have changed with the case."}));
}

/// Two of one version of crossgrain are distinguished by what differs, and by when and where.
TEST(History, ColumnsNameTheVersionsThatDifferTheTimeAndTheFolder) {
  using enum Verdict;
  std::vector<SiteReport> reports = {madeBy("one", "2026-01-01T08:00:00Z", pass, 1.0),
                                     madeBy("one", "2026-01-01T09:00:00Z", pass, 1.0),
                                     madeBy("one", "2026-01-01T09:00:00Z", pass, 1.0)};
  for (SiteReport& report : reports) report.digest.engines[0].version = "7";
  for (SiteReport& report : reports) report.digest.engines[1].version = "1";
  reports[2].digest.engines[1].version = "2";
  reports[2].folder = "again";
  const History history = historiesOf(reports).at(0);
  EXPECT_EQ(changedEngines(history), std::vector<std::string>{"theirs"});
  std::vector<std::string> columns;
  for (const SiteReport* report : history.reports)
    columns.push_back(columnNameOf(history, *report));
  EXPECT_EQ(columns, (std::vector<std::string>{
                         "crossgrain 0.3.0 (one), theirs 1, 2026-01-01T08:00:00Z (made-by-one)",
                         "crossgrain 0.3.0 (one), theirs 1, 2026-01-01T09:00:00Z (made-by-one)",
                         "crossgrain 0.3.0 (one), theirs 2, 2026-01-01T09:00:00Z (again)"}));
}

TEST(History, IsOfSeveralVersionsOnly) {
  using enum Verdict;
  std::vector<SiteReport> reports = {madeBy("one", "2026-01-01", pass, 1.0),
                                     madeBy("one", "2026-01-02", fail, 2.0)};
  EXPECT_TRUE(historiesOf(reports).empty());
  reports[1].digest.engines[1].version = "2";  // another engine is another version, too
  EXPECT_EQ(historiesOf(reports).size(), 1u);
  // What one report alone has did not change.
  reports[0].digest.overview = {};
  const auto histories = historiesOf(reports);
  for (const HistoryRow& row : histories.at(0).rows) EXPECT_EQ(changeOf(row), "");
}

TEST(History, HasTheMeansOfEndpoints) {
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
  EXPECT_EQ(of(row.a)->cell.verdict, std::nullopt);
  EXPECT_DOUBLE_EQ(of(row.a)->cell.value.value(), row.reference.value());
  EXPECT_DOUBLE_EQ(of(row.b)->cell.value.value(), *row.reference + row.difference.value());
}

TEST(EnginePages, HaveNamesForAnAddressEachOnce) {
  SiteReport report = siteReportOf("collide", Verdict::pass, Verdict::pass);
  report.digest.engines = {engine("yade"), engine("my engine"), engine("my/engine")};
  std::vector<std::string> files;
  for (const EnginePage& page : enginePages({report})) files.push_back(page.file);
  EXPECT_EQ(files, (std::vector<std::string>{"engine-yade.html", "engine-my-engine.html",
                                             "engine-my-engine-2.html"}));
}

TEST(EnginePages, AreOneForEachVersionTheLatestFirst) {
  std::vector<SiteReport> reports = {madeBy("a", "2026-01-01", Verdict::fail, 2.0),
                                     madeBy("b", "2026-02-01", Verdict::pass, 0.1),
                                     madeBy("c", "2026-03-01", Verdict::pass, 0.1)};
  for (std::size_t k = 0; k < 3; ++k)
    reports[k].digest.engines = {engine("ours"), engine("theirs")};
  reports[0].digest.engines[1].version = "1.0";
  reports[1].digest.engines[1].version = reports[2].digest.engines[1].version = "2.0";
  const std::vector<EnginePage> pages = enginePages(reports);
  ASSERT_EQ(pages.size(), 3u);
  EXPECT_EQ(pages[0].reports.size(), 3u);
  EXPECT_EQ(pages[1].file, "engine-theirs-2.0.html");
  EXPECT_EQ(pages[1].reports.size(), 2u);
  EXPECT_EQ(pages[2].file, "engine-theirs-1.0.html");
  EXPECT_EQ(pages[2].reports.front().folder, "made-by-a");
  // Of a refusal no version is known: it stands with the latest.
  std::vector<SiteReport> refused = reports;
  refused[2].digest.engines[1].version = "";
  ASSERT_EQ(enginePages(refused).size(), 3u);
  EXPECT_EQ(enginePages(refused)[1].reports.size(), 2u);
  const Overview overview = siteOverview(reports);  // a row for each engine, to its latest version
  ASSERT_EQ(overview.rows.size(), 2u);
  EXPECT_EQ(overview.rows[1].anchor, "engine-theirs-2.0.html");
}

TEST(EnginePages, SayWhatDidNotPassAndWhereItWasFound) {
  SiteReport report = siteReportOf("stability", Verdict::fail, Verdict::pass);
  report.digest.head.machine = {"a processor", "an OS", 4};
  report.digest.checks = {{"column", "ours: drift", Verdict::fail, "3 d", 0.0, false, "ours"},
                          {"ball", "ours: drift", Verdict::pass, "", 0.0, false, "ours"},
                          {"gas", "ours: drift", Verdict::borderline, "", 0.0, false, "ours", true},
                          {"wedge", "ours: drift", Verdict::fail, "died", 0.0, true, "ours"},
                          {"cell", "ours: drift", Verdict::notApplicable, "", 0.0, false, "ours"},
                          {"column", "theirs: drift", Verdict::fail, "4 d", 0.0, false, "theirs"}};
  Report page;
  addEngineReports(page, enginePages({report}).front());
  ASSERT_EQ(page.sections.size(), 1u);
  std::string words;
  const Table* table = nullptr;
  for (const Block& block : page.sections[0].blocks) {
    if (const auto* text = std::get_if<Paragraph>(&block.content)) words += text->text + "\n";
    if (const auto* found = std::get_if<Table>(&block.content)) table = found;
  }
  EXPECT_TRUE(has(words, "a processor"));
  EXPECT_TRUE(
      has(words, "1 of 4 checks passed, 1 borderline, 1 failed; the engine broke down in 1."))
      << words;
  ASSERT_NE(table, nullptr);
  ASSERT_EQ(table->rows.size(), 3u) << "not the other engine's, nor what passed";
  EXPECT_EQ(table->rows[0].cells[0].text, "column");
  EXPECT_EQ(table->rows[0].cells[1].text, "drift");
  EXPECT_EQ(table->rows[0].cells[3].text, "3 d");
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
  const std::string file = "engine-grain-" + sample::stabilityResults().engines.front().version;
  const std::string engine = readFile(site / (file + ".html")).value();
  EXPECT_TRUE(has(index, "href=\"" + file + ".html\""));
  EXPECT_TRUE(has(engine, "href=\"one-2/report.html#"));
  EXPECT_FALSE(has(engine, "{{"));
  EXPECT_TRUE(has(index, "href=\"one-2/stability.csv\""));
  EXPECT_TRUE(std::filesystem::exists(site / "one-2/stability.csv"));
  EXPECT_FALSE(has(index, "{{"));
  EXPECT_TRUE(has(readFile(site / "summary.md").value(), "# crossgrain: 2 reports"));
}

TEST(Site, HasDrawingsBesideItsPagesAndNoCopyOfTheResults) {
  const TemporaryFolder folder;
  const auto site = folder.path() / "site", dir = site / "stability";
  const auto results = toJson(sample::stabilityResults());
  writeSite({{"a/stability", results}}, site);
  std::set<std::string> kinds;
  std::size_t shown = 0;
  const std::string page = readFile(dir / "report.html").value();
  for (const auto& drawn : std::filesystem::directory_iterator(dir / "plots")) {
    kinds.insert(drawn.path().extension().string());
    shown += has(page, "src=\"plots/" + drawn.path().filename().string() + "\"");
  }
  EXPECT_EQ(kinds, std::set<std::string>{".svg"});
  EXPECT_GT(shown, 0u);
  EXPECT_FALSE(has(page, "svg+xml;base64"));
  EXPECT_FALSE(std::filesystem::exists(dir / "results.json"));

  // Results that lie below the site are whole: nothing of them is replaced by less.
  const auto own = site / "own";
  writeReport(results, own);
  writeSite({{own, results}}, site);
  EXPECT_TRUE(std::filesystem::exists(own / "results.json"));
  EXPECT_TRUE(has(readFile(own / "report.html").value(), "svg+xml;base64"));
}

TEST(Site, SaysWhichResultsAreOfAChangedCase) {
  const TemporaryFolder folder;
  const auto site = folder.path() / "site";
  const StabilityResults before = sample::stabilityResults();
  StabilityResults now = before;
  now.head.machine.cpu = "their processor";
  const std::string changed = "law.mu: 0.44 → 0.5, compared with a/ours";
  writeSite({{"a/ours", toJson(before)}, {"b/theirs", toJson(now), changed}}, site);
  const std::string index = readFile(site / "index.html").value();
  EXPECT_TRUE(has(index, "Changed case: stability hard cases (theirs; "));
  EXPECT_TRUE(has(index, "their processor): " + changed + "."));
  EXPECT_TRUE(has(index, "(theirs, changed case)"));
  EXPECT_FALSE(has(index, "(ours, changed case)"));
  EXPECT_TRUE(has(readFile(site / "summary.md").value(), "(theirs, changed case)"));
  const std::string file = "engine-grain-" + before.engines.front().version + ".html";
  EXPECT_TRUE(has(readFile(site / file).value(), "Changed case: " + changed + "."));
}

TEST(Site, ShowsTheHistoryOfACase) {
  const TemporaryFolder folder;
  const auto site = folder.path() / "site";
  StabilityResults before = sample::stabilityResults(), now = before;
  before.head.version = "0.1.0";
  now.head.version = "0.2.0";
  now.head.build = "abc";
  writeSite({{"a/before", toJson(before)}, {"b/now", toJson(now)}}, site);
  const std::string index = readFile(site / "index.html").value();
  EXPECT_TRUE(has(index, "<h2 id=\"history\">"));
  EXPECT_TRUE(has(index, "<a href=\"now/report.html\">"));
  EXPECT_TRUE(has(index, "No answer changed from the first to the last."));
}

}  // namespace
}  // namespace crossgrain::reports
