#include <fmt/format.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>

#include "adapters/law_options.hpp"
#include "oracle/collision_oracle.hpp"
#include "oracle/impact.hpp"

namespace crossgrain::inline oracle {
namespace {

constexpr std::size_t numbers = 15;

/// Position and velocity of i against j (of a plane: against the point that is touched first), both
/// spins, ξ; while the contact slips with a spring ξ's direction e instead, of length 1.
struct State {
  std::array<double, numbers> y{};

  auto at(int first) { return Eigen::Map<Vec3>(y.data() + first); }
  Vec3 at(int first) const { return Eigen::Map<const Vec3>(y.data() + first); }
  Vec3 position() const { return at(0); }
  Vec3 velocity() const { return at(3); }
  Vec3 spin(int side) const { return at(6 + 3 * side); }
  Vec3 spring() const { return at(12); }
};

struct Kinematics {
  Vec3 normal, turning;                      ///< n, dn/dt [1/s]
  double distance, overlap, normalVelocity;  ///< [m], δ [m], v_n [m/s]
  Vec3 slip;                                 ///< v_t [m/s]
};

enum class Phase {
  free,          ///< no bound, no force: ξ = 0
  sticks,        ///< f_t = −k_t ξ − γ_t v_t
  slidesSpring,  ///< f_t = −bound e, de/dt = k_t (v_t − (v_t·e) e)/bound: no dashpot
  slides         ///< f_t = −bound v_t/|v_t|: each step of a law with a dashpot turns f_t so
};

/// The collision of two spheres, or of a sphere and a plane, in space and in continuous time.
/// docs/dimensions.md, section 4, has the equations. A linear law with constant dampers.
class TwoSpheres {
 public:
  TwoSpheres(const ContactLaw& law, const CollidingPair& pair)
      : law_(law),
        pair_(pair),
        reach_(pair.radius[0] + pair.radius[1]),
        springs_(law.friction() && law.springs()),
        kt_(springs_ ? law.kt : 0.0),
        gt_(springs_ && law.dashpots() ? law.gt : 0.0) {}

  CollisionEnd solve(const CollisionStart& start);

 private:
  Kinematics kinematics(const State& s) const;
  double trialNormal(const Kinematics& k) const {
    return law_.kn * k.overlap - law_.gn * k.normalVelocity;
  }
  double normalForce(const Kinematics& k) const {
    return law_.conventions.tension == Tension::cut && !presses_ ? 0.0 : trialNormal(k);
  }
  double normalRate(const Kinematics& k) const;
  bool hasBound() const {
    return law_.friction() &&
           (presses_ || (law_.conventions.coulombBound == CoulombBound::magnitude &&
                         law_.conventions.tension == Tension::allow));
  }
  double bound(const Kinematics& k) const {
    return hasBound() ? law_.mu * std::abs(normalForce(k)) : 0.0;
  }
  double boundRate(const Kinematics& k) const {
    return hasBound() ? std::copysign(law_.mu, normalForce(k)) * normalRate(k) : 0.0;
  }
  double arm(LeverArm of, const Kinematics& k, int side) const {
    return pair_.radius[side] -
           leverFraction(of, law_.conventions.planeArm, pair_, side) * k.overlap;
  }
  Vec3 heldForce(const State& s, const Kinematics& k) const {
    return -kt_ * s.spring() - gt_ * k.slip;
  }
  Vec3 tangentialForce(const State& s, const Kinematics& k) const;
  State derivative(const State& s) const;

  bool lasts(const State& s) const;
  void choosePhase(State& s);
  void begin(State& s);
  void slipFrom(State& s);
  void stopSliding(State& s);
  State firstTouch(const CollisionStart& start) const;
  static int rightHandSide(double, const double y[], double dydt[], void* self);

  ContactLaw law_;
  CollidingPair pair_;
  double reach_;
  bool springs_;
  double kt_, gt_;
  bool presses_ = true;  ///< the elastic force with its dashpot is > 0
  Phase phase_ = Phase::free;
  Vec3 slipBefore_ = Vec3::Zero();  ///< direction of v_t when this step began
  std::optional<Vec3> slowing_;     ///< the same when a slide was down to a hundredth of its speed
  double still_ = 0.0;              ///< a slip that is none [m/s]
};

Kinematics TwoSpheres::kinematics(const State& s) const {
  Kinematics k;
  const Vec3 x = s.position(), v = s.velocity();
  k.distance = pair_.plane ? x.x() : x.norm();
  k.normal = pair_.plane ? Vec3::UnitX() : Vec3(x / k.distance);
  k.overlap = reach_ - k.distance;
  k.normalVelocity = v.dot(k.normal);
  const Vec3 aside = v - k.normalVelocity * k.normal;
  k.turning = pair_.plane ? Vec3::Zero() : Vec3(aside / k.distance);
  const LeverArm of = law_.conventions.armOfVelocity();
  k.slip = aside - (arm(of, k, 0) * s.spin(0) + arm(of, k, 1) * s.spin(1)).cross(k.normal);
  return k;
}

/// df_n/dt, with dv_n/dt = f_n/m₁₂ + v·dn/dt.
double TwoSpheres::normalRate(const Kinematics& k) const {
  if (law_.conventions.tension == Tension::cut && !presses_) return 0.0;
  const double acceleration =
      normalForce(k) / pair_.reducedMass() + k.distance * k.turning.squaredNorm();
  return -law_.kn * k.normalVelocity - law_.gn * acceleration;
}

Vec3 TwoSpheres::tangentialForce(const State& s, const Kinematics& k) const {
  switch (phase_) {
    case Phase::free:
      break;
    case Phase::sticks:
      return heldForce(s, k);
    case Phase::slidesSpring:
      return -bound(k) * s.spring();
    case Phase::slides:
      return -bound(k) * k.slip.normalized();
  }
  return Vec3::Zero();
}

State TwoSpheres::derivative(const State& s) const {
  const Kinematics k = kinematics(s);
  const Vec3 force = tangentialForce(s, k);
  const Vec3 couple = k.normal.cross(force);
  State rate;
  rate.at(0) = s.velocity();
  rate.at(3) = (normalForce(k) * k.normal + force) / pair_.reducedMass();
  for (const int side : {0, 1})
    rate.at(6 + 3 * side) = -arm(law_.conventions.leverArm, k, side) / pair_.inertia[side] * couple;
  if (phase_ != Phase::sticks && phase_ != Phase::slidesSpring) return rate;
  // Parallel transport along n(t), and the turn about n.
  const Vec3 spring = s.spring();
  Vec3 turned = -spring.dot(k.turning) * k.normal;
  if (law_.conventions.springTwist == SpringTwist::meanSpin)
    turned += 0.5 * (s.spin(0) + s.spin(1)).dot(k.normal) * k.normal.cross(spring);
  if (phase_ == Phase::sticks) {
    rate.at(12) = turned + k.slip;
  } else {
    const double holds = bound(k);
    const Vec3 pulled = k.slip - k.slip.dot(spring) * spring;
    rate.at(12) = turned + (holds > 0.0 ? Vec3(kt_ / holds * pulled) : Vec3::Zero());
  }
  return rate;
}

int TwoSpheres::rightHandSide(double, const double y[], double dydt[], void* self) {
  State s;
  std::copy_n(y, numbers, s.y.begin());
  std::ranges::copy(static_cast<const TwoSpheres*>(self)->derivative(s).y, dydt);
  return GSL_SUCCESS;
}

/// Whether no event has come: the bodies part, f_n changes its sign, f_t meets its bound, ξ is
/// pulled back faster than its bound falls, v_t comes to rest.
bool TwoSpheres::lasts(const State& s) const {
  const Kinematics k = kinematics(s);
  if (k.normalVelocity > 0.0 && !(k.overlap > 0.0)) return false;
  if (law_.gn > 0.0 && presses_ != (trialNormal(k) > 0.0)) return false;
  switch (phase_) {
    case Phase::free:
      break;
    case Phase::sticks:
      return heldForce(s, k).norm() <= bound(k);
    case Phase::slidesSpring:
      return kt_ * k.slip.dot(s.spring()) > boundRate(k);
    case Phase::slides:
      return k.slip.dot(slipBefore_) > still_;
  }
  return true;
}

/// Where nothing is stretched, at the first touch and where a bound comes back.
void TwoSpheres::begin(State& s) {
  const Kinematics k = kinematics(s);
  const double held = heldForce(s, k).norm(), holds = bound(k);
  const bool slips = held > holds || (held == holds && kt_ * k.slip.norm() > boundRate(k));
  phase_ = !slips ? Phase::sticks : gt_ > 0.0 ? Phase::slides : Phase::slidesSpring;
  if (phase_ == Phase::slidesSpring) s.at(12) = k.slip.normalized();
}

/// f* is beyond the bound. With a dashpot each step of the law makes f := bound·f/|f| and tries
/// f − γ_t v_t next: it comes to stick again where v_t is along f, else to −bound v_t/|v_t|.
void TwoSpheres::slipFrom(State& s) {
  const Kinematics k = kinematics(s);
  if (gt_ == 0.0) {
    phase_ = Phase::slidesSpring;
    s.at(12).normalize();
    return;
  }
  const double holds = bound(k);
  Vec3 trial = heldForce(s, k);
  phase_ = Phase::slides;
  constexpr int mostSteps = 100000;
  for (int step = 0; step < mostSteps; ++step) {
    const Vec3 force = holds * trial.normalized();
    trial = force - gt_ * k.slip;
    if (trial.norm() <= holds) {
      phase_ = Phase::sticks;
      s.at(12) = -force / kt_;
      return;
    }
    if ((force / holds + k.slip.normalized()).norm() < 1e-15) return;
  }
}

/// ξ holds the bound from now on.
void TwoSpheres::stopSliding(State& s) {
  const Kinematics k = kinematics(s);
  const Vec3 along = phase_ == Phase::slides ? slipBefore_ : s.spring();
  const bool dashpot = phase_ == Phase::slides;
  if (dashpot && slowing_ && along.cross(*slowing_).norm() > 1e-3)
    throw std::invalid_argument(
        "no limit of small time steps: a slip whose force is along it turns on as it comes to "
        "rest, "
        "however slow it is");
  phase_ = Phase::sticks;
  s.at(12) = bound(k) / kt_ * (along - along.dot(k.normal) * k.normal).normalized();
  if (!dashpot) return;
  // v_t = 0, and |f*| falls by γ_t dv_t/dt. Where the bound falls faster the length of steps
  // decides (CollisionEnd::noLimit). What n turns in that time is not counted.
  const State rate = derivative(s);
  Vec3 pulled = rate.at(3);
  for (const int side : {0, 1})
    pulled -=
        (arm(law_.conventions.armOfVelocity(), k, side) * rate.at(6 + 3 * side)).cross(k.normal);
  if (boundRate(k) < gt_ * pulled.dot(along))
    throw std::invalid_argument(
        "no limit of small time steps: a slip ends while its bound falls faster than the dashpot "
        "relaxes");
}

void TwoSpheres::choosePhase(State& s) {
  const bool pressed = presses_;
  const Kinematics k = kinematics(s);
  if (law_.gn > 0.0) presses_ = trialNormal(k) > 0.0;
  if (!springs_) return;
  if (presses_ != pressed || phase_ == Phase::free) {
    s.at(12).setZero();
    phase_ = Phase::free;
    if (hasBound()) begin(s);
  } else if (phase_ == Phase::sticks) {
    slipFrom(s);
  } else {
    stopSliding(s);
  }
}

State TwoSpheres::firstTouch(const CollisionStart& start) const {
  const SpaceMotion motion = spaceMotionBefore(pair_, start);
  State state;
  state.at(0) = reach_ * Vec3::UnitX() + start.late * motion.velocity;
  state.at(3) = motion.velocity;
  for (const int side : {0, 1}) state.at(6 + 3 * side) = motion.spin[side];
  if (start.late == 0.0 || !springs_) return state;
  const SpringUpdate update = law_.conventions.springUpdate;
  const double share = update == SpringUpdate::after    ? 0.0
                       : update == SpringUpdate::before ? 1.0
                                                        : 0.5;
  state.at(12) = share * start.late * kinematics(state).slip;
  return state;
}

CollisionEnd TwoSpheres::solve(const CollisionStart& start) {
  const double contactTime =
      impactTime(law_, {pair_.reducedMass(), pair_.reducedRadius(), start.vn});
  gsl_odeiv2_system system{&rightHandSide, nullptr, numbers, this};
  const std::unique_ptr<gsl_odeiv2_step, decltype(&gsl_odeiv2_step_free)> stepper(
      gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, numbers), &gsl_odeiv2_step_free);

  State now = firstTouch(start);
  const double slip = kinematics(now).slip.norm(), speed = start.vn + slip;
  still_ = 1e-13 * speed;
  presses_ = law_.gn == 0.0 || trialNormal(kinematics(now)) > 0.0;
  if (springs_ && hasBound()) begin(now);

  const double largestForce = pair_.reducedMass() * speed / contactTime;
  std::array<double, numbers> error{};
  const auto stepFrom = [&](const State& from, double h) {
    State to = from;
    gsl_odeiv2_step_reset(stepper.get());
    gsl_odeiv2_step_apply(stepper.get(), 0.0, h, to.y.data(), error.data(), nullptr, nullptr,
                          &system);
    return to;
  };
  /// The last step's, in units of what is there.
  const auto errorOfStep = [&] {
    const auto part = [&](int first) {
      return Eigen::Map<const Vec3>(error.data() + first).norm();
    };
    // A direction counts by the force that has it.
    const double spring = phase_ == Phase::slidesSpring
                              ? largestForce / (bound(kinematics(now)) + 1e-9 * largestForce)
                              : speed * contactTime;
    return part(3) / speed + reach_ * (part(6) + part(9)) / speed + part(12) / spring;
  };
  const auto timeOf = [&](const auto& holds, const State& from, double h) {
    double before = 0.0, after = h;
    while (after - before > 1e-16 * contactTime && after - before > 1e-15 * after) {
      const double middle = 0.5 * (before + after);
      (holds(stepFrom(from, middle)) ? before : after) = middle;
    }
    return after;
  };
  const auto phaseLasts = [this](const State& s) { return lasts(s); };
  const auto approaches = [this](const State& s) { return kinematics(s).normalVelocity < 0.0; };

  // Steps of t_c/400 leave an error below rounding, as in the plane; beside a bound of 0 and a slip
  // of 0, where directions turn fast, they shrink until they do.
  const double fullStep = contactTime / 400.0, shortest = 1e-10 * fullStep;
  // What a rounded distance makes of v, and of a spin by up to K times as much, in a step.
  const double rounding =
      8.0 * std::numeric_limits<double>::epsilon() * reach_ * law_.kn / pair_.reducedMass() / speed;
  const auto allowed = [&](double h) { return 1e-14 + h * rounding; };
  constexpr int mostSteps = 100000;
  double wanted = fullStep, duration = 0.0, maxOverlap = 0.0;
  for (int step = 0; step < mostSteps; ++step) {
    const Vec3 slipping = kinematics(now).slip;
    slipBefore_ = slipping.normalized();
    if (phase_ != Phase::slides)
      slowing_.reset();
    else if (!slowing_ && slipping.norm() < 0.01 * speed)
      slowing_ = slipBefore_;
    double h = wanted;
    State next = stepFrom(now, h);
    const double found = errorOfStep();
    if (found > allowed(h) && h > shortest) {
      wanted = 0.5 * h;
      continue;
    }
    wanted = std::min(fullStep, found < 0.01 * allowed(h) ? 2.0 * h : h);
    const bool early = !lasts(stepFrom(now, 0.5 * h));  // it may be back by the end
    const bool event = early || !lasts(next);
    if (event) {
      h = timeOf(phaseLasts, now, early ? 0.5 * h : h);
      next = stepFrom(now, h);
    }
    if (approaches(now) && !approaches(next))
      maxOverlap = kinematics(stepFrom(now, timeOf(approaches, now, h))).overlap;
    duration += h;
    now = next;
    if (phase_ == Phase::slidesSpring) now.at(12).normalize();
    if (!event) continue;
    const Kinematics k = kinematics(now);
    if (k.normalVelocity > 0.0 && k.overlap <= 1e-14 * reach_) {
      CollisionEnd end =
          spaceEndOf(pair_, start, {k.normal, now.velocity(), {now.spin(0), now.spin(1)}});
      end.duration = duration;
      end.maxOverlap = maxOverlap;
      return end;
    }
    choosePhase(now);
    wanted = fullStep;
  }
  throw std::invalid_argument(
      fmt::format("the spheres have not parted after {} steps of the oracle, {:.3g} contact times",
                  mostSteps, duration / contactTime));
}

/// @throws std::invalid_argument naming what there is no oracle of in space
void requireKnown(const ContactLaw& law) {
  const LawConventions& how = law.conventions;
  const auto demand = [&](bool known, const char* option) {
    if (!known)
      throw std::invalid_argument(fmt::format("{} = \"{}\": there is no oracle of it in space",
                                              option, lawOptionValue(law, option)));
  };
  demand(law.normal == NormalLaw::linear, "normal");
  demand(law.damper == Damper::constant || (law.gn == 0.0 && law.gt == 0.0), "damper");
  demand(!law.rolls(), "rolling");
  demand(!law.coheres(), "cohesion");
  if (!law.friction()) return;
  demand(law.springs(), "tangential");
  demand(how.coulombBound != CoulombBound::signedForce, "coulomb_bound");
  if (!law.dashpots() || law.gt == 0.0) return;
  demand(how.dashpot == Dashpot::inside, "dashpot");
  demand(how.springReset == SpringReset::total, "spring_reset");
}

}  // namespace

CollisionEnd spaceOutcome(const ContactLaw& law, const CollidingPair& pair,
                          const CollisionStart& start) {
  if (!law.soft()) return rigidOutcomeInSpace(law, pair, start);
  requireKnown(law);
  return TwoSpheres(law, pair).solve(start);
}

}  // namespace crossgrain::inline oracle
