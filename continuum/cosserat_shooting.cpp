#include <fmt/format.h>
#include <gsl/gsl_roots.h>

#include <cmath>
#include <functional>
#include <memory>

#include "continuum/cosserat_shot.hpp"
#include "support/quiet_gsl.hpp"

namespace crossgrain::inline continuum {
namespace {

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

CosseratOutcome solveByShooting(const CosseratParameters& parameters,
                                const CosseratNumerics& numerics, const CosseratSource& source) {
  const CosseratEquations equations(parameters, source);
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

std::optional<double> wallFrictionForSpin(const CosseratParameters& parameters, double spinRatio,
                                          const CosseratNumerics& numerics) {
  const CosseratEquations equations(parameters);
  const auto range = coarseShotRange(equations, numerics.tolerance);
  if (!range) return std::nullopt;
  const ChebyshevGrid wheelAndRing(2);
  const auto excess = [&](double s) {
    const auto fields = shootFields(equations, s, wheelAndRing, numerics.tolerance);
    return fields ? 1.0 / fields->ratio.front() - spinRatio : std::nan("");
  };
  // u and ω may take more steps than there are where the stresses alone just did not.
  double low = range->lowest;
  while (low < range->highest && std::isnan(excess(low))) low *= 1.1;
  const auto outerShear = rootBetween(low, range->highest, excess);
  if (!outerShear) return std::nullopt;
  return std::atan(shootStresses(equations, *outerShear, numerics.tolerance).wheelShear);
}

}  // namespace crossgrain::inline continuum
