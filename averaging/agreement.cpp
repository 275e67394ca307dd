#include "averaging/agreement.hpp"

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace crossgrain::inline averaging {

namespace {

constexpr int fewestPackings = 4;
constexpr double fewestDof = fewestPackings - 1;

/// t of the upper tail `level`.
double upperQuantile(double level, double dof) {
  return gsl_cdf_tdist_Qinv(level, dof);
}

std::vector<std::optional<double>> pairedDifferences(const PairedSample& sample) {
  if (sample.reference.size() != sample.other.size())
    throw std::invalid_argument(
        fmt::format("agreement: {} packings of the reference, {} of the other engine",
                    sample.reference.size(), sample.other.size()));
  std::vector<std::optional<double>> differences;
  for (std::size_t k = 0; k < sample.reference.size(); ++k)
    if (sample.reference[k] && sample.other[k])
      differences.emplace_back(*sample.other[k] - *sample.reference[k]);
  return differences;
}

bool anything(const PairedSample& sample) {
  const auto has = [](const std::optional<double>& x) { return x.has_value(); };
  return std::ranges::any_of(sample.reference, has) || std::ranges::any_of(sample.other, has);
}

/// Largest chance, over all |µ| ≤ margin, of a mean difference as far out as this one.
double pWithin(double difference, double standardError, double margin, double dof) {
  const double beyond = std::abs(difference) - margin;
  if (standardError == 0.0) return beyond > 0.0 ? 0.0 : 1.0;
  const double p = gsl_cdf_tdist_Q(beyond / standardError, dof) +
                   gsl_cdf_tdist_Q((std::abs(difference) + margin) / standardError, dof);
  return std::min(p, 1.0);
}

/// The smallest |difference| that pWithin() puts at the level or below. One tail of the two alone
/// bounds it from below, both tails alike from above.
double criticalDifference(double standardError, double margin, double level, double dof) {
  double low = margin + upperQuantile(level, dof) * standardError;
  double high = margin + upperQuantile(0.5 * level, dof) * standardError;
  for (int k = 0; k < 12; ++k) {
    const double middle = 0.5 * (low + high);
    (pWithin(middle, standardError, margin, dof) <= level ? high : low) = middle;
  }
  return high;
}

/// BinFraction of the differences' variance that stems from the runs' finite length.
std::optional<double> withinFractionOf(const PairedSample& sample, const EnsembleMean& mean) {
  double sum = 0.0;
  int count = 0;
  for (const auto& variance : sample.withinVariance)
    if (variance) {
      sum += *variance;
      ++count;
    }
  const double all = *mean.standardError * *mean.standardError * mean.packings;
  if (count == 0 || all == 0.0) return std::nullopt;
  return std::min(sum / count / all, 1.0);
}

void describePairs(const PairedSample& sample, PairedComparison& result) {
  const auto mean = ensembleMean(pairedDifferences(sample));
  if (!mean) return;
  result.packings = result.referencePackings = result.otherPackings = mean->packings;
  result.difference = mean->mean;
  result.standardError = mean->standardError;
  result.dof = mean->packings - 1;
  if (result.standardError) result.withinFraction = withinFractionOf(sample, *mean);
}

void describeSamples(const PairedSample& sample, PairedComparison& result) {
  const auto a = ensembleMean(sample.reference), b = ensembleMean(sample.other);
  result.referencePackings = a ? a->packings : 0;
  result.otherPackings = b ? b->packings : 0;
  result.packings = std::min(result.referencePackings, result.otherPackings);
  if (!a || !b) return;
  result.difference = b->mean - a->mean;
  const double n = a->packings, m = b->packings;
  const double aSquare = std::pow(a->standardError.value_or(0.0), 2);  // s²/n
  const double bSquare = std::pow(b->standardError.value_or(0.0), 2);
  if (result.packings >= fewestPackings) {
    result.basis = Basis::independent;
    const double sum = aSquare + bSquare;
    result.standardError = std::sqrt(sum);
    result.dof = sum > 0.0
                     ? sum * sum / (aSquare * aSquare / (n - 1.0) + bSquare * bSquare / (m - 1.0))
                     : n + m - 2.0;
  } else if (n + m > 2.0) {
    result.basis = Basis::oneScatter;
    result.dof = n + m - 2.0;
    const double scatter = ((n - 1.0) * n * aSquare + (m - 1.0) * m * bSquare) / result.dof;  // p²
    result.standardError = std::sqrt(scatter * (1.0 / n + 1.0 / m));
  } else {
    result.basis = Basis::oneRunEach;
    if (sample.withinVariance.empty() || !sample.withinVariance.front()) return;
    if (sample.withinDof < 1.0) return;
    result.dof = sample.withinDof;
    result.standardError = std::sqrt(*sample.withinVariance.front());
  }
}

PairedComparison describe(const PairedSample& sample, double alpha) {
  if (!(sample.margin >= 0.0))
    throw std::invalid_argument(
        fmt::format("agreement: the margin must be 0 or more, got {}", sample.margin));
  PairedComparison result;
  if (sample.independent)
    describeSamples(sample, result);
  else
    describePairs(sample, result);
  if (!result.standardError) return result;
  const double half = upperQuantile(alpha, result.dof) * *result.standardError;
  result.low = result.difference - half;
  result.high = result.difference + half;
  if (result.dof >= fewestDof)
    result.pDisagree =
        pWithin(result.difference, *result.standardError, sample.margin + sample.bias, result.dof);
  return result;
}

/// Turns the family's p-values into Holm's adjusted ones. What is no number is no test.
void adjustByHolm(std::vector<std::optional<PairedComparison>>& family) {
  std::vector<double*> tests;
  for (auto& comparison : family)
    if (comparison && comparison->pDisagree && std::isfinite(*comparison->pDisagree))
      tests.push_back(&*comparison->pDisagree);
  std::ranges::stable_sort(tests, {}, [](const double* p) { return *p; });
  double largest = 0.0;
  for (std::size_t k = 0; k < tests.size(); ++k) {
    largest = std::max(largest, std::min(1.0, static_cast<double>(tests.size() - k) * *tests[k]));
    *tests[k] = largest;
  }
}

}  // namespace

std::optional<EnsembleMean> ensembleMean(std::span<const std::optional<double>> packingMeans) {
  std::vector<double> present;
  for (const auto& mean : packingMeans)
    if (mean) present.push_back(*mean);
  if (present.empty()) return std::nullopt;
  const double n = static_cast<double>(present.size());
  EnsembleMean result;
  result.packings = static_cast<int>(present.size());
  result.mean = std::accumulate(present.begin(), present.end(), 0.0) / n;
  if (present.size() < 2) return result;
  double squares = 0.0;
  for (const double x : present) squares += (x - result.mean) * (x - result.mean);
  result.standardError = std::sqrt(squares / (n - 1.0) / n);
  return result;
}

std::vector<std::optional<PairedComparison>> comparePaired(std::span<const PairedSample> family,
                                                           double confidence) {
  const double alpha = 1.0 - confidence;
  std::vector<std::optional<PairedComparison>> result;
  for (const PairedSample& sample : family)
    result.push_back(anything(sample) ? std::optional(describe(sample, alpha)) : std::nullopt);
  adjustByHolm(result);
  for (std::size_t k = 0; k < family.size(); ++k) {
    if (!result[k]) continue;
    PairedComparison& c = *result[k];
    const double margin = family[k].margin - family[k].bias;
    if (c.pDisagree && *c.low >= -margin && *c.high <= margin)
      c.verdict = Verdict::pass;
    else if (c.pDisagree && *c.pDisagree <= alpha)
      c.verdict = Verdict::fail;
  }
  return result;
}

std::optional<double> smallestDetectable(double standardError, double dof, double margin,
                                         double level, double power) {
  if (dof < fewestDof) return std::nullopt;
  if (standardError == 0.0) return margin;
  // Equally likely values of the sample's standard error, and what is significant with each.
  constexpr int quantiles = 50;
  std::vector<double> critical;
  for (int k = 0; k < quantiles; ++k)
    critical.push_back(criticalDifference(
        standardError * std::sqrt(gsl_cdf_chisq_Pinv((k + 0.5) / quantiles, dof) / dof), margin,
        level, dof));
  const auto detected = [&](double truth) {
    double sum = 0.0;
    for (const double bound : critical)
      sum += gsl_cdf_ugaussian_P((truth - bound) / standardError) +
             gsl_cdf_ugaussian_P((-truth - bound) / standardError);
    return sum / quantiles;
  };
  double low = margin;
  double high = critical.back() + 5.0 * standardError;
  for (int k = 0; k < 30; ++k) {
    const double middle = 0.5 * (low + high);
    (detected(middle) >= power ? high : low) = middle;
  }
  return high;
}

std::optional<double> smallestSignificant(double standardError, double dof, std::size_t tests,
                                          double confidence) {
  if (dof < fewestDof || tests == 0) return std::nullopt;
  const double tail = (1.0 - confidence) / 2.0 / static_cast<double>(tests);
  return upperQuantile(tail, dof) * standardError;
}

std::vector<std::optional<double>> smallestSignificant(
    std::span<const std::optional<PairedComparison>> family, double confidence) {
  const auto isTest = [](const auto& one) { return one && one->pDisagree; };
  const auto isRejected = [&](const auto& one) {
    return isTest(one) && *one->pDisagree <= 1.0 - confidence;
  };
  const auto left = static_cast<std::size_t>(std::ranges::count_if(family, isTest) -
                                             std::ranges::count_if(family, isRejected));
  std::vector<std::optional<double>> smallest;
  for (const auto& one : family)
    smallest.push_back(isTest(one)
                           ? smallestSignificant(*one->standardError, one->dof,
                                                 left + (isRejected(one) ? 1 : 0), confidence)
                           : std::nullopt);
  return smallest;
}

FieldVerdict fieldVerdict(std::span<const std::optional<PairedComparison>> rings) {
  FieldVerdict result;
  for (const auto& ring : rings) {
    if (!ring) continue;
    ++result.compared;
    result.agreeing += ring->verdict == Verdict::pass;
    result.disagreeing += ring->verdict == Verdict::fail;
  }
  if (result.disagreeing > 0)
    result.verdict = Verdict::fail;
  else if (result.compared > 0 && result.agreeing == result.compared)
    result.verdict = Verdict::pass;
  return result;
}

}  // namespace crossgrain::inline averaging
