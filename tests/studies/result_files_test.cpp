// From frames of other programs' files to snapshots, and from several files to one average, against
// numbers by hand.
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <fstream>
#include <functional>
#include <numbers>
#include <set>

#include "adapters/files/file_snapshots.hpp"
#include "cases/assembly_scene.hpp"
#include "cases/couette.hpp"
#include "studies/flow/average.hpp"
#include "studies/flow/snapshot_file.hpp"
#include "studies/flow/snapshot_fit.hpp"
#include "studies/flow/snapshot_sources.hpp"
#include "tests/studies/quick_cell.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/temporary_folder.hpp"

namespace crossgrain {
namespace {

using files::FileFrame;
using PlaneSnapshots = files::FileSnapshotsOf<2>;
using files::Vec3;

class FakeReader : public files::FrameReader {
 public:
  explicit FakeReader(std::deque<FileFrame> frames) : frames_(std::move(frames)) {}
  std::optional<FileFrame> next() override {
    if (frames_.empty()) return std::nullopt;
    FileFrame frame = std::move(frames_.front());
    frames_.pop_front();
    return frame;
  }
  double progress() const override { return 0.0; }

 private:
  std::deque<FileFrame> frames_;
};

/// Three disks of radius 1 m and mass 2 kg: two overlap by 0.1 m side by side, the third is 0.02 m
/// deep in the floor. k_n = 100 N/m: forces of 10 N and 2 N.
Case restingDisks() {
  Case setup;
  setup.source = Assembly();
  setup.law.normal = NormalLaw::linear;
  setup.law.kn = 100.0;
  setup.law.kt = 50.0;
  setup.law.mu = 0.5;
  DiskGroup group{.position = {0.0, 2.0}, .radius = 1.0, .mass = 2.0};
  group.places = {{0.0, 0.0}, {0.95, 0.0}, {2.0, -0.51}};  // in diameters
  assemblyIn<2>(setup).disks = {group};
  WallGroup floor;
  floor.planes = {{Vec2::Zero(), Vec2::UnitY()}};
  assemblyIn<2>(setup).walls = {floor};
  assemblyIn<2>(setup).duration = 4.0;
  setup.run.dt = 1e-3;
  Region& region = setup.region.emplace();
  region.low = {-2.0, 0.0, 0.0};
  region.high = {6.0, 4.0, 0.0};
  region.height = 0.5;
  region.snapshots = 4;
  return setup;
}

/// The three by ids 12, 5 and 9 out of order, with the contact of 5 and 9 listed from both sides
/// and that of 12 with wall 0.
FileFrame threeParticles(double time = 1.0) {
  FileFrame frame{.where = "mine.dump, step 7", .time = time};
  frame.particles.id = {12, 5, 9};
  frame.particles.position = {{4.0, 0.98, 0.0}, {0.0, 2.0, 0.0}, {1.9, 2.0, 0.0}};
  frame.particles.radius = {1.0, 1.0, 1.0};
  frame.particles.velocity = std::vector<Vec3>(3, Vec3::Zero());
  frame.particles.spin = {{0.0, 0.0, 3.0}, {0.0, 0.0, 1.0}, {0.0, 0.0, 2.0}};
  auto& contacts = frame.contacts.emplace();
  contacts.first = {9, 12, 5};
  contacts.second = {5, -1, 9};
  contacts.normal = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {-1.0, 0.0, 0.0}};
  contacts.force = {{10.0, 0.4, 0.0}, {0.0, 2.0, 0.0}, {-10.0, -0.4, 0.0}};
  contacts.overlap = {0.1, 0.02, 0.1};
  return frame;
}

files::FileSceneOf<2> targetOf(const Case& setup) {
  files::FileSceneOf<2> target{.name = "mine", .where = "[engines.mine]"};
  const bool cell = cellOf(setup);
  target.bodies = cell ? couetteScene(setup, Packing(), 0.0).bodies
                       : assemblyScene(setup, Disks(), 0.0, 0.0).bodies;
  target.anyAngle = cell;
  target.around = [setup](Disks disks) {
    disks.mass.assign(disks.size(), 2.0);
    disks.inertia.assign(disks.size(), 1.0);
    return sceneAround(setup, std::move(disks), {"mine.dump"});
  };
  target.dt = 1e-3;
  return target;
}

PlaneSnapshots snapshotsOf(std::deque<FileFrame> frames,
                           files::FileSceneOf<2> target = targetOf(restingDisks()),
                           const files::FileUnits& units = {}) {
  return {std::make_unique<FakeReader>(std::move(frames)), units, std::move(target)};
}

/// Why frames that are all read are refused.
std::string refusalOfFrames(const std::deque<FileFrame>& frames,
                            const files::FileSceneOf<2>& target = targetOf(restingDisks()),
                            const files::FileUnits& units = {},
                            std::vector<std::string>* remarks = nullptr) {
  return test::refusalOf([&] {
    PlaneSnapshots source = snapshotsOf(frames, target, units);
    while (source.next()) continue;
    if (remarks) *remarks = source.remarks();
  });
}

std::string lines(const std::vector<std::string>& remarks) {
  return fmt::format("{}\n", fmt::join(remarks, "\n"));
}

/// The first snapshot of that frame, changed if need be.
Snapshot firstOf(const std::function<void(FileFrame&)>& change = {},
                 const files::FileUnits& units = {}, std::vector<std::string>* remarks = nullptr) {
  FileFrame frame = threeParticles();
  if (change) change(frame);
  PlaneSnapshots source = snapshotsOf({frame}, targetOf(restingDisks()), units);
  Snapshot now = source.next().value();
  EXPECT_FALSE(source.next());
  if (remarks) *remarks = source.remarks();
  return now;
}

std::string refusalOfFrame(const std::function<void(FileFrame&)>& change) {
  return test::refusalOf([&] { firstOf(change); });
}

using test::expectSays;

TEST(PlaneSnapshots, Frame_BecomesDisksByRisingIdAndContactsOnce) {
  std::vector<std::string> remarks;
  const Snapshot now = firstOf({}, {}, &remarks);
  EXPECT_EQ(now.position, (std::vector<Vec2>{{0.0, 2.0}, {1.9, 2.0}, {4.0, 0.98}}));
  EXPECT_EQ(*now.spin, (std::vector{1.0, 2.0, 3.0}));
  const Contacts& contacts = now.contacts.value();
  EXPECT_EQ(contacts.i, (std::vector<std::int32_t>{0, 2}));
  EXPECT_EQ(contacts.j, (std::vector<std::int32_t>{1, 3}));  // 3: the floor
  EXPECT_EQ(contacts.normal[0], Vec2(-1.0, 0.0));            // from 9 to 5
  EXPECT_EQ(contacts.normalForce, (std::vector{10.0, 2.0}));
  // On disk 0 acts (−10, −0.4), and z × n = (0, −1).
  EXPECT_NEAR(contacts.tangentialForce[0], 0.4, 1e-15);
  EXPECT_EQ(contacts.overlap, (std::vector{0.1, 0.02}));
  EXPECT_TRUE(contacts.rollingTorque.empty());
  // The floor bears 2 N, at x = 4 m from its centre at the origin.
  EXPECT_EQ(*now.bodies[0].force, Vec2(0.0, -2.0));
  EXPECT_NEAR(*now.bodies[0].torque, -8.0, 1e-12);
  EXPECT_EQ(remarks, std::vector<std::string>{"no masses in the files: they are the case's"});
}

TEST(PlaneSnapshots, Units_ScaleLengthTimeAndMass) {
  files::FileUnits units{.length = 1e-3, .time = 1e-3, .mass = 1e-3, .start = 500.0};
  const Snapshot now = firstOf(
      [](FileFrame& frame) {  // mm, ms, g: forces in g mm/ms² = N
        frame.time = 1500.0;
        for (Vec3& x : frame.particles.position) x *= 1e3;
        for (double& a : frame.particles.radius) a *= 1e3;
        frame.particles.velocity[1] = {2.0, 0.0, 0.0};  // mm/ms
        for (double& d : frame.contacts->overlap) d *= 1e3;
      },
      units);
  EXPECT_NEAR(now.positionTime, 1.0, 1e-12);
  EXPECT_NEAR(now.position[1].x(), 1.9, 1e-12);
  EXPECT_NEAR(now.velocity[0].x(), 2.0, 1e-12);
  EXPECT_NEAR((*now.spin)[0], 1000.0, 1e-9);
  EXPECT_NEAR(now.contacts->normalForce[0], 10.0, 1e-9);
  EXPECT_NEAR(now.contacts->overlap[0], 0.1, 1e-12);
}

TEST(PlaneSnapshots, PlaneXz_TurnsSpinsWithTheRightHand) {
  files::FileUnits units = files::fileUnits("csv", {{"plane", std::string("xz")}});
  const auto upright = [](FileFrame& frame) {
    const auto turn = [](std::vector<Vec3>& all) {
      for (Vec3& v : all) v = Vec3(v.x(), 0.0, v.y());
    };
    turn(frame.particles.position);
    turn(frame.contacts->normal);
    turn(frame.contacts->force);
    // ω = −e_y carries a point at +x towards +z: counter-clockwise in (x, z).
    for (Vec3& w : frame.particles.spin) w = Vec3(0.0, -w.z(), 0.0);
  };
  const Snapshot now = firstOf(upright, units);
  EXPECT_EQ(now.position[2], Vec2(4.0, 0.98));
  EXPECT_EQ(*now.spin, (std::vector{1.0, 2.0, 3.0}));
  EXPECT_NEAR(now.contacts->tangentialForce[0], 0.4, 1e-15);
  expectSays(refusalOfFrame(upright),
             {"mine.dump, step 7", "particles lie from z", "plane = \"xz\""});
}

TEST(PlaneSnapshots, OverlapsAndNormals_FollowFromPositionsWhereTheyAreMissing) {
  std::vector<std::string> remarks;
  const Snapshot now = firstOf(
      [](FileFrame& frame) {
        frame.contacts->overlap.clear();
        frame.contacts->normal.clear();
        frame.contacts->first.push_back(9);  // a pair that was only looked at
        frame.contacts->second.push_back(12);
        frame.contacts->force.push_back(Vec3::Zero());
      },
      {}, &remarks);
  ASSERT_EQ(now.contacts->size(), 2u);
  EXPECT_NEAR(now.contacts->overlap[0], 0.1, 1e-15);
  EXPECT_NEAR(now.contacts->overlap[1], 0.02, 1e-15);
  EXPECT_NEAR(now.contacts->normalForce[1], 2.0, 1e-15);
  EXPECT_EQ(remarks.size(), 3u);
}

TEST(PlaneSnapshots, MissingColumns_AreRemarkedOrRefused) {
  std::vector<std::string> remarks;
  const Snapshot now = firstOf(
      [](FileFrame& frame) {
        frame.contacts.reset();
        frame.particles.spin.clear();
      },
      {}, &remarks);
  EXPECT_FALSE(now.contacts);
  EXPECT_FALSE(now.spin);
  ASSERT_EQ(remarks.size(), 3u);
  expectSays(remarks[0], {"no contacts", "stress, fabric"});
  expectSays(remarks[2], {"no spins"});
  // A force without a direction is none, but where it is 0.
  const auto sizes = [](double tangential) {
    return [tangential](FileFrame& frame) {
      frame.contacts->force.clear();
      frame.contacts->normalForce = {10.0, 2.0, 10.0};
      frame.contacts->tangentialForce.assign(3, tangential);
    };
  };
  EXPECT_FALSE(firstOf(sizes(0.4), {}, &remarks).contacts);
  expectSays(remarks[1], {"no direction"});
  EXPECT_EQ(firstOf(sizes(0.0)).contacts->normalForce, (std::vector{10.0, 2.0}));
  expectSays(refusalOfFrame([](FileFrame& frame) { frame.particles.velocity.clear(); }),
             {"no velocities"});
}

TEST(PlaneSnapshots, FilesWithoutContactsOfWalls_HaveThoseOfPairs) {
  std::vector<std::string> remarks;
  const Snapshot now = firstOf(
      [](FileFrame& frame) {
        auto& contacts = *frame.contacts;
        for (auto* list : {&contacts.first, &contacts.second}) list->erase(list->begin() + 1);
        for (auto* list : {&contacts.normal, &contacts.force}) list->erase(list->begin() + 1);
        contacts.overlap.erase(contacts.overlap.begin() + 1);
      },
      {}, &remarks);
  EXPECT_EQ(now.contacts->size(), 1u);
  EXPECT_FALSE(now.bodies[0].force);
  expectSays(remarks.at(0), {"no contacts with walls"});
}

TEST(PlaneSnapshots, FaultyContacts_AreRefused) {
  const std::pair<std::function<void(FileFrame&)>, std::vector<std::string>> faults[] = {
      {[](FileFrame& f) { f.contacts->force[2] *= 1.01; },
       {"contact 5–9 is listed twice with different forces"}},
      {[](FileFrame& f) {
         f.contacts->first[2] = 9;
         f.contacts->second[2] = 5;
         f.contacts->normal[2] *= -1.0;
         f.contacts->force[2] *= -1.0;
       },
       {"contact 5–9 is listed twice from the same side"}},
      {[](FileFrame& f) {
         for (Vec3& force : f.contacts->force) force = -force;
       },
       {"normal forces attract", "-12 N over 2 contacts", "other sign?"}},
      {[](FileFrame& f) {
         for (Vec3& n : f.contacts->normal) n = -n;
       },
       {"contact 9–5", "normal points from the first to the second"}},
      {[](FileFrame& f) { f.contacts->second[0] = 77; }, {"contact 9–77", "no particle 77"}},
      {[](FileFrame& f) { f.contacts->overlap[1] = 0.03; }, {"overlaps by 0.03 m", "by 0.02 m"}},
      {[](FileFrame& f) { f.contacts->normal[1] = Vec3(1.0, 0.0, 0.0); },
       {"contact 12–wall 0", "no plane of the case touches disk 2", "normal of (1, 0)"}},
      {[](FileFrame& f) { f.contacts->force[1] = Vec3(0.0, 2.0, 1.0); }, {"is not in the plane"}},
      {[](FileFrame& f) {  // particle 12 with what is 4 m away
         f.contacts->first[1] = 12;
         f.contacts->second[1] = 5;
       },
       {"contact 12–5", "periodic edge?"}},
      {[](FileFrame& f) {  // pairs that overlap are contacts
         f.contacts->first = {12};
         f.contacts->second = {-1};
         f.contacts->normal = {Vec3::UnitY()};
         f.contacts->force = {2.0 * Vec3::UnitY()};
         f.contacts->overlap = {0.02};
       },
       {"no contact of disk 0 with disk 1", "0.1 m"}}};
  for (const auto& [change, says] : faults) expectSays(refusalOfFrame(change), says);
}

/// The pair overlaps by less than a millionth of the scene and is not listed, that with the floor
/// is, at 1e-6 m. Places have eight digits: they leave 2e-7 m open (two places and two radii of
/// 5e-8 m).
TEST(PlaneSnapshots, PairsThatOverlap_AreListedWhereDigitsShowThem) {
  const auto missing = [](double x, double speed, double listed = 1e-6) {
    return [=](FileFrame& frame) {
      frame.particles.position = {{4.0, 1.0 - listed, 0.0}, {0.0, 2.0, 0.0}, {x, 2.0, 0.0}};
      frame.particles.velocity[2] = Vec3(speed, 0.0, 0.0);
      auto& contacts = *frame.contacts;
      contacts.first = {12};
      contacts.second = {-1};
      contacts.normal = {Vec3::UnitY()};
      contacts.force = {Vec3(0.0, 100.0 * listed, 0.0)};
      contacts.overlap = {listed};
    };
  };
  expectSays(refusalOfFrame(missing(1.9999996001, 0.0)),
             {"no contact of disk 0 with disk 1", "4e-07"});
  expectSays(refusalOfFrame(missing(1.9999996001, -1e-4)), {"no contact of disk 0 with disk 1"});
  // Less than the digits show; less than a tenth of the median; met within the last step of 1 ms.
  EXPECT_EQ(refusalOfFrame(missing(1.9999999, 0.0)), "");
  EXPECT_EQ(refusalOfFrame(missing(1.9999996001, 0.0, 5e-6)), "");
  EXPECT_EQ(refusalOfFrame(missing(1.9999996001, -1e-3)), "");
  // A critical damper of 2 √(m₁₂ k_n) = 20 kg/s leaves no force above 100 δ/20 = 2e-6 m/s.
  EXPECT_NE(refusalOfFrame(missing(1.9999996001, 1e-6)), "");
  EXPECT_EQ(refusalOfFrame(missing(1.9999996001, 3e-6)), "");
  // Places that a program has made of parts of a box have digits of their own.
  EXPECT_EQ(refusalOfFrame([&](FileFrame& frame) {
              missing(1.9999996001, 0.0)(frame);
              frame.particles.scaled = true;
            }),
            "");
}

/// Forty pairs that slide on each other at 1 m/s, at f_t = µ f_n = 5 N.
std::string refusalOfSliding(double tangential, double spin, std::size_t pairs, double mu = 0.5,
                             std::vector<std::string>* remarks = nullptr) {
  Case setup = restingDisks();
  setup.law.mu = mu;
  auto& group = assemblyIn<2>(setup).disks[0];
  group.places.clear();
  FileFrame frame{.where = "mine.dump, step 7", .time = 1.0};
  auto& contacts = frame.contacts.emplace();
  for (std::size_t k = 0; k < pairs; ++k)
    for (const bool upper : {false, true}) {
      const double x = 3.0 * static_cast<double>(k), y = upper ? 5.9 : 4.0;
      group.places.emplace_back(0.5 * x, 0.5 * (y - 2.0));
      frame.particles.id.push_back(static_cast<std::int64_t>(frame.particles.id.size()) + 1);
      frame.particles.position.emplace_back(x, y, 0.0);
      frame.particles.radius.push_back(1.0);
      frame.particles.velocity.emplace_back(upper && spin == 0.0 ? 1.0 : 0.0, 0.0, 0.0);
      frame.particles.spin.emplace_back(0.0, 0.0, spin);
      if (!upper) continue;
      contacts.first.push_back(frame.particles.id.back());
      contacts.second.push_back(frame.particles.id.back() - 1);
      contacts.normal.push_back(Vec3::UnitY());
      contacts.force.emplace_back(tangential, 10.0, 0.0);
      contacts.overlap.push_back(0.1);
    }
  return refusalOfFrames({frame}, targetOf(setup), {}, remarks);
}

TEST(PlaneSnapshots, FrictionAlongTheSliding_IsRefused) {
  EXPECT_EQ(refusalOfSliding(-5.0, 0.0, 40), "");
  expectSays(refusalOfSliding(5.0, 0.0, 40), {"mine.dump, step 7: in 40 of 40 contacts that slide",
                                              "along the sliding", "or the spin, the other sign?"});
  // Of disks that turn counter-clockwise the upper one's lower side moves to the right.
  EXPECT_EQ(refusalOfSliding(-5.0, 1.0, 40), "");
  EXPECT_NE(refusalOfSliding(5.0, 1.0, 40), "");
  // Too few; below the bound, where springs may push back; of another bound than the case's.
  EXPECT_EQ(refusalOfSliding(5.0, 0.0, 20), "");
  EXPECT_EQ(refusalOfSliding(4.0, 0.0, 40), "");
  std::vector<std::string> remarks;
  EXPECT_EQ(refusalOfSliding(5.0, 0.0, 40, 0.3, &remarks), "");
}

/// Three disks of which one leaves and another one comes.
TEST(PlaneSnapshots, ParticlesThatComeAndGo_AreThoseOfTheirTimes) {
  FileFrame fewer = threeParticles(2.0), other = threeParticles(3.0), none = threeParticles(4.0);
  const auto drop = [](FileFrame& frame, std::size_t row) {
    files::FileParticles& all = frame.particles;
    const auto at = static_cast<std::ptrdiff_t>(row);
    all.id.erase(all.id.begin() + at);
    all.radius.erase(all.radius.begin() + at);
    for (auto* list : {&all.position, &all.velocity, &all.spin}) list->erase(list->begin() + at);
  };
  drop(fewer, 1);  // 5, and its contact with 9
  for (auto* list : {&fewer.contacts->first, &fewer.contacts->second}) *list = {(*list)[1]};
  for (auto* list : {&fewer.contacts->normal, &fewer.contacts->force}) *list = {(*list)[1]};
  fewer.contacts->overlap = {0.02};
  other.particles.id = {12, 77, 9};
  for (auto* list : {&other.contacts->first, &other.contacts->second})
    std::ranges::replace(*list, 5, 77);
  for (int k = 0; k < 3; ++k) drop(none, 0);
  none.contacts.emplace();
  files::FileSceneOf<2> target = targetOf(restingDisks());
  PlaneSnapshots source = snapshotsOf({threeParticles(), fewer, other, none}, target);
  EXPECT_EQ(source.next()->position.size(), 3u);
  EXPECT_FALSE(source.disksChanged());
  Snapshot now = source.next().value();
  EXPECT_TRUE(source.disksChanged());
  EXPECT_EQ(now.position, (std::vector<Vec2>{{1.9, 2.0}, {4.0, 0.98}}));  // 9 and 12
  EXPECT_EQ(source.scene().disks.mass, (std::vector{2.0, 2.0}));
  EXPECT_EQ(now.contacts->i, std::vector<std::int32_t>{1});
  EXPECT_EQ(now.contacts->j, std::vector<std::int32_t>{2});  // the floor
  now = source.next().value();
  EXPECT_TRUE(source.disksChanged());
  EXPECT_EQ(now.position[2], Vec2(0.0, 2.0));                             // 77
  EXPECT_EQ(source.scene().disks.mass, (std::vector{2.0, 2.0, 2.0}));     // by the density
  EXPECT_EQ(source.scene().disks.inertia, (std::vector{1.0, 1.0, 1.0}));  // as the others
  EXPECT_EQ(source.next()->position.size(), 0u);
  EXPECT_FALSE(source.next());
  expectSays(source.remarks().at(1), {"particles come and go", "0 to 3 of them"});
  const auto refused = [&](const FileFrame& frame) {
    return refusalOfFrames({threeParticles(), frame}, target);
  };
  FileFrame without = other;
  without.particles.radius.clear();
  expectSays(refused(without), {"particle 77 was not there before", "no radii"});
  other.particles.id = {12, 9, 9};
  expectSays(refused(other), {"particle 9 is there twice"});
  target.needsAll = "the endpoint top is of disk 3";
  expectSays(refused(fewer), {"other particles than a time before (2 now, 3 then)",
                              "the endpoint top is of disk 3"});
}

TEST(PlaneSnapshots, FaultyParticles_AreRefused) {
  const std::pair<std::function<void(FileFrame&)>, std::vector<std::string>> faults[] = {
      {[](FileFrame& f) { f.particles.velocity[2].z() = 1.0; }, {"particle 9 moves along z"}},
      {[](FileFrame& f) { f.particles.spin[0].x() = 1.0; }, {"particle 12 spins"}},
      {[](FileFrame& f) { f.particles.id[2] = 5; }, {"particle 5 is there twice"}},
      {[](FileFrame& f) { f.time.reset(); }, {"neither a time nor a step"}},
      {[](FileFrame& f) {
         f.time.reset();
         f.step = 1000;
       },
       {"has a step and no time", "say dt", "[engines.mine]"}},
      {[](FileFrame& f) {
         f.box.emplace();
         f.box->low = Vec3(-0.5, -1.0, -1.0);
         f.box->high = Vec3(5.0, 5.0, 1.0);
         f.box->periodic[0] = f.box->periodic[2] = true;
       },
       {"particle 5 reaches over the periodic edge at x = -0.5"}}};
  for (const auto& [change, says] : faults) expectSays(refusalOfFrame(change), says);
}

TEST(PlaneSnapshots, ContactsOfOtherTimes_AreRefused) {
  expectSays(refusalOfFrame([](FileFrame& frame) {
               frame.contacts.reset();
               frame.contactsOfOtherTimes = "the last are of mine.local, step 6";
             }),
             {"mine.dump, step 7: there are no contacts of this time",
              "the last are of mine.local, step 6", "leave the files of contacts out"});
}

/// Three disks in flight: the first two falls of v Δt each, v = 1, 2, 3 m/s, and gravity between.
std::string motionOf(const std::function<void(FileFrame&)>& change, std::size_t times,
                     std::vector<std::string>* remarks = nullptr) {
  std::deque<FileFrame> frames;
  for (std::size_t k = 0; k < times; ++k) {
    const double t = 0.1 * static_cast<double>(k);
    FileFrame frame = threeParticles(1.0 + t);
    frame.contacts.reset();
    frame.particles.position = {{10.0, 30.0, 0.0}, {0.0, 40.0, 0.0}, {5.0, 50.0, 0.0}};
    for (std::size_t p = 0; p < 3; ++p) {
      const double v = 1.0 + static_cast<double>(p);
      frame.particles.position[p].y() -= v * t + 5.0 * t * t;
      frame.particles.velocity[p].y() = -v - 10.0 * t;
    }
    change(frame);
    frames.push_back(frame);
  }
  return refusalOfFrames(frames, targetOf(restingDisks()), {}, remarks);
}

TEST(PlaneSnapshots, WaysThatVelocitiesDoNotSay_AreRefusedWithTheirFactor) {
  const auto times = [](double factor) {
    return [factor](FileFrame& frame) {
      for (Vec3& v : frame.particles.velocity) v *= factor;
    };
  };
  std::vector<std::string> remarks;
  EXPECT_EQ(motionOf(times(1.0), 3, &remarks), "");
  EXPECT_EQ(remarks.size(), 2u);  // masses and contacts
  expectSays(motionOf(times(1e3), 2),
             {"3 disks that move have gone 0.001 times as far since the snapshot before",
              "velocities should be in the files' length per the files' time"});
  expectSays(motionOf(times(0.1), 2), {"gone 10 times as far"});
  // Any other factor may be chance, once; not twice.
  EXPECT_EQ(motionOf(times(0.25), 2, &remarks), "");
  expectSays(remarks.at(0), {"gone 3.38 times as far", "(root mean square)"});
  expectSays(motionOf(times(0.25), 3), {"gone 4 times as far"});
  // One of three that stands, and says so of itself, is no factor of all.
  EXPECT_EQ(motionOf(
                [](FileFrame& frame) {
                  for (std::size_t p = 0; p < 2; ++p) frame.particles.velocity[p] *= 1e-3;
                },
                3, &remarks),
            "");
}

/// Half and twice the time step: disks in flight know the time that has passed from their way and,
/// under the case's gravity, from their velocity.
TEST(PlaneSnapshots, TimesOffByTwo_AreRefusedInFlightAndAtEvenSpeed) {
  const auto flown = [](double stamps, double gravity, double from,
                        const std::vector<double>& bounce, double drive = 0.0) {
    std::deque<FileFrame> frames;
    for (std::size_t k = 0; k < 4; ++k) {
      const double t = 0.1 * static_cast<double>(k);
      FileFrame frame = threeParticles(stamps * t);
      frame.contacts.reset();
      for (std::size_t p = 0; p < 3; ++p) {
        const double v = 1.0 + static_cast<double>(p);
        frame.particles.position[p] = {4.0 * static_cast<double>(p),
                                       40.0 - v * t - 0.5 * gravity * t * t, 0.0};
        if (!bounce.empty()) frame.particles.position[p].y() = 40.0 - bounce[k] * v;
        frame.particles.velocity[p] = {0.0, -v - gravity * t, 0.0};
      }
      frames.push_back(frame);
    }
    files::FileSceneOf<2> target = targetOf(restingDisks());
    target.gravity = {0.0, -gravity};
    target.from = from;
    for (WallBody& body : target.bodies) body.motion.frequency = drive;
    return refusalOfFrames(frames, target);
  };
  for (const double gravity : {0.0, 10.0}) {
    EXPECT_EQ(flown(1.0, gravity, 0.0, {}), "");
    expectSays(flown(2.0, gravity, 0.0, {}), {"3 disks that move have gone 0.5 times as far"});
    expectSays(flown(0.5, gravity, 0.0, {}), {"gone 2 times as far"});
    // Also where the case averages only what comes later.
    expectSays(flown(2.0, gravity, 0.5, {}), {"gone 0.5 times as far"});
    EXPECT_EQ(flown(1.0, gravity, 0.25, {}), "");
  }
  // Once is chance; and walls may drive what is seen at one phase of theirs only.
  EXPECT_EQ(flown(1.0, 0.0, 0.0, {0.0, 0.05, 0.13, 0.2}), "");
  expectSays(flown(1.0, 0.0, 0.0, {0.0, 0.05, 0.1, 0.15}), {"gone 0.5 times as far"});
  EXPECT_EQ(flown(1.0, 0.0, 0.0, {0.0, 0.05, 0.1, 0.15}, 60.0), "");
}

TEST(PlaneSnapshots, ForcesOfAnotherUnit_AreHintedAt) {
  std::vector<std::string> remarks;
  firstOf(
      [](FileFrame& f) {
        for (Vec3& force : f.contacts->force) force *= 1e6;
      },
      {}, &remarks);
  expectSays(remarks.at(0), {"not those of the case's law",
                             "most normal forces are 1e+06 times those of the law: are they in "
                             "another unit?"});
}

TEST(PlaneSnapshots, ForcesOfAnotherLaw_AreRemarked) {
  std::vector<std::string> remarks;
  firstOf([](FileFrame& f) { f.contacts->force[0].y() = 7.0, f.contacts->force[2].y() = -7.0; }, {},
          &remarks);
  expectSays(remarks.at(0), {"not those of the case's law", "|f_t| is 7 N, the law allows 5 N"});
}

TEST(PlaneSnapshots, Times_AreThoseOfTheAveragedPart) {
  files::FileUnits units;
  units.dt = 0.01;
  const auto at = [](std::int64_t step) {
    FileFrame frame = threeParticles();
    frame.time.reset();
    frame.step = step;
    return frame;
  };
  files::FileSceneOf<2> target = targetOf(restingDisks());
  target.from = 1.0;
  target.to = 3.0;
  PlaneSnapshots source = snapshotsOf({at(0), at(100), at(200), at(300), at(400)}, target, units);
  std::vector<double> times;
  while (const auto now = source.next()) times.push_back(now->positionTime);
  // As engines are averaged: the instant that averaging begins at is not of it, its end is.
  EXPECT_EQ(times, (std::vector{2.0, 3.0}));
  expectSays(source.remarks().back(), {"2 snapshots up to 1 s and 1 after 3 s are left out"});
  const auto timesOf = [&](std::deque<FileFrame> frames) {
    PlaneSnapshots own = snapshotsOf(std::move(frames), target, units);
    std::vector<double> found;
    while (const auto now = own.next()) found.push_back(now->positionTime);
    return found;
  };
  // Six digits of a time, and half a step of the case's, are the instant, however far apart files
  // are.
  const auto timed = [](double t) { return threeParticles(t); };
  EXPECT_EQ(timesOf({timed(0.999999), timed(1.000001), timed(2.0), timed(3.000002)}),
            (std::vector{2.0, 3.000002}));
  EXPECT_EQ(timesOf({timed(1.0004), timed(1.0006), timed(3.0004), timed(3.0006)}),
            (std::vector{1.0006, 3.0004}));
  // Nothing else is there: a single snapshot is of the instant that it is of.
  EXPECT_EQ(timesOf({timed(0.5), timed(1.0)}), (std::vector{1.0}));
  EXPECT_EQ(timesOf({timed(1.0), timed(3.5)}), (std::vector{1.0}));
  const auto refused = [&](const std::deque<FileFrame>& frames) {
    return refusalOfFrames(frames, target, units);
  };
  expectSays(refused({at(1), at(2)}), {"no snapshot lies between 1 and 3 s", "0.02 s"});
  expectSays(refused({at(200), at(200)}), {"not after the one before"});
}

/// A single file without a time: a number in its name is a step only if that is averaged.
TEST(PlaneSnapshots, LoneFileWithoutATime_IsOfTheEnd) {
  files::FileSceneOf<2> target = targetOf(restingDisks());
  target.from = 1.0;
  target.to = 3.0;
  const auto timeBy = [&](std::optional<std::int64_t> number, double dt, const char* says) {
    FileFrame frame = threeParticles();
    frame.time.reset();
    frame.step = number;
    frame.alone = true;
    files::FileUnits units;
    units.dt = dt;
    PlaneSnapshots source = snapshotsOf({frame}, target, units);
    const double t = source.next().value().positionTime;
    expectSays(lines(source.remarks()), {"says no time", says});
    return t;
  };
  EXPECT_EQ(timeBy({}, 0.0, "of the end of the averaged time, t = 3 s"), 3.0);
  EXPECT_EQ(timeBy(2, 0.0, "of the end of the averaged time, t = 3 s"), 3.0);
  EXPECT_EQ(timeBy(2, 1e-3, "of the end of the averaged time, t = 3 s"), 3.0);
  EXPECT_EQ(timeBy(2000, 1e-3, "step 2000 by its name, t = 2 s"), 2.0);
}

/// Later snapshots must have the same data as the first averaged one.
TEST(PlaneSnapshots, WhatLaterSnapshotsLack_IsRefused) {
  const auto refused = [](const std::function<void(FileFrame&)>& change, bool first = false) {
    std::deque<FileFrame> frames;
    for (int k = 1; k <= 3; ++k) frames.push_back(threeParticles(k));
    change(first ? frames[0] : frames[2]);
    return refusalOfFrames(frames);
  };
  const auto withoutDirection = [](FileFrame& f) {
    f.contacts->force.clear();
    f.contacts->normalForce = {10.0, 2.0, 10.0};
  };
  EXPECT_EQ(refused([](FileFrame&) {}), "");
  expectSays(refused([](FileFrame& f) { f.particles.velocity.clear(); }),
             {"it has no velocities, the first snapshot has"});
  expectSays(refused([](FileFrame& f) { f.particles.spin.clear(); }), {"it has no spins"});
  expectSays(refused([](FileFrame& f) { f.particles.spin.clear(); }, true),
             {"it has spins, the first averaged snapshot has none"});
  expectSays(refused(withoutDirection), {"it has no contacts with forces and their directions"});
  expectSays(refused(withoutDirection, true), {"it has contacts with forces"});
  expectSays(refused([](FileFrame& f) { f.particles.radius[0] = 1.1; }),
             {"particle 12 has radius 1.1 m, in the first snapshot 1 m"});
}

/// Of a law with friction forces along the normal alone are half of what is averaged; of one
/// without they are all of it.
TEST(PlaneSnapshots, NormalForcesAlone_AreThoseOfALawWithoutFriction) {
  const auto contacts = [](bool friction) {
    Case setup = restingDisks();
    if (!friction) setup.law.tangential = TangentialLaw::none;
    FileFrame frame = threeParticles();
    frame.contacts->force.clear();
    frame.contacts->normalForce = {10.0, 2.0, 10.0};
    PlaneSnapshots source = snapshotsOf({frame}, targetOf(setup));
    const bool found = source.next()->contacts.has_value();
    EXPECT_EQ(source.remarks().back().starts_with("no tangential forces in the files"), !found);
    return found;
  };
  EXPECT_FALSE(contacts(true));
  EXPECT_TRUE(contacts(false));
}

/// Along the plane's axes, and of spins across it.
TEST(PlaneSnapshots, MissingComponents_AreThoseOfThePlane) {
  const auto lack = [](const char* column, int axis, bool axial) {
    return [=](FileFrame& f) { f.particles.missing = {{column, axis, axial}}; };
  };
  EXPECT_EQ(refusalOfFrame(lack("vz", 2, false)), "");
  expectSays(refusalOfFrame(lack("vx", 0, false)),
             {"there is no column vx", "plane = \"xy\" takes x and y of the files"});
  EXPECT_TRUE(firstOf(lack("spin_x", 0, true)).spin);
  std::vector<std::string> remarks;
  EXPECT_FALSE(firstOf(lack("spin_z", 2, true), {}, &remarks).spin);
  expectSays(remarks.back(), {"no spin_z in the files"});
  expectSays(refusalOfFrame([](FileFrame& f) {
               f.contacts->missing = {{"fy", 1, false}};
             }),
             {"its contacts have no column fy"});
}

/// Contacts deeper than half a radius are of the plane that has their normal.
TEST(PlaneSnapshots, WallContacts_MayBeDeep) {
  const Snapshot now = firstOf([](FileFrame& f) {
    f.particles.position[0].y() = 0.3;
    f.contacts->overlap[1] = 0.7;
    f.contacts->force[1].y() = 70.0;
  });
  EXPECT_EQ(now.contacts->j[1], 3);
  EXPECT_NEAR(now.contacts->overlap[1], 0.7, 1e-15);
}

/// One velocity among others: none that crosses the scene in a step, and a note where it stands out
/// and the particle did not go that way.
TEST(PlaneSnapshots, OneVelocity_IsRefusedOrRemarked) {
  const auto fast = [](double speed, double after = 1.15) {
    return [=](FileFrame& frame) {
      if (*frame.time > after) frame.particles.velocity[0].x() = speed;
    };
  };
  std::vector<std::string> remarks;
  for (const double speed : {1e308, 1e150, 1e8})
    for (const double after : {0.0, 1.15})
      expectSays(motionOf(fast(speed, after), 3),
                 {"particle 12 has a velocity of", "within a step of"});
  EXPECT_EQ(motionOf(fast(1000.0), 3, &remarks), "");
  expectSays(lines(remarks),
             {"particle 12 has a velocity of 1e+03 m/s, no other one of more than"});
}

/// Hertz: places of six digits say no overlap, the file's own has the force of the law.
TEST(PlaneSnapshots, ForcesOfTheShownOverlaps_AreOfTheLaw) {
  Case setup = restingDisks();
  setup.law.normal = NormalLaw::hertz;
  setup.law.kn = 1e6;
  const auto remarksAt = [&](double overlap, double force, bool shown) {
    FileFrame frame = threeParticles();
    frame.particles.position = {
        {4.00001, 30.00002, 0.0}, {1.00003, 10.00001, 0.0}, {3.00003, 10.00001, 0.0}};
    auto& contacts = *frame.contacts;
    contacts.first = {9};
    contacts.second = {5};
    contacts.normal = {{1.0, 0.0, 0.0}};
    contacts.force = {{force, 0.0, 0.0}};
    contacts.overlap = {overlap};
    if (!shown) contacts.overlap.clear();
    PlaneSnapshots source = snapshotsOf({frame}, targetOf(setup));
    source.next();
    const bool remarked =
        lines(source.remarks()).find("not those of the case's law") != std::string::npos;
    EXPECT_EQ(source.hasOtherLaw(), remarked);
    return remarked;
  };
  // f = k_n √R₁₂ δ^1.5, with R₁₂ = 0.5 m.
  const auto byLaw = [](double overlap) { return 1e6 * std::sqrt(0.5) * std::pow(overlap, 1.5); };
  EXPECT_FALSE(remarksAt(1.23456e-5, byLaw(1.23456e-5), true));
  EXPECT_TRUE(remarksAt(1.23456e-5, 1.01 * byLaw(1.23456e-5), true));
  // Places alone leave some 10⁻⁴ m open: any force of that is the law's, a larger one is not.
  EXPECT_FALSE(remarksAt(0.0, byLaw(1.23456e-5), false));
  EXPECT_TRUE(remarksAt(0.0, byLaw(1e-2), false));
}

TEST(PlaneSnapshots, SixDigits_WidenWhatGeometryMayBeOffBy) {
  const auto rounded = [](FileFrame& frame) {  // 1.9 + 1e-6 and its like are gone
    for (Vec3& x : frame.particles.position) x += Vec3(0.123456, 0.0, 0.0);
    frame.particles.position[2].x() -= 9e-6;
    for (Vec3& x : frame.particles.position)
      for (double& each : x) each = std::strtod(fmt::format("{:.6g}", each).c_str(), nullptr);
  };
  std::vector<std::string> remarks;
  firstOf(rounded, {}, &remarks);
  expectSays(remarks.back(), {"few digits", "m"});
}

/// Of the quick cell with one disk: a wheel that has turned by a third of its spacing.
TEST(PlaneSnapshots, WallDisksOfACell_AreFoundAtAnyAngle) {
  const Case setup = test::quickCell({"particles.small=1", "particles.large=0"});
  FileFrame frame{.where = "cell.dump, step 0", .time = 0.5};
  const double turned = 0.05 + 0.5 * couetteIn(setup).cell.omega;
  std::int64_t id = 100;
  const auto add = [&](const Vec2& x, double a) {
    frame.particles.id.push_back(id--);
    frame.particles.position.emplace_back(x.x(), x.y(), 0.0);
    frame.particles.radius.push_back(a);
    frame.particles.velocity.push_back(Vec3::Zero());
  };
  for (const auto& [radius, angle] : {std::pair(couetteIn(setup).cell.innerRadius, turned),
                                      {couetteIn(setup).cell.outerRadius, 0.02}})
    for (const Vec2& x : wallRing("", couetteIn(setup).cell, radius, angle).diskPosition)
      add(x, couetteIn(setup).cell.wallRadius);
  add({0.05, 0.0}, couetteIn(setup).particles.smallRadius);
  FileFrame later = frame;
  later.time = 0.75;
  PlaneSnapshots source = snapshotsOf({frame, later}, targetOf(setup));
  EXPECT_EQ(source.scene().disks.size(), 1u);
  const Snapshot first = source.next().value(), second = source.next().value();
  EXPECT_EQ(first.position, (std::vector<Vec2>{{0.05, 0.0}}));
  // Walls are where the case prescribes them, whatever a file makes of them.
  const auto angleOf = [](const Vec2& x) { return std::atan2(x.y(), x.x()); };
  const double spacing = 2.0 * std::numbers::pi /
                         wallDiskCount(couetteIn(setup).cell, couetteIn(setup).cell.innerRadius);
  EXPECT_NEAR(std::remainder(angleOf(first.wallPosition[0]) - turned, spacing), 0.0, 1e-12);
  EXPECT_NEAR(angleOf(second.wallPosition[0]) - angleOf(first.wallPosition[0]),
              0.25 * couetteIn(setup).cell.omega, 1e-12);
  EXPECT_EQ(first.bodies[0].angularVelocity, couetteIn(setup).cell.omega);
}

TEST(PlaneSnapshots, WallDisksOfAnAssembly_AreAllThereOrNone) {
  Case setup = restingDisks();
  WallGroup row{.position = {{-1.5, 5.0}, {0.5, 5.0}}, .radius = 0.5};
  row.motion.kind = Motion::Kind::translating;
  row.motion.velocity = {0.25, 0.0};
  assemblyIn<2>(setup).walls.push_back(row);
  const auto opened = [&](const std::vector<Vec3>& walls) {
    FileFrame frame = threeParticles(2.0);
    for (std::size_t k = 0; k < walls.size(); ++k) {
      frame.particles.id.push_back(static_cast<std::int64_t>(1 + k));
      frame.particles.position.push_back(walls[k]);
      frame.particles.radius.push_back(0.5);
      frame.particles.velocity.emplace_back(0.25, 0.0, 0.0);
      frame.particles.spin.push_back(Vec3::Zero());
    }
    return snapshotsOf({frame}, targetOf(setup)).next().value();
  };
  for (const auto& walls : {std::vector<Vec3>{}, {{1.0, 5.0, 0.0}, {-1.0, 5.0, 0.0}}}) {
    const Snapshot now = opened(walls);  // both have moved by half a metre
    EXPECT_EQ(now.position.size(), 3u);
    EXPECT_EQ(now.wallPosition, (std::vector<Vec2>{{-1.0, 5.0}, {1.0, 5.0}}));
    EXPECT_EQ(now.contacts->j, (std::vector<std::int32_t>{1, 5}));  // the floor, behind them
  }
  expectSays(test::refusalOf([&] {
               opened({{1.0, 5.0, 0.0}, {-1.5, 5.0, 0.0}});
             }),
             {"1 of the 2 wall disks of wall-1"});
}

TEST(CoveredTime, Gap_IsWhereAnotherSnapshotWasDue) {
  FlowTimes wanted;  // every 0.01 s from 0.61 to 0.8 s
  wanted.settled = 0.6;
  wanted.samples = 20;
  wanted.interval = 0.01;
  const auto gap = [&](double from, double to, double apart, const std::set<int>& without = {}) {
    CoveredTime covered(wanted);
    for (int k = 0; from + k * apart <= to + 1e-9; ++k)
      if (!without.contains(k)) covered.add(from + k * apart);
    return covered.gap();
  };
  for (const double apart : {0.01, 0.002, 0.04})
    EXPECT_EQ(gap(0.6 + apart, 0.8, apart), "") << apart;
  EXPECT_EQ(gap(0.6, 0.8, 0.01), "");
  EXPECT_EQ(gap(0.605, 0.795, 0.001), "");  // nearer than the case asks for
  EXPECT_EQ(gap(0.6, 0.78, 0.03), "");      // the next one is due at 0.81 s
  EXPECT_EQ(gap(0.6, 0.68, 0.01),
            "9 snapshots cover 0.6 to 0.68 s; the case averages 0.6 to 0.8 s");
  EXPECT_EQ(gap(0.65, 0.8, 0.01),
            "16 snapshots cover 0.65 to 0.8 s; the case averages 0.6 to 0.8 s");
  EXPECT_EQ(gap(0.8, 0.8, 1.0), "a single snapshot, of 0.8 s; the case averages 0.6 to 0.8 s");
  EXPECT_EQ(gap(0.61, 0.8, 0.01, {5, 6, 7}),
            "no snapshot between 0.65 and 0.69 s; the case averages 0.6 to 0.8 s");
}

/// Disks that leave through an open border before the averaged time and within it.
TEST(ResultFiles, ParticlesThatLeave_CountWhileTheyAreThere) {
  const TemporaryFolder folder;
  Case setup = restingDisks();
  setup.file = "open.toml";
  setup.region->from = 0.5;
  const auto write = [&](const char* name, const std::string& rows) {
    std::ofstream(folder.path() / name) << "t,id,x,y,radius,mass,vx,vy,spin\n" << rows;
    return folder.path() / name;
  };
  const std::string five = ",5,0,2,1,2,1,0,0\n", nine = ",9,1.9,2,1,2,1,0,0\n",
                    twelve = ",12,4,1.5,1,2,0,0,0\n", later = ",5,1,2,1,2,1,0,0\n";
  const auto file = write(
      "a.csv", "0" + five + "0" + nine + "0" + twelve + "1" + later + "1" + twelve + "2" + twelve);
  const CompareResults results = averageSnapshots(setup, {file}, "test");
  // Disks in the region, of 8 × 4 m × 0.5 m: two, then one of 2 kg each.
  EXPECT_EQ(results.runs.at(0).series->at("disks"), (std::vector<std::optional<double>>{2.0, 1.0}));
  const Profile* density = profileOf(results.runs.at(0).profiles, "density");
  ASSERT_TRUE(density);
  EXPECT_NEAR(density->mean[0].value(), 1.5 * 2.0 / 16.0, 1e-14);
  // Kinetic energies of 1 J and 0.
  EXPECT_EQ(results.runs.at(0).series->at("kinetic_energy"),
            (std::vector<std::optional<double>>{1.0, 0.0}));
  EXPECT_TRUE(std::ranges::any_of(results.notes, [](const std::string& note) {
    return note.find("particles come and go: each snapshot counts those that are there, 1 to 2") !=
           std::string::npos;
  }));
  // Of another number throughout: the case is another one.
  const auto other = write("b.csv", "0" + five + "0" + nine + "1" + later + "1" + nine);
  expectSays(test::refusalOf([&] { averageSnapshots(setup, {other}, "test"); }),
             {"2 disks, not 3"});
}

class AssemblyFiles : public testing::Test {
 protected:
  /// Snapshots of the three disks, k of them with forces of that size between the two.
  std::filesystem::path write(const char* name, double force, const std::string& engine = "mine") {
    const Scene scene = assemblyScene(setup_, assemblyDisks(setup_, 0), 0.0, 1e-3);
    const std::filesystem::path path = folder_.path() / name;
    SnapshotFile out(path, engine, scene, 1, 1);
    PlaneSnapshots source =
        snapshotsOf({threeParticles(1.0), threeParticles(2.0)}, targetOf(setup_));
    for (int k = 1; auto now = source.next(); ++k) {
      now->contacts->normalForce[0] = force;
      out.offer(*now, k);
    }
    out.close();
    return path;
  }

  const TemporaryFolder folder_;
  Case setup_ = restingDisks();
};

TEST_F(AssemblyFiles, OneFile_HasTheVirialStress) {
  const CompareResults results = averageSnapshots(setup_, {write("a.h5", 10.0)}, "test");
  // Both disks of the pair have f_x l_x = −10 N · 1 m, in 16 m³.
  const Profile* stress = profileOf(results.runs.at(0).profiles, "stress_xx");
  ASSERT_TRUE(stress);
  EXPECT_NEAR(stress->mean[0].value(), 20.0 / 16.0, 1e-14);
  EXPECT_TRUE(results.ensemble.empty());
  EXPECT_EQ(results.averaging.snapshots, 2);
  expectSays(results.notes.back(), {"2 snapshots cover 1 to 2 s; the case averages 0 to 4 s"});
  EXPECT_EQ(results.engines[0].name, "mine");
}

TEST_F(AssemblyFiles, SeveralRuns_AreReplicates) {
  const CompareResults results =
      averageSnapshots(setup_, {write("a.h5", 10.0), write("b.h5", 13.0)}, "test");
  ASSERT_EQ(results.ensemble.size(), 1u);
  const Profile* stress = profileOf(results.ensemble[0].profiles, "stress_xx");
  ASSERT_TRUE(stress);
  // Of 20/16 and 26/16: the mean 23/16, its error |26 − 20|/16 / 2.
  EXPECT_NEAR(stress->mean[0].value(), 23.0 / 16.0, 1e-14);
  EXPECT_NEAR(stress->standardError[0].value(), 3.0 / 16.0, 1e-14);
  const CompareResults back = fromJson<CompareResults>(toJson(results));
  EXPECT_EQ(back.ensemble.size(), 1u);
  expectSays(
      test::refusalOf([&] {
        averageSnapshots(setup_, {write("a.h5", 10.0), write("c.h5", 13.0, "theirs")}, "test");
      }),
      {"a.h5 is of mine", "c.h5 is of theirs", "one engine"});
}

TEST_F(AssemblyFiles, SnapshotsOutsideOfTheAveragedTime_AreLeftOut) {
  const auto path = write("a.h5", 10.0);  // of 1 s and of 2 s
  setup_.region->from = 1.5;
  const CompareResults results = averageSnapshots(setup_, {path}, "test");
  EXPECT_EQ(results.averaging.snapshots, 1);
  ASSERT_GE(results.notes.size(), 2u);
  expectSays(results.notes.end()[-2], {"1 of 2 snapshots", "left out"});
  expectSays(results.notes.back(), {"a single snapshot, of 2 s; the case averages 1.5 to 4 s"});
  setup_.region->from = 3.0;
  expectSays(test::refusalOf([&] { averageSnapshots(setup_, {path}, "test"); }),
             {"a.h5", "none of its snapshots"});
}

/// Copies are one run, and said to be; runs of the same places with other forces are two.
TEST_F(AssemblyFiles, Copies_AreOneRun) {
  const auto first = write("a.h5", 10.0), rounded = write("b.h5", 10.0 * (1.0 + 4e-6));
  std::filesystem::copy_file(first, folder_.path() / "c.h5");
  const CompareResults results = averageSnapshots(
      setup_, {first, rounded, folder_.path() / "c.h5", write("d.h5", 13.0)}, "test");
  EXPECT_EQ(results.runs.size(), 2u);
  ASSERT_GE(results.notes.size(), 3u);
  expectSays(results.notes[1], {"b.h5 has the snapshots of", "a.h5", "both are one run"});
  expectSays(results.notes[2], {"c.h5 has the snapshots of", "a.h5"});
  EXPECT_TRUE(averageSnapshots(setup_, {first, rounded}, "test").ensemble.empty());
}

TEST_F(AssemblyFiles, SameFileTwice_IsRefused) {
  const auto path = write("a.h5", 10.0);
  const auto refused = [&](const std::filesystem::path& other) {
    return test::refusalOf([&] { averageSnapshots(setup_, {path, other}, "test"); });
  };
  EXPECT_EQ(refused(path), path.string() + ": the file is named twice");
  const auto link = folder_.path() / "b.h5";
  std::filesystem::create_symlink(path, link);
  EXPECT_EQ(refused(link), path.string() + " and " + link.string() + " are the same file");
  expectSays(refused(folder_.path() / "." / "a.h5"), {"are the same file"});
}

TEST_F(AssemblyFiles, OtherScene_IsRefused) {
  const auto path = write("a.h5", 10.0);
  const auto refused = [&](const std::function<void(Case&)>& change) {
    Case other = setup_;
    change(other);
    return test::refusalOf([&] { averageSnapshots(other, {path}, "test"); });
  };
  expectSays(refused([](Case& c) { assemblyIn<2>(c).disks[0].places.pop_back(); }),
             {"a.h5 does not fit", "3 disks, not 2"});
  expectSays(refused([](Case& c) { assemblyIn<2>(c).disks[0].radius = 1e-3; }),
             {"disk 0 of radius 1 m, not 0.001 m", "are lengths in mm?"});
  expectSays(refused([](Case& c) { assemblyIn<2>(c).disks[0].mass = 2e-3; }),
             {"disk 0 of mass 2 kg, not 0.002 kg", "are masses in g?"});
  expectSays(refused([](Case& c) {
               assemblyIn<2>(c).walls[0].planes[0].point = {0.0, 0.5};
             }),
             {"a.h5, snapshot 0", "from the positions"});
  EXPECT_EQ(refused([](Case& c) { assemblyIn<2>(c).disks[0].radiusSpread = 0.2; }), "");
}

}  // namespace
}  // namespace crossgrain
