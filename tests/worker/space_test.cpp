// YADE, LAMMPS and LIGGGHTS in space and in periodic boxes: scenes of many bodies, by symmetries,
// sums and the in-house engine with each one's conventions.
#include <gtest/gtest.h>
#include <unistd.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

#include "adapters/registry.hpp"
#include "adapters/suitability.hpp"
#include "adapters/worker/worker_engine.hpp"
#include "support/data_folder.hpp"
#include "support/files.hpp"
#include "tests/support/scenes.hpp"

namespace crossgrain::test {
namespace {

constexpr double radius = 0.005, mass = 1.309e-3;  // [m, kg]: 2500 kg/m³

ContactLaw springLaw(int dimension) {
  ContactLaw law;
  law.dimension = dimension;
  law.tangential = TangentialLaw::springDashpot;
  law.kn = 1e5;
  law.gn = 1.15;
  law.kt = 2.857e4;
  law.gt = 0.33;
  law.mu = 0.3;
  return law;
}

template <int D>
SceneOf<D> emptyBox() {
  SceneOf<D> scene;
  scene.name = "space test";
  scene.law = springLaw(D);
  scene.dt = 4e-6;
  return scene;
}

template <int D>
void addBody(SceneOf<D>& scene, const VecOf<D>& place, const VecOf<D>& velocity,
             const SpinOf<D>& spin) {
  scene.disks.radius.push_back(radius);
  scene.disks.mass.push_back(mass);
  scene.disks.inertia.push_back((D == 2 ? 0.5 : 0.4) * mass * radius * radius);
  scene.disks.position.push_back(place);
  scene.disks.velocity.push_back(velocity);
  scene.disks.spin.push_back(spin);
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
  WallBodyOf<3> wall;
  wall.name = name;
  wall.centre = shift + Vec3(0.01, 0.02, height);
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
  SpaceScene scene = emptyBox<3>();
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
template <int D>
std::map<std::pair<int, int>, std::size_t> byPair(const ContactsOf<D>& contacts) {
  std::map<std::pair<int, int>, std::size_t> found;
  for (std::size_t k = 0; k < contacts.size(); ++k)
    EXPECT_TRUE(found.try_emplace({contacts.i[k], contacts.j[k]}, k).second) << "listed twice";
  return found;
}

template <int D>
EffectiveParameters loadInto(Engine& engine, const SceneOf<D>& scene) {
  if constexpr (D == 2)
    return engine.load(scene, {});
  else
    return engine.loadInSpace(scene, {});
}

template <int D>
SnapshotOf<D> snapshotAt(Engine& engine, double t) {
  engine.advance(t);
  if constexpr (D == 2)
    return engine.snapshot(ContactReport::instant);
  else
    return engine.snapshotInSpace(ContactReport::instant);
}

class Space : public ::testing::TestWithParam<const char*> {
 protected:
  static void TearDownTestSuite() {
    started_.clear();
    std::filesystem::remove_all(scratch());
  }
  void SetUp() override {
    const std::string name = GetParam();
    ProgramCall call({"/usr/bin/python3", workerScript(name).string()});
    if (name == "yade") call = findEngine("yade")->command();
    if (!isOnPath(name == "lammps" ? "lmp" : name)) GTEST_SKIP() << name << " is not installed";
    setenv("OMPI_MCA_ess_singleton_isolated", "1", 1);  // as liggghts.toml does
    std::unique_ptr<WorkerEngine>& engine = started_[name];
    if (!engine) engine = std::make_unique<WorkerEngine>(name, call, scratch() / name, 120.0);
    engine_ = engine.get();
  }
  static std::filesystem::path scratch() {
    return std::filesystem::path(::testing::TempDir()) /
           ("crossgrain-space-" + std::to_string(getpid()));
  }
  /// With the conventions that the engine has.
  template <int D>
  SceneOf<D> asRun(SceneOf<D> scene) const {
    scene.law = lawAsRun(engine_->capabilities(), scene.law);
    return scene;
  }

  template <int D>
  void expectPairAcrossTheBorderAsInside();
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
  // What LAMMPS shows of DMT's contacts is bounded by another load than what acts (README.md of
  // engines/lammps).
  const bool ownBounds = ofLammps && scene.law.cohesion == CohesionLaw::dmt;
  const auto apart = [&](const Vec3& a, const Vec3& b) {
    return (scene.box ? scene.box->nearest(a - b) : Vec3(a - b)).norm();
  };
  loadInto(*engine_, scene);
  loadInto(*mirror, scene);
  std::size_t compared = 0;
  for (const double t : times) {
    SCOPED_TRACE(t);
    const SpaceSnapshot now = snapshotAt<3>(*engine_, t);
    const SpaceSnapshot then = snapshotAt<3>(*mirror, now.contactTime);
    const SpaceSnapshot own = snapshotAt<3>(*mirror, t);
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
  bool inThePlaneAlone = false;  ///< in space it is another one, which its deviation says
};

std::vector<NamedLaw> lawsBeside(const std::string& engine) {
  ContactLaw linear = springLaw(3), hertz = linear;
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
    const double own = 2.25 * linear.kn * 0.2 * 0.2;
    ContactLaw constant = rolling(linear, RollingLaw::constantTorque, 0.1, 0.0, 0.0);
    constant.conventions.rollingLoad = RollingLoad::elastic;
    ContactLaw critical = rolling(linear, RollingLaw::spring, 0.2, own, 0.3);
    critical.conventions.rollingDamper = RollingDamper::critical;
    return {{"area", area},
            {"cdt", constant, true},
            {"epsd", critical, true},
            {"epsd2", rolling(linear, RollingLaw::spring, 0.2, linear.kt, 0.0), true}};
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
          {"elasto_plastic", plastic},
          {"viscous_by_load", rolling(linear, RollingLaw::viscousByLoad, 2.0, 0.0, 0.0), true}};
}

TEST_P(Space, LawsThatResistRollingOrCohere_AreTheMirrors) {
  for (const NamedLaw& each : lawsBeside(GetParam())) {
    SCOPED_TRACE(each.name);
    if (each.inThePlaneAlone) continue;
    SpaceScene scene = shearedLayers(0.0);
    scene.law = each.law;
    expectLayersAsTheMirrorHasThem(asRun(scene));
  }
}

TEST_P(Space, TurningBody_IsWhereItTurnsToAndPushesAsItsSpheresMove) {
  // A sphere meets one of the body's, or one as heavy as nothing moves it that has its velocity and
  // spin. Meanwhile the former leaves the latter's straight path by ½ Ω² r t² = 3e-9 m, and the
  // overlap is 1.6e-5 m.
  const Vec3 spin = 4.0 * Vec3(0.3, -0.5, 0.8).normalized(), centre(0.01, 0.02, -0.03);
  const Vec3 arm = 0.03 * spin.cross(Vec3::UnitX()).normalized();
  const Vec3 n = Vec3(1.0, 1.0, 0.2).normalized();
  Vec3 velocity[2], turning[2];
  for (const bool free : {false, true}) {
    SpaceScene scene = emptyBox<3>();
    addBody<3>(scene, centre + arm + 2.0005 * radius * n, -0.2 * n, {10.0, -5.0, 3.0});
    if (free) {
      addBody<3>(scene, centre + arm, spin.cross(arm), spin);
      scene.disks.mass[1] = 1e12;
      scene.disks.inertia[1] = 0.4e12 * radius * radius;
    } else {
      WallBodyOf<3>& body = scene.bodies.emplace_back();
      body.name = "drum";
      body.centre = centre;
      body.diskPosition = {centre + arm, centre - arm};
      body.diskRadius = {radius, radius};
      body.motion.kind = MotionKind::rotating;
      body.motion.angularVelocity = spin;
    }
    scene = asRun(scene);
    loadInto(*engine_, scene);
    const SpaceSnapshot during = snapshotAt<3>(*engine_, 1.2e-4);
    ASSERT_EQ(during.contacts->size(), 1u);
    if (!free) {
      const BodySnapshotOf<3>& body = during.bodies[0];
      EXPECT_LE((body.angle - during.positionTime * spin).norm(), 1e-15);
      EXPECT_LE((body.angularVelocity - spin).norm(), 1e-15);
      const Vec3 force = -during.contacts->force(0);
      EXPECT_LE((*body.force - force).norm(), 1e-9 * force.norm());
      const Eigen::AngleAxisd turn(4.0 * during.contactTime, spin.normalized());
      const Vec3 contact =
          turn * arm + (radius - 0.5 * during.contacts->overlap[0]) * during.contacts->normal[0];
      EXPECT_LE((*body.torque - contact.cross(force)).norm(), 1e-9 * force.norm() * 0.04);
    }
    const SpaceSnapshot after = snapshotAt<3>(*engine_, 1e-2);
    velocity[free] = after.velocity[0];
    turning[free] = after.spin->at(0);
    if (free) continue;
    const Eigen::AngleAxisd turn(4e-2, spin.normalized());
    for (const int side : {0, 1})
      EXPECT_LE((after.wallPosition[side] - centre - (side == 0 ? 1 : -1) * (turn * arm)).norm(),
                1e-15);
  }
  EXPECT_GT((velocity[0] + 0.2 * n).norm(), 0.2);
  EXPECT_LE((velocity[0] - velocity[1]).norm(), 1e-3 * 0.2);
  EXPECT_LE((turning[0] - turning[1]).norm(), 1e-3 * 0.2 / radius);
}

/// Two that meet, and the same two half a box further on, on either side of its border.
template <int D>
void Space::expectPairAcrossTheBorderAsInside() {
  SceneOf<D> scene = emptyBox<D>();
  BoxOf<D>& box = scene.box.emplace();
  box.high.setConstant(16 * radius);  // exact halves: both pairs are the same to rounding
  box.periodic[0] = true;
  const VecOf<D> middle = VecOf<D>::Constant(8 * radius);
  VecOf<D> apart = VecOf<D>::Zero(), velocity = VecOf<D>::Zero();
  apart[0] = 0.99 * radius;
  apart[1] = 0.1 * radius;
  velocity[0] = -0.2;
  velocity[D - 1] += 0.1;
  SpinOf<D> spin = noSpin<D>();
  if constexpr (D == 2)
    spin = 20.0;
  else
    spin = Vec3(20.0, -30.0, 10.0);
  for (const double at : {0.0, 8.0})
    for (const double side : {1.0, -1.0}) {
      VecOf<D> place = middle + side * apart;
      place[0] += at * radius;
      addBody<D>(scene, box.wrapped(place), side * velocity, spin);
    }
  scene = asRun(scene);
  loadInto(*engine_, scene);
  // What differs is the rounding of places, 1e-17 m and as much of δ.
  for (const double t : {4e-5, 1.2e-4, 1e-3}) {
    const SnapshotOf<D> now = snapshotAt<D>(*engine_, t);
    for (const int k : {0, 1}) {
      EXPECT_LE((now.velocity[k] - now.velocity[k + 2]).norm(), 1e-11);
      VecOf<D> moved = now.position[k + 2] - now.position[k];
      moved[0] -= 8 * radius;
      EXPECT_LE(box.nearest(moved).norm(), 1e-11 * radius);
    }
    if (t == 1e-3) continue;  // they have parted
    ASSERT_EQ(now.contacts->size(), 2u);
    const auto of = byPair(*now.contacts);
    const std::size_t inside = of.at({0, 1}), across = of.at({2, 3});
    EXPECT_GT(now.contacts->normal[inside][0], 0.9);
    EXPECT_LE((now.contacts->normal[inside] - now.contacts->normal[across]).norm(), 1e-11);
    EXPECT_NEAR(now.contacts->overlap[inside], now.contacts->overlap[across], 1e-11 * radius);
    EXPECT_LE((now.contacts->force(inside) - now.contacts->force(across)).norm(), 1e-9);
  }
}

TEST_P(Space, PairAcrossTheBorder_IsThePairInside) {
  expectPairAcrossTheBorderAsInside<3>();
}

TEST_P(Space, PairAcrossTheBorderOfThePlane_IsThePairInside) {
  expectPairAcrossTheBorderAsInside<2>();
}

TEST_P(Space, SpheresOnAFloor_MoveAndPushAsTheMirrorHasThem) {
  SpaceScene scene = emptyBox<3>();
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
  SpaceScene scene = emptyBox<3>();
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
    loadInto(*engine_, asRun(scene));
    const SpaceSnapshot now = snapshotAt<3>(*engine_, 0.1);
    // At the wall the sphere's surface moves as the wall does, at Ω R, as nothing resists rolling.
    const Cylinder& drum = scene.bodies[0].cylinders[0];
    const Vec3 inward = tangentPlane(drum, now.position[0]).normal;
    const Vec3 slip = now.velocity[0] - radius * now.spin->at(0).cross(inward) +
                      omega * drum.radius * drum.axis.cross(inward);
    const Vec3 along = slip - slip.dot(inward) * inward;
    EXPECT_LE(along.norm(), 1e-3 * omega * drum.radius) << along.transpose();
  }
}

/// Two spheres that meet in the plane z = 0, turned by `frame`; or disks with a sphere's J.
template <int D>
SceneOf<D> planarImpact(const ContactLaw& law, const Eigen::Matrix3d& frame) {
  SceneOf<D> scene = emptyBox<D>();
  scene.law = law;
  scene.law.dimension = D;
  const auto placed = [&](double x, double y, double z = 0.0) -> VecOf<D> {
    const Vec3 place = frame * Vec3(x, y, z);
    return place.template head<D>();
  };
  for (const double side : {1.0, -1.0}) {
    SpinOf<D> spin = noSpin<D>();
    if constexpr (D == 2)
      spin = 30.0 + 10.0 * side;
    else
      spin = placed(0.0, 0.0, 30.0 + 10.0 * side);
    addBody<D>(scene, placed(side * 1.001 * radius, 0.0), placed(-0.1 * side, 0.15 * side), spin);
  }
  for (double& inertia : scene.disks.inertia) inertia = 0.4 * mass * radius * radius;
  return scene;
}

TEST_P(Space, PlanarImpactInAnyFrame_IsThePlanes) {
  const Eigen::Matrix3d frame =
      Eigen::AngleAxisd(2.0, Vec3(1.0, -2.0, 0.5).normalized()).toRotationMatrix();
  std::vector<NamedLaw> laws = lawsBeside(GetParam());
  laws.push_back({"linear", springLaw(3)});
  for (const NamedLaw& each : laws) {
    SCOPED_TRACE(each.name);
    const bool coheres = each.law.coheres();
    loadInto(*engine_, asRun(planarImpact<2>(each.law, Eigen::Matrix3d::Identity())));
    const Snapshot plane = snapshotAt<2>(*engine_, 1e-3);
    const SpaceScene scene = asRun(planarImpact<3>(each.law, frame));
    loadInto(*engine_, scene);
    const SpaceSnapshot space = snapshotAt<3>(*engine_, 1e-3);
    for (const int k : {0, 1}) {
      const Vec3 velocity = frame * Vec3(plane.velocity[k].x(), plane.velocity[k].y(), 0.0);
      EXPECT_GT((velocity - scene.disks.velocity[k]).norm(), coheres ? 0.02 : 0.1);
      // Springs that are turned to first order, or shortened, by 1e-3 rad a step at most.
      EXPECT_LE((space.velocity[k] - velocity).norm(), 1e-6 * 0.2);
      EXPECT_LE((space.spin->at(k) - plane.spin->at(k) * frame.col(2)).norm(), 1e-6 * 40.0);
    }
  }
}

TEST_P(Space, WhatItDoesNotHave_IsRefused) {
  SpaceScene scene = shearedLayers(0.0);
  scene.bodies[0].motion.kind = MotionKind::radial;
  const auto refusal = [&] {
    try {
      engine_->loadInSpace(asRun(scene), {});
    } catch (const UnsupportedScene& error) {
      return std::string(error.what());
    }
    return std::string("ran");
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
    seen[more] = snapshotAt<3>(*engine_, 4e-4);
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
