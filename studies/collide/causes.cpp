#include "studies/collide/causes.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "adapters/registry.hpp"
#include "adapters/stopwatch.hpp"
#include "cases/materials.hpp"
#include "studies/causes/attribution.hpp"
#include "studies/causes/closest_law.hpp"
#include "studies/causes/differences.hpp"
#include "support/interrupt.hpp"

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

  /// Whether a number is of the state after the collision, not of what an engine shows on the way.
  bool isOfEnd(std::size_t number) const {
    const CollisionQuantity& quantity = *quantities_[number / starts_.size()];
    return quantity.id != QuantityId::maxOverlap &&
           quantity.scored != CollisionQuantity::Scored::energyFraction;
  }
  std::size_t startOf(std::size_t number) const { return number % starts_.size(); }

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

/// Search for what a soft engine does otherwise than it declares.
template <int D>
class Undeclared {
 public:
  /// @param peer      as declared
  /// @param rounding  in units
  Undeclared(const Case& setup, const std::vector<CollisionStart>& starts, const SceneOf<D>& peer,
             const SweepNumbers& numbers, const Outcomes& found, double rounding)
      : setup_(setup),
        starts_(starts),
        peer_(peer),
        numbers_(numbers),
        found_(numbers.of(found)),
        rounding_(rounding) {}

  /// Changes of the peer; none where it differs by rounding, or nothing explains it.
  std::vector<AppliedChangeOf<D>> changes() {
    if (!showsAtTwoStarts()) return {};
    leaveOutRounding();
    if (!leftOut_.empty() && !showsAtTwoStarts()) return {};
    ClosestLaw<D> search(
        peer_, engineRegistry().front().make()->capabilities(),
        [this](const auto& changes, double) -> std::optional<Separations> {
          auto from = separationFrom(withChanges(peer_, changes));
          return from ? std::optional(Separations{std::move(*from)}) : std::nullopt;
        },
        rounding_);
    const double before = search.distance(), enough = std::max(rounding_, leftOfCause * before);
    using enum ChangeKind;
    std::vector<ClosestLaw<D>> found;
    // Another beginning where one change is not nearly all, nor several exactly.
    for (const auto begin : {convention, pair, constantAtLarge}) {
      ClosestLaw<D>& one = found.emplace_back(search);
      if (!(begin == convention ? one.takeBest() : one.take(begin))) continue;
      while (one.distance() > enough && (one.takeBest() || one.take(pair))) {
      }
      if (one.distance() <= (one.changes().size() == 1 ? enough : rounding_)) break;
    }
    search = *std::ranges::min_element(found, {}, &ClosestLaw<D>::distance);
    search.undoNeedless(1.0 / termWorthTrying);
    if (!(search.distance() < termUnexplained * before)) return {};
    std::vector<AppliedChangeOf<D>> changes = search.changes();
    std::erase_if(changes, [](const AppliedChangeOf<D>& one) {
      return one.change.isConstant && std::abs(one.by) < leastConstant;
    });
    return changes;
  }

  int runs() const { return runs_; }

 private:
  /// Of the difference: what is left of it is looked at no further.
  static constexpr double leftOfCause = 1e-3;

  /// In units; 1 of a number that only one of both has.
  std::optional<std::vector<double>> separationFrom(const SceneOf<D>& scene) {
    throwIfInterrupted();
    ++runs_;
    Numbers own;
    try {
      own = numbers_.of(inHouseOutcomes<D>(setup_, scene, starts_, /*watch=*/false));
    } catch (const Interrupted&) {
      throw;
    } catch (const std::exception&) {
      return std::nullopt;
    }
    std::vector<double> apart(own.size(), 0.0);
    for (std::size_t k = 0; k < own.size(); ++k)
      if (!numbers_.isOfEnd(k) || leftOut_.contains(numbers_.startOf(k)))
        continue;
      else if (own[k] && found_[k])
        apart[k] = (*found_[k] - *own[k]) / numbers_.units()[k];
      else
        apart[k] = own[k].has_value() == found_[k].has_value() ? 0.0 : 1.0;
    return apart;
  }

  /// One number can be had by any constant.
  bool showsAtTwoStarts() {
    const auto apart = separationFrom(peer_);
    std::set<std::size_t> starts;
    for (std::size_t k = 0; apart && k < apart->size(); ++k)
      if (std::abs((*apart)[k]) > rounding_) starts.insert(numbers_.startOf(k));
    return starts.size() > 1;
  }

  /// Starts from which the law jumps and rounding decides where it ends.
  void leaveOutRounding() {
    constexpr double rounding = 1e-12;
    const auto as = separationFrom(peer_);
    for (const double by : {rounding, -rounding}) {
      SceneOf<D> beside = peer_;
      changeLaws(beside, [by](ContactLaw& law) {
        law.kn *= 1.0 + by;
        law.mu *= 1.0 - by;
      });
      const auto other = separationFrom(beside);
      for (std::size_t k = 0; as && other && k < as->size(); ++k)
        if (std::abs((*as)[k] - (*other)[k]) > rounding_) leftOut_.insert(numbers_.startOf(k));
    }
  }

  const Case& setup_;
  const std::vector<CollisionStart>& starts_;
  const SceneOf<D>& peer_;
  const SweepNumbers& numbers_;
  Numbers found_;
  double rounding_;
  std::set<std::size_t> leftOut_;
  int runs_ = 0;
};

template <int D>
std::optional<CollisionCauses> causesIn(const Case& setup,
                                        const std::vector<CollisionStart>& starts,
                                        const SceneOf<D>& scene, const SceneOf<D>& peer,
                                        const Outcomes& found, const CurveScore& score) {
  Stopwatch watch;
  std::optional<Stopwatch::Lap> lap(watch);
  const SweepNumbers numbers(setup, starts, score);
  const double rounding = std::max(leastDifference, score.rounding.value_or(0.0));
  std::string reason;
  const auto runOf = [&](const SceneOf<D>& each) -> std::optional<Numbers> {
    try {
      return numbers.of(inHouseOutcomes<D>(setup, each, starts, /*watch=*/true));
    } catch (const UnsupportedScene& refusal) {
      reason = refusal.what();
      return std::nullopt;
    }
  };
  const auto reference = runOf(scene);
  CollisionCauses causes;
  if (!reference) {
    causes.reason = reason;
    return causes;
  }
  const Numbers whole = less(numbers.of(found), *reference);
  if (largest(whole, numbers.units()) <= rounding) return std::nullopt;

  Undeclared<D> search(setup, starts, peer, numbers, found, rounding);
  const auto behaviour = behaviourOf<D>(
      scene, peer, peer.law.soft() ? search.changes() : std::vector<AppliedChangeOf<D>>());
  const auto& differences = behaviour.differences;
  static_cast<Causes&>(causes) = behaviour.causes;
  causes.runs = search.runs();
  causes.remainder = peer.law.soft() ? "implementation" : "solver";
  const auto parts = attribute(causes, {.units = numbers.units()}, [&](Mixture mixture) {
    return mixture == 0 ? reference : runOf(mixed(scene, behaviour.scene, differences, mixture));
  });
  causes.reason = reason;
  if (!parts) return causes;
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
  return causesIn<D>(setup, starts, scene, peer, found, score);
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
