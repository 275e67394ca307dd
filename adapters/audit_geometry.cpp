#include "adapters/audit_geometry.hpp"

#include <fmt/format.h>

#include <cmath>

namespace crossgrain {
namespace {

/// The state of a body as a snapshot shows it; what widens it is the scene's matter.
BodyState shownState(const WallBody& body, const BodySnapshot& shown, double t) {
  BodyState state = stateAt(body.motion, body.centre, t);
  state.centre = shown.centre;
  state.velocity = shown.velocity;
  state.angularVelocity = shown.angularVelocity;
  return state;
}

void placeDisks(const Snapshot& snapshot, double lag, ContactPlaces& places) {
  places.position = snapshot.position;
  places.velocity = snapshot.velocity;
  if (lag == 0.0) return;
  for (std::size_t i = 0; i < places.position.size(); ++i)
    places.position[i] -= lag * places.velocity[i];
}

void placeWalls(const Snapshot& snapshot, const AuditBasis& basis, double lag,
                ContactPlaces& places) {
  const Scene& scene = *basis.scene;
  std::size_t k = 0;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const WallBody& body = scene.bodies[b];
    const bool shown = b < snapshot.bodies.size();
    const BodyState now = stateAt(body.motion, body.centre, snapshot.positionTime);
    const BodyState then = stateAt(body.motion, body.centre, snapshot.contactTime);
    const BodyState seen =
        shown ? shownState(body, snapshot.bodies[b], snapshot.positionTime) : now;
    for (const Vec2& start : body.diskPosition) {
      const Vec2& place = snapshot.wallPosition[k++];
      const Vec2 velocity = memberVelocity(seen, place);
      Vec2 moved = lag * velocity;
      if (basis.prescribed && lag != 0.0)
        moved = memberPosition(now, body.centre, start) - memberPosition(then, body.centre, start);
      places.position.push_back(place - moved);
      places.velocity.push_back(velocity);
    }
    const bool turns = body.motion.kind == Motion::Kind::rotating;
    for (const Plane& plane : body.planes)
      places.planes.push_back({planeAt(then, body.centre, {plane.point, plane.normal.normalized()}),
                               &body, then, basis.prescribed || !turns});
  }
}

}  // namespace

ContactPlaces contactPlaces(const Snapshot& snapshot, const AuditBasis& basis) {
  ContactPlaces places;
  places.rounding = basis.rounding * basis.farthest;
  const double lag = snapshot.positionTime - snapshot.contactTime;
  const double halfWay = snapshot.contactTime + 0.5 * lag;
  if (std::abs(snapshot.velocityTime - halfWay) > 1e-3 * std::abs(lag))
    places.drift = 0.5 * std::abs(lag);
  if (!basis.prescribed) places.drift += std::abs(lag);
  if (!basis.byOverlap) places.drift += std::max(basis.dt, snapshot.contactInterval);
  placeDisks(snapshot, lag, places);
  placeWalls(snapshot, basis, lag, places);
  return places;
}

void placeWallsAsPrescribed(const Scene& scene, double t, Snapshot& snapshot) {
  snapshot.wallPosition.clear();
  snapshot.bodies.clear();
  for (const WallBody& body : scene.bodies) {
    const BodyState now = stateAt(body.motion, body.centre, t);
    for (const Vec2& start : body.diskPosition)
      snapshot.wallPosition.push_back(memberPosition(now, body.centre, start));
    snapshot.bodies.push_back(
        {now.centre, now.angle, now.velocity, now.angularVelocity, std::nullopt, std::nullopt});
  }
}

Vec2 footOn(const Plane& plane, const Vec2& point) {
  return point - (point - plane.point).dot(plane.normal) * plane.normal;
}

Vec2 velocityOfSecond(const ContactPlaces& places, const AuditBasis& basis, std::size_t i,
                      std::size_t j) {
  if (j < basis.radius.size()) return places.velocity[j];
  const PlacedPlane& wall = places.planes[j - basis.radius.size()];
  BodyState motion = wall.motion;
  motion.radialVelocity = 0.0;  // planes of radial bodies stay
  return memberVelocity(motion, footOn(wall.plane, places.position[i]));
}

PairPlace pairPlace(const ContactPlaces& places, const AuditBasis& basis, std::size_t i,
                    std::size_t j) {
  PairPlace pair;
  if (j >= basis.radius.size()) {
    const Plane& plane = places.planes[j - basis.radius.size()].plane;
    pair.distance = (places.position[i] - plane.point).dot(plane.normal);
    pair.normal = plane.normal;
    pair.overlap = basis.radius[i] - pair.distance;
    pair.uncertain = places.rounding;
    if (places.drift > 0.0)
      pair.uncertain +=
          places.drift * ((places.velocity[i] - velocityOfSecond(places, basis, i, j)).norm() +
                          (basis.prescribed ? 0.0 : basis.fastest));
    pair.distance = basis.radius[i];
    return pair;
  }
  const Vec2 apart = places.position[i] - places.position[j];
  pair.distance = apart.norm();
  pair.normal = apart / pair.distance;
  pair.overlap = basis.radius[i] + basis.radius[j] - pair.distance;
  pair.uncertain = places.rounding;
  if (places.drift > 0.0)
    pair.uncertain += places.drift * (places.velocity[i] - places.velocity[j]).norm();
  return pair;
}

std::string contactName(const Contacts& contacts, std::size_t k, const Scene& scene) {
  return fmt::format("contact {} ({} with {})", k,
                     nameOfId(scene, static_cast<std::size_t>(contacts.i[k])),
                     nameOfId(scene, static_cast<std::size_t>(contacts.j[k])));
}

}  // namespace crossgrain
