#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

#include "adapters/audit_geometry.hpp"
#include "adapters/suitability.hpp"

namespace crossgrain {
namespace {

/// Fastest that a body's motion moves any of its members [m/s].
template <int D>
double fastestOf(const WallBodyOf<D>& body) {
  double arm = 0.0;
  for (const VecOf<D>& place : body.diskPosition) arm = std::max(arm, (place - body.centre).norm());
  for (const PlaneOf<D>& plane : body.planes)
    arm = std::max(arm, (plane.point - body.centre).norm());
  for (const Cylinder& cylinder : body.cylinders) arm = std::max(arm, cylinder.radius);
  const MotionOf<D>& motion = body.motion;
  switch (motion.kind) {
    case MotionKind::fixed:
      return 0.0;
    case MotionKind::rotating:
      return sizeOf(motion.angularVelocity) * arm;
    case MotionKind::translating:
      return motion.velocity.norm();
    case MotionKind::oscillating:
      return std::abs(motion.frequency) * motion.amplitude.norm();
    case MotionKind::radial:
      return std::abs(motion.radialVelocity);
  }
  return 0.0;
}

template <int D>
void measurePlaces(const SceneOf<D>& scene, AuditBasisOf<D>& basis) {
  std::vector<VecOf<D>> places = scene.disks.position;
  for (const WallBodyOf<D>& body : scene.bodies) {
    places.insert(places.end(), body.diskPosition.begin(), body.diskPosition.end());
    for (const PlaneOf<D>& plane : body.planes) places.push_back(plane.point);
    if constexpr (D == 3)
      for (const Cylinder& cylinder : body.cylinders)
        for (const double radius : {-cylinder.radius, cylinder.radius})
          places.emplace_back(cylinder.point + Vec3::Constant(radius));
  }
  if (places.empty()) return;
  VecOf<D> low = places.front(), high = places.front();
  for (const VecOf<D>& place : places) {
    low = low.cwiseMin(place);
    high = high.cwiseMax(place);
  }
  const double largest =
      basis.radius.empty() ? 0.0 : *std::max_element(basis.radius.begin(), basis.radius.end());
  basis.middle = 0.5 * (low + high);
  basis.extent = 0.5 * (high - low).norm() + largest;
  basis.farthest = basis.middle.norm() + basis.extent;
}

constexpr double stepTolerance = 0.01;  // of a step
constexpr double wallTolerance = 1e-6;  // of the scene's extent, besides rounding

/// Negated so that a NaN is off.
bool within(double distance, double limit) {
  return std::abs(distance) <= limit;
}

template <int D>
std::string listed(const SpinOf<D>& angle) {
  if constexpr (D == 2)
    return fmt::format("{:.6g}", angle);
  else
    return fmt::format("({:.6g})", fmt::join(angle, ", "));
}

template <int D>
std::string wallFault(const SnapshotOf<D>& snapshot, const AuditBasisOf<D>& basis) {
  const SceneOf<D>& scene = *basis.scene;
  const auto apart = [&](VecOf<D> difference) {  // of the nearest images
    return (scene.box ? scene.box->nearest(difference) : difference).norm();
  };
  const double limit = wallTolerance * basis.extent + basis.rounding * basis.farthest;
  std::size_t k = 0;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const WallBodyOf<D>& body = scene.bodies[b];
    const BodyStateOf<D> state = stateAt(body.motion, body.centre, snapshot.positionTime);
    const BodySnapshotOf<D>& shown = snapshot.bodies[b];
    const double angle = sizeOf(state.angle);
    if (!within(sizeOf(SpinOf<D>(shown.angle - state.angle)), wallTolerance * std::max(1.0, angle)))
      return fmt::format("body {} has turned by {} rad, not by {} rad as prescribed", body.name,
                         listed<D>(shown.angle), listed<D>(state.angle));
    if (!within(apart(shown.centre - state.centre), limit))
      return fmt::format("body {} has its centre at ({:.6g}) m, not at ({:.6g}) m", body.name,
                         fmt::join(shown.centre, ", "), fmt::join(state.centre, ", "));
    for (const VecOf<D>& start : body.diskPosition) {
      const VecOf<D> place = memberPosition<D>(state, body.centre, start);
      const VecOf<D>& found = snapshot.wallPosition[k];
      if (!within(apart(found - place), limit))
        return fmt::format("{} is at ({:.6g}) m, not at ({:.6g}) m as prescribed",
                           nameOfId(scene, scene.disks.size() + k), fmt::join(found, ", "),
                           fmt::join(place, ", "));
      ++k;
    }
  }
  return {};
}

}  // namespace

template <int D>
AuditBasisOf<D> auditBasis(const SceneOf<D>& scene) {
  AuditBasisOf<D> basis;
  basis.scene = &scene;
  basis.prescribed = false;
  basis.rounding = 1e-6;
  basis.radius = scene.radii();
  basis.mass = std::accumulate(scene.disks.mass.begin(), scene.disks.mass.end(), 0.0);
  for (const WallBodyOf<D>& body : scene.bodies)
    basis.fastest = std::max(basis.fastest, fastestOf(body));
  for (std::size_t i = 0; i < scene.disks.size(); ++i)
    basis.fastest = std::max(basis.fastest, scene.disks.velocity[i].norm());
  measurePlaces(scene, basis);
  return basis;
}

template <int D>
AuditBasisOf<D> auditBasis(const SceneOf<D>& scene, const Capabilities& can,
                           const EffectiveParameters& effective) {
  AuditBasisOf<D> basis = auditBasis(scene);
  basis.dt = effective.dt;
  basis.byOverlap = scene.law.soft() && hasNormalLaw(can, scene.law);
  basis.prescribed = true;
  basis.rounding = effective.precision == toString(Precision::float32) ? 1e-6 : 1e-10;
  return basis;
}

template <int D>
std::string timeFault(const SnapshotOf<D>& snapshot, const AuditBasisOf<D>& basis,
                      std::optional<double> reached) {
  const double now = snapshot.positionTime, dt = basis.dt;
  if (!(now >= 0.0)) return fmt::format("positions are of t = {:g} s, before the start", now);
  if (!(snapshot.contactInterval >= 0.0))
    return fmt::format("contacts are means over {:g} s, which is no interval",
                       snapshot.contactInterval);
  if (!(dt > 0.0)) return {};
  const double steps = now / dt;
  if (!within(steps - std::round(steps), stepTolerance))
    return fmt::format("positions are of t = {:.9g} s, {:.3f} steps of {:g} s: not a whole number",
                       now, steps, dt);
  if (reached && !within(now - *reached, stepTolerance * dt))
    return fmt::format("positions are of t = {:.9g} s, not of {:.9g} s that advance reached", now,
                       *reached);
  for (const auto& [what, time] :
       {std::pair("velocities", snapshot.velocityTime), {"contacts", snapshot.contactTime}})
    if (!within(time - now, (1.0 + stepTolerance) * dt))
      return fmt::format(
          "{} are of t = {:.9g} s, more than a step of {:g} s from positions of "
          "{:.9g} s",
          what, time, dt, now);
  if (!within(snapshot.contactInterval, now + (1.0 + stepTolerance) * dt))
    return fmt::format("contacts are means over {:g} s, longer than the {:g} s since the start",
                       snapshot.contactInterval, now);
  return {};
}

template <int D>
std::string positionFault(const SnapshotOf<D>& snapshot, const AuditBasisOf<D>& basis) {
  const SceneOf<D>& scene = *basis.scene;
  const double t = snapshot.positionTime;
  const double fastest = 10.0 * basis.fastest;
  const double reach = 100.0 * basis.extent + fastest * t + 5.0 * scene.gravity.norm() * t * t;
  for (std::size_t i = 0; i < snapshot.position.size(); ++i) {
    const VecOf<D>& place = snapshot.position[i];
    VecOf<D> off = place - basis.middle;
    if (scene.box) off = scene.box->nearest(off);
    if (!within(off.norm(), reach))
      return fmt::format(
          "{} is at ({:.3g}) m, outside of the scene: at most {:.3g} m from ({:.3g}) m",
          nameOfId(scene, i), fmt::join(place, ", "), reach, fmt::join(basis.middle, ", "));
    const double speed = snapshot.velocity[i].norm();
    if (basis.dt > 0.0 && !within(speed * basis.dt, fastest * basis.dt + basis.extent))
      return fmt::format("{} moves at {:.3g} m/s, through the whole scene of {:.3g} m in a step",
                         nameOfId(scene, i), speed, basis.extent);
  }
  return basis.prescribed ? wallFault(snapshot, basis) : std::string();
}

namespace {

template <int D>
std::string shapeFault(const SnapshotOf<D>& snapshot, const AuditBasisOf<D>& basis) {
  const SceneOf<D>& scene = *basis.scene;
  const std::size_t disks = scene.disks.size();
  for (const auto& [what, found, wanted] :
       {std::tuple("positions", snapshot.position.size(), disks),
        {"velocities", snapshot.velocity.size(), disks},
        {"spins", snapshot.spin ? snapshot.spin->size() : disks, disks},
        {"orientations",
         snapshot.turn          ? snapshot.turn->size()
         : scene.shapes.empty() ? disks
                                : 0,
         disks},
        {"places of wall disks", snapshot.wallPosition.size(), basis.radius.size() - disks}})
    if (found != wanted) return fmt::format("{} {} are shown, not {}", found, what, wanted);
  if constexpr (D == 3)
    for (std::size_t i = 0; snapshot.turn && i < disks; ++i)
      if (const double length = (*snapshot.turn)[i].norm(); !(std::abs(length - 1.0) <= 1e-5))
        return fmt::format("the quaternion of {} has length {:.6g}, not 1", nameOfId(scene, i),
                           length);
  if (basis.prescribed && snapshot.bodies.size() != scene.bodies.size())
    return fmt::format("{} wall bodies are shown, not {}", snapshot.bodies.size(),
                       scene.bodies.size());
  return {};
}

}  // namespace

template <int D>
std::string auditFault(const SnapshotOf<D>& snapshot, const AuditBasisOf<D>& basis,
                       std::optional<double> reached) {
  if (std::string why = shapeFault(snapshot, basis); !why.empty()) return why;
  if (std::string why = timeFault(snapshot, basis, reached); !why.empty()) return why;
  if (std::string why = positionFault(snapshot, basis); !why.empty()) return why;
  return contactFault(snapshot, basis);
}

template AuditBasis auditBasis<2>(const Scene&);
template AuditBasis auditBasis<2>(const Scene&, const Capabilities&, const EffectiveParameters&);
template std::string timeFault<2>(const Snapshot&, const AuditBasis&, std::optional<double>);
template std::string positionFault<2>(const Snapshot&, const AuditBasis&);
template std::string auditFault<2>(const Snapshot&, const AuditBasis&, std::optional<double>);
template AuditBasisOf<3> auditBasis<3>(const SpaceScene&, const Capabilities&,
                                       const EffectiveParameters&);
template std::string auditFault<3>(const SpaceSnapshot&, const AuditBasisOf<3>&,
                                   std::optional<double>);

std::string statsFault(const Stats& stats, double dt, double reached) {
  const double steps = std::round(reached / dt);
  if (static_cast<double>(stats.steps) != steps)
    return fmt::format("{} steps are counted, but t = {:g} s is {:g} steps of {:g} s", stats.steps,
                       reached, steps, dt);
  if (!(stats.wallSeconds >= 0.0 && stats.cpuSeconds >= 0.0))
    return fmt::format("{:g} s of wall time and {:g} s of CPU time are counted, which cannot be",
                       stats.wallSeconds, stats.cpuSeconds);
  return {};
}

}  // namespace crossgrain
