#include "adapters/grain_space.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "adapters/grain.hpp"
#include "adapters/law_options.hpp"
#include "adapters/pair_table.hpp"

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
  const ContactLaw& law = scene.law;
  const auto option = [&](const char* name) { return lawOptionValue(law, name); };
  demand(law.normal == NormalLaw::linear,
         fmt::format("has normal = linear in space, not {}", option("normal")));
  demand(law.damper == Damper::constant || (law.gn == 0.0 && law.gt == 0.0),
         fmt::format("has damper = constant in space, not {}", option("damper")));
  demand(!law.friction() || law.springs(),
         fmt::format("has tangential = none | spring | spring_dashpot in space, not {}",
                     option("tangential")));
  demand(!law.rolls(), "has no rolling_resistance in space");
  demand(!law.coheres(), "has no cohesion in space");
  demand(!scene.materials, "has no pair_materials in space");
  demand(!scene.energyLedger, "has no energy_ledger in space");
  demand(scene.precision == Precision::float64, "has precision = double in space, not float");
  for (const WallBodyOf<3>& body : scene.bodies) {
    const MotionKind kind = body.motion.kind;
    demand(body.diskRadius.empty(), "has walls of planes alone in space");
    demand(kind != MotionKind::rotating && kind != MotionKind::radial,
           fmt::format("has walls that are fixed | translating | oscillating in space, not {}",
                       toString(kind)));
  }
}

grain::SpaceWall wallOf(const WallBodyOf<3>& body) {
  grain::SpaceWall wall;
  for (const PlaneOf<3>& plane : body.planes)
    wall.planes.push_back({of(plane.point), of(Vec3(plane.normal.normalized()))});
  wall.motion = [motion = body.motion, centre = body.centre](double t) {
    const BodyStateOf<3> now = stateAt(motion, centre, t);
    return grain::SpaceWall::State{of(now.centre), of(now.velocity)};
  };
  return wall;
}

grain::SpheresSetup setupOf(const SpaceScene& scene, double skin, double maxOverlap) {
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
  const LawConventions& how = scene.law.conventions;
  setup.law = grainLawOf(scene.law);
  // Both sides list the values of these in the same order, too.
  setup.conventions = {static_cast<grain::SpringTurn>(how.springTurn),
                       static_cast<grain::SpringTwist>(how.springTwist)};
  setup.gravity = of(scene.gravity);
  setup.dt = scene.dt;
  setup.integrator = static_cast<grain::Integrator>(how.integrator);
  setup.rotation = scene.rotation;
  setup.skin = skin;
  setup.maxOverlap = maxOverlap;
  return setup;
}

}  // namespace

GrainSpheres::GrainSpheres(const SpaceScene& scene, double skin, double maxOverlap)
    : scene_(scene), simulation_(setupOf(scene, skin, maxOverlap)) {}

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

SpaceSnapshot GrainSpheres::snapshot(ContactReport report) const {
  if (report == ContactReport::accumulated)
    throw std::invalid_argument("accumulated contacts: see Capabilities::accumulatedContacts");
  SpaceSnapshot snapshot;
  snapshot.positionTime = snapshot.velocityTime = snapshot.contactTime = simulation_.time();
  for (std::size_t i = 0; i < simulation_.size(); ++i) {
    snapshot.position.push_back(of(simulation_.position(i)));
    snapshot.velocity.push_back(of(simulation_.velocity(i)));
  }
  if (scene_.law.friction()) {
    snapshot.spin.emplace();
    for (std::size_t i = 0; i < simulation_.size(); ++i)
      snapshot.spin->push_back(of(simulation_.spin(i)));
  }
  for (std::size_t b = 0; b < scene_.bodies.size(); ++b) {
    const grain::SpaceWall::State wall = simulation_.wallState(b);
    const auto [force, torque] = simulation_.wallLoad(b);
    snapshot.bodies.push_back(
        {of(wall.centre), Vec3::Zero(), of(wall.velocity), Vec3::Zero(), of(force), of(torque)});
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
  }
  return snapshot;
}

}  // namespace crossgrain
