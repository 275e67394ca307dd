#include "tests/faults/disguise/disguised_engine.hpp"

#include <limits>
#include <utility>

#include "adapters/grain.hpp"

namespace crossgrain::test {

DisguisedEngine::DisguisedEngine(const Disguise& disguise, std::filesystem::path scratch)
    : disguise_(disguise), scratch_(std::move(scratch)), engine_(makeGrain()) {}

Capabilities DisguisedEngine::capabilities() const {
  Capabilities can = engine_->capabilities();
  can.checkpoints = false;
  can.periodic = false;  // no Transform turns a box
  can.energyLedger = false;
  can.settings.clear();
  return can;
}

EffectiveParameters DisguisedEngine::load(const Scene& scene, const Settings& /*none*/) {
  by_ = disguise_.transform;
  if (disguise_.order) by_.order = shuffledOrder(scene.disks.size(), *disguise_.order);
  own_ = transformed(scene, by_);
  if (disguise_.nudge)
    own_.disks = nudged(own_.disks, std::numeric_limits<double>::epsilon(), *disguise_.nudge);
  engine_ = makeGrain();
  EffectiveParameters effective = engine_->load(own_, {});
  before_ = {};
  advances_ = 0;
  effective.dt = scene.dt;
  effective.velocityLag /= by_.units.time;
  effective.pairs.clear();
  return effective;
}

void DisguisedEngine::beginAnew() {
  const auto file = scratch_ / "state";
  engine_->checkpoint(file);
  const Stats now = stats();
  engine_ = makeGrain();
  engine_->load(own_, {});
  engine_->restore(file);
  const Stats fresh = engine_->stats();
  before_ = now;
  before_.steps -= fresh.steps;
  before_.contactEvaluations -= fresh.contactEvaluations;
  before_.wallSeconds -= fresh.wallSeconds;
  before_.cpuSeconds -= fresh.cpuSeconds;
}

double DisguisedEngine::advance(double t) {
  if (disguise_.restartEvery > 0 && ++advances_ % disguise_.restartEvery == 0) beginAnew();
  return engine_->advance(t * by_.units.time) / by_.units.time;
}

Snapshot DisguisedEngine::snapshot(ContactReport contacts) {
  return transformedBack(engine_->snapshot(contacts), by_);
}

Stats DisguisedEngine::stats() const {
  Stats all = engine_->stats();
  all.steps += before_.steps;
  all.contactEvaluations += before_.contactEvaluations;
  all.wallSeconds += before_.wallSeconds;
  all.cpuSeconds += before_.cpuSeconds;
  return all;
}

namespace {

void tellBack(Contacts& contacts, const Transform& by, std::size_t disks) {
  const double force = by.units.of(1, 1, -2), energy = by.units.of(2, 1, -2);
  const double handed = by.placement.mirror ? -1.0 : 1.0;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    for (std::int32_t* id : {&contacts.i[c], &contacts.j[c]})
      if (const auto k = static_cast<std::size_t>(*id); k < disks && !by.order.empty())
        *id = static_cast<std::int32_t>(by.order[k]);
    contacts.normal[c] = by.placement.turnedBack(contacts.normal[c]);
    contacts.overlap[c] /= by.units.length;
    contacts.normalForce[c] /= force;
    contacts.tangentialForce[c] *= handed / force;
    if (!contacts.rollingTorque.empty()) contacts.rollingTorque[c] *= handed / energy;
    if (contacts.i[c] < contacts.j[c]) continue;
    std::swap(contacts.i[c], contacts.j[c]);  // the force on the other along the other normal
    contacts.normal[c] = -contacts.normal[c];
    if (!contacts.rollingTorque.empty()) contacts.rollingTorque[c] = -contacts.rollingTorque[c];
  }
}

}  // namespace

Snapshot transformedBack(Snapshot now, const Transform& by) {
  const Units& units = by.units;
  const double handed = by.placement.mirror ? -1.0 : 1.0;
  const double force = units.of(1, 1, -2), energy = units.of(2, 1, -2);
  const auto places = [&](std::vector<Vec2>& vectors, double unit) {
    for (Vec2& vector : vectors) vector = by.placement.turnedBack(vector) / unit;
  };
  for (double* time :
       {&now.positionTime, &now.velocityTime, &now.contactTime, &now.contactInterval})
    *time /= units.time;
  now.position = placesBack(by, now.position);
  Transform velocities = by;  // as places, but for their unit
  velocities.units.length = units.of(1, 0, -1);
  now.velocity = placesBack(velocities, now.velocity);
  if (now.spin) now.spin = spinsBack(by, *now.spin);
  places(now.wallPosition, units.length);
  for (BodySnapshot& body : now.bodies) {
    body.centre = by.placement.turnedBack(body.centre) / units.length;
    body.angle *= handed;
    body.velocity = by.placement.turnedBack(body.velocity) / units.of(1, 0, -1);
    body.angularVelocity *= handed * units.time;
    if (body.force) body.force = Vec2(by.placement.turnedBack(*body.force) / force);
    if (body.torque) *body.torque *= handed / energy;
  }
  if (now.contacts) tellBack(*now.contacts, by, now.position.size());
  if (now.energies) {
    now.energies->kinetic /= energy;
    now.energies->elastic /= energy;
  }
  now.ledger.reset();
  return now;
}

}  // namespace crossgrain::test
