#pragma once

#include <optional>
#include <span>

namespace crossgrain {

/// The mean of a correlated time series and how well it is known.
struct MeanEstimate {
  double mean = 0.0;
  std::optional<double> standardError;  ///< absent with fewer than 4 samples
  double nEff = 0.0;      ///< independent samples the series is worth, 1 … its length
  double tau = 0.0;       ///< integrated autocorrelation time, ½ + Σ ρ(t) [samples]
  double dof = 0.0;       ///< degrees of freedom of the error itself, for Student's t
  bool resolved = false;  ///< the series spans at least 10 τ; otherwise see below
};

/// Mean with an error that accounts for autocorrelation: variance·2τ/N, where τ is summed up to the
/// first window W ≥ 5τ (Madras & Sokal 1988), with Wolff's (2004) correction
/// 1 + (2W + 1)/N for the subtracted mean. The error's own scatter, variance 2(2W + 1)/N
/// (Madras & Sokal 1988, appendix C), gives dof = N/(2W + 1).
///
/// A series shorter than 10 τ cannot tell its own correlation: it counts as one sample, with nEff =
/// dof = 1 and the scatter of the whole series as its error. A series that never changes is one
/// sample with error 0.
/// @pre series is not empty
MeanEstimate estimateMean(std::span<const double> series);

/// t such that Student's t of that many degrees of freedom (not necessarily whole, at least 1) lies
/// in [−t, t] with this confidence.
double studentQuantile(double confidence, double dof);

/// Half width of the confidence interval of a mean; absent where its error is.
std::optional<double> halfWidth(const MeanEstimate& estimate, double confidence);

}  // namespace crossgrain
