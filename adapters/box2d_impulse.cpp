#include <box2d/b2_common.h>
#include <box2d/b2_settings.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "adapters/box2d_common.hpp"
#include "adapters/grain.hpp"
#include "adapters/pair_table.hpp"
#include "adapters/stopwatch.hpp"
#include "adapters/suitability.hpp"
#include "engines/box2d/impulse_world.hpp"
#include "law/law_options.hpp"

namespace crossgrain {

using box2d_granular::PairImpulse;
using box2d_granular::PairInertia;
using box2d_granular::Restitution;
using box2d_granular::WallImpulse;

namespace {

Contacts contactsFrom(std::span<const PairImpulse> impulses, double interval,
                      const box2d_granular::Members& members) {
  Contacts contacts;
  for (const PairImpulse& impulse : impulses) {
    const auto [normal, overlap] = box2d_granular::pairGeometry(members, impulse.i, impulse.j);
    contacts.i.push_back(impulse.i);
    contacts.j.push_back(impulse.j);
    contacts.normal.push_back(toVec2(normal));
    contacts.overlap.push_back(overlap);
    contacts.normalForce.push_back(impulse.normal / interval);
    contacts.tangentialForce.push_back(impulse.tangential / interval);
  }
  return contacts;
}

Contacts contactsFrom(const box2d_granular::ImpulseWorld::PairPoints& points, double interval) {
  Contacts contacts;
  for (const auto& [pair, sum] : points) {
    const auto one = sum.contact();
    contacts.i.push_back(pair.first);
    contacts.j.push_back(pair.second);
    contacts.normal.push_back(toVec2(one.normal));
    contacts.overlap.push_back(sum.depth);
    contacts.normalForce.push_back(one.pressing / interval);
    contacts.tangentialForce.push_back(one.along / interval);
    contacts.rollingTorque.push_back(one.left / interval);
    contacts.point.push_back(toVec2(one.place));
  }
  return contacts;
}

SettingSpec iterations(const char* name, double value, const char* doc) {
  return {name, value, "-", doc, {}, 1.0, 1e6, true, SettingRole::iterations};
}

double friction(const ContactLaw& law) {
  const bool frictionless = law.soft() && law.tangential == TangentialLaw::none;
  return frictionless ? 0.0 : law.mu;
}

std::vector<Deviation> deviationsOf(const Scene& scene, const box2d_granular::Model& model,
                                    const std::vector<PairCoefficients>& pairs) {
  std::vector<Deviation> deviations;
  if (scene.law.normal != NormalLaw::rigid && !pairs.empty()) {
    std::string each;
    for (const PairCoefficients& pair : pairs) {
      each += fmt::format("{}{}: {:.4f}", each.empty() ? "" : "; ", pair.pair, pair.en);
      if (pair.mu > 0.0) each += fmt::format(", {:.4f}", pair.et0);
    }
    const char* tangential = !(pairs.front().mu > 0.0) ? ""
                             : scene.shapes.empty()
                                 ? ", and its -psi_f/psi_i at psi_i = 0.5 as e_t0"
                                 : ", and e_t0 = 0";
    deviations.push_back(
        {"normal", pairs.front().en, "-",
         fmt::format("rigid contacts with the soft law's e_n{} ({})", tangential, each)});
  }
  const double unit = model.lengthUnit;
  deviations.push_back({"rounding", box2d_granular::roundingAt(box2d_granular::extentOf(model)),
                        "m", "largest rounding of positions to float32"});
  deviations.push_back({"slop", static_cast<double>(b2_linearSlop) * unit, "m",
                        "largest overlap that is left standing"});
  deviations.push_back({"speed_limit", static_cast<double>(b2_maxTranslation) * unit / model.dt,
                        "m/s", "speed above which Box2D slows disks"});
  if (model.skin > 0.0)
    deviations.push_back({"skin", model.skin * static_cast<double>(b2_polygonRadius) * unit, "m",
                          "reach of polygons beyond their sides"});
  return deviations;
}

/// Box2D's own solver for rigid disks, extended by tangential restitution (see
/// engines/box2d/impulse_world.hpp). A soft law is run as the rigid one that restores as much, pair
/// by pair: that is a deviation.
///
/// Forces are impulses divided by the time in which they acted: the last step for instant
/// contacts, and the time since the last accumulated snapshot for accumulated ones. Before the
/// first step there are none, so contacts and wall forces are absent.
class Box2dImpulse : public Engine {
 public:
  Capabilities capabilities() const override {
    Capabilities can;
    can.version = box2dVersion();
    for (const Effect effect : allEffects) can.effects[effect] = Support::optional;
    for (const Effect effect : {Effect::rollingResistance, Effect::cohesion, Effect::pairMaterials})
      can.effects[effect] = Support::never;
    // The plate's spring and dashpot are a soft law, for which the step of rigid contacts is too
    // long.
    can.effects[Effect::bottomFriction] = Support::never;
    can.effects[Effect::bottomSpinFriction] = Support::never;
    // A soft law's tangential spring and dashpot are folded into e_n and e_t0.
    can.effects[Effect::tangentialSpring] = Support::never;
    can.effects[Effect::tangentialDamping] = Support::never;
    can.lawOptions = {{"normal", {"rigid"}},
                      {"lever_arm", {"overlap_middle"}},
                      {"velocity_arm", {"lever_arm"}},
                      {"plane_arm", {"middle"}}};
    can.precisions = {Precision::float32};
    can.accumulatedContacts = true;
    can.settings = {
        {"dt", 5e-4, "s", "time step; 0: the case's"},
        lengthUnitSetting(),
        {"impact_speed", 0.005, "m/s",
         "contacts that begin more slowly get no tangential restitution: the position solver moves "
         "enduring ones apart by up to Box2D's slop, and slop/dt is of this order"},
        iterations("velocity_iterations", 8.0, "of Box2D's velocity solver"),
        iterations("position_iterations", 3.0, "of Box2D's position solver"),
        {"skin", 0.0, "-", "that polygons have around them, of Box2D's own", {}, 0.0, 1.0}};
    can.limits = box2dLimits();
    can.limits.shapes = {ShapeKind::polygon, ShapeKind::capsule};
    can.limits.mostVertices = b2_maxPolygonVertices;
    return can;
  }

  EffectiveParameters load(const Scene& scene, const Settings& settings) override {
    const std::vector<SettingSpec> specs = capabilities().settings;
    const auto number = [&](const std::string& name) {
      return numberSetting(settings, specs, name);
    };
    const auto passes = [&](const std::string& name) { return static_cast<int>(number(name)); };
    if (scene.bottom && scene.bottom->mu > 0.0) throw UnsupportedScene("has no bottom_friction");
    if (scene.law.stiffens())
      throw UnsupportedScene(
          "has rigid contacts, normal = \"rigid\"; they can stand for normal = \"linear\", whose "
          "restitutions are the same at every speed");
    if (scene.law.damper != Damper::constant && mattersTo(scene.law, "damper"))
      throw UnsupportedScene("can stand in for a linear law with damper = \"constant\" only");
    convex_ = !scene.shapes.empty();
    if (convex_ && scene.law.normal == NormalLaw::rigid && scene.law.et0 != 0.0)
      throw UnsupportedScene("has no tangential restitution of convex bodies, so it needs et0 = 0");
    const double dt = number("dt") > 0.0 ? number("dt") : scene.dt;
    box2d_granular::Model model = box2dModel(scene, dt, number("length_unit"));
    model.skin = number("skin");

    disks_ = scene.disks;
    law_ = scene.law;
    known_.clear();
    world_.emplace(
        model,
        box2d_granular::ImpulseOptions{
            friction(law_), [this](std::int32_t i, std::int32_t j) { return restitution(i, j); },
            number("impact_speed"), passes("velocity_iterations"), passes("position_iterations")});
    rotation_ = model.rotation;
    spins_ = convex_ || effectsOf(scene).contains(Effect::friction);
    stopwatch_ = {};

    EffectiveParameters effective;
    effective.dt = dt;
    effective.precision = "float";
    effective.integrator = "semi_implicit_euler with sequential impulses";
    effective.velocityLag = 0.5 * effective.dt;
    effective.effects = simulatedEffects(capabilities(), scene);
    effective.pairs = pairTable(scene, [&](double reducedMass) {
      const double q = disks_.inertia[0] / (disks_.mass[0] * disks_.radius[0] * disks_.radius[0]);
      const Restitution used =
          restitutionOf({1.0 / reducedMass, (1.0 + (rotation_ ? 1.0 / q : 0.0)) / reducedMass});
      ContactLaw law;
      law.normal = NormalLaw::rigid;
      law.mu = friction(law_);
      law.en = used.normal;
      law.et0 = used.tangential;
      return coefficientsOf(law);
    });
    effective.deviations = deviationsOf(scene, model, effective.pairs);
    if (world_->restSpeed() > 0.0)
      effective.deviations.push_back({"restitution_threshold", world_->restSpeed(), "m/s",
                                      "impacts slower than what gravity gives in two steps do not "
                                      "rebound"});
    return effective;
  }

  double advance(double t) override {
    const auto wanted = std::llround(t / world_->dt());
    const Stopwatch::Lap lap(stopwatch_);
    while (static_cast<long long>(world_->steps()) < wanted) world_->step();
    return world_->time();
  }

  Snapshot snapshot(ContactReport report) override {
    const box2d_granular::Members& members = world_->members();
    Snapshot snapshot = kinematicSnapshot(members, world_->time(), spins_);
    const bool accumulated = report == ContactReport::accumulated;
    const std::uint64_t steps =
        accumulated ? world_->sumSteps() : std::min<std::uint64_t>(1, world_->steps());
    if (steps == 0) return snapshot;

    const double interval = static_cast<double>(steps) * world_->dt();
    snapshot.contactInterval = interval;
    const std::span<const WallImpulse> onWalls =
        accumulated ? world_->wallSums() : world_->lastWallImpulses();
    for (std::size_t b = 0; b < onWalls.size(); ++b) {
      snapshot.bodies[b].force = toVec2((1.0 / interval) * onWalls[b].linear);
      snapshot.bodies[b].torque = onWalls[b].angular / interval;
    }
    if (report == ContactReport::instant)
      snapshot.contacts = convex_ ? contactsFrom(world_->lastPoints(), interval)
                                  : contactsFrom(world_->lastImpulses(), interval, members);
    if (accumulated) {
      snapshot.contacts = convex_ ? contactsFrom(world_->pointSums(), interval)
                                  : contactsFrom(world_->sums(), interval, members);
      world_->clearSums();
    }
    return snapshot;
  }

  Stats stats() const override {
    return {world_->steps(),
            world_->contactEvaluations(),
            stopwatch_.wallSeconds,
            stopwatch_.cpuSeconds,
            {{"impacts", static_cast<double>(world_->impacts())}}};
  }

 private:
  /// Restitutions of disk i with disk or wall j.
  Restitution restitution(std::int32_t i, std::int32_t j) {
    PairInertia pair;
    for (const std::int32_t id : {i, j}) {
      const auto k = static_cast<std::size_t>(id);
      if (k >= disks_.size()) continue;  // walls are infinitely heavy
      pair.normal += 1.0 / disks_.mass[k];
      pair.tangential += 1.0 / disks_.mass[k];
      if (rotation_) pair.tangential += disks_.radius[k] * disks_.radius[k] / disks_.inertia[k];
    }
    return restitutionOf(pair);
  }

  Restitution restitutionOf(const PairInertia& pair) {
    if (law_.normal == NormalLaw::rigid) return {law_.en, law_.et0};
    const auto [known, isNew] = known_.try_emplace({pair.normal, pair.tangential});
    if (isNew) known->second = box2d_granular::rigidEquivalent(law_, pair);
    if (convex_) known->second.tangential = 0.0;  // of which the arms of an impact decide
    return known->second;
  }

  Disks disks_;
  ContactLaw law_;
  /// Restitutions of a soft law, by what the contact feels of the two.
  std::map<std::pair<double, double>, box2d_granular::Restitution> known_;
  std::optional<box2d_granular::ImpulseWorld> world_;
  bool rotation_ = false;
  bool convex_ = false;  ///< whether there are convex bodies
  bool spins_ = false;   ///< whether any force asks for them
  Stopwatch stopwatch_;
};

}  // namespace

std::unique_ptr<Engine> makeBox2dImpulse() {
  return std::make_unique<Box2dImpulse>();
}

EngineEntry box2dImpulseEngine() {
  return {"box2d-impulse", "Box2D's impulse solver, with tangential restitution", makeBox2dImpulse};
}

EngineEntry box2dImpulseMirror() {
  return mirrorEntry("grain-as-box2d-impulse",
                     "the in-house engine with impulses, as Box2D's solver has them for two disks",
                     "box2d-impulse", {"rigid"},
                     {{"normal", {"rigid"}},
                      {"integrator", {"semi_implicit_euler"}},
                      {"damping_velocity", {"lagged"}},
                      {"lever_arm", {"overlap_middle"}},
                      {"velocity_arm", {"lever_arm"}},
                      {"plane_arm", {"middle"}}});
}

/// In the quick cell Box2D's solver holds about 16 times the pressure of the soft law. A stiffer
/// law is no mirror proper, so it stands for its peer in no scene and runs only where it is named.
EngineEntry stiffGrainEngine() {
  return {.name = "grain-stiff",
          .summary = "the in-house engine with contacts 25 times as stiff, towards rigid ones",
          .make = [] { return makeStiffGrain(25.0); },
          .mirrors = "box2d-impulse"};
}

}  // namespace crossgrain
