#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "reports/common/figure.hpp"

namespace crossgrain::reports {

/// gnuplot is not installed, or stopped; what() is one line.
struct GnuplotError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Writes name.dat and name.gp; run in that folder, the script makes name.svg and name.pdf (and
/// name.png), and name.axes: a line for each panel, the ends of its axes in px of the SVG, left,
/// right, lower, upper, from its lower left corner, and in the data's units.
/// @returns the script's file name
std::string writeFigure(const Figure& figure, const std::filesystem::path& dir);

/// gnuplot names what it draws "gnuplot_plot_1", 2, … in the SVG, one for each element of a plot;
/// in a multiplot, and a figure's key above all panels is a plot of its own, with a letter for each
/// plot behind it: a, b, ….
///
/// A curve's elements: its bars first, then itself, then its labels.
std::size_t elementCount(const Curve& curve);
bool isMultiplot(const Figure& figure);
/// Of the key above all panels, in its order; empty: there is none.
std::vector<std::string> namesAbove(const Figure& figure);

/// Runs the scripts in gnuplot, some processes side by side, in that folder. The user's own gnuplot
/// settings are not read and no shell is involved. What gnuplot says is kept in dir/gnuplot.log.
/// @throws GnuplotError
void runGnuplot(const std::vector<std::string>& scripts, const std::filesystem::path& dir);

}  // namespace crossgrain::reports
