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
#include <array>
#include <cmath>
#include <numbers>

#include "averaging/regime.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/page.hpp"
#include "reports/thesis/drawing.hpp"

namespace crossgrain::reports {
namespace {

constexpr double bandEnd = 5.0;  ///< r̃; beyond it shear rates are noise

/// What is known of one ring: I, k_n/(p h), σ_rφ/p, the share of the fluctuations in the normal
/// stress, p h/k_n and γ̇ √(m/k_n), the time of a contact over that of shear.
enum StateNumber { inertial, stiffness, friction, moving, softness, contactRate, stateNumbers };
using RingState = std::array<double, stateNumbers>;

/// Those of the band in which disks touch and shear.
std::vector<RingState> statesOf(const CaseRun& at) {
  static const Formula formulas[] = {
      "abs(positive(abs(shear_rate))) * d * sqrt(density / positive(volume_fraction) / (0.5 * "
      "stress_trace))",
      "kn / (positive(0.5 * stress_trace) * height)", "stress_rp / (0.5 * stress_trace)",
      "0.5 * (fluctuation_stress_rr + fluctuation_stress_pp)"
      " / (0.5 * (fluctuation_stress_rr + fluctuation_stress_pp) + 0.5 * stress_trace)"};
  if (ringCount(at) == 0) return {};
  std::vector<Numbers> values;
  for (const Formula& formula : formulas)
    values.push_back(formula.rings({at, at.run->run.profiles}).values);
  std::vector<RingState> states;
  for (const RingValue& ring : ringPlaces(at.setup->cell, ringCount(at))) {
    const auto of = [&](StateNumber number) { return values[number][ring.ring]; };
    if (!(ring.rTilde < bandEnd) || !of(inertial) || !of(stiffness) || !of(friction) || !of(moving))
      continue;
    states.push_back({*of(inertial), *of(stiffness), *of(friction), *of(moving),
                      1.0 / *of(stiffness),
                      *of(inertial) * std::sqrt(std::numbers::pi / 4.0 / *of(stiffness))});
  }
  return states;
}

/// All rings of the runs of one regime.
struct RegimeStates {
  std::string name;
  std::size_t runs = 0;
  std::vector<RingState> rings;

  std::vector<double> numbers(StateNumber of) const {
    std::vector<double> all;
    for (const RingState& ring : rings) all.push_back(ring[of]);
    return all;
  }
  std::string median(StateNumber of) const {
    std::vector<double> all = numbers(of);
    return readable(gsl_stats_median(all.data(), 1, all.size()));
  }
};

std::vector<RegimeStates> statesByRegime(const ThesisResults& results, const std::string& engine) {
  std::vector<RegimeStates> all = {{"flowing", 0, {}},
                                   {"blocked", 0, {}},
                                   {"collisional", 0, {}},
                                   {"in no regime that is known", 0, {}}};
  for (const ThesisCase& setup : results.cases)
    for (const CaseRun& at : finishedRuns(results, setup, engine)) {
      const auto& row = at.run->run.regime;
      RegimeStates& own =
          row && row->regime ? all[static_cast<std::size_t>(*row->regime)] : all.back();
      const std::vector<RingState> states = statesOf(at);
      own.runs += states.empty() ? 0 : 1;
      own.rings.insert(own.rings.end(), states.begin(), states.end());
    }
  std::erase_if(all, [](const RegimeStates& each) { return each.rings.empty(); });
  return all;
}

Panel statesPanel(const std::vector<RegimeStates>& all, const char* xLabel, StateNumber x,
                  const char* yLabel, StateNumber y, bool logY) {
  Panel panel;
  panel.xLabel = xLabel;
  panel.yLabel = yLabel;
  panel.logX = true;
  panel.logY = logY;
  for (std::size_t g = 0; g < all.size(); ++g) {
    Curve curve{all[g].name, thesisStyle(g, g), Draw::points, {}, 1.0};
    curve.style.dashed = false;
    for (const RingState& of : all[g].rings) curve.points.push_back({of[x], of[y], {}});
    panel.curves.push_back(std::move(curve));
  }
  return panel;
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
  RegimeStates together;
  for (const RegimeStates& of : all) {
    clauses.push_back(fmt::format(
        "{} ({}): medians I = {}, k_n/(p h) = {}, σ_rφ/p = {}, share of fluctuations {}", of.name,
        counted(of.runs, "run"), of.median(inertial), of.median(stiffness), of.median(friction),
        of.median(moving)));
    together.rings.insert(together.rings.end(), of.rings.begin(), of.rings.end());
  }
  const std::size_t rings = together.rings.size();
  const auto rankCorrelation = [&](StateNumber x) {  // Spearman's
    const auto xs = together.numbers(x), ys = together.numbers(moving);
    std::vector<double> work(2 * rings);
    return gsl_stats_spearman(xs.data(), 1, ys.data(), 1, rings, work.data());
  };
  if (rings >= 3)
    clauses.push_back(fmt::format(
        "over {} rings the fluctuations' share has a rank correlation of {:.2f} with I and of "
        "{:.2f} with k_n/(p h)",
        rings, rankCorrelation(inertial), rankCorrelation(stiffness)));
  figure.caption = fmt::format(
      "{}. {} All rings of 0 < r̃ < {:g} of all cases' runs. A state that contacts carry is level "
      "in "
      "the last panel, one that impacts carry follows a line of one I, slope 2; above I = {:g} "
      "flow is called collisional.",
      figure.title,
      thesisAndFound("a flow that contacts carry, dynamic stresses two orders below static ones",
                     clauses),
      bandEnd, collisionalInertialNumber);
  constexpr const char* share = "fluctuations in the normal stress";
  Panel plane = statesPanel(all, "γ̇ (m / k_{n})^{1/2}", contactRate, "p h / k_{n}", softness, true);
  const auto rates = together.numbers(contactRate);
  const auto [low, high] = std::ranges::minmax(rates);
  for (const double number : {0.01, collisionalInertialNumber}) {
    // p h/k_n at one inertial number: (γ̇ √(m/k_n))² 4/(π I²).
    std::vector<Point> line;
    for (const double x : {low, high})
      line.push_back({x, x * x * 4.0 / std::numbers::pi / (number * number), {}});
    plane.curves.push_back(guideLine(fmt::format("I = {:g}", number), std::move(line)));
    plane.curves.back().style.dashed = number < 0.1;
  }
  figure.panels = {statesPanel(all, "inertial number I", inertial, "σ_{rφ} / p", friction, false),
                   statesPanel(all, "inertial number I", inertial, share, moving, true),
                   statesPanel(all, "k_{n} / (p h)", stiffness, share, moving, true),
                   std::move(plane)};
  figure.columns = 2;
  return figure;
}

}  // namespace crossgrain::reports
