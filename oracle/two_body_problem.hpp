#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "adapters/vec2.hpp"
#include "oracle/collision_oracle.hpp"
#include "oracle/normal_forces.hpp"

namespace crossgrain::inline oracle {

// Velocities, forces and axes in the tangent plane of a contact are SpinOf<D>: in the plane one
// number, along s = z × n or about z, in space a vector. Of these:

inline double sizeOf(double a) {
  return std::abs(a);
}
inline double sizeOf(const Vec3& a) {
  return a.norm();
}
/// Of length 1; 0 of 0.
inline double directionOf(double a) {
  return (a > 0.0) - (a < 0.0);
}
inline Vec3 directionOf(const Vec3& a) {
  return a.normalized();
}
inline double dot(double a, double b) {
  return a * b;
}
inline double dot(const Vec3& a, const Vec3& b) {
  return a.dot(b);
}
/// n × f, the couple of a force, and ω × n, the velocity of a spin; z × n = s, n × s = z.
inline double coupleOf(const Vec2&, double force) {
  return force;
}
inline Vec3 coupleOf(const Vec3& n, const Vec3& force) {
  return n.cross(force);
}
inline double sweepOf(const Vec2&, double spin) {
  return spin;
}
inline Vec3 sweepOf(const Vec3& n, const Vec3& spin) {
  return spin.cross(n);
}
/// In the laboratory's frame.
inline Vec2 alongTangent(const Vec2& n, double force) {
  return force * perpendicular(n);
}
inline Vec3 alongTangent(const Vec3&, const Vec3& force) {
  return force;
}

/// Both ways in which a contact resists: friction the slip v_t, by f_t, and rolling resistance the
/// relative spin ω_r, by M.
enum Resistance { friction, rolling };

/// Variables of the integration: numbers alone, so that they are an array, too.
template <int D>
struct State {
  VecOf<D> position = VecOf<D>::Zero();  ///< of i against j, or the point of a plane touched first
  VecOf<D> velocity = VecOf<D>::Zero();  ///< likewise
  SpinOf<D> spin[2] = {noSpin<D>(), noSpin<D>()};
  /// Memory of the springs: ξ, or its force with the sign of ξ, and θ.
  SpinOf<D> spring[2] = {noSpin<D>(), noSpin<D>()};
  /// Directions of f_t and M while they slip.
  SpinOf<D> side[2] = {noSpin<D>(), noSpin<D>()};
  double largest = 0.0;  ///< δ_max of an elasto-plastic contact [m]
  /// The account of the energy lost so far, as in EnergySplit; `body` is −∫ f v_n dt of the force
  /// without its dashpot, of a body that forgets.
  struct Lost {
    double normal = 0.0, tangential = 0.0, stiffening = 0.0, sliding = 0.0;
    double rollingDamping = 0.0, rolling = 0.0, body = 0.0;
  } lost;

  double* data() { return reinterpret_cast<double*>(this); }
  const double* data() const { return reinterpret_cast<const double*>(this); }
};

template <int D>
struct Kinematics : NormalMotion {
  double distance;
  VecOf<D> normal;     ///< from j to i
  SpinOf<D> sideways;  ///< the centres' own velocity across n [m/s]
  SpinOf<D> turning;   ///< dn/dt [1/s]
  double lever[2];     ///< of f_t [m]
  double arm[2];       ///< of the spins in v_t [m]
  SpinOf<D> velocity[2];  ///< v_t [m/s] and ω_r = ω_i − ω_j, in space less its part along n [rad/s]
  // In space:
  double twist = 0.0;     ///< rate at which springs turn about n, spring_twist [rad/s]
  double spinning = 0.0;  ///< (Σ c ω)·n [m/s]
  double twisting = 0.0;  ///< (ω_i − ω_j)·n [rad/s]
};

/// The collision of two bodies, or of one and a plane, in continuous time, one phase after another:
/// in the plane, or in space. docs/dimensions.md, section 4, has the equations of space, of which
/// those of the plane are the same with one component of each tangential vector.
template <int D>
class TwoBodyProblem : private NormalForces {
 public:
  TwoBodyProblem(const ContactLaw& law, const CollidingPair& pair);
  CollisionEnd solve(const CollisionStart& start);
  /// As the free function.
  bool jumpsAtTouch(const CollisionStart& start);
  bool hasJump() const;
  bool slipsAtFirst(const CollisionStart& start);
  /// The v_t to grow from where a slip ends at 0 and CollisionEnd::noLimit may hold; rounding
  /// without it. @param speed  [m/s]
  void overshoot(double speed) { overshoot_ = speed; }

 private:
  using Tangent = SpinOf<D>;
  using Moment = State<D>;
  using Motion = Kinematics<D>;
  static constexpr Resistance both[] = {friction, rolling};
  static constexpr std::size_t numbers = sizeof(Moment) / sizeof(double);
  static constexpr std::size_t accounts = sizeof(typename Moment::Lost) / sizeof(double);

  /// Between two events the right-hand side is smooth; a mode says which branch of the law holds.
  enum class Mode {
    none,    ///< no force or torque, or none as there is no load
    damped,  ///< f_t = −γ_t v_t
    stick,   ///< f_t = −k_t ξ − γ_t v_t, M = −k_r θ − γ_r ω_r
    slip,    ///< at its bound, along side()
    hold     ///< at rest without a spring: the force or torque that keeps it there
  };

  /// How a law resists, and what of it holds now.
  struct Slider {
    bool springs = false;     ///< else Coulomb's law or a dashpot alone, M of type A or B
    double dashpot = 0.0;     ///< 0: none beside the spring
    bool outside = false;     ///< of the test against the bound
    bool springOnly = false;  ///< is reset by a slip
    Mode mode = Mode::none;
    /// In space, of a force against the motion: its direction when a step began; of one below 1e-6
    /// of the speed the last one, as that of the last bits is rounding; and when it was down to a
    /// hundredth of the speed.
    Tangent before = noSpin<D>();
    std::optional<Tangent> slowing = {};

    /// Whether its slip is against the motion at each instant, and ends where that does: without a
    /// spring, and where the reset of a spring to all of the force leaves the dashpot to turn it.
    bool followsMotion() const { return !springs || (dashpot > 0.0 && !springOnly && !outside); }
  };

  /// A remembered force over a stiffness that goes to 0 under a pull has no energy: all its work
  /// counts as that of sticking.
  bool springHasEnergy() const { return !(remembersForce() && law_.stiffens() && law_.coheres()); }

  // The law
  Motion kinematics(const Moment& s) const;
  double leverFraction(int side) const { return fractionOf(law_.conventions.leverArm, side); }
  double armFraction(int side) const { return fractionOf(law_.conventions.armOfVelocity(), side); }
  double fractionOf(LeverArm arm, int side) const {
    return crossgrain::leverFraction(arm, law_.conventions.planeArm, pair_, side);
  }
  double rollingLoad(const Motion& k) const;
  double rollingBound(const Motion& k) const {
    return law_.muR * rollingLength_ * std::max(rollingLoad(k), 0.0);
  }
  double bound(Resistance of, const Motion& k) const {
    return of == friction ? NormalForces::bound(load(k)) : rollingBound(k);
  }
  Slope stiffness(Resistance of, const Motion& k) const {
    return of == friction ? tangentialStiffness(k.overlap) : Slope{rollingStiffness_, 0.0};
  }
  Slope damping(Resistance of, const Motion& k) const;
  /// Force or torque of a spring per unit of what it remembers.
  double springUnit(Resistance of, const Motion& k) const {
    return of == friction && remembersForce() ? 1.0 : stiffness(of, k).value;
  }
  Tangent tested(Resistance of, const Moment& s, const Motion& k) const;
  Tangent side(Resistance of, const Moment& s, const Motion& k) const;
  Tangent force(Resistance of, const Moment& s, const Motion& k) const;
  double storedEnergy(Resistance of, const Moment& s) const;
  double stiffeningLoss(const Moment& s, const Motion& k) const;
  VecOf<D> acceleration(const Moment& s, const Motion& k) const;
  Moment derivative(const Moment& s) const;
  CollisionEnd endAt(const Moment& s, const CollisionStart& start) const;
  Tangent carried(const Tangent& spring, const Motion& k) const;

  // Events
  bool rollingHasNoLimit() const;
  bool hasNoBound(Resistance of) const;
  double normalAcceleration(const Moment& s, const Motion& k) const;
  double compliance(const Motion& k) const;
  /// dω_r/dt per M [1/(kg m²)], and per −f_t [1/(kg m)].
  double rollingCompliance() const { return 1.0 / pair_.inertia[0] + 1.0 / pair_.inertia[1]; }
  double turningBySlip(const Motion& k) const {
    return k.lever[0] / pair_.inertia[0] - k.lever[1] / pair_.inertia[1];
  }
  /// dv_t/dt per −M [1/(kg m)].
  double slippingByTorque(const Motion& k) const {
    return k.arm[0] / pair_.inertia[0] - k.arm[1] / pair_.inertia[1];
  }
  Tangent slipDrift(const Moment& s, const Motion& k) const;
  Tangent rollingDrift(const Motion& k) const;
  Tangent holding(Resistance of, const Moment& s, const Motion& k) const;
  double boundRate(Resistance of, const Moment& s, const Motion& k) const;
  Tangent slippedSpring(Resistance of, const Moment& s, const Motion& k) const;
  Tangent dashpotRate(Resistance of, const Moment& s, const Motion& k) const;
  double springRate(Resistance of, const Moment& s, const Motion& k) const;
  double slipGuard(Resistance of, const Moment& s, const Motion& k) const;
  Tangent turningOfSlip(Resistance of, const Moment& s, const Motion& k) const;
  double unseenBound(Resistance of, const Motion& k) const;
  double stillness(Resistance of) const {
    return of == friction ? stillness_ : stillness_ / pair_.radius[0];
  }
  double guard(Resistance of, const Moment& s, const Motion& k) const;
  double firstGuard(const Moment& s) const;
  bool lasts(Resistance of, const Moment& s) const;
  void enterPhase(Moment& s, bool anew = false);
  void choose(Resistance of, Moment& s, bool anew);
  void chooseAtRest(Resistance of, Moment& s);
  void chooseSpring(Resistance of, Moment& s);
  void endSlip(Resistance of, Moment& s);
  void slip(Resistance of, Moment& s, const Tangent& along);
  void setVelocity(Resistance of, Moment& s, const Motion& k, const Tangent& wanted) const;

  // Integration
  Moment firstTouch(const CollisionStart& start) const;
  Moment along(const Moment& s, double time) const;
  double roundingOfForce(const Moment& s) const;
  void watchDirections(const Moment& s, double speed);
  double errorOf(const Moment& error, const Moment& s, const CollisionStart& start,
                 double speed) const;

  static int rightHandSide(double t, const double y[], double dydt[], void* self);

  double rollingLength_ = 0.0;     ///< L [m]
  double rollingStiffness_ = 0.0;  ///< k_r (…) [N m]
  double rollingDamping_ = 0.0;    ///< of its dashpot [N m s]
  Slider slider_[2];
  double stillness_ = 0.0;  ///< v_t that counts as 0 [m/s]
  double overshoot_ = 0.0;  ///< overshoot() [m/s]
  bool noLimit_ = false;    ///< CollisionEnd::noLimit
};

}  // namespace crossgrain::inline oracle
