#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "results/schema.hpp"

/// The matrix that a report opens with, engines and questions: its marks and colours, what follows
/// from it, and its plain forms.
namespace crossgrain::reports {

/// Names in files of a cell's verdict. A number that nothing is judged by, what it costs, has
/// none.
inline std::string cellWord(std::optional<Verdict> verdict) {
  if (verdict == Verdict::pass) return "good";
  if (verdict == Verdict::fail) return "bad";
  return verdict ? std::string(nameOf(*verdict)) : "figure";
}

/// One answer: a mark and one number.
struct OverviewCell {
  std::optional<Verdict> verdict = Verdict::notMeasured;  ///< absent: nothing is judged by it
  std::optional<double> value = {};                       ///< [unit]; absent: there is none
  std::string unit = {};                                  ///< "margins", "s"
  std::string shown = {};  ///< the number with its unit as people read it: "0.31 margins"
  std::string words = {};  ///< quantity of the number, or why there is none
  /// Id of the page's heading that has the evidence; empty: none
  std::string anchor = {};

  void fields(auto& io) {
    io("state", cellWord(verdict));
    FIELDS(io, value, unit, shown, words);
  }
};

struct OverviewColumn {
  std::string name;    ///< of the question, in two words or three
  std::string asks;    ///< the question in a sentence
  std::string anchor;  ///< as of a cell

  void fields(auto& io) { FIELDS(io, name, asks); }
};

struct OverviewRow {
  std::string name;
  bool isEngine = true;             ///< else an effect
  std::vector<OverviewCell> cells;  ///< one for each column

  void fields(auto& io) { FIELDS(io, name, cells); }
};

/// The most severe verdict of its cells.
inline Verdict mostSevere(const OverviewRow& row) {
  auto worst = Verdict::notMeasured;
  for (const OverviewCell& cell : row.cells)
    worst = moreSevere(worst, cell.verdict.value_or(Verdict::notMeasured));
  return worst;
}

/// Words for a verdict where it means something else than everywhere.
struct VerdictWords {
  std::optional<Verdict> verdict;
  std::string words;

  void fields(auto& io) {
    io("state", cellWord(verdict));
    io("words", words);
  }
};

/// It is written, for scripts, and never read.
struct Overview {
  std::string rowsAre = "engine";  ///< kind of the rows
  std::vector<VerdictWords> states = {};
  std::vector<OverviewColumn> columns;
  std::vector<OverviewRow> rows;
  std::vector<std::string> conclusion;  ///< at most three sentences

  void fields(auto& io) { FIELDS(io, rowsAre, states, columns, rows, conclusion); }
};

/// How a verdict is shown everywhere: by its mark first, then by a colour. Without a verdict it is
/// a number that nothing is judged by.
struct VerdictLook {
  std::optional<Verdict> verdict;
  std::string_view mark, cssClass, words;
  std::string_view terminal;  ///< number of the colour in a terminal's escape sequence
  std::string_view plot;      ///< "#rrggbb" in plots
};

/// In the order in which a legend has them.
inline constexpr std::array verdictLooks = {
    VerdictLook{Verdict::pass, "✓", "good", "passed", "32", "#8cc3e0"},
    VerdictLook{Verdict::modelDifference, "≠", "model",
                "model difference: true to the law that it declares", "35", "#b8a2d8"},
    VerdictLook{Verdict::borderline, "≈", "borderline", "borderline", "33", "#f0d264"},
    VerdictLook{Verdict::fail, "✗", "bad", "failed", "31", "#d55e00"},
    VerdictLook{Verdict::undecided, "?", "open", "undecided", "36", "#c0c8d0"},
    VerdictLook{{}, "•", "figure", "a number that nothing is judged by", "0", "#888888"},
    VerdictLook{Verdict::notMeasured, "–", "none", "not measured", "2", "#f2f4f5"},
    VerdictLook{Verdict::notApplicable, "·", "none nothing", "does not apply", "2", "#d5d9dd"}};

constexpr const VerdictLook& lookOf(std::optional<Verdict> verdict) {
  return *std::ranges::find(verdictLooks, verdict, &VerdictLook::verdict);
}

/// Of more questions than these a row is wrapped on the page, and Markdown has a row for each.
inline constexpr std::size_t mostColumns = 10;

/// Of more rows than these each has only as many lines of small words on the page as the first
/// screen has room for; the rest is in the cell's title.
inline constexpr std::size_t mostRows = 6;

/// Where the terminal's form is printed.
struct TextLook {
  std::size_t width = 160;  ///< [characters]
  bool coloured = false;
};

/// The most lines that overviewText() has.
inline constexpr std::size_t mostOverviewLines = 25;

/// The matrix, aligned, its columns in several blocks where the width asks for it, and the
/// conclusion, each line ended. What does not fit is counted in a line of its own.
std::string overviewText(const Overview& overview, const TextLook& look);

/// The same as Markdown, for the pages of build servers.
/// @param title  its heading
std::string overviewMarkdown(const Overview& overview, const std::string& title);

}  // namespace crossgrain::reports
