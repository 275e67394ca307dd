// YADE's Hertz–Mindlin functors against closed forms. What they do in oblique impacts is held
// against their mirror in tests/conformance.
#include <algorithm>

#include "tests/worker/yade_fixture.hpp"

namespace crossgrain::test {
namespace {

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
TEST_F(YadeWorker, GlassSpheresMeetAsHertzSays) {
  const double elasticity = 48e9 / (2 * (1 - 0.2 * 0.2));  // E₁₂
  const Meeting glass{4.0 / 3.0 * elasticity, 0.010, sphereMass(0.010, 2800), 20.0};
  EXPECT_NEAR(glass.deepest(), 274.1e-6, 0.05e-6);
  EXPECT_NEAR(glass.largestForce(), 10.70e3, 5.0);
  EXPECT_NEAR(glass.duration(), 40.3e-6, 0.05e-6);
  expectElasticAsHertz(*engine_, glass);
}

// Chung and Ooi (2011), test 2: an aluminium sphere on a rigid plane. R₁₂ is the sphere's radius.
TEST_F(YadeWorker, SphereMeetsAPlaneAsHertzSays) {
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
TEST_F(YadeWorker, CriticalDampersRestoreTheSameAtEverySpeed) {
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
TEST_F(YadeWorker, FirstStepDampsWithTheScenesMasses) {
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

TEST_F(YadeWorker, MixesToTheScenesConstantsOfHertzLaw) {
  Scene scene;
  scene.law = hertzLaw();
  scene.dt = 1e-5;
  addDisk(scene, smallRadius, smallMass, {0.0, 0.0}, {0, 0});
  addDisk(scene, largeRadius, largeMass, {0.1, 0.0}, {0, 0});
  scene.bodies.push_back(ringBody("ring", {0, 0}, 0.3, 4, {}));
  scene.bodies[0].planes.push_back({{0.0, -0.1}, {0.0, 1.0}});
  const EffectiveParameters effective = engine_->load(scene, {});
  ASSERT_EQ(effective.pairs.size(), 5u);
  for (const PairCoefficients& pair : effective.pairs) {
    // A plane is a sphere of 1e8 radii to YADE.
    const double allowed = pair.pair.ends_with("plane") ? 1e-8 : 1e-14;
    EXPECT_NEAR(pair.kn / scene.law.kn, 1.0, allowed) << pair.pair;
    EXPECT_NEAR(pair.kt / scene.law.kt, 1.0, allowed) << pair.pair;
    EXPECT_DOUBLE_EQ(pair.gn, scene.law.gn) << pair.pair;
    EXPECT_DOUBLE_EQ(pair.gt, scene.law.gt) << pair.pair;
    EXPECT_DOUBLE_EQ(pair.mu, scene.law.mu) << pair.pair;
  }
  EXPECT_EQ(effective.effects, effectsOf(scene));
}

TEST_F(YadeWorker, RefusesWhatItsHertzLawCannotDo) {
  const auto expectRefusal = [](const ContactLaw& law, const std::string& reason) {
    Scene scene;
    scene.law = law;
    scene.dt = 1e-5;
    addDisk(scene, smallRadius, smallMass, {0.0, 0.0}, {0, 0});
    try {
      engine_->load(scene, {});
      FAIL() << "not refused: " << reason;
    } catch (const UnsupportedScene& refusal) {
      EXPECT_NE(std::string(refusal.what()).find(reason), std::string::npos) << refusal.what();
    }
  };
  ContactLaw law = hertzLaw();
  for (const Damper damper : {Damper::constant, Damper::viscoelastic}) {
    law.damper = damper;
    expectRefusal(law, "has only damper = \"critical\" with normal = \"hertz\"");
  }
  law = hertzLaw();
  law.kt = 2.5 * law.kn;
  expectRefusal(law, "Poisson's ratio");
  law = emptyScene().law;
  law.damper = Damper::critical;
  expectRefusal(law, "has only damper = \"constant\" with normal = \"linear\"");
  law.normal = NormalLaw::polynomial;
  expectRefusal(law, "has normal = linear | hertz, not \"polynomial\"");
}

}  // namespace
}  // namespace crossgrain::test
