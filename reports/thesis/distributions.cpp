// The thesis' figures of distributions, of the first packing of a case.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/common/engines.hpp"
#include "reports/common/numbers.hpp"
#include "reports/flow/figures.hpp"
#include "reports/thesis/drawing.hpp"

namespace crossgrain::reports {

namespace {

const Distribution* thesisDistribution(const ThesisRun& run, std::string_view quantity,
                                       std::optional<int> ring) {
  for (const Distribution& one : run.run.distributions)
    if (one.quantity == quantity && one.ring == ring) return &one;
  return nullptr;
}

/// @param unit  what one unit of the distribution is on the axis
std::vector<Point> densityPoints(const Distribution& distribution, double unit) {
  std::vector<Point> points;
  if (distribution.axes.size() != 1) return points;
  const Bins& bins = distribution.axes[0];
  for (std::size_t k = 0; k < distribution.density.size(); ++k)
    if (const double density = distribution.density[k]; density > 0.0)
      points.push_back({(bins.low + (static_cast<double>(k) + 0.5) * bins.width) * unit,
                        density / std::abs(unit),
                        {}});
  return points;
}

struct Spread {
  double mean, width;
};
Spread spreadOf(const std::vector<Point>& points) {
  double weight = 0.0, first = 0.0, second = 0.0;
  for (const Point& p : points) {
    weight += p.y;
    first += p.y * p.x;
    second += p.y * p.x * p.x;
  }
  const double mean = first / weight;
  return {mean, std::sqrt(std::max(0.0, second / weight - mean * mean))};
}

struct DensityPanel {
  std::string title, quantity, xLabel;
  double rTilde;  ///< of the ring
  std::optional<Range> xRange;
  Range yRange;
  double (*unit)(const CouetteCell&);
};

Figure densitiesFigure(const ThesisResults& results, const std::string& number,
                       const std::string& title, const std::string& says,
                       const std::vector<double>& labels, const std::vector<DensityPanel>& specs) {
  std::vector<std::string> clauses;
  std::vector<Panel> panels;
  const auto engines = enginesWithRuns(results);
  for (const DensityPanel& spec : specs) {
    Panel panel;
    panel.title = spec.title;
    panel.xLabel = spec.xLabel;
    panel.yLabel = "probability density";
    panel.xRange = spec.xRange;
    panel.logY = true;
    for (std::size_t l = 0; l < labels.size(); ++l)
      for (std::size_t e = 0; e < engines.size(); ++e) {
        const ThesisCase* const setup = packingCase(results, labels[l]);
        const auto runs =
            setup ? finishedRuns(results, *setup, engines[e]) : std::vector<CaseRun>{};
        const auto ring = runs.empty() ? std::nullopt : ringNear(runs.front(), spec.rTilde);
        const auto* found =
            ring ? thesisDistribution(*runs.front().run, spec.quantity, static_cast<int>(*ring))
                 : nullptr;
        if (!found) continue;
        const std::string name = e == 0   ? fmt::format("{:.3f}", labels[l])
                                 : l == 0 ? engines[e]
                                          : "";
        Curve curve{name, thesisStyle(l, e), Draw::linesAndPoints,
                    densityPoints(*found, spec.unit(setup->cell)), 1.0};
        if (curve.points.empty()) continue;
        if (e == 0) {
          const Spread spread = spreadOf(curve.points);
          clauses.push_back(fmt::format("{}, ν̄ = {:.3f}, {}: mean {}, standard deviation {}",
                                        spec.title, labels[l], engines[e], readable(spread.mean),
                                        readable(spread.width)));
        }
        panel.curves.push_back(std::move(curve));
      }
    if (panel.curves.empty()) continue;
    fitAxis(panel, spec.yRange);
    panels.push_back(std::move(panel));
  }
  return thesisFigureOf(number, title, thesisAndFound(says, clauses), std::move(panels));
}

/// A case's first packing as a comparison of engines has it; the results must outlive it.
struct CaseStudy {
  FlowFrame frame;
  std::vector<EngineRuns> engines;
};

CaseStudy studyOf(const ThesisResults& results, double label) {
  CaseStudy study;
  const ThesisCase* const setup = packingCase(results, label);
  if (!setup) return study;
  study.frame.cell = setup->cell;
  for (const std::string& engine : enginesWithRuns(results)) {
    const auto runs = finishedRuns(results, *setup, engine);
    if (runs.empty() || ringCount(runs.front()) == 0) continue;
    study.frame.rings = {};
    for (const RingValue& ring : ringPlaces(setup->cell, ringCount(runs.front()))) {
      study.frame.rings.r.push_back(ring.r);
      study.frame.rings.rTilde.push_back(ring.rTilde);
    }
    EngineRuns row;
    row.name = engine;
    row.style = engineStyle(study.engines.size());
    row.runs = row.finished = {&runs.front().run->run};
    study.engines.push_back(std::move(row));
  }
  return study;
}

std::vector<Panel> panelsNamed(const CaseStudy& study, const std::string& name) {
  for (Figure& figure : distributionFigures(study.frame, study.engines))
    if (figure.name == name) return std::move(figure.panels);
  return {};
}

/// The places of a joint distribution's highest cell, by engine.
std::string peakClause(const EngineRuns& engine, double label) {
  for (const Distribution& one : engine.distributions()) {
    if (one.quantity != "azimuthal_velocity_and_spin" || one.density.empty()) continue;
    const auto highest =
        static_cast<std::size_t>(std::ranges::max_element(one.density) - one.density.begin());
    const auto columns = static_cast<std::size_t>(one.axes[0].count);
    const auto middle = [](const Bins& bins, std::size_t k) {
      return bins.low + (static_cast<double>(k) + 0.5) * bins.width;
    };
    return fmt::format("ν̄ = {:.3f}, {}: the highest cell at ({}, {})", label, engine.name,
                       readable(middle(one.axes[0], highest % columns)),
                       readable(middle(one.axes[1], highest / columns)));
  }
  return "";
}

Figure jointFigure(const ThesisResults& results) {
  std::vector<Panel> panels;
  std::vector<std::string> clauses;
  for (const double label : {0.800, 0.811}) {
    const CaseStudy study = studyOf(results, label);
    for (Panel& panel : panelsNamed(study, "distribution_joint")) {
      panel.title += fmt::format(", ν̄ = {:.3f}", label);
      panels.push_back(std::move(panel));
    }
    for (const EngineRuns& engine : study.engines)
      if (const std::string clause = peakClause(engine, label); !clause.empty())
        clauses.push_back(clause);
  }
  Figure figure = thesisFigureOf(
      "6.11", "Joint distribution of velocity and spin at the wheel",
      thesisAndFound(
          "a peak at rest, smaller at higher ν̄, and a ridge on v_φ/(ΩR_i) = 1 + S d/(ΩD)",
          clauses) +
          " Filled: the densest cells that hold half of the samples, open: nine tenths.",
      std::move(panels));
  figure.panelWidth = 380;
  figure.panelHeight = 300;
  return figure;
}

std::vector<Figure> directionFigures(const ThesisResults& results) {
  std::vector<Panel> panels = panelsNamed(studyOf(results, 0.804), "distribution_directions");
  if (panels.empty()) return {};
  std::vector<std::string> clauses;
  for (const Panel& panel : panels) {
    const auto& points = panel.curves.front().points;
    if (points.empty()) continue;
    const auto most = std::ranges::max_element(points, {}, &Point::y);
    clauses.push_back(fmt::format("{}, {}: most contacts at {} π, {} times the mean",
                                  withoutBraces(panel.title), panel.curves.front().name,
                                  readable(most->x / std::numbers::pi),
                                  readable(most->y * 2.0 * std::numbers::pi)));
  }
  Figure wheel = thesisFigureOf(
      "7.8", "Directions of contacts at the wheel, ν̄ = 0.804",
      thesisAndFound(
          "π/2 and π/6 preferred, 5π/6 depleted",
          std::vector(clauses.begin(),
                      clauses.begin() + std::min<long>(1, static_cast<long>(clauses.size())))),
      {panels.front()}, 1);
  Figure all = thesisFigureOf(
      "7.9", "Directions of contacts from the wheel to the outer ring, ν̄ = 0.804",
      thesisAndFound("homogeneous further out, triangular at the outer wall", clauses),
      std::move(panels), 3);
  all.panelWidth = 380;
  all.panelHeight = 300;
  return {std::move(wheel), std::move(all)};
}

}  // namespace

std::vector<Figure> thesisDistributionFigures(const ThesisResults& results) {
  const auto perSecond = [](const CouetteCell& cell) {
    return std::abs(cell.omega) * cell.innerRadius / cell.diameter;
  };
  const auto asItIs = [](const CouetteCell&) { return 1.0; };
  std::vector<Figure> figures = {
      densitiesFigure(
          results, "6.6", "Radial velocities", "centred on zero, wider near the wheel",
          {0.789, 0.804, 0.811},
          {{"0 < r̃ < 1", "radial_velocity", "v_{r} / d [1/s]", 0.5, {}, {1e-3, 10.0}, perSecond},
           {"12 < r̃ < 13",
            "radial_velocity",
            "v_{r} / d [1/s]",
            12.5,
            {},
            {1e-3, 10.0},
            perSecond}}),
      densitiesFigure(
          results, "6.10", "Velocities and spins at the wheel",
          "a peak at rest, a second one of the velocity near 0.5 and a small one near 1",
          {0.800, 0.811},
          {{"velocity",
            "azimuthal_velocity",
            "v_{φ} / (Ω R_{i})",
            0.5,
            Range{-1.0, 1.5},
            {1e-3, 10.0},
            asItIs},
           {"spin", "spin", "S d / (Ω D)", 0.5, Range{-2.0, 2.0}, {1e-4, 1.0}, asItIs}}),
      jointFigure(results)};
  for (Figure& figure : directionFigures(results)) figures.push_back(std::move(figure));
  return figures;
}

}  // namespace crossgrain::reports
