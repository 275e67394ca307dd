// Several reports in one folder, and the page that lists them.
#include "reports/report.hpp"

#include <gtest/gtest.h>

#include <set>

#include "support/files.hpp"
#include "tests/reports/report_text.hpp"
#include "tests/reports/sample_results.hpp"
#include "tests/support/temporary_folder.hpp"

namespace crossgrain::reports {
namespace {

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

TEST(Site, ListsReportsWithVerdictEnginesAndOrigin) {
  const TemporaryFolder folder;
  const auto site = folder.path() / "site";
  const StabilityResults before = sample::stabilityResults();
  StabilityResults now = before;
  now.head.machine.cpu = "their processor";
  now.head.build = "abc";
  const std::string changed = "law.mu: 0.44 → 0.5, compared with a/ours";
  writeSite({{"a/ours/", toJson(before)}, {"b/a b#c", toJson(now), changed}}, site);
  const std::string index = readFile(site / "index.html").value();
  EXPECT_TRUE(has(index, "their processor"));
  EXPECT_TRUE(has(index, "(abc)"));
  EXPECT_TRUE(has(index, before.head.started));
  EXPECT_TRUE(has(index, "href=\"a-b-c/report.html\"")) << "a name fit for an address";
  EXPECT_TRUE(has(index, "changed case: " + changed));
  const std::string line = "| Stability: hard cases; ours | ✗ failed; odd-one: ";
  EXPECT_TRUE(has(readFile(site / "summary.md").value(), line))
      << readFile(site / "summary.md").value();
}

}  // namespace
}  // namespace crossgrain::reports
