// Assemblies in space and periodic boxes, and what is wrong with them in one line.
#include "files.hpp"

namespace crossgrain::test {
namespace {

using Space = InFolder;

const std::string spheres = R"([case]
kind = "assembly"
dimension = 3
[law]
kn = 100.0
gn = 0.0
tangential = "none"
[assembly]
contact_times = 3
gravity = [0, 0, -1]
[assembly.box]
low = [0, 0, 0]
high = [5, 6, 1]
periodic = ["x", "y"]
[[assembly.disks]]
position = [0.5, 0.5, 1.0]
radius = 0.5
density = 3.0
grid = { columns = 4, rows = 3, layers = 2, triangular = true }
choose = 20
velocity_rms = 0.1
spin = [1, 2, 3]
[[assembly.walls]]
position = [0, 0, -0.5]
radius = 0.5
grid = { columns = 5, rows = 6 }
velocity = [-1, 0, 0]
)";
constexpr int highLine = 13, periodicLine = 14, positionLine = 16, gridLine = 19, chooseLine = 20;

const std::string slabsAlongZ = R"([average]
bins = "slabs"
along = "z"
low = [0, 0, 0]
high = [5, 6, 4]
count = 4
from = 0.1
snapshots = 10
)";

TEST_F(Space, Assembly_IsRead) {
  std::ofstream("case.toml") << spheres + slabsAlongZ;
  const Case c = loadCase("case.toml").front();
  const AssemblyOf<3>& assembly = assemblyIn<3>(c);
  EXPECT_EQ(assembly.gravity, Vec3(0.0, 0.0, -1.0));
  EXPECT_EQ(assembly.inertiaFactor, 0.4);
  ASSERT_TRUE(assembly.box);
  EXPECT_EQ(assembly.box->periodic, (std::array<bool, 3>{true, true, false}));
  const DiskGroupOf<3>& group = assembly.disks.at(0);
  EXPECT_NEAR(group.mass, 3.0 * 3.14159265358979323846 / 6.0, 1e-15);
  EXPECT_EQ(group.places.size(), 24u);
  EXPECT_EQ(group.count(), 20u);
  EXPECT_EQ(group.spin, Vec3(1.0, 2.0, 3.0));
  EXPECT_EQ(assembly.walls.at(0).position.size(), 30u);
  EXPECT_EQ(assembly.walls[0].position[6], Vec3(1.0, 1.0, -0.5));
  EXPECT_EQ(assembly.walls[0].motion.velocity, Vec3(-1.0, 0.0, 0.0));
  const Region& region = *c.region;
  EXPECT_EQ(region.axis, 2);
  EXPECT_EQ(region.binCount(), 4);
  EXPECT_EQ(region.high, Vec3(5.0, 6.0, 4.0));
}

TEST_F(Space, GridAlongOtherAxes) {
  std::ofstream("case.toml") << withLine(
      spheres, gridLine, "grid = { columns = 2, rows = 5, layers = 2, axes = \"xzy\" }");
  const auto places = assemblyIn<3>(loadCase("case.toml").front()).disks.at(0).places;
  ASSERT_EQ(places.size(), 20u);
  EXPECT_EQ(places[2], Vec3(0.0, 0.0, 1.0));   // rows along z
  EXPECT_EQ(places[10], Vec3(0.0, 1.0, 0.0));  // layers along y
}

TEST_F(Space, Cylinder_IsReadAndTurnsItsBody) {
  std::ofstream("case.toml") << withLine(spheres, periodicLine, "periodic = [\"y\"]") +
                                    R"([[assembly.walls]]
cylinder = { point = [1, 2, 3], axis = [0, -2, 0], radius = 40, omega = 5 }
position = [1, 2, 30]
radius = 0.5
[[assembly.walls]]
cylinder = { axis = [0, 1, 0], radius = 50 }
)";
  const auto walls = assemblyIn<3>(loadCase("case.toml").front()).walls;
  ASSERT_EQ(walls.size(), 3u);
  ASSERT_EQ(walls[1].cylinders.size(), 1u);
  EXPECT_EQ(walls[1].cylinders[0].point, Vec3(1.0, 2.0, 3.0));
  EXPECT_EQ(walls[1].cylinders[0].axis, Vec3(0.0, -1.0, 0.0));
  EXPECT_EQ(walls[1].cylinders[0].radius, 40.0);
  EXPECT_EQ(walls[1].position.size(), 1u);  // it turns with the cylinder
  EXPECT_EQ(walls[1].centre, Vec3(1.0, 2.0, 3.0));
  EXPECT_EQ(walls[1].motion.kind, MotionKind::rotating);
  EXPECT_EQ(walls[1].motion.angularVelocity, Vec3(0.0, -5.0, 0.0));
  EXPECT_EQ(walls[2].motion.kind, MotionKind::fixed);
}

TEST_F(Space, Cylinder_Refusals) {
  const auto with = [](const std::string& table, const char* more = "") {
    return spheres + "[[assembly.walls]]\ncylinder = { " + table + " }\n" + more;
  };
  expectMessage(with("axis = [0, 1, 0]"), "assembly.walls[1].cylinder.radius");
  expectMessage(with("axis = [0, 1, 0], radius = 0"), "radius = 0: must be > 0");
  expectMessage(with("axis = [0, 0, 0], radius = 9"), "axis: must not be zero");
  expectMessage(with("axis = [0, 1e-200, 0], radius = 9"), "or of a length below 1e-100");
  expectMessage(with("axis = 'z', radius = 9"), "must be [x, y, z]");
  expectMessage(with("axis = [0, 1, 0], radius = 0.4"), "m, must fit in");
  expectMessage(
      with("axis = [0, 1, 0], radius = 9", "velocity = [0, 1, 0]\n"),
      "velocity: is not of a wall with a cylinder, which stands still or turns about its");
  expectMessage(with("axis = [0, 1, 0.1], radius = 9"),
                "assembly.walls[1] has a cylinder that is not along x: what is periodic has no");
  expectMessage(with("axis = [1, 0, 0], radius = 9"), "a cylinder that is not along y");
  expectMessage(soundAssembly + "[[assembly.walls]]\ncylinder = { axis = [0, 1], radius = 9 }\n",
                "is of space alone, and case.dimension = 2");
}

TEST_F(Space, Circles_AreFilledFromTheInnerToTheOuter) {
  const auto places = [](const std::string& table) {
    std::ofstream("case.toml") << withLine(
        withLine(spheres, gridLine, "circles = { " + table + " }"), chooseLine, "");
    return assemblyIn<3>(loadCase("case.toml").front()).disks.at(0).places;
  };
  // 1 in the middle, 6 at one diameter, 12 at two: their chords 2 r sin(π/n) are 1 and 1.04.
  const auto disk = places("outer = 2, layers = 2, rise = 1.5");
  ASSERT_EQ(disk.size(), 2u * 19u);
  EXPECT_EQ(disk[0], Vec3(0.0, 0.0, 0.0));
  EXPECT_EQ(disk[19], Vec3(0.0, 0.0, 1.5));
  for (std::size_t i = 0; i < disk.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_GT((disk[i] - disk[j]).norm(), 1.0 - 1e-12);
  EXPECT_EQ(places("inner = 2, outer = 2.9").size(), 12u);
  // The first lies along x of the circles; that is z where they are about y, y about x.
  EXPECT_EQ(places("inner = 2, outer = 2, axis = \"y\"")[0], Vec3(0.0, 0.0, 2.0));
  EXPECT_EQ(places("inner = 2, outer = 2, axis = \"x\"")[0], Vec3(0.0, 2.0, 0.0));
  expectMessage(withLine(spheres, gridLine, "circles = { inner = 3, outer = 2 }"),
                "outer = 2: must be at least inner, 3 diameters");
  expectMessage(withLine(spheres, gridLine, "circles = { outer = 1e6 }"),
                "a case may have at most");
  expectMessage(withLine(soundAssembly, 12, "mass = 1\ncircles = { outer = 2 }"),
                "is of space alone, and case.dimension = 2");
}

TEST_F(Space, Box_Refusals) {
  // Spheres reach 1 m: the box has to be wider than 2 m.
  expectMessage(
      withLine(spheres, highLine, "high = [5, 2, 1]"),
      "assembly.box.high: the box is 2 m wide along y, and must be wider than two reaches "
      "of its largest pair, 2 m");
  expectMessage(withLine(spheres, highLine, "high = [5, 0, 1]"), "must lie beyond low in all of");
  expectMessage(withLine(spheres, highLine, "high = [5, 6]"), "must be [x, y, z] in m");
  expectMessage(withLine(spheres, periodicLine, "periodic = []"), "must name a direction");
  expectMessage(withLine(spheres, periodicLine, "periodic = [\"w\"]"), "unknown name");
  expectMessage(spheres + "[[assembly.walls]]\npoint = [0, 0, 0]\nnormal = [1, 0, 1]\n",
                "assembly.box.periodic: assembly.walls[1] has a plane across x");
  expectMessage(
      withLine(spheres, gridLine, "grid = { columns = 1, rows = 1 }\nradius_spread = 0.8") +
          slabsAlongZ,
      "choose = 20: must be at most 1, the places there");
}

TEST_F(Space, OtherDimensionsKeys_Refused) {
  for (const char* const key : {"mirror = true", "rotate = 90", "offset = [1, 0]"})
    expectMessage(withLine(spheres, 9, std::string("contact_times = 3\n") + key),
                  "is of the plane alone, and case.dimension = 3");
  expectMessage(withLine(spheres, gridLine, "stack = { count = 3 }"), "is of the plane alone");
  expectMessage(spheres + "omega = 1\n", "is of the plane alone");
  expectMessage(withLine(spheres, positionLine, "position = [0, 1]"), "must be [x, y, z] in m");
  expectMessage(
      withLine(soundAssembly, 12, "mass = 1\ngrid = { columns = 1, rows = 1, layers = 2 }"),
      "is of space alone, and case.dimension = 2");
  expectMessage(spheres + "[bottom]\nmu = 0.1\n", "is of the plane alone, and case.dimension = 3");
  expectMessage(withLine(soundCase, 2, "kind = \"couette\"\ndimension = 3"),
                "a couette cell is of the plane");
}

TEST_F(Space, Average_Refusals) {
  const auto with = [](int number, const char* text) {
    return spheres + withLine(slabsAlongZ, number, text);
  };
  expectMessage(with(4, "low = [0, 0]"), "average.low: must be [x, y, z] in m");
  expectMessage(with(5, "high = [5, 7, 4]"),
                "average.high: the averaged part must lie in assembly.box along y, from 0 to 6 m");
  expectMessage(with(7, "from = 0.1\nheight = 1"), "spheres have none");
  expectMessage(with(7, "from = 0.1\nlayers = 2"), "has no meaning with bins = \"slabs\"");
  expectMessage(withLine(soundAssembly, 8, "duration = 3") +
                    withLine(withLine(slabsAlongZ, 4, "low = [0, 0]"), 5, "high = [5, 6]"),
                "average.along = \"z\": must be \"x\" or \"y\"");
  const std::string rings =
      "[average]\nbins = \"rings\"\ninner_radius = 0\nouter_radius = 2\n"
      "count = 2\nfrom = 0.1\nsnapshots = 10\n";
  expectMessage(spheres + rings, "average.bottom is missing");
  expectMessage(spheres + rings + "bottom = 0\ntop = 1\n",
                "rings are of scenes that are not periodic");
}

TEST_F(Space, SizesThatNoNumberHolds_AreRefused) {
  const auto with = [](const std::string& from, const std::string& to) {
    std::string text = spheres + slabsAlongZ;
    return text.replace(text.find(from), from.size(), to);
  };
  expectMessage(with("contact_times = 3", "duration = 1e300"), "steps: at most 1e+12");
  // Contacts of such a law are short, and the run is counted in them.
  expectMessage(with("kn = 100.0", "kn = 1e300"), "average.from = 0.1: must be <");
  expectMessage(with("contact_times = 3", "contact_times = 1e12"), "steps: at most 1e+12");
  expectMessage(
      with("low = [0, 0, 0]\nhigh = [5, 6, 1]", "low = [-1e308, 0, 0]\nhigh = [1e308, 6, 1]"),
      "assembly.box.high: is so far from low that no number holds it");
  expectMessage(with("high = [5, 6, 4]", "high = [5, 6, 1e-12]"),
                "average.high: a bin would be 2.5e-13 m wide along z: at least 0.0001 m");
}

TEST_F(Space, WallStress_IsOfTwoWalls_AndAForceOfOne) {
  const std::string alone = spheres + slabsAlongZ;
  const auto endpoint = [](const std::string& what) {
    return "[[endpoints]]\nname = \"w\"\nabsolute = 1\nwhy = \"x\"\n" + what;
  };
  const std::string plane = "[[assembly.walls]]\nbox = [0, 0, 0, 5, 6, 9]\n",
                    stress = "quantity = \"wall_normal_stress\"";
  expectMessage(alone + endpoint(stress), "is of a box that is periodic in all directions but one");
  std::string closed = alone;
  closed.erase(closed.find("[assembly.box]"),
               closed.find("[[assembly.disks]]") - closed.find("[assembly.box]"));
  closed.insert(closed.find("[average]"), plane);
  expectMessage(closed + endpoint(stress),
                "is of a box that is periodic in all directions but one");
  const std::string normal = "quantity = \"normal_force\"\nwall = 1\n";
  expectMessage(closed + endpoint(normal), "endpoints[0].plane is missing");
  expectMessage(closed + endpoint(normal + "plane = 6"), "assembly.walls[1] has 6 planes");
  expectMessage(closed + endpoint("quantity = \"force_x\"\nwall = 2"), "there are 2 walls");
  expectMessage(closed + endpoint("quantity = \"mean_z\"\narea = 2.0"), "is of one wall");
  std::ofstream("case.toml") << closed + endpoint(normal + "plane = 2\narea = 30.0");
  const Endpoint own = loadCase("case.toml").front().endpoints.at(0);
  EXPECT_EQ(own.unit, "N/m²");
  EXPECT_EQ(own.series(), "wall_1_plane_2_normal_force");
}

/// One glass sphere of 1 mm on a plane at 1 m/s: T = 2.9432 δ/v, δ = (15 m v²/(16 E* √R))^(2/5)
/// with E* = 50 GPa/(2 (1 − 0.22²)), m = 1.309 mg, R = 0.5 mm (Johnson 1985).
TEST_F(Space, HertzWithoutStep_SaysHowLongTheFastestImpactOfTheStartLasts) {
  expectMessage(R"([case]
kind = "assembly"
dimension = 3
[law]
normal = "hertz"
young = 50e9
poisson = 0.22
gn = 0.0
tangential = "none"
[assembly]
duration = 1e-4
[[assembly.disks]]
position = [0.0, 0.0, 0.00051]
velocity = [0.0, 0.0, -1.0]
radius = 0.0005
density = 2500
[[assembly.walls]]
point = [0.0, 0.0, 0.0]
normal = [0.0, 0.0, 1.0]
)",
                "3.95e-06 s at 1 m/s, the fastest at the start; a fiftieth of it is 7.9e-08 s");
}

TEST_F(Space, Start_IsReadWithItsThirdColumns) {
  const std::string start =
      withLine(spheres.substr(0, spheres.find("[[assembly.disks]]")), 9,
               "contact_times = 3\nstart = { file = \"s.csv\", density = 3 }");
  write("s.csv", "x,y,z,radius,vz,spin_x,spin_z,fixed\n1,2,3,0.5,4,5,6,0\n1,2,4,0.25,0,0,0,1\n");
  std::ofstream("case.toml") << start;
  const Case c = loadCase("case.toml").front();
  const DisksOf<3>& disks = assemblyIn<3>(c).starts.disks.at(0);
  ASSERT_EQ(disks.size(), 1u);
  EXPECT_EQ(disks.position[0], Vec3(1.0, 2.0, 3.0));
  EXPECT_EQ(disks.velocity[0], Vec3(0.0, 0.0, 4.0));
  EXPECT_EQ(disks.spin[0], Vec3(5.0, 0.0, 6.0));
  EXPECT_NEAR(disks.mass[0], 0.5 * 3.14159265358979323846, 1e-15);
  EXPECT_EQ(assemblyIn<3>(c).walls.back().position.at(0), Vec3(1.0, 2.0, 4.0));
  write("s.csv", "x,y,radius\n1,2,0.5\n");
  expectMessage(start, "s.csv:1: there is no column z");
  write("s.csv", "x,y,z,radius,spin\n1,2,3,0.5,1\n");
  expectMessage(start, "\"spin\" is no column");
}

}  // namespace
}  // namespace crossgrain::test
