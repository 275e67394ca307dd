#include "engines/grain/skin.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace grain {
namespace {

double seconds(auto duration) {
  return std::chrono::duration<double>(duration).count();
}

/// Three quarters of the old figure, one quarter of the new one, of which a machine that does
/// something else meanwhile does not make more than twice the old.
void follow(double& figure, double now) {
  figure = figure > 0.0 ? 0.75 * figure + 0.25 * std::min(now, 2.0 * figure) : now;
}

double towards(double from, double to) {
  return std::clamp(to, from / 1.25, 1.25 * from);
}

}  // namespace

Skin::Skin(double skin, double smallestRadius)
    : fixed_(skin > 0.0),
      radius_(smallestRadius),
      skin_(fixed_ ? skin : 0.3 * smallestRadius),
      nextSkin_(skin_) {}

void Skin::beginUpdate(std::size_t stepsSince) {
  began_ = Clock::now();
  stepsSinceRebuild_ += stepsSince;
}

void Skin::beginRebuild() {
  skin_ = nextSkin_;
}

void Skin::endRebuild() {
  const auto now = Clock::now();
  follow(rebuildTime_, seconds(now - began_));
  began_ = now;
  stepsSinceRebuild_ = 0;
  ++rebuilds_;
}

void Skin::endRefresh(const PairCounts& pairs) {
  follow(refreshTime_, seconds(Clock::now() - began_));
  ++refreshes_;
  const std::size_t waiting = pairs.near - pairs.touching;
  if (!(pairTime_ > 0.0) || waiting == 0) return;
  const double best = refreshTime_ / (0.3 * pairTime_ * static_cast<double>(waiting));
  horizon_ = std::clamp(towards(horizon_, best), 1.0, 256.0);
}

void Skin::pairsTook(double time, std::size_t pairs) {
  if (pairs > 0) follow(pairTime_, time / static_cast<double>(pairs));
}

void Skin::tune(const PairCounts& pairs, double used) {
  if (fixed_ || !(used > 0.0) || stepsSinceRebuild_ == 0 || pairs.far <= pairs.near) return;
  const double path = used / static_cast<double>(stepsSinceRebuild_);
  const double farCost = refreshTime_ / static_cast<double>(pairs.far) *
                         (static_cast<double>(pairs.far - pairs.near) / skin_);
  const double best = std::sqrt(rebuildTime_ * path * horizon_ / farCost);
  nextSkin_ = std::clamp(towards(skin_, best), 0.01 * radius_, 2.0 * radius_);
}

void Skin::allow(std::span<const double> travel, std::vector<double>& allowance) const {
  const double mean = std::accumulate(travel.begin(), travel.end(), 0.0) /
                      static_cast<double>(std::max<std::size_t>(travel.size(), 1));
  const double least = 1e-4 * radius_;
  const double most = 0.25 * skin_;
  allowance.resize(travel.size());
  for (std::size_t i = 0; i < travel.size(); ++i) {
    const double wanted = horizon_ * (1.25 * travel[i] + 0.25 * mean);
    allowance[i] = std::min(std::max(wanted, least), most);
  }
}

}  // namespace grain
