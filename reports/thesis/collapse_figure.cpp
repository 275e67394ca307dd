// Whether impacts or lasting contacts carry the stress: all runs against the inertial number and
// the stiffness in units of the pressure.
//
// I = γ̇ d √(ρ/p) as in averaging/regime.hpp (GDR MiDi 2004), with the ring's own γ̇ = |∂v_φ/∂r −
// v_φ/r|, p = (σ_rr + σ_φφ)/2 and ρ its disks' mass over their volume. With a disk's mass m =
// ρ π d² h/4 and the force per length p h this is √(4/π) times the γ̇ √(m/(p h)) of two dimensions
// (da Cruz et al. 2005, whose κ is k_n/(p h)).

#include <fmt/format.h>
#include <gsl/gsl_statistics_double.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "averaging/regime.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/page.hpp"
#include "reports/thesis/figures.hpp"
#include "reports/thesis/findings.hpp"
#include "reports/thesis/leg_rings.hpp"

namespace crossgrain::reports {

namespace {

constexpr double bandEnd = 5.0;  ///< r̃; beyond it shear rates are noise

/// One ring of one run.
struct RingState {
  double inertial = 0.0;   ///< I
  double stiffness = 0.0;  ///< k_n/(p h)
  double friction = 0.0;   ///< σ_rφ/p
  double moving = 0.0;     ///< share of the fluctuations in the normal stress
};

/// Those of the band in which disks touch and shear.
std::vector<RingState> statesOf(const RingView& view) {
  const auto of = [&](const char* field) { return valuesIn(view, {field}); };
  const Numbers place = of("r_tilde"), rate = of("shear_rate"), trace = of("stress_trace"),
                shear = of("stress_rp"), density = of("density"), filling = of("volume_fraction"),
                rr = of("fluctuation_stress_rr"), pp = of("fluctuation_stress_pp");
  const CouetteCell& cell = view.leg->cell;
  std::vector<RingState> states;
  for (std::size_t k = 0; k < place.size(); ++k) {
    if (!rate[k] || !trace[k] || !shear[k] || !density[k] || !filling[k] || !rr[k] || !pp[k])
      continue;
    const double p = 0.5 * *trace[k], moving = 0.5 * (*rr[k] + *pp[k]);
    if (!(*place[k] < bandEnd) || !(p > 0.0) || !(*filling[k] > 0.0) || *rate[k] == 0.0) continue;
    states.push_back({std::abs(*rate[k]) * cell.diameter * std::sqrt(*density[k] / *filling[k] / p),
                      view.leg->kn / (p * cell.height), *shear[k] / p, moving / (moving + p)});
  }
  return states;
}

/// All rings of the runs of one regime.
struct RegimeStates {
  std::string name;
  std::size_t runs = 0;
  std::vector<RingState> rings;
};

std::vector<RegimeStates> statesByRegime(const ThesisResults& results, const std::string& engine) {
  std::vector<RegimeStates> all = {{"flowing", 0, {}},
                                   {"blocked", 0, {}},
                                   {"collisional", 0, {}},
                                   {"in no regime that was told", 0, {}}};
  for (const ThesisLeg& leg : results.legs)
    for (const RingView& view : ringViews(results, leg, engine)) {
      const auto& row = view.run->run.regime;
      RegimeStates& own =
          row && row->regime ? all[static_cast<std::size_t>(*row->regime)] : all.back();
      const std::vector<RingState> states = statesOf(view);
      own.runs += states.empty() ? 0 : 1;
      own.rings.insert(own.rings.end(), states.begin(), states.end());
    }
  std::erase_if(all, [](const RegimeStates& each) { return each.rings.empty(); });
  return all;
}

using RingNumber = double (*)(const RingState&);

double inertialOf(const RingState& of) {
  return of.inertial;
}
double stiffnessOf(const RingState& of) {
  return of.stiffness;
}
double frictionOfRing(const RingState& of) {
  return of.friction;
}
double movingOf(const RingState& of) {
  return of.moving;
}
/// p h/k_n
double softnessOf(const RingState& of) {
  return 1.0 / of.stiffness;
}
/// γ̇ √(m/k_n), the time of a contact over that of shear.
double contactRateOf(const RingState& of) {
  return of.inertial * std::sqrt(std::numbers::pi / 4.0 / of.stiffness);
}

Panel statesPanel(const std::vector<RegimeStates>& all, const char* xLabel, RingNumber x,
                  const char* yLabel, RingNumber y, bool logY) {
  Panel panel;
  panel.xLabel = xLabel;
  panel.yLabel = yLabel;
  panel.logX = true;
  panel.logY = logY;
  for (std::size_t g = 0; g < all.size(); ++g) {
    Curve curve{all[g].name, thesisStyle(g, g), Draw::points, {}, 1.0};
    curve.style.dashed = false;
    for (const RingState& of : all[g].rings) curve.points.push_back({x(of), y(of), {}});
    panel.curves.push_back(std::move(curve));
  }
  return panel;
}

/// p h/k_n at one inertial number: (γ̇ √(m/k_n))² 4/(π I²).
Curve inertialLine(double inertial, const std::vector<RegimeStates>& all) {
  Curve line{
      fmt::format("I = {:g}", inertial), {"#888888", 0, inertial < 0.1}, Draw::lines, {}, 2.0};
  double low = 1e300, high = 0.0;
  for (const RegimeStates& group : all)
    for (const RingState& of : group.rings) {
      low = std::min(low, contactRateOf(of));
      high = std::max(high, contactRateOf(of));
    }
  for (const double x : {low, high})
    line.points.push_back({x, x * x * 4.0 / std::numbers::pi / (inertial * inertial), {}});
  return line;
}

double medianOf(const std::vector<RingState>& rings, RingNumber of) {
  std::vector<double> values;
  for (const RingState& ring : rings) values.push_back(of(ring));
  std::ranges::sort(values);
  return gsl_stats_median_from_sorted_data(values.data(), 1, values.size());
}

/// Spearman's rank correlation over all rings.
double rankCorrelation(const std::vector<RegimeStates>& all, RingNumber x, RingNumber y) {
  std::vector<double> xs, ys;
  for (const RegimeStates& group : all)
    for (const RingState& of : group.rings) {
      xs.push_back(x(of));
      ys.push_back(y(of));
    }
  std::vector<double> work(2 * xs.size());
  return gsl_stats_spearman(xs.data(), 1, ys.data(), 1, xs.size(), work.data());
}

std::string rankClause(const std::vector<RegimeStates>& all) {
  std::size_t rings = 0;
  for (const RegimeStates& group : all) rings += group.rings.size();
  if (rings < 3) return "";
  return fmt::format(
      "over {} rings the fluctuations' share has a rank correlation of {:.2f} with I and of {:.2f} "
      "with k_n/(p h)",
      rings, rankCorrelation(all, inertialOf, movingOf),
      rankCorrelation(all, stiffnessOf, movingOf));
}

}  // namespace

Figure collapseFigure(const ThesisResults& results) {
  Figure figure;
  figure.name = "map_collapse";
  figure.title = "What carries the stress";
  const auto engines = enginesWithRuns(results);
  if (engines.empty()) return figure;
  const std::vector<RegimeStates> all = statesByRegime(results, engines.front());
  if (all.empty()) return figure;
  std::vector<std::string> clauses;
  for (const RegimeStates& of : all)
    clauses.push_back(fmt::format(
        "{} ({}): medians I = {}, k_n/(p h) = {}, σ_rφ/p = {}, share of fluctuations {}", of.name,
        counted(of.runs, "run"), readable(medianOf(of.rings, inertialOf)),
        readable(medianOf(of.rings, stiffnessOf)), readable(medianOf(of.rings, frictionOfRing)),
        readable(medianOf(of.rings, movingOf))));
  if (const std::string ranks = rankClause(all); !ranks.empty()) clauses.push_back(ranks);
  figure.caption = fmt::format(
      "{}. {} All rings of 0 < r̃ < {:g} of all legs' runs. A state that contacts carry is level in "
      "the last panel, one that impacts carry follows a line of one I, slope 2; above I = {:g} "
      "flow is called collisional.",
      figure.title,
      thesisAndFound("a flow that contacts carry, dynamic stresses two orders below static ones",
                     clauses),
      bandEnd, collisionalInertialNumber);
  constexpr const char* share = "fluctuations in the normal stress";
  Panel plane =
      statesPanel(all, "γ̇ (m / k_{n})^{1/2}", contactRateOf, "p h / k_{n}", softnessOf, true);
  for (const double inertial : {0.01, collisionalInertialNumber})
    plane.curves.push_back(inertialLine(inertial, all));
  figure.panels = {
      statesPanel(all, "inertial number I", inertialOf, "σ_{rφ} / p", frictionOfRing, false),
      statesPanel(all, "inertial number I", inertialOf, share, movingOf, true),
      statesPanel(all, "k_{n} / (p h)", stiffnessOf, share, movingOf, true), std::move(plane)};
  figure.columns = 2;
  return figure;
}

}  // namespace crossgrain::reports
