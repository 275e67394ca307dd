// Engines of rigid contacts: a sphere in a hollow cylinder, against closed forms, in a frame that
// lies along no axis.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include "adapters/suitability.hpp"
#include "adapters/worker/worker_engine.hpp"
#include "cases/engine_file.hpp"
#include "support/data_folder.hpp"
#include "support/scratch_folder.hpp"

namespace crossgrain::test {
namespace {

constexpr double a = 0.005, mass = 1.309e-3, g = 9.81, bore = 0.05;  // [m, kg, m/s²]
constexpr double arm = bore - a;                                     // of a sphere that touches
constexpr double dt = 1e-4;                                          // [s]

const Eigen::Matrix3d frame =
    Eigen::AngleAxisd(0.9, Vec3(1.0, 2.0, -1.0).normalized()).toRotationMatrix();
const Vec3 centre(0.01, -0.02, 0.03);

struct Rigid {
  const char *name, *file;  ///< in engines/
  double inexact;           ///< how far it sinks in, in radii: Rapier's contacts yield
};

class RigidCylinder : public ::testing::TestWithParam<Rigid> {
 protected:
  void SetUp() override {
    // Where the program is, so are workers that are built with it.
    const std::string path = fmt::format("{}:{}", CROSSGRAIN_PROGRAMS, std::getenv("PATH"));
    setenv("PATH", path.c_str(), 1);
    const EngineEntry entry = loadEngineFile(dataFolder() / "engines" / GetParam().file);
    if (entry.missing && !entry.missing().empty()) GTEST_SKIP() << entry.missing();
    engine_ = std::make_unique<WorkerEngine>(entry.name, entry.command(), scratch_, 120.0);
  }

  /// A sphere that touches the cylinder, along the frame's z, at an angle from its lowest line.
  SpaceScene scene(double angle, double omega) const {
    SpaceScene made;
    made.name = "rigid cylinder";
    made.law.dimension = 3;
    made.law.normal = NormalLaw::rigid;
    made.law.mu = 0.5;
    made.law.en = made.law.et0 = 0.0;
    made.dt = dt;
    made.gravity = frame * Vec3(0.0, -g, 0.0);
    made.disks.radius = {a};
    made.disks.mass = {mass};
    made.disks.inertia = {0.4 * mass * a * a};
    made.disks.position = {centre + frame * Vec3(arm * std::sin(angle), -arm * std::cos(angle), 0)};
    made.disks.velocity = made.disks.spin = {Vec3::Zero()};
    WallBodyOf<3>& drum = made.bodies.emplace_back();
    drum.name = "drum";
    drum.centre = centre;
    drum.cylinders.push_back({centre, frame.col(2), bore});
    if (omega != 0.0) drum.motion.kind = MotionKind::rotating;
    drum.motion.angularVelocity = omega * frame.col(2);
    made.law = lawAsRun(engine_->capabilities(), made.law);
    return made;
  }

  SpaceSnapshot at(double t) {
    engine_->advance(std::round(t / dt) * dt);
    return engine_->snapshotInSpace(engine_->capabilities().instantContacts ? ContactReport::instant
                                                                            : ContactReport::none);
  }

  const ScratchFolder folder_;
  std::filesystem::path scratch_ = folder_.path / "worker";
  std::unique_ptr<WorkerEngine> engine_;
};

TEST_P(RigidCylinder, SphereRollingAtItsBottom_SwingsAsAPendulum) {
  // (1 + q) m (R − a) φ̈ = −m g sin φ; of a swing by φ0 ω² is φ0²/8 lower. A scheme of first order
  // is half a step off, ω dt/2 = 6e-4 of the amplitude.
  const double start = 0.05;
  const double omega = std::sqrt(g / (1.4 * arm) * (1.0 - start * start / 8.0));
  engine_->loadInSpace(scene(start, 0.0), {{"dt", dt}});
  for (int part = 1; part <= 12; ++part) {
    const double t = std::round(part * 0.125 * 2.0 * M_PI / omega / dt) * dt;
    const Vec3 x = frame.transpose() * (at(t).position[0] - centre);
    EXPECT_NEAR(std::atan2(x.x(), -x.y()), start * std::cos(omega * t),
                (1e-3 + GetParam().inexact) * start);
    EXPECT_NEAR(std::hypot(x.x(), x.y()), arm, (1e-3 + GetParam().inexact) * a);
    EXPECT_NEAR(x.z(), 0.0, 1e-3 * a);
  }
}

TEST_P(RigidCylinder, SphereInATurningDrum_IsSpunUpUntilItRolls) {
  const double omega = 3.0;
  const SpaceScene drum = scene(0.0, omega);
  engine_->loadInSpace(drum, {{"dt", dt}});
  // It slips for Ω R/(7/2 µ g) = 8.7 ms: J dω/dt = µ m g a.
  const double early = frame.col(2).dot(at(2e-3).spin->at(0));
  const SpaceSnapshot slipping = at(6e-3);
  const double wanted = 0.5 * g * 2.5 / a;
  EXPECT_NEAR((frame.col(2).dot(slipping.spin->at(0)) - early) / 4e-3, wanted, 5e-3 * wanted);
  if (slipping.contacts) {
    // The wall takes what the sphere does not get, about the axis at its radius.
    ASSERT_EQ(slipping.contacts->size(), 1u);
    EXPECT_EQ(slipping.contacts->j[0], 1);
    const Vec3 force = slipping.contacts->force(0), n = slipping.contacts->normal[0];
    EXPECT_LT((*slipping.bodies[0].force + force).norm(), 1e-3 * force.norm());
    EXPECT_LT((*slipping.bodies[0].torque - (-bore * n).cross(-force)).norm(),
              1e-3 * bore * force.norm());
    EXPECT_NEAR((force - force.dot(n) * n).norm(), 0.5 * force.dot(n), 1e-3 * force.norm());
  }
  // At last nothing slips at its surface, which has v + a ω of the two there.
  const SpaceSnapshot now = at(1.0);
  const Vec3 inward = tangentPlane(drum.bodies[0].cylinders[0], now.position[0]).normal;
  const Vec3 around = inward.cross(frame.col(2));
  EXPECT_NEAR(now.velocity[0].dot(around) + a * now.spin->at(0).dot(frame.col(2)), omega * bore,
              (1e-3 + GetParam().inexact) * omega * bore);
}

// Rapier's contacts with what is fixed sink in by 0.013 a under a sphere's weight.
INSTANTIATE_TEST_SUITE_P(Engines, RigidCylinder,
                         ::testing::Values(Rigid{"bullet", "bullet/bullet.toml", 0.0},
                                           Rigid{"ode", "ode/ode.toml", 0.0},
                                           Rigid{"jolt", "jolt/jolt.toml", 0.0},
                                           Rigid{"rapier3d", "rapier/rapier3d.toml", 0.015}),
                         [](const auto& each) { return std::string(each.param.name); });

}  // namespace
}  // namespace crossgrain::test
