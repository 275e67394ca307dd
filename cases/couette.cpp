#include "cases/couette.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "adapters/start_check.hpp"
#include "cases/endpoints.hpp"
#include "cases/flow.hpp"
#include "cases/materials.hpp"
#include "cases/scene_numbers.hpp"
#include "support/bad_input.hpp"

namespace crossgrain::inline cases {

double rotationTime(const Case& setup) {
  return 2.0 * std::numbers::pi / std::abs(couetteIn(setup).cell.omega);
}

void setFlowOfCell(Case& c) {
  Region& region = c.region.emplace();
  region.bins = BinKind::rings;
  const auto& [cell, particles, filling, rotations] = couetteIn(c);
  region.innerRadius = cell.innerRadius;
  region.outerRadius = cell.outerRadius;
  region.count = rotations.rings;
  region.height = cell.height;
  const FlowTimes times = flowTimes(c);
  region.from = times.settled;
  region.snapshots = times.samples;
  c.endpoints.clear();
  for (const Endpoint& endpoint : endpointTable())
    if (c.averaging.endpoints.contains(endpoint.name)) c.endpoints.push_back(endpoint);
}

int wallDiskCount(const Cell& cell, double radius) {
  return static_cast<int>(std::lround(2.0 * std::numbers::pi * radius / cell.wallSpacing));
}

double wallHole(const Cell& cell, double radius, double dilation) {
  const double half = std::numbers::pi / wallDiskCount(cell, radius);
  return 2.0 * dilation * radius * std::sin(half) - 2.0 * cell.wallRadius;
}

WallBody wallRing(const char* name, const Cell& cell, double radius, double angle) {
  WallBody body;
  body.name = name;
  const int count = wallDiskCount(cell, radius);
  for (int k = 0; k < count; ++k) {
    const double phi = angle + 2.0 * std::numbers::pi * k / count;
    body.diskPosition.emplace_back(radius * std::cos(phi), radius * std::sin(phi));
    body.diskRadius.push_back(cell.wallRadius);
  }
  return body;
}

Disks diskKinds(const Particles& particles) {
  Disks disks;
  const auto add = [&](int count, double radius, double mass) {
    for (int k = 0; k < count; ++k) {
      disks.radius.push_back(radius);
      disks.mass.push_back(mass);
      disks.inertia.push_back(particles.inertiaFactor * mass * radius * radius);
    }
  };
  add(particles.small, particles.smallRadius, particles.smallMass);
  add(particles.large, particles.largeRadius, particles.largeMass);
  disks.position.assign(disks.size(), Vec2::Zero());
  disks.velocity.assign(disks.size(), Vec2::Zero());
  disks.spin.assign(disks.size(), 0.0);
  return disks;
}

Disks spreadDisks(const Case& setup) {
  const auto& [cell, particles, filling, times] = couetteIn(setup);
  Disks disks = diskKinds(particles);
  const double clearance = cell.wallRadius + particles.smallRadius;
  const double inner = cell.innerRadius + clearance;
  const double outer = cell.outerRadius - clearance;
  const double goldenAngle = std::numbers::pi * (3.0 - std::sqrt(5.0));
  const auto count = static_cast<double>(disks.size());
  for (std::size_t k = 0; k < disks.size(); ++k) {
    const double fraction = (static_cast<double>(k) + 0.5) / count;
    const double r = std::sqrt(inner * inner + fraction * (outer * outer - inner * inner));
    const double angle = static_cast<double>(k) * goldenAngle;
    disks.position[k] = {r * std::cos(angle), r * std::sin(angle)};
  }
  return disks;
}

Scene couetteScene(const Case& setup, const Packing& packing, double dt) {
  const auto& [cell, particles, filling, times] = couetteIn(setup);
  Scene scene;
  scene.name = setup.name;
  scene.disks = packing.disks;
  scene.law = setup.law;
  scene.bottom = setup.bottom;
  scene.rotation = particles.rotation;
  if (!scene.rotation) std::ranges::fill(scene.disks.spin, 0.0);
  scene.precision = setup.run.precision;
  scene.energyLedger = setup.run.energyLedger;
  scene.dt = dt;
  WallBody wheel = wallRing(wheelName, cell, cell.innerRadius, packing.wheelAngle);
  wheel.motion.kind = Motion::Kind::rotating;
  wheel.motion.angularVelocity = cell.omega;
  scene.bodies.push_back(std::move(wheel));
  scene.bodies.push_back(wallRing(ringName, cell, cell.outerRadius, 0.0));
  addMaterials(scene, setup);
  return scene;
}

namespace {

void checkInCell(const Disks& disks, const Cell& cell, const std::string& where) {
  for (std::size_t i = 0; i < disks.size(); ++i) {
    const double r = disks.position[i].norm();
    if (r <= cell.innerRadius || r >= cell.outerRadius)
      throw BadInput(fmt::format(
          "{}: disk {} at r = {:.4g} m is not between the walls at {:g} m and "
          "{:g} m{}",
          where, i, r, cell.innerRadius, cell.outerRadius,
          1e-3 * r > cell.innerRadius && 1e-3 * r < cell.outerRadius ? "; are lengths in mm?"
                                                                     : ""));
  }
}

/// Whether numbers in mm stand where m are meant: an overlap is gross, nearly all of both radii or
/// more, and there is none where radii, or all lengths of the disks, are a thousandth.
template <int D>
std::string unitHint(const SceneOf<D>& scene, const DeepStartOf<D>& deep, double limit) {
  const DisksOf<D>& disks = scene.disks;
  const double other = deep.j < disks.size() ? disks.radius[deep.j] : disks.radius[deep.i];
  constexpr double gross = 0.97;  // of touching radii in mm it is 0.999
  if (deep.overlap < gross * (disks.radius[deep.i] + other)) return {};
  constexpr double milli = 1e-3;
  SceneOf<D> scaled = scene;
  const auto sound = [&] {
    return !deepStart<D>(scaled, [=](double, double) { return milli * limit; });
  };
  for (double& a : scaled.disks.radius) a *= milli;
  if (sound()) return "; are radii in mm?";
  for (VecOf<D>& x : scaled.disks.position) x *= milli;
  return sound() ? "; are the disks' lengths in mm?" : "";
}

/// Where a sphere has its centre outside of the cylinder that it meets; empty: it is no such start.
template <int D>
std::string outsideCylinder(const SceneOf<D>& scene, const DeepStartOf<D>& deep) {
  std::size_t id = scene.idCount() - scene.cylinderCount();
  for (const WallBodyOf<D>& body : scene.bodies)
    for (const Cylinder& cylinder : body.cylinders) {
      if (id++ != deep.j) continue;
      const double apart = cylinder.radius + deep.overlap - scene.disks.radius[deep.i];
      if (apart < cylinder.radius) return {};
      return fmt::format("lies outside {}: {:.4g} m from its axis, with a radius of {:g} m{}",
                         nameOfId(scene, deep.j), apart, cylinder.radius,
                         apart > 100.0 * cylinder.radius ? "; are lengths in mm?" : "");
    }
  return {};
}

}  // namespace

template <int D>
void checkStart(const SceneOf<D>& scene, const Particles& particles, const std::string& where,
                const Cell* cell, std::span<const int> lines) {
  if (const auto lost = firstNotFinite(scene))
    throw BadInput(fmt::format("{}: the position of disk {} is not finite", where, *lost));
  if (const std::string why = beyondNumbers(scene); !why.empty()) throw BadInput(where + why);
  if constexpr (D == 2)
    if (cell) checkInCell(scene.disks, *cell, where);
  const bool convex = !scene.shapes.empty();
  const auto deep = deepStart<D>(scene, [&](double a, double b) {
    const double thinner = std::min(a, b);
    return particles.maxOverlap *
           (convex ? std::min(particles.smallRadius, thinner) : particles.smallRadius);
  });
  if (!deep) return;
  const auto lineOf = [&](std::size_t id) { return id < lines.size() ? lines[id] : 0; };
  const auto nameOf = [&](std::size_t id) {
    const int line = lineOf(id);
    return nameOfId(scene, id) + (line > 0 ? fmt::format(" (line {})", line) : "");
  };
  // The later of the two lines is the one to go to.
  const int line = std::max(lineOf(deep->i), lineOf(deep->j));
  const std::string place = line > 0 ? fmt::format("{}:{}", where, line) : where;
  const std::string who = fmt::format("{} and {}", nameOf(deep->i), nameOf(deep->j));
  if (deep->sameCentre) throw BadInput(fmt::format("{}: {} have the same centre", place, who));
  if (const std::string why = outsideCylinder(scene, *deep); !why.empty())
    throw BadInput(fmt::format("{}: {} {}", place, nameOf(deep->i), why));
  throw BadInput(fmt::format(
      "{}: {} overlap by {:.3g} m at the start, more than {} = {:g} of {} allows ({:.3g} m){}",
      place, who, deep->overlap, particles.maxOverlapKey, particles.maxOverlap,
      convex ? "the way from the thinner body's centre out of it" : "the small radius",
      deep->allowed, unitHint(scene, *deep, deep->allowed)));
}
template void checkStart<2>(const Scene&, const Particles&, const std::string&, const Cell*,
                            std::span<const int>);
template void checkStart<3>(const SpaceScene&, const Particles&, const std::string&, const Cell*,
                            std::span<const int>);

namespace {

double square(double x) {
  return x * x;
}

/// Areas are in units of π.
double cellArea(const Cell& cell) {
  return square(cell.outerRadius) - square(cell.innerRadius);
}

}  // namespace

double volumeFraction(const Case& c) {
  const Particles& p = couetteIn(c).particles;
  return (p.small * square(p.smallRadius) + p.large * square(p.largeRadius)) /
         cellArea(couetteIn(c).cell);
}

double diskNumber(const Cell& cell, const Particles& particles, double fraction,
                  double largeFraction) {
  const double each = (1.0 - largeFraction) * square(particles.smallRadius) +
                      largeFraction * square(particles.largeRadius);
  return fraction * cellArea(cell) / each;
}

void setNumbers(const Cell& cell, Particles& particles, double fraction, double largeFraction) {
  const double all = diskNumber(cell, particles, fraction, largeFraction);
  particles.large = static_cast<int>(std::lround(largeFraction * all));
  const double left = fraction * cellArea(cell) - particles.large * square(particles.largeRadius);
  const double small = left / square(particles.smallRadius);
  particles.small = largeFraction == 1.0 ? 0 : static_cast<int>(std::lround(std::max(0.0, small)));
}

namespace {

double diameter(const Case& c) {
  return 2.0 * couetteIn(c).particles.smallRadius;
}

double rimSpeed(const Case& c) {
  return couetteIn(c).cell.rimSpeed();
}

double diskDensity(const Case& c) {
  const auto& [cell, particles, filling, times] = couetteIn(c);
  const double area = std::numbers::pi * particles.smallRadius * particles.smallRadius;
  return particles.smallMass / (area * cell.height);
}

// d: diameter of a small disk; D = 2 R_i, as the thesis scales spins (Lätzel 2003, section 6.3).
constexpr std::array<Scale, 8> scaleTable = {{
    {"rim_speed", "m/s", "Ω R_i", rimSpeed},
    {"spin_scale", "rad/s", "Ω D/d, D = 2 R_i",
     [](const Case& c) { return 2.0 * rimSpeed(c) / diameter(c); }},
    {"wheel_rate", "rad/s", "Ω", [](const Case& c) { return std::abs(couetteIn(c).cell.omega); }},
    {"shear_rate", "1/s", "Ω R_i/d", [](const Case& c) { return rimSpeed(c) / diameter(c); }},
    {"diameter", "m", "d", diameter},
    {"rim_pressure", "N/m²", "ρ (Ω R_i)²",
     [](const Case& c) { return diskDensity(c) * rimSpeed(c) * rimSpeed(c); }},
    {"contact_pressure", "N/m²", "k_n/h",
     [](const Case& c) { return c.law.kn / couetteIn(c).cell.height; }},
    {"disk_density", "kg/m³", "ρ of a small disk", diskDensity},
}};

}  // namespace

std::span<const Scale> scales() {
  return scaleTable;
}

double fractionOf(const Scale& scale, double share, const Case& setup) {
  return std::strtod(fmt::format("{:.1e}", share * scale.of(setup)).c_str(), nullptr);
}

}  // namespace crossgrain::inline cases
