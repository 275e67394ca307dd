// The matrix that every report begins with: as text, as Markdown, and what stands in it by study.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>

#include "reports/common/overview.hpp"
#include "reports/lockstep/report.hpp"
#include "reports/regression/regression.hpp"
#include "reports/render/html.hpp"
#include "support/terminal.hpp"
#include "tests/reports/report_text.hpp"

namespace crossgrain::reports {
namespace {

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

Overview made(std::size_t rows, std::size_t columns) {
  Overview overview;
  for (std::size_t k = 0; k < columns; ++k)
    overview.columns.push_back({fmt::format("question {}", k + 1), "", ""});
  for (std::size_t k = 0; k < rows; ++k) {
    OverviewRow row{fmt::format("engine-{}", k + 1), true, {}};
    for (std::size_t c = 0; c < columns; ++c)
      row.cells.push_back({c == 0 ? Verdict::pass : Verdict::fail, 0.3, "margins", "0.3 µm"});
    overview.rows.push_back(std::move(row));
  }
  overview.conclusion = {"One.", "Two."};
  return overview;
}

TEST(OverviewText, Columns_AreAlignedWhateverTheLettersTake) {
  const auto lines = linesOf(overviewText(made(2, 2), {}));
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_EQ(lines[0], "engine    question 1  question 2");
  EXPECT_EQ(lines[1], "engine-1  ✓ 0.3 µm    ✗ 0.3 µm");
  EXPECT_EQ(lines[4], "Two.");
}

TEST(OverviewText, Colours_AreThereWhereWanted) {
  EXPECT_FALSE(has(overviewText(made(1, 1), {160, false}), "\033"));
  EXPECT_TRUE(has(overviewText(made(1, 1), {160, true}), "\033[32m✓ 0.3 µm"));
}

TEST(OverviewText, ManyRows_AreCutAtTwentyFiveLines) {
  for (const std::size_t rows : {1u, 21u, 22u, 23u, 100u})
    for (const std::size_t width : {40u, 80u, 160u})
      EXPECT_LE(linesOf(overviewText(made(rows, 9), {width, false})).size(), mostOverviewLines)
          << rows << " " << width;
  EXPECT_TRUE(has(overviewText(made(100, 1), {}), "… and 79 more rows: in the report"));
  EXPECT_FALSE(has(overviewText(made(22, 1), {}), ": in the report"));
}

TEST(OverviewText, ManyColumns_AreLeftOutWithTheirNumber) {
  for (const std::size_t rows : {1u, 2u, 9u})
    for (const std::size_t width : {1u, 20u, 40u}) {
      const std::string text = overviewText(made(rows, 27), {width, false});
      EXPECT_LE(linesOf(text).size(), mostOverviewLines) << rows << " " << width;
      EXPECT_TRUE(has(text, "more columns: in the report")) << rows << " " << width;
      EXPECT_TRUE(has(text, "question"));
    }
}

TEST(OverviewText, NarrowTerminal_HasNoLongerLine) {
  for (const std::string& line : linesOf(overviewText(made(3, 9), {60, false})))
    EXPECT_LE(displayWidth(line), 60u) << line;
}

TEST(OverviewText, LongConclusion_IsBrokenAtBlanks) {
  Overview overview = made(1, 1);
  overview.conclusion = {"A sentence that is longer than the terminal is wide."};
  EXPECT_TRUE(has(overviewText(overview, {30, false}),
                  "A sentence that is longer than\n  the terminal is wide.\n"));
}

TEST(Wrapped, LongLine_IsBrokenWhereItFitsAndHangs) {
  EXPECT_EQ(wrapped("short", 5, 2), "short");
  EXPECT_EQ(wrapped("a b c d", 3, 2), "a b\n  c\n  d");
  EXPECT_EQ(wrapped("  name    σ_rφ and more", 16, 10),
            "  name    σ_rφ\n          and\n          more");
  EXPECT_EQ(wrapped("a-long-word b", 5, 1), "a-long-word\n b") << "a word stays whole";
  EXPECT_EQ(wrapped("run --out a", 8, 2, " \\"), "run \\\n  --out \\\n  a");
  EXPECT_EQ(wrappedLines("  one two\nthree\n", 6), "  one\n    two\nthree\n");
  EXPECT_EQ(wrappedLines("# one two\nkn = 1\n", 7), "# one\n#   two\nkn = 1\n")
      << "a comment stays one";
}

TEST(Cut, LongLine_EndsWithAnEllipsis) {
  EXPECT_EQ(cut("µm is", 5), "µm is");
  EXPECT_EQ(cut("µm is it", 5), "µm i…");
}

TEST(TerminalWidth, Columns_AreThoseOfTheEnvironment) {
  const char* const before = std::getenv("COLUMNS");
  const std::string kept = before ? before : "";
  for (const auto& [text, columns] : {std::pair("62", 62u), {"0", 80u}, {"wide", 80u}}) {
    ::setenv("COLUMNS", text, 1);
    EXPECT_EQ(terminalWidth(-1), columns) << text;
  }
  if (before)
    ::setenv("COLUMNS", kept.c_str(), 1);
  else
    ::unsetenv("COLUMNS");
}

TEST(OverviewText, LongNamesOfColumns_TakeSeveralLinesBeforeColumnsTakeSeveralBlocks) {
  Overview overview = made(1, 2);
  overview.columns[1].name = "largest difference from the reference";
  EXPECT_EQ(linesOf(overviewText(overview, {60, false}))[0],
            "engine    question 1  largest difference from the reference");
  const auto lines = linesOf(overviewText(overview, {40, false}));
  EXPECT_EQ(lines[0], "engine    question  largest");
  EXPECT_EQ(lines[1], "          1         difference");
  EXPECT_EQ(lines[2], "                    from the");
  EXPECT_EQ(lines[3], "                    reference");
  EXPECT_EQ(lines[4], "engine-1  ✓ 0.3 µm  ✗ 0.3 µm");
}

TEST(OverviewMarkdown, ManyQuestions_AreRows) {
  const std::string text = overviewMarkdown(made(2, mostColumns + 1), "t");
  EXPECT_TRUE(has(text, "\n| question 11 | ✗ 0.3 µm | ✗ 0.3 µm |\n"));
}

TEST(OverviewMarkdown, AwkwardNames_AreEscaped) {
  Overview overview = made(1, 1);
  overview.rows[0].name = "a|b_c";
  const std::string text = overviewMarkdown(overview, "compare: <x>");
  EXPECT_TRUE(has(text, "# compare: &lt;x&gt;\n\n| engine | question 1 |\n|---|---|\n"));
  EXPECT_TRUE(has(text, "| a\\|b\\_c | ✓ 0.3 µm |\n\nOne.\n\nTwo.\n"));
}

TEST(MatrixHtml, ManyRows_HaveLimitedLines) {
  Overview overview;
  overview.columns = {{"slide", "", ""}};
  overview.rows.assign(mostRows, OverviewRow{"ours", true, {OverviewCell{}}});
  const auto isTall = [&] { return has(htmlMatrix(overview, {}), "overview tall"); };
  EXPECT_FALSE(isTall());
  overview.rows.push_back(overview.rows.front());
  EXPECT_TRUE(isTall());
}

TEST(LockstepOverview, Difference_NamesTheDeviationFound) {
  LockstepResults results;
  results.engines = {{"theirs", "", "", "", Status::finished, ""}};
  results.lockstep.rules = {1e-10, 1e-3, 1e-3, "kn", 0.05};
  LockstepRow& row = results.lockstep.rows.emplace_back();
  row.engine = "theirs";
  row.verdict = Equivalence::differs;
  row.equivalent = 0.02;
  row.term = NamedTerm{"kn", -0.02, 0.1};
  EXPECT_EQ(shown(reportOf(results).overview.rows[0].cells[0]), "bad 2.00 % of kₙ");
  row.term = NamedTerm{"mu", -0.02, 0.1};
  const Overview overview = reportOf(results).overview;
  EXPECT_EQ(shown(overview.rows[0].cells[0]), "bad 20.0 × limit");
  EXPECT_EQ(shown(overview.rows[0].cells[4]), "bad −2.00 %");
  EXPECT_EQ(overview.conclusion[0], "theirs follows another law than it declares.");
  EXPECT_EQ(overview.conclusion.size(), 3u);
}

TEST(DiffOverview, Change_IsNamed) {
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
  EXPECT_EQ(shown(rowNamed(overview, "one").cells[1]), "good same bits");
  EXPECT_EQ(shown(rowNamed(overview, "two").cells[1]), "bad 5.00 %");
  EXPECT_EQ(overview.conclusion[0], "one: same bits; two: differs.");
  EXPECT_EQ(overview.conclusion[1], "Next: where the change of two is meant, keep a new baseline.");
}

}  // namespace
}  // namespace crossgrain::reports
