// The thesis' figures over volume fractions, rotations and ring widths, of collisions, and Mohan's
// model over the averages.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "cases/thesis_claims.hpp"
#include "continuum/cell_scale.hpp"
#include "reports/common/numbers.hpp"
#include "reports/thesis/drawing.hpp"

namespace crossgrain::reports {
namespace {

using Maybe = std::optional<double>;

// ---- Over volume fractions: 6.4, 6.5, 7.24.

using NumberOfRun = std::function<Maybe(const CaseRun&)>;

struct DensityPart {
  const char* label;
  Range axis;
  NumberOfRun value;
};

Panel overDensityPanel(const ThesisResults& results, const DensityPart& part,
                       std::vector<DrawnCurve>& drawn) {
  Panel panel;
  panel.xLabel = "ν̄";
  panel.yLabel = part.label;
  panel.xRange = Range{0.78, 0.83};
  panel.shaded = shearFlow;
  const auto engines = enginesWithRuns(results);
  for (std::size_t e = 0; e < engines.size(); ++e) {
    Curve curve{engines[e], thesisStyle(e, e), Draw::points, {}};
    for (const ThesisCase* setup : packingCases(results)) {
      std::vector<Maybe> values;
      for (const CaseRun& at : finishedRuns(results, *setup, engines[e]))
        values.push_back(part.value(at));
      if (const auto [mean, error] = meanOfRuns(values); mean)
        curve.points.push_back({setup->label, *mean, error});
    }
    if (curve.points.empty()) continue;
    drawn.push_back({withoutBraces(part.label) + ", " + engines[e], curve.points, false});
    panel.curves.push_back(std::move(curve));
  }
  if (!panel.curves.empty()) fitAxis(panel, part.axis);
  return panel;
}

Figure densityFigure(const ThesisResults& results, const char* number, const char* title,
                     const char* says, const std::vector<DensityPart>& parts) {
  std::vector<DrawnCurve> drawn;
  std::vector<Panel> panels;
  for (const DensityPart& part : parts) panels.push_back(overDensityPanel(results, part, drawn));
  return thesisFigureOf(
      number, title,
      thesisAndFound(says, drawn, Finding::extremes) + " Shaded: what the thesis calls shear flow.",
      std::move(panels), static_cast<int>(parts.size()));
}

/// By the rules that the results hold; the defaults where they hold none.
DivergenceRule divergenceRule(const ThesisResults& results) {
  if (results.rules.empty()) return {};
  const ClaimRules rules = claimRulesOf(results.rules, nullptr);
  return {rules.number("band_to"), rules.number("first_layer_to"), rules.number("bulk_to"),
          rules.of("C27").number("factor")};
}

// ---- Rotation by rotation: 5.5, 6.1.

Figure fillingOverRotations(const ThesisResults& results, const char* number, double label) {
  struct Part {
    const char *name, *label;
    std::optional<double> ThesisSpan::*value;
  };
  constexpr Part parts[] = {
      {"at the wheel", "ν, innermost ring", &ThesisSpan::volumeFractionAtWheel},
      {"outer half", "ν, outer half", &ThesisSpan::volumeFractionOutside}};
  std::vector<std::string> clauses;
  std::vector<Panel> panels;
  const ThesisCase* const setup = packingCase(results, label);
  const auto engines = enginesWithRuns(results);
  for (const Part& part : parts) {
    Panel panel;
    panel.xLabel = "rotations since the ring had closed";
    panel.yLabel = part.label;
    for (std::size_t e = 0; setup && e < engines.size(); ++e) {
      std::string name = engines[e];
      for (const CaseRun& at : finishedRuns(results, *setup, engines[e])) {
        Curve curve{name, thesisStyle(e, e), Draw::linesAndPoints, {}};
        for (const ThesisSpan& span : at.run->history)
          if (const auto value = span.*part.value)
            curve.points.push_back({0.5 * (span.from + span.to), *value, {}});
        if (curve.points.empty()) continue;
        if (!name.empty())
          clauses.push_back(fmt::format("{}, {}: {} in the first rotation, {} in the last",
                                        engines[e], part.name, readable(curve.points.front().y),
                                        readable(curve.points.back().y)));
        panel.curves.push_back(std::move(curve));
        name.clear();
      }
    }
    if (panel.curves.empty()) continue;
    fitAxis(panel, {0.4, 1.0});
    panels.push_back(std::move(panel));
  }
  Figure figure = thesisFigureOf(number, "Volume fraction over time", "", std::move(panels));
  figure.caption = fmt::format(
      "Figure {}. Volume fraction over time, ν̄ = {:.3f}. {} Profiles are kept of the "
      "averaged rotations only: these are the wheel's ring and the outer half.",
      number, label,
      thesisAndFound("a steady state at the wheel within about five rotations, hardly any change "
                     "further out",
                     clauses));
  return figure;
}

// ---- What the width of a ring does to the volume fraction in it: 5.6.

/// ν of so many neighbouring rings together, those about a radius: volumes add up. Absent where
/// they do not lie in the cell.
Maybe togetherAbout(const std::vector<RingValue>& rings, double width, double innerRadius,
                    double radius, std::size_t count) {
  const auto first = std::lround((radius - innerRadius) / width - 0.5 * static_cast<double>(count));
  if (first < 0 || static_cast<std::size_t>(first) + count > rings.size()) return std::nullopt;
  double disks = 0.0, room = 0.0;
  for (auto k = static_cast<std::size_t>(first); k < static_cast<std::size_t>(first) + count; ++k) {
    disks += rings[k].value * rings[k].r;  // a ring's volume goes as its radius
    room += rings[k].r;
  }
  return disks / room;
}

/// Over the rings' width in d, mean over packings.
std::vector<Point> overWidths(const std::vector<CaseRun>& runs, const char* method, double radius) {
  constexpr double widest = 3.0;  // d
  std::vector<Point> points;
  for (std::size_t count = 1;; ++count) {
    std::vector<Maybe> values;
    double width = 0.0;
    for (const CaseRun& at : runs) {
      const RingAverages* const finest = finestOf(*at.run);
      const auto& profiles = finest ? finest->profiles : at.run->run.profiles;
      const CouetteCell& cell = at.setup->cell;
      const Profile* const nu = profileOf(profiles, method, "volume_fraction");
      const auto rings = ringsOf(cell, nu);
      if (rings.empty() || rings.size() < nu->mean.size()) continue;
      width = (cell.outerRadius - cell.innerRadius) / static_cast<double>(rings.size());
      values.push_back(togetherAbout(rings, width, cell.innerRadius, radius, count));
      width /= cell.diameter;
    }
    if (width == 0.0 || static_cast<double>(count) * width > widest) return points;
    if (const auto [mean, error] = meanOfRuns(values); mean)
      points.push_back({static_cast<double>(count) * width, *mean, error});
  }
}

/// By how much the two differ where rings are narrowest, and about one d wide.
std::string methodsClause(double radius, const std::vector<Point>& slices,
                          const std::vector<Point>& centres) {
  if (slices.empty() || slices.size() != centres.size()) return "";
  const auto off = [&](std::size_t k) { return readable(std::abs(centres[k].y - slices[k].y)); };
  const auto atD = static_cast<std::size_t>(
      std::ranges::min_element(slices, {}, [](const Point& p) { return std::abs(p.x - 1.0); }) -
      slices.begin());
  return fmt::format("r = {:.2f} m: the methods differ by {} at {:.2f} d, by {} at {:.2f} d",
                     radius, off(0), slices[0].x, off(atD), slices[atD].x);
}

// ---- Collisions: 4.3.

/// Laws by their names in case files: the three of the figure, and the thesis' own.
constexpr std::pair<const char*, const char*> figureLaws[] = {
    {"coulomb", "Coulomb"},
    {"viscous", "viscous"},
    {"spring", "spring"},
    {"spring_dashpot", "spring, dashpot"}};

Panel sweepsPanel(const CollideResults& collisions, const char* tension, const char* title,
                  std::vector<std::string>& clauses) {
  constexpr double thesisSteps = 50.0, largestPsi = 4.0;
  Panel panel;
  panel.title = title;
  panel.xLabel = "Ψ_{i}";
  panel.yLabel = "Ψ_{f}";
  panel.xRange = Range{0.0, largestPsi};
  panel.level = 0.0;
  std::vector<std::string> engines;
  for (const CollisionVariant& variant : collisions.variants)
    for (const CollisionCurve& curve : variant.curves)
      if (std::ranges::find(engines, curve.engine) == engines.end())
        engines.push_back(curve.engine);
  bool line = false;
  for (std::size_t e = 0; e < engines.size(); ++e) {
    const LawSweeps sweeps = lawSweeps(collisions, engines[e], tension, thesisSteps);
    for (std::size_t l = 0; l < std::size(figureLaws); ++l) {
      const auto& [law, label] = figureLaws[l];
      const auto found = sweeps.find(law);
      if (found == sweeps.end()) continue;
      Curve curve{e == 0   ? label
                  : l == 0 ? engines[e]
                           : "",
                  thesisStyle(l, e),
                  Draw::points,
                  {},
                  1.0};
      for (const auto& [psi, after] : found->second.points)
        curve.points.push_back({psi, after, {}});
      panel.curves.push_back(std::move(curve));
      clauses.push_back(fmt::format("{}, {}, {}: lowest Ψ_f {}, e_n {}", title, engines[e], label,
                                    readable(found->second.lowest()), readable(found->second.en)));
      if (line) continue;
      const double constant = 3.0 * (1.0 + found->second.en) * lawFriction(collisions);
      panel.curves.push_back(
          guideLine("sliding", {{constant, 0.0, {}}, {largestPsi, largestPsi - constant, {}}}));
      line = true;
    }
  }
  if (!panel.curves.empty()) fitAxis(panel, {-1.0, 3.0});
  return panel;
}

// ---- Mohan's Cosserat model over the averages: 9.1 to 9.4.

CellScale scaleOf(const ThesisCase& setup) {
  CellScale cell;
  cell.innerRadius = setup.cell.innerRadius;
  cell.gap = setup.cell.outerRadius - setup.cell.innerRadius;
  cell.omega = std::abs(setup.cell.omega);
  return cell;
}

/// A parameter set of the model, and its fields or why it has none.
struct ModelCurve {
  std::string name;
  CosseratOutcome outcome;
};

/// The ring next to the wheel, as the reference engine has it.
std::optional<RingStress> wheelRing(const std::vector<CaseRun>& runs) {
  const auto value = [&](const char* field) -> Maybe {
    const auto points = meanPoints(runs, "r", field);
    return points.empty() ? std::nullopt : Maybe(points.front().y);
  };
  const auto rr = value("stress_rr"), pp = value("stress_pp"), rp = value("stress_rp"),
             pr = value("stress_pr"), couple = value("couple_stress_zr"), r = value("r");
  if (!rr || !pp || !rp || !pr || !couple || !r) return std::nullopt;
  return RingStress{*r, *rr, *pp, *rp, *pr, *couple};
}

const Formula atXi = "(r - R_i) / (R_o - R_i)";
const Formula velocityOfModel = "azimuthal_velocity / (omega * R_i)";

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

/// @param fitted  is set to a clause about the second curve
std::vector<ModelCurve> modelCurves(const ThesisCase& setup, const std::vector<CaseRun>& runs,
                                    std::string& fitted) {
  const auto velocities = meanPoints(runs, atXi, velocityOfModel);
  CosseratParameters parameters = parametersOf(scaleOf(setup));
  std::vector<ModelCurve> curves = {
      {"model as printed", matchedAtTheWheel(parameters, velocities)}};
  const auto ring = wheelRing(runs);
  const auto friction = ring ? frictionOf(*ring, scaleOf(setup)) : std::nullopt;
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

struct ModelPanel {
  const char* yLabel;
  Range yRange;
  bool logY;
  Formula average;
  double CosseratPoint::*value;
  RingWidth width = RingWidth::ofCase;
  bool averages = true, model = true;
};

struct ModelFigure {
  const char *number, *title, *says;
  std::vector<ModelPanel> panels;
  const char* note = "";
};

std::vector<ModelFigure> modelFigureTable() {
  using P = CosseratPoint;
  const char* const u = "u = v_{φ} / (Ω R_{i})";
  const char* const omega = "|ω| = |S| H / (Ω R_{i})";
  const char* const spin = "abs(spin) * (R_o - R_i) / (omega * R_i)";
  // M_rz of m = 1 is d_p L √(2(A+1)) σ_c, with σ_c = tr σ/2, d_p = 8 mm, L = 10 and A = 1/3.
  const char* const couple =
      "-2 * couple_stress_zr / stress_trace / (0.008 * 10 * sqrt(2 * (1 / 3 + 1)))";
  return {
      {"9.1",
       "Velocity and Mohan's model",
       "the model fits, though it decays faster than the exponential of the simulation",
       {{u, {0.0, 1.0}, false, velocityOfModel, &P::u},
        {u, {1e-5, 1.0}, true, velocityOfModel, &P::u}}},
      {"9.2",
       "Spin and Mohan's model",
       "the model fits |ω|, of which it knows no oscillation",
       {{omega, {0.0, 6.0}, false, spin, &P::omega, RingWidth::finest},
        {omega, {1e-4, 10.0}, true, spin, &P::omega, RingWidth::finest}}},
      {"9.3",
       "Shear stresses and Mohan's model",
       "σ_rφ ≠ σ_φr at the wheel in both, equal further out",
       {{"σ_{φr} / σ_{c}", {0.0, 0.6}, false, "2 * stress_pr / stress_trace", &P::s},
        {"σ_{rφ} / σ_{c}", {0.0, 0.6}, false, "2 * stress_rp / stress_trace", &P::q}}},
      {"9.4",
       "Couple stress and Mohan's model",
       "0.21 to 0.23, growing outward, in the model; at most 6×10⁻⁵, decaying, in the simulation",
       {{"m, model", {0.2, 0.24}, false, couple, &P::m, RingWidth::ofCase, false, true},
        {"m, averages", {-1e-5, 6e-5}, false, couple, &P::m, RingWidth::ofCase, true, false}},
       " M_zr > 0 of averages is m < 0: that sign has a couple stress which Eq. 9.24 balances with "
       "σ_φr − σ_rφ."}};
}

std::string rangeClause(const Curve& curve) {
  return curve.name + ": " + readable(curve.points.front().y) + " at the wheel, " +
         readable(curve.points.back().y) + " at the outer ring";
}

}  // namespace

std::vector<Figure> densityFigures(const ThesisResults& results) {
  const auto fitted = [](const char* name) {
    return [=](const CaseRun& at) { return fittedIn(*at.run, name); };
  };
  const auto width = [](const CaseRun& at) -> Maybe {
    const auto inverse = fittedIn(*at.run, "dilation_decay");
    return inverse && *inverse > 0.0 ? Maybe(1.0 / *inverse) : std::nullopt;
  };
  const auto divergence = [rule = divergenceRule(results)](const CaseRun& at) {
    return traceOfDivergence(at, rule);
  };
  return {densityFigure(results, "6.4", "Fit parameters of the volume fraction",
                        "ν₀ within 0.82 … 0.87 and B within 0 … 0.7, which are its axes",
                        {{"ν_{0}", {0.82, 0.87}, fitted("volume_fraction_outside")},
                         {"B", {0.0, 0.7}, fitted("dilation")}}),
          densityFigure(results, "6.5", "Width of the dilated zone",
                        "both a minimal width and a maximal C⁻¹ at ν̄ ≈ 0.809",
                        {{"1/C [d]", {0.0, 10.0}, width}}),
          densityFigure(results, "7.24", "tr F at which the shear resistance diverges",
                        "grows with ν̄", {{"tr F_{div}", {0.5, 3.5}, divergence}})};
}

std::vector<Figure> rotationFigures(const ThesisResults& results) {
  return {fillingOverRotations(results, "5.5", 0.796), fillingOverRotations(results, "6.1", 0.804)};
}

std::vector<Figure> widthOfRingFigures(const ThesisResults& results) {
  constexpr double label = 0.804;  // the thesis does not say which
  const ThesisCase* const setup = packingCase(results, label);
  const auto engines = enginesWithRuns(results);
  if (!setup || engines.empty()) return {};
  const std::vector<CaseRun> runs = finishedRuns(results, *setup, engines.front());
  Panel panel;
  panel.xLabel = "Δr / d";
  panel.yLabel = "ν";
  panel.logX = true;
  panel.xRange = Range{0.25, 4.0};
  panel.xTicks = {0.3, 0.5, 1.0, 2.0, 3.0};
  std::vector<std::string> clauses;
  std::size_t colour = 0;
  for (const double radius : {0.12, 0.13, 0.14, 0.20}) {  // m
    const auto slices = overWidths(runs, "slicing", radius),
               centres = overWidths(runs, "centre", radius);
    const LineStyle style = thesisStyle(colour++, 0);
    constexpr int open = 6, filled = 7;  // circles
    const std::string name = fmt::format("r = {:.2f} m", radius);
    if (!slices.empty())
      panel.curves.push_back({name, {style.colour, filled, false}, Draw::linesAndPoints, slices});
    if (!centres.empty())
      panel.curves.push_back(
          {name + ", centres", {style.colour, open, true}, Draw::linesAndPoints, centres});
    if (const std::string clause = methodsClause(radius, slices, centres); !clause.empty())
      clauses.push_back(clause);
  }
  if (panel.curves.empty()) return {};
  fitAxis(panel, {0.0, 2.0});
  return {thesisFigureOf(
      "5.6", "Volume fraction against the width of the ring",
      thesisAndFound("slicing and centres meet at Δr = 0.97 to 1.03 d and at 2 d; between 0.1 and "
                     "2 d centres vary strongly",
                     clauses) +
          fmt::format(" ν̄ = {:.3f}, {}. Rings wider than the narrowest that were averaged are put "
                      "together of them, next to each radius; the thesis goes on to 0.01 d.",
                      label, engines.front()),
      {std::move(panel)}, 1)};
}

std::vector<Figure> collisionFigures(const ThesisResults& results) {
  if (!results.collisions) return {};
  std::vector<std::string> clauses;
  std::vector<Panel> panels = {
      sweepsPanel(*results.collisions, "allow", "tension allowed", clauses),
      sweepsPanel(*results.collisions, "cut", "tension cut", clauses)};
  std::erase_if(panels, [](const Panel& panel) { return panel.curves.empty(); });
  return {thesisFigureOf(
      "4.3", "Tangential velocities after and before a collision",
      thesisAndFound("only a spring reverses the tangential velocity; sliding follows Ψ_f = Ψ_i − "
                     "3(1 + e_n)µ",
                     clauses) +
          " Head-on collisions of two small disks with spin, table 4.1's constants (those of the "
          "thesis' figure are not stated), at 50 steps per contact; dashed: sliding.",
      std::move(panels))};
}

std::vector<Figure> modelFigures(const ThesisResults& results) {
  constexpr double label = 0.804;  // chapter 9 does not say which ν̄
  const ThesisCase* const setup = packingCase(results, label);
  const auto engines = enginesWithRuns(results);
  if (!setup || engines.empty()) return {};
  std::string fitted;
  const auto models = modelCurves(*setup, finishedRuns(results, *setup, engines.front()), fitted);
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
      const auto add = [&](Curve curve) {
        if (curve.points.empty()) return;
        if (first) clauses.push_back(rangeClause(curve));
        panel.curves.push_back(std::move(curve));
      };
      for (std::size_t e = 0; part.averages && e < engines.size(); ++e)
        add({engines[e], thesisStyle(e, e), Draw::linesAndPoints,
             meanPoints(finishedRuns(results, *setup, engines[e]), atXi, part.average,
                        part.width)});
      for (std::size_t k = 0; part.model && k < models.size(); ++k) {
        Curve curve{
            models[k].name, {k == 0 ? "#666666" : "#aa4499", 0, k > 0}, Draw::lines, {}, 2.0};
        constexpr int places = 200;
        for (int place = 0; models[k].outcome.solution && place <= places; ++place) {
          const CosseratPoint at =
              models[k].outcome.solution->at(static_cast<double>(place) / places);
          curve.points.push_back({at.xi, at.*part.value, {}});
        }
        add(std::move(curve));
      }
      if (panel.curves.empty()) continue;
      if (part.logY)
        panel.yRange = part.yRange;  // the model falls by ten decades
      else
        fitAxis(panel, part.yRange);
      panels.push_back(std::move(panel));
    }
    clauses.push_back(fitted);
    figures.push_back(
        thesisFigureOf(spec.number, spec.title,
                       fmt::format("{} ν̄ = {:.3f}; as printed: δ = 9.8°, ψ = 22.6°.{}",
                                   thesisAndFound(spec.says, clauses), label, spec.note),
                       std::move(panels)));
  }
  return figures;
}

}  // namespace crossgrain::reports
