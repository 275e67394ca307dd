#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "support/verdict.hpp"

/// What a report answers at a glance: a matrix of engines and questions, and what follows from it.
namespace crossgrain::inline results {

enum class CellState {
  good,
  modelDifference,  ///< true to the law that the engine declares, which is not the scene's
  borderline,
  bad,
  undecided,
  figure,        ///< a number that nothing is judged by: what it costs
  notMeasured,   ///< this command or this run has no number for it
  notApplicable  ///< the question does not arise: the reference against itself, a law that it lacks
};
constexpr auto namesOf(CellState) {
  return std::array<std::string_view, 8>{"good",         "model_difference", "borderline",
                                         "bad",          "undecided",        "figure",
                                         "not_measured", "not_applicable"};
}

/// How a verdict is shown.
constexpr CellState stateOf(Verdict verdict) {
  using enum Verdict;
  switch (verdict) {
    case pass:
      return CellState::good;
    case modelDifference:
      return CellState::modelDifference;
    case borderline:
      return CellState::borderline;
    case undecided:
      return CellState::undecided;
    case fail:
      return CellState::bad;
    case notApplicable:
      return CellState::notApplicable;
    case notMeasured:
      break;
  }
  return CellState::notMeasured;
}

/// One answer: a mark and one number.
struct OverviewCell {
  CellState state = CellState::notMeasured;
  std::optional<double> value = {};  ///< [unit]; absent: there is none
  std::string unit = {};             ///< "margins", "s"
  std::string shown = {};            ///< the number with its unit as people read it: "0.31 margins"
  std::string words = {};            ///< what the number is of, or why there is none
  /// Id of the page's heading that has the evidence or, with a slash, a page beside it; empty: none
  std::string anchor = {};
};

struct OverviewColumn {
  std::string name;    ///< of the question, in two words or three
  std::string asks;    ///< the question in a sentence
  std::string anchor;  ///< as of a cell
};

struct OverviewRow {
  std::string name;
  bool isEngine = true;             ///< else an effect
  std::vector<OverviewCell> cells;  ///< one for each column
  std::string anchor = {};          ///< of a page that has more of it; empty: none
};

/// What a state means here, where that is not what it means everywhere.
struct StateWords {
  CellState state;
  std::string words;
};

struct Overview {
  std::string rowsAre = "engine";  ///< what the rows are
  std::vector<StateWords> states = {};
  std::vector<OverviewColumn> columns;
  std::vector<OverviewRow> rows;
  std::vector<std::string> conclusion;  ///< at most three sentences
};

nlohmann::json toJson(const Overview& overview);

}  // namespace crossgrain::inline results
