#include "cases/larger_scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "adapters/engine.hpp"
#include "cases/couette.hpp"
#include "cases/flow.hpp"
#include "cases/scaled_cell.hpp"

namespace crossgrain::inline cases {
namespace {

/// A direction that copies can be placed along.
struct Direction {
  int axis;
  double length;  ///< from one copy to the next [m]
};

/// Names what lies across an axis, so that no copy can stand along it; empty: nothing does.
template <int D>
std::string obstacleAlong(const SceneOf<D>& scene, int axis) {
  constexpr double aslant = 1e-12;
  const bool periodic = scene.box && scene.box->periodic[static_cast<std::size_t>(axis)];
  if (!periodic && scene.gravity[axis] != 0.0) return "gravity";
  for (const WallBodyOf<D>& body : scene.bodies) {
    const auto kind = body.motion.kind;
    const bool turns = kind == MotionKind::rotating;
    if (turns && !body.planes.empty())
      return fmt::format("a plane of \"{}\" that turns", body.name);
    for (const PlaneOf<D>& plane : body.planes)
      if (std::abs(plane.normal[axis]) > aslant) return fmt::format("a plane of \"{}\"", body.name);
    for (const Cylinder& cylinder : body.cylinders)
      if (std::abs(std::abs(cylinder.axis[axis]) - 1.0) > aslant)
        return fmt::format("a cylinder of \"{}\"", body.name);
  }
  return {};
}

/// From one copy to the next: the box's length, else room for all bodies and the largest more.
template <int D>
double lengthAlong(const SceneOf<D>& scene, int axis) {
  if (scene.box && scene.box->periodic[static_cast<std::size_t>(axis)])
    return scene.box->high[axis] - scene.box->low[axis];
  double low = std::numeric_limits<double>::infinity(), high = -low, largest = 0.0;
  const auto extend = [&](const VecOf<D>& place, double radius) {
    low = std::min(low, place[axis] - radius);
    high = std::max(high, place[axis] + radius);
    largest = std::max(largest, radius);
  };
  for (std::size_t k = 0; k < scene.disks.size(); ++k)
    extend(scene.disks.position[k], scene.disks.radius[k]);
  for (const WallBodyOf<D>& body : scene.bodies)
    for (std::size_t k = 0; k < body.diskPosition.size(); ++k)
      extend(body.diskPosition[k], body.diskRadius[k]);
  return high - low + 2.0 * largest;
}

/// Periodic directions alone where there is one: along others nothing keeps copies together.
template <int D>
std::vector<Direction> directionsOf(const SceneOf<D>& scene) {
  std::vector<Direction> periodic, free;
  std::vector<std::string> obstacles;
  for (int axis = 0; axis < D; ++axis) {
    const std::string obstacle = obstacleAlong(scene, axis);
    if (!obstacle.empty())
      obstacles.push_back(fmt::format("{} lies across {}", obstacle, "xyz"[axis]));
    else if (scene.box && scene.box->periodic[static_cast<std::size_t>(axis)])
      periodic.push_back({axis, lengthAlong(scene, axis)});
    else
      free.push_back({axis, lengthAlong(scene, axis)});
  }
  if (periodic.empty() && free.empty())
    throw UnsupportedScene(
        fmt::format("the scene cannot be made larger: {}", fmt::join(obstacles, ", ")));
  return periodic.empty() ? free : periodic;
}

template <class T>
void repeat(std::vector<T>& values, std::size_t copies) {
  const std::size_t once = values.size();
  for (std::size_t k = once; k < once * copies; ++k) values.push_back(values[k - once]);
}

/// The same once more at every multiple of the shift.
template <int D>
void repeatShifted(std::vector<VecOf<D>>& places, std::size_t copies, const VecOf<D>& shift) {
  const std::size_t once = places.size();
  repeat(places, copies);
  for (std::size_t k = once; k < places.size(); ++k)
    places[k] += static_cast<double>(k / once) * shift;
}

template <int D>
void repeatAlong(SceneOf<D>& scene, const Direction& along, std::size_t copies) {
  VecOf<D> shift = VecOf<D>::Zero();
  shift[along.axis] = along.length;
  DisksOf<D>& disks = scene.disks;
  const std::size_t once = disks.size();
  disks.forEachList([&](auto& list) { repeat(list, copies); });
  for (std::size_t k = once; k < disks.size(); ++k)
    disks.position[k] += static_cast<double>(k / once) * shift;
  if (scene.materials) repeat(scene.materials->ofDisk, copies);
  const std::size_t bodies = scene.bodies.size();
  for (std::size_t b = 0; b < bodies; ++b) {
    const bool aboutCentre = scene.bodies[b].motion.kind == MotionKind::rotating ||
                             scene.bodies[b].motion.kind == MotionKind::radial;
    if (!aboutCentre) {
      repeatShifted<D>(scene.bodies[b].diskPosition, copies, shift);
      repeat(scene.bodies[b].diskRadius, copies);
      continue;
    }
    for (std::size_t copy = 1; copy < copies && !scene.bodies[b].diskPosition.empty(); ++copy) {
      WallBodyOf<D> other = scene.bodies[b];
      const VecOf<D> by = static_cast<double>(copy) * shift;
      other.name += fmt::format(" {}", copy + 1);
      other.centre += by;
      for (VecOf<D>& place : other.diskPosition) place += by;
      other.planes.clear();
      other.cylinders.clear();
      scene.bodies.push_back(std::move(other));
      if (scene.materials) scene.materials->ofBody.push_back(scene.materials->ofBody[b]);
    }
  }
  if (scene.box && scene.box->periodic[static_cast<std::size_t>(along.axis)])
    scene.box->high[along.axis] += static_cast<double>(copies - 1) * along.length;
}

}  // namespace

template <int D>
SceneOf<D> besideItself(const SceneOf<D>& scene, std::size_t copies) {
  SceneOf<D> larger = scene;
  if (copies < 2) return larger;
  std::vector<Direction> directions = directionsOf(scene);
  for (std::size_t factor = 2; copies > 1; ++factor)  // prime factors, each along the shortest
    while (copies % factor == 0) {
      Direction& along = *std::ranges::min_element(directions, {}, &Direction::length);
      repeatAlong(larger, along, factor);
      along.length *= static_cast<double>(factor);
      copies /= factor;
    }
  return larger;
}
template Scene besideItself(const Scene&, std::size_t);
template SpaceScene besideItself(const SpaceScene&, std::size_t);

template <int D>
SceneOf<D> largerFlow(const Case& setup, const Packing& state, double dt, std::size_t bodies,
                      const std::filesystem::path& folder,
                      const std::function<void(double)>& progress) {
  SceneOf<D> own = flowScene<D>(setup, state, dt);
  if (bodies <= own.disks.size()) return own;
  if constexpr (D == 2)
    if (canBeScaled(setup)) {
      const Case scaled = scaledCase(setup, bodies);
      return couetteScene(scaled, scaledPacking(scaled, folder, progress), dt);
    }
  const auto copies =
      std::llround(static_cast<double>(bodies) / static_cast<double>(own.disks.size()));
  return besideItself(own, static_cast<std::size_t>(copies));
}
template Scene largerFlow(const Case&, const Packing&, double, std::size_t,
                          const std::filesystem::path&, const std::function<void(double)>&);
template SpaceScene largerFlow(const Case&, const Packing&, double, std::size_t,
                               const std::filesystem::path&, const std::function<void(double)>&);

}  // namespace crossgrain::inline cases
