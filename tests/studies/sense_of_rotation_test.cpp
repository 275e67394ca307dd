// The mirror image of a run, y → −y, is a run whose wheel turns the other way. All that has a sense
// of rotation changes its sign, and nothing else changes.
#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <set>
#include <sstream>

#include "cases/couette.hpp"
#include "studies/flow/averages.hpp"
#include "studies/flow/run.hpp"
#include "tests/studies/quick_cell.hpp"

namespace {

using namespace crossgrain;

Packing mirrored(Packing packing) {
  for (auto* vectors : {&packing.disks.position, &packing.disks.velocity})
    for (Vec2& v : *vectors) v.y() = -v.y();
  for (double& spin : packing.disks.spin) spin = -spin;
  packing.wheelAngle = -packing.wheelAngle;
  return packing;
}

/// One packing of the quick cell after a third of a rotation, seen as it is and in the mirror.
class SenseOfRotation : public testing::Test {
 protected:
  static constexpr double end = 0.05;  // s: 1250 steps, before rounding has grown to be seen
  static constexpr int snapshots = 25;

  static void SetUpTestSuite() {
    as_ = test::quickCell({"preparation.rotations=0.3"});
    opposite_ = test::quickCell({"cell.omega=-1.0"});
    const auto engine = makeGrain();
    packing_ = preparePacking(as_, 0, timeStep(as_), *engine, [](double) {});
    run(as_, packing_, one_, oneEnd_);
    run(opposite_, mirrored(packing_), other_, otherEnd_);
  }

  static void run(const Case& setup, const Packing& packing, FlowRun& averages, Snapshot& last) {
    const Scene scene = couetteScene(setup, packing, timeStep(setup));
    const auto engine = makeGrain();
    const EffectiveParameters effective = engine->load(scene, {});
    FlowAverages collected(setup, scene);
    for (int k = 1; k <= snapshots; ++k) {
      engine->advance(end * k / snapshots);
      collected.add(last = engine->snapshot(ContactReport::instant));
    }
    collected.describe(effective, averages);
  }

  /// @param sign  of the mirrored numbers over the others
  static void expectSame(const Numbers& a, const Numbers& b, double sign, const std::string& what) {
    ASSERT_EQ(a.size(), b.size()) << what;
    double scale = 0.0;
    for (const auto& value : a)
      if (value) scale = std::max(scale, std::abs(*value));
    for (std::size_t k = 0; k < a.size(); ++k) {
      ASSERT_EQ(a[k].has_value(), b[k].has_value()) << what << " " << k;
      if (a[k]) {
        EXPECT_NEAR(sign * *b[k], *a[k], close * scale) << what << " " << k;
      }
    }
  }

  /// Of the largest value: rounding of 10⁻¹⁶ has grown by e^(λt) in the chaos of the packing.
  static constexpr double close = 1e-6;

  static inline Case as_, opposite_;
  static inline Packing packing_;
  static inline FlowRun one_, other_;
  static inline Snapshot oneEnd_, otherEnd_;
};

TEST_F(SenseOfRotation, MirroredPacking_MovesAsTheMirrorImage) {
  const double d = 2.0 * couetteIn(as_).particles.smallRadius;
  const double rim = couetteIn(as_).cell.innerRadius;
  for (std::size_t i = 0; i < oneEnd_.position.size(); ++i) {
    const Vec2 image(otherEnd_.position[i].x(), -otherEnd_.position[i].y());
    const Vec2 velocity(otherEnd_.velocity[i].x(), -otherEnd_.velocity[i].y());
    EXPECT_LT((image - oneEnd_.position[i]).norm(), 1e-9 * d) << i;
    EXPECT_LT((velocity - oneEnd_.velocity[i]).norm(), close * rim) << i;
    EXPECT_NEAR((*otherEnd_.spin)[i], -(*oneEnd_.spin)[i], close * rim / d) << i;
  }
  EXPECT_NEAR(otherEnd_.bodies[0].angle, -oneEnd_.bodies[0].angle, 1e-12);
}

TEST_F(SenseOfRotation, ProfilesWithOneAzimuthalIndex_ChangeTheirSign) {
  std::istringstream ofSense(
      "azimuthal_velocity spin stress_rp stress_pr stress_antisymmetric dynamic_stress_rp "
      "fluctuation_stress_rp full_stress_rp fabric_rp couple_stress_zr velocity_gradient "
      "shear_rate "
      "continuum_rotation excess_rotation"),
      ofNone(
          "volume_fraction radial_velocity stress_rr stress_pp stress_trace dynamic_stress_pp "
          "stress_deviator fabric_trace coordination rotational_stress density fabric_deviator");
  using Words = std::istream_iterator<std::string>;
  const std::set<std::string> flipped(Words(ofSense), {}), kept(Words(ofNone), {});
  std::size_t seen = 0;
  for (std::size_t k = 0; k < one_.profiles.size(); ++k) {
    const Profile& a = one_.profiles[k];
    const Profile& b = other_.profiles[k];
    const std::string& field = a.field;
    ASSERT_EQ(b.field, field);
    if (!flipped.contains(field) && !kept.contains(field)) continue;
    ++seen;
    expectSame(a.mean, b.mean, flipped.contains(field) ? -1.0 : 1.0, field);
    expectSame(a.standardError, b.standardError, 1.0, "error of " + field);
  }
  EXPECT_EQ(seen, flipped.size() + kept.size());
}

TEST_F(SenseOfRotation, Series_ChangeTheSignOfTheTorqueAlone) {
  for (const auto& [name, values] : *one_.series)
    expectSame(values, valuesOf(*other_.series, name), name == "wheel_torque" ? -1.0 : 1.0, name);
}

TEST_F(SenseOfRotation, FitsAndNumbers_KeepTheirValues) {
  ASSERT_GT(one_.fits.size(), 6u);
  std::size_t fitted = 0;
  for (std::size_t k = 0; k < one_.fits.size(); ++k) {
    const FitRow& a = one_.fits[k];
    const FitRow& b = other_.fits[k];
    ASSERT_EQ(a.name, b.name);
    ASSERT_EQ(a.value.has_value(), b.value.has_value()) << a.name;
    if (!a.value) continue;
    ++fitted;
    EXPECT_NEAR(*b.value, *a.value, 1e-5 * std::abs(*a.value)) << a.name;
  }
  EXPECT_GT(fitted, 1u);  // a run this short refuses the others, either way the same ones
  for (std::size_t k = 0; k < one_.head.size(); ++k) {
    const HeadNumber& a = one_.head[k];
    const double sign = a.name == "stress_ratio_wheel" ? -1.0 : 1.0;  // σ_rφ/σ_rr
    expectSame({a.value}, {other_.head[k].value}, sign, a.name);
  }
}

TEST_F(SenseOfRotation, Distributions_AreTheSame) {
  std::size_t seen = 0;
  for (std::size_t k = 0; k < one_.distributions.size(); ++k) {
    const Distribution& a = one_.distributions[k];
    Distribution b = other_.distributions[k];
    ASSERT_EQ(a.quantity, b.quantity);
    if (a.quantity == "contact_direction")  // α → −α
      std::ranges::reverse(b.density);
    const double cells = static_cast<double>(a.density.size());
    double moved = 0.0, all = 0.0;
    for (std::size_t cell = 0; cell < a.density.size(); ++cell) {
      moved += std::abs(a.density[cell] - b.density[cell]);
      all += std::abs(a.density[cell]);
    }
    // A value on the edge of a bin may fall to either side.
    EXPECT_LT(moved, 1e-3 * all) << a.quantity << " " << a.ring.value_or(-1) << " of " << cells;
    ++seen;
  }
  EXPECT_GT(seen, 20u);
}

TEST_F(SenseOfRotation, Packing_IsPreparedInTheCasesSense) {
  Case setup = opposite_;
  couetteIn(setup).filling.shrinkTime = 0.1;
  couetteIn(setup).filling.rotations = 0.01;
  const auto engine = makeGrain();
  const Packing packing = preparePacking(setup, 0, timeStep(setup), *engine, [](double) {});
  EXPECT_NEAR(packing.wheelAngle, -(0.1 + 0.02 * M_PI), 4e-5);
}

}  // namespace
