// Two bodies meet once. What comes out is held against conservation laws and the oracles.
#include <array>
#include <cmath>

#include "adapters/law_options.hpp"
#include "runs/conformance/check_list.hpp"
#include "runs/conformance/exam.hpp"

namespace crossgrain::conformance::collision {
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

void expectParted(Exam& it, const Snapshot& now, double reach) {
  const Vec2 apart = now.position[0] - now.position[1];
  it.above(apart.norm(), reach, "their distance in the end");
  it.above((now.velocity[0] - now.velocity[1]).dot(apart), 0.0, "the speed at which they part");
}

const Tolerance restitution = {0.0, 0.02, "a first-order scheme at t_c/400"};

void headOnCollision(Exam& it) {
  Encounter unequal;  // masses 1 : 10 of one material
  unequal.radii[1] = std::sqrt(10.0) * smallRadius;
  unequal.masses[1] = 10.0 * smallMass;
  unequal.drift = {0.013, -0.021};
  for (const Encounter& pair : {Encounter{}, unequal}) {
    const Scene scene = encounterScene(pair, it.law(), fine);
    it.load(scene);
    it.examined(toString(Effect::normalDamping));
    const Snapshot before = it.at(0.0);
    const Snapshot after = it.at(Encounter::end);
    expectParted(it, after, pair.radii[0] + pair.radii[1]);
    const double unit = pair.reducedMass() * Encounter::speed;
    const Tolerance rounding = {it.byPrecision(1e-12, 1e-5, "").relative * unit, 0.0,
                                "both disks get the same impulse"};
    it.expect(close(momentum(scene, after), momentum(scene, before), rounding),
              "momentum [kg m/s]");
    it.below(kineticEnergy(scene, after), kineticEnergy(scene, before),
             "kinetic energy after a collision");
    const double en = (after.velocity[0] - after.velocity[1]).x() / Encounter::speed;
    it.expect(close(en, restitutionOf(scene.law, pair.reducedMass()), restitution), "e_n");
    // Nothing slides, so nothing turns.
    const Tolerance turn = {
        it.byPrecision(1e-12, 1e-5, "").absolute * Encounter::speed / smallRadius, 0.0,
        "head on, without spin"};
    for (const double spin : spinsOf(scene, after))
      it.expect(close(spin, 0.0, turn), "a spin after it [rad/s]");
  }
}

Scene throwAt(const WallBody& wall, const ContactLaw& law) {
  Scene scene = emptyScene(law, fine);
  scene.bodies = {wall};
  const double height = Encounter::gap + (wall.planes.empty() ? 2.0 : 1.0) * smallRadius;
  addDisk(scene, smallRadius, smallMass, {0.001, height}, {0.0, -Encounter::speed});
  return scene;
}

void wallDiskDoesNotYield(Exam& it) {
  const Scene scene = throwAt(wallOf("post", {0.001, 0.0}, {{0.001, 0.0}}), it.law());
  it.load(scene);
  const Snapshot after = it.at(Encounter::end);
  it.expect(close(after.velocity[0],
                  Vec2(0.0, restitutionOf(scene.law, smallMass) * Encounter::speed), restitution),
            "the velocity after it [m/s]");
  const Tolerance place = {it.byPrecision(1e-12, 1e-5, "").absolute * smallRadius, 0.0,
                           "rounding, of an engine that has coordinates of its own"};
  it.expect(close(after.wallPosition[0], Vec2(0.001, 0.0), place), "the wall disk's place [m]");
}

void planeDoesNotYield(Exam& it) {
  const Scene scene = throwAt(planeWall({0.5, 0.0}, {0.0, 1.0}), it.law());
  it.load(scene);
  const Snapshot after = it.at(Encounter::end);
  it.expect(close(after.velocity[0],
                  Vec2(0.0, restitutionOf(scene.law, smallMass) * Encounter::speed), restitution),
            "the velocity after it [m/s]");
}

void slantingPlaneDoesNotYield(Exam& it) {
  const Vec2 normal(0.6, 0.8);
  Scene scene = emptyScene(it.law(), fine);
  scene.bodies = {planeWall({0.3, -0.4}, normal)};  // 0.14 m below the origin
  const Vec2 foot = Vec2(0.3, -0.4) + 0.2 * Vec2(-0.8, 0.6);
  addDisk(scene, smallRadius, smallMass, foot + (smallRadius + Encounter::gap) * normal,
          -Encounter::speed * normal);
  it.loadWithinLimits(scene);
  it.examined(slantingPlanes);
  const Snapshot after = it.at(Encounter::end);
  it.expect(close(after.velocity[0],
                  restitutionOf(scene.law, smallMass) * Encounter::speed * normal, restitution),
            "the velocity after it [m/s]");
}

void energyIsNotGained(Exam& it) {
  for (const double obliqueness : {-1.2, -0.6, 0.6, 1.2})
    for (const double spin : {-40.0, 0.0, 40.0}) {
      Encounter pair = crookedEncounter();
      pair.obliqueness = obliqueness;
      pair.spins[0] = spin;
      const Scene scene = encounterScene(pair, it.law(), coarse);
      it.load(scene);
      const double before = kineticEnergy(scene, it.at(0.0));
      it.atMost(kineticEnergy(scene, it.at(2.0 * Encounter::end)), before,
                said("kinetic energy at obliqueness ", obliqueness, ", spin ", spin));
    }
}

void frictionlessDisksKeepTheirSpins(Exam& it) {
  const Scene scene = encounterScene(crookedEncounter(), frictionless(it.law()), coarse);
  it.load(scene);
  const Snapshot after = it.at(Encounter::end);
  it.above((after.velocity[0] - scene.disks.velocity[0]).norm(), 0.1 * Encounter::speed,
           "the change of velocity by a collision");
  const Tolerance rounding = it.byPrecision(0.0, 1e-7, "the given spins, rounded once");
  for (const int i : {0, 1})
    it.expect(close(spinsOf(scene, after)[i], scene.disks.spin[i], rounding),
              "a spin after it [rad/s]");
}

/// What a disk is thrown to and fro between.
enum class Between { posts, planes, disks };

/// A disk that is thrown to and fro, with friction that loads the springs. Disks that it is thrown
/// between are a million times as heavy.
Scene toAndFro(const ContactLaw& law, Between what) {
  Scene scene = emptyScene(law, coarse);
  const double post = 2.0 * smallRadius + Encounter::gap;
  const double plane = smallRadius + Encounter::gap;
  addDisk(scene, smallRadius, smallMass, {0.0, 0.0004}, {-Encounter::speed, 0.0}, 20.0);
  switch (what) {
    case Between::posts:
      scene.bodies = {wallOf("posts", Vec2::Zero(), {{-post, 0.0}, {post, 0.0}})};
      break;
    case Between::planes:
      scene.bodies = {planeWall({-plane, 0.0}, Vec2::UnitX())};
      scene.bodies[0].planes.push_back({{plane, 0.0}, -Vec2::UnitX()});
      break;
    case Between::disks:
      for (const double side : {-post, post})
        addDisk(scene, smallRadius, 1e6 * smallMass, {side, 0.0}, Vec2::Zero());
      break;
  }
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

/// @returns why the engine cannot be asked
std::optional<std::string> expectForgotten(Exam& it, Scene scene, const std::string& where) {
  if (auto why = it.refused(scene)) return why;
  const std::vector<Snapshot> seen = it.watch(4.0 * Encounter::end);
  const std::vector<std::size_t> touch = changes(seen);
  it.requireAtLeast(touch.size(), 5u,
                    "it is to touch one " + where + ", the other, and the first again");
  const auto goneOn = [&](std::size_t from, std::size_t to) {
    scene.disks.position = seen[from].position;
    scene.disks.velocity = seen[from].velocity;
    scene.disks.spin = spinsOf(scene, seen[from]);
    it.load(scene);
    return it.at(static_cast<double>(to - from) * it.realised.dt);
  };
  const std::size_t end = touch.size() > 7 ? touch[7] : seen.size() - 1;  // of two bounces more
  const Snapshot resumed = goneOn((touch[3] + touch[4]) / 2, end);
  const Tolerance rounding = it.byPrecision(1e-9, 1e-3, "roundings, magnified by two bounces");
  const auto velocity = [&](const Snapshot& found, const Snapshot& wanted) {
    return close(found.velocity[0], wanted.velocity[0],
                 {rounding.absolute * Encounter::speed, 0.0, rounding.why});
  };
  const auto spin = [&](const Snapshot& found, const Snapshot& wanted) {
    return close(spinsOf(scene, found)[0], spinsOf(scene, wanted)[0],
                 {rounding.absolute * Encounter::speed / smallRadius, 0.0, rounding.why});
  };
  const std::size_t before = it.faults().size();
  it.expect(velocity(resumed, seen[end]), said("between ", where, "s, the velocity [m/s]"));
  it.expect(spin(resumed, seen[end]), said("between ", where, "s, the spin [rad/s]"));
  if (it.faults().size() == before || !it.scene.law.springs() || !it.scene.law.soft())
    return std::nullopt;
  // Where it does not even go on from before the first touch, something else is wrong: what
  // snapshots show, or the step.
  const std::size_t bounced = (touch[1] + touch[2]) / 2;
  const Snapshot first = goneOn(touch[0] / 2, bounced);
  if (velocity(first, seen[bounced]).difference.empty() &&
      spin(first, seen[bounced]).difference.empty())
    it.suspect(said("what a contact remembers (its spring) outlives it, at a ", where,
                    " that is met again"));
  return std::nullopt;
}

/// A contact that has ended leaves nothing behind: a run that starts from a moment of free flight
/// goes on as the run did that it was taken from.
void freeFlightRemembersNothing(Exam& it) {
  if (it.contactReport() == ContactReport::none) it.skip(said("shows no contacts"));
  // Without dashpots the spring is longest when they part, and felt at once when they meet; with
  // them a spring that goes on while nothing touches grows where the dashpot pushes already.
  ContactLaw undamped = fullLaw();
  undamped.tangential = TangentialLaw::spring;
  undamped.gn = 0.0;
  undamped.en = 1.0;
  ContactLaw damped = fullLaw();
  damped.gn *= 0.2;  // the fourth bounce is to have some speed left
  damped.en = 0.95;
  std::string why;
  bool any = false;
  for (const ContactLaw& law : {followed(it.can, undamped), followed(it.can, damped)})
    for (const auto& [what, name] : {std::pair(Between::posts, "wall disk"),
                                     {Between::planes, "plane"},
                                     {Between::disks, "disk"}}) {
      const auto refusal = expectForgotten(it, toAndFro(law, what), name);
      any = any || !refusal;
      if (refusal) why = *refusal;
    }
  if (!any) it.skip(why);
}

/// With the arms to the contact point both torques and the moment of the force couple add up to
/// nothing. With the radii as arms dL/dt = −δ f_t (Lätzel 2003, chapter 4), which the contacts that
/// the engine shows must account for.
void angularMomentumIsKept(Exam& it) {
  // Whatever arm v_t takes: it is no part of the balance.
  std::vector<ContactLaw> laws = {it.law()};
  for (const char* option : {"lever_arm", "velocity_arm"}) {
    const auto arms = it.can.lawOptions.find(option);
    if (arms == it.can.lawOptions.end() || it.rigid()) continue;
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
    it.load(scene);
    const std::vector<Snapshot> seen = it.watch(Encounter::end);
    double expected = angularMomentum(scene, seen.front());
    if (!it.rigid() && each.conventions.leverArm == LeverArm::radius)
      for (const Snapshot& now : seen)
        for (std::size_t c = 0; now.contacts && c < now.contacts->size(); ++c)
          expected -= now.contacts->overlap[c] * now.contacts->tangentialForce[c] * it.realised.dt;
    const double unit = scene.disks.mass[0] * Encounter::speed * smallRadius;
    const Tolerance sum = {it.byPrecision(1e-11, 1e-5, "").absolute * unit, 0.0,
                           "roundings of the additions"};
    const Tolerance moved = {Encounter::speed * it.realised.dt / smallRadius * unit, 0.0,
                             "a rigid engine moves disks apart that overlap after a step"};
    it.expect(close(angularMomentum(scene, seen.back()), expected, it.rigid() ? moved : sum),
              said("lever_arm = ", lawOptionValue(each, "lever_arm"),
                   ", velocity_arm = ", lawOptionValue(each, "velocity_arm")));
  }
}

}  // namespace
std::span<const Check> checks() {
  static constexpr std::array list = {
      Check{"HeadOnCollision", "two disks head on: momentum, energy, restitution", headOnCollision},
      Check{"WallDiskDoesNotYield", "a wall disk does not yield", wallDiskDoesNotYield},
      Check{"PlaneDoesNotYield", "a plane does not yield", planeDoesNotYield},
      Check{"SlantingPlaneDoesNotYield", "nor does one along no axis", slantingPlaneDoesNotYield},
      Check{"EnergyIsNotGained", "no collision gains energy", energyIsNotGained},
      Check{"FrictionlessDisksKeepTheirSpins", "without friction spins stay",
            frictionlessDisksKeepTheirSpins},
      Check{"FreeFlightRemembersNothing", "a contact that ended leaves nothing behind",
            freeFlightRemembersNothing},
      Check{"AngularMomentumIsKept", "angular momentum is kept, or changes as the arms say",
            angularMomentumIsKept},
  };
  return list;
}

}  // namespace crossgrain::conformance::collision
