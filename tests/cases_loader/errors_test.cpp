// Every kind of bad input: one line that says where, what is there, and what would be right. Laws
// and collisions: law_errors_test.cpp.
#include "bad_cases.hpp"

namespace crossgrain::test {
namespace {

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
      {line(18, "small = -1"), "case.toml:18:9: particles.small = -1: must be in [0, 1000000]"},
      {line(18, "small = 9223372036854775807"),
       "case.toml:18:9: particles.small = 9223372036854775807: must be in [0, 1000000]"},
      {line(4, "kn = nan"), "case.toml:4:6: law.kn = nan: is not a number"},
      {line(15, "height = inf"), "case.toml:15:10: cell.height = inf: is infinite: must be > 0 m"},
      {line(14, "wall_spacing = 0"), "case.toml:14:16: cell.wall_spacing = 0: must be > 0 m"},
      {line(16, "omega = 0"),
       "case.toml:16:9: cell.omega = 0: must be > 0 or < 0 rad/s: all is timed in rotations "
       "of the wheel; < 0 is clockwise"},
      {plus("inertia_factor = 0\n"),
       "case.toml:24:18: particles.inertia_factor = 0: must be in (0, 1]"},
      {plus("[preparation]\nengine = \"yadee\"\n"),
       "case.toml:25:10: preparation.engine = \"yadee\": there is no such engine (did you mean "
       "yade?)"},
      {plus("[preparation]\npackings = 0\n"),
       "case.toml:25:12: preparation.packings = 0: must be in [1, 10000]"},
      {plus("[preparation]\nseed = -3\n"),
       "case.toml:25:8: preparation.seed = -3: must be in [0, 4294967295]"},
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
       "case.toml:25:8: engines.x.rate = inf: is infinite: must be a finite number"},
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
      {line(2, "kind = \"assembly\""), "case.toml:10:1: [cell]: has no part in an assembly case"},
      {line(2, "kind = \"couette\"\nname = \"a b\""),
       "case.toml:3:8: case.name = \"a b\": must be of letters, digits and . _ - +, at most 80, "
       "and "
       "not start with a dot"},
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
       "case.toml:17:1: particles.small is missing: or large, or volume_fraction, or file: a cell "
       "without disks"},
      {plus("[bottom]\nmu = 1e-5\nkb = 1\ngb = 0\n"), "case.toml:24:1: bottom.tau_m is missing"},
      {plus("[averaging.margins]\nspin = { relative = 0.1 }\n"),
       "case.toml:25:8: averaging.margins.spin.why is missing"},
      {plus("[averaging.margins]\nspin = { why = \"x\" }\n"),
       "case.toml:25:8: averaging.margins.spin.relative is missing: or absolute, or share and of: "
       "a "
       "margin has one of them"},
      {collision(9, ""), "case.toml:8:1: collision.psi is missing"},
  });
}

TEST_F(LoaderErrors, TheCellMustHoldItsDisks) {
  expectMessages({
      {line(12, "outer_radius = 0.03"),
       "case.toml:12:16: cell.outer_radius = 0.03: must be > inner_radius = 0.03 m"},
      {line(12, "outer_radius = 0.0414"),  // 11.4 mm − 2.5 mm of wall disks, the large one has 8.99
       "case.toml:12:16: cell.outer_radius = 0.0414: a disk of radius 0.004495 m does not fit "
       "between the walls, 0.0089 m apart"},
      // Chords less 2.5 mm: 60 sin(π/19) = 9.88 mm hold 7.4 mm back, 150 sin(π/47) = 10.02 mm do
      // not.
      {line(14, "wall_spacing = 0.01"),
       "case.toml:14:16: cell.wall_spacing = 0.01: a disk of radius 0.0037 m slips through holes "
       "of 0.007519 m between the 47 disks of the ring"},
      // 60 sin(π/18) = 10.42 mm: fewer disks than 2π·30/10.2 = 18.5 stand further apart than
      // wanted.
      {line(14, "wall_spacing = 0.0102"),
       "case.toml:14:16: cell.wall_spacing = 0.0102: a disk of radius 0.0037 m slips through holes "
       "of 0.007919 m between the 18 disks of the wheel"},
      // 150 sin(π/59) − 2.5 = 5.48 mm, and 7.48 mm with the ring at 1.25 R_o.
      {line(14, "wall_spacing = 0.008"),
       "case.toml:14:16: cell.wall_spacing = 0.008: a disk of radius 0.0037 m slips through holes "
       "of 0.007479 m between the 59 disks of the ring before it shrinks from "
       "preparation.dilation = 1.25 R_o"},
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

TEST_F(LoaderErrors, Variants) {
  expectMessages({
      {"variants = 3\n" + soundCase,
       "case.toml:1:12: variants: must be a list of tables, [[variants]]"},
      {plus("[[variants]]\nlaw.mu = 0.1\n"), "case.toml:24:1: variants: each needs a name"},
      {plus("[[variants]]\nname = \"a\"\n[[variants]]\nname = \"a\"\n"),
       "case.toml:27:8: variants.name: \"a\" is there twice"},
      {plus("[[variants]]\nname = \"a/b\"\n"),
       "case.toml:25:8: variants.name: \"a/b\" must be of letters, digits and . _ - +, at most 80, "
       "and not start with a dot"},
  });
}

TEST_F(LoaderErrors, Files) {
  EXPECT_EQ(messageOf("none.toml"), "none.toml: no such file");
  EXPECT_EQ(messageOf("."), ".: is a folder, not a file");
  write("a.toml", "[case]\nextends = \"none.toml\"\n");
  EXPECT_EQ(messageOf("a.toml"),
            "a.toml:2:11: case.extends = \"none.toml\": no such file (looked for none.toml)");
  write("a.toml", "extends = \"none.toml\"\n");
  EXPECT_EQ(messageOf("a.toml"), "a.toml:1:11: unknown key extends (did you mean case.extends?)");
  write("a.toml", "[case]\nname = \"a\"\n[zzzzzz]\n");
  const std::string listed = messageOf("a.toml");
  ASSERT_NE(listed.find("preparation"), std::string::npos) << listed;
  EXPECT_EQ(listed.find("preparation"), listed.rfind("preparation")) << "each key once: " << listed;
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

/// What it breaks may show in another line of the file, which says nothing wrong.
TEST_F(LoaderErrors, WhatAnOverrideBreaksIsBlamedOnIt) {
  write("case.toml", soundCase);
  const std::string missing = messageOf("case.toml", {"law.normal=hertz"});
  EXPECT_TRUE(missing.starts_with("--set law.normal=hertz: case.toml:3:1: law.young is missing"))
      << missing;
  const std::string of = messageOf("case.toml", {"law.mu=0.3", "cell.outer_radius=0.02"});
  EXPECT_TRUE(of.starts_with("--set cell.outer_radius=0.02: ")) << of;
  // What is wrong without it is the file's own.
  write("case.toml", line(20, "small_radius = -0.0037"));
  EXPECT_EQ(messageOf("case.toml", {"law.normal=hertz"}).find("case.toml:20:16:"), 0u);
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
}  // namespace crossgrain::test
