#pragma once

#include <concepts>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "adapters/engine.hpp"
#include "reports/common/figure.hpp"
#include "reports/common/overview.hpp"
#include "reports/common/pictures.hpp"
#include "reports/common/text.hpp"
#include "results/head.hpp"

/// A report as data. A study's builder makes it from results alone; reports/render/ has one
/// renderer each for HTML, the terminal, Markdown, JUnit and gnuplot. All texts are plain:
/// renderers escape them, and typeset "k_n", "σ_rφ" and "r^2" (reports/common/text.hpp).
namespace crossgrain::reports {

/// A part of a cell that is a row of coloured squares.
struct Square {
  std::optional<Verdict> verdict;
  std::string title;
};

/// An interval on an axis of margins, whose band reaches from −1 to 1.
struct MarginBar {
  double middle = 0.0;
  std::optional<double> low, high;
  std::string title;  ///< in words
};

struct Cell {
  std::string text;
  Names notes;                     ///< in smaller letters below
  std::optional<Verdict> verdict;  ///< its colour; absent: none, unless it is marked
  bool marked = false;             ///< the verdict's mark stands before the text
  std::string link = {};           ///< "#id" or another page; empty: none
  std::vector<Square> strip = {};
  std::optional<MarginBar> bar = {};

  Cell(std::string text_ = {}, Names notes_ = {}, std::optional<Verdict> verdict_ = {},
       bool marked_ = false)
      : text(std::move(text_)), notes(std::move(notes_)), verdict(verdict_), marked(marked_) {
    std::erase(notes, std::string());
  }
  Cell(const char* text_) : text(text_) {}
};

struct Column {
  enum class Kind {
    words,
    number,   ///< to the right, on one line
    remark,   ///< long words, of limited width
    engine,   ///< the name is an engine's: its colour stands beside it
    engines,  ///< the cells are engines' names: each has its colour beside it
    margins   ///< the cells are bars on one axis, which the head has
  };
  std::string name;
  Kind kind = Kind::words;

  Column(std::string name_, Kind kind_ = Kind::words) : name(std::move(name_)), kind(kind_) {}
  Column(const char* name_, Kind kind_ = Kind::words) : name(name_), kind(kind_) {}
};
inline Column numbers(std::string name) {
  return {std::move(name), Column::Kind::number};
}
inline Column remarks(std::string name) {
  return {std::move(name), Column::Kind::remark};
}
inline Column engineNames(std::string name) {
  return {std::move(name), Column::Kind::engines};
}

struct TableRow {
  std::vector<Cell> cells;  ///< the first is the row's name
  std::string group = {};   ///< a heading above the row, or an engine's name; empty: none
  std::string id = {};      ///< to link to
};

struct Table {
  std::vector<Column> columns;
  std::vector<TableRow> rows = {};
  std::string note = {};  ///< below it, in smaller letters
  bool dense = false;     ///< of thousands of numbers
  double reach = 0.0;     ///< where the axis of its bars ends [margins]
};

struct Paragraph {
  enum class Style { plain, small, warning };
  std::string text;
  Style style = Style::plain;
};

struct Item {
  std::string lead;  ///< in bold letters; empty: none
  std::string text;
};
struct List {
  std::vector<Item> items;
};

/// Plots and pictures by the names of their files.
struct Drawings {
  Names names;
  bool side = true;  ///< side by side, where they are narrow enough
};

struct Code {
  std::string text;
};

struct Heading {
  std::string text, id = {};
};

struct Block;
/// Folded: what a reader may want, and what passes.
struct Details {
  std::string summary;
  std::vector<Block> blocks;
};

struct Block {
  std::variant<Paragraph, List, Table, Drawings, Code, Heading, Details> content;

  template <typename T>
  requires(!std::same_as<std::remove_cvref_t<T>, Block>) Block(T&& part)
      : content(std::forward<T>(part)) {}
};
using Blocks = std::vector<Block>;

struct Section {
  std::string id, title;
  Blocks blocks;
  std::string shortTitle = {};  ///< in the list of sections; empty: the title
  bool folded = false;
};

/// One thing that was judged, or that could not be.
struct JUnitCase {
  std::string group;                ///< case and variant: "classname"
  std::string name;                 ///< engine and what is judged
  Verdict verdict = Verdict::pass;  ///< as the matrix has it
  std::string message = {};         ///< figure, limit and reason; why it is an error or was skipped
  double seconds = 0.0;  ///< wall time of the run; 0 where others of the same run have it
  bool broke = false;    ///< the engine did, so that nothing could be judged
  std::optional<bool> passes = {};  ///< for build servers, or else is skipped, whatever the verdict
};

/// Parts of a report that a site keeps.
struct ReportDigest {
  ResultsHead head;
  std::vector<EngineRow> engines;
  Overview overview = {};  ///< the matrix, and at most three sentences that follow from it
  std::optional<std::vector<JUnitCase>> checks = {};  ///< absent: nothing is judged
};

struct Report : ReportDigest {
  std::optional<double> elapsed = {};  ///< [s]
  Names notes = {};                    ///< remarks that the matrix does not have
  std::vector<Section> sections = {};
  std::vector<Figure> figures = {};
  std::vector<Picture> pictures = {};
  std::vector<std::pair<std::string, std::string>> tables = {};  ///< CSV: name of the file, content
  bool engineColours = true;  ///< plots have the engines' colours: a legend stays in sight
  std::string caseHeading = "The case as it was run";

  Section& section(std::string id, std::string title, std::string shortTitle = {}) {
    return sections.emplace_back(
        Section{std::move(id), std::move(title), {}, std::move(shortTitle), false});
  }
  /// Leaves these sections in sight, all others in one line each.
  void foldAllBut(const Names& ids) {
    for (Section& one : sections) one.folded = !contains(ids, one.id);
  }
};

/// The figures whose names begin so, that have anything to draw.
Drawings drawingsOf(const std::vector<Figure>& figures, std::string_view prefix);
Drawings drawingsOf(const std::vector<Picture>& pictures, Picture::Shows shows);

/// "Engine agreement: CASE, VARIANT"
std::string titleOf(const ResultsHead& head);

/// "compare CASE, VARIANT": results of one name are of one command and case.
std::string nameOf(const ResultsHead& head);

/// The matrix as tests, for studies that have no finer ones.
std::vector<JUnitCase> matrixChecks(const Report& report);

/// As Markdown, a cell's notes after its text.
/// @param title  its heading
std::string tableMarkdown(const Table& table, const std::string& title);

// Checks as JUnit's XML, which build servers read.

/// @param suite  "stability"
std::string junitXml(const std::string& suite, const std::vector<JUnitCase>& cases);

/// A matrix as tests, one for each cell that answers a question: what passed passes, a model
/// difference too; what failed fails; borderline, undecided and not measured are skipped with their
/// words, for nothing was shown. Figures and cells without a question are left out.
/// @param group  "classname" of all
std::vector<JUnitCase> overviewCases(const Overview& overview, const std::string& group);

/// "CASE VARIANT", or the one where the other says nothing more.
std::string junitGroup(const std::string& name, const std::string& variant);

/// Of a run; 0 where it is not known [s].
double junitSeconds(const std::optional<Stats>& stats);

}  // namespace crossgrain::reports
