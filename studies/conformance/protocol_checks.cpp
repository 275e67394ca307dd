// Capabilities and the life cycle (load, advance, snapshot, load again), on which every run relies.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "adapters/pair_table.hpp"
#include "adapters/suitability.hpp"
#include "law/law_options.hpp"
#include "studies/conformance/check_context.hpp"
#include "studies/conformance/conformance_scenes.hpp"
#include "support/scratch_folder.hpp"

namespace crossgrain::conformance {
namespace {

bool named(const std::vector<Deviation>& deviations, const std::string& name) {
  return std::ranges::find(deviations, name, &Deviation::name) != deviations.end();
}

// ---- capabilities -------------------------------------------------------------------------------

void capabilitiesAreComplete(CheckContext& context) {
  context.expect(!context.can.version.empty(), "it reports no version");
  context.expect(!context.can.precisions.empty(), "it reports no precision");
}

void lawOptionsAreThoseOfTheCaseFiles(CheckContext& context) {
  context.expect(context.can.lawOptions.contains("normal"), "it does not list its normal laws");
  ContactLaw law;
  for (const auto& [name, values] : context.can.lawOptions) {
    context.expect(!values.empty(), text(name, " has no value"));
    for (const std::string& value : values) {
      setLawOption(law, name, value);
      context.equal(std::ranges::count(values, value), 1,
                    text("times that ", name, " = ", value, " is listed"));
    }
  }
}

void settingsAreDocumented(CheckContext& context) {
  std::set<std::string> names;
  for (const SettingSpec& setting : context.can.settings) {
    context.expect(!setting.name.empty(), "a setting has no name");
    context.expect(names.insert(setting.name).second, text(setting.name, " is listed twice"));
    context.expect(!setting.doc.empty(), text(setting.name, " has no doc"));
    context.expect(!std::holds_alternative<double>(setting.defaultValue) || !setting.unit.empty(),
                   text(setting.name, " has no unit"));
    const auto* chosen = std::get_if<std::string>(&setting.defaultValue);
    if (chosen && !setting.choices.empty())
      context.equal(std::ranges::count(setting.choices, *chosen), 1,
                    text("times that the default of ", setting.name, " is among its choices"));
  }
}

void defaultsSpokenAloudChangeNothing(CheckContext& context) {
  const Scene scene = context.busy();
  const Snapshot silent = context.run(scene, busyEnd);
  const double dt = context.effective.dt;
  Settings spoken = context.entry.settings;
  for (const SettingSpec& setting : context.can.settings)
    spoken.try_emplace(setting.name, setting.defaultValue);
  context.load(scene, spoken);
  context.equal(context.effective.dt, dt, "the time step with its defaults as settings");
  context.expect(sameBits(context.at(busyEnd), silent),
                 "with its defaults as settings, and without");
}

/// Of what is loaded.
void expectItsConstants(CheckContext& context) {
  const EffectiveParameters& effective = context.effective;
  context.above(effective.dt, 0.0, "the time step");
  context.equal(effective.precision, toString(context.can.precisions.front()), "the precision");
  context.expect(!effective.integrator.empty(), "it reports no integrator");
  // The constants of a pair are the scene's, whatever the engine's mixing rule, unless it declares
  // that its contacts are stiffer; then restitutions stay, γ²/k being the same.
  double stiffness = 1.0;
  for (const Deviation& deviation : effective.deviations) {
    context.expect(!deviation.name.empty() || deviation.note.empty(), deviation.name);
    if (deviation.name == "stiffness") stiffness = deviation.value;
  }
  if (effective.pairs.empty()) context.skip("reports no pairs: the constants that it uses");
  // Some roundings of a number are some times its ε, 2⁻²³ in single precision.
  const Tolerance rounding = {1e-14, context.single() ? 1e-6 : 1e-12,
                              "a mixing rule undone: some roundings"};
  const PairCoefficients wanted = coefficientsOf(context.scene.law);
  const double root = std::sqrt(stiffness);
  using Coefficients = PairCoefficients;
  for (const Coefficients& used : effective.pairs) {
    for (const auto& [name, constant, factor] : {std::tuple("kn", &Coefficients::kn, stiffness),
                                                 {"gn", &Coefficients::gn, root},
                                                 {"kt", &Coefficients::kt, stiffness},
                                                 {"gt", &Coefficients::gt, root},
                                                 {"mu", &Coefficients::mu, 1.0},
                                                 {"en", &Coefficients::en, 1.0},
                                                 {"et0", &Coefficients::et0, 1.0}})
      context.near(used.*constant, wanted.*constant * factor, rounding,
                   text(used.pair, ", ", name));
    for (const auto& [name, constant] : {std::pair("kr", &Coefficients::kr),
                                         {"gr", &Coefficients::gr},
                                         {"mu_r", &Coefficients::muR},
                                         {"kc", &Coefficients::kc},
                                         {"w", &Coefficients::w}})
      if (used.*constant != 0.0 && stiffness == 1.0)  // they may be left out
        context.near(used.*constant, wanted.*constant, rounding, text(used.pair, ", ", name));
  }
}

void realisedSaysWhatTheSceneSays(CheckContext& context) {
  context.load(encounterScene(crookedEncounter(), context.law(), coarseSteps));
  expectItsConstants(context);
  for (const ContactLaw& law : resistingLaws(context.can))
    if (!context.refusal(encounterScene(crookedEncounter(), law, coarseSteps)))
      expectItsConstants(context);
}

/// It simulates what the scene calls for, or reports a deviation.
void simulatesWhatTheSceneCallsFor(CheckContext& context) {
  ContactLaw undamped = context.law();
  undamped.gn = 0.0;
  undamped.en = 1.0;
  ContactLaw dashpotless = context.law();
  dashpotless.gt = 0.0;
  const Scene full = plateScene(context.law());
  Scene spinFree = full;
  spinFree.bottom->spin = false;
  const auto meeting = [](const ContactLaw& law) { return encounterScene({}, law, coarseSteps); };
  std::vector<Scene> scenes = {meeting(frictionless(undamped)),
                               meeting(frictionless(context.law())),
                               meeting(dashpotless),
                               meeting(context.law()),
                               full,
                               spinFree};
  for (const ContactLaw& law : resistingLaws(context.can)) {
    scenes.push_back(meeting(law));
    if (law.rolls()) scenes.push_back(meeting(frictionless(law)));
  }
  if (context.can.effects.at(Effect::pairMaterials) != Support::never)
    scenes.push_back(withMaterials(meeting(context.law())));
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    const Scene scene = context.simplified(scenes[k]);
    const Effects called = effectsOf(scene);
    // Laws of its own that it refuses have their checks elsewhere.
    if (!context.loads(scene, k < 6)) continue;
    for (const Effect effect : allEffects) {
      const bool simulated = context.effective.effects.contains(effect);
      context.expect(simulated == called.contains(effect) ||
                         named(context.effective.deviations, toString(effect)),
                     text(toString(effect), " is called for: ", called.contains(effect),
                          ", simulated: ", simulated));
    }
  }
}

/// Capabilities, the harness' own account of a scene and EffectiveParameters agree, of a scene that
/// calls for everything: an effect that an engine never simulates is not among the simulated ones,
/// a soft law's springs in a rigid engine included.
void effectsAreThoseThatItsCapabilitiesSay(CheckContext& context) {
  Scene full = fullScene(context.can, fullLaw());
  context.requireEqual(effectsOf(full).size(), allEffects.size(),
                       "effects of a scene that calls for all");
  std::vector<std::string> anything = effectNames();
  for (const LawOption& option : lawOptions()) anything.emplace_back(option.name);
  Scene scene = adaptScene(context.can, context.withItsInertia(full), anything).scene;
  try {
    context.effective = context.engine.load(scene, context.entry.settings);
  } catch (const UnsupportedScene&) {  // nor can it put another law in this one's place
    full = plateScene(context.law());
    scene = adaptScene(context.can, context.withItsInertia(full), anything).scene;
    context.effective = context.engine.load(scene, context.entry.settings);
  }
  for (const Effect effect : effectsOf(full))
    context.equal(context.effective.effects.contains(effect),
                  context.can.effects.at(effect) != Support::never, toString(effect));
  context.expect(context.effective.effects == simulatedEffects(context.can, scene),
                 "its effects are not those of the scene that it has");
}

// ---- life cycle ---------------------------------------------------------------------------------

/// A disk alone, so many steps in one advance.
void longAdvancesAreWhole(CheckContext& context) {
  constexpr double steps = 5000.0;
  Scene scene = emptyScene(context.law(), coarseSteps);
  addDisk(scene, smallRadius, smallMass, Vec2::Zero(), {0.01, 0.0});
  context.load(scene);
  const Snapshot there = context.at(steps * context.effective.dt);
  const Tolerance rounding = context.byPrecision(1e-9, 1e-3, "a flight, rounded in every step");
  context.near(there.position[0].x(), steps * context.effective.dt * scene.disks.velocity[0].x(),
               {0.0, rounding.absolute, rounding.why},
               text("the way flown in ", steps, " steps at once [m]"));
}

void advancesByWholeSteps(CheckContext& context) {
  context.load(context.busy());
  const double dt = context.effective.dt;
  const Tolerance rounding = {0.0, 1e-12, "steps·dt in one order of additions or another"};
  const Tolerance step = {1.001 * dt, 0.0, "arrays may be staggered by up to a step"};
  std::vector<double> stops = {0.0, 0.3, 1.0, 10.4, 10.6, 11.0};
  while (stops.back() < 40.0) stops.push_back(stops.back() + 1.0);  // as often as a run is stopped
  for (const double steps : stops) {
    const double reached = context.engine.advance(steps * dt);
    const auto whole = static_cast<double>(std::llround(steps));
    context.near(reached, whole * dt, rounding, text("advance to ", steps, " steps"));
    context.equal(context.engine.stats().steps, static_cast<std::uint64_t>(whole), "steps counted");
    const Snapshot now = context.engine.snapshot(ContactReport::none);
    context.near(now.positionTime, reached, rounding, "position_time");
    context.near(now.velocityTime, reached, step, "velocity_time");
    context.near(now.contactTime, reached, step, "contact_time");
    context.expect(!now.contacts, "shows contacts that were not asked for");
  }
  context.engine.advance(busyEnd);
  const Stats stats = context.engine.stats();
  context.above(stats.contactEvaluations, 0u, "contact_evaluations");
  context.above(stats.wallSeconds, 0.0, "wall_seconds");
  context.above(stats.cpuSeconds, 0.0, "cpu_seconds");
  longAdvancesAreWhole(context);
}

void startIsTheScene(CheckContext& context) {
  const Scene scene = context.busy();
  context.load(scene);
  const Snapshot start = context.engine.snapshot(ContactReport::none);
  const Tolerance rounding = context.byPrecision(1e-15, 1e-7, "the given numbers, rounded once");
  context.requireEqual(start.position.size(), scene.disks.size(), "positions shown");
  context.requireEqual(start.velocity.size(), scene.disks.size(), "velocities shown");
  const std::vector<DiskState> states = statesOf(scene, start);
  for (std::size_t i = 0; i < states.size(); ++i) {
    context.near(states[i].position, scene.disks.position[i], rounding, "a disk's position");
    context.near(states[i].velocity, scene.disks.velocity[i] + start.velocityTime * scene.gravity,
                 rounding, "a disk's velocity");
    context.near(states[i].spin, scene.disks.spin[i], rounding, "a disk's spin");
  }
  context.requireEqual(start.bodies.size(), scene.bodies.size(), "wall bodies shown");
  context.requireEqual(start.wallPosition.size(), scene.wallDiskCount(), "wall disks shown");
  std::size_t k = 0;
  for (const WallBody& body : scene.bodies)
    for (const Vec2& position : body.diskPosition)
      context.near(start.wallPosition[k++], position, rounding, "a wall disk's position");
}

void lookingChangesNothing(CheckContext& context) {
  const Scene scene = context.busy();
  const Snapshot unseen = context.run(scene, busyEnd);
  context.load(scene);
  for (int k = 0; k < 20; ++k) {
    context.engine.advance(busyEnd * k / 20);
    context.engine.snapshot(ContactReport::none);
    if (context.can.instantContacts) context.engine.snapshot(ContactReport::instant);
    if (context.can.accumulatedContacts) context.engine.snapshot(ContactReport::accumulated);
    context.engine.stats();
  }
  const Snapshot seen = context.at(busyEnd);
  if (context.contactReport() == ContactReport::accumulated) {  // each begins another interval
    context.expect(seen.position == unseen.position,
                   "positions differ from those of a run without snapshots");
  } else {
    context.expect(sameBits(seen, unseen), "with many snapshots, and without");
  }
  const Snapshot once = context.engine.snapshot(ContactReport::none);
  context.expect(sameBits(once, context.engine.snapshot(ContactReport::none)),
                 "two snapshots of one state");
}

/// The heap, and heaps under laws whose contacts remember other things, where the engine has such.
std::vector<Scene> heaps(CheckContext& context) {
  std::vector<Scene> scenes = {context.busy()};
  const Scene plate = context.simplified(plateScene(context.law()));
  if (plate.bottom) scenes.push_back(plate);
  for (const ContactLaw& law : resistingLaws(context.can)) {
    Scene scene = context.simplified(busyScene(law));
    if (!context.refusal(scene)) scenes.push_back(std::move(scene));
  }
  return scenes;
}

void expectAFreshStart(CheckContext& context, const Scene& scene) {
  const Snapshot first = context.run(scene, busyEnd);
  const Stats stats = context.engine.stats();
  context.run(encounterScene(crookedEncounter(), context.law(), 37.0), Encounter::end);
  context.load(scene);
  context.equal(context.engine.stats().steps, 0u, "steps counted after loading");
  const Snapshot second = context.at(busyEnd);
  context.expect(sameBits(second, first), "loaded the second time, and the first");
  context.equal(context.engine.stats().steps, stats.steps, "steps counted the second time");
  context.equal(context.engine.stats().contactEvaluations, stats.contactEvaluations,
                "contact_evaluations the second time");
  // No scene came in between that would have removed data kept for these pairs.
  context.expect(sameBits(context.run(scene, busyEnd), second),
                 "loaded a third time, at once, and the second");
}

/// In a new worker, after a scene of as many bodies that has other constants: nothing may stay of
/// these.
void expectNothingOfAnother(CheckContext& context, const Scene& scene) {
  const Snapshot wanted = context.run(scene, busyEnd);
  Scene other = scene;
  for (double* constant : {&other.law.kn, &other.law.gn, &other.law.mu}) *constant *= 0.8;
  for (double& mass : other.disks.mass) mass *= 1.1;
  for (double& inertia : other.disks.inertia) inertia *= 1.1;
  if (context.refusal(other)) return;
  const auto worker = context.start(context.entry);
  for (const Scene& each : {other, scene}) {
    worker->load(context.withItsInertia(each), context.entry.settings);
    worker->advance(busyEnd);
  }
  context.expect(sameBits(worker->snapshot(context.contactReport()), wanted),
                 "loaded after a scene with other constants, and without");
}

void loadingStartsAfresh(CheckContext& context) {
  for (const Scene& scene : heaps(context)) expectAFreshStart(context, scene);
  expectNothingOfAnother(context, context.busy());
}

void workersAgreeBitForBit(CheckContext& context) {
  const Scene scene = context.busy();
  const Snapshot here = context.run(scene, busyEnd);
  const auto other = context.start(context.entry);
  other->load(context.scene, context.entry.settings);
  other->advance(busyEnd);
  context.expect(sameBits(other->snapshot(context.contactReport()), here), "two workers");
}

/// The largest difference between velocities of one disk [m/s].
double velocitiesApart(const Snapshot& a, const Snapshot& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.velocity.size(); ++i)
    most = std::max(most, (a.velocity[i] - b.velocity[i]).norm());
  return most;
}

/// Whether what is taken up in the middle, by whichever worker, goes on as before where nothing has
/// a spring, but for a tenth of what friction makes of it: else it is not springs that are lost.
/// @param withSprings  by how much velocities are off with friction [m/s]
bool resumesWithoutSprings(CheckContext& context, Scene scene, double middle, double end,
                           double withSprings) {
  changeLaws(scene, [](ContactLaw& law) { law = frictionless(law); });
  if (context.refusal(scene)) return false;
  const ScratchFolder scratch;
  const std::filesystem::path file = scratch.path / "checkpoint";
  context.at(middle);
  context.engine.checkpoint(file);
  const Snapshot whole = context.at(end);
  const auto other = context.start(context.entry);
  other->load(context.scene, context.entry.settings);
  other->restore(file);
  other->advance(end);
  return velocitiesApart(other->snapshot(context.contactReport()), whole) < 0.1 * withSprings;
}

/// A run that another worker resumes from the middle goes on to the bit, and the one that wrote the
/// checkpoint is unaffected by it. Of a scene that is loaded.
void expectResumed(CheckContext& context, double middle, double end) {
  const Scene scene = context.scene;
  const Snapshot whole = context.at(end);
  const Snapshot half = context.run(scene, middle);
  const ScratchFolder scratch;
  const std::filesystem::path file = scratch.path / "checkpoint";
  const auto other = context.start(context.entry);
  try {
    context.engine.checkpoint(file);
    other->load(context.scene, context.entry.settings);
    other->restore(file);
  } catch (const EngineFailure& failure) {
    context.suspect("checkpoints are declared, and there are none that work");
    context.require(false, text("it declares checkpoints, and one at t = ", middle,
                                " s fails: ", failure.what()));
  }
  context.expect(sameBits(context.at(end), whole),
                 "the run that wrote a checkpoint, and one that did not");
  context.expect(sameBits(other->snapshot(context.contactReport()), half),
                 "the restored state, at once");
  other->advance(end);
  const Snapshot resumed = other->snapshot(context.contactReport());
  const Comparison same = sameBits(resumed, whole);
  context.expect(same, text("resumed from a checkpoint at t = ", middle, " s, and in one go"));
  const bool fixed =
      scene.bodies.empty() || scene.bodies.front().motion.kind == Motion::Kind::fixed;
  if (same.difference.empty() || !fixed) return;
  // A start from the same places and velocities has no springs.
  Scene afresh = scene;
  afresh.disks.position = half.position;
  afresh.disks.velocity = half.velocity;
  afresh.disks.spin = spinsOf(scene, half);
  if (context.refusal(afresh)) return;
  const Snapshot forgot = context.at(end - middle);
  const double off = velocitiesApart(resumed, whole);
  // An engine that shows no contacts may have springs.
  const bool springs = !half.contacts || std::ranges::any_of(half.contacts->tangentialForce,
                                                             [](double f) { return f != 0.0; });
  if (springs && velocitiesApart(resumed, forgot) < 0.1 * off &&
      resumesWithoutSprings(context, scene, middle, end, off))
    context.suspect(
        "checkpoints lose the springs of contacts: a restored run goes on as a start without them "
        "does");
}

/// Pairs that approach from gaps of a tenth of a radius to three: whatever the skin of lists is,
/// some are met too late by a list that takes the place where it was taken up for the one where it
/// was made.
Scene approachScene(const ContactLaw& law) {
  Scene scene = emptyScene(law, coarseSteps);
  for (int k = 0; k < 30; ++k) {
    const Vec2 place(0.0, 6.0 * smallRadius * k);
    const double apart = smallRadius * (2.0 + 0.1 * (k + 1));
    for (const double side : {-0.5, 0.5})
      addDisk(scene, smallRadius, smallMass, place + Vec2(side * apart, 0.0),
              {-side * Encounter::speed, 0.0});
  }
  return scene;
}

void checkpointsGoOnToTheBit(CheckContext& context) {
  context.needs(checkpoints);
  context.examine(checkpoints);
  // On the plane when the contact is deepest, about; engines without planes have the heap alone.
  constexpr double inContact = Encounter::gap / 0.05 + 0.5 * smallContactTime;
  if (!context.refusal(landingScene(context.law(), coarseSteps)))
    expectResumed(context, inContact, Encounter::end);
  for (const Scene& scene : heaps(context)) {
    context.load(scene);
    expectResumed(context, 0.5 * busyEnd, busyEnd);
  }
  context.load(context.simplified(approachScene(context.law())));
  expectResumed(context, 0.146 * smallRadius / Encounter::speed,
                4.0 * smallRadius / Encounter::speed);
}

/// A step that it is set to is the step that it takes: half as long takes twice as many, flies as
/// far, and comes to other roundings of a contact.
void settingDtIsUsed(CheckContext& context) {
  context.needs(settingDt);
  Scene scene = encounterScene(crookedEncounter(), context.law(), coarseSteps);
  const Vec2 alone(0.3, -0.2), flying(0.31, -0.17);
  addDisk(scene, smallRadius, smallMass, alone, flying);
  const auto ended = [&](double dt) {
    context.load(scene, {{"dt", dt}});
    context.near(context.effective.dt, dt, {0.0, 1e-12, "as it was set"}, "the time step [s]");
    const Snapshot after = context.at(Encounter::end);
    context.equal(context.engine.stats().steps,
                  static_cast<std::uint64_t>(std::llround(Encounter::end / dt)),
                  text("steps of ", dt, " s that it counts"));
    context.near(Vec2(after.position[2] - alone), Vec2(after.positionTime * flying),
                 context.byPrecision(1e-9, 1e-3, "a flight, rounded in every step"),
                 text("the way flown in steps of ", dt, " s [m]"));
    return after;
  };
  const Snapshot whole = ended(scene.dt), halves = ended(0.5 * scene.dt);
  context.examine(settingDt);
  if (!context.rigid())
    context.expect(whole.velocity[0] != halves.velocity[0],
                   "a collision in steps half as long is the same to the bit");
}

}  // namespace

Checks capabilityChecks() {
  return {
      {"CapabilitiesAreComplete", "it says what it can do", capabilitiesAreComplete},
      {"LawOptionsAreThoseOfTheCaseFiles",
       "its law options have names and values that case files know",
       lawOptionsAreThoseOfTheCaseFiles},
      {"SettingsAreDocumented", "its settings have names, units and words", settingsAreDocumented},
      {"DefaultsSpokenAloudChangeNothing", "its defaults as settings change nothing",
       defaultsSpokenAloudChangeNothing},
      {"SettingDtIsUsed", "a time step that it is set to is the one that it takes",
       settingDtIsUsed},
      {"RealisedSaysWhatTheSceneSays", "the constants that it uses are the scene's",
       realisedSaysWhatTheSceneSays},
      {"SimulatesWhatTheSceneCallsFor", "it simulates what the scene calls for, or says otherwise",
       simulatesWhatTheSceneCallsFor},
      {"EffectsAreThoseThatItsCapabilitiesSay", "effects are those that its capabilities say",
       effectsAreThoseThatItsCapabilitiesSay},
  };
}

Checks lifecycleChecks() {
  return {
      {"AdvancesByWholeSteps", "it advances by whole steps and counts them", advancesByWholeSteps,
       2, true},
      {"StartIsTheScene", "it starts from the scene's own state", startIsTheScene, 2, true},
      {"LookingChangesNothing", "stops and looking change nothing", lookingChangesNothing, 2, true},
      {"LoadingStartsAfresh", "loading again starts afresh, to the bit", loadingStartsAfresh, 2,
       true},
      {"CheckpointsGoOnToTheBit", "a run taken up from a checkpoint goes on to the bit",
       checkpointsGoOnToTheBit},
      {"WorkersAgreeBitForBit", "two workers do the same, to the bit", workersAgreeBitForBit, 2,
       true},
  };
}

}  // namespace crossgrain::conformance
