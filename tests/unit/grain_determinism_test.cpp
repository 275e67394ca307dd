#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>
#include <stdexcept>

#include "engines/grain/kernels.hpp"
#include "tests/support/refusal.hpp"
#include "tests/unit/grain_packed.hpp"

// "The same setup gives the same bits in every run, on any number of threads, with any skin and any
// instruction set", at any moment of the run: before and after renumberings, which come every 8192
// steps.

namespace {

using namespace grain;
namespace test = crossgrain::test;

/// Environment variable for as long as this lives, then as it was.
class WithInstructions {
 public:
  explicit WithInstructions(const char* set) {
    if (const char* old = std::getenv(name)) was_ = old;
    ::setenv(name, set, 1);
  }
  ~WithInstructions() { was_.empty() ? ::unsetenv(name) : ::setenv(name, was_.c_str(), 1); }

 private:
  static constexpr const char* name = "GRAIN_INSTRUCTIONS";
  std::string was_;
};

grain::Setup scene(Precision precision, int side = 12) {
  grain::Setup setup = test::packed(side, 5);
  setup.precision = precision;
  setup.bottom = test::thesisBottom<BottomPlate>(2e-3);
  return setup;
}

class Determinism : public testing::TestWithParam<Precision> {};

INSTANTIATE_TEST_SUITE_P(Precisions, Determinism,
                         testing::Values(Precision::float64, Precision::float32));

constexpr std::uint64_t pastARenumbering = 8192 + 500;

/// Every number of an energy ledger, none without one.
std::vector<double> ledgerOf(const Simulation& simulation) {
  if (simulation.energyLedger() == nullptr) return {};
  const EnergyLedger& l = *simulation.energyLedger();
  return {l.initial,     l.kinetic,           l.elasticNormal,         l.elasticTangential,
          l.potential,   l.plateSprings,      l.workOfWalls,           l.gainedByConvention,
          l.lostSliding, l.lostNormalDamping, l.lostTangentialDamping, l.lostBottom,
          l.lostRelease};
}

/// @returns the run that all instruction sets give
Simulation sameOnEveryInstructionSet(const grain::Setup& setup, std::uint64_t steps) {
  std::optional<Simulation> reference;
  for (const char* set : instructionSets()) {
    SCOPED_TRACE(set);
    const WithInstructions with(set);
    auto simulation = test::advanced(setup, steps);
    EXPECT_EQ(simulation.instructions(), set);
    if (reference) {
      EXPECT_EQ(test::difference(simulation, *reference), "");
      EXPECT_EQ(ledgerOf(simulation), ledgerOf(*reference));
    } else {
      reference = std::move(simulation);
    }
  }
  return std::move(*reference);
}

TEST_P(Determinism, EveryInstructionSet_GivesTheSameBitsAndLedger) {
  ASSERT_STREQ(instructionSets().front(), "baseline");
  sameOnEveryInstructionSet(scene(GetParam()), 1500);
  for (const LeverArm lever : {LeverArm::radius, LeverArm::contactPoint})
    for (const bool rotation : {true, false}) {
      grain::Setup setup = scene(GetParam());
      setup.ledger = true;
      setup.law.conventions.leverArm = lever;
      setup.rotation = rotation;
      const Simulation run = sameOnEveryInstructionSet(setup, 1500);
      EXPECT_GT(run.energyLedger()->lostSliding, 0.0);  // contacts have slid: all of it has run
    }
}

TEST_P(Determinism, EveryInstructionSet_GivesTheSameBitsForEveryLaw) {
  for (const TangentialLaw tangential :
       {TangentialLaw::none, TangentialLaw::coulomb, TangentialLaw::viscous, TangentialLaw::spring,
        TangentialLaw::springDashpot})
    for (const DampingVelocity damping :
         {DampingVelocity::lagged, DampingVelocity::predicted, DampingVelocity::implicit})
      for (const LeverArm lever :
           {LeverArm::radius, LeverArm::contactPoint, LeverArm::overlapMiddle}) {
        grain::Setup setup = scene(GetParam(), 8);
        setup.law.tangential = tangential;
        setup.law.conventions.dampingVelocity = damping;
        setup.law.conventions.leverArm = lever;
        sameOnEveryInstructionSet(setup, 100);
      }
}

TEST(Instructions, ThatTheProcessorLacksAreRefused) {
  const WithInstructions with("z80");
  test::expectSays(test::refusalOf<std::invalid_argument>(
                       [] { Simulation simulation(test::crowd(2, 1, 4e-5)); }),
                   {"\"z80\"", "baseline"});
}

TEST_P(Determinism, AnySkinGivesTheSameBits) {
  const auto reference = test::advanced(scene(GetParam()), pastARenumbering);  // a tuned one
  EXPECT_GT(reference.contacts().size(), 100u);
  std::size_t rebuilds = SIZE_MAX;
  for (const double share : {0.01, 0.1, 0.5, 2.0}) {
    SCOPED_TRACE(share);
    grain::Setup setup = scene(GetParam());
    setup.skin = share * test::smallRadius;
    const auto simulation = test::advanced(std::move(setup), pastARenumbering);
    EXPECT_EQ(test::difference(simulation, reference), "");
    EXPECT_EQ(simulation.neighbours().skin, share * test::smallRadius);
    EXPECT_LT(simulation.neighbours().rebuilds, rebuilds);
    rebuilds = simulation.neighbours().rebuilds;
  }
}

TEST_P(Determinism, LookingAndListingNeighboursAnew_ChangeNoBit) {
  const auto reference = test::advanced(scene(GetParam()), 2000);
  Simulation watched(scene(GetParam()));
  double seen = 0.0;
  while (watched.steps() < 2000) {
    watched.advance(1 + watched.steps() % 7);
    seen += watched.x(0) + watched.velocityY(1) + watched.spin(2) + watched.kineticEnergy();
    seen += watched.elasticEnergy() + watched.wallLoad(2).torque + watched.contacts()[0].overlap;
    if (watched.steps() % 50 == 0) watched.findNeighbours();
    if (watched.steps() + 7 > 2000) watched.advance(2000 - watched.steps());
  }
  EXPECT_NE(seen, 0.0);
  EXPECT_EQ(test::difference(watched, reference), "");
}

TEST(Contacts, OfTheLastStepAreNotKnownOnceNeighboursAreListedAnew) {
  for (const bool lookedBefore : {false, true}) {
    Simulation simulation(scene(Precision::float64, 8));
    simulation.advance(10);
    if (lookedBefore) {
      EXPECT_FALSE(simulation.contacts().empty());
    }
    simulation.findNeighbours();
    EXPECT_THROW(simulation.contacts(), std::logic_error) << "looked before: " << lookedBefore;
  }
}

}  // namespace
