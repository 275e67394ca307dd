#pragma once

#include <optional>
#include <string>
#include <vector>

#include "results/json_fields.hpp"

/// What a report answers at a glance: a matrix of engines and questions, and what follows from it.
namespace crossgrain::inline results {

/// What files call the verdict of a cell. A number that nothing is judged by, what it costs, has
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
  std::string words = {};  ///< what the number is of, or why there is none
  /// Id of the page's heading that has the evidence; empty: none
  std::string anchor = {};

  void fields(auto& io) {
    io("state", cellWord(verdict));
    io("value", value);
    io("unit", unit);
    io("shown", shown);
    io("words", words);
  }
};

struct OverviewColumn {
  std::string name;    ///< of the question, in two words or three
  std::string asks;    ///< the question in a sentence
  std::string anchor;  ///< as of a cell

  void fields(auto& io) {
    io("name", name);
    io("asks", asks);
  }
};

struct OverviewRow {
  std::string name;
  bool isEngine = true;             ///< else an effect
  std::vector<OverviewCell> cells;  ///< one for each column

  void fields(auto& io) {
    io("name", name);
    io("cells", cells);
  }
};

/// What a verdict means here, where that is not what it means everywhere.
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
  std::string rowsAre = "engine";  ///< what the rows are
  std::vector<VerdictWords> states = {};
  std::vector<OverviewColumn> columns;
  std::vector<OverviewRow> rows;
  std::vector<std::string> conclusion;  ///< at most three sentences

  void fields(auto& io) {
    io("rows_are", rowsAre);
    io("states", states);
    io("columns", columns);
    io("rows", rows);
    io("conclusion", conclusion);
  }
};

}  // namespace crossgrain::inline results
