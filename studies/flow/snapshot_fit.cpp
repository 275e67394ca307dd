#include "studies/flow/snapshot_fit.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "adapters/audit.hpp"
#include "cases/couette.hpp"
#include "support/bad_input.hpp"

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
  void number(const char* what, std::size_t found, std::size_t target) {
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
  const double radii[] = {setup.cell.innerRadius, setup.cell.outerRadius};
  const char* const names[] = {wheelName, ringName};
  std::size_t at = 0;
  for (std::size_t b = 0; b < 2; ++b) {
    const std::vector<double>& disks = scene.bodies[b].diskRadius;
    if (disks.empty()) continue;
    const WallBody target = wallRing(names[b], setup.cell, radii[b], 0.0);
    misfits.number(b == 0 ? "wall disks of the wheel" : "wall disks of the ring", disks.size(),
                   target.diskRadius.size());
    misfits.size(fmt::format("the {}'s wall disks' radius", names[b]), disks.front(),
                 setup.cell.wallRadius, "m");
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

}  // namespace

void requireFit(const SnapshotReader& reader, const Case& setup) {
  const Scene& scene = reader.scene();
  const Snapshot first = reader.read(0);
  Misfits misfits;
  if (!setup.particles.file) compareDisks(scene.disks, setup.particles, misfits);
  compareWalls(scene, first, setup, misfits);
  if (reader.tellsMotion(0))
    misfits.size("a wheel that turns at", first.bodies.front().angularVelocity, setup.cell.omega,
                 "rad/s");
  comparePlaces(first, setup.cell, misfits);
  if (!misfits.list().empty())
    throw BadInput(fmt::format("{} does not fit {}: it has {}", reader.file().string(),
                               setup.file.string(), fmt::join(misfits.list(), "; ")));
}

void requireSound(const SnapshotReader& reader, const Case& setup) {
  // What the file says of places; the case says the rest.
  Scene scene = reader.scene();
  const Snapshot first = reader.read(0);
  scene.disks.position = first.position;
  scene.disks.velocity = first.velocity;
  auto place = first.wallPosition.begin();
  for (WallBody& body : scene.bodies)
    for (std::size_t k = 0; k < body.diskRadius.size(); ++k) body.diskPosition.push_back(*place++);
  AuditBasis basis = auditBasis(scene);
  basis.byOverlap = setup.law.soft();
  for (std::size_t k = 0; k < reader.count(); ++k) {
    Snapshot snapshot = reader.read(k);
    // Where walls were when the contacts were is not said.
    if (snapshot.contactTime != snapshot.positionTime && !reader.tellsMotion(k))
      snapshot.contacts.reset();
    if (const std::string why = auditFault(snapshot, basis); !why.empty())
      throw BadInput(fmt::format("{}, snapshot {}: {}", reader.file().string(), k, why));
  }
}

}  // namespace crossgrain::inline studies
