#include "tests/continuum/collocation.hpp"

#include <gsl/gsl_linalg.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "support/quiet_gsl.hpp"

namespace crossgrain::test {
namespace {

/// ω′/ω and (u/ω)′ with v = u/ω.
double logarithmicRate(const CosseratEquations::FlowRule& rule, double v, double radius) {
  return -rule.turn * (1.0 + v / radius);
}
double ratioRate(const CosseratEquations::FlowRule& rule, double v, double radius) {
  return v / radius - rule.shear * (1.0 + v / radius) - v * logarithmicRate(rule, v, radius);
}

/// A dense system of linear equations, set up row by row.
class LinearSystem {
 public:
  explicit LinearSystem(std::size_t size)
      : matrix_(gsl_matrix_calloc(size, size), &gsl_matrix_free),
        right_(gsl_vector_calloc(size), &gsl_vector_free),
        permutation_(gsl_permutation_alloc(size), &gsl_permutation_free) {}

  double& operator()(std::size_t row, std::size_t column) {
    return *gsl_matrix_ptr(matrix_.get(), row, column);
  }
  double& right(std::size_t row) { return *gsl_vector_ptr(right_.get(), row); }

  /// The solution, in place of the right side. Not finite if the matrix is singular.
  std::vector<double> solve() {
    const QuietGsl quiet;
    int sign = 0;
    gsl_linalg_LU_decomp(matrix_.get(), permutation_.get(), &sign);
    if (gsl_linalg_LU_svx(matrix_.get(), permutation_.get(), right_.get()) != GSL_SUCCESS)
      return std::vector<double>(right_->size, std::nan(""));
    return {right_->data, right_->data + right_->size};
  }

 private:
  std::unique_ptr<gsl_matrix, decltype(&gsl_matrix_free)> matrix_;
  std::unique_ptr<gsl_vector, decltype(&gsl_vector_free)> right_;
  std::unique_ptr<gsl_permutation, decltype(&gsl_permutation_free)> permutation_;
};

double sizeOf(const std::vector<double>& values) {
  double size = 0.0;
  for (const double value : values) size = std::max(size, std::abs(value));
  return std::isfinite(size) ? size : HUGE_VAL;
}

constexpr int mostNewtonSteps = 60;

/// s and m: equations at all points but the one where a condition takes their place.
class StressCollocation {
 public:
  StressCollocation(const CosseratEquations& equations, const ChebyshevGrid& grid)
      : equations_(equations), grid_(grid), slopes_(grid), n_(grid.count()), s(n_), m(n_) {
    // Symmetric stress: q = s ∝ r⁻² from 9.23, with the m that 9.19 leaves.
    const double wheel = std::tan(equations.parameters().wallFriction);
    for (std::size_t k = 0; k < n_; ++k) {
      s[k] = wheel * std::pow(equations.radius(0.0) / equations.radius(grid.points()[k]), 2);
      // More shear than without couples goes with q < s: begins with none.
      const double couple = equations.outerCouple(s[k]);
      m[k] = std::isfinite(couple) ? couple : 0.0;
    }
  }

  /// Whether Newton's method came to an end.
  bool solve(double tolerance) {
    for (int k = 0; k < mostNewtonSteps; ++k) {
      const std::vector<double> step = newtonStep();
      double share = 1.0;
      // Never over the edge of the yield surface: R² keeps at least a tenth of what it was.
      while (!stays(step, share)) {
        share *= 0.5;
        if (share < 1e-6) return false;
      }
      for (std::size_t i = 0; i < n_; ++i) {
        s[i] += share * step[i];
        m[i] += share * step[n_ + i];
      }
      // Steps are quadratically small: this one's size is far above what is left.
      if (share == 1.0 && sizeOf(step) < std::sqrt(tolerance) * 1e-3) return true;
    }
    return false;
  }

 private:
  double square(std::size_t k, double ds = 0.0, double dm = 0.0) const {
    return equations_.rootSquared({s[k] + ds, m[k] + dm});
  }

  bool stays(const std::vector<double>& step, double share) const {
    for (std::size_t k = 0; k < n_; ++k)
      if (!(square(k, share * step[k], share * step[n_ + k]) > 0.1 * square(k))) return false;
    return true;
  }

  std::vector<double> newtonStep() const {
    const double A = equations_.parameters().asymmetry, c = equations_.momentFactor();
    LinearSystem system(2 * n_);
    const auto ds = slopes_.of(s), dm = slopes_.of(m);
    for (std::size_t k = 0; k < n_; ++k) {
      const double xi = grid_.points()[k], r = equations_.radius(xi);
      const double root = std::sqrt(square(k));
      const ShearState rates = equations_.rates(xi, {s[k], m[k]}, root);
      // ∂q/∂s and ∂q/∂m of 9.20.
      const double qs = -A + (A * A - 1.0) * s[k] / root;
      const double qm = -4.0 * (A + 1.0) * (A + 1.0) * m[k] / root;
      const auto row = slopes_.row(k);
      for (std::size_t j = 0; j < n_; ++j) {
        system(k, j) = row[j];
        system(n_ + k, n_ + j) = row[j];
      }
      system(k, k) += (1.0 + qs) / r;
      system(k, n_ + k) += qm / r;
      system(n_ + k, k) -= (1.0 - qs) / c;
      system(n_ + k, n_ + k) += qm / c + 1.0 / r;
      system.right(k) = rates.s - ds[k];
      system.right(n_ + k) = rates.m - dm[k];
    }
    // s(0) = tan δ, and s(1) = q(1) as sin²ψ = s² + 2(A+1) m².
    const std::size_t wheel = 0, outer = n_ - 1;
    const double sine = equations_.sineOfFriction();
    for (std::size_t j = 0; j < 2 * n_; ++j) system(wheel, j) = system(n_ + outer, j) = 0.0;
    system(wheel, wheel) = 1.0;
    system.right(wheel) = std::tan(equations_.parameters().wallFriction) - s[wheel];
    system(n_ + outer, outer) = 2.0 * s[outer];
    system(n_ + outer, n_ + outer) = 4.0 * (A + 1.0) * m[outer];
    system.right(n_ + outer) =
        sine * sine - s[outer] * s[outer] - 2.0 * (A + 1.0) * m[outer] * m[outer];
    return system.solve();
  }

  const CosseratEquations& equations_;
  const ChebyshevGrid& grid_;
  ChebyshevSlopes slopes_;
  std::size_t n_;

 public:
  std::vector<double> s, m;
};

/// v = u/ω with v(1) = 0, a Riccati equation, by Newton's method, then ln ω, an integral.
bool collocateFlow(const CosseratEquations& equations, const ChebyshevGrid& grid, double tolerance,
                   CosseratSolution::Values& values) {
  const std::size_t n = grid.count();
  const ChebyshevSlopes slopes(grid);
  std::vector<CosseratEquations::FlowRule> rules;
  for (std::size_t k = 0; k < n; ++k) {
    const ShearState at{values.s[k], values.m[k]};
    rules.push_back(equations.flowRule(at, std::sqrt(equations.rootSquared(at))));
  }
  values.ratio.assign(n, 0.0);
  bool settled = false;
  for (int iteration = 0; iteration < mostNewtonSteps && !settled; ++iteration) {
    LinearSystem system(n);
    const auto slope = slopes.of(values.ratio);
    for (std::size_t k = 0; k < n; ++k) {
      const double r = equations.radius(grid.points()[k]), v = values.ratio[k];
      const auto& rule = rules[k];
      const auto row = slopes.row(k);
      for (std::size_t j = 0; j < n; ++j) system(k, j) = k == n - 1 ? 0.0 : row[j];
      // ∂v′/∂v
      system(k, k) -= k == n - 1 ? -1.0 : (1.0 - rule.shear) / r + rule.turn * (1.0 + 2.0 * v / r);
      system.right(k) = k == n - 1 ? -v : ratioRate(rule, v, r) - slope[k];
    }
    const std::vector<double> step = system.solve();
    for (std::size_t k = 0; k < n; ++k) values.ratio[k] += step[k];
    settled = sizeOf(step) < std::sqrt(tolerance) * 1e-3;
  }
  if (!settled || !(values.ratio.front() > 0.0)) return false;

  LinearSystem integral(n);
  for (std::size_t k = 0; k < n; ++k) {
    const double r = equations.radius(grid.points()[k]);
    const auto row = slopes.row(k);
    for (std::size_t j = 0; j < n; ++j) integral(k, j) = k == 0 ? 0.0 : row[j];
    if (k > 0) integral.right(k) = logarithmicRate(rules[k], values.ratio[k], r);
  }
  integral(0, 0) = 1.0;
  integral.right(0) = std::log(equations.parameters().wheelVelocity / values.ratio.front());
  values.logOmega = integral.solve();
  return std::isfinite(sizeOf(values.logOmega));
}

}  // namespace

ChebyshevSlopes::ChebyshevSlopes(const ChebyshevGrid& grid)
    : count_(grid.count()), matrix_(count_ * count_) {
  const auto last = count_ - 1;
  const auto angle = [&](std::size_t k) {
    return 0.5 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(last);
  };
  const auto weight = [&](std::size_t k) {
    return (k % 2 == 0 ? 1.0 : -1.0) * (k == 0 || k == last ? 0.5 : 1.0);
  };
  for (std::size_t i = 0; i < count_; ++i)
    for (std::size_t j = 0; j < count_; ++j) {
      if (i == j) continue;
      // ξ_i − ξ_j without cancellation; rows sum up to 0, so that a constant has no slope.
      const double apart = std::sin(angle(i) + angle(j)) * std::sin(angle(i) - angle(j));
      matrix_[i * count_ + j] = weight(j) / weight(i) / apart;
      matrix_[i * count_ + i] -= matrix_[i * count_ + j];
    }
}

std::vector<double> ChebyshevSlopes::of(std::span<const double> values) const {
  std::vector<double> result(count_);
  // Differences: what the values have in common would only bring its rounding.
  for (std::size_t k = 0; k < count_; ++k)
    for (std::size_t j = 0; j < count_; ++j) result[k] += row(k)[j] * (values[j] - values[k]);
  return result;
}

std::optional<CosseratSolution> solveByCollocation(const CosseratParameters& parameters,
                                                   int degree) {
  const CosseratEquations equations(parameters);
  if (std::tan(parameters.wallFriction) > equations.largestShear()) return std::nullopt;
  constexpr double tolerance = 1e-12;  // of Newton's last step
  const ChebyshevGrid grid(degree);
  StressCollocation stresses(equations, grid);
  if (!stresses.solve(tolerance)) return std::nullopt;
  CosseratSolution::Values values;
  values.s = stresses.s;
  values.m = stresses.m;
  if (!collocateFlow(equations, grid, tolerance, values)) return std::nullopt;
  return CosseratSolution(equations, grid, values);
}

}  // namespace crossgrain::test
