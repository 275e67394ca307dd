#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "engines/grain/contact_force.hpp"
#include "engines/grain/law_types.hpp"
#include "tests/unit/grain_scenes.hpp"

namespace {

using namespace grain;
using namespace crossgrain::test;
using grain::Setup;

/// e_n of the pair, with v_n taken where the overlap passes zero: carried there from the last step
/// in contact by the motion's own Taylor series. The dashpot's force sets in and ends with a jump,
/// so a step that straddles one end is off by up to η dt, whatever the scheme: contacts here begin
/// midway between two steps, and end where they end.
double restitution(Setup setup, double v) {
  const double reduced = 0.5 * smallMass, kn = setup.law.kn, gn = setup.law.gn;
  Simulation simulation(std::move(setup));
  double overlap = 0.0, velocity = 0.0, force = 0.0;
  do {
    simulation.step();
    if (simulation.contacts().empty()) continue;
    overlap = simulation.contacts()[0].overlap;
    force = simulation.contacts()[0].normalForce;
    velocity = simulation.velocityX(0) - simulation.velocityX(1);
  } while (simulation.steps() < 2 || !simulation.contacts().empty());
  const double acceleration = force / reduced;
  const double jerk = force == 0.0 ? 0.0 : (-kn * velocity - gn * acceleration) / reduced;
  double left = overlap / velocity;  // δ = v τ + a τ²/2, by iteration
  for (int k = 0; k < 20; ++k) left = overlap / (velocity + 0.5 * acceleration * left);
  return (velocity + acceleration * left + 0.5 * jerk * left * left) / v;
}

/// Lätzel (2003), section 4.1: exp(−η π/ω) with tension, exp(−(η/ω)(π − atan2(2ηω, ω² − η²)))
/// without.
double closedForm(bool cut) {
  const double reduced = 0.5 * smallMass, eta = thesis.gn / (2.0 * reduced);
  const double omega = std::sqrt(thesis.kn / reduced - eta * eta);
  const double end = cut ? M_PI - std::atan2(2.0 * eta * omega, omega * omega - eta * eta) : M_PI;
  return std::exp(-eta / omega * end);
}

TEST(GrainCollision, ClosedFormsAreThoseOfTheThesisDisks) {
  EXPECT_NEAR(closedForm(false), 0.2223, 5e-5);
  EXPECT_NEAR(closedForm(true), 0.3408, 5e-5);
}

struct Scheme {
  Integrator integrator;
  DampingVelocity damping;
  double tolerance;
};

class NormalRestitution : public testing::TestWithParam<std::tuple<Scheme, bool>> {};

TEST_P(NormalRestitution, IsTheClosedFormAtTwoThousandStepsPerContact) {
  const auto& [scheme, cut] = GetParam();
  auto setup = collidingPair(0.1, 0.0, 0.0, contactTime() / 2000.0);
  setup.law.tangential = TangentialLaw::none;
  setup.law.conventions.tension = cut ? Tension::cut : Tension::allow;
  setup.law.conventions.dampingVelocity = scheme.damping;
  setup.law.conventions.integrator = scheme.integrator;
  EXPECT_NEAR(restitution(std::move(setup), 0.1), closedForm(cut), scheme.tolerance);
}

// 2e-6 for second order, ω² dt² = 2.5e-6 of which schemes show a fraction; 2e-3 for first order,
// whose error is of the order of η dt = 0.75e-3.
INSTANTIATE_TEST_SUITE_P(
    Schemes, NormalRestitution,
    testing::Combine(
        testing::Values(Scheme{Integrator::positionVerlet, DampingVelocity::predicted, 2e-6},
                        Scheme{Integrator::positionVerlet, DampingVelocity::implicit, 2e-6},
                        Scheme{Integrator::velocityVerlet, DampingVelocity::predicted, 2e-6},
                        Scheme{Integrator::velocityVerlet, DampingVelocity::implicit, 2e-6},
                        Scheme{Integrator::positionVerlet, DampingVelocity::lagged, 2e-3},
                        Scheme{Integrator::velocityVerlet, DampingVelocity::lagged, 2e-3},
                        Scheme{Integrator::semiImplicitEuler, DampingVelocity::lagged, 2e-3}),
        testing::Bool()));

/// The law as the contact kernels see it, every option at run time.
GeneralLaw<double> kernelLaw(bool cutTension = false,
                             CoulombBound bound = CoulombBound::compression) {
  ContactLaw law = thesisLaw();
  law.conventions.tension = cutTension ? Tension::cut : Tension::allow;
  law.conventions.coulombBound = bound;
  return generalLaw<double>(law, 1e-6, true);
}

TEST(GrainCollision, TensionOfTheNormalForceIsAllowedOrCut) {
  auto law = kernelLaw();
  const ContactMotion<double> parting{1e-7, 0.05, 0.0, 0.0, 0.0};
  EXPECT_DOUBLE_EQ(normalForce(law, parting, elasticForce(law, parting)),
                   352.1e-7 - thesis.gn * 0.05);
  law = kernelLaw(true);
  EXPECT_EQ(normalForce(law, parting, elasticForce(law, parting)), 0.0);
}

TEST(GrainCollision, CoulombBoundHasThreeReadings) {
  auto law = kernelLaw();
  EXPECT_DOUBLE_EQ(coulombBound(law, 2.0), 0.88);
  EXPECT_EQ(coulombBound(law, -2.0), 0.0);
  law = kernelLaw(false, CoulombBound::magnitude);
  EXPECT_DOUBLE_EQ(coulombBound(law, -2.0), 0.88);
  law = kernelLaw(false, CoulombBound::signedForce);
  EXPECT_DOUBLE_EQ(coulombBound(law, -2.0), -0.88);
}

TEST(GrainCollision, TangentialLawsByHand) {
  auto law = kernelLaw();
  law.normalDamping = false;  // f_n = 352.1 · 1e-4 = 0.03521 N, bound 0.0154924 N
  const ContactMotion<double> slow{1e-4, 0.0, 0.01, 0.0, 0.0};
  const ContactMotion<double> fast{1e-4, 0.0, 1.0, 0.0, 0.0};
  const double bound = thesis.mu * 0.03521;
  double spring = 0.0, memory = 0.0, rest = 0.0;

  law.tangential = TangentialLaw::coulomb;
  EXPECT_DOUBLE_EQ(contactForce(law, slow, spring, memory, rest).tangential, -bound);
  law.tangential = TangentialLaw::viscous;
  EXPECT_DOUBLE_EQ(contactForce(law, slow, spring, memory, rest).tangential, -thesis.gt * 0.01);
  EXPECT_DOUBLE_EQ(contactForce(law, fast, spring, memory, rest).tangential, -bound);
  EXPECT_EQ(spring, 0.0);

  law.tangential = TangentialLaw::spring;
  spring = 2e-5;
  EXPECT_DOUBLE_EQ(contactForce(law, slow, spring, memory, rest).tangential, -thesis.kt * 2e-5);
  EXPECT_DOUBLE_EQ(spring, 2e-5 + 0.01 * 1e-6);  // stretched after the force
  spring = 1e-4;                                 // 0.02671 N, beyond the bound
  const ContactForce<double> slipping = contactForce(law, slow, spring, memory, rest);
  EXPECT_EQ(slipping.sliding, 1.0);
  EXPECT_DOUBLE_EQ(slipping.tangential, -bound);
  EXPECT_DOUBLE_EQ(spring, bound / thesis.kt);

  law.tangential = TangentialLaw::springDashpot;
  spring = 2e-5;
  EXPECT_DOUBLE_EQ(contactForce(law, slow, spring, memory, rest).tangential,
                   -thesis.kt * 2e-5 - thesis.gt * 0.01);
  law.resetSpringOnly = true;
  spring = 2e-5;
  contactForce(law, fast, spring, memory, rest);
  EXPECT_NEAR(-thesis.kt * spring - thesis.gt * 1.0, -bound,
              1e-16);  // together they carry the bound
  law.dashpotOutsideBound = true;
  spring = 2e-5;  // within the bound by itself, so the dashpot comes on top of it
  EXPECT_DOUBLE_EQ(contactForce(law, fast, spring, memory, rest).tangential,
                   -thesis.kt * 2e-5 - thesis.gt * 1.0);
}

}  // namespace
