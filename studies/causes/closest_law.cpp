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
                                       double rounding) {
  std::vector<Candidate<D>> candidates;
  for (const MirrorChangeOf<D>& change : changes) {
    std::optional<Candidate<D>> best;
    const auto moved = with({{change, termChange}}, anyDistance);
    for (std::size_t k = 0; moved && k < now.size(); ++k) {
      if ((*moved)[k].size() != now[k].size() || norm(now[k]) < rounding) continue;
      NamedTerm term = asTerm(change, now[k], less(now[k], (*moved)[k]));
      if (!best || term.unexplained < best->term.unexplained) best = {&change, k, std::move(term)};
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
                 const std::vector<double>& response) {
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
  if (change.isConstant) term.amount = times * termChange;
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
                          double rounding)
    : scene_(std::move(scene)), can_(std::move(can)), with_(std::move(with)), rounding_(rounding) {
  restart();
}

template <int D>
void ClosestLaw<D>::restart() {
  separation_ = std::move(with_(taken_, anyDistance)->back());
  best_ = norm(separation_);
}

template <int D>
typename ClosestLaw<D>::Changes ClosestLaw<D>::changes() const {
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
std::optional<double> ClosestLaw<D>::distanceWith(const Changes& further, double limit) const {
  return distanceOf(withTaken(further), limit);
}

template <int D>
bool ClosestLaw<D>::take(ChangeKind kind, double leaving) {
  double distance = best_ * leaving;
  return take(best(kind, distance));
}

template <int D>
bool ClosestLaw<D>::takeBest() {
  double distance = best_ * (1.0 - fitsAlike);
  Changes found = best(ChangeKind::convention, distance);
  if (!found.empty()) distance *= termWorthTrying;
  if (const Changes constant = best(ChangeKind::constant, distance); !constant.empty())
    found = constant;
  return take(found);
}

template <int D>
typename ClosestLaw<D>::Changes ClosestLaw<D>::best(ChangeKind kind, double& distance) const {
  const bool ofConstants = kind == ChangeKind::constant || kind == ChangeKind::constantAtLarge;
  std::vector<MirrorChangeOf<D>> all = candidates();
  std::erase_if(all, [&](const auto& change) { return change.isConstant != ofConstants; });
  Changes found;
  const auto look = [&](const Changes& further, std::optional<double> left) {
    if (!left || !(*left < distance)) return;
    distance = *left;
    found = further;
  };
  const auto lookAt = [&](const Changes& further) {
    look(further, distanceWith(further, distance));
  };
  const auto lookAtTerm = [&](const MirrorChangeOf<D>& change, const NamedTerm& term) {
    if (term.amount) look({{change, *term.amount}}, term.unexplained * best_);
  };
  const SeparationsWith<D> with = [this](const Changes& further, double limit) {
    return with_(withTaken(further), limit);
  };
  if (kind == ChangeKind::constant)
    for (const Candidate<D>& one :
         candidatesOf(all, {separation_}, with, rounding_) | std::views::take(mostTried))
      lookAtTerm(*one.change, tried(one, {separation_}, with));
  else if (kind == ChangeKind::constantAtLarge)
    for (const MirrorChangeOf<D>& change : all)
      lookAtTerm(change, triedAtLarge(change, separation_, with));
  else if (kind == ChangeKind::convention)
    for (const MirrorChangeOf<D>& change : all) lookAt({{change}});
  else
    for (std::size_t b = 1; b < all.size(); ++b)
      for (std::size_t a = 0; a < b; ++a)
        if (optionNamed(all[a]) != optionNamed(all[b])) lookAt({{all[a]}, {all[b]}});
  return found;
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
typename ClosestLaw<D>::Changes ClosestLaw<D>::withTaken(const Changes& further) const {
  Changes all = taken_;
  all.insert(all.end(), further.begin(), further.end());
  return all;
}

template <int D>
std::optional<double> ClosestLaw<D>::distanceOf(const Changes& all, double limit) const {
  const auto separations = with_(all, limit);
  if (!separations) return std::nullopt;
  const double distance = norm(separations->back());
  return distance <= limit ? std::optional(distance) : std::nullopt;
}

template <int D>
bool ClosestLaw<D>::take(const Changes& further) {
  if (further.empty()) return false;
  taken_ = withTaken(further);
  restart();
  return true;
}

template NamedTerm asTerm(const MirrorChangeOf<2>&, const std::vector<double>&,
                          const std::vector<double>&);
template std::optional<NamedTerm> closestTerm(const std::vector<MirrorChangeOf<2>>&,
                                              const SeparationsWith<2>&, double);
template class ClosestLaw<2>;
template NamedTerm asTerm(const MirrorChangeOf<3>&, const std::vector<double>&,
                          const std::vector<double>&);
template std::optional<NamedTerm> closestTerm(const std::vector<MirrorChangeOf<3>>&,
                                              const SeparationsWith<3>&, double);
template class ClosestLaw<3>;

}  // namespace crossgrain::inline studies
