/// Dumps of LAMMPS and LIGGGHTS. samples/lammps.in and liggghts.in are the scripts that Debian's
/// programs ran: 2 at x = 3.41 and 1 at 0.4 touch over the edge at 4 with k_n δ = 1000 · 0.01 N, 3
/// lies 0.02 deep on a floor.
#include <gtest/gtest.h>
#include <zlib.h>

#include <fstream>
#include <iterator>

#include "tests/files/samples.hpp"

namespace {

using namespace crossgrain::files;
using namespace crossgrain::files::sampled;
namespace fs = std::filesystem;

/// Of what is printed with six digits.
constexpr double sixDigits = 1e-5;

const std::vector<std::string> lammpsFiles{"lammps.0.dump",  "lammps.2.dump",  "lammps.4.dump",
                                           "lammps.0.local", "lammps.2.local", "lammps.4.local"};
const std::vector<std::string> liggghtsFiles{"liggghts.0.dump",  "liggghts.2.dump",
                                             "liggghts.4.dump",  "liggghts.0.local",
                                             "liggghts.2.local", "liggghts.4.local"};
constexpr const char* liggghtsColumns =
    "c_c=pair/gran/"
    "local,pos,id,force,force_normal,force_tangential,torque,history,delta,contactPoint";

TEST(Lammps, OwnDump_PairOverTheEdgeAndWall) {
  const auto frames = programs().read("lammps", lammpsFiles);
  ASSERT_EQ(frames.size(), 3u);
  const FileFrame& start = frames[0];
  EXPECT_EQ(start.step, 0);
  EXPECT_EQ(frames[2].step, 4);
  EXPECT_EQ(frames[2].time, 0.004);  // dump_modify time yes
  EXPECT_TRUE(start.box->periodic[0] && start.box->periodic[1] && !start.box->periodic[2]);
  EXPECT_EQ(start.particles.id, (std::vector<std::int64_t>{1, 2, 3}));
  EXPECT_EQ(start.particles.mass[0], 1.0);
  const FileContacts& contacts = *start.contacts;
  ASSERT_EQ(contacts.size(), 2u);
  EXPECT_EQ(contacts.first, (std::vector<std::int64_t>{2, 3}));
  EXPECT_EQ(contacts.second, (std::vector<std::int64_t>{1, -1}));
  // The image of 1 is at 4.4, right of 2: it pushes 2 to the left.
  expectNear(contacts.normal[0], Vec3(-1, 0, 0), 0.0);
  expectNear(contacts.force[0], Vec3(-10, 0, 0), sixDigits * 10);
  expectNear(contacts.normal[1], Vec3(0, 0, 1), 0.0);
  expectNear(contacts.force[1], Vec3(0, 0, 20), sixDigits * 20);
  expectNear(contacts.point[0], Vec3(3.41 + 0.495, 2, 2), sixDigits);
  expectNear(contacts.point[1], Vec3(2, 2, 0), 0.0);
}

/// Two programs, one law without damping: forces of later steps agree, tangential ones too. The
/// normal is of places with six digits, so that 10 N turn by 5e-6 · 4 / 1.
TEST(Lammps, BothPrograms_GiveTheSameContact) {
  const auto one = programs().read("lammps", lammpsFiles);
  const auto other = programs().read("lammps", liggghtsFiles, {liggghtsColumns});
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t k = 0; k < one.size(); ++k) {
    expectNear(one[k].contacts->force[0], other[k].contacts->force[0], 2e-4);
    expectNear(one[k].contacts->point[0], other[k].contacts->point[0], 1e-4);
  }
  EXPECT_NEAR(one[2].contacts->force[0].y(), 0.1154, 1e-4);  // 1 moves along +y and takes 2 along
}

TEST(Lammps, Liggghts_TorqueWithoutLeverIsRolling) {
  const auto frames = programs().read("lammps", liggghtsFiles, {liggghtsColumns});
  for (const FileFrame& frame : frames) {
    EXPECT_EQ(frame.contacts->torque[0], Vec3(0, 0, 0));  // tangential history alone
    EXPECT_NEAR(frame.contacts->overlap[0], 0.01, 2e-4);
  }
}

/// LAMMPS' own sums over contacts, of samples/granular.in: f and tq of both atoms. With equal radii
/// the levers of one force give both the same torque, so that half the difference is rolling
/// resistance. Dashpots of what is dumped use velocities half a step later than those that moved
/// the atoms: the normal one 5 N s/m · 29 m/s² · 0.5 ms = 0.07 N, the rolling one 0.25 m · 2 N s/m
/// · 6 m/s² · 0.5 ms = 1.5 mN m.
TEST(Lammps, Granular_ForceAndRollingTorqueAreTheAtoms) {
  const FileFrame frame =
      programs().read("lammps", {"granular.5.dump", "granular.5.local"}).front();
  const FileContacts& contacts = *frame.contacts;
  ASSERT_EQ(contacts.first[0], 1);
  expectNear(contacts.force[0], Vec3(-14.207400646455177, -3.8010239968894428, 1.5513708497147116),
             0.1);
  const Vec3 one(0.057212160055400266, -0.56076258873338702, -1.4549278362718421),
      other(0.097963045849647032, -0.95995442944420117, -0.84990183004522768);
  expectNear(contacts.torque[0], 0.5 * (one - other), 2e-3);
  EXPECT_GT(contacts.torque[0].norm(), 0.3);
}

class LammpsText : public Sampled {
 protected:
  static std::string head(const std::string& what, int count) {
    return "ITEM: TIMESTEP\n7\nITEM: NUMBER OF " + what + "\n" + std::to_string(count) +
           "\nITEM: BOX BOUNDS ff ff ff\n0 4\n0 4\n0 4\n";
  }
  void writeAtoms() {
    samples_.write("a.dump",
                   head("ATOMS", 2) + "ITEM: ATOMS id x y z radius\n2 1.98 2 2 0.5\n1 1 2 2 0.5\n");
  }
};

/// p5–p7 are a force without its sign's lever: torque = R* n × it, here 0.25 · (−1, 0, 0) × (0, 25,
/// 0).
TEST_F(LammpsText, Granular_RollingPseudoForce) {
  writeAtoms();
  samples_.write("a.local",
                 head("ENTRIES", 1) +
                     "ITEM: ENTRIES c_p[1] c_p[2] c_q[1] c_q[2] c_q[3] c_q[4] c_q[5] c_q[6] c_q[7] "
                     "c_q[8] c_q[9] c_q[10] c_q[11] c_q[12] c_q[13]\n"
                     "1 2 20 0 -3 0 3 0 25 0 25 0 -0.98 0 0\n");
  const FileContacts contacts = *samples_.read("lammps", {"a.dump", "a.local"}).front().contacts;
  EXPECT_EQ(contacts.force[0], Vec3(-20, -3, 0));
  EXPECT_EQ(contacts.torque[0], Vec3(0, 0, -6.25));
}

/// A case that says what columns of contacts are may go with atoms alone.
TEST_F(LammpsText, AtomsAlone_NeedNoColumnsOfContacts) {
  writeAtoms();
  EXPECT_FALSE(samples_.read("lammps", {"a.dump"}, {"c_e=first,second"}).front().contacts);
}

/// Writers in Python have Radius; LAMMPS itself no capitals.
TEST_F(LammpsText, Names_MayHaveCapitalsAndAreThereOnce) {
  samples_.write("a.dump", head("ATOMS", 1) +
                               "ITEM: ATOMS ID xs ys zs Radius VX vy vz\n"
                               "1 0.5 0.5 0.25 0.3 4 5 6\n");
  const FileFrame frame = samples_.read("lammps", {"a.dump"}).front();
  EXPECT_EQ(frame.particles.position[0], Vec3(2, 2, 1));
  EXPECT_EQ(frame.particles.radius.at(0), 0.3);
  EXPECT_EQ(frame.particles.velocity.at(0), Vec3(4, 5, 6));
  samples_.write("a.dump", head("ATOMS", 1) +
                               "ITEM: ATOMS id x y z vx vy vz vx\n"
                               "1 2 2 1 4 5 6 7\n");
  EXPECT_EQ(samples_.refusal("lammps", {"a.dump"}),
            "a.dump:9: the column vx is there twice: only one of them can be read");
}

/// A wall's points are in the box, the atoms' paths are left whole: the first two periods off.
TEST_F(LammpsText, Walls_TouchTheNearestImage) {
  std::string text = head("ATOMS", 1);
  text.replace(text.find("ff ff ff"), 8, "pp pp ff");
  samples_.write("a.dump", text +
                               "ITEM: ATOMS id xu yu zu radius f_w[1] f_w[2] f_w[3] f_w[4] "
                               "f_w[5] f_w[6] f_w[7] f_w[8]\n"
                               "3 9 -2 0.48 0.5 1 0 0 20 1 2 0 0.5\n");
  text = head("ENTRIES", 0);
  samples_.write("a.local", text + "ITEM: ENTRIES c_p[1] c_p[2] c_q[1]\n");
  const FileContacts contacts = *samples_.read("lammps", {"a.dump", "a.local"}).front().contacts;
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_EQ(contacts.normal[0], Vec3(0, 0, 1));
}

/// Of a dump that somebody wrote anew the borders are the case's, where it is as wide.
TEST_F(LammpsText, Borders_OfWhichNothingIsSaidAreTheCases) {
  FileOptions options;
  options.box.emplace();
  options.box->high = Vec3(4, 5, 4);
  options.box->periodic[0] = options.box->periodic[1] = true;
  std::string text =
      head("ATOMS", 2) + "ITEM: ATOMS id x y z radius\n1 0.2 2 2 0.5\n2 3.3 2 2 0.5\n";
  samples_.write("a.local", head("ENTRIES", 1) +
                                "ITEM: ENTRIES c_p[1] c_p[2] c_q[1] c_q[2] c_q[3] c_q[4]\n"
                                "1 2 100 0 0 0\n");
  for (const std::string letters : {" ff ff ff", ""}) {
    std::string own = text;
    own.replace(own.find(" ff ff ff"), 9, letters);
    samples_.write("a.dump", own);
    const FileFrame frame = samples_.read("lammps", {"a.dump", "a.local"}, options).front();
    EXPECT_TRUE(frame.box->periodic[0]);
    EXPECT_FALSE(frame.box->periodic[1]);  // of another width
    EXPECT_EQ(frame.box->saidFixed[0], !letters.empty());
    EXPECT_EQ(frame.contacts->normal[0], Vec3(1, 0, 0));
  }
}

/// LAMMPS packs what its name ends with .gz of.
TEST_F(LammpsText, PackedDumps_AreReadAsTheyAre) {
  writeAtoms();
  const auto pack = [&](const char* name, std::size_t length) {
    std::ifstream in(folder_.path() / "a.dump");
    const std::string text((std::istreambuf_iterator<char>(in)), {});
    const gzFile out = gzopen((folder_.path() / name).c_str(), "wb");
    gzwrite(out, text.data(), static_cast<unsigned>(text.size()));
    gzclose(out);
    if (length > 0) fs::resize_file(folder_.path() / name, length);
    return folder_.path() / name;
  };
  EXPECT_EQ(formatOf(pack("a.dump.gz", 0)), "lammps");
  const FileFrame frame = samples_.read("lammps", {"a.dump.gz"}).front();
  EXPECT_EQ(frame.particles.position,
            samples_.read("lammps", {"a.dump"}).front().particles.position);
  pack("b.dump.gz", 60);
  EXPECT_EQ(samples_.refusal("lammps", {"b.dump.gz"}),
            "b.dump.gz: what gzip packed into it is damaged or was cut off");
}

/// Half a velocity is none: the other half would be 0 for all that anybody knows.
TEST_F(LammpsText, HalfAVectorIsRefused) {
  samples_.write("a.dump", head("ATOMS", 1) + "ITEM: ATOMS id x y radius vx vz\n1 1 2 0.5 3 0\n");
  EXPECT_NE(samples_.refusal("lammps", {"a.dump"}).find("one of vx, vy is missing"),
            std::string::npos);
}

TEST_F(LammpsText, Columns_AsTheComputesSay) {
  writeAtoms();
  samples_.write("a.local", head("ENTRIES", 2) +
                                "ITEM: ENTRIES c_f[1] c_f[2] c_i[1] c_i[2] c_d\n"
                                "0.98 20 1 2 4\n1.5 0 2 1 4\n");
  const FileContacts contacts =
      *samples_
           .read("lammps", {"a.dump", "a.local"},
                 {"c_f=pair/local,dist,force c_i=property/local,patom1,patom2 c_d=-"})
           .front()
           .contacts;
  // A pair without a force may touch even so, where tension is cut: positions say.
  EXPECT_EQ(contacts.normalForce, (std::vector<double>{20.0, 0.0}));
  EXPECT_TRUE(contacts.force.empty());
  EXPECT_EQ(contacts.normal[0], Vec3(-1, 0, 0));
  // Or by the names of CSV columns.
  EXPECT_EQ(samples_.read("lammps", {"a.dump", "a.local"}, {"c_i=first,second c_f=-,normal_force"})
                .front()
                .contacts->normalForce,
            (std::vector<double>{20.0, 0.0}));
  EXPECT_EQ(samples_.refusal("lammps", {"a.dump", "a.local"}),
            "a.local:9: what are its columns? say so by the computes' own keywords: columns = "
            "c_f=property/local,patom1,patom2 c_…=pair/local,force,p1,p2,p3,p4 (LAMMPS) or "
            "c_f=pair/gran/local,pos,id,force,… (LIGGGHTS)");
  EXPECT_EQ(samples_.refusal("lammps", {"a.dump", "a.local"},
                             {"c_f=pair/local,dist,force c_i=property/local,patom1,patom2 c_e=-"}),
            "columns: a.dump, step 7 has no column c_e");
  EXPECT_EQ(samples_.refusal("lammps", {"a.dump", "a.local"}, {"c_f=pair/local,dist,fource"}),
            "columns: c_f=pair/local,…: compute pair/local has no fource that is known here");
}

TEST_F(LammpsText, Scaled_Unsorted_Walls) {
  samples_.write("a.dump",
                 head("ATOMS", 1) +
                     "ITEM: ATOMS xs ys zs id diameter f_w[1] f_w[2] f_w[3] f_w[4] f_w[5] "
                     "f_w[6] f_w[7] f_w[8]\n0.5 0.5 0.12 3 1 1 0 0 20 2 2 0 0.5\n");
  const FileFrame frame = samples_.read("lammps", {"a.dump"}).front();
  EXPECT_EQ(frame.particles.position[0], Vec3(2, 2, 0.48));
  EXPECT_EQ(frame.particles.radius[0], 0.5);
  EXPECT_FALSE(frame.contacts);  // of walls alone: no stress could be made of them
  samples_.write("a.dump", head("ATOMS", 1) +
                               "ITEM: ATOMS x y z id f_w[1] f_w[2] f_w[3] f_w[4] f_w[5] f_w[6] "
                               "f_w[7] f_w[8]\n2 2 2 3 0.7 0 0 20 2 2 0 0.5\n");
  EXPECT_EQ(samples_.refusal("lammps", {"a.dump"}),
            "a.dump:10: f_w[1] is 0.7, neither 0 nor 1: if f_w is no fix wall/gran … contacts, say "
            "columns = f_w=-");
  EXPECT_EQ(samples_.read("lammps", {"a.dump"}, {"f_w=-"}).size(), 1u);
}

/// A row of LIGGGHTS' wall/gran/local for a mesh, which it wrote for a sphere 0.02 deep in a floor.
TEST_F(LammpsText, Liggghts_MeshWall) {
  samples_.write("a.dump",
                 head("ATOMS", 1) + "ITEM: ATOMS id x y z radius\n3 2.5 1.5 0.48016 0.5\n");
  std::string names = "ITEM: ENTRIES";
  for (int k = 1; k <= 13; ++k) names += " c_w[" + std::to_string(k) + "]";
  samples_.write("a.local", head("ENTRIES", 1) + names +
                                "\n2.5 1.5 0 2.5 1.5 0.48016 0 0 3 0 0 19.8402 0.0198402\n");
  const FileContacts contacts =
      *samples_.read("lammps", {"a.dump", "a.local"}, {"c_w=wall/gran/local,pos,id,force,delta"})
           .front()
           .contacts;
  EXPECT_EQ(contacts.first[0], 3);
  EXPECT_EQ(contacts.second[0], -1);
  EXPECT_EQ(contacts.normal[0], Vec3(0, 0, 1));
  EXPECT_EQ(contacts.force[0], Vec3(0, 0, 19.8402));
  EXPECT_EQ(contacts.point[0], Vec3(2.5, 1.5, 0));
  EXPECT_EQ(contacts.overlap[0], 0.0198402);
}

TEST_F(LammpsText, WhatCannotBe_IsRefusedByLine) {
  const auto refusal = [&](const std::string& text) {
    samples_.write("b.dump", text);
    return samples_.refusal("lammps", {"b.dump"});
  };
  EXPECT_EQ(refusal(head("ATOMS", 1) + "ITEM: ATOMS id type\n1 1\n"),
            "b.dump:9: the columns x y z are missing: dump … custom … id type x y z radius …");
  EXPECT_EQ(refusal(head("ATOMS", 900) + "ITEM: ATOMS id x y z\n1 1 2 3\n"),
            "b.dump:9: 900 rows are announced, the rest of the file has room for 2 at most");
  EXPECT_EQ(refusal("ITEM: TIMESTEP\n1.5\nITEM: ATOMS\n"),
            "b.dump:2: the step: \"1.5\" should be a whole number, 0 or more");
  EXPECT_EQ(refusal("ITEM: TIMESTEP\n1\nITEM: NUMBER OF ATOMS\n0\nITEM: BOX BOUNDS xy xz yz pp pp "
                    "pp\n0 1 0.5\n0 1 0\n0 1 0\n"),
            "b.dump:6: a tilted (triclinic) box is not read");
  writeAtoms();
  samples_.write("b.local", head("ENTRIES", 1) + "ITEM: ENTRIES c_p[1] c_p[2] c_q[1]\n1 5 20\n");
  EXPECT_EQ(samples_.refusal("lammps", {"a.dump", "b.local"}),
            "b.local, step 7: contact 1 (1 and 5): there is no particle 5 at that time (a.dump, "
            "step 7: ids from 1 to 2)");
  samples_.write("c.dump",
                 head("ATOMS", 2) + "ITEM: ATOMS id x y z radius\n1 1.98 2 2 0.5\n1 1 2 2 0.5\n");
  EXPECT_EQ(samples_.refusal("lammps", {"c.dump", "b.local"}),
            "c.dump, step 7: particle 1 is there twice (lines 10 and 11)");
  EXPECT_EQ(refusal(head("ATOMS", 1) + "ITEM: ATOMS type x y z\n1 1 2 3\n"),
            "b.dump:9: the column id is missing, by which a particle is known from one time to the "
            "next and in its contacts: dump … custom … id type x y z vx vy vz radius …");
}

}  // namespace
