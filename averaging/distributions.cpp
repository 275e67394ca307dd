#include "averaging/distributions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>

#include "averaging/contact_rule.hpp"

namespace crossgrain::inline averaging {

namespace {

constexpr std::size_t fewestBlocks = 8;

// In units of the wheel's surface: a disk can at most be a little faster than that for long.
const Bins radialBins{-0.5, 0.04, 25};
const Bins azimuthalBins{-0.5, 0.04, 50};
const Bins spinBins{-1.5, 0.06, 50};
const Bins coordinationBins{-0.5, 1.0, 9};
const Bins forceBins{0.0, 0.2, 50};
const Bins directionBins{-std::numbers::pi, std::numbers::pi / 18.0, 36};

constexpr std::size_t perRing = 4;

/// The bin of the angle of the unit vector (x, y), which in a quadrant is known from the sines of
/// the bins' edges: an arc tangent for each contact would take as long as all fields.
std::size_t directionSlot(double x, double y) {
  static const auto sines = [] {
    std::array<double, 9> edges{};
    for (std::size_t k = 0; k < edges.size(); ++k)
      edges[k] = std::sin(static_cast<double>(k + 1) * directionBins.width);
    return edges;
  }();
  std::size_t bins = 0;
  for (const double sine : sines) bins += std::abs(y) >= sine ? 1 : 0;
  const std::size_t slot =
      y >= 0.0 ? (x >= 0.0 ? 18 + bins : 35 - bins) : (x >= 0.0 ? 17 - bins : bins);
  return slot + 1;
}

double sumOf(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

}  // namespace

std::size_t Bins::slot(double value) const {
  if (value < low) return 0;
  const double bin = std::floor((value - low) / width);
  return static_cast<std::size_t>(std::min(bin, static_cast<double>(count))) + 1;
}

BlockedCounts::Fractions BlockedCounts::fractions() const {
  Fractions result;
  result.mean = series_.sums();  // counts, until they are divided
  result.total = sumOf(result.mean);
  if (result.total == 0.0) return result;
  for (double& fraction : result.mean) fraction /= result.total;
  const auto n = static_cast<double>(series_.blocks());
  if (series_.blocks() < fewestBlocks) return result;
  // A fraction is a ratio of two sums: its error comes from count − fraction·total, block by block.
  const double perBlock = result.total / n;
  result.standardError.assign(result.mean.size(), 0.0);
  for (std::size_t b = 0; b < series_.blocks(); ++b) {
    const std::span<const double> block = series_.sums(b);
    const double total = sumOf(block);
    for (std::size_t k = 0; k < block.size(); ++k) {
      const double residual = (block[k] - result.mean[k] * total) / perBlock;
      result.standardError[k] += residual * residual;
    }
  }
  for (double& error : result.standardError) error = std::sqrt(error / (n * (n - 1.0)));
  return result;
}

DistributionAccumulator::DistributionAccumulator(Rings rings, const Scene& scene,
                                                 DistributionScales scales)
    : rings_(std::move(rings)), scales_(scales), disks_(scene.disks.size()), places_(disks_) {
  for (int ring = 0; ring < rings_.count(); ++ring) {
    collect("radial_velocity", ring, {radialBins});
    collect("azimuthal_velocity", ring, {azimuthalBins});
    collect("spin", ring, {spinBins});
    collect("contact_direction", ring, {directionBins});
  }
  joint_ = collect("azimuthal_velocity_and_spin", {}, {azimuthalBins, spinBins});
  coordination_ = collect("coordination", {}, {coordinationBins});
  normal_ = collect("normal_force", {}, {forceBins});
  tangential_ = collect("tangential_force", {}, {forceBins});
}

std::size_t DistributionAccumulator::collect(const char* quantity, std::optional<int> ring,
                                             std::vector<Bins> axes) {
  std::size_t slots = 1;
  for (const Bins& axis : axes) slots *= static_cast<std::size_t>(axis.count) + 2;
  all_.push_back({quantity, ring, std::move(axes), BlockedCounts(slots)});
  return all_.size() - 1;
}

void DistributionAccumulator::add(const Snapshot& snapshot) {
  for (std::size_t disk = 0; disk < disks_; ++disk) addDisk(disk, snapshot);
  if (snapshot.contacts) addContacts(*snapshot.contacts);
  for (Collected& collected : all_) collected.counts.endSnapshot();
}

void DistributionAccumulator::addDisk(std::size_t disk, const Snapshot& snapshot) {
  const Vec2& position = snapshot.position[disk];
  const double r = position.norm();
  const int ring = rings_.binOf(r);
  Place& place = places_[disk] = Place{};
  if (ring == rings_.insideBin() || ring == rings_.outsideBin()) return;
  const Vec2 radial = position / r;
  place.radial = radial;
  place.ring = ring;
  const Vec2& velocity = snapshot.velocity[disk];
  const std::size_t first = static_cast<std::size_t>(ring) * perRing;
  const double azimuthal =
      (radial.x() * velocity.y() - radial.y() * velocity.x()) / scales_.velocity;
  const std::size_t azimuthalSlot = azimuthalBins.slot(azimuthal);
  all_[first].counts.count(radialBins.slot(radial.dot(velocity) / std::abs(scales_.velocity)));
  all_[first + 1].counts.count(azimuthalSlot);
  if (!snapshot.spin) return;
  const std::size_t spinSlot = spinBins.slot((*snapshot.spin)[disk] / scales_.spin);
  all_[first + 2].counts.count(spinSlot);
  if (r < rings_.innerRadius() + rings_.diameter())
    all_[joint_].counts.count(azimuthalSlot + spinSlot * (azimuthalBins.count + 2));
}

void DistributionAccumulator::addContacts(const Contacts& pairs) {
  double count = 0.0, normal = 0.0, tangential = 0.0;
  for (std::size_t c = 0; c < pairs.size(); ++c) {
    if (!transmits(pairs, c)) continue;
    addContactOf(pairs.i[c], -pairs.normal[c]);
    addContactOf(pairs.j[c], pairs.normal[c]);
    count += 1.0;
    normal += pairs.normalForce[c];
    tangential += std::abs(pairs.tangentialForce[c]);
  }
  normal /= count;
  tangential /= count;
  for (const Place& place : places_)
    all_[coordination_].counts.count(coordinationBins.slot(place.contacts));
  for (std::size_t c = 0; c < pairs.size(); ++c) {
    if (!transmits(pairs, c)) continue;
    if (normal > 0.0) all_[normal_].counts.count(forceBins.slot(pairs.normalForce[c] / normal));
    if (tangential > 0.0)
      all_[tangential_].counts.count(
          forceBins.slot(std::abs(pairs.tangentialForce[c]) / tangential));
  }
}

void DistributionAccumulator::addContactOf(std::int32_t disk, const Vec2& outward) {
  const auto p = static_cast<std::size_t>(disk);
  if (p >= disks_) return;
  Place& place = places_[p];
  ++place.contacts;
  if (place.ring < 0) return;
  const double along = place.radial.dot(outward);
  const double across = perpendicular(place.radial).dot(outward);
  all_[static_cast<std::size_t>(place.ring) * perRing + 3].counts.count(
      directionSlot(along, across));
}

std::vector<Distribution> DistributionAccumulator::distributions() const {
  std::vector<Distribution> result;
  for (const Collected& collected : all_)
    if (Distribution found = distribution(collected); found.samples > 0.0)
      result.push_back(std::move(found));
  return result;
}

Distribution DistributionAccumulator::distribution(const Collected& collected) const {
  const BlockedCounts::Fractions fractions = collected.counts.fractions();
  Distribution result{collected.quantity, collected.ring, collected.axes, {}, {}, 0.0,
                      fractions.total};
  const bool joint = result.axes.size() > 1;
  const auto across = static_cast<std::size_t>(result.axes[0].count);
  const auto rows = static_cast<std::size_t>(joint ? result.axes[1].count : 1);
  const double size = result.axes[0].width * (joint ? result.axes[1].width : 1.0);
  for (std::size_t slot = 0; slot < fractions.mean.size(); ++slot) {
    const std::size_t column = slot % (across + 2), row = slot / (across + 2);
    if (column == 0 || column > across || (joint && (row == 0 || row > rows))) {
      result.outside += fractions.mean[slot];
      continue;
    }
    result.density.push_back(fractions.mean[slot] / size);
    if (!fractions.standardError.empty())
      result.standardError.push_back(fractions.standardError[slot] / size);
  }
  return result;
}

}  // namespace crossgrain::inline averaging
