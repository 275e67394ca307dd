#include "studies/collide/causes.hpp"

#include <algorithm>
#include <cmath>

#include "adapters/stopwatch.hpp"
#include "studies/causes/attribution.hpp"
#include "studies/causes/differences.hpp"

namespace crossgrain::inline studies {

namespace {

/// Of a quantity's unit: what outcomes differ by at least, beyond what rounding of places does.
/// In double precision rounding gives some 1e-12.
constexpr double leastDifference = 1e-9;

/// All scored quantities of a sweep's collisions, one after the other.
class SweepNumbers {
 public:
  SweepNumbers(const Case& setup, const std::vector<CollisionStart>& starts,
               const CurveScore& score)
      : pair_(collidingPair(setup)), starts_(starts) {
    for (const CollisionQuantity& quantity : scoredQuantities()) {
      if (!score.of[quantity.id]) continue;
      quantities_.push_back(&quantity);
      units_.insert(units_.end(), starts.size(), score.of[quantity.id]->unit);
    }
  }

  Numbers of(const Outcomes& outcomes) const {
    Numbers numbers;
    for (const CollisionQuantity* quantity : quantities_)
      for (std::size_t k = 0; k < starts_.size(); ++k)
        numbers.push_back(outcomes[k] ? quantity->scoredValue(*outcomes[k], pair_, starts_[k].vn)
                                      : std::nullopt);
    return numbers;
  }

  const std::vector<double>& units() const { return units_; }

  /// Numbers of one quantity among all.
  Numbers part(const Numbers& all, std::size_t quantity) const {
    const auto from = all.begin() + static_cast<std::ptrdiff_t>(quantity * starts_.size());
    return {from, from + static_cast<std::ptrdiff_t>(starts_.size())};
  }
  const std::vector<const CollisionQuantity*>& quantities() const { return quantities_; }

 private:
  CollidingPair pair_;
  const std::vector<CollisionStart>& starts_;
  std::vector<const CollisionQuantity*> quantities_;
  std::vector<double> units_;
};

Numbers less(const Numbers& one, const Numbers& other) {
  Numbers difference;
  for (std::size_t k = 0; k < one.size(); ++k)
    difference.push_back(one[k] && other[k] ? std::optional(*one[k] - *other[k]) : std::nullopt);
  return difference;
}

double largest(const Numbers& numbers, const std::vector<double>& units) {
  double most = 0.0;
  for (std::size_t k = 0; k < numbers.size(); ++k)
    if (numbers[k]) most = std::max(most, std::abs(*numbers[k]) / units[k]);
  return most;
}

template <int D>
std::optional<CollisionCauses> causesIn(const Case& setup,
                                        const std::vector<CollisionStart>& starts,
                                        const SceneOf<D>& scene, const SceneOf<D>& peer,
                                        const Outcomes& found, const CurveScore& score) {
  Stopwatch watch;
  std::optional<Stopwatch::Lap> lap(watch);
  const SweepNumbers numbers(setup, starts, score);
  const std::vector<Difference<SceneOf<D>>> differences = differencesOf(scene, peer);
  CollisionCauses causes;
  static_cast<Causes&>(causes) = causesOf(differences);
  causes.remainder = peer.law.soft() ? "implementation" : "solver";
  const RunMixture run = [&](Mixture mixture) -> std::optional<Numbers> {
    const bool all = mixture + 1 == Mixture{1} << differences.size();
    try {
      return numbers.of(inHouseOutcomes<D>(setup, all ? peer : mixed(scene, differences, mixture),
                                           starts, /*watch=*/true));
    } catch (const UnsupportedScene& refusal) {
      causes.reason = refusal.what();
      return std::nullopt;
    }
  };
  const auto parts = attribute({.differences = differences.size(), .units = numbers.units()}, run);
  if (!parts) return causes;
  addFindings(causes, *parts);
  const Numbers reference = *run(0);
  const Numbers whole = less(numbers.of(found), reference);
  if (largest(whole, numbers.units()) <= std::max(leastDifference, score.rounding.value_or(0.0)))
    return std::nullopt;
  Numbers remainder = less(whole, parts->interaction);
  for (const Numbers& part : parts->parts) remainder = less(remainder, part);
  for (std::size_t q = 0; q < numbers.quantities().size(); ++q) {
    QuantityCauses& own = causes.of[numbers.quantities()[q]->id].emplace();
    own.whole = numbers.part(whole, q);
    for (const Numbers& part : parts->parts) own.parts.push_back(numbers.part(part, q));
    own.interaction = numbers.part(parts->interaction, q);
    own.remainder = numbers.part(remainder, q);
    if (const auto& of = score.of[numbers.quantities()[q]->id]; of->limit)
      own.limit = *of->limit * of->unit;
  }
  lap.reset();
  causes.cpuSeconds = watch.cpuSeconds;
  return causes;
}
}  // namespace

template <int D>
std::optional<CollisionCauses> causesOfSweep(const Case& setup,
                                             const std::vector<CollisionStart>& starts,
                                             const SceneOf<D>& scene, const SceneOf<D>& peer,
                                             const Outcomes& found, const CurveScore& score) {
  return causesIn(setup, starts, scene, peer, found, score);
}
template std::optional<CollisionCauses> causesOfSweep<2>(const Case&,
                                                         const std::vector<CollisionStart>&,
                                                         const Scene&, const Scene&,
                                                         const Outcomes&, const CurveScore&);
template std::optional<CollisionCauses> causesOfSweep<3>(const Case&,
                                                         const std::vector<CollisionStart>&,
                                                         const SpaceScene&, const SpaceScene&,
                                                         const Outcomes&, const CurveScore&);

}  // namespace crossgrain::inline studies
