#include "reports/thesis/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/common/engines.hpp"
#include "reports/common/numbers.hpp"
#include "reports/thesis/figure_specs.hpp"
#include "reports/thesis/findings.hpp"

namespace crossgrain::reports {

namespace {

struct LabelledLeg {
  double label;
  const ThesisLeg* leg;
  std::string words() const { return fmt::format("{:.3f}", label); }
};

/// Draws a figure's spec from the results.
class ThesisPainter {
 public:
  ThesisPainter(const ThesisResults& results, const ThesisFigure& spec)
      : results_(results), spec_(spec), engines_(enginesWithRuns(results)) {
    for (const double label : spec.labels)
      if (const ThesisLeg* leg = packingLeg(results, label)) legs_.push_back({label, leg});
  }

  Figure figure() {
    std::vector<Panel> panels;
    for (const ThesisPanel& panel : spec_.panels) {
      if (spec_.panelPerLabel)
        for (const LabelledLeg& leg : legs_) panels.push_back(panelOf(panel, {leg}));
      else
        panels.push_back(panelOf(panel, legs_));
    }
    std::erase_if(panels, [](const Panel& panel) { return !hasPoints(panel); });
    std::string caption = thesisAndFound(spec_.says, told_, spec_.finding);
    if (widened_) caption += " The axes are wider than the thesis', to hold all values.";
    if (!spec_.note.empty()) caption += " " + spec_.note;
    Figure figure = thesisFigureOf(spec_.number, spec_.title, caption);
    figure.panels = std::move(panels);
    figure.columns = std::min<int>(2, static_cast<int>(figure.panels.size()));
    return figure;
  }

 private:
  Panel panelOf(const ThesisPanel& spec, const std::vector<LabelledLeg>& legs) {
    Panel panel;
    panel.title = spec.title;
    if (spec_.panelPerLabel && !legs.empty()) panel.title = "ν̄ = " + legs[0].words();
    panel.xLabel = spec.xLabel;
    panel.yLabel = spec.yLabel;
    panel.xRange = spec.xRange;
    panel.logX = spec.logX;
    panel.logY = spec.logY;
    panel.level = spec.level;
    if (spec.logX) panel.xTicks = {0.1, 0.15, 0.2, 0.25};
    for (std::size_t l = 0; l < legs.size(); ++l)
      for (std::size_t c = 0; c < spec.curves.size(); ++c)
        for (std::size_t e = 0; e < engines_.size(); ++e) {
          const std::size_t colour = legs.size() > 1 ? l : spec.curves.size() > 1 ? c : e;
          addCurve(
              panel, spec, spec.curves[c], legs[l], e,
              {nameOf(spec, legs, l, c, e), thesisStyle(colour, e), Draw::linesAndPoints, {}, 1.5});
        }
    if (panel.curves.empty()) return panel;
    if (spec.yRange) panel.yRange = holding(*spec.yRange, panel.curves, spec.logY, widened_);
    if (spec.guide) panel.curves.push_back(guideBelow(panel, *spec.guide));
    for (const Curve& line : spec.lines) panel.curves.push_back(line);
    return panel;
  }

  /// The first engine's curves tell what colours are, the first colour's which mark is whose.
  std::string nameOf(const ThesisPanel& spec, const std::vector<LabelledLeg>& legs, std::size_t l,
                     std::size_t c, std::size_t e) const {
    if (e > 0) return l == 0 && c == 0 ? engines_[e] : "";
    if (legs.size() > 1) return legs[l].words();
    if (spec.curves.size() > 1) return withoutBraces(spec.curves[c].name);
    return engines_[e];
  }

  /// A power law below the last of the first engine's curves, which shows its slope.
  static Curve guideBelow(const Panel& panel, double exponent) {
    const std::vector<Point>& points = panel.curves.back().points;
    Curve line{fmt::format("slope {}", readableSetting(exponent)),
               {"#888888", 0, true},
               Draw::lines,
               {},
               2.0};
    for (const double x : {points.front().x, points.back().x})
      line.points.push_back(
          {x, 0.7 * points.front().y * std::pow(x / points.front().x, exponent), {}});
    return line;
  }

  void addCurve(Panel& panel, const ThesisPanel& spec, const ThesisCurve& wanted,
                const LabelledLeg& leg, std::size_t engine, Curve curve) {
    const auto views = ringViews(results_, *leg.leg, engines_[engine], wanted.width, wanted.method);
    curve.points = meanPoints(views, spec.x, wanted.y);
    if (curve.points.empty()) return;
    if (spec.x.field != "r_tilde" && spec.x.field != "r_m") curve.draw = Draw::points;
    tell(spec, wanted, leg, engine, curve.points);
    panel.curves.push_back(std::move(curve));
  }

  /// The sentence is of the first and the last ν̄; of other engines at the first, of figures with
  /// one curve.
  void tell(const ThesisPanel& spec, const ThesisCurve& wanted, const LabelledLeg& leg,
            std::size_t engine, const std::vector<Point>& points) {
    const bool first = leg.leg == legs_.front().leg, last = leg.leg == legs_.back().leg;
    const bool oneCurve = spec_.panels.size() == 1 && spec.curves.size() == 1;
    if (engine == 0 ? !(first || last) : !(first && oneCurve)) return;
    std::string of = "ν̄ = " + leg.words() + ", " + engines_[engine];
    const std::string what = wanted.name.empty() && spec_.panels.size() > 1
                                 ? withoutBraces(spec.yLabel.substr(0, spec.yLabel.find(" [")))
                                 : withoutBraces(wanted.name);
    if (!what.empty()) of += ", " + what;
    if (!spec.title.empty()) of += " (" + spec.title + ")";
    told_.push_back({of, points, spec.x.field == "r_tilde"});
  }

  const ThesisResults& results_;
  const ThesisFigure& spec_;
  std::vector<std::string> engines_;
  std::vector<LabelledLeg> legs_;
  std::vector<DrawnCurve> told_;
  bool widened_ = false;
};

/// 7.8 after 7.7 and 7.11 after 7.9.
std::pair<int, int> orderOf(const Figure& figure) {
  const auto mark = figure.name.rfind('_');
  return {std::stoi(figure.name.substr(figure.name.find('_') + 1)),
          std::stoi(figure.name.substr(mark + 1))};
}

}  // namespace

std::string thesisFigureName(const std::string& number) {
  std::string name = "figure_" + number;
  std::ranges::replace(name, '.', '_');
  return name;
}

Figure thesisFigureOf(const std::string& number, const std::string& title,
                      const std::string& caption) {
  Figure figure;
  figure.name = thesisFigureName(number);
  figure.title = "Figure " + number + ": " + title;
  figure.caption = fmt::format("Figure {}. {}. {}", number, title, caption);
  return figure;
}

std::string withoutBraces(std::string words) {
  std::erase_if(words, [](char c) { return c == '{' || c == '}'; });
  return words;
}

LineStyle thesisStyle(std::size_t colour, std::size_t engine) {
  return {engineStyle(colour).colour, engineStyle(engine).pointType,
          engine > 0 && colour != engine};
}

Range holding(Range axis, const std::vector<Curve>& curves, bool logarithmic, bool& widened) {
  Range range = axis;
  for (const Curve& curve : curves)
    for (const Point& point : curve.points) {
      if (!std::isfinite(point.y) || (logarithmic && point.y <= 0.0)) continue;
      range.low = std::min(range.low, point.y);
      range.high = std::max(range.high, point.y);
    }
  if (range.low < axis.low || range.high > axis.high) widened = true;
  if (logarithmic) {
    if (range.low < axis.low) range.low = std::pow(10.0, std::floor(std::log10(range.low)));
    if (range.high > axis.high) range.high = std::pow(10.0, std::ceil(std::log10(range.high)));
    return range;
  }
  const double margin = 0.03 * (range.high - range.low);  // so that marks are not cut
  if (range.low < axis.low) range.low -= margin;
  if (range.high > axis.high) range.high += margin;
  return range;
}

std::vector<Figure> thesisFigures(const ThesisResults& results) {
  std::vector<Figure> figures;
  for (const auto& specs : {motionFigures(), stressFigures()})
    for (const ThesisFigure& spec : specs) figures.push_back(ThesisPainter(results, spec).figure());
  for (auto&& part :
       {densityFigures(results), rotationFigures(results), thesisDistributionFigures(results),
        modelFigures(results), collisionFigures(results), widthOfRingFigures(results)})
    figures.insert(figures.end(), part.begin(), part.end());
  std::ranges::stable_sort(figures, {}, orderOf);
  const std::vector<Figure> map = mapFigures(results);
  figures.insert(figures.end(), map.begin(), map.end());
  std::erase_if(
      figures, [](const Figure& figure) { return std::ranges::none_of(figure.panels, hasPoints); });
  return figures;
}

}  // namespace crossgrain::reports
