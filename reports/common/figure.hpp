#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

/// A plot as data; reports/render/gnuplot.hpp draws it. Labels of axes are gnuplot's enhanced text
/// and never contain the user's words; names of curves may, and are printed as they are.
namespace crossgrain::reports {

struct Point {
  double x = 0.0, y = 0.0;
  std::optional<double> error;  ///< half length of the bar: upright, in panels with rows across
  std::string label{};          ///< beside the point, printed as it is; empty: none
};

/// How everything that belongs to one engine looks in every plot.
struct LineStyle {
  std::string colour = "#000000";  ///< "#rrggbb"
  int pointType = 7;               ///< gnuplot's numbers
  bool dashed = false;
  bool operator==(const LineStyle&) const = default;
};

/// Blocks reach from x = 0 to each point, in panels with rows; tiles fill the place of each point,
/// in panels with rows and columns; bands fill what lies within the points' errors.
enum class Draw { linesAndPoints, lines, points, blocks, tiles, bands };

struct Curve {
  std::string name;  ///< empty: not in the key
  LineStyle style;
  Draw draw = Draw::linesAndPoints;
  std::vector<Point> points;
  double width = 1.5;
};

struct Range {
  double low = 0.0, high = 0.0;
};

enum class Key { none, topRight, topLeft, outside };

struct Panel {
  std::string title;
  std::string name;  ///< in the title's place, and may be the user's words: printed as it is
  std::string xLabel, yLabel;
  std::optional<Range> xRange, yRange;
  bool logX = false, logY = false;   ///< points that are not positive are left out
  std::vector<double> xTicks;        ///< empty: gnuplot's choice
  std::vector<std::string> rows;     ///< names along the y axis, at y = 0, 1, … from the top
  std::vector<std::string> columns;  ///< names along the x axis, at x = 0, 1, …
  std::optional<Range> shaded;       ///< part of the x axis
  std::optional<double> shadedTo;    ///< the y axis from its lower end up to there
  std::optional<Range> band;         ///< part of the y axis
  std::optional<double> level;       ///< a thin horizontal line
  std::vector<Curve> curves;
  Key key = Key::outside;
};

/// One or more panels in a grid, one file.
struct Figure {
  std::string name;     ///< of its files
  std::string title;    ///< description for readers who cannot see it
  std::string caption;  ///< under it in the report
  std::vector<Panel> panels;
  int columns = 1;
  int panelWidth = 560, panelHeight = 380;  ///< [px] in the SVG
  bool png = false;                         ///< also as PNG, twice the size
  bool keyAbove = false;                    ///< every name of the panels once, above them all
  int rowNames = 0;  ///< [px] left of the first panel: panels with rows, in one line, share them
};

/// Of the whole drawing [px].
int widthOf(const Figure& figure);

/// Makes the y axis logarithmic where all values are positive and differ tenfold or more, so that
/// one engine far off does not flatten the others.
void chooseLogY(Panel& panel);

/// Names that a key may have: more would leave the plot no room.
inline constexpr std::size_t mostKeyNames = 8;

/// Whether a panel that asks for a key has none, as there are too many curves to name.
bool keyIsTooLong(const Panel& panel);

/// Whether anything of a curve lies within the panel: a key names nothing else.
bool isSeen(const Panel& panel, const Curve& curve);

/// The range of the y axis where it is not gnuplot's to choose.
std::optional<Range> yRange(const Panel& panel);

/// Whether there is anything to draw; a figure without is not written.
bool hasPoints(const Panel& panel);

}  // namespace crossgrain::reports
