#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <stdexcept>

#include "adapters/box2d_common.hpp"
#include "adapters/grain.hpp"
#include "adapters/pair_table.hpp"
#include "adapters/stopwatch.hpp"
#include "engines/box2d/penalty_world.hpp"
#include "law/law_options.hpp"

namespace crossgrain {

namespace {

/// The scene's soft law on Box2D's broad phase and contact life (see
/// engines/box2d/penalty_world.hpp for what remains Box2D's). Positions, velocities, spins and
/// contacts of a snapshot all belong to the same time.
class Box2dPenalty : public Engine {
 public:
  Capabilities capabilities() const override {
    Capabilities can;
    can.version = box2dVersion();
    for (const Effect effect : allEffects) can.effects[effect] = Support::optional;
    for (const Effect effect : {Effect::rollingResistance, Effect::cohesion})
      can.effects[effect] = Support::never;
    can.lawOptions = {{"normal", {"linear", "hertz"}},
                      {"spring_update", {"after", "before"}},
                      {"lever_arm", {"radius", "contact_point"}},
                      {"velocity_arm", {"lever_arm"}},
                      {"plane_arm", {"surface"}},
                      {"damping_velocity", {"lagged"}},
                      {"integrator", {"semi_implicit_euler"}}};
    can.precisions = {Precision::float64};
    can.slidingFlags = true;
    can.settings = {{"dt", 0.0, "s", "time step; 0: the case's"}, lengthUnitSetting()};
    can.limits = box2dLimits();
    return can;
  }

  EffectiveParameters load(const Scene& scene, const Settings& settings) override {
    if (!scene.shapes.empty()) throw UnsupportedScene("has no convex bodies");
    if (scene.law.normal != NormalLaw::linear && scene.law.normal != NormalLaw::hertz)
      throw UnsupportedScene(fmt::format("has normal = linear | hertz, not \"{}\"",
                                         lawOptionValue(scene.law, "normal")));
    const std::vector<SettingSpec> specs = capabilities().settings;
    const double dt = numberSetting(settings, specs, "dt");
    const box2d_granular::Model model =
        box2dModel(scene, dt > 0.0 ? dt : scene.dt, numberSetting(settings, specs, "length_unit"));
    std::optional<BottomPlate> plate = scene.bottom;
    if (plate && !(plate->mu > 0.0)) plate.reset();
    world_.emplace(model, scene.law, plate, pairLaws(scene));
    spins_ = scene.law.friction();
    stopwatch_ = {};

    EffectiveParameters effective;
    effective.dt = model.dt;
    effective.precision = "double";
    effective.integrator = "semi_implicit_euler";
    effective.velocityLag = 0.5 * effective.dt;
    effective.effects = effectsOf(scene);
    effective.pairs = pairTable(scene, [&](double) { return coefficientsOf(scene.law); });
    return effective;
  }

  double advance(double t) override {
    const auto wanted = std::llround(t / world_->dt());
    const Stopwatch::Lap lap(stopwatch_);
    while (static_cast<long long>(world_->steps()) < wanted) world_->step();
    return world_->time();
  }

  Snapshot snapshot(ContactReport report) override {
    if (report == ContactReport::accumulated)
      throw std::invalid_argument("accumulated contacts: see Capabilities::accumulatedContacts");
    Snapshot snapshot = kinematicSnapshot(world_->members(), world_->time(), spins_);
    const std::vector<box2d_granular::WallLoad> loads = world_->wallLoads();
    for (std::size_t b = 0; b < loads.size(); ++b) {
      snapshot.bodies[b].force = toVec2(loads[b].force);
      snapshot.bodies[b].torque = loads[b].torque;
    }
    if (report == ContactReport::instant) snapshot.contacts = contacts();
    snapshot.energies = {world_->kineticEnergy(), world_->elasticEnergy()};
    return snapshot;
  }

  Stats stats() const override {
    return {world_->steps(),
            world_->contactEvaluations(),
            stopwatch_.wallSeconds,
            stopwatch_.cpuSeconds,
            {{"close_pairs", static_cast<double>(world_->contacts().size())}}};
  }

 private:
  static std::optional<box2d_granular::PairLaws> pairLaws(const Scene& scene) {
    if (!scene.materials) return std::nullopt;
    const Materials& from = *scene.materials;
    box2d_granular::PairLaws to{from.ofDisk, from.names.size(), from.laws};
    for (std::size_t b = 0; b < scene.bodies.size(); ++b)
      to.material.insert(to.material.end(), scene.bodies[b].diskRadius.size(), from.ofBody[b]);
    for (std::size_t b = 0; b < scene.bodies.size(); ++b)
      to.material.insert(to.material.end(), scene.bodies[b].planes.size(), from.ofBody[b]);
    return to;
  }

  Contacts contacts() const {
    Contacts contacts;
    for (const box2d_granular::SoftContact& contact : world_->contacts()) {
      if (!contact.touching) continue;
      contacts.i.push_back(contact.i);
      contacts.j.push_back(contact.j);
      contacts.normal.push_back(toVec2(contact.geometry.normal));
      contacts.overlap.push_back(contact.geometry.overlap);
      contacts.normalForce.push_back(contact.force.normal);
      contacts.tangentialForce.push_back(contact.force.tangential);
      contacts.sliding.push_back(contact.force.sliding);
    }
    return contacts;
  }

  std::optional<box2d_granular::PenaltyWorld> world_;
  bool spins_ = false;  ///< whether any force asks for them
  Stopwatch stopwatch_;
};

}  // namespace

std::unique_ptr<Engine> makeBox2dPenalty() {
  return std::make_unique<Box2dPenalty>();
}

EngineEntry box2dPenaltyEngine() {
  return {"box2d-penalty", "the scene's soft law on Box2D's collision detection", makeBox2dPenalty};
}

EngineEntry box2dPenaltyMirror() {
  return mirrorEntry("grain-as-box2d-penalty",
                     "the in-house engine with the penalty engine's conventions", "box2d-penalty",
                     {"linear", "hertz"}, conventionsOf(Box2dPenalty().capabilities().lawOptions));
}

}  // namespace crossgrain
