// Bad input as in errors_test.cpp, of laws.
#include "files.hpp"

namespace crossgrain::test {
namespace {

TEST_F(LoaderErrors, Law_NeedsWhatItUsesAndNothingElse) {
  expectMessages({
      {line(4, "kn = 0"), "case.toml:4:6: law.kn = 0: a linear law needs it > 0"},
      {line(7, ""), "case.toml:3:1: law.kt is missing: a spring law needs it > 0"},
      {line(7, "kt = 0"), "case.toml:7:6: law.kt = 0: a spring law needs it > 0"},
      {line(6, "mu = 0"), "case.toml:6:6: law.mu = 0: a tangential law needs it > 0"},
      {line(9, "tangential = \"none\""),
       "case.toml:6:6: law.mu = 0.44: mu without friction (law.tangential is none): set it to 0 or "
       "leave it out"},
      {withLine(line(9, "tangential = \"none\""), 6, ""),
       "case.toml:7:6: law.kt = 267.1: kt without friction (law.tangential is none): set it to 0 "
       "or "
       "leave it out"},
      {withLine(line(9, "tangential = \"viscous\""), 8, "gt = 0"),
       "case.toml:8:6: law.gt = 0: a viscous law needs it > 0"},
      {line(5, ""), "case.toml:3:1: law.gn is missing: an undamped law says 0"},
      {line(9, ""), "case.toml:3:1: law.tangential is missing: a frictionless law says none"},
      {line(5, "gn = 30"),
       "case.toml:5:6: law.gn = 30: overdamps the lightest pair: must be < 0.4401"},
      {line(5, "gn = 0.1\ne_n = 0.9"),
       "case.toml:6:7: law.e_n = 0.9: a rigid law takes it, and a linear or Hertz law with damper "
       "= "
       "\"critical\""},
  });
}

TEST_F(LoaderErrors, ConventionsOfSpace_NeedACaseInSpace) {
  expectMessages({
      {collision(5, "gn = 0.19\nspring_twist = \"none\""),
       "case.toml:6:16: law.spring_twist = \"none\": only a law in space has it (case.dimension = "
       "3)"},
      {withLine(collision(2, "kind = \"collision\"\ndimension = 3"), 6,
                "gn = 0.19\nspring_twist = \"none\"\nspring_turn = \"projected\""),
       ""},
  });
}

TEST_F(LoaderErrors, TwoMaterials_OutsideACollision_AreRefused) {
  const std::string assembly =
      "[case]\nkind = \"assembly\"\n[assembly]\nduration = 1\n[[assembly.disks]]\n"
      "position = [0, 0]\nradius = 1\nmass = 1\n[run]\ndt = 1e-6\n[law]\nnormal = \"hertz\"\n"
      "tangential = \"none\"\ngn = 0\nyoung = 1e9\npoisson = 0.3\n";  // 15, 16
  expectMessages({
      {assembly, ""},
      {withLine(assembly, 15, "young = [1e9, 1e9]"), ""},
      {withLine(assembly, 15, "young = [1e6, 1e8]"),
       "case.toml:15:9: law.young: the values of two bodies belong to a "
       "collision; here all disks and walls are of one material: give one value"},
  });
  for (const std::string& other : {withLine(assembly, 15, "young = [1e9, inf]"),
                                   withLine(assembly, 16, "poisson = [0.3, 0.2]")}) {
    write("case.toml", other);
    EXPECT_NE(messageOf("case.toml").find("of one material"), std::string::npos);
  }
}

TEST_F(LoaderErrors, Law_ThatStiffens_HasItsOwnKeys) {
  const std::string hertz =
      "[case]\nkind = \"collision\"\n[collision]\npsi = 1\nvn = 1\nradius = 1\nmass = 1\n[law]\n"
      "normal = \"hertz\"\ntangential = \"none\"\nyoung = 1e9\npoisson = 0.3\ngn = 0\n";  // 14 on
  expectMessages({
      {hertz, ""},
      {withLine(hertz, 11, "young = [1e9, inf]"), ""},
      {withLine(hertz, 13, "damper = \"critical\"\ne_n = 0.5"), ""},
      {withLine(hertz, 11, ""), "case.toml:8:1: law.young is missing: Hertz' law needs it"},
      {withLine(hertz, 11, "young = inf"),
       "case.toml:11:9: law.young = inf: one of two bodies must give way"},
      {withLine(hertz, 12, "poisson = 0.6"),
       "case.toml:12:11: law.poisson = 0.6: must be in [0, 0.5]"},
      {hertz + "kn = 5\n",
       "case.toml:14:6: law.kn = 5: only a law that does not get it from young and poisson takes "
       "it"},
      {hertz + "e_n = 0.5\n",
       "case.toml:14:7: law.e_n = 0.5: a rigid law takes it, and a linear or Hertz law with damper "
       "= "
       "\"critical\""},
      {hertz + "damper = \"critical\"\ne_n = 0.5\n",
       "case.toml:15:7: law.e_n = 0.5: stands beside gn: give one of the two"},
      {withLine(hertz, 13, "damper = \"critical\"\ne_n = 0"),
       "case.toml:14:7: law.e_n = 0: a soft law needs it > 0"},
      {withLine(hertz, 9, "normal = \"polynomial\""),
       "case.toml:11:9: law.young = 1000000000.0: only normal = \"hertz\" takes it"},
      {withLine(withLine(withLine(hertz, 12, ""), 11, ""), 9, "normal = \"polynomial\""),
       "case.toml:8:1: law.k2 is missing: a polynomial law needs it > 0"},
  });
}

TEST_F(LoaderErrors, Law_Rigid_HasNeitherSpringsNorAContactTime) {
  const std::string rigid =
      "[case]\nkind = \"collision\"\n[collision]\npsi = 1\nvn = 1\nradius = 1\nmass = 1\n"
      "[run]\ndt = 0.1\n[law]\nnormal = \"rigid\"\ne_n = 0.9\n";  // further lines: 13 on
  expectMessages({
      {rigid, ""},
      {withLine(rigid, 12, ""), "case.toml:10:1: law.e_n is missing: a rigid law needs it"},
      {withLine(rigid, 12, "e_n = 1.1"), "case.toml:12:7: law.e_n = 1.1: must be in [0, 1]"},
      {rigid + "e_t0 = -0.1\n", "case.toml:13:8: law.e_t0 = -0.1: must be in [0, 1]"},
      {rigid + "kn = 5\n",
       "case.toml:13:6: law.kn = 5: a rigid law has none: set it to 0 or leave it out"},
      {rigid + "tangential = \"spring\"\n",
       "case.toml:13:14: law.tangential = \"spring\": a rigid law has none or coulomb"},
      {withLine(rigid, 9, ""), "case.toml:8:1: run.dt is missing: a rigid law has no contact time"},
      {withLine(rigid, 7, "mass = 1\nsteps_per_contact = 50"),
       "case.toml:8:21: collision.steps_per_contact = 50: a rigid law has no contact time, give "
       "run.dt"},
  });
}

/// A disk alone; further lines of its law: 16 on.
const std::string loneDisk =
    "[case]\nkind = \"assembly\"\n[assembly]\nduration = 1\n[[assembly.disks]]\n"
    "position = [0, 0]\nradius = 1\nmass = 1\n[run]\ndt = 1e-6\n[law]\nnormal = \"linear\"\n"
    "tangential = \"none\"\ngn = 0\nkn = 100\n";

TEST_F(LoaderErrors, Law_OfRolling_NeedsItsConstantsWithinTheirRanges) {
  expectMessages({
      {loneDisk + "rolling = \"spring\"\nmu_r = 0.1\nkr_factor = 3\n", ""},
      {loneDisk + "mu_r = -0.1\n", "case.toml:16:8: law.mu_r = -0.1: must be >= 0"},
      {loneDisk + "mu_r = 0.1\n",
       "case.toml:16:8: law.mu_r = 0.1: mu_r without rolling resistance (law.rolling is none): set "
       "it to 0 or leave it out"},
      {loneDisk + "kr = 5\n",
       "case.toml:16:6: law.kr = 5: kr without rolling resistance (law.rolling is none): set it to "
       "0 or leave it out"},
      {loneDisk + "rolling = \"sping\"\n",
       "case.toml:16:11: law.rolling = \"sping\": unknown name (did you mean spring?)"},
      {loneDisk + "rolling = \"spring\"\n",
       "case.toml:11:1: law.mu_r is missing: this rolling resistance needs it > 0"},
      {loneDisk + "rolling = \"spring\"\nmu_r = 0\nkr = 1\n",
       "case.toml:17:8: law.mu_r = 0: this rolling resistance needs it > 0"},
      {loneDisk + "rolling = \"spring\"\nmu_r = 0.1\n",
       "case.toml:11:1: law.kr is missing: a rolling spring needs it > 0, or kr_per_kt or "
       "kr_factor"},
      {loneDisk + "rolling = \"spring\"\nmu_r = 0.1\nkr = 0\n",
       "case.toml:18:6: law.kr = 0: a rolling spring needs it > 0"},
      {loneDisk + "rolling = \"spring\"\nmu_r = 0.1\nkr_factor = 3\nkr_per_kt = 1\n",
       "case.toml:18:13: law.kr_factor = 3: one of kr, kr_per_kt and kr_factor"},
      {loneDisk + "rolling = \"spring\"\nmu_r = 0.1\nkr = 1\nkr_factor = 3\n",
       "case.toml:18:6: law.kr = 1: one of kr, kr_per_kt and kr_factor"},
      {loneDisk + "rolling = \"spring\"\nmu_r = 0.1\nkr_per_kt = 1\n",
       "case.toml:18:13: law.kr_per_kt = 1: a rolling spring needs it > 0, and what it is times"},
      {loneDisk +
           "rolling = \"spring\"\nmu_r = 0.1\nkr_factor = 2.25\nrolling_stiffness = \"constant\"\n",
       "case.toml:18:13: law.kr_factor = 2.25: [N/m], and rolling_stiffness = \"constant\" is [N "
       "m]: give kr"},
      {loneDisk + "rolling = \"viscous\"\n",
       "case.toml:11:1: law.gr is missing: viscous rolling resistance needs it > 0"},
      {loneDisk + "rolling = \"spring\"\nmu_r = 0.1\nkr = 1\ngr = -1\n",
       "case.toml:19:6: law.gr = -1: must be >= 0 kg/s"},
      {loneDisk + "rolling = \"constant_torque\"\nmu_r = inf\n",
       "case.toml:17:8: law.mu_r = inf: is infinite: must be >= 0"},
  });
}

TEST_F(LoaderErrors, Law_OfCohesion_NeedsItsConstantsWithinTheirRanges) {
  expectMessages({
      {loneDisk + "cohesion = \"dmt\"\ngamma = 0.05\n", ""},
      {loneDisk + "kc = 1\n",
       "case.toml:16:6: law.kc = 1: kc without cohesion (law.cohesion is none): set it to 0 or "
       "leave it out"},
      {loneDisk + "w = 0.1\n",
       "case.toml:16:5: law.w = 0.1: w without cohesion (law.cohesion is none): set it to 0 or "
       "leave it out"},
      {loneDisk + "cohesion = \"area\"\n",
       "case.toml:11:1: law.kc is missing: cohesion by area needs it > 0"},
      {loneDisk + "cohesion = \"area\"\nkc = -1\n", "case.toml:17:6: law.kc = -1: must be >= 0 Pa"},
      {loneDisk + "cohesion = \"dmt\"\n",
       "case.toml:11:1: law.w is missing: adhesion needs it > 0"},
      {loneDisk + "cohesion = \"dmt\"\ngamma = -0.1\n",
       "case.toml:17:9: law.gamma = -0.1: must be >= 0 J/m^2"},
      {loneDisk + "cohesion = \"dmt\"\nw = 0.1\ngamma = 0.05\n",
       "case.toml:18:9: law.gamma = 0.05: stands beside w: give one of the two"},
      {loneDisk + "cohesion = \"jkr\"\nw = 0.1\n",
       "case.toml:16:12: law.cohesion = \"jkr\": \"jkr\" is Hertz' law with adhesion: it needs "
       "normal = \"hertz\""},
      {loneDisk + "cohesion = \"elasto_plastic\"\n",
       "case.toml:11:1: law.k_unload is missing: an elasto-plastic law needs it > 0"},
      {loneDisk + "cohesion = \"elasto_plastic\"\nk_unload = 50\n",
       "case.toml:17:12: law.k_unload = 50: unloading is stiffer than loading: more than kn"},
      {loneDisk + "cohesion = \"elasto_plastic\"\nk_unload = 200\nplastic_depth = -1\n",
       "case.toml:18:17: law.plastic_depth = -1: must be >= 0"},
      {loneDisk + "cohesion = \"elasto_plastic\"\nk_unload = 200\nkc = nan\n",
       "case.toml:18:6: law.kc = nan: is not a number"},
  });
}

}  // namespace
}  // namespace crossgrain::test
