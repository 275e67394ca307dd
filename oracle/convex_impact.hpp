#pragma once

#include <limits>
#include <optional>
#include <string_view>
#include <type_traits>

#include "adapters/scene.hpp"
#include "adapters/vec2.hpp"
#include "oracle/collision_end.hpp"

namespace crossgrain::inline oracle {

/// I⁻¹ about the centre of mass, in space in the laboratory frame [1/(kg m²)].
template <int D>
using InverseInertiaOf = std::conditional_t<D == 2, double, Eigen::Matrix3d>;

template <int D>
InverseInertiaOf<D> noInverseInertia() {
  if constexpr (D == 2)
    return 0.0;
  else
    return Eigen::Matrix3d::Zero();
}

/// Body of any shape at the instant of an impact, laboratory frame. By default a wall at rest.
template <int D>
struct ConvexImpactBody {
  double mass = std::numeric_limits<double>::infinity();  ///< [kg]
  /// Zero, in space in one direction or in all, where the body cannot turn.
  InverseInertiaOf<D> inverseInertia = noInverseInertia<D>();
  VecOf<D> arm = VecOf<D>::Zero();       ///< r, from the centre of mass to the contact [m]
  VecOf<D> velocity = VecOf<D>::Zero();  ///< of the centre of mass [m/s]
  SpinOf<D> spin = noSpin<D>();          ///< ω [rad/s]
};

/// Velocity of its point at the contact, v + ω × r [m/s].
template <int D>
VecOf<D> velocityAtContact(const ConvexImpactBody<D>& body) {
  if constexpr (D == 2)
    return body.velocity + body.spin * perpendicular(body.arm);
  else
    return body.velocity + body.spin.cross(body.arm);
}

/// Kinetic energy of what can move and turn [J].
template <int D>
double kineticEnergy(const ConvexImpactBody<D>& body);

/// Impact of two bodies at one point.
template <int D>
struct ConvexImpactStart {
  std::array<ConvexImpactBody<D>, 2> body;
  VecOf<D> normal;           ///< n of length 1, from body 1 to body 0
  double restitution = 0.0;  ///< e, 0 to 1
  double mu = 0.0;           ///< µ of Coulomb's friction, ≥ 0
};

/// Course of the slip u_t during an impact. One that turns in space without a stop is `slip`.
enum class ImpactKind {
  separating,       ///< u_n ≥ 0 at the start: no impulse
  stick,            ///< no slip from start to end; of Newton's restitution no slip at the end
  slip,             ///< until the end
  slipThenStick,    ///< it stops for good
  slipThenReversed  ///< it stops and begins anew, in the plane the other way
};
/// In results and reports, in enum order.
inline constexpr std::array<std::string_view, 5> impactKindNames = {"no impact", "stick", "slip",
                                                                    "slip-stick", "slip-reversal"};

template <int D>
struct ImpactOutcome {
  ImpactKind kind;
  std::array<VecOf<D>, 2> velocity;  ///< [m/s]
  std::array<SpinOf<D>, 2> spin;     ///< [rad/s]
  VecOf<D> impulse;                  ///< P on body 0, at the contact [N s]
  /// Kinetic energy of what can move and turn, laboratory frame [J].
  double energyAfter;
  /// ½ (u + u′)·P, the kinetic energy that the contact adds, in any frame and beside walls that
  /// move; ≤ 0 of a sound impact [J].
  double gain;
};

/// Outcomes by three hypotheses of restitution.
template <int D>
struct ConvexImpact {
  double energyBefore;  ///< as energyAfter [J]
  /// None where no impulse satisfies it, in space alone.
  std::optional<ImpactOutcome<D>> newton;
  ImpactOutcome<D> poisson, stronge;
  /// Largest |P_a − P_b| of two hypotheses over the largest |P|; infinite without Newton's.
  double spread;
  /// Whether the three agree, spread ≤ agreement: then an engine is judged on its outcome. A gain
  /// of energy is judged always.
  bool judged;
  static constexpr double agreement = 1e-10;
};

/// Impact of rigid bodies at one point with Coulomb's friction: velocities and spins jump, poses
/// stay. With u = v_0 + ω_0 × r_0 − v_1 − ω_1 × r_1 and P on body 0,
///   Δu = M P,  M = Σ (1/m) 1 − [r]× I⁻¹ [r]×,  Δv = ±P/m,  Δω = ±I⁻¹ (r × P);
/// with n first, M = (B Cᵀ; C A).
///
/// Poisson's and Stronge's use Routh's method (Dynamics of a System of Rigid Bodies, 1905; in space
/// Keller, J. Appl. Mech. 53, 1986): the normal impulse p takes the place of time. While the
/// contact slips
///   dP_t/dp = −µ u_t/|u_t|,  du_t/dp = C + A dP_t/dp,  du_n/dp = B + C·dP_t/dp.
/// Where the slip stops or there is none, it stays 0 if |A⁻¹C| ≤ µ, by dP_t/dp = −A⁻¹C. Else it
/// begins along the one direction t with C − µ A t = λ t, λ > 0, which it keeps. Compression ends
/// at u_n = 0, with p_c and W_c = ∫ u_n dp. The impact ends
///   by Poisson at p = (1 + e) p_c. In space a slip that turns may make u_n′ < 0: then it is not
///   over; by Stronge where ∫ u_n dp of restitution is −e² W_c (Proc. R. Soc. A 431, 1990).
/// Both are exact in the plane. In space a slip that turns is integrated to about 1e-12.
///
/// Newton's is algebraic (Whittaker 1904; Kane and Levinson 1985): u_n′ = −e u_n, and u_t′ = 0 if
/// that has |P_t| ≤ µ P_n, else P_t = −µ P_n t with t = u_t/|u_t|, or where u_t = 0 the direction
/// in which slip begins. In space t is the same at the start and at the end, too. It may gain
/// energy.
/// @throws std::invalid_argument for a normal not of length 1, a mass or constant out of range, and
/// two walls
template <int D>
ConvexImpact<D> convexImpact(const ConvexImpactStart<D>& start);

/// The point of a body that is farthest along a direction.
template <int D>
struct CornerOf {
  VecOf<D> arm;  ///< from the centre of mass, laboratory frame [m]
  double next;   ///< how much less far the next corner or end is, 0 of a face or an edge [m]
};
template <int D>
CornerOf<D> cornerTowards(const ShapeOf<D>& shape, const TurnOf<D>& turn,
                          const VecOf<D>& direction);

/// A body as it is in a scene, about to be hit at the end of an arm.
template <int D>
ConvexImpactBody<D> impactBody(const DisksOf<D>& bodies, std::size_t i, const VecOf<D>& arm);

/// Numbers of a collision of bodies of any shape at one point. e_n and Ψ_f are of that point,
/// where both bodies had it before; centrePsi and ConvexEnd::centreNormal of the centres of mass.
/// @param start  its normal is x, and Ψ is along y
/// @param velocity, spin  after it
template <int D>
CollisionEnd convexEnd(const ConvexImpactStart<D>& start, const std::array<VecOf<D>, 2>& velocity,
                       const std::array<SpinOf<D>, 2>& spin);

}  // namespace crossgrain::inline oracle
