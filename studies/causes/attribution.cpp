#include "studies/causes/attribution.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace crossgrain::inline studies {

namespace {

/// Of the largest difference of the laws: what is less is no interaction that a reader asks for.
constexpr double leastInteraction = 0.05;
/// Of a number's unit: what is less is rounding.
constexpr double roundingOfNumbers = 1e-12;
constexpr std::size_t mostPairs = 3;

struct CannotRun {};

/// Σ weights times numbers; absent where one of them is.
class Sum {
 public:
  explicit Sum(std::size_t size) : sum_(size, 0.0) {}
  void add(double weight, const Numbers& numbers) {
    for (std::size_t k = 0; k < sum_.size(); ++k)
      if (sum_[k] && numbers[k])
        *sum_[k] += weight * *numbers[k];
      else
        sum_[k].reset();
  }
  const Numbers& numbers() const { return sum_; }

 private:
  Numbers sum_;
};

double factorial(std::size_t n) {
  return std::tgamma(static_cast<double>(n) + 1.0);
}

class Attributing {
 public:
  Attributing(const AttributionPlan& plan, const RunMixture& run)
      : plan_(plan), run_(run), all_((Mixture{1} << plan.differences) - 1) {}

  Attribution result() {
    const std::size_t k = plan_.differences;
    found_.parts.assign(k, Numbers(at(0).size(), 0.0));
    std::vector<std::size_t> active(k);
    for (std::size_t i = 0; i < k; ++i) active[i] = i;
    if (k > plan_.mostMixed) std::erase_if(active, [&](std::size_t i) { return isInert(i); });
    Mixture taken = 0;
    for (const std::size_t i : active) taken |= bit(i);
    if (active.size() <= plan_.mostMixed && (taken == all_ || same(at(taken), at(all_))))
      shapley(active);
    else
      bothEnds();
    Sum rest(at(0).size());
    rest.add(1.0, at(all_));
    rest.add(-1.0, at(0));
    for (const Numbers& part : found_.parts) rest.add(-1.0, part);
    found_.interaction = rest.numbers();
    if (found_.mixtures == Mixtures::all)
      for (auto& value : found_.interaction)
        if (value) value = 0.0;
    std::ranges::sort(found_.pairs, std::greater(), &Attribution::Pair::share);
    found_.runs = static_cast<int>(known_.size());
    return std::move(found_);
  }

 private:
  static Mixture bit(std::size_t i) { return Mixture{1} << i; }

  const Numbers& at(Mixture mixture) {
    const auto known = known_.find(mixture);
    if (known != known_.end()) return known->second;
    auto numbers = run_(mixture);
    if (!numbers) throw CannotRun();
    return known_.emplace(mixture, std::move(*numbers)).first->second;
  }

  double unit(std::size_t k) const { return plan_.units.empty() ? 1.0 : plan_.units[k]; }

  /// Largest difference, in units.
  double apart(const Numbers& one, const Numbers& other) const {
    double most = 0.0;
    for (std::size_t k = 0; k < one.size(); ++k)
      if (one[k] && other[k])
        most = std::max(most, std::abs(*one[k] - *other[k]) / unit(k));
      else if (one[k].has_value() != other[k].has_value())
        return HUGE_VAL;
    return most;
  }
  bool same(const Numbers& one, const Numbers& other) const {
    return apart(one, other) <= roundingOfNumbers;
  }
  double largest(const Numbers& numbers) const {
    double most = 0.0;
    for (std::size_t k = 0; k < numbers.size(); ++k)
      if (numbers[k]) most = std::max(most, std::abs(*numbers[k]) / unit(k));
    return most;
  }
  double distance(const Numbers& one, const Numbers& other) const {
    double squares = 0.0;
    for (std::size_t k = 0; k < one.size(); ++k)
      if (one[k] && other[k]) squares += std::pow((*one[k] - *other[k]) / unit(k), 2);
    return std::sqrt(squares);
  }

  bool isInert(std::size_t i) {
    return same(at(bit(i)), at(0)) && same(at(all_), at(all_ & ~bit(i)));
  }

  /// Mixtures of the active, by the bits of a number of as many bits.
  static Mixture spread(std::size_t subset, const std::vector<std::size_t>& active) {
    Mixture mixture = 0;
    for (std::size_t n = 0; n < active.size(); ++n)
      if (subset >> n & 1) mixture |= bit(active[n]);
    return mixture;
  }

  void shapley(const std::vector<std::size_t>& active) {
    const std::size_t k = active.size(), subsets = std::size_t{1} << k, size = at(0).size();
    for (std::size_t n = 0; n < k; ++n) {
      Sum part(size);
      for (std::size_t s = 0; s < subsets; ++s) {
        if (s >> n & 1) continue;
        const auto others = static_cast<std::size_t>(std::popcount(s));
        const double weight = factorial(others) * factorial(k - others - 1) / factorial(k);
        part.add(weight, at(spread(s | std::size_t{1} << n, active)));
        part.add(-weight, at(spread(s, active)));
      }
      found_.parts[active[n]] = part.numbers();
    }
    for (std::size_t n = 0; n < k; ++n)
      for (std::size_t m = n + 1; m < k; ++m) {
        const std::size_t one = std::size_t{1} << n, other = std::size_t{1} << m;
        Sum both(size);
        for (std::size_t s = 0; s < subsets; ++s) {
          if (s & (one | other)) continue;
          const auto others = static_cast<std::size_t>(std::popcount(s));
          const double weight = factorial(others) * factorial(k - others - 2) / factorial(k - 1);
          both.add(weight, at(spread(s | one | other, active)));
          both.add(-weight, at(spread(s | one, active)));
          both.add(-weight, at(spread(s | other, active)));
          both.add(weight, at(spread(s, active)));
        }
        addPair(active[n], active[m], both.numbers());
      }
  }

  void addPair(std::size_t one, std::size_t other, const Numbers& both) {
    const double law = apart(at(all_), at(0)), share = largest(both) / law;
    if (law > roundingOfNumbers && std::isfinite(law) && share >= leastInteraction)
      found_.pairs.push_back({one, other, share});
  }

  void bothEnds() {
    found_.mixtures = Mixtures::bothEnds;
    const std::size_t k = plan_.differences, size = at(0).size();
    std::vector<std::pair<double, std::size_t>> disagreeing;  // of both ends
    for (std::size_t i = 0; i < k; ++i) {
      Sum mean(size), ends(size);
      for (const auto& [sum, first, second] :
           {std::tuple(&mean, 0.5, 0.5), std::tuple(&ends, 1.0, -1.0)}) {
        sum->add(first, at(bit(i)));
        sum->add(-first, at(0));
        sum->add(second, at(all_));
        sum->add(-second, at(all_ & ~bit(i)));
      }
      found_.parts[i] = mean.numbers();
      disagreeing.emplace_back(largest(ends.numbers()), i);
    }
    if (!plan_.searches) return;
    std::ranges::sort(disagreeing, std::greater());
    disagreeing.resize(std::min(disagreeing.size(), mostPairs));
    for (std::size_t n = 0; n < disagreeing.size(); ++n)
      for (std::size_t m = n + 1; m < disagreeing.size(); ++m) {
        const std::size_t i = disagreeing[n].second, j = disagreeing[m].second;
        Sum both(size);
        both.add(1.0, at(bit(i) | bit(j)));
        both.add(-1.0, at(bit(i)));
        both.add(-1.0, at(bit(j)));
        both.add(1.0, at(0));
        addPair(std::min(i, j), std::max(i, j), both.numbers());
      }
    walk();
  }

  /// From the reference to the peer, by what brings it nearest in each step, until nothing is left
  /// that shows.
  void walk() {
    const double whole = distance(at(0), at(all_));
    Mixture taken = 0;
    while (taken != all_ && whole > 0.0) {
      std::optional<Attribution::Step> best;
      for (std::size_t i = 0; i < plan_.differences; ++i) {
        if (taken & bit(i)) continue;
        const double left = distance(at(taken | bit(i)), at(all_)) / whole;
        if (!best || left < best->left) best = {i, left};
      }
      taken |= bit(best->taken);
      found_.path.push_back(*best);
      if (best->left < leastInteraction) return;
    }
  }

  const AttributionPlan& plan_;
  const RunMixture& run_;
  Mixture all_;
  std::map<Mixture, Numbers> known_;
  Attribution found_;
};

}  // namespace

std::optional<Attribution> attribute(const AttributionPlan& plan, const RunMixture& run) {
  try {
    return Attributing(plan, run).result();
  } catch (const CannotRun&) {
    return std::nullopt;
  }
}

std::set<Mixture> mixturesOf(std::size_t differences, std::size_t mostMixed) {
  const Mixture all = (Mixture{1} << differences) - 1;
  std::set<Mixture> mixtures = {0, all};
  if (differences <= mostMixed)
    for (Mixture mixture = 1; mixture < all; ++mixture) mixtures.insert(mixture);
  else
    for (std::size_t k = 0; k < differences; ++k)
      mixtures.insert({Mixture{1} << k, all ^ Mixture{1} << k});
  return mixtures;
}

}  // namespace crossgrain::inline studies
