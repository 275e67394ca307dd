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
       "case.toml:15:7: law.e_n = 0.5: and gn: give one of them"},
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

}  // namespace
}  // namespace crossgrain::test
