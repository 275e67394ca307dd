// Every kind of bad input: one line that says where, what is there, and what would be right.
#include "files.hpp"

namespace crossgrain {
namespace {

using LoaderErrors = InFolder;

struct Bad {
  std::string text;     ///< of case.toml
  std::string message;  ///< all of it
};

void expectMessages(const std::vector<Bad>& bads) {
  for (const Bad& bad : bads) {
    std::ofstream("case.toml") << bad.text;
    EXPECT_EQ(messageOf("case.toml"), bad.message) << bad.text;
  }
}

/// The sound case with one line replaced, or with lines added from line 24 on.
std::string line(int number, const std::string& text) {
  return withLine(soundCase, number, text);
}
std::string plus(const std::string& lines) {
  return soundCase + lines;
}

/// The sound collision likewise; lines are added from line 13 on.
std::string collision(int number, const std::string& text) {
  return withLine(soundCollision, number, text);
}

TEST_F(LoaderErrors, TheSoundCasesAreSound) {
  expectMessages({{soundCase, ""}, {soundCollision, ""}});
}

TEST_F(LoaderErrors, UnknownKeysNameTheNearest) {
  expectMessages({
      {line(20, "smal_radius = 0.0037"),
       "case.toml:20:1: unknown key particles.smal_radius (did you mean small_radius?)"},
      {line(17, "[partciles]"), "case.toml:17:2: unknown key partciles (did you mean particles?)"},
      {line(2, "kind = \"couette\"\nzzzzzz = 1"),
       "case.toml:3:1: unknown key case.zzzzzz (there are: name, kind)"},
      {plus("[averaging.margins]\nspinn = { relative = 0.1, why = \"x\" }\n"),
       "case.toml:25:1: unknown key averaging.margins.spinn (did you mean spin?)"},
      {plus("[averaging.margins]\nspin = { relativ = 0.1, why = \"x\" }\n"),
       "case.toml:25:10: unknown key averaging.margins.spin.relativ (did you mean relative?)"},
      {plus("[[variants]]\nname = \"a\"\nlaw.knn = 3\n"),
       "case.toml:26:5: unknown key law.knn (did you mean kn?)"},
  });
}

TEST_F(LoaderErrors, WrongTypesSayWhatIsThereAndWhatIsWanted) {
  expectMessages({
      {line(4, "kn = \"352.1\""),
       "case.toml:4:6: law.kn = \"352.1\": must be a number, is a string"},
      {line(4, "kn = true"), "case.toml:4:6: law.kn = true: must be a number, is a boolean"},
      {line(4, "kn = [1, 2]"), "case.toml:4:6: law.kn: must be a number, is a list"},
      {line(4, "kn = 1979-05-27"),
       "case.toml:4:6: law.kn = 1979-05-27: must be a number, is a date or time"},
      {line(18, "small = 210.0"),
       "case.toml:18:9: particles.small = 210.0: must be a whole number, is a decimal number"},
      {plus("[run]\nmirrors = 1\n"),
       "case.toml:25:11: run.mirrors = 1: must be true or false, is a whole number"},
      {line(9, "tangential = 1"),
       "case.toml:9:14: law.tangential = 1: must be a string, is a whole number"},
      {"law = 3\n" + soundCase.substr(0, soundCase.find("[law]")),
       "case.toml:1:7: law = 3: must be a table, is a whole number"},
      {plus("[run]\nmay_differ = [\"tension\", 3]\n"),
       "case.toml:25:26: run.may_differ[1] = 3: must be a string, is a whole number"},
      {plus("[engines.x]\nmode = [1]\n"),
       "case.toml:25:8: engines.x.mode: must be a number, is a list"},
      {plus("[engines]\ndt = 1\n"),
       "case.toml:25:6: engines.dt = 1: must be a table, is a whole number"},
  });
}

TEST_F(LoaderErrors, NumbersOutOfRangeSayTheRange) {
  expectMessages({
      {line(20, "small_radius = -0.0037"),
       "case.toml:20:16: particles.small_radius = -0.0037: must be > 0 m"},
      {line(22, "small_mass = 0"), "case.toml:22:14: particles.small_mass = 0: must be > 0 kg"},
      {line(18, "small = -1"), "case.toml:18:9: particles.small = -1: must be in [0, 10000000]"},
      {line(18, "small = 9223372036854775807"),
       "case.toml:18:9: particles.small = 9223372036854775807: must be in [0, 10000000]"},
      {line(4, "kn = nan"), "case.toml:4:6: law.kn = nan: must be >= 0 N/m"},
      {line(15, "height = inf"), "case.toml:15:10: cell.height = inf: must be > 0 m"},
      {line(14, "wall_spacing = 0"), "case.toml:14:16: cell.wall_spacing = 0: must be > 0 m"},
      {line(16, "omega = 0"), "case.toml:16:9: cell.omega = 0: must be > 0 rad/s"},
      {plus("inertia_factor = 0\n"),
       "case.toml:24:18: particles.inertia_factor = 0: must be in (0, 1]"},
      {plus("[preparation]\npackings = 0\n"),
       "case.toml:25:12: preparation.packings = 0: must be in [1, 10000]"},
      {plus("[preparation]\nseed = -3\n"), "case.toml:25:8: preparation.seed = -3: must be >= 0"},
      {plus("[preparation]\ndilation = 1\n"),
       "case.toml:25:12: preparation.dilation = 1: must be > 1"},
      {plus("[preparation]\nrotations = -1\n"),
       "case.toml:25:13: preparation.rotations = -1: must be >= 0"},
      {plus("[averaging]\nrotations = 0\n"),
       "case.toml:25:13: averaging.rotations = 0: must be > 0"},
      {plus("[averaging]\nconfidence = 1\n"),
       "case.toml:25:14: averaging.confidence = 1: must be in (0, 1)"},
      {plus("[averaging]\nrings = 0\n"),
       "case.toml:25:9: averaging.rings = 0: must be in [1, 10000]"},
      {plus("[run]\ndt = 0\n"), "case.toml:25:6: run.dt = 0: must be > 0 s"},
      {plus("[run]\nsteps_per_contact = 1\n"),
       "case.toml:25:21: run.steps_per_contact = 1: must be >= 2"},
      {plus("[engines.x]\nrate = inf\n"),
       "case.toml:25:8: engines.x.rate = inf: must be a finite number"},
      {collision(10, "vn = [0.1, 0]"),
       "case.toml:10:12: collision.vn[1] = 0: must be > 0 m/s, else the disks never meet"},
  });
}

TEST_F(LoaderErrors, UnknownNamesSuggestTheNearest) {
  expectMessages({
      {line(2, "kind = \"colision\""),
       "case.toml:2:8: case.kind = \"colision\": unknown name (did you mean collision?)"},
      {line(9, "tangential = \"spring_dashpt\""),
       "case.toml:9:14: law.tangential = \"spring_dashpt\": unknown name (did you mean "
       "spring_dashpot?)"},
      {line(9, "tangential = \"mindlin-deresiewicz\""),
       "case.toml:9:14: law.tangential = \"mindlin-deresiewicz\": unknown name (there are: none, "
       "coulomb, viscous, spring, spring_dashpot)"},
      {plus("[averaging]\nmethod = \"slices\"\n"),
       "case.toml:25:10: averaging.method = \"slices\": unknown name (did you mean slicing?)"},
      {plus("[run]\nhandover = \"warm\"\n"),
       "case.toml:25:12: run.handover = \"warm\": not yet supported; \"cold\" is"},
      {plus("[run]\nhandover = \"hot\"\n"),
       "case.toml:25:12: run.handover = \"hot\": unknown name (there are: cold, warm)"},
      {plus("[run]\nmay_differ = [\"tensoin\"]\n"),
       "case.toml:25:15: run.may_differ[0] = \"tensoin\": unknown name (did you mean tension?)"},
      {plus("[run]\nmay_differ = [\"tension\", \"tension\"]\n"),
       "case.toml:25:14: run.may_differ: \"tension\" is there twice"},
      {line(2, "kind = \"assembly\""),
       "case.toml:2:8: case.kind = \"assembly\": not yet supported"},
      {line(2, "kind = \"couette\"\nname = \"a b\""),
       "case.toml:3:8: case.name = \"a b\": must be of letters, digits and . _ - +, and not start "
       "with a dot"},
  });
}

TEST_F(LoaderErrors, MissingKeysNameTheirSection) {
  expectMessages({
      {line(20, ""), "case.toml:17:1: particles.small_radius is missing"},
      {line(2, ""), "case.toml:1:1: case.kind is missing"},
      {line(5, ""), "case.toml:3:1: law.gn is missing: an undamped law says 0"},
      {line(9, ""), "case.toml:3:1: law.tangential is missing: a frictionless law says none"},
      {soundCase.substr(0, soundCase.find("[particles]")),
       "case.toml: particles.small_radius is missing"},
      {"", "case.toml: case.kind is missing"},
      {withLine(line(18, ""), 19, ""),
       "case.toml:17:1: particles.small is missing: or large, or file: a cell without disks"},
      {plus("[bottom]\nmu = 1e-5\nkb = 1\ngb = 0\n"), "case.toml:24:1: bottom.tau_m is missing"},
      {plus("[averaging.margins]\nspin = { relative = 0.1 }\n"),
       "case.toml:25:8: averaging.margins.spin.why is missing"},
      {plus("[averaging.margins]\nspin = { why = \"x\" }\n"),
       "case.toml:25:8: averaging.margins.spin.relative is missing: or absolute: a margin has one "
       "of them"},
      {collision(9, ""), "case.toml:8:1: collision.psi is missing"},
  });
}

TEST_F(LoaderErrors, LawsNeedWhatTheyUseAndNothingElse) {
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
      {line(5, "gn = 30"),
       "case.toml:5:6: law.gn = 30: overdamps the lightest pair: must be < 0.4401"},
      {line(5, "gn = 0.1\ne_n = 0.9"),
       "case.toml:6:7: law.e_n = 0.9: a rigid law takes it, and a linear or Hertz law with damper "
       "= "
       "\"critical\""},
  });
}

TEST_F(LoaderErrors, LawsThatStiffenHaveTheirOwnKeys) {
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

TEST_F(LoaderErrors, WallsHaveNeitherSizeNorSpin) {
  expectMessages({
      {collision(12, "mass = 0.275e-3\nsecond = \"wall\""), ""},
      {collision(12, "mass = 0.275e-3\nsecond = \"wal\""),
       "case.toml:13:10: collision.second = \"wal\": unknown name (did you mean wall?)"},
      {collision(12, "mass = [0.275e-3, 1]\nsecond = \"wall\""),
       "case.toml:12:8: collision.mass: a wall has none: give the disk's alone"},
      {collision(12, "mass = 0.275e-3\nsecond = \"wall\"\ncounter_spin = 1"),
       "case.toml:14:16: collision.counter_spin = 1: a wall does not turn"},
      {collision(12, "mass = 0.275e-3\nwall_velocity = [0, 1]"),
       "case.toml:13:17: collision.wall_velocity: only a wall has one (second = \"wall\")"},
      {collision(12, "mass = 0.275e-3\nsecond = \"wall\"\nwall_velocity = 1"),
       "case.toml:14:17: collision.wall_velocity = 1: must be [along its normal, along it] in m/s"},
      {collision(9, "psi = 1\nangle = 45"),
       "case.toml:10:9: collision.angle = 45: and psi, its tangent: give one of them"},
      {collision(9, "angle = 90"),
       "case.toml:9:9: collision.angle = 90: must be in (-90, 90) degrees"},
      {collision(10, "vn = 1\nspeed = 1"),
       "case.toml:11:9: collision.speed = 1: and vn, its part along the normal: give one of them"},
  });
}

TEST_F(LoaderErrors, RigidLawsHaveNeitherSpringsNorAContactTime) {
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

TEST_F(LoaderErrors, TheCellMustHoldItsDisks) {
  expectMessages({
      {line(12, "outer_radius = 0.03"),
       "case.toml:12:16: cell.outer_radius = 0.03: must be > inner_radius = 0.03 m"},
      {line(12, "outer_radius = 0.0414"),  // 11.4 mm − 2.5 mm of wall disks, the large one has 8.99
       "case.toml:12:16: cell.outer_radius = 0.0414: a disk of radius 0.004495 m does not fit "
       "between the walls, 0.0089 m apart"},
      {line(14, "wall_spacing = 0.01"),  // 10 − 2.5 = 7.5 mm lets 7.4 mm through
       "case.toml:14:16: cell.wall_spacing = 0.01: a disk of radius 0.0037 m slips through holes "
       "of "
       "0.0075 m"},
      {line(14, "wall_spacing = 0.04"),
       "case.toml:14:16: cell.wall_spacing = 0.04: must be <= inner_radius = 0.03 m"},
      {line(18, "small = 300"),  // (300·3.7² + 34·4.495²)/4725 = 1.015
       "case.toml:18:9: particles.small = 300: the disks have 1.015 times the area of the cell"},
      {withLine(line(18, "small = 0"), 19, "large = 0"),
       "case.toml:18:9: particles.small = 0: no small and no large disks: a cell without disks"},
      {line(21, "large_radius = 0.003"),
       "case.toml:21:16: particles.large_radius = 0.003: must be >= small_radius = 0.0037 m"},
      {plus("file = \"none.h5\"\n"),
       "case.toml:24:8: particles.file = \"none.h5\": no such file (looked for none.h5)"},
  });
}

TEST_F(LoaderErrors, SectionsAndKeysBelongToTheirKind) {
  expectMessages({
      {plus("[collision]\nvn = 1\n"), "case.toml:24:1: [collision]: has no part in a couette case"},
      {soundCollision + "[cell]\nheight = 1\n",
       "case.toml:13:1: [cell]: has no part in a collision case"},
      {soundCollision + "[run]\nsteps_per_contact = 50\n",
       "case.toml:14:21: run.steps_per_contact = 50: a collision takes "
       "collision.steps_per_contact"},
      {soundCollision + "[run]\ndt = 1e-5\n",
       "case.toml:14:6: run.dt = 1e-05: a collision of a soft law takes "
       "collision.steps_per_contact"},
      {plus("[run]\ndt = 1e-5\nsteps_per_contact = 50\n"),
       "case.toml:26:21: run.steps_per_contact = 50: the step is given by run.dt, leave out one of "
       "them"},
      {plus("[averaging.margins]\nspin = { relative = 0.1, absolute = 1, why = \"x\" }\n"),
       "case.toml:25:37: averaging.margins.spin.absolute = 1: spin is relative or absolute, not "
       "both"},
      {plus("[averaging.margins]\nspin = { relative = 0.1, why = \"\" }\n"),
       "case.toml:25:32: averaging.margins.spin.why = \"\": must give the reason"},
      {plus("[averaging]\nmethod = []\n"), "case.toml:25:10: averaging.method: must not be empty"},
  });
}

TEST_F(LoaderErrors, SweepsOfCollisions) {
  expectMessages({
      {soundCollision + "[collision.margins]\nspin = { absolute = 1, why = \"x\" }",
       "case.toml:14:1: unknown key collision.margins.spin (did you mean spin_i?)"},
      {soundCollision + "[collision.margins]\nanything_else_at_all = { absolute = 1, why = \"x\" }",
       "case.toml:14:1: unknown key collision.margins.anything_else_at_all (there are: psi_f, e_n, "
       "beta, e_t, centre_psi_f, rebound_angle, spin_i, spin_j, duration, max_overlap, "
       "energy_lost, "
       "lost_normal_damping, lost_tangential, lost_tangential_damping, lost_stiffening, "
       "lost_sliding, lost_stored)"},
      {collision(9, "psi = []"), "case.toml:9:7: collision.psi: must not be empty"},
      {collision(9, "psi = { from = 0, to = 4 }"), "case.toml:9:7: collision.psi.count is missing"},
      {collision(9, "psi = { from = 0, to = 4, count = 1 }"),
       "case.toml:9:35: collision.psi.count = 1: must be in [2, 10000]"},
      {collision(9, "psi = { from = 4, to = 4, count = 3 }"),
       "case.toml:9:24: collision.psi.to = 4: must be > 4 (from)"},
      {collision(11, "radius = [1, 2, 3]"),
       "case.toml:11:10: collision.radius: must be one number or two"},
      {collision(12, "mass = 0.275e-3\nstart_phase = 1"),
       "case.toml:13:15: collision.start_phase = 1: must be < 1"},
      {collision(12, "mass = 0.275e-3\nstart_phase = -0.5"),
       "case.toml:13:15: collision.start_phase = -0.5: must be >= 0, else the disks overlap at the "
       "start"},
      {collision(12, "mass = 0.275e-3\napproach = \"obligue\""),
       "case.toml:13:12: collision.approach = \"obligue\": unknown name (did you mean oblique?)"},
      {collision(5, "gn = 0.45"),
       "case.toml:5:6: law.gn = 0.45: overdamps the lightest pair: must be < 0.4401"},
  });
}

TEST_F(LoaderErrors, Variants) {
  expectMessages({
      {"variants = 3\n" + soundCase,
       "case.toml:1:12: variants: must be a list of tables, [[variants]]"},
      {plus("[[variants]]\nlaw.mu = 0.1\n"), "case.toml:24:1: variants: each needs a name"},
      {plus("[[variants]]\nname = \"a\"\n[[variants]]\nname = \"a\"\n"),
       "case.toml:27:8: variants.name: \"a\" is there twice"},
      {plus("[[variants]]\nname = \"a/b\"\n"),
       "case.toml:25:8: variants.name: \"a/b\" must be of letters, digits and . _ - +, and not "
       "start with a dot"},
  });
}

TEST_F(LoaderErrors, Files) {
  EXPECT_EQ(messageOf("none.toml"), "none.toml: no such file");
  EXPECT_EQ(messageOf("."), ".: no such file");
  write("a.toml", "[case]\nextends = \"none.toml\"\n");
  EXPECT_EQ(messageOf("a.toml"),
            "a.toml:2:11: case.extends = \"none.toml\": no such file (looked for none.toml)");
  write("a.toml", "[case]\nextends = 3\n");
  EXPECT_EQ(messageOf("a.toml"), "a.toml:2:11: case.extends: must be the path of a case file");
  write("a b.toml", soundCase);
  EXPECT_EQ(messageOf("a b.toml"),
            "a b.toml:1:1: case.name is missing: the name of the file cannot stand in for it");
}

TEST_F(LoaderErrors, CyclesOfExtends) {
  write("a.toml", "[case]\nextends = \"sub/b.toml\"\n");
  write("sub/b.toml", "[case]\nextends = \"../c.toml\"\n");
  write("c.toml", "[case]\nextends = \"a.toml\"\n");
  EXPECT_EQ(
      messageOf("a.toml"),
      "a.toml: case.extends goes round in a circle: a.toml -> sub/b.toml -> c.toml -> a.toml");
  write("self.toml", "[case]\nextends = \"self.toml\"\n");
  EXPECT_EQ(messageOf("self.toml"),
            "self.toml: case.extends goes round in a circle: self.toml -> self.toml");
}

TEST_F(LoaderErrors, AnErrorIsReportedWhereTheValueWasWritten) {
  write("law.toml", line(20, "small_radius = -1"));
  write("top.toml", "[case]\nextends = \"law.toml\"\n[law]\nkn = 300\n");
  EXPECT_EQ(messageOf("top.toml"), "law.toml:20:16: particles.small_radius = -1: must be > 0 m");
  write("top.toml", "[case]\nextends = \"law.toml\"\n[particles]\nsmall_radius = -2\n");
  EXPECT_EQ(messageOf("top.toml"), "top.toml:4:16: particles.small_radius = -2: must be > 0 m");
}

TEST_F(LoaderErrors, Syntax) {
  for (const auto& [text, where] : std::vector<std::pair<std::string, std::string>>{
           {"[case\nkind = 3\n", "case.toml:1:"},
           {"[case]\nkind = \"couette\n", "case.toml:2:"},
           {"[case]\nkind = couette\n", "case.toml:2:"},
           {"[case]\nkind = 1\nkind = 2\n", "case.toml:3:"},
           {"\x80\xff\n", "case.toml:1:"},
           {std::string("[case]\nkind\0", 12), "case.toml:2:"}}) {
    std::ofstream("case.toml", std::ios::binary) << text;
    const std::string message = messageOf("case.toml");
    EXPECT_TRUE(message.starts_with(where)) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST_F(LoaderErrors, AFileCutOffAnywhereLoadsOrGivesOneLine) {
  const std::string whole = plus("[[variants]]\nname = \"a\"\nlaw.mu = 0.1\n");
  for (std::size_t length = 0; length < whole.size(); ++length) {
    std::ofstream("case.toml") << whole.substr(0, length);
    const std::string message = messageOf("case.toml");
    if (message.empty()) continue;
    EXPECT_TRUE(message.starts_with("case.toml")) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST_F(LoaderErrors, OverridesNameThemselves) {
  write("case.toml", soundCase);
  for (const auto& [text, message] : std::vector<std::pair<std::string, std::string>>{
           {"law.knn=3", "unknown key law.knn (did you mean kn?)"},
           {"lwa.kn=3", "unknown key lwa (did you mean law?)"},
           {"law.kn=fast", "law.kn = \"fast\": must be a number, is a string"},
           {"law.kn=-3", "law.kn = -3: must be >= 0 N/m"},
           {"law.tension=cutt", "law.tension = \"cutt\": unknown name (did you mean cut?)"},
           {"case.extends=x.toml", "unknown key case.extends (there are: name, kind)"},
           {"law.kn", "must be key.path=value"},
           {"=3", "must be key.path=value"},
           {"law.kn=", "must be key.path=value"}})
    EXPECT_EQ(messageOf("case.toml", {text}), "--set " + text + ": " + message);
  // A second line would be a second key: refused, and the message still is one line.
  EXPECT_EQ(messageOf("case.toml", {"law.kn=3\nlaw.gn=0"}),
            "--set law.kn=3 law.gn=0: must be key.path=value");
  EXPECT_TRUE(messageOf("case.toml", {"law.kn=\"a"}).starts_with("--set law.kn=\"a: "));
}

}  // namespace
}  // namespace crossgrain
