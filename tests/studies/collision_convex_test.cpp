// Sweeps of convex bodies: scenes that meet as the case says, and engines that end an impact by one
// hypothesis of restitution or another, or wrongly.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "cases/loader.hpp"
#include "cases/time_step.hpp"
#include "studies/collide/sweep.hpp"
#include "tests/support/refusal.hpp"

namespace {

using namespace crossgrain;

std::vector<Case> shipped(const std::string& name, const std::vector<std::string>& set = {}) {
  return loadCase(std::filesystem::path(CROSSGRAIN_CASES) / ("collision/" + name + ".toml"), set);
}

Case variantOf(const std::string& name, const std::string& variant,
               const std::vector<std::string>& set = {}) {
  for (Case& setup : shipped(name, set))
    if (setup.variant == variant) return setup;
  throw std::logic_error("no variant " + variant);
}

/// Of both bodies of a start, or the one on a wall, moved on to the touch.
template <int D>
void expectTouch(const Case& setup) {
  const auto starts = collisionStarts(setup);
  const double dt = timeStep(setup), flight = collisionIn(setup).startPhase * dt;
  SceneOf<D> scene = sweepScene<D>(setup, starts, dt);
  DisksOf<D>& bodies = scene.disks;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    bodies.position[i] += flight * bodies.velocity[i];
    if constexpr (D == 2) {
      bodies.turn[i] += flight * bodies.spin[i];
    } else if (const double angle = flight * bodies.spin[i].norm(); angle > 0.0) {
      const auto& q = bodies.turn[i];
      const Eigen::Quaterniond on =
          Eigen::Quaterniond(Eigen::AngleAxisd(angle, bodies.spin[i].normalized())) *
          Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
      bodies.turn[i] = {on.w(), on.x(), on.y(), on.z()};
    }
  }
  const bool wall = collisionIn(setup).wall;
  for (std::size_t k = 0; k < starts.size(); ++k) {
    const std::size_t i = wall ? k : 2 * k;
    const double overlap =
        wall ? overlapWithPlane<D>(scene, i, bodies.position[i], scene.bodies[0].planes[0])
             : overlapOfPair<D>(scene, i, i + 1, bodies.position[i] - bodies.position[i + 1]);
    EXPECT_NEAR(overlap, 0.0, 1e-12) << setup.name << " " << setup.variant << " " << k;
    const ConvexImpactStart<D> impact = convexTouch<D>(setup, starts[k]).impact;
    const VecOf<D> meets = velocityAtContact(impact.body[0]) - velocityAtContact(impact.body[1]);
    EXPECT_NEAR(meets[0], -starts[k].vn, 1e-12);
    EXPECT_NEAR(meets[1], starts[k].psi * starts[k].vn, 1e-12);
    if (D == 3) {
      EXPECT_NEAR(meets[D - 1], 0.0, 1e-12);
    }
  }
}

TEST(ConvexCollisions, Scenes_MeetWithOneCornerAfterTheStartPhase) {
  for (const char* const name : {"convex-box", "convex-pair"})
    for (const Case& setup : shipped(name)) expectTouch<2>(setup);
  for (const Case& setup : shipped("convex-space", {"collision.turn=[10.0, 20.0, 30.0]"}))
    expectTouch<3>(setup);
}

/// A square of 0.1 m turned by 30° meets the plane x = 0: the table of the reference, turned by a
/// right angle, so that its x is −s.
TEST(ConvexCollisions, SquareAt30Degrees_NumbersOfTheTable) {
  Case setup = variantOf(
      "convex-box", "oblique",
      {"collision.shape.box=[0.1, 0.1]", "collision.psi=2.0", "law.e_n=0.8", "law.mu=0.1"});
  const auto starts = collisionStarts(setup);
  const ConvexImpact<2> impact = convexImpact(convexTouch<2>(setup, starts[0]).impact);
  ASSERT_TRUE(impact.judged);
  // v = (−2, −1) there: v_n = 0.1 here, and all goes with it.
  const ImpactOutcome<2>& after = *impact.newton;
  const OracleCurve oracle = oracleCurve(setup, starts);
  const CollisionEnd& end = *oracle.ends[0];
  EXPECT_NEAR(end.convex->centreNormal, after.velocity[0].x() / 0.1, 1e-12);
  EXPECT_NEAR(after.velocity[0].x(), 0.1 * 0.598633, 1e-7);
  EXPECT_NEAR(after.velocity[0].y(), 0.1 * 1.840137, 1e-7);
  EXPECT_NEAR(after.spin[0], -1.1002890, 1e-6);
  EXPECT_NEAR(end.en, 0.8, 1e-12);
}

using Choice = std::function<const ImpactOutcome<2>&(const ConvexImpact<2>&)>;

/// Bodies above the plane x = 0 that fly until a corner is behind it.
class ImpactEngine : public Engine {
 public:
  explicit ImpactEngine(
      Choice choose, std::function<void(ConvexImpactStart<2>&)> spoil = [](auto&) {})
      : choose_(std::move(choose)), spoil_(std::move(spoil)) {}

  Capabilities capabilities() const override {
    Capabilities can;
    for (const Effect effect : allEffects) can.effects[effect] = Support::optional;
    can.lawOptions = {{"normal", {"rigid"}}};
    can.tangentialRestitution = false;
    can.limits.shapes = {ShapeKind::polygon};
    return can;
  }
  EffectiveParameters load(const Scene& scene, const Settings&) override {
    scene_ = scene;
    steps_ = 0;
    EffectiveParameters effective{.engine = "impacts", .dt = scene.dt, .precision = "double"};
    effective.pairs.push_back({.pair = "all", .mu = scene.law.mu, .en = scene.law.en});
    return effective;
  }
  double advance(double t) override {
    for (; steps_ < static_cast<std::uint64_t>(std::llround(t / scene_.dt)); ++steps_)
      for (std::size_t i = 0; i < scene_.disks.size(); ++i) step(i);
    return static_cast<double>(steps_) * scene_.dt;
  }
  Snapshot snapshot(ContactReport) override {
    Snapshot now;
    now.positionTime = now.velocityTime = static_cast<double>(steps_) * scene_.dt;
    now.position = scene_.disks.position;
    now.velocity = scene_.disks.velocity;
    now.spin = scene_.disks.spin;
    now.turn = scene_.disks.turn;
    return now;
  }
  Stats stats() const override {
    Stats stats;
    stats.steps = steps_;
    return stats;
  }

 private:
  void step(std::size_t i) {
    Disks& bodies = scene_.disks;
    bodies.position[i] += scene_.dt * bodies.velocity[i];
    bodies.turn[i] += scene_.dt * bodies.spin[i];
    const Vec2 arm = cornerTowards<2>(scene_.shapes[0], bodies.turn[i], -Vec2::UnitX()).arm;
    if (bodies.position[i].x() + arm.x() > 0.0) return;
    ConvexImpactStart<2> start;
    start.body[0] = impactBody<2>(bodies, i, arm);
    start.normal = Vec2::UnitX();
    start.restitution = scene_.law.en;
    start.mu = scene_.law.mu;
    if (velocityAtContact(start.body[0]).x() > -1e-9) return;
    spoil_(start);
    const ConvexImpact<2> impact = convexImpact(start);
    bodies.velocity[i] = choose_(impact).velocity[0];
    bodies.spin[i] = choose_(impact).spin[0];
  }

  Choice choose_;
  std::function<void(ConvexImpactStart<2>&)> spoil_;
  Scene scene_;
  std::uint64_t steps_ = 0;
};

const ImpactOutcome<2>& newtons(const ConvexImpact<2>& impact) {
  return *impact.newton;
}
const ImpactOutcome<2>& poissons(const ConvexImpact<2>& impact) {
  return impact.poisson;
}

CollisionCurve sweptBy(const Case& setup, Engine& engine) {
  const EngineEntry entry{.name = "impacts", .summary = ""};
  const auto starts = collisionStarts(setup);
  return runSweep(engine, entry, setup, timeStep(setup), starts, oracleCurve(setup, starts), true);
}

TEST(ConvexCollisions, NewtonsAndPoissonsEngine_BothPassWhereTheyAgree) {
  const Case setup = variantOf("convex-box", "oblique");
  ImpactEngine newton(newtons), poisson(poissons);
  const CollisionCurve one = sweptBy(setup, newton), other = sweptBy(setup, poisson);
  EXPECT_EQ(one.score.verdict, Verdict::pass);
  EXPECT_EQ(other.score.verdict, Verdict::pass);
  int judged = 0, apart = 0;
  for (std::size_t k = 0; k < one.points.size(); ++k) {
    const auto off = [&](QuantityId id) {
      return std::abs(*one.points.at(id, k) - *other.points.at(id, k));
    };
    const bool same = std::max(off(QuantityId::psiF), off(QuantityId::en)) < 1e-9;
    if (one.points.status(k) == "parted") {
      ++judged;
      EXPECT_TRUE(same) << k;
    } else {
      EXPECT_EQ(one.points.status(k), "not judged");
      apart += !same;
    }
  }
  EXPECT_GE(judged, 20);
  EXPECT_GT(apart, 3);
  EXPECT_FALSE(one.causes || one.declared);
}

TEST(ConvexCollisions, NothingJudged_InputsStay) {
  const Case setup = variantOf("convex-box", "oblique");
  const auto starts = collisionStarts(setup);
  const CollisionTable table = tableOf(starts, Outcomes(starts.size()), true);
  ASSERT_EQ(table.orientation.size(), starts.size());
  EXPECT_NEAR(table.orientation.front(), 30.0, 1e-9);
  EXPECT_EQ(table.spin.size(), starts.size());
}

TEST(ConvexCollisions, ImpulseAtTheCentre_Fails) {
  ImpactEngine engine(newtons, [](ConvexImpactStart<2>& start) { start.body[0].arm.setZero(); });
  const CollisionCurve curve = sweptBy(variantOf("convex-box", "orientation-smooth"), engine);
  EXPECT_EQ(curve.score.verdict, Verdict::fail);
  EXPECT_EQ(curve.score.of[QuantityId::spinI]->held, false);
  EXPECT_EQ(curve.score.of[QuantityId::energyGained]->held, true);
}

/// Where an elastic impact stops its slip, Newton's restitution adds energy (Kane and Levinson
/// 1985) and Poisson's does not.
TEST(ConvexCollisions, HypothesesDiffer_OnlyAGainOfEnergyIsJudged) {
  Case setup = variantOf("convex-box", "orientation-elastic");
  collisionIn(setup).orientation = {std::numbers::pi / 18.0, std::numbers::pi / 12.0};
  for (const ConvexOutcomes& outcomes : oracleCurve(setup, collisionStarts(setup)).convex) {
    EXPECT_FALSE(outcomes.judged);
    EXPECT_EQ(outcomes.kind, "slip-stick");
  }
  ImpactEngine newton(newtons), poisson(poissons);
  const CollisionCurve gains = sweptBy(setup, newton), sound = sweptBy(setup, poisson);
  EXPECT_EQ(sound.score.verdict, Verdict::pass);
  EXPECT_FALSE(sound.score.of[QuantityId::psiF]);
  EXPECT_EQ(gains.score.verdict, Verdict::fail);
  EXPECT_NEAR(gains.score.of[QuantityId::energyGained]->max, 0.08, 0.01);
}

TEST(ConvexCollisions, Capsule_OnAnEngineWithoutIt_IsRefusedInOneLine) {
  ImpactEngine engine(newtons);
  test::expectSays(test::refusalOf<UnsupportedScene>(
                       [&] { sweptBy(variantOf("convex-box", "capsule"), engine); }),
                   {"has no capsule"});
}

}  // namespace
