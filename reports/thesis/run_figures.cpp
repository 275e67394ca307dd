// Figures over volume fractions, and over rotations.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "reports/common/numbers.hpp"
#include "reports/thesis/divergence.hpp"
#include "reports/thesis/figures.hpp"
#include "reports/thesis/findings.hpp"
#include "reports/thesis/leg_rings.hpp"
#include "reports/thesis/leg_runs.hpp"

namespace crossgrain::reports {

namespace {

/// Table 3.2: shear flow from the critical ν̄ up to where the cell is blocked.
constexpr Range shearFlow{0.793, 0.810};

using NumberOfRun = std::function<std::optional<double>(const ThesisLeg&, const ThesisRun&)>;

Panel overDensityPanel(const ThesisResults& results, const char* label, Range axis,
                       const NumberOfRun& number, std::vector<DrawnCurve>& told) {
  Panel panel;
  panel.xLabel = "ν̄";
  panel.yLabel = label;
  panel.xRange = Range{0.78, 0.83};
  panel.shaded = shearFlow;
  const auto engines = enginesWithRuns(results);
  for (std::size_t e = 0; e < engines.size(); ++e) {
    Curve curve{engines[e], thesisStyle(e, e), Draw::points, {}, 1.5};
    for (const ThesisLeg* leg : packingLegs(results)) {
      std::vector<std::optional<double>> values;
      for (const ThesisRun* run : finishedRuns(results, *leg, engines[e]))
        values.push_back(number(*leg, *run));
      if (const auto [mean, error] = meanOfRuns(values); mean)
        curve.points.push_back({leg->label, *mean, error});
    }
    if (curve.points.empty()) continue;
    told.push_back({withoutBraces(label) + ", " + engines[e], curve.points, false});
    panel.curves.push_back(std::move(curve));
  }
  bool widened = false;
  if (!panel.curves.empty()) panel.yRange = holding(axis, panel.curves, false, widened);
  return panel;
}

struct DensityFigure {
  const char *number, *title, *says;
  struct Part {
    const char* label;
    Range axis;
    NumberOfRun value;
  };
  std::vector<Part> parts;
};

/// A number of a span, of the first packing of a leg.
struct SpanNumber {
  const char *name, *label;
  std::optional<double> ThesisSpan::*value;
};

constexpr SpanNumber spanNumbers[] = {
    {"at the wheel", "ν, innermost ring", &ThesisSpan::volumeFractionAtWheel},
    {"outer half", "ν, outer half", &ThesisSpan::volumeFractionOutside}};

Figure fillingOverRotations(const ThesisResults& results, const char* number, double label) {
  Figure figure = thesisFigureOf(number, "Volume fraction over time", "");
  const ThesisLeg* leg = packingLeg(results, label);
  if (!leg) return figure;
  std::vector<std::string> clauses;
  const auto engines = enginesWithRuns(results);
  for (const SpanNumber& wanted : spanNumbers) {
    Panel panel;
    panel.xLabel = "rotations since the ring had closed";
    panel.yLabel = wanted.label;
    for (std::size_t e = 0; e < engines.size(); ++e) {
      std::string name = engines[e];
      for (const ThesisRun* run : finishedRuns(results, *leg, engines[e])) {
        Curve curve{name, thesisStyle(e, e), Draw::linesAndPoints, {}, 1.5};
        for (const ThesisSpan& span : run->history)
          if (const auto value = span.*wanted.value)
            curve.points.push_back({0.5 * (span.from + span.to), *value, {}});
        if (curve.points.empty()) continue;
        if (!name.empty())
          clauses.push_back(fmt::format("{}, {}: {} in the first rotation, {} in the last",
                                        engines[e], wanted.name, readable(curve.points.front().y),
                                        readable(curve.points.back().y)));
        panel.curves.push_back(std::move(curve));
        name.clear();
      }
    }
    bool widened = false;
    if (panel.curves.empty()) continue;
    panel.yRange = holding({0.4, 1.0}, panel.curves, false, widened);
    figure.panels.push_back(std::move(panel));
  }
  figure.columns = 2;
  figure.caption = fmt::format(
      "Figure {}. Volume fraction over time, ν̄ = {:.3f}. {} Profiles are kept of the "
      "averaged rotations only: these are the wheel's ring and the outer half.",
      number, label,
      thesisAndFound("a steady state at the wheel within about five rotations, hardly "
                     "any change further out",
                     clauses));
  return figure;
}

}  // namespace

std::vector<Figure> densityFigures(const ThesisResults& results) {
  const std::vector<DensityFigure> specs = {
      {"6.4",
       "Fit parameters of the volume fraction",
       "ν₀ within 0.82 … 0.87 and B within 0 … 0.7, which are its axes",
       {{"ν_{0}",
         {0.82, 0.87},
         [](const ThesisLeg&, const ThesisRun& run) {
           return fittedIn(run, "volume_fraction_outside");
         }},
        {"B",
         {0.0, 0.7},
         [](const ThesisLeg&, const ThesisRun& run) { return fittedIn(run, "dilation"); }}}},
      {"6.5",
       "Width of the dilated zone",
       "both a minimal width and a maximal C⁻¹ at ν̄ ≈ 0.809",
       {{"1/C [d]",
         {0.0, 10.0},
         [](const ThesisLeg&, const ThesisRun& run) -> std::optional<double> {
           const auto inverse = fittedIn(run, "dilation_decay");
           return inverse && *inverse > 0.0 ? std::optional(1.0 / *inverse) : std::nullopt;
         }}}},
      {"7.24",
       "tr F at which the shear resistance diverges",
       "grows with ν̄",
       {{"tr F_{div}",
         {0.5, 3.5},
         [rule = divergenceRule(results)](const ThesisLeg& leg,
                                          const ThesisRun& run) -> std::optional<double> {
           const auto view = ringViewOf(leg, run);
           return view ? traceOfDivergence(*view, rule) : std::nullopt;
         }}}},
  };
  std::vector<Figure> figures;
  for (const DensityFigure& spec : specs) {
    std::vector<DrawnCurve> told;
    std::vector<Panel> panels;
    for (const auto& part : spec.parts)
      panels.push_back(overDensityPanel(results, part.label, part.axis, part.value, told));
    Figure figure = thesisFigureOf(spec.number, spec.title,
                                   thesisAndFound(spec.says, told, Finding::extremes) +
                                       " Shaded: what the thesis calls shear flow.");
    figure.panels = std::move(panels);
    figure.columns = static_cast<int>(spec.parts.size());
    figures.push_back(std::move(figure));
  }
  return figures;
}

std::vector<Figure> rotationFigures(const ThesisResults& results) {
  return {fillingOverRotations(results, "5.5", 0.796), fillingOverRotations(results, "6.1", 0.804)};
}

}  // namespace crossgrain::reports
