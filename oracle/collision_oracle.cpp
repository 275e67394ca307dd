#include "oracle/collision_oracle.hpp"

#include <fmt/format.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "oracle/impact.hpp"
#include "oracle/two_body_problem.hpp"

namespace crossgrain::inline oracle {

int TwoBodyProblem::rightHandSide(double, const double y[], double dydt[], void* self) {
  State s;
  std::memcpy(&s, y, sizeof s);
  const State rate = static_cast<const TwoBodyProblem*>(self)->derivative(s);
  std::memcpy(dydt, &rate, sizeof rate);
  return GSL_SUCCESS;
}

/// A law that stiffens has no stiffness to stick with at δ = 0: it begins 1e-12 of a contact later,
/// or where positions resolve an overlap. The forces of that time are below rounding, or below
/// 1e-7 of the whole for overlaps of 1e-8 of the reach.
State TwoBodyProblem::firstTouch(const CollisionStart& start) const {
  const PairMotion touch = motionBefore(pair_, start);
  State state{};
  state.x = reach_;
  state.vx = touch.normal;
  state.vy = touch.tangential;
  state.spinI = touch.spin[0];
  state.spinJ = touch.spin[1];
  double later = start.late;
  if (law_.stiffens())
    later = std::max({later, 1e-12 * contactTime(start.vn), visibleLength() / start.vn});
  if (later == 0.0) return state;
  state.x += later * state.vx;
  state.y += later * state.vy;
  const Kinematics k = kinematics(state);
  if (start.late > 0.0)
    state.spring = stretchedShare() * later * k.tangentialVelocity *
                   (remembersForce() ? tangentialStiffness(k.overlap).value : 1.0);
  else if (!remembersForce())
    state.spring = later * k.tangentialVelocity;
  return state;
}

/// The state a little later (or earlier), to first order.
State TwoBodyProblem::along(const State& s, double time) const {
  const State rate = derivative(s);
  std::array<double, dimension> y, dydt;
  std::memcpy(y.data(), &s, sizeof s);
  std::memcpy(dydt.data(), &rate, sizeof rate);
  for (std::size_t k = 0; k < dimension; ++k) y[k] += time * dydt[k];
  State moved;
  std::memcpy(&moved, y.data(), sizeof moved);
  return moved;
}

/// Change of a force by a rounding of the distance [N].
double TwoBodyProblem::roundingOfForce(const State& s) const {
  const Kinematics k = kinematics(s);
  const Slope kt = tangentialStiffness(k.overlap);
  const double stretch = remembersForce() ? 0.0 : std::abs(s.spring);
  return std::numeric_limits<double>::epsilon() * reach_ *
         (std::max(stiffness(k.overlap).value,
                   law_.coheres() ? std::abs(cohesiveForce(k).rate) : 0.0) +
          normalDamping(k.overlap).rate * std::abs(k.normalVelocity) + kt.rate * stretch +
          tangentialDamping(k.overlap).rate * std::abs(k.tangentialVelocity));
}

CollisionEnd TwoBodyProblem::solve(const CollisionStart& start) {
  const double contactTime = this->contactTime(start.vn);
  gsl_odeiv2_system system{&rightHandSide, nullptr, dimension, this};
  const std::unique_ptr<gsl_odeiv2_step, decltype(&gsl_odeiv2_step_free)> stepper(
      gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, dimension), &gsl_odeiv2_step_free);

  State now = firstTouch(start);
  stillness_ = 1e-13 * start.vn * (1.0 + std::abs(start.psi));
  noLimit_ = jumpsAtTouch(start);
  enterPhase(now, true);

  std::array<double, dimension> error{};
  const auto stepFrom = [&](const State& from, double h) {
    State to = from;
    gsl_odeiv2_step_reset(stepper.get());
    gsl_odeiv2_step_apply(stepper.get(), 0.0, h, reinterpret_cast<double*>(&to), error.data(),
                          nullptr, nullptr, &system);
    return to;
  };
  /// The last step's error of the relative velocity and of the energies lost, in units of what was
  /// there.
  const double energy = energyOf(pair_, motionBefore(pair_, start));
  const auto errorOfStep = [&] {
    double sum = std::hypot(error[2], error[3]) / start.vn;
    for (const std::size_t k : accounts) sum += std::abs(error[k]) / energy;
    return sum;
  };
  /// When within h a guard that is > 0 at first no longer is.
  const auto timeOf = [&](const auto& guard, const State& from, double h) {
    double before = 0.0, after = h;
    while (after - before > 1e-16 * contactTime && after - before > 1e-15 * after) {
      const double middle = 0.5 * (before + after);
      (guard(stepFrom(from, middle)) > 0.0 ? before : after) = middle;
    }
    return after;
  };
  const auto phaseLasts = [this](const State& s) { return firstGuard(s); };
  const auto approach = [this](const State& s) { return -kinematics(s).normalVelocity; };
  /// When within h a guard of friction or rolling, > 0 at both ends, is ≤ 0 in between: where it
  /// falls at first and rises at last its minimum is looked for. Else the events between would be
  /// missed, and with them that a contact sticks for less than a step before its bound begins to
  /// fall, which is where the outcome jumps.
  const auto dipOf = [&](const auto& guardOf, const State& from, const State& to,
                         double h) -> std::optional<double> {
    const auto guardAfter = [&](const State& of, double time) {
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
  // again and again: a fiftieth is still 1e-14 of a step's own.
  const double fullStep = contactTime / 400.0;
  const double least = law_.coheres() ? 0.02 : 1e-3;
  const auto shortest = [&](const State& from) {
    const Kinematics k = kinematics(from);
    return std::min(
        fullStep,
        std::max(least * std::min(std::abs(k.overlap), k.overlap + bondRange_), visibleLength()) /
            std::abs(k.normalVelocity));
  };
  /// Errors below this are those of rounded positions, which a force sees.
  const auto allowed = [&](const State& from, double h) {
    return 1e-14 + 4.0 * h * roundingOfForce(from) * inverseMass_ / start.vn;
  };
  double wanted = law_.stiffens() ? 1e-12 * contactTime : fullStep;
  constexpr int mostSteps = 100000;
  double duration = 0.0, maxOverlap = 0.0;
  for (int step = 0; step < mostSteps; ++step) {
    double h = wanted;
    State next = stepFrom(now, h);
    if (law_.stiffens()) {
      if (errorOfStep() > allowed(now, h) && h > shortest(now)) {
        wanted = 0.5 * h;
        continue;
      }
      const double grown = errorOfStep() < 0.01 * allowed(now, h) ? 2.0 * h : h;
      wanted = std::min(fullStep, std::max(grown, shortest(next)));
    }
    std::optional<double> within;  // a time by when the phase has ended
    if (!(phaseLasts(next) > 0.0))
      within = h;
    else if (law_.springs())
      within = dipOf([this](const State& s) { return tangentialGuard(s); }, now, next, h);
    if (!within && law_.rolling == RollingLaw::spring)
      within =
          dipOf([this](const State& s) { return rollingGuard(s, kinematics(s)); }, now, next, h);
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
    if (law_.coheres() && duration > longestContact * contactTime) {
      CollisionEnd end = endAt(now, start);
      end.parted = false;
      return end;
    }
    if (!event) continue;
    const Kinematics k = kinematics(now);
    if (k.overlap + bondRange_ <= 1e-14 * reach_ && k.normalVelocity > 0.0) {
      CollisionEnd end = endAt(now, start);
      end.duration = duration;
      end.maxOverlap = maxOverlap;
      return end;
    }
    enterPhase(now);
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
    TwoBodyProblem problem(law, pair);
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
  CollisionEnd end = TwoBodyProblem(law, pair).solve(start);
  if (end.noLimit)
    end.noLimit = jumpsAtTouch(law, pair, start) || hasSeveralOutcomes(law, pair, start);
  if (law.inSpace()) end.outOfPlane.emplace();
  return end;
}

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

bool jumpsAtTouch(const ContactLaw& law, const CollidingPair& pair, const CollisionStart& start) {
  return law.soft() && TwoBodyProblem(law, pair).jumpsAtTouch(inPlane(pair, start));
}

bool stepMissesSlip(const ContactLaw& law, const CollidingPair& pair, const CollisionStart& start,
                    double dt) {
  if (!law.soft()) return false;
  TwoBodyProblem problem(law, pair);
  const CollisionStart touch = inPlane(pair, start);
  CollisionStart late = touch;
  late.late = dt;
  return problem.hasJump() && problem.slipsAtFirst(touch) && !problem.slipsAtFirst(late);
}

}  // namespace crossgrain::inline oracle
