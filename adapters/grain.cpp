#include "adapters/grain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <optional>

#include "adapters/declared_law.hpp"
#include "adapters/grain_space.hpp"
#include "adapters/pair_table.hpp"
#include "adapters/stopwatch.hpp"
#include "adapters/suitability.hpp"
#include "engines/grain/simulation.hpp"
#include "law/law_options.hpp"
#include "support/busy_time.hpp"

namespace crossgrain {

std::optional<grain::Materials> grainMaterialsOf(const std::optional<Materials>& materials) {
  if (!materials) return std::nullopt;
  return grain::Materials{materials->ofDisk, materials->ofBody, materials->names.size(),
                          materials->laws};
}

namespace {

grain::WallState translate(const BodyState& state) {
  return {state.centre.x(),   state.centre.y(),   state.angle,           state.radialShift,
          state.velocity.x(), state.velocity.y(), state.angularVelocity, state.radialVelocity};
}

grain::Wall translate(const WallBody& body) {
  grain::Wall wall;
  for (const Vec2& position : body.diskPosition) {
    wall.diskX.push_back(position.x());
    wall.diskY.push_back(position.y());
  }
  wall.diskRadius = body.diskRadius;
  for (const Plane& plane : body.planes)
    wall.planes.push_back({plane.point.x(), plane.point.y(), plane.normal.x(), plane.normal.y()});
  wall.moves = body.motion.kind != Motion::Kind::fixed;
  wall.motion = [motion = body.motion, centre = body.centre](double t) {
    return translate(stateAt(motion, centre, t));
  };
  return wall;
}

}  // namespace

grain::Setup setupOf(const Scene& scene) {
  grain::Setup setup;
  for (std::size_t i = 0; i < scene.disks.size(); ++i) {
    setup.disks.x.push_back(scene.disks.position[i].x());
    setup.disks.y.push_back(scene.disks.position[i].y());
    setup.disks.vx.push_back(scene.disks.velocity[i].x());
    setup.disks.vy.push_back(scene.disks.velocity[i].y());
  }
  setup.disks.spin = scene.disks.spin;
  setup.disks.radius = scene.disks.radius;
  setup.disks.mass = scene.disks.mass;
  setup.disks.inertia = scene.disks.inertia;
  for (const WallBody& body : scene.bodies) setup.walls.push_back(translate(body));
  setup.law = scene.law;
  setup.materials = grainMaterialsOf(scene.materials);
  if (scene.bottom && scene.bottom->mu > 0.0) setup.bottom = scene.bottom;
  setup.gravityX = scene.gravity.x();
  setup.gravityY = scene.gravity.y();
  setup.dt = scene.dt;
  setup.rotation = scene.rotation;
  setup.precision = static_cast<grain::Precision>(scene.precision);
  setup.ledger = scene.energyLedger;
  return setup;
}

namespace {

class GrainEngine : public Engine {
 public:
  GrainEngine(LawConventionSets conventions, double stiffness)
      : conventions_(std::move(conventions)), stiffness_(stiffness) {}

  Capabilities capabilities() const override {
    Capabilities can;
    can.version = "0.1.0";
    can.dimensions = {2, 3};
    can.periodic = true;
    can.limits.cylinders = true;
    for (const Effect effect : allEffects) can.effects[effect] = Support::optional;
    for (const LawOption& option : lawOptions())
      can.lawOptions[std::string(option.name)] = {option.values.begin(), option.values.end()};
    // A mirror of soft contacts has nothing to say of rigid ones, and the other way round.
    if (!conventions_.empty() || stiffness_ != 1.0) std::erase(can.lawOptions["normal"], "rigid");
    for (const auto& [name, values] : conventions_) can.lawOptions[name] = values;
    if (can.lawOptions["normal"] == std::vector<std::string>{"rigid"})
      for (const Effect effect : {Effect::rollingResistance, Effect::cohesion})
        can.effects[effect] = Support::never;
    can.precisions = {Precision::float64, Precision::float32};
    can.slidingFlags = true;
    can.checkpoints = true;
    can.energyLedger = true;
    can.settings = {
        {"dt", 0.0, "s", "time step; 0: the case's"},
        {"stiffness",
         stiffness_,
         "-",
         "times the case's k_n and k_t, at the same restitution; dt shrinks by its root",
         {},
         1e-9,
         1e9},
        {"skin", 0.0, "m", "of the Verlet lists; 0: tuned while it runs"},
        {"max_overlap", 1.0, "-",
         "of two disks, in units of the smaller radius: a run with a deeper one ends; 0: any"},
        {"threads",
         1.0,
         "-",
         "that share the work of a step, to the same bits",
         {},
         1.0,
         1024.0,
         true}};
    return can;
  }

  EffectiveParameters load(const Scene& scene, const Settings& settings) override {
    if (scene.box) return loadInSpace(inSpace(scene), settings);
    const double stiffness = setting(settings, "stiffness", stiffness_);
    own_ = asRun(scene, stiffness);
    const Scene& own = own_;
    const bool rigid = rigid_ = !scene.law.soft();
    const ContactLaw& law = own.law;
    grain::Setup setup = setupOf(own);
    if (const double dt = setting(settings, "dt", 0.0); dt > 0.0) setup.dt = dt;
    setup.skin = setting(settings, "skin", 0.0);
    setup.maxOverlap = setting(settings, "max_overlap", setup.maxOverlap);
    setup.threads = threadsOf(settings);
    rolls_ = law.rolls();
    bonds_ = law.cohesion == CohesionLaw::jkr;
    law_ = law;
    radii_ = scene.radii();
    spins_ = law.friction() || law.rolls();
    stopwatch_ = stopwatchOf(settings);
    spheres_.reset();
    simulation_.emplace(std::move(setup));

    EffectiveParameters effective;
    effective.dt = simulation_->dt();
    effective.precision = toString(scene.precision);
    effective.integrator = lawOptionValue(law, "integrator");
    if (law.conventions.integrator == Integrator::semiImplicitEuler)
      effective.velocityLag = 0.5 * effective.dt;
    effective.effects = effectsOf(own);
    const LawConventions& how = law.conventions;
    if (how.integrator == Integrator::semiImplicitEuler &&
        how.dampingVelocity != DampingVelocity::lagged && mattersTo(law, "damping_velocity"))
      effective.deviations.push_back({"damping_velocity", 0.0, "",
                                      "Euler's velocities are those of the positions' own time: "
                                      "nothing is predicted"});
    if (rigid && scene.law.conventions.integrator != Integrator::semiImplicitEuler)
      effective.deviations.push_back(
          {"integrator", 0.0, "", "impulses act at the beginning of semi-implicit Euler steps"});
    reportStiffness(effective, stiffness);
    effective.pairs =
        pairTable(own, [](const ContactLaw& of, double) { return coefficientsOf(of); });
    return effective;
  }

  EffectiveParameters loadInSpace(const SpaceScene& scene, const Settings& settings) override {
    const double stiffness = setting(settings, "stiffness", stiffness_);
    SpaceScene own = asRun(scene, stiffness);
    if (const double dt = setting(settings, "dt", 0.0); dt > 0.0) own.dt = dt;
    spheres_.emplace(own, setting(settings, "skin", 0.0), setting(settings, "max_overlap", 1.0),
                     threadsOf(settings));
    simulation_.reset();
    stopwatch_ = stopwatchOf(settings);
    EffectiveParameters effective = spheres_->effective();
    reportStiffness(effective, stiffness);
    return effective;
  }

  SpaceSnapshot snapshotInSpace(ContactReport report) override {
    return spheres_->snapshot(report);
  }

  double advance(double t) override {
    const Stopwatch::Lap lap(stopwatch_);
    const BusyTime::Piece stepping(steppingTime());
    return spheres_ ? advanceTo(spheres_->simulation(), t) : advanceTo(*simulation_, t);
  }

  Snapshot snapshot(ContactReport report) override {
    if (spheres_) return inPlane(spheres_->snapshot(report));  // of a periodic box
    const grain::Simulation& now = *simulation_;
    Snapshot snapshot;
    snapshot.positionTime = snapshot.velocityTime = snapshot.contactTime = now.time();
    for (std::size_t i = 0; i < now.movingCount(); ++i) {
      snapshot.position.emplace_back(now.x(i), now.y(i));
      snapshot.velocity.emplace_back(now.velocityX(i), now.velocityY(i));
    }
    if (spins_) {
      snapshot.spin.emplace();
      for (std::size_t i = 0; i < now.movingCount(); ++i) snapshot.spin->push_back(now.spin(i));
    }
    for (std::size_t i = now.movingCount(); i < now.diskCount(); ++i)
      snapshot.wallPosition.emplace_back(now.x(i), now.y(i));
    for (std::size_t b = 0; b < own_.bodies.size(); ++b) {
      const grain::WallState wall = now.wallState(b);
      const grain::WallLoad load = now.wallLoad(b);
      snapshot.bodies.push_back({{wall.x, wall.y},
                                 wall.angle,
                                 {wall.vx, wall.vy},
                                 wall.spin,
                                 Vec2(load.fx, load.fy),
                                 load.torque});
    }
    if (report == ContactReport::instant) snapshot.contacts = contacts();
    if (report == ContactReport::accumulated)
      throw std::invalid_argument("accumulated contacts: see Capabilities::accumulatedContacts");
    snapshot.energies = {now.kineticEnergy(), now.elasticEnergy()};
    if (const EnergyLedger* ledger = now.energyLedger()) snapshot.ledger = *ledger;
    return snapshot;
  }

  void checkpoint(const std::filesystem::path& file) override {
    std::ofstream out(file, std::ios::binary);
    spheres_ ? spheres_->simulation().save(out) : simulation_->save(out);
    out.close();
    if (!out) throw EngineFailure(fmt::format("{}: cannot be written", file.string()));
  }

  void restore(const std::filesystem::path& file) override {
    std::ifstream in(file, std::ios::binary);
    if (!in) throw EngineFailure(fmt::format("{}: cannot be read", file.string()));
    try {
      spheres_ ? spheres_->simulation().restore(in) : simulation_->restore(in);
    } catch (const std::runtime_error& error) {
      throw EngineFailure(fmt::format("{}: {}", file.string(), error.what()));
    }
  }

  void beginUnderWay(const ContactsOf<3>& contacts) { spheres_->beginUnderWay(contacts); }

  void beginUnderWay(const Contacts& contacts) {
    if (spheres_) return beginUnderWay(inSpace(contacts));  // in a periodic box
    std::vector<grain::Contact> forces(contacts.size());
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      forces[k].i = contacts.i[k];
      forces[k].j = contacts.j[k];
      forces[k].tangentialForce = contacts.tangentialForce[k];
      // Without flags: at the bound to what an engine's own rounding may leave of it.
      const ContactLaw& law = own_.lawOf(static_cast<std::size_t>(contacts.i[k]),
                                         static_cast<std::size_t>(contacts.j[k]));
      const double bound = law.mu * std::abs(contacts.normalForce[k]);
      forces[k].sliding = contacts.sliding.empty()
                              ? std::abs(forces[k].tangentialForce) >= (1.0 - 1e-6) * bound
                              : contacts.sliding[k] != 0;
      if (!contacts.rollingTorque.empty()) {
        forces[k].rollingTorque = contacts.rollingTorque[k];
        forces[k].rollingSlides =
            std::abs(forces[k].rollingTorque) >= (1.0 - 1e-6) * rollingBound(law, contacts, k);
      }
      if (bonds_) forces[k].memory = 1.0;  // listed: bonded
    }
    simulation_->beginUnderWay(forces);
  }

  Stats stats() const override {
    if (spheres_) {
      const grain::Spheres& now = spheres_->simulation();
      return {now.steps(),
              now.contactEvaluations(),
              stopwatch_.wallSeconds,
              stopwatch_.cpuSeconds,
              {{"rebuilds", static_cast<double>(now.rebuilds())}}};
    }
    Stats stats{simulation_->steps(),
                simulation_->contactEvaluations(),
                stopwatch_.wallSeconds,
                stopwatch_.cpuSeconds,
                {{"rebuilds", static_cast<double>(simulation_->neighbours().rebuilds)}}};
    if (rigid_)
      stats.counters["unfinished_impacts"] = static_cast<double>(simulation_->unfinishedImpacts());
    return stats;
  }

 private:
  static int threadsOf(const Settings& settings) {
    return static_cast<int>(setting(settings, "threads", 1.0));
  }
  static Stopwatch stopwatchOf(const Settings& settings) {
    return {.cpuClock =
                threadsOf(settings) > 1 ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_THREAD_CPUTIME_ID};
  }
  /// The scene with the engine's own conventions, contacts and time step.
  /// @throws UnsupportedScene for a normal law that it does not have, and for convex bodies, which
  ///         would be the disks around them: mirrors are loaded without a look at limits
  template <int D>
  SceneOf<D> asRun(const SceneOf<D>& scene, double stiffness) const {
    if (!scene.shapes.empty()) throw UnsupportedScene("has no convex bodies");
    const bool rigid = !scene.law.soft();
    const Capabilities can = capabilities();
    const std::vector<std::string>& normals = can.lawOptions.at("normal");
    if (std::ranges::find(normals, lawOptionValue(scene.law, "normal")) == normals.end())
      throw UnsupportedScene(rigid ? "has no rigid contacts, only soft ones"
                                   : "has rigid contacts only, normal = \"rigid\"");
    SceneOf<D> own = scene;
    changeLaws(own, [&](ContactLaw& law) {
      law = lawAsRun(can, law);
      // An impulse is a force within one step of the scheme in which a kick precedes its drift.
      if (rigid) law.conventions.integrator = Integrator::semiImplicitEuler;
      law = stiffened(law, stiffness);
    });
    own.dt = scene.dt / std::sqrt(stiffness);
    return own;
  }

  static void reportStiffness(EffectiveParameters& effective, double stiffness) {
    if (stiffness != 1.0)
      effective.deviations.push_back(
          {"stiffness", stiffness, "-", "contacts are this many times as stiff as the case's"});
  }

  /// @returns the time reached [s]
  static double advanceTo(auto& simulation, double t) {
    const auto wanted = std::llround(t / simulation.dt());
    const auto done = static_cast<long long>(simulation.steps());
    if (wanted > done) simulation.advance(static_cast<std::uint64_t>(wanted - done));
    return simulation.time();
  }

  static double setting(const Settings& settings, const std::string& name, double otherwise) {
    const auto found = settings.find(name);
    return found == settings.end() ? otherwise : std::get<double>(found->second);
  }

  /// µ_r L N of a contact; infinite where N is not its normal force, or limits nothing.
  double rollingBound(const ContactLaw& law, const Contacts& contacts, std::size_t k) const {
    const LawConventions& how = law.conventions;
    const double force = contacts.normalForce[k];
    if (law.coheres() || how.rollingLoad == RollingLoad::elastic ||
        (how.rollingLoad == RollingLoad::whileCompressed && force <= 0.0))
      return std::numeric_limits<double>::infinity();
    const double own = radii_[static_cast<std::size_t>(contacts.i[k])];
    const auto j = static_cast<std::size_t>(contacts.j[k]);
    const bool plane = j >= radii_.size();
    const double other = plane ? own : radii_[j];
    double length = plane ? own : own * other / (own + other);
    if (how.rollingLength == RollingLength::twiceEffective) length *= 2.0;
    if (how.rollingLength == RollingLength::smallerRadius) length = std::min(own, other);
    if (how.rollingLength == RollingLength::meanRadius) length = 0.5 * (own + other);
    return law.muR * length *
           (how.rollingLoad == RollingLoad::magnitude ? std::abs(force) : std::max(force, 0.0));
  }

  Contacts contacts() const {
    Contacts contacts;
    for (const grain::Contact& contact : simulation_->contacts()) {
      contacts.i.push_back(contact.i);
      contacts.j.push_back(contact.j);
      contacts.normal.emplace_back(contact.nx, contact.ny);
      contacts.overlap.push_back(contact.overlap);
      contacts.normalForce.push_back(contact.normalForce);
      contacts.tangentialForce.push_back(contact.tangentialForce);
      contacts.sliding.push_back(contact.sliding);
      if (rolls_) contacts.rollingTorque.push_back(contact.rollingTorque);
    }
    contacts.dissipation = simulation_->contactLosses();
    return contacts;
  }

  LawConventionSets conventions_;
  double stiffness_;
  Scene own_;  ///< as it is run
  bool rigid_ = false;
  bool rolls_ = false;
  ContactLaw law_;
  std::vector<double> radii_;  ///< of disks and wall disks [m]
  bool bonds_ = false;         ///< whether contacts last beyond their overlap
  bool spins_ = false;         ///< whether snapshots have them; blocked ones are zero
  std::optional<grain::Simulation> simulation_;
  std::optional<GrainSpheres> spheres_;  ///< instead, of a scene in space
  Stopwatch stopwatch_;
};

}  // namespace

std::unique_ptr<Engine> makeGrain() {
  return makeGrainMirror({});
}

std::unique_ptr<Engine> makeGrainMirror(LawConventionSets conventions) {
  return std::make_unique<GrainEngine>(std::move(conventions), 1.0);
}

LawConventionSets conventionsOf(LawConventionSets declared) {
  for (const char* const law : {"normal", "damper", "tangential"}) declared.erase(law);
  return declared;
}

EngineEntry mirrorEntry(std::string name, std::string summary, std::string peer,
                        std::vector<std::string> normals, LawConventionSets conventions) {
  return {.name = std::move(name),
          .summary = std::move(summary),
          .make = [conventions = std::move(conventions)] { return makeGrainMirror(conventions); },
          .mirrors = std::move(peer),
          .mirrorsNormal = std::move(normals)};
}

std::unique_ptr<Engine> makeStiffGrain(double factor) {
  return std::make_unique<GrainEngine>(LawConventionSets{}, factor);
}

template <int D>
void beginUnderWay(Engine& inHouse, const ContactsOf<D>& contacts) {
  auto* const own = dynamic_cast<GrainEngine*>(&inHouse);
  if (!own)
    throw UnsupportedScene("no mirror with its time stepping begins in the middle of a run");
  own->beginUnderWay(contacts);
}
template void beginUnderWay(Engine&, const Contacts&);
template void beginUnderWay(Engine&, const ContactsOf<3>&);

EngineEntry grainEngine() {
  return {"grain", "in-house: soft disks, every convention an option", makeGrain};
}

}  // namespace crossgrain
