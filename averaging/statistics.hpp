#pragma once

#include <optional>
#include <span>

namespace crossgrain::inline averaging {

/// The mean of a correlated time series and how well it is known.
struct MeanEstimate {
  double mean = 0.0;
  std::optional<double> standardError;  ///< absent with fewer than 4 samples
  double nEff = 0.0;                    ///< independent samples the series is worth: N/2τ, or 1
  double tau = 0.0;       ///< integrated autocorrelation time, ½ + Σ ρ(t) [samples]
  double dof = 0.0;       ///< degrees of freedom of the error itself, for Student's t
  bool resolved = false;  ///< the series spans at least 16 τ; otherwise nEff and dof are 1
};

/// Mean with an error that accounts for autocorrelation.
///
/// The variance of the mean is the spectral density at frequency 0 over N, and that is the mean
/// square of the K slowest cosine coefficients √(2/N) Σ_t x_t cos(πk(t + ½)/N), k = 1 … K: nearly
/// independent normal numbers, hence Student's t with dof = K (Müller 2007; Lazarus, Lewis, Stock &
/// Watson 2018, "equal-weighted cosine"). K = N/8τ, at least 1 and at most 8: few slow modes see
/// slow parts of the series that a window of a few τ misses, at the price of a somewhat wider bar
/// (t of 8 degrees of freedom is 2.31, of many 1.96). τ comes from Geyer's (1992) initial monotone
/// sequence. A drift over the whole series is thus one sample with the scatter of all as its error.
/// A series that never changes is one sample with error 0. averaging/README.md says how often these
/// bars cover.
/// @pre series is not empty
MeanEstimate estimateMean(std::span<const double> series);

/// t such that Student's t of that many degrees of freedom (not necessarily whole, at least 1) lies
/// in [−t, t] with this confidence.
double studentQuantile(double confidence, double dof);

/// Half width of the confidence interval of a mean; absent where its error is.
std::optional<double> halfWidth(const MeanEstimate& estimate, double confidence);

}  // namespace crossgrain::inline averaging
