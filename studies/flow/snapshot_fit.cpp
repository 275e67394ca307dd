#include "studies/flow/snapshot_fit.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "cases/assembly_scene.hpp"
#include "cases/couette.hpp"
#include "support/bad_input.hpp"
#include "support/numbers.hpp"

namespace crossgrain::inline studies {
namespace {

/// Engines of floats round to 10⁻⁷; what differs by more differs.
constexpr double tolerance = 1e-5;

bool same(double a, double b) {
  return std::abs(a - b) <= tolerance * std::max(std::abs(a), std::abs(b));
}

/// Everything that does not fit, each "what the file has, not what the case has".
class Misfits {
 public:
  void number(const std::string& what, std::size_t found, std::size_t target) {
    if (found != target) list_.push_back(fmt::format("{} {}, not {}", found, what, target));
  }
  void size(const std::string& what, double found, double target, const char* unit) {
    if (!same(found, target))
      list_.push_back(fmt::format("{} {:.4g} {}, not {:.4g} {}", what, found, unit, target, unit));
  }
  void add(std::string misfit) { list_.push_back(std::move(misfit)); }
  const std::vector<std::string>& list() const { return list_; }

 private:
  std::vector<std::string> list_;
};

/// @param radius, mass  of one kind in the case; @returns how many of the file are of it
std::size_t compareKind(const Disks& disks, double radius, double mass, const char* kind,
                        Misfits& misfits) {
  std::size_t count = 0;
  bool reported = false;
  for (std::size_t i = 0; i < disks.size(); ++i) {
    if (!same(disks.radius[i], radius)) continue;
    ++count;
    if (reported || same(disks.mass[i], mass)) continue;
    misfits.size(fmt::format("a {} disk's mass", kind), disks.mass[i], mass, "kg");
    reported = true;
  }
  return count;
}

void compareDisks(const Disks& disks, const Particles& target, Misfits& misfits) {
  const auto isOf = [&](double radius) {
    return same(radius, target.smallRadius) || same(radius, target.largeRadius);
  };
  const auto other = std::ranges::find_if_not(disks.radius, isOf);
  if (other != disks.radius.end())
    misfits.add(fmt::format("disks of radius {:.4g} m, not {:.4g} and {:.4g} m", *other,
                            target.smallRadius, target.largeRadius));
  misfits.number("disks", disks.size(), static_cast<std::size_t>(target.small + target.large));
  if (other != disks.radius.end()) return;
  const std::size_t small =
      compareKind(disks, target.smallRadius, target.smallMass, "small", misfits);
  if (same(target.smallRadius, target.largeRadius)) return;
  const std::size_t large =
      compareKind(disks, target.largeRadius, target.largeMass, "large", misfits);
  misfits.number("small disks", small, static_cast<std::size_t>(target.small));
  misfits.number("large disks", large, static_cast<std::size_t>(target.large));
}

/// The wheel's and the ring's wall disks, in this order, against those of the case's cell.
void compareWalls(const Scene& scene, const Snapshot& first, const Case& setup, Misfits& misfits) {
  const Cell& cell = couetteIn(setup).cell;
  const double radii[] = {cell.innerRadius, cell.outerRadius};
  const char* const names[] = {wheelName, ringName};
  std::size_t at = 0;
  for (std::size_t b = 0; b < 2; ++b) {
    const std::vector<double>& disks = scene.bodies[b].diskRadius;
    if (disks.empty()) continue;
    const WallBody target = wallRing(names[b], cell, radii[b], 0.0);
    misfits.number(b == 0 ? "wall disks of the wheel" : "wall disks of the ring", disks.size(),
                   target.diskRadius.size());
    misfits.size(fmt::format("the {}'s wall disks' radius", names[b]), disks.front(),
                 cell.wallRadius, "m");
    misfits.size(fmt::format("the {}'s radius", names[b]), first.wallPosition[at].norm(), radii[b],
                 "m");
    at += disks.size();
  }
}

/// A disk or two may have got through a wall; a hundredth of them has not.
void comparePlaces(const Snapshot& first, const Cell& cell, Misfits& misfits) {
  const auto outside = std::ranges::count_if(first.position, [&](const Vec2& at) {
    return at.norm() < cell.innerRadius || at.norm() > cell.outerRadius;
  });
  if (outside > 2 && 100 * static_cast<std::size_t>(outside) > first.position.size())
    misfits.add(fmt::format("{} disks not between {:.4g} and {:.4g} m from the axis", outside,
                            cell.innerRadius, cell.outerRadius));
}

/// The range of radii that the case allows for disk k of an assembly of groups.
struct GroupDisk {
  double least, most;  ///< radius [m]
  double massPerSize;  ///< mass/radius², in space mass/radius³ [kg/m², kg/m³]
  std::int32_t shape;  ///< among those of the case; −1: it is round
};

/// As DisksOf::shape has it.
template <int D>
std::int32_t shapeIndex(const DisksOf<D>& disks, std::size_t k) {
  return disks.areRound() ? -1 : disks.shape[k];
}

/// a², in space a³.
template <int D>
double sizeOf(double radius) {
  return D == 2 ? radius * radius : radius * radius * radius;
}

template <int D>
std::vector<GroupDisk> groupDisks(const AssemblyOf<D>& assembly) {
  std::vector<GroupDisk> all;
  std::int32_t shapes = 0;
  for (const DiskGroupOf<D>& group : assembly.disks)
    all.insert(
        all.end(), group.count(),
        {group.radius * (1.0 - group.radiusSpread), group.radius * (1.0 + group.radiusSpread),
         group.mass / sizeOf<D>(group.radius), group.shape ? shapes++ : -1});
  return all;
}

template <int D>
void compareGroups(const DisksOf<D>& disks, const AssemblyOf<D>& assembly,
                   const SnapshotOrigin& origin, Misfits& misfits) {
  const std::vector<GroupDisk> groups = groupDisks<D>(assembly);
  for (std::size_t k = 0; k < disks.size(); ++k) {
    const GroupDisk& own = groups[k];
    const double a = disks.radius[k];
    const char* const word = own.shape < 0 ? "disk" : "body";
    if (const std::int32_t shape = shapeIndex(disks, k); shape != own.shape)
      return misfits.add(fmt::format("{} {} of shape {}, not {}", word, k, shape, own.shape));
    if (a < own.least * (1.0 - tolerance) || a > own.most * (1.0 + tolerance)) {
      const std::string target = same(own.least, own.most)
                                     ? fmt::format("{:.4g}", own.most)
                                     : fmt::format("{:.4g} to {:.4g}", own.least, own.most);
      return misfits.add(fmt::format("{} {} of radius {:.4g} m, not {} m{}", word, k, a, target,
                                     unitHint(a, own.most, "length", origin)));
    }
    if (const double mass = own.massPerSize * sizeOf<D>(a); !same(disks.mass[k], mass))
      return misfits.add(fmt::format("{} {} of mass {:.4g} kg, not {:.4g} kg{}", word, k,
                                     disks.mass[k], mass,
                                     unitHint(disks.mass[k], mass, "mass", origin)));
  }
}

/// Any of the case's start files may be the one that they began from.
template <int D>
void compareStarts(const DisksOf<D>& disks, const StartFilesOf<D>& starts,
                   const SnapshotOrigin& origin, Misfits& misfits) {
  const auto firstOther = [&](const DisksOf<D>& start) {
    std::size_t k = 0;
    while (k < disks.size() && k < start.size() && same(disks.radius[k], start.radius[k]) &&
           same(disks.mass[k], start.mass[k]) && shapeIndex(disks, k) == shapeIndex(start, k))
      ++k;
    return k;
  };
  std::size_t best = 0, bestFile = 0;
  for (std::size_t f = 0; f < starts.disks.size(); ++f) {
    if (starts.disks[f].size() != disks.size()) continue;
    const std::size_t k = firstOther(starts.disks[f]);
    if (k == disks.size()) return;
    if (k >= best) std::tie(best, bestFile) = std::pair(k, f);
  }
  const DisksOf<D>& target = starts.disks[bestFile];
  misfits.add(
      fmt::format("disk {} of radius {:.4g} m and mass {:.4g} kg, not {:.4g} m and {:.4g} "
                  "kg as in {}{}",
                  best, disks.radius[best], disks.mass[best], target.radius[best],
                  target.mass[best], starts.files[bestFile].filename().string(),
                  unitHint(disks.radius[best], target.radius[best], "length", origin)));
}

void throwIfAny(const Misfits& misfits, const Case& setup, const SnapshotOrigin& origin,
                const std::string& hint = {}) {
  if (!misfits.list().empty())
    throw BadInput(fmt::format("{} does not fit {}: it has {}{}", origin.name, setup.file.string(),
                               fmt::join(misfits.list(), "; "), hint));
}

/// Of an assembly; any start file's number will do.
template <int D>
void compareNumber(std::size_t found, const AssemblyOf<D>& assembly, Misfits& misfits) {
  const auto differs = [&](std::size_t target) {
    if (found != target)
      misfits.add(fmt::format("{}, not {}", counted(found, assembly.anyConvex() ? "body" : "disk"),
                              target));
  };
  if (assembly.starts.disks.empty()) return differs(groupDisks<D>(assembly).size());
  const bool known = std::ranges::any_of(
      assembly.starts.disks, [&](const DisksOf<D>& start) { return start.size() == found; });
  if (!known) differs(assembly.starts.disks.front().size());
}

/// Disks of a file in a Couette cell.
Scene cellAround(const Case& setup, Disks disks, const SnapshotOrigin& origin) {
  Case own = setup;
  couetteIn(own).particles.file = origin.name;  // small and large are known by their radii
  Packing packing;
  packing.disks = std::move(disks);
  return couetteScene(own, packing, 0.0);
}

/// requireFit() of a Couette cell.
void requireCellFit(const Scene& scene, const Snapshot& first, const Case& setup,
                    const SnapshotOrigin& origin) {
  const auto& [cell, particles, filling, times] = couetteIn(setup);
  Misfits misfits;
  if (!packingFile(setup)) compareDisks(scene.disks, particles, misfits);
  compareWalls(scene, first, setup, misfits);
  if (!first.bodies.empty())
    misfits.size("a wheel that turns at", first.bodies.front().angularVelocity, cell.omega,
                 "rad/s");
  comparePlaces(first, cell, misfits);
  const std::string hint =
      packingFile(setup) || scene.disks.size() == 0
          ? ""
          : unitHint(std::ranges::max(scene.disks.radius), particles.largeRadius, "length", origin);
  throwIfAny(misfits, setup, origin, hint);
}

}  // namespace

std::string unitHint(double found, double target, std::string_view key,
                     const SnapshotOrigin& origin) {
  const double power = std::round(std::log10(found / target));
  if (!(std::abs(found / target / std::pow(10.0, power) - 1.0) < 0.3) || power == 0.0) return {};
  const bool length = key == "length";
  const char* const unit = power == 3.0             ? length ? "mm" : "g"
                           : power == 2.0 && length ? "cm"
                           : power == 6.0           ? length ? "µm" : "mg"
                                                    : "another unit";
  std::string hint = fmt::format("; are {} in {}?", length ? "lengths" : "masses", unit);
  if (!origin.settings.empty())
    hint += fmt::format(" say {} = {:g} in {}", key,
                        (length ? origin.length : origin.mass) * std::pow(10.0, -power),
                        origin.settings);
  return hint;
}

template <int D>
double massOf(const Case& setup, std::size_t k, double radius) {
  if (cellOf(setup)) {
    const Particles& p = couetteIn(setup).particles;
    const bool small = std::abs(radius - p.smallRadius) <= std::abs(radius - p.largeRadius);
    return small ? p.smallMass : p.largeMass;
  }
  for (const DisksOf<D>& start : assemblyIn<D>(setup).starts.disks)
    if (k < start.size() && same(start.radius[k], radius)) return start.mass[k];
  for (const DiskGroupOf<D>& group : assemblyIn<D>(setup).disks) {
    if (k < group.count())
      return group.mass * (D == 3 ? radius / group.radius : 1.0) * radius * radius /
             (group.radius * group.radius);
    k -= group.count();
  }
  return NAN;
}
template double massOf<2>(const Case&, std::size_t, double);
template double massOf<3>(const Case&, std::size_t, double);

template <int D>
SceneOf<D> sceneAround(const Case& setup, DisksOf<D> disks, const SnapshotOrigin& origin) {
  if constexpr (D == 2)
    if (cellOf(setup)) return cellAround(setup, std::move(disks), origin);
  Misfits misfits;
  compareNumber<D>(disks.size(), assemblyIn<D>(setup), misfits);
  throwIfAny(misfits, setup, origin);
  return assemblyScene<D>(setup, std::move(disks), 0.0, 0.0);
}
template Scene sceneAround<2>(const Case&, Disks, const SnapshotOrigin&);
template SpaceScene sceneAround<3>(const Case&, DisksOf<3>, const SnapshotOrigin&);

template <int D>
void requireFit(const SceneOf<D>& scene, const SnapshotOf<D>& first, const Case& setup,
                const SnapshotOrigin& origin) {
  if constexpr (D == 2)
    if (cellOf(setup)) return requireCellFit(scene, first, setup, origin);
  Misfits misfits;
  const AssemblyOf<D>& assembly = assemblyIn<D>(setup);
  if (assembly.starts.disks.empty())
    compareGroups<D>(scene.disks, assembly, origin, misfits);
  else
    compareStarts<D>(scene.disks, assembly.starts, origin, misfits);
  throwIfAny(misfits, setup, origin);
}
template void requireFit<2>(const Scene&, const Snapshot&, const Case&, const SnapshotOrigin&);
template void requireFit<3>(const SpaceScene&, const SpaceSnapshot&, const Case&,
                            const SnapshotOrigin&);

}  // namespace crossgrain::inline studies
