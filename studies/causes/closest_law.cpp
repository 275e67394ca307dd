#include "studies/causes/closest_law.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <ranges>
#include <string>
#include <utility>

namespace crossgrain::inline studies {
namespace {

constexpr double anyDistance = std::numeric_limits<double>::infinity();
constexpr std::size_t mostTried = 5;

double dot(const std::vector<double>& one, const std::vector<double>& other) {
  return std::inner_product(one.begin(), one.end(), other.begin(), 0.0);
}

double norm(const std::vector<double>& vector) {
  return std::sqrt(dot(vector, vector));
}

std::vector<double> less(std::vector<double> one, const std::vector<double>& other) {
  for (std::size_t k = 0; k < one.size(); ++k) one[k] -= other[k];
  return one;
}

/// A change that may account for what is seen at one of the instants, to first order.
template <int D>
struct Candidate {
  const MirrorChangeOf<D>* change;
  std::size_t instant;
  NamedTerm term;
};

/// The best first.
template <int D>
std::vector<Candidate<D>> candidatesOf(const std::vector<MirrorChangeOf<D>>& changes,
                                       const Separations& now, const SeparationsWith<D>& with,
                                       double rounding,
                                       const std::vector<double>& amounts = {termChange}) {
  std::vector<Candidate<D>> candidates;
  for (const MirrorChangeOf<D>& change : changes) {
    std::optional<Candidate<D>> best;
    for (const double by : amounts) {
      const auto moved = with({{change, by}}, anyDistance);
      for (std::size_t k = 0; moved && k < now.size(); ++k) {
        if ((*moved)[k].size() != now[k].size() || norm(now[k]) < rounding) continue;
        NamedTerm term = asTerm(change, now[k], less(now[k], (*moved)[k]), by);
        if (!best || term.unexplained < best->term.unexplained)
          best = {&change, k, std::move(term)};
      }
    }
    if (best && best->term.unexplained < termWorthTrying) candidates.push_back(*best);
  }
  std::ranges::stable_sort(candidates, {},
                           [](const Candidate<D>& one) { return one.term.unexplained; });
  return candidates;
}

/// A constant changed by as much as the candidate says, and what that leaves in the mirror itself.
/// To first order it is -59 % for a half: each further trial takes the amount in proportion to what
/// the last one did.
template <int D>
NamedTerm tried(const Candidate<D>& candidate, const Separations& now,
                const SeparationsWith<D>& with) {
  constexpr int trials = 3;
  const std::vector<double>& separation = now[candidate.instant];
  NamedTerm best{candidate.term.name, candidate.term.amount, 1.0};
  double amount = *candidate.term.amount;
  for (int trial = 0; trial < trials; ++trial) {
    const auto moved = with({{*candidate.change, amount}}, anyDistance);
    if (!moved || (*moved)[candidate.instant].size() != separation.size()) break;
    const std::vector<double>& rest = (*moved)[candidate.instant];
    const double left = norm(rest) / norm(separation);
    if (left < best.unexplained) best = {candidate.term.name, amount, left};
    const std::vector<double> response = less(separation, rest);
    if (!(norm(response) > 0.0)) break;
    amount *= dot(separation, response) / dot(response, response);
  }
  return best;
}

/// Of one constant, by amounts from a hundredth to the whole of it and then between them, at the
/// last instant. To first order nothing is seen of a constant whose change makes contacts slip that
/// stuck: a rolling spring takes its whole bound then.
template <int D>
NamedTerm triedAtLarge(const MirrorChangeOf<D>& change, const std::vector<double>& separation,
                       const SeparationsWith<D>& with) {
  NamedTerm best{change.name, std::nullopt, 1.0};
  const auto attempt = [&](double amount) {
    const auto moved = with({{change, amount}}, anyDistance);
    if (!moved || moved->back().size() != separation.size()) return false;
    const double left = norm(moved->back()) / norm(separation);
    if (!(left < best.unexplained)) return false;
    best.unexplained = left;
    best.amount = amount;
    return true;
  };
  for (const double size : {0.01, 0.03, 0.1, 0.3, 0.6, 1.0})
    for (const double amount : {-size, size})
      if (amount > -1.0) attempt(amount);
  constexpr double worthRefining = 0.8;
  if (!(best.unexplained < worthRefining)) return best;
  for (double width = 0.5 * std::abs(*best.amount); width > 1e-3 * std::abs(*best.amount);
       width *= 0.5)
    if (const double amount = *best.amount; !attempt(amount + width)) attempt(amount - width);
  return best;
}

/// The part before " = " of a convention; all of an effect's name.
template <int D>
std::string optionNamed(const MirrorChangeOf<D>& change) {
  return change.name.substr(0, change.name.find(" = "));
}

}  // namespace

template <int D>
NamedTerm asTerm(const MirrorChangeOf<D>& change, const std::vector<double>& separation,
                 const std::vector<double>& response, double by) {
  NamedTerm term{change.name, std::nullopt, 1.0};
  const double whole = dot(separation, separation), ofResponse = dot(response, response);
  if (!(whole > 0.0) || !(ofResponse > 0.0)) return term;
  const double times = change.isConstant ? dot(separation, response) / ofResponse : 1.0;
  double left = 0.0;
  for (std::size_t k = 0; k < separation.size(); ++k) {
    const double rest = separation[k] - times * response[k];
    left += rest * rest;
  }
  term.unexplained = std::sqrt(left / whole);
  if (change.isConstant) term.amount = times * by;
  return term;
}

std::optional<NamedTerm> bestTerm(const std::vector<NamedTerm>& terms) {
  const auto best = std::ranges::min_element(terms, {}, &NamedTerm::unexplained);
  if (best == terms.end() || !(best->unexplained < termUnexplained)) return std::nullopt;
  return *best;
}

template <int D>
std::optional<NamedTerm> closestTerm(const std::vector<MirrorChangeOf<D>>& changes,
                                     const SeparationsWith<D>& with, double rounding) {
  const auto now = with({}, anyDistance);
  if (!now) return std::nullopt;
  std::vector<NamedTerm> terms;
  for (const Candidate<D>& one :
       candidatesOf(changes, *now, with, rounding) | std::views::take(mostTried))
    terms.push_back(one.change->isConstant ? tried(one, *now, with) : one.term);
  if (const auto named = bestTerm(terms)) return named;
  terms.clear();
  if (norm(now->back()) < rounding) return std::nullopt;
  for (const MirrorChangeOf<D>& change : changes)
    if (change.isConstant) terms.push_back(triedAtLarge(change, now->back(), with));
  return bestTerm(terms);
}

template <int D>
ClosestLaw<D>::ClosestLaw(SceneOf<D> scene, Capabilities can, SeparationsWith<D> with,
                          double rounding, std::vector<double> amounts)
    : scene_(std::move(scene)),
      can_(std::move(can)),
      with_(std::move(with)),
      rounding_(rounding),
      amounts_(std::move(amounts)) {
  restart();
}

template <int D>
void ClosestLaw<D>::restart() {
  separation_ = std::move(with_(taken_, anyDistance)->back());
  best_ = norm(separation_);
}

template <int D>
std::vector<AppliedChangeOf<D>> ClosestLaw<D>::changes() const {
  Changes all;
  for (const AppliedChangeOf<D>& one : taken_) {
    const auto known = std::ranges::find_if(
        all, [&](const AppliedChangeOf<D>& other) { return other.change.name == one.change.name; });
    if (known == all.end())
      all.push_back(one);
    else
      known->by = (1.0 + known->by) * (1.0 + one.by) - 1.0;
  }
  return all;
}

template <int D>
std::optional<double> ClosestLaw<D>::distanceWith(const AppliedChangeOf<D>& further,
                                                  double limit) const {
  Changes all = taken_;
  all.push_back(further);
  return distanceOf(all, limit);
}

template <int D>
bool ClosestLaw<D>::takeConvention() {
  double distance = best_ * (1.0 - fitsAlike);
  const auto best = bestConvention(candidates(), distance);
  if (best) take({*best});
  return best.has_value();
}

template <int D>
bool ClosestLaw<D>::takeConstant(double leaving) {
  double distance = best_ * leaving;
  const auto best = bestConstant(candidates(), distance);
  if (best) take({*best});
  return best.has_value();
}

template <int D>
bool ClosestLaw<D>::takeBest() {
  const std::vector<MirrorChangeOf<D>> all = candidates();
  double distance = best_ * (1.0 - fitsAlike);
  auto best = bestConvention(all, distance);
  if (best) distance *= termWorthTrying;
  if (const auto constant = bestConstant(all, distance)) best = constant;
  if (best) take({*best});
  return best.has_value();
}

/// If it leaves less than `distance`, which becomes what it leaves.
template <int D>
std::optional<AppliedChangeOf<D>> ClosestLaw<D>::bestConvention(
    const std::vector<MirrorChangeOf<D>>& candidates, double& distance) const {
  std::optional<AppliedChangeOf<D>> best;
  for (const MirrorChangeOf<D>& change : candidates) {
    if (change.isConstant) continue;
    const auto with = distanceWith({change}, distance);
    if (!with || !(*with < distance)) continue;
    distance = *with;
    best = {change};
  }
  return best;
}

/// If with the amount that leaves least it leaves less than `distance`, which becomes that.
template <int D>
std::optional<AppliedChangeOf<D>> ClosestLaw<D>::bestConstant(
    const std::vector<MirrorChangeOf<D>>& candidates, double& distance) const {
  std::vector<MirrorChangeOf<D>> constants;
  std::ranges::copy_if(candidates, std::back_inserter(constants), &MirrorChangeOf<D>::isConstant);
  const SeparationsWith<D> with = withTaken();
  std::optional<AppliedChangeOf<D>> best;
  for (const Candidate<D>& one :
       candidatesOf(constants, {separation_}, with, rounding_) | std::views::take(mostTried)) {
    const NamedTerm term = tried(one, {separation_}, with);
    if (!(term.unexplained * best_ < distance)) continue;
    distance = term.unexplained * best_;
    best = {*one.change, *term.amount};
  }
  return best;
}

template <int D>
bool ClosestLaw<D>::takeConstantAtLarge() {
  std::optional<AppliedChangeOf<D>> best;
  double left = 1.0 - fitsAlike;
  for (const MirrorChangeOf<D>& change : candidates()) {
    if (!change.isConstant) continue;
    const NamedTerm term = triedAtLarge(change, separation_, withTaken());
    if (!(term.unexplained < left)) continue;
    left = term.unexplained;
    best = {change, *term.amount};
  }
  if (best) take({*best});
  return best.has_value();
}

template <int D>
bool ClosestLaw<D>::takeBestPair() {
  std::vector<MirrorChangeOf<D>> all = candidates();
  std::erase_if(all, &MirrorChangeOf<D>::isConstant);
  Changes best;
  double distance = best_ * (1.0 - fitsAlike);
  for (std::size_t b = 1; b < all.size(); ++b)
    for (std::size_t a = 0; a < b; ++a) {
      if (optionNamed(all[a]) == optionNamed(all[b])) continue;
      Changes both = taken_;
      both.insert(both.end(), {{all[a]}, {all[b]}});
      const auto with = distanceOf(both, distance);
      if (!with || !(*with < distance)) continue;
      distance = *with;
      best = {{all[a]}, {all[b]}};
    }
  if (!best.empty()) take(best);
  return !best.empty();
}

template <int D>
void ClosestLaw<D>::undoNeedless(double times) {
  for (std::size_t k = taken_.size(); k-- > 0;) {
    Changes without = taken_;
    without.erase(without.begin() + static_cast<std::ptrdiff_t>(k));
    if (distanceOf(without, best_ * times + rounding_)) {
      taken_ = std::move(without);
      restart();
    }
  }
}

template <int D>
SeparationsWith<D> ClosestLaw<D>::withTaken() const {
  return [this](const Changes& further, double limit) {
    Changes all = taken_;
    all.insert(all.end(), further.begin(), further.end());
    return with_(all, limit);
  };
}

template <int D>
std::optional<double> ClosestLaw<D>::distanceOf(const Changes& all, double limit) const {
  const auto separations = with_(all, limit);
  if (!separations) return std::nullopt;
  const double distance = norm(separations->back());
  return distance <= limit ? std::optional(distance) : std::nullopt;
}

template <int D>
void ClosestLaw<D>::take(const Changes& further) {
  taken_.insert(taken_.end(), further.begin(), further.end());
  restart();
}

template NamedTerm asTerm(const MirrorChangeOf<2>&, const std::vector<double>&,
                          const std::vector<double>&, double);
template std::optional<NamedTerm> closestTerm(const std::vector<MirrorChangeOf<2>>&,
                                              const SeparationsWith<2>&, double);
template class ClosestLaw<2>;
template NamedTerm asTerm(const MirrorChangeOf<3>&, const std::vector<double>&,
                          const std::vector<double>&, double);
template std::optional<NamedTerm> closestTerm(const std::vector<MirrorChangeOf<3>>&,
                                              const SeparationsWith<3>&, double);
template class ClosestLaw<3>;

}  // namespace crossgrain::inline studies
