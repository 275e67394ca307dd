// [average], [[endpoints]] and [assembly.start], and what is wrong with them in one line.
#include "cases/assembly_scene.hpp"
#include "files.hpp"

namespace crossgrain::test {
namespace {

using Average = InFolder;

const std::string scene =
    withLine(withLine(soundAssembly, 8, "duration = 3"), 12, "density = 2.0\njitter = 0.1");

const std::string slabs = R"([average]
bins = "slabs"
along = "y"
low = [0, 0]
high = [1, 4]
count = 4
from = 1
)";

std::string endpoint(const std::string& keys) {
  return "[[endpoints]]\nname = \"one\"\n" + keys + "\nwhy = \"a reason\"\n";
}

TEST_F(Average, AssemblyDisks_GridByDensity) {
  std::ofstream("case.toml") << withLine(
      soundAssembly, 12,
      "density = 4.0\njitter = 0.25\ngrid = { columns = 2, rows = 2, spacing = [2, 3] }");
  const Case c = loadCase("case.toml").front();
  EXPECT_EQ(assemblyIn<2>(c).contactTimes, 3.0);
  const DiskGroup group = assemblyIn<2>(c).disks.at(0);
  EXPECT_EQ(group.position, Vec2(0.0, 1.0));
  EXPECT_DOUBLE_EQ(group.mass, 4.0 * 3.14159265358979323846 * group.radius * group.radius);
  EXPECT_EQ(group.jitter, 0.25);
  EXPECT_EQ(group.places, (std::vector<Vec2>{{0, 0}, {2, 0}, {0, 3}, {2, 3}}));  // diameters
}

TEST_F(Average, Assembly_Slabs) {
  std::ofstream("case.toml") << scene + slabs +
                                    endpoint(
                                        "quantity = \"velocity_x\"\nat = \"slope\"\nabsolute = 2") +
                                    "[preparation]\npackings = 5\nseed = 7\n";
  const Case c = loadCase("case.toml").front();
  ASSERT_TRUE(c.region);
  EXPECT_EQ(c.region->rowCount(), 4);
  EXPECT_EQ(assemblyIn<2>(c).seed, 7u);
  EXPECT_EQ(c.preparation.seed, 7u);
  const Endpoint& one = c.endpoints.front();
  EXPECT_EQ(one.unit, "1/s");
  EXPECT_EQ(one.definition, "slope of velocity_x over the bins");
  EXPECT_FALSE(one.byRatio);
  EXPECT_EQ(c.averaging.endpoints.at("one").value, 2.0);
}

TEST_F(Average, Definition_OfRatios) {
  const auto definition = [](const std::string& keys) {
    std::ofstream("case.toml") << scene + slabs + endpoint(keys + "\nabsolute = 2") +
                                      "[preparation]\npackings = 5\nseed = 7\n";
    return loadCase("case.toml").front().endpoints.front().definition;
  };
  const std::string stresses = "quantity = \"stress_xy\"\nper = \"stress_yy\"\n";
  EXPECT_EQ(definition(stresses),
            "ratio of the means of stress_xy and stress_yy over the averaged part");
  EXPECT_EQ(definition(stresses + "at = \"slope\""),
            "ratio of the slopes of stress_xy and stress_yy over the bins");
  EXPECT_EQ(definition(stresses + "at = 2"), "ratio of stress_xy and stress_yy in bin 2");
  EXPECT_EQ(definition("quantity = \"top\"\nper = \"mean_y\"\nat = \"rate\""),
            "ratio of the rates of change of top and mean_y over the averaged time");
  EXPECT_EQ(definition("quantity = \"spin\""), "mean of spin over the averaged part");
}

TEST_F(Average, BadInput_NamesTheKey) {
  const auto with = [](const std::string& keys) { return scene + slabs + endpoint(keys); };
  expectMessage(with("quantity = \"stress_rr\"\nabsolute = 1"), "did you mean stress_");
  expectMessage(with("quantity = \"spin\"\nat = 5\nabsolute = 1"), "endpoints[0].at = 5");
  expectMessage(with("quantity = \"disks\"\nat = 1\nabsolute = 1"), "only a field has bins");
  expectMessage(with("quantity = \"disks\"\nper = \"top\"\nabsolute = 1"), "top");
  expectMessage(with("quantity = \"spin\"\nper = \"disks\"\nabsolute = 1"), "must be a field");
  expectMessage(with("quantity = \"spin\""), "a margin has one of them");
  expectMessage(
      with("quantity = \"spin\"\nabsolute = 1") + endpoint("quantity = \"spin\"\nabsolute = 1"),
      "two endpoints have this name");
  expectMessage(scene + slabs + "snapshots = 1000000\n",
                "average.snapshots = 1000000: 1000000 snapshots would be 2e-06 s apart, less than");
  expectMessage(scene + withLine(slabs, 7, "from = 2.9999"),
                "average.from = 2.9999: 100 snapshots");
  expectMessage(scene + "[looks]\ncount = 2\n", "is of no use without [average]");
  expectMessage(scene + withLine(slabs, 7, "from = 3"), "average.from = 3: must be < 3 s");
  expectMessage(withLine(scene, 13, "") + slabs, "no packing would differ from another");
  // Whoever has files makes none.
  std::ofstream("case.toml") << withLine(scene, 13, "") + slabs;
  EXPECT_EQ(loadCase("case.toml", {}, {}, Starts::notMade).size(), 1u);
  expectMessage(scene + slabs + "columns = 3\n",
                "average.columns = 3: has no meaning with bins = \"slabs\"");
  expectMessage(scene + withLine(slabs, 3, ""), "average.along is missing");
  expectMessage(scene + withLine(slabs, 5, "high = [0, 4]"), "must lie above and to the right");
}

TEST_F(Average, ClosedForms) {
  const std::string still = withLine(scene, 13, "");  // nothing is random
  const auto with = [&](const std::string& keys, const std::string& rest = "") {
    return still + slabs + endpoint(keys) + rest;
  };
  const std::string apex = "quantity = \"y\"\ndisk = 0\nat = \"maximum\"\nbetween = [1.5, 2]\n";
  std::ofstream("case.toml") << with(apex + "expected = -4\nrelative = 0.1");
  const Case c = loadCase("case.toml").front();
  const Endpoint& one = c.endpoints.front();
  EXPECT_EQ(one.expected, -4.0);
  EXPECT_EQ(one.disk, 0);
  EXPECT_EQ(one.reduction, Reduction::maximum);
  EXPECT_FALSE(one.byRatio);
  EXPECT_NEAR(c.averaging.endpoints.at("one").value, 0.4, 1e-15);  // of |−4|
  EXPECT_EQ(one.unit, "m");
  std::ofstream("case.toml") << with(
      "quantity = \"spin\"\ndisk = 0\nreaches = -3\nexpected = 1\nabsolute = 1");
  EXPECT_EQ(loadCase("case.toml").front().endpoints.front().unit, "s");

  expectMessage(with(apex + "expected = 0\nrelative = 0.1"), "give absolute");
  expectMessage(scene + slabs + endpoint(apex + "expected = 1\nabsolute = 1"),
                "endpoints[0].expected = 1: is of one start");
  expectMessage(with(apex + "absolute = 1"), "no packing would differ from another");
  expectMessage(with(apex + "expected = 1\nabsolute = 1", "[preparation]\npackings = 5\n"),
                "preparation.packings = 5");
  expectMessage(with(apex + "expected = 1\nabsolute = 1",
                     "[[endpoints]]\nname = \"two\"\nquantity = \"spin\"\nabsolute = 1\nwhy = "
                     "\"a reason\"\n"),
                "endpoints[1].expected is missing");
  expectMessage(with("quantity = \"y\"\ndisk = 99\nabsolute = 1"), "endpoints[0].disk = 99");
  expectMessage(with("quantity = \"top\"\ndisk = 0\nabsolute = 1"), "x, y, velocity_x");
  expectMessage(with("quantity = \"y\"\ndisk = 0\nat = \"end\"\ntime = 2\nabsolute = 1"),
                "give one of the two");
  expectMessage(with("quantity = \"y\"\ndisk = 0\ntime = 9\nexpected = 1\nabsolute = 1"),
                "endpoints[0].time = 9: snapshots are from 1.02 to 3 s");
  expectMessage(with("quantity = \"spin\"\nreaches = 2\nabsolute = 1"), "not of a field");
  expectMessage(with("quantity = \"disks\"\nbetween = [2, 1]\nabsolute = 1"),
                "must be [from, to] in s");
}

TEST_F(Average, StartFiles_AreAllReadFirst_WithLines) {
  const std::string start = scene.substr(0, scene.find("[[")) +
                            "[assembly.start]\nfile = [\"one.csv\", \"two.csv\"]\ndensity = 2\n";
  write("one.csv", "x,y,radius\n0,1,0.5\n2,1,0.5\n");
  write("two.csv", "# made by hand\nx,y,radius,fixed\n0,1,0.5,0\n\n4,1,0.5,0\n0,1,0.5,0\n");
  expectMessage(start, "two.csv:6: disk 0 (line 3) and disk 2 (line 6) have the same centre");
  write("two.csv", "x,y,radius\n0,1,0.5\n0.1,1,0.5\n");
  expectMessage(start, "two.csv:3: disk 0 (line 2) and disk 1 (line 3) overlap by 0.9 m");
  EXPECT_EQ(messageOf("case.toml").find("mm"), std::string::npos);  // near, but no thousandth
  write("two.csv", "x,y,radius\n0,0.0037,3.7\n0.0074,0.0037,3.7\n");
  expectMessage(start, "are radii in mm?");
}

TEST_F(Average, StartFile_Csv) {
  write("start.csv", "# made by hand\nx, y,radius,vy,fixed\n+0.0,+1,0.5,-2,0\r\n\n3,0,0.25,0,1\n");
  const std::string start =
      scene.substr(0, scene.find("[[")) + "[assembly.start]\nfile = \"start.csv\"\ndensity = 2\n";
  std::ofstream("case.toml") << start;
  const Case c = loadCase("case.toml").front();
  const Disks& disks = assemblyIn<2>(c).starts.disks.at(0);
  ASSERT_EQ(disks.size(), 1u);
  EXPECT_EQ(disks.velocity[0].y(), -2.0);
  EXPECT_NEAR(disks.mass[0], 2.0 * 3.14159265358979 * 0.25, 1e-12);
  EXPECT_EQ(assemblyIn<2>(c).walls.back().radii, std::vector<double>{0.25});
  test::expectSays(c.resolvedToml, {std::filesystem::absolute("start.csv").string()});
  for (const auto& [text, message] :
       {std::pair{"x,y,radius\n0,1,0.5\n0,1\n", "start.csv:3: has 2 values for 3 columns"},
        {"x,y,radius\n0,1,-1\n", "start.csv:2: radius = -1: must be > 0"},
        {"x,y,radius\n0,one,1\n", "start.csv:2: y = one: must be a number"},
        {"x,y,radius\n0,+-1,1\n", "start.csv:2: y = +-1: must be a number"},
        {"x,y,radus\n0,1,1\n", "start.csv:1: \"radus\" is no column (did you mean radius?)"},
        {"x,y\n0,1\n", "start.csv:1: there is no column radius"},
        {"", "start.csv: has no line of column names"},
        {"x,y,radius,fixed\n0,1,1,2\n", "start.csv:2: fixed = 2: must be 0 or 1"}}) {
    write("start.csv", text);
    expectMessage(start, message);
  }
  write("start.csv", "\xEF\xBB\xBFx,y,radius\n0,1,1\n");  // as spreadsheets save it
  EXPECT_EQ(messageOfText(start), "");
  write("start.csv", "x,y,radius\n0,1,1\n");
  expectMessage(start.substr(0, start.find("density")), "has no masses");
  expectMessage(start.substr(0, start.find("file")), "assembly.start.file is missing");
  const auto of = [&](const std::string& files) {
    return start.substr(0, start.find("file")) + "file = " + files + "\ndensity = 2\n";
  };
  expectMessage(of("[]"), "assembly.start.file: must name one file or more");
  write("other.csv", "radius,x,y\n1.0,0,1\n");
  expectMessage(of("[\"start.csv\", \"other.csv\"]"),
                "other.csv: its disks are those of start.csv: each file must be another start");
  write("other.csv", "x,y,radius\n0,1.5,1\n");
  EXPECT_EQ(messageOfText(of("[\"start.csv\", \"other.csv\"]")), "");
  expectMessage(start + scene.substr(scene.find("[[")), "come from one of the two");
}

/// Two species in one file, as restart files have them; where a row says nothing, the case does.
TEST_F(Average, StartFile_MaterialOfARow) {
  const std::string start =
      scene.substr(0, scene.find("[[")) +
      "[[law.pairs]]\nbetween = [\"ball\", \"steel\"]\nkn = 110.0\n[[law.pairs]]\nbetween = "
      "[\"ball\", \"ball\"]\nkn = 120.0\n[assembly.start]\nfile = \"start.csv\"\ndensity = "
      "2\nmaterial = \"ball\"\n";
  write("start.csv",
        "x,y,radius,material,fixed\n0,1,0.5,ball,0\n2,1,0.5, \"steel\",0\n4,1,0.5,,0\n"
        "6,1,0.5,steel,1\n");
  std::ofstream("case.toml") << start;
  const Case c = loadCase("case.toml").front();
  const Scene made = assemblyScene<2>(c, assemblyDisks<2>(c, 0), 0.0, 1e-3);
  ASSERT_TRUE(made.materials);
  const std::vector<std::string>& names = made.materials->names;
  const auto nameOf = [&](std::int32_t k) { return names[static_cast<std::size_t>(k)]; };
  ASSERT_EQ(made.materials->ofDisk.size(), 3u);
  EXPECT_EQ(nameOf(made.materials->ofDisk[0]), "ball");
  EXPECT_EQ(nameOf(made.materials->ofDisk[1]), "steel");
  EXPECT_EQ(nameOf(made.materials->ofDisk[2]), "ball");
  EXPECT_EQ(nameOf(made.materials->ofBody.back()), "steel");
  EXPECT_EQ(made.lawOf(0, 1).kn, 110.0);
  EXPECT_EQ(made.lawOf(0, 2).kn, 120.0);
  for (const auto& [text, message] :
       {std::pair{"x,y,radius,material\n0,1,0.5,ball\n2,1,0.5,brass\n",
                  "start.csv:3: material = \"brass\": no [[law.pairs]] has that material"},
        {"x,y,radius,material,fixed\n0,1,1,ball,0\n3,1,1,ball,1\n6,1,1,steel,1\n",
         "start.csv:4: material = steel: disks that stand still are one body, of ball"}}) {
    write("start.csv", text);
    expectMessage(start, message);
  }
  write("start.csv", "x,y,radius,material\n0,1,0.5,steel\n2,1,0.5,ball\n");
  EXPECT_EQ(messageOfText(start.substr(0, start.find("material"))), "");  // each row says its own
  write("other.csv", "x,y,radius,material\n0,1.5,0.5,ball\n2,1,0.5,steel\n");
  std::string two = start;
  two.replace(two.find("\"start.csv\""), 11, "[\"start.csv\", \"other.csv\"]");
  expectMessage(two, "other.csv: the materials of its disks are not those of");
  expectMessage(
      start.substr(0, start.find("[[law.pairs]]")) + start.substr(start.find("[assembly.start]")),
      "the case has no [[law.pairs]]");
}

/// A start whose rows name shapes is the scene of groups that have them, to the bit.
template <int D>
void expectSameStart(const std::string& rows, const std::string& groups) {
  const auto sceneOf = [](const std::string& text) {
    std::ofstream("case.toml") << text;
    const Case c = loadCase("case.toml").front();
    return assemblyScene<D>(c, assemblyDisks<D>(c, 0), 0.0, 1e-3);
  };
  const SceneOf<D> made = sceneOf(rows), target = sceneOf(groups);
  EXPECT_EQ(made.shapes, target.shapes);
  EXPECT_EQ(made.disks.shape, target.disks.shape);
  EXPECT_EQ(made.disks.position, target.disks.position);
  EXPECT_EQ(made.disks.velocity, target.disks.velocity);
  EXPECT_EQ(made.disks.radius, target.disks.radius);
  EXPECT_EQ(made.disks.mass, target.disks.mass);
  EXPECT_EQ(made.disks.inertia, target.disks.inertia);
  EXPECT_EQ(made.disks.moments, target.disks.moments);
  EXPECT_EQ(made.disks.turn, target.disks.turn);
}

TEST_F(Average, StartFile_ShapeOfARow) {
  const std::string head = scene.substr(0, scene.find("[["));
  const std::string file = "[assembly.start]\nfile = \"start.csv\"\ndensity = 2\n";
  const std::string start =
      head + file +
      "shapes = { a = { polygon = [[0, 0], [1, 0], [0, 2]] }, b = { box = [2, 1] } }\n";
  write("start.csv",
        "x,y,radius,shape,angle,vx,mass\n0,1,,a,30,1,2\n8,1,,b,,0,3\n4,1,0.5,,,-1,1\n");
  expectSameStart<2>(
      start, head +
                 "[[assembly.disks]]\nposition = [0, 1]\nmass = 2\nvelocity = [1, 0]\nangle = "
                 "30\nshape = { polygon = [[0, 0], [1, 0], [0, 2]] }\n"
                 "[[assembly.disks]]\nposition = [8, 1]\nmass = 3\nshape = { box = [2, 1] }\n"
                 "[[assembly.disks]]\nposition = [4, 1]\nmass = 1\nvelocity = [-1, 0]\nradius = "
                 "0.5\n");
  const auto boxOf = [&](const std::string& mass) {
    return head + "[[assembly.disks]]\nposition = [8, 1]\nshape = { box = [2, 1] }\n" + mass;
  };
  expectSameStart<2>(boxOf("density = 2\ninertia = 0.3\n"), boxOf("mass = 4\ninertia = 0.3\n"));
  for (const auto& [text, message] :
       {std::pair{"x,y,shape\n0,1,a\n3,1,d\n",
                  "start.csv:3: shape = d: is no shape of [assembly.start]"},
        {"x,y,shape,radius\n0,1,a,1\n",
         "start.csv:2: shape = a: stands beside a radius: give one of the two"},
        {"x,y,shape,radius\n0,1,,\n", "start.csv:2: has neither a radius nor a shape"},
        {"x,y,angle\n0,1,3\n", "start.csv:1: there is no column radius"},
        {"x,y,radius,angle\n0,1,1,3\n",
         "start.csv:1: angle is of convex bodies: there is no column shape"},
        {"x,y,radius,shape,angle\n0,1,1,,3\n",
         "start.csv:2: angle = 3: is of convex bodies, which have a shape"},
        {"x,y,shape,fixed\n0,1,a,1\n", "start.csv:2: shape = a: what stands still is disks"},
        {"x,y,shape,mass,inertia\n0,1,b,1,9\n",
         "start.csv:2: inertia = 9: is more than a body of 1 kg that reaches 1.11803 m can "
         "have"}}) {
    write("start.csv", text);
    expectMessage(start, message);
  }
  write("start.csv", "x,y,shape\n0,1,a\n");
  expectMessage(start, "[assembly.start.shapes]: no row names b");
  expectMessage(head + file, "start.csv:2: shape = a: [assembly.start] has no shapes");
  std::string unweighed = start;
  unweighed.erase(unweighed.find("density"), 12);
  expectMessage(unweighed, "start.csv:2: has no mass, and [assembly.start] no density");
}

TEST_F(Average, StartFile_ShapeOfARowInSpace) {
  const std::string head =
      "[case]\nkind = \"assembly\"\ndimension = 3\n[law]\nkn = 100\ngn = "
      "0\ntangential = \"none\"\n[assembly]\ncontact_times = 3\n";
  const std::string wedge = "{ polyhedron = [[0, 0, 0], [1, 0, 0], [0, 2, 0], [0, 0, 3]] }";
  const std::string start = head +
                            "[assembly.start]\nfile = \"start.csv\"\ndensity = 2\nshapes = "
                            "{ wedge = " +
                            wedge + " }\n";
  write("start.csv",
        "x,y,z,radius,shape,qw,qx,qy,qz,spin_x\n0,1,2,,wedge,0.6,0,0,0.8,5\n9,1,2,0.5,,,,,,0\n");
  expectSameStart<3>(start, head +
                                "[[assembly.disks]]\nposition = [0, 1, 2]\ndensity = 2\nspin = "
                                "[5, 0, 0]\nquaternion = [0.6, 0, 0, 0.8]\nshape = " +
                                wedge +
                                "\n[[assembly.disks]]\nposition = [9, 1, 2]\ndensity = 2\nradius = "
                                "0.5\n");
  for (const auto& [text, message] :
       {std::pair{"x,y,z,shape,qw,qx,qy,qz\n0,1,2,wedge,1,0,0,1\n",
                  "start.csv:2: qw, qx, qy, qz: must be of length 1, not 1.41421"},
        {"x,y,z,shape,qw,qx,qy,qz\n0,1,2,wedge,1,0,,0\n",
         "start.csv:2: qy = nothing: quaternions are qw, qx, qy, qz"},
        {"x,y,z,shape,qw,qx,qz\n0,1,2,wedge,1,0,0\n",
         "start.csv:1: there is no column qy: quaternions are qw, qx, qy, qz"},
        {"x,y,z,shape,inertia\n0,1,2,wedge,1\n",
         "start.csv:2: inertia = 1: a convex body in space has that of its density"}}) {
    write("start.csv", text);
    expectMessage(start, message);
  }
}

}  // namespace
}  // namespace crossgrain::test
