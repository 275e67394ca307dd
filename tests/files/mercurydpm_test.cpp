/// MercuryDPM's files: who is where, and in which direction forces act. The lines were checked
/// against BaseInteraction::writeToFStat and files of its repository.
#include <gtest/gtest.h>

#include "tests/files/samples.hpp"

namespace {

using namespace crossgrain::files;
using namespace crossgrain::files::sampled;

using MercuryDpm = Sampled;

TEST_F(MercuryDpm, Pair_IsListedTwice_ForceOnTheFirst) {
  samples_.write("a.data", pairData);
  samples_.write("a.fstat", pairFstat);
  const auto frames = samples_.read("mercurydpm", {"a.data", "a.fstat"});
  ASSERT_EQ(frames.size(), 1u);
  const FileFrame& frame = frames.front();
  EXPECT_EQ(frame.time, 0.5);
  EXPECT_FALSE(frame.step);
  EXPECT_EQ(frame.box->high, Vec3(4, 4, 4));
  EXPECT_EQ(frame.particles.id, (std::vector<std::int64_t>{0, 1}));
  EXPECT_EQ(frame.particles.position[1], Vec3(1.98, 2, 2));
  EXPECT_EQ(frame.particles.velocity[0], Vec3(0.1, 0, 0));
  EXPECT_EQ(frame.particles.spin[0], Vec3(0, 0, 1));
  EXPECT_EQ(frame.particles.radius[0], 0.5);
  EXPECT_TRUE(frame.particles.mass.empty());
  const FileContacts& contacts = *frame.contacts;
  ASSERT_EQ(contacts.size(), 2u);
  // 0 is left of 1, which pushes it to the left; 3 N act on it along −y.
  EXPECT_EQ(contacts.first[0], 0);
  EXPECT_EQ(contacts.second[0], 1);
  EXPECT_EQ(contacts.normal[0], Vec3(-1, 0, 0));
  EXPECT_EQ(contacts.force[0], Vec3(-20, -3, 0));
  EXPECT_EQ(contacts.force[1], Vec3(20, 3, 0));
  EXPECT_EQ(contacts.point[0], Vec3(1.49, 2, 2));
  EXPECT_EQ(contacts.overlap[0], 0.02);
}

TEST_F(MercuryDpm, Wall_NormalAndTangentAreFlipped) {
  samples_.write("a.data", "1 0 0 0 0 4 4 4\n2 2 0.48 0 0 0 0.5 0 0 0 0 0 0 0\n");
  // A floor below: MercuryDPM's n is downward there, its t against the force.
  samples_.write("a.fstat",
                 "# 0 1\n# 0 0 0 4 4 4\n# 0.5 0.5 0 0 0 0\n"
                 "0 0 -1  2 2 0  0.02 0  20 3  0 0 -1  -1 0 0\n");
  const FileContacts contacts =
      *samples_.read("mercurydpm", {"a.data", "a.fstat"}).front().contacts;
  EXPECT_EQ(contacts.second[0], -1);
  EXPECT_EQ(contacts.normal[0], Vec3(0, 0, 1));
  EXPECT_EQ(contacts.force[0], Vec3(3, 0, 20));
}

TEST_F(MercuryDpm, TwoDimensions_SpinIsTurnedBack) {
  samples_.write("a.data", "1 0.25 0 0 1 2\n0.5 0.75 1 2 0.1 0.3 -7 2\n");
  const FileFrame frame = samples_.read("mercurydpm", {"a.data"}).front();
  EXPECT_EQ(frame.particles.position[0], Vec3(0.5, 0.75, 0));
  EXPECT_EQ(frame.particles.velocity[0], Vec3(1, 2, 0));
  EXPECT_EQ(frame.particles.spin[0], Vec3(0, 0, 7));
  EXPECT_EQ(frame.particles.kind[0], 2);
  EXPECT_EQ(frame.box->high, Vec3(1, 2, 0));
  EXPECT_FALSE(frame.contacts);
}

TEST_F(MercuryDpm, Ghosts_AreTheParticlesOfTheMirroredLine) {
  // 0 at 0.1 and 1 at 3.12 touch over the edge x = 4; 2 and 3 are ghosts.
  samples_.write(
      "a.data",
      "2 0 0 0 0 4 4 4\n0.1 2 2 0 0 0 0.5 0 0 0 0 0 0 0\n3.12 2 2 0 0 0 0.5 0 0 0 0 0 0 0\n");
  samples_.write("a.fstat",
                 "# 0 1\n# 0 0 0 4 4 4\n# 0.5 0.5 0 0 0 0\n"
                 "0 1 2  3.61 2 2  0.02 0  20 0  -1 0 0  0 0 0\n"
                 "0 0 3  -0.39 2 2  0.02 0  20 0  1 0 0  0 0 0\n");
  const FileFrame frame = samples_.read("mercurydpm", {"a.data", "a.fstat"}).front();
  EXPECT_EQ(frame.contacts->second, (std::vector<std::int64_t>{0, 1}));
  EXPECT_EQ(frame.contacts->normal[1], Vec3(1, 0, 0));
  EXPECT_TRUE(frame.box->periodic[0]);
  EXPECT_FALSE(frame.box->periodic[1]);
  samples_.write(
      "a.fstat",
      "# 0 1\n# 0 0 0 4 4 4\n# 0.5 0.5 0 0 0 0\n0 1 2  3.61 2 2  0.02 0  20 0  -1 0 0  0 0 0\n");
  EXPECT_EQ(
      samples_.refusal("mercurydpm", {"a.data", "a.fstat"}),
      "a.data, time 0: particle 1 touches 2, but there are 2 particles, from 0: if that is the "
      "ghost of one, its own contact over the periodic edge should be listed, too");
  // A fixed particle's contact is listed from one side; with the case's box it is found by place.
  const FileFrame placed =
      samples_
          .read("mercurydpm", {"a.data", "a.fstat"},
                {.columns = {}, .box = FileBox{{0, 0, 0}, {4, 4, 4}, {true, true, false}}})
          .front();
  EXPECT_EQ(placed.contacts->second, (std::vector<std::int64_t>{0}));
}

/// Files may be numbered, and contacts be saved at other times.
TEST_F(MercuryDpm, Times_AreMatched) {
  const std::string later = "1 0.75 0 0 0 4 4 4\n1 2 2 0 0 0 0.5 0 0 0 0 0 0 0\n";
  samples_.write("a.data.0000", pairData);
  samples_.write("a.data.0001", later);
  samples_.write("a.fstat.0000", pairFstat);
  samples_.write("a.fstat.0001",
                 "# 0.7 1\n# 0 0 0 4 4 4\n# 0 0 0 0 0 0\n# 0.7500001 1\n# 0\t0 0 4 4 4\n# 0 0\n");
  const auto frames =
      samples_.read("mercurydpm", {"a.data.0000", "a.data.0001", "a.fstat.0000", "a.fstat.0001"});
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0].contacts->size(), 2u);
  EXPECT_EQ(frames[1].contacts->size(), 0u);
}

TEST_F(MercuryDpm, WhatCannotBe_IsRefusedByLine) {
  samples_.write("a.data", pairData);
  const auto refusal = [&](std::string_view data) {
    samples_.write("b.data", data);
    return samples_.refusal("mercurydpm", {"b.data"});
  };
  EXPECT_EQ(refusal("2 0.5 0 0 0 4 4 4\n1 2 2 0.1 0 0 0.5 0 0 0 0 0 1 0\n"),
            "b.data:2: the file ends where a particle should be: it was cut off");
  EXPECT_EQ(refusal("1 0.5 0 0 0 4 4 4\n1 2 2 0.1 0 0 0.5 0 0 0 0 0 1\n"),
            "b.data:2: 13 columns, there should be 14");
  EXPECT_EQ(refusal("1 0.5 0 0 0 4 4 4\n1 2 2 0.1 0 0 0.5 0 0 0 0 0 1 0 0\n"),
            "b.data:2: more than 14 columns");
  EXPECT_EQ(refusal("1 0.5 0 0 0 4 4 4\n1 nan 2 0.1 0 0 0.5 0 0 0 0 0 1 0\n"),
            "b.data:2: column 2: \"nan\" should be a finite number");
  EXPECT_EQ(
      refusal("1000000000000 0.5 0 0 0 4 4 4\n1 2 2 0.1 0 0 0.5 0 0 0 0 0 1 0\n"),
      "b.data:1: 1000000000000 rows are announced, the rest of the file has room for 2 at most");
  EXPECT_EQ(
      refusal("1 0.5 0 0 4 4 4\n"),
      "b.data:1: a time begins with N t xmin ymin zmin xmax ymax zmax (in 2D: without z); here "
      "are 7 words");
  EXPECT_EQ(refusal(""), "b.data: is empty");
  samples_.write("b.fstat", "# 0.5 1\n# 0\n");
  EXPECT_EQ(samples_.refusal("mercurydpm", {"a.data", "b.fstat"}),
            "b.fstat:2: a time begins with three lines: # t 1, # box, # Rmin Rmax 0 0 0 0");
  samples_.write("b.fstat", "# 0.9 1\n# 0 0\n# 0 0\n");
  EXPECT_EQ(samples_.refusal("mercurydpm", {"a.data", "b.fstat"}),
            "b.fstat, time 0.9: none of its times is one of a.data, time 0.5");
  samples_.write("b.fstat", "# 0.5 1\n# 0 0\n# 0 0\n0.5 0 0 1 2 2 0 0 1 0 -1 0 0 0 0 0\n");
  EXPECT_EQ(samples_.refusal("mercurydpm", {"a.data", "b.fstat"}),
            "b.fstat, time 0.5: contact 1 (0 and 0): a particle touches itself");
  samples_.write("b.fstat", "# 0.5 1\n# 0 0\n# 0 0\n0.5 0 1 1 2 2 0 0 1 0 -0.5 0 0 0 0 0\n");
  EXPECT_EQ(samples_.refusal("mercurydpm", {"a.data", "b.fstat"}),
            "b.fstat, time 0.5: contact 1 (0 and 1): its normal has the length 0.5, it should be a "
            "unit vector");
  EXPECT_EQ(samples_.refusal("mercurydpm", {"b.fstat"}),
            "b.fstat: contacts alone: the file of the particles is missing");
  EXPECT_EQ(
      samples_.refusal("mercurydpm", {"a.data", "a.data"}),
      "a.data, time 0.5: comes after a.data, time 0.5: times of a run must rise; files of other "
      "runs should be in folders of their own");
}

}  // namespace
