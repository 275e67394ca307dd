#include "averaging/least_squares.hpp"

#include <fmt/format.h>
#include <gsl/gsl_multifit_nlinear.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <memory>

#include "averaging/fits.hpp"
#include "support/quiet_gsl.hpp"

namespace crossgrain::inline averaging {

namespace {

/// Of parameters and gradient: far below any parameter's error, above the rounding of numerical
/// derivatives.
constexpr double tolerance = 1e-8;

struct Problem {
  const WeightedPoints& points;
  const std::function<double(const std::vector<double>&, double)>& value;
};

int residuals(const gsl_vector* at, void* data, gsl_vector* f) {
  const Problem& problem = *static_cast<const Problem*>(data);
  const std::vector<double> parameters(at->data, at->data + at->size);
  for (std::size_t k = 0; k < problem.points.x.size(); ++k) {
    const double r = problem.value(parameters, problem.points.x[k]) - problem.points.y[k];
    if (!std::isfinite(r)) return GSL_EBADFUNC;
    gsl_vector_set(f, k, r);
  }
  return GSL_SUCCESS;
}

}  // namespace

WeightedPoints weightedPoints(std::span<const FitPoint> points) {
  WeightedPoints result;
  result.weighted = std::ranges::all_of(points, [](const FitPoint& point) {
    return point.standardError && *point.standardError > 0.0;
  });
  double squares = 0.0;
  for (const FitPoint& point : points) squares += point.y * point.y;
  const double equal = squares > 0.0 ? static_cast<double>(points.size()) / squares : 1.0;
  for (const FitPoint& point : points) {
    result.x.push_back(point.x);
    result.y.push_back(point.y);
    result.weight.push_back(result.weighted ? 1.0 / (*point.standardError * *point.standardError)
                                            : equal);
  }
  return result;
}

std::optional<LinearSolution> solveLinear(const WeightedPoints& points,
                                          const std::function<std::vector<double>(double)>& basis,
                                          std::size_t unknowns) {
  const auto rows = static_cast<Eigen::Index>(points.x.size());
  Eigen::MatrixXd design(rows, static_cast<Eigen::Index>(unknowns));
  Eigen::VectorXd target(rows);
  for (Eigen::Index k = 0; k < rows; ++k) {
    const auto point = static_cast<std::size_t>(k);
    const double root = std::sqrt(points.weight[point]);
    const std::vector<double> g = basis(points.x[point]);
    for (std::size_t c = 0; c < unknowns; ++c)
      design(k, static_cast<Eigen::Index>(c)) = root * g[c];
    target(k) = root * points.y[point];
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(design);
  if (!design.allFinite() || qr.rank() < static_cast<Eigen::Index>(unknowns)) return std::nullopt;
  const Eigen::VectorXd c = qr.solve(target);
  LinearSolution solution;
  solution.coefficients.assign(c.data(), c.data() + c.size());
  solution.chi2 = (design * c - target).squaredNorm();
  return solution;
}

NonlinearSolution solveNonlinear(
    const WeightedPoints& points,
    const std::function<double(const std::vector<double>& parameters, double x)>& value,
    const std::vector<double>& start) {
  const QuietGsl quiet;
  const std::size_t n = points.x.size();
  const std::size_t unknowns = start.size();
  Problem problem{points, value};
  gsl_multifit_nlinear_fdf system{};
  system.f = residuals;
  system.n = n;
  system.p = unknowns;
  system.params = &problem;
  gsl_multifit_nlinear_parameters settings = gsl_multifit_nlinear_default_parameters();
  settings.fdtype = GSL_MULTIFIT_NLINEAR_CTRDIFF;

  const std::unique_ptr<gsl_multifit_nlinear_workspace, decltype(&gsl_multifit_nlinear_free)> work(
      gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &settings, n, unknowns),
      gsl_multifit_nlinear_free);
  const std::unique_ptr<gsl_matrix, decltype(&gsl_matrix_free)> covariance(
      gsl_matrix_alloc(unknowns, unknowns), gsl_matrix_free);
  const auto begin = gsl_vector_const_view_array(start.data(), unknowns);
  const auto weight = gsl_vector_const_view_array(points.weight.data(), n);

  NonlinearSolution solution;
  int status = gsl_multifit_nlinear_winit(&begin.vector, &weight.vector, &system, work.get());
  int info = 0;
  if (status == GSL_SUCCESS)
    status = gsl_multifit_nlinear_driver(200, tolerance, tolerance, 0.0, nullptr, nullptr, &info,
                                         work.get());
  // GSL's way to say that no step lowers the sum from the start: a minimum, to rounding.
  const bool startIsBest = status == GSL_EMAXITER && info == GSL_ENOPROG;
  if (status != GSL_SUCCESS && !startIsBest) {
    solution.reason = fmt::format("the iteration failed: {}", gsl_strerror(status));
    return solution;
  }
  if (gsl_multifit_nlinear_covar(gsl_multifit_nlinear_jac(work.get()), 0.0, covariance.get()) !=
      GSL_SUCCESS) {
    solution.reason = "the covariance matrix is singular";
    return solution;
  }
  const gsl_vector* best = gsl_multifit_nlinear_position(work.get());
  const gsl_vector* misfit = gsl_multifit_nlinear_residual(work.get());
  for (std::size_t k = 0; k < n; ++k)
    solution.chi2 += gsl_vector_get(misfit, k) * gsl_vector_get(misfit, k);
  for (std::size_t k = 0; k < unknowns; ++k) {
    solution.parameters.push_back(gsl_vector_get(best, k));
    solution.standardErrors.push_back(std::sqrt(gsl_matrix_get(covariance.get(), k, k)));
  }
  const std::size_t last = unknowns - 1;
  for (std::size_t k = 0; k < unknowns; ++k)
    solution.correlationWithLast.push_back(
        gsl_matrix_get(covariance.get(), k, last) /
        (solution.standardErrors[k] * solution.standardErrors[last]));
  return solution;
}

}  // namespace crossgrain::inline averaging
