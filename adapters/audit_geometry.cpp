#include "adapters/audit_geometry.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace crossgrain {
namespace {

/// The state of a body as a snapshot shows it; what widens it is the scene's matter.
template <int D>
BodyStateOf<D> shownState(const WallBodyOf<D>& body, const BodySnapshotOf<D>& shown, double t) {
  BodyStateOf<D> state = stateAt(body.motion, body.centre, t);
  state.centre = shown.centre;
  state.velocity = shown.velocity;
  state.angularVelocity = shown.angularVelocity;
  return state;
}

template <int D>
void placeDisks(const SnapshotOf<D>& snapshot, double lag, ContactPlacesOf<D>& places) {
  places.position = snapshot.position;
  places.velocity = snapshot.velocity;
  if (lag == 0.0) return;
  for (std::size_t i = 0; i < places.position.size(); ++i)
    places.position[i] -= lag * places.velocity[i];
}

template <int D>
void placeWalls(const SnapshotOf<D>& snapshot, const AuditBasisOf<D>& basis, double lag,
                ContactPlacesOf<D>& places) {
  const SceneOf<D>& scene = *basis.scene;
  std::size_t k = 0;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const WallBodyOf<D>& body = scene.bodies[b];
    const bool shown = b < snapshot.bodies.size();
    const BodyStateOf<D> now = stateAt(body.motion, body.centre, snapshot.positionTime);
    const BodyStateOf<D> then = stateAt(body.motion, body.centre, snapshot.contactTime);
    const BodyStateOf<D> seen =
        shown ? shownState(body, snapshot.bodies[b], snapshot.positionTime) : now;
    for (const VecOf<D>& start : body.diskPosition) {
      VecOf<D> place = snapshot.wallPosition[k++];
      if (scene.box) {  // a member turns with its body in that body's own image
        const VecOf<D> own = memberPosition<D>(now, body.centre, start);
        place = own + scene.box->nearest(place - own);
      }
      const VecOf<D> velocity = memberVelocity<D>(seen, place);
      VecOf<D> moved = lag * velocity;
      if (basis.prescribed && lag != 0.0)
        moved = memberPosition<D>(now, body.centre, start) -
                memberPosition<D>(then, body.centre, start);
      places.position.push_back(place - moved);
      places.velocity.push_back(velocity);
    }
    const bool turns = body.motion.kind == MotionKind::rotating;
    for (const PlaneOf<D>& plane : body.planes)
      places.planes.push_back(
          {planeAt<D>(then, body.centre, {plane.point, plane.normal.normalized()}), &body, then,
           basis.prescribed || !turns});
  }
  for (const WallBodyOf<D>& body : scene.bodies)
    for (const Cylinder& cylinder : body.cylinders)
      places.planes.push_back(
          {{}, &body, stateAt(body.motion, body.centre, snapshot.contactTime), true, &cylinder});
}

}  // namespace

template <int D>
ContactPlacesOf<D> contactPlaces(const SnapshotOf<D>& snapshot, const AuditBasisOf<D>& basis) {
  ContactPlacesOf<D> places;
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
template ContactPlaces contactPlaces<2>(const Snapshot&, const AuditBasis&);
template ContactPlacesOf<3> contactPlaces<3>(const SpaceSnapshot&, const AuditBasisOf<3>&);

template <int D>
void placeWallsAsPrescribed(const SceneOf<D>& scene, double t, SnapshotOf<D>& snapshot) {
  snapshot.wallPosition.clear();
  snapshot.bodies.clear();
  for (const WallBodyOf<D>& body : scene.bodies) {
    const BodyStateOf<D> now = stateAt<D>(body.motion, body.centre, t);
    for (const VecOf<D>& start : body.diskPosition)
      snapshot.wallPosition.push_back(memberPosition<D>(now, body.centre, start));
    snapshot.bodies.push_back(
        {now.centre, now.angle, now.velocity, now.angularVelocity, std::nullopt, std::nullopt});
  }
}
template void placeWallsAsPrescribed(const Scene&, double, Snapshot&);
template void placeWallsAsPrescribed(const SpaceScene&, double, SpaceSnapshot&);

template <int D>
VecOf<D> footOn(const PlaneOf<D>& plane, const VecOf<D>& point) {
  return point - (point - plane.point).dot(plane.normal) * plane.normal;
}
template Vec2 footOn<2>(const Plane&, const Vec2&);

template <int D>
VecOf<D> velocityOfSecond(const ContactPlacesOf<D>& places, const AuditBasisOf<D>& basis,
                          std::size_t i, std::size_t j) {
  if (j < basis.radius.size()) return places.velocity[j];
  const PlacedPlaneOf<D>& wall = places.planes[j - basis.radius.size()];
  BodyStateOf<D> motion = wall.motion;
  motion.radialVelocity = 0.0;  // planes of radial bodies stay
  const VecOf<D>& place = places.position[i];
  return memberVelocity<D>(motion, footOn<D>(wall.under(place), place));
}
template Vec2 velocityOfSecond<2>(const ContactPlaces&, const AuditBasis&, std::size_t,
                                  std::size_t);
template Vec3 velocityOfSecond<3>(const ContactPlacesOf<3>&, const AuditBasisOf<3>&, std::size_t,
                                  std::size_t);

template <int D>
PairPlaceOf<D> pairPlace(const ContactPlacesOf<D>& places, const AuditBasisOf<D>& basis,
                         std::size_t i, std::size_t j) {
  PairPlaceOf<D> pair;
  if (j >= basis.radius.size()) {
    const PlaneOf<D> plane = places.planes[j - basis.radius.size()].under(places.position[i]);
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
  VecOf<D> apart = places.position[i] - places.position[j];
  if (basis.scene->box) apart = basis.scene->box->nearest(apart);
  pair.distance = apart.norm();
  pair.normal = apart / pair.distance;
  pair.overlap = basis.radius[i] + basis.radius[j] - pair.distance;
  pair.uncertain = places.rounding;
  if (places.drift > 0.0)
    pair.uncertain += places.drift * (places.velocity[i] - places.velocity[j]).norm();
  return pair;
}
template PairPlace pairPlace<2>(const ContactPlaces&, const AuditBasis&, std::size_t, std::size_t);
template PairPlaceOf<3> pairPlace<3>(const ContactPlacesOf<3>&, const AuditBasisOf<3>&, std::size_t,
                                     std::size_t);

template <int D>
CollidingPair pairOf(const AuditBasisOf<D>& basis, std::size_t i, std::size_t j) {
  const DisksOf<D>& disks = basis.scene->disks;
  CollidingPair pair =
      diskOnWall(basis.radius[i], disks.mass[i], std::numeric_limits<double>::infinity());
  pair.plane = j >= basis.radius.size();
  if (!pair.plane) pair.radius[1] = basis.radius[j];
  if (j < disks.size()) pair.mass[1] = disks.mass[j];
  return pair;
}
template CollidingPair pairOf<2>(const AuditBasis&, std::size_t, std::size_t);
template CollidingPair pairOf<3>(const AuditBasisOf<3>&, std::size_t, std::size_t);

template <int D>
std::string contactName(const ContactsOf<D>& contacts, std::size_t k, const SceneOf<D>& scene) {
  return fmt::format("contact {} ({} with {})", k,
                     nameOfId(scene, static_cast<std::size_t>(contacts.i[k])),
                     nameOfId(scene, static_cast<std::size_t>(contacts.j[k])));
}
template std::string contactName<2>(const Contacts&, std::size_t, const Scene&);
template std::string contactName<3>(const ContactsOf<3>&, std::size_t, const SpaceScene&);

}  // namespace crossgrain
