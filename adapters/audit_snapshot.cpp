#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "adapters/audit.hpp"
#include "adapters/suitability.hpp"

namespace crossgrain {
namespace {

/// Fastest that a body's motion moves any of its members [m/s].
double fastestOf(const WallBody& body) {
  double arm = 0.0;
  for (const Vec2& place : body.diskPosition) arm = std::max(arm, (place - body.centre).norm());
  for (const Plane& plane : body.planes) arm = std::max(arm, (plane.point - body.centre).norm());
  const Motion& motion = body.motion;
  switch (motion.kind) {
    case Motion::Kind::fixed:
      return 0.0;
    case Motion::Kind::rotating:
      return std::abs(motion.angularVelocity) * arm;
    case Motion::Kind::translating:
      return motion.velocity.norm();
    case Motion::Kind::oscillating:
      return std::abs(motion.frequency) * motion.amplitude.norm();
    case Motion::Kind::radial:
      return std::abs(motion.radialVelocity);
  }
  return 0.0;
}

void measurePlaces(const Scene& scene, AuditBasis& basis) {
  std::vector<Vec2> places = scene.disks.position;
  for (const WallBody& body : scene.bodies) {
    places.insert(places.end(), body.diskPosition.begin(), body.diskPosition.end());
    for (const Plane& plane : body.planes) places.push_back(plane.point);
  }
  if (places.empty()) return;
  Vec2 low = places.front(), high = places.front();
  for (const Vec2& place : places) {
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
constexpr double wallTolerance = 1e-6;  // of the scene's extent

/// Negated so that a NaN is off.
bool within(double distance, double limit) {
  return std::abs(distance) <= limit;
}

std::string whyNoWalls(const Snapshot& snapshot, const AuditBasis& basis) {
  const Scene& scene = *basis.scene;
  const double limit = wallTolerance * basis.extent;
  std::size_t k = 0;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const WallBody& body = scene.bodies[b];
    const BodyState state = stateAt(body.motion, body.centre, snapshot.positionTime);
    const BodySnapshot& shown = snapshot.bodies[b];
    if (!within(shown.angle - state.angle, wallTolerance * std::max(1.0, std::abs(state.angle))))
      return fmt::format("body {} has turned by {:.6g} rad, not by {:.6g} rad as prescribed",
                         body.name, shown.angle, state.angle);
    if (!within((shown.centre - state.centre).norm(), limit))
      return fmt::format("body {} has its centre at ({:.6g}, {:.6g}) m, not at ({:.6g}, {:.6g}) m",
                         body.name, shown.centre.x(), shown.centre.y(), state.centre.x(),
                         state.centre.y());
    for (const Vec2& start : body.diskPosition) {
      const Vec2 place = memberPosition(state, body.centre, start);
      const Vec2& found = snapshot.wallPosition[k];
      if (!within((found - place).norm(), limit))
        return fmt::format(
            "wall disk {} is at ({:.6g}, {:.6g}) m, not at ({:.6g}, {:.6g}) m as "
            "prescribed",
            k, found.x(), found.y(), place.x(), place.y());
      ++k;
    }
  }
  return {};
}

}  // namespace

AuditBasis auditBasis(const Scene& scene) {
  AuditBasis basis;
  basis.scene = &scene;
  basis.prescribed = false;
  basis.rounding = 1e-6;
  basis.radius = scene.radii();
  for (const WallBody& body : scene.bodies)
    basis.fastest = std::max(basis.fastest, fastestOf(body));
  for (std::size_t i = 0; i < scene.disks.size(); ++i)
    basis.fastest = std::max(basis.fastest, scene.disks.velocity[i].norm());
  measurePlaces(scene, basis);
  return basis;
}

AuditBasis auditBasis(const Scene& scene, const Capabilities& can,
                      const EffectiveParameters& effective) {
  AuditBasis basis = auditBasis(scene);
  basis.dt = effective.dt;
  basis.byOverlap = scene.law.soft() && hasNormalLaw(can, scene.law);
  basis.prescribed = true;
  basis.rounding = effective.precision == toString(Precision::float32) ? 1e-6 : 1e-10;
  return basis;
}

std::string timeFault(const Snapshot& snapshot, const AuditBasis& basis,
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

std::string positionFault(const Snapshot& snapshot, const AuditBasis& basis) {
  const Scene& scene = *basis.scene;
  const double t = snapshot.positionTime;
  const double fastest = 10.0 * basis.fastest;
  const double reach = 100.0 * basis.extent + fastest * t + 5.0 * scene.gravity.norm() * t * t;
  for (std::size_t i = 0; i < snapshot.position.size(); ++i) {
    const Vec2& place = snapshot.position[i];
    if (!within((place - basis.middle).norm(), reach))
      return fmt::format(
          "disk {} is at ({:.3g}, {:.3g}) m, outside of the scene: at most {:.3g} m "
          "from ({:.3g}, {:.3g}) m",
          i, place.x(), place.y(), reach, basis.middle.x(), basis.middle.y());
    const double speed = snapshot.velocity[i].norm();
    if (basis.dt > 0.0 && !within(speed * basis.dt, fastest * basis.dt + basis.extent))
      return fmt::format(
          "disk {} moves at {:.3g} m/s, through the whole scene of {:.3g} m in a "
          "step",
          i, speed, basis.extent);
  }
  return basis.prescribed ? whyNoWalls(snapshot, basis) : std::string();
}

namespace {

std::string whyNoShape(const Snapshot& snapshot, const AuditBasis& basis) {
  const Scene& scene = *basis.scene;
  const std::size_t disks = scene.disks.size();
  for (const auto& [what, found, wanted] :
       {std::tuple("positions", snapshot.position.size(), disks),
        {"velocities", snapshot.velocity.size(), disks},
        {"spins", snapshot.spin ? snapshot.spin->size() : disks, disks},
        {"places of wall disks", snapshot.wallPosition.size(), basis.radius.size() - disks}})
    if (found != wanted) return fmt::format("{} {} are shown, not {}", found, what, wanted);
  if (basis.prescribed && snapshot.bodies.size() != scene.bodies.size())
    return fmt::format("{} wall bodies are shown, not {}", snapshot.bodies.size(),
                       scene.bodies.size());
  return {};
}

}  // namespace

std::string auditFault(const Snapshot& snapshot, const AuditBasis& basis,
                       std::optional<double> reached) {
  if (std::string why = whyNoShape(snapshot, basis); !why.empty()) return why;
  if (std::string why = timeFault(snapshot, basis, reached); !why.empty()) return why;
  if (std::string why = positionFault(snapshot, basis); !why.empty()) return why;
  return contactFault(snapshot, basis);
}

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
