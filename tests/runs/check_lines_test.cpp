#include "runs/check_lines.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "cases/couette.hpp"
#include "cases/loader.hpp"

namespace {

using namespace crossgrain;

std::vector<std::string> linesOf(const char* name, bool placed = true) {
  const Case setup = loadCase(CROSSGRAIN_CASES "/couette/quick.toml", {}).front();
  Packing packing;
  if (placed) packing.disks = spreadDisks(setup);
  const EngineEntry& entry = *findEngine(name);
  return checkLines(*entry.make(), entry, setup, couetteScene(setup, packing, *setup.run.dt));
}

bool has(const std::vector<std::string>& lines, const std::string& line) {
  return std::ranges::find(lines, line) != lines.end();
}

TEST(CheckLines, TellWhatTheEngineTellsOnceItHasTheScene) {
  const auto lines = linesOf("box2d-impulse");
  EXPECT_EQ(lines.front(), "can run it, dt 0.0005 s");
  EXPECT_TRUE(has(lines, "differs: takes steps of 0.0005 s, the case's are 4e-05 s"));
  EXPECT_TRUE(has(lines, "differs: has no bottom_friction"));
  EXPECT_TRUE(has(lines,
                  "does not simulate: tangential_spring, tangential_damping, bottom_friction, "
                  "bottom_spin_friction"));
}

TEST(CheckLines, AnEngineThatDoesAllHasNothingToAdd) {
  EXPECT_EQ(linesOf("grain"), std::vector<std::string>{"can run it, dt 4e-05 s"});
}

TEST(CheckLines, WithoutDisksTheyTellWhatIsKnownBefore) {
  const auto lines = linesOf("box2d-impulse", false);
  EXPECT_EQ(lines.front(), "can run it");
  EXPECT_TRUE(has(lines, "differs: has no bottom_friction"));
}

}  // namespace
