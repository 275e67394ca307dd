#include "averaging/regime.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace crossgrain::inline averaging {

namespace {

std::optional<double> ringMean(std::span<const Profile> profiles, std::string_view field,
                               std::size_t ring) {
  const auto found = std::ranges::find(profiles, field, &Profile::field);
  if (found == profiles.end() || ring >= found->mean.size()) return std::nullopt;
  return found->mean[ring];
}

/// Mean angular velocity of disks about the origin.
struct Layer {
  double sum = 0.0;
  int disks = 0;
  double rotation() const { return sum / disks; }
};

}  // namespace

std::optional<WheelMotion> wheelMotion(const Scene& scene, const Snapshot& snapshot,
                                       const Rings& cell, double omega) {
  Layer inner, outer;
  for (std::size_t disk = 0; disk < scene.disks.size(); ++disk) {
    const Vec2& x = snapshot.position[disk];
    const double r = x.norm();
    const auto addTo = [&](Layer& layer) {
      layer.sum += perpendicular(x).dot(snapshot.velocity[disk]) / (r * r);
      ++layer.disks;
    };
    if (r < cell.innerRadius() + cell.diameter()) addTo(inner);
    if (r > cell.outerRadius() - cell.diameter()) addTo(outer);
  }
  if (inner.disks == 0 || outer.disks == 0) return std::nullopt;
  return WheelMotion{1.0 - inner.rotation() / omega, (inner.rotation() - outer.rotation()) / omega};
}

std::optional<double> inertialNumber(const Rings& rings, std::span<const Profile> profiles,
                                     double density) {
  if (rings.count() < 2) return std::nullopt;
  const auto inner = ringMean(profiles, "azimuthal_velocity", 0);
  const auto outer = ringMean(profiles, "azimuthal_velocity", 1);
  const auto rr = ringMean(profiles, "stress_rr", 0);
  const auto pp = ringMean(profiles, "stress_pp", 0);
  if (!inner || !outer || !rr || !pp || *rr + *pp <= 0.0) return std::nullopt;
  const double gradient = (*outer - *inner) / (rings.centre(1) - rings.centre(0));
  const double rotation = 0.5 * (*inner + *outer) / rings.edge(1);
  return std::abs(gradient - rotation) * rings.diameter() * std::sqrt(2.0 * density / (*rr + *pp));
}

RegimeVerdict regimeOf(const RegimeFigures& figures) {
  const auto& contacts = figures.wheelContacts;
  const auto& number = figures.inertialNumber;
  if (contacts && *contacts < fewestWheelContacts)
    return {Regime::collisional,
            fmt::format("the wheel touches {:.2g} disks at a time, fewer than {:g}", *contacts,
                        fewestWheelContacts)};
  if (number && *number > collisionalInertialNumber)
    return {Regime::collisional,
            fmt::format("the inertial number at the wheel is {:.2g}, above {:g}", *number,
                        collisionalInertialNumber)};
  if (!figures.motion)
    return {{}, "there are no disks at the wheel or at the ring that would show it"};
  const double shear = figures.motion->shear;
  if (std::abs(shear) < leastShear)
    return {Regime::blocked, fmt::format("layers take up {:.2g} of the wheel's rotation, less than "
                                         "{:g}",
                                         shear, leastShear)};
  if (!contacts)
    return {{}, "layers pass one another, but without contacts nobody knows what drives them"};
  return {Regime::flowing, fmt::format("layers take up {:.2g} of the wheel's rotation", shear)};
}

std::optional<double> blockedFraction(std::span<const double> shear, std::size_t window) {
  const std::size_t windows = window == 0 ? 0 : shear.size() / window;
  if (windows == 0) return std::nullopt;
  std::size_t blocked = 0;
  for (std::size_t w = 0; w < windows; ++w) {
    const auto part = shear.subspan(w * window, window);
    const double mean =
        std::accumulate(part.begin(), part.end(), 0.0) / static_cast<double>(window);
    blocked += std::abs(mean) < leastShear;
  }
  return static_cast<double>(blocked) / static_cast<double>(windows);
}

}  // namespace crossgrain::inline averaging
