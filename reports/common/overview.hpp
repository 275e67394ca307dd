#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "results/overview.hpp"

/// The matrix that a report opens with: its marks and colours, and its plain forms.
namespace crossgrain::reports {

/// How a state is shown everywhere: by its mark first, then by a colour.
struct CellLook {
  std::string_view mark, cssClass, words;
  std::string_view terminal;  ///< number of the colour in a terminal's escape sequence
  std::string_view plot;      ///< "#rrggbb" in plots
};

constexpr CellLook lookOf(CellState state) {
  constexpr std::array looks = {
      CellLook{"✓", "good", "passed", "32", "#8cc3e0"},
      CellLook{"≠", "model", "model difference: true to the law that it declares", "35", "#b8a2d8"},
      CellLook{"≈", "borderline", "borderline", "33", "#f0d264"},
      CellLook{"✗", "bad", "failed", "31", "#d55e00"},
      CellLook{"?", "open", "undecided", "36", "#c0c8d0"},
      CellLook{"•", "figure", "a number that nothing is judged by", "0", "#888888"},
      CellLook{"–", "none", "not measured", "2", "#f2f4f5"},
      CellLook{"·", "none nothing", "does not apply", "2", "#d5d9dd"}};
  return looks[static_cast<std::size_t>(state)];
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

/// Columns of equal width, the first to the left and the others to the right, each line ended; for
/// the terminal.
std::string alignedText(const std::vector<std::vector<std::string>>& rows);

}  // namespace crossgrain::reports
