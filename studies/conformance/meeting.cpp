#include "studies/conformance/meeting.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <utility>

#include "adapters/declared_law.hpp"
#include "cases/collision_scene.hpp"
#include "oracle/collision_flight.hpp"
#include "oracle/collision_oracle.hpp"
#include "oracle/impact.hpp"

namespace crossgrain::conformance {
namespace {

constexpr double heavy = 1e9;  // times as heavy as the disk: a wall to nine digits

Case setupOf(const Meeting& meeting) {
  const bool wallDisk = meeting.partner == Partner::wallDisk;
  Case setup;
  setup.name = "conformance";
  setup.law = meeting.law;
  Collision& collision = setup.collision;
  collision.wall = meeting.partner == Partner::plane;
  collision.wallVelocity = meeting.wallVelocity;
  collision.radius[0] = smallRadius;
  collision.radius[1] = meeting.radius;
  collision.mass[0] = smallMass;
  collision.mass[1] = wallDisk ? heavy * smallMass : meeting.mass;
  collision.startPhase = meeting.flight;
  collision.inertiaFactor = meeting.inertiaFactor;
  return setup;
}

/// The second of each pair as a disk of a wall at rest.
Scene withWallDisks(Scene scene) {
  WallBody wall;
  wall.name = "posts";
  const Disks all = std::exchange(scene.disks, {});
  for (std::size_t k = 0; k < all.size(); k += 2) {
    addDisk(scene, all.radius[k], all.mass[k], all.position[k], all.velocity[k], all.spin[k]);
    wall.diskPosition.push_back(all.position[k + 1]);
    wall.diskRadius.push_back(all.radius[k + 1]);
  }
  scene.bodies = {wall};
  return scene;
}

Snapshot withoutWallDisks(const Snapshot& now) {
  Snapshot all;
  all.positionTime = now.positionTime;
  if (now.spin) all.spin.emplace();
  for (std::size_t k = 0; k < now.position.size(); ++k) {
    all.position.insert(all.position.end(), {now.position[k], now.wallPosition[k]});
    all.velocity.insert(all.velocity.end(), {now.velocity[k], Vec2::Zero()});
    if (now.spin) all.spin->insert(all.spin->end(), {(*now.spin)[k], 0.0});
  }
  return all;
}

Scene wholeOf(const Meeting& meeting) {
  return collisionScene(setupOf(meeting), meeting.starts,
                        emptyScene(meeting.law, meeting.steps).dt);
}

/// The oracle's outcome; none for conventions that have no limit of small steps.
std::optional<CollisionEnd> oracle(const ContactLaw& law, const CollidingPair& pair,
                                   const CollisionStart& start) {
  try {
    const CollisionEnd end = oracleOutcome(law, pair, start);
    if (end.noLimit || !std::isfinite(end.psi) || !std::isfinite(end.en)) return std::nullopt;
    return end;
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

using Ends = std::vector<std::optional<CollisionEnd>>;

/// @param whole  wholeOf(meeting), which the engine has loaded
Ends endsOf(Engine& engine, const Meeting& meeting, const Scene& whole, double t) {
  engine.advance(t);
  Snapshot after = engine.snapshot(ContactReport::none);
  for (auto* each : {&after.position, &after.wallPosition})
    for (Vec2& x : *each) x -= meeting.place;
  if (meeting.partner == Partner::wallDisk) after = withoutWallDisks(after);
  Ends ends;
  for (std::size_t k = 0; k < meeting.starts.size(); ++k)
    ends.push_back(collisionEnd(whole, after, k, meeting.starts[k]));
  return ends;
}

Ends oracleEnds(const ContactLaw& law, const CollidingPair& pair,
                const std::vector<CollisionStart>& starts) {
  Ends ends;
  for (const CollisionStart& start : starts) ends.push_back(oracle(law, pair, start));
  return ends;
}

/// A number of an outcome and how far it may be off.
struct Quantity {
  const char* name;
  std::optional<double> (*of)(const CollisionEnd&);
  Tolerance allowed;
};

// Friction is first order where it starts to slip; a rigid engine acts half a step's overlap inside
// the radius, 0.7 % of Ψ_f.
const Tolerance friction = {0.03, 0.01, "slip begins within a step"};
const Tolerance firstOrder = {0.0, 0.02, "a first-order scheme at t_c/400"};

std::vector<Quantity> quantities(const Tolerance& psi, const Tolerance& others) {
  return {
      {"e_n", [](const CollisionEnd& end) { return std::optional(end.en); }, others},
      {"psi_f", [](const CollisionEnd& end) { return std::optional(end.psi); }, psi},
      {"the centre's v_t/v_n", [](const CollisionEnd& end) { return std::optional(end.centrePsi); },
       psi},
      {"the contact's duration [s]", [](const CollisionEnd& end) { return end.duration; }, others}};
}

/// The largest error of one outcome's numbers, in units of what is allowed; infinite without a
/// reference.
double misfit(const CollisionEnd& found, const std::optional<CollisionEnd>& wanted,
              const std::vector<Quantity>& all) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  if (!wanted) return infinite;
  double most = 0.0;
  for (const Quantity& quantity : all) {
    const auto is = quantity.of(found), should = quantity.of(*wanted);
    if (!is || !should) continue;
    const double limit =
        std::max(quantity.allowed.absolute, quantity.allowed.relative * std::abs(*should));
    const double times = std::abs(*is - *should) / limit;
    most = std::max(most, std::isnan(times) ? infinite : times);
  }
  return most;
}

// ---- the most likely cause ----------------------------------------------------------------------

/// A law, a pair or a start that is another one by a factor; 1 is right.
struct Suspect {
  using End = std::function<std::optional<CollisionEnd>(const CollisionStart&, double factor)>;
  std::string name;
  End end;
  std::optional<double> factor = {};  ///< the only one possible; absent: it is fitted and named
};

/// v_t + a ω in place of v_t − a ω on a plane. As s' = v_t − a ω', J' ω̇' = −a f_t with ω' = −ω and
/// J' = −J it is the slip of a disk of negative inertia that spins the other way.
std::optional<CollisionEnd> endOfWrongSpin(const ContactLaw& law, const CollidingPair& pair,
                                           const CollisionStart& start) {
  CollidingPair other = pair;
  other.inertia[0] = -pair.inertia[0];
  CollisionStart wrong = start;
  if (start.approach != Approach::oblique) wrong.psi = -start.psi;
  const auto seen = oracle(law, other, wrong);
  if (!seen) return std::nullopt;
  CollisionEnd end =
      endOf(pair, start, {seen->en * start.vn, seen->centrePsi * start.vn, {-seen->spin[0], 0.0}});
  end.duration = seen->duration;
  return end;
}

/// The slip lacks the plane's velocity u along itself, so it is larger by it before and after.
std::optional<CollisionEnd> endWithoutBelt(const ContactLaw& law, const CollidingPair& pair,
                                           const CollisionStart& start, double u) {
  auto end = oracle(law, pair, {start.psi + u / start.vn, start.vn, Approach::firstSpin});
  if (!end) return std::nullopt;
  end->psi -= u / start.vn;
  if (start.approach == Approach::oblique) end->centrePsi += start.psi;
  return end;
}

std::vector<Suspect> suspectsOf(const Meeting& meeting, const MeetingResult& outcome) {
  const ContactLaw law = outcome.law;
  const CollidingPair pair = outcome.pair;
  std::vector<Suspect> all;
  const auto ofLaw = [&](const std::string& name, std::vector<double ContactLaw::*> constants,
                         std::optional<double> factor = {}) {
    if (std::ranges::all_of(constants, [&](auto each) { return law.*each == 0.0; })) return;
    all.push_back({name,
                   [=](const CollisionStart& start, double by) {
                     ContactLaw other = law;
                     for (auto constant : constants) other.*constant *= by;
                     return oracle(other, pair, start);
                   },
                   factor});
  };
  if (meeting.partner == Partner::plane) {
    const double u = meeting.wallVelocity.y();
    all.push_back(
        {"the disk's spin enters the slip with the wrong sign",
         [=](const CollisionStart& start, double) { return endOfWrongSpin(law, pair, start); },
         1.0});
    if (u != 0.0)
      all.push_back(
          {"the plane's motion along itself is not in the slip",
           [=](const CollisionStart& start, double) { return endWithoutBelt(law, pair, start, u); },
           1.0});
  }
  if (law.normal == NormalLaw::hertz)
    ofLaw("a Hertz law without √R₁₂", {&ContactLaw::kn, &ContactLaw::kt},
          1.0 / std::sqrt(pair.reducedRadius()));
  if (law.soft()) {
    const bool cut = law.conventions.tension == Tension::cut;
    ContactLaw other = law;
    other.conventions.tension = cut ? Tension::allow : Tension::cut;
    all.push_back({cut ? "tension is not cut" : "tension is cut",
                   [=](const CollisionStart& start, double) { return oracle(other, pair, start); },
                   1.0});
  }
  ofLaw("µ", {&ContactLaw::mu});
  // Half the torque and twice the moment of inertia are one motion.
  all.push_back({"torque", [=](const CollisionStart& start, double factor) {
                   CollidingPair other = pair;
                   for (double& inertia : other.inertia) inertia /= factor;
                   return oracle(law, other, start);
                 }});
  if (law.soft()) {
    ofLaw("k_n", {&ContactLaw::kn, &ContactLaw::kn3});
    ofLaw("γ_n", {&ContactLaw::gn});
    ofLaw("k_t", {&ContactLaw::kt});
    ofLaw("γ_t", {&ContactLaw::gt});
    ofLaw("k_n and k_t", {&ContactLaw::kn, &ContactLaw::kn3, &ContactLaw::kt});
  } else {
    ofLaw("e_n", {&ContactLaw::en});
    ofLaw("e_t0", {&ContactLaw::et0});
  }
  return all;
}

/// The one that explains every number, sign and size, to within what a scheme may be off; of
/// several, the one that leaves least. Empty: none does, or nothing is to be explained.
std::string explain(const Meeting& meeting, const MeetingResult& outcome) {
  const std::vector<Quantity> all = quantities(friction, firstOrder);
  // @param most  what is beyond it need not be known
  const auto left = [&](const Suspect::End& end, double factor, double most) {
    double worst = 0.0;
    for (std::size_t k = 0; k < outcome.ends.size() && worst <= most; ++k)
      if (const auto& found = outcome.ends[k])
        worst = std::max(worst, misfit(*found, end(meeting.starts[k], factor), all));
    return worst;
  };
  const auto right = [&](const CollisionStart& start, double) {
    return oracle(outcome.law, outcome.pair, start);
  };
  if (left(right, 1.0, 1.0) <= 1.0) return {};
  std::string best;
  double least = 1.0;
  for (const Suspect& suspect : suspectsOf(meeting, outcome)) {
    double factor = suspect.factor.value_or(1.0);
    double rest = std::numeric_limits<double>::infinity();
    if (suspect.factor) {
      rest = left(suspect.end, factor, least);
    } else {
      const auto attempt = [&](double by) {
        const double now = left(suspect.end, by, rest);
        if (!(now < rest)) return false;
        rest = now;
        factor = by;
        return true;
      };
      for (const double by : {0.0, 0.25, 0.5, 0.75, 0.9, 1.1, 1.25, 1.5, 2.0, -1.0}) attempt(by);
      for (double width = 0.125; width > 2e-3; width *= 0.5)
        if (!attempt(factor + width)) attempt(factor - width);
    }
    if (!(rest <= least)) continue;
    least = rest;
    best = suspect.factor ? suspect.name : text(suspect.name, percentOf(factor - 1.0));
  }
  return best;
}

std::string placeOf(const Meeting& meeting) {
  std::string place = meeting.partner == Partner::plane      ? "at planes"
                      : meeting.partner == Partner::wallDisk ? "at wall disks"
                      : meeting.radius != smallRadius        ? "of unequal disks"
                                                             : "of two disks";
  if (!meeting.wallVelocity.isZero(0.0))
    place += meeting.wallVelocity.y() != 0.0  ? " that move along themselves"
             : meeting.wallVelocity.x() > 0.0 ? " that advance"
                                              : " that retreat";
  return place;
}

/// @param when    follows a cause, where there is more to say of it than the place
/// @param leftOf  the outcome as it would be if the engine's right collisions were the oracle's
bool expectEnds(CheckContext& context, const Meeting& meeting, const MeetingResult& outcome,
                const Ends& wanted, const std::vector<Quantity>& all, const std::string& name,
                const std::string& when = {},
                const std::function<MeetingResult(MeetingResult)>& leftOf = std::identity()) {
  const std::size_t before = context.faults.size();
  bool any = false;
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    if (!wanted[k]) continue;
    any = true;
    const CollisionStart& start = meeting.starts[k];
    const std::string where =
        text(name, ", ", placeOf(meeting), ", psi_i = ", start.psi,
             start.approach == Approach::oblique ? " obliquely: " : " by spin: ");
    context.expect(outcome.ends[k].has_value(), where + "they do not meet, or do not part");
    if (!outcome.ends[k]) continue;
    for (const Quantity& quantity : all) {
      const auto is = quantity.of(*outcome.ends[k]), should = quantity.of(*wanted[k]);
      if (is && should) context.near(*is, *should, quantity.allowed, where + quantity.name);
    }
  }
  if (context.faults.size() == before || context.cause) return any;
  MeetingResult left = outcome;  // what is to be explained
  for (std::size_t k = 0; k < wanted.size(); ++k)
    if (!wanted[k]) left.ends[k].reset();
  const std::string cause = explain(meeting, leftOf(left));
  context.suspect(cause.empty() ? "" : text(cause, ", ", placeOf(meeting), when));
  return any;
}

}  // namespace

std::optional<MeetingResult> meet(CheckContext& context, const Meeting& meeting, std::string* why) {
  const CollidingPair pair = collidingPair(setupOf(meeting));
  const Scene whole = wholeOf(meeting);
  const Scene scene =
      shifted(meeting.partner == Partner::wallDisk ? withWallDisks(whole) : whole, meeting.place);
  if (const auto refusal = context.refusal(scene)) {
    if (why) *why = *refusal;
    return std::nullopt;
  }
  const auto law = declaredLaw(context.can, context.scene, context.effective, pair.reducedMass());
  if (!law) {
    if (why) *why = "declares no law with known constants";
    return std::nullopt;
  }
  ContactLaw soft = *law;
  if (!soft.soft()) soft = fullLaw();
  double longest = 0.0;
  for (const CollisionStart& start : meeting.starts)
    longest =
        std::max(longest, impactTime(soft, {pair.reducedMass(), pair.reducedRadius(), start.vn}));
  MeetingResult outcome{
      *law, pair, {}, meeting.flight * whole.dt + 2.5 * longest + 20.0 * context.effective.dt};
  outcome.ends = endsOf(context.engine, meeting, whole, outcome.time);
  return outcome;
}

bool expectTheOracle(CheckContext& context, const Meeting& meeting, const MeetingResult& outcome,
                     const std::string& name) {
  Ends wanted = oracleEnds(outcome.law, outcome.pair, meeting.starts);
  // Conventions without a limit of small steps are compared with the in-house engine that has
  // them; that one with nothing.
  if (!context.inHouse() && outcome.law.soft() &&
      !std::ranges::all_of(wanted, [](const auto& end) { return end.has_value(); })) {
    Scene mirrored = context.scene;
    mirrored.law = outcome.law;
    mirrored.dt = context.effective.dt;
    mirrored.precision = Precision::float64;
    const auto mirror = engineRegistry().front().make();
    mirror->load(mirrored, {});
    const Ends theirs = endsOf(*mirror, meeting, wholeOf(meeting), outcome.time);
    for (std::size_t k = 0; k < wanted.size(); ++k)
      if (!wanted[k]) wanted[k] = theirs[k];
  }
  return expectEnds(context, meeting, outcome, wanted, quantities(friction, firstOrder), name);
}

void expectTheSame(CheckContext& context, const Meeting& meeting, const MeetingResult& outcome,
                   const MeetingResult& wanted, const Tolerance& psi, const std::string& when) {
  const auto withoutTruncation = [&](MeetingResult found) {
    const Ends right = oracleEnds(found.law, found.pair, meeting.starts);
    for (std::size_t k = 0; k < right.size(); ++k) {
      auto& end = found.ends[k];
      if (!end) continue;
      if (!right[k]) {
        end.reset();
        continue;
      }
      const CollisionEnd& was = *wanted.ends[k];
      end->en += right[k]->en - was.en;
      end->psi += right[k]->psi - was.psi;
      end->centrePsi += right[k]->centrePsi - was.centrePsi;
      if (end->duration && was.duration) *end->duration += *right[k]->duration - *was.duration;
    }
    return found;
  };
  expectEnds(context, meeting, outcome, wanted.ends, quantities(psi, {0.0, psi.absolute, psi.why}),
             when.substr(when.find_first_not_of(", ")), when, withoutTruncation);
}

}  // namespace crossgrain::conformance
