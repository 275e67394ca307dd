#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>
#include <tuple>

#include "tests/unit/grain_packed.hpp"
#include "tests/unit/grain_sheared.hpp"

// Allocations of the engine: none once started, and none for effects that a scene does not call
// for. This program's operator new counts.

namespace {

std::atomic<std::size_t> allocations{0};

/// The size is kept before the block, to be subtracted when it goes.
std::atomic<std::size_t> liveBytes{0};
constexpr std::size_t head = 64;

void* allocate(std::size_t size) {
  void* block = std::aligned_alloc(head, head + (size + head - 1) / head * head);
  if (block == nullptr) throw std::bad_alloc();
  *static_cast<std::size_t*>(block) = size;
  ++allocations;
  liveBytes += size;
  return static_cast<char*>(block) + head;
}

void release(void* p) {
  if (p == nullptr) return;
  void* block = static_cast<char*>(p) - head;
  liveBytes -= *static_cast<std::size_t*>(block);
  std::free(block);
}

}  // namespace

void* operator new(std::size_t size) {
  return allocate(size);
}
void* operator new(std::size_t size, std::align_val_t) {
  return allocate(size);
}
void operator delete(void* p) noexcept {
  release(p);
}
void operator delete(void* p, std::size_t) noexcept {
  release(p);
}
void operator delete(void* p, std::align_val_t) noexcept {
  release(p);
}
void operator delete(void* p, std::size_t, std::align_val_t) noexcept {
  release(p);
}

namespace {

using namespace grain;
namespace test = crossgrain::test;

/// Allocations of `steps` steps once the run has warmed up.
std::size_t allocationsOf(const grain::Setup& setup, std::uint64_t warmUp, std::uint64_t steps) {
  Simulation simulation(setup);
  simulation.advance(warmUp);
  const std::size_t rebuilds = simulation.neighbours().rebuilds;
  const std::size_t before = allocations;
  simulation.advance(steps);
  const std::size_t made = allocations - before;
  EXPECT_GT(simulation.neighbours().rebuilds, rebuilds);  // else there was little to allocate for
  return made;
}

TEST(Allocation, IsSeenByThisProgram) {
  const std::size_t before = allocations, bytes = liveBytes;
  {
    std::vector<double> some(100);
    Array<double> aligned(100);
    EXPECT_EQ(allocations, before + 2);
    EXPECT_EQ(liveBytes, bytes + 1600);
  }
  EXPECT_EQ(liveBytes, bytes);
}

class SteadyState : public testing::TestWithParam<std::tuple<Precision, Integrator, int>> {
 protected:
  grain::Setup scene() const {
    grain::Setup setup = test::packed(10, 6);
    std::tie(setup.precision, setup.law.conventions.integrator, setup.threads) = GetParam();
    setup.bottom = test::thesisBottom<BottomPlate>(2e-3);
    setup.skin = 0.1 * test::smallRadius;
    return setup;
  }

  /// Lists may still find a new largest size after the warm-up. They double then, so this is some
  /// few times in a run of any length, for each part's lists; once a rebuild would be hundreds of
  /// times.
  std::size_t someGrowth() { return 12 * static_cast<std::size_t>(std::get<int>(GetParam())); }
};

INSTANTIATE_TEST_SUITE_P(Schemes, SteadyState,
                         testing::Combine(testing::Values(Precision::float64, Precision::float32),
                                          testing::Values(Integrator::positionVerlet,
                                                          Integrator::velocityVerlet,
                                                          Integrator::semiImplicitEuler),
                                          testing::Values(1)));
INSTANTIATE_TEST_SUITE_P(TwoThreads, SteadyState,
                         testing::Combine(testing::Values(Precision::float64, Precision::float32),
                                          testing::Values(Integrator::velocityVerlet),
                                          testing::Values(2)));

TEST_P(SteadyState, AllocatesNothingOverStepsAndRebuilds) {
  EXPECT_LE(allocationsOf(scene(), 2000, 1000), someGrowth());
}

TEST_P(SteadyState, AllocatesNothingOverASecondRenumbering) {
  EXPECT_LE(allocationsOf(scene(), 16000, 500), someGrowth());
}

/// Memory that a simulation holds at its beginning, or after some steps [bytes].
template <class Run = Simulation>
std::size_t bytesHeld(const auto& setup, std::uint64_t steps = 0) {
  const Run first(setup);  // what the program keeps from then on is not this scene's
  const std::size_t before = liveBytes;
  Run simulation(setup);
  simulation.advance(steps);
  return liveBytes - before;
}

class AbsentEffects : public testing::TestWithParam<Precision> {
 protected:
  static grain::Setup scene() {
    grain::Setup setup = test::packed(20, 6);
    setup.precision = GetParam();
    setup.skin = 0.2 * test::smallRadius;
    return setup;
  }
  static std::size_t real() { return GetParam() == Precision::float64 ? 8 : 4; }
};

INSTANTIATE_TEST_SUITE_P(Precisions, AbsentEffects,
                         testing::Values(Precision::float64, Precision::float32));

TEST_P(AbsentEffects, BlockedRotationHoldsNoSpinsAndTorques) {
  auto setup = scene();
  const std::size_t turning = bytesHeld(setup);
  setup.rotation = false;
  // Spin, torque, spin as the dashpots see it and inverse inertia.
  EXPECT_GE(turning, bytesHeld(setup) + 4 * real() * setup.disks.size());
}

TEST_P(AbsentEffects, LawsWithoutSpringsHoldNoHistory) {
  auto setup = scene();
  const std::size_t history = bytesHeld(setup);
  const std::size_t pairs = Simulation(setup).neighbours().farPairs;
  setup.law.tangential = TangentialLaw::viscous;
  // A spring a pair, near and far, and one a disk for each of four planes.
  EXPECT_GE(history, bytesHeld(setup) + real() * (2 * pairs + 4 * setup.disks.size()));
}

TEST_P(AbsentEffects, FrictionlessScenesHoldWhatOnesWithoutSpringsAndRotationDo) {
  auto setup = scene();
  setup.law.tangential = TangentialLaw::viscous;
  setup.rotation = false;
  const std::size_t without = bytesHeld(setup);
  setup.law.tangential = TangentialLaw::none;
  setup.rotation = true;  // nothing would turn them
  EXPECT_EQ(bytesHeld(setup), without);
  setup.law.tangential = TangentialLaw::springDashpot;
  setup.law.mu = 0.0;
  EXPECT_EQ(bytesHeld(setup), without);
}

TEST_P(AbsentEffects, ScenesWithoutAPlateHoldNoSpringsOfIt) {
  auto setup = scene();
  const std::size_t without = bytesHeld(setup);
  setup.bottom = test::thesisBottom<BottomPlate>(2e-3);
  // Springs along x and y, and the mass that it carries.
  EXPECT_GE(bytesHeld(setup), without + 3 * real() * setup.disks.size());
}

TEST_P(AbsentEffects, ScenesWithoutALedgerHoldNoneOfIt) {
  auto setup = scene();
  const std::size_t without = bytesHeld(setup);
  setup.ledger = true;
  // Velocities of two times, kinetic energies and masses of each disk; room for pairs at hand.
  EXPECT_GE(bytesHeld(setup), without + 7 * 8 * setup.disks.size());
}

TEST(SpaceAbsentEffects, BlockedRotation_HoldsNoSpinsAndTorques) {
  SpheresSetup setup = test::pressed();
  const std::size_t turning = bytesHeld<Spheres>(setup);
  setup.rotation = false;
  // Spin, torque and spin as the dashpots see it, as wide as registers, and inverse inertia; the
  // setup's own spins stay.
  EXPECT_GE(turning, bytesHeld<Spheres>(setup) +
                         (3 * sizeof(Quad) + sizeof(double)) * (setup.radius.size() + 2 * 49));
}

TEST(SpaceAbsentEffects, LawsWithoutASpring_HoldNoHistory) {
  SpheresSetup setup = test::pressed();
  const std::size_t contacts = Spheres(setup).contacts().size();
  ASSERT_GT(contacts, 100u);
  const std::size_t history = bytesHeld<Spheres>(setup);
  setup.law.tangential = TangentialLaw::viscous;
  EXPECT_GE(history, bytesHeld<Spheres>(setup) + contacts * sizeof(Vec3<double>));
}

TEST(SpaceAbsentEffects, FrictionlessScenes_HoldNeitherSlipNorSpins) {
  SpheresSetup setup = test::pressed();
  const std::size_t contacts = Spheres(setup).contacts().size();
  setup.law.tangential = TangentialLaw::viscous;
  setup.rotation = false;
  const std::size_t slipping = bytesHeld<Spheres>(setup);
  setup.law.tangential = TangentialLaw::none;
  const std::size_t without = bytesHeld<Spheres>(setup);
  EXPECT_GE(slipping, without + contacts * sizeof(Quad));
  setup.rotation = true;  // nothing would turn them
  EXPECT_EQ(bytesHeld<Spheres>(setup), without);
  setup.law.tangential = TangentialLaw::springDashpot;
  setup.law.mu = 0.0;
  EXPECT_EQ(bytesHeld<Spheres>(setup), without);
}

TEST(SpaceAbsentEffects, RollingAndBonds_AloneHaveRecordsOfThem) {
  SpheresSetup setup = test::pressed();
  const std::size_t contacts = Spheres(setup).contacts().size(),
                    without = bytesHeld<Spheres>(setup);
  setup.law.rolling = RollingLaw::constantTorque;
  setup.law.muR = 0.1;
  const std::size_t torque = bytesHeld<Spheres>(setup);
  EXPECT_GE(torque, without + contacts * sizeof(Vec3<double>));
  setup.law.rolling = RollingLaw::spring;
  setup.law.kr = setup.law.kt;
  EXPECT_GE(bytesHeld<Spheres>(setup), torque + contacts * sizeof(Vec3<double>));
}

}  // namespace
