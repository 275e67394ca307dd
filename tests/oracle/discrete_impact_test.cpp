#include "oracle/impact.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>

#include "oracle/collision_oracle.hpp"
#include "tests/support/pairs.hpp"

namespace {

using namespace crossgrain;

/// k_n = 1 N/m, m₁₂ = 1 kg: at dt = 1 s Störmer's recursion is x_{k+1} = x_k − x_{k−1} in contact.
ContactLaw unitLaw(Integrator integrator = Integrator::positionVerlet) {
  ContactLaw law{.tangential = TangentialLaw::none, .kn = 1.0};
  law.conventions.integrator = integrator;
  return law;
}

TEST(DiscreteImpact, AFreeFlightIsAStraightLine) {
  const auto motion = discreteImpact(unitLaw(), {8.0, -0.5, 1.0, 0.25}, 4);
  ASSERT_EQ(motion.size(), 5u);
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_EQ(motion[k].gap, 8.0 - 0.125 * static_cast<double>(k));
    EXPECT_EQ(motion[k].halfStep, -0.5);
    EXPECT_EQ(motion[k].velocity, -0.5);
  }
}

/// Touching at a step with speed 1: x = 0, −1, −1, 0, by hand, and away as it came.
TEST(DiscreteImpact, ASpringByHand) {
  for (const Integrator integrator : {Integrator::positionVerlet, Integrator::velocityVerlet}) {
    const auto motion = discreteImpact(unitLaw(integrator), {0.0, -1.0, 1.0, 1.0}, 4);
    const double gap[] = {0.0, -1.0, -1.0, 0.0, 1.0}, halfStep[] = {-1.0, -1.0, 0.0, 1.0, 1.0},
                 velocity[] = {-1.0, -0.5, 0.5, 1.0, 1.0};
    for (std::size_t k = 0; k < 5; ++k) {
      EXPECT_EQ(motion[k].gap, gap[k]) << k;
      EXPECT_EQ(motion[k].halfStep, halfStep[k]) << k;
      EXPECT_EQ(motion[k].velocity, velocity[k]) << k;
    }
  }
}

/// γ_n = 1/2 kg/s and speed 1, by hand. x_1 = −1; then for each damping velocity
///   lagged     f_1 = 1 + ½         = 3/2 → u_{3/2} = ½,  x_2 = −½
///   predicted  the same, a_0 being 0; f_2 = ½ − ½ (½ + ¾) = −1/8, where lagged has ½ − ¼ = ¼
///   implicit   f_1 = (3/2)/(1 + ¼) = 6/5 → u_{3/2} = 1/5, x_2 = −4/5
TEST(DiscreteImpact, ADashpotByHand) {
  const auto with = [](DampingVelocity damping, Tension tension, Integrator integrator) {
    ContactLaw law = unitLaw(integrator);
    law.gn = 0.5;
    law.conventions.dampingVelocity = damping;
    law.conventions.tension = tension;
    return discreteImpact(law, {0.0, -1.0, 1.0, 1.0}, 3);
  };
  using enum DampingVelocity;
  const auto verlet = Integrator::positionVerlet, euler = Integrator::semiImplicitEuler;
  EXPECT_EQ(with(lagged, Tension::allow, verlet)[2].gap, -0.5);
  EXPECT_EQ(with(lagged, Tension::allow, verlet)[3].halfStep, 0.75);
  EXPECT_EQ(with(predicted, Tension::allow, verlet)[3].halfStep, 0.375);
  EXPECT_EQ(with(predicted, Tension::cut, verlet)[3].halfStep, 0.5);
  EXPECT_NEAR(with(implicit, Tension::allow, verlet)[2].gap, -0.8, 1e-16);
  // Euler's velocity is that of the half step, whatever it is asked to predict.
  EXPECT_EQ(with(predicted, Tension::allow, euler)[3].velocity, 0.75);
}

/// From an overlap on, a_0 takes the velocity given: x_0 = −1, v_0 = 2, γ_n = ½: a_0 = 1 − 1 = 0.
TEST(DiscreteImpact, TheFirstKickIsHalfAKickOfVerlet) {
  ContactLaw law = unitLaw();
  EXPECT_EQ(discreteImpact(law, {-1.0, 0.0, 1.0, 1.0}, 1)[1].halfStep, 0.5);
  law.conventions.integrator = Integrator::semiImplicitEuler;
  EXPECT_EQ(discreteImpact(law, {-1.0, 0.0, 1.0, 1.0}, 1)[1].halfStep, 1.0);
  law.gn = 0.5;
  EXPECT_EQ(discreteImpact(law, {-1.0, 2.0, 1.0, 1.0}, 1)[1].halfStep, 2.0);
}

using Matrix = Eigen::Matrix<long double, 3, 3>;

/// By squaring.
Matrix power(Matrix factor, int n) {
  Matrix product = Matrix::Identity();
  for (; n > 0; n /= 2) {
    if (n % 2 != 0) product = product * factor;
    factor = factor * factor;
  }
  return product;
}

/// The same as powers of a matrix: while spring and dashpot act, a step takes (x, u, a) to
///   u' = u + h a, x' = x + h u', a' = −K x' − G u',  K = k_n/m₁₂, G = γ_n/m₁₂,
/// predicted with u' + a h/2 in place of u', implicit over 1 + h G/2.
TEST(DiscreteImpact, IsThePowerOfItsStepMatrix) {
  using Vector = Eigen::Matrix<long double, 3, 1>;
  using enum DampingVelocity;
  const double mass = test::smallPair().reducedMass();
  for (const DampingVelocity damping : {lagged, predicted, implicit}) {
    ContactLaw law = test::thesisLaw();
    law.conventions.dampingVelocity = damping;
    const DiscreteStart start{1e-7, -0.01, mass, contactTime(law, mass) / 50.0};
    const auto motion = discreteImpact(law, start, 60);
    const long double h = start.dt, divisor = damping == implicit ? 1 + h * law.gn / mass / 2 : 1;
    const long double K = law.kn / mass / divisor, G = law.gn / mass / divisor;
    Matrix step;
    step << 1, h, h * h, 0, 1, h, -K, -K * h - G, -K * h * h - G * h;
    if (damping == predicted) step(2, 2) -= G * h / 2;
    ASSERT_LT(motion[1].gap, 0.0);
    const Vector first(motion[1].gap, motion[1].halfStep,
                       -K * motion[1].gap - G * motion[1].halfStep);
    for (int n = 1; motion[static_cast<std::size_t>(n)].gap < 0.0; ++n) {
      const Vector now = power(step, n) * first;
      const DiscreteMotion& found = motion[static_cast<std::size_t>(n) + 1];
      EXPECT_NEAR(found.gap, static_cast<double>(now[0]), 1e-14 * 6e-6) << n;
      EXPECT_NEAR(found.halfStep, static_cast<double>(now[1]), 1e-14 * 0.01) << n;
    }
  }
}

/// Against x = −(v/ω) e^(−ηt) sin ωt (Lätzel 2003, section 4.1) until the disks are halfway
/// through: first order where dashpots lag, second where they do not, as the disks touch half way
/// between two steps.
TEST(DiscreteImpact, ConvergesToTheImpactItself) {
  const double mass = test::smallPair().reducedMass(), speed = 0.01;
  struct Scheme {
    Integrator integrator;
    DampingVelocity damping;
    double order;
  };
  using enum DampingVelocity;
  for (const Scheme& scheme : {Scheme{Integrator::positionVerlet, lagged, 1.0},
                               Scheme{Integrator::positionVerlet, predicted, 2.0},
                               Scheme{Integrator::velocityVerlet, implicit, 2.0},
                               Scheme{Integrator::semiImplicitEuler, lagged, 1.0}}) {
    ContactLaw law = test::thesisLaw();
    law.conventions.integrator = scheme.integrator;
    law.conventions.dampingVelocity = scheme.damping;
    const double eta = law.gn / (2.0 * mass), omega = std::sqrt(law.kn / mass - eta * eta);
    const auto error = [&](std::size_t steps) {
      const double dt = contactTime(law, mass) / static_cast<double>(steps);
      const auto motion = discreteImpact(law, {0.5 * dt * speed, -speed, mass, dt}, steps / 2);
      double largest = 0.0;
      for (std::size_t k = 1; k < motion.size(); ++k) {
        const double t = (static_cast<double>(k) - 0.5) * dt;
        const double x = -speed / omega * std::exp(-eta * t) * std::sin(omega * t);
        largest = std::max(largest, std::abs(motion[k].gap - x) * omega / speed);
      }
      return largest;
    };
    EXPECT_NEAR(std::log2(error(800) / error(1600)), scheme.order, 0.05)
        << static_cast<int>(scheme.integrator) << " " << static_cast<int>(scheme.damping);
  }
}

/// Without tension too: e_n tends to that of the closed form, 0.3408.
TEST(DiscreteImpact, EndsWithTheRestitutionOfTheLaw) {
  const double mass = test::smallPair().reducedMass(), speed = 0.01;
  for (const Tension tension : {Tension::allow, Tension::cut}) {
    ContactLaw law = test::thesisLaw();
    law.conventions.tension = tension;
    const double dt = contactTime(law, mass) / 10000.0;
    const auto motion = discreteImpact(law, {0.5 * dt * speed, -speed, mass, dt}, 20000);
    EXPECT_NEAR(motion.back().velocity / speed, restitutionOfLinearLaw(law, mass), 1e-4);
  }
}

TEST(DiscreteImpact, ARigidLawHasNone) {
  EXPECT_THROW(discreteImpact(test::rigidLaw(0.9, 0.0, 0.0), {0.0, -1.0, 1.0, 1.0}, 1),
               std::invalid_argument);
}

/// Two spheres of 0.5 m and 1 kg under every law of cohesion, in so fine steps that it is the
/// impact itself: e_n of the oracle in continuous time, at second order.
TEST(DiscreteImpact, OfCohesion_TendsToTheImpactItself) {
  const CollidingPair pair{{0.5, 0.5}, {1.0, 1.0}, {0.1, 0.1}};
  using enum UnloadingStiffness;
  for (const auto& [cohesion, unloading] :
       {std::pair(CohesionLaw::area, current), std::pair(CohesionLaw::dmt, current),
        std::pair(CohesionLaw::jkr, current), std::pair(CohesionLaw::elastoPlastic, current),
        std::pair(CohesionLaw::elastoPlastic, lagged)}) {
    ContactLaw law = unitLaw();
    law.conventions.unloadingStiffness = unloading;
    law.normal = cohesion == CohesionLaw::jkr ? NormalLaw::hertz : NormalLaw::linear;
    law.cohesion = cohesion;
    law.kn = cohesion == CohesionLaw::jkr ? 4.0 / 3.0 * 5e4 : 1e4;
    law.w = cohesion == CohesionLaw::jkr ? 200.0 : 20.0;
    law.kc = cohesion == CohesionLaw::area ? 2e3 : 1e3;
    law.kUnload = 4e4;
    law.plasticDepth = 0.05;
    const double speed = 5.0, time = impactTime(law, {0.5, 0.25, speed});
    const double expected = oracleOutcome(law, pair, {0.0, speed}).en;
    const auto error = [&](double steps) {
      const double dt = time / steps;
      const auto motion = discreteImpact(law, {0.5 * dt * speed, -speed, 0.5, dt, pair},
                                         static_cast<std::size_t>(3.0 * steps));
      return std::abs(motion.back().velocity / speed - expected);
    };
    EXPECT_LT(error(20000), 1e-3) << static_cast<int>(cohesion);
    EXPECT_LT(error(20000), 0.5 * error(1000)) << static_cast<int>(cohesion);
  }
}

/// A critical damper of a linear law is a constant one: γ √(m₁₂ k).
TEST(DiscreteImpact, TakesDampersOfALinearLaw) {
  ContactLaw constant = unitLaw(), critical = unitLaw();
  constant.gn = 0.5;
  critical.damper = Damper::critical;
  critical.gn = 0.5;
  EXPECT_EQ(discreteImpact(constant, {0.0, -1.0, 1.0, 1.0}, 3)[3].gap,
            discreteImpact(critical, {0.0, -1.0, 1.0, 1.0}, 3)[3].gap);
}

}  // namespace
