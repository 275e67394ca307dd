// Two bodies meet once. What comes out is held against conservation laws and the oracles.
#include <cmath>
#include <stdexcept>

#include "adapters/law_options.hpp"
#include "cases/collision_scene.hpp"
#include "oracle/collision_flight.hpp"
#include "oracle/collision_oracle.hpp"
#include "tests/conformance/conformance.hpp"
#include "tests/support/pairs.hpp"

namespace crossgrain::test {
namespace {

constexpr double fine = 400.0;   // steps in a contact, where an outcome is compared
constexpr double coarse = 50.0;  // where only exact properties are

Vec2 momentum(const Scene& scene, const Snapshot& now) {
  Vec2 sum = Vec2::Zero();
  for (std::size_t i = 0; i < now.velocity.size(); ++i)
    sum += scene.disks.mass[i] * now.velocity[i];
  return sum;
}

double kineticEnergy(const Scene& scene, const Snapshot& now) {
  const std::vector<double> spins = spinsOf(scene, now);
  double sum = 0.0;
  for (std::size_t i = 0; i < now.velocity.size(); ++i)
    sum += 0.5 * scene.disks.mass[i] * now.velocity[i].squaredNorm() +
           0.5 * scene.disks.inertia[i] * spins[i] * spins[i];
  return sum;
}

/// About the origin. In free flight x × v does not change, so it does not matter that an engine
/// shows positions and velocities of slightly different times.
double angularMomentum(const Scene& scene, const Snapshot& now) {
  const std::vector<double> spins = spinsOf(scene, now);
  double sum = 0.0;
  for (std::size_t i = 0; i < now.velocity.size(); ++i)
    sum += scene.disks.mass[i] * cross(now.position[i], now.velocity[i]) +
           scene.disks.inertia[i] * spins[i];
  return sum;
}

void expectParted(const Snapshot& now, double reach) {
  const Vec2 apart = now.position[0] - now.position[1];
  EXPECT_GT(apart.norm(), reach);
  EXPECT_GT((now.velocity[0] - now.velocity[1]).dot(apart), 0.0);
}

const Tolerance restitution = {0.0, 0.02, "a first-order scheme at t_c/400"};

TEST_P(Conformance, HeadOnCollision) {
  Encounter unequal;  // masses 1 : 10 of one material
  unequal.radii[1] = std::sqrt(10.0) * smallRadius;
  unequal.masses[1] = 10.0 * smallMass;
  unequal.drift = {0.013, -0.021};
  for (const Encounter& pair : {Encounter{}, unequal}) {
    const Scene scene = encounterScene(pair, law(), fine);
    if (const auto why = refused(scene)) GTEST_SKIP() << *why;
    const Snapshot before = at(0.0);
    const Snapshot after = at(Encounter::end);
    expectParted(after, pair.radii[0] + pair.radii[1]);
    const double unit = pair.reducedMass() * Encounter::speed;
    const Tolerance rounding = {byPrecision(1e-12, 1e-5, "").relative * unit, 0.0,
                                "both disks get the same impulse"};
    EXPECT_TRUE(close(momentum(scene, after), momentum(scene, before), rounding));
    EXPECT_LT(kineticEnergy(scene, after), kineticEnergy(scene, before));
    const double en = (after.velocity[0] - after.velocity[1]).x() / Encounter::speed;
    EXPECT_TRUE(close(en, restitutionOf(scene.law, pair.reducedMass()), restitution));
    // Nothing slides, so nothing turns.
    const Tolerance turn = {byPrecision(1e-12, 1e-5, "").absolute * Encounter::speed / smallRadius,
                            0.0, "head on, without spin"};
    for (const double spin : spinsOf(scene, after)) EXPECT_TRUE(close(spin, 0.0, turn));
  }
}

Scene throwAt(const WallBody& wall, const ContactLaw& law) {
  Scene scene = emptyScene(law, fine);
  scene.bodies = {wall};
  const double height = Encounter::gap + (wall.planes.empty() ? 2.0 : 1.0) * smallRadius;
  addDisk(scene, smallRadius, smallMass, {0.001, height}, {0.0, -Encounter::speed});
  return scene;
}

TEST_P(Conformance, WallDiskDoesNotYield) {
  const Scene scene = throwAt(wallOf("post", {0.001, 0.0}, {{0.001, 0.0}}), law());
  if (const auto why = refused(scene)) GTEST_SKIP() << *why;
  const Snapshot after = at(Encounter::end);
  EXPECT_TRUE(close(after.velocity[0],
                    Vec2(0.0, restitutionOf(scene.law, smallMass) * Encounter::speed),
                    restitution));
  EXPECT_EQ(after.wallPosition[0], Vec2(0.001, 0.0));
}

TEST_P(Conformance, PlaneDoesNotYield) {
  const Scene scene = throwAt(planeWall({0.5, 0.0}, {0.0, 1.0}), law());
  if (const auto why = refused(scene)) GTEST_SKIP() << *why;
  const Snapshot after = at(Encounter::end);
  EXPECT_TRUE(close(after.velocity[0],
                    Vec2(0.0, restitutionOf(scene.law, smallMass) * Encounter::speed),
                    restitution));
}

TEST_P(Conformance, EnergyIsNotGained) {
  for (const double obliqueness : {-1.2, -0.6, 0.6, 1.2})
    for (const double spin : {-40.0, 0.0, 40.0}) {
      Encounter pair = crookedEncounter();
      pair.obliqueness = obliqueness;
      pair.spins[0] = spin;
      const Scene scene = encounterScene(pair, law(), coarse);
      if (const auto why = refused(scene)) GTEST_SKIP() << *why;
      const double before = kineticEnergy(scene, at(0.0));
      EXPECT_LE(kineticEnergy(scene, at(2.0 * Encounter::end)), before)
          << "obliqueness " << obliqueness << ", spin " << spin;
    }
}

/// Two small disks head on with equal spins: v_t = Ψ_i v_n.
Scene spinningPair(const ContactLaw& law, double psi) {
  Encounter pair;
  pair.spins[0] = pair.spins[1] = -psi * Encounter::speed / (2.0 * smallRadius);
  return encounterScene(pair, law, fine);
}

/// The oracle's outcome; none for conventions that have no limit of small steps.
std::optional<CollisionEnd> oracle(const ContactLaw& law, const CollisionStart& start) {
  try {
    return oracleOutcome(law, smallPair(), start);
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

/// Each tangential law that the engine has, one sticking and one sliding collision.
TEST_P(Conformance, FrictionFollowsTheOracle) {
  std::vector<ContactLaw> laws;
  if (const auto options = can_.lawOptions.find("tangential"); options != can_.lawOptions.end())
    for (const std::string& tangential : options->second) {
      laws.push_back(law());
      setLawOption(laws.back(), "tangential", tangential);
    }
  else
    laws.push_back(law());
  // Friction is first order where it starts to slip; a rigid engine acts half a step's overlap
  // inside the radius, 0.7 % of Ψ_f.
  const Tolerance scheme = {0.03, 0.01, "slip begins within a step"};
  int compared = 0;
  for (const ContactLaw& each : laws)
    for (const double psi : {0.5, 3.0}) {
      const CollisionStart start{psi, Encounter::speed};
      const auto expected = oracle(each, start);
      if (!expected) continue;
      const Scene scene = spinningPair(each, psi);
      if (const auto why = refused(scene)) GTEST_SKIP() << *why;
      const auto end = collisionEnd(scene, at(Encounter::end), 0, start);
      ASSERT_TRUE(end);
      const std::string what = lawOptionValue(each, "tangential");
      EXPECT_TRUE(close(end->psi, expected->psi, scheme)) << what << ", psi_i = " << psi;
      EXPECT_TRUE(close(end->en, expected->en, restitution)) << what << ", psi_i = " << psi;
      ++compared;
    }
  EXPECT_GT(compared, 0) << "the oracle knows none of its laws";
}

TEST_P(Conformance, FrictionlessDisksKeepTheirSpins) {
  const Scene scene = encounterScene(crookedEncounter(), frictionless(law()), coarse);
  if (const auto why = refused(scene)) GTEST_SKIP() << *why;
  const Snapshot after = at(Encounter::end);
  EXPECT_GT((after.velocity[0] - scene.disks.velocity[0]).norm(), 0.1 * Encounter::speed);
  const Tolerance rounding = byPrecision(0.0, 1e-7, "the given spins, rounded once");
  for (const int i : {0, 1})
    EXPECT_TRUE(close(spinsOf(scene, after)[i], scene.disks.spin[i], rounding));
}

/// A disk that is thrown to and fro between two posts, with friction that loads the springs.
Scene toAndFro(const ContactLaw& law) {
  Scene scene = emptyScene(law, coarse);
  const double post = 2.0 * smallRadius + Encounter::gap;
  scene.bodies = {wallOf("posts", Vec2::Zero(), {{-post, 0.0}, {post, 0.0}})};
  addDisk(scene, smallRadius, smallMass, {0.0, 0.0004}, {-Encounter::speed, 0.0}, 20.0);
  return scene;
}

/// Steps after which the number of contacts changes from or to none.
std::vector<std::size_t> changes(const std::vector<Snapshot>& seen) {
  const auto touches = [](const Snapshot& now) { return now.contacts && now.contacts->size() > 0; };
  std::vector<std::size_t> steps;
  for (std::size_t k = 1; k < seen.size(); ++k)
    if (touches(seen[k]) != touches(seen[k - 1])) steps.push_back(k);
  return steps;
}

/// A contact that has ended leaves nothing behind: a run that starts from a moment of free flight
/// goes on as the run did that it was taken from.
TEST_P(Conformance, FreeFlightRemembersNothing) {
  if (contactReport() == ContactReport::none) GTEST_SKIP() << "shows no contacts";
  // Without dashpots the spring is longest when they part, and felt at once when they meet.
  ContactLaw undamped = fullLaw();
  undamped.tangential = TangentialLaw::spring;
  undamped.gn = 0.0;
  undamped.en = 1.0;
  Scene scene = toAndFro(followed(can_, undamped));
  if (const auto why = refused(scene)) GTEST_SKIP() << *why;
  const std::vector<Snapshot> seen = watch(3.0 * Encounter::end);
  const std::vector<std::size_t> touch = changes(seen);
  ASSERT_GE(touch.size(), 5u) << "it is to touch one post, the other, and the first again";
  const std::size_t between = (touch[3] + touch[4]) / 2;
  scene.disks.position = seen[between].position;
  scene.disks.velocity = seen[between].velocity;
  scene.disks.spin = spinsOf(scene, seen[between]);
  ASSERT_FALSE(refused(scene));
  const Snapshot resumed = at(static_cast<double>(seen.size() - 1 - between) * realised_.dt);
  const Tolerance rounding = byPrecision(1e-9, 1e-3, "roundings, magnified by two bounces");
  const Snapshot& last = seen.back();
  EXPECT_TRUE(close(resumed.velocity[0], last.velocity[0],
                    {rounding.absolute * Encounter::speed, 0.0, rounding.why}));
  EXPECT_TRUE(close(spinsOf(scene, resumed)[0], spinsOf(scene, last)[0],
                    {rounding.absolute * Encounter::speed / smallRadius, 0.0, rounding.why}));
}

/// With the arms to the contact point both torques and the moment of the force couple add up to
/// nothing. With the radii as arms dL/dt = −δ f_t (Lätzel 2003, chapter 4), which the contacts that
/// the engine shows must account for.
TEST_P(Conformance, AngularMomentumIsKept) {
  // Whatever arm v_t takes: it is no part of the balance.
  std::vector<ContactLaw> laws = {law()};
  for (const char* option : {"lever_arm", "velocity_arm"}) {
    const auto arms = can_.lawOptions.find(option);
    if (arms == can_.lawOptions.end() || rigid()) continue;
    std::vector<ContactLaw> more;
    for (const std::string& arm : arms->second)
      for (const ContactLaw& each : laws) {
        more.push_back(each);
        setLawOption(more.back(), option, arm);
      }
    laws = std::move(more);
  }
  for (const ContactLaw& each : laws) {
    const Scene scene = encounterScene(crookedEncounter(), each, coarse);
    if (const auto why = refused(scene)) GTEST_SKIP() << *why;
    const std::vector<Snapshot> seen = watch(Encounter::end);
    double expected = angularMomentum(scene, seen.front());
    if (!rigid() && each.conventions.leverArm == LeverArm::radius)
      for (const Snapshot& now : seen)
        for (std::size_t c = 0; now.contacts && c < now.contacts->size(); ++c)
          expected -= now.contacts->overlap[c] * now.contacts->tangentialForce[c] * realised_.dt;
    const double unit = scene.disks.mass[0] * Encounter::speed * smallRadius;
    const Tolerance sum = {byPrecision(1e-11, 1e-5, "").absolute * unit, 0.0,
                           "roundings of the additions"};
    const Tolerance moved = {Encounter::speed * realised_.dt / smallRadius * unit, 0.0,
                             "a rigid engine moves disks apart that overlap after a step"};
    EXPECT_TRUE(close(angularMomentum(scene, seen.back()), expected, rigid() ? moved : sum))
        << "lever_arm = " << lawOptionValue(each, "lever_arm")
        << ", velocity_arm = " << lawOptionValue(each, "velocity_arm");
  }
}

}  // namespace
}  // namespace crossgrain::test
