#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "support/verdict.hpp"

namespace crossgrain::inline averaging {

/// The packing is a random effect: one number per packing, and what they say together.
struct EnsembleMean {
  double mean = 0.0;
  std::optional<double> standardError;  ///< sd/√P; absent for one packing
  int packings = 0;                     ///< P, those that have the number
};

/// Absent where no packing has the number.
std::optional<EnsembleMean> ensembleMean(std::span<const std::optional<double>> packingMeans);

using support::Verdict;

/// Where the error of a difference of means comes from.
enum class Basis {
  paired,       ///< the differences of packings
  independent,  ///< each engine's own scatter over its packings (Welch)
  oneScatter,   ///< one of the two has too few packings: both are taken to scatter alike
  oneRunEach    ///< a single run of each: what their own series say of their errors
};

/// One ring of one field as two engines found it, on the same packings or each on its own.
struct PairedSample {
  std::vector<std::optional<double>> reference;  ///< per packing
  std::vector<std::optional<double>> other;      ///< per packing, in the same order
  double margin = 0.0;  ///< largest |other − reference| that still counts as agreement, ≥ 0
  /// By how much the true difference may be another than that of these numbers, 0 … margin: it
  /// narrows the margin of agreement and widens that of disagreement.
  double bias = 0.0;
  /// Per packing the variance of other − reference that the two runs' finite length brings, the
  /// sum of their squared within-run errors; empty if not known.
  std::vector<std::optional<double>> withinVariance;
  /// Packings of the two are not the same ones, nor need they be as many.
  bool independent = false;
  double withinDof = 0.0;  ///< degrees of freedom of the first withinVariance; 0: not known
};

/// Verdict on the differences other − reference of one ring.
struct PairedComparison {
  int packings = 0;                              ///< P, those that both engines have
  int referencePackings = 0, otherPackings = 0;  ///< with a value; both P where they are paired
  Basis basis = Basis::paired;
  double difference = 0.0;  ///< of the means over packings
  std::optional<double>
      standardError;                ///< of difference, sd/√P; absent for P < 2, like low and high
  double dof = 0.0;                 ///< of Student's t for it; P − 1 where they are paired
  std::optional<double> low, high;  ///< (1 − 2α) confidence interval of the difference
  std::optional<double> pDisagree;  ///< that |µ| ≤ margin, Holm-adjusted; absent for dof < 3
  Verdict verdict = Verdict::undecided;
  std::optional<double>
      withinFraction;  ///< of the differences' variance, due to finite runs, 0 … 1
};

/// Verdicts on a family of tests (rings and fields of one comparison), α = 1 − confidence:
/// - agree: two one-sided t tests at α, i.e. the (1 − 2α) interval lies within ±margin
///   (Schuirmann 1987). A field needs all of its rings, so this needs no correction.
/// - disagree: |µ| ≤ margin is rejected by a t test under Holm's (1979) step-down procedure, so
/// that
///   the chance of any false disagree in the family is at most α.
/// - undecided: neither, and always with fewer than 3 degrees of freedom: 4 packings.
///
/// Independent samples of n and m packings with variances s² and u² have SE² = s²/n + u²/m, with
/// (s²/n + u²/m)²/((s²/n)²/(n − 1) + (u²/m)²/(m − 1)) degrees of freedom (Welch 1947). Where one of
/// them has fewer than 4 packings its scatter is hardly known: both are taken to have the same,
/// SE² = p² (1/n + 1/m), p² = ((n − 1) s² + (m − 1) u²)/(n + m − 2). A single run of each has
/// withinVariance, which does not know how packings differ.
/// A ring where neither engine has anything is absent; where only one has, it is undecided with
/// P = 0.
/// @throws std::invalid_argument for unequal numbers of paired packings or a negative margin
std::vector<std::optional<PairedComparison>> comparePaired(std::span<const PairedSample> family,
                                                           double confidence);

/// The smallest true mean difference that a t test of |µ| ≤ margin at `level` rejects with this
/// power: over the scatter of the sample's own standard deviation (χ² of dof) and mean, which for
/// margin 0 is the noncentral t distribution. Absent for fewer than 3 degrees of freedom.
/// @param standardError  σ/√P of the mean difference, taken for the true one
std::optional<double> smallestDetectable(double standardError, double dof, double margin,
                                         double level, double power = 0.9);

/// The smallest mean paired difference that would be significant in a family of that many two-sided
/// tests whose false alarms are limited to 1 − confidence: Holm's step with so many tests left.
/// Absent for fewer than 3 degrees of freedom. @param standardError  of the mean difference
std::optional<double> smallestSignificant(double standardError, double dof, std::size_t tests,
                                          double confidence);

/// Of each of a family of differences without a margin the smallest one that would have been
/// significant: the half of an interval that leaves out 0 exactly where Holm's procedure rejects
/// that there is none. He holds the largest t against the level α/m of m tests, the next against
/// α/(m − 1), and stops at the first that fails, the K + 1st: all that he rejects pass α/(m − K +
/// 1), all others fail α/(m − K).
/// @param family  of comparePaired() at that confidence
/// @returns absent where there was no test
std::vector<std::optional<double>> smallestSignificant(
    std::span<const std::optional<PairedComparison>> family, double confidence);

/// The verdict on a field from its rings.
struct FieldVerdict {
  Verdict verdict = Verdict::undecided;
  int compared = 0, agreeing = 0, disagreeing = 0;  ///< rings
};

/// Agree iff every compared ring agrees, disagree if any ring disagrees, else undecided.
FieldVerdict fieldVerdict(std::span<const std::optional<PairedComparison>> rings);

}  // namespace crossgrain::inline averaging
