// A disk that nothing touches.
#include "runs/conformance/check_list.hpp"
#include "runs/conformance/exam.hpp"

namespace crossgrain::conformance::free_motion {
namespace {

constexpr double flight = 0.05;  // [s]

Scene oneDisk(const ContactLaw& law) {
  Scene scene = emptyScene(law, 20.0);
  addDisk(scene, smallRadius, smallMass, {0.002, -0.001}, {0.31, -0.17}, 5.0);
  return scene;
}

void fliesStraight(Exam& it) {
  for (const Precision precision : it.can.precisions) {
    Scene scene = oneDisk(it.law());
    scene.precision = precision;
    it.load(scene);
    it.examined(precisionNamed(precision));
    const Snapshot after = it.at(flight);
    const Vec2 flown = after.positionTime * scene.disks.velocity[0];
    const double allowed = precision == Precision::float32 ? 1e-5 : 1e-12;
    const Tolerance rounding = {allowed, allowed, "roundings of the additions, of the distance"};
    it.equal(it.realised.precision, toString(precision), "the precision");
    it.expect(close(Vec2(after.position[0] - scene.disks.position[0]), flown, rounding),
              "the way flown [m]");
    it.expect(close(after.velocity[0], scene.disks.velocity[0], rounding), "the velocity [m/s]");
    it.expect(close(spinsOf(scene, after)[0], 5.0, rounding), "the spin [rad/s]");
    if (after.contacts) it.equal(after.contacts->size(), 0u, "contacts of a disk alone");
  }
}

void fallsFreely(Exam& it) {
  Scene scene = oneDisk(it.law());
  scene.gravity = {1.5, -9.81};
  it.load(scene);
  it.examined(toString(Effect::gravity));
  const Snapshot after = it.at(flight);
  const double t = after.positionTime;
  const Vec2 expected =
      scene.disks.position[0] + t * scene.disks.velocity[0] + 0.5 * t * t * scene.gravity;
  // Second-order schemes are exact for a constant force; Euler's, whose velocity lags, is off by
  // ½ g t dt.
  const bool exact = it.realised.velocityLag == 0.0;
  const Tolerance scheme =
      exact ? it.byPrecision(1e-12, 1e-5, "roundings of the additions")
            : Tolerance{0.5001 * scene.gravity.norm() * t * it.realised.dt, 0.0, "first order"};
  it.expect(close(after.position[0], expected, scheme), "the position [m]");
  it.expect(
      close(after.velocity[0], Vec2(scene.disks.velocity[0] + after.velocityTime * scene.gravity),
            it.byPrecision(1e-12, 1e-5, "roundings of the additions")),
      "the velocity [m/s]");
  it.expect(close(spinsOf(scene, after)[0], 5.0, it.byPrecision(1e-12, 1e-5, "nothing turns it")),
            "the spin [rad/s]");
}

BottomPlate roughPlate(bool spin) {
  return thesisBottom<BottomPlate>(0.05, spin);
}

/// Everything slides at once, γ_b v > µ_b m g: the disk loses µ_b g t of its speed and, where the
/// plate brakes spins, µ_b m g (2/3) a / (½ m a²) · t = (4/3)(µ_b g/a) t of its spin.
void bottomPlateBrakesADisk(Exam& it) {
  for (const bool spin : {false, true}) {
    Scene scene = oneDisk(it.law());
    scene.disks.spin[0] = 30.0;
    scene.bottom = roughPlate(spin);
    it.load(scene);
    it.examined(toString(spin ? Effect::bottomSpinFriction : Effect::bottomFriction));
    const double end = 0.02;
    const Snapshot after = it.at(end);
    const double lost = scene.bottom->mu * scene.bottom->gravity * after.velocityTime;
    const double speed = scene.disks.velocity[0].norm();
    const Vec2 expected = scene.disks.velocity[0] * (1.0 - lost / speed);
    const Tolerance step = {scene.bottom->mu * scene.bottom->gravity * it.realised.dt, 0.0,
                            "whether the plate acts in the first half step"};
    it.expect(close(after.velocity[0], expected, step), "the velocity [m/s]");
    const double slower = spin ? 4.0 / 3.0 * lost / smallRadius : 0.0;
    const Tolerance turn = {4.0 / 3.0 * step.absolute / smallRadius, 0.0, step.why};
    it.expect(close(spinsOf(scene, after)[0], 30.0 - slower, turn), "the spin [rad/s]");
  }
}

}  // namespace
std::span<const Check> checks() {
  static constexpr std::array list = {
      Check{"FliesStraight", "a disk alone flies straight", fliesStraight},
      Check{"FallsFreely", "a disk falls freely", fallsFreely},
      Check{"BottomPlateBrakesADisk", "the bottom plate brakes a disk", bottomPlateBrakesADisk},
  };
  return list;
}

}  // namespace crossgrain::conformance::free_motion
