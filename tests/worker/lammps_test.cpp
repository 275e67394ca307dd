// LAMMPS and LIGGGHTS in their workers: materials, torques against rolling, bonds. All else that an
// engine must do is asked of it, as of every other, in tests/conformance; that flows of these laws
// are those of their mirrors, in tests/system/test_peers.py.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>

#include "adapters/registry.hpp"
#include "adapters/worker/worker_engine.hpp"
#include "support/data_folder.hpp"
#include "support/files.hpp"
#include "tests/support/scenes.hpp"

namespace crossgrain::test {
namespace {

Scene emptyScene(NormalLaw normal) {
  Scene scene;
  scene.name = "lammps test";
  scene.law.normal = normal;
  scene.law.tangential = TangentialLaw::none;
  scene.law.kn = normal == NormalLaw::hertz ? 1e6 : 1e3;
  scene.dt = 1e-5;
  return scene;
}

/// One worker for all tests of an engine: each test then also shows that loading starts afresh.
class LammpsWorkers : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    const bool lammps = GetParam() == std::string("lammps");
    if (!isOnPath(lammps ? "lmp" : "liggghts")) GTEST_SKIP() << GetParam() << " is not installed";
    setenv("OMPI_MCA_ess_singleton_isolated", "1", 1);  // as liggghts.toml does
    const ProgramCall call({"/usr/bin/python3", workerScript(GetParam()).string()});
    engine_ = std::make_unique<WorkerEngine>(
        GetParam(), call, std::filesystem::path(testing::TempDir()) / GetParam(), 120.0);
  }
  std::unique_ptr<WorkerEngine> engine_;
};

TEST_P(LammpsWorkers, Materials_PairsHaveTheirOwnStiffness) {
  Scene scene = emptyScene(NormalLaw::linear);
  const double overlap = 1e-5, apart = 2.0 * smallRadius - overlap;
  Materials materials;
  materials.names = {"soft", "hard"};
  for (const double kn : {1e3, 2e3, 2e3, 5e3}) {
    materials.laws.push_back(scene.law);
    materials.laws.back().kn = kn;
  }
  for (const auto& [of, at] :
       {std::pair{0, 0.0}, {0, apart}, {0, 1.0}, {1, 1.0 + apart}, {1, 2.0}}) {
    addDisk(scene, smallRadius, smallMass, {at, 0.0}, {0, 0});
    materials.ofDisk.push_back(of);
  }
  scene.bodies.push_back(diskWall({2.0 + apart, 0.0}, smallRadius));
  scene.bodies.push_back(planeWall({0.0, -1.0}, {0.0, 1.0}));
  materials.ofBody = {1, 1};
  for (const int of : {0, 1}) {
    addDisk(scene, smallRadius, smallMass, {1.0 * of, -1.0 + smallRadius - overlap}, {0, 0});
    materials.ofDisk.push_back(of);
  }
  scene.materials = materials;
  const EffectiveParameters effective = engine_->load(scene, {});
  EXPECT_TRUE(effective.effects.contains(Effect::pairMaterials));
  ASSERT_EQ(effective.pairs.size(), 3U);
  EXPECT_EQ(effective.pairs[1].pair, "soft with hard");
  EXPECT_EQ(effective.pairs[1].kn, 2e3);
  const Contacts contacts = engine_->snapshot(ContactReport::instant).contacts.value();
  std::vector<double> found;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    found.push_back(scene.lawOf(contacts.i[k], contacts.j[k]).kn);
    EXPECT_NEAR(contacts.normalForce[k], found.back() * overlap, 1e-9 * found.back() * overlap);
  }
  std::ranges::sort(
      found);  // soft with soft; with hard, with a plane; hard with wall disk and plane
  EXPECT_EQ(found, (std::vector{1e3, 2e3, 2e3, 5e3, 5e3}));
}

/// A disk that rests under gravity on a body and turns: J ω′ = −k_r L² θ, hence ω = Ω cos(ω₀ t),
/// ω₀² = k_r L²/J. Velocities and the first stretch are off by a step at most, ω₀ dt = 2e-3 of a
/// swing; k_r off by a thousandth makes 7e-3 after 2.2 turns.
void expectRollingOscillation(Engine& engine, WallBody body, double height, double length) {
  Scene scene = emptyScene(NormalLaw::linear);
  ContactLaw& law = scene.law;
  law.rolling = RollingLaw::spring;
  law.muR = 0.4;
  law.kr = 2.25 * law.kn * law.muR * law.muR;  // LIGGGHTS' epsd has no other
  scene.gravity = {0.0, -9.81};
  scene.dt = 1e-6;
  const double overlap = smallMass * 9.81 / law.kn, spin = 0.02;
  addDisk(scene, smallRadius, smallMass, {0.0, height - overlap}, {0, 0}, spin);
  scene.bodies.push_back(std::move(body));
  const EffectiveParameters effective = engine.load(scene, {});
  EXPECT_TRUE(effective.effects.contains(Effect::rollingResistance));
  EXPECT_TRUE(effective.effects.contains(Effect::rotation));
  const double inertia = scene.disks.inertia[0];
  const double frequency = length * std::sqrt(law.kr / inertia);
  for (const double turn : {0.1, 0.4, 1.0, 2.2}) {
    const double t = engine.advance(2.0 * std::numbers::pi * turn / frequency);
    const Snapshot now = engine.snapshot(ContactReport::instant);
    EXPECT_NEAR(now.spin->at(0), spin * std::cos(frequency * t), 4e-3 * spin);
    ASSERT_EQ(now.contacts->rollingTorque.size(), 1U);
    const double torque = -inertia * spin * frequency * std::sin(frequency * t);
    EXPECT_NEAR(now.contacts->rollingTorque[0], torque, 4e-3 * inertia * spin * frequency);
  }
}

TEST_P(LammpsWorkers, RollingSpringOfAPair_OscillatesAsItsStiffnessSays) {
  expectRollingOscillation(*engine_, diskWall({0.0, 0.0}, smallRadius), 2.0 * smallRadius,
                           0.5 * smallRadius);
}

TEST_P(LammpsWorkers, RollingSpringAtAPlane_OscillatesAsItsStiffnessSays) {
  expectRollingOscillation(*engine_, planeWall({0.0, 0.0}, {0.0, 1.0}), smallRadius, smallRadius);
}

// LAMMPS sorts atoms by bins, and of a huge box has more than it can count.
TEST_P(LammpsWorkers, HugeBox_IsNoSignal) {
  Scene scene = emptyScene(NormalLaw::linear);
  for (const double at : {0.0, 1e10 * smallRadius})
    addDisk(scene, smallRadius, smallMass, {at, 0.0}, {1e-3, 0.0});
  engine_->load(scene, {});
  engine_->advance(10 * scene.dt);
  EXPECT_NEAR(engine_->snapshot(ContactReport::none).position[0].x(), 1e-3 * 10 * scene.dt, 1e-15);
}

INSTANTIATE_TEST_SUITE_P(Both, LammpsWorkers, ::testing::Values("lammps", "liggghts"),
                         [](const auto& each) { return std::string(each.param); });

/// Of JKR by its definition: F over a = a_p x (Johnson, Kendall and Roberts 1971), x by bisection.
double jkrForce(double kn, double w, double radius, double overlap) {
  const double modulus = 0.75 * kn, pi = std::numbers::pi;
  const double peak = std::cbrt(9.0 * pi * w * radius * radius / (8.0 * modulus));
  const auto overlapAt = [&](double a) {
    return a * a / radius - std::sqrt(2.0 * pi * w * a / modulus);
  };
  double low = peak, high = 100.0 * peak;
  for (int k = 0; k < 200; ++k)
    (overlapAt(0.5 * (low + high)) < overlap ? low : high) = 0.5 * (low + high);
  return 4.0 * modulus * low * low * low / (3.0 * radius) -
         std::sqrt(8.0 * pi * w * modulus * low * low * low);
}

using LammpsAlone = LammpsWorkers;

TEST_P(LammpsAlone, BondOfJkr_OutlastsLists) {
  // Disks part slowly while they fly 20 radii, so that LAMMPS makes its lists anew again and again;
  // with the skin as asked for, a third of the bond's range a_p²/(3 R₁₂), it would lose the bond
  // there. Beyond that range nothing acts.
  Scene scene = emptyScene(NormalLaw::hertz);
  ContactLaw& law = scene.law;
  law.cohesion = CohesionLaw::jkr;
  law.w = 1.0;
  const double radius = 0.5 * smallRadius, heavy = 1e3;
  const double peak = std::cbrt(1.5 * std::numbers::pi * law.w * radius * radius / law.kn);
  const double range = peak * peak / (3.0 * radius);
  scene.dt = 1e-6;
  addDisk(scene, smallRadius, heavy, {0.0, 0.0}, {10.0, 0.0});
  addDisk(scene, smallRadius, heavy, {0.0, 2.0 * smallRadius - 0.1 * range}, {10.0, 200.0 * range});
  engine_->load(scene, {{"skin", 0.3 * range / smallRadius}});
  bool stretched = false, parted = false;
  double before = 0.0, speed = 200.0 * range;
  for (int k = 1; k <= 8; ++k) {
    engine_->advance(k * 1e-3);
    const Snapshot now = engine_->snapshot(ContactReport::instant);
    const double overlap = 2.0 * smallRadius - (now.position[1] - now.position[0]).norm();
    if (overlap < -range) {
      EXPECT_EQ(now.contacts->size(), 0U);
      parted = true;
      continue;
    }
    stretched = stretched || overlap < -0.8 * range;
    ASSERT_EQ(now.contacts->size(), 1U) << overlap / range;
    const double force = jkrForce(law.kn, law.w, radius, overlap);
    EXPECT_NEAR(now.contacts->normalForce[0], force, 1e-9 * std::abs(force));
    // Impulse that LAMMPS applied: m/2 Δv = ∫F dt, by the trapezoidal rule, of which the curve of F
    // takes less than a hundredth.
    const double slower = now.velocity[1].y() - now.velocity[0].y() - speed;
    if (k > 1) {
      EXPECT_NEAR(slower * 0.5 * heavy, 0.5e-3 * (before + force), 1e-5 * std::abs(force));
    }
    before = force;
    speed += slower;
  }
  EXPECT_TRUE(stretched && parted);
}

TEST_P(LammpsAlone, CohesionAtPlanes_IsRefusedWhereItIsWrong) {
  Scene scene = emptyScene(NormalLaw::hertz);
  addDisk(scene, smallRadius, smallMass, {0.0, smallRadius - 1e-5}, {0, 0});
  scene.bodies.push_back(planeWall({0.0, 0.0}, {0.0, 1.0}));
  ContactLaw& law = scene.law;
  law.w = 1.0;
  law.cohesion = CohesionLaw::jkr;
  EXPECT_THROW(engine_->load(scene, {}), UnsupportedScene);
  law.cohesion = CohesionLaw::dmt;
  engine_->load(scene, {});
  const double pull = 2.0 * std::numbers::pi * law.w * smallRadius;
  const double force = law.kn * std::sqrt(smallRadius * 1e-5) * 1e-5 - pull;
  const Contacts contacts = engine_->snapshot(ContactReport::instant).contacts.value();
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_NEAR(contacts.normalForce[0], force, 1e-9 * pull);
  law.conventions.cohesionLoad = CohesionLoad::netWithoutDashpot;
  law.tangential = TangentialLaw::viscous;
  law.mu = law.gt = law.gn = 0.1;
  EXPECT_THROW(engine_->load(scene, {}), UnsupportedScene);
}

INSTANTIATE_TEST_SUITE_P(Lammps, LammpsAlone, ::testing::Values("lammps"),
                         [](const auto& each) { return std::string(each.param); });

}  // namespace
}  // namespace crossgrain::test
