#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <sstream>

#include "tests/unit/grain_packed.hpp"

// The energy ledger: its residual, and every term by another route.

namespace {

using namespace grain;
namespace test = crossgrain::test;

/// Runs for a time, whatever `visit(simulation)` does after each step. @returns the last ledger
EnergyLedger ledgerOf(grain::Setup setup, double time,
                      const std::function<void(const Simulation&)>& visit = {}) {
  setup.ledger = true;
  Simulation simulation(std::move(setup));
  const long steps = std::lround(time / simulation.dt());
  for (long k = 0; k < steps; ++k) {
    simulation.step();
    if (visit) visit(simulation);
  }
  return *simulation.energyLedger();
}

double worstResidual(const grain::Setup& setup, double time) {
  double worst = 0.0;
  ledgerOf(setup, time, [&](const Simulation& s) {
    worst = std::max(worst, std::abs(test::residual(*s.energyLedger())));
  });
  return worst;
}

using SetupAt = std::function<grain::Setup(double dt)>;

/// Of the largest residual, from dt to dt/8.
double orderOf(const SetupAt& scene, double dt, double time) {
  return std::log2(worstResidual(scene(dt), time) / worstResidual(scene(dt / 8), time)) / 3.0;
}

double dtOf(double stepsPerContact) {
  return test::contactTime() / stepsPerContact;
}

grain::Setup with(grain::Setup setup, Integrator integrator) {
  setup.law.conventions.integrator = integrator;
  if (integrator == Integrator::semiImplicitEuler)
    setup.law.conventions.dampingVelocity = DampingVelocity::lagged;
  return setup;
}

// The scheme's order.

struct LawCase {
  const char* name;
  void (*change)(ContactLaw&);
  double impact, spin;
};

void PrintTo(const LawCase& law, std::ostream* out) {
  *out << law.name;
}

void hertz(ContactLaw& law) {
  law.normal = NormalLaw::hertz;
  law.kn = 1e6;
  law.kt = 8e5;
  law.gn = law.gt = 0.0;
  law.conventions.springUpdate = SpringUpdate::midpoint;
  law.mu = 10.0;
}

constexpr LawCase laws[] = {
    {"undamped",
     [](ContactLaw& law) {
       law.gn = 0.0;
       law.tangential = TangentialLaw::none;
     },
     0.3, 0.0},
    {"damped", [](ContactLaw& law) { law.tangential = TangentialLaw::none; }, 0.3, 0.0},
    {"cutTension",
     [](ContactLaw& law) {
       law.tangential = TangentialLaw::none;
       law.conventions.tension = Tension::cut;
     },
     0.0, 0.0},
    {"implicitDamping",
     [](ContactLaw& law) {
       law.conventions.dampingVelocity = DampingVelocity::implicit;
       law.conventions.springUpdate = SpringUpdate::before;
     },
     0.1, 5.0},
    {"coulomb", [](ContactLaw& law) { law.tangential = TangentialLaw::coulomb; }, 0.3, 10.0},
    {"viscous", [](ContactLaw& law) { law.tangential = TangentialLaw::viscous; }, 0.3, 10.0},
    {"springSticking",
     [](ContactLaw& law) { law.conventions.springUpdate = SpringUpdate::midpoint; }, 0.05, 5.0},
    {"springSliding",
     [](ContactLaw& law) { law.conventions.springUpdate = SpringUpdate::midpoint; }, 0.0, 60.0},
    {"undampedSpring",
     [](ContactLaw& law) {
       law.tangential = TangentialLaw::spring;
       law.conventions.springUpdate = SpringUpdate::midpoint;
     },
     0.5, 10.0},
    {"springOnlyReset",
     [](ContactLaw& law) {
       law.conventions.springUpdate = SpringUpdate::midpoint;
       law.conventions.springReset = SpringReset::springOnly;
     },
     0.5, 30.0},
    {"contactPoint",
     [](ContactLaw& law) {
       law.conventions.springUpdate = SpringUpdate::midpoint;
       law.conventions.leverArm = LeverArm::contactPoint;
     },
     0.3, 5.0},
    {"armsApart",
     [](ContactLaw& law) {
       law.conventions.springUpdate = SpringUpdate::midpoint;
       law.conventions.leverArm = LeverArm::overlapMiddle;
       law.conventions.velocityArm = VelocityArm::radius;
     },
     0.3, 5.0},
    {"hertz", hertz, 0.05, 5.0},
    {"mindlinForce",
     [](ContactLaw& law) {
       hertz(law);
       law.conventions.history = History::force;
     },
     0.05, 5.0},
    {"polynomial",
     [](ContactLaw& law) {
       law.normal = NormalLaw::polynomial;
       law.kn = 5e6;
       law.kn3 = 1e10;
       law.damper = Damper::critical;
       law.gn = law.gt = 0.3;
       law.conventions.springUpdate = SpringUpdate::midpoint;
     },
     0.1, 5.0}};

class LedgerOrder : public testing::TestWithParam<std::tuple<LawCase, Integrator>> {};

/// Between the first touch and the last, where f_el is continuous, the trapezium rule of a Verlet
/// scheme is of second order, however the dashpot begins and ends: what it takes is known exactly.
/// The kink of f_el at δ = 0 costs a step's share of dt³. Euler's one kick from t on is a rectangle
/// to the left: first order.
TEST_P(LedgerOrder, OfTheResidualIsTheSchemes) {
  const auto& [law, integrator] = GetParam();
  const double order = orderOf(
      [&, law = law, integrator = integrator](double dt) {
        grain::Setup setup = with(test::collidingPair(0.1, law.impact, law.spin, dt), integrator);
        law.change(setup.law);
        return setup;
      },
      dtOf(50), 2.5 * test::contactTime());
  const double expected = integrator == Integrator::semiImplicitEuler ? 1.0 : 2.0;
  EXPECT_NEAR(order, expected, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Laws, LedgerOrder,
                         testing::Combine(testing::ValuesIn(laws),
                                          testing::Values(Integrator::positionVerlet,
                                                          Integrator::velocityVerlet,
                                                          Integrator::semiImplicitEuler)),
                         [](const auto& at) {
                           std::ostringstream name;
                           PrintTo(std::get<1>(at.param), &name);
                           return std::string(std::get<0>(at.param).name) + "_" + name.str();
                         });

/// A spring that is stretched by v_t dt after its force, or before, is of first order itself.
TEST(LedgerOrders, OfASpringStretchedOnOneSideIsOne) {
  for (const SpringUpdate stretch : {SpringUpdate::after, SpringUpdate::before}) {
    const double order = orderOf(
        [&](double dt) {
          grain::Setup setup = test::collidingPair(0.1, 0.5, 10.0, dt);
          setup.law.tangential = TangentialLaw::spring;
          setup.law.conventions.springUpdate = stretch;
          return setup;
        },
        dtOf(400), 1.5 * test::contactTime());
    EXPECT_NEAR(order, 1.0, 0.15);
  }
}

// Rigid contacts have no springs, so nothing is left but rounding.

TEST(LedgerOfImpulses, ClosesToRounding) {
  grain::Setup setup = test::packed(10, 5);
  setup.law.normal = NormalLaw::rigid;
  setup.law.tangential = TangentialLaw::coulomb;
  setup.law.en = 0.8;
  setup.law.et0 = 0.3;
  setup = with(setup, Integrator::semiImplicitEuler);
  for (double& x : setup.disks.radius) x *= 0.95;
  const EnergyLedger end = ledgerOf(setup, 0.1);
  EXPECT_GT(end.lostNormalDamping, 0.1 * end.initial);
  EXPECT_GT(end.lostSliding, 0.01 * end.initial);
  EXPECT_GT(std::abs(end.workOfWalls), 0.1 * end.initial);
  EXPECT_LT(std::abs(test::residual(end)), 1e-12 * end.initial);  // 2500 steps of 1e-16 each
}

/// One impact along the normal: ½ m₁₂ (1 − e²) v².
TEST(LedgerOfImpulses, LosesWhatRestitutionSays) {
  grain::Setup setup = test::collidingPair(0.1, 0.0, 0.0, dtOf(50));
  setup.law.normal = NormalLaw::rigid;
  setup.law.en = 0.6;
  setup = with(setup, Integrator::semiImplicitEuler);
  const EnergyLedger end = ledgerOf(setup, 2e-3);
  const double lost = 0.5 * (0.5 * test::smallMass) * (1.0 - 0.36) * 0.01;
  EXPECT_NEAR(end.lostNormalDamping, lost, 1e-12 * lost);
  EXPECT_EQ(end.lostSliding + end.lostTangentialDamping + end.workOfWalls, 0.0);
}

// Terms that the oracle of two disks (tests/stability/energy_ledger_test.cpp) does not have.

/// Half way through an undamped collision all energy is in the spring.
TEST(LedgerTerms, NormalSpring) {
  grain::Setup setup = test::collidingPair(0.1, 0.0, 0.0, dtOf(400));
  setup.law.tangential = TangentialLaw::none;
  setup.law.gn = 0.0;
  double most = 0.0;
  const EnergyLedger end = ledgerOf(setup, 5e-3, [&](const Simulation& s) {
    most = std::max(most, s.energyLedger()->elasticNormal);
    EXPECT_NEAR(s.energyLedger()->elasticNormal, s.elasticEnergy(), 1e-12 * 6.9e-7);
    EXPECT_NEAR(s.energyLedger()->kinetic, s.kineticEnergy(), 1e-12 * 6.9e-7);
  });
  EXPECT_NEAR(most, end.initial, 1e-4 * end.initial);
}

/// A column settles under gravity: the potential falls by m g times the fall, and in the end all of
/// that is lost or in springs.
TEST(LedgerTerms, PotentialOfAColumn) {
  grain::Setup setup;
  setup.law = test::thesisLaw();
  setup.law.conventions.springUpdate = SpringUpdate::midpoint;
  setup.dt = 2e-5;
  setup.gravityX = 1.0;
  setup.gravityY = -9.81;
  for (int k = 0; k < 5; ++k) test::addDisk(setup.disks, 0.5, 4e-3 + 7.6e-3 * k, 0.0, 0.0, 0.0);
  setup.walls.push_back(
      test::standing({{0.0, 0.0, 0.0, 1.0}, {0.5 + test::smallRadius, 0.0, -1.0, 0.0}}));
  double potential = 0.0, scale = 0.0;
  const EnergyLedger end = ledgerOf(setup, 1.0, [&](const Simulation& s) {
    potential = 0.0;
    for (std::size_t i = 0; i < 5; ++i)
      potential += test::smallMass * (9.81 * (s.y(i) - (4e-3 + 2 * 7.6e-3)) - (s.x(i) - 0.5));
    scale = std::max(scale, std::abs(potential));
    EXPECT_NEAR(s.energyLedger()->potential, potential, 1e-15);
  });
  EXPECT_LT(end.kinetic, 1e-12);
  EXPECT_NEAR(end.lostNormalDamping + end.lostTangentialDamping + end.lostSliding +
                  end.elasticNormal + end.elasticTangential - end.gainedByConvention,
              -potential, 1e-3 * scale);
  EXPECT_EQ(end.workOfWalls, 0.0);
}

/// A plane that presses one undamped disk against another plane: its work is ½ k δ² of two
/// contacts, each by half its way.
TEST(LedgerTerms, WorkOfAPlaneThatCompresses) {
  grain::Setup setup;
  setup.law.kn = test::thesis.kn;
  setup.dt = 1e-5;
  test::addDisk(setup.disks, test::smallRadius, 0.0, 0.0, 0.0, 0.0);
  Wall press;
  press.planes = {{2.0 * test::smallRadius, 0.0, -1.0, 0.0}};
  press.motion = [](double t) { return WallState{.x = -1e-4 * t, .vx = -1e-4}; };
  setup.walls = {test::standing({{0.0, 0.0, 1.0, 0.0}}), press};
  const double way = 1e-4 * 1.0;
  double pushed = 0.0;
  const EnergyLedger end = ledgerOf(
      setup, 1.0, [&](const Simulation& s) { pushed += s.wallLoad(1).fx * 1e-4 * s.dt(); });
  const double stored = 2.0 * 0.5 * test::thesis.kn * 0.25 * way * way;
  // Slowly, but with a beginning: the disk swings by v/ω about the middle.
  EXPECT_NEAR(end.workOfWalls, stored, 2e-2 * stored);
  EXPECT_NEAR(end.workOfWalls, pushed, 1e-4 * stored);
  EXPECT_NEAR(end.elasticNormal, stored, 2e-2 * stored);
}

/// A disk coasts over the plate: first it only stretches the spring, then it slides: µ_b m g times
/// the way, and in the end the spring holds it.
TEST(LedgerTerms, PlateTakesWhatADiskLosesOnTheWay) {
  grain::Setup setup{.bottom = BottomPlate{0.1, 200.0, 0.1, 0.0, 9.81, false}, .dt = 1e-5};
  test::addDisk(setup.disks, 0.0, 0.0, 0.06, 0.08, 0.0);
  double springs = 0.0;
  const EnergyLedger end = ledgerOf(setup, 0.2, [&](const Simulation& s) {
    springs = std::max(springs, s.energyLedger()->plateSprings);
  });
  const double bound = 0.1 * test::smallMass * 9.81;
  EXPECT_NEAR(springs, 0.5 * bound * bound / 200.0, 1e-3 * springs);
  EXPECT_LT(end.kinetic, 1e-4 * end.initial);
  EXPECT_NEAR(end.lostBottom - end.gainedByConvention, end.initial - end.plateSprings - end.kinetic,
              1e-3 * end.initial);
  // Sliding to rest takes v²/(2 µ_b g): the loss is that of friction over this way.
  const double way = 0.01 / (2.0 * 0.1 * 9.81);
  EXPECT_NEAR(end.lostBottom, bound * way, 0.02 * bound * way);
}

/// Springs of the plate are stretched after their force: first order.
TEST(LedgerTerms, PlateIsOfFirstOrder) {
  const double order = orderOf(
      [](double dt) {
        grain::Setup setup{.bottom = BottomPlate{1.0, 200.0, 0.02, 1e-4, 9.81, true}, .dt = dt};
        test::addDisk(setup.disks, 0.0, 0.0, 1e-4, 0.0, 0.0);
        return setup;
      },
      4e-5, 0.02);
  EXPECT_NEAR(order, 1.0, 0.1);
}

// A packing in a moving box around a turning wheel: everything at once.

class PackedLedger : public testing::TestWithParam<Integrator> {
 protected:
  static grain::Setup scene(double dt) {
    grain::Setup setup = with(test::packed(10, 7), GetParam());
    setup.law.conventions.springUpdate = SpringUpdate::midpoint;
    setup.gravityY = -1.0;
    setup.dt = dt;
    return setup;
  }
};

/// The power of walls is minus what the disks do to them: force times velocity and torque times
/// spin, from the loads that snapshots show.
TEST_P(PackedLedger, WorkOfWallsIsThatOfTheLoads) {
  double power = 0.0, turned = 0.0;
  const EnergyLedger end = ledgerOf(scene(1e-5), 0.05, [&](const Simulation& s) {
    for (std::size_t w = 0; w < 3; ++w) {
      const WallState wall = s.wallState(w);
      const WallLoad load = s.wallLoad(w);
      power -= s.dt() * (load.fx * wall.vx + load.fy * wall.vy + load.torque * wall.spin);
      turned -= s.dt() * load.torque * wall.spin;
    }
  });
  EXPECT_GT(std::abs(turned), 1e-3 * end.initial);
  EXPECT_NEAR(end.workOfWalls, power, 5e-3 * std::abs(power));
}

TEST_P(PackedLedger, ResidualShrinksAtTheSchemesOrder) {
  const double coarse = worstResidual(scene(2e-5), 0.02), fine = worstResidual(scene(5e-6), 0.02);
  const double order = std::log2(coarse / fine) / 2.0;
  EXPECT_NEAR(order, GetParam() == Integrator::semiImplicitEuler ? 1.0 : 2.0, 0.25);
}

/// Looking changes nothing; nor do threads what the ledger says; a checkpoint carries it on.
TEST_P(PackedLedger, ChangesNoBitAndIsPartOfTheState) {
  grain::Setup setup = scene(4e-5);
  setup.bottom = test::thesisBottom<BottomPlate>();
  Simulation without(setup);
  setup.ledger = true;
  Simulation one(setup);
  setup.threads = 2;
  Simulation two(setup);
  EXPECT_EQ(without.energyLedger(), nullptr);
  without.advance(200);
  two.advance(200);
  one.advance(100);
  std::stringstream kept;
  one.save(kept);
  Simulation restored(setup);
  restored.restore(kept);
  one.advance(100);
  restored.advance(100);
  EXPECT_EQ(test::difference(without, one), "");
  const EnergyLedger& ledger = *one.energyLedger();
  for (const Simulation* other : {&two, &restored}) {
    EXPECT_EQ(other->energyLedger()->lostSliding, ledger.lostSliding);
    EXPECT_EQ(other->energyLedger()->lostBottom, ledger.lostBottom);
    EXPECT_EQ(other->energyLedger()->workOfWalls, ledger.workOfWalls);
    EXPECT_EQ(test::residual(*other->energyLedger()), test::residual(ledger));
  }
  EXPECT_GT(ledger.lostBottom, 0.0);
}

TEST_P(PackedLedger, IsNotTakenFromARunWithout) {
  grain::Setup setup = scene(4e-5);
  std::stringstream kept;
  Simulation(setup).save(kept);
  setup.ledger = true;
  EXPECT_THROW(Simulation(setup).restore(kept), std::runtime_error);
}

INSTANTIATE_TEST_SUITE_P(Schemes, PackedLedger,
                         testing::Values(Integrator::positionVerlet, Integrator::velocityVerlet,
                                         Integrator::semiImplicitEuler));

/// In single precision kicks round to 6e-8 of a velocity, and overlaps to 1e-9 m or so.
TEST(LedgerInSinglePrecision, ClosesAsFarAsFloatsCan) {
  grain::Setup setup = test::packed(10, 7);
  setup.law.conventions.springUpdate = SpringUpdate::midpoint;
  setup.dt = 1e-5;
  const double fine = worstResidual(setup, 0.02);
  setup.precision = Precision::float32;
  const double single = worstResidual(setup, 0.02);
  double initial = ledgerOf(setup, 0.0).initial;
  EXPECT_LT(std::abs(single - fine), 1e-4 * initial);
}

}  // namespace
