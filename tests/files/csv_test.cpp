#include <gtest/gtest.h>

#include "tests/files/samples.hpp"

namespace {

using namespace crossgrain::files;
using namespace crossgrain::files::sampled;

using Csv = Sampled;

TEST_F(Csv, Times_RowsOfOneFollowOneAnother) {
  samples_.write(
      "particles.csv",
      "# of a run\nt, id, x, y, radius, spin\n0,5,1,2,0.5,0\n0,6,1.98,2,0.5,0\n1,5,1,2,0.5,3\n"
      "# later\n1,6,1.98,2,0.5,0\n");
  samples_.write("contacts.csv",
                 "t,first,second,normal_force,tx,ty\n0,5,6,20,0,-3\n0,-1,5,4,1,0\n");
  EXPECT_EQ(samples_.refusal("csv", {"particles.csv", "contacts.csv"}),
            "contacts.csv, t = 0: contact 2 (5 and -1): the direction of a contact with a wall is "
            "missing (nx, ny, nz)");
  samples_.write("contacts.csv",
                 "t,first,second,nx,ny,normal_force,tx,ty\n0,5,6,-1,0,20,0,-3\n0,-1,5,0,-1,4,1,"
                 "0\n1,5,6,-1,0,7,0,0\n");
  const auto frames = samples_.read("csv", {"particles.csv", "contacts.csv"});
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[1].time, 1.0);
  EXPECT_EQ(frames[1].particles.spin[0], Vec3(0, 0, 3));
  EXPECT_EQ(frames[0].particles.id, (std::vector<std::int64_t>{5, 6}));
  EXPECT_EQ(frames[0].contacts->force[0], Vec3(-20, -3, 0));
  // Listed as the force on the wall, below: on the particle it is the reverse.
  EXPECT_EQ(frames[0].contacts->first[1], 5);
  EXPECT_EQ(frames[0].contacts->second[1], -1);
  EXPECT_EQ(frames[0].contacts->normal[1], Vec3(0, 1, 0));
  EXPECT_EQ(frames[0].contacts->force[1], Vec3(-1, 4, 0));
  EXPECT_EQ(frames[1].contacts->force[0], Vec3(-7, 0, 0));
}

/// Extended XYZ: two times of a file, names of several programs.
TEST_F(Csv, ExtendedXyz_HasParticlesByItsProperties) {
  samples_.write("run.xyz",
                 "2\nLattice=\"4 0 0 0 3 0 0 0 2\" Origin=\"-1 0 0\" pbc=\"T F T\" "
                 "Properties=species:S:1:id:I:1:pos:R:3:velo:R:3:radius:R:1:mine:R:2:omega:R:3 "
                 "Time=0.5 Timestep=50\nAr 7 0.1 0.2 0.3 1 2 3 0.5 9 9 4 5 6\n"
                 "Ar 5 1.5 0.2 0.3 0 0 0 0.5 9 9 0 0 0\n"
                 "0\nProperties=species:S:1:pos:R:3 Time=1\n");
  const auto frames = samples_.read("xyz", {"run.xyz"});
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0].time, 0.5);
  EXPECT_EQ(frames[0].step, 50);
  const FileParticles& all = frames[0].particles;
  EXPECT_EQ(all.id, (std::vector<std::int64_t>{7, 5}));
  EXPECT_EQ(all.position[1], Vec3(1.5, 0.2, 0.3));
  EXPECT_EQ(all.velocity[0], Vec3(1, 2, 3));
  EXPECT_EQ(all.spin[0], Vec3(4, 5, 6));
  EXPECT_EQ(all.radius, (std::vector{0.5, 0.5}));
  ASSERT_TRUE(frames[0].box);
  EXPECT_EQ(frames[0].box->low, Vec3(-1, 0, 0));
  EXPECT_EQ(frames[0].box->high, Vec3(3, 3, 2));
  EXPECT_TRUE(frames[0].box->periodic[0] && frames[0].box->saidFixed[1]);
  EXPECT_EQ(frames[1].particles.size(), 0u);
  FileOptions options;
  options.columns = "mine=mass,-";
  EXPECT_EQ(samples_.read("xyz", {"run.xyz"}, options)[0].particles.mass, (std::vector{9.0, 9.0}));
  for (const auto& [text, message] :
       {std::pair{"2\nProperties=pos:R:3 Time=1\n1 2 3\n",
                  "run.xyz:3: the file ends where a particle"},
        {"1\nTime=1\n1 2 3\n", "run.xyz:2: Properties= is missing"},
        {"1\nProperties=pos:R Time=1\n1 2 3\n", "should be NAME:TYPE:COLUMNS"},
        {"1\nProperties=radius:R:1 Time=1\n1\n", "Properties has no pos:R:3"},
        {"1\nProperties=pos:R:3 Time=1\n1 2 x\n", "run.xyz:3: column 3: \"x\" should be"},
        {"1\nProperties=pos:R:3 Time=1 Lattice=\"1 1 0 0 1 0 0 0 1\" pbc=\"T T T\"\n1 2 3\n",
         "Lattice is tilted"}}) {
    samples_.write("run.xyz", text);
    const std::string said = samples_.refusal("xyz", {"run.xyz"});
    EXPECT_NE(said.find(message), std::string::npos) << said;
  }
}

/// The square of such a distance has no room in a double.
TEST_F(Csv, Normals_AreUnitVectorsOrRefused) {
  samples_.write("contacts.csv", "first,second,normal_force\n1,2,20\n");
  samples_.write("p.csv", "id,x,y,radius\n1,0,0,1\n2,-4e100,0,1\n");
  const FileFrame frame = samples_.read("csv", {"p.csv", "contacts.csv"}).front();
  EXPECT_EQ(frame.contacts->normal[0], Vec3(1, 0, 0));
  samples_.write("p.csv", "id,x,y,radius\n1,0,0,1\n2,-4e200,0,1\n");
  EXPECT_EQ(samples_.refusal("csv", {"p.csv", "contacts.csv"}),
            "contacts.csv: contact 1 (1 and 2): its centres are too far apart");
}

/// A start file is a time; ids are rows.
TEST_F(Csv, StartFile) {
  samples_.write("start.csv", "x,y,radius,vx,vy,spin,mass,inertia,fixed\n1,2,0.5,3,4,5,6,7,0\n");
  const FileFrame frame = samples_.read("csv", {"start.csv"}).front();
  EXPECT_EQ(frame.particles.id[0], 0);
  EXPECT_EQ(frame.particles.velocity[0], Vec3(3, 4, 0));
  EXPECT_EQ(frame.particles.mass[0], 6.0);
  // The time of a single file that gives none is unknown, whatever number its name has.
  EXPECT_FALSE(frame.step);
  EXPECT_TRUE(frame.alone);
  samples_.write("start2.csv", "x,y,radius\n1,2,0.5\n");
  EXPECT_EQ(samples_.read("csv", {"start2.csv"}).front().step, 2);
  EXPECT_TRUE(samples_.read("csv", {"start2.csv"}).front().alone);
}

/// Programs write X and Radius; T is a temperature, too.
TEST_F(Csv, Names_MayHaveCapitals) {
  samples_.write("p.csv", "ID,X,Y,Z,Radius,VX,Vy,vz\n5,1,2,3,0.5,4,5,6\n");
  const FileFrame frame = samples_.read("csv", {"p.csv"}).front();
  EXPECT_EQ(frame.particles.id[0], 5);
  EXPECT_EQ(frame.particles.position[0], Vec3(1, 2, 3));
  EXPECT_EQ(frame.particles.radius[0], 0.5);
  EXPECT_EQ(frame.particles.velocity[0], Vec3(4, 5, 6));
  samples_.write("p.csv", "x,y,T\n1,2,300\n");
  EXPECT_NE(samples_.refusal("csv", {"p.csv"}).find("T is none of the names"), std::string::npos);
}

/// A component that has no column is named: its numbers are 0 for the plane alone.
TEST_F(Csv, Components_ThatAreMissingAreNamed) {
  samples_.write("p.csv", "id,x,y,z,vx,vy,spin\n1,1,2,3,4,5,6\n2,1.9,2,3,4,5,6\n");
  samples_.write("contacts.csv", "first,second,fx,fy,torque_z\n1,2,3,4,5\n");
  const FileFrame frame = samples_.read("csv", {"p.csv", "contacts.csv"}).front();
  const auto named = [](const std::vector<MissingComponent>& missing) {
    std::string all;
    for (const MissingComponent& one : missing) all += one.column + (one.axial ? "* " : " ");
    return all;
  };
  EXPECT_EQ(named(frame.particles.missing), "vz spin_x* spin_y* ");
  EXPECT_EQ(named(frame.contacts->missing), "fz torque_x* torque_y* ");
}

/// Spreadsheets write semicolons and tabs, and a mark before the first line.
TEST_F(Csv, Separators_AreThoseOfTheNames) {
  const std::string same[] = {
      "\xEF\xBB\xBFid,x,y,radius\n5,1,2,0.5\n", "id ; x;y; radius\r\n5;1 ; 2;0.5\r\n",
      "id\tx\ty\tradius\n5\t1\t2\t0.5\n", "id,\tx,\ty, radius\n5,\t1,\t2,\t0.5\n"};
  for (const std::string& text : same) {
    const auto file = samples_.write("p.csv", text);
    EXPECT_EQ(formatOf(file), "csv") << text;
    const FileFrame frame = samples_.read("csv", {"p.csv"}).front();
    EXPECT_EQ(frame.particles.id, (std::vector<std::int64_t>{5})) << text;
    EXPECT_EQ(frame.particles.position[0], Vec3(1, 2, 0)) << text;
    EXPECT_EQ(frame.particles.radius[0], 0.5) << text;
  }
}

TEST_F(Csv, Names_OfOnesOwn) {
  samples_.write("p.csv", "nr,px,py,r\n1,1,2,0.5\n2,1.98,2,0.5\n");
  samples_.write("contacts.csv", "a,b,push,junk\n1,2,20,x\n");
  const FileFrame frame =
      samples_
          .read("csv", {"p.csv", "contacts.csv"},
                {"nr=id px=x py=y r=radius a=first b=second push=normal_force junk=-"})
          .front();
  EXPECT_EQ(frame.contacts->normalForce[0], 20.0);
  EXPECT_EQ(frame.particles.id[1], 2);
}

TEST_F(Csv, WhatCannotBe_IsRefusedByLine) {
  const auto refusal = [&](const std::string& text) {
    samples_.write("p.csv", text);
    return samples_.refusal("csv", {"p.csv"});
  };
  EXPECT_EQ(refusal("x,y,radus\n1,2,3\n"),
            "p.csv:1: radus is none of the names of columns (did you mean radius?); columns = "
            "radus=MEANING says what it is, radus=- leaves it out");
  EXPECT_NE(refusal("x,y,r\n1,2,3\n").find("(did you mean radius?)"), std::string::npos);
  EXPECT_EQ(refusal("x,y,radius\n1,,3\n"), "p.csv:2: column 2: \"\" should be a finite number");
  EXPECT_EQ(refusal("x,y,radius\n1,2\n"), "p.csv:2: 2 columns, there should be 3");
  EXPECT_EQ(refusal("x,y,radius\n1 2,3,4\n"), "p.csv:2: no ',' after column 1");
  EXPECT_EQ(refusal("x,y,radius\n1,2,3,4\n"), "p.csv:2: more than 3 columns");
  EXPECT_EQ(refusal("x,y,spin,spin_z\n1,2,3,4\n"),
            "p.csv:1: columns 3 and 4 are the same thing: only one of them can be read");
  EXPECT_EQ(refusal("x,y,id\n1,2,1.5\n"), "p.csv:2: id: 1.5 should be a whole number");
  EXPECT_EQ(refusal("t,x,y\n1,2,3\n0,2,3\n"),
            "p.csv, t = 0: comes after p.csv, t = 1: times of a run must rise; files of other runs "
            "should be in folders of their own");
  const char* const unclear =
      "p.csv:1: commas, or semicolons, or tabs should part the names of columns";
  EXPECT_EQ(refusal("x y radius\n1 2 3\n"), unclear);
  EXPECT_EQ(refusal("x;y,radius\n1;2,3\n"), unclear);
  EXPECT_EQ(refusal("x;y\n1,5;2\n"), "p.csv:2: column 1: \"1,5\" should be a finite number");
  EXPECT_EQ(refusal("x,y\n"), "p.csv:1: there are no rows below the column names");
}

}  // namespace
