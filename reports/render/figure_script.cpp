#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/common/text.hpp"
#include "reports/render/gnuplot.hpp"
#include "support/bad_input.hpp"
#include "support/files.hpp"
#include "support/input_file.hpp"

namespace crossgrain::reports {

namespace {

/// The one way for words into a script. Single quotes: gnuplot neither runs back-quoted commands
/// nor expands macros nor reads escapes in them; they end at the end of a line, so that there is
/// none.
std::string quoted(const std::string& words) {
  std::string result = "'";
  for (const char c : words) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) continue;
    result += c;
    if (c == '\'') result += c;
  }
  return result + "'";
}

/// Whether a point is drawn, wherever the axes end: it is finite, and positive on a log axis.
bool drawable(const Panel& panel, const Point& point) {
  return std::isfinite(point.x) && std::isfinite(point.y) && (!panel.logX || point.x > 0.0) &&
         (!panel.logY || point.y > 0.0);
}

/// The range of a log axis: whole decades, at most eight of the data since below lies noise about
/// zero; a narrow one just holds its data. The panel's line is on it in any case.
std::optional<Range> logRange(const Panel& panel) {
  double low = INFINITY, high = 0.0;
  for (const Curve& curve : panel.curves)
    for (const Point& point : curve.points)
      if (drawable(panel, point)) {
        low = std::min(low, point.y);
        high = std::max(high, point.y);
      }
  if (high <= 0.0) return std::nullopt;
  low = std::max(low, std::pow(10.0, std::ceil(std::log10(high) - 1e-9) - 8.0));
  if (panel.level && *panel.level > 0.0) {
    low = std::min(low, *panel.level);
    high = std::max(high, *panel.level);
  }
  if (high < 50.0 * low) return Range{low / 1.3, high * 1.3};
  return Range{std::pow(10.0, std::floor(std::log10(low) + 1e-9)),
               std::pow(10.0, std::ceil(std::log10(high) - 1e-9))};
}

/// 1, 2, 5, 10, … within a log axis too short for powers of ten alone; empty: gnuplot's choice.
std::vector<double> shortLogTicks(const std::optional<Range>& range) {
  std::vector<double> places;
  if (!range || range->high > 100.0 * range->low) return places;
  const int last = static_cast<int>(std::ceil(std::log10(range->high)));
  for (int power = static_cast<int>(std::floor(std::log10(range->low))); power <= last; ++power)
    for (const double digit : {1.0, 2.0, 5.0}) places.push_back(digit * std::pow(10.0, power));
  return places;
}

/// The column of labels, of curves that have any.
std::string labelColumn(const std::string& words) {
  std::string result;
  for (const char c : words)
    if (static_cast<unsigned char>(c) >= 0x20 && c != 0x7f && c != '"' && c != '\\') result += c;
  return " \"" + result + "\"";
}

bool hasLabels(const Curve& curve) {
  return std::ranges::any_of(curve.points, [](const Point& p) { return !p.label.empty(); });
}

/// One block per curve: x, y, ends of the bar ("?" without one; clipped where a log axis ends).
std::string dataBlock(const Panel& panel, const Curve& curve) {
  const auto range = yRange(panel);
  const bool labelled = hasLabels(curve);
  std::string block;
  for (const Point& point : curve.points) {
    if (!drawable(panel, point)) continue;
    const std::string label = labelled ? labelColumn(point.label) : std::string();
    if (!point.error || !std::isfinite(*point.error)) {
      block += fmt::format("{} {} ? ?{}\n", point.x, point.y, label);
      continue;
    }
    const double middle = panel.rows.empty() ? point.y : point.x;
    const auto& shown = panel.rows.empty() ? range : panel.xRange;
    const bool log = panel.rows.empty() ? panel.logY : panel.logX;
    double low = middle - *point.error;
    if (log && shown) low = std::max(low, std::min(shown->low, middle));
    block += fmt::format("{} {} {} {}{}\n", point.x, point.y, low, middle + *point.error, label);
  }
  return block.empty() ? "? ? ? ?\n" : block;
}

bool hasBars(const Curve& curve) {
  return std::ranges::any_of(curve.points, [](const Point& p) { return p.error.has_value(); });
}

/// Bars below the curve. Not "yerrorbars": as SVG it paints a white disk around each point.
std::string barsElement(const std::string& source, const std::string& colour, bool across) {
  return fmt::format("{} using {} with vectors nohead {} lw 1 notitle, \\\n    ", source,
                     across ? "3:2:($4-$3):(0)" : "1:3:(0):($4-$3)", colour);
}

std::string labelsElement(const std::string& source, const LineStyle& style) {
  return fmt::format(
      ", {} using 1:2:5 with labels noenhanced left offset char 0.7,0.35 font ',12' textcolor rgb "
      "{} notitle",
      source, quoted(style.colour));
}

std::string blocksElement(const std::string& source, const std::string& colour) {
  return fmt::format(
      "{} using 1:2:(0):1:($2-0.3):($2+0.3) with boxxyerror fill solid 0.75 noborder {} notitle",
      source, colour);
}

std::string keyTitle(const std::string& name) {
  return name.empty() ? "notitle" : fmt::format("title {} noenhanced", quoted(name));
}

std::string tilesElement(const std::string& source, const std::string& colour,
                         const std::string& name) {
  return fmt::format(
      "{} using 1:2:($1-0.47):($1+0.47):($2-0.44):($2+0.44) with boxxyerror fill solid 1 noborder "
      "{} {}",
      source, colour, keyTitle(name));
}

std::string styleText(const Curve& curve, bool across) {
  const std::string line =
      fmt::format("lw {} dt {}", curve.width, curve.style.dashed ? "(8,4)" : "solid");
  const std::string marks = fmt::format("pt {} ps {}", curve.style.pointType, across ? 0.9 : 0.6);
  return curve.draw == Draw::lines    ? "lines " + line
         : curve.draw == Draw::points ? "points " + marks
                                      : "linespoints " + line + " " + marks;
}

/// Bars first, then the curve itself, then labels.
std::string plotElements(const std::string& data, std::size_t index, const Curve& curve,
                         bool across, bool seen) {
  const std::string source = fmt::format("{} index {}", quoted(data), index);
  const std::string colour = "lc rgb " + quoted(curve.style.colour);
  if (curve.draw == Draw::blocks)
    return blocksElement(source, colour) +
           (hasBars(curve) ? ", " + barsElement(source, "lc rgb 'black'", across) + "1/0 notitle"
                           : "");
  if (curve.draw == Draw::bands)
    return fmt::format("{} using 1:3:4 with filledcurves fill solid 0.6 noborder {} {}", source,
                       colour, keyTitle(seen ? curve.name : std::string()));
  if (curve.draw == Draw::tiles) return tilesElement(source, colour, curve.name);
  const std::string look = styleText(curve, across);
  const std::string title = keyTitle(seen ? curve.name : std::string());
  return (hasBars(curve) ? barsElement(source, colour, across) : std::string()) +
         fmt::format("{} using 1:2 with {} {} {}", source, look, colour, title) +
         (hasLabels(curve) ? labelsElement(source, curve.style) : std::string());
}

std::string rangeText(const std::optional<Range>& range) {
  return range ? fmt::format("[{}:{}]", range->low, range->high) : "[*:*]";
}

/// gnuplot's own choice is made from the data alone: the panel's line is to lie within it too.
std::string yRangeText(const Panel& panel) {
  const auto range = yRange(panel);
  if (range || !panel.level) return rangeText(range);
  return fmt::format("[*<{0}:{0}<*]", *panel.level);
}

std::string ticks(char axis, const std::vector<double>& at, bool log) {
  std::string places;
  for (const double tick : at) places += fmt::format("{}{:.6g}", places.empty() ? "" : ",", tick);
  const bool powers = log && at.empty();
  return fmt::format("set format {0} {1}\n  set {0}tics {2}", axis, powers ? "'10^{%L}'" : "'%g'",
                     at.empty() ? "autofreq" : "(" + places + ")");
}

/// Names instead of numbers along the y axis, which then runs downward.
std::string rowNames(const Panel& panel, bool shown) {
  std::string places;
  for (std::size_t k = 0; k < panel.rows.size(); ++k)
    places += fmt::format("{}{} {}", k == 0 ? "" : ",", quoted(shown ? panel.rows[k] : ""), k);
  return fmt::format(
      "set ytics noenhanced ({})\n  set yrange [{}:-0.5]\n  set yzeroaxis lc rgb '#444444' lw 1 dt "
      "solid",
      places, static_cast<double>(panel.rows.size()) - 0.5);
}

/// Names instead of numbers along the x axis.
std::string columnNames(const Panel& panel) {
  std::string places;
  for (std::size_t k = 0; k < panel.columns.size(); ++k)
    places += fmt::format("{}{} {}", k == 0 ? "" : ",", quoted(panel.columns[k]), k);
  return fmt::format("set xtics noenhanced ({})\n  set xrange [-0.5:{}]", places,
                     static_cast<double>(panel.columns.size()) - 0.5);
}

std::string keyText(Key key) {
  if (key == Key::none) return "unset key";
  return fmt::format("set key {} samplen 2 spacing 1.1",
                     key == Key::outside    ? "outside top center horizontal"
                     : key == Key::topRight ? "inside top right noopaque"
                                            : "inside top left Left reverse noopaque");
}

/// Thin lines and the shaded part, drawn behind the data.
std::string furniture(const Panel& panel) {
  std::string lines = "  unset object\n  unset arrow\n";
  if (panel.shaded)
    lines += fmt::format(
        "  set object 1 rectangle from {}, graph 0 to {}, graph 1 behind fillcolor rgb '#eeeeee' "
        "fillstyle solid noborder\n",
        panel.shaded->low, panel.shaded->high);
  if (panel.shadedTo)
    lines += fmt::format(
        "  set object 2 rectangle from graph 0, graph 0 to graph 1, first {} behind fillcolor rgb "
        "'#e6e6e6' fillstyle solid noborder\n",
        *panel.shadedTo);
  if (panel.band)
    lines += fmt::format(
        "  set object 3 rectangle from graph 0, first {} to graph 1, first {} behind fillcolor rgb "
        "'#dcebf5' fillstyle solid noborder\n",
        panel.band->low, panel.band->high);
  if (panel.level)
    lines += fmt::format(
        "  set arrow 1 from graph 0, first {0} to graph 1, first {0} nohead back lc rgb '#888888' "
        "lw 1\n",
        *panel.level);
  return lines;
}

std::string panelScript(const std::string& data, std::size_t firstBlock, const Panel& panel,
                        bool firstInLine) {
  const auto range = yRange(panel);
  std::string script = fmt::format(
      "  set title {}\n  set xlabel {}\n  set ylabel {}\n  {}\n  {} logscale x\n  {} logscale y\n  "
      "{}\n  {}\n  set xrange {}\n  set yrange {}\n",
      panel.name.empty() ? quoted(panel.title) : quoted(panel.name) + " noenhanced",
      quoted(panel.xLabel), quoted(panel.yLabel),
      keyText(keyIsTooLong(panel) ? Key::none : panel.key), panel.logX ? "set" : "unset",
      panel.logY ? "set" : "unset", ticks('x', panel.xTicks, panel.logX),
      ticks('y', panel.logY ? shortLogTicks(range) : std::vector<double>(), panel.logY),
      rangeText(panel.xRange), yRangeText(panel));
  if (!panel.rows.empty()) script += "  " + rowNames(panel, firstInLine) + "\n";
  if (!panel.columns.empty()) script += "  " + columnNames(panel) + "\n";
  script += furniture(panel);
  script += "  plot ";
  for (std::size_t k = 0; k < panel.curves.size(); ++k)
    script += (k == 0 ? "" : ", \\\n    ") + plotElements(data, firstBlock + k, panel.curves[k],
                                                          !panel.rows.empty(),
                                                          isSeen(panel, panel.curves[k]));
  return script + "\n";
}

/// Room for the axis' name, whose letters may reach below the line. [letters]
double bottomMargin(const Figure& figure) {
  return figure.rowNames > 0 ? 3.8 : 3.5;
}

constexpr const char* frame =
    "set border 3 lc rgb '#444444'\nset tics nomirror out scale 0.6\nset grid lc rgb '#e4e4e4' lw "
    "0.7 dt solid\n";

const Curve* firstNamed(const Figure& figure, const std::string& name) {
  for (const Panel& panel : figure.panels)
    for (const Curve& curve : panel.curves)
      if (curve.name == name && isSeen(panel, curve)) return &curve;
  return nullptr;
}

/// Of the key above all panels, in its order; empty: there is none.
std::vector<std::string> namesAbove(const Figure& figure) {
  std::vector<std::string> names;
  if (!figure.keyAbove) return names;
  for (const Panel& panel : figure.panels)
    for (const Curve& curve : panel.curves)
      if (!curve.name.empty() && isSeen(panel, curve)) addOnce(names, curve.name);
  return names;
}

/// A plot without height across the figure's upper edge: gnuplot breaks a key into lines by the
/// width of the plot that it belongs to.
std::string keyAbove(const Figure& figure) {
  std::string entries;
  for (const std::string& name : namesAbove(figure)) {
    const Curve& curve = *firstNamed(figure, name);
    entries += fmt::format("{}2 with {} lc rgb {} title {} noenhanced", entries.empty() ? "" : ", ",
                           styleText(curve, false), quoted(curve.style.colour), quoted(name));
  }
  if (entries.empty()) return {};
  return fmt::format(
      "  unset border\n  set tics scale 0\n  set format ''\n  unset grid\n  unset object\n  unset "
      "arrow\n  unset title\n  unset xlabel\n  unset ylabel\n  unset logscale\n  set lmargin at "
      "screen 0.02\n  set rmargin at screen 0.98\n  set bmargin at screen 0.998\n  set tmargin at "
      "screen 0.999\n  set key at screen 0.5, screen 0.99 center top horizontal samplen 2 spacing "
      "1.1\n  plot [0:1][0:1] {}\n  unset lmargin\n  unset rmargin\n  unset tmargin\n  set bmargin "
      "{}\n{}",
      entries, bottomMargin(figure), frame);
}

/// Where the k-th of panels that share the names of their rows stands.
std::string placeInLine(const Figure& figure, std::size_t k) {
  if (figure.rowNames == 0) return {};
  constexpr double gap = 22.0;  // [px]
  const double left = figure.rowNames + figure.panelWidth * static_cast<double>(k);
  return fmt::format("  set lmargin at screen {}\n  set rmargin at screen {}\n",
                     left / widthOf(figure), (left + figure.panelWidth - gap) / widthOf(figure));
}

std::string terminals(const Figure& figure, std::size_t rows) {
  const int width = widthOf(figure);
  const int height = figure.panelHeight * static_cast<int>(rows);
  std::string script = fmt::format(
      "  if (terminal eq 'svg') {{\n    set terminal svg size {0},{1} font 'sans-serif,13' "
      "background rgb 'white'\n    set output {2}\n  }}\n  if (terminal eq 'pdfcairo') {{\n    set "
      "terminal pdfcairo size {3}in,{4}in font 'sans-serif,10'\n    set output {5}\n  }}\n",
      width, height, quoted(figure.name + ".svg"), width / 96.0, height / 96.0,
      quoted(figure.name + ".pdf"));
  if (figure.png)
    script += fmt::format(
        "  if (terminal eq 'pngcairo') {{\n    set terminal pngcairo size {},{} font "
        "'sans-serif,10' fontscale 2 linewidth 2 pointscale 2\n    set output {}\n  }}\n",
        2 * width, 2 * height, quoted(figure.name + ".png"));
  return script;
}

}  // namespace

int widthOf(const Figure& figure) {
  return figure.rowNames + figure.panelWidth * figure.columns;
}

bool keyIsTooLong(const Panel& panel) {
  const auto named = [&](const Curve& curve) {
    return !curve.name.empty() && isSeen(panel, curve);
  };
  return panel.key != Key::none &&
         static_cast<std::size_t>(std::ranges::count_if(panel.curves, named)) > mostKeyNames;
}

std::optional<Range> yRange(const Panel& panel) {
  return !panel.yRange && panel.logY ? logRange(panel) : panel.yRange;
}

bool isSeen(const Panel& panel, const Curve& curve) {
  const auto y = yRange(panel);
  const auto within = [](const std::optional<Range>& range, double value) {
    return !range || (value >= range->low && value <= range->high);
  };
  return std::ranges::any_of(curve.points, [&](const Point& point) {
    return drawable(panel, point) && within(panel.xRange, point.x) &&
           (!panel.rows.empty() || within(y, point.y));
  });
}

void chooseLogY(Panel& panel) {
  double low = INFINITY, high = -INFINITY;
  for (const Curve& curve : panel.curves)
    for (const Point& point : curve.points) {
      low = std::min(low, point.y);
      high = std::max(high, point.y);
    }
  panel.logY = low > 0.0 && high >= 10.0 * low;
}

bool hasPoints(const Panel& panel) {
  return std::ranges::any_of(panel.curves, [&](const Curve& curve) {
    return std::ranges::any_of(curve.points, [&](const Point& p) { return drawable(panel, p); });
  });
}

std::string writeFigure(const Figure& figure, const std::filesystem::path& dir) {
  // It is the name of files, and part of a script outside of quotes.
  if (!usableName(figure.name))
    throw BadInput(fmt::format("no figure is called \"{}\"", figure.name));
  const std::string data = figure.name + ".dat";
  const auto columns = static_cast<std::size_t>(figure.columns);
  const std::size_t rows = (figure.panels.size() + columns - 1) / columns;
  const bool several = figure.panels.size() > 1 || figure.keyAbove;
  // Lines for the key: a figure one panel wide has two names in each.
  const std::size_t lines =
      columns > 1 ? 2 : std::max<std::size_t>(2, (namesAbove(figure).size() + 1) / 2);
  std::string room;
  for (std::size_t k = 0; figure.keyAbove && k < lines; ++k) room += "\\n";
  if (!room.empty()) room = fmt::format(" title \"{}\"", room);
  std::string script = fmt::format(
      "# gnuplot {0}.gp\nreset\nset encoding utf8\nset bmargin {4}\nset datafile missing "
      "'?'\n{5}do for [terminal in 'svg pdfcairo{1}'] {{\n  if (strstrt(GPVAL_TERMINALS, ' ' . "
      "terminal . ' ') == 0) {{ continue }}\n{2}{3}",
      figure.name, figure.png ? " pngcairo" : "", terminals(figure, rows),
      several ? fmt::format("  set multiplot layout {},{}{}\n", rows, columns, room) : "",
      bottomMargin(figure), frame);
  std::string blocks;
  std::size_t block = 0;
  for (std::size_t k = 0; k < figure.panels.size(); ++k) {
    const Panel& panel = figure.panels[k];
    script += placeInLine(figure, k) + panelScript(data, block, panel, k == 0);
    for (const Curve& curve : panel.curves) {
      blocks +=
          fmt::format("{}# x y low high\n{}", block == 0 ? "" : "\n\n", dataBlock(panel, curve));
      ++block;
    }
  }
  if (figure.keyAbove) script += keyAbove(figure);
  script += several ? "  unset multiplot\n" : "";
  script += "  unset output\n}\n";
  // gnuplot would write through a link that somebody left there, or wait for a pipe.
  for (const char* end : {".svg", ".pdf", ".png"})
    std::filesystem::remove(dir / (figure.name + end));
  writeFile(dir / data, blocks);
  writeFile(dir / (figure.name + ".gp"), script);
  return figure.name + ".gp";
}

}  // namespace crossgrain::reports
