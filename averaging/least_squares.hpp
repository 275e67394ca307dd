#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace crossgrain::inline averaging {

struct FitPoint;

/// Points with the weights that a fit gives them: 1/error² if all have a positive error, else all
/// 1/⟨y²⟩, so that the solver's tolerances do not depend on units.
struct WeightedPoints {
  std::vector<double> x, y, weight;
  bool weighted = false;
};

WeightedPoints weightedPoints(std::span<const FitPoint> points);

struct LinearSolution {
  std::vector<double> coefficients;
  double chi2 = 0.0;
};

/// Weighted least squares of y = Σ_k c_k g_k(x). Absent if the normal equations are singular.
std::optional<LinearSolution> solveLinear(const WeightedPoints& points,
                                          const std::function<std::vector<double>(double)>& basis,
                                          std::size_t unknowns);

struct NonlinearSolution {
  std::vector<double> parameters;
  std::vector<double> standardErrors;       ///< from the covariance with the weights as given
  std::vector<double> correlationWithLast;  ///< of each parameter's error with the last one's
  double chi2 = 0.0;
  std::string reason;  ///< why it failed; empty if it did not
};

/// Weighted nonlinear least squares from a start (Levenberg–Marquardt of gsl_multifit_nlinear).
/// @pre more points than parameters
NonlinearSolution solveNonlinear(
    const WeightedPoints& points,
    const std::function<double(const std::vector<double>& parameters, double x)>& value,
    const std::vector<double>& start);

}  // namespace crossgrain::inline averaging
