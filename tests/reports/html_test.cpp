// Written files, as a browser and a spreadsheet get them.
#include <gtest/gtest.h>

#include <cstdlib>

#include "reports/render/html.hpp"
#include "reports/report.hpp"
#include "results/schema.hpp"
#include "support/bad_input.hpp"
#include "support/files.hpp"
#include "tests/reports/report_text.hpp"
#include "tests/reports/sample_results.hpp"
#include "tests/support/refusal.hpp"
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
    "odd &lt;b&gt;&quot;name&quot;&lt;/b&gt; &amp; `touch pwned` {x &#39;y&#39; _z";

TEST(Pages, Page_NeedsNoOtherFileAndHasNoNaN) {
  for (const Written* written : {&compared(), &collided()}) {
    const std::string page = withoutImages(written->page);
    for (const char* outside : {"http:", "https:", "src=", "<link", "@import", "url("})
      EXPECT_FALSE(has(page, outside)) << outside;
    for (const char* notANumber : {"nan", "NaN", "-inf", "null"})
      EXPECT_FALSE(has(page, std::string(">") + notANumber)) << notANumber;
    EXPECT_TRUE(has(page, "</html>"));
  }
}

TEST(Pages, Links_LeadSomewhere) {
  for (const Written* written : {&compared(), &collided()}) {
    std::size_t links = 0;
    for (std::size_t at = 0; (at = written->page.find("href=\"#", at)) != std::string::npos;
         ++links) {
      at += 7;
      const std::string target = written->page.substr(at, written->page.find('"', at) - at);
      EXPECT_TRUE(has(written->page, " id=\"" + target + "\"")) << target;
    }
    EXPECT_GT(links, 15u);
  }
}

TEST(Pages, WordsOfTheUser_AreEscaped) {
  for (const Written* written : {&compared(), &collided()}) {
    EXPECT_TRUE(has(written->page, awkwardAsHtml));
    EXPECT_FALSE(has(written->page, "<b>\"name\""));
    EXPECT_TRUE(has(written->page, "# a &lt; b &amp; c"));
    EXPECT_FALSE(fs::exists(written->folder.path() / "plots" / "pwned"));
  }
}

TEST(Html, EveryBlock_IsEscapedAndTypeset) {
  using namespace reports;
  Report report;
  report.engines = {{"en<g", "", "", "", Status::finished, ""}};
  Table table{{engineNames("engine"), numbers("σ_rφ")}};
  table.rows.push_back({{"en<g", {"1<2", {"k_n"}, Verdict::fail, true}}, "gr<oup"});
  report.section("one", "O<ne").blocks = {Paragraph{"a<b, k_n"}, List{{{"le<ad", "t_c"}}},
                                          std::move(table), Code{"c<d k_n"},
                                          Details{"su<m", {Heading{"O<ne"}}}};
  const std::string page = html(report, {});
  for (const char* words :
       {"<p>a&lt;b, k<sub>n</sub></p>", "<b>le&lt;ad</b>: t<sub>c</sub>", "</span>en&lt;g</th>",
        "σ<sub>rφ</sub></th>", "<pre>c&lt;d k_n</pre>", "<summary>su&lt;m</summary>",
        "<b>✗ 1&lt;2</b><small>k<sub>n</sub></small>", "gr&lt;oup</th>", "<h3 id=\"o-ne\">"})
    EXPECT_TRUE(has(page, words)) << words << page.substr(page.find("<nav>"));
  EXPECT_FALSE(has(page, "a<b"));
}

TEST(Report, ResultsWithAlmostNothing_AreWritten) {
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

TEST(Report, WrongMember_IsNamedByItsPath) {
  const TemporaryFolder folder;
  const auto complaint = [&](const json& broken) {
    return test::refusalOf([&] { writeReport(broken, folder.path()); });
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

/// Sets PATH for its lifetime.
class PathIs {
 public:
  explicit PathIs(const char* path) : old_(std::getenv("PATH")) { ::setenv("PATH", path, 1); }
  ~PathIs() { ::setenv("PATH", old_.c_str(), 1); }

 private:
  std::string old_;
};

TEST(Report, WithoutGnuplot_EverythingElseIsThere) {
  const TemporaryFolder folder;
  const PathIs nowhere("/nonexistent");
  const std::string message = test::refusalOf<std::runtime_error>(
      [&] { writeReport(sample::compareResults(1, 50), folder.path()); });
  EXPECT_TRUE(message.starts_with("gnuplot cannot be started (No such file or directory)"));
  EXPECT_EQ(message.find('\n'), std::string::npos);
  const std::string page = readFile(folder.path() / "report.html").value();
  EXPECT_TRUE(has(page, "<p class=\"warning\">gnuplot cannot be started"));
  EXPECT_TRUE(fs::exists(folder.path() / "results.json"));
  EXPECT_TRUE(fs::exists(folder.path() / "profiles.csv"));
}

}  // namespace
}  // namespace crossgrain
