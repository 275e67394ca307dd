// The case files that come with the program, against numbers of thesis-facts and table 3.2.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cases/collision_scene.hpp"
#include "cases/couette.hpp"
#include "cases/endpoints.hpp"
#include "cases/loader.hpp"
#include "cases/time_step.hpp"
#include "law/law_options.hpp"
#include "oracle/collision_oracle.hpp"
#include "oracle/impact.hpp"
#include "tests/support/thesis.hpp"

namespace crossgrain::test {
namespace {

const std::filesystem::path folder = CROSSGRAIN_CASES;

std::vector<Case> shipped(const std::string& name) {
  return loadCase(folder / name);
}

TEST(ShippedCases, ThesisCell_VolumeFraction) {
  const Case c = shipped("couette/nu-0.804.toml").front();
  EXPECT_EQ(couetteIn(c).particles.small + couetteIn(c).particles.large, 2921);
  EXPECT_NEAR(volumeFraction(c), 0.8041, 0.00005);  // facts 1.1, four digits
  EXPECT_EQ(timeStep(c), 4e-5);
  EXPECT_NEAR(contactTime(c.law, lightestReducedMass(c)), smallContactTime, 0.005e-3);
  EXPECT_EQ(couetteIn(c).times.rings, 20);
  EXPECT_EQ(c.averaging.margins.size(), 7u);
}

TEST(ShippedCases, QuickCell_HasTheThesisLaw) {
  const Case c = shipped("couette/quick.toml").front();
  const Case reference = shipped("couette/nu-0.804.toml").front();
  EXPECT_NEAR(volumeFraction(c), 0.760, 0.0005);
  EXPECT_EQ(c.averaging.endpoints.size(), endpointTable().size());
  EXPECT_EQ(c.law, reference.law);
  EXPECT_EQ(c.law.kn, thesis.kn);
  EXPECT_EQ(c.law.gn, thesis.gn);
  EXPECT_EQ(c.law.mu, thesis.mu);
  EXPECT_EQ(c.law.kt, thesis.kt);
  EXPECT_EQ(c.law.gt, thesis.gt);
  ASSERT_TRUE(c.bottom);
  EXPECT_EQ(c.bottom->mu, 2e-5);
  EXPECT_EQ(c.bottom->tauM, 1e-4);
}

TEST(ShippedCases, ThesisCases_SayTheThesisConventions) {
  for (const char* const name : {"couette/nu-0.804.toml", "couette/quick.toml",
                                 "collision/figure-4-3.toml", "assembly/roll.toml"}) {
    EXPECT_EQ(shipped(name).front().law.conventions, LawConventions{}) << name;
  }
}

/// The oracle's end of each collision of a variant.
std::vector<CollisionEnd> endsOf(const std::string& name, const std::string& variant) {
  std::vector<CollisionEnd> ends;
  for (const Case& c : shipped(name))
    if (c.variant == variant)
      for (const CollisionStart& start : collisionStarts(c))
        ends.push_back(oracleOutcome(c.law, collidingPair(c), start));
  return ends;
}

TEST(ShippedCases, CasesWithoutConventions_AreWhatWasMeasured) {
  for (const char* const name : {"space/benchmarks.toml", "space/chung-ooi.toml"})
    for (const Case& c : shipped(name)) {
      EXPECT_EQ(c.law.conventions.springUpdate, SpringUpdate::before) << name;
      EXPECT_EQ(c.law.conventions.springReset, SpringReset::springOnly) << name;
      EXPECT_EQ(c.law.conventions.leverArm, LeverArm::overlapMiddle) << name;
    }
  // MFiX' DEM05, rebound of the centre at 5, 10, … 50°: right to 0.1°. 35° and 45° are not given.
  const std::vector<double> angles = {3.99,  6.60, 9.09,  12.21, 16.17,
                                      21.48, 0.0,  33.23, 0.0,   45.22};
  const auto dem05 = endsOf("space/benchmarks.toml", "mfix-dem05");
  ASSERT_EQ(dem05.size(), angles.size());
  for (std::size_t k = 0; k < angles.size(); ++k)
    if (angles[k] > 0.0) {
      EXPECT_NEAR(dem05[k].reboundAngle * 180.0 / std::numbers::pi, angles[k], 0.1) << k;
    }
  // Foerster et al.: e = 0.97, and in sliding Ψ_f = Ψ_i − 7/2 · 0.092 · 1.97.
  const auto glass = endsOf("space/benchmarks.toml", "glass-foerster");
  EXPECT_NEAR(glass.front().en, 0.97, 0.001);
  EXPECT_NEAR(glass.back().psi, 2.0 - 0.63434, 0.005);
  // Chung and Ooi, test 4, read off a figure: e_t at 5, 10, 15, … 85°, of every second start.
  const std::vector<double> et = {.948, .687, .624, .616, .634, .684, .737, .781, 0.,
                                  .845, 0.,   .893, 0.,   .932, 0.,   .966, .983};
  const auto test4 = endsOf("space/chung-ooi.toml", "test-4");
  ASSERT_EQ(test4.size(), 33u);
  for (std::size_t k = 0; k < et.size(); ++k)
    if (et[k] > 0.0) {
      EXPECT_NEAR(*test4[2 * k].et, et[k], 0.01) << 5 * (k + 1) << " degrees";
    }
  // Test 1 of Hertz' theory. Rigid spheres slide beyond 64.5°: a ω′ is 5 µ v_n in test 5, less by
  // the arm's δ, 0.7 % of a; the centre gets µ (1 + e) v_n = 0.4 · 1.5503 · 0.2 m/s in test 6, with
  // e of the cut law, as friction sees no pull: 0.5503 of a Hertz contact whose damper gives 0.5
  // (Tsuji et al. 1992; a fourth-order integration of that contact alone).
  EXPECT_NEAR(*endsOf("space/chung-ooi.toml", "test-1").front().maxOverlap, 274.1e-6, 0.2e-6);
  EXPECT_NEAR(*endsOf("space/chung-ooi.toml", "test-2").front().maxOverlap, 49.7e-6, 0.1e-6);
  EXPECT_NEAR(endsOf("space/chung-ooi.toml", "test-3").front().en, 0.6, 0.001);
  EXPECT_NEAR(
      std::abs(endsOf("space/chung-ooi.toml", "test-5").back().spin[0]) * 1e-5 / (0.3 * 5.0), 5.0,
      0.04);
  const auto test6 = endsOf("space/chung-ooi.toml", "test-6");
  EXPECT_NEAR(std::abs(test6.back().centrePsi) * 0.2, 0.4 * 1.5503 * 0.2, 0.001);
  for (const CollisionEnd& end : endsOf("space/chung-ooi.toml", "test-7"))
    EXPECT_NEAR(end.psi, 0.0, 1e-9);
  EXPECT_NEAR(endsOf("space/chung-ooi.toml", "test-8").back().psi, test6.back().psi, 0.01);
}

TEST(ShippedCases, Figure43_FourLawsWithAndWithoutTension) {
  const auto cases = shipped("collision/figure-4-3.toml");
  ASSERT_EQ(cases.size(), 8u);
  for (std::size_t k = 0; k < 8; ++k) {
    const Case& c = cases[k];
    ASSERT_EQ(collisionIn(c).psi.size(), 41u);
    EXPECT_EQ(collisionIn(c).psi.front(), 0.0);
    EXPECT_DOUBLE_EQ(collisionIn(c).psi[5], 0.5);
    EXPECT_EQ(collisionIn(c).psi.back(), 4.0);
    EXPECT_EQ(c.variant, lawOptionValue(c.law, "tangential") +
                             (c.law.conventions.tension == Tension::cut ? "-cut" : "-tension"));
    // A spring stretched after the force lags by more than the margin at t_c/50.
    const double coarsest = c.law.tangential == TangentialLaw::spring ? 200.0 : 50.0;
    EXPECT_NEAR(collisionTimeSteps(c)[0], smallContactTime / coarsest, 0.1e-6);
    EXPECT_NEAR(collisionTimeSteps(c).back(), smallContactTime / 2000, 0.005e-6);
  }
  EXPECT_EQ(cases[0].law.tangential, TangentialLaw::coulomb);
  EXPECT_EQ(cases[7].law.tangential, TangentialLaw::springDashpot);
}

TEST(ShippedCases, Hertz_ConstantsOfTheMaterials) {
  // Test 2 of Chung and Ooi: E₁₂ = E/(1 − ν²) of an elastic sphere on a rigid wall.
  const auto rigidWall = shipped("collision/chung-ooi-2.toml");
  EXPECT_NEAR(rigidWall.front().law.kn, 4.0 / 3.0 * 70e9 / (1.0 - 0.09), 1.0);
  EXPECT_TRUE(collisionIn(rigidWall.front()).wall);
  // Test 4: both of one material, G₁₂ = E/(4 (1 + ν)(2 − ν)), k_t/k_n = 3 (1 − ν)/(2 − ν).
  const auto oblique = shipped("collision/chung-ooi-4.toml");
  const ContactLaw& law = oblique.front().law;
  EXPECT_NEAR(law.kt, 8.0 * 380e9 / (4.0 * 1.23 * 1.77), 1e-3);
  EXPECT_NEAR(law.kt / law.kn, 3.0 * 0.77 / 1.77, 1e-12);
  EXPECT_NEAR(*closedRestitution(law, 1.0), 0.98, 1e-12);
  const auto starts = collisionStarts(oblique.front());
  ASSERT_EQ(starts.size(), 33u);
  for (const CollisionStart& start : starts)
    EXPECT_NEAR(start.vn * std::hypot(1.0, start.psi), 3.9, 1e-12);
  EXPECT_NEAR(starts.front().psi, std::tan(5.0 * std::numbers::pi / 180.0), 1e-15);
}

}  // namespace
}  // namespace crossgrain::test
