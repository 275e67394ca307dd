#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

namespace crossgrain::inline averaging {

/// The straight line through a correlated time series, and how well its rise is known.
struct Trend {
  double mean = 0.0;
  double change = 0.0;                  ///< of the line, from the first sample's to the last one's
  std::optional<double> standardError;  ///< of change; absent with fewer than 12 samples
  double dof = 0.0;                     ///< degrees of freedom of that error, for Student's t
  /// Likewise, of 3 degrees of freedom, if bends of up to the third degree belong to the change and
  /// not to the scatter: of a fall to nothing, say, which is no line.
  std::optional<double> errorBesideBends;
  bool resolved = false;  ///< the series spans at least 16 of its correlation times about the line
};

/// Least-squares line with an error that accounts for autocorrelation.
///
/// On discrete Legendre (Gram) polynomials, orthonormal over the samples, the line's rise is the
/// first coefficient, and the coefficients 2 … K+1 of a stationary series are independent of it and
/// of each other and scatter as it does: by the spectral density at frequency 0. So their mean
/// square is the square of its error, with Student's t of K degrees of freedom (the trend test with
/// an orthonormal series estimate of the variance: Bunzel & Vogelsang 2005; Phillips 2005; Sun
/// 2011). K is the series' length over 16 of its correlation times about the line, 3 to 8. A bend
/// of the series counts as scatter and widens the bar.
/// @pre series is not empty
Trend estimateTrend(std::span<const double> series);

enum class Drift { drifts, notSeen, cannotTell };
constexpr auto namesOf(Drift) {
  return std::array<std::string_view, 3>{"drifts", "no drift seen", "cannot tell"};
}

/// "drifts", "no drift seen", "cannot tell"
constexpr std::string_view toString(Drift drift) {
  return namesOf(drift)[static_cast<std::size_t>(drift)];
}

/// The change over the whole series in units of its mean, with its interval.
struct RelativeDrift {
  Drift verdict = Drift::cannotTell;
  std::optional<double>
      change;  ///< < 0: falls; absent where the mean is not significantly different from 0
  std::optional<double> half;      ///< half width of the interval
  std::optional<double> excluded;  ///< |change| up to this is not excluded: |change| + half
};

/// Where the series is not resolved, a bend may be slow noise or the drift itself. Then the
/// interval is four times that beside bends, if that is the narrower one: it is left by few lines
/// through noise that is correlated over a fifth of the series, and by six in seven noisy falls to
/// a twentieth, which bend so much that no line's error shows them.
///
/// - drifts: the interval of the change leaves out 0.
/// - not seen: it holds 0, the series is resolved, and a change larger than `limit` is excluded.
/// - cannot tell: neither.
/// @param confidence  of the interval
RelativeDrift relativeDrift(std::span<const double> series, double confidence, double limit);

}  // namespace crossgrain::inline averaging
