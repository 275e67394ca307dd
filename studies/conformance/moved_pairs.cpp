#include "studies/conformance/moved_pairs.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "law/law_options.hpp"
#include "oracle/calibration.hpp"
#include "oracle/collision_end.hpp"
#include "studies/conformance/check_context.hpp"
#include "studies/conformance/conformance_scenes.hpp"

namespace crossgrain::conformance {
namespace {

constexpr double heavyMass = 1e12;              ///< [kg]: 100 N move it by 5e-17 m in a millisecond
constexpr double large = 0.006, small = 0.004;  ///< radii [m]

/// No axis of a scene is special: this turns all of them elsewhere.
Eigen::Matrix3d anyFrame() {
  return Eigen::AngleAxisd(1.1, Vec3(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
}

MovedPair turned(MovedPair pair) {
  const Eigen::Matrix3d frame = anyFrame();
  for (const int side : {0, 1})
    for (Vec3* vector : {&pair.position[side], &pair.velocity[side], &pair.spin[side]})
      *vector = frame * *vector;
  return pair;
}

Vec3 turnedSpring(SpringTurn how, const Vec3& spring, const Vec3& before, const Vec3& now) {
  if (how == SpringTurn::rotated) return turnedAlong(before, now, spring);
  if (how == SpringTurn::firstOrder) return spring + before.cross(now).cross(spring);
  const Vec3 projected = spring - spring.dot(now) * now;
  if (how == SpringTurn::projected || projected.isZero(0.0)) return projected;
  return spring.norm() / projected.norm() * projected;
}

CollidingPair radiiOf(const MovedPair& pair) {
  return {{pair.radii[0], pair.radii[1]}, {}, {}};
}

/// The arm of v_t of one of the pair [m].
double armOf(const ContactLaw& law, const MovedPair& pair, int side, double overlap) {
  const LawConventions& how = law.conventions;
  return pair.radii[side] -
         overlap * leverFraction(how.armOfVelocity(), how.planeArm, radiiOf(pair), side);
}

/// A spring of the step before as it is in the one with normal n.
Vec3 turnedWithPair(const Vec3& spring, const MovedPair& pair, const SpringMotion& motion,
                    double dt, const Vec3& before, const Vec3& n) {
  const LawConventions& how = motion.law.conventions;
  if (motion.staysInSpace) return spring;
  Vec3 now = turnedSpring(how.springTurn, spring, before, n);
  if (how.springTwist != SpringTwist::meanSpin) return now;
  // Turned and twisted at once in first order, one after the other else.
  const bool toFirstOrder = how.springTurn == SpringTurn::firstOrder;
  const Vec3& about = toFirstOrder ? before : n;
  const double angle = motion.twistBy * 0.5 * dt * about.dot(pair.spin[0] + pair.spin[1]);
  if (toFirstOrder) return now + angle * about.cross(now);
  return Eigen::AngleAxisd(angle, about) * now;
}

/// Those that springs of moved pairs depend on.
constexpr const char* movedOptions[] = {"spring_turn", "spring_twist", "velocity_arm",
                                        "spring_update"};

}  // namespace

MovedPair passingPair() {
  constexpr double reach = large + small, nearest = 0.92 * reach, end = 0.99 * reach;
  const double half = std::sqrt(end * end - nearest * nearest);
  const Vec3 along = Vec3::UnitY(), across = Vec3::UnitZ();
  MovedPair pair{"a sphere that passes another", {large, small}, {}, {}, {}};
  pair.position[0] = nearest * Vec3::UnitX() - half * along;
  pair.position[1] = Vec3::Zero();
  pair.velocity[0] = 1.5 * half / movedTime * along;
  pair.velocity[1] = -0.5 * half / movedTime * along;
  pair.spin[0] = 800.0 * along + 500.0 * across;
  pair.spin[1] = -800.0 * along + 700.0 * across;
  return turned(pair);
}

MovedPair twistingPair() {
  MovedPair pair{"a pair that turns about its n", {large, small}, {}, {}, {}};
  pair.position[0] = 0.97 * (large + small) * Vec3::UnitX();
  for (Vec3& place : pair.velocity) place.setZero();
  pair.position[1].setZero();
  for (const int side : {0, 1})
    pair.spin[side] = (side == 0 ? 1.5 : 0.5) / movedTime * Vec3::UnitX() + 100.0 * Vec3::UnitZ();
  return turned(pair);
}

MovedPair rollingPair() {
  MovedPair pair = twistingPair();
  pair.name = "a pair that rolls while it turns about its n";
  const Vec3 across = pair.apart(0.0).unitOrthogonal();
  for (const int side : {0, 1}) pair.spin[side] += (side == 0 ? 300.0 : -300.0) * across;
  return pair;
}

ContactLaw rollingLaw(ContactLaw law) {
  law.rolling = RollingLaw::spring;
  law.kr = law.kt;
  if (law.conventions.rollingStiffness == RollingStiffness::constant)
    law.kr *= large * small;  // [N m]
  law.muR = law.mu;
  return law;
}

ContactLaw movedLaw() {
  ContactLaw law;
  law.dimension = 3;
  law.tangential = TangentialLaw::spring;
  law.kn = 1e5;
  law.kt = 2e5 / 7.0;
  law.mu = 100.0;
  law.conventions.leverArm = LeverArm::overlapMiddle;
  return law;
}

ContactLaw rollingLawOf(const Capabilities& can, int dimension) {
  ContactLaw law = movedLaw();
  law.dimension = dimension;
  if (std::ranges::count(rollingLaws(can), RollingLaw::spring) == 0) return followed(can, law);
  law.rolling = RollingLaw::spring;
  return rollingLaw(followed(can, law));
}

SpaceScene movedScene(const MovedPair& pair, const ContactLaw& law) {
  SpaceScene scene;
  scene.name = pair.name;
  scene.law = law;
  scene.dt = movedTime / movedSteps;
  for (const int side : {0, 1})
    addRound<3>(scene, pair.radii[side], heavyMass, 0.4, pair.position[side], pair.velocity[side],
                pair.spin[side]);
  return scene;
}

std::vector<Vec3> springForces(const MovedPair& pair, const SpringMotion& motion, double dt,
                               int steps) {
  const double part = stretchedShare(motion.law.conventions.springUpdate);
  std::vector<Vec3> forces;
  Vec3 spring = Vec3::Zero(), before = Vec3::Zero();
  for (int k = 0; k <= steps; ++k) {
    const Vec3 apart = pair.apart(k * dt), n = apart.normalized();
    if (k > 0) spring = turnedWithPair(spring, pair, motion, dt, before, n);
    const double overlap = pair.reach() - apart.norm();
    const Vec3 rims = armOf(motion.law, pair, 0, overlap) * pair.spin[0] +
                      armOf(motion.law, pair, 1, overlap) * pair.spin[1];
    const Vec3 relative = pair.velocity[0] - pair.velocity[1];
    const Vec3 slip = relative - relative.dot(n) * n - motion.spinsOfSlip * rims.cross(n);
    spring += part * dt * slip;
    forces.emplace_back(-motion.law.kt * (spring - spring.dot(n) * n));
    spring += (1.0 - part) * dt * slip;
    before = n;
  }
  return forces;
}

std::vector<Vec3> rollingTorques(const MovedPair& pair, const SpringMotion& motion, double dt,
                                 int steps) {
  const double part = stretchedShare(motion.law.conventions.springUpdate);
  const double stiffness = motion.law.kr * rollingSquare(motion.law, radiiOf(pair));
  const Vec3 spin = pair.spin[0] - pair.spin[1];
  std::vector<Vec3> torques;
  Vec3 spring = Vec3::Zero(), before = Vec3::Zero();
  for (int k = 0; k <= steps; ++k) {
    const Vec3 n = pair.apart(k * dt).normalized();
    if (k > 0) spring = turnedWithPair(spring, pair, motion, dt, before, n);
    Vec3 rolled = spin - spin.dot(n) * n;
    if (motion.asDisplacement) rolled = rolled.cross(n);
    spring += part * dt * rolled;
    const Vec3 turn = motion.asDisplacement ? n.cross(spring) : Vec3(spring - spring.dot(n) * n);
    torques.emplace_back(-stiffness * turn);
    spring += (1.0 - part) * dt * rolled;
    before = n;
  }
  return torques;
}

std::string SpringMotion::differenceFrom(const ContactLaw& declared) const {
  std::string words;
  const auto add = [&](const std::string& what) { words += (words.empty() ? "" : "; ") + what; };
  if (staysInSpace)
    add("its spring does not follow n as that turns: nothing takes out its part along n");
  if (twistBy < 0.0)
    add("its spring turns about n against its pair");
  else if (twistBy != 1.0)
    add(fmt::format("its spring turns about n by {:g} times the mean spin of its pair", twistBy));
  if (spinsOfSlip != 1.0) add(fmt::format("spins are in v_t {:g} times", spinsOfSlip));
  for (const char* const option : movedOptions) {
    const std::string value(lawOptionValue(law, option)), other(lawOptionValue(declared, option));
    if (value != other) add(fmt::format("it has {} = {}, and declares {}", option, value, other));
  }
  return words;
}

std::vector<SpringMotion> springMotions(const ContactLaw& declared) {
  std::vector<SpringMotion> all;
  std::vector<ContactLaw> laws = {declared};
  for (const char* const name : movedOptions) {
    const auto option = std::ranges::find(lawOptions(), name, &LawOption::name);
    const std::vector<ContactLaw> shorter = laws;
    for (const ContactLaw& law : shorter)
      for (const std::string_view value : option->values) {
        ContactLaw changed = law;
        setLawOption(changed, name, std::string(value));
        // The arm of f_t by another name is no other arm.
        const bool same = std::string_view(name) == "velocity_arm" &&
                          changed.conventions.armOfVelocity() == law.conventions.armOfVelocity();
        if (!(changed == law) && !same) laws.push_back(changed);
      }
  }
  for (const ContactLaw& law : laws) {
    all.push_back({law});
    all.push_back({law, true});
    for (const double twist : {-1.0, 2.0}) all.push_back({law, false, twist});
    for (const double spins : {-1.0, 0.0}) all.push_back({law, false, 1.0, spins});
  }
  const auto differences = [&](const SpringMotion& one) {
    const std::string words = one.differenceFrom(declared);
    return words.empty() ? 0 : 1 + std::ranges::count(words, ';');
  };
  std::ranges::stable_sort(all, {}, differences);
  return all;
}

std::vector<std::string> frameDependence(const ContactLaw& law) {
  const LawConventions& how = law.conventions;
  const SpringMotion own{law};
  SpringMotion other = own;
  const double dt = movedTime / movedSteps;
  const auto change = [&](const MovedPair& pair) {
    const std::vector<Vec3> is = springForces(pair, own, dt, movedSteps),
                            was = springForces(pair, other, dt, movedSteps);
    return (is.back() - was.back()).norm() / was.back().norm();
  };
  std::vector<std::string> words;
  if (how.armOfVelocity() == LeverArm::radius) {
    other.law.conventions.velocityArm = VelocityArm::overlapMiddle;
    words.push_back(
        fmt::format("velocity_arm = radius, as declared: arms that together are δ longer than the "
                    "distance let a "
                    "pair that turns rigidly by Θ stretch its spring by δ Θ, k_t δ Θ of F_t (here "
                    "{:.2g} of it)",
                    change(passingPair())));
    other = own;
  }
  other.law.conventions.springTurn = SpringTurn::rotated;
  if (how.springTurn == SpringTurn::firstOrder || how.springTurn == SpringTurn::projected)
    words.push_back(fmt::format(
        "spring_turn = {}, as declared: in steps of ΔΘ a turn by Θ makes |F_t| in its plane "
        "exp({}½ Θ ΔΘ) times what it was (here {:.2g} of F_t)",
        lawOptionValue(law, "spring_turn"), how.springTurn == SpringTurn::firstOrder ? "" : "−",
        change(passingPair())));
  other = own;
  other.law.conventions.springTwist = SpringTwist::meanSpin;
  if (how.springTwist == SpringTwist::none)
    words.push_back(fmt::format(
        "spring_twist = none, as declared: where a pair turns about n F_t stays where it was (here "
        "{:.2g} of F_t after 1 rad)",
        change(twistingPair())));
  return words;
}

}  // namespace crossgrain::conformance
