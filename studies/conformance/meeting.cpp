#include "studies/conformance/meeting.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <utility>

#include "adapters/declared_law.hpp"
#include "cases/collision_scene.hpp"
#include "oracle/collision_end.hpp"
#include "oracle/collision_oracle.hpp"
#include "oracle/impact.hpp"

namespace crossgrain::conformance {
namespace {

constexpr double heavy = 1e12;  // times as heavy as the disk: a wall, in flights of 10⁵ steps too

Case setupOf(const CheckContext& context, const Meeting& meeting) {
  const bool wallDisk = meeting.partner == Partner::wallDisk;
  Case setup;
  setup.name = "conformance";
  setup.law = meeting.law;
  Collision& collision = setup.source.emplace<Collision>();
  collision.wall = meeting.partner == Partner::plane;
  collision.wallVelocity = meeting.wallVelocity;
  collision.radius[0] = smallRadius;
  collision.radius[1] = meeting.radius;
  collision.mass[0] = smallMass;
  collision.mass[1] = wallDisk ? heavy * smallMass : meeting.mass;
  collision.startPhase = meeting.flight;
  collision.inertiaFactor = meeting.inertiaFactor.value_or(context.inertiaFactor());
  return setup;
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

/// @param whole  MeetingResult::whole
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
  bool isTime = false;
};

// Friction is first order where it starts to slip; a rigid engine acts half a step's overlap inside
// the radius, 0.7 % of Ψ_f.
const Tolerance friction = {0.03, 0.01, "slip begins within a step"};
const Tolerance firstOrder = {0.0, 0.02, "a first-order scheme at t_c/400"};

Tolerance wider(Tolerance allowed, double by, double size) {
  const double limit = std::max(allowed.absolute, allowed.relative * size);
  return {limit + by, 0.0, allowed.why};
}

/// How far single precision takes the numbers of an outcome (check_context.hpp): speeds by that
/// part of the speed of approach in the contact, the duration in the flight that follows, from
/// which the instant of separation is worked out.
struct Rounded {
  double speeds = 0.0;  ///< [-]
  double way = 0.0;     ///< of both bodies in the flight until the snapshot [m]
};

std::vector<Quantity> quantities(const Tolerance& psi, const Tolerance& others) {
  return {{"e_n", [](const CollisionEnd& end) { return std::optional(end.en); }, others},
          {"psi_f", [](const CollisionEnd& end) { return std::optional(end.psi); }, psi},
          {"the centre's v_t/v_n",
           [](const CollisionEnd& end) { return std::optional(end.centrePsi); }, psi},
          {"the contact's duration [s]", [](const CollisionEnd& end) { return end.duration; },
           others, true}};
}

/// The largest error of one outcome's numbers, in units of the allowed one; infinite without a
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

/// A meeting and its outcome.
struct Met {
  const Meeting* meeting;
  MeetingResult outcome;
};

/// A law, a pair or a start that is another one by a factor; 1 is right. Of a meeting that it does
/// not concern the outcome stays.
struct Suspect {
  using End =
      std::function<std::optional<CollisionEnd>(const Met&, const CollisionStart&, double factor)>;
  std::string name;
  End end;
  std::optional<double> factor = {};  ///< the only one possible; absent: it is fitted and named
  std::string without = {};           ///< the name where the factor is 0, if it has one
};

/// v_t − Σ a_i k_i ω_i in place of v_t − Σ a_i ω_i: ω′ = k ω of bodies of J′ = J/k has the slip of
/// the law, as J′ ω̇′ = −a f_t. The force sees nothing but the slip, which is here one by spin.
/// @param by  k of each, not 0; of a plane −1, say, where the sign is wrong
std::optional<CollisionEnd> endOfSpins(const ContactLaw& law, const CollidingPair& pair,
                                       const CollisionStart& start, const double (&by)[2]) {
  CollidingPair other = pair;
  const PairMotion before = motionBefore(pair, start);
  double slip = before.tangential;
  for (const int side : {0, 1}) {
    other.inertia[side] /= by[side];
    slip -= by[side] * pair.radius[side] * before.spin[side];
  }
  CollisionStart seen = start;
  seen.psi = slip / start.vn;
  seen.approach = Approach::firstSpin;
  seen.counterSpin = 0.0;
  const auto found = oracle(law, other, seen);
  if (!found) return std::nullopt;
  const PairMotion from = motionBefore(other, seen);
  PairMotion after{
      found->en * start.vn, before.tangential + found->centrePsi * start.vn - from.tangential, {}};
  for (const int side : {0, 1})
    after.spin[side] = before.spin[side] + (found->spin[side] - from.spin[side]) / by[side];
  CollisionEnd end = endOf(pair, start, after);
  end.duration = found->duration;
  return end;
}

/// Of the plane's velocity u along itself the slip has that part only, so it is larger by the rest
/// before and after.
std::optional<CollisionEnd> endOnBelt(const ContactLaw& law, const CollidingPair& pair,
                                      const CollisionStart& start, double u, double part) {
  if (u == 0.0) return oracle(law, pair, start);
  const double lacks = (1.0 - part) * u / start.vn;
  auto end = oracle(law, pair, {start.psi + lacks, start.vn, Approach::firstSpin});
  if (!end) return std::nullopt;
  end->psi -= lacks;
  if (start.approach == Approach::oblique) end->centrePsi += start.psi;
  return end;
}

std::vector<Suspect> suspectsOf(const std::vector<Met>& met) {
  std::vector<Suspect> all;
  const MeetingResult& first = met.front().outcome;
  const auto any = [&](const auto& holds) { return std::ranges::any_of(met, holds); };
  const auto ofLaw = [&](const std::string& name, std::vector<double ContactLaw::*> constants,
                         std::optional<double> factor = {}) {
    const bool has = any([&](const Met& one) {
      return std::ranges::any_of(constants,
                                 [&](auto each) { return one.outcome.law.*each != 0.0; });
    });
    if (!has) return;
    all.push_back({name,
                   [=](const Met& one, const CollisionStart& start, double by) {
                     ContactLaw other = one.outcome.law;
                     for (auto constant : constants) other.*constant *= by;
                     return oracle(other, one.outcome.pair, start);
                   },
                   factor});
  };
  if (met.front().meeting->partner == Partner::plane) {
    all.push_back({"the disk's spin enters the slip with the wrong sign",
                   [](const Met& one, const CollisionStart& start, double) {
                     return endOfSpins(one.outcome.law, one.outcome.pair, start, {-1.0, 1.0});
                   },
                   1.0});
    if (any([](const Met& one) { return one.meeting->wallVelocity.y() != 0.0; }))
      all.push_back({"the plane's motion along itself in the slip",
                     [](const Met& one, const CollisionStart& start, double part) {
                       const double u = one.meeting->wallVelocity.y();
                       return endOnBelt(one.outcome.law, one.outcome.pair, start, u, part);
                     },
                     {},
                     "the plane's motion along itself is not in the slip"});
  }
  all.push_back({"spins enter the slip without their radii",
                 [](const Met& one, const CollisionStart& start, double) {
                   const CollidingPair& pair = one.outcome.pair;
                   const bool wall = !(pair.radius[1] > 0.0);
                   return endOfSpins(one.outcome.law, pair, start,
                                     {1.0 / pair.radius[0], wall ? 1.0 : 1.0 / pair.radius[1]});
                 },
                 1.0});
  if (first.law.normal == NormalLaw::hertz)
    ofLaw("a Hertz law without √R₁₂", {&ContactLaw::kn, &ContactLaw::kt},
          1.0 / std::sqrt(first.pair.reducedRadius()));
  if (first.law.soft())
    for (const auto& [has, name] :
         {std::pair(Tension::cut, "tension is not cut"), {Tension::allow, "tension is cut"}})
      if (any([&](const Met& one) { return one.outcome.law.conventions.tension == has; }))
        all.push_back({name,
                       [has](const Met& one, const CollisionStart& start, double) {
                         ContactLaw other = one.outcome.law;
                         if (other.conventions.tension == has)
                           other.conventions.tension =
                               has == Tension::cut ? Tension::allow : Tension::cut;
                         return oracle(other, one.outcome.pair, start);
                       },
                       1.0});
  ofLaw("µ", {&ContactLaw::mu});
  const auto withInertia = [](const Met& one, const CollisionStart& start, double times) {
    CollidingPair other = one.outcome.pair;
    for (double& inertia : other.inertia) inertia *= times;
    return oracle(one.outcome.law, other, start);
  };
  // Half the torque and twice the moment of inertia are one motion.
  all.push_back({"torque", [=](const Met& one, const CollisionStart& start, double factor) {
                   return withInertia(one, start, 1.0 / factor);
                 }});
  // Of solid disks, by that of the scene.
  const auto asSolid = [](const Met& one) {
    const CollidingPair& pair = one.outcome.pair;
    return solidInertia(pair.mass[0], pair.radius[0]) / pair.inertia[0];
  };
  if (any([&](const Met& one) { return std::abs(asSolid(one) - 1.0) > 1e-9; }))
    all.push_back({"the moment of inertia is ½ m a², whatever the scene says",
                   [=](const Met& one, const CollisionStart& start, double) {
                     return withInertia(one, start, asSolid(one));
                   },
                   1.0});
  if (first.law.soft()) {
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

struct Explanation {
  SubjectCause cause;
  std::string words;  ///< "µ -30 %"
};

/// The one that explains every number of all meetings, sign and size: it leaves less than a scheme
/// may be off, and less than a fifth of what is to be explained; of several, the one that leaves
/// least.
std::optional<Explanation> explain(const std::vector<Met>& met) {
  const std::vector<Quantity> all = quantities(friction, firstOrder);
  // @param most  what is beyond it need not be known
  const auto leftOf = [&](const Met& one, const Suspect::End& end, double factor, double most) {
    double worst = 0.0;
    for (std::size_t k = 0; k < one.outcome.ends.size() && worst <= most; ++k)
      if (const auto& found = one.outcome.ends[k])
        worst = std::max(worst, misfit(*found, end(one, one.meeting->starts[k], factor), all));
    return worst;
  };
  // Where most is to be explained a suspect is found wrong soonest.
  std::vector<std::pair<double, const Met*>> order;
  const auto right = [](const Met& one, const CollisionStart& start, double) {
    return oracle(one.outcome.law, one.outcome.pair, start);
  };
  for (const Met& one : met)
    order.emplace_back(leftOf(one, right, 1.0, std::numeric_limits<double>::infinity()), &one);
  std::ranges::sort(order, std::greater(), [](const auto& one) { return one.first; });
  const double off = order.front().first;
  if (off <= 1.0) return std::nullopt;
  const auto left = [&](const Suspect::End& end, double factor, double most) {
    double worst = 0.0;
    for (const auto& [size, one] : order)
      if (worst <= most) worst = std::max(worst, leftOf(*one, end, factor, most));
    return worst;
  };
  std::optional<Explanation> best;
  double least = std::min(1.0, explainedLeaves * off);
  for (const Suspect& suspect : suspectsOf(met)) {
    double factor = suspect.factor.value_or(0.0);
    double rest =
        suspect.factor || !suspect.without.empty() ? left(suspect.end, factor, least) : off;
    const bool without = !suspect.factor && rest <= least;  // then a part of it is as good
    if (!suspect.factor && !without) {
      rest = off;
      factor = 1.0;
      const auto attempt = [&](double by) {
        const double now = left(suspect.end, by, rest);
        if (!(now < 0.9 * rest)) return false;  // where it has no bearing, no amount is another
        rest = now;
        factor = by;
        return true;
      };
      for (const double by : {0.0, 0.25, 0.5, 0.75, 0.9, 1.1, 1.25, 1.5, 2.0, -1.0}) attempt(by);
      for (double width = 0.125; width > 2e-3; width *= 0.5)
        if (!attempt(factor + width)) attempt(factor - width);
    }
    // Of two that come to the same, as no friction and no spring to have it, the first.
    if (!(rest <= (best ? 0.99 * least : least))) continue;
    least = rest;
    best = {{suspect.name, suspect.factor ? 0.0 : factor - 1.0},
            without          ? suspect.without
            : suspect.factor ? suspect.name
                             : text(suspect.name, percentOf(factor - 1.0))};
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

/// @returns whether there was any reference
bool expectEnds(CheckContext& context, const Meeting& meeting, const MeetingResult& outcome,
                const Ends& wanted, const std::vector<Quantity>& all, const std::string& name,
                const Rounded& rounded = {}) {
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
      if (!is || !should) continue;
      const double apart = std::max(wanted[k]->en, 1e-3) * start.vn;  // slow ones fly for long
      const double by = quantity.isTime ? rounded.way / apart : rounded.speeds;
      context.near(*is, *should, wider(quantity.allowed, by, std::abs(*should)),
                   where + quantity.name);
    }
  }
  return any;
}

/// The outcome as it would be if what came of its scheme's steps were what comes of small ones;
/// what has no limit of small steps is left out.
/// @param inSteps  what a right engine does in such steps
MeetingResult withoutTruncation(MeetingResult found, const Meeting& meeting, const Ends& inSteps) {
  const Ends right = oracleEnds(found.law, found.pair, meeting.starts);
  for (std::size_t k = 0; k < right.size(); ++k) {
    auto& end = found.ends[k];
    if (!end) continue;
    if (!right[k] || (!inSteps.empty() && !inSteps[k])) {
      end.reset();
      continue;
    }
    if (inSteps.empty()) continue;
    const CollisionEnd& was = *inSteps[k];
    end->en += right[k]->en - was.en;
    end->psi += right[k]->psi - was.psi;
    end->centrePsi += right[k]->centrePsi - was.centrePsi;
    if (end->duration && was.duration) *end->duration += *right[k]->duration - *was.duration;
  }
  return found;
}

/// Ends of the meeting in the in-house engine, with the law and steps that another engine ran.
Ends inHouseEnds(const Scene& mirrored, const Meeting& meeting, const MeetingResult& outcome) {
  const auto mirror = engineRegistry().front().make();
  mirror->load(mirrored, {});
  return endsOf(*mirror, meeting, outcome.whole, outcome.time);
}

}  // namespace

std::optional<MeetingResult> meet(CheckContext& context, const Meeting& meeting, std::string* why) {
  const Case setup = setupOf(context, meeting);
  const CollidingPair pair = collidingPair(setup);
  Scene whole = collisionScene(setup, meeting.starts, emptyScene(meeting.law, meeting.steps).dt);
  const Scene scene =
      shifted(meeting.partner == Partner::wallDisk ? withPosts<2>(whole) : whole, meeting.place);
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
  const double time = meeting.flight * whole.dt + 2.5 * longest + 20.0 * context.effective.dt;
  MeetingResult outcome{*law, pair, std::move(whole), {}, time};
  outcome.ends = endsOf(context.engine, meeting, outcome.whole, time);
  return outcome;
}

namespace {

Rounded roundedOf(const CheckContext& context, const Meeting& meeting,
                  const MeetingResult& outcome) {
  Rounded rounded;
  if (!context.single() || !outcome.law.soft()) return rounded;
  const double place = farthestPlace(context.scene);
  const double dt = context.effective.dt;
  for (const CollisionStart& start : meeting.starts) {
    const Impact impact{outcome.pair.reducedMass(), outcome.pair.reducedRadius(), start.vn};
    const double contact = impactTime(outcome.law, impact);
    const double walk = roundedInContact(context.can, place, contact / dt);
    rounded.speeds = std::max(rounded.speeds, walk / deepestOverlap(outcome.law, impact));
    rounded.way = std::max(
        rounded.way, 2.0 * roundedInFlight(context.can, place, (outcome.time - contact) / dt));
  }
  return rounded;
}

}  // namespace

bool Evidence::expectTheOracle(CheckContext& context, const Meeting& meeting,
                               const MeetingResult& outcome, const std::string& name) {
  Ends wanted = oracleEnds(outcome.law, outcome.pair, meeting.starts);
  Scene mirrored = context.mirrored(outcome.law);
  // Conventions without a limit of small steps are compared with the in-house engine that has
  // them; that one with nothing.
  if (!context.inHouse() && outcome.law.soft() &&
      !std::ranges::all_of(wanted, [](const auto& end) { return end.has_value(); })) {
    const Ends theirs = inHouseEnds(mirrored, meeting, outcome);
    for (std::size_t k = 0; k < wanted.size(); ++k)
      if (!wanted[k]) wanted[k] = theirs[k];
  }
  const std::size_t before = context.faults.size();
  const bool any = expectEnds(context, meeting, outcome, wanted, quantities(friction, firstOrder),
                              name, roundedOf(context, meeting, outcome));
  if (context.faults.size() > before && !firstWrong_) firstWrong_ = all_.size();
  all_.push_back({meeting, outcome, std::move(mirrored)});
  return any;
}

void Evidence::explain(CheckContext& context) const {
  if (!firstWrong_) return;
  context.lawIsOff = true;
  std::vector<Met> met;
  for (const One& one : all_) {
    const bool steps = !context.inHouse() && one.outcome.law.soft();
    const Ends inSteps = steps ? inHouseEnds(one.mirrored, one.meeting, one.outcome) : Ends();
    met.push_back({&one.meeting, withoutTruncation(one.outcome, one.meeting, inSteps)});
    const Ends right = oracleEnds(one.outcome.law, one.outcome.pair, one.meeting.starts);
    for (std::size_t k = 0; k < right.size(); ++k)
      if (right[k] && !one.outcome.ends[k]) return;  // no constant is why they do not part
  }
  const auto found = conformance::explain(met);
  if (!found) return;
  context.subjectCauses.push_back(found->cause);
  context.suspect(text(found->words, ", ", placeOf(all_[*firstWrong_].meeting)));
}

void expectTheSame(CheckContext& context, const Meeting& meeting, const MeetingResult& outcome,
                   const MeetingResult& wanted, const Tolerance& psi, const std::string& when) {
  const std::size_t before = context.faults.size();
  expectEnds(context, meeting, outcome, wanted.ends, quantities(psi, {0.0, psi.absolute, psi.why}),
             when.substr(when.find_first_not_of(", ")));
  if (context.faults.size() == before || context.cause) return;
  const auto found = explain({{&meeting, withoutTruncation(outcome, meeting, wanted.ends)}});
  if (found) context.suspect(text(found->words, ", ", placeOf(meeting), when));
}

}  // namespace crossgrain::conformance
