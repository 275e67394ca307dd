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
#include <utility>

#include "law/law_options.hpp"
#include "oracle/collision_oracle.hpp"
#include "oracle/contact_forces.hpp"

namespace crossgrain::inline oracle {
namespace {

constexpr std::size_t numbers = 15;

/// Position and velocity of i against j (of a plane: against the point that is touched first), both
/// spins, what the tangential spring remembers (ξ, or its force with the sign of ξ); while the
/// contact slips with a spring that direction e instead, of length 1.
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
  double twist;                              ///< turn rate of ξ about n, spring_twist [rad/s]
};

enum class Phase {
  free,          ///< no bound, no force: nothing is remembered
  damped,        ///< f_t = −γ_t v_t
  sticks,        ///< f_t = −k_t ξ − γ_t v_t
  slidesSpring,  ///< f_t = −bound e, with e of pulled()
  slides,  ///< f_t = −bound v_t/|v_t|: no spring, or a reset that leaves v_t's dashpot outside
  holds    ///< Coulomb's law at v_t = 0: the force that keeps it there
};

/// The collision of two spheres, or of a sphere and a plane, in space and in continuous time.
/// docs/dimensions.md, section 4, has the equations. Soft laws without rolling and cohesion.
class TwoSpheres : private ContactForces {
 public:
  TwoSpheres(const ContactLaw& law, const CollidingPair& pair) : ContactForces(law, pair) {}

  CollisionEnd solve(const CollisionStart& start);

 private:
  Kinematics kinematics(const State& s) const;
  double trialNormal(const Kinematics& k) const {
    return elasticForce(k.overlap) - normalDamping(k.overlap).value * k.normalVelocity;
  }
  double normalForce(const Kinematics& k) const {
    return law_.conventions.tension == Tension::cut && !presses_ ? 0.0 : trialNormal(k);
  }
  double normalRate(const Kinematics& k) const;
  bool slippery() const { return law_.tangential == TangentialLaw::none; }
  bool hasBound() const {
    return !slippery() && (presses_ || (law_.conventions.coulombBound == CoulombBound::magnitude &&
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
  double velocityArm(const Kinematics& k, int side) const {
    return arm(law_.conventions.armOfVelocity(), k, side);
  }
  Vec3 heldForce(const State& s, const Kinematics& k) const {
    return -springUnit(k.overlap) * s.spring() - tangentialDamping(k.overlap).value * k.slip;
  }
  /// Whether a slip resets the spring to all of the force and has a dashpot besides.
  bool dashpotAlone() const {
    return law_.gt > 0.0 && law_.conventions.springReset == SpringReset::total;
  }
  Vec3 holdingForce(const State& s, const Kinematics& k) const;
  Vec3 tangentialForce(const State& s, const Kinematics& k) const;
  State motion(const State& s, const Kinematics& k, const Vec3& force) const;
  Vec3 slipRate(const State& s, const Kinematics& k, const State& rate) const;
  Vec3 transported(const Vec3& spring, const Kinematics& k) const {
    return -spring.dot(k.turning) * k.normal + k.twist * k.normal.cross(spring);
  }
  State derivative(const State& s) const;

  /// Rates at which a tested force at its bound grows, in the frame that ξ turns with.
  struct Pull {
    Vec3 spring;        ///< by stretching, k_t v_t [N/s]
    Vec3 dashpot;       ///< d(γ_t v_t)/dt [N/s]
    double stiffening;  ///< along e, of a spring that keeps ξ while k_t changes [N/s]
  };
  Pull pulled(const State& s, const Kinematics& k, const State& rate) const;
  double growth(const Pull& pull, const Vec3& along) const;
  double shareOfStretching(const Pull& pull, const Vec3& along, double boundGrows) const;

  bool lasts(const State& s) const;
  void choosePhase(State& s);
  void begin(State& s);
  void setSlip(State& s, const Kinematics& k, const Vec3& slip) const;
  void slipFrom(State& s);
  void stopSliding(State& s);
  State firstTouch(const CollisionStart& start, double contactTime) const;
  static int rightHandSide(double, const double y[], double dydt[], void* self);

  bool presses_ = true;  ///< the elastic force with its dashpot is > 0
  Phase phase_ = Phase::free;
  /// Direction of v_t when this step began; of a v_t below 1e-6 of the speed the last one, as that
  /// of the last bits is rounding.
  Vec3 slipBefore_ = Vec3::Zero();
  std::optional<Vec3> slowing_;  ///< the same when a slide was down to a hundredth of its speed
  double still_ = 0.0;           ///< a slip that is none [m/s]
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
  k.slip = aside - (velocityArm(k, 0) * s.spin(0) + velocityArm(k, 1) * s.spin(1)).cross(k.normal);
  k.twist = law_.conventions.springTwist == SpringTwist::meanSpin
                ? 0.5 * (s.spin(0) + s.spin(1)).dot(k.normal)
                : 0.0;
  return k;
}

/// df_n/dt, with dδ/dt = −v_n and dv_n/dt = f_n/m₁₂ + v·dn/dt.
double TwoSpheres::normalRate(const Kinematics& k) const {
  if (law_.conventions.tension == Tension::cut && !presses_) return 0.0;
  const double acceleration = normalForce(k) * inverseMass_ + k.distance * k.turning.squaredNorm();
  const Slope damping = normalDamping(k.overlap);
  return (damping.rate * k.normalVelocity - stiffness(k.overlap).value) * k.normalVelocity -
         damping.value * acceleration;
}

/// The f_t under which v_t stays as it is: dv_t/dt is linear in f_t, and of the same slope in all
/// directions of the tangent plane.
Vec3 TwoSpheres::holdingForce(const State& s, const Kinematics& k) const {
  double compliance = inverseMass_;
  for (const int side : {0, 1})
    compliance +=
        velocityArm(k, side) * arm(law_.conventions.leverArm, k, side) / pair_.inertia[side];
  return -slipRate(s, k, motion(s, k, Vec3::Zero())) / compliance;
}

/// e of a slip. Beside a bound of 0 it turns at any rate, and within a step its length goes astray:
/// were that a part of its rate, the more the longer it is.
Vec3 directionOf(const State& s) {
  return s.spring().normalized();
}

Vec3 TwoSpheres::tangentialForce(const State& s, const Kinematics& k) const {
  switch (phase_) {
    case Phase::free:
      break;
    case Phase::damped:
      return -tangentialDamping(k.overlap).value * k.slip;
    case Phase::sticks:
      return heldForce(s, k);
    case Phase::slidesSpring:
      return -bound(k) * directionOf(s);
    case Phase::slides:
      return -bound(k) * k.slip.normalized();
    case Phase::holds:
      return holdingForce(s, k);
  }
  return Vec3::Zero();
}

/// Rates of position, velocity and spins.
State TwoSpheres::motion(const State& s, const Kinematics& k, const Vec3& force) const {
  const Vec3 couple = k.normal.cross(force);
  State rate;
  rate.at(0) = s.velocity();
  rate.at(3) = (normalForce(k) * k.normal + force) * inverseMass_;
  for (const int side : {0, 1})
    rate.at(6 + 3 * side) = -arm(law_.conventions.leverArm, k, side) / pair_.inertia[side] * couple;
  return rate;
}

/// dv_t/dt in the tangent plane, of v_t = v − (v·n) n − (Σ c ω) × n with dc/dt = v_n times the part
/// of δ that c is short of its radius.
Vec3 TwoSpheres::slipRate(const State& s, const Kinematics& k, const State& rate) const {
  const LawConventions& how = law_.conventions;
  Vec3 arms = Vec3::Zero(), changes = Vec3::Zero();
  for (const int side : {0, 1}) {
    const double c = velocityArm(k, side);
    const double grows =
        leverFraction(how.armOfVelocity(), how.planeArm, pair_, side) * k.normalVelocity;
    arms += c * s.spin(side);
    changes += c * rate.spin(side) + grows * s.spin(side);
  }
  const Vec3 all = rate.velocity() - k.normalVelocity * k.turning - changes.cross(k.normal) -
                   arms.cross(k.turning);
  return all - all.dot(k.normal) * k.normal;
}

/// Has no meaning with spring_reset = "total" and a dashpot: such a slip has no e of its own.
TwoSpheres::Pull TwoSpheres::pulled(const State& s, const Kinematics& k, const State& rate) const {
  const Slope kt = tangentialStiffness(k.overlap), gt = tangentialDamping(k.overlap);
  Pull pull{kt.value * k.slip, Vec3::Zero(), 0.0};
  if (law_.gt > 0.0)
    pull.dashpot = gt.value * (slipRate(s, k, rate) - k.twist * k.normal.cross(k.slip)) -
                   gt.rate * k.normalVelocity * k.slip;
  if (!remembersForce() && kt.rate != 0.0)
    pull.stiffening = -bound(k) * kt.rate / kt.value * k.normalVelocity;
  return pull;
}

/// The rate at which the tested force of a slip along e grows before the law resets it. A law that
/// stretches its spring only after a step that sticks (SpringUpdate::after) does not see v_t in the
/// step after a slip, so no v_t relaxes it there (TwoBodyProblem::slipGuard()).
double TwoSpheres::growth(const Pull& pull, const Vec3& along) const {
  double stretching = pull.spring.dot(along);
  if (law_.conventions.springUpdate == SpringUpdate::after) stretching = std::max(stretching, 0.0);
  return stretching + pull.dashpot.dot(along) + pull.stiffening;
}

/// The share of steps that stretch the spring of a contact that slips along e. All of them, unless
/// the law stretches only after a step that sticks. With S = k_t v_t·e, and x = dbound/dt less the
/// other rates at which the tested force grows, a slip leaves it at its bound, and m steps later it
/// has grown by (m − 1) S dt against a bound that has by m x dt. So where x ≤ 0 every step slips,
/// and e keeps its direction whichever way v_t turns: the spring is never stretched. Where 0 < x <
/// S one step slips and m stick in turn, with the smallest m that has m S > (m + 1) x, and the
/// share is m/(m + 1), from ½ where S > 2x.
double TwoSpheres::shareOfStretching(const Pull& pull, const Vec3& along, double boundGrows) const {
  if (law_.conventions.springUpdate != SpringUpdate::after) return 1.0;
  const double stretching = pull.spring.dot(along);
  const double x = boundGrows - pull.dashpot.dot(along) - pull.stiffening;
  if (x <= 0.0) return 0.0;
  if (stretching <= x) return 1.0;
  const double stuck = std::floor(x / (stretching - x)) + 1.0;
  return stuck / (stuck + 1.0);
}

State TwoSpheres::derivative(const State& s) const {
  const Kinematics k = kinematics(s);
  State rate = motion(s, k, tangentialForce(s, k));
  const Vec3 spring = s.spring();
  if (phase_ == Phase::sticks) {
    rate.at(12) = transported(spring, k) +
                  (remembersForce() ? tangentialStiffness(k.overlap).value : 1.0) * k.slip;
  } else if (phase_ == Phase::slidesSpring) {
    rate.at(12) = transported(spring, k);
    const double holds = bound(k);
    if (!(holds > 0.0)) return rate;
    const Pull pull = pulled(s, k, rate);
    const Vec3 along = directionOf(s);
    const Vec3 turns = shareOfStretching(pull, along, boundRate(k)) * pull.spring + pull.dashpot;
    rate.at(12) += (turns - turns.dot(along) * along) / holds;
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
    case Phase::damped:
      return tangentialDamping(k.overlap).value * k.slip.norm() <= bound(k);
    case Phase::sticks:
      return heldForce(s, k).norm() <= bound(k);
    case Phase::holds:
      return holdingForce(s, k).norm() <= bound(k);
    case Phase::slidesSpring:
      return growth(pulled(s, k, derivative(s)), directionOf(s)) > boundRate(k);
    case Phase::slides:
      if (law_.tangential == TangentialLaw::viscous)
        return tangentialDamping(k.overlap).value * k.slip.norm() > bound(k);
      return k.slip.dot(slipBefore_) > still_;
  }
  return true;
}

/// Gives the first body a spin that makes v_t what it is to be.
void TwoSpheres::setSlip(State& s, const Kinematics& k, const Vec3& slip) const {
  s.at(6) += k.normal.cross(k.slip - slip) / velocityArm(k, 0);
}

/// Where nothing is stretched, at the first touch and where a bound comes back.
void TwoSpheres::begin(State& s) {
  const Kinematics k = kinematics(s);
  const double holds = bound(k);
  if (law_.tangential == TangentialLaw::viscous) {
    const bool slips = tangentialDamping(k.overlap).value * k.slip.norm() > holds;
    phase_ = slips ? Phase::slides : Phase::damped;
    return;
  }
  if (law_.tangential == TangentialLaw::coulomb) {
    phase_ = Phase::slides;
    if (k.slip.norm() <= 2.0 * still_) stopSliding(s);  // it never began
    return;
  }
  const Vec3 trial = heldForce(s, k), along = k.slip.normalized();
  phase_ = Phase::sticks;
  const double held = trial.norm();
  if (held < holds) return;
  if (held == holds && !(growth(pulled(s, k, derivative(s)), along) > boundRate(k))) return;
  phase_ = dashpotAlone() ? Phase::slides : Phase::slidesSpring;
  if (phase_ == Phase::slidesSpring) s.at(12) = held > 0.0 ? Vec3(-trial / held) : along;
}

/// f* is beyond the bound. Where a slip has an e of its own, that of f*. With a dashpot and a total
/// reset each step of the law makes f := bound·f/|f| and tries f − γ_t v_t next: it comes to stick
/// again where v_t is along f, else to −bound v_t/|v_t|.
void TwoSpheres::slipFrom(State& s) {
  const Kinematics k = kinematics(s);
  Vec3 trial = heldForce(s, k);
  if (!dashpotAlone()) {
    phase_ = Phase::slidesSpring;
    s.at(12) = -trial.normalized();
    return;
  }
  const double holds = bound(k);
  phase_ = Phase::slides;
  constexpr int mostSteps = 100000;
  for (int step = 0; step < mostSteps; ++step) {
    const Vec3 force = holds * trial.normalized();
    trial = force - tangentialDamping(k.overlap).value * k.slip;
    if (trial.norm() <= holds) {
      phase_ = Phase::sticks;
      s.at(12) = -force / springUnit(k.overlap);
      return;
    }
    if ((force / holds + k.slip.normalized()).norm() < 1e-15) return;
  }
}

/// The end of a slip: Coulomb's law holds v_t at 0 or lets it go on; of a spring ξ holds the bound
/// from now on.
void TwoSpheres::stopSliding(State& s) {
  const Kinematics k = kinematics(s);
  // At rest to the last bit, or what is left of v_t would end what follows at once.
  const bool rests = phase_ != Phase::slidesSpring;
  if (rests) setSlip(s, k, Vec3::Zero());
  if (law_.tangential == TangentialLaw::coulomb) {
    const Vec3 hold = holdingForce(s, k);
    phase_ = hold.norm() <= bound(k) ? Phase::holds : Phase::slides;
    if (phase_ == Phase::slides) setSlip(s, kinematics(s), -4.0 * still_ * hold.normalized());
    return;
  }
  Vec3 along = rests ? slipBefore_ : s.spring();
  if (rests && slowing_ && along.cross(*slowing_).norm() > 1e-3)
    throw std::invalid_argument(
        "no limit of small time steps: a slip whose force is along it turns on as it comes to "
        "rest, however slow it is");
  along = (along - along.dot(k.normal) * k.normal).normalized();
  const Vec3 viscous =
      rests ? Vec3(Vec3::Zero()) : Vec3(tangentialDamping(k.overlap).value * k.slip);
  phase_ = Phase::sticks;
  s.at(12) = (bound(k) * along - viscous) / springUnit(k.overlap);
  if (!rests) return;
  // |f*| falls by γ_t dv_t/dt. Where the bound falls faster the length of steps decides
  // (CollisionEnd::noLimit).
  const Kinematics still = kinematics(s);
  if (boundRate(still) < pulled(s, still, derivative(s)).dashpot.dot(along))
    throw std::invalid_argument(
        "no limit of small time steps: a slip ends while its bound falls faster than the dashpot "
        "relaxes");
}

void TwoSpheres::choosePhase(State& s) {
  const bool pressed = presses_;
  const Kinematics k = kinematics(s);
  if (law_.gn > 0.0) presses_ = trialNormal(k) > 0.0;
  if (slippery()) return;
  const bool viscous = law_.tangential == TangentialLaw::viscous;
  if (presses_ != pressed || phase_ == Phase::free || viscous) {
    s.at(12).setZero();
    phase_ = Phase::free;
    if (hasBound()) begin(s);
  } else if (phase_ == Phase::sticks) {
    slipFrom(s);
  } else {
    stopSliding(s);
  }
}

/// As that of the plane, with its touch a little later of a law that stiffens.
State TwoSpheres::firstTouch(const CollisionStart& start, double contactTime) const {
  const SpaceMotion before = spaceMotionBefore(pair_, start);
  State state;
  double later = start.late;
  if (law_.stiffens()) later = std::max({later, 1e-12 * contactTime, visibleLength() / start.vn});
  state.at(0) = reach_ * Vec3::UnitX() + later * before.velocity;
  state.at(3) = before.velocity;
  for (const int side : {0, 1}) state.at(6 + 3 * side) = before.spin[side];
  if (later == 0.0 || !law_.springs()) return state;
  const Kinematics k = kinematics(state);
  if (start.late > 0.0)
    state.at(12) = stretchedShare() * later *
                   (remembersForce() ? tangentialStiffness(k.overlap).value : 1.0) * k.slip;
  else if (!remembersForce())
    state.at(12) = later * k.slip;
  return state;
}

CollisionEnd TwoSpheres::solve(const CollisionStart& start) {
  const double contactTime = this->contactTime(start.vn);
  gsl_odeiv2_system system{&rightHandSide, nullptr, numbers, this};
  const std::unique_ptr<gsl_odeiv2_step, decltype(&gsl_odeiv2_step_free)> stepper(
      gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, numbers), &gsl_odeiv2_step_free);

  State now = firstTouch(start, contactTime);
  const double slip = kinematics(now).slip.norm(), speed = start.vn + slip;
  still_ = 1e-13 * speed;
  presses_ = law_.gn == 0.0 || trialNormal(kinematics(now)) > 0.0;
  if (hasBound()) begin(now);

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
                          : remembersForce() ? largestForce
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
  // of 0, where directions turn fast, and at the ends of a contact that stiffens, they shrink until
  // they do.
  const double fullStep = contactTime / 400.0;
  const auto shortest = [&](const Kinematics& k) {
    const bool turns = phase_ == Phase::slidesSpring || phase_ == Phase::slides;
    if (turns || !law_.stiffens()) return 1e-10 * fullStep;
    return std::min(fullStep,
                    std::max(1e-3 * k.overlap, visibleLength()) / std::abs(k.normalVelocity));
  };
  // Change by a rounded distance of v, and of a spin by up to K times as much, in a step. Where
  // the share of steps that stretch a spring jumps, steps need not find each jump to rounding.
  const auto allowed = [&](const State& from, double h) {
    const Kinematics k = kinematics(from);
    const double stretch =
        phase_ == Phase::sticks && !remembersForce() ? from.spring().norm() : 0.0;
    const double stiff = stiffness(k.overlap).value +
                         normalDamping(k.overlap).rate * std::abs(k.normalVelocity) +
                         tangentialStiffness(k.overlap).rate * stretch +
                         tangentialDamping(k.overlap).rate * k.slip.norm();
    const bool jumps =
        phase_ == Phase::slidesSpring && law_.conventions.springUpdate == SpringUpdate::after;
    return (jumps ? 1e-11 : 1e-14) +
           8.0 * std::numeric_limits<double>::epsilon() * h * reach_ * stiff * inverseMass_ / speed;
  };
  constexpr int mostSteps = 100000;
  const double firstStep = law_.stiffens() ? 1e-12 * contactTime : fullStep;
  double wanted = firstStep, duration = 0.0, maxOverlap = 0.0;
  bool begun = true;  // the phase
  for (int step = 0; step < mostSteps; ++step) {
    const Vec3 slipping = kinematics(now).slip;
    if (begun || slipping.norm() > 1e-6 * speed) slipBefore_ = slipping.normalized();
    begun = false;
    if (phase_ != Phase::slides)
      slowing_.reset();
    else if (!slowing_ && slipping.norm() < 0.01 * speed)
      slowing_ = slipBefore_;
    double h = wanted;
    State next = stepFrom(now, h);
    const double found = errorOfStep();
    const double most = allowed(now, h);
    if (found > most && h > shortest(kinematics(now))) {
      wanted = 0.5 * h;
      continue;
    }
    wanted = std::min(fullStep, found < 0.01 * most ? 2.0 * h : h);
    wanted = std::max(wanted, shortest(kinematics(next)));
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
    begun = true;
    if (!law_.stiffens()) wanted = fullStep;
  }
  throw std::invalid_argument(
      fmt::format("the spheres have not parted after {} steps of the oracle, {:.3g} contact times",
                  mostSteps, duration / contactTime));
}

}  // namespace

CollisionEnd vectorOutcome(const ContactLaw& law, const CollidingPair& pair,
                           const CollisionStart& start) {
  for (const auto& [has, option] : {std::pair{law.rolls(), "rolling"}, {law.coheres(), "cohesion"}})
    if (has)
      throw std::invalid_argument(
          fmt::format("{} = \"{}\": there is no oracle of it in space but for spheres that move in "
                      "a plane",
                      option, lawOptionValue(law, option)));
  return TwoSpheres(law, pair).solve(start);
}

}  // namespace crossgrain::inline oracle
