// Engines that are right but for one planted thing, compared with their mirrors.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>

#include "adapters/grain.hpp"
#include "adapters/registry.hpp"
#include "cases/couette.hpp"
#include "cases/flow.hpp"
#include "cases/loader.hpp"
#include "cases/preparation.hpp"
#include "cases/time_step.hpp"
#include "results/lockstep_text.hpp"
#include "studies/lockstep/late_windows.hpp"
#include "studies/lockstep/lockstep.hpp"
#include "studies/lockstep/rules.hpp"
#include "studies/lockstep/separation.hpp"
#include "studies/lockstep/window.hpp"
#include "tests/studies/planted_engine.hpp"
#include "tests/studies/planted_program.hpp"
#include "tests/studies/quick_cell.hpp"
#include "tests/support/two_disks.hpp"

namespace {

using namespace crossgrain;

/// The quick cell, one packing, made once for all tests.
class Lockstep : public testing::Test {
 protected:
  static void SetUpTestSuite() { flow_ = new test::QuickFlow(4); }
  static void TearDownTestSuite() { delete flow_; }

  static LockstepRow rowOf(std::function<void(Scene&)> fault) {
    test::PlantedEngine engine(std::move(fault));
    return holdAgainstMirror(engine, test::inHouse, flow_->setup, flow_->states, flow_->dt,
                             [](double) {});
  }

  static std::size_t diskWithOneContact(const FlowState& state) {
    const auto engine = makeGrain();
    const Scene scene = couetteScene(flow_->setup, state.packing, flow_->dt);
    engine->load(scene, {});
    engine->advance(flow_->dt);
    const Contacts contacts = *engine->snapshot(ContactReport::instant).contacts;
    std::vector<int> count(scene.disks.size() + scene.wallDiskCount());
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      ++count[static_cast<std::size_t>(contacts.i[k])];
      ++count[static_cast<std::size_t>(contacts.j[k])];
    }
    const auto one = std::find(count.begin(),
                               count.begin() + static_cast<std::ptrdiff_t>(scene.disks.size()), 1);
    return static_cast<std::size_t>(one - count.begin());
  }

  static inline test::QuickFlow* flow_ = nullptr;
};

TEST_F(Lockstep, Starts_LieInEqualPartsOfTheFlow) {
  ASSERT_EQ(flow_->states.size(), 4u);
  const double part = startSteps * flow_->dt / 4.0;
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_GE(flow_->states[k].start.time, part * static_cast<double>(k) - flow_->dt);
    EXPECT_LE(flow_->states[k].start.time, part * static_cast<double>(k + 1) + flow_->dt);
    EXPECT_NE(flow_->states[k].packing.hash, flow_->packings.front().hash);
  }
  EXPECT_GT(flow_->states[3].start.wheelAngle, flow_->states[0].start.wheelAngle);
  const auto again = statesAlongTheFlow(flow_->setup, flow_->packings, flow_->dt, 4, [](double) {});
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_EQ(again[k].packing.hash, flow_->states[k].packing.hash);
}

TEST(LockstepStarts, SwingingWalls_HaveAStartInEachPeriod) {
  Case setup = test::twoDisks();
  assemblyIn<2>(setup).disks.front().velocityRms = 0.1;
  WallGroup wall;
  wall.planes = {{{0.0, 0.0}, Vec2::UnitY()}};
  wall.motion = {.kind = Motion::Kind::oscillating,
                 .amplitude = {0.1, 0.0},
                 .frequency = 2.0 * std::numbers::pi};
  assemblyIn<2>(setup).walls = {wall};
  setup.region.emplace();
  const auto statesOf = [&setup](std::size_t count) {
    const auto none = std::unique_ptr<Engine>();
    const std::vector<Packing> one = {flowPacking(setup, 0, 1e-3, *none, [](double) {})};
    return statesAlongTheFlow(setup, one, 1e-3, count, [](double) {});
  };
  // Three periods of 1 s: three places to begin at in each packing.
  const auto states = statesOf(8);
  ASSERT_EQ(states.size(), 8u);
  std::set<std::string> hashes;
  for (const FlowState& state : states) hashes.insert(state.packing.hash);
  EXPECT_EQ(hashes.size(), 8u);
  EXPECT_EQ(states[2].start.packing, 0u);
  EXPECT_EQ(states[3].start.packing, 1u);
  EXPECT_EQ(states.back().start.packing, 2u);
  assemblyIn<2>(setup).disks.front().velocityRms = 0.0;  // no packing differs from another
  EXPECT_EQ(statesOf(8).size(), 3u);
}

TEST_F(Lockstep, NoFault_IdenticalToRounding) {
  const LockstepRow row = rowOf([](Scene&) {});
  EXPECT_EQ(row.verdict, Equivalence::sameToRounding);
  EXPECT_EQ(row.starts, 4u);
  EXPECT_EQ(row.track.back(), 0.0);
  EXPECT_EQ(row.forces->normal, 0.0);
  EXPECT_FALSE(row.first);
  EXPECT_FALSE(row.term);
  const ContactKinds& kinds = row.kinds;
  for (const std::size_t count :
       {kinds.sticking, kinds.sliding, kinds.made, kinds.opened, kinds.wall})
    EXPECT_GT(count, 0u);
}

struct Fault {
  std::function<void(Scene&)> plant;
  const char* term;
  std::optional<double> amount;
};

/// Each is found, named by its term, and its amount reported: to first order, so that of
/// a part x of a constant a part of the order of x of the amount itself may be wrong.
TEST_F(Lockstep, PlantedFault_IsNamedWithItsAmount) {
  const auto times = [](double ContactLaw::*constant, double factor) {
    return [=](Scene& scene) { scene.law.*constant *= factor; };
  };
  const std::vector<Fault> faults = {
      {times(&ContactLaw::kn, 1.0001), "kn", 1e-4},
      {times(&ContactLaw::kn, 0.9999), "kn", -1e-4},
      {times(&ContactLaw::mu, 1.0001), "mu", 1e-4},
      {times(&ContactLaw::mu, 0.9999), "mu", -1e-4},
      {times(&ContactLaw::gt, 0.5), "gt", -0.5},
      {[](Scene& scene) { scene.law.conventions.tension = Tension::cut; }, "tension = cut", {}},
      {[](Scene& scene) { scene.law.conventions.dashpot = Dashpot::outside; },
       "dashpot = outside",
       {}},
      {[](Scene& scene) {
         for (double& inertia : scene.disks.inertia) inertia *= 0.8;
       },
       "inertia", -0.2},
      {[](Scene& scene) { scene.bottom->mu *= 1.1; }, "plate mu", 0.1},
      {[](Scene& scene) { scene.bottom.reset(); }, "without bottom_friction", {}}};
  for (const Fault& fault : faults) {
    SCOPED_TRACE(fault.term);
    const LockstepRow row = rowOf(fault.plant);
    ASSERT_TRUE(row.first);
    EXPECT_NE(row.verdict, Equivalence::sameToRounding);
    ASSERT_TRUE(row.term);
    EXPECT_EQ(row.term->name, fault.term) << "leaves " << row.term->unexplained;
    if (fault.amount) {
      EXPECT_NEAR(*row.term->amount / *fault.amount, 1.0, 0.01 + std::abs(*fault.amount));
    }
  }
}

/// The rule is a tenth of a per cent of k_n.
TEST_F(Lockstep, StiffnessOff_IsTheSameLawOrAnotherByItsSize) {
  const auto kn = [](double by) { return [by](Scene& scene) { scene.law.kn *= 1.0 + by; }; };
  const LockstepRow little = rowOf(kn(3e-5)), more = rowOf(kn(0.03));
  EXPECT_EQ(little.verdict, Equivalence::sameLaw);
  EXPECT_EQ(little.beyond, 0u);
  EXPECT_EQ(little.read, little.starts);
  EXPECT_LE(*little.equivalentLow, *little.equivalent);
  EXPECT_LE(*little.equivalent, *little.equivalentHigh);
  EXPECT_EQ(more.verdict, Equivalence::differs);
  // At the first time reported no contact has been made or broken at another step yet.
  EXPECT_NEAR(*little.separations.front().equivalent / 3e-5, 1.0, 0.1);
  EXPECT_NEAR(*more.separations.front().equivalent / 0.03, 1.0, 0.1);
}

/// Single precision is told apart from another law, and with what would be seen beside it.
TEST_F(Lockstep, SinglePrecision_IsNoOtherLaw) {
  const auto single = [](double by) {
    return [by](Scene& scene) {
      scene.precision = Precision::float32;
      scene.law.kn *= 1.0 + by;
    };
  };
  const LockstepRow right = rowOf(single(0.0));
  EXPECT_EQ(right.verdict, Equivalence::sameToPrecision);
  EXPECT_GT(right.track.back(), lockstepRounding);
  EXPECT_FALSE(right.first);
  ASSERT_TRUE(right.resolution);
  EXPECT_LT(*right.resolution, 0.05);
  const LockstepRow wrong = rowOf(single(3.0 * *right.resolution));
  EXPECT_EQ(wrong.verdict, Equivalence::differs);
  ASSERT_TRUE(wrong.term);
  EXPECT_EQ(wrong.term->name, "kn");
}

/// Declared they are its law: LockstepOfDeclaredLaws.
TEST_F(Lockstep, ConventionOfAnotherProgram_NotDeclared_IsNamed) {
  test::expectNamed(*flow_, {{"integrator=2", "integrator = semi_implicit_euler"},
                             {"spring_before=1", "spring_update = before"},
                             {"spring_only=1", "spring_reset = spring_only"},
                             {"lever_middle=1", "lever_arm = overlap_middle"},
                             {"cut_tension=1", "tension = cut"},
                             {"lagged=1", "damping_velocity = lagged"},
                             {"dashpot_outside=1", "dashpot = outside"}});
}

double partsThen(const LockstepCauses& causes, std::size_t time) {
  double sum = *causes.interaction[time];
  for (const Numbers& part : causes.parts) sum += *part[time];
  return sum;
}

TEST_F(Lockstep, DeclaredConventions_HaveAFirstStepAndAPartOfTheDivergence) {
  EXPECT_FALSE(rowOf([](Scene&) {}).causes);
  const auto causes = test::rowOfProgram(*flow_, {"cut_tension=1", "lever_middle=1"}, true).causes;
  ASSERT_TRUE(causes);
  EXPECT_EQ(causes->starts, 1u);  // of 4, that have 24 windows: a tenth is less than the 4 mixtures
  EXPECT_EQ(causes->runs, 4);
  ASSERT_EQ(causes->differences.size(), 2u);
  for (std::size_t time = 0; time < lockstepTimes.size(); ++time)
    EXPECT_NEAR(partsThen(*causes, time), 1.0, 1e-9) << lockstepTimes[time];
  const std::function<void(ContactLaw&)> alone[] = {
      [](ContactLaw& law) { law.conventions.tension = Tension::cut; },
      [](ContactLaw& law) { law.conventions.leverArm = LeverArm::overlapMiddle; }};
  const char* const names[] = {"tension", "lever_arm"};
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(causes->differences[k].name, names[k]);
    EXPECT_TRUE(causes->differences[k].declared);
    ASSERT_TRUE(causes->firstStep[k]) << names[k];
    const auto apartAfter = [&](std::size_t step) {
      const auto as = makeGrain(), other = makeGrain();
      Scene scene = couetteScene(flow_->setup, flow_->states.front().packing, flow_->dt);
      as->load(scene, {});
      alone[k](scene.law);
      other->load(scene, {});
      const auto there = follow<2>(*as, flow_->dt, {step}),
                 here = follow<2>(*other, flow_->dt, {step});
      return farthest(there.front(), here.front(), flowDiameter(flow_->setup)).distance;
    };
    EXPECT_GT(apartAfter(*causes->firstStep[k]), lockstepRounding) << names[k];
    if (*causes->firstStep[k] > 1) {
      EXPECT_LE(apartAfter(*causes->firstStep[k] - 1), lockstepRounding) << names[k];
    }
  }
}

/// What a false declaration says is no cause: what it does is.
TEST_F(Lockstep, ConventionNotDeclared_IsTheCause) {
  const LockstepRow row = test::rowOfProgram(*flow_, {"lever_middle=1"}, false);
  ASSERT_TRUE(row.causes);
  ASSERT_EQ(row.causes->differences.size(), 1u);
  EXPECT_EQ(row.causes->differences.front(),
            (CauseName{"lever_arm", "radius", "overlap_middle", false}));
  EXPECT_EQ(row.causes->undeclared, row.causes->differences);
  EXPECT_NEAR(*row.causes->parts.front().back(), 1.0, 1e-12);
  EXPECT_NE(describeCauses(row).find("lever_arm (not declared) in step"), std::string::npos);
}

/// Conventions that go with each other, but for the other name of the first integrator; and of
/// those that do not go together the one that is chosen.
constexpr std::array conventionsOfProgram = {"integrator=2", "lagged=1", "spring_before=1",
                                             "lever_middle=1", "cut_tension=1"};
constexpr std::array notTogether = {"spring_only=0", "spring_only=1", "dashpot_outside=1"};

struct Combination {
  unsigned chosen;  ///< bit k: conventionsOfProgram[k]
  std::size_t of;   ///< notTogether
  unsigned operator[](std::size_t factor) const {
    return factor < conventionsOfProgram.size() ? chosen >> factor & 1u : static_cast<unsigned>(of);
  }
};

void expectDeclaredLaw(const test::QuickFlow& flow, const Combination& one) {
  std::vector<std::string> words = {notTogether[one.of]};
  for (std::size_t k = 0; k < conventionsOfProgram.size(); ++k)
    if (one[k]) words.emplace_back(conventionsOfProgram[k]);
  const LockstepRow row = test::rowOfProgram(flow, words, true);
  EXPECT_EQ(row.verdict, Equivalence::sameToRounding)
      << fmt::format("{}: {}", fmt::join(words, " "), row.reason);
}

/// As few as have every choice of any three options (18 is the least: six for all pairs of five by
/// each of three).
TEST(LockstepOfDeclaredLaws, EveryThreeConventions_AreTheLawThatItDeclares) {
  constexpr unsigned chosen[3][6] = {
      {2, 12, 15, 19, 20, 25}, {4, 9, 14, 18, 21, 31}, {1, 10, 15, 16, 23, 28}};
  std::vector<Combination> all;
  for (std::size_t of = 0; of < notTogether.size(); ++of)
    for (const unsigned each : chosen[of]) all.push_back({each, of});
  constexpr std::size_t factors = conventionsOfProgram.size() + 1;
  for (std::size_t a = 0; a < factors; ++a)
    for (std::size_t b = 0; b < a; ++b)
      for (std::size_t c = 0; c < b; ++c) {
        std::set<std::array<unsigned, 3>> choices;
        for (const Combination& one : all) choices.insert({one[a], one[b], one[c]});
        ASSERT_EQ(choices.size(), a == factors - 1 ? 12u : 8u) << a << b << c;
      }
  const test::QuickFlow flow(1);
  for (const Combination& one : all) expectDeclaredLaw(flow, one);
}

/// All 96: the target all_declared_laws, of nightly.
TEST(LockstepOfAllDeclaredLaws, EveryCombinationOfConventions_IsTheLawThatItDeclares) {
  const test::QuickFlow flow(1);
  for (unsigned chosen = 0; chosen < 1u << conventionsOfProgram.size(); ++chosen)
    for (std::size_t of = 0; of < notTogether.size(); ++of) expectDeclaredLaw(flow, {chosen, of});
}

/// Both Verlet schemes are one motion, whichever an engine declares.
TEST_F(Lockstep, VelocityVerletOfAnotherProgram_IsPositionVerlet) {
  for (const bool declares : {true, false})
    EXPECT_EQ(test::rowOfProgram(*flow_, {"integrator=1"}, declares).verdict,
              Equivalence::sameToRounding);
}

TEST_F(Lockstep, SinglePrecisionOfAnotherProgram_IsItsPrecisionWhereItDeclaresThat) {
  EXPECT_EQ(test::rowOfProgram(*flow_, {"float_state=2"}, true).verdict,
            Equivalence::sameToPrecision);
  EXPECT_EQ(test::rowOfProgram(*flow_, {"float_state=2"}, false).verdict, Equivalence::differs);
}

TEST_F(Lockstep, MissingContact_IsFoundAtItsDisk) {
  // A disk of the first start that touches one other is a little smaller there: it lets go.
  const std::size_t lonely = diskWithOneContact(flow_->states.front());
  int loads = 0;
  const LockstepRow row = rowOf([&](Scene& scene) {
    if (++loads == 1) scene.disks.radius[lonely] *= 0.99;
  });
  EXPECT_NE(row.verdict, Equivalence::sameToRounding);
  ASSERT_TRUE(row.forces);
  EXPECT_EQ(row.forces->missing, 1u);
  EXPECT_EQ(row.forces->extra, 0u);
  ASSERT_TRUE(row.first);
  EXPECT_EQ(row.first->start, 0u);
  EXPECT_EQ(row.first->after, 0.0);
  EXPECT_TRUE(row.first->disk == lonely || row.first->partner == lonely);
}

/// A dashpot of the wrong sign drives its disks until the run is stopped: that is a failure, and
/// reported.
TEST_F(Lockstep, EngineThatBlowsUp_IsNotMeasured) {
  const LockstepRow row = rowOf([](Scene& scene) { scene.law.gt *= -1.0; });
  EXPECT_EQ(row.verdict, Equivalence::notMeasured);
  EXPECT_NE(row.failure.find("overlap"), std::string::npos) << row.failure;
  EXPECT_EQ(row.reason, row.failure);
}

/// Two disks that meet so fast that their centres pass: by the law, which is no engine's failure.
TEST(LockstepOfDeclaredLaws, LawThatBlowsUp_IsNobodysFailure) {
  Case setup = test::twoDisks();
  setup.region.emplace();
  const auto none = std::unique_ptr<Engine>();
  const double dt = 1e-5;
  FlowState state = {{}, flowPacking(setup, 0, dt, *none, [](double) {})};
  state.packing.disks.velocity = {{100.0, 0.0}, {-100.0, 0.0}};
  test::PlantedEngine right([](Scene&) {});
  const LockstepRow row =
      holdAgainstMirror(right, test::inHouse, setup, {state}, dt, [](double) {});
  EXPECT_EQ(row.verdict, Equivalence::notMeasured);
  EXPECT_EQ(row.failure, "");
  EXPECT_NE(row.reason.find("does not come through"), std::string::npos) << row.reason;
}

/// A difference that k_n does not explain has no equivalent in k_n, and no term that only resembles
/// it is named.
TEST_F(Lockstep, TermThatOnlyResembles_IsNotNamed) {
  const LockstepRow hot = rowOf([](Scene& scene) {
    for (Vec2& velocity : scene.disks.velocity) velocity *= 1.1;
  });
  EXPECT_EQ(hot.verdict, Equivalence::differs);
  EXPECT_FALSE(hot.term) << hot.term->name;
  // The sign of the plate's torque: no negative coefficient of friction stands for it.
  const LockstepRow plate = rowOf([](Scene& scene) { scene.bottom->tauM *= -1.0; });
  if (plate.term) {
    EXPECT_EQ(plate.term->name, "plate tau_m");
  }
}

/// A fault at one start of four is no share that is shown.
TEST_F(Lockstep, FaultAtOneStartOfFour_IsUndecided) {
  int loads = 0;
  const LockstepRow row = rowOf([&](Scene& scene) {
    if (++loads == 2) scene.law.kn *= 1.1;
  });
  EXPECT_EQ(row.verdict, Equivalence::undecided);
  EXPECT_EQ(row.beyond, 1u);
  EXPECT_TRUE(row.readings[1].beyond);
}

/// Moves disks with the velocities that it has, then finds contacts and kicks, as Chipmunk does.
class DriftsFirst : public test::PlantedEngine {
 public:
  explicit DriftsFirst(double declaredLag)
      : PlantedEngine([](Scene& scene) {
          scene.law.conventions.integrator = Integrator::semiImplicitEuler;
          for (std::size_t i = 0; i < scene.disks.size(); ++i)
            scene.disks.position[i] += scene.dt * scene.disks.velocity[i];
        }),
        declaredLag_(declaredLag) {}
  EffectiveParameters load(const Scene& scene, const Settings& settings) override {
    EffectiveParameters effective = PlantedEngine::load(scene, settings);
    dt_ = effective.dt;
    effective.velocityLag = declaredLag_ * dt_;
    return effective;
  }
  double advance(double t) override { return PlantedEngine::advance(t - dt_) + dt_; }
  Snapshot snapshot(ContactReport contacts) override {
    Snapshot now = PlantedEngine::snapshot(contacts);
    for (double* time : {&now.positionTime, &now.velocityTime, &now.contactTime}) *time += dt_;
    return now;
  }

 private:
  double declaredLag_, dt_ = 0.0;
};

/// Two disks that fall on a plane, by an engine that declares a lag of its velocities in steps.
LockstepRow fallingRow(double declaredLag) {
  Case setup = test::twoDisks();
  setup.law.conventions.integrator = Integrator::semiImplicitEuler;
  setup.law.kn = 1e4;
  assemblyIn<2>(setup).gravity = {0.0, -9.81};
  assemblyIn<2>(setup).disks.front().velocityRms = 0.05;
  WallGroup floor;
  floor.planes = {{{0.0, 0.0}, Vec2::UnitY()}};
  assemblyIn<2>(setup).walls = {floor};
  setup.region.emplace();
  const auto none = std::unique_ptr<Engine>();
  const double dt = 1e-3;
  const std::vector<Packing> one = {flowPacking(setup, 0, dt, *none, [](double) {})};
  const auto states = statesAlongTheFlow(setup, one, dt, 4, [](double) {});
  DriftsFirst engine(declaredLag);
  return holdAgainstMirror(engine, test::inHouse, setup, states, dt, [](double) {});
}

TEST(FallingBall, EngineThatMovesBeforeItKicks_HasAMirrorWhereItDeclaresThat) {
  const LockstepRow row = fallingRow(-0.5);
  ASSERT_EQ(row.starts, 4u) << row.reason;
  EXPECT_LT(std::ranges::max(row.track), lockstepRounding) << row.reason;
  // Under another declaration it is another motion, by g n dt².
  const LockstepRow other = fallingRow(0.5);
  ASSERT_EQ(other.starts, 4u) << other.reason;
  EXPECT_GT(std::ranges::max(other.track), visibleMotion);
  // And no scheme has velocities a quarter of a step late.
  const LockstepRow none = fallingRow(-0.25);
  EXPECT_EQ(none.verdict, Equivalence::notMeasured);
  EXPECT_NE(none.reason.find("no mirror has its time stepping"), std::string::npos) << none.reason;
}

/// An engine that dies is reported, with its results until then.
TEST_F(Lockstep, EngineThatDies_KeepsTheStartsBefore) {
  int loads = 0;
  const LockstepRow row = rowOf([&](Scene&) {
    if (++loads == 3) throw EngineFailure("gone");
  });
  EXPECT_EQ(row.starts, 2u);
  EXPECT_EQ(row.failure, "gone");
  EXPECT_EQ(row.verdict, Equivalence::sameToRounding);
}

/// A disk that meets nothing moves alike under any law: that neither clears nor accuses an engine.
TEST(LateWindows, RunInWhichNoConstantActs_SaysNothingOfTheLaw) {
  const Case setup = test::quickCell(
      {"bottom.mu=0", "averaging.settle_rotations=0.01", "averaging.rotations=0.02"});
  const double x = 0.5 * (couetteIn(setup).cell.innerRadius + couetteIn(setup).cell.outerRadius);
  Packing packing;
  packing.disks = {
      {couetteIn(setup).particles.smallRadius}, {1e-4}, {1e-9}, {{x, 0.0}}, {{0.0, 0.0}}, {0.0}};
  const auto engine = makeGrain();
  const LateWindows late =
      followLate(*engine, test::inHouse, setup, packing, 0, timeStep(setup), 4, [](double) {});
  EXPECT_FALSE(late.times.empty());
  EXPECT_TRUE(late.equivalents.empty());
  EXPECT_NE(late.failure.find("say nothing of its law"), std::string::npos) << late.failure;
}

}  // namespace
