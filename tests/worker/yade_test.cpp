// YADE in its worker: walls, constants and forces, its Hertz–Mindlin functors against closed forms.
// All else that an engine must do is asked of it, as of every other, in tests/conformance; oblique
// impacts are compared with their mirror there.
#include "tests/worker/yade_worker.hpp"

#include <algorithm>
#include <cmath>

namespace crossgrain::test {
namespace {

/// Three spheres that meet each other and a floor that slides, not in one plane.
SpaceScene spheresOnAFloor() {
  SpaceScene scene;
  scene.name = "yade in space";
  scene.law = emptyScene().law;
  scene.law.dimension = 3;
  scene.law.tangential = TangentialLaw::spring;
  scene.dt = 4e-5;
  scene.gravity = {0.1, -9.81, 0.2};
  const Vec3 places[] = {{0.0, 0.0, 0.0}, {2.0, 0.1, 0.2}, {1.0, 1.74, -0.1}};
  for (int k = 0; k < 3; ++k) {
    scene.disks.radius.push_back(smallRadius);
    scene.disks.mass.push_back(smallMass);
    scene.disks.inertia.push_back(0.4 * smallMass * smallRadius * smallRadius);
    scene.disks.position.push_back(1.001 * smallRadius * places[k]);
    scene.disks.velocity.emplace_back(0.02 - 0.03 * k, -0.05, 0.01 * k);
    scene.disks.spin.emplace_back(20.0 * k, 30.0, -10.0);
  }
  WallBodyOf<3>& floor = scene.bodies.emplace_back();
  floor.name = "floor";
  floor.planes.push_back({{0.0, -1.001 * smallRadius, 0.0}, {0.0, 1.0, 0.0}});
  floor.motion.kind = MotionKind::translating;
  floor.motion.velocity = {0.02, 0.0, -0.01};
  return scene;
}

TEST_F(YadeWorker, SpheresInSpace_MoveAsItsMirrorMovesThem) {
  const auto mirror = findEngine("grain-as-yade")->make();
  SpaceScene scene = spheresOnAFloor();
  const EffectiveParameters effective = engine_->loadInSpace(scene, {});
  EXPECT_EQ(effective.dt, scene.dt);
  mirror->loadInSpace(scene, {});
  for (const double t : {0.0, 0.001, 0.004, 0.012}) {
    engine_->advance(t);
    mirror->advance(t);
    const SpaceSnapshot now = engine_->snapshotInSpace(ContactReport::none);
    const SpaceSnapshot own = mirror->snapshotInSpace(ContactReport::none);
    ASSERT_EQ(now.position.size(), 3u);
    // Rounding of 300 steps and some ten contacts.
    for (int k = 0; k < 3; ++k) EXPECT_LE((now.position[k] - own.position[k]).norm(), 1e-12 * t);
    EXPECT_EQ(now.bodies[0].centre, Vec3(t * scene.bodies[0].motion.velocity));
  }
  EXPECT_GT(mirror->stats().contactEvaluations, 100u);
}

TEST_F(YadeWorker, SlantingPlaneInSpace_IsRefused) {
  SpaceScene scene = spheresOnAFloor();
  scene.bodies[0].planes[0].normal = Vec3(0.6, 0.8, 0.0);
  EXPECT_THROW(engine_->loadInSpace(scene, {}), UnsupportedScene);
}

TEST_F(YadeWorker, Walls_MoveAsPrescribed) {
  Scene scene = emptyScene();
  scene.dt = 1e-4;
  addDisk(scene, smallRadius, smallMass, {1.0, 1.0}, {0, 0});
  Motion translating, oscillating, radial;
  translating.kind = Motion::Kind::translating;
  translating.velocity = {0.01, -0.02};
  oscillating.kind = Motion::Kind::oscillating;
  oscillating.amplitude = {0.003, 0.001};
  oscillating.frequency = 200.0;
  radial.kind = Motion::Kind::radial;
  radial.radialVelocity = -0.02;
  radial.radialEnd = 0.30003;  // within a step
  scene.bodies.push_back(ringBody("wheel", {0.1, 0.2}, 0.1032, 93, rotating(1.0)));
  scene.bodies.back().diskPosition.resize(40);  // its centre of mass is not its centre
  scene.bodies.back().diskRadius.resize(40);
  scene.bodies.push_back(ringBody("slider", {-0.5, 0}, 0.1, 5, translating));
  scene.bodies.push_back(ringBody("shaker", {-1.0, 0}, 0.1, 5, oscillating));
  scene.bodies.push_back(ringBody("shrinker", {-2.0, 0}, 0.1, 5, radial));
  engine_->load(scene, {});
  double worst = 0.0;
  for (const double t : {0.0, 0.0001, 0.1, 0.3, 0.3001, 1.0}) {
    ASSERT_NEAR(engine_->advance(t), t, 1e-12);  // 10⁴ steps in all
    const Snapshot now = engine_->snapshot(ContactReport::none);
    std::size_t k = 0;
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
      const WallBody& body = scene.bodies[b];
      const BodyState state = stateAt(body.motion, body.centre, now.positionTime);
      EXPECT_EQ(now.bodies[b].angle, state.angle);
      EXPECT_EQ(now.bodies[b].angularVelocity, state.angularVelocity);
      for (const Vec2& reference : body.diskPosition) {
        const double off =
            (now.wallPosition[k++] - memberPosition(state, body.centre, reference)).norm();
        // Rounding of 10⁴ additions; an uncorrected linear step would be off by 1e-5 m.
        EXPECT_LT(off, 1e-12) << body.name << " at " << t;
        worst = std::max(worst, off);
      }
    }
  }
  RecordProperty("worst_m", std::to_string(worst * 1e15) + "e-15");
}

TEST_F(YadeWorker, RotationBlocked_SpinsStay) {
  Scene scene = emptyScene();
  scene.rotation = false;
  addDisk(scene, smallRadius, smallMass, {-smallRadius - 0.5e-6, 0.0}, {0.05, 0.0}, 10.0);
  addDisk(scene, smallRadius, smallMass, {smallRadius + 0.5e-6, 0.0}, {-0.05, 0.0}, -3.0);
  scene.dt = 4e-5;
  const EffectiveParameters effective = engine_->load(scene, {});
  EXPECT_TRUE(effective.effects.contains(Effect::friction));
  EXPECT_FALSE(effective.effects.contains(Effect::rotation));
  engine_->advance(0.004);
  const Snapshot after = engine_->snapshot(ContactReport::instant);
  EXPECT_EQ(*after.spin, (std::vector<double>{10.0, -3.0}));
  EXPECT_LT(std::abs(after.velocity[0].x()), 0.05);  // they met,
  EXPECT_NE(after.velocity[0].y(), 0.0);             // and their spins rubbed
}

}  // namespace

void expectForcesThatMoveTheDisks(Engine& engine, const Scene& scene) {
  const std::size_t count = scene.disks.size();
  engine.load(scene, {});
  std::size_t sliding = 0, sticking = 0, withWall = 0, withPlane = 0;
  for (const int step : {1, 2, 1000, 2500, 4000, 5000, 6000}) {
    engine.advance((step - 1) * scene.dt);
    const Snapshot before = engine.snapshot(ContactReport::none);
    engine.advance(step * scene.dt);
    const Snapshot after = engine.snapshot(ContactReport::instant);
    EXPECT_DOUBLE_EQ(after.velocityTime, (step - 0.5) * scene.dt);
    EXPECT_DOUBLE_EQ(after.contactTime, (step - 1) * scene.dt);

    std::vector<Vec2> force(count, Vec2::Zero());
    std::vector<double> torque(count, 0.0);
    std::vector<Vec2> bodyForce(2, Vec2::Zero());
    const Contacts& contacts = *after.contacts;
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const auto i = static_cast<std::size_t>(contacts.i[c]);
      const auto j = static_cast<std::size_t>(contacts.j[c]);
      ASSERT_LT(i, count);
      const Vec2 f = contacts.normalForce[c] * contacts.normal[c] +
                     contacts.tangentialForce[c] * perpendicular(contacts.normal[c]);
      const bool plane = j >= count + 24;
      const bool onPlane = plane && scene.law.conventions.planeArm == PlaneArm::surface;
      const double depth = (onPlane ? 1.0 : 0.5) * contacts.overlap[c];
      const double rolling = contacts.rollingTorque.empty() ? 0.0 : contacts.rollingTorque[c];
      EXPECT_GT(contacts.overlap[c], 0.0);
      force[i] += f;
      torque[i] += rolling - (scene.disks.radius[i] - depth) * contacts.tangentialForce[c];
      (contacts.sliding[c] ? sliding : sticking) += 1;
      if (j < count) {
        force[j] -= f;
        torque[j] -= rolling + (scene.disks.radius[j] - depth) * contacts.tangentialForce[c];
      } else {
        bodyForce[plane ? 1 : 0] -= f;
        (plane ? withPlane : withWall) += 1;
      }
    }
    const double kick = after.velocityTime - before.velocityTime;  // half a step, the first time
    for (std::size_t i = 0; i < count; ++i) {
      const Vec2 acceleration = (after.velocity[i] - before.velocity[i]) / kick;
      const Vec2 expected = force[i] / scene.disks.mass[i] + scene.gravity;
      // v/dt loses about 1e-16·0.1/4e-5, the reconstructed dashpot as much.
      EXPECT_LT((acceleration - expected).norm(), 1e-10) << "disk " << i << ", step " << step;
      const double spinUp = ((*after.spin)[i] - (*before.spin)[i]) / kick;
      EXPECT_NEAR(spinUp, torque[i] / scene.disks.inertia[i], 1e-7) << i << ", step " << step;
    }
    // YADE sums its time step by step, which the shaking floor's velocity feels: γ·18 m/s²·1e-14 s.
    for (std::size_t b = 0; b < 2; ++b)
      EXPECT_LT((*after.bodies[b].force - bodyForce[b]).norm(), 1e-13) << "body " << b;
  }
  EXPECT_GT(sliding, 3u);
  EXPECT_GT(sticking, 3u);
  EXPECT_GT(withWall, 3u);
  EXPECT_GT(withPlane, 3u);
}

namespace {

TEST_F(YadeWorker, ContactForces_AreThoseThatMovedTheDisks) {
  expectForcesThatMoveTheDisks(*engine_, crowdedScene());
}

TEST_F(YadeWorker, ContactForcesOfHertzLaw_AreThoseThatMovedTheDisks) {
  expectForcesThatMoveTheDisks(*engine_, crowdedScene(hertzLaw()));
}

TEST_F(YadeWorker, MixesToTheScenesConstants_OfEveryPair) {
  for (const ContactLaw& law : {thesisLaw(), hertzLaw()}) {
    Scene scene = emptyScene();
    scene.law = law;
    scene.dt = 1e-5;
    addDisk(scene, smallRadius, smallMass, {0.0, 0.0}, {0, 0});
    addDisk(scene, largeRadius, largeMass, {0.1, 0.0}, {0, 0});
    addDisk(scene, largeRadius, largeMass, {0.2, 0.0}, {0, 0});
    scene.bodies.push_back(ringBody("ring", {0, 0}, 0.3, 4, {}));
    scene.bodies[0].planes.push_back({{0.0, -0.1}, {0.0, 1.0}});
    const EffectiveParameters effective = engine_->load(scene, {});
    // small–large, large–large, and each with a wall disk and a plane; there is one small disk
    // only.
    ASSERT_EQ(effective.pairs.size(), 6u);
    for (const PairCoefficients& pair : effective.pairs) {
      // To YADE's law of Hertz a plane is a sphere of 1e8 radii; else an ulp or two.
      const bool hertz = law.normal == NormalLaw::hertz;
      const double allowed = hertz && pair.pair.ends_with("plane") ? 1e-8 : 1e-14;
      EXPECT_NEAR(pair.kn / scene.law.kn, 1.0, allowed) << pair.pair;
      EXPECT_NEAR(pair.kt / scene.law.kt, 1.0, allowed) << pair.pair;
      EXPECT_DOUBLE_EQ(pair.gn, scene.law.gn) << pair.pair;
      EXPECT_DOUBLE_EQ(pair.gt, scene.law.gt) << pair.pair;
      EXPECT_DOUBLE_EQ(pair.mu, scene.law.mu) << pair.pair;
    }
    EXPECT_EQ(effective.effects, effectsOf(scene));
  }
}

TEST_F(YadeWorker, SceneItCannotDo_IsRefused) {
  const auto refusal = [](const Scene& scene) { return refusalOf(*engine_, scene); };
  Scene bottom = crowdedScene(), tilted = crowdedScene();
  bottom.bottom = thesisBottom<BottomPlate>();
  EXPECT_EQ(refusal(bottom), "has no bottom_friction");
  tilted.bodies[1].planes[0].normal = {0.6, 0.8};
  EXPECT_EQ(refusal(tilted), "has planes along axes only; one of floor has the normal (0.6, 0.8)");
  ContactLaw viscous = thesisLaw(), constant = hertzLaw(), steep = hertzLaw(),
             critical = thesisLaw();
  viscous.tangential = TangentialLaw::viscous;
  constant.damper = Damper::constant;
  steep.kt = 2.5 * steep.kn;
  critical.damper = Damper::critical;
  ContactLaw polynomial = critical;
  polynomial.normal = NormalLaw::polynomial;
  for (const auto& [law, reason] :
       {std::pair(viscous, "has tangential = none | spring | spring_dashpot, not \"viscous\""),
        {constant, "has only damper = \"critical\" with normal = \"hertz\""},
        {steep, "Poisson's ratio"},
        {critical, "has only damper = \"constant\" with normal = \"linear\""},
        {polynomial, "has normal = linear | hertz, not \"polynomial\""}}) {
    Scene scene = crowdedScene();
    scene.law = law;
    EXPECT_NE(refusal(scene).find(reason), std::string::npos) << refusal(scene);
  }
}

/// Spheres or disks that meet with Hertz' law, at a relative speed along x.
struct Meeting {
  double kn;            ///< 4/3 E₁₂ [Pa]
  double radius, mass;  ///< of each [m, kg]
  double speed;         ///< [m/s]
  bool plane = false;   ///< a plane that does not yield instead of the second

  double reducedMass() const { return plane ? mass : mass / 2; }
  double reducedRadius() const { return plane ? radius : radius / 2; }
  /// Johnson 1985, Eqs. 11.23 and 11.24, written with k_n = 4/3 E₁₂.
  double deepest() const {
    return std::pow(1.25 * reducedMass() * speed * speed / (kn * std::sqrt(reducedRadius())), 0.4);
  }
  double largestForce() const { return kn * std::sqrt(reducedRadius()) * std::pow(deepest(), 1.5); }
  double duration() const { return 2.9432 * deepest() / speed; }
};

Scene sceneOf(const Meeting& pair, double gn, int stepsPerContact) {
  Scene scene;
  scene.law = hertzLaw();
  scene.law.kn = pair.kn;
  scene.law.kt = 1.2 * pair.kn;
  scene.law.gn = gn;
  scene.dt = pair.duration() / stepsPerContact;
  const double gap = 0.3 * scene.dt * pair.speed;
  if (pair.plane) {
    scene.bodies = {planeWall({0.0, 0.0}, {1.0, 0.0})};
    addDisk(scene, pair.radius, pair.mass, {pair.radius + gap, 0.0}, {-pair.speed, 0.0});
  } else {
    for (const double side : {1.0, -1.0})
      addDisk(scene, pair.radius, pair.mass, {side * (pair.radius + gap / 2), 0.0},
              {-side * pair.speed / 2, 0.0});
  }
  return scene;
}

struct Course {
  double deepest = 0.0, largestForce = 0.0, duration = 0.0, restitution = 0.0;
};

Course courseOf(Engine& engine, const Meeting& pair, double gn, int stepsPerContact) {
  const Scene scene = sceneOf(pair, gn, stepsPerContact);
  engine.load(scene, {});
  Course course;
  for (int step = 1; step <= 1.5 * stepsPerContact; ++step) {
    engine.advance(step * scene.dt);
    const Snapshot now = engine.snapshot(ContactReport::instant);
    const Contacts& contacts = now.contacts.value();
    const double away = now.velocity[0].x() - (pair.plane ? 0.0 : now.velocity[1].x());
    course.restitution = away / pair.speed;
    if (contacts.size() == 0) continue;
    course.deepest = std::max(course.deepest, contacts.overlap[0]);
    course.largestForce = std::max(course.largestForce, contacts.normalForce[0]);
    course.duration += scene.dt;
  }
  return course;
}

double sphereMass(double radius, double density) {
  return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius * density;
}

constexpr int steps = 500;
constexpr double oneStep = 1.1 / steps;  // in which a contact begins or ends

/// Without damping: the deepest point is missed by up to half a step, (π/1000)²/2 = 5e-6.
void expectElasticAsHertz(Engine& engine, const Meeting& meeting) {
  const Course yade = courseOf(engine, meeting, 0.0, steps);
  EXPECT_NEAR(yade.deepest / meeting.deepest(), 1.0, 1e-5);
  EXPECT_NEAR(yade.largestForce / meeting.largestForce(), 1.0, 2e-5);
  EXPECT_NEAR(yade.duration / meeting.duration(), 1.0, oneStep);
  EXPECT_NEAR(yade.restitution, 1.0, 1e-6);
}

// Chung and Ooi (2011), test 1: two glass spheres.
TEST_F(YadeWorker, GlassSpheres_MeetAsHertzSays) {
  const double elasticity = 48e9 / (2 * (1 - 0.2 * 0.2));  // E₁₂
  const Meeting glass{4.0 / 3.0 * elasticity, 0.010, sphereMass(0.010, 2800), 20.0};
  EXPECT_NEAR(glass.deepest(), 274.1e-6, 0.05e-6);
  EXPECT_NEAR(glass.largestForce(), 10.70e3, 5.0);
  EXPECT_NEAR(glass.duration(), 40.3e-6, 0.05e-6);
  expectElasticAsHertz(*engine_, glass);
}

// Chung and Ooi (2011), test 2: an aluminium sphere on a rigid plane. R₁₂ is the sphere's radius.
TEST_F(YadeWorker, SphereOnAPlane_MeetsAsHertzSays) {
  const double elasticity = 70e9 / (1 - 0.3 * 0.3);
  const Meeting alloy{4.0 / 3.0 * elasticity, 0.1, sphereMass(0.1, 2699), 0.2, true};
  EXPECT_NEAR(alloy.deepest(), 49.7e-6, 0.05e-6);
  EXPECT_NEAR(alloy.largestForce(), 11.37e3, 5.0);
  EXPECT_NEAR(alloy.duration(), 732e-6, 0.5e-6);
  expectElasticAsHertz(*engine_, alloy);
}

// In y ~ δ^(5/4) and a time that runs as δ^(1/4), Hertz' law with critical dampers is a linear
// oscillator with β = γ/(2 √(5/6)) (Antypov and Elliott 2011), so with the tension cut its e is
// that of Schwager and Pöschel (2007) for a linear law, at every speed.
TEST_F(YadeWorker, CriticalDampers_RestoreTheSameAtEverySpeed) {
  constexpr double gn = 0.3;
  const double beta = gn / (2 * std::sqrt(5.0 / 6.0));
  const double omega = std::sqrt(1 - beta * beta);
  const double expected =
      std::exp(-beta / omega *
               (std::numbers::pi - std::atan2(2 * beta * omega, omega * omega - beta * beta)));
  EXPECT_NEAR(expected, 0.6260, 5e-5);
  for (const bool plane : {false, true})
    for (const double speed : {0.01, 0.1, 1.0}) {
      const Meeting pair{7e5, smallRadius, smallMass, speed, plane};
      // Velocities that lag make it first order in dt.
      EXPECT_NEAR(courseOf(*engine_, pair, gn, steps).restitution / expected, 1.0, 0.001)
          << "at " << speed << " m/s" << (plane ? " on a plane" : "");
    }
}

// The first step is a half kick, made of twice the inertia, which critical dampers would see.
TEST_F(YadeWorker, FirstStep_DampsWithTheScenesMasses) {
  Scene scene;
  scene.law = hertzLaw();
  scene.dt = 1e-6;
  constexpr double overlap = 2e-5, speed = 0.1;
  addDisk(scene, smallRadius, smallMass, {0.0, 0.0}, {0.0, 0.0});
  addDisk(scene, largeRadius, largeMass, {smallRadius + largeRadius - overlap, 0.0}, {-speed, 0.0});
  engine_->load(scene, {});
  const double radius = smallRadius * largeRadius / (smallRadius + largeRadius);
  const double mass = smallMass * largeMass / (smallMass + largeMass);
  const double root = std::sqrt(radius * overlap);
  const double elastic = scene.law.kn * root * overlap;
  const double dashpot = scene.law.gn * std::sqrt(mass * 1.5 * scene.law.kn * root) * speed;
  engine_->advance(scene.dt);
  EXPECT_NEAR(engine_->snapshot(ContactReport::instant).contacts->normalForce[0], elastic + dashpot,
              1e-9 * elastic);
  engine_->advance(2 * scene.dt);
  // A step deeper, 0.1 µm of 20 µm; √2 in the dashpot's force would be 40 %.
  EXPECT_NEAR(engine_->snapshot(ContactReport::instant).contacts->normalForce[0], elastic + dashpot,
              0.01 * elastic);
}

}  // namespace
}  // namespace crossgrain::test
