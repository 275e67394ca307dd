#include "tests/worker/yade_fixture.hpp"

namespace crossgrain::test {
namespace {

void expectSameState(const Snapshot& a, const Snapshot& b) {
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.velocity, b.velocity);
  EXPECT_EQ(a.spin, b.spin);
  ASSERT_EQ(a.contacts.has_value(), b.contacts.has_value());
  if (!a.contacts) return;
  EXPECT_EQ(a.contacts->i, b.contacts->i);
  EXPECT_EQ(a.contacts->normalForce, b.contacts->normalForce);
  EXPECT_EQ(a.contacts->tangentialForce, b.contacts->tangentialForce);
}

TEST_F(YadeWorker, MovesWallsAsPrescribed) {
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

TEST_F(YadeWorker, FliesAParabola) {
  Scene scene = emptyScene();
  scene.dt = 1e-3;
  scene.gravity = {0.5, -9.81};
  addDisk(scene, smallRadius, smallMass, {0.1, 0.2}, {0.3, 0.4}, 3.0);
  engine_->load(scene, {});
  engine_->advance(0.5);
  const Snapshot now = engine_->snapshot(ContactReport::instant);
  // Leapfrog is exact here if it starts half a step early.
  const Vec2 expected = Vec2(0.1, 0.2) + 0.5 * Vec2(0.3, 0.4) + 0.125 * scene.gravity;
  EXPECT_LT((now.position[0] - expected).norm(), 1e-13);
  const Vec2 velocity = Vec2(0.3, 0.4) + now.velocityTime * scene.gravity;
  EXPECT_LT((now.velocity[0] - velocity).norm(), 1e-13);
  EXPECT_EQ((*now.spin)[0], 3.0);
}

TEST_F(YadeWorker, LookingDoesNotChangeTheRunAndLoadingStartsAfresh) {
  const Scene scene = crowdedScene();
  engine_->load(scene, {});
  engine_->advance(0.02);
  const Snapshot first = engine_->snapshot(ContactReport::instant);
  expectSameState(engine_->snapshot(ContactReport::instant), first);
  engine_->advance(0.03);
  const Snapshot watched = engine_->snapshot(ContactReport::instant);

  engine_->load(emptyScene(), {});
  engine_->load(scene, {});
  EXPECT_FALSE(engine_->snapshot(ContactReport::instant).contacts)
      << "there are none before a step";
  engine_->advance(0.03);
  expectSameState(engine_->snapshot(ContactReport::instant), watched);
  EXPECT_EQ(engine_->stats().steps, 750u);
  EXPECT_GT(engine_->stats().contactEvaluations, 750u);
}

TEST_F(YadeWorker, RunsSideBySideToTheSameBits) {
  const auto second = startYade("yade-2");
  const auto third = startYade("yade-3");
  std::vector<Snapshot> ends;
  for (WorkerEngine* engine : {engine_.get(), second.get(), third.get()}) {
    engine->load(crowdedScene(), {});
    engine->advance(0.02);
    ends.push_back(engine->snapshot(ContactReport::instant));
  }
  expectSameState(ends[1], ends[0]);
  expectSameState(ends[2], ends[0]);
}

TEST_F(YadeWorker, RefusesWhatItCannotDo) {
  const auto refusal = [](const Scene& scene) {
    try {
      engine_->load(scene, {});
    } catch (const UnsupportedScene& error) {
      return std::string(error.what());
    }
    return std::string("ran");
  };
  Scene bottom = crowdedScene();
  bottom.bottom = thesisBottom<BottomPlate>();
  EXPECT_EQ(refusal(bottom), "has no bottom_friction");
  Scene viscous = crowdedScene();
  viscous.law.tangential = TangentialLaw::viscous;
  EXPECT_EQ(refusal(viscous), "has tangential = none | spring | spring_dashpot, not \"viscous\"");
  Scene tilted = crowdedScene();
  tilted.bodies[1].planes[0].normal = {0.6, 0.8};
  EXPECT_EQ(refusal(tilted),
            "has planes along x or y only; one of floor has the normal (0.6, 0.8)");
}

}  // namespace
}  // namespace crossgrain::test
