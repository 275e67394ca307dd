#include "adapters/files/displacements.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "adapters/audit_geometry.hpp"

namespace crossgrain::files {
namespace {

/// Displacements below this many times the uncertainty of a position are not compared.
constexpr double clear = 100.0;
/// Fewer disks are no sample.
constexpr std::size_t fewest = 3;
constexpr double sameFactor = 0.05, mostDisks = 0.9, powerOfTen = 0.02;
/// ½ to 3/2 is motion, and of what is even 0.9 to 1.1; the rest is room for what five in a hundred
/// of it are.
constexpr double leastOfMotion = 0.45, mostOfMotion = 1.6;
constexpr double leastOfEven = 0.85, mostOfEven = 1.18;
/// Disks that all bounce alike without loss are after n of their periods T as before. Snapshots nT
/// + δ apart then show δ/(nT + δ) of the way, less than 1/3 where a flight holds two of them in a
/// row.
constexpr double mostOfBouncing = 0.4;
/// Limit of the turn of the drive between two snapshots [rad].
constexpr double mostDriven = 0.5;
constexpr double mostRms = 2.0, leastRms = 0.01;

bool isSame(double a, double b, double within) {
  return std::abs(a - b) <= within * std::abs(b);
}

bool isPowerOfTen(double factor) {
  return isSame(factor, std::pow(10.0, std::round(std::log10(factor))), powerOfTen);
}

/// Median of factors, if nearly all are close to it and it lies outside [least, most]; absent also
/// of too few factors.
std::optional<double> commonFactor(std::vector<double> factors, double least, double most) {
  if (factors.size() < fewest) return std::nullopt;
  const auto middle = factors.begin() + static_cast<std::ptrdiff_t>(factors.size() / 2);
  std::ranges::nth_element(factors, middle);
  const double median = *middle;
  const auto alike =
      std::ranges::count_if(factors, [&](double f) { return isSame(f, median, sameFactor); });
  if (median <= 0.0 ||
      static_cast<double>(alike) < mostDisks * static_cast<double>(factors.size()) ||
      (median >= least && median <= most))
    return std::nullopt;
  return median;
}

}  // namespace

template <int D>
double driveOf(const std::vector<WallBodyOf<D>>& bodies) {
  double drive = 0.0;
  for (const WallBodyOf<D>& body : bodies)
    drive = std::max({drive, body.motion.frequency, sizeOf(body.motion.angularVelocity)});
  return drive;
}
template double driveOf(const std::vector<WallBody>&);
template double driveOf(const std::vector<WallBodyOf<3>>&);

template <int D>
std::optional<VecOf<D>> DisplacementsOf<D>::movedOf(const SnapshotOf<D>& now, std::size_t k) const {
  const VecOf<D> moved = now.position[k] - position_[k];
  if (!moved.allFinite()) return std::nullopt;  // it is new
  if (!box_) return moved;
  const VecOf<D> way = 0.5 * (now.positionTime - time_) * (velocity_[k] + now.velocity[k]);
  if (box_->nearest(way) != way) return std::nullopt;
  return box_->nearest(moved);
}

template <int D>
DisplacementsOf<D>::Factors DisplacementsOf<D>::factorsOf(const SnapshotOf<D>& now,
                                                          double uncertain) const {
  const double lapse = now.positionTime - time_;
  Factors factors;
  for (std::size_t k = 0; k < position_.size(); ++k) {
    const VecOf<D> mean = 0.5 * (velocity_[k] + now.velocity[k]), way = lapse * mean;
    const auto shown = movedOf(now, k);
    if (!shown) continue;
    const VecOf<D> change = now.velocity[k] - velocity_[k], &moved = *shown;
    if (std::max(moved.norm(), way.norm()) <= clear * uncertain || way.isZero(0.0)) continue;
    const double factor = moved.dot(way) / way.squaredNorm();
    const bool straight = (moved - factor * way).norm() <= 0.1 * moved.norm();
    const bool even =
        std::min(change.norm(), (change - factor * lapse * gravity_).norm()) <= 0.2 * mean.norm();
    if (change.norm() <= mean.norm()) factors.all.push_back(straight ? factor : 0.0);
    if (even) factors.even.push_back(straight ? factor : 0.0);
  }
  return factors;
}

template <int D>
std::optional<double> DisplacementsOf<D>::rmsOf(const SnapshotOf<D>& now, double uncertain) const {
  const double lapse = now.positionTime - time_;
  double moved = 0.0, earlier = 0.0, later = 0.0;  // sums of squares
  std::size_t count = 0;
  for (std::size_t k = 0; k < position_.size(); ++k) {
    const auto shown = movedOf(now, k);
    if (!shown) continue;
    ++count;
    moved += shown->squaredNorm();
    earlier += velocity_[k].squaredNorm();
    later += now.velocity[k].squaredNorm();
  }
  const double way = std::sqrt(moved), before = lapse * std::sqrt(earlier),
               after = lapse * std::sqrt(later);
  const double noise = clear * uncertain * std::sqrt(static_cast<double>(count));
  if (way > noise && way > mostRms * std::max(before, after)) return way / std::max(before, after);
  if (std::min(before, after) > noise && way < leastRms * std::min(before, after))
    return way / std::min(before, after);
  return std::nullopt;
}

template <int D>
MotionFinding DisplacementsOf<D>::compare(const SnapshotOf<D>& now, double uncertain) {
  MotionFinding finding;
  if (!position_.empty()) {
    const Factors factors = factorsOf(now, uncertain);
    const auto factor = commonFactor(factors.all, leastOfMotion, mostOfMotion);
    auto even = commonFactor(factors.even, leastOfEven, mostOfEven);
    if (even && *even < mostOfBouncing) even.reset();
    const bool inPhase = drive_ * (now.positionTime - time_) > mostDriven;
    const auto again = [&](const std::optional<double>& found,
                           const std::optional<double>& before) {
      return !inPhase && found && before && isSame(*found, *before, sameFactor);
    };
    finding.of = factors.all.size();
    if (factor && (isPowerOfTen(*factor) || again(factor, factor_))) {
      finding.factor = factor;
    } else if (again(even, even_)) {
      finding.factor = even;
      finding.of = factors.even.size();
    } else {
      finding.rms = rmsOf(now, uncertain);
    }
    factor_ = factor;
    even_ = even;
  }
  position_ = now.position;
  velocity_ = now.velocity;
  time_ = now.positionTime;
  return finding;
}

template <int D>
void DisplacementsOf<D>::changeDisks(const std::vector<std::optional<std::size_t>>& before) {
  if (position_.empty()) return;
  std::vector<VecOf<D>> position, velocity;
  for (const std::optional<std::size_t>& k : before) {
    position.push_back(k ? position_[*k] : VecOf<D>(VecOf<D>::Constant(NAN)));
    velocity.push_back(k ? velocity_[*k] : VecOf<D>(VecOf<D>::Zero()));
  }
  position_ = std::move(position);
  velocity_ = std::move(velocity);
}

template class DisplacementsOf<2>;
template class DisplacementsOf<3>;

}  // namespace crossgrain::files
