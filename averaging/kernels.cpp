#include "averaging/kernels.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace crossgrain::inline averaging {

namespace {

constexpr double gaussCut = 3.0;  // of a Gaussian, in w

/// erf(3/√2): what the cut leaves of it.
const double keptOfGauss = std::erf(gaussCut / std::numbers::sqrt2);

}  // namespace

KernelIn1d::KernelIn1d(Kernel kind, double width)
    : kind_(kind), width_(width), reach_(kind == Kernel::gauss ? gaussCut * width : width) {
  if (!std::isfinite(width) || !(width > 0.0))
    throw std::invalid_argument(
        fmt::format("weights: a coarse-graining function needs a width above 0, got {} m", width));
}

double KernelIn1d::density(double x) const {
  const double r = std::abs(x) / reach_;
  if (r >= 1.0) return 0.0;
  switch (kind_) {
    case Kernel::heaviside:
      return 0.5 / reach_;
    case Kernel::lucy:
      return 1.25 / reach_ * (1.0 + 3.0 * r) * (1.0 - r) * (1.0 - r) * (1.0 - r);
    case Kernel::gauss:
      break;
  }
  const double z = x / width_;
  return std::exp(-0.5 * z * z) / (std::sqrt(2.0 * std::numbers::pi) * width_ * keptOfGauss);
}

double KernelIn1d::below(double x) const {
  if (x <= -reach_) return 0.0;
  if (x >= reach_) return 1.0;
  const double r = x / reach_, s = std::abs(r);
  switch (kind_) {
    case Kernel::heaviside:
      return 0.5 + 0.5 * r;
    case Kernel::lucy:
      return 0.5 + 1.25 * r * (1.0 + s * s * (-2.0 + s * (2.0 - 0.6 * s)));
    case Kernel::gauss:
      break;
  }
  return 0.5 + 0.5 * std::erf(x / (std::numbers::sqrt2 * width_)) / keptOfGauss;
}

double KernelIn1d::integral(double x) const {
  if (x <= -reach_) return 0.0;
  if (x >= reach_) return x;
  const double r = x / reach_, s = r * r;
  switch (kind_) {
    case Kernel::heaviside:
      return 0.25 * reach_ * (1.0 + r) * (1.0 + r);
    case Kernel::lucy:
      return reach_ *
             (0.125 + 0.5 * r + 0.625 * s - s * s * (0.625 - 0.5 * std::abs(r) + 0.125 * s));
    case Kernel::gauss:
      break;
  }
  // ∫ erf(x/√2w) dx = x erf(x/√2w) + w √(2/π) exp(−x²/2w²)
  const auto odd = [&](double z) {
    return z * std::erf(z / std::numbers::sqrt2) +
           std::sqrt(2.0 / std::numbers::pi) * std::exp(-0.5 * z * z);
  };
  return 0.5 * (x + reach_) + 0.5 * width_ * (odd(x / width_) - odd(gaussCut)) / keptOfGauss;
}

double KernelIn1d::lineBelow(double x, double y1, double y2) const {
  // Across a short line below() is straight to 1e-9; the difference of Ψ would cancel.
  if (std::abs(y2 - y1) < 1e-5 * width_) return below(x - 0.5 * (y1 + y2));
  return (integral(x - y1) - integral(x - y2)) / (y2 - y1);
}

}  // namespace crossgrain::inline averaging
