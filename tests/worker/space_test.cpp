// YADE, LAMMPS and LIGGGHTS in space and in periodic boxes: scenes of several bodies, by the
// in-house engine with each one's conventions. Pairs, borders, frames and walls that move are asked
// of them, as of every engine, in tests/conformance and tests/system/test_peers.py.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>

#include "adapters/registry.hpp"
#include "adapters/suitability.hpp"
#include "adapters/worker/worker_engine.hpp"
#include "studies/conformance/space_scenes.hpp"
#include "support/data_folder.hpp"
#include "support/files.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/scenes.hpp"

namespace crossgrain::test {
namespace {

ContactLaw springLaw() {
  ContactLaw law;
  law.dimension = 3;
  law.tangential = TangentialLaw::springDashpot;
  law.kn = 1e5;
  law.gn = 1.15;
  law.kt = 2.857e4;
  law.gt = 0.33;
  law.mu = 0.3;
  return law;
}

SpaceScene emptyScene() {
  return SpaceScene{.name = "space test", .law = springLaw(), .dt = 4e-6};
}

/// The same numbers again and again, between −1 and 1.
struct Numbers {
  unsigned state = 1;
  double next() {
    state = state * 1664525u + 1013904223u;
    return state / 2147483648.0 - 1.0;
  }
  Vec3 vector() {
    const double x = next(), y = next();
    return {x, y, next()};
  }
};

constexpr int columns = 6, rows = 5, layers = 3;

/// A sheet of wall spheres, which touch each other.
WallBodyOf<3> sheet(const char* name, double height, const Vec3& shift) {
  WallBodyOf<3> wall{.name = name, .centre = shift + Vec3(0.01, 0.02, height)};
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      wall.diskPosition.push_back(shift + Vec3((2 * x + 1) * radius, (2 * y + 1) * radius, height));
      wall.diskRadius.push_back(radius);
    }
  return wall;
}

/// Spheres in contact between two sheets, one that slides and one that shakes; periodic along x and
/// y. @param part  of the box by which all of it is moved
SpaceScene shearedLayers(double part) {
  SpaceScene scene = emptyScene();
  const Vec3 extent(2 * columns * radius, 2 * rows * radius, 0.1);
  scene.box = BoxOf<3>{Vec3::Zero(), extent, {true, true, false}};
  const Vec3 shift = part * Vec3(extent.x(), extent.y(), 0.0);
  Numbers random;
  for (int z = 0; z < layers; ++z)
    for (int y = 0; y < rows; ++y)
      for (int x = 0; x < columns; ++x) {
        const Vec3 place =
            1.98 * radius * Vec3(x, y, z) + Vec3(0.005, 0.005, 0.015) + 2e-4 * random.vector();
        addBody<3>(scene, scene.box->wrapped(place + shift), 0.3 * random.vector(),
                   50.0 * random.vector());
      }
  scene.bodies = {sheet("low", 0.006, shift), sheet("high", 0.044, shift)};
  MotionOf<3>&slides = scene.bodies[0].motion, &shakes = scene.bodies[1].motion;
  slides.kind = MotionKind::translating;
  slides.velocity = {-0.3, 0.0, 0.0};
  shakes.kind = MotionKind::oscillating;
  shakes.amplitude = {1e-3, 0.0, 1e-4};
  shakes.frequency = 300.0;
  return scene;
}

/// Contacts by their pair.
std::map<std::pair<int, int>, std::size_t> byPair(const ContactsOf<3>& contacts) {
  std::map<std::pair<int, int>, std::size_t> found;
  for (std::size_t k = 0; k < contacts.size(); ++k)
    EXPECT_TRUE(found.try_emplace({contacts.i[k], contacts.j[k]}, k).second) << "listed twice";
  return found;
}

SpaceSnapshot snapshotAt(Engine& engine, double t) {
  engine.advance(t);
  return engine.snapshotInSpace(ContactReport::instant);
}

class Space : public ::testing::TestWithParam<const char*> {
 protected:
  static void TearDownTestSuite() { started_.clear(); }
  void SetUp() override {
    const std::string name = GetParam();
    ProgramCall call({"/usr/bin/python3", workerScript(name).string()});
    if (name == "yade") call = findEngine("yade")->command();
    if (!isOnPath(name == "lammps" ? "lmp" : name)) GTEST_SKIP() << name << " is not installed";
    setenv("OMPI_MCA_ess_singleton_isolated", "1", 1);  // as liggghts.toml does
    std::unique_ptr<WorkerEngine>& engine = started_[name];
    if (!engine)
      engine = std::make_unique<WorkerEngine>(
          name, call, std::filesystem::path(testing::TempDir()) / name, 120.0);
    engine_ = engine.get();
  }
  /// With the conventions that the engine has.
  SpaceScene asRun(SpaceScene scene) const {
    scene.law = lawAsRun(engine_->capabilities(), scene.law);
    return scene;
  }

  /// Places, contacts (all but a pair at an overlap of 0) and loads.
  /// @param rounding  of places, in radii: some 500 steps
  /// @returns how many contacts were compared
  std::size_t expectAsTheMirrorHasIt(const SpaceScene& scene,
                                     const std::vector<double>& times = {4e-6, 4e-5, 8e-5, 1.2e-4,
                                                                         1.6e-4, 2e-3},
                                     double rounding = 1e-11);
  /// Of many that collide, which in 100 steps make more of rounding.
  void expectLayersAsTheMirrorHasThem(const SpaceScene& scene) {
    EXPECT_GT(expectAsTheMirrorHasIt(scene, {4e-4}, 1e-10), 200u);
  }

  /// One start serves all tests of an engine.
  static inline std::map<std::string, std::unique_ptr<WorkerEngine>> started_;
  WorkerEngine* engine_ = nullptr;
};

std::size_t Space::expectAsTheMirrorHasIt(const SpaceScene& scene, const std::vector<double>& times,
                                          double rounding) {
  const auto mirror = findEngine("grain")->make();
  // LAMMPS' rolling spring follows n as θ × n does: per step ½ ΔΘ² of M = µ_r R₁₂ N = 0.05 N m from
  // θ, with ΔΘ = 2.4e-4 of 0.6 m/s; in 100 steps 1.5e-7 N m, that is 5e-3 rad/s or 2e-4 N.
  const bool ofLammps = GetParam() == std::string("lammps");
  if (ofLammps && scene.law.rolls()) rounding *= 200.0;
  // In DMT's contacts LAMMPS shows forces bounded by another load than those that act (README.md of
  // engines/lammps).
  const bool ownBounds = ofLammps && scene.law.cohesion == CohesionLaw::dmt;
  const auto apart = [&](const Vec3& a, const Vec3& b) {
    return (scene.box ? scene.box->nearest(a - b) : Vec3(a - b)).norm();
  };
  engine_->loadInSpace(scene, {});
  mirror->loadInSpace(scene, {});
  std::size_t compared = 0;
  for (const double t : times) {
    SCOPED_TRACE(t);
    const SpaceSnapshot now = snapshotAt(*engine_, t);
    const SpaceSnapshot then = snapshotAt(*mirror, now.contactTime);
    const SpaceSnapshot own = snapshotAt(*mirror, t);
    for (std::size_t k = 0; k < own.position.size(); ++k)
      EXPECT_LE(apart(now.position[k], own.position[k]), rounding * radius);
    EXPECT_EQ(now.wallPosition.size(), own.wallPosition.size());
    for (std::size_t k = 0; k < own.wallPosition.size(); ++k)
      EXPECT_LE(apart(now.wallPosition[k], own.wallPosition[k]), 1e-15);
    const auto of = byPair(*now.contacts), there = byPair(*then.contacts);
    std::size_t both = 0;
    for (const auto& [pair, k] : of) {
      SCOPED_TRACE(std::to_string(pair.first) + " with " + std::to_string(pair.second));
      if (!there.contains(pair)) continue;  // an overlap that is 0 to rounding
      ++both;
      const std::size_t l = there.at(pair);
      EXPECT_LE((now.contacts->normal[k] - then.contacts->normal[l]).norm(), 10.0 * rounding);
      EXPECT_NEAR(now.contacts->overlap[k], then.contacts->overlap[l], 2.0 * rounding * radius);
      if (ownBounds) {
        EXPECT_NEAR(now.contacts->normalForce[k], then.contacts->normalForce[l], 1e4 * rounding);
        continue;
      }
      EXPECT_LE((now.contacts->force(k) - then.contacts->force(l)).norm(), 1e4 * rounding);
      if (scene.law.rolls()) {
        const Vec3 more = now.contacts->rollingTorque[k] - then.contacts->rollingTorque[l];
        EXPECT_LE(more.norm(), 10.0 * rounding);
      }
    }
    EXPECT_GE(both + 1, std::max(of.size(), there.size()));
    compared += both;
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
      EXPECT_LE((now.bodies[b].centre - own.bodies[b].centre).norm(), 1e-15);
      EXPECT_LE((*now.bodies[b].force - *then.bodies[b].force).norm(), 1e4 * rounding);
      EXPECT_LE((*now.bodies[b].torque - *then.bodies[b].torque).norm(), 1e2 * rounding);
    }
  }
  return compared;
}

TEST_P(Space, SpheresBetweenSheets_MoveAndPushAsTheMirrorHasThem) {
  for (const double part : {0.0, 1.0 / 3.0})
    expectLayersAsTheMirrorHasThem(asRun(shearedLayers(part)));
}

TEST_P(Space, SpheresAndSheetsOfOtherMaterials_MeetByTheirOwnLaws) {
  SpaceScene scene = asRun(shearedLayers(0.0));
  const auto changed = [&](double by, double friction) {
    ContactLaw law = scene.law;
    for (double* constant : {&law.kn, &law.gn, &law.kt, &law.gt}) *constant *= by;
    law.mu *= friction;
    return law;
  };
  // As YADE mixes materials: constants like springs in series, the smaller µ.
  const ContactLaw both = changed(2.0 / 3.0, 0.4);
  scene.materials = Materials{{"ball", "sheet"},
                              std::vector<std::int32_t>(scene.disks.size(), 0),
                              std::vector<std::int32_t>(scene.bodies.size(), 1),
                              {scene.law, both, both, changed(0.5, 0.4)}};
  scene.materials->ofDisk[1] = 1;
  expectLayersAsTheMirrorHasThem(scene);
}

/// Laws that the engine has beside the linear one, as cases name them; µ_r, k_r and pulls are as
/// large as friction and its springs.
struct NamedLaw {
  const char* name;
  ContactLaw law;
};

std::vector<NamedLaw> lawsBeside(const std::string& engine) {
  ContactLaw linear = springLaw(), hertz = linear;
  hertz.normal = NormalLaw::hertz;
  hertz.kn = hertz.kt = 5e7;
  ContactLaw undamped = linear;
  undamped.gn = undamped.gt = 0.0;
  undamped.tangential = TangentialLaw::spring;
  ContactLaw undampedHertz = hertz;
  undampedHertz.gn = undampedHertz.gt = 0.0;
  undampedHertz.tangential = TangentialLaw::spring;
  const auto rolling = [](ContactLaw law, RollingLaw kind, double mu, double kr, double gr) {
    law.rolling = kind;
    law.muR = mu;
    law.kr = kr;
    law.gr = gr;
    return law;
  };
  const auto dmt = [](ContactLaw law, CohesionLoad load) {
    law.cohesion = CohesionLaw::dmt;
    law.w = 100.0;
    law.conventions.cohesionLoad = load;
    return law;
  };
  constexpr CohesionLoad ofLammps = CohesionLoad::netWithoutDashpot;
  if (engine == "lammps")
    return {{"spring", rolling(linear, RollingLaw::spring, 0.2, 2e4, 0.2)},
            {"hertz with spring", rolling(hertz, RollingLaw::spring, 0.2, 2e4, 0.2)},
            {"dmt", dmt(hertz, ofLammps)},
            {"dmt with spring", rolling(dmt(hertz, ofLammps), RollingLaw::spring, 0.2, 2e4, 0.2)}};
  if (engine == "liggghts") {
    ContactLaw area = linear;
    area.cohesion = CohesionLaw::area;
    area.kc = 1e6;
    return {{"area", area}};
  }
  ContactLaw spring = rolling(undamped, RollingLaw::spring, 0.2, 2e4, 0.0);
  spring.conventions.rollingLength = RollingLength::smallerRadius;
  spring.conventions.rollingStiffness = RollingStiffness::radii;
  ContactLaw moment = rolling(hertz, RollingLaw::spring, 0.2, 0.5, 0.0);
  moment.damper = Damper::critical;
  moment.gn = 0.2;
  moment.gt = 0.1;
  ContactLaw criticalHertz = moment;
  criticalHertz.rolling = RollingLaw::none;
  ContactLaw plastic = undamped;
  plastic.cohesion = CohesionLaw::elastoPlastic;
  plastic.kUnload = 3e5;
  plastic.kc = 5e4;
  plastic.plasticDepth = 0.02;
  return {{"spring", spring},
          {"hertz", criticalHertz},
          {"hertz with spring", moment},
          {"dmt", dmt(undampedHertz, CohesionLoad::magnitudePlusPullOff)},
          {"elasto_plastic", plastic}};
}

TEST_P(Space, LawsThatResistRollingOrCohere_AreTheMirrors) {
  for (const NamedLaw& each : lawsBeside(GetParam())) {
    SCOPED_TRACE(each.name);
    SpaceScene scene = shearedLayers(0.0);
    scene.law = each.law;
    expectLayersAsTheMirrorHasThem(asRun(scene));
  }
}

TEST_P(Space, SpheresOnAFloor_MoveAndPushAsTheMirrorHasThem) {
  SpaceScene scene = emptyScene();
  scene.gravity = {0.1, -9.81, 0.2};
  const Vec3 places[] = {{0.0, 0.0, 0.0}, {1.99, 0.1, 0.2}, {1.0, 1.72, -0.1}};
  for (int k = 0; k < 3; ++k)
    addBody<3>(scene, radius * places[k], {0.02 - 0.03 * k, -0.05, 0.01 * k},
               {20.0 * k, 30.0, -10.0});
  WallBodyOf<3>& floor = scene.bodies.emplace_back();
  floor.name = "floor";
  floor.planes.push_back({{0.0, -0.999 * radius, 0.0}, {0.0, 1.0, 0.0}});
  EXPECT_GE(expectAsTheMirrorHasIt(asRun(scene)), 10u);
}

/// Three spheres that lie at the bottom of a cylinder along one of the axes.
SpaceScene spheresInACylinder(int axis, double omega) {
  SpaceScene scene = emptyScene();
  const double bore = 0.03;
  const Vec3 centre(0.01, -0.02, 0.005);
  // x, y, z of a drum along z are y, z, x and z, x, y of those along x and y.
  const auto placed = [axis](const Vec3& v) {
    Vec3 found;
    for (int k = 0; k < 3; ++k) found[(axis + 1 + k) % 3] = v[k];
    return found;
  };
  scene.gravity = placed({0.1, -9.81, 0.2});
  for (int k = 0; k < 3; ++k) {
    const double angle = -1.8 + 0.404 * k, arm = bore - 0.999 * radius;
    addBody<3>(scene, centre + placed({arm * std::cos(angle), arm * std::sin(angle), 1e-3 * k}),
               placed({0.02 - 0.03 * k, -0.05, 0.01 * k}), placed({20.0 * k, 30.0, -10.0}));
  }
  WallBodyOf<3>& drum = scene.bodies.emplace_back();
  drum.name = "drum";
  drum.centre = centre;
  drum.cylinders.push_back({centre, Vec3::Unit(axis), bore});
  if (omega != 0.0) drum.motion.kind = MotionKind::rotating;
  drum.motion.angularVelocity = omega * Vec3::Unit(axis);
  return scene;
}

TEST_P(Space, SpheresInACylinder_MoveAndPushAsTheMirrorHasThem) {
  if (GetParam() == std::string("yade")) GTEST_SKIP() << "has no cylinders";
  for (const int axis : {0, 1, 2}) {
    SCOPED_TRACE(axis);
    EXPECT_GE(expectAsTheMirrorHasIt(asRun(spheresInACylinder(axis, 0.0))), 10u);
  }
}

TEST_P(Space, TurningCylinder_SpinsASphereUpUntilItRolls) {
  const std::string name = GetParam();
  if (name == "yade") GTEST_SKIP() << "has no cylinders";
  const double omega = 3.0;
  for (const int axis : {0, 1, 2}) {
    SCOPED_TRACE(axis);
    SpaceScene scene = spheresInACylinder(axis, omega);
    scene.gravity *= 10.0;  // so that friction is soon done
    if (name == "liggghts" && axis == 1) {
      EXPECT_THROW(engine_->loadInSpace(asRun(scene), {}), UnsupportedScene);
      continue;
    }
    if (name == "lammps") {
      EXPECT_GE(expectAsTheMirrorHasIt(asRun(scene)), 10u);
    }
    for (auto* list : {&scene.disks.position, &scene.disks.velocity, &scene.disks.spin})
      list->resize(1);
    for (auto* list : {&scene.disks.radius, &scene.disks.mass, &scene.disks.inertia})
      list->resize(1);
    engine_->loadInSpace(asRun(scene), {});
    const SpaceSnapshot now = snapshotAt(*engine_, 0.1);
    // At the wall the sphere's surface moves as the wall does, at Ω R, as nothing resists rolling.
    const Cylinder& drum = scene.bodies[0].cylinders[0];
    const Vec3 inward = tangentPlane(drum, now.position[0]).normal;
    const Vec3 slip = now.velocity[0] - radius * now.spin->at(0).cross(inward) +
                      omega * drum.radius * drum.axis.cross(inward);
    const Vec3 along = slip - slip.dot(inward) * inward;
    EXPECT_LE(along.norm(), 1e-3 * omega * drum.radius) << along.transpose();
  }
}

TEST_P(Space, WhatItDoesNotHave_IsRefused) {
  SpaceScene scene = shearedLayers(0.0);
  scene.bodies[0].motion.kind = MotionKind::radial;
  const auto refusal = [&] {
    return test::refusalOf<UnsupportedScene>([&] { engine_->loadInSpace(asRun(scene), {}); });
  };
  EXPECT_EQ(refusal(),
            "has walls that are fixed | rotating | translating | oscillating in space, not radial");
  scene = spheresInACylinder(2, 0.0);
  scene.bodies[0].cylinders[0].axis = {0.0, 0.6, 0.8};
  EXPECT_EQ(refusal(),
            GetParam() == std::string("yade")
                ? "has no cylinders, as drum has"
                : "has cylinders along axes only; that of drum is along (0.0, 0.6, 0.8)");
}

using LammpsInSpace = Space;

TEST_P(LammpsInSpace, TwoRanks_MoveAndPushAsOne) {
  if (!isOnPath("mpirun")) GTEST_SKIP() << "mpirun is not installed";
  const SpaceScene scene = asRun(shearedLayers(0.0));
  SpaceSnapshot seen[2];
  for (const int more : {0, 1}) {
    engine_->loadInSpace(scene, {{"ranks", 1.0 + more}});
    seen[more] = snapshotAt(*engine_, 4e-4);
  }
  // Sums in another order, as rounding.
  for (std::size_t k = 0; k < scene.disks.size(); ++k) {
    const Vec3 apart = seen[1].position[k] - seen[0].position[k];
    EXPECT_LE(scene.box->nearest(apart).norm(), 1e-10 * radius);
    EXPECT_LE((seen[1].spin->at(k) - seen[0].spin->at(k)).norm(), 1e-10 / radius);
  }
  EXPECT_EQ(byPair(*seen[0].contacts).size(), byPair(*seen[1].contacts).size());
  for (const int b : {0, 1})
    EXPECT_LE((*seen[0].bodies[b].torque - *seen[1].bodies[b].torque).norm(), 1e-8);
}

INSTANTIATE_TEST_SUITE_P(Lammps, LammpsInSpace, ::testing::Values("lammps"),
                         [](const auto& each) { return std::string(each.param); });

INSTANTIATE_TEST_SUITE_P(Peers, Space, ::testing::Values("yade", "lammps", "liggghts"),
                         [](const auto& each) { return std::string(each.param); });

}  // namespace
}  // namespace crossgrain::test
