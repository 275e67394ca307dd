// The thesis' figures of profiles, as one table; the other figures have functions of their own.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reports/common/numbers.hpp"
#include "reports/thesis/drawing.hpp"
#include "reports/thesis/report.hpp"

namespace crossgrain::reports {
namespace {

/// One curve for each volume fraction and engine.
struct ThesisCurve {
  const char* name;  ///< empty where a panel has one
  Formula y;
  RingWidth width = RingWidth::ofCase;
  const char* method = "";  ///< empty: the first one
};

struct ThesisPanel {
  const char* yLabel;
  Range yRange;  ///< the thesis' axis; drawn wider where data lie beyond it
  std::vector<ThesisCurve> curves;
  bool logY = false;
  const char* title = "";
  Formula x = "r_tilde";
  const char* xLabel = "(r − R_{i}) / d";
  Range xRange{0.0, 20.0};
  bool logX = false;
  std::optional<double> level = {};
  std::optional<double> guide = {};  ///< exponent of a power law beside the last curve
  std::vector<Curve> lines = {};
};

/// A figure of profiles, as the thesis has it.
struct ThesisFigure {
  const char *number, *title, *says;  ///< what the thesis says it shows
  std::vector<double> labels;         ///< ν̄ of its curves
  std::vector<ThesisPanel> panels;
  Finding finding = Finding::ends;
  const char* note = "";  ///< what is otherwise here
  bool panelPerLabel = false;
};

/// The thesis' fit at ν̄ = 0.796 (section 6.3.2).
Curve spinOfTheText() {
  std::vector<Point> points;
  for (int k = 5; k <= 100; ++k) {
    const double x = 0.1 * k;
    points.push_back({x, 0.24 * std::exp(-1.46 * x) * std::cos(std::numbers::pi * x + 1.79), {}});
  }
  return guideLine("thesis, fit at 0.796", std::move(points));
}

Curve identityLine(const char* name, double to) {
  return guideLine(name, {{0.0, 0.0, {}}, {to, to, {}}});
}

ThesisPanel overFabric(const char* yLabel, Range yRange, const char* y) {
  ThesisPanel panel{yLabel, yRange, {{"", y, RingWidth::finest}}};
  panel.x = "fabric_trace";
  panel.xLabel = "tr F";
  panel.xRange = {0.0, 3.5};
  return panel;
}

std::vector<ThesisFigure> profileFigureTable() {
  constexpr double pi = std::numbers::pi;
  constexpr auto finest = RingWidth::finest, ofCase = RingWidth::ofCase;
  const char* const nu = "volume_fraction";
  const char* const clockwise = "−ω [rad/s], at Ω = 0.1 /s";  // Ω of the thesis
  const std::vector<double> fabric = {0.789, 0.800, 0.804, 0.807, 0.810, 0.811, 0.819},
                            stress = {0.796, 0.800, 0.804, 0.807, 0.810, 0.811, 0.828},
                            strain = {0.796, 0.800, 0.804, 0.807, 0.810, 0.811},
                            someStrain = {0.798, 0.800, 0.804, 0.807, 0.810, 0.811},
                            moduli = {0.796, 0.800, 0.804, 0.807, 0.810, 0.811, 0.819};
  const char* const fineRings =
      "The thesis has 150 rings; these are the finest that were averaged.";
  const char* const anyDensity = "The thesis does not say which ν̄.";
  ThesisPanel velocity{
      "v_{φ} / (Ω R_{i})", {1e-5, 1.0}, {{"", "azimuthal_velocity / (omega * R_i)"}}, true};
  velocity.xRange = {0.0, 14.0};
  ThesisPanel spin{
      "S d / (Ω D)", {-0.2, 0.15}, {{"", "spin * (d / (omega * 2 * R_i))", finest, "centre"}}};
  spin.xRange = {0.0, 10.0};
  spin.level = 0.0;
  spin.lines = {spinOfTheText()};
  ThesisPanel traces = overFabric("tr F", {0.0, 3.0}, "fabric_trace");
  traces.curves.front().width = ofCase;
  traces.x = "volume_fraction * coordination";
  traces.xLabel = "ν C";
  traces.xRange = {0.0, 3.0};
  traces.lines = {identityLine("tr F = ν C", 3.0)};
  const auto angles = [](const char* label, std::vector<ThesisCurve> curves) {
    ThesisPanel panel{label, {0.0, pi / 2.0}, std::move(curves)};
    panel.level = pi / 4.0;
    return panel;
  };
  ThesisPanel statics{"stress [N/m^{2}]",
                      {0.1, 10.0},
                      {{"σ_{rr}", "stress_rr"},
                       {"σ_{φφ}", "stress_pp"},
                       {"σ_{φr}", "stress_pr"},
                       {"σ_{rφ}", "stress_rp"}},
                      true};
  statics.x = "r";
  statics.xLabel = "r [m]";
  statics.xRange = {0.1, 0.26};
  statics.logX = true;
  statics.guide = -2.0;
  ThesisPanel stiffness =
      overFabric("2πhE / k_{n}", {0.0, 3.5}, "2 * pi * height / kn * bulk_modulus");
  stiffness.lines = {identityLine("mean field", 3.5)};
  ThesisPanel excess{
      "−ω* [rad/s], at Ω = 0.1 /s", {-0.4, 0.6}, {{"", "-0.1 / omega * excess_rotation", finest}}};
  excess.xRange = {1.0, 7.0};
  excess.level = 0.0;
  const auto aboutZero = [](ThesisPanel panel) {
    panel.level = 0.0;
    return panel;
  };
  const auto binning = [&](const char* title, const char* method, Range range) {
    ThesisPanel panel{
        "ν", range, {{"Δr of the case", nu, ofCase, method}, {"finest Δr", nu, finest, method}}};
    panel.title = title;
    return panel;
  };
  // clang-format off
  return {
      {"5.7", "Volume fraction by two averaging methods and ring widths", "centres alone exceed 1 in 60 rings, slices never do",
       {0.804}, {binning("particle centres", "centre", {0.0, 1.6}), binning("slicing", "slicing", {0.2, 0.9})}, Finding::extremes},
      {"6.2", "Volume fraction for several densities", "a dilated zone at the wheel, 5 to 6 d wide",
       {0.789, 0.804, 0.811}, {{"ν", {0.4, 1.0}, {{"", nu}}}}},
      {"6.3", "Volume fraction beside the experiment's", "as in the experiment, whose values are shifted by −0.08",
       {0.789, 0.804, 0.811}, {{"ν", {0.4, 1.0}, {{"", nu}}}}, Finding::ends, "The experiment's curves are pictures only and are not drawn."},
      {"6.7", "Azimuthal velocity", "an exponential decay, with slip at the wheel", {0.796, 0.804, 0.811}, {velocity}, Finding::decay},
      {"6.8", "Spin", "the first layer turns against the wheel, the second with it; A = 0.24, B = 1.46, φ = 1.79 at ν̄ = 0.796",
       {0.796, 0.811}, {spin}, Finding::extremes},
      {"7.4", "Trace of the fabric against ν C", "all bins on the identity, but for those at the walls",
       fabric, {traces}, Finding::identity, "Contacts with walls count in C here, which makes it an identity at the walls, too."},
      {"7.5", "Trace of the fabric", "smallest in the shear band, lower again at the outer wall, growing with ν̄",
       fabric, {{"tr F", {0.0, 3.5}, {{"", "fabric_trace"}}}}},
      {"7.6", "Deviatoric share of the fabric", "falls with ν̄ and with the distance from the wheel",
       fabric, {{"dev F / tr F", {0.0, 0.6}, {{"", "fabric_deviator / fabric_trace"}}}}},
      {"7.7", "Orientation of the fabric", "a little more than π/4, but for the innermost layer and far out",
       fabric, {angles("φ_{F} [rad]", {{"", "fabric_angle"}})}},
      {"7.11", "Dynamic stress", "σ_φφ > σ_rr > σ_rφ, two orders below the static stress", {0.804},
       {{"dynamic stress [N/m^{2}]", {1e-5, 1e-2},
         {{"σ^{dyn}_{φφ}", "dynamic_stress_pp"}, {"σ^{dyn}_{rr}", "dynamic_stress_rr"}, {"|σ^{dyn}_{rφ}|", "abs(dynamic_stress_rp)"},
          {"ρ v_{φ}^{2}", "density * azimuthal_velocity * azimuthal_velocity"}}, true}}, Finding::ends, anyDensity},
      {"7.12", "Static stress against the radius", "σ_rr and σ_φφ almost constant, σ_rφ ∝ r⁻²", {0.804}, {statics}, Finding::powerLaw, anyDensity},
      {"7.13", "Static stress for several densities", "both grow with ν̄", stress,
       {{"σ_{rr} [N/m^{2}]", {0.1, 1000.0}, {{"", "stress_rr"}}, true}, {"σ_{rφ} [N/m^{2}]", {1e-3, 100.0}, {{"", "stress_rp"}}, true}}},
      {"7.14", "Trace of the stress", "grows with ν̄, constant over r", stress, {{"tr σ [N/m^{2}]", {0.1, 1000.0}, {{"", "stress_trace"}}, true}}},
      {"7.15", "Deviatoric share of the stress", "falls with ν̄ and with the distance from the wheel",
       stress, {{"dev σ / tr σ", {0.0, 0.6}, {{"", "stress_deviator / stress_trace"}}}}},
      {"7.17", "Trace of the elastic deformation gradient", "largest in the shear band at low ν̄, flatter at high ν̄",
       strain, {{"tr ε", {1e-5, 1e-2}, {{"", "strain_trace"}}, true}}},
      {"7.18", "Deviatoric share of the elastic deformation gradient", "depends little on ν̄",
       someStrain, {{"dev ε / tr ε", {0.0, 0.35}, {{"", "strain_deviator / strain_trace"}}}}},
      {"7.19", "Orientation of the elastic deformation gradient", "below that of the fabric",
       someStrain, {angles("φ_{ε} [rad]", {{"", "strain_angle"}})}},
      {"7.21", "Orientations of fabric, stress and elastic deformation gradient", "not collinear: F above σ above ε", {0.789, 0.809, 0.811},
       {angles("angle from r [rad]", {{"F", "fabric_angle"}, {"σ", "stress_angle"}, {"ε", "strain_angle"}})}, Finding::ends, "", true},
      {"7.22", "Granular stiffness against tr F", "collapses on tr F, which mean field has a few per cent low", moduli, {stiffness}, Finding::identity, fineRings},
      {"7.23", "Shear resistance against tr F", "proportional to tr F in the band, diverging outside it", moduli,
       {overFabric("πhG / k_{n}", {0.0, 9.0}, "pi * height / kn * shear_modulus")}, Finding::identity, fineRings},
      {"8.3", "Rotation of the particles and of the continuum", "the mean spin follows the continuum's rotation", {0.809},
       {{clockwise, {1e-4, 1.0}, {{"spin", "-0.1 / omega * spin", finest}, {"continuum", "-0.1 / omega * continuum_rotation"}}, true}}},
      {"8.4", "Excess rotation", "oscillates layer by layer", {0.809}, {excess}, Finding::extremes},
      {"8.5", "Couple stress", "large at the wheel only", {0.809},
       {aboutZero({"M_{zr} / d^{2} [N/m^{3}]", {-2.0, 12.0}, {{"", "couple_stress_zr / (d * d)"}}})}},
      {"8.6", "Curvature", "large at the wheel only", {0.809},
       {aboutZero({"κ_{zr} / d^{2} [1/m]", {-0.2, 1.8}, {{"", "curvature_zr / (d * d)"}}})}},
      {"8.7", "Torque resistance", "grows with the distance from the wheel and with ν̄", {0.800, 0.809, 0.811},
       {{"µ_{c} l^{2} [N/m^{2}]", {0.0, 500.0}, {{"", "torque_resistance"}}}}, Finding::ends, "The thesis' axis ends at 500 without a unit."},
  };
  // clang-format on
}

struct LabelledCase {
  double label;
  const ThesisCase* setup;
  std::string text() const { return fmt::format("{:.3f}", label); }
};

/// Draws an entry of the table from the results.
class ThesisPainter {
 public:
  ThesisPainter(const ThesisResults& results, const ThesisFigure& spec)
      : results_(results), spec_(spec), engines_(enginesWithRuns(results)) {
    for (const double label : spec.labels)
      if (const ThesisCase* setup = packingCase(results, label)) cases_.push_back({label, setup});
  }

  Figure figure() {
    std::vector<Panel> panels;
    for (const ThesisPanel& panel : spec_.panels) {
      if (!spec_.panelPerLabel) panels.push_back(panelOf(panel, cases_));
      for (std::size_t k = 0; spec_.panelPerLabel && k < cases_.size(); ++k)
        panels.push_back(panelOf(panel, {cases_[k]}));
    }
    std::erase_if(panels, [](const Panel& panel) { return !hasPoints(panel); });
    std::string caption = thesisAndFound(spec_.says, drawn_, spec_.finding);
    if (widened_) caption += " The axes are wider than the thesis', to hold all values.";
    if (*spec_.note != '\0') caption += std::string(" ") + spec_.note;
    const int columns = std::min<int>(2, static_cast<int>(panels.size()));
    return thesisFigureOf(spec_.number, spec_.title, caption, std::move(panels), columns);
  }

 private:
  Panel panelOf(const ThesisPanel& spec, const std::vector<LabelledCase>& cases) {
    Panel panel;
    panel.title = spec_.panelPerLabel && !cases.empty() ? "ν̄ = " + cases[0].text() : spec.title;
    panel.xLabel = spec.xLabel;
    panel.yLabel = spec.yLabel;
    panel.xRange = spec.xRange;
    panel.logX = spec.logX;
    panel.logY = spec.logY;
    panel.level = spec.level;
    if (spec.logX) panel.xTicks = {0.1, 0.15, 0.2, 0.25};
    for (std::size_t l = 0; l < cases.size(); ++l)
      for (std::size_t c = 0; c < spec.curves.size(); ++c)
        for (std::size_t e = 0; e < engines_.size(); ++e) {
          const std::size_t colour = cases.size() > 1 ? l : spec.curves.size() > 1 ? c : e;
          addCurve(
              panel, spec, spec.curves[c], cases[l], e,
              {nameOf(spec, cases, l, c, e), thesisStyle(colour, e), Draw::linesAndPoints, {}});
        }
    if (panel.curves.empty()) return panel;
    if (fitAxis(panel, spec.yRange)) widened_ = true;
    if (spec.guide) panel.curves.push_back(guideBelow(panel, *spec.guide));
    panel.curves.insert(panel.curves.end(), spec.lines.begin(), spec.lines.end());
    return panel;
  }

  /// The first engine's curves name the colours, the first colour's the engines' marks.
  std::string nameOf(const ThesisPanel& spec, const std::vector<LabelledCase>& cases, std::size_t l,
                     std::size_t c, std::size_t e) const {
    if (e > 0) return l == 0 && c == 0 ? engines_[e] : "";
    if (cases.size() > 1) return cases[l].text();
    if (spec.curves.size() > 1) return withoutBraces(spec.curves[c].name);
    return engines_[e];
  }

  /// A power law below the last of the first engine's curves, which shows its slope.
  static Curve guideBelow(const Panel& panel, double exponent) {
    const std::vector<Point>& points = panel.curves.back().points;
    std::vector<Point> line;
    for (const double x : {points.front().x, points.back().x})
      line.push_back({x, 0.7 * points.front().y * std::pow(x / points.front().x, exponent), {}});
    return guideLine(fmt::format("slope {}", readableSetting(exponent)), std::move(line));
  }

  void addCurve(Panel& panel, const ThesisPanel& spec, const ThesisCurve& wanted,
                const LabelledCase& of, std::size_t engine, Curve curve) {
    curve.points = meanPoints(finishedRuns(results_, *of.setup, engines_[engine]), spec.x, wanted.y,
                              wanted.width, wanted.method);
    if (curve.points.empty()) return;
    if (spec.x.text() != "r_tilde" && spec.x.text() != "r") curve.draw = Draw::points;
    describe(spec, wanted, of, engine, curve.points);
    panel.curves.push_back(std::move(curve));
  }

  /// The caption is of the first and the last ν̄; of other engines at the first, of figures with
  /// one curve.
  void describe(const ThesisPanel& spec, const ThesisCurve& wanted, const LabelledCase& of,
                std::size_t engine, const std::vector<Point>& points) {
    const bool first = of.setup == cases_.front().setup, last = of.setup == cases_.back().setup;
    const bool oneCurve = spec_.panels.size() == 1 && spec.curves.size() == 1;
    if (engine == 0 ? !(first || last) : !(first && oneCurve)) return;
    std::string text = "ν̄ = " + of.text() + ", " + engines_[engine];
    const std::string label = spec.yLabel;
    const std::string what = *wanted.name == '\0' && spec_.panels.size() > 1
                                 ? withoutBraces(label.substr(0, label.find(" [")))
                                 : withoutBraces(wanted.name);
    if (!what.empty()) text += ", " + what;
    if (*spec.title != '\0') text += fmt::format(" ({})", spec.title);
    drawn_.push_back({text, points, spec.x.text() == "r_tilde"});
  }

  const ThesisResults& results_;
  const ThesisFigure& spec_;
  std::vector<std::string> engines_;
  std::vector<LabelledCase> cases_;
  std::vector<DrawnCurve> drawn_;
  bool widened_ = false;
};

/// 7.8 after 7.7 and 7.11 after 7.9.
std::pair<int, int> orderOf(const Figure& figure) {
  const auto mark = figure.name.rfind('_');
  return {std::stoi(figure.name.substr(figure.name.find('_') + 1)),
          std::stoi(figure.name.substr(mark + 1))};
}

}  // namespace

std::vector<Figure> thesisFigures(const ThesisResults& results) {
  std::vector<Figure> figures;
  for (const ThesisFigure& spec : profileFigureTable())
    figures.push_back(ThesisPainter(results, spec).figure());
  for (auto&& part :
       {densityFigures(results), rotationFigures(results), thesisDistributionFigures(results),
        modelFigures(results), collisionFigures(results), widthOfRingFigures(results)})
    figures.insert(figures.end(), part.begin(), part.end());
  std::ranges::stable_sort(figures, {}, orderOf);
  std::erase_if(
      figures, [](const Figure& figure) { return std::ranges::none_of(figure.panels, hasPoints); });
  return figures;
}

}  // namespace crossgrain::reports
