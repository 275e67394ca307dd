#include "averaging/interim_analyses.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>

#include "averaging/pocock.hpp"

namespace crossgrain::inline averaging {

namespace {

constexpr int mostForecast = 10000;

/// Of independent samples all are looked at.
PairedSample firstOf(const PairedSample& sample, int packings) {
  if (sample.independent) return sample;
  const auto cut = [&](const std::vector<std::optional<double>>& values) {
    const auto end = std::min(values.size(), static_cast<std::size_t>(packings));
    return std::vector(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(end));
  };
  return {cut(sample.reference), cut(sample.other), sample.margin, sample.bias, {}};
}

/// A difference is shown, and that it is less than twice the margin; the margin lies in between.
bool isBorderline(const PairedComparison& found, const PairedSample& sample) {
  const bool positive = found.difference > 0.0;
  const double near = (positive ? *found.low : -*found.high) - sample.bias;
  const double far = (positive ? *found.high : -*found.low) + sample.bias;
  return near > 0.0 && near <= sample.margin && far >= sample.margin && far <= 2.0 * sample.margin;
}

/// @param looked  packings that could have a value, of both engines
void describe(InterimAnswer& answer, const PairedComparison& found, std::size_t look, int looked) {
  answer.look = look;
  answer.packings = found.packings;
  answer.referencePackings = found.referencePackings;
  answer.otherPackings = found.otherPackings;
  answer.basis = found.basis;
  answer.lost = looked - found.packings;
  answer.difference = found.difference;
  answer.standardError = found.standardError;
  answer.low = found.low;
  answer.high = found.high;
}

bool isFinal(Verdict verdict) {
  return verdict == Verdict::pass || verdict == Verdict::fail;
}

}  // namespace

InterimPlan interimPlanAt(int first, int count, double alpha) {
  InterimPlan plan;
  plan.agreeAlpha = pocockLevel(count, alpha);
  plan.alpha.assign(static_cast<std::size_t>(count), alpha);
  for (int k = 1; k <= count; ++k) plan.packings.push_back(k * first);
  double left = alpha;
  for (int k = count - 1; k > 0; --k) {
    left /= 2.0;
    plan.alpha[static_cast<std::size_t>(k)] = left;
    plan.alpha.front() = left;
  }
  return plan;
}

std::size_t interimsTaken(const InterimPlan& plan, int available) {
  return static_cast<std::size_t>(
      std::ranges::count_if(plan.packings, [&](int packings) { return packings <= available; }));
}

std::vector<std::optional<InterimAnswer>> answersAfterInterims(std::span<const PairedSample> family,
                                                               const InterimPlan& plan,
                                                               int available) {
  std::vector<std::optional<InterimAnswer>> answers(family.size());
  const std::size_t looks = interimsTaken(plan, available);
  for (std::size_t look = 0; look < looks; ++look) {
    std::vector<PairedSample> seen;
    for (const PairedSample& sample : family) seen.push_back(firstOf(sample, plan.packings[look]));
    const auto found = comparePaired(seen, 1.0 - plan.agreeAlpha);
    for (std::size_t k = 0; k < family.size(); ++k) {
      if (!found[k] || (answers[k] && isFinal(answers[k]->verdict))) continue;
      InterimAnswer& own = answers[k] ? *answers[k] : answers[k].emplace();
      const auto both = std::min(seen[k].reference.size(), seen[k].other.size());
      describe(own, *found[k], look,
               seen[k].independent ? static_cast<int>(both) : plan.packings[look]);
      own.verdict = Verdict::undecided;
      if (found[k]->verdict == Verdict::pass)
        own.verdict = Verdict::pass;
      else if (found[k]->pDisagree && *found[k]->pDisagree <= plan.alpha[look])
        own.verdict = Verdict::fail;
      else if (found[k]->pDisagree && isBorderline(*found[k], family[k]))
        own.verdict = Verdict::borderline;
    }
  }
  return answers;
}

double chanceOfOneAsFar(double difference, double scatter, int dof, std::size_t tests) {
  const double t = std::abs(difference) / scatter;
  return std::min(1.0, 2.0 * static_cast<double>(tests) * gsl_cdf_tdist_Q(t, dof));
}

double farthestByChance(double chance, int dof, std::size_t tests) {
  return gsl_cdf_tdist_Qinv(chance / 2.0 / static_cast<double>(tests), dof);
}

std::optional<int> packingsFor(double difference, double sd, double margin, double alpha,
                               double chance) {
  const double room = std::abs(margin - std::abs(difference));
  // The mean lies within t of the upper chance of its place as often as asked for; toward
  // agreement both sides of the margin count, which matters where the difference is near 0.
  const bool toAgree = std::abs(difference) < margin;
  const auto shown = [&](int n) {
    const double se = sd / std::sqrt(n);
    const double reach = gsl_cdf_tdist_Qinv(alpha, n - 1) * se;
    if (!toAgree) return gsl_cdf_ugaussian_P((room - reach) / se) >= chance;
    if (reach >= margin) return false;
    return gsl_cdf_ugaussian_P((margin - reach - difference) / se) -
               gsl_cdf_ugaussian_P((-margin + reach - difference) / se) >=
           chance;
  };
  constexpr int fewest = 4;
  if (shown(fewest)) return fewest;
  if (!shown(mostForecast)) return std::nullopt;
  int tooFew = fewest, enough = mostForecast;
  while (enough - tooFew > 1) {
    const int middle = tooFew + (enough - tooFew) / 2;
    (shown(middle) ? enough : tooFew) = middle;
  }
  return enough;
}

std::optional<PackingRange> packingsFor(double difference, double sd, int dof, double margin,
                                        double alpha) {
  if (dof < 1) return std::nullopt;
  const auto with = [&](double chi2) {
    return packingsFor(difference, sd * std::sqrt(dof / chi2), margin, alpha);
  };
  const auto low = with(gsl_cdf_chisq_Qinv(0.1, dof));
  if (!low) return std::nullopt;
  return PackingRange{*low, with(gsl_cdf_chisq_Pinv(0.1, dof))};
}

}  // namespace crossgrain::inline averaging
