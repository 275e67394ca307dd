#include "runs/baseline/collision_changes.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "runs/lockstep/rules.hpp"

namespace crossgrain::inline runs {
namespace {

using Values = std::vector<std::optional<double>>;

double largestOf(const Values& values) {
  double largest = 0.0;
  for (const auto& value : values) largest = std::max(largest, std::abs(value.value_or(0.0)));
  return largest > 0.0 ? largest : 1.0;
}

CollisionChange changeOf(const KeptCollisions& sweep, const std::string& quantity,
                         const Values& before, const Values& now) {
  CollisionChange change{sweep.name, sweep.variant, quantity};
  change.points = before.size();
  const double unit = largestOf(before);
  for (std::size_t k = 0; k < before.size(); ++k) {
    if (before[k] == now[k]) continue;
    ++change.changed;
    const bool both = before[k] && now[k];
    const double by = both ? *now[k] - *before[k] : NAN;
    const double relative = both ? std::abs(by) / unit : 1.0;
    if (change.changed > 1 && relative <= change.relative) continue;
    change.largest = by;
    change.relative = relative;
    change.psi = sweep.psi[k];
    change.vn = sweep.vn[k];
  }
  return change;
}

}  // namespace

bool sameCollisions(const KeptCollisions& before, const KeptCollisions& now) {
  return before.name == now.name && before.variant == now.variant && before.psi == now.psi &&
         before.vn == now.vn;
}

std::vector<CollisionChange> collisionChanges(const KeptCollisions& before,
                                              const KeptCollisions& now) {
  const Values none(before.psi.size());
  std::vector<CollisionChange> changes;
  const auto compare = [&](const std::string& quantity, const Values& was, const Values& is) {
    if (CollisionChange change = changeOf(before, quantity, was, is); change.changed > 0)
      changes.push_back(std::move(change));
  };
  for (const auto& [quantity, was] : before.values) {
    const auto found = now.values.find(quantity);
    compare(quantity, was, found == now.values.end() ? none : found->second);
  }
  for (const auto& [quantity, is] : now.values)
    if (!before.values.contains(quantity)) compare(quantity, none, is);
  std::ranges::stable_sort(changes, std::ranges::greater(), &CollisionChange::relative);
  return changes;
}

DiffVerdict verdictOf(const std::vector<CollisionChange>& changes) {
  double largest = 0.0;
  for (const CollisionChange& change : changes) largest = std::max(largest, change.relative);
  if (changes.empty()) return DiffVerdict::sameBits;
  if (largest < lockstepRounding) return DiffVerdict::sameToRounding;
  return largest < lockstepSameLaw ? DiffVerdict::sameLaw : DiffVerdict::differs;
}

}  // namespace crossgrain::inline runs
