// What holds here, soon and of two disks holds far away, late and of many.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "adapters/audit.hpp"
#include "runs/conformance/check_list.hpp"
#include "runs/conformance/exam.hpp"
#include "runs/conformance/meeting.hpp"

namespace crossgrain::conformance::reach {
namespace {

bool single(const Exam& it) {
  return !it.can.precisions.empty() && it.can.precisions.front() == Precision::float32;
}

/// Fractions of a step at which they touch. Single precision does not keep the phase over a long
/// flight, and what impulses do may hang on it: then any of several will do.
std::vector<double> phasesOf(const Exam& it) {
  if (single(it)) return {0.1, 0.3, 0.5, 0.7, 0.9};
  return {0.5};
}

/// A disk slips on a plane, on a wall disk and on another disk, wherever the engine has that.
/// @param change  makes a meeting the other one
template <typename Change>
void expectTheSameElsewhere(Exam& it, const ContactLaw& law, double speed, const Tolerance& psi,
                            const std::string& when, const Change& change) {
  int count = 0;
  std::string why;
  for (const Partner partner : {Partner::plane, Partner::wallDisk, Partner::disk}) {
    Meeting here;
    here.law = law;
    here.partner = partner;
    here.steps = 50.0;
    here.starts = {{3.0, speed}};
    std::vector<Outcome> wanted;
    for (const double phase : phasesOf(it)) {
      here.flight = phase;
      if (const auto one = meet(it, here, &why); one && one->ends.front()) wanted.push_back(*one);
    }
    if (wanted.empty()) continue;
    Meeting there = here;
    change(there);
    const auto found = meet(it, there, &why);
    it.require(found.has_value(), said("refuses", when, " what it runs elsewhere: ", why));
    const auto distance = [&](const Outcome& one) {
      const auto &is = found->ends.front(), &was = one.ends.front();
      return is ? std::abs(is->psi - was->psi) : 0.0;
    };
    const Outcome& nearest = *std::ranges::min_element(wanted, {}, distance);
    Tolerance allowed = psi;
    for (const Outcome& one : wanted)
      allowed.absolute =
          std::max(allowed.absolute, std::abs(one.ends.front()->psi - nearest.ends.front()->psi));
    expectTheSame(it, there, *found, nearest, allowed, when);
    ++count;
  }
  if (count == 0) it.skip(why.empty() ? "none of these collisions ends" : why);
}

/// Rounding of a place x to ε x moves a contact that is 70 µm deep by that part of it in each of
/// fifty steps, which a slip magnifies a few times.
constexpr double far = 10.0, farOfSingle = 1.0;  // [m]

void farIsAsNear(Exam& it) {
  const double place = single(it) ? farOfSingle : far;
  expectTheSameElsewhere(it, it.law(), Encounter::speed,
                         it.byPrecision(1e-6, 0.1, "rounding of places so far from the origin"),
                         said(", ", place, " m from the origin"), [&](Meeting& there) {
                           there.place = {place, -0.7 * place};
                         });
  it.examined(farPlaces);
}

/// Two seconds of flight before the same collision. The law is a twenty-fifth as stiff, the
/// restitution the same, so that a step is five times as long.
void lateIsAsEarly(Exam& it) {
  constexpr double late = 2.0;  // [s]
  ContactLaw soft = it.law();
  for (double* constant : {&soft.kn, &soft.kt}) *constant /= 25.0;
  if (soft.damper == Damper::constant)
    for (double* constant : {&soft.gn, &soft.gt}) *constant /= 5.0;
  if (soft.damper == Damper::viscoelastic)
    for (double* constant : {&soft.gn, &soft.gt}) *constant *= 5.0;
  const double dt = emptyScene(soft, 50.0).dt;
  expectTheSameElsewhere(it, soft, 0.01,
                         it.byPrecision(1e-6, 0.1, "a flight of 2 cm, rounded in every step"),
                         said(", ", late, " s after load"),
                         // At the same phase of a step: of the engine's own, where it has one.
                         [&](Meeting& there) {
                           const double step = it.realised.dt;
                           there.flight += std::round(late / step) * step / dt;
                         });
  it.examined(lateTimes);
}

/// 150 pairs, each in the middle of nothing: every one does what one alone does, and a snapshot in
/// the midst of it holds all contacts.
void manyAreAsFew(Exam& it) {
  const Scene one = encounterScene(crookedEncounter(), it.law(), 50.0);
  it.load(one);
  const Snapshot alone = it.at(Encounter::end);
  const auto distance = [](const Snapshot& now, std::size_t k) {
    return (now.position[2 * k] - now.position[2 * k + 1]).norm();
  };
  Scene many = emptyScene(it.law(), 50.0);
  constexpr int columns = 15, rows = 10;
  constexpr double apart = 8.0 * largeRadius;
  std::vector<Vec2> places;
  for (int k = 0; k < columns * rows; ++k) {
    places.emplace_back(apart * (k % columns), apart * (k / columns));
    for (const int i : {0, 1})
      addDisk(many, one.disks.radius[i], one.disks.mass[i], one.disks.position[i] + places.back(),
              one.disks.velocity[i], one.disks.spin[i]);
  }
  it.load(many);
  const double touch = Encounter::gap / Encounter::speed;
  const Snapshot middle = it.at(touch + 0.4 * smallContactTime);
  if (it.contactReport() != ContactReport::none) {
    const std::string why =
        whyUnsound(middle, auditBasis(it.scene, it.can, it.realised), middle.positionTime);
    it.expect(why.empty(), why);
  }
  const Snapshot after = it.at(Encounter::end);
  const Tolerance relative = it.byPrecision(1e-6, 0.1, "rounding of places");
  const auto in = [&](double unit) {
    return Tolerance{relative.relative * unit, 0.0, relative.why};
  };
  it.requireEqual(after.position.size(), many.disks.size(), "positions shown");
  const std::vector<double> spins = spinsOf(many, after), spin = spinsOf(one, alone);
  for (std::size_t k = 0; k < places.size(); ++k) {
    const std::string which = said(" of pair ", k, " of ", places.size());
    it.expect(close(distance(after, k), distance(alone, 0), in(smallRadius)),
              "the distance [m]" + which);
    for (const std::size_t i : {0, 1}) {
      it.expect(close(after.velocity[2 * k + i], alone.velocity[i], in(Encounter::speed)),
                "a velocity [m/s]" + which);
      it.expect(close(spins[2 * k + i], spin[i], in(Encounter::speed / smallRadius)),
                "a spin [rad/s]" + which);
    }
  }
  it.examined(manyDisks);
}

/// Pressed between two posts, a disk hangs on its two tangential springs, ξ = m g/(2 k_t) from
/// where they were relaxed. Another falls past it for 2700 steps and 70 mm, through more than
/// a hundred lists of neighbours: none may lose what the springs hold, and no step what the other
/// flies with.
void springsHoldWhileAnotherFalls(Exam& it) {
  const ContactLaw law = it.law();
  if (law.normal != NormalLaw::linear || law.tangential != TangentialLaw::springDashpot)
    it.skip("has no linear law with tangential spring and dashpot");
  constexpr double gravity = 9.81, depth = 0.02 * smallRadius, end = 0.12;
  constexpr double post = 2.0 * smallRadius - depth;
  Scene scene = emptyScene(law, 50.0);
  scene.gravity = {gravity, 0.0};
  scene.bodies = {wallOf("posts", Vec2::Zero(), {{0.0, post}, {0.0, -post}})};
  addDisk(scene, smallRadius, smallMass, {0.0, 20.0 * smallRadius}, Vec2::Zero());
  addDisk(scene, smallRadius, smallMass, Vec2::Zero(), Vec2::Zero());
  it.load(scene);
  const double stretch = smallMass * gravity / (2.0 * law.kt);
  for (const double t : {0.25 * end, 0.5 * end, 0.75 * end, end}) {
    const Snapshot now = it.at(t);
    const std::string when = said(" after ", it.engine().stats().steps, " steps");
    // Rounded posts and arms that follow the overlap make two per cent.
    it.atMost(now.position[1].x() / stretch, 1.2,
              "sag of a disk that springs hold, in m g/(2 k_t)," + when);
    const double fallen = 0.5 * gravity * now.positionTime * now.positionTime;
    const Tolerance scheme = {0.51 * gravity * now.positionTime * it.realised.dt, 1e-5,
                              "first order, or single precision"};
    it.expect(close(now.position[0].x(), fallen, scheme), "the way fallen [m]" + when);
  }
  it.examined(toString(Effect::tangentialSpring));
}

}  // namespace

std::span<const Check> checks() {
  static constexpr std::array list = {
      Check{"FarIsAsNear", "a collision far from the origin is as one near it", farIsAsNear},
      Check{"LateIsAsEarly", "a collision two seconds after load is as one at once", lateIsAsEarly},
      Check{"ManyAreAsFew", "each of 150 pairs does what one alone does", manyAreAsFew},
      Check{"SpringsHoldWhileAnotherFalls",
            "springs hold a disk while another falls past it, and it falls freely",
            springsHoldWhileAnotherFalls},
  };
  return list;
}

}  // namespace crossgrain::conformance::reach
