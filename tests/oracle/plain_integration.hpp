#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "oracle/collision_oracle.hpp"

/// A route to a collision's end that shares nothing with the oracle but the law's text: classical
/// Runge–Kutta in Cartesian coordinates, small equal steps, and once a step the choice between
/// stick and slip (Lätzel 2003, Eqs. 4.9 and 4.20–4.25, with the conventions of contact_law.hpp).
/// No events, no energies, no frames that turn.
namespace crossgrain::test {

class PlainIntegration {
 public:
  struct Outcome {
    double en, psi;
  };

  /// @param phase  how much of a step before the first touch it begins
  static Outcome run(const ContactLaw& law, const CollidingPair& pair, const CollisionStart& start,
                     double contactTime, double stepsPerContact, double phase) {
    PlainIntegration plain(law, pair);
    const double h = contactTime / stepsPerContact;
    const PairMotion touch = motionBefore(pair, start);
    State s{plain.reach_ - phase * h * touch.normal,
            -phase * h * touch.tangential,
            touch.normal,
            touch.tangential,
            touch.spin[0],
            touch.spin[1],
            0.0};
    bool touched = false;
    for (double step = 0.0; step < 20.0 * stepsPerContact; ++step) {
      plain.decide(s);
      const State next = plain.stepped(s, h);
      const double before = plain.see(s).overlap, after = plain.see(next).overlap;
      if (touched && after <= 0.0) {  // the last step is cut where the disks part
        const Seen end = plain.see(plain.stepped(s, h * before / (before - after)));
        return {end.vn / start.vn, end.vt / start.vn};
      }
      touched = touched || after > 0.0;
      s = next;
    }
    return {NAN, NAN};
  }

 private:
  /// Of i relative to j: x, y, v_x, v_y; then ω_i, ω_j and ξ, or with History::force the force.
  using State = std::array<double, 7>;
  struct Seen {
    double nx, ny, overlap, vn, vt, fn, bound, kt, gt;
  };

  PlainIntegration(const ContactLaw& law, const CollidingPair& pair)
      : law_(law), how_(law.conventions), pair_(pair), reach_(pair.radius[0] + pair.radius[1]) {}

  double arm(LeverArm of, int side, double overlap) const {
    return pair_.radius[side] - overlap * leverFraction(of, how_.planeArm, pair_, side);
  }
  double damping(double constant, double stiffness) const {
    if (law_.damper == Damper::viscoelastic) return constant * stiffness;
    if (law_.damper == Damper::critical)
      return constant * std::sqrt(pair_.reducedMass() * stiffness);
    return constant;
  }
  double unit(const Seen& c) const { return how_.history == History::force ? 1.0 : c.kt; }
  double trial(const State& s, const Seen& c) const { return -unit(c) * s[6] - c.gt * c.vt; }

  Seen see(const State& s) const {
    Seen c{};
    const double distance = pair_.plane ? s[0] : std::sqrt(s[0] * s[0] + s[1] * s[1]);
    c.nx = pair_.plane ? 1.0 : s[0] / distance;
    c.ny = pair_.plane ? 0.0 : s[1] / distance;
    c.overlap = reach_ - distance;
    c.vn = s[2] * c.nx + s[3] * c.ny;
    c.vt = -s[2] * c.ny + s[3] * c.nx - arm(how_.armOfVelocity(), 0, c.overlap) * s[4] -
           arm(how_.armOfVelocity(), 1, c.overlap) * s[5];
    const double d = c.overlap, root = std::sqrt(pair_.reducedRadius() * std::max(d, 0.0));
    double elastic = law_.kn * d, stiffness = law_.kn;
    c.kt = law_.kt;
    if (law_.normal == NormalLaw::hertz) {
      elastic = law_.kn * root * d;
      stiffness = 1.5 * law_.kn * root;
      c.kt = law_.kt * root;
    } else if (law_.normal == NormalLaw::polynomial) {
      elastic = (law_.kn + law_.kn3 * d) * d * d;
      stiffness = (2.0 * law_.kn + 3.0 * law_.kn3 * d) * std::max(d, 0.0);
    }
    c.gt = law_.tangential == TangentialLaw::spring ? 0.0 : damping(law_.gt, c.kt);
    c.fn = elastic - damping(law_.gn, stiffness) * c.vn;
    if (how_.tension == Tension::cut) c.fn = std::max(c.fn, 0.0);
    const double size =
        how_.coulombBound == CoulombBound::magnitude ? std::abs(c.fn) : std::max(c.fn, 0.0);
    c.bound = law_.mu * size;
    return c;
  }

  /// Within a step a contact lasts: its force may jump where it ends. f* within the bound sticks;
  /// else ξ = −f_t/k_t, or −(f_t + γ_t v_t)/k_t.
  void decide(State& s) {
    const Seen c = see(s);
    touches_ = c.overlap >= 0.0;
    slips_ = touches_ && std::abs(trial(s, c)) > c.bound;
    if (!touches_) s[6] = 0.0;
    if (!slips_) return;
    sense_ = std::copysign(1.0, trial(s, c));
    const bool springOnly = how_.springReset == SpringReset::springOnly;
    s[6] = -(sense_ * c.bound + (springOnly ? c.gt * c.vt : 0.0)) / unit(c);
  }

  State rate(const State& s) const {
    const Seen c = see(s);
    const double fn = touches_ ? c.fn : 0.0;
    const double ft = !touches_ ? 0.0 : slips_ ? sense_ * c.bound : trial(s, c);
    const double fx = fn * c.nx - ft * c.ny, fy = fn * c.ny + ft * c.nx;
    const double inverse = 1.0 / pair_.mass[0] + 1.0 / pair_.mass[1];
    // Stretched after the force, a spring is not in a step that slips: it has been reset.
    const bool stretches = touches_ && (!slips_ || how_.springUpdate != SpringUpdate::after);
    const double growth = how_.history == History::force ? c.kt * c.vt : c.vt;
    return {s[2],
            s[3],
            fx * inverse,
            fy * inverse,
            -arm(how_.leverArm, 0, c.overlap) * ft / pair_.inertia[0],
            -arm(how_.leverArm, 1, c.overlap) * ft / pair_.inertia[1],
            stretches ? growth : 0.0};
  }

  State stepped(const State& s, double h) const {
    const auto moved = [](const State& from, const State& along, double by) {
      State to = from;
      for (std::size_t k = 0; k < to.size(); ++k) to[k] += by * along[k];
      return to;
    };
    const State a = rate(s), b = rate(moved(s, a, 0.5 * h)), c = rate(moved(s, b, 0.5 * h)),
                d = rate(moved(s, c, h));
    State to = s;
    for (std::size_t k = 0; k < to.size(); ++k)
      to[k] += h / 6.0 * (a[k] + 2.0 * b[k] + 2.0 * c[k] + d[k]);
    return to;
  }

  ContactLaw law_;
  LawConventions how_;
  CollidingPair pair_;
  double reach_;
  bool touches_ = false, slips_ = false;
  double sense_ = 0.0;  ///< sign of friction while it slips
};

}  // namespace crossgrain::test
