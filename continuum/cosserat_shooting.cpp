#include <fmt/format.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <gsl/gsl_roots.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>

#include "continuum/cosserat.hpp"
#include "support/quiet_gsl.hpp"

namespace crossgrain::inline continuum {
namespace {

/// What comes of integrating the stresses inward from s(1) = q(1).
struct CosseratShot {
  bool reached = false;     ///< ξ = 0, on the yield surface all the way
  double wheelShear = 0.0;  ///< s(0), if reached
  double lostAt = 0.0;      ///< ξ where R fell to 0, if not
};

/// s(1) of shots that reach the wheel: one interval, with s(0) rising within it.
struct ShotRange {
  double lowest, highest;                      ///< s(1)
  double lowestWheelShear, highestWheelShear;  ///< s(0) there
};

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
    const auto rule = equations.flowRule(at, root);
    const double r = equations.radius(xi);
    const double excess = y[3] + y[2] / r;
    dydxi[2] = y[2] / r - rule.shear * excess;
    dydxi[3] = -rule.turn * excess;
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

/// All fields at the points of a grid, with u(0) as the parameters have it. Absent where
/// shootStresses() does not reach ξ = 0, and where ω changes sign.
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

/// The interval but for up to a tenth of a decade at both ends, which takes some ten shots.
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

/// The interval to its ends, within 1e-9 of s(1).
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

/// The root of a function between two points, by Brent's method. Absent if it has one sign at both.
std::optional<double> rootBetween(double low, double high, std::function<double(double)> function) {
  if (!(function(low) * function(high) <= 0.0)) return std::nullopt;
  const QuietGsl quiet;
  gsl_function wrapped{
      [](double x, void* f) { return (*static_cast<std::function<double(double)>*>(f))(x); },
      &function};
  const std::unique_ptr<gsl_root_fsolver, decltype(&gsl_root_fsolver_free)> solver(
      gsl_root_fsolver_alloc(gsl_root_fsolver_brent), &gsl_root_fsolver_free);
  if (gsl_root_fsolver_set(solver.get(), &wrapped, low, high) != GSL_SUCCESS) return std::nullopt;
  constexpr int mostIterations = 200;
  for (int k = 0; k < mostIterations; ++k) {
    if (gsl_root_fsolver_iterate(solver.get()) != GSL_SUCCESS) return std::nullopt;
    if (gsl_root_test_interval(gsl_root_fsolver_x_lower(solver.get()),
                               gsl_root_fsolver_x_upper(solver.get()), 0.0, 4e-16) == GSL_SUCCESS)
      return gsl_root_fsolver_root(solver.get());
  }
  return gsl_root_fsolver_root(solver.get());
}

CosseratOutcome failed(CosseratFailure failure, std::string reason) {
  return {std::nullopt, failure, std::move(reason)};
}

}  // namespace

CosseratOutcome solveCosserat(const CosseratParameters& parameters,
                              const CosseratNumerics& numerics) {
  const CosseratEquations equations(parameters);
  const double wanted = std::tan(parameters.wallFriction);
  if (wanted > equations.largestShear())
    return failed(CosseratFailure::beyondYield,
                  fmt::format("tan δ = {:.4g}, but yield allows at most {:.4g}", wanted,
                              equations.largestShear()));
  auto range = coarseShotRange(equations, numerics.tolerance);
  if (range && (wanted < range->lowestWheelShear || wanted > range->highestWheelShear))
    range = wholeShotRange(equations, numerics.tolerance);
  if (!range)
    return failed(CosseratFailure::noConvergence,
                  "no s(1) that was tried lets the stresses yield from the ring to the wheel");
  if (wanted < range->lowestWheelShear)
    return failed(
        CosseratFailure::tooLittleWallFriction,
        fmt::format("with δ below {:.4g}° the stresses cannot yield everywhere: R falls to 0",
                    degrees(std::atan(range->lowestWheelShear))));
  if (wanted > range->highestWheelShear)
    return failed(
        CosseratFailure::tooMuchWallFriction,
        fmt::format("with δ above {:.4g}° the stresses cannot yield at the wheel: R falls to 0",
                    degrees(std::atan(range->highestWheelShear))));
  const auto outerShear = rootBetween(range->lowest, range->highest, [&](double s) {
    return shootStresses(equations, s, numerics.tolerance).wheelShear - wanted;
  });
  ChebyshevGrid grid(numerics.degree);
  auto values =
      outerShear ? shootFields(equations, *outerShear, grid, numerics.tolerance) : std::nullopt;
  if (!values)
    return failed(CosseratFailure::noConvergence, "the search for s(1) did not come to an end");
  return {CosseratSolution(equations, std::move(grid), std::move(*values)), CosseratFailure::none,
          ""};
}

std::optional<WallFrictionRange> wallFrictionRange(const CosseratParameters& parameters,
                                                   const CosseratNumerics& numerics) {
  const auto range = wholeShotRange(CosseratEquations(parameters), numerics.tolerance);
  if (!range) return std::nullopt;
  return WallFrictionRange{std::atan(range->lowestWheelShear), std::atan(range->highestWheelShear)};
}

}  // namespace crossgrain::inline continuum
