// Materials: pairs of bodies with laws of their own.
#include "cases/materials.hpp"

#include "adapters/effects.hpp"
#include "cases/assembly_scene.hpp"
#include "cases/couette.hpp"
#include "cases/packing.hpp"
#include "cases/time_step.hpp"
#include "files.hpp"
#include "oracle/impact.hpp"

namespace crossgrain::test {
namespace {

/// Small disks of glass, all else of steel; lines of pairs begin with 28.
std::string cell(const std::string& pairs, const std::string& walls = "steel") {
  return withLine(soundCase, 16,
                  "omega = 1.0\nwheel_material = \"" + walls + "\"\nring_material = \"steel\"") +
         "small_material = \"glass\"\nlarge_material = \"steel\"\n" + pairs;
}

std::string pair(const std::string& between, const std::string& constants) {
  return "[[law.pairs]]\nbetween = [" + between + "]\n" + constants + "\n";
}

const std::string glassSteel = R"("glass", "steel")", glassGlass = R"("glass", "glass")";

using Materials = InFolder;

TEST_F(Materials, Pairs_HaveTheirConstantsAndTheRestOfTheLaw) {
  write("case.toml", cell(pair(glassSteel, "kn = 500.0\nmu = 0.0") + pair(glassGlass, "gt = 0.3")));
  const Case setup = loadCase("case.toml").front();
  ASSERT_TRUE(setup.materials);
  EXPECT_EQ(setup.materials->names, (std::vector<std::string>{"glass", "steel"}));
  ContactLaw mixed = setup.law, glass = setup.law;
  mixed.kn = 500.0;
  mixed.mu = 0.0;
  glass.gt = 0.3;
  EXPECT_EQ(setup.materials->laws, (std::vector{glass, mixed, mixed, setup.law}));

  const Disks disks = diskKinds(couetteIn(setup).particles);
  Packing packing;
  packing.disks = disks;
  const Scene scene = couetteScene(setup, packing, 1e-5);
  const std::size_t wheel = disks.size(), large = 210;
  EXPECT_EQ(scene.lawOf(0, 1), glass);
  EXPECT_EQ(scene.lawOf(0, large), mixed);
  EXPECT_EQ(scene.lawOf(large, large + 1), setup.law);
  EXPECT_EQ(scene.lawOf(0, wheel), mixed);
  EXPECT_EQ(scene.lawOf(large, scene.disks.size() + scene.wallDiskCount() - 1), setup.law);
  EXPECT_TRUE(effectsOf(scene).contains(Effect::pairMaterials));
}

TEST_F(Materials, PairsLikeTheLaw_AreNoEffect) {
  write("case.toml", cell(pair(glassSteel, "kn = 352.1")));
  EXPECT_FALSE(loadCase("case.toml").front().materials);
  write("case.toml", cell(pair(glassSteel, "kn = 500.0")));
  EXPECT_FALSE(loadCase("case.toml", {}, "[law]\npairs = []\n").front().materials);
}

TEST_F(Materials, StepAndLimit_AreThoseOfTheStiffestPair) {
  write("case.toml", cell(pair(glassSteel, "kn = 3521.0")));
  const Case setup = loadCase("case.toml").front();
  Case stiff = setup;
  stiff.law.kn = 3521.0;
  stiff.materials.reset();
  EXPECT_EQ(timeStep(setup), timeStep(stiff));
  EXPECT_EQ(pairStepLimit(setup)->dt, pairStepLimit(stiff)->dt);
  EXPECT_EQ(shortestContact(setup), contactTime(stiff.law, lightestReducedMass(setup)));
}

TEST_F(Materials, Packing_IsThatOfItsPairs) {
  const auto hashOf = [&](const std::string& text) {
    write("case.toml", text);
    return packingHash(loadCase("case.toml").front(), 0, 1e-5);
  };
  const std::string plain = hashOf(soundCase), mixed = hashOf(cell(pair(glassSteel, "kn = 500.0")));
  EXPECT_NE(mixed, plain);
  EXPECT_EQ(hashOf(cell(pair(glassSteel, "kn = 352.1"))), plain);
  EXPECT_NE(hashOf(cell(pair(glassSteel, "kn = 501.0"))), mixed);
  EXPECT_NE(hashOf(cell(pair(glassSteel, "kn = 500.0"), "glass")), mixed);
}

TEST_F(Materials, Assembly_DisksAndWallsByGroup) {
  write("case.toml", soundAssembly +
                         "material = \"glass\"\n[[assembly.disks]]\nposition = [3, 1]\nradius = 1\n"
                         "mass = 1\nchain = { count = 2 }\nmaterial = \"steel\"\n"
                         "[[assembly.walls]]\npoint = [0, 0]\nnormal = [0, 1]\nmaterial = "
                         "\"glass\"\n" +
                         pair(glassSteel, "kn = 50.0"));
  const Scene scene = assemblyScene(loadCase("case.toml").front());
  EXPECT_EQ(scene.materials->ofDisk, (std::vector<std::int32_t>{0, 1, 1}));
  EXPECT_EQ(scene.materials->ofBody, (std::vector<std::int32_t>{0}));
  EXPECT_EQ(scene.lawOf(0, 3).kn, 100.0);
  EXPECT_EQ(scene.lawOf(1, 3).kn, 50.0);
}

TEST_F(Materials, Collision_HasTheLawOfItsTwo) {
  write("case.toml",
        soundCollision + "material = [\"glass\", \"steel\"]\n" + pair(glassSteel, "mu = 0.1"));
  const Case setup = loadCase("case.toml").front();
  EXPECT_FALSE(setup.materials);
  EXPECT_EQ(setup.law.mu, 0.1);
  write("case.toml", soundCollision + "material = \"glass\"\n" + pair(glassGlass, "mu = 0.2"));
  EXPECT_EQ(loadCase("case.toml").front().law.mu, 0.2);
}

TEST_F(Materials, Hertz_OfTwoBodies) {
  // 1/E₁₂ of glass with steel from their own moduli: (1 − 0.09)(1/1e6 + 1/4e6).
  const std::string assembly =
      "[case]\nkind = \"assembly\"\n[assembly]\nduration = 1\n[[assembly.disks]]\n"
      "position = [0, 0]\nradius = 1\nmass = 1\nmaterial = \"glass\"\n[[assembly.walls]]\n"
      "point = [0, -2]\nnormal = [0, 1]\nmaterial = \"steel\"\n[run]\ndt = 1e-6\n[law]\nnormal = "
      "\"hertz\"\ntangential = \"none\"\ngn = 0\nyoung = 1e6\npoisson = 0.3\n";
  write("case.toml", assembly + pair(glassSteel, "young = [1e6, 4e6]"));
  const Case setup = loadCase("case.toml").front();
  EXPECT_NEAR(setup.materials->law(0, 1).kn, 4.0 / 3.0 / (0.91 * 1.25e-6), 1e-3);
}

TEST_F(Materials, RollingAndCohesion_OfPairs) {
  const std::string law = withLine(cell(""), 9,
                                   "tangential = \"spring_dashpot\"\nrolling = \"spring\"\nmu_r = "
                                   "0.1\nkr_factor = 3.0\ncohesion = \"area\"\nkc = 1e4");
  write("case.toml",
        law + pair(glassSteel, "mu_r = 0.0\nkc = 0.0") + pair(glassGlass, "mu_r = 0.2\nkc = 2e4"));
  const Case setup = loadCase("case.toml").front();
  const ContactLaw &mixed = setup.materials->law(0, 1), &glass = setup.materials->law(0, 0);
  EXPECT_EQ(mixed.muR, 0.0);
  EXPECT_EQ(mixed.kr, setup.law.kr) << "a spring that no bound lets carry anything";
  EXPECT_EQ(mixed.kc, 0.0);
  EXPECT_DOUBLE_EQ(glass.kr, 3.0 * 352.1 * 0.04);
  EXPECT_EQ(glass.kc, 2e4);
}

TEST_F(LoaderErrors, MaterialWithoutPairs_IsRefused_UnlessTheyWereTakenAway) {
  const std::string named = soundAssembly + "material = \"glass\"\n";
  expectMessage(named, "\"glass\": the case has no [[law.pairs]]");
  std::string away = named;
  EXPECT_EQ(messageOfText(away.insert(away.find("[assembly]"), "pairs = []\n")), "");
}

TEST_F(LoaderErrors, Pairs_OfMaterials) {
  expectMessages({
      {cell(pair(glassSteel, "kn = 0")),
       "case.toml:30:6: law.pairs[0].kn = 0: a linear law needs "
       "it > 0"},
      {cell(pair(glassSteel, "tension = \"cut\"")),
       "case.toml:30:11: law.pairs[0].tension = \"cut\": an option is that of [law] for all pairs"},
      {cell(pair(glassSteel, "kz = 1")),
       "case.toml:30:1: unknown key law.pairs[0].kz (did you mean kn?)"},
      {cell(pair("\"glass\"", "kn = 1")),
       "case.toml:29:11: law.pairs[0].between: must be two materials"},
      {cell("[[law.pairs]]\nkn = 1\n"), "case.toml:28:1: law.pairs[0].between is missing"},
      {cell(pair(glassSteel, "kn = 400") + pair(R"("steel", "glass")", "kn = 300")),
       "case.toml:32:11: law.pairs[1].between: is there twice"},
      {cell(pair(glassSteel, "kn = 400"), "stel"),
       "case.toml:17:18: cell.wheel_material = \"stel\": no [[law.pairs]] has that material (did "
       "you mean steel?)"},
      {cell(pair(glassSteel, "kn = 400") + pair(R"("glass", "oak")", "kn = 300")),
       "case.toml: [[law.pairs]] has a material that nobody is made of, \"oak\""},
      {soundCase + pair(glassSteel, "kn = 400"),
       "case.toml: [particles] small has no material: with [[law.pairs]] every body has one, of "
       "glass, steel"},
      {soundCollision + pair(glassSteel, "kn = 400"),
       "case.toml: [collision] has no material: with [[law.pairs]] it has two, of glass, steel"},
      {cell(pair(glassSteel, "gn = 30")),
       "case.toml:28:1: law.pairs: gn of glass with steel overdamps the lightest pair: must be < "
       "0.4401"},
      {withLine(cell(pair(glassSteel, "gn = 0.1")), 5, "gn = 0"),
       "case.toml:30:6: law.pairs[0].gn = 0.1: [law] is without it, and pairs have no effect that "
       "it has not"},
      {withLine(cell(pair(glassSteel, "mu = 0.1")), 6, "mu = -1"),
       "case.toml:6:6: law.mu = -1: must be >= 0"},
  });
}

}  // namespace
}  // namespace crossgrain::test
