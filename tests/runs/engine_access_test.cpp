#include "runs/engine_access.hpp"

#include <gtest/gtest.h>

#include "cases/bad_input.hpp"

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

}  // namespace
