#include "continuum/cosserat_shot.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "support/quiet_gsl.hpp"

namespace crossgrain::inline continuum {
namespace {

/// Of s, m and, in the second pass, u and ω, inward from ξ = 1.
class Integration {
 public:
  Integration(const CosseratEquations& equations, double outerShear, std::size_t fields,
              double tolerance)
      : equations_(equations),
        system_{&rightHandSide, nullptr, fields, this},
        // All that is integrated is of order 1 or compared with what is: an absolute tolerance
        // is only to keep u(1) = 0 from asking for steps of no length.
        driver_(gsl_odeiv2_driver_alloc_y_new(&system_, gsl_odeiv2_step_rk8pd, -1e-6,
                                              1e-3 * tolerance, tolerance),
                &gsl_odeiv2_driver_free),
        state{outerShear, equations.outerCouple(outerShear), 0.0, 1.0} {
    gsl_odeiv2_driver_set_nmax(driver_.get(), mostSteps);
    gsl_odeiv2_driver_set_hmin(driver_.get(), shortestStep);
  }
  Integration(const Integration&) = delete;
  Integration& operator=(const Integration&) = delete;

  /// Whether R stays positive until ξ.
  bool to(double xi) {
    if (xi >= xi_) return equations_.rootSquared({state[0], state[1]}) > 0.0;
    return gsl_odeiv2_driver_apply(driver_.get(), &xi_, xi, state.data()) == GSL_SUCCESS;
  }
  void startAfresh() { gsl_odeiv2_driver_reset(driver_.get()); }
  double xi() const { return xi_; }

 private:
  // Most solutions take some hundred; at the least δ of all, where R is small everywhere, more than
  // 5000 and fewer than 20 000 (the range of δ is the same with 100 000).
  static constexpr unsigned long mostSteps = 20000;
  static constexpr double shortestStep = 1e-12;  // where R falls to 0 there is no last step

  static int rightHandSide(double xi, const double y[], double dydxi[], void* self) {
    const auto& integration = *static_cast<const Integration*>(self);
    const CosseratEquations& equations = integration.equations_;
    const ShearState at{y[0], y[1]};
    const double square = equations.rootSquared(at);
    if (!(square > 0.0)) return GSL_EDOM;  // the step is halved, until it is none
    const double root = std::sqrt(square);
    const ShearState rates = equations.rates(xi, at, root);
    dydxi[0] = rates.s;
    dydxi[1] = rates.m;
    if (integration.system_.dimension == 2) return GSL_SUCCESS;
    const auto rule = equations.flowRule(xi, at, root);
    const double r = equations.radius(xi);
    const double excess = y[3] + y[2] / r;
    dydxi[2] = y[2] / r - rule.shear * excess + rule.pushU * y[3];
    dydxi[3] = -rule.turn * excess + rule.pushOmega * y[3];
    return GSL_SUCCESS;
  }

  const CosseratEquations& equations_;
  gsl_odeiv2_system system_;
  std::unique_ptr<gsl_odeiv2_driver, decltype(&gsl_odeiv2_driver_free)> driver_;
  double xi_ = 1.0;

 public:
  std::array<double, 4> state;
};

/// s(1) from sin ψ down. The interval of shots that reach the wheel spans more than two of them for
/// all parameters tried.
constexpr int mostTrials = 80;
double trialShear(const CosseratEquations& equations, int k) {
  constexpr double perDecade = 20.0;
  return equations.sineOfFriction() * std::pow(10.0, -k / perDecade);
}

}  // namespace

CosseratShot shootStresses(const CosseratEquations& equations, double outerShear,
                           double tolerance) {
  const QuietGsl quiet;
  Integration integration(equations, outerShear, 2, tolerance);
  CosseratShot shot;
  shot.reached = integration.to(0.0);
  (shot.reached ? shot.wheelShear : shot.lostAt) =
      shot.reached ? integration.state[0] : integration.xi();
  return shot;
}

std::optional<CosseratSolution::Values> shootFields(const CosseratEquations& equations,
                                                    double outerShear, const ChebyshevGrid& grid,
                                                    double tolerance) {
  const QuietGsl quiet;
  const std::size_t count = grid.count();
  CosseratSolution::Values values{std::vector<double>(count), std::vector<double>(count),
                                  std::vector<double>(count), std::vector<double>(count)};
  Integration integration(equations, outerShear, 4, tolerance);
  double logOmega = 0.0;
  for (std::size_t k = count; k-- > 0;) {
    if (!integration.to(grid.points()[k])) return std::nullopt;
    auto& [s, m, u, omega] = integration.state;
    if (!(omega > 0.0)) return std::nullopt;
    // u and ω grow inward beyond all numbers for small δ; being linear, they may be scaled.
    logOmega += std::log(omega);
    u /= omega;
    omega = 1.0;
    integration.startAfresh();
    values.s[k] = s;
    values.m[k] = m;
    values.ratio[k] = u;
    values.logOmega[k] = logOmega;
  }
  if (!(values.ratio.front() > 0.0)) return std::nullopt;
  const double wanted = std::log(equations.parameters().wheelVelocity / values.ratio.front());
  const double shift = wanted - values.logOmega.front();
  for (double& logarithm : values.logOmega) logarithm += shift;
  return values;
}

std::optional<ShotRange> coarseShotRange(const CosseratEquations& equations, double tolerance) {
  const auto trial = [&](int k) { return trialShear(equations, k); };
  const auto shoot = [&](double s) { return shootStresses(equations, s, tolerance); };
  int highest = 1;
  while (highest <= mostTrials && !shoot(trial(highest)).reached) ++highest;
  if (highest > mostTrials) return std::nullopt;
  int lowest = highest;
  while (lowest < mostTrials && shoot(trial(lowest + 1)).reached) ++lowest;
  return ShotRange{trial(lowest), trial(highest), shoot(trial(lowest)).wheelShear,
                   shoot(trial(highest)).wheelShear};
}

std::optional<ShotRange> wholeShotRange(const CosseratEquations& equations, double tolerance) {
  auto range = coarseShotRange(equations, tolerance);
  if (!range) return std::nullopt;
  // Between a shot that reaches the wheel and one that is lost, the last that does.
  const auto extend = [&](double& reaching, double& shear, double lost) {
    constexpr double closeEnough = 1e-9;
    while (std::abs(lost / reaching - 1.0) > closeEnough) {
      const double middle = std::sqrt(lost * reaching);
      const CosseratShot shot = shootStresses(equations, middle, tolerance);
      if (shot.reached) shear = shot.wheelShear;
      (shot.reached ? reaching : lost) = middle;
    }
  };
  const double apart = trialShear(equations, 1) / trialShear(equations, 2);
  extend(range->lowest, range->lowestWheelShear, range->lowest / apart);
  extend(range->highest, range->highestWheelShear,
         std::min(range->highest * apart, equations.sineOfFriction()));
  return range;
}

}  // namespace crossgrain::inline continuum
