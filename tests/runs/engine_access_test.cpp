#include "runs/common/engine_access.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "cases/collision_scene.hpp"
#include "cases/loader.hpp"
#include "cases/time_step.hpp"
#include "support/bad_input.hpp"

namespace {

using namespace crossgrain;

TEST(EngineAccess, AllAddsEveryOtherInstalledEngineOnce) {
  const auto engines = selectEngines({"box2d-penalty", "all"});
  EXPECT_EQ(engines.front().name, "box2d-penalty");
  for (std::size_t a = 0; a < engines.size(); ++a)
    for (std::size_t b = a + 1; b < engines.size(); ++b)
      EXPECT_NE(engines[a].name, engines[b].name);
  for (const EngineEntry& engine : engines) EXPECT_TRUE(engine.mirrors.empty());
}

TEST(EngineAccess, UnknownAndRepeatedNamesAreBadInput) {
  EXPECT_THROW(selectEngines({"grian"}), BadInput);
  EXPECT_THROW(selectEngines({"grain", "grain"}), BadInput);
}

TEST(EngineAccess, MirrorsComeWithTheirPeers) {
  const auto mirrors = mirrorsOf(selectEngines({"grain", "box2d-penalty"}));
  ASSERT_EQ(mirrors.size(), 1u);
  EXPECT_EQ(mirrors[0].mirrors, "box2d-penalty");
}

TEST(EngineAccess, SettingsAreHeldAgainstWhatTheEngineHas) {
  Capabilities can;
  can.settings = {{"dt", 0.0, "s", "step", {}}, {"mode", std::string("a"), "", "", {"a", "b"}}};
  const auto refused = [&](const std::string& name, const SettingValue& value) {
    Case setup;
    setup.file = "case.toml";
    setup.engines["one"][name] = value;
    try {
      settingsFor(setup, "one", can);
    } catch (const BadInput& bad) {
      return std::string(bad.what());
    }
    return std::string();
  };
  EXPECT_EQ(refused("dt", 1e-5), "");
  EXPECT_EQ(refused("mode", std::string("b")), "");
  EXPECT_EQ(refused("dt", -1e-5), "case.toml: [engines.one] dt = -1e-05 must be >= 0");
  EXPECT_EQ(refused("dt", true), "case.toml: [engines.one] dt must be a number, not true or false");
  EXPECT_NE(refused("mode", std::string("c")).find("cannot be 'c'"), std::string::npos);
  EXPECT_NE(refused("td", 1.0).find("there is no setting 'td'"), std::string::npos);
}

/// What is said first counts: the engine's section, the case's explicit step, the engine's default.
TEST(EngineStep, TheCasesOwnStepCountsForAll) {
  Capabilities can;
  can.settings = {{"dt", 5e-4, "s", "step", {}}};
  Case setup;
  EXPECT_EQ(stepOfItsOwn(setup, "one", can), 5e-4);  // t_c / 50 is nobody's wish
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

TEST(EngineStep, AnotherStepThanTheScenesIsADeviation) {
  EXPECT_FALSE(stepDeviation(4e-5, 4e-5));
  const auto other = stepDeviation(5e-4, 4e-5);
  ASSERT_TRUE(other);
  EXPECT_EQ(other->name, "dt");
  EXPECT_EQ(other->value, 5e-4);
  EXPECT_EQ(other->note, "takes steps of 0.0005 s, the case's are 4e-05 s");
}

/// Through the engines themselves: Realised of box2d-impulse and of its mirrors.
TEST(EngineStep, AMirrorTakesItsPeersStep) {
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
      const Realised realised = stepOf(engine, setup);
      EXPECT_EQ(realised.dt, dt) << engine;
      for (const Deviation& deviation : realised.deviations) EXPECT_NE(deviation.name, "dt");
    }
  }
  const Case setup = loadCase(file, {"engines.box2d-impulse.dt=2.5e-4"}).front();
  for (const char* engine : {"box2d-impulse", "grain-as-box2d-impulse"}) {
    const Realised realised = stepOf(engine, setup);
    EXPECT_EQ(realised.dt, 2.5e-4) << engine;
    EXPECT_EQ(std::ranges::count(realised.deviations, "dt", &Deviation::name), 1) << engine;
  }
  const Case own =
      loadCase(file, {"engines.box2d-impulse.dt=2.5e-4", "engines.grain-as-box2d-impulse.dt=1e-4"})
          .front();
  EXPECT_EQ(stepOf("grain-as-box2d-impulse", own).dt, 1e-4);
}

}  // namespace
