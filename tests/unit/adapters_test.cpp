#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <ctime>

#include "adapters/grain.hpp"
#include "adapters/registry.hpp"
#include "adapters/stopwatch.hpp"
#include "adapters/suitability.hpp"
#include "cases/keys.hpp"
#include "engines/grain/kernels.hpp"
#include "law/law_options.hpp"
#include "tests/support/refusal.hpp"

namespace {

using namespace crossgrain;

Scene oneDisk() {
  Scene scene;
  scene.disks.radius = {1.0};
  scene.disks.mass = {1.0};
  scene.disks.inertia = {0.5};
  scene.disks.position = {Vec2::Zero()};
  scene.disks.velocity = {Vec2::Zero()};
  scene.disks.spin = {0.0};
  scene.law.kn = 100.0;
  scene.law.gn = 1.0;
  scene.law.kt = 50.0;
  scene.law.gt = 1.0;
  scene.law.mu = 0.5;
  scene.dt = 1e-3;
  return scene;
}

/// An engine that can do every effect, and do without it.
Capabilities able() {
  Capabilities can;
  for (const Effect effect : allEffects) can.effects[effect] = Support::optional;
  return can;
}

/// Message of the refusal; "" where the scene is taken.
std::string refusalOf(const Capabilities& can, const Scene& scene,
                      const std::vector<std::string>& mayDiffer) {
  return test::refusalOf<UnsupportedScene>([&] { adaptScene(can, scene, mayDiffer); });
}

TEST(Effects, AreDerivedFromTheScene) {
  Scene scene = oneDisk();
  EXPECT_EQ(effectsOf(scene),
            (Effects{Effect::normalDamping, Effect::friction, Effect::tangentialSpring,
                     Effect::tangentialDamping, Effect::rotation}));
  scene.law.tangential = TangentialLaw::none;
  EXPECT_EQ(effectsOf(scene), Effects{Effect::normalDamping});
  scene.bottom = BottomPlate{2e-5, 1.0, 1.0, 1e-4, 9.81, true};
  scene.gravity = {0.0, -9.81};
  WallBody body;
  body.motion.kind = Motion::Kind::rotating;
  scene.bodies.push_back(body);
  // Without friction nothing spins, so nothing brakes spins either.
  EXPECT_EQ(effectsOf(scene), (Effects{Effect::normalDamping, Effect::bottomFriction,
                                       Effect::gravity, Effect::movingWalls}));
}

TEST(Effects, RollingResistanceTurnsDisksAndCohesionDoesNot) {
  Scene scene = oneDisk();
  scene.law.tangential = TangentialLaw::none;
  scene.law.cohesion = CohesionLaw::area;
  EXPECT_EQ(effectsOf(scene), (Effects{Effect::normalDamping, Effect::cohesion}));
  scene.law.rolling = RollingLaw::constantTorque;
  EXPECT_EQ(effectsOf(scene), (Effects{Effect::normalDamping, Effect::rotation,
                                       Effect::rollingResistance, Effect::cohesion}));
}

TEST(Suitability, ALawThatAnEngineLacksIsNamedWithItsOption) {
  Scene scene = oneDisk();
  scene.law.rolling = RollingLaw::constantTorque;
  scene.law.muR = 0.1;
  Capabilities can = able();
  can.lawOptions["rolling"] = {"spring"};
  EXPECT_EQ(refusalOf(can, scene, {}),
            "has rolling = spring, not constant_torque; list \"rolling\" under [run] may_differ to "
            "run it all the same");
  can.lawOptions["rolling_length"] = {"smaller_radius"};
  scene.law.rolling = RollingLaw::spring;
  EXPECT_EQ(refusalOf(can, scene, {}),
            "has rolling_length = smaller_radius, not effective; list \"rolling_length\" under "
            "[run] may_differ to run it all the same");
  // Effects that the law lacks do not matter.
  scene.law.rolling = RollingLaw::none;
  EXPECT_EQ(refusalOf(can, scene, {}), "");
  can.effects[Effect::cohesion] = Support::never;
  scene.law.cohesion = CohesionLaw::dmt;
  EXPECT_EQ(refusalOf(can, scene, {}),
            "has no cohesion; list \"cohesion\" under [run] may_differ to run it all the same");
  EXPECT_FALSE(adaptScene(can, scene, {"cohesion"}).scene.law.coheres());
}

TEST(Suitability, ARefusalNamesAllThingsAndHowToAllowThem) {
  Capabilities can = able();
  can.effects[Effect::friction] = Support::never;
  can.lawOptions["tension"] = {"cut"};
  EXPECT_EQ(refusalOf(can, oneDisk(), {}),
            "has no friction; has tension = cut, not allow; list \"friction\", \"tension\" under "
            "[run] may_differ to run it all the same");
  EXPECT_EQ(
      refusalOf(can, oneDisk(), {"friction"}),
      "has tension = cut, not allow; list \"tension\" under [run] may_differ to run it all the "
      "same");
  const Adapted adapted = adaptScene(can, oneDisk(), {"friction", "tension"});
  EXPECT_EQ(adapted.deviations.size(), 2u);
  EXPECT_FALSE(effectsOf(adapted.scene).contains(Effect::friction));
  can = able();
  can.effects[Effect::gravity] = Support::always;
  const auto found = mismatches(can, oneDisk());
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].reason, "cannot do without gravity");
}

/// Rigid contacts stand for a soft law, and not for a kind of rolling resistance that they lack.
TEST(Suitability, AnEngineOfAnotherLawHasItsOwnKindsOfRolling) {
  Capabilities can = able();
  can.lawOptions = {{"normal", {"rigid"}}, {"rolling", {"none", "constant_torque"}}};
  can.effects[Effect::rollingResistance] = Support::optional;
  Scene scene = oneDisk();
  scene.law.rolling = RollingLaw::constantTorque;
  scene.law.muR = 0.1;
  EXPECT_EQ(refusalOf(can, scene, {"normal"}), "");
  scene.law.rolling = RollingLaw::viscous;
  scene.law.gr = 0.1;
  EXPECT_EQ(refusalOf(can, scene, {"normal"}),
            "has rolling = none | constant_torque, not viscous; list \"rolling\" under [run] "
            "may_differ to run it all the same");
}

TEST(Suitability, ASceneBeyondTheLimitsIsRefusedWhateverMayDiffer) {
  Capabilities can = able();
  Scene scene = oneDisk();
  scene.bodies.push_back({"wheel", {0, 0}, {{1.0, 0.0}}, {0.1}, {}, {}});
  scene.bodies.push_back({"floor", {0, 0}, {}, {}, {Plane{}}, {}});
  scene.bodies[1].motion.kind = Motion::Kind::rotating;
  const auto refusal = [&](const SceneLimits& limits) {
    can.limits = limits;
    return refusalOf(can, scene, {"gravity", "friction", "moving_walls"});
  };
  const double q = scene.disks.inertia[0] /
                   (scene.disks.mass[0] * scene.disks.radius[0] * scene.disks.radius[0]);
  using enum Motion::Kind;
  // Limits with one of their members set.
  const auto only = [](auto member, auto value) {
    SceneLimits limits;
    limits.*member = std::move(value);
    return limits;
  };
  const auto inertia = &SceneLimits::inertia;
  const auto walls = &SceneLimits::wallMotions, planes = &SceneLimits::planeMotions;
  const SceneLimits perBody = only(&SceneLimits::restitutionPerBody, true);
  EXPECT_EQ(refusal({}), "");
  EXPECT_EQ(refusal(only(inertia, std::vector{q})), "");
  EXPECT_EQ(
      refusal(only(inertia, std::vector{0.1 * q, 2.0 * q})),
      fmt::format("has moments of inertia of {} | {} m a², not {:.6g} m a²", 0.1 * q, 2.0 * q, q));
  EXPECT_EQ(refusal(only(walls, std::vector{fixed})), "");
  EXPECT_EQ(refusal(only(walls, std::vector{translating, radial})),
            "has walls that are translating | radial, not fixed as wheel is");
  EXPECT_EQ(refusal(only(planes, std::vector{fixed, translating})),
            "has planes that are fixed | translating, not rotating as those of floor are");
  EXPECT_EQ(refusal(only(planes, std::vector<Motion::Kind>{})), "has no planes, as floor has");
  const SceneLimits alongAxes = only(&SceneLimits::planesAlongAxes, true);
  EXPECT_EQ(refusal(alongAxes), "has planes along an axis only, and those of floor turn");
  scene.bodies[1].motion.kind = fixed;
  EXPECT_EQ(refusal(alongAxes), "");
  scene.bodies[1].planes.push_back({{0, 0}, {0.6, -0.8}});
  EXPECT_EQ(refusal(alongAxes),
            "has planes along an axis only, not with the normal (0.6, -0.8) of floor");
  scene.bodies[1].planes.pop_back();
  scene.bodies[1].motion.kind = rotating;
  EXPECT_EQ(refusal(perBody), "");  // the law is its own
  can.lawOptions["normal"] = {"rigid"};
  scene.law.gn = 0.1;
  const std::string several =
      "has one restitution for each body, and the soft law gives this scene's pairs several";
  const auto soft = [&] { return beyondLimits(perBody, scene, true); };
  EXPECT_EQ(soft(), std::vector{several});
  scene.bodies.clear();
  EXPECT_TRUE(soft().empty());
  // Effects that a case lets an engine leave out are gone, so nothing is refused.
  can.lawOptions.clear();
  can.effects[Effect::movingWalls] = Support::never;
  scene.bodies.push_back({"floor", {0, 0}, {}, {}, {Plane{}}, {}});
  scene.bodies[0].motion.kind = Motion::Kind::rotating;
  EXPECT_EQ(refusal(only(planes, std::vector{fixed})), "");
}

TEST(Suitability, WhatMayDifferIsTakenOutOfTheScene) {
  Capabilities can = able();
  for (const Effect effect : {Effect::bottomFriction, Effect::bottomSpinFriction, Effect::rotation})
    can.effects[effect] = Support::never;
  Scene scene = oneDisk();
  scene.bottom = BottomPlate{2e-5, 1.0, 1.0, 1e-4, 9.81, true};
  scene.disks.spin = {3.0};
  const Adapted adapted =
      adaptScene(can, scene, {"bottom_friction", "bottom_spin_friction", "rotation"});
  EXPECT_FALSE(adapted.scene.bottom);
  EXPECT_EQ(adapted.deviations.size(), 3u);
  EXPECT_FALSE(adapted.scene.rotation);
  EXPECT_EQ(adapted.scene.disks.spin, std::vector<double>{0.0});
  EXPECT_TRUE(effectsOf(adapted.scene).contains(Effect::friction));
  EXPECT_FALSE(effectsOf(adapted.scene).contains(Effect::rotation));
}

TEST(Suitability, AnEngineRunsInItsOwnPrecisionAndSaysWhereThatWasNotAskedFor) {
  Capabilities can = able();
  can.precisions = {Precision::float64};
  Scene scene = oneDisk();
  EXPECT_TRUE(adaptScene(can, scene, {}).deviations.empty());
  scene.precision = Precision::float32;
  const Adapted adapted = adaptScene(can, scene, {});
  EXPECT_EQ(adapted.scene.precision, Precision::float64);
  ASSERT_EQ(adapted.deviations.size(), 1u);
  EXPECT_EQ(adapted.deviations[0].name, "precision");
  EXPECT_EQ(adapted.deviations[0].note, "runs in double, not float");
  can.precisions = {Precision::float64, Precision::float32};
  EXPECT_EQ(adaptScene(can, scene, {}).scene.precision, Precision::float32);
  EXPECT_TRUE(adaptScene(can, scene, {}).deviations.empty());
}

/// Two disks that are about to graze each other.
Scene grazing() {
  Scene scene = oneDisk();
  for (auto* values : {&scene.disks.radius, &scene.disks.mass, &scene.disks.inertia})
    values->push_back(values->front());
  scene.disks.spin = {0.0, 0.0};
  scene.disks.position = {{-1.0, 0.0}, {1.0, 0.5}};
  scene.disks.velocity = {{1.0, 0.0}, {-1.0, 0.0}};
  return scene;
}

Snapshot after(Engine& engine, const Scene& scene) {
  engine.load(scene, {});
  engine.advance(0.5);
  return engine.snapshot(ContactReport::none);
}

TEST(GrainAdapter, BlockedDisksRubAndDoNotSpin) {
  Scene scene = grazing();
  const auto engine = makeGrain();
  const Snapshot free = after(*engine, scene);
  EXPECT_GT(std::abs(free.spin->at(0)), 0.1);
  scene.rotation = false;
  EXPECT_EQ(engine->load(scene, {}).effects,
            (Effects{Effect::normalDamping, Effect::friction, Effect::tangentialSpring,
                     Effect::tangentialDamping}));
  const Snapshot blocked = after(*engine, scene);
  EXPECT_EQ(*blocked.spin, (std::vector<double>{0.0, 0.0}));
  EXPECT_GT((blocked.velocity[0] - free.velocity[0]).norm(), 0.01);
}

TEST(GrainAdapter, StepsInTheScenesPrecision) {
  Scene scene = grazing();
  const auto engine = makeGrain();
  EXPECT_EQ(engine->load(scene, {}).precision, "double");
  const Snapshot exact = after(*engine, scene);
  scene.precision = Precision::float32;
  EXPECT_EQ(engine->load(scene, {}).precision, "float");
  const Snapshot rounded = after(*engine, scene);
  // float32 holds seven digits; 500 steps add their roundings.
  EXPECT_NEAR((rounded.position[0] - exact.position[0]).norm(), 0.0, 1e-4);
  EXPECT_NE(rounded.velocity[0].x(), exact.velocity[0].x());
}

// Two threads share every step by half: what they use is about twice what this one uses.
TEST(GrainAdapter, CpuTime_IsThatOfAllThreads) {
  Scene scene = oneDisk();
  constexpr int side = 60;
  Disks& disks = scene.disks;
  for (auto* each : {&disks.radius, &disks.mass, &disks.inertia, &disks.spin})
    each->assign(side * side, each->front());
  disks.velocity.assign(side * side, Vec2::Zero());
  disks.position.clear();
  for (int k = 0; k < side * side; ++k)
    disks.position.push_back(1.99 * Vec2(k % side, static_cast<double>(k / side)));
  const auto engine = makeGrain();
  engine->load(scene, {{"threads", 2.0}});
  const std::clock_t before = std::clock();  // of all threads
  engine->advance(4.0);
  const double all = static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
  EXPECT_GT(engine->stats().cpuSeconds, 0.8 * all);
  EXPECT_LT(engine->stats().cpuSeconds, 1.2 * all);
}

TEST(GrainAdapter, RunsThePairsOfMaterialsAndReportsTheirConstants) {
  Scene scene = grazing();
  const auto engine = makeGrain();
  const Snapshot alike = after(*engine, scene);
  Materials& materials = scene.materials.emplace();
  materials = {{"glass", "steel"}, {0, 1}, {}, std::vector<ContactLaw>(4, scene.law)};
  materials.ofBody.assign(scene.bodies.size(), 1);
  const Snapshot same = after(*engine, scene);
  EXPECT_EQ(same.velocity, alike.velocity);
  for (const std::size_t mixed : {1u, 2u}) materials.laws[mixed].mu = 0.0;
  scene.energyLedger = true;
  const EffectiveParameters effective = engine->load(scene, {});
  EXPECT_TRUE(effective.effects.contains(Effect::pairMaterials));
  const auto ofPair = [&](const std::string& part) {
    return std::ranges::find_if(effective.pairs, [&](const PairCoefficients& row) {
      return row.pair.find(part) != std::string::npos;
    });
  };
  ASSERT_NE(ofPair("of glass with"), effective.pairs.end());
  EXPECT_EQ(ofPair("g of steel")->mu, 0.0);
  EXPECT_EQ(ofPair("of steel with")->mu, scene.law.mu);
  const Snapshot smooth = after(*engine, scene);
  EXPECT_EQ(*smooth.spin, scene.disks.spin);
  EXPECT_NE(smooth.velocity, alike.velocity);
  const Snapshot now = engine->snapshot(ContactReport::instant);
  EXPECT_EQ(now.contacts->dissipation.size(), now.contacts->size());
}

TEST(LawOptions, OptionsThatHaveNoBearingOnALawDoNotMatter) {
  ContactLaw law = oneDisk().law;
  EXPECT_TRUE(mattersTo(law, "lever_arm"));
  EXPECT_FALSE(mattersTo(law, "velocity_arm")) << "it is that of f_t";
  EXPECT_FALSE(mattersTo(law, "plane_arm")) << "the radius is the radius at a plane too";
  law.conventions.velocityArm = VelocityArm::radius;
  EXPECT_FALSE(mattersTo(law, "velocity_arm")) << "it is still that of f_t";
  law.conventions.leverArm = LeverArm::overlapMiddle;
  EXPECT_TRUE(mattersTo(law, "velocity_arm"));
  EXPECT_TRUE(mattersTo(law, "plane_arm"));
  EXPECT_EQ(law.conventions.armOfVelocity(), LeverArm::radius);
  law.tangential = TangentialLaw::none;
  EXPECT_FALSE(mattersTo(law, "lever_arm"));
  EXPECT_FALSE(mattersTo(law, "velocity_arm"));
  EXPECT_FALSE(mattersTo(law, "dashpot"));
  EXPECT_TRUE(mattersTo(law, "tension"));
  law.gn = 0.0;
  EXPECT_FALSE(mattersTo(law, "tension"));
}

TEST(LawOptions, OptionsOfFriction_MatterToLawsThatPullAndToRollingSprings) {
  ContactLaw law;
  law.tangential = TangentialLaw::spring;
  EXPECT_FALSE(mattersTo(law, "coulomb_bound")) << "nothing pulls";
  law.cohesion = CohesionLaw::dmt;
  EXPECT_TRUE(mattersTo(law, "coulomb_bound"));
  law.tangential = TangentialLaw::none;
  EXPECT_FALSE(mattersTo(law, "spring_update"));
  law.rolling = RollingLaw::spring;
  EXPECT_TRUE(mattersTo(law, "spring_update")) << "of the rolling spring";
  // k_r in another unit would be another constant.
  Capabilities can;
  can.lawOptions = {{"rolling_stiffness", {"constant"}}, {"rolling_length", {"smaller_radius"}}};
  EXPECT_EQ(lawOptionValue(lawAsRun(can, law), "rolling_stiffness"), "length_square");
  EXPECT_EQ(lawOptionValue(lawAsRun(can, law), "rolling_length"), "smaller_radius");
}

TEST(LawOptions, UnknownNamesAndValuesAreSaid) {
  ContactLaw law;
  setLawOption(law, "lever_arm", "contact_point");
  EXPECT_EQ(law.conventions.leverArm, LeverArm::contactPoint);
  EXPECT_THROW(setLawOption(law, "lever", "radius"), std::invalid_argument);
  EXPECT_EQ(test::refusalOf<std::invalid_argument>([&] { setLawOption(law, "tension", "maybe"); }),
            "tension cannot be 'maybe' (it is one of: allow, cut)");
}

TEST(Registry, MirrorsNameTheirPeer) {
  for (const EngineEntry& entry : engineRegistry()) {
    EXPECT_TRUE(entry.make || entry.command) << entry.name;
    if (entry.mirrors.empty()) continue;
    EXPECT_NE(findEngine(entry.mirrors), nullptr) << entry.name;
  }
  EXPECT_EQ(findEngine("no such engine"), nullptr);
}

TEST(GrainKernels, ConventionsOfACaseThatNamesNone_HaveTheirOwnInBothDimensions) {
  ContactLaw law = oneDisk().law;
  law.conventions = usualConventions();
  const auto variant = grain::contactVariant(grain::generalLaw<double>(law, 1e-5, true));
  ASSERT_TRUE(variant);
  const auto kernels = grain::kernels<double>();
  EXPECT_NE(kernels.contacts[*variant], nullptr);
  EXPECT_NE(kernels.planes[*variant], nullptr);
  EXPECT_NE(kernels.space.pairs.own[*variant], nullptr);
}

}  // namespace
