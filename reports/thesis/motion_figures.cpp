#include <cmath>
#include <numbers>

#include "reports/thesis/figure_specs.hpp"

namespace crossgrain::reports {

namespace {

double perRim(const ThesisLeg& leg) {
  return 1.0 / (leg.cell.omega * leg.cell.innerRadius);
}

/// S d/(ΩD), D = 2 R_i.
double perRolling(const ThesisLeg& leg) {
  return leg.cell.diameter / (leg.cell.omega * 2.0 * leg.cell.innerRadius);
}

/// The thesis' fit at ν̄ = 0.796 (section 6.3.2).
Curve spinOfTheText() {
  Curve curve{"thesis, fit at 0.796", {"#888888", 0, true}, Draw::lines, {}, 2.0};
  for (int k = 5; k <= 100; ++k) {
    const double x = 0.1 * k;
    curve.points.push_back(
        {x, 0.24 * std::exp(-1.46 * x) * std::cos(std::numbers::pi * x + 1.79), {}});
  }
  return curve;
}

const Quantity fraction{"volume_fraction"};
const Range fractionAxis{0.4, 1.0};

ThesisPanel binningPanel(const char* title, const char* method, Range yRange) {
  ThesisPanel panel;
  panel.title = title;
  panel.curves = {{"Δr of the case", fraction, RingWidth::ofCase, method},
                  {"finest Δr", fraction, RingWidth::finest, method}};
  panel.yLabel = "ν";
  panel.yRange = yRange;
  return panel;
}

ThesisPanel profilePanelOf(ThesisCurve curve, const char* yLabel, Range yRange) {
  ThesisPanel panel;
  panel.curves = {std::move(curve)};
  panel.yLabel = yLabel;
  panel.yRange = yRange;
  return panel;
}

}  // namespace

std::vector<ThesisFigure> motionFigures() {
  ThesisPanel velocity = profilePanelOf({"", {"azimuthal_velocity", "", {}, perRim}},
                                        "v_{φ} / (Ω R_{i})", {1e-5, 1.0});
  velocity.logY = true;
  velocity.xRange = {0.0, 14.0};
  ThesisPanel spin = profilePanelOf({"", {"spin", "", {}, perRolling}, RingWidth::finest, "centre"},
                                    "S d / (Ω D)", {-0.2, 0.15});
  spin.xRange = {0.0, 10.0};
  spin.level = 0.0;
  spin.lines = {spinOfTheText()};
  const ThesisPanel fractions = profilePanelOf({"", fraction}, "ν", fractionAxis);
  return {
      {"5.7",
       "Volume fraction by two averaging methods and ring widths",
       "centres alone exceed 1 in 60 rings, slices never do",
       {0.804},
       {binningPanel("particle centres", "centre", {0.0, 1.6}),
        binningPanel("slicing", "slicing", {0.2, 0.9})},
       Finding::extremes},
      {"6.2",
       "Volume fraction for several densities",
       "a dilated zone at the wheel, 5 to 6 d wide",
       {0.789, 0.804, 0.811},
       {fractions}},
      {"6.3",
       "Volume fraction beside the experiment's",
       "as in the experiment, whose values are shifted by −0.08",
       {0.789, 0.804, 0.811},
       {fractions},
       Finding::ends,
       false,
       "The experiment's curves are pictures only and are not drawn."},
      {"6.7",
       "Azimuthal velocity",
       "an exponential decay, with slip at the wheel",
       {0.796, 0.804, 0.811},
       {velocity},
       Finding::decay},
      {"6.8",
       "Spin",
       "the first layer turns against the wheel, the second with it; A = 0.24, B = 1.46, φ = 1.79 "
       "at ν̄ = 0.796",
       {0.796, 0.811},
       {spin},
       Finding::extremes},
  };
}

}  // namespace crossgrain::reports
