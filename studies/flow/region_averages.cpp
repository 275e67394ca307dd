#include "studies/flow/averages.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>

#include "cases/flow.hpp"
#include "cases/time_step.hpp"
#include "studies/flow/run.hpp"
#include "studies/flow/summary.hpp"

namespace crossgrain::inline studies {

void RegionAverages::addDisks(const Snapshot& now) {
  std::set<std::string> added;  // two endpoints may share a column
  for (const OwnEndpoint& own : setup_.average->endpoints) {
    if (!own.disk || !added.insert(own.series()).second) continue;
    const auto i = static_cast<std::size_t>(*own.disk);
    Numbers& row = series_[own.series()];
    if (own.quantity == "spin")
      row.push_back(now.spin ? std::optional((*now.spin)[i]) : std::nullopt);
    else {
      const Vec2& pair = own.quantity.starts_with("velocity") ? now.velocity[i] : now.position[i];
      row.push_back(own.quantity.ends_with("y") ? pair.y() : pair.x());
    }
  }
  if (!added.empty()) series_["velocity_t_s"].push_back(now.velocityTime);
}

void RegionAverages::addMoments(const Snapshot& now) {
  std::vector<std::size_t> inside;
  double mass = 0.0, top = -INFINITY;
  Vec2 first = Vec2::Zero(), second = Vec2::Zero();
  for (std::size_t i = 0; i < now.position.size(); ++i) {
    const Vec2& x = now.position[i];
    if (bins_->isOverflow(bins_->slotAt(x))) continue;
    inside.push_back(i);
    mass += scene_.disks.mass[i];
    first += scene_.disks.mass[i] * x;
    top = std::max(top, x.y() + scene_.disks.radius[i]);
  }
  const bool any = !inside.empty();
  const Vec2 centre = any ? Vec2(first / mass) : Vec2::Zero();
  for (const std::size_t i : inside)
    second += scene_.disks.mass[i] * (now.position[i] - centre).cwiseAbs2();
  const Vec2 rms = any ? Vec2((second / mass).cwiseSqrt()) : Vec2::Zero();
  const double height = centre.y() - setup_.average->region.low.y();
  const auto number = [&](const char* name, double value) {
    series_[name].push_back(any && std::isfinite(value) ? std::optional(value) : std::nullopt);
  };
  series_["disks"].push_back(static_cast<double>(inside.size()));
  number("top", top - setup_.average->region.low.y());
  number("mean_x", centre.x());
  number("mean_y", height);
  number("rms_x", rms.x());
  number("rms_y", rms.y());
  number("heap_slope", 3.0 * height / (std::sqrt(6.0) * rms.x()));
}

void RegionAverages::addFlanks(const Snapshot& now) {
  // As Lethe measures the sandpile of Ai et al. (2011): eight tops from -0.5 to -0.1 m of a box of
  // +-1 m; here of the right flank too, and in any box.
  constexpr int strips = 8;
  constexpr double nearest = 0.1, farthest = 0.5;
  const auto& region = setup_.average->region;
  const double middle = 0.5 * (region.low.x() + region.high.x());
  const double half = 0.5 * (region.high.x() - region.low.x());
  std::array<std::array<double, strips>, 2> tops;
  for (auto& flank : tops) flank.fill(-INFINITY);
  for (const Vec2& x : now.position) {
    if (bins_->isOverflow(bins_->slotAt(x))) continue;
    const double way = std::abs(x.x() - middle) / half;
    const int strip = static_cast<int>(std::floor(strips * (way - nearest) / (farthest - nearest)));
    if (strip < 0 || strip >= strips) continue;
    double& top = tops[x.x() > middle][static_cast<std::size_t>(strip)];
    top = std::max(top, x.y());
  }
  // Least squares over strips at k: slope = Σ (k − k̄) y / Σ (k − k̄)², per strip.
  const double width = half * (farthest - nearest) / strips;
  double moment = 0.0, square = 0.0;
  for (int k = 0; k < strips; ++k) {
    const double away = k - 0.5 * (strips - 1);
    square += away * away;
    for (const auto& flank : tops) moment -= away * flank[static_cast<std::size_t>(k)];
  }
  const double slope = moment / (2.0 * square * width);
  series_["flank_slope"].push_back(std::isfinite(slope) ? std::optional(slope) : std::nullopt);
}

RegionAverages::RegionAverages(const Case& setup, const Scene& scene)
    : ProfileAverages({binsOf(setup), weightsOf(setup, setup.averaging.methods), scene}),
      setup_(setup),
      scene_(scene),
      bins_(binsOf(setup)) {}

void RegionAverages::add(const Snapshot& snapshot) {
  profiles_.add(snapshot);
  addGlobalNumbers(series_, scene_, snapshot);
  addMoments(snapshot);
  addDisks(snapshot);
  if (std::ranges::any_of(setup_.average->endpoints, [](const OwnEndpoint& own) {
        return own.quantity == "flank_slope" || own.per == "flank_slope";
      }))
    addFlanks(snapshot);
}

void RegionAverages::describe(const EffectiveParameters& effective, FlowRun& run) const {
  run.profiles = profiles_.profiles();
  run.series = series_;
  if (const auto times = run.series->find("velocity_t_s"); times != run.series->end())
    for (auto& t : times->second) *t -= effective.velocityLag;
  const double diameter = flowDiameter(setup_);
  const auto mean = [&](const char* name) { return meanOf(valuesOf(*run.series, name)); };
  const auto add = [&](const char* name, std::optional<double> value, double factor = 1.0) {
    if (value) *value *= factor;
    run.head.push_back({name, "-", value, {}, {}});
  };
  const auto overlaps = presentNumbers(valuesOf(*run.series, "max_overlap"));
  add("coordination", mean("coordination"));
  add("mean_overlap_over_d", mean("mean_overlap"), 1.0 / diameter);
  add("max_overlap_over_d",
      overlaps.empty() ? std::nullopt : std::optional(std::ranges::max(overlaps)), 1.0 / diameter);
  add("sliding_fraction", mean("sliding_fraction"));
  if (const auto contact = pairContactTime(setup_); contact && effective.dt > 0.0)
    add("dt_over_tc", effective.dt / *contact);
}

}  // namespace crossgrain::inline studies
