// Mohan's Cosserat model over the averages (chapter 9).

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "continuum/cell_scale.hpp"
#include "reports/common/numbers.hpp"
#include "reports/thesis/figures.hpp"
#include "reports/thesis/findings.hpp"
#include "reports/thesis/leg_rings.hpp"

namespace crossgrain::reports {

namespace {

CellScale scaleOf(const ThesisLeg& leg) {
  CellScale cell;
  cell.innerRadius = leg.cell.innerRadius;
  cell.gap = leg.cell.outerRadius - leg.cell.innerRadius;
  cell.omega = std::abs(leg.cell.omega);
  return cell;
}

double perWheelSpeed(const ThesisLeg& leg) {
  return 1.0 / (leg.cell.omega * leg.cell.innerRadius);
}
/// |ω| = |spin| H/(ΩR_i).
double spinToModel(const ThesisLeg& leg) {
  return scaleOf(leg).gap * perWheelSpeed(leg);
}
/// Of M_zr over σ_c.
double coupleToModel(const ThesisLeg& leg) {
  const CosseratParameters p;
  return -1.0 / (scaleOf(leg).grainDiameter * p.lengthScale * std::sqrt(2.0 * (p.asymmetry + 1.0)));
}
/// σ_c = tr σ/2.
double overMeanStress(const ThesisLeg&) {
  return 2.0;
}
double coupleOverMeanStress(const ThesisLeg& leg) {
  return 2.0 * coupleToModel(leg);
}

const Quantity atXi{"xi"};
const Quantity velocityOfModel{"azimuthal_velocity", "", {}, perWheelSpeed};
const Quantity spinOfModel{"spin", "", {}, spinToModel, true};
const Quantity shearOfModel{"stress_pr", "stress_trace", {}, overMeanStress};
const Quantity otherShearOfModel{"stress_rp", "stress_trace", {}, overMeanStress};
const Quantity coupleOfModel{"couple_stress_zr", "stress_trace", {}, coupleOverMeanStress};

/// A parameter set of the model, and its fields or why it has none.
struct ModelCurve {
  std::string name;
  CosseratOutcome outcome;
};

std::optional<double> firstValue(const std::vector<Point>& points) {
  return points.empty() ? std::nullopt : std::optional(points.front().y);
}

/// The ring next to the wheel, as the reference engine has it.
std::optional<RingStress> wheelRing(const std::vector<RingView>& views) {
  const auto value = [&](const char* field) {
    return firstValue(meanPoints(views, {"r_m"}, {field}));
  };
  const auto rr = value("stress_rr"), pp = value("stress_pp"), rp = value("stress_rp"),
             pr = value("stress_pr"), couple = value("couple_stress_zr"), r = value("r_m");
  if (!rr || !pp || !rp || !pr || !couple || !r) return std::nullopt;
  return RingStress{*r, *rr, *pp, *rp, *pr, *couple};
}

/// u(0) is chosen so that the model has the averages' velocity in the ring next to the wheel.
CosseratOutcome matchedAtTheWheel(CosseratParameters parameters,
                                  const std::vector<Point>& velocities) {
  CosseratOutcome outcome = solveCosserat(parameters);
  if (!outcome.solution || velocities.empty()) return outcome;
  const double there = outcome.solution->at(velocities.front().x).u;
  if (!(velocities.front().y > 0.0 && there > 0.0)) return outcome;
  parameters.wheelVelocity = velocities.front().y / there;
  return solveCosserat(parameters);
}

std::vector<ModelCurve> modelCurves(const ThesisLeg& leg, const std::vector<RingView>& views,
                                    std::string& fitted) {
  const auto velocities = meanPoints(views, atXi, velocityOfModel);
  CosseratParameters parameters = parametersOf(scaleOf(leg));
  std::vector<ModelCurve> curves = {
      {"model as printed", matchedAtTheWheel(parameters, velocities)}};
  const auto ring = wheelRing(views);
  const auto friction = ring ? frictionOf(*ring, scaleOf(leg)) : std::nullopt;
  if (!friction) {
    fitted = "no frictions can be fitted to the stresses next to the wheel";
    return curves;
  }
  parameters.wallFriction = friction->wallFriction;
  parameters.internalFriction = friction->internalFriction;
  CosseratOutcome outcome = matchedAtTheWheel(parameters, velocities);
  fitted =
      fmt::format("fitted to the stresses next to the wheel δ = {:.1f}° and ψ = {:.1f}°{}",
                  degrees(friction->wallFriction), degrees(friction->internalFriction),
                  outcome.solution ? "" : ", for which there is no solution: " + outcome.reason);
  curves.push_back({"model, fitted frictions", std::move(outcome)});
  return curves;
}

using ModelValue = double (*)(const CosseratPoint&);

Curve curveOfModel(const ModelCurve& model, const std::string& name, std::size_t index,
                   ModelValue value) {
  Curve curve{name, {index == 0 ? "#666666" : "#aa4499", 0, index > 0}, Draw::lines, {}, 2.0};
  constexpr int places = 200;
  for (int k = 0; model.outcome.solution && k <= places; ++k) {
    const CosseratPoint point = model.outcome.solution->at(static_cast<double>(k) / places);
    curve.points.push_back({point.xi, value(point), {}});
  }
  return curve;
}

struct ModelPanel {
  const char* yLabel;
  Range yRange;
  bool logY;
  Quantity average;
  ModelValue value;
  RingWidth width = RingWidth::ofCase;
  bool averages = true, model = true;
};

struct ModelFigure {
  const char *number, *title, *says;
  std::vector<ModelPanel> panels;
  std::string note = {};
};

const std::vector<ModelFigure>& modelFigureTable() {
  const ModelValue u = [](const CosseratPoint& p) { return p.u; };
  const ModelValue omega = [](const CosseratPoint& p) { return p.omega; };
  const ModelValue s = [](const CosseratPoint& p) { return p.s; };
  const ModelValue q = [](const CosseratPoint& p) { return p.q; };
  const ModelValue m = [](const CosseratPoint& p) { return p.m; };
  static const std::vector<ModelFigure> table = {
      {"9.1",
       "Velocity and Mohan's model",
       "the model fits, though it decays faster than the exponential of the simulation",
       {{"u = v_{φ} / (Ω R_{i})", {0.0, 1.0}, false, velocityOfModel, u},
        {"u = v_{φ} / (Ω R_{i})", {1e-5, 1.0}, true, velocityOfModel, u}}},
      {"9.2",
       "Spin and Mohan's model",
       "the model fits |ω|, of which it knows no oscillation",
       {{"|ω| = |S| H / (Ω R_{i})", {0.0, 6.0}, false, spinOfModel, omega, RingWidth::finest},
        {"|ω| = |S| H / (Ω R_{i})", {1e-4, 10.0}, true, spinOfModel, omega, RingWidth::finest}}},
      {"9.3",
       "Shear stresses and Mohan's model",
       "σ_rφ ≠ σ_φr at the wheel in both, equal further out",
       {{"σ_{φr} / σ_{c}", {0.0, 0.6}, false, shearOfModel, s},
        {"σ_{rφ} / σ_{c}", {0.0, 0.6}, false, otherShearOfModel, q}}},
      {"9.4",
       "Couple stress and Mohan's model",
       "0.21 to 0.23, growing outward, in the model; at most 6×10⁻⁵, decaying, in the simulation",
       {{"m, model", {0.2, 0.24}, false, coupleOfModel, m, RingWidth::ofCase, false, true},
        {"m, averages", {-1e-5, 6e-5}, false, coupleOfModel, m, RingWidth::ofCase, true, false}},
       " M_zr > 0 of averages is m < 0: that sign has a couple stress which Eq. 9.24 balances with "
       "σ_φr − σ_rφ."}};
  return table;
}

std::string rangeClause(const std::string& of, const Curve& curve) {
  return of + ": " + readable(curve.points.front().y) + " at the wheel, " +
         readable(curve.points.back().y) + " at the outer ring";
}

}  // namespace

std::vector<Figure> modelFigures(const ThesisResults& results) {
  // Chapter 9 does not say which ν̄.
  constexpr double label = 0.804;
  const ThesisLeg* leg = packingLeg(results, label);
  const auto engines = enginesWithRuns(results);
  if (!leg || engines.empty()) return {};
  std::string fitted;
  const auto models = modelCurves(*leg, ringViews(results, *leg, engines.front()), fitted);
  std::vector<Figure> figures;
  for (const ModelFigure& spec : modelFigureTable()) {
    std::vector<std::string> clauses;
    std::vector<Panel> panels;
    for (const ModelPanel& part : spec.panels) {
      const bool first = panels.empty() || spec.panels[0].yLabel != std::string(part.yLabel);
      Panel panel;
      panel.xLabel = "ξ = (r − R_{i}) / H";
      panel.yLabel = part.yLabel;
      panel.xRange = Range{0.0, 1.0};
      panel.logY = part.logY;
      for (std::size_t e = 0; part.averages && e < engines.size(); ++e) {
        Curve curve{
            engines[e], thesisStyle(e, e), Draw::linesAndPoints,
            meanPoints(ringViews(results, *leg, engines[e], part.width), atXi, part.average), 1.5};
        if (curve.points.empty()) continue;
        if (first) clauses.push_back(rangeClause(engines[e], curve));
        panel.curves.push_back(std::move(curve));
      }
      for (std::size_t k = 0; part.model && k < models.size(); ++k) {
        Curve curve = curveOfModel(models[k], models[k].name, k, part.value);
        if (curve.points.empty()) continue;
        if (first) clauses.push_back(rangeClause(models[k].name, curve));
        panel.curves.push_back(std::move(curve));
      }
      bool widened = false;
      if (panel.curves.empty()) continue;
      if (part.logY)
        panel.yRange = part.yRange;  // the model falls by ten decades
      else
        panel.yRange = holding(part.yRange, panel.curves, false, widened);
      panels.push_back(std::move(panel));
    }
    clauses.push_back(fitted);
    Figure figure = thesisFigureOf(spec.number, spec.title,
                                   fmt::format("{} ν̄ = {:.3f}; as printed: δ = 9.8°, ψ = 22.6°.",
                                               thesisAndFound(spec.says, clauses), label) +
                                       spec.note);
    figure.panels = std::move(panels);
    figure.columns = 2;
    figures.push_back(std::move(figure));
  }
  return figures;
}

}  // namespace crossgrain::reports
