// Bad input: one line that names the place, the error and the remedy. Ranges and names are data of
// the schema: here is one example of each kind of message, and every check that a section makes
// beyond its table. Laws: law_errors_test.cpp.
#include <sys/stat.h>

#include "files.hpp"

namespace crossgrain::test {
namespace {

std::string assembly(int number, const std::string& text) {
  return withLine(soundAssembly, number, text);
}

TEST_F(LoaderErrors, SoundCases_Load) {
  expectMessages({{soundCase, ""}, {soundCollision, ""}, {soundAssembly, ""}});
}

TEST_F(LoaderErrors, UnknownKey_NamesTheNearest) {
  expectMessages({
      {line(20, "smal_radius = 0.0037"),
       "case.toml:20:1: unknown key particles.smal_radius (did you mean small_radius?)"},
      {line(17, "[partciles]"), "case.toml:17:2: unknown key partciles (did you mean particles?)"},
      {line(2, "kind = \"couette\"\nzzzzzz = 1"),
       "case.toml:3:1: unknown key case.zzzzzz (there are: name, kind, dimension)"},
      {plus("[averaging.margins]\nspinn = { relative = 0.1, why = \"x\" }\n"),
       "case.toml:25:1: unknown key averaging.margins.spinn (did you mean spin?)"},
      {plus("[averaging.margins]\nspin = { relativ = 0.1, why = \"x\" }\n"),
       "case.toml:25:10: unknown key averaging.margins.spin.relativ (did you mean relative?)"},
      {plus("[[variants]]\nname = \"a\"\nlaw.knn = 3\n"),
       "case.toml:26:5: unknown key law.knn (did you mean kn?)"},
      {assembly(11, "radus = 0.5"),
       "case.toml:11:1: unknown key assembly.disks[0].radus (did you mean radius?)"},
      {soundCollision + "[collision.margins]\nspin = { absolute = 1, why = \"x\" }",
       "case.toml:14:1: unknown key collision.margins.spin (did you mean spin_i?)"},
  });
}

TEST_F(LoaderErrors, WrongType_SaysBoth) {
  expectMessages({
      {line(4, "kn = \"352.1\""),
       "case.toml:4:6: law.kn = \"352.1\": must be a number, is a string"},
      {line(4, "kn = [1, 2]"), "case.toml:4:6: law.kn: must be a number, is a list"},
      {line(18, "small = 210.0"),
       "case.toml:18:9: particles.small = 210.0: must be a whole number, is a decimal number"},
      {plus("[run]\nmirrors = 1\n"),
       "case.toml:25:11: run.mirrors = 1: must be true or false, is a whole number"},
      {"law = 3\n" + soundCase.substr(0, soundCase.find("[law]")),
       "case.toml:1:7: law = 3: must be a table, is a whole number"},
      {plus("[run]\nmay_differ = [\"tension\", 3]\n"),
       "case.toml:25:26: run.may_differ[1] = 3: must be a string, is a whole number"},
      {plus("[engines.x]\nmode = [1]\n"),
       "case.toml:25:8: engines.x.mode: must be a number, is a list"},
      {assembly(10, "position = [1.0]"),
       "case.toml:10:12: assembly.disks[0].position: must be [x, y] in m"},
      {collision(11, "radius = [1, 2, 3]"),
       "case.toml:11:10: collision.radius: must be one number or two"},
      {collision(9, "psi = []"), "case.toml:9:7: collision.psi: must not be empty"},
  });
}

TEST_F(LoaderErrors, NumberOutOfRange_SaysTheRange) {
  expectMessages({
      {line(20, "small_radius = -0.0037"),
       "case.toml:20:16: particles.small_radius = -0.0037: must be > 0 m"},
      {line(18, "small = 9223372036854775807"),
       "case.toml:18:9: particles.small = 9223372036854775807: must be in [0, 1000000]"},
      {line(4, "kn = nan"), "case.toml:4:6: law.kn = nan: is not a number"},
      {line(15, "height = inf"), "case.toml:15:10: cell.height = inf: is infinite: must be > 0 m"},
      {line(16, "omega = 0"),
       "case.toml:16:9: cell.omega = 0: must be > 0 or < 0 rad/s: all is timed in rotations "
       "of the wheel; < 0 is clockwise"},
      {plus("inertia_factor = 0\n"),
       "case.toml:24:18: particles.inertia_factor = 0: must be in (0, 1]"},
      {plus("[preparation]\nseed = 4294967296\n"),
       "case.toml:25:8: preparation.seed = 4294967296: must be in [0, 4294967295]"},
      {plus("[engines.x]\nrate = inf\n"),
       "case.toml:25:8: engines.x.rate = inf: is infinite: must be a finite number"},
      {collision(10, "vn = [0.1, 0]"),
       "case.toml:10:12: collision.vn[1] = 0: must be > 0 m/s, else the two never meet"},
      {collision(9, "psi = { from = 0, to = 4, count = 1 }"),
       "case.toml:9:35: collision.psi.count = 1: must be in [2, 10000]"},
      {collision(9, "angle = 90"),
       "case.toml:9:9: collision.angle = 90: must be in (-90, 90) degrees"},
      {plus("[run]\ntimeout = 1e300\n"),
       "case.toml:25:11: run.timeout = 1e+300: must be in [0.001, 1000000000] s"},
  });
}

TEST_F(LoaderErrors, UnknownName_SuggestsTheNearest) {
  expectMessages({
      {line(2, "kind = \"colision\""),
       "case.toml:2:8: case.kind = \"colision\": unknown name (did you mean collision?)"},
      {line(9, "tangential = \"mindlin-deresiewicz\""),
       "case.toml:9:14: law.tangential = \"mindlin-deresiewicz\": unknown name (there are: none, "
       "coulomb, viscous, spring, spring_dashpot)"},
      {plus("[averaging]\nmethod = \"slices\"\n"),
       "case.toml:25:10: averaging.method = \"slices\": unknown name (did you mean slicing?)"},
      {plus("[averaging]\nmethod = []\n"), "case.toml:25:10: averaging.method: must not be empty"},
      {plus("[run]\nhandover = \"warm\"\n"),
       "case.toml:25:12: run.handover = \"warm\": not yet supported; \"cold\" is"},
      {plus("[run]\nmay_differ = [\"tensoin\"]\n"),
       "case.toml:25:15: run.may_differ[0] = \"tensoin\": unknown name (did you mean tension?)"},
      {plus("[run]\nmay_differ = [\"tension\", \"tension\"]\n"),
       "case.toml:25:14: run.may_differ: \"tension\" is there twice"},
      {plus("[preparation]\nengine = \"yadee\"\n"),
       "case.toml:25:10: preparation.engine = \"yadee\": there is no such engine (did you mean "
       "yade?)"},
      {line(2, "kind = \"couette\"\nname = \"" + std::string(81, 'a') + "\""),
       "case.toml:3:8: case.name = \"" + std::string(81, 'a') +
           "\": must be of letters, digits and . _ - +, at most 80, and not start with a dot"},
  });
}

TEST_F(LoaderErrors, MissingKey_NamesItsSection) {
  expectMessages({
      {line(20, ""), "case.toml:17:1: particles.small_radius is missing"},
      {line(2, ""), "case.toml:1:1: case.kind is missing"},
      {soundCase.substr(0, soundCase.find("[particles]")),
       "case.toml: particles.small_radius is missing"},
      {"", "case.toml: case.kind is missing"},
      {withLine(line(18, ""), 19, ""),
       "case.toml:17:1: particles.small is missing: or large, or volume_fraction, or file: a cell "
       "without disks"},
      {plus("[averaging.margins]\nspin = { relative = 0.1 }\n"),
       "case.toml:25:8: averaging.margins.spin.why is missing"},
      {plus("[averaging.margins]\nspin = { why = \"x\" }\n"),
       "case.toml:25:8: averaging.margins.spin.relative is missing: or absolute, or share and of: "
       "a margin has one of them"},
      {collision(9, ""), "case.toml:8:1: collision.psi is missing"},
      {collision(10, ""), "case.toml:8:1: collision.vn is missing"},
      {assembly(8, ""), "case.toml:7:1: assembly.duration is missing: or contact_times, or steps"},
      {assembly(12, ""), "case.toml:9:1: assembly.disks[0].mass is missing: or density"},
      {assembly(12, "mass = 1.0\n[[assembly.walls]]\npoint = [0, 0]"),
       "case.toml:13:1: assembly.walls[0].normal is missing: a plane has both"},
  });
}

TEST_F(LoaderErrors, TwoWaysToSayOneThing_AreRefused) {
  expectMessages({
      {plus("[run]\ndt = 1e-5\nsteps_per_contact = 50\n"),
       "case.toml:26:21: run.steps_per_contact = 50: the step is given by run.dt, leave out one of "
       "them"},
      {plus("[averaging.margins]\nspin = { relative = 0.1, absolute = 1, why = \"x\" }\n"),
       "case.toml:25:37: averaging.margins.spin.absolute = 1: stands beside relative: give one of "
       "the two"},
      {collision(9, "psi = 1\nangle = 45"),
       "case.toml:10:9: collision.angle = 45: stands beside psi, its tangent: give one of the two"},
      {collision(10, "vn = 1\nspeed = 1"),
       "case.toml:11:9: collision.speed = 1: stands beside vn, its part along the normal: give one "
       "of the two"},
      {assembly(12, "mass = 1.0\ndensity = 1.0"),
       "case.toml:13:11: assembly.disks[0].density = 1.0: stands beside mass: give one of the two"},
      {assembly(12, "mass = 1.0\ngrid = { columns = 2, rows = 2 }\nchain = { count = 2 }"),
       "case.toml:14:9: [assembly.disks[0].chain]: stands beside grid: give one of the two"},
      {assembly(8, "steps = 1\nduration = 2.0"),
       "case.toml:8:9: assembly.steps = 1: stands beside duration: give one of the two"},
  });
}

TEST_F(LoaderErrors, Sentences_AreNotBlank) {
  expectMessages({
      {plus("[averaging.margins]\nspin = { relative = 0.1, why = \"  \" }\n"),
       "case.toml:25:32: averaging.margins.spin.why = \"  \": must give the reason"},
      {soundAssembly + "[stability]\ntests = \"\"\nmeasure = \"energy_gain\"\nlimit = 0.1\n"
                       "degraded = 0.2\nwhy = \"b\"\n",
       "case.toml:14:9: stability.tests = \"\": must say in a sentence what it tests"},
  });
}

TEST_F(LoaderErrors, Cell_MustHoldItsDisks) {
  expectMessages({
      {line(12, "outer_radius = 0.03"),
       "case.toml:12:16: cell.outer_radius = 0.03: must be > inner_radius = 0.03 m"},
      {line(12, "outer_radius = 0.0414"),  // 11.4 mm − 2.5 mm of wall disks, the large one has 8.99
       "case.toml:12:16: cell.outer_radius = 0.0414: a disk of radius 0.004495 m does not fit "
       "between the walls, 0.0089 m apart"},
      // Chords less 2.5 mm: 60 sin(π/19) = 9.88 mm hold 7.4 mm back, 150 sin(π/47) = 10.02 do not.
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
  // Of two small disks under the sound case's law, whatever the runs' own step is.
  write("case.toml", plus("[preparation]\ndt = 1e-2\n"));
  const std::string message = messageOf("case.toml");
  EXPECT_TRUE(message.starts_with("case.toml:25:6: preparation.dt = ")) << message;
  EXPECT_NE(message.find("the longest step"), std::string::npos) << message;
}

TEST_F(LoaderErrors, Sections_BelongToTheirKind) {
  expectMessages({
      {plus("[collision]\nvn = 1\n"), "case.toml:24:1: [collision]: has no part in a couette case"},
      {line(2, "kind = \"assembly\""), "case.toml:10:1: [cell]: has no part in an assembly case"},
      {soundCollision + "[run]\nsteps_per_contact = 50\n",
       "case.toml:14:21: run.steps_per_contact = 50: a collision takes "
       "collision.steps_per_contact"},
      {soundCollision + "[run]\ndt = 1e-5\n",
       "case.toml:14:6: run.dt = 1e-05: a collision of a soft law takes "
       "collision.steps_per_contact"},
      {soundAssembly + "[preparation]\npackings = 10000",
       "case.toml:13:1: [preparation]: is of no use without [average]"},
  });
}

TEST_F(LoaderErrors, Collision_OfAWall_HasNeitherItsSizeNorItsSpin) {
  expectMessages({
      {collision(12, "mass = 0.275e-3\nsecond = \"wall\""), ""},
      {collision(12, "mass = [0.275e-3, 1]\nsecond = \"wall\""),
       "case.toml:12:8: collision.mass: a wall has none: give the disk's alone"},
      {collision(12, "mass = 0.275e-3\nsecond = \"wall\"\ncounter_spin = 1"),
       "case.toml:14:16: collision.counter_spin = 1: a wall does not turn"},
      {collision(12, "mass = 0.275e-3\nwall_velocity = [0, 1]"),
       "case.toml:13:17: collision.wall_velocity: only a wall has one (second = \"wall\")"},
      {collision(12, "mass = 0.275e-3\nsecond = \"wall\"\nwall_velocity = 1"),
       "case.toml:14:17: collision.wall_velocity = 1: must be [along its normal, along it] in m/s"},
      {line(2, "kind = \"couette\"\ndimension = 3"),
       "case.toml:3:13: case.dimension = 3: a couette cell is of the plane: collisions and "
       "assemblies are in space, too"},
      {collision(2, "kind = \"collision\"\ndimension = 4"),
       "case.toml:3:13: case.dimension = 4: must be in [2, 3]"},
      {collision(12, "mass = 0.275e-3\nturn = [0, 0, 90]"),
       "case.toml:13:8: collision.turn: only collisions in space have it (case.dimension = 3)"},
      {collision(12, "mass = 0.275e-3\nfirst_spin = [1, 0]"),
       "case.toml:13:14: collision.first_spin: only collisions in space have it (case.dimension = "
       "3)"},
      {withLine(collision(2, "kind = \"collision\"\ndimension = 3"), 13,
                "mass = 0.275e-3\nturn = [0, 90]"),
       "case.toml:14:8: collision.turn: must be [x, y, z] in degrees"},
      {withLine(collision(2, "kind = \"collision\"\ndimension = 3"), 13,
                "mass = 0.275e-3\nsecond = \"wall\"\nsecond_spin = [1, 0]"),
       "case.toml:15:15: collision.second_spin: a wall does not turn"},
      {withLine(collision(2, "kind = \"collision\"\ndimension = 3"), 13,
                "mass = 0.275e-3\nturn = [0, 0, 90]\nfirst_spin = [1, 0]"),
       ""},
      {collision(9, "psi = { from = 4, to = 4, count = 3 }"),
       "case.toml:9:24: collision.psi.to = 4: must be > 4 (from)"},
      {collision(12, "mass = 0.275e-3\nstart_phase = 1"),
       "case.toml:13:15: collision.start_phase = 1: must be in [0, 1): from 0 on, else the two "
       "overlap at the start"},
  });
}

/// A box above a wall, with one line more.
std::string convex(const std::string& shape, const std::string& more = "") {
  return R"([case]
kind = "collision"
[law]
normal = "rigid"
e_n = 0.5
mu = 0.3
[run]
dt = 1e-4
[collision]
second = "wall"
psi = 1.0
vn = 0.1
mass = 1.0
)" + shape +
         "\n" + more + "\n";
}

TEST_F(LoaderErrors, Collision_OfConvexBodies) {
  const std::string box = "shape = { box = [0.1, 0.06] }", angle = "orientation = 30";
  const std::vector<Bad> bads = {
      {convex(box, angle), ""},
      {convex(box, angle + "\nradius = 0.1"),
       "case.toml:16:10: collision.radius = 0.1: stands beside shape: give one of the two"},
      {convex(""), "case.toml:9:1: collision.radius is missing: or shape"},
      {convex("shape = { box = [0.1, 0.06], radius = 0.1 }", angle),
       "case.toml:14:39: collision.shape.radius = 0.1: is of the sides of a regular polygon; a box "
       "has none"},
      {convex("shape = { sides = 5 }", angle),
       "case.toml:14:19: collision.shape.sides = 5: needs radius, that of the corners"},
      {convex("shape = { polygon = [[0, 0], [1, 0], [2, 0], [0, 1]] }", angle),
       "case.toml:14:21: collision.shape.polygon: is straight at vertex 1, which is no corner: "
       "leave it out"},
      {convex("shape = { polygon = [[0, 0], [0.1, 0], [0, 0.1]], rounding = 0.5 }",
              "orientation = 20"),
       ""},
      {convex("shape = { polygon = [[0, 0], [1, 0], [0.4, 0.4], [0, 1]] }", angle),
       "case.toml:14:21: collision.shape.polygon: "},
      {convex("shape = { polygon = [[0, 0], [0, 1], [1, 0]] }", angle),
       "case.toml:14:21: collision.shape.polygon: "},
      {convex("shape = { polygon = [[0, 0], [1, 0], [1, 0], [0, 1]] }", angle),
       "case.toml:14:21: collision.shape.polygon: "},
      {convex(box, "orientation = [30, 90]"),
       "case.toml:15:15: collision.orientation: at orientation 90 a face or an edge meets flat: no "
       "single corner is the nearest"},
      {convex(box),
       "case.toml:14:9: [collision.shape]: at orientation 0 a face or an edge meets flat"},
      {convex(box, "orientation = 89.95"),
       "case.toml:15:15: collision.orientation = 89.95: at orientation 89.95 a second corner may"},
      {convex(box, angle + "\napproach = \"spin\""),
       "case.toml:16:12: collision.approach = \"spin\": is of disks and spheres"},
      {convex(box, angle + "\nsecond_radius = 1"),
       "case.toml:16:17: collision.second_radius = 1: is of second = \"disk\""},
      {convex(box, angle + "\nsecond_shape = { box = [1, 1] }"),
       "case.toml:16:16: [collision.second_shape]: is of second = \"body\""},
      {convex(box, angle + "\noffset = 0.1"),
       "case.toml:16:10: collision.offset = 0.1: is along a second body's face"},
      {convex(box, angle + "\nquaternion = [1, 0, 0, 0]"),
       "case.toml:16:14: collision.quaternion: is of space alone"},
      {withLine(convex(box, angle), 10, "second = \"disk\""),
       "case.toml:9:1: collision.second_radius is missing"},
      {withLine(convex(box, angle + "\noffset = 0.04"), 10, "second = \"body\""),
       "case.toml:16:10: collision.offset = 0.04: the corner misses the second body's face"},
      {withLine(convex(box, angle + "\nsecond_shape = { sides = 5, radius = 0.1 }"), 10,
                "second = \"body\""),
       "case.toml:16:16: [collision.second_shape]: this body has no flat face towards n"},
      {withLine(convex("radius = 0.1", angle), 10, "second = \"wall\""),
       "case.toml:15:15: collision.orientation = 30: is of convex bodies, which have a shape"},
      {withLine(convex(box, angle), 5, "e_n = 0.5\ne_t0 = 0.2"),
       "case.toml:15:9: [collision.shape]: takes law.e_t0 = 0"},
  };
  for (const Bad& bad : bads) {
    std::ofstream("case.toml") << bad.text;
    const std::string message = messageOf("case.toml");
    EXPECT_EQ(message.substr(0, bad.message.size()), bad.message) << bad.text;
    EXPECT_EQ(message.empty(), bad.message.empty()) << message;
  }
}

TEST_F(LoaderErrors, Assembly_Walls_Density_Stability) {
  expectMessages({
      {assembly(12, "mass = 1.0\n[[assembly.walls]]\nbox = [0, 0, 0, 1]"),
       "case.toml:14:7: assembly.walls[0].box: must be [left, bottom, right, top] in m"},
      {assembly(12, "mass = 1.0\n[[assembly.walls]]\nbox = [0, 1, 1, 1]"),
       "case.toml:14:7: assembly.walls[0].box: must be [left, bottom, right, top] in m"},
      {assembly(12,
                "mass = 1.0\n[[assembly.walls]]\npoint = [0, 0]\nnormal = [0, 1]\n"
                "omega = 1.0\nvelocity = [1, 0]"),
       "case.toml:16:9: assembly.walls[0].omega = 1.0: stands beside velocity: a wall moves in one "
       "way"},
      {assembly(12, "density = 1e308"),
       "case.toml:12:11: assembly.disks[0].density = 1e+308: makes disks of radius 0.5 m weigh inf "
       "kg"},
      {assembly(12, "mass = 1.0\ngrid = { columns = 2, rows = 2, spacing = [1, 2, 3] }"),
       "case.toml:13:43: assembly.disks[0].grid.spacing: must be one number or [columns, rows] in "
       "diameters"},
      {soundAssembly + "[stability]\ntests = \"a\"\nmeasure = \"energy_gain\"\nlimit = 0.1\n"
                       "degraded = 0.05\nwhy = \"b\"\n",
       "case.toml:17:12: stability.degraded = 0.05: must be >= limit = 0.1"},
  });
}

TEST_F(LoaderErrors, MoreThanACaseMayHave_IsRefusedBeforeMemoryIsTaken) {
  const std::string grid = "grid = { columns = 1000, rows = 600 }";
  expectMessages({
      {withLine(line(18, "small = 600000"), 19, "large = 600000"),
       "case.toml:18:9: particles.small = 600000: with large = 600000 that is more than 1000000 "
       "disks"},
      {line(14, "wall_spacing = 1e-7"),
       "case.toml:14:16: cell.wall_spacing = 1e-07: makes 6.6e+06 wall disks: a case may have at "
       "most 1000000"},
      {assembly(12, "mass = 1.0\ngrid = { columns = 100000, rows = 100000 }\n"),
       "case.toml:13:20: assembly.disks[0].grid.columns = 100000: times 100000 rows are 1e+10 "
       "disks: a case may have at most 1000000"},
      {assembly(12, "mass = 1.0\n" + grid +
                        "\n[[assembly.disks]]\nposition = [0, 0]\nradius = 1\nmass = 1\n" + grid),
       "case.toml:9:1: assembly.disks: these are more than the 1000000 disks that a case may have"},
      {collision(9,
                 "psi = { from = 0.0, to = 4.0, count = 10000 }\ncounter_spin = [0, 1, 2, 3, 4, "
                 "5, 6, 7, 8, 9, 10]"),
       "case.toml:9:7: [collision.psi]: with all vn and counter_spin 110000 collisions: at most "
       "100000"},
      {plus("[averaging]\nsnapshots_per_rotation = 1000000\nrotations = 11\n"),
       "case.toml:26:13: averaging.rotations = 11: with 1000000 snapshots_per_rotation: more than "
       "10000000 snapshots"},
      {line(16, "omega = 1e-12"),
       "case.toml:16:9: cell.omega = 1e-12: preparation, settling and averaging would take "
       "4.69e+17 steps: at most 1e+12"},
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

TEST_F(LoaderErrors, Files_ThatAreMissingOrNoFiles) {
  write("cases/quick.toml", soundCase);
  write("cases/notes.txt", "");
  EXPECT_EQ(messageOf("cases/quik.toml"),
            "cases/quik.toml: no such file (did you mean cases/quick.toml?)");
  EXPECT_EQ(messageOf("cases"), "cases: is a folder, not a file (there are: quick.toml)");
  ASSERT_EQ(::mkfifo("pipe.toml", 0600), 0);
  EXPECT_EQ(messageOf("pipe.toml"), "pipe.toml: is a named pipe, not a file");
  EXPECT_EQ(messageOf("/dev/null"), "/dev/null: is a device, not a file");
  for (const auto& [text, message] : std::vector<std::pair<std::string, std::string>>{
           {"[case]\nextends = \"cases/quik.toml\"\n",
            "a.toml:2:11: case.extends = \"cases/quik.toml\": no such file (looked for "
            "cases/quik.toml) (did you mean cases/quick.toml?)"},
           {"extends = \"none.toml\"\n",
            "a.toml:1:11: unknown key extends (did you mean case.extends?)"},
           {"[case]\nextends = 3\n", "a.toml:2:11: case.extends: must be the path of a case file"},
           {"[case]\nextends = \"\"\n",
            "a.toml:2:11: case.extends: must be the path of a case file"},
           // A copy of a shipped case names what it extends by its place among the program's own.
           {"[case]\nextends = \"nu-0.804.toml\"\n",
            "a.toml:2:11: case.extends = \"nu-0.804.toml\": no such file (looked for "
            "nu-0.804.toml) (did you mean cases/couette/nu-0.804.toml?)"}}) {
    write("a.toml", text);
    EXPECT_EQ(messageOf("a.toml"), message);
  }
  write("a b.toml", soundCase);
  EXPECT_EQ(messageOf("a b.toml"),
            "a b.toml:1:1: case.name is missing: the name of the file cannot stand in for it");
}

TEST_F(LoaderErrors, ShippedCase_IsFoundFromAnywhere_AfterWhatLiesBesideTheFile) {
  write("mine.toml", "[case]\nextends = \"cases/couette/nu-0.804.toml\"\n[law]\nmu = 0.3\n");
  EXPECT_EQ(loadCase("mine.toml").front().law.mu, 0.3);
  write("cases/couette/nu-0.804.toml", soundCase);
  EXPECT_EQ(couetteIn(loadCase("mine.toml").front()).particles.small, 210);
}

TEST_F(LoaderErrors, CyclesOfExtends) {
  write("a.toml", "[case]\nextends = \"sub/b.toml\"\n");
  write("sub/b.toml", "[case]\nextends = \"../c.toml\"\n");
  write("c.toml", "[case]\nextends = \"a.toml\"\n");
  EXPECT_EQ(
      messageOf("a.toml"),
      "a.toml: case.extends goes round in a circle: a.toml -> sub/b.toml -> c.toml -> a.toml");
}

TEST_F(LoaderErrors, Error_IsReportedWhereTheValueWasWritten) {
  write("law.toml", line(20, "small_radius = -1"));
  write("top.toml", "[case]\nextends = \"law.toml\"\n[law]\nkn = 300\n");
  EXPECT_EQ(messageOf("top.toml"), "law.toml:20:16: particles.small_radius = -1: must be > 0 m");
  write("top.toml", "[case]\nextends = \"law.toml\"\n[particles]\nsmall_radius = -2\n");
  EXPECT_EQ(messageOf("top.toml"), "top.toml:4:16: particles.small_radius = -2: must be > 0 m");
}

TEST_F(LoaderErrors, Syntax_AndFilesCutOffAnywhere_GiveOneLine) {
  for (const auto& [text, where] : std::vector<std::pair<std::string, std::string>>{
           {"[case\nkind = 3\n", "case.toml:1:"},
           {"[case]\nkind = \"couette\n", "case.toml:2:"},
           {"[case]\nkind = 1\nkind = 2\n", "case.toml:3:"},
           {"\x80\xff\n", "case.toml:1:"},
           {std::string("[case]\nkind\0", 12), "case.toml:2:"}}) {
    std::ofstream("case.toml", std::ios::binary) << text;
    const std::string message = messageOf("case.toml");
    EXPECT_TRUE(message.starts_with(where)) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
  const std::string whole = plus("[[variants]]\nname = \"a\"\nlaw.mu = 0.1\n");
  for (std::size_t length = 0; length < whole.size(); ++length) {
    std::ofstream("case.toml") << whole.substr(0, length);
    const std::string message = messageOf("case.toml");
    EXPECT_TRUE(message.empty() || message.starts_with("case.toml")) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST_F(LoaderErrors, Overrides_NameThemselves) {
  write("case.toml", soundCase);
  for (const auto& [text, message] : std::vector<std::pair<std::string, std::string>>{
           {"law.knn=3", "unknown key law.knn (did you mean kn?)"},
           {"law.kn=fast", "law.kn = \"fast\": must be a number, is a string"},
           {"law.kn=-3", "law.kn = -3: must be >= 0 N/m"},
           {"case.extends=x.toml", "unknown key case.extends (there are: name, kind, dimension)"},
           {"law.kn", "must be key.path=value"},
           {"=3", "must be key.path=value"},
           {"law.kn=", "must be key.path=value"}})
    EXPECT_EQ(messageOf("case.toml", {text}), "--set " + text + ": " + message);
  // A second line would be a second key: refused, and the message still is one line.
  EXPECT_EQ(messageOf("case.toml", {"law.kn=3\nlaw.gn=0"}),
            "--set law.kn=3 law.gn=0: must be key.path=value");
  EXPECT_TRUE(messageOf("case.toml", {"law.kn=\"a"}).starts_with("--set law.kn=\"a: "));
  const std::string endless = "preparation.seed=99999999999999999999999";
  const std::string message = messageOf("case.toml", {endless});
  EXPECT_TRUE(message.starts_with("--set " + endless)) << message;
  EXPECT_EQ(message.find("string"), std::string::npos) << message;
}

/// An override's error may show in another line of the file, which has no fault.
TEST_F(LoaderErrors, Overrides_AreBlamedForWhatTheyBreak) {
  write("case.toml", soundCase);
  const std::string missing = messageOf("case.toml", {"law.normal=hertz"});
  EXPECT_TRUE(missing.starts_with("--set law.normal=hertz: case.toml:3:1: law.young is missing"))
      << missing;
  const std::string of = messageOf("case.toml", {"law.mu=0.3", "cell.outer_radius=0.02"});
  EXPECT_TRUE(of.starts_with("--set cell.outer_radius=0.02: ")) << of;
  write("case.toml", line(20, "small_radius = -0.0037"));  // the file's own fault
  EXPECT_EQ(messageOf("case.toml", {"law.mu=0.3"}).find("case.toml:20:16:"), 0u);
}

TEST_F(LoaderErrors, Numbers_MinusZeroIsZero_WholeOnesAreRounded) {
  write("case.toml", line(5, "gn = -0.0"));
  EXPECT_FALSE(std::signbit(loadCase("case.toml").front().law.gn));
  for (const char* number : {"9007199254740993", "9223372036854775807"})
    EXPECT_EQ(loadCase("case.toml", {std::string("looks.budget=") + number}).front().looks.budget,
              std::strtod(number, nullptr));
}

TEST_F(LoaderErrors, FileOutsideTheCasesFolder_IsNotQuoted) {
  const std::string secret = "hunter2-s3cr3t";
  write("mine/top.toml", "[case]\nextends = \"../theirs/it.toml\"\n");
  for (const auto& [text, where] : std::vector<std::pair<std::string, std::string>>{
           {secret + "\n", "theirs/it.toml:1:"},
           {"password = \"" + secret, "theirs/it.toml:1:"},
           {secret + " = 1\n", "theirs/it.toml:1:1: a key that no case has"},
           {"[case]\nkind = \"" + secret + "\"\n", "theirs/it.toml:2:8: case.kind: unknown name"},
           {"[case]\nextends = \"" + secret + "\"\n", "theirs/it.toml:2:11: case.extends: no such"},
           {"[case]\nname = \"" + secret + " x\"\nkind = \"couette\"\n", ""},
           {withLine(soundCase, 4, "kn = \"" + secret + "\""), "theirs/it.toml:4:6: law.kn: must"},
           {soundCase + "[[variants]]\nname = \"" + secret + "/\"\n", "theirs/it.toml:25:8: "}}) {
    write("theirs/it.toml", text);
    const std::string message = messageOf("mine/top.toml");
    EXPECT_FALSE(message.empty());
    EXPECT_EQ(message.find(secret), std::string::npos) << message;
    EXPECT_NE(message.find(where), std::string::npos) << message << " | " << where;
  }
  write("mine/law.toml", "[case]\nkind = \"cuette\"\n");  // in the case's own folder
  write("mine/top.toml", "[case]\nextends = \"law.toml\"\n");
  EXPECT_EQ(messageOf("mine/top.toml"),
            "mine/law.toml:2:8: case.kind = \"cuette\": unknown name (did you mean couette?)");
}

}  // namespace
}  // namespace crossgrain::test
