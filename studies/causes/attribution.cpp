#include "studies/causes/attribution.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numeric>
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
  Attributing(Causes& causes, const AttributionPlan& plan, const RunMixture& run)
      : causes_(causes),
        plan_(plan),
        run_(run),
        count_(causes.differences.size()),
        all_((Mixture{1} << count_) - 1) {}

  Attribution result() {
    found_.parts.assign(count_, Numbers(at(0).size(), 0.0));
    std::vector<std::size_t> active(count_);
    std::iota(active.begin(), active.end(), std::size_t{0});
    if (count_ > plan_.mostMixed) std::erase_if(active, [&](std::size_t i) { return isInert(i); });
    const Mixture taken = spread(all_, active);
    const bool mixed = active.size() <= plan_.mostMixed && same(at(taken), at(all_));
    causes_.mixtures = mixed ? Mixtures::all : Mixtures::bothEnds;
    if (mixed)
      mixAll(active);
    else
      takeBothEnds();
    Sum rest(at(0).size());
    addEffect(rest, 1.0, 0, all_);
    for (const Numbers& part : found_.parts) rest.add(-1.0, part);
    found_.interaction = rest.numbers();
    if (mixed)
      for (auto& value : found_.interaction)
        if (value) value = 0.0;
    std::ranges::sort(causes_.interactions, std::greater(), &Interaction::share);
    causes_.runs += static_cast<int>(known_.size());
    return std::move(found_);
  }

 private:
  static Mixture bit(std::size_t i) { return Mixture{1} << i; }
  const std::string& nameOf(std::size_t i) const { return causes_.differences[i].name; }

  const Numbers& at(Mixture mixture) {
    const auto known = known_.find(mixture);
    if (known != known_.end()) return known->second;
    auto numbers = run_(mixture);
    if (!numbers) throw CannotRun();
    return known_.emplace(mixture, std::move(*numbers)).first->second;
  }

  /// Adds Δ of one, or of one and another.
  void addEffect(Sum& sum, double weight, Mixture beside, Mixture one, Mixture other = 0) {
    sum.add(weight, at(beside | one | other));
    if (other != 0) {
      sum.add(-weight, at(beside | one));
      sum.add(-weight, at(beside | other));
    }
    sum.add(other != 0 ? weight : -weight, at(beside));
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
      most = std::max(most, std::abs(numbers[k].value_or(0.0)) / unit(k));
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

  /// Mixture of those of the active that have a bit in `subset`.
  static Mixture spread(Mixture subset, const std::vector<std::size_t>& active) {
    Mixture mixture = 0;
    for (std::size_t n = 0; n < active.size(); ++n)
      if (subset >> n & 1) mixture |= bit(active[n]);
    return mixture;
  }

  /// I_T of one of the active, or of two.
  Numbers meanEffect(const std::vector<std::size_t>& active, Mixture one, Mixture other = 0) {
    const std::size_t k = active.size(), t = other == 0 ? 1 : 2;
    Sum sum(at(0).size());
    for (Mixture s = 0; s < bit(k); ++s) {
      if (s & (one | other)) continue;
      const auto others = static_cast<std::size_t>(std::popcount(s));
      addEffect(sum, factorial(others) * factorial(k - others - t) / factorial(k - t + 1),
                spread(s, active), spread(one, active), spread(other, active));
    }
    return sum.numbers();
  }

  void mixAll(const std::vector<std::size_t>& active) {
    for (std::size_t n = 0; n < active.size(); ++n) {
      found_.parts[active[n]] = meanEffect(active, bit(n));
      for (std::size_t m = n + 1; m < active.size(); ++m)
        addPair(active[n], active[m], meanEffect(active, bit(n), bit(m)));
    }
  }

  void addPair(std::size_t one, std::size_t other, const Numbers& both) {
    const double law = apart(at(all_), at(0)), share = largest(both) / law;
    if (law > roundingOfNumbers && std::isfinite(law) && share >= leastInteraction)
      causes_.interactions.push_back({nameOf(one), nameOf(other), share});
  }

  void takeBothEnds() {
    const std::size_t size = at(0).size();
    std::vector<std::pair<double, std::size_t>> disagreeing;  // of both ends
    for (std::size_t i = 0; i < count_; ++i) {
      Sum mean(size), ends(size);
      addEffect(mean, 0.5, 0, bit(i));
      addEffect(mean, 0.5, all_ & ~bit(i), bit(i));
      addEffect(ends, 1.0, 0, bit(i));
      addEffect(ends, -1.0, all_ & ~bit(i), bit(i));
      found_.parts[i] = mean.numbers();
      disagreeing.emplace_back(largest(ends.numbers()), i);
    }
    if (!plan_.searches) return;
    std::ranges::sort(disagreeing, std::greater());
    disagreeing.resize(std::min(disagreeing.size(), mostPairs));
    for (const auto& [ends, i] : disagreeing)
      for (const auto& [otherEnds, j] : disagreeing) {
        if (i >= j) continue;
        Sum both(size);
        addEffect(both, 1.0, 0, bit(i), bit(j));
        addPair(i, j, both.numbers());
      }
    walk();
  }

  /// From the reference to the peer, by what brings it nearest in each step, until nothing is left
  /// that shows.
  void walk() {
    const double whole = distance(at(0), at(all_));
    double left = 1.0;
    for (Mixture taken = 0; taken != all_ && whole > 0.0 && left >= leastInteraction;) {
      std::optional<std::size_t> best;
      for (std::size_t i = 0; i < count_; ++i) {
        if (taken & bit(i)) continue;
        const double with = distance(at(taken | bit(i)), at(all_)) / whole;
        if (best && !(with < left)) continue;
        best = i;
        left = with;
      }
      taken |= bit(*best);
      causes_.path.push_back({nameOf(*best), left});
    }
  }

  Causes& causes_;
  const AttributionPlan& plan_;
  const RunMixture& run_;
  std::size_t count_;
  Mixture all_;
  std::map<Mixture, Numbers> known_;
  Attribution found_;
};

}  // namespace

std::optional<Attribution> attribute(Causes& causes, const AttributionPlan& plan,
                                     const RunMixture& run) {
  try {
    return Attributing(causes, plan, run).result();
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
