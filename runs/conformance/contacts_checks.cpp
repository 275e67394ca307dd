// What an engine says of its contacts, and whether those forces are the ones that it applied.
#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <stdexcept>

#include "adapters/audit.hpp"
#include "adapters/declared_law.hpp"
#include "runs/conformance/check_list.hpp"
#include "runs/conformance/exam.hpp"

namespace crossgrain::conformance::contacts {
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
void expectGeometry(Exam& it, const Contacts& contacts, const Place& place, const Film& film,
                    bool soft, const Tolerance& length) {
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const auto i = static_cast<std::size_t>(contacts.i[c]);
    const auto j = static_cast<std::size_t>(contacts.j[c]);
    it.require(i < j, "the ids of a contact, i before j");
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
    it.expect(close(contacts.normal[c], normal, direction), said("the normal of ", i, " with ", j));
    it.expect(close(contacts.overlap[c], overlap, length),
              said("the overlap of ", i, " with ", j, " [m]"));
    if (soft) {
      it.above(contacts.overlap[c], 0.0, "the overlap of soft disks that touch [m]");
    }
  }
}

/// Every step of a heap on a turning wheel, and of an impact.
void snapshotsAreSound(Exam& it) {
  if (it.contactReport() == ContactReport::none) it.skip("shows no contacts");
  for (const auto& [scene, end] : {std::pair(it.simplified(busyScene(it.law())), busyEnd),
                                   {allKindsOfContact(it.law(), false), 2.0 * Encounter::end}}) {
    it.load(scene);
    const AuditBasis basis = auditBasis(it.scene, it.can, it.realised);
    const auto last = std::llround(end / it.realised.dt);
    for (long long step = 0; step <= last; ++step) {
      const double reached = it.engine().advance(static_cast<double>(step) * it.realised.dt);
      const std::string why = whyUnsound(it.engine().snapshot(it.contactReport()), basis, reached);
      if (!why.empty()) it.fault(said("at t = ", reached, " s ", why));
    }
    const std::string cost =
        whyNoStats(it.engine().stats(), it.realised.dt, static_cast<double>(last) * it.realised.dt);
    it.expect(cost.empty(), cost);
  }
}

/// The same, held against the law that the engine declares.
void forcesAreThoseOfTheLaw(Exam& it) {
  if (it.contactReport() == ContactReport::none) it.skip("shows no contacts");
  it.load(it.simplified(busyScene(it.law())));
  const AuditBasis basis = auditBasis(it.scene, it.can, it.realised);
  const auto law = declaredLaw(it.can, it.scene, it.realised, 0.5 * smallMass);
  if (!law) it.skip("declares no law whose constants anybody can tell");
  for (const Snapshot& now : it.watch(busyEnd)) {
    const std::string why = whyNotOfLaw(now, basis, *law);
    if (!why.empty()) it.fault(said("at t = ", now.contactTime, " s ", why));
  }
}

void contactsSayWhereTheyAre(Exam& it) {
  if (it.contactReport() == ContactReport::none) it.skip(said("shows no contacts"));
  const Scene scene = allKindsOfContact(it.law(), false);
  it.load(scene);
  it.examined(it.can.instantContacts ? instantContacts : accumulatedContacts);
  const std::vector<Snapshot> seen = it.watch(2.0 * Encounter::end);
  const Film film(scene, seen);
  const Tolerance length = {it.byPrecision(1e-12, 1e-6, "").absolute * smallRadius, 0.0,
                            "roundings"};
  bool pair = false, wall = false;
  for (const Snapshot& now : seen) {
    if (!now.contacts) continue;
    expectGeometry(it, *now.contacts, film.at(now.contactTime), film, !it.rigid(), length);
    for (const std::int32_t j : now.contacts->j) (j < 2 ? pair : wall) = true;
  }
  it.expect(pair && wall, "it never shows a contact of two disks, or none with a wall disk");
}

void contactsWithPlanesSayWhereTheyAre(Exam& it) {
  if (it.contactReport() == ContactReport::none) it.skip(said("shows no contacts"));
  const Scene scene = allKindsOfContact(it.law(), true);
  it.load(scene);
  const std::vector<Snapshot> seen = it.watch(2.0 * Encounter::end);
  const Film film(scene, seen);
  const Tolerance length = {it.byPrecision(1e-12, 1e-6, "").absolute * smallRadius, 0.0,
                            "roundings"};
  bool plane = false;
  for (const Snapshot& now : seen) {
    if (!now.contacts) continue;
    expectGeometry(it, *now.contacts, film.at(now.contactTime), film, !it.rigid(), length);
    // Two disks and two wall disks: the plane is number 4.
    for (const std::int32_t j : now.contacts->j) plane = plane || j == 4;
  }
  it.expect(plane, "it never shows a contact with a plane");
}

/// Ψ_i = ±3 slides throughout: f_n pushes apart, f_t on i is along −v_t.
void forcesPointWhereTheySay(Exam& it) {
  if (it.contactReport() == ContactReport::none) it.skip(said("shows no contacts"));
  for (const double spin : {-40.0, 40.0}) {
    Encounter pair;
    pair.spins[0] = pair.spins[1] = spin;
    const Scene scene = encounterScene(pair, it.law(), steps);
    it.load(scene);
    const double slip = -2.0 * smallRadius * spin;
    double pushed = 0.0, dragged = 0.0;
    for (const Snapshot& now : it.watch(Encounter::end)) {
      if (!now.contacts || now.contacts->size() == 0) continue;
      const double fn = now.contacts->normalForce[0];
      const double ft = now.contacts->tangentialForce[0];
      if (pushed == 0.0) {
        it.above(fn, 0.0, "at first touch");
      }
      if (fn > 0.0) {
        it.atMost(ft * slip, 0.0, said("at t = ", now.contactTime, " s"));
      }
      pushed += fn;
      dragged += ft;
    }
    it.above(pushed, 0.0, "the sum of f_n");
    it.below(dragged * slip, 0.0, "friction times slip");
  }
}

void slidingFlagsMarkTheBound(Exam& it) {
  if (!it.can.slidingFlags) it.skip(said("has no sliding flags"));
  it.examined(slidingFlags);
  ContactLaw cut = fullLaw();
  cut.conventions.tension = Tension::cut;  // where it can: then every convention's bound is µ f_n
  Encounter pair = crookedEncounter();
  // A rigid impact slides or sticks, as a whole; and a spring alone, held to µ |f_n|, hardly
  // slides.
  const std::vector<std::pair<double, double>> spinsAndFrictions =
      it.rigid()
          ? std::vector{std::pair{pair.spins[0], cut.mu}, std::pair{100.0, cut.mu}}
          : std::vector{std::pair{pair.spins[0], cut.mu}, std::pair{pair.spins[0], 0.1 * cut.mu}};
  int sliding = 0, sticking = 0;
  for (const auto& [spin, friction] : spinsAndFrictions) {
    pair.spins[0] = spin;
    cut.mu = friction;
    const Scene scene = encounterScene(pair, followed(it.can, cut), steps);
    it.load(scene);
    const ContactLaw& law = scene.law;
    const bool held = law.conventions.dashpot == Dashpot::inside;
    for (const Snapshot& now : it.watch(Encounter::end)) {
      if (!now.contacts || now.contacts->size() == 0) continue;
      it.requireEqual(now.contacts->sliding.size(), 1u, "sliding flags of one contact");
      const double ft = std::abs(now.contacts->tangentialForce[0]);
      const double fn = now.contacts->normalForce[0];
      const bool pushed = law.conventions.coulombBound == CoulombBound::compression;
      const double bound = law.mu * (pushed ? std::max(fn, 0.0) : std::abs(fn));
      const Tolerance rounding = it.byPrecision(1e-12, 1e-5, "roundings");
      if (now.contacts->sliding[0]) {
        it.expect(close(ft, bound, {0.0, rounding.relative, rounding.why}),
                  "|f_t| of a contact that slides [N]");
      } else if (held) {
        it.atMost(ft, bound * (1.0 + rounding.relative), "|f_t| of a contact that sticks");
      }
      ++(now.contacts->sliding[0] ? sliding : sticking);
    }
  }
  it.above(sliding, 0, "contacts that slide");
  it.above(sticking, 0, "contacts that stick");
}

/// Newton's second law: over each step m Δv/Δt lies between the forces that the engine shows before
/// and after it, whichever of the two, or their mean, the scheme uses; over the whole collision the
/// impulses add up, of forces and of torques.
void contactForcesAreThoseThatAct(Exam& it) {
  if (it.contactReport() == ContactReport::none) it.skip(said("shows no contacts"));
  Encounter pair = crookedEncounter();
  pair.radii[1] = pair.radii[0];  // every engine's contact point is then in the middle
  const Scene scene = encounterScene(pair, it.law(), steps);
  it.load(scene);
  const std::vector<Snapshot> seen = it.watch(Encounter::end);
  // A mean over an interval is shown with the normal of its end, which has turned since.
  const double turn = seen.back().contactInterval * Encounter::speed / smallRadius;
  const double relative = it.byPrecision(1e-12, 1e-5, "").relative + turn;
  double largest = 0.0;
  for (const Snapshot& now : seen) largest = std::max(largest, forceOn(now, 0).norm());
  it.require(largest > 0.0, "no contact force is ever shown");

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
        it.atLeast(acting[axis], std::min(before[axis], after[axis]) - relative * largest,
                   "m Δv/Δt against the smaller of the forces before and after the step");
        it.atMost(acting[axis], std::max(before[axis], after[axis]) + relative * largest,
                  "m Δv/Δt against the larger of the forces before and after the step");
      }
      impulse += it.realised.dt * after;
      for (std::size_t c = 0; now.contacts && c < now.contacts->size(); ++c)
        angularImpulse -= it.realised.dt * now.contacts->tangentialForce[c] *
                          arm(scene.law, smallRadius, smallRadius, now.contacts->overlap[c]);
    }
    const double unit = scene.disks.mass[id] * Encounter::speed;
    const Tolerance sum = {relative * unit, 0.0, "roundings, and a normal that turns"};
    it.expect(
        close(impulse,
              Vec2(scene.disks.mass[id] * (seen.back().velocity[id] - seen.front().velocity[id])),
              sum),
        "the sum of forces over time against the change of momentum [kg m/s]");
    const double spun = spinsOf(scene, seen.back())[id] - spinsOf(scene, seen.front())[id];
    it.expect(close(angularImpulse, scene.disks.inertia[id] * spun,
                    {relative * unit * smallRadius, 0.0, sum.why}),
              "the sum of torques over time against the change of angular momentum [kg m²/s]");
  }
}

/// Means over the time since the last look, times that, are what changed the momentum of a disk.
void accumulatedContactsAreImpulses(Exam& it) {
  it.needs(accumulatedContacts);
  const Scene scene = encounterScene(crookedEncounter(), it.law(), steps);
  it.load(scene);
  it.examined(accumulatedContacts);
  const auto look = [&](double t) {
    it.engine().advance(t);
    return it.engine().snapshot(ContactReport::accumulated);
  };
  const Snapshot start = look(0.0);
  Snapshot last = start;
  Vec2 impulse = Vec2::Zero();
  // Twice a step: the normal shown is that of the end.
  const double lapse = 2.0 * it.realised.dt;
  for (double t = lapse; t < Encounter::end; t += lapse) {
    last = look(t);
    impulse += last.contactInterval * forceOn(last, 0);
  }
  const double turn = lapse * Encounter::speed / smallRadius;
  const double unit = scene.disks.mass[0] * Encounter::speed;
  const Vec2 change = scene.disks.mass[0] * (last.velocity[0] - start.velocity[0]);
  it.above(change.norm(), 0.1 * unit, "the change of momentum by a collision [kg m/s]");
  it.expect(close(impulse, change,
                  {(it.byPrecision(1e-12, 1e-5, "").relative + 2.0 * turn) * unit, 0.0,
                   "roundings, and a normal that turns"}),
            "the sum of accumulated forces times their intervals [kg m/s]");
}

/// A closed account: what no term of the ledger accounts for is of the order of the scheme.
void energyLedgerIsClosed(Exam& it) {
  it.needs(energyLedger);
  double left[2] = {};
  for (const int k : {0, 1}) {
    Scene scene = encounterScene(crookedEncounter(), it.law(), k == 0 ? 100.0 : 400.0);
    scene.energyLedger = true;
    it.load(scene);
    it.examined(energyLedger);
    const Snapshot after = it.at(Encounter::end);
    it.require(after.ledger.has_value(), "it declares an energy ledger, and shows none");
    const Tolerance rounding = it.byPrecision(1e-9, 1e-4, "roundings of the additions");
    double kinetic = 0.0;
    const std::vector<double> spins = spinsOf(scene, after);
    for (std::size_t i = 0; i < spins.size(); ++i)
      kinetic += 0.5 * scene.disks.mass[i] * after.velocity[i].squaredNorm() +
                 0.5 * scene.disks.inertia[i] * spins[i] * spins[i];
    it.expect(close(after.ledger->kinetic, kinetic, rounding), "its kinetic energy [J]");
    left[k] = std::abs(residual(*after.ledger)) / after.ledger->initial;
  }
  it.atMost(left[0], 0.02, "part of the energy that it does not account for, at t_c/100");
  it.atMost(left[1], std::max(0.5 * left[0], 1e-9), "the same at t_c/400, which is to be less");
}

/// A wall's force and torque are those of the contacts of its disks.
void wallLoadsAreThoseOfTheirContacts(Exam& it) {
  if (it.contactReport() == ContactReport::none) it.skip(said("shows no contacts"));
  const Vec2 centre(0.01, -0.02);
  std::vector<Vec2> rim;
  for (const double angle : {-0.35, 0.0, 0.35})
    rim.push_back(centre + 0.025 * Vec2(std::cos(angle), std::sin(angle)));
  Scene scene = emptyScene(it.law(), steps);
  scene.bodies = {wallOf("wheel", centre, rim, rotating(0.5))};
  const Vec2 between(std::cos(0.175), std::sin(0.175));
  addDisk(scene, smallRadius, smallMass, centre + 0.0308 * between, -Encounter::speed * between,
          9.0);
  it.load(scene);

  const std::vector<Snapshot> seen = it.watch(Encounter::end);
  const Film film(scene, seen);
  const double turn = seen.back().contactInterval * Encounter::speed / smallRadius;
  const double relative = it.byPrecision(1e-12, 1e-5, "").relative + 2.0 * turn;
  std::set<std::int32_t> touched;
  for (const Snapshot& now : seen) {
    if (!now.contacts) continue;
    touched.insert(now.contacts->j.begin(), now.contacts->j.end());
    if (!now.bodies[0].force || !now.bodies[0].torque) it.skip(said("shows no wall loads"));
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
    it.expect(close(*now.bodies[0].force, force, sum), said("at t = ", now.contactTime, " s"));
    it.expect(close(*now.bodies[0].torque, torque, {0.025 * sum.absolute, 0.0, sum.why}),
              said("at t = ", now.contactTime, " s"));
  }
  it.equal(touched.size(), 2u, "it falls between two wall disks");
}

/// The same of a plane: f_n and f_t act on it where it is nearest to the disk's centre, or half the
/// overlap behind that where the engine has its contact points in the middle of overlaps.
void planeLoadsAreThoseOfTheirContacts(Exam& it) {
  if (it.contactReport() == ContactReport::none) it.skip(said("shows no contacts"));
  Scene scene = emptyScene(it.law(), steps);
  scene.bodies = {planeWall({0.2, -smallRadius - Encounter::gap}, {0.0, 1.0})};
  scene.bodies[0].centre = {-0.01, 0.003};
  addDisk(scene, smallRadius, smallMass, {0.0, 0.0}, {0.02, -Encounter::speed}, 9.0);
  it.load(scene);

  const std::vector<Snapshot> seen = it.watch(Encounter::end);
  const Film film(scene, seen);
  const double turn = seen.back().contactInterval * Encounter::speed / smallRadius;
  const double relative = it.byPrecision(1e-12, 1e-5, "").relative + 2.0 * turn;
  bool touched = false;
  for (const Snapshot& now : seen) {
    if (!now.contacts) continue;
    if (!now.bodies[0].force || !now.bodies[0].torque) it.skip(said("shows no wall loads"));
    const Vec2 force = -forceOn(now, 0);
    Vec2 foot = film.at(now.contactTime).centre[0];
    foot.y() = scene.bodies[0].planes[0].point.y();
    const LawConventions& how = it.scene.law.conventions;
    const bool inside = how.leverArm != LeverArm::radius && how.planeArm == PlaneArm::middle;
    if (inside && now.contacts->size() > 0) foot.y() -= 0.5 * now.contacts->overlap[0];
    const Tolerance sum = {relative * force.norm(), 0.0, "roundings, and a disk that moves on"};
    it.expect(close(*now.bodies[0].force, force, sum), said("at t = ", now.contactTime, " s"));
    it.expect(close(*now.bodies[0].torque, cross(foot - scene.bodies[0].centre, force),
                    {0.01 * sum.absolute, 0.0, sum.why}),
              said("at t = ", now.contactTime, " s"));
    touched = touched || now.contacts->size() > 0;
  }
  it.expect(touched, "it never shows a contact with the plane");
}

}  // namespace
std::span<const Check> checks() {
  static constexpr std::array list = {
      Check{"SnapshotsAreSound", "snapshots can be true: times, places, contacts worked out again",
            snapshotsAreSound},
      Check{"ForcesAreThoseOfTheLaw", "the forces of contacts are those of the declared law",
            forcesAreThoseOfTheLaw},
      Check{"ContactsSayWhereTheyAre", "contacts lie where the disks are", contactsSayWhereTheyAre},
      Check{"ContactsWithPlanesSayWhereTheyAre", "contacts with planes lie where the disks are",
            contactsWithPlanesSayWhereTheyAre},
      Check{"ForcesPointWhereTheySay", "forces have the signs that they say",
            forcesPointWhereTheySay},
      Check{"SlidingFlagsMarkTheBound", "sliding flags mark the Coulomb bound",
            slidingFlagsMarkTheBound},
      Check{"ContactForcesAreThoseThatAct", "the forces shown are those that act",
            contactForcesAreThoseThatAct},
      Check{"AccumulatedContactsAreImpulses", "accumulated contacts are the impulses that acted",
            accumulatedContactsAreImpulses},
      Check{"EnergyLedgerIsClosed", "its energy ledger accounts for all energy",
            energyLedgerIsClosed},
      Check{"WallLoadsAreThoseOfTheirContacts",
            "a wall's force and torque are those of its contacts",
            wallLoadsAreThoseOfTheirContacts},
      Check{"PlaneLoadsAreThoseOfTheirContacts",
            "a plane's force and torque are those of its contacts",
            planeLoadsAreThoseOfTheirContacts},
  };
  return list;
}

}  // namespace crossgrain::conformance::contacts
