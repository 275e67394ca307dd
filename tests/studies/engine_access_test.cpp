// Which engines run, with which settings and steps, what `check` says of them, and the scenes of
// mirrors.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <set>

#include "cases/collision_scene.hpp"
#include "cases/couette.hpp"
#include "cases/engine_file.hpp"
#include "cases/loader.hpp"
#include "cases/time_step.hpp"
#include "law/law_options.hpp"
#include "studies/core/engine_access.hpp"
#include "studies/core/mirrors.hpp"
#include "tests/studies/quick_cell.hpp"
#include "tests/support/refusal.hpp"

namespace {

using namespace crossgrain;

TEST(SelectEngines, All_AddsEveryOtherInstalledEngineOnce) {
  const auto engines = selectEngines({"box2d-penalty", "all"});
  EXPECT_EQ(engines.front().name, "box2d-penalty");
  for (std::size_t a = 0; a < engines.size(); ++a)
    for (std::size_t b = a + 1; b < engines.size(); ++b)
      EXPECT_NE(engines[a].name, engines[b].name);
  for (const EngineEntry& engine : engines) EXPECT_TRUE(engine.mirrors.empty());
  EXPECT_THROW(selectEngines({"grian"}), BadInput);
  EXPECT_THROW(selectEngines({"grain", "grain"}), BadInput);
  const auto mirrors = mirrorsOf(selectEngines({"grain", "box2d-penalty"}));
  ASSERT_EQ(mirrors.size(), 1u);
  EXPECT_EQ(mirrors[0].mirrors, "box2d-penalty");
}

/// A law under which every convention of contacts may matter.
Case springsAndDashpots() {
  Case setup;
  setup.law.normal = NormalLaw::linear;
  setup.law.tangential = TangentialLaw::springDashpot;
  setup.law.kn = setup.law.kt = 1.0;
  setup.law.gn = setup.law.gt = setup.law.mu = 0.1;
  return setup;
}

/// All have "cut", whose default is "allow"; the lever arms have nothing in common.
TEST(SharedConventions, AreWhatAllHaveOfWhatTheCaseLeavesOpen) {
  Capabilities any, cuts, rigid;
  any.lawOptions = {
      {"normal", {"linear"}}, {"tension", {"allow", "cut"}}, {"lever_arm", {"radius"}}};
  cuts.lawOptions = {
      {"normal", {"linear"}}, {"tension", {"cut"}}, {"lever_arm", {"contact_point"}}};
  rigid.lawOptions = {{"normal", {"rigid"}}, {"tension", {}}};
  Case setup = springsAndDashpots();
  EXPECT_EQ(sharedConventions(setup, {any, cuts}), std::vector<std::string>{"law.tension=\"cut\""});
  EXPECT_EQ(sharedConventions(setup, {any, cuts, rigid}), sharedConventions(setup, {any, cuts}))
      << "an engine of another law has no say";
  EXPECT_TRUE(sharedConventions(setup, {any, any}).empty()) << "all have the default";
  setup.run.mayDiffer = {"tension"};
  EXPECT_TRUE(sharedConventions(setup, {any, cuts}).empty()) << "the case lets it differ";
  setup.run.mayDiffer.clear();
  setup.resolvedToml = "[law]\ntension = \"allow\"\n";
  EXPECT_TRUE(sharedConventions(setup, {any, cuts}).empty()) << "the case gives it";
}

/// With "contact_point", `plane_arm` matters, of which the two have nothing in common.
TEST(SharedConventions, ValueThatMakesAnotherLackMatter_IsNotTaken) {
  Capabilities both, one;
  both.lawOptions = {{"lever_arm", {"radius", "contact_point", "overlap_middle"}},
                     {"plane_arm", {"middle"}}};
  one.lawOptions = {{"lever_arm", {"contact_point", "overlap_middle"}}, {"plane_arm", {"surface"}}};
  EXPECT_TRUE(sharedConventions(springsAndDashpots(), {both, one}).empty());
  one.lawOptions["plane_arm"] = {"surface", "middle"};
  EXPECT_EQ(
      sharedConventions(springsAndDashpots(), {both, one}),
      (std::vector<std::string>{"law.lever_arm=\"contact_point\"", "law.plane_arm=\"middle\""}));
}

/// Conventions of a law that an engine lacks and the case does not list.
std::set<std::string> lacking(const Capabilities& can, const Case& setup) {
  Scene scene;
  scene.law = setup.law;
  std::set<std::string> names;
  for (const Mismatch& mismatch : mismatches(can, scene)) names.insert(mismatch.name);
  for (const std::string& name : setup.run.mayDiffer) names.erase(name);
  return names;
}

/// Requires that shared conventions exclude no engine that could run the law before.
void expectNoNewRefusal(const Case& setup, const std::vector<Capabilities>& engines) {
  Case shared = setup;
  for (const std::string& change : sharedConventions(setup, engines)) {
    const std::size_t equals = change.find('=');
    setLawOption(shared.law, change.substr(4, equals - 4),
                 change.substr(equals + 2, change.size() - equals - 3));
  }
  for (const Capabilities& can : engines)
    if (lacking(can, setup).empty()) {
      EXPECT_EQ(lacking(can, shared), std::set<std::string>{});
    }
}

TEST(SharedConventions, AllPairsOfInstalledEngines_NoneRefusesWhatItRanBefore) {
  std::vector<Capabilities> engines;
  for (const EngineEntry& entry : selectEngines({"all"}))
    if (const auto can = capabilitiesOf(entry, 60.0)) engines.push_back(*can);
  ASSERT_GE(engines.size(), 3u);
  std::vector<Case> cases = {springsAndDashpots()};
  for (const char* file : {"/couette/quick.toml", "/assembly/hopper.toml",
                           "/collision/rolling.toml", "/collision/cohesion.toml"})
    cases.push_back(loadCase(CROSSGRAIN_CASES + std::string(file)).front());
  for (Case& setup : cases)
    for (const bool strict : {false, true}) {
      if (strict) setup.run.mayDiffer.clear();
      for (const Capabilities& a : engines)
        for (const Capabilities& b : engines) expectNoNewRefusal(setup, {a, b});
    }
}

/// Engines that list any of the values of any of the conventions, three at a time.
TEST(SharedConventions, ArbitraryEngines_NoneRefusesWhatItRanBefore) {
  std::mt19937 random(1);
  const auto chance = [&](double p) { return std::bernoulli_distribution(p)(random); };
  int shared = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    std::vector<Capabilities> engines(3);
    for (Capabilities& can : engines)
      for (const LawOption& option : lawOptions())
        if (isConvention(option.name) && chance(0.8))
          for (const std::string_view value : option.values)
            if (chance(0.8)) can.lawOptions[std::string(option.name)].emplace_back(value);
    shared += sharedConventions(springsAndDashpots(), engines).empty() ? 0 : 1;
    expectNoNewRefusal(springsAndDashpots(), engines);
  }
  EXPECT_GT(shared, 200) << "else nothing is tested";
}

TEST(SettingsFor, UnknownNameTypeRangeOrChoice_Throws) {
  Capabilities can;
  can.settings = {{"dt", 0.0, "s", "step", {}}, {"mode", std::string("a"), "", "", {"a", "b"}}};
  const auto refused = [&](const std::string& name, const SettingValue& value) {
    Case setup;
    setup.file = "case.toml";
    setup.engines["one"][name] = value;
    return test::refusalOf([&] { settingsFor(setup, "one", can); });
  };
  EXPECT_EQ(refused("dt", 1e-5), "");
  EXPECT_EQ(refused("mode", std::string("b")), "");
  EXPECT_EQ(refused("dt", -1e-5), "case.toml: [engines.one] dt = -1e-05 must be >= 0");
  EXPECT_EQ(refused("dt", true), "case.toml: [engines.one] dt must be a number, not true or false");
  EXPECT_NE(refused("mode", std::string("c")).find("cannot be 'c'"), std::string::npos);
  EXPECT_NE(refused("td", 1.0).find("there is no setting 'td'"), std::string::npos);
}

/// Of every engine installed: what no solver can count to, a value below the least and one above
/// the most are refused with the range.
TEST(SettingsFor, EveryEnginesNumbers_AreRefusedBeyondTheirRange) {
  std::vector<EngineEntry> engines = selectEngines({"all"});
  for (const auto& file : installedEngineFiles()) engines.push_back(loadEngineFile(file));
  int asked = 0;
  for (const EngineEntry& entry : engines) {
    if (entry.missing && !entry.missing().empty()) continue;
    const auto can = capabilitiesOf(entry, 60.0);
    ASSERT_TRUE(can) << entry.name;
    for (const SettingSpec& spec : can->settings) {
      if (!std::holds_alternative<double>(spec.defaultValue)) continue;
      ++asked;
      const std::string name = entry.name + "." + spec.name;
      EXPECT_TRUE(!spec.whole || spec.most <= 1e6) << name;
      const auto refused = [&](double value) {
        Case setup;
        setup.engines[entry.name][spec.name] = value;
        return test::refusalOf([&] { settingsFor(setup, entry.name, *can); });
      };
      EXPECT_EQ(refused(std::get<double>(spec.defaultValue)), "") << name;
      std::vector<double> beyond = {spec.least - 1.0, std::nextafter(spec.least, -1.0)};
      if (std::isfinite(spec.most)) beyond.push_back(std::nextafter(spec.most, 1e300));
      if (spec.whole) beyond.push_back(spec.least + 0.5);
      for (const double value : beyond)
        EXPECT_NE(refused(value).find(spec.name + " = "), std::string::npos) << name << value;
    }
  }
  EXPECT_GE(asked, 15);
}

/// Neither a run that would not end nor one in which nothing moves.
TEST(LoadScene, StepFarFromTheCases_IsBadInput) {
  const std::string file = CROSSGRAIN_CASES "/collision/hard-sphere.toml";
  const auto refused = [&](const std::string& setting) {
    const Case setup = loadCase(file, {"engines.box2d-impulse." + setting}).front();
    const EngineEntry& entry = *findEngine("box2d-impulse");
    const auto engine = entry.make();
    const Scene scene =
        collisionScene(setup, collisionStarts(setup), collisionTimeSteps(setup).front());
    return test::refusalOf<std::exception>([&] { loadScene(*engine, entry, setup, scene); });
  };
  EXPECT_EQ(refused("dt=1e-3"), "");
  for (const char* step : {"dt=1e-300", "dt=1e300"})
    test::expectSays(refused(step), {"must be 0, or from 5e-10 to 500 s"});
  for (const char* unit : {"length_unit=1e-300", "length_unit=1e300"})
    test::expectSays(refused(unit), {"takes length_unit = 0, or from "});
}

/// The first step given counts: the engine's section, the case's explicit step, the engine's
/// default.
TEST(StepOfItsOwn, SectionThenCaseThenDefault_TakesTheFirst) {
  Capabilities can;
  can.settings = {{"dt", 5e-4, "s", "step", {}}};
  Case setup;
  EXPECT_EQ(stepOfItsOwn(setup, "one", can), 5e-4);  // t_c / 50 is not explicit
  EXPECT_EQ(settingsFor(setup, "one", can), Settings{});
  setup.run.dt = 1e-5;
  EXPECT_EQ(stepOfItsOwn(setup, "one", can), std::nullopt);
  EXPECT_EQ(settingsFor(setup, "one", can), (Settings{{"dt", 0.0}}));
  setup.engines["one"]["dt"] = 2e-4;
  EXPECT_EQ(stepOfItsOwn(setup, "one", can), 2e-4);
  EXPECT_EQ(settingsFor(setup, "one", can), (Settings{{"dt", 2e-4}}));
  setup.engines["one"]["dt"] = 0.0;
  setup.run.dt.reset();
  EXPECT_EQ(stepOfItsOwn(setup, "one", can), std::nullopt);
  can.settings.clear();  // an engine whose step cannot be set
  setup.run.dt = 1e-5;
  EXPECT_EQ(settingsFor(setup, "two", can), Settings{});
}

TEST(StepDeviation, OtherStep_IsADeviation) {
  EXPECT_FALSE(stepDeviation(4e-5, 4e-5));
  const auto other = stepDeviation(5e-4, 4e-5);
  ASSERT_TRUE(other);
  EXPECT_EQ(other->name, "dt");
  EXPECT_EQ(other->value, 5e-4);
  EXPECT_EQ(other->note, "takes steps of 0.0005 s, the case's are 4e-05 s");
}

/// Through the engines themselves: EffectiveParameters of box2d-impulse and of its mirrors.
TEST(LoadScene, Mirror_TakesItsPeersStep) {
  const auto stepOf = [](const std::string& engine, const Case& setup) {
    const EngineEntry& entry = *findEngine(engine);
    const auto started = entry.make();
    const Scene scene =
        collisionScene(setup, collisionStarts(setup), collisionTimeSteps(setup).front());
    return loadScene(*started, entry, setup, scene);
  };
  const std::string file = CROSSGRAIN_CASES "/collision/hard-sphere.toml";
  for (const double dt : {5e-4, 1e-4}) {
    const Case setup = loadCase(file, {fmt::format("run.dt={}", dt)}).front();
    for (const char* engine : {"box2d-impulse", "grain-as-box2d-impulse"}) {
      const EffectiveParameters effective = stepOf(engine, setup);
      EXPECT_EQ(effective.dt, dt) << engine;
      for (const Deviation& deviation : effective.deviations) EXPECT_NE(deviation.name, "dt");
    }
  }
  const Case setup = loadCase(file, {"engines.box2d-impulse.dt=2.5e-4"}).front();
  for (const char* engine : {"box2d-impulse", "grain-as-box2d-impulse"}) {
    const EffectiveParameters effective = stepOf(engine, setup);
    EXPECT_EQ(effective.dt, 2.5e-4) << engine;
    EXPECT_EQ(std::ranges::count(effective.deviations, "dt", &Deviation::name), 1) << engine;
  }
  const Case own =
      loadCase(file, {"engines.box2d-impulse.dt=2.5e-4", "engines.grain-as-box2d-impulse.dt=1e-4"})
          .front();
  EXPECT_EQ(stepOf("grain-as-box2d-impulse", own).dt, 1e-4);
}

/// Reason why an engine is refused for a case, or "" where it runs it.
std::string refusalBy(const std::string& name, const Case& setup, const Scene& scene) {
  const EngineEntry& entry = *findEngine(name);
  const auto engine = entry.make();
  return test::refusalOf<UnsupportedScene>([&] { loadScene(*engine, entry, setup, scene); });
}

/// Each engine that is built in, under laws of which none of Box2D's has all: after what it advises
/// it runs the case. tests/system/test_refusals.py asks the others.
TEST(LoadScene, AdviceOfARefusal_WorksWhereItIsFollowed) {
  const std::string file = CROSSGRAIN_CASES "/collision/rolling.toml";
  const std::vector<std::function<void(ContactLaw&)>> laws = {
      [](ContactLaw&) {}, [](ContactLaw& law) { law.rolling = RollingLaw::viscous, law.gr = 0.5; },
      [](ContactLaw& law) { law.rolling = RollingLaw::spring, law.kr = 2e3; },
      [](ContactLaw& law) {
        law.rolling = RollingLaw::none;
        law.cohesion = CohesionLaw::dmt;
        law.w = 0.05;
      }};
  int advised = 0;
  for (const EngineEntry& entry : engineRegistry()) {
    if (!entry.make || !entry.mirrors.empty() || (entry.missing && !entry.missing().empty()))
      continue;
    for (const auto& change : laws) {
      Case setup = loadCase(file, {"run.may_differ=[]"}).front();
      change(setup.law);
      const Scene scene =
          collisionScene(setup, collisionStarts(setup), collisionTimeSteps(setup).front());
      const std::string why = refusalBy(entry.name, setup, scene);
      const std::size_t list = why.find("; list ");
      if (list == std::string::npos) continue;
      ++advised;
      const std::size_t end = why.find(" under [run]", list);
      for (std::size_t from = why.find('"', list); from < end;) {
        const std::size_t to = why.find('"', from + 1);
        setup.run.mayDiffer.push_back(why.substr(from + 1, to - from - 1));
        from = why.find('"', to + 1);
      }
      EXPECT_EQ(refusalBy(entry.name, setup, scene), "") << why;
    }
  }
  EXPECT_GE(advised, 8);  // of Box2D's two
}

Scene sceneOf(const Case& setup, bool placed = true) {
  Packing packing;
  if (placed) packing.disks = spreadDisks(setup);
  return couetteScene(setup, packing, 4e-5);
}

Suitability of(const char* name, bool placed = true) {
  const Case setup = test::quickCell();
  const EngineEntry& entry = *findEngine(name);
  return suitabilityOf(*entry.make(), entry, setup, sceneOf(setup, placed));
}

bool has(const std::vector<std::string>& notes, const std::string& note) {
  return std::ranges::find(notes, note) != notes.end();
}

TEST(SuitabilityOf, EngineWithLimits_ListsStepDeviationsAndMissingEffects) {
  const Suitability found = of("box2d-impulse");
  EXPECT_EQ(found.dt, 1.5e-3);
  EXPECT_TRUE(has(found.deviations, "takes steps of 0.0015 s, the case's are 4e-05 s"));
  EXPECT_TRUE(has(found.deviations, "has no bottom_friction"));
  EXPECT_EQ(found.notSimulated,
            (std::vector<std::string>{"tangential_spring", "tangential_damping", "bottom_friction",
                                      "bottom_spin_friction"}));
  const Suitability empty = of("box2d-impulse", false);  // a scene without disks
  EXPECT_FALSE(empty.dt);
  EXPECT_TRUE(has(empty.deviations, "has no bottom_friction"));
  const Suitability all = of("grain");
  EXPECT_EQ(all.dt, 4e-5);
  EXPECT_TRUE(all.deviations.empty());
  EXPECT_TRUE(all.notSimulated.empty());
}

std::vector<EngineEntry> mirrors() {
  std::vector<EngineEntry> found;
  for (const EngineEntry& entry : engineRegistry()) {
    const EngineEntry* peer = findEngine(entry.mirrors);
    if (peer && (!peer->missing || peer->missing().empty())) found.push_back(entry);
  }
  return found;
}

/// Whatever the peer, and from nothing but its capabilities: what it lacks is gone.
/// Files that do not take part have settings, too, and names that are like those of others.
TEST(EngineSections, SettingsOfAbsentFiles_AreNoSlips) {
  for (const char* const name : {"A", "B"}) {
    EngineEntry entry{.name = name, .files = {{"run.dump"}}};
    addEngine(entry);
  }
  Case setup;
  setup.engines = {{"A", {}}, {"B", {}}, {"C", {}}};
  EXPECT_EQ(test::refusalOf([&] { checkEngineSections(setup); }), "");
  setup.engines["grian"] = {};
  EXPECT_NE(test::refusalOf([&] { checkEngineSections(setup); }).find("did you mean grain?"),
            std::string::npos);
}

TEST(SceneOfPeer, EveryMirror_HasTheEffectsOfItsPeer) {
  const Case setup = test::quickCell();
  const Scene scene = sceneOf(setup);
  ASSERT_TRUE(effectsOf(scene).contains(Effect::bottomFriction));
  for (const EngineEntry& mirror : mirrors()) {
    const Capabilities peer = *capabilitiesOf(*findEngine(mirror.mirrors), 60.0);
    const Scene seen = sceneOfPeer(mirror, setup, scene).scene;
    const Effects theirs =
        simulatedEffects(peer, adaptScene(peer, scene, setup.run.mayDiffer).scene);
    Effects ours = effectsOf(seen);
    if (!hasNormalLaw(peer, scene.law)) {  // springs that stand for a rigid law
      ours.erase(Effect::tangentialSpring);
      ours.erase(Effect::tangentialDamping);
    }
    EXPECT_EQ(ours, theirs) << mirror.name;
  }
}

/// The registry's conventions of a mirror are those that its peer declares.
TEST(SceneOfPeer, EveryMirror_HasTheConventionsOfItsPeer) {
  const Case setup = test::quickCell();
  const Scene scene = sceneOf(setup);
  for (const EngineEntry& mirror : mirrors()) {
    const Capabilities peer = *capabilitiesOf(*findEngine(mirror.mirrors), 60.0);
    const Scene seen = sceneOfPeer(mirror, setup, scene).scene;
    if (!hasNormalLaw(peer, scene.law)) {
      for (const LawOption& option : lawOptions())
        EXPECT_EQ(lawOptionValue(seen.law, option.name), lawOptionValue(scene.law, option.name));
      continue;
    }
    const Capabilities own = mirror.make()->capabilities();
    for (const auto& [option, values] : peer.lawOptions) {
      // Which law it is is the scene's matter.
      const std::set<std::string> laws = {"normal", "damper", "tangential", "rolling", "cohesion"};
      if (laws.contains(option)) continue;
      EXPECT_EQ(own.lawOptions.at(option), values) << mirror.name << ", " << option;
      if (!mattersTo(scene.law, option)) continue;
      EXPECT_EQ(std::ranges::count(values, lawOptionValue(seen.law, option)), 1)
          << mirror.name << ", " << option;
    }
  }
}

TEST(SceneOfPeer, PeerThatLacksEffectsRefusesOrIsUnknown_IsReported) {
  const Case setup = test::quickCell(),
             strict = test::quickCell({"run.may_differ=[\"integrator\"]"});
  const Scene scene = sceneOf(setup);
  const Adapted lacking = sceneOfPeer(*findEngine("grain-as-box2d-penalty"), setup, scene);
  ASSERT_FALSE(lacking.deviations.empty());
  for (const Deviation& deviation : lacking.deviations)
    EXPECT_TRUE(deviation.note.starts_with("as its peer box2d-penalty: has ")) << deviation.note;
  const std::string refusal = test::refusalOf<UnsupportedScene>(
      [&] { sceneOfPeer(*findEngine("grain-stiff"), strict, sceneOf(strict)); });
  EXPECT_TRUE(refusal.starts_with("its peer box2d-impulse has no bottom_")) << refusal;
  EngineEntry mirror = *findEngine("grain-as-yade");
  mirror.mirrors = "nobody";
  const Adapted unknown = sceneOfPeer(mirror, setup, scene);
  ASSERT_EQ(unknown.deviations.size(), 1u);
  EXPECT_EQ(unknown.deviations[0].name, "peer");
  EXPECT_EQ(effectsOf(unknown.scene), effectsOf(scene));
}

TEST(EngineAccess, DimensionThatAnEngineDoesNotHave_IsRefusedInOneLine) {
  const SpaceScene spheres;
  const auto refusal = [&](const std::vector<int>& dimensions) {
    Capabilities can;
    can.dimensions = dimensions;
    return test::refusalOf<UnsupportedScene>([&] { adaptScene(can, spheres, {"dimension"}); });
  };
  EXPECT_EQ(refusal({2}), "has dimension = 2, not 3");
  EXPECT_EQ(refusal({2, 3}), "");
  Capabilities spheresAlone;
  spheresAlone.dimensions = {3};
  EXPECT_EQ(test::refusalOf<UnsupportedScene>([&] { adaptScene(spheresAlone, Scene{}, {}); }),
            "has dimension = 3, not 2");
  // Every engine but those that say 3; their base class says so, too.
  EXPECT_EQ(test::refusalOf<UnsupportedScene>(
                [&] { findEngine("box2d-penalty")->make()->loadInSpace(spheres, {}); }),
            "has dimension = 2, not 3");
}

}  // namespace
