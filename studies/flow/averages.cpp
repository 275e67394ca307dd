#include "studies/flow/averages.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include "averaging/global.hpp"
#include "averaging/grid.hpp"
#include "averaging/regime.hpp"
#include "averaging/rings.hpp"
#include "averaging/space_rings.hpp"
#include "cases/endpoints.hpp"
#include "cases/flow.hpp"
#include "cases/time_step.hpp"
#include "studies/flow/run.hpp"
#include "studies/flow/summary.hpp"

namespace crossgrain::inline studies {

template <>
std::shared_ptr<const Coordinates> coordinatesOf<2>(const Case& setup,
                                                    const std::optional<BoxOf<2>>& box) {
  const Region& region = setup.region.value();
  if (region.hasRings())
    return std::make_shared<Rings>(region.innerRadius, region.outerRadius, region.count,
                                   region.height, flowDiameter(setup));
  return std::make_shared<Grid>(region.low.head<2>(), region.high.head<2>(), region.columnCount(),
                                region.rowCount(), region.height, box);
}

template <>
std::shared_ptr<const SpaceBins> coordinatesOf<3>(const Case& setup,
                                                  const std::optional<BoxOf<3>>& box) {
  const Region& region = setup.region.value();
  if (region.hasRings())
    return std::make_shared<SpaceRings>(region.innerRadius, region.outerRadius, region.count,
                                        region.low.z(), region.high.z(), region.layers, box);
  std::array<int, 3> count = {region.columns, region.rows, region.layers};
  const bool inLine = region.bins == BinKind::slabs;
  if (inLine) count[static_cast<std::size_t>(region.axis)] = region.count;
  return std::make_shared<Cells>(region.low, region.high, count, box,
                                 inLine ? std::optional(region.axis) : std::nullopt);
}

std::shared_ptr<const BinSet> binsOf(const Case& setup) {
  if (setup.dimension == 3) return coordinatesOf<3>(setup);
  return coordinatesOf<2>(setup);
}

template <int D>
void addGlobalNumbers(RunSeries& rows, const SceneOf<D>& scene, const SnapshotOf<D>& now) {
  const GlobalNumbers numbers = globalNumbers(scene, now);
  rows["t_s"].push_back(now.positionTime);
  rows["kinetic_energy"].push_back(numbers.kineticEnergy);
  rows["coordination"].push_back(numbers.coordination);
  rows["max_overlap"].push_back(numbers.maxOverlap);
  rows["mean_overlap"].push_back(numbers.meanOverlap);
  rows["sliding_fraction"].push_back(numbers.slidingFraction);
  rows["pairs_listed"].push_back(numbers.listedPairs);
  if (!now.ledger) return;
  const bool more = scene.law.rolls() || scene.law.coheres();
  for (const LedgerTerm& term :
       std::span(ledgerTerms).first(more ? ledgerTerms.size() : commonLedgerTerms))
    rows["energy_" + std::string(term.name)].push_back(*now.ledger.*term.value);
  rows["energy_residual"].push_back(residual(*now.ledger));
}
template void addGlobalNumbers(RunSeries&, const Scene&, const Snapshot&);
template void addGlobalNumbers(RunSeries&, const SpaceScene&, const SpaceSnapshot&);

namespace {

constexpr std::string_view axes = "xyz";

/// "y" or "velocity_y": the component that a name ends in.
Eigen::Index componentOf(std::string_view name) {
  return static_cast<Eigen::Index>(axes.find(name.back()));
}

/// Orientation of a convex body as endpoints have it; absent of a disk.
/// @param last  what it was before
template <int D>
std::optional<double> angleOf(const SceneOf<D>& scene, const SnapshotOf<D>& now, std::size_t i,
                              const std::optional<double>& last) {
  if (!scene.isConvex(i) || !now.turn) return std::nullopt;
  const TurnOf<D>&turn = (*now.turn)[i], &start = scene.disks.turn[i];
  if constexpr (D == 2)
    return turn - 2.0 * std::numbers::pi *
                      std::round((turn - last.value_or(start)) / (2.0 * std::numbers::pi));
  else
    return turnBetween<D>(turn, start);
}

/// Spin of a convex body about axes of its own, which were along the scene's at its start; absent
/// of a sphere [rad/s].
std::optional<Vec3> ownSpin(const SpaceScene& scene, const SpaceSnapshot& now, std::size_t i) {
  if (!scene.isConvex(i) || !now.turn || !now.spin) return std::nullopt;
  return Vec3(matrixOf<3>(scene.disks.turn[i]) * matrixOf<3>((*now.turn)[i]).transpose() *
              (*now.spin)[i]);
}

/// How far a body reaches above its centre, along y or, in space, z [m].
template <int D>
double reachUp(const SceneOf<D>& scene, const SnapshotOf<D>& now, std::size_t i) {
  if (!scene.isConvex(i) || !now.turn) return scene.disks.radius[i];
  const VecOf<D> up = VecOf<D>::Unit(D - 1);
  const PlacedBody<D> body(scene, i, VecOf<D>::Zero(), (*now.turn)[i]);
  return depthBehind<D>(body.get(), VecOf<D>::Zero(), -up);
}

}  // namespace

template <int D>
void FlowAverages<D>::addDisks(const SnapshotOf<D>& now) {
  std::set<std::string> added;  // two endpoints may share a column
  for (const Endpoint& own : setup_.endpoints) {
    if (!own.disk || !added.insert(own.series()).second) continue;
    const auto i = static_cast<std::size_t>(*own.disk);
    Numbers& row = series_[own.series()];
    if (own.quantity == "angle") {
      row.push_back(angleOf(scene_, now, i, row.empty() ? std::nullopt : row.back()));
    } else if (own.quantity.starts_with("own_spin")) {
      if constexpr (D == 3) {
        const auto spin = ownSpin(scene_, now, i);
        row.push_back(spin ? std::optional((*spin)[componentOf(own.quantity)]) : std::nullopt);
      }
    } else if (own.quantity.starts_with("spin")) {
      if (!now.spin)
        row.emplace_back();
      else if constexpr (D == 2)
        row.push_back((*now.spin)[i]);
      else
        row.push_back((*now.spin)[i][componentOf(own.quantity)]);
    } else {
      const auto& vector = own.quantity.starts_with("velocity") ? now.velocity[i] : now.position[i];
      row.push_back(vector[componentOf(own.quantity)]);
    }
  }
  if (!added.empty()) series_["velocity_t_s"].push_back(now.velocityTime);
}

template <int D>
void FlowAverages<D>::addMoments(const SnapshotOf<D>& now) {
  constexpr Eigen::Index up = D - 1;
  using Vec = VecOf<D>;
  std::vector<std::size_t> inside;
  double mass = 0.0, top = -INFINITY;
  Vec first = Vec::Zero(), second = Vec::Zero();
  for (std::size_t i = 0; i < now.position.size(); ++i) {
    const Vec& x = now.position[i];
    if (bins_->isOverflow(bins_->slotAt(x))) continue;
    inside.push_back(i);
    mass += scene_.disks.mass[i];
    first += scene_.disks.mass[i] * x;
    top = std::max(top, x[up] + reachUp(scene_, now, i));
  }
  const bool any = !inside.empty();
  const Vec centre = any ? Vec(first / mass) : Vec::Zero();
  for (const std::size_t i : inside)
    second += scene_.disks.mass[i] * (now.position[i] - centre).cwiseAbs2();
  const Vec rms = any ? Vec((second / mass).cwiseSqrt()) : Vec::Zero();
  const double low = setup_.region->low[up];
  const double height = centre[up] - low;
  const auto number = [&](const std::string& name, double value, Eigen::Index along) {
    const bool repeats = scene_.box && scene_.box->periodic[static_cast<std::size_t>(along)];
    series_[name].push_back(any && !repeats && std::isfinite(value) ? std::optional(value)
                                                                    : std::nullopt);
  };
  series_["disks"].push_back(static_cast<double>(inside.size()));
  number("top", top - low, up);
  for (Eigen::Index k = 0; k < D; ++k) {
    const std::string axis(1, axes[static_cast<std::size_t>(k)]);
    number("mean_" + axis, k == up ? height : centre[k], k);
    number("rms_" + axis, rms[k], k);
  }
  if constexpr (D == 2) number("heap_slope", 3.0 * height / (std::sqrt(6.0) * rms.x()), 0);
}

template <int D>
void FlowAverages<D>::addWalls(const SnapshotOf<D>& now) {
  if (!hasTwoWalls(scene_)) return;
  const double height = D == 2 ? setup_.region->height : 1.0;
  const auto stresses = wallStresses(scene_, now, height);
  series_["wall_normal_stress"].push_back(stresses ? std::optional(stresses->normal)
                                                   : std::nullopt);
  series_["wall_shear_stress"].push_back(stresses ? std::optional(stresses->shear) : std::nullopt);
}

template <int D>
void FlowAverages<D>::addWallForces(const SnapshotOf<D>& now) {
  std::set<std::string> added;  // two endpoints may share a column
  for (const Endpoint& own : setup_.endpoints) {
    if (!own.wall || !added.insert(own.series()).second) continue;
    const auto body = static_cast<std::size_t>(*own.wall);
    const std::optional<std::size_t> plane =
        own.plane ? std::optional(static_cast<std::size_t>(*own.plane)) : std::nullopt;
    const auto force = forceOnWall<D>(scene_, now, body, plane);
    Numbers& row = series_[own.series()];
    if (!force)
      row.emplace_back();
    else if (own.quantity == normalForce)
      row.push_back(-force->dot(scene_.bodies[body].planes[plane.value_or(0)].normal));
    else
      row.push_back((*force)[componentOf(own.quantity)]);
  }
}

template <int D>
void FlowAverages<D>::addFlanks(const SnapshotOf<D>& now) {
  // As Lethe measures the sandpile of Ai et al. (2011): eight tops from -0.5 to -0.1 m of a box of
  // +-1 m; here of the right flank too, and in any box.
  constexpr int strips = 8;
  constexpr double nearest = 0.1, farthest = 0.5;
  const auto& region = *setup_.region;
  const double middle = 0.5 * (region.low.x() + region.high.x());
  const double half = 0.5 * (region.high.x() - region.low.x());
  std::array<std::array<double, strips>, 2> tops;
  for (auto& flank : tops) flank.fill(-INFINITY);
  for (const auto& x : now.position) {
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

template <int D>
std::optional<FlowRun> FlowAverages<D>::without(std::size_t k, std::size_t n) const {
  const auto part = profiles_.part(k, n);
  if (!part) return std::nullopt;
  FlowRun run;
  run.profiles = profiles_.profilesWithout(k, n);
  run.series = series_;
  for (auto& [name, values] : *run.series)
    values.erase(values.begin() + static_cast<std::ptrdiff_t>(part->first),
                 values.begin() + static_cast<std::ptrdiff_t>(part->second));
  return run;
}

template <int D>
FlowAverages<D>::FlowAverages(const Case& setup, const SceneOf<D>& scene)
    : setup_(setup),
      scene_(scene),
      bins_(coordinatesOf<D>(setup, scene.box)),
      profiles_(bins_, weightsOf(setup, setup.averaging.methods), scene) {
  if constexpr (D == 2)
    if (cellOf(setup)) cell_.emplace(setup, scene);
}

template <int D>
void FlowAverages<D>::add(const SnapshotOf<D>& snapshot) {
  profiles_.add(snapshot);
  addGlobalNumbers(series_, scene_, snapshot);
  if constexpr (D == 2)
    if (cell_) return cell_->add(snapshot, series_);
  addMoments(snapshot);
  addWalls(snapshot);
  addDisks(snapshot);
  addWallForces(snapshot);
  if (std::ranges::any_of(setup_.endpoints, [](const Endpoint& endpoint) {
        return endpoint.quantity == "flank_slope" || endpoint.per == "flank_slope";
      }))
    addFlanks(snapshot);
}

template <int D>
void FlowAverages<D>::describe(const EffectiveParameters& effective, FlowRun& run) const {
  run.profiles = profiles_.profiles();
  run.series = series_;
  if (cell_) return cell_->describe(effective, run);
  if (const auto times = run.series->find("velocity_t_s"); times != run.series->end())
    for (auto& t : times->second) *t -= effective.velocityLag;
  run.head = headOfRegion(effective);
}

template <int D>
std::vector<HeadNumber> FlowAverages<D>::headOfRegion(const EffectiveParameters& effective) const {
  std::vector<HeadNumber> head;
  const double diameter = flowDiameter(setup_);
  const auto mean = [&](const char* name) { return meanOf(valuesOf(series_, name)); };
  const auto add = [&](const char* name, std::optional<double> value, double factor = 1.0) {
    if (value) *value *= factor;
    head.push_back({name, "-", value, {}, {}});
  };
  const auto overlaps = presentNumbers(valuesOf(series_, "max_overlap"));
  add("coordination", mean("coordination"));
  add("mean_overlap_over_d", mean("mean_overlap"), 1.0 / diameter);
  add("max_overlap_over_d",
      overlaps.empty() ? std::nullopt : std::optional(std::ranges::max(overlaps)), 1.0 / diameter);
  add("sliding_fraction", mean("sliding_fraction"));
  if (const auto contact = pairContactTime(setup_); contact && effective.dt > 0.0)
    add("dt_over_tc", effective.dt / *contact);
  return head;
}

template class FlowAverages<2>;
template class FlowAverages<3>;

}  // namespace crossgrain::inline studies
