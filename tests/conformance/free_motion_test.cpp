// A disk that nothing touches.
#include "tests/conformance/conformance.hpp"

namespace crossgrain::test {
namespace {

constexpr double flight = 0.05;  // [s]

Scene oneDisk(const ContactLaw& law) {
  Scene scene = emptyScene(law, 20.0);
  addDisk(scene, smallRadius, smallMass, {0.002, -0.001}, {0.31, -0.17}, 5.0);
  return scene;
}

TEST_P(Conformance, FliesStraight) {
  const Scene scene = oneDisk(law());
  if (const auto why = refused(scene)) GTEST_SKIP() << *why;
  const Snapshot after = at(flight);
  const Vec2 flown = after.positionTime * scene.disks.velocity[0];
  const Tolerance rounding =
      byPrecision(1e-12, 1e-5, "roundings of the additions, of the distance");
  EXPECT_TRUE(close(Vec2(after.position[0] - scene.disks.position[0]), flown, rounding));
  EXPECT_TRUE(close(after.velocity[0], scene.disks.velocity[0], rounding));
  EXPECT_TRUE(close(spinsOf(scene, after)[0], 5.0, rounding));
  if (after.contacts) {
    EXPECT_EQ(after.contacts->size(), 0u);
  }
}

TEST_P(Conformance, FallsFreely) {
  Scene scene = oneDisk(law());
  scene.gravity = {1.5, -9.81};
  if (const auto why = refused(scene)) GTEST_SKIP() << *why;
  const Snapshot after = at(flight);
  const double t = after.positionTime;
  const Vec2 expected =
      scene.disks.position[0] + t * scene.disks.velocity[0] + 0.5 * t * t * scene.gravity;
  // Second-order schemes are exact for a constant force; Euler's, whose velocity lags, is off by
  // ½ g t dt.
  const bool exact = realised_.velocityLag == 0.0;
  const Tolerance scheme =
      exact ? byPrecision(1e-12, 1e-5, "roundings of the additions")
            : Tolerance{0.5001 * scene.gravity.norm() * t * realised_.dt, 0.0, "first order"};
  EXPECT_TRUE(close(after.position[0], expected, scheme));
  EXPECT_TRUE(close(after.velocity[0],
                    Vec2(scene.disks.velocity[0] + after.velocityTime * scene.gravity),
                    byPrecision(1e-12, 1e-5, "roundings of the additions")));
  EXPECT_TRUE(close(spinsOf(scene, after)[0], 5.0, byPrecision(1e-12, 1e-5, "nothing turns it")));
}

BottomPlate roughPlate(bool spin) {
  return thesisBottom<BottomPlate>(0.05, spin);
}

/// Everything slides at once, γ_b v > µ_b m g: the disk loses µ_b g t of its speed and, where the
/// plate brakes spins, µ_b m g (2/3) a / (½ m a²) · t = (4/3)(µ_b g/a) t of its spin.
TEST_P(Conformance, BottomPlateBrakesADisk) {
  for (const bool spin : {false, true}) {
    Scene scene = oneDisk(law());
    scene.disks.spin[0] = 30.0;
    scene.bottom = roughPlate(spin);
    if (const auto why = refused(scene)) GTEST_SKIP() << *why;
    const double end = 0.02;
    const Snapshot after = at(end);
    const double lost = scene.bottom->mu * scene.bottom->gravity * after.velocityTime;
    const double speed = scene.disks.velocity[0].norm();
    const Vec2 expected = scene.disks.velocity[0] * (1.0 - lost / speed);
    const Tolerance step = {scene.bottom->mu * scene.bottom->gravity * realised_.dt, 0.0,
                            "whether the plate acts in the first half step"};
    EXPECT_TRUE(close(after.velocity[0], expected, step));
    const double slower = spin ? 4.0 / 3.0 * lost / smallRadius : 0.0;
    const Tolerance turn = {4.0 / 3.0 * step.absolute / smallRadius, 0.0, step.why};
    EXPECT_TRUE(close(spinsOf(scene, after)[0], 30.0 - slower, turn));
  }
}

}  // namespace
}  // namespace crossgrain::test
