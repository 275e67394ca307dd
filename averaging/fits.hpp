#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "averaging/profiles.hpp"

namespace crossgrain::inline averaging {

/// One ring of a profile as a fit sees it, in the fit's own units.
struct FitPoint {
  double x = 0.0;
  double y = 0.0;
  std::optional<double> standardError;  ///< of y
};

struct FitParameter {
  std::string name;
  double value = 0.0;
  std::optional<double> standardError;
  double period = 0.0;  ///< > 0: an angle, known up to multiples of this
};

/// A fit, or why there is none: no better than no signal, a parameter that the points leave open, a
/// curve beyond their reach, or one that misses them (averaging/fits.cpp has the bounds and why).
/// The points are weighted by 1/error² if every one of them has a positive error, else equally.
/// Parameter errors come from the covariance matrix; it is scaled by χ²/dof without weights, and
/// with weights where that exceeds 1 (the points scatter more than their errors say).
struct Fit {
  bool converged = false;
  std::string reason;  ///< empty if converged
  std::vector<FitParameter> parameters;
  double chi2 = 0.0;  ///< weighted sum of squares; without errors in units of ⟨y²⟩
  int dof = 0;        ///< points − parameters
  bool weighted = false;
};

/// σ_rφ = A x^p with x = r/R_i (claim: p = −2). Parameters A, p.
Fit fitPowerLaw(std::span<const FitPoint> points);

/// v_φ/(ΩR_i) = A exp(−x/B) with x = r̃, points of 0 < r̃ < 6 (Lätzel 2003, section 6.3.1).
/// Parameters A, B.
Fit fitVelocityDecay(std::span<const FitPoint> points);

/// ν = ν₀ − B exp(−C x) with x = r̃, points of 0.5 ≤ r̃ ≤ 8.5 (Lätzel 2003, Eq. 6.2).
/// Parameters nu0, B, C.
Fit fitDilation(std::span<const FitPoint> points);

/// S d/(ΩD) = A exp(−B x) cos(π x + φ) with x = r̃ and A > 0, all points (Lätzel 2003, section
/// 6.3.2). Parameters A, B, phi (−π … π). Rings of width d sample every half period at one phase
/// and cannot distinguish A from φ: take rings of about d/3.
Fit fitSpinOscillation(std::span<const FitPoint> points);

/// S d/(ΩD) = scale · S: S is the disks' mean spin, counter-clockwise positive like Ω, D = 2R_i the
/// diameter of the wheel (Lätzel 2003, section 6.3.2). 1 is a disk's surface speed S d/2 equal to
/// the wheel's ΩR_i, as in rolling; the first layer rolls backwards on the wheel: negative.
double spinScale(const Rings& rings, double omega);

/// The rings of a profile as points (r̃, scale · mean); rings without a mean are left out.
std::vector<FitPoint> pointsOverRTilde(const Rings& rings, const Profile& profile,
                                       double scale = 1.0);

/// The same over r/R_i.
std::vector<FitPoint> pointsOverRadius(const Rings& rings, const Profile& profile,
                                       double scale = 1.0);

/// Fits of the same law to each packing's profile: parameter means over those that converged, with
/// sd/√P as errors (absent for one packing).
struct EnsembleFit {
  std::vector<FitParameter> parameters;  ///< empty if none converged
  int converged = 0;
  int packings = 0;
};

EnsembleFit ensembleFit(std::span<const Fit> perPacking);

}  // namespace crossgrain::inline averaging
