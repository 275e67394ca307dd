// Result files of other programs of one scene of spheres, each format with the same numbers, which
// are worked out here by hand.
//
// Three spheres of radius 0.5 m in a cell of 4 m × 3 m, periodic along x and y. At t = 1 s the
// first, at (0.2, 1, 2), and the second, at (3.3, 1, 2), overlap by 0.1 m over the border in x; the
// third, at (2, 2, 0.48), is 0.02 m deep in the floor. A wall sphere that began at (3.2, 1, 2.9)
// and moves at 1 m/s along x is at (4.2, 1, 2.9) by then, 0.1 m deep in the first from above.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <fmt/format.h>

#include <fstream>
#include <map>

#include "adapters/files/write_snapshots.hpp"
#include "averaging/statistics.hpp"
#include "studies/flow/average.hpp"
#include "studies/flow/file_runs.hpp"
#include "studies/flow/snapshot_sources.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/temporary_folder.hpp"

namespace crossgrain {
namespace {

namespace fs = std::filesystem;

Case threeSpheres() {
  Case setup{.dimension = 3, .source = AssemblyOf<3>(), .file = "three.toml"};
  setup.law.normal = NormalLaw::linear;
  setup.law.kn = 1000.0;
  setup.law.kt = 300.0;
  setup.law.mu = 0.5;
  AssemblyOf<3>& assembly = assemblyIn<3>(setup);
  DiskGroupOf<3> group{.radius = 0.5, .mass = 2.0};
  group.places = {{0.2, 1.0, 2.0}, {3.3, 1.0, 2.0}, {2.0, 2.0, 0.48}};  // in diameters
  assembly.disks = {group};
  assembly.walls.resize(2);
  assembly.walls[0].planes = {{Vec3::Zero(), Vec3::UnitZ()}};
  assembly.walls[1].position = {{3.2, 1.0, 2.9}};
  assembly.walls[1].radius = 0.5;
  assembly.walls[1].motion.kind = MotionKind::translating;
  assembly.walls[1].motion.velocity = Vec3::UnitX();
  assembly.box = BoxOf<3>{Vec3::Zero(), {4.0, 3.0, 4.0}, {true, true, false}};
  assembly.duration = 2.0;
  setup.run.dt = 1e-3;
  Region& region = setup.region.emplace();
  region.bins = BinKind::whole;
  region.high = {4.0, 3.0, 4.0};
  region.snapshots = 1;
  return setup;
}

/// A run's files by their names.
using Texts = std::map<std::string, std::string>;

struct Sample {
  std::string format;
  Texts texts;
  Settings settings = {};
};

std::string dumpHead(const std::string& what, int count) {
  return "ITEM: TIME\n1\nITEM: TIMESTEP\n1000\nITEM: NUMBER OF " + what + "\n" +
         std::to_string(count) + "\nITEM: BOX BOUNDS pp pp ff\n0 4\n0 3\n0 4\n";
}

/// Atoms by ids 11, 12, 13 and the wall's 5; paths are whole: the second has gone out to the left.
Sample ofLammps() {
  return {"lammps",
          {{"a.dump", dumpHead("ATOMS", 4) +
                          "ITEM: ATOMS id x y z radius mass vx vy vz omegax omegay omegaz "
                          "f_f[1] f_f[2] f_f[3] f_f[4] f_f[5] f_f[6] f_f[7] f_f[8]\n"
                          "13 2 2 0.48 0.5 2 0 0 0 0 0 0 1 0 0 20 2 2 0 0.5\n"
                          "11 0.2 1 2 0.5 2 0.1 0.2 0.3 1 2 3 0 0 0 0 0 0 0 0\n"
                          "5 4.2 1 2.9 0.5 0 1 0 0 0 0 0 0 0 0 0 0 0 0 0\n"
                          "12 -0.7 1 2 0.5 2 0 0 0 0 0 0 0 0 0 0 0 0 0 0\n"},
           {"a.local", dumpHead("ENTRIES", 2) +
                           "ITEM: ENTRIES c_p[1] c_p[2] c_q[1] c_q[2] c_q[3] c_q[4]\n"
                           "12 11 100 0 -5 0\n"
                           "5 11 100 -6 0 0\n"}}};
}

/// Wrapped, with pair/gran/local and wall/gran/local of a mesh.
Sample ofLiggghts() {
  return {"lammps",
          {{"a.dump", dumpHead("ATOMS", 4) +
                          "ITEM: ATOMS id x y z radius mass vx vy vz omegax omegay omegaz\n"
                          "13 2 2 0.48 0.5 2 0 0 0 0 0 0\n11 0.2 1 2 0.5 2 0.1 0.2 0.3 1 2 3\n"
                          "5 0.2 1 2.9 0.5 0 1 0 0 0 0 0\n12 3.3 1 2 0.5 2 0 0 0 0 0 0\n"},
           {"a-pairs.dump", dumpHead("ENTRIES", 2) +
                                "ITEM: ENTRIES c_c[1] c_c[2] c_c[3] c_c[4] c_c[5] c_c[6] c_c[7] "
                                "c_c[8] c_c[9] c_c[10] c_c[11] c_c[12]\n"
                                "0.2 1 2 -0.7 1 2 11 12 1 100 5 0\n"
                                "0.2 1 2 0.2 1 2.9 11 5 0 6 0 -100\n"},
           {"a-walls.dump", dumpHead("ENTRIES", 1) +
                                "ITEM: ENTRIES c_w[1] c_w[2] c_w[3] c_w[4] c_w[5] c_w[6] c_w[7] "
                                "c_w[8] c_w[9] c_w[10] c_w[11] c_w[12]\n"
                                "2 2 0 2 2 0.48 0 0 13 0 0 20\n"}},
          {{"columns", std::string("c_c=pair/gran/local,pos,id,force "
                                   "c_w=wall/gran/local,pos,id,force")}}};
}

/// The wall's sphere is fixed: its contact has one line. The pair over the border is with two
/// ghosts, rows 4 and 5. The box of .data is not the periodic one.
Sample ofMercuryDpm() {
  return {"mercurydpm",
          {{"a.data",
            "4 1 -0.5 -0.5 0 5 4 5\n0.2 1 2 0.1 0.2 0.3 0.5 0 0 0 1 2 3 0\n"
            "3.3 1 2 0 0 0 0.5 0 0 0 0 0 0 0\n2 2 0.48 0 0 0 0.5 0 0 0 0 0 0 0\n"
            "0.2 1 2.9 1 0 0 0.5 0 0 0 0 0 0 0\n"},
           {"a.fstat",
            "# 1 1\n# -0.5 -0.5 0 5 4 5\n# 0.5 0.5 0 0 0 0\n"
            "1 0 4 -0.25 1 2 0.1 0 100 5 1 0 0 0 1 0\n1 1 5 3.75 1 2 0.1 0 100 5 -1 0 0 0 -1 0\n"
            "1 0 3 0.2 1 2.45 0.1 0 100 6 0 0 -1 1 0 0\n1 2 -1 2 2 0 0.02 0 20 0 0 0 -1 0 0 0\n"}}};
}

/// Without normals, which are those of nearest images then.
Sample ofCsv() {
  return {"csv",
          {{"a.csv",
            "t,id,x,y,z,radius,mass,vx,vy,vz,spin_x,spin_y,spin_z\n"
            "1,13,2,2,0.48,0.5,2,0,0,0,0,0,0\n1,11,0.2,1,2,0.5,2,0.1,0.2,0.3,1,2,3\n"
            "1,5,0.2,1,2.9,0.5,0,1,0,0,0,0,0\n1,12,3.3,1,2,0.5,2,0,0,0,0,0,0\n"},
           {"a-contacts.csv",
            "t,first,second,fx,fy,fz,branch_x,branch_y,branch_z\n"
            "1,11,12,100,5,0,0.9,0,0\n1,5,11,-6,0,100,0,0,0.9\n1,13,-1,0,0,20,0,0,1\n"}}};
}

/// YADE's export.VTKExporter: n from id1 to id2, F on id2. The floor is no sphere, body 1.
Sample ofVtk() {
  const std::string head = "# vtk DataFile Version 3.0.\ncomment\nASCII\n\nDATASET POLYDATA\n";
  const auto scalars = [](const std::string& name, const std::string& values) {
    return "SCALARS " + name + " double 1\nLOOKUP_TABLE default\n" + values + "\n\n";
  };
  return {"vtk",
          {{"a-spheres-00001000.vtk",
            head + "POINTS 4 double\n0.2 1 2\n3.3 1 2\n2 2 0.48\n0.2 1 2.9\n\nPOINT_DATA 4\n" +
                scalars("radius", "0.5\n0.5\n0.5\n0.5") + scalars("id", "11\n12\n13\n5") +
                scalars("mass", "2\n2\n2\n0") +
                "VECTORS vel double\n0.1 0.2 0.3\n0 0 0\n0 0 0\n1 0 0\n\n"
                "VECTORS spin double\n1 2 3\n0 0 0\n0 0 0\n0 0 0\n\n"},
           {"a-intrs-00001000.vtk",
            head +
                "POINTS 6 double\n3.3 1 2\n4.2 1 2\n0.2 1 2.9\n0.2 1 2\n2 2 0\n2 2 0.48\n"
                "LINES 3 9\n2 0 1\n2 2 3\n2 4 5\n\nCELL_DATA 3\n\n" +
                scalars("id1", "12\n5\n1") + scalars("id2", "11\n11\n13") +
                "VECTORS n double\n1 0 0\n0 0 -1\n0 0 1\n\n"
                "VECTORS F double\n100 5 0\n6 0 -100\n0 0 20\n\n" +
                scalars("overlap", "0.1\n0.1\n0.02")}},
          {{"dt", 1e-3}, {"contacts_behind", 0.0}}};
}

class SpaceFiles : public testing::Test {
 protected:
  std::vector<fs::path> write(const Texts& texts) {
    std::vector<fs::path> files;
    for (const auto& [name, text] : texts) {
      files.push_back(folder_.path() / name);
      std::ofstream(files.back()) << text;
    }
    return files;
  }
  std::unique_ptr<SnapshotSourceOf<3>> open(const Texts& texts) {
    const auto runs = snapshotRuns(write(texts));
    EXPECT_EQ(runs.size(), 1u);
    return openSnapshots<3>(runs.front(), setup_, "mine");
  }
  std::string refusal(const Texts& texts) {
    return test::refusalOf([&] {
      const auto source = open(texts);
      while (source->next()) continue;
    });
  }

  TemporaryFolder folder_;
  Case setup_ = threeSpheres();
};

void expectNear(const Vec3& found, const Vec3& wanted, double within = 1e-12) {
  EXPECT_LE((found - wanted).norm(), within) << found.transpose() << " and " << wanted.transpose();
}

/// Requires the snapshot that every format has.
void expectTheSnapshot(SnapshotSourceOf<3>& source) {
  EXPECT_EQ(source.scene().disks.mass, (std::vector<double>{2.0, 2.0, 2.0}));
  EXPECT_NEAR(source.scene().disks.inertia[0], 0.4 * 2.0 * 0.25, 1e-15);
  const SpaceSnapshot now = source.next().value();
  EXPECT_FALSE(source.next());
  EXPECT_EQ(now.positionTime, 1.0);
  expectNear(now.position[0], {0.2, 1.0, 2.0});
  expectNear(now.velocity[0], {0.1, 0.2, 0.3});
  expectNear(now.spin->at(0), {1.0, 2.0, 3.0});
  // Walls are where they are prescribed to be, whatever image the files have.
  expectNear(now.wallPosition[0], {4.2, 1.0, 2.9});
  const ContactsOf<3>& contacts = now.contacts.value();
  EXPECT_EQ(contacts.i, (std::vector<std::int32_t>{0, 0, 2}));
  EXPECT_EQ(contacts.j, (std::vector<std::int32_t>{1, 3, 4}));
  expectNear(contacts.normal[0], Vec3::UnitX());
  expectNear(contacts.normal[1], -Vec3::UnitZ());
  expectNear(contacts.normal[2], Vec3::UnitZ());
  for (const auto& [c, overlap, force, tangential] :
       {std::tuple(0, 0.1, 100.0, Vec3(0.0, 5.0, 0.0)),
        {1, 0.1, 100.0, Vec3(6.0, 0.0, 0.0)},
        {2, 0.02, 20.0, Vec3(0.0, 0.0, 0.0)}}) {
    const auto k = static_cast<std::size_t>(c);
    EXPECT_NEAR(contacts.overlap[k], overlap, 1e-12);
    EXPECT_NEAR(contacts.normalForce[k], force, 1e-12);
    expectNear(contacts.tangentialForce[k], tangential);
  }
  // On the wall where it touches, at (4.2, 1, 2.45), 3.2 m along x from its body's centre.
  expectNear(now.bodies[1].force.value(), {-6.0, 0.0, 100.0});
  expectNear(now.bodies[1].torque.value(), Vec3(3.2, 1.0, 2.45).cross(Vec3(-6.0, 0.0, 100.0)));
  expectNear(now.bodies[0].force.value(), {0.0, 0.0, -20.0});
}

TEST_F(SpaceFiles, EveryFormat_HasTheSameSnapshot) {
  for (const Sample& sample : {ofLammps(), ofLiggghts(), ofMercuryDpm(), ofVtk(), ofCsv()}) {
    SCOPED_TRACE(sample.texts.begin()->first + " of " + sample.format);
    setup_.engines["mine"] = sample.settings;
    expectTheSnapshot(*open(sample.texts));
  }
}

/// And so have those that are written here; ON-DEM's of blocks is YADE's otherwise.
TEST_F(SpaceFiles, WrittenFiles_HaveTheSameSnapshot) {
  for (const char* const format : {"lammps", "ondem"}) {
    SCOPED_TRACE(format);
    const auto source = open(ofCsv().texts);
    const auto writer = files::openWriter(format, folder_.path() / "written", source->scene(),
                                          source->scene().box.value());
    writer->write(source->next().value());
    writer->close();
    setup_.engines["mine"] = {{"contacts_behind", 0.0}};
    const auto runs =
        snapshotRuns(files::writtenFiles(format, folder_.path() / "written", 1), format);
    expectTheSnapshot(*openSnapshots<3>(runs.at(0), setup_, "mine"));
  }
}

/// Positions alone, and velocities: no contacts, so no stress.
TEST_F(SpaceFiles, YadeText_HasSpheresAlone) {
  setup_.engines["mine"] = {{"dt", 1e-3}};
  const auto source = open({{"a.1000.txt",
                             "#format x_y_z_r_attrs\n# x y z r id vx vy vz\n"
                             "2 2 0.48 0.5 13 0 0 0\n0.2 1 2 0.5 11 0.1 0.2 0.3\n"
                             "3.3 1 2 0.5 12 0 0 0\n0.2 1 2.9 0.5 5 1 0 0\n"}});
  const SpaceSnapshot now = source->next().value();
  EXPECT_EQ(now.positionTime, 1.0);
  expectNear(now.position[2], {2.0, 2.0, 0.48});
  expectNear(now.velocity[0], {0.1, 0.2, 0.3});
  EXPECT_FALSE(now.contacts || now.spin);
}

TEST_F(SpaceFiles, Average_HasTheShortBranchOverTheBorder) {
  for (const Sample& sample : {ofLammps(), ofCsv()}) {
    const CompareResults results = averageSnapshots(setup_, write(sample.texts), "test");
    const auto stress = [&](const char* field) {
      const Profile* found = profileOf(results.runs.at(0).profiles, field);
      return found ? found->mean[0].value_or(NAN) : NAN;
    };
    // Of 48 m³: 100 N · 0.9 m along x, and the wall's 6 N on a branch along z.
    EXPECT_NEAR(stress("stress_xx"), 90.0 / 48.0, 1e-12);
    EXPECT_NEAR(stress("stress_yx"), 5.0 * 0.9 / 48.0, 1e-12);
    EXPECT_NEAR(stress("stress_xy"), 0.0, 1e-12);
  }
}

/// Dumps that Debian's programs wrote of tests/files/samples/lammps.in and liggghts.in: a pair over
/// the edge x = 4 with 1000 N/m · 0.01 m on a branch of 0.99 m, in 64 m³; and a sphere 0.02 m deep
/// in a floor, whose contact LIGGGHTS' dump does not have. Numbers have six digits.
TEST_F(SpaceFiles, DumpsOfBothPrograms_HaveTheStressOverTheBorder) {
  AssemblyOf<3>& assembly = assemblyIn<3>(setup_);
  assembly.disks[0].mass = 1.0;
  assembly.disks[0].places = {{0.4, 2.0, 2.0}, {3.41, 2.0, 2.0}, {2.0, 2.0, 0.48}};
  assembly.walls.resize(1);
  for (Vec3* high : {&assembly.box->high, &setup_.region->high}) *high = {4.0, 4.0, 4.0};
  struct Program {
    const char* name;
    Settings settings;
    double floor;
  };
  for (const Program& program :
       {Program{"lammps", {}, 20.0 * 0.48 / 64.0},
        {"liggghts",
         {{"dt", 1e-3},
          {"columns", std::string("c_c=pair/gran/local,pos,id,force,force_normal,force_tangential,"
                                  "torque,history,delta,contactPoint")}},
         0.0}}) {
    SCOPED_TRACE(program.name);
    setup_.engines["lammps-files"] = program.settings;
    const std::string name = fmt::format("{}/files/samples/{}.0.", CROSSGRAIN_TESTS, program.name);
    const CompareResults results =
        averageSnapshots(setup_, {name + "dump", name + "local"}, "test");
    const std::vector<Profile>& profiles = results.runs.at(0).profiles;
    EXPECT_NEAR(profileOf(profiles, "stress_xx")->mean[0].value(), 10.0 * 0.99 / 64.0, 1e-5);
    EXPECT_NEAR(profileOf(profiles, "stress_zz")->mean[0].value(), program.floor, 1e-5);
  }
}

/// Half a metre in 500 steps at 1 m/s, over the border; by a time step of a tenth it is ten times
/// as far as velocities say.
TEST_F(SpaceFiles, WaysOverTheBorder_AreThoseOfTheVelocities) {
  const Texts texts = {{"a.csv",
                        "step,id,x,y,z,radius,vx,vy,vz\n"
                        "1000,1,3.8,0.5,2,0.5,1,0,0\n1000,2,0.6,1.5,2,0.5,1,0,0\n"
                        "1000,3,1.9,2.5,2,0.5,1,0,0\n1500,1,0.3,0.5,2,0.5,1,0,0\n"
                        "1500,2,1.1,1.5,2,0.5,1,0,0\n1500,3,2.4,2.5,2,0.5,1,0,0\n"}};
  setup_.engines["mine"] = {{"dt", 1e-3}};
  EXPECT_EQ(refusal(texts), "");
  EXPECT_TRUE(open(texts)->next());
  setup_.engines["mine"] = {{"dt", 1e-4}};
  const std::string said = refusal(texts);
  EXPECT_NE(said.find("3 spheres that move have gone 10 times as far"), std::string::npos) << said;
}

/// Dashpots that may pull do so as two part: one such contact is no sign of wrong signs, twenty
/// are.
TEST_F(SpaceFiles, ForcesThatAttract_AreRefusedWhereDashpotsDoNotExplainThem) {
  setup_.law.gn = 10.0;
  AssemblyOf<3>& assembly = assemblyIn<3>(setup_);
  assembly.walls.clear();
  assembly.box.reset();
  const auto chain = [&](int spheres, double force) {
    Texts texts = {{"a.csv", "t,id,x,y,z,radius,vx,vy,vz\n"},
                   {"a-contacts.csv", "t,first,second,normal_force,tx,ty,tz\n"}};
    assembly.disks[0].places.assign(static_cast<std::size_t>(spheres), Vec3::Zero());
    for (int k = 0; k < spheres; ++k) {
      assembly.disks[0].places[static_cast<std::size_t>(k)].x() = 0.99 * k;
      texts["a.csv"] += fmt::format("1,{},{},1,2,0.5,0,0,0\n", k, 0.99 * k);
      if (k > 0) texts["a-contacts.csv"] += fmt::format("1,{},{},{},0,0,0\n", k - 1, k, force);
    }
    return refusal(texts);
  };
  EXPECT_EQ(chain(2, -1.0), "");
  EXPECT_EQ(chain(21, 1.0), "");
  EXPECT_NE(chain(21, -1.0).find("normal forces attract, -20 N over 20 contacts"),
            std::string::npos);
  setup_.law.conventions.tension = Tension::cut;
  EXPECT_NE(chain(2, -1.0).find("normal forces attract"), std::string::npos);
}

/// A component that no column has is not 0: places, velocities and forces are refused, spins
/// absent.
TEST_F(SpaceFiles, MissingComponents_AreRefusedOrAbsent) {
  const auto refused = [&](const char* names, const char* rows) {
    return refusal({{"a.csv", fmt::format("t,id,{}\n{}", names, rows)}});
  };
  const char* const full = "x,y,z,radius,vx,vy,vz";
  EXPECT_EQ(refused(full, "1,1,0.2,1,2,0.5,0,0,-1\n1,2,2,1,2,0.5,0,0,-1\n1,3,2,2,2,0.5,0,0,-1\n"),
            "");
  for (const auto& [names, column] : {std::pair("x,y,z,radius,vx,vy,spin_z", "no column vz"),
                                      {"x,y,spin_z,radius,vx,vy,vz", "no column z"}}) {
    const std::string said =
        refused(names, "1,1,0.2,1,2,0.5,0,0,-1\n1,2,2,1,2,0.5,0,0,-1\n1,3,2,2,2,0.5,0,0,-1\n");
    test::expectSays(said, {column, "a case in space takes all three components"});
  }
  Texts texts = ofCsv().texts;
  std::string& contacts = texts.at("a-contacts.csv");
  contacts.replace(contacts.find(",fz"), 3, ",kind");
  const std::string said = refusal(texts);
  EXPECT_NE(said.find("its contacts have no column fz"), std::string::npos) << said;
}

TEST_F(SpaceFiles, WhatDoesNotFit_IsRefusedInOneLine) {
  const auto changed = [](Sample sample, const char* file, const std::string& from,
                          const std::string& to) {
    std::string& text = sample.texts.at(file);
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
      text.replace(at, from.size(), to);
    return sample.texts;
  };
  const auto expect = [&](const Texts& texts, const std::vector<const char*>& words) {
    const std::string said = refusal(texts);
    for (const char* const word : words) EXPECT_NE(said.find(word), std::string::npos) << said;
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
  };
  expect(changed(ofLammps(), "a.dump", "0 4\n0 3", "0 4.5\n0 3"),
         {"a.dump, step 1000", "periodic along x over 4.5 m, the case's over 4 m"});
  expect(changed(ofLammps(), "a.dump", "pp pp ff", "pp pp pp"),
         {"particle 13 reaches over the periodic edge at z = 0", "no periodic edge there"});
  expect(changed(ofLammps(), "a.dump", "13 2 2 0.48", "13 2 2 -0.48"),
         {"no plane of the case touches sphere 2"});
  expect(changed(ofLammps(), "a.dump", "5 4.2 1", "5 4.3 1"), {"4 disks, not 3"});
  expect(changed(ofLammps(), "a.local", "12 11 100", "12 13 100"), {"contact 12–13"});
  expect(changed(ofCsv(), "a-contacts.csv", "1,11,12,100,5,0,0.9,0,0\n", ""),
         {"no contact of sphere 0 with sphere 1, which overlap by 0.1 m"});
  expect(changed(ofCsv(), "a-contacts.csv", "0.9,0,0", "-0.9,0,0"), {"its normal points from"});
  setup_.engines["mine"]["plane"] = std::string("xz");
  expect(ofCsv().texts, {"[engines.mine]", "there is no setting 'plane'"});
}

}  // namespace
}  // namespace crossgrain
