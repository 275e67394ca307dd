#include "adapters/scene_limits.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "adapters/effects.hpp"

namespace crossgrain {
namespace {

bool has(const std::vector<Motion::Kind>& kinds, Motion::Kind kind) {
  return std::ranges::find(kinds, kind) != kinds.end();
}

std::string describe(const std::vector<Motion::Kind>& kinds) {
  std::vector<std::string> names;
  for (const Motion::Kind kind : kinds) names.push_back(toString(kind));
  return fmt::format("{}", fmt::join(names, " | "));
}

/// @param first  that every engine has
std::string describe(const std::vector<ShapeKind>& kinds, const char* first) {
  std::string all = first;
  for (const ShapeKind kind : kinds) all += " | " + toString(kind);
  return all;
}

/// The first of a scene that is none of them.
template <int D>
std::optional<double> otherInertia(const SceneLimits& limits, const SceneOf<D>& scene) {
  const DisksOf<D>& disks = scene.disks;
  for (std::size_t k = 0; k < disks.size(); ++k) {
    if (scene.isConvex(k)) continue;
    const double q = disks.inertia[k] / (disks.mass[k] * disks.radius[k] * disks.radius[k]);
    if (!hasInertia(limits, q)) return q;
  }
  return std::nullopt;
}

/// The first that is beyond, of a body's planes; empty: nothing.
template <int D>
std::string beyondOfPlanes(const SceneLimits& limits, const WallBodyOf<D>& body) {
  if (body.planes.empty()) return {};
  const Motion::Kind kind = body.motion.kind;
  if (limits.planeMotions && limits.planeMotions->empty())
    return fmt::format("has no planes, as {} has", body.name);
  if (limits.planeMotions && !has(*limits.planeMotions, kind))
    return fmt::format("has planes that are {}, not {} as those of {} are",
                       describe(*limits.planeMotions), toString(kind), body.name);
  if (!limits.planesAlongAxes) return {};
  for (const PlaneOf<D>& plane : body.planes)
    if ((plane.normal.array() != 0.0).count() > 1) {
      std::vector<std::string> normal;
      for (const double component : plane.normal)
        normal.push_back(fmt::format("{:.6g}", component));
      return fmt::format("has planes along an axis only, not with the normal ({}) of {}",
                         fmt::join(normal, ", "), body.name);
    }
  if (kind == Motion::Kind::rotating)
    return fmt::format("has planes along an axis only, and those of {} turn", body.name);
  return {};
}

/// Whether its cylinders stay where they are: it stands still, or turns about the axis of each.
bool keepsCylinders(const WallBodyOf<3>& body) {
  if (body.motion.kind == MotionKind::fixed) return true;
  constexpr double roundings = 1e-9;
  return body.motion.kind == MotionKind::rotating &&
         std::ranges::all_of(body.cylinders, [&](const Cylinder& cylinder) {
           const Vec3 axis = cylinder.axis.normalized(), &spin = body.motion.angularVelocity;
           return axis.cross(spin).norm() <= roundings * spin.norm() &&
                  axis.cross(body.centre - cylinder.point).norm() <= roundings * cylinder.radius;
         });
}

/// The first that is beyond, of a body's cylinders; empty: nothing.
template <int D>
std::string beyondOfCylinders(const SceneLimits& limits, const WallBodyOf<D>& body) {
  if constexpr (D == 3) {
    if (!body.cylinders.empty() && !limits.cylinders)
      return fmt::format("has no cylinders, as {} has", body.name);
    if (!keepsCylinders(body) && !body.cylinders.empty())
      return fmt::format("has cylinders that stand still or turn about their axis, not as {} does",
                         body.name);
  }
  return {};
}

/// The first shape that is beyond; empty: none.
template <int D>
std::string beyondOfShapes(const SceneLimits& limits, const SceneOf<D>& scene) {
  for (const ShapeOf<D>& shape : scene.shapes) {
    const std::string kind = toString(shape.kind);
    if (std::ranges::find(limits.shapes, shape.kind) == limits.shapes.end())
      return fmt::format("has no {}, as the scene has (its shapes: {})", kind,
                         describe(limits.shapes, D == 2 ? "disk" : "sphere"));
    if (shape.vertices.size() > static_cast<std::size_t>(limits.mostVertices))
      return fmt::format("has {}s of at most {} vertices, not {}", kind, limits.mostVertices,
                         shape.vertices.size());
    if (shape.kind == ShapeKind::polygon && shape.rounding > 0.0 && !limits.rounded)
      return "has polygons with sharp corners, not rounded ones";
  }
  if (!scene.shapes.empty() && scene.law.coheres()) return "has convex bodies without cohesion";
  return {};
}

/// Whether contacts of this scene have several reduced masses.
template <int D>
bool pairsDiffer(const SceneOf<D>& scene) {
  const auto [least, most] = std::ranges::minmax(scene.disks.mass);
  return least != most || scene.idCount() > scene.disks.size();
}

}  // namespace

bool hasInertia(const SceneLimits& limits, double q) {
  constexpr double roundings = 1e-9;  // of J = q m a² and back
  return !limits.inertia || std::ranges::any_of(*limits.inertia, [&](double a) {
    return std::abs(q - a) <= roundings * a;
  });
}

template <int D>
std::vector<std::string> beyondLimits(const SceneLimits& limits, const SceneOf<D>& scene,
                                      bool softLawStoodFor) {
  std::vector<std::string> reasons;
  if (effectsOf(scene).contains(Effect::rotation))
    if (const auto q = otherInertia(limits, scene))
      reasons.push_back(fmt::format("has moments of inertia of {} m a², not {:.6g} m a²",
                                    fmt::join(*limits.inertia, " | "), *q));
  if (std::string why = beyondOfShapes(limits, scene); !why.empty())
    reasons.push_back(std::move(why));
  for (const auto& body : scene.bodies) {
    const std::string kind = toString(body.motion.kind);
    if (limits.wallMotions && !body.diskRadius.empty() &&
        !has(*limits.wallMotions, body.motion.kind))
      reasons.push_back(fmt::format("has walls that are {}, not {} as {} is",
                                    describe(*limits.wallMotions), kind, body.name));
    for (std::string why : {beyondOfPlanes(limits, body), beyondOfCylinders(limits, body)})
      if (!why.empty()) reasons.push_back(std::move(why));
  }
  if (limits.restitutionPerBody && softLawStoodFor && scene.law.gn > 0.0 &&
      !scene.disks.mass.empty() && pairsDiffer(scene))
    reasons.emplace_back(
        "has one restitution for each body, and the soft law gives this scene's pairs several");
  return reasons;
}

template std::vector<std::string> beyondLimits<2>(const SceneLimits&, const Scene&, bool);
template std::vector<std::string> beyondLimits<3>(const SceneLimits&, const SpaceScene&, bool);

std::string beyondSinglePrecision(const Scene& scene) {
  // Squares of these, and products of a mass with one of them, are within 10^±38.
  constexpr double farthest = 1e15, lightest = 1e-30, heaviest = 1e20;
  const Disks& disks = scene.disks;
  if (disks.size() == 0) return {};
  const double unit = *std::ranges::min_element(disks.radius);
  const auto beyond = [](const std::string& what, double value, const char* symbol, double least,
                         double most) {
    return fmt::format(
        "works in single precision, which needs {} between {:.3g} and {:.3g} {}, not {:.6g}", what,
        least, most, symbol, value);
  };
  for (std::size_t k = 0; k < disks.size(); ++k) {
    const std::string of = fmt::format(" of disk {}", k);
    const double m = disks.mass[k], j = disks.inertia[k], square = unit * unit;
    if (!(m >= lightest && m <= heaviest))
      return beyond("the mass" + of, m, "kg", lightest, heaviest);
    if (!(j >= square * lightest && j <= square * heaviest))
      return beyond("the moment of inertia" + of, j, "kg m²", square * lightest, square * heaviest);
    const double lengths[] = {disks.radius[k], disks.position[k].x(), disks.position[k].y(),
                              disks.velocity[k].x(), disks.velocity[k].y()};
    const char* const names[] = {"the radius", "x", "y", "v_x", "v_y"};
    for (int n = 0; n < 5; ++n)
      if (!(std::abs(lengths[n]) <= farthest * unit))
        return beyond(names[n] + of, lengths[n], n < 3 ? "m" : "m/s", -farthest * unit,
                      farthest * unit);
    if (!(std::abs(disks.spin[k]) <= farthest))
      return beyond("the spin" + of, disks.spin[k], "rad/s", -farthest, farthest);
  }
  if (!(scene.gravity.norm() <= farthest * unit))
    return beyond("gravity", scene.gravity.norm(), "m/s²", 0.0, farthest * unit);
  return {};
}

}  // namespace crossgrain
