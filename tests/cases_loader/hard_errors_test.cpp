// [assembly] and [stability]: what is read, and one line for everything that is wrong.
#include <numbers>

#include "bad_cases.hpp"

namespace crossgrain::test {
namespace {

const std::string soundStability = R"([stability]
tests = "a"
measure = "energy_gain"
limit = 0.1
degraded = 0.2
why = "b"
)";

std::string assembly(int number, const std::string& text) {
  return withLine(soundAssembly, number, text);
}
std::string hard(int number, const std::string& text) {
  return soundAssembly + withLine(soundStability, number, text);
}

TEST_F(LoaderErrors, SoundAssembliesAreSound) {
  expectMessages({{soundAssembly, ""}, {soundAssembly + soundStability, ""}});
  std::ofstream("case.toml") << soundAssembly + soundStability;
  const Case c = loadCase("case.toml").front();
  EXPECT_EQ(c.kind, CaseKind::assembly);
  ASSERT_EQ(c.assembly.disks.size(), 1u);
  EXPECT_EQ(c.assembly.disks[0].position, Vec2(0.0, 1.0));
  EXPECT_EQ(c.assembly.contactTimes, 3.0);
  ASSERT_TRUE(c.stability);
  EXPECT_EQ(c.stability->degraded, 0.2);
}

TEST_F(LoaderErrors, DisksOfAGridByDensity) {
  std::ofstream("case.toml") << assembly(
      12, "density = 4.0\njitter = 0.25\ngrid = { columns = 2, rows = 2, spacing = [2, 3] }");
  const DiskGroup group = loadCase("case.toml").front().assembly.disks.at(0);
  EXPECT_DOUBLE_EQ(group.mass, 4.0 * std::numbers::pi * group.radius * group.radius);
  EXPECT_EQ(group.jitter, 0.25);
  EXPECT_EQ(group.places, (std::vector<Vec2>{{0, 0}, {2, 0}, {0, 3}, {2, 3}}));  // diameters
}

TEST_F(LoaderErrors, OfAssemblies) {
  expectMessages({
      {assembly(11, "radus = 0.5"),
       "case.toml:11:1: unknown key assembly.disks[0].radus (did you mean radius?)"},
      {assembly(11, "radius = -0.5"),
       "case.toml:11:10: assembly.disks[0].radius = -0.5: must be > 0 m"},
      {assembly(10, "position = [1.0]"),
       "case.toml:10:12: assembly.disks[0].position: must be [x, y] in m"},
      {assembly(12, ""), "case.toml:9:1: assembly.disks[0].mass is missing: or density"},
      {assembly(12, "mass = 1.0\ndensity = 1.0"),
       "case.toml:13:11: assembly.disks[0].density = 1.0: and mass: give one of them"},
      {assembly(12, "mass = 1.0\ngrid = { columns = 2, rows = 2 }\nchain = { count = 2 }"),
       "case.toml:14:9: [assembly.disks[0].chain]: and grid: give one of them"},
      {assembly(8, ""), "case.toml:7:1: assembly.duration is missing: or contact_times, or steps"},
      {assembly(8, "steps = 1\nduration = 2.0"),
       "case.toml:8:9: assembly.steps = 1: and duration: give one of them"},
      {assembly(12, "mass = 1.0\n[[assembly.walls]]\npoint = [0, 0]"),
       "case.toml:13:1: assembly.walls[0].normal is missing: a plane has both"},
      {assembly(12, "mass = 1.0\n[[assembly.walls]]\nbox = [0, 0, 0, 1]"),
       "case.toml:14:7: assembly.walls[0].box: must be [left, bottom, right, top] in m"},
      {assembly(12, "mass = 1.0\n[[assembly.walls]]\nbox = [0, 1, 1, 1]"),
       "case.toml:14:7: assembly.walls[0].box: must be [left, bottom, right, top] in m"},
      {assembly(12, "density = 1e308"),
       "case.toml:12:11: assembly.disks[0].density = 1e+308: makes disks of radius 0.5 m weigh inf "
       "kg"},
      {assembly(8, "duration = 0.0"), "case.toml:8:12: assembly.duration = 0.0: must be > 0 s"},
      {assembly(8, "steps = 0.0"), "case.toml:8:9: assembly.steps = 0.0: must be > 0"},
      {assembly(12, "mass = 1.0\ngrid = { columns = 2, rows = 2, spacing = [1, 2, 3] }"),
       "case.toml:13:43: assembly.disks[0].grid.spacing: must be one number or [columns, rows] in "
       "diameters"},
      {assembly(12, "mass = 1.0\n[preparation]\npackings = 10000"),
       "case.toml:13:1: [preparation]: is of no use without [average]"},
      {assembly(12, "mass = 1.0\n[preparation]\npackings = 10001"),
       "case.toml:14:12: preparation.packings = 10001: must be in [1, 10000]"},
      {assembly(12, "mass = 1.0\n[cell]\nomega = 1.0"),
       "case.toml:13:1: [cell]: has no part in an assembly case"},
  });
}

TEST_F(LoaderErrors, OfHardCases) {
  expectMessages({
      {hard(3, "measure = \"energy_gian\""),
       "case.toml:15:11: stability.measure = \"energy_gian\": unknown name (did you mean "
       "energy_gain?)"},
      {hard(4, "limit = -1"), "case.toml:16:9: stability.limit = -1: must be >= 0"},
      {hard(5, "degraded = 0.05"),
       "case.toml:17:12: stability.degraded = 0.05: must be >= limit = 0.1"},
      {hard(6, ""), "case.toml:13:1: stability.why is missing"},
      {hard(6, "why = \"\""), "case.toml:18:7: stability.why = \"\": must give the reason"},
  });
}

}  // namespace
}  // namespace crossgrain::test
