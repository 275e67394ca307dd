#include "averaging/agreement.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace crossgrain {
namespace {

constexpr double confidence = 0.95;

/// One ring whose paired differences are those given.
PairedSample differing(const std::vector<double>& differences, double margin) {
  PairedSample sample;
  sample.margin = margin;
  for (std::size_t k = 0; k < differences.size(); ++k) {
    const double packing = 10.0 * static_cast<double>(k);  // packings differ far more than engines
    sample.reference.emplace_back(packing);
    sample.other.emplace_back(packing + differences[k]);
  }
  return sample;
}

PairedComparison compareOne(const PairedSample& sample) {
  return comparePaired(std::vector{sample}, confidence)[0].value();
}

/// A family of rings under the null or not: each packing has its own level, each engine its noise.
std::vector<PairedSample> randomFamily(std::mt19937_64& generator, int rings, int packings,
                                       double shift, double margin) {
  std::normal_distribution<double> normal;
  std::vector<PairedSample> family(static_cast<std::size_t>(rings));
  for (PairedSample& sample : family) {
    sample.margin = margin;
    for (int p = 0; p < packings; ++p) {
      const double level = 10.0 * normal(generator);
      sample.reference.emplace_back(level + normal(generator));
      sample.other.emplace_back(level + shift + normal(generator));
    }
  }
  return family;
}

/// BinFraction of families with at least one ring of that verdict.
double familyRate(Verdict verdict, double shift, double margin, int repeats) {
  std::mt19937_64 generator(14);
  int hits = 0;
  for (int k = 0; k < repeats; ++k) {
    const auto result = comparePaired(randomFamily(generator, 20, 4, shift, margin), confidence);
    bool any = false;
    for (const auto& ring : result) any = any || ring->verdict == verdict;
    hits += any;
  }
  return static_cast<double>(hits) / repeats;
}

PairedSample independent(std::vector<std::optional<double>> reference,
                         std::vector<std::optional<double>> other, double margin) {
  PairedSample sample{std::move(reference), std::move(other), margin, 0.0, {}};
  sample.independent = true;
  return sample;
}

TEST(IndependentSamples, WelchByHand) {
  // Means 2.5 and 6; s² = 5/3 of 4 values and 10 of 5: SE² = 5/12 + 2, and
  // dof = (29/12)²/((5/12)²/3 + 2²/4) = 5.5208.
  const auto found =
      compareOne(independent({1.0, 2.0, 3.0, 4.0}, {2.0, 4.0, 6.0, 8.0, 10.0}, 100.0));
  EXPECT_EQ(found.basis, Basis::independent);
  EXPECT_EQ(found.referencePackings, 4);
  EXPECT_EQ(found.otherPackings, 5);
  EXPECT_DOUBLE_EQ(found.difference, 3.5);
  EXPECT_NEAR(*found.standardError, std::sqrt(5.0 / 12.0 + 2.0), 1e-12);
  EXPECT_NEAR(found.dof, 5.5208, 1e-4);
  EXPECT_EQ(found.verdict, Verdict::pass);
}

TEST(IndependentSamples, OneRunIsTakenToScatterAsTheOthersDo) {
  // p² = 10 of five values of variance 10; SE² = 10 (1/5 + 1), 4 degrees of freedom.
  const auto found = compareOne(independent({2.0, 4.0, 6.0, 8.0, 10.0}, {7.0}, 30.0));
  EXPECT_EQ(found.basis, Basis::oneScatter);
  EXPECT_DOUBLE_EQ(found.difference, 1.0);
  EXPECT_NEAR(*found.standardError, std::sqrt(12.0), 1e-12);
  EXPECT_DOUBLE_EQ(found.dof, 4.0);
  EXPECT_EQ(found.verdict, Verdict::pass);
  // t of 4 degrees, 95 %: 2.1318.
  EXPECT_NEAR(*found.high, 1.0 + 2.1318 * std::sqrt(12.0), 1e-3);
}

TEST(IndependentSamples, ThreeAgainstOneSayNothing) {
  const auto found = compareOne(independent({2.0, 4.0, 6.0}, {4.0}, 1e9));
  EXPECT_EQ(found.verdict, Verdict::undecided);
  EXPECT_FALSE(found.pDisagree);
}

TEST(IndependentSamples, SingleRunsHaveTheirOwnErrors) {
  PairedSample sample = independent({2.0}, {3.0}, 5.0);
  EXPECT_FALSE(compareOne(sample).standardError);
  EXPECT_EQ(compareOne(sample).verdict, Verdict::undecided);
  sample.withinVariance = {0.04};
  sample.withinDof = 8.0;
  const auto found = compareOne(sample);
  EXPECT_EQ(found.basis, Basis::oneRunEach);
  EXPECT_DOUBLE_EQ(*found.standardError, 0.2);
  EXPECT_EQ(found.verdict, Verdict::pass);
  sample.margin = 0.1;
  EXPECT_EQ(compareOne(sample).verdict, Verdict::fail);
}

/// How often independent samples of these sizes, of scatters 1 and `scatter`, with a true
/// difference at the margin, get that verdict: each is at most the 5 % that it promises.
double rateAtTheMargin(Verdict verdict, std::size_t n, std::size_t m, double scatter) {
  std::mt19937_64 generator(39);
  std::normal_distribution<double> normal;
  constexpr int trials = 20000;
  int hits = 0;
  for (int k = 0; k < trials; ++k) {
    PairedSample sample = independent({}, {}, 1.0);
    for (std::size_t i = 0; i < n; ++i) sample.reference.emplace_back(normal(generator));
    for (std::size_t i = 0; i < m; ++i)
      sample.other.emplace_back(1.0 + scatter * normal(generator));
    hits += compareOne(sample).verdict == verdict;
  }
  return static_cast<double>(hits) / trials;
}

TEST(IndependentSamples, VerdictsAreAsSeldomWrongAsPromised) {
  for (const auto& [n, m, scatter] :
       {std::tuple(4u, 9u, 1.0), {8u, 32u, 3.0}, {5u, 5u, 0.2}, {8u, 1u, 1.0}, {6u, 3u, 1.0}}) {
    EXPECT_LT(rateAtTheMargin(Verdict::fail, n, m, scatter), 0.056) << n << ", " << m;
    EXPECT_LT(rateAtTheMargin(Verdict::pass, n, m, scatter), 0.056) << n << ", " << m;
  }
  // And they do come: with scatters of a tenth, 8 against 1, a difference of 0 is agreement.
  PairedSample sample = independent({}, {0.0}, 1.0);
  for (int i = 0; i < 8; ++i) sample.reference.emplace_back(0.1 * (i % 2));
  EXPECT_EQ(compareOne(sample).verdict, Verdict::pass);
}

TEST(EnsembleMean, MeanAndErrorByHand) {
  const std::vector<std::optional<double>> means = {1.0, 3.0, std::nullopt, 5.0};
  const EnsembleMean ensemble = ensembleMean(means).value();
  EXPECT_EQ(ensemble.packings, 3);
  EXPECT_DOUBLE_EQ(ensemble.mean, 3.0);
  EXPECT_DOUBLE_EQ(ensemble.standardError.value(), 2.0 / std::sqrt(3.0));  // sd = 2
  EXPECT_FALSE(ensembleMean(std::vector<std::optional<double>>{7.0})->standardError);
  EXPECT_FALSE(ensembleMean(std::vector<std::optional<double>>{std::nullopt}));
}

TEST(ComparePaired, IntervalByHand) {
  // Differences 1, 2, 3, 4: mean 2.5, sd √(5/3), t_3(0.95) = 2.353 (table).
  const PairedComparison c = compareOne(differing({1.0, 2.0, 3.0, 4.0}, 10.0));
  const double error = std::sqrt(5.0 / 3.0) / 2.0;
  EXPECT_DOUBLE_EQ(c.difference, 2.5);
  EXPECT_NEAR(c.standardError.value(), error, 1e-12);
  EXPECT_NEAR(c.high.value() - 2.5, 2.353 * error, 5e-4);
  EXPECT_NEAR(2.5 - c.low.value(), 2.353 * error, 5e-4);
  EXPECT_EQ(c.verdict, Verdict::pass);
}

TEST(ComparePaired, VerdictsOfOneRing) {
  const auto verdict = [](const std::vector<double>& differences, double margin) {
    return compareOne(differing(differences, margin)).verdict;
  };
  EXPECT_EQ(verdict({0.1, -0.1, 0.05, -0.05}, 1.0), Verdict::pass);
  EXPECT_EQ(verdict({5.1, 4.9, 5.05, 4.95}, 1.0), Verdict::fail);
  EXPECT_EQ(verdict({2.0, -2.0, 1.0, -1.0}, 1.0), Verdict::undecided);
  EXPECT_EQ(verdict({0.0, 0.0, 0.0, 0.0}, 0.0), Verdict::pass);  // an engine and itself
  // 1.2 ± 0.4 is on the wrong side of 1.0 but not significantly so.
  EXPECT_EQ(verdict({0.4, 0.8, 1.6, 2.0}, 1.0), Verdict::undecided);
  EXPECT_GT(*compareOne(differing({0.4, 0.8, 1.6, 2.0}, 1.0)).pDisagree, 0.05);
  // Fewer than four packings decide nothing.
  EXPECT_EQ(verdict({0.0, 0.0, 0.0}, 1.0), Verdict::undecided);
  EXPECT_EQ(verdict({9.0, 9.1, 9.2}, 1.0), Verdict::undecided);
  EXPECT_FALSE(compareOne(differing({9.0, 9.1, 9.2}, 1.0)).pDisagree);
}

TEST(ComparePaired, AbsentValues) {
  PairedSample sample = differing({0.0, 0.0, 0.0, 0.0, 0.0}, 1.0);
  sample.other[2] = std::nullopt;
  EXPECT_EQ(compareOne(sample).packings, 4);
  for (auto& value : sample.other) value = std::nullopt;
  EXPECT_EQ(compareOne(sample).verdict, Verdict::undecided);
  EXPECT_EQ(compareOne(sample).packings, 0);
  for (auto& value : sample.reference) value = std::nullopt;
  EXPECT_FALSE(comparePaired(std::vector{sample}, confidence)[0]);
  sample = differing({0.0, 0.0, 0.0, 0.0}, 1.0);
  sample.reference.pop_back();
  EXPECT_THROW(comparePaired(std::vector{sample}, confidence), std::invalid_argument);
}

TEST(ComparePaired, HolmByHand) {
  // Same differences but for one ring: m = 3 tests. The smallest p is tripled, the next doubled.
  const PairedSample far = differing({9.9, 10.1, 10.2, 9.8}, 1.0);
  const PairedSample near = differing({1.5, 3.5, 2.5, 4.5}, 1.0);
  const PairedSample same = differing({0.3, -0.3, 0.2, -0.2}, 1.0);
  const auto family = comparePaired(std::vector{same, near, far}, confidence);
  EXPECT_NEAR(*family[2]->pDisagree / *compareOne(far).pDisagree, 3.0, 1e-9);
  EXPECT_NEAR(*family[1]->pDisagree / *compareOne(near).pDisagree, 2.0, 1e-9);
  EXPECT_LE(*family[0]->pDisagree, 1.0);
  // near alone is significant (p < 0.05), in the family it is not.
  EXPECT_EQ(compareOne(near).verdict, Verdict::fail);
  EXPECT_EQ(family[1]->verdict, Verdict::undecided);
  EXPECT_EQ(family[2]->verdict, Verdict::fail);
}

TEST(ComparePaired, WhatIsNoNumberIsNoTestOfTheFamily) {
  const PairedSample far = differing({9.9, 10.1, 10.2, 9.8}, 1.0);
  const PairedSample none = differing({NAN, 10.1, 10.2, 9.8}, 1.0);
  const auto family = comparePaired(std::vector{none, far}, confidence);
  EXPECT_EQ(family[0]->verdict, Verdict::undecided);
  EXPECT_EQ(family[1]->verdict, Verdict::fail);
  EXPECT_EQ(*family[1]->pDisagree, *compareOne(far).pDisagree);  // as if it were alone
}

TEST(ComparePaired, FalseAlarmsAreHeldToAlpha) {
  // 20 rings × 4 packings of equal engines. Margin 0 is the hardest null: any disagree is false.
  // α = 5 %, binomial sd of 4000 families 0.34 %: three of them on top.
  const double rate = familyRate(Verdict::fail, 0.0, 0.0, 4000);
  RecordProperty("false_alarms", std::to_string(rate));
  EXPECT_LE(rate, 0.05 + 3.0 * 0.0034);
  EXPECT_GE(rate, 0.03);  // and the procedure is not idle
  // A true difference right at the margin must not raise it.
  EXPECT_LE(familyRate(Verdict::fail, 1.0, 1.0, 4000), 0.05 + 3.0 * 0.0034);
  EXPECT_LE(familyRate(Verdict::fail, 0.0, 0.5, 4000), 0.05);
}

TEST(ComparePaired, FalseAgreementIsHeldToAlphaPerRing) {
  // A true difference at the margin, where agreeing is wrong: at most 5 % of the rings.
  std::mt19937_64 generator(15);
  int agreeing = 0;
  constexpr int repeats = 1000;
  for (int k = 0; k < repeats; ++k)
    for (const auto& ring : comparePaired(randomFamily(generator, 20, 4, 3.0, 3.0), confidence))
      agreeing += ring->verdict == Verdict::pass;
  EXPECT_LE(agreeing / (20.0 * repeats), 0.05 + 3.0 * std::sqrt(0.05 * 0.95 / (20.0 * repeats)));
}

TEST(ComparePaired, LargeDifferencesAreFound) {
  EXPECT_GT(familyRate(Verdict::fail, 30.0, 1.0, 500), 0.99);
}

TEST(SmallestDetectable, IsTheNoncentralT) {
  // Two-sided t test at 5 %, 4 packings, power 90 %: noncentrality 5.0138 (root of
  // P(|t_3(λ)| > 3.1824) = 0.9). Scales with σ.
  EXPECT_NEAR(*smallestDetectable(1.0, 3, 0.0, 0.05), 5.0138, 0.03);
  EXPECT_NEAR(*smallestDetectable(2.0, 3, 0.0, 0.05), 2.0 * 5.0138, 0.06);
  // Many packings: a normal test, 1.960 + 1.282; with a margin that is wide, one-sided beyond it.
  EXPECT_NEAR(*smallestDetectable(1.0, 9999, 0.0, 0.05), 3.242, 0.01);
  EXPECT_NEAR(*smallestDetectable(1.0, 9999, 50.0, 0.05), 50.0 + 1.645 + 1.282, 0.01);
  EXPECT_EQ(*smallestDetectable(0.0, 3, 0.5, 0.05), 0.5);
  EXPECT_FALSE(smallestDetectable(1.0, 2, 0.0, 0.05));
}

TEST(SmallestDetectable, APlantedShiftIsFoundNineTimesOutOfTen) {
  // 20 rings × 6 packings, scatter of a paired difference √2: the shift is planted in one ring.
  const double detectable = *smallestDetectable(std::sqrt(2.0 / 6.0), 5, 1.0, 0.05 / 20.0);
  std::mt19937_64 generator(17);
  int found = 0;
  constexpr int repeats = 4000;
  for (int k = 0; k < repeats; ++k) {
    auto family = randomFamily(generator, 20, 6, 0.0, 1.0);
    for (auto& value : family[7].other) *value += detectable;
    found += comparePaired(family, confidence)[7]->verdict == Verdict::fail;
  }
  // Three binomial errors; Holm's later steps can only help.
  EXPECT_NEAR(static_cast<double>(found) / repeats, 0.9, 3.0 * std::sqrt(0.09 / repeats));
}

TEST(ComparePaired, SaysHowMuchOfTheScatterIsTheRunsOwn) {
  PairedSample sample = differing({1.0, -1.0, 1.0, -1.0}, 1.0);  // sd² = 4/3
  EXPECT_FALSE(compareOne(sample).withinFraction);               // the runs' own errors are unknown
  sample.withinVariance.assign(4, 1.2);
  EXPECT_NEAR(compareOne(sample).withinFraction.value(), 0.9, 1e-12);
}

TEST(SmallestSignificant, IsTheQuantileOfTheWholeFamily) {
  // Student's t with 3 degrees of freedom, two-sided: 5 % at 3.182, 0.5 % at 7.453 (tables).
  EXPECT_NEAR(*smallestSignificant(2.0, 3, 1, 0.95), 2.0 * 3.182, 2e-3);
  EXPECT_NEAR(*smallestSignificant(2.0, 3, 10, 0.95), 2.0 * 7.453, 2e-3);
  EXPECT_FALSE(smallestSignificant(2.0, 2, 10, 0.95));
}

/// p of 0.001, 0.03 and 0.04 for t of 3 degrees of freedom: 0.03 is above 0.05/2, so only the first
/// is rejected, at 0.05/3, and both others fail at 0.05/2.
TEST(SmallestSignificant, OfAFamily_StopsWhereHolmDoes) {
  std::vector<PairedSample> family;
  for (const double t : {12.924, 3.896, 3.482}) {  // tables; sd of ±1: 2/√3, SE = 1/√3
    const double mean = t / std::sqrt(3.0);
    family.push_back(differing({mean + 1.0, mean - 1.0, mean + 1.0, mean - 1.0}, 0.0));
  }
  family.emplace_back();  // no test
  const auto found = comparePaired(family, 0.95);
  const auto smallest = smallestSignificant(found, 0.95);
  EXPECT_NEAR(*smallest[0] * std::sqrt(3.0), 4.857, 1e-2);  // two-sided 0.05/3
  EXPECT_NEAR(*smallest[1] * std::sqrt(3.0), 4.177, 1e-2);  // two-sided 0.05/2
  EXPECT_DOUBLE_EQ(*smallest[2], *smallest[1]);
  EXPECT_FALSE(smallest[3]);
}

/// An interval leaves out 0 exactly where Holm's procedure rejects it, so that any of a family of
/// 20 does so by accident in at most 1 − confidence of all families.
TEST(SmallestSignificant, OfAFamily_NamesNoneByAccident) {
  std::mt19937_64 generator(61);
  constexpr int repeats = 2000;
  for (const double shift : {0.0, 8.0}) {
    int families = 0;
    for (int k = 0; k < repeats; ++k) {
      auto family = randomFamily(generator, 20, 4, 0.0, 0.0);
      const auto shifted = randomFamily(generator, 5, 4, shift, 0.0);
      family.insert(family.end(), shifted.begin(), shifted.end());
      const auto found = comparePaired(family, 0.95);
      const auto smallest = smallestSignificant(found, 0.95);
      bool any = false;
      for (std::size_t r = 0; r < family.size(); ++r) {
        const bool named = std::abs(found[r]->difference) > *smallest[r];
        EXPECT_EQ(named, *found[r]->pDisagree <= 0.05);
        any = any || (named && r < 20);
      }
      families += any;
    }
    EXPECT_LT(static_cast<double>(families) / repeats,
              0.05 + 3.0 * std::sqrt(0.05 * 0.95 / repeats));
  }
}

TEST(FieldVerdict, FollowsItsRings) {
  const auto ring = [](Verdict verdict) {
    PairedComparison c;
    c.verdict = verdict;
    return std::optional(c);
  };
  const auto agree = ring(Verdict::pass), disagree = ring(Verdict::fail);
  const auto undecided = ring(Verdict::undecided);
  using Rings = std::vector<std::optional<PairedComparison>>;
  EXPECT_EQ(fieldVerdict(Rings{agree, std::nullopt, agree}).verdict, Verdict::pass);
  EXPECT_EQ(fieldVerdict(Rings{agree, disagree, undecided}).verdict, Verdict::fail);
  EXPECT_EQ(fieldVerdict(Rings{agree, undecided}).verdict, Verdict::undecided);
  EXPECT_EQ(fieldVerdict(Rings{std::nullopt}).verdict, Verdict::undecided);
  EXPECT_EQ(fieldVerdict(Rings{std::nullopt}).compared, 0);
}

}  // namespace
}  // namespace crossgrain
