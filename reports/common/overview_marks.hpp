#pragma once

#include <array>
#include <string_view>

#include "results/overview.hpp"

namespace crossgrain::reports {

/// How a state of the matrix is shown everywhere: by its shape first, then by a colour.
struct CellLook {
  std::string_view mark, cssClass, words;
  std::string_view terminal;  ///< number of the colour in a terminal's escape sequence
};

constexpr CellLook lookOf(CellState state) {
  constexpr std::array looks = {
      CellLook{"✓", "good", "holds", "32"},
      CellLook{"≠", "model", "differs by its model: true to the law that it declares", "35"},
      CellLook{"≈", "borderline", "borderline", "33"},
      CellLook{"✗", "bad", "falls short", "31"},
      CellLook{"?", "open", "undecided", "36"},
      CellLook{"•", "figure", "a figure that nothing is judged by", "0"},
      CellLook{"–", "none", "not measured", "2"},
      CellLook{"·", "none nothing", "does not apply", "2"}};
  return looks[static_cast<std::size_t>(state)];
}

}  // namespace crossgrain::reports
