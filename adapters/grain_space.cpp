#include "adapters/grain_space.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "adapters/grain.hpp"
#include "adapters/pair_table.hpp"
#include "law/law_options.hpp"

namespace crossgrain {
namespace {

grain::Vec3<double> of(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}
Vec3 of(const grain::Vec3<double>& v) {
  return {v.x, v.y, v.z};
}

void demand(bool holds, const std::string& what) {
  if (!holds) throw UnsupportedScene(what);
}

/// @throws UnsupportedScene
void requireSupported(const SpaceScene& scene) {
  demand(scene.law.soft(), "has no rigid contacts in space");
  demand(!scene.energyLedger, "has no energy_ledger in space");
  demand(scene.precision == Precision::float64, "has precision = double in space, not float");
  for (const WallBodyOf<3>& body : scene.bodies)
    demand(body.motion.kind != MotionKind::radial,
           fmt::format("has no walls that are {} in space", toString(body.motion.kind)));
}

grain::SpaceWall wallOf(const WallBodyOf<3>& body) {
  grain::SpaceWall wall;
  for (const PlaneOf<3>& plane : body.planes)
    wall.planes.push_back({of(plane.point), of(Vec3(plane.normal.normalized()))});
  for (const Cylinder& each : body.cylinders)
    wall.cylinders.push_back({of(each.point), of(Vec3(each.axis.normalized())), each.radius});
  for (const Vec3& position : body.diskPosition) wall.position.push_back(of(position));
  wall.radius = body.diskRadius;
  wall.motion = [motion = body.motion, centre = body.centre](double t) {
    const BodyStateOf<3> now = stateAt(motion, centre, t);
    return grain::SpaceWall::State{of(now.centre), of(now.velocity), of(now.angle),
                                   of(now.angularVelocity)};
  };
  return wall;
}

grain::SpheresSetup setupOf(const SpaceScene& scene, double skin, double maxOverlap, int threads) {
  requireSupported(scene);
  const DisksOf<3>& spheres = scene.disks;
  grain::SpheresSetup setup;
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    setup.position.push_back(of(spheres.position[i]));
    setup.velocity.push_back(of(spheres.velocity[i]));
    setup.spin.push_back(of(spheres.spin[i]));
  }
  setup.radius = spheres.radius;
  setup.mass = spheres.mass;
  setup.inertia = spheres.inertia;
  for (const WallBodyOf<3>& body : scene.bodies) setup.walls.push_back(wallOf(body));
  if (const auto& box = scene.box)
    setup.box = grain::SpaceBox{of(box->low), of(Vec3(box->high - box->low)), box->periodic};
  setup.law = scene.law;
  setup.materials = grainMaterialsOf(scene.materials);
  setup.gravity = of(scene.gravity);
  setup.dt = scene.dt;
  setup.rotation = scene.rotation;
  setup.skin = skin;
  setup.maxOverlap = maxOverlap;
  setup.threads = threads;
  return setup;
}

Vec3 raised(const Vec2& v) {
  return {v.x(), v.y(), 0.0};
}
Vec3 aboutZ(double spin) {
  return {0.0, 0.0, spin};
}

template <class From, class Change>
auto each(const std::vector<From>& list, const Change& change) {
  std::vector<decltype(change(list[0]))> out;
  for (const From& value : list) out.push_back(change(value));
  return out;
}

MotionOf<3> inSpace(const Motion& motion) {
  return {motion.kind,
          aboutZ(motion.angularVelocity),
          raised(motion.velocity),
          raised(motion.amplitude),
          motion.frequency,
          motion.radialVelocity,
          motion.radialEnd};
}

}  // namespace

SpaceScene inSpace(const Scene& scene) {
  demand(!scene.bottom, "has no bottom plate in a periodic box");
  SpaceScene to;
  to.name = scene.name;
  to.disks = {scene.disks.radius,
              scene.disks.mass,
              scene.disks.inertia,
              each(scene.disks.position, raised),
              each(scene.disks.velocity, raised),
              each(scene.disks.spin, aboutZ)};
  for (const WallBody& body : scene.bodies)
    to.bodies.push_back({body.name, raised(body.centre), each(body.diskPosition, raised),
                         body.diskRadius,
                         each(body.planes,
                              [](const Plane& plane) {
                                return PlaneOf<3>{raised(plane.point), raised(plane.normal)};
                              }),
                         inSpace(body.motion)});
  to.law = scene.law;
  to.materials = scene.materials;
  if (const auto& box = scene.box)
    to.box =
        BoxOf<3>{raised(box->low), raised(box->high), {box->periodic[0], box->periodic[1], false}};
  to.gravity = raised(scene.gravity);
  to.rotation = scene.rotation;
  to.precision = scene.precision;
  to.dt = scene.dt;
  to.energyLedger = scene.energyLedger;
  changeLaws(to, [](ContactLaw& law) { law.dimension = 3; });
  return to;
}

ContactsOf<3> inSpace(const Contacts& contacts) {
  ContactsOf<3> to;
  to.i = contacts.i;
  to.j = contacts.j;
  to.normal = each(contacts.normal, raised);
  to.overlap = contacts.overlap;
  to.normalForce = contacts.normalForce;
  for (std::size_t k = 0; k < contacts.size(); ++k)  // along z × n
    to.tangentialForce.push_back(
        raised(contacts.tangentialForce[k] * perpendicular(contacts.normal[k])));
  to.sliding = contacts.sliding;
  to.rollingTorque = each(contacts.rollingTorque, aboutZ);
  return to;
}

Snapshot inPlane(const SpaceSnapshot& snapshot) {
  const auto flat = [](const Vec3& v) { return Vec2(v.head<2>()); };
  const auto spin = [](const Vec3& v) { return v.z(); };
  Snapshot to;
  to.positionTime = snapshot.positionTime;
  to.velocityTime = snapshot.velocityTime;
  to.contactTime = snapshot.contactTime;
  to.contactInterval = snapshot.contactInterval;
  to.position = each(snapshot.position, flat);
  to.velocity = each(snapshot.velocity, flat);
  if (snapshot.spin) to.spin = each(*snapshot.spin, spin);
  to.wallPosition = each(snapshot.wallPosition, flat);
  for (const BodySnapshotOf<3>& body : snapshot.bodies) {
    BodySnapshot& wall = to.bodies.emplace_back();
    wall = {flat(body.centre),          spin(body.angle), flat(body.velocity),
            spin(body.angularVelocity), std::nullopt,     std::nullopt};
    if (body.force) wall.force = flat(*body.force);
    if (body.torque) wall.torque = spin(*body.torque);
  }
  if (!snapshot.contacts) return to;
  const ContactsOf<3>& from = *snapshot.contacts;
  Contacts& contacts = to.contacts.emplace();
  contacts.i = from.i;
  contacts.j = from.j;
  contacts.normal = each(from.normal, flat);
  contacts.overlap = from.overlap;
  contacts.normalForce = from.normalForce;
  for (std::size_t k = 0; k < from.size(); ++k)  // along z × n
    contacts.tangentialForce.push_back(
        flat(from.tangentialForce[k]).dot(perpendicular(contacts.normal[k])));
  contacts.sliding = from.sliding;
  contacts.rollingTorque = each(from.rollingTorque, spin);
  return to;
}

GrainSpheres::GrainSpheres(const SpaceScene& scene, double skin, double maxOverlap, int threads)
    : scene_(scene), simulation_(setupOf(scene, skin, maxOverlap, threads)) {}

EffectiveParameters GrainSpheres::effective() const {
  EffectiveParameters effective;
  effective.dt = simulation_.dt();
  effective.precision = toString(Precision::float64);
  effective.integrator = lawOptionValue(scene_.law, "integrator");
  if (scene_.law.conventions.integrator == Integrator::semiImplicitEuler)
    effective.velocityLag = 0.5 * effective.dt;
  effective.effects = effectsOf(scene_);
  effective.pairs =
      pairTable(scene_, [](const ContactLaw& law, double) { return coefficientsOf(law); });
  return effective;
}

SpaceSnapshot GrainSpheres::snapshot(ContactReport report) {
  if (report == ContactReport::accumulated)
    throw std::invalid_argument("accumulated contacts: see Capabilities::accumulatedContacts");
  SpaceSnapshot snapshot;
  snapshot.positionTime = snapshot.velocityTime = snapshot.contactTime = simulation_.time();
  for (std::size_t i = 0; i < simulation_.size(); ++i) {
    snapshot.position.push_back(of(simulation_.position(i)));
    snapshot.velocity.push_back(of(simulation_.velocity(i)));
  }
  if (scene_.law.friction() || scene_.law.rolls()) {
    snapshot.spin.emplace();
    for (std::size_t i = 0; i < simulation_.size(); ++i)
      snapshot.spin->push_back(of(simulation_.spin(i)));
  }
  for (std::size_t k = 0; k < simulation_.wallSpheres(); ++k)
    snapshot.wallPosition.push_back(of(simulation_.wallPosition(k)));
  for (std::size_t b = 0; b < scene_.bodies.size(); ++b) {
    const grain::SpaceWall::State wall = simulation_.wallState(b);
    const auto [force, torque] = simulation_.wallLoad(b);
    snapshot.bodies.push_back(
        {of(wall.centre), of(wall.angle), of(wall.velocity), of(wall.spin), of(force), of(torque)});
  }
  if (report == ContactReport::none) return snapshot;
  ContactsOf<3>& contacts = snapshot.contacts.emplace();
  for (const grain::SpaceContact& contact : simulation_.contacts()) {
    contacts.i.push_back(contact.i);
    contacts.j.push_back(contact.j);
    contacts.normal.push_back(of(contact.normal));
    contacts.overlap.push_back(contact.overlap);
    contacts.normalForce.push_back(contact.normalForce);
    contacts.tangentialForce.push_back(of(contact.tangentialForce));
    contacts.sliding.push_back(contact.sliding);
    if (scene_.law.rolls()) contacts.rollingTorque.push_back(of(contact.rollingTorque));
  }
  return snapshot;
}

void GrainSpheres::beginUnderWay(const ContactsOf<3>& contacts) {
  std::vector<grain::SpaceContact> forces;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const double size = contacts.tangentialForce[k].norm();
    // Without flags: at the bound to what an engine's own rounding may leave of it.
    const bool slides = contacts.sliding.empty() ? size >= (1.0 - 1e-6) * scene_.law.mu *
                                                               std::abs(contacts.normalForce[k])
                                                 : contacts.sliding[k] != 0;
    forces.push_back(
        {contacts.i[k], contacts.j[k], of(contacts.normal[k]), contacts.overlap[k],
         contacts.normalForce[k], of(contacts.tangentialForce[k]),
         contacts.rollingTorque.empty() ? grain::Vec3<double>{} : of(contacts.rollingTorque[k]),
         slides});
  }
  simulation_.beginUnderWay(forces);
}

}  // namespace crossgrain
