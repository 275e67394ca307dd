#include <numbers>

#include "reports/thesis/figure_specs.hpp"

namespace crossgrain::reports {

namespace {

constexpr double pi = std::numbers::pi;

double bulkScale(const ThesisLeg& leg) {
  return 2.0 * pi * leg.cell.height / leg.kn;
}
double shearScale(const ThesisLeg& leg) {
  return pi * leg.cell.height / leg.kn;
}
double perDiameterSquared(const ThesisLeg& leg) {
  return 1.0 / (leg.cell.diameter * leg.cell.diameter);
}
/// Rates as they would be at the thesis' 0.1 /s, clockwise positive.
double clockwiseAtThesisRate(const ThesisLeg& leg) {
  return -0.1 / leg.cell.omega;
}

const std::vector<double> fabricLabels = {0.789, 0.800, 0.804, 0.807, 0.810, 0.811, 0.819};
const std::vector<double> stressLabels = {0.796, 0.800, 0.804, 0.807, 0.810, 0.811, 0.828};
const std::vector<double> strainLabels = {0.796, 0.800, 0.804, 0.807, 0.810, 0.811};
const std::vector<double> modulusLabels = {0.796, 0.800, 0.804, 0.807, 0.810, 0.811, 0.819};

Curve identityLine(const char* name, double to) {
  return {name, {"#888888", 0, true}, Draw::lines, {{0.0, 0.0, {}}, {to, to, {}}}, 2.0};
}

/// Of one quantity over r̃.
ThesisPanel radialPanel(Quantity y, const char* yLabel, Range yRange, bool logY = false) {
  ThesisPanel panel;
  panel.curves = {{"", std::move(y)}};
  panel.yLabel = yLabel;
  panel.yRange = yRange;
  panel.logY = logY;
  return panel;
}

ThesisPanel anglePanel(const char* field, const char* yLabel) {
  ThesisPanel panel = radialPanel({field}, yLabel, {0.0, pi / 2.0});
  panel.level = pi / 4.0;
  return panel;
}

/// Of one quantity over tr F, on narrow rings.
ThesisPanel overFabric(Quantity y, const char* yLabel, Range yRange) {
  ThesisPanel panel = radialPanel(std::move(y), yLabel, yRange);
  panel.curves.front().width = RingWidth::finest;
  panel.x = {"fabric_trace"};
  panel.xLabel = "tr F";
  panel.xRange = {0.0, 3.5};
  return panel;
}

ThesisPanel dynamicStressPanel() {
  ThesisPanel panel;
  panel.curves = {{"σ^{dyn}_{φφ}", {"dynamic_stress_pp"}},
                  {"σ^{dyn}_{rr}", {"dynamic_stress_rr"}},
                  {"|σ^{dyn}_{rφ}|", {"dynamic_stress_rp", "", {}, nullptr, true}},
                  {"ρ v_{φ}^{2}", {"density", "", {"azimuthal_velocity", "azimuthal_velocity"}}}};
  panel.yLabel = "dynamic stress [N/m^{2}]";
  panel.yRange = Range{1e-5, 1e-2};
  panel.logY = true;
  return panel;
}

ThesisPanel staticStressPanel() {
  ThesisPanel panel;
  panel.curves = {{"σ_{rr}", {"stress_rr"}},
                  {"σ_{φφ}", {"stress_pp"}},
                  {"σ_{φr}", {"stress_pr"}},
                  {"σ_{rφ}", {"stress_rp"}}};
  panel.x = {"r_m"};
  panel.xLabel = "r [m]";
  panel.xRange = {0.1, 0.26};
  panel.yLabel = "stress [N/m^{2}]";
  panel.yRange = Range{0.1, 10.0};
  panel.logX = panel.logY = true;
  panel.guide = -2.0;
  return panel;
}

ThesisPanel anglesPanel() {
  ThesisPanel panel = anglePanel("fabric_angle", "angle from r [rad]");
  panel.curves = {{"F", {"fabric_angle"}}, {"σ", {"stress_angle"}}, {"ε", {"strain_angle"}}};
  return panel;
}

ThesisPanel rotationPanel() {
  ThesisPanel panel;
  panel.curves = {
      {"spin", {"spin", "", {}, clockwiseAtThesisRate}, RingWidth::finest},
      {"continuum", {"continuum_rotation", "", {}, clockwiseAtThesisRate}, RingWidth::ofCase}};
  panel.yLabel = "−ω [rad/s], at Ω = 0.1 /s";
  panel.yRange = Range{1e-4, 1.0};
  panel.logY = true;
  return panel;
}

std::vector<ThesisFigure> fabricAndStress() {
  ThesisPanel traceOverContacts = overFabric({"fabric_trace"}, "tr F", {0.0, 3.0});
  traceOverContacts.curves.front().width = RingWidth::ofCase;
  traceOverContacts.x = {"volume_fraction", "", {"coordination"}};
  traceOverContacts.xLabel = "ν C";
  traceOverContacts.xRange = {0.0, 3.0};
  traceOverContacts.lines = {identityLine("tr F = ν C", 3.0)};
  ThesisPanel radial = radialPanel({"stress_rr"}, "σ_{rr} [N/m^{2}]", {0.1, 1000.0}, true);
  ThesisPanel shear = radialPanel({"stress_rp"}, "σ_{rφ} [N/m^{2}]", {1e-3, 100.0}, true);
  return {
      {"7.4",
       "Trace of the fabric against ν C",
       "all bins on the identity, but for those at the walls",
       fabricLabels,
       {traceOverContacts},
       Finding::identity,
       false,
       "Contacts with walls count in C here, which makes it an identity at the walls, too."},
      {"7.5",
       "Trace of the fabric",
       "smallest in the shear band, lower again at the outer wall, growing with ν̄",
       fabricLabels,
       {radialPanel({"fabric_trace"}, "tr F", {0.0, 3.5})}},
      {"7.6",
       "Deviatoric share of the fabric",
       "falls with ν̄ and with the distance from the wheel",
       fabricLabels,
       {radialPanel({"fabric_deviator", "fabric_trace"}, "dev F / tr F", {0.0, 0.6})}},
      {"7.7",
       "Orientation of the fabric",
       "a little more than π/4, but for the innermost layer and far out",
       fabricLabels,
       {anglePanel("fabric_angle", "φ_{F} [rad]")}},
      {"7.11",
       "Dynamic stress",
       "σ_φφ > σ_rr > σ_rφ, two orders below the static stress",
       {0.804},
       {dynamicStressPanel()},
       Finding::ends,
       false,
       "The thesis does not say which ν̄."},
      {"7.12",
       "Static stress against the radius",
       "σ_rr and σ_φφ almost constant, σ_rφ ∝ r⁻²",
       {0.804},
       {staticStressPanel()},
       Finding::powerLaw,
       false,
       "The thesis does not say which ν̄."},
      {"7.13",
       "Static stress for several densities",
       "both grow with ν̄",
       stressLabels,
       {radial, shear}},
      {"7.14",
       "Trace of the stress",
       "grows with ν̄, constant over r",
       stressLabels,
       {radialPanel({"stress_trace"}, "tr σ [N/m^{2}]", {0.1, 1000.0}, true)}},
      {"7.15",
       "Deviatoric share of the stress",
       "falls with ν̄ and with the distance from the wheel",
       stressLabels,
       {radialPanel({"stress_deviator", "stress_trace"}, "dev σ / tr σ", {0.0, 0.6})}},
  };
}

std::vector<ThesisFigure> strainAndModuli() {
  ThesisPanel stiffness =
      overFabric({"bulk_modulus", "", {}, bulkScale}, "2πhE / k_{n}", {0.0, 3.5});
  stiffness.lines = {identityLine("mean field", 3.5)};
  ThesisPanel resistance =
      overFabric({"shear_modulus", "", {}, shearScale}, "πhG / k_{n}", {0.0, 9.0});
  return {
      {"7.17",
       "Trace of the elastic deformation gradient",
       "largest in the shear band at low ν̄, flatter at high ν̄",
       strainLabels,
       {radialPanel({"strain_trace"}, "tr ε", {1e-5, 1e-2}, true)}},
      {"7.18",
       "Deviatoric share of the elastic deformation gradient",
       "depends little on ν̄",
       {0.798, 0.800, 0.804, 0.807, 0.810, 0.811},
       {radialPanel({"strain_deviator", "strain_trace"}, "dev ε / tr ε", {0.0, 0.35})}},
      {"7.19",
       "Orientation of the elastic deformation gradient",
       "below that of the fabric",
       {0.798, 0.800, 0.804, 0.807, 0.810, 0.811},
       {anglePanel("strain_angle", "φ_{ε} [rad]")}},
      {"7.21",
       "Orientations of fabric, stress and elastic deformation gradient",
       "not collinear: F above σ above ε",
       {0.789, 0.809, 0.811},
       {anglesPanel()},
       Finding::ends,
       true},
      {"7.22",
       "Granular stiffness against tr F",
       "collapses on tr F, which mean field has a few per cent low",
       modulusLabels,
       {stiffness},
       Finding::identity,
       false,
       "The thesis has 150 rings; these are the finest that were averaged."},
      {"7.23",
       "Shear resistance against tr F",
       "proportional to tr F in the band, diverging outside it",
       modulusLabels,
       {resistance},
       Finding::identity,
       false,
       "The thesis has 150 rings; these are the finest that were averaged."},
  };
}

std::vector<ThesisFigure> couples() {
  ThesisPanel excess = radialPanel({"excess_rotation", "", {}, clockwiseAtThesisRate},
                                   "−ω* [rad/s], at Ω = 0.1 /s", {-0.4, 0.6});
  excess.curves.front().width = RingWidth::finest;
  excess.xRange = {1.0, 7.0};
  excess.level = 0.0;
  ThesisPanel couple = radialPanel({"couple_stress_zr", "", {}, perDiameterSquared},
                                   "M_{zr} / d^{2} [N/m^{3}]", {-2.0, 12.0});
  couple.level = 0.0;
  ThesisPanel curvature = radialPanel({"curvature_zr", "", {}, perDiameterSquared},
                                      "κ_{zr} / d^{2} [1/m]", {-0.2, 1.8});
  curvature.level = 0.0;
  return {
      {"8.3",
       "Rotation of the particles and of the continuum",
       "the mean spin follows the continuum's rotation",
       {0.809},
       {rotationPanel()}},
      {"8.4", "Excess rotation", "oscillates layer by layer", {0.809}, {excess}, Finding::extremes},
      {"8.5", "Couple stress", "large at the wheel only", {0.809}, {couple}},
      {"8.6", "Curvature", "large at the wheel only", {0.809}, {curvature}},
      {"8.7",
       "Torque resistance",
       "grows with the distance from the wheel and with ν̄",
       {0.800, 0.809, 0.811},
       {radialPanel({"torque_resistance"}, "µ_{c} l^{2} [N/m^{2}]", {0.0, 500.0})},
       Finding::ends,
       false,
       "The thesis' axis ends at 500 without a unit."},
  };
}

}  // namespace

std::vector<ThesisFigure> stressFigures() {
  std::vector<ThesisFigure> all = fabricAndStress();
  for (auto part : {strainAndModuli(), couples()}) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace crossgrain::reports
