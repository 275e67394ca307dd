#pragma once

#include <string>
#include <vector>

#include "reports/common/figure.hpp"
#include "reports/common/view.hpp"

/// What the page's script (templates/figures.js) knows of its figures. Without it they are
/// pictures.
namespace crossgrain::reports {

/// A name that stands for the same thing in every figure of a page: most often an engine.
struct LegendEntry {
  std::string name;
  LineStyle style;
};

/// Names that several panels have, each with a colour of its own, or dashed, in the order of the
/// figures.
std::vector<LegendEntry> sharedLegend(const std::vector<Figure>& figures);

/// Whose a curve is: the entry of its name, else of its style, else, of lines and points, the first
/// of its colour; −1: nobody's.
int ownerOf(const Curve& curve, const std::vector<LegendEntry>& legend);

/// How much of the figure's upper end its key takes, where the page's legend says the same; else 0.
/// [px]
int keyRoom(const Figure& figure, const std::string& axes, const std::vector<LegendEntry>& legend);

/// {top [px: left out, keyRoom()], height [px: of what is left], panels [{box [px: left, right,
/// upper, lower], x, y [at left or lower, at right or upper], logX, logY, xLabel, yLabel (gnuplot's
/// enhanced text), rows, columns [name], curves [{name, owner, parts ["2a" of gnuplot_plot_2a],
/// points [[x, y, half bar | null, place]], place: of all points where they share it, each [[y |
/// null]] and colour: of what the points are means of}]}]}
/// Of a curve whose points are [x, y] alone there are "ys" in place of points, and "xs", the place
/// of their abscissae in the panel's "xs".
/// @param axes  what gnuplot wrote of them (writeFigure()); where it does not fit the figure, null
Json figureData(const Figure& figure, const std::string& axes,
                const std::vector<LegendEntry>& legend);

}  // namespace crossgrain::reports
