// load, advance, snapshot, load again: what every run relies on.
#include <cmath>

#include "tests/conformance/conformance.hpp"

namespace crossgrain::test {
namespace {

TEST_P(Conformance, AdvancesByWholeSteps) {
  const Scene scene = simplified(busyScene(law()));
  if (const auto why = refused(scene)) GTEST_SKIP() << *why;
  const double dt = realised_.dt;
  const Tolerance rounding = {0.0, 1e-12, "steps·dt in one order of additions or another"};
  for (const double steps : {0.0, 0.3, 1.0, 10.4, 10.6, 11.0, 40.0}) {
    const double reached = engine().advance(steps * dt);
    const auto whole = static_cast<double>(std::llround(steps));
    EXPECT_TRUE(close(reached, whole * dt, rounding)) << "advance to " << steps << " steps";
    EXPECT_EQ(engine().stats().steps, static_cast<std::uint64_t>(whole));
    const Snapshot now = engine().snapshot(ContactReport::none);
    const Tolerance step = {1.001 * dt, 0.0, "arrays may be staggered by up to a step"};
    EXPECT_TRUE(close(now.positionTime, reached, rounding));
    EXPECT_TRUE(close(now.velocityTime, reached, step));
    EXPECT_TRUE(close(now.contactTime, reached, step));
    EXPECT_FALSE(now.contacts) << "not asked for";
  }
  engine().advance(busyEnd);
  const Stats stats = engine().stats();
  EXPECT_GT(stats.contactEvaluations, 0u);
  EXPECT_GT(stats.wallSeconds, 0.0);
  EXPECT_GT(stats.cpuSeconds, 0.0);
}

TEST_P(Conformance, StartIsTheScene) {
  const Scene scene = simplified(busyScene(law()));
  if (const auto why = refused(scene)) GTEST_SKIP() << *why;
  const Snapshot start = engine().snapshot(ContactReport::none);
  const Tolerance rounding = byPrecision(1e-15, 1e-7, "the given numbers, rounded once");
  ASSERT_EQ(start.position.size(), scene.disks.size());
  ASSERT_EQ(start.velocity.size(), scene.disks.size());
  for (std::size_t i = 0; i < scene.disks.size(); ++i) {
    EXPECT_TRUE(close(start.position[i], scene.disks.position[i], rounding));
    EXPECT_TRUE(close(start.velocity[i],
                      scene.disks.velocity[i] + start.velocityTime * scene.gravity, rounding));
    EXPECT_TRUE(close(spinsOf(scene, start)[i], scene.disks.spin[i], rounding));
  }
  ASSERT_EQ(start.bodies.size(), scene.bodies.size());
  ASSERT_EQ(start.wallPosition.size(), scene.wallDiskCount());
  std::size_t k = 0;
  for (const WallBody& body : scene.bodies)
    for (const Vec2& position : body.diskPosition)
      EXPECT_TRUE(close(start.wallPosition[k++], position, rounding));
}

TEST_P(Conformance, HalfwayStopsChangeNothing) {
  const Scene scene = simplified(busyScene(law()));
  if (const auto why = refused(scene)) GTEST_SKIP() << *why;
  const Snapshot once = at(busyEnd);
  ASSERT_TRUE(once.contacts && once.contacts->size() > 0) << "nothing happens in this scene";
  ASSERT_FALSE(refused(scene));
  engine().advance(0.37 * busyEnd);
  engine().advance(0.5 * busyEnd);
  EXPECT_TRUE(sameBits(at(busyEnd), once));
}

TEST_P(Conformance, LookingChangesNothing) {
  const Scene scene = simplified(busyScene(law()));
  if (const auto why = refused(scene)) GTEST_SKIP() << *why;
  const Snapshot unseen = at(busyEnd);
  ASSERT_FALSE(refused(scene));
  for (int look = 0; look < 20; ++look) {
    engine().advance(busyEnd * look / 20);
    engine().snapshot(ContactReport::none);
    if (can_.instantContacts) engine().snapshot(ContactReport::instant);
    if (can_.accumulatedContacts) engine().snapshot(ContactReport::accumulated);
    engine().stats();
  }
  const Snapshot seen = at(busyEnd);
  if (contactReport() == ContactReport::accumulated) {
    EXPECT_EQ(seen.position, unseen.position);  // each look begins another interval
  } else {
    EXPECT_TRUE(sameBits(seen, unseen));
  }
  EXPECT_TRUE(
      sameBits(engine().snapshot(ContactReport::none), engine().snapshot(ContactReport::none)));
}

TEST_P(Conformance, LoadingStartsAfresh) {
  const Scene scene = simplified(busyScene(law()));
  if (const auto why = refused(scene)) GTEST_SKIP() << *why;
  const Snapshot first = at(busyEnd);
  const Stats stats = engine().stats();
  const Scene other = encounterScene(crookedEncounter(), law(), 37.0);
  ASSERT_FALSE(refused(other));
  at(Encounter::end);
  ASSERT_FALSE(refused(scene));
  EXPECT_EQ(engine().stats().steps, 0u);
  EXPECT_TRUE(sameBits(at(busyEnd), first));
  EXPECT_EQ(engine().stats().steps, stats.steps);
  EXPECT_EQ(engine().stats().contactEvaluations, stats.contactEvaluations);
}

TEST_P(Conformance, WorkersAgreeBitForBit) {
  const Scene scene = simplified(busyScene(law()));
  if (const auto why = refused(scene)) GTEST_SKIP() << *why;
  const Snapshot here = at(busyEnd);
  const auto other = startWorker(*entry_);
  other->load(scene, {});
  other->advance(busyEnd);
  EXPECT_TRUE(sameBits(other->snapshot(contactReport()), here));
}

}  // namespace
}  // namespace crossgrain::test
