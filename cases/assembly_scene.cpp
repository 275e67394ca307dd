#include "cases/assembly_scene.hpp"

#include <fmt/format.h>
#include <gsl/gsl_randist.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "cases/couette.hpp"
#include "cases/materials.hpp"
#include "cases/time_step.hpp"
#include "support/bad_input.hpp"
#include "support/random.hpp"

namespace crossgrain::inline cases {

namespace {

/// Nothing is drawn where nothing is to vary, so that other groups stay as they are.
double within(gsl_rng* random, double half) {
  return half > 0.0 ? gsl_ran_flat(random, -half, half) : 0.0;
}

double normal(gsl_rng* random, double rms) {
  return rms > 0.0 ? gsl_ran_gaussian(random, rms) : 0.0;
}

/// Each coordinate anew, one after the other.
template <int D>
VecOf<D> each(auto&& draw) {
  VecOf<D> drawn;
  for (int k = 0; k < D; ++k) drawn[k] = draw();
  return drawn;
}

/// Where the assembly is placed as a whole. In space it stays.
template <int D>
VecOf<D> placedAt(const AssemblyOf<D>& assembly, const VecOf<D>& point) {
  if constexpr (D == 2)
    return assembly.placement.offset + assembly.placement.turned(point);
  else
    return point;
}

template <int D>
VecOf<D> turned(const AssemblyOf<D>& assembly, const VecOf<D>& direction) {
  if constexpr (D == 2)
    return assembly.placement.turned(direction);
  else
    return direction;
}

template <int D>
VecOf<D> movingAt(const AssemblyOf<D>& assembly, const VecOf<D>& velocity) {
  if constexpr (D == 2)
    return assembly.placement.boost + assembly.placement.turned(velocity);
  else
    return velocity;
}

template <int D>
SpinOf<D> spinningAt(const AssemblyOf<D>& assembly, const SpinOf<D>& spin) {
  if (!assembly.rotation) return noSpin<D>();
  return assembly.placement.mirror ? -spin : spin;
}

/// All places of a group, or so many of them, drawn without repeats.
template <int D>
std::vector<VecOf<D>> placesOf(const DiskGroupOf<D>& group, gsl_rng* random) {
  if (group.choose == 0) return group.places;
  std::vector<std::size_t> all(group.places.size()), chosen(group.count());
  std::iota(all.begin(), all.end(), 0);
  gsl_ran_choose(random, chosen.data(), chosen.size(), all.data(), all.size(), sizeof(std::size_t));
  std::vector<VecOf<D>> places;
  for (const std::size_t k : chosen) places.push_back(group.places[k]);
  return places;
}

/// An orientation, each as likely (Shoemake, Graphics Gems III (1992) 124).
template <int D>
TurnOf<D> anyTurn(gsl_rng* random) {
  const auto angle = [&] { return gsl_ran_flat(random, 0.0, 2.0 * std::numbers::pi); };
  if constexpr (D == 2) {
    return angle();
  } else {
    const double share = gsl_rng_uniform(random), a = angle(), b = angle();
    const double s = std::sqrt(1.0 - share), c = std::sqrt(share);
    return {c * std::cos(b), s * std::sin(a), s * std::cos(a), c * std::sin(b)};
  }
}

/// Mirrored at the y axis, as the assembly is.
template <int D>
ShapeOf<D> placedShape(const AssemblyOf<D>& assembly, ShapeOf<D> shape) {
  if (!assembly.placement.mirror) return shape;
  for (VecOf<D>& vertex : shape.vertices) vertex[0] *= -1.0;
  std::ranges::reverse(shape.vertices);
  return shape;
}

template <int D>
TurnOf<D> placedTurn(const AssemblyOf<D>& assembly, const TurnOf<D>& turn) {
  if constexpr (D == 2)
    return assembly.placement.turn + (assembly.placement.mirror ? -turn : turn);
  else
    return turn;
}

/// @param shape  the group's, among those of the scene; −1 of disks
template <int D>
void addDisks(DisksOf<D>& disks, const DiskGroupOf<D>& group, const AssemblyOf<D>& assembly,
              std::int32_t shape, gsl_rng* random) {
  for (const VecOf<D>& place : placesOf(group, random)) {
    const double scale = 1.0 + within(random, group.radiusSpread);
    const VecOf<D> jitter = each<D>([&] { return within(random, group.jitter); });
    const VecOf<D> extra = each<D>([&] { return normal(random, group.velocityRms); });
    const double radius = group.radius * scale;
    double mass = group.mass * scale * scale;
    if (D == 3) mass *= scale;
    const VecOf<D> position = group.position + group.pitch().cwiseProduct(place + jitter);
    disks.radius.push_back(radius);
    disks.mass.push_back(mass);
    disks.inertia.push_back(assembly.inertiaFactor * mass * radius * radius);
    disks.position.push_back(placedAt(assembly, position));
    disks.velocity.push_back(movingAt<D>(assembly, group.velocity + extra));
    disks.spin.push_back(spinningAt(assembly, group.spin));
    if (!assembly.anyConvex()) continue;
    disks.shape.push_back(shape);
    const TurnOf<D> turn = group.randomTurn ? anyTurn<D>(random) : group.turn;
    disks.turn.push_back(placedTurn(assembly, turn));
    const bool round = shape < 0;
    if (!round) disks.inertia.back() = D == 2 ? group.moments.z() : group.moments.mean();
    if (D == 3)
      disks.moments.push_back(round ? Vec3(Vec3::Constant(disks.inertia.back())) : group.moments);
  }
}

/// Walls that move in any other way cannot be boosted: the loader says so.
template <int D>
MotionOf<D> movedAlong(MotionOf<D> motion, const AssemblyOf<D>& assembly) {
  motion.velocity = turned(assembly, motion.velocity);
  motion.amplitude = turned(assembly, motion.amplitude);
  if (assembly.placement.mirror) motion.angularVelocity = -motion.angularVelocity;
  if (assembly.placement.boost.isZero(0.0)) return motion;
  motion.kind = MotionKind::translating;
  if constexpr (D == 2) motion.velocity += assembly.placement.boost;
  return motion;
}

template <int D>
WallBodyOf<D> bodyOf(const WallGroupOf<D>& group, const AssemblyOf<D>& assembly,
                     std::size_t index) {
  WallBodyOf<D> body;
  body.name = fmt::format("wall-{}", index);
  body.centre = placedAt(assembly, group.centre);
  for (const PlaneOf<D>& plane : group.planes)
    body.planes.push_back({placedAt(assembly, plane.point), turned(assembly, plane.normal)});
  for (const VecOf<D>& position : group.position)
    body.diskPosition.push_back(placedAt(assembly, position));
  body.diskRadius = group.radii;
  if (group.radii.empty()) body.diskRadius.assign(group.position.size(), group.radius);
  body.motion = movedAlong(group.motion, assembly);
  body.cylinders = group.cylinders;  // nothing turns or shifts an assembly in space
  return body;
}

/// The body as a start that is so far along [s].
template <int D>
void moveOn(WallBodyOf<D>& body, double time) {
  if (time == 0.0) return;
  const BodyStateOf<D> now = stateAt(body.motion, body.centre, time);
  for (VecOf<D>& position : body.diskPosition)
    position = memberPosition<D>(now, body.centre, position);
  for (PlaneOf<D>& plane : body.planes) plane = planeAt<D>(now, body.centre, plane);
  body.centre = now.centre;
}

/// A file's disks, placed as the assembly is, with this packing's velocities.
template <int D>
DisksOf<D> placed(DisksOf<D> disks, const AssemblyOf<D>& assembly, gsl_rng* random) {
  for (std::size_t i = 0; i < disks.size(); ++i) {
    const VecOf<D> extra = each<D>([&] { return normal(random, assembly.starts.velocityRms); });
    disks.position[i] = placedAt(assembly, disks.position[i]);
    disks.velocity[i] = movingAt<D>(assembly, disks.velocity[i] + extra);
    disks.spin[i] = spinningAt(assembly, disks.spin[i]);
    if (!disks.areRound()) disks.turn[i] = placedTurn(assembly, disks.turn[i]);
  }
  return disks;
}

/// @throws BadInput for a command that does not know the case's dimension
template <int D>
void requireDimension(const Case& setup) {
  if (setup.dimension == D) return;
  throw BadInput(
      fmt::format("{}: only compare, plan, lockstep and check run assemblies in space "
                  "(case.dimension = 3)",
                  setup.file.string()));
}

}  // namespace

template <int D>
DisksOf<D> assemblyDisks(const Case& setup, int packing) {
  requireDimension<D>(setup);
  const AssemblyOf<D>& assembly = assemblyIn<D>(setup);
  const Random random = randomStream(assembly.seed, static_cast<std::uint64_t>(packing));
  const auto& starts = assembly.starts.disks;
  if (!starts.empty())
    return placed(starts[static_cast<std::size_t>(packing) % starts.size()], assembly,
                  random.get());
  DisksOf<D> disks;
  std::int32_t shapes = 0;
  for (const DiskGroupOf<D>& group : assembly.disks)
    addDisks(disks, group, assembly, group.shape ? shapes++ : -1, random.get());
  return disks;
}
template Disks assemblyDisks<2>(const Case&, int);
template DisksOf<3> assemblyDisks<3>(const Case&, int);

template <int D>
SceneOf<D> assemblyScene(const Case& setup, DisksOf<D> disks, double wallTime, double dt) {
  requireDimension<D>(setup);
  const AssemblyOf<D>& assembly = assemblyIn<D>(setup);
  SceneOf<D> scene;
  scene.name = setup.variant.empty() ? setup.name : setup.name + " " + setup.variant;
  scene.law = setup.law;
  scene.bottom = setup.bottom;
  scene.box = assembly.box;
  scene.gravity = turned(assembly, assembly.gravity);
  scene.rotation = assembly.rotation;
  scene.precision = setup.run.precision;
  scene.dt = dt;
  scene.energyLedger = setup.run.energyLedger;
  scene.disks = std::move(disks);
  for (const DiskGroupOf<D>& group : assembly.disks)
    if (group.shape) scene.shapes.push_back(placedShape(assembly, *group.shape));
  for (const ShapeOf<D>& shape : assembly.starts.shapes)
    scene.shapes.push_back(placedShape(assembly, shape));
  for (const WallGroupOf<D>& group : assembly.walls) {
    scene.bodies.push_back(bodyOf(group, assembly, scene.bodies.size()));
    moveOn(scene.bodies.back(), wallTime);
  }
  addMaterials(scene, setup);
  return scene;
}
template Scene assemblyScene<2>(const Case&, Disks, double, double);
template SpaceScene assemblyScene<3>(const Case&, DisksOf<3>, double, double);

namespace {

template <int D>
Particles limitsOf(const Case& setup, const SceneOf<D>& scene) {
  Particles limits;
  limits.smallRadius = std::ranges::min(scene.disks.radius);
  limits.maxOverlap = assemblyIn<D>(setup).maxOverlap;
  limits.maxOverlapKey = "assembly.max_overlap";
  return limits;
}

}  // namespace

template <int D>
void checkAssemblyStart(const Case& setup, const SceneOf<D>& scene) {
  checkStart(scene, limitsOf(setup, scene), setup.file.string());
}
template void checkAssemblyStart<2>(const Case&, const Scene&);
template void checkAssemblyStart<3>(const Case&, const SpaceScene&);

template <int D>
void checkStartFiles(const Case& setup) {
  const StartFilesOf<D>& starts = assemblyIn<D>(setup).starts;
  for (std::size_t k = 0; k < starts.files.size(); ++k) {
    const SceneOf<D> scene =
        assemblyScene<D>(setup, assemblyDisks<D>(setup, static_cast<int>(k)), 0.0, timeStep(setup));
    std::vector<int> lines = starts.lines[k];
    if (!lines.empty())  // fixed disks are the last body of the walls
      lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(scene.disks.size()),
                   scene.wallDiskCount() - starts.fixedRadius.size(), 0);
    checkStart(scene, limitsOf(setup, scene), starts.files[k].string(), nullptr, lines);
  }
}
template void checkStartFiles<2>(const Case&);
template void checkStartFiles<3>(const Case&);

template <int D>
SceneOf<D> assemblyScene(const Case& setup) {
  SceneOf<D> scene = assemblyScene<D>(setup, assemblyDisks<D>(setup, 0), 0.0, timeStep(setup));
  checkAssemblyStart(setup, scene);
  return scene;
}
template Scene assemblyScene<2>(const Case&);
template SpaceScene assemblyScene<3>(const Case&);

double assemblyDuration(const Case& setup) {
  return withAssembly(setup, [&](const auto& assembly) {
    if (assembly.duration) return *assembly.duration;
    if (assembly.steps) return *assembly.steps * timeStep(setup);
    return *assembly.contactTimes * shortestContact(setup);
  });
}

std::vector<Vec2> gridPlaces(int columns, int rows, const Vec2& spacing, bool triangular) {
  std::vector<Vec2> places;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const double shift = triangular && row % 2 == 1 ? 0.5 : 0.0;
      places.emplace_back((column + shift) * spacing.x(), row * spacing.y());
    }
  return places;
}

std::vector<Vec2> heapPlaces(int base, double spacing) {
  std::vector<Vec2> places;
  for (int row = 0; row < base; ++row)
    for (int column = 0; column < base - row; ++column)
      places.emplace_back((column + 0.5 * row) * spacing, row * spacing * std::sqrt(0.75));
  return places;
}

std::vector<Vec3> latticePlaces(const std::array<int, 3>& counts, const Vec3& spacing,
                                bool closePacked) {
  std::vector<Vec3> places;
  for (int layer = 0; layer < counts[2]; ++layer) {
    const Vec2 hollow = closePacked && layer % 2 == 1 ? Vec2(0.5 * spacing.x(), spacing.y() / 3.0)
                                                      : Vec2(Vec2::Zero());
    for (const Vec2& place : gridPlaces(counts[0], counts[1], spacing.head<2>(), closePacked))
      places.emplace_back(place.x() + hollow.x(), place.y() + hollow.y(), layer * spacing.z());
  }
  return places;
}

std::vector<Vec3> circlePlaces(double inner, double outer, double spacing, int layers,
                               double rise) {
  constexpr double roundings = 1e-9;
  std::vector<Vec3> places;
  for (int layer = 0; layer < layers; ++layer)
    for (double r = inner; r <= outer * (1.0 + roundings); r += spacing) {
      // Neighbours on a circle are a chord apart: 2 r sin(π/n) ≥ spacing.
      const double half = 0.5 * spacing / std::max(r, 0.5 * spacing);
      const auto count =
          r < 0.5 * spacing ? 1.0 : std::floor(std::numbers::pi / std::asin(half) + roundings);
      for (double k = 0.0; k < count; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / count;
        places.emplace_back(r * std::cos(angle), r * std::sin(angle), layer * rise);
      }
    }
  return places;
}

}  // namespace crossgrain::inline cases
