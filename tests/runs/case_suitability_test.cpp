#include "runs/common/engine_access.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "cases/couette.hpp"
#include "cases/loader.hpp"

namespace {

using namespace crossgrain;

Suitability of(const char* name, bool placed = true) {
  const Case setup = loadCase(CROSSGRAIN_CASES "/couette/quick.toml", {}).front();
  Packing packing;
  if (placed) packing.disks = spreadDisks(setup);
  const EngineEntry& entry = *findEngine(name);
  return suitabilityOf(*entry.make(), entry, setup, couetteScene(setup, packing, *setup.run.dt));
}

bool has(const std::vector<std::string>& notes, const std::string& note) {
  return std::ranges::find(notes, note) != notes.end();
}

TEST(CaseSuitability, IsWhatTheEngineTellsOnceItHasTheScene) {
  const Suitability found = of("box2d-impulse");
  EXPECT_EQ(found.dt, 1.5e-3);
  EXPECT_TRUE(has(found.deviations, "takes steps of 0.0015 s, the case's are 4e-05 s"));
  EXPECT_TRUE(has(found.deviations, "has no bottom_friction"));
  EXPECT_EQ(found.notSimulated,
            (std::vector<std::string>{"tangential_spring", "tangential_damping", "bottom_friction",
                                      "bottom_spin_friction"}));
}

TEST(CaseSuitability, AnEngineThatDoesAllHasNothingToAdd) {
  const Suitability found = of("grain");
  EXPECT_EQ(found.dt, 4e-5);
  EXPECT_TRUE(found.deviations.empty());
  EXPECT_TRUE(found.notSimulated.empty());
}

TEST(CaseSuitability, WithoutDisksItIsWhatIsKnownBefore) {
  const Suitability found = of("box2d-impulse", false);
  EXPECT_FALSE(found.dt);
  EXPECT_TRUE(has(found.deviations, "has no bottom_friction"));
}

}  // namespace
