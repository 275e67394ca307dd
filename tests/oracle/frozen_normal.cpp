#include "frozen_normal.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_roots.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <stdexcept>

namespace crossgrain {

namespace {

using Function = std::function<double(double)>;

/// The root of f between `low` and `high`, where f has different signs.
double rootOf(const Function& f, double low, double high) {
  gsl_function function{
      [](double x, void* self) { return (*static_cast<const Function*>(self))(x); },
      const_cast<Function*>(&f)};
  const std::unique_ptr<gsl_root_fsolver, decltype(&gsl_root_fsolver_free)> solver(
      gsl_root_fsolver_alloc(gsl_root_fsolver_brent), &gsl_root_fsolver_free);
  gsl_root_fsolver_set(solver.get(), &function, low, high);
  for (int iteration = 0; iteration < 200; ++iteration) {
    gsl_root_fsolver_iterate(solver.get());
    low = gsl_root_fsolver_x_lower(solver.get());
    high = gsl_root_fsolver_x_upper(solver.get());
    if (gsl_root_test_interval(low, high, 0.0, 4e-16) == GSL_SUCCESS) break;
  }
  return gsl_root_fsolver_root(solver.get());
}

/// δ'' = −(k_n δ + γ_n δ')/m₁₂ from δ = 0, δ' = v, up to where the force would pull and is cut;
/// from there on the disks fly.
class NormalMotion {
 public:
  NormalMotion(const ContactLaw& law, double mass, double v)
      : mass_(mass), v_(v), eta_(0.5 * law.gn / mass) {
    const double omega2 = law.kn / mass - eta_ * eta_;
    if (!(omega2 > 0.0))
      throw std::invalid_argument("the pair is overdamped: it never parts by itself");
    omega_ = std::sqrt(omega2);
    release_ = (std::numbers::pi - std::atan2(2.0 * eta_ * omega_, omega2 - eta_ * eta_)) / omega_;
    end_ = std::numbers::pi / omega_;
    if (law.conventions.tension == Tension::cut && law.gn > 0.0)
      end_ = release_ + overlap(release_) / -rate(release_);
    cut_ = law.conventions.tension == Tension::cut;
  }

  double overlap(double t) const {
    return v_ / omega_ * std::exp(-eta_ * t) * std::sin(omega_ * t);
  }
  double rate(double t) const {
    return v_ * std::exp(-eta_ * t) * (std::cos(omega_ * t) - eta_ / omega_ * std::sin(omega_ * t));
  }
  /// ∫ max(f_n, 0) dt from the first touch: what the disks' approach has lost, m₁₂ (v − δ').
  double impulse(double t) const { return mass_ * (v_ - rate(std::min(t, release_))); }
  double compression(double t) const {
    if (t >= release_) return 0.0;
    const double stiffness = mass_ * (omega_ * omega_ + eta_ * eta_);
    return stiffness * overlap(t) + 2.0 * eta_ * mass_ * rate(t);
  }
  double compressionRate(double t) const {
    if (t >= release_) return 0.0;
    const double stiffness = mass_ * (omega_ * omega_ + eta_ * eta_);
    const double acceleration = -compression(t) / mass_;
    return stiffness * rate(t) + 2.0 * eta_ * mass_ * acceleration;
  }

  double end() const { return end_; }          ///< when the disks part [s]
  double release() const { return release_; }  ///< when f_n changes sign [s]
  double parting() const { return -rate(cut_ ? std::min(release_, end_) : end_); }
  double maxOverlap() const { return overlap(std::atan2(omega_, eta_) / omega_); }

 private:
  double mass_, v_, eta_;
  double omega_ = 0.0, release_ = 0.0, end_ = 0.0;
  bool cut_ = false;
};

struct Tangential {
  double slip = 0.0;    ///< v_t [m/s]
  double spring = 0.0;  ///< ξ [m]
};

/// ξ'' = −C (k_t ξ + γ_t ξ') after a time t, whatever its damping.
Tangential stuck(const ContactLaw& law, double compliance, const Tangential& from, double t) {
  const double eta = 0.5 * compliance * law.gt;
  const double square = compliance * law.kt - eta * eta;  // ω², < 0 where overdamped
  const double omega = std::sqrt(std::abs(square));
  double cosine = 1.0,
         sine = t;  // cos ωt and sin(ωt)/ω, both with e^{−ηt}, cosh and sinh overdamped
  if (square > 0.0) {
    cosine = std::exp(-eta * t) * std::cos(omega * t);
    sine = std::exp(-eta * t) * std::sin(omega * t) / omega;
  } else if (square < 0.0) {
    const double slow = std::exp((omega - eta) * t), fast = std::exp(-(omega + eta) * t);
    cosine = 0.5 * (slow + fast);
    sine = 0.5 * (slow - fast) / omega;
  } else {
    cosine = std::exp(-eta * t);
    sine = t * std::exp(-eta * t);
  }
  const double drive = from.slip + eta * from.spring;
  return {cosine * from.slip - sine * (eta * drive + square * from.spring),
          cosine * from.spring + sine * drive};
}

/// The tangential motion under a given normal one, a phase after the other.
class TangentialMotion {
 public:
  TangentialMotion(const ContactLaw& law, double compliance, const NormalMotion& normal)
      : law_(law), compliance_(compliance), normal_(normal) {
    if (law.tangential == TangentialLaw::spring) law_.gt = 0.0;
  }

  bool noLimit() const { return noLimit_; }

  double after(double slip) {
    if (law_.tangential == TangentialLaw::none || law_.mu == 0.0) return slip;
    // Beyond the release there is no bound left, and no friction.
    const double end = std::min(normal_.release(), normal_.end());
    double now = 0.0;
    Tangential state{slip, 0.0};
    choose(now, state);
    constexpr int mostEvents = 10000;
    for (int event = 0; event < mostEvents; ++event) {
      const double next = nextEvent(now, state, end);
      state = moved(now, state, next);
      now = next;
      if (!(now < end)) return state.slip;
      choose(now, state);
    }
    throw std::runtime_error("the collision with frozen normal did not come to an end");
  }

 private:
  enum class Phase { still, damped, stick, slip };

  double bound(double t) const { return law_.mu * normal_.compression(t); }

  Tangential moved(double from, const Tangential& state, double to) const {
    switch (phase_) {
      case Phase::still:
        return state;
      case Phase::damped:
        return {state.slip * std::exp(-compliance_ * law_.gt * (to - from)), 0.0};
      case Phase::stick:
        return stuck(law_, compliance_, state, to - from);
      case Phase::slip:
        break;
    }
    const double impulse = law_.mu * (normal_.impulse(to) - normal_.impulse(from));
    return {state.slip + compliance_ * side_ * impulse, 0.0};
  }

  /// > 0 while the phase lasts.
  double guard(double t, const Tangential& state) const {
    switch (phase_) {
      case Phase::still:
        return 1.0;
      case Phase::damped:
        return bound(t) - law_.gt * std::abs(state.slip);
      case Phase::stick:
        return bound(t) - std::abs(trial(state));
      case Phase::slip:
        break;
    }
    const double against = -side_ * state.slip;  // > 0 while friction opposes the motion
    if (law_.tangential == TangentialLaw::viscous) return law_.gt * against - bound(t);
    if (law_.tangential == TangentialLaw::coulomb || law_.gt > 0.0) return against;
    // A spring alone sees v_t only after a step that stuck: not where it would relax.
    return law_.kt * std::max(against, 0.0) - law_.mu * normal_.compressionRate(t);
  }

  double trial(const Tangential& state) const {
    return -law_.kt * state.spring - law_.gt * state.slip;
  }

  /// The phase that follows at t; after a slip the spring carries the bound.
  void choose(double t, Tangential& state) {
    const bool first = t == 0.0;
    switch (law_.tangential) {
      case TangentialLaw::coulomb:
        // Stopped by friction, v_t stays 0: nothing else drives it.
        phase_ = first && state.slip != 0.0 ? Phase::slip : Phase::still;
        side_ = -std::copysign(1.0, state.slip);
        if (phase_ == Phase::still) state.slip = 0.0;
        return;
      case TangentialLaw::viscous:
        phase_ = law_.gt * std::abs(state.slip) <= bound(t) || (!first && phase_ == Phase::slip)
                     ? Phase::damped
                     : Phase::slip;
        side_ = -std::copysign(1.0, state.slip);
        return;
      default:
        break;
    }
    const bool slipped = phase_ == Phase::slip && !first;
    if (slipped) {
      state.spring = -side_ * bound(t) / law_.kt;
      const double relaxing =
          law_.mu * (normal_.compressionRate(t) + law_.gt * compliance_ * normal_.compression(t));
      noLimit_ |= law_.gt > 0.0 && relaxing < 0.0;
    }
    const double tested = trial(state);
    phase_ = Phase::stick;
    if (slipped || std::abs(tested) < bound(t)) return;
    phase_ = Phase::slip;
    side_ = std::copysign(1.0, tested);
    if (guard(t, state) > 0.0) return;
    state.spring = -side_ * bound(t) / law_.kt;
    phase_ = Phase::stick;
  }

  double nextEvent(double now, const Tangential& state, double end) const {
    const Function guardAt = [&](double t) { return guard(t, moved(now, state, t)); };
    const double grain = 1e-13 * end;
    const double stride = end / 400.0;
    double before = now + grain;
    if (before >= end) return end;
    if (!(guardAt(before) > 0.0)) return before;
    while (before < end) {
      const double after = std::min(before + stride, end);
      if (!(guardAt(after) > 0.0)) return after == before ? end : rootOf(guardAt, before, after);
      before = after;
    }
    return end;
  }

  ContactLaw law_;
  double compliance_;
  const NormalMotion& normal_;
  Phase phase_ = Phase::still;
  double side_ = 0.0;
  bool noLimit_ = false;
};

void requireDefaults(const LawConventions& how) {
  if (how.coulombBound != CoulombBound::compression || how.dashpot != Dashpot::inside ||
      how.springReset != SpringReset::total || how.springUpdate != SpringUpdate::after)
    throw std::invalid_argument(
        "the frozen normal is solved for the default conventions of friction only");
}

}  // namespace

CollisionEnd frozenNormalOutcome(const ContactLaw& law, const CollidingPair& pair,
                                 const CollisionStart& start) {
  requireDefaults(law.conventions);
  const NormalMotion normal(law, pair.reducedMass(), start.vn);
  TangentialMotion tangential(law, pair.tangentialCompliance(), normal);
  const double before = start.psi * start.vn;
  const double impulse = (tangential.after(before) - before) / pair.tangentialCompliance();

  PairMotion after = motionBefore(pair, start);
  after.normal = normal.parting();
  after.tangential += impulse / pair.reducedMass();
  for (const int side : {0, 1})
    after.spin[side] -= pair.radius[side] * impulse / pair.inertia[side];
  CollisionEnd end = endOf(pair, start, after);
  end.noLimit = tangential.noLimit();
  end.duration = normal.end();
  end.maxOverlap = normal.maxOverlap();
  return end;
}

}  // namespace crossgrain
