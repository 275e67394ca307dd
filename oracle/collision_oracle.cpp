#include "oracle/collision_oracle.hpp"

#include <fmt/format.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>

#include "law/cohesion.hpp"
#include "oracle/impact.hpp"
#include "oracle/two_body_problem.hpp"

namespace crossgrain::inline oracle {

namespace {

/// As fast a slip at the first touch, in the plane: what a law makes of that touch has no
/// direction.
CollisionStart inPlane(const CollidingPair& pair, CollisionStart start) {
  const double out =
      start.spinOutOfPlane[0].y() * pair.radius[0] + start.spinOutOfPlane[1].y() * pair.radius[1];
  if (out != 0.0) start.psi = std::hypot(start.psi, out / start.vn);
  return start;
}

}  // namespace

template <int D>
int TwoBodyProblem<D>::rightHandSide(double, const double y[], double dydt[], void* self) {
  Moment s;
  std::copy_n(y, numbers, s.data());
  const Moment rate = static_cast<const TwoBodyProblem*>(self)->derivative(s);
  std::copy_n(rate.data(), numbers, dydt);
  return GSL_SUCCESS;
}

/// A law that stiffens has no stiffness to stick with at δ = 0: it begins 1e-12 of a contact later,
/// or where positions resolve an overlap. The forces of that time are below rounding, or below
/// 1e-7 of the whole for overlaps of 1e-8 of the reach.
template <int D>
State<D> TwoBodyProblem<D>::firstTouch(const CollisionStart& start) const {
  const SpaceMotion touch = spaceMotionBefore(pair_, start);
  Moment state;
  state.position = reach_ * VecOf<D>::UnitX();
  state.velocity = touch.velocity.template head<D>();
  for (const int side : {0, 1}) {
    if constexpr (D == 2)
      state.spin[side] = touch.spin[side].z();
    else
      state.spin[side] = touch.spin[side];
  }
  double later = start.late;
  if (law_.stiffens())
    later = std::max({later, 1e-12 * contactTime(start.vn), visibleLength() / start.vn});
  if (later == 0.0) return state;
  state.position += later * state.velocity;
  const Motion k = kinematics(state);
  if (start.late > 0.0)
    state.spring[friction] = stretchedShare(law_.conventions.springUpdate) * later *
                             k.velocity[friction] *
                             (remembersForce() ? tangentialStiffness(k.overlap).value : 1.0);
  else if (!remembersForce())
    state.spring[friction] = later * k.velocity[friction];
  return state;
}

/// The state a little later (or earlier), to first order.
template <int D>
State<D> TwoBodyProblem<D>::along(const Moment& s, double time) const {
  const Moment rate = derivative(s);
  Moment moved = s;
  for (std::size_t k = 0; k < numbers; ++k) moved.data()[k] += time * rate.data()[k];
  return moved;
}

/// Change of a force by a rounding of the distance [N].
template <int D>
double TwoBodyProblem<D>::roundingOfForce(const Moment& s) const {
  const Motion k = kinematics(s);
  const Slope kt = tangentialStiffness(k.overlap);
  const double stretch = remembersForce() ? 0.0 : sizeOf(s.spring[friction]);
  return std::numeric_limits<double>::epsilon() * reach_ *
         (std::max(NormalForces::stiffness(k.overlap).value,
                   law_.coheres() ? std::abs(cohesiveForce(k).rate) : 0.0) +
          normalDamping(k.overlap).rate * std::abs(k.normalVelocity) + kt.rate * stretch +
          tangentialDamping(k.overlap).rate * sizeOf(k.velocity[friction]));
}

/// A step's error in units of what was there: of the relative velocity and of the energies lost; in
/// space, where it decides on every step, of all that moves, a direction by the force that has it.
/// @param speed  of the centres and the contact points before [m/s]
template <int D>
double TwoBodyProblem<D>::errorOf(const Moment& error, const Moment& s, const CollisionStart& start,
                                  double speed) const {
  double sum = 0.0;
  if constexpr (D == 2) {
    const double energy = energyOf(pair_, motionBefore(pair_, start));
    sum = std::hypot(error.velocity.x(), error.velocity.y()) / start.vn;
    for (std::size_t k = numbers - accounts; k < numbers; ++k)
      sum += std::abs(error.data()[k]) / energy;
  } else {
    const double time = contactTime(start.vn), force = pair_.reducedMass() * speed / time;
    const Motion k = kinematics(s);
    sum = error.velocity.norm() + reach_ * (error.spin[0].norm() + error.spin[1].norm());
    sum /= speed;
    for (const Resistance of : both) {
      const double length = of == friction ? 1.0 : reach_;
      const bool isForce = of == friction && remembersForce();
      sum += error.spring[of].norm() / (isForce ? force : speed * time / length) +
             error.side[of].norm() * (bound(of, k) / (force * length) + 1e-9);
    }
  }
  return sum;
}

/// Of slips whose force is against the motion, before a step.
template <int D>
void TwoBodyProblem<D>::watchDirections(const Moment& s, double speed) {
  const Motion k = kinematics(s);
  for (const Resistance of : both) {
    Slider& slider = slider_[of];
    const double size = sizeOf(k.velocity[of]), unit = of == friction ? speed : speed / reach_;
    if (size > 1e-6 * unit) slider.before = directionOf(k.velocity[of]);
    if (slider.mode != Mode::slip || !slider.followsMotion())
      slider.slowing.reset();
    else if (!slider.slowing && size < 0.01 * unit)
      slider.slowing = slider.before;
  }
}

template <int D>
CollisionEnd TwoBodyProblem<D>::solve(const CollisionStart& start) {
  const double contactTime = this->contactTime(start.vn);
  gsl_odeiv2_system system{&rightHandSide, nullptr, numbers, this};
  const std::unique_ptr<gsl_odeiv2_step, decltype(&gsl_odeiv2_step_free)> stepper(
      gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, numbers), &gsl_odeiv2_step_free);

  Moment now = firstTouch(start);
  const double speed = start.vn * (1.0 + std::abs(inPlane(pair_, start).psi));
  stillness_ = 1e-13 * speed;
  noLimit_ = jumpsAtTouch(start);
  enterPhase(now, true);

  Moment error;
  const auto stepFrom = [&](const Moment& from, double h) {
    Moment to = from;
    gsl_odeiv2_step_reset(stepper.get());
    gsl_odeiv2_step_apply(stepper.get(), 0.0, h, to.data(), error.data(), nullptr, nullptr,
                          &system);
    return to;
  };
  /// When within h a guard that is > 0 at first no longer is.
  const auto timeOf = [&](const auto& guard, const Moment& from, double h) {
    double before = 0.0, after = h;
    while (after - before > 1e-16 * contactTime && after - before > 1e-15 * after) {
      const double middle = 0.5 * (before + after);
      (guard(stepFrom(from, middle)) > 0.0 ? before : after) = middle;
    }
    return after;
  };
  const auto phaseLasts = [this](const Moment& s) { return firstGuard(s); };
  const auto approach = [this](const Moment& s) { return -kinematics(s).normalVelocity; };
  /// When within h a guard of friction or rolling, > 0 at both ends, is ≤ 0 in between: where it
  /// falls at first and rises at last its minimum is looked for. Else the events between would be
  /// missed, and with them that a contact sticks for less than a step before its bound begins to
  /// fall, which is where the outcome jumps.
  const auto dipOf = [&](const auto& guardOf, const Moment& from, const Moment& to,
                         double h) -> std::optional<double> {
    const auto guardAfter = [&](const Moment& of, double time) {
      return guardOf(stepFrom(of, time));
    };
    const double little = 1e-6 * h, first = guardOf(from), last = guardOf(to);
    const bool justBegun = first < 1e-9 * last;  // it is 0 to rounding
    if (justBegun || guardOf(along(from, little)) >= first || guardOf(along(to, -little)) >= last)
      return std::nullopt;
    constexpr double golden = 0.6180339887498949;
    double low = 0.0, high = h;
    double left = high - golden * h, right = low + golden * h;
    double atLeft = guardAfter(from, left), atRight = guardAfter(from, right);
    while (high - low > little) {
      if (!(atLeft > 0.0)) return left;
      if (!(atRight > 0.0)) return right;
      if (atLeft < atRight) {
        high = std::exchange(right, left);
        left = high - golden * (high - low);
        atRight = std::exchange(atLeft, guardAfter(from, left));
      } else {
        low = std::exchange(left, right);
        right = low + golden * (high - low);
        atLeft = std::exchange(atRight, guardAfter(from, right));
      }
    }
    return std::nullopt;
  };

  // Steps of t_c/400 leave rk8pd's own error far below rounding where the law is smooth; where it
  // is not, at the ends of a contact that stiffens, they shrink until it is again, to a thousandth
  // of the time in which the overlap comes or goes at most, which is fine enough for any power of
  // it, or to that in which positions change visibly. Events cut steps short. A bond passes δ = 0
  // again and again: a fiftieth is still 1e-14 of a step's own. In space directions turn fast
  // beside a bound of 0 and a slip of 0.
  const bool adapts = D == 3 || law_.stiffens();
  const double fullStep = contactTime / 400.0;
  const double least = law_.coheres() ? 0.02 : 1e-3;
  const auto shortest = [&](const Moment& from) {
    const bool turns = D == 3 && (slider_[friction].mode == Mode::slip ||
                                  slider_[rolling].mode == Mode::slip || !law_.stiffens());
    if (turns) return 1e-10 * fullStep;
    const Motion k = kinematics(from);
    return std::min(
        fullStep,
        std::max(least * std::min(std::abs(k.overlap), k.overlap + bondRange_), visibleLength()) /
            std::abs(k.normalVelocity));
  };
  /// Errors below this are those of rounded positions, which a force sees; in space of spins too,
  /// which change by up to K times as much. Where the share of steps that stretch a spring jumps,
  /// steps need not find each jump to rounding.
  const auto allowed = [&](const Moment& from, double h) {
    const double rounding = h * roundingOfForce(from) * inverseMass_;
    if (D == 2) return 1e-14 + 4.0 * rounding / start.vn;
    const bool jumps = law_.conventions.springUpdate == SpringUpdate::after &&
                       std::ranges::any_of(slider_, [](const Slider& slider) {
                         return slider.mode == Mode::slip && !slider.followsMotion();
                       });
    return (jumps ? 1e-11 : 1e-14) + 8.0 * rounding / speed;
  };
  double wanted = law_.stiffens() ? 1e-12 * contactTime : fullStep;
  constexpr int mostSteps = 100000;
  double duration = 0.0, maxOverlap = 0.0;
  for (int step = 0; step < mostSteps; ++step) {
    double h = wanted;
    if (D == 3) watchDirections(now, speed);
    Moment next = stepFrom(now, h);
    if (adapts) {
      const double found = errorOf(error, now, start, speed), most = allowed(now, h);
      if (found > most && h > shortest(now)) {
        wanted = 0.5 * h;
        continue;
      }
      wanted = std::min(fullStep, std::max(found < 0.01 * most ? 2.0 * h : h, shortest(next)));
    }
    std::optional<double> within;  // a time by when the phase has ended
    if (!(phaseLasts(next) > 0.0)) within = h;
    for (const Resistance of : both)
      if (!within && slider_[of].springs)
        within = dipOf([&](const Moment& s) { return guard(of, s, kinematics(s)); }, now, next, h);
    const bool event = within.has_value();
    if (event) {
      h = timeOf(phaseLasts, now, *within);
      next = stepFrom(now, h);
    }
    if (approach(now) > 0.0 && !(approach(next) > 0.0))
      maxOverlap =
          std::max(maxOverlap, kinematics(stepFrom(now, timeOf(approach, now, h))).overlap);
    duration += h;
    now = next;
    if (D == 3)
      for (Tangent& side : now.side) side = directionOf(side);
    if (law_.coheres() && duration > longestContact * contactTime) {
      CollisionEnd end = endAt(now, start);
      end.parted = false;
      return end;
    }
    if (!event) continue;
    const Motion k = kinematics(now);
    if (k.overlap + bondRange_ <= 1e-14 * reach_ && k.normalVelocity > 0.0) {
      CollisionEnd end = endAt(now, start);
      end.duration = duration;
      end.maxOverlap = maxOverlap;
      return end;
    }
    enterPhase(now);
    if (!law_.stiffens()) wanted = fullStep;
  }
  throw std::invalid_argument(
      fmt::format("the pair has not parted after {} steps of the oracle, {:.3g} contact times",
                  mostSteps, duration / contactTime));
}

namespace {

/// Some conventions make the force jump back and forth between the steps of any engine: sticking
/// with the dashpot on top of a spring at its bound, slipping without it; or a bound below zero
/// that turns the spring's force round. What they converge to depends on the engine, so there is
/// nothing to compare it with.
void requireContinuousLimit(const ContactLaw& law) {
  const LawConventions& how = law.conventions;
  const bool tension = law.gn > 0.0 && how.tension == Tension::allow;
  const bool dashpot = law.tangential == TangentialLaw::springDashpot && law.gt > 0.0;
  const char* jumps = nullptr;
  if (tension && law.tangential != TangentialLaw::none &&
      how.coulombBound == CoulombBound::signedForce)
    jumps = "coulomb_bound = \"signed\"";
  if (dashpot && how.dashpot == Dashpot::outside) jumps = "dashpot = \"outside\"";
  if (dashpot && law.normal == NormalLaw::hertz && how.history == History::displacement &&
      how.springReset == SpringReset::springOnly)
    throw std::invalid_argument(
        "spring_reset = \"spring_only\" with history = \"displacement\": as k_t goes to 0 the "
        "spring "
        "that balances the dashpot is stretched without bound; there is no oracle for it");
  if (law.coheres() && law.tangential != TangentialLaw::none &&
      how.coulombBound == CoulombBound::signedForce)
    jumps = "coulomb_bound = \"signed\"";
  const bool rollingSpring = law.rolling == RollingLaw::spring;
  if (rollingSpring && law.gr > 0.0 && how.rollingDashpot == Dashpot::outside &&
      how.rollingReset == SpringReset::total && how.springUpdate == SpringUpdate::after)
    jumps = "rolling_dashpot = \"outside\" with spring_update = \"after\"";
  if (jumps)
    throw std::invalid_argument(std::string(jumps) +
                                " has no limit of small time steps to score against");
}

/// Whether a collision has several outcomes in the limit of small steps, where a slip's end lets
/// v_t grow from its rounding (CollisionEnd::noLimit). What it grows from is taken anew, over three
/// decades below any step's, at places that no factor of growth can share; outcomes that then stay
/// together are one. 10⁻⁴ of the larger of v_n and v_t is a hundredth of the narrowest margin that
/// collisions are judged by here: what is left moves no verdict.
bool hasSeveralOutcomes(const ContactLaw& law, const CollidingPair& pair,
                        const CollisionStart& start) {
  constexpr int samples = 8;
  constexpr double golden = 0.6180339887498949;
  const double allowed = 1e-4 * std::max(1.0, std::abs(start.psi));
  std::array<double, samples> psi, en;
  for (int k = 0; k < samples; ++k) {
    TwoBodyProblem<2> problem(law, pair);
    problem.overshoot(start.vn * std::pow(10.0, -9.0 + 3.0 * std::fmod(k * golden, 1.0)));
    const CollisionEnd end = problem.solve(start);
    psi[k] = end.psi;
    en[k] = end.en;
  }
  const auto spread = [](const auto& values) {
    const auto [low, high] = std::ranges::minmax(values);
    return high - low;
  };
  return spread(psi) > allowed || spread(en) > allowed;
}

}  // namespace

CollisionEnd oracleOutcome(const ContactLaw& law, const CollidingPair& pair,
                           const CollisionStart& start) {
  if (!law.soft())
    return law.inSpace() ? rigidOutcomeInSpace(law, pair, start) : rigidOutcome(law, pair, start);
  requireContinuousLimit(law);
  const bool planar = start.spinOutOfPlane[0].isZero(0.0) && start.spinOutOfPlane[1].isZero(0.0);
  if (law.inSpace() && !planar) return vectorOutcome(law, pair, start);
  CollisionEnd end = TwoBodyProblem<2>(law, pair).solve(start);
  if (end.noLimit)
    end.noLimit = jumpsAtTouch(law, pair, start) || hasSeveralOutcomes(law, pair, start);
  if (law.inSpace()) end.outOfPlane.emplace();
  return end;
}

CollisionEnd vectorOutcome(const ContactLaw& law, const CollidingPair& pair,
                           const CollisionStart& start) {
  const LawConventions& how = law.conventions;
  const bool rollingSpring = law.rolling == RollingLaw::spring;
  const char* lacks = nullptr;
  // After a slip the spring is beyond its bound on the other side, by a finite part of it per step.
  if (rollingSpring && law.gr > 0.0 && how.rollingDashpot == Dashpot::outside &&
      how.rollingReset == SpringReset::springOnly)
    lacks = "rolling_dashpot = \"outside\" with rolling_reset = \"spring_only\"";
  // Where the dashpot is cut the bound stays as it is: rounding decides whether a step slips again
  // or stretches the spring, which turns the force.
  const bool ofPullAlone =
      (law.cohesion == CohesionLaw::dmt && how.cohesionLoad == CohesionLoad::withoutPull) ||
      (pullOff(law, pair.reducedRadius()) > 0.0 &&
       how.cohesionLoad == CohesionLoad::magnitudePlusPullOff);
  if (ofPullAlone && law.gn > 0.0 && how.tension == Tension::cut &&
      how.springUpdate == SpringUpdate::after && (law.springs() || rollingSpring))
    lacks = "spring_update = \"after\" with a bound that tension = \"cut\" keeps constant";
  if (lacks)
    throw std::invalid_argument(fmt::format(
        "{}: there is no oracle of it in space but for spheres that move in a plane", lacks));
  return TwoBodyProblem<3>(law, pair).solve(start);
}

bool jumpsAtTouch(const ContactLaw& law, const CollidingPair& pair, const CollisionStart& start) {
  return law.soft() && TwoBodyProblem<2>(law, pair).jumpsAtTouch(inPlane(pair, start));
}

bool stepMissesSlip(const ContactLaw& law, const CollidingPair& pair, const CollisionStart& start,
                    double dt) {
  if (!law.soft()) return false;
  TwoBodyProblem<2> problem(law, pair);
  const CollisionStart touch = inPlane(pair, start);
  CollisionStart late = touch;
  late.late = dt;
  return problem.hasJump() && problem.slipsAtFirst(touch) && !problem.slipsAtFirst(late);
}

}  // namespace crossgrain::inline oracle
