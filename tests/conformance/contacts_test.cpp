// What an engine says of its contacts, and whether those forces are the ones that it applied.
#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "tests/conformance/conformance.hpp"

namespace crossgrain::test {
namespace {

constexpr double steps = 50.0;  // in one contact

/// Where everything was at the time of a snapshot's contacts.
struct Place {
  std::vector<Vec2> centre;  ///< disks, wall disks
  std::vector<double> radii;
};

/// The looks at a run, step by step, and where things were when.
class Film {
 public:
  Film(const Scene& scene, const std::vector<Snapshot>& seen) : scene_(scene), seen_(seen) {}

  Place at(double t) const {
    const auto nearest = std::ranges::min_element(
        seen_, {}, [t](const Snapshot& s) { return std::abs(s.positionTime - t); });
    Place place{nearest->position, scene_.disks.radius};
    for (const Vec2& x : nearest->wallPosition) place.centre.push_back(x);
    for (const WallBody& body : scene_.bodies)
      for (const double a : body.diskRadius) place.radii.push_back(a);
    return place;
  }

  /// The only plane of the scenes here.
  const Plane& plane() const {
    for (const WallBody& body : scene_.bodies)
      if (!body.planes.empty()) return body.planes[0];
    throw std::logic_error("the scene has no plane");
  }

 private:
  const Scene& scene_;
  const std::vector<Snapshot>& seen_;
};

Vec2 forceOn(const Contacts& contacts, std::size_t c) {
  return contacts.normalForce[c] * contacts.normal[c] +
         contacts.tangentialForce[c] * perpendicular(contacts.normal[c]);
}

/// Sum of the contact forces on one disk or wall disk.
Vec2 forceOn(const Snapshot& now, std::int32_t id) {
  Vec2 sum = Vec2::Zero();
  for (std::size_t c = 0; now.contacts && c < now.contacts->size(); ++c) {
    if (now.contacts->i[c] == id) sum += forceOn(*now.contacts, c);
    if (now.contacts->j[c] == id) sum -= forceOn(*now.contacts, c);
  }
  return sum;
}

/// The arm of f_t about the centre of a disk of radius a that overlaps one of radius b by δ.
double arm(const ContactLaw& law, double a, double b, double overlap) {
  return law.conventions.leverArm == LeverArm::radius ? a : a - overlap * b / (a + b);
}

/// Two disks that hit a wall disk, a plane and each other.
Scene allKindsOfContact(const ContactLaw& law, bool withPlane) {
  Scene scene = emptyScene(law, steps);
  addDisk(scene, smallRadius, smallMass, {0.0, 0.0}, {0.03, 0.0}, 8.0);
  addDisk(scene, largeRadius, largeMass, {0.0083, 0.0005}, {-0.08, 0.01}, -3.0);
  scene.bodies = {wallOf("post", {-0.0076, 0.001}, {{-0.0076, 0.001}, {-0.02, 0.0}})};
  if (withPlane) {
    scene.bodies.push_back(planeWall({0.0, -0.0045}, {0.0, 1.0}));
    scene.disks.velocity[1].y() = -0.06;
  }
  return scene;
}

/// i < j, n from j to i at the contact's own time, δ = a_i + a_j − distance.
void expectGeometry(const Contacts& contacts, const Place& place, const Film& film, bool soft,
                    const Tolerance& length) {
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const auto i = static_cast<std::size_t>(contacts.i[c]);
    const auto j = static_cast<std::size_t>(contacts.j[c]);
    ASSERT_LT(i, j);
    Vec2 normal;
    double overlap;
    if (j < place.centre.size()) {
      const Vec2 apart = place.centre[i] - place.centre[j];
      normal = apart.normalized();
      overlap = place.radii[i] + place.radii[j] - apart.norm();
    } else {
      normal = film.plane().normal;
      overlap = place.radii[i] - (place.centre[i] - film.plane().point).dot(normal);
    }
    const Tolerance direction = {length.absolute / smallRadius, 0.0, length.why};
    EXPECT_TRUE(close(contacts.normal[c], normal, direction)) << i << ", " << j;
    EXPECT_TRUE(close(contacts.overlap[c], overlap, length)) << i << ", " << j;
    if (soft) {
      EXPECT_GT(contacts.overlap[c], 0.0) << "soft disks that do not touch feel nothing";
    }
  }
}

TEST_P(Conformance, ContactsSayWhereTheyAre) {
  if (contactReport() == ContactReport::none) GTEST_SKIP() << "shows no contacts";
  const Scene scene = allKindsOfContact(law(), false);
  if (const auto why = refused(scene)) GTEST_SKIP() << *why;
  const std::vector<Snapshot> seen = watch(2.0 * Encounter::end);
  const Film film(scene, seen);
  const Tolerance length = {byPrecision(1e-12, 1e-6, "").absolute * smallRadius, 0.0, "roundings"};
  bool pair = false, wall = false;
  for (const Snapshot& now : seen) {
    if (!now.contacts) continue;
    expectGeometry(*now.contacts, film.at(now.contactTime), film, !rigid(), length);
    for (const std::int32_t j : now.contacts->j) (j < 2 ? pair : wall) = true;
  }
  EXPECT_TRUE(pair && wall);
}

TEST_P(Conformance, ContactsWithPlanesSayWhereTheyAre) {
  if (contactReport() == ContactReport::none) GTEST_SKIP() << "shows no contacts";
  const Scene scene = allKindsOfContact(law(), true);
  if (const auto why = refused(scene)) GTEST_SKIP() << *why;
  const std::vector<Snapshot> seen = watch(2.0 * Encounter::end);
  const Film film(scene, seen);
  const Tolerance length = {byPrecision(1e-12, 1e-6, "").absolute * smallRadius, 0.0, "roundings"};
  bool plane = false;
  for (const Snapshot& now : seen) {
    if (!now.contacts) continue;
    expectGeometry(*now.contacts, film.at(now.contactTime), film, !rigid(), length);
    // Two disks and two wall disks: the plane is number 4.
    for (const std::int32_t j : now.contacts->j) plane = plane || j == 4;
  }
  EXPECT_TRUE(plane);
}

/// Ψ_i = ±3 slides throughout: f_n pushes apart, f_t on i is along −v_t.
TEST_P(Conformance, ForcesPointWhereTheySay) {
  if (contactReport() == ContactReport::none) GTEST_SKIP() << "shows no contacts";
  for (const double spin : {-40.0, 40.0}) {
    Encounter pair;
    pair.spins[0] = pair.spins[1] = spin;
    const Scene scene = encounterScene(pair, law(), steps);
    if (const auto why = refused(scene)) GTEST_SKIP() << *why;
    const double slip = -2.0 * smallRadius * spin;
    double pushed = 0.0, dragged = 0.0;
    for (const Snapshot& now : watch(Encounter::end)) {
      if (!now.contacts || now.contacts->size() == 0) continue;
      const double fn = now.contacts->normalForce[0];
      const double ft = now.contacts->tangentialForce[0];
      if (pushed == 0.0) {
        EXPECT_GT(fn, 0.0) << "at first touch";
      }
      if (fn > 0.0) {
        EXPECT_LE(ft * slip, 0.0) << "at t = " << now.contactTime << " s";
      }
      pushed += fn;
      dragged += ft;
    }
    EXPECT_GT(pushed, 0.0);
    EXPECT_LT(dragged * slip, 0.0);
  }
}

TEST_P(Conformance, SlidingFlagsMarkTheBound) {
  if (!can_.slidingFlags) GTEST_SKIP() << "has no sliding flags";
  ContactLaw cut = fullLaw();
  cut.conventions.tension = Tension::cut;  // then every convention's bound is µ f_n
  Encounter pair = crookedEncounter();
  std::vector<double> spins = {pair.spins[0]};
  if (rigid()) spins.push_back(100.0);  // a rigid impact slides or sticks, as a whole
  int sliding = 0, sticking = 0;
  for (const double spin : spins) {
    pair.spins[0] = spin;
    const Scene scene = encounterScene(pair, followed(can_, cut), steps);
    if (const auto why = refused(scene)) GTEST_SKIP() << *why;
    const ContactLaw& law = scene.law;
    const bool held = law.conventions.dashpot == Dashpot::inside;
    for (const Snapshot& now : watch(Encounter::end)) {
      if (!now.contacts || now.contacts->size() == 0) continue;
      ASSERT_EQ(now.contacts->sliding.size(), 1u);
      const double ft = std::abs(now.contacts->tangentialForce[0]);
      const double bound = law.mu * now.contacts->normalForce[0];
      const Tolerance rounding = byPrecision(1e-12, 1e-5, "roundings");
      if (now.contacts->sliding[0]) {
        EXPECT_TRUE(close(ft, bound, {0.0, rounding.relative, rounding.why}));
      } else if (held) {
        EXPECT_LE(ft, bound * (1.0 + rounding.relative));
      }
      ++(now.contacts->sliding[0] ? sliding : sticking);
    }
  }
  EXPECT_GT(sliding, 0);
  EXPECT_GT(sticking, 0);
}

/// Newton's second law: over each step m Δv/Δt lies between the forces that the engine shows before
/// and after it, whichever of the two, or their mean, the scheme uses; over the whole collision the
/// impulses add up, of forces and of torques.
TEST_P(Conformance, ContactForcesAreThoseThatAct) {
  if (contactReport() == ContactReport::none) GTEST_SKIP() << "shows no contacts";
  Encounter pair = crookedEncounter();
  pair.radii[1] = pair.radii[0];  // every engine's contact point is then in the middle
  const Scene scene = encounterScene(pair, law(), steps);
  if (const auto why = refused(scene)) GTEST_SKIP() << *why;
  const std::vector<Snapshot> seen = watch(Encounter::end);
  // A mean over an interval is shown with the normal of its end, which has turned since.
  const double turn = seen.back().contactInterval * Encounter::speed / smallRadius;
  const double relative = byPrecision(1e-12, 1e-5, "").relative + turn;
  double largest = 0.0;
  for (const Snapshot& now : seen) largest = std::max(largest, forceOn(now, 0).norm());
  ASSERT_GT(largest, 0.0);

  for (const std::int32_t id : {0, 1}) {
    Vec2 impulse = Vec2::Zero();
    double angularImpulse = 0.0;
    for (std::size_t k = 1; k < seen.size(); ++k) {
      const Snapshot& was = seen[k - 1];
      const Snapshot& now = seen[k];
      const double lapse = now.velocityTime - was.velocityTime;
      const Vec2 acting = scene.disks.mass[id] / lapse * (now.velocity[id] - was.velocity[id]);
      const Vec2 before = forceOn(was, id), after = forceOn(now, id);
      for (const int axis : {0, 1}) {
        EXPECT_GE(acting[axis], std::min(before[axis], after[axis]) - relative * largest);
        EXPECT_LE(acting[axis], std::max(before[axis], after[axis]) + relative * largest);
      }
      impulse += realised_.dt * after;
      for (std::size_t c = 0; now.contacts && c < now.contacts->size(); ++c)
        angularImpulse -= realised_.dt * now.contacts->tangentialForce[c] *
                          arm(scene.law, smallRadius, smallRadius, now.contacts->overlap[c]);
    }
    const double unit = scene.disks.mass[id] * Encounter::speed;
    const Tolerance sum = {relative * unit, 0.0, "roundings, and a normal that turns"};
    EXPECT_TRUE(close(
        impulse,
        Vec2(scene.disks.mass[id] * (seen.back().velocity[id] - seen.front().velocity[id])), sum));
    const double spun = spinsOf(scene, seen.back())[id] - spinsOf(scene, seen.front())[id];
    EXPECT_TRUE(close(angularImpulse, scene.disks.inertia[id] * spun,
                      {relative * unit * smallRadius, 0.0, sum.why}));
  }
}

/// A wall's force and torque are those of the contacts of its disks.
TEST_P(Conformance, WallLoadsAreThoseOfTheirContacts) {
  if (contactReport() == ContactReport::none) GTEST_SKIP() << "shows no contacts";
  const Vec2 centre(0.01, -0.02);
  std::vector<Vec2> rim;
  for (const double angle : {-0.35, 0.0, 0.35})
    rim.push_back(centre + 0.025 * Vec2(std::cos(angle), std::sin(angle)));
  Scene scene = emptyScene(law(), steps);
  scene.bodies = {wallOf("wheel", centre, rim, rotating(0.5))};
  const Vec2 between(std::cos(0.175), std::sin(0.175));
  addDisk(scene, smallRadius, smallMass, centre + 0.0308 * between, -Encounter::speed * between,
          9.0);
  if (const auto why = refused(scene)) GTEST_SKIP() << *why;

  const std::vector<Snapshot> seen = watch(Encounter::end);
  const Film film(scene, seen);
  const double turn = seen.back().contactInterval * Encounter::speed / smallRadius;
  const double relative = byPrecision(1e-12, 1e-5, "").relative + 2.0 * turn;
  std::set<std::int32_t> touched;
  for (const Snapshot& now : seen) {
    if (!now.contacts) continue;
    touched.insert(now.contacts->j.begin(), now.contacts->j.end());
    if (!now.bodies[0].force || !now.bodies[0].torque) GTEST_SKIP() << "shows no wall loads";
    const Place place = film.at(now.contactTime);
    Vec2 force = Vec2::Zero();
    double torque = 0.0, size = 0.0;
    for (std::size_t c = 0; c < now.contacts->size(); ++c) {
      const Vec2 onWall = -forceOn(*now.contacts, c);
      force += onWall;
      torque += cross(place.centre[now.contacts->j[c]] - centre, onWall) -
                arm(scene.law, smallRadius, smallRadius, now.contacts->overlap[c]) *
                    now.contacts->tangentialForce[c];
      size += onWall.norm();
    }
    const Tolerance sum = {relative * size, 0.0, "roundings, and a normal that turns"};
    EXPECT_TRUE(close(*now.bodies[0].force, force, sum)) << "at t = " << now.contactTime << " s";
    EXPECT_TRUE(close(*now.bodies[0].torque, torque, {0.025 * sum.absolute, 0.0, sum.why}))
        << "at t = " << now.contactTime << " s";
  }
  EXPECT_EQ(touched.size(), 2u) << "it falls between two wall disks";
}

/// The same of a plane: f_n and f_t act on it where it is nearest to the disk's centre, or half the
/// overlap behind that where the engine has its contact points in the middle of overlaps.
TEST_P(Conformance, PlaneLoadsAreThoseOfTheirContacts) {
  if (contactReport() == ContactReport::none) GTEST_SKIP() << "shows no contacts";
  Scene scene = emptyScene(law(), steps);
  scene.bodies = {planeWall({0.2, -smallRadius - Encounter::gap}, {0.0, 1.0})};
  scene.bodies[0].centre = {-0.01, 0.003};
  addDisk(scene, smallRadius, smallMass, {0.0, 0.0}, {0.02, -Encounter::speed}, 9.0);
  if (const auto why = refused(scene)) GTEST_SKIP() << *why;

  const std::vector<Snapshot> seen = watch(Encounter::end);
  const Film film(scene, seen);
  const double turn = seen.back().contactInterval * Encounter::speed / smallRadius;
  const double relative = byPrecision(1e-12, 1e-5, "").relative + 2.0 * turn;
  bool touched = false;
  for (const Snapshot& now : seen) {
    if (!now.contacts) continue;
    if (!now.bodies[0].force || !now.bodies[0].torque) GTEST_SKIP() << "shows no wall loads";
    const Vec2 force = -forceOn(now, 0);
    Vec2 foot = film.at(now.contactTime).centre[0];
    foot.y() = scene.bodies[0].planes[0].point.y();
    const LawConventions& how = scene_.law.conventions;
    const bool inside = how.leverArm != LeverArm::radius && how.planeArm == PlaneArm::middle;
    if (inside && now.contacts->size() > 0) foot.y() -= 0.5 * now.contacts->overlap[0];
    const Tolerance sum = {relative * force.norm(), 0.0, "roundings, and a disk that moves on"};
    EXPECT_TRUE(close(*now.bodies[0].force, force, sum)) << "at t = " << now.contactTime << " s";
    EXPECT_TRUE(close(*now.bodies[0].torque, cross(foot - scene.bodies[0].centre, force),
                      {0.01 * sum.absolute, 0.0, sum.why}))
        << "at t = " << now.contactTime << " s";
    touched = touched || now.contacts->size() > 0;
  }
  EXPECT_TRUE(touched);
}

}  // namespace
}  // namespace crossgrain::test
