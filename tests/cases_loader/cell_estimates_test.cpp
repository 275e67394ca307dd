// Estimates of `check` against the trial runs that they were made from (thesis-facts, section 6).

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "adapters/start_check.hpp"
#include "cases/cautions.hpp"
#include "cases/couette.hpp"
#include "cases/loader.hpp"
#include "tests/cases_loader/files.hpp"

namespace crossgrain::test {
namespace {

Case cellOf(const char* name, int small, int large) {
  Case c = loadCase(std::filesystem::path(CROSSGRAIN_CASES) / "couette" / name).front();
  couetteIn(c).particles.small = small;
  couetteIn(c).particles.large = large;
  return c;
}

TEST(CellEstimates, Pressure_AsInTrialRuns_NoneOfAGas) {
  struct Row {
    const char* file;
    int small, large;
    double pressure;  ///< of trial runs at Ω = 1 /s, 0: a gas [N/m²]
    bool quick = false;
  };
  for (const Row& row : {Row{"nu-0.804.toml", 2511, 410, 100.0},
                         {"nu-0.804.toml", 2476, 406, 0.0},
                         {"nu-0.804-spacing-7mm.toml", 2511, 410, 0.0},
                         {"nu-0.804.toml", 2511, 410, 250.0},
                         {"nu-0.804.toml", 202, 33, 0.0, true},
                         {"nu-0.804.toml", 206, 34, 70.0, true},
                         {"nu-0.804.toml", 211, 34, 350.0, true},
                         {"nu-0.804.toml", 215, 35, 530.0, true}}) {
    Case c = cellOf(row.file, row.small, row.large);
    if (row.quick) {
      couetteIn(c).cell.innerRadius = 0.03;
      couetteIn(c).cell.outerRadius = 0.075;
    }
    const auto pressure = expectedPressure(c, bulkVolumeFraction(c, volumeFraction(c)));
    ASSERT_EQ(pressure.has_value(), row.pressure > 0.0) << row.small;
    if (!pressure) continue;
    EXPECT_GT(*pressure, row.pressure / 4.0) << row.small;
    EXPECT_LT(*pressure, row.pressure * 4.0) << row.small;
  }
}

TEST(CellEstimates, MadeUpPacking_FillsTheCell) {
  const Case c = cellOf("nu-0.804.toml", 2511, 410);
  const Packing packing = madeUpPacking(c);
  ASSERT_EQ(packing.disks.size(), 2921u);
  double area = 0.0;
  for (const double a : packing.disks.radius) area += a * a;
  EXPECT_GT(area / (0.2524 * 0.2524 - 0.1032 * 0.1032), 0.7);
  EXPECT_NO_THROW(checkStart(couetteScene(c, packing, 1e-5), couetteIn(c).particles, "made up",
                             &couetteIn(c).cell));
}

class CautionsOfShapes : public InFolder {};

TEST(Cautions, GasSqueezedDisksFewStepsNothingToJudge) {
  const auto said = [](const Case& c, const char* what) {
    const double fraction = volumeFraction(c);
    for (const std::string& line : cautions(c, fraction))
      if (line.find(what) != std::string::npos) return true;
    return false;
  };
  Case c = cellOf("nu-0.804.toml", 2511, 410);
  for (const char* const what : {"dilute", "over-dense", "steps in the shortest", "margins"})
    EXPECT_FALSE(said(c, what)) << what;
  EXPECT_TRUE(said(cellOf("nu-0.804.toml", 2462, 404), "dilute"));
  EXPECT_TRUE(said(cellOf("nu-0.804.toml", 2588, 422), "over-dense"));
  c.run.dt = 2e-4;
  EXPECT_TRUE(said(c, "steps in the shortest contact"));
  c.run.dt = 3e-4;
  EXPECT_TRUE(said(c, "six contacts"));
  c.run.dt = 1.0;
  EXPECT_TRUE(said(c, "the longest step"));
  c.preparation.packings = 2;
  EXPECT_TRUE(said(c, "2 packings: compare judges nothing with fewer than 4"));
  c.averaging.endpoints.clear();
  EXPECT_TRUE(said(c, "no [averaging.endpoints]"));
  c.engines["box2d-impulse"]["dt"] = 0.05;
  EXPECT_TRUE(said(c, "[engines.box2d-impulse] dt = 0.05 s: the wheel's rim moves 0.7 d"));
}

/// Of shapes in the plane and in space, of assemblies and of collisions.
TEST_F(CautionsOfShapes, ThinAndTinyBodies_AreNamed) {
  const auto said = [](const std::string& source) {
    write("case.toml", "[law]\nnormal = 'rigid'\ne_n = 0.5\nmu = 0.3\n[run]\ndt = 1e-4\n" + source);
    std::string lines;
    for (const std::string& line : cautions(loadCase("case.toml").front(), 0.0))
      lines += line + "\n";
    return lines;
  };
  const auto assembly = [&](int dimension, const std::string& shape) {
    return said(
        fmt::format("[case]\nkind = 'assembly'\ndimension = {}\n[assembly]\nduration = 1\n"
                    "[[assembly.disks]]\nposition = [0, 0{}]\nmass = 1\nshape = {}\n",
                    dimension, dimension == 3 ? ", 0" : "", shape));
  };
  EXPECT_EQ(assembly(2, "{ box = [0.1, 0.001] }"), "");
  EXPECT_EQ(assembly(3, "{ box = [0.1, 0.001, 0.5] }"), "");
  for (const auto& thin :
       {assembly(2, "{ box = [0.1, 1e-12] }"),
        assembly(2, "{ polygon = [[0, 0], [1, 1], [1, 1.0001]] }"),
        assembly(3, "{ box = [0.1, 0.1, 1e-12] }"), assembly(3, "{ cylinder = [1e-6, 0.1] }")}) {
    EXPECT_EQ(thin.rfind("assembly.disks[0].shape is ", 0), 0u) << thin;
    EXPECT_NE(thin.find("times as thin as long"), std::string::npos) << thin;
  }
  EXPECT_NE(assembly(2, "{ box = [1e-12, 1e-12] }").find("the smallest bodies are 1.41421e-12 m"),
            std::string::npos);
  const std::string collision = said(
      "[case]\nkind = 'collision'\n[collision]\nsecond = 'body'\npsi = 1\nvn = 0.1\nmass = 1\n"
      "orientation = 30\nshape = { box = [0.1, 0.06] }\nsecond_shape = { box = [0.0001, 1] }\n");
  EXPECT_NE(collision.find("collision.second_shape is 1e+04 times as thin"), std::string::npos)
      << collision;
}

}  // namespace
}  // namespace crossgrain::test
