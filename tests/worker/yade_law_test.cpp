#include "tests/worker/yade_fixture.hpp"

namespace crossgrain::test {
namespace {

// With the tension cut e = exp(−(η/ω)(π − atan2(2ηω, ω² − η²))) (Schwager and Pöschel 2007).
TEST_F(YadeWorker, RestitutionOfTwoDisksIsThatOfTheLaw) {
  Scene scene = emptyScene();
  const double reduced = smallMass / 2;
  const double eta = scene.law.gn / (2 * reduced);
  const double omega = std::sqrt(scene.law.kn / reduced - eta * eta);
  const double expected = std::exp(
      -eta / omega * (std::numbers::pi - std::atan2(2 * eta * omega, omega * omega - eta * eta)));
  EXPECT_NEAR(expected, 0.3408, 5e-5);

  const double contactTime = std::numbers::pi / omega;
  scene.dt = contactTime / 1000;
  addDisk(scene, smallRadius, smallMass, {-smallRadius - 0.5e-6, 0.0}, {0.05, 0.0});
  addDisk(scene, smallRadius, smallMass, {smallRadius + 0.5e-6, 0.0}, {-0.05, 0.0});
  engine_->load(scene, {});
  engine_->advance(2 * contactTime);
  const Snapshot after = engine_->snapshot(ContactReport::instant);
  EXPECT_EQ(after.contacts->size(), 0u);
  const double restitution = (after.velocity[1].x() - after.velocity[0].x()) / 0.1;
  // First order in dt: 1/1000 of a contact is off by about 0.1 %.
  EXPECT_NEAR(restitution / expected, 1.0, 0.005);
  RecordProperty("restitution", std::to_string(restitution));
}

TEST_F(YadeWorker, BlocksSpinsThatTheSceneBlocks) {
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

TEST_F(YadeWorker, MixesToTheScenesConstantsForEveryPair) {
  Scene scene = emptyScene();
  addDisk(scene, smallRadius, smallMass, {0.0, 0.0}, {0, 0});
  addDisk(scene, largeRadius, largeMass, {0.1, 0.0}, {0, 0});
  addDisk(scene, largeRadius, largeMass, {0.2, 0.0}, {0, 0});
  scene.bodies.push_back(ringBody("ring", {0, 0}, 0.3, 4, {}));
  scene.bodies[0].planes.push_back({{0.0, -0.1}, {0.0, 1.0}});
  const EffectiveParameters effective = engine_->load(scene, {});
  // small–large, large–large, and each with a wall disk and a plane; there is one small disk only.
  ASSERT_EQ(effective.pairs.size(), 6u);
  for (const PairCoefficients& pair : effective.pairs) {
    // 1/(1/2k + 1/2k) and tan(atan µ) may be off by an ulp or two; EXPECT_DOUBLE_EQ allows four.
    EXPECT_DOUBLE_EQ(pair.kn, scene.law.kn) << pair.pair;
    EXPECT_DOUBLE_EQ(pair.gn, scene.law.gn) << pair.pair;
    EXPECT_DOUBLE_EQ(pair.kt, scene.law.kt) << pair.pair;
    EXPECT_DOUBLE_EQ(pair.gt, scene.law.gt) << pair.pair;
    EXPECT_DOUBLE_EQ(pair.mu, scene.law.mu) << pair.pair;
  }
  EXPECT_TRUE(effective.deviations.empty());
  EXPECT_EQ(effective.effects, effectsOf(scene));
}

TEST_F(YadeWorker, KeepsMomentumInAnObliqueCollision) {
  Scene scene = emptyScene();
  addDisk(scene, smallRadius, smallMass, {-smallRadius, 0.5e-3}, {0.05, 0.02}, 10.0);
  addDisk(scene, largeRadius, largeMass, {4.6e-3, -0.5e-3}, {-0.03, 0.0}, 4.0);
  const auto momentum = [&](const Snapshot& s) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();  // linear, and angular about the origin
    for (std::size_t i = 0; i < 2; ++i) {
      const double m = scene.disks.mass[i];
      // Positions are taken back to the time of the velocities, where x × v is unambiguous.
      sum += Eigen::Vector3d(
          m * s.velocity[i].x(), m * s.velocity[i].y(),
          m * cross(s.position[i], s.velocity[i]) + scene.disks.inertia[i] * (*s.spin)[i]);
    }
    return sum;
  };
  engine_->load(scene, {});
  const Eigen::Vector3d before = momentum(engine_->snapshot(ContactReport::none));
  engine_->advance(3e-3);
  ASSERT_EQ(engine_->snapshot(ContactReport::instant).contacts->size(), 1u);
  engine_->advance(10e-3);
  const Snapshot after = engine_->snapshot(ContactReport::instant);
  ASSERT_EQ(after.contacts->size(), 0u);
  EXPECT_GT(std::abs((*after.spin)[0] - 10.0), 0.1);
  // YADE's two torques act at one contact point, so nothing but rounding is lost.
  EXPECT_LT((momentum(after) - before).cwiseAbs().maxCoeff(), 1e-12 * before.norm());
}

// Newton's second law ties velocities, which YADE integrates, to the contacts that the worker
// reads.
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
      const Vec2 f = contacts.normalForce[c] * contacts.normal[c] +
                     contacts.tangentialForce[c] * perpendicular(contacts.normal[c]);
      const bool plane = j >= count + 24;
      const double depth = (plane ? 1.0 : 0.5) * contacts.overlap[c];
      EXPECT_GT(contacts.overlap[c], 0.0);
      force[i] += f;
      torque[i] -= (scene.disks.radius[i] - depth) * contacts.tangentialForce[c];
      (contacts.sliding[c] ? sliding : sticking) += 1;
      if (j < count) {
        force[j] -= f;
        torque[j] -= (scene.disks.radius[j] - depth) * contacts.tangentialForce[c];
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

TEST_F(YadeWorker, ContactForcesAreThoseThatMovedTheDisks) {
  expectForcesThatMoveTheDisks(*engine_, crowdedScene());
}

TEST_F(YadeWorker, ContactForcesOfHertzLawAreThoseThatMovedTheDisks) {
  expectForcesThatMoveTheDisks(*engine_, crowdedScene(hertzLaw()));
}

// The wheel's torque from the contacts' own numbers: each acts at its contact point. Where the
// packing stands at one instant is chaotic, and now and then nothing touches the wheel: many
// instants are asked.
TEST_F(YadeWorker, TorqueOnTheWheelIsThatOfItsContacts) {
  const Scene scene = crowdedScene();
  const std::size_t count = scene.disks.size();
  engine_->load(scene, {});
  int touched = 0;
  for (int step = 500; step <= 6000; step += 500) {
    engine_->advance((step - 1) * scene.dt);
    const Snapshot then = engine_->snapshot(ContactReport::none);
    engine_->advance(step * scene.dt);
    const Snapshot now = engine_->snapshot(ContactReport::instant);
    double torque = 0.0, terms = 0.0;
    for (std::size_t c = 0; c < now.contacts->size(); ++c) {
      const auto i = static_cast<std::size_t>(now.contacts->i[c]);
      const auto j = static_cast<std::size_t>(now.contacts->j[c]);
      if (j < count || j >= count + 24) continue;
      const Vec2 n = now.contacts->normal[c];
      const Vec2 f =
          now.contacts->normalForce[c] * n + now.contacts->tangentialForce[c] * perpendicular(n);
      // The contacts are as old as the earlier positions.
      const Vec2 point =
          then.position[i] - (scene.disks.radius[i] - now.contacts->overlap[c] / 2) * n;
      const double term = cross(point - scene.bodies[0].centre, f);
      torque -= term;
      terms += std::abs(term);
    }
    touched += terms > 1e-7;
    EXPECT_NEAR(*now.bodies[0].torque, torque, 1e-9 * terms) << "step " << step;
  }
  EXPECT_GE(touched, 6);
}

TEST_F(YadeWorker, SpinsNothingWithoutFriction) {
  Scene scene = crowdedScene();
  scene.law.tangential = TangentialLaw::none;
  EXPECT_FALSE(engine_->load(scene, {}).effects.contains(Effect::rotation));
  engine_->advance(0.1);
  const Snapshot now = engine_->snapshot(ContactReport::instant);
  EXPECT_FALSE(now.spin);
  ASSERT_GT(now.contacts->size(), 5u);
  for (const double force : now.contacts->tangentialForce) EXPECT_EQ(force, 0.0);
}

}  // namespace
}  // namespace crossgrain::test
