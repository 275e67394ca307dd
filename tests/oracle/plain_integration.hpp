#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "oracle/collision_oracle.hpp"

/// A route to a collision's end that shares nothing with the oracle but the law's text: classical
/// Runge–Kutta in Cartesian coordinates, small equal steps, and once a step the choice between
/// stick and slip (Lätzel 2003, Eqs. 4.9 and 4.20–4.25, with the conventions of contact_law.hpp),
/// of rolling too; JKR's contact radius by bisection. No events, no energies, no frames that turn.
namespace crossgrain::test {

class PlainIntegration {
 public:
  struct Outcome {
    double en, psi;  ///< NAN: it does not part
    double rollingSpin = 0.0;
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
            0.0,
            0.0,
            0.0};
    bool touched = false;
    for (double step = 0.0; step < 10.0 * stepsPerContact; ++step) {
      plain.decide(s);
      const State next = plain.stepped(s, h);
      const double end = plain.end();
      const double before = plain.see(s).overlap - end, after = plain.see(next).overlap - end;
      if (touched && after <= 0.0) {  // the last step is cut where the disks part
        const State last = plain.stepped(s, h * before / (before - after));
        const Seen parted = plain.see(last);
        return {parted.vn / start.vn, parted.vt / start.vn, last[4] - last[5]};
      }
      touched = touched || plain.see(next).overlap > 0.0;
      plain.bonded_ = touched;
      s = next;
    }
    return {NAN, NAN};
  }

 private:
  /// Of i relative to j: x, y, v_x, v_y; then ω_i, ω_j and ξ, or with History::force the force; θ
  /// of the rolling spring; δ_max.
  using State = std::array<double, 9>;
  struct Seen {
    double nx, ny, overlap, vn, vt, fn, bound, kt, gt;
    double spin, rollingBound;
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
  double trial(const State& s, const Seen& c) const {
    return (law_.springs() ? -unit(c) * s[6] : 0.0) - c.gt * c.vt;
  }
  double rollingLength() const {
    const double a = pair_.radius[0], b = pair_.radius[1],
                 two = pair_.plane ? 2.0 * a : 2.0 * a * b / (a + b);
    if (how_.rollingLength == RollingLength::smallerRadius) return pair_.plane ? a : std::min(a, b);
    if (how_.rollingLength == RollingLength::meanRadius) return pair_.plane ? a : 0.5 * (a + b);
    return how_.rollingLength == RollingLength::twiceEffective ? two : 0.5 * two;
  }
  double kr() const {
    const double a = pair_.radius[0], b = pair_.plane ? a : pair_.radius[1];
    if (how_.rollingStiffness == RollingStiffness::constant) return law_.kr;
    if (how_.rollingStiffness == RollingStiffness::radii) return law_.kr * a * b;
    return law_.kr * rollingLength() * rollingLength();
  }
  double gr() const {
    if (law_.rolling != RollingLaw::spring || how_.rollingDamper == RollingDamper::constant)
      return law_.gr * rollingLength() * rollingLength();
    const auto about = [&](int k) {  // the point of contact
      return 1.0 / (pair_.inertia[k] + pair_.mass[k] * pair_.radius[k] * pair_.radius[k]);
    };
    return 2.0 * law_.gr * std::sqrt(kr() / (about(0) + (pair_.plane ? 0.0 : about(1))));
  }
  bool isSpring() const { return law_.rolling == RollingLaw::spring; }
  double rollingTested(const State& s, const Seen& c) const {
    return -kr() * s[7] - (how_.rollingDashpot == Dashpot::outside ? 0.0 : gr() * c.spin);
  }
  double torque(const State& s, const Seen& c) const {
    switch (law_.rolling) {
      case RollingLaw::none:
        return 0.0;
      case RollingLaw::constantTorque:
        return c.rollingBound * turns_;
      case RollingLaw::viscous:
        return -gr() * c.spin;
      case RollingLaw::viscousByLoad:
        return -c.rollingBound * rollingLength() * c.spin;
      case RollingLaw::spring:
        break;
    }
    return rolls_ ? c.rollingBound * turns_ : -kr() * s[7] - gr() * c.spin;
  }

  /// JKR's overlap and force of a contact of that radius: δ = a²/R − √(2π w a/E*),
  /// F = 4 E* a³/(3 R) − √(8π w E* a³).
  double R() const { return pair_.reducedRadius(); }
  double E() const { return 0.75 * law_.kn; }
  double overlapOf(double a) const {
    return a * a / R() - std::sqrt(2.0 * M_PI * law_.w * a / E());
  }
  double forceOf(double a) const {
    return 4.0 * E() * a * a * a / (3.0 * R()) - std::sqrt(8.0 * M_PI * law_.w * E() * a * a * a);
  }
  /// Of the contact at whose radius the branch ends, dδ/da = 0, or the force is least, dF/da = 0.
  double radiusOfEnd() const {
    if (how_.jkrEnd == JkrEnd::branch) return std::cbrt(M_PI * law_.w * R() * R() / (8.0 * E()));
    return std::cbrt(9.0 * M_PI * law_.w * R() * R() / (8.0 * E()));
  }
  /// By bisection.
  double radiusAt(double overlap) const {
    double low = radiusOfEnd(), high = pair_.radius[0];
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high);
      (overlapOf(middle) < overlap ? low : high) = middle;
    }
    return low;
  }
  /// The overlap at which bodies part [m].
  double end() const { return law_.cohesion == CohesionLaw::jkr ? overlapOf(radiusOfEnd()) : 0.0; }
  double pull() const {
    return law_.cohesion == CohesionLaw::dmt   ? 2.0 * M_PI * law_.w * R()
           : law_.cohesion == CohesionLaw::jkr ? 1.5 * M_PI * law_.w * R()
                                               : 0.0;
  }
  double plasticReach() const {
    return law_.kUnload / (law_.kUnload - law_.kn) * law_.plasticDepth * 2.0 * R();
  }
  double k2(double largest) const {
    const double share = largest >= plasticReach() ? 1.0 : largest / plasticReach();
    return law_.kn + (law_.kUnload - law_.kn) * share;
  }
  double unloading(double d, double largest) const {
    return k2(largest) * d - (k2(largest) - law_.kn) * largest;
  }
  double bodyForce(double d, double elastic, double largest) const {
    const double a = pair_.radius[0], b = pair_.radius[1];
    switch (law_.cohesion) {
      case CohesionLaw::none:
        return elastic;
      case CohesionLaw::dmt:
        return elastic - pull();
      case CohesionLaw::area: {
        double area = 2.0 * M_PI * R() * d;
        if (how_.cohesionArea == CohesionArea::twiceBetweenDisks && !pair_.plane) area *= 2.0;
        if (how_.cohesionArea == CohesionArea::lens) {  // π h², h by Pythagoras
          const double c = a + b - d;
          const double foot = pair_.plane ? c : (c * c + a * a - b * b) / (2.0 * c);
          area = M_PI * (a - foot) * (a + foot);
        }
        return elastic - law_.kc * area;
      }
      case CohesionLaw::jkr:
        return forceOf(radiusAt(d));
      case CohesionLaw::elastoPlastic:
        break;
    }
    const double line = unloading(d, largest);
    const bool beyond = law_.plasticDepth > 0.0 && d > plasticReach();
    return std::max(beyond ? line : std::min(elastic, line), -law_.kc * d);
  }
  /// δ_max, at most δ*; at the limit of the pull by bisection.
  double remembered(double d, double largest) const {
    largest = std::max(largest, d);
    if (law_.plasticDepth > 0.0) largest = std::min(largest, plasticReach());
    if (unloading(d, largest) >= -law_.kc * d) return largest;
    double low = d, high = largest;
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high);
      (unloading(d, middle) < -law_.kc * d ? high : low) = middle;
    }
    return low;
  }

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
      c.kt = law_.kt * (law_.cohesion == CohesionLaw::jkr ? radiusAt(d) : root);
    } else if (law_.normal == NormalLaw::polynomial) {
      elastic = (law_.kn + law_.kn3 * d) * d * d;
      stiffness = (2.0 * law_.kn + 3.0 * law_.kn3 * d) * std::max(d, 0.0);
    }
    c.gt = law_.tangential == TangentialLaw::spring ? 0.0 : damping(law_.gt, c.kt);
    const bool yields = law_.cohesion == CohesionLaw::elastoPlastic;
    const double body = bodyForce(d, elastic, s[8]), attraction = std::min(body, 0.0);
    c.fn = body - damping(law_.gn, stiffness) * c.vn;
    if (how_.tension == Tension::cut) c.fn = std::max(c.fn, law_.coheres() ? attraction : 0.0);
    double load = c.fn;
    if (law_.coheres()) {
      const CohesionLoad of = how_.cohesionLoad;
      if (of == CohesionLoad::plusTwicePullOff && pull() > 0.0) load = body + 2.0 * pull();
      if (of == CohesionLoad::netWithoutDashpot) load = body;
      if (of == CohesionLoad::magnitudePlusPullOff) load = std::abs(load) + pull();
      if (of == CohesionLoad::withoutPull) load -= yields ? attraction : body - elastic;
    }
    const double size =
        how_.coulombBound == CoulombBound::magnitude ? std::abs(load) : std::max(load, 0.0);
    c.bound = law_.mu * size;
    c.spin = s[4] - s[5];
    const double rollingLoad = how_.rollingLoad == RollingLoad::elastic     ? elastic
                               : how_.rollingLoad == RollingLoad::magnitude ? std::abs(load)
                                                                            : load;
    c.rollingBound = law_.muR * rollingLength() * std::max(rollingLoad, 0.0);
    return c;
  }

  /// Within a step a contact lasts: its force may jump where it ends. f* within the bound sticks;
  /// else ξ = −f_t/k_t, or −(f_t + γ_t v_t)/k_t.
  void decide(State& s) {
    s[8] = law_.cohesion == CohesionLaw::elastoPlastic ? remembered(see(s).overlap, s[8]) : 0.0;
    const Seen c = see(s);
    touches_ = c.overlap >= (bonded_ ? end() : 0.0);
    decideRolling(s, c);
    if (!law_.springs()) return decideSpringless(c);
    slips_ = touches_ && std::abs(trial(s, c)) > c.bound;
    if (!touches_) s[6] = 0.0;
    if (!slips_) return;
    sense_ = std::copysign(1.0, trial(s, c));
    const bool springOnly = how_.springReset == SpringReset::springOnly;
    s[6] = unit(c) == 0.0 ? 0.0 : -(sense_ * c.bound + (springOnly ? c.gt * c.vt : 0.0)) / unit(c);
  }
  /// Coulomb's force always slips, the viscous one where it exceeds the bound.
  void decideSpringless(const Seen& c) {
    slips_ = law_.tangential != TangentialLaw::viscous || std::abs(c.gt * c.vt) > c.bound;
    sense_ =
        law_.tangential == TangentialLaw::none || c.vt == 0.0 ? 0.0 : -std::copysign(1.0, c.vt);
  }
  void decideRolling(State& s, const Seen& c) {
    turns_ = c.spin == 0.0 ? 0.0 : -std::copysign(1.0, c.spin);
    if (!isSpring()) return;
    if (!touches_) s[7] = 0.0;
    const bool limited = how_.rollingLoad != RollingLoad::whileCompressed || c.rollingBound > 0.0;
    rolls_ = touches_ && limited && std::abs(rollingTested(s, c)) > c.rollingBound;
    if (!rolls_) return;
    turns_ = std::copysign(1.0, rollingTested(s, c));
    const bool springOnly = how_.rollingReset == SpringReset::springOnly;
    s[7] = -(turns_ * c.rollingBound + (springOnly ? gr() * c.spin : 0.0)) / kr();
  }

  State rate(const State& s) const {
    const Seen c = see(s);
    const double fn = touches_ ? c.fn : 0.0;
    const double ft = !touches_ ? 0.0 : slips_ ? sense_ * c.bound : trial(s, c);
    const double fx = fn * c.nx - ft * c.ny, fy = fn * c.ny + ft * c.nx;
    const double inverse = 1.0 / pair_.mass[0] + 1.0 / pair_.mass[1];
    const double M = touches_ ? torque(s, c) : 0.0;
    // Stretched after the force, a spring is not in a step that slips: it has been reset.
    const bool stretches = touches_ && (!slips_ || how_.springUpdate != SpringUpdate::after);
    const double growth = how_.history == History::force ? c.kt * c.vt : c.vt;
    return {s[2],
            s[3],
            fx * inverse,
            fy * inverse,
            (M - arm(how_.leverArm, 0, c.overlap) * ft) / pair_.inertia[0],
            (-M - arm(how_.leverArm, 1, c.overlap) * ft) / pair_.inertia[1],
            stretches ? growth : 0.0,
            touches_ && isSpring() && (!rolls_ || how_.springUpdate != SpringUpdate::after) ? c.spin
                                                                                            : 0.0,
            0.0};
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
  bool touches_ = false, slips_ = false, bonded_ = false, rolls_ = false;
  double sense_ = 0.0;  ///< sign of friction while it slips
  double turns_ = 0.0;  ///< sign of the torque at its bound
};

}  // namespace crossgrain::test
