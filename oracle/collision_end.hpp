#pragma once

#include <optional>

#include "adapters/scene.hpp"
#include "adapters/snapshot.hpp"
#include "adapters/vec2.hpp"
#include "law/contact_reference.hpp"

namespace crossgrain::inline oracle {

/// Source of the contact point's tangential velocity before a collision.
enum class Approach {
  spin,       ///< both disks turn alike, their centres meet head on
  firstSpin,  ///< only the first disk turns; the same on a wall
  oblique     ///< the centres' own motion; the disks do not turn
};

/// Ψ_i = v_t/v_n of the contact point before, with v_n the speed of approach.
struct CollisionStart {
  double psi = 0.0;
  double vn = 0.0;  ///< > 0 [m/s]
  Approach approach = Approach::spin;
  /// Spin added to the first disk and taken from the second, times a_j/a_i there: it leaves v_t as
  /// it is [rad/s]
  double counterSpin = 0.0;
  /// How long after the touch the law is evaluated first [s]: until then the disks fly on without a
  /// force, as in a step of that length. 0: the law in continuous time.
  double late = 0.0;
  /// In space, spins that each body has besides, about the line of centres n and about the tangent
  /// s: the first leave the slip as it is, the second give it a part along b = n × s [rad/s].
  Vec2 spinOutOfPlane[2] = {Vec2::Zero(), Vec2::Zero()};
  /// Of convex bodies: the first one's orientation [rad], and its spin along b at the touch
  /// [rad/s].
  double orientation = 0.0, spin = 0.0;
};

/// Motion of i against j, in the frame of the normal n (from j to i) and s = z × n.
struct PairMotion {
  double normal = 0.0;      ///< of the centres along n, < 0 on approach [m/s]
  double tangential = 0.0;  ///< of the centres along s [m/s]
  double spin[2] = {};      ///< ω_i, ω_j [rad/s]
};

/// Where the energy went that a collision took, a closed account:
/// before = after + the sum of all parts. Parts of a law's rolling resistance and cohesion are
/// absent where it has none, or where it is not known.
struct EnergySplit {
  /// ∫ (f_el − f_n) v_n dt: the dashpot's, and what the spring does not give back where tension is
  /// cut [J]
  double normalDamping = 0.0;
  double tangentialDamping = 0.0;  ///< ∫ γ_t v_t² dt while the contact does not slip [J]
  /// The loss (+) or gain (−) of a loaded tangential spring because its stiffness follows the
  /// overlap, while the contact does not slip: no force does this work, a history-dependent law
  /// just forgets it (Elata and Berryman 1996) [J]
  double stiffening = 0.0;
  /// −∫ f_t v_t dt while it slips, together with what the tangential spring gains (−) or loses (+)
  /// from the first instant of a slip to the last: the law resets it [J]
  double sliding = 0.0;
  double stored = 0.0;  ///< k_t ξ²/2 in the tangential spring when the disks part, lost then [J]
  /// ∫ γ_r L² ω_r² dt of a rolling spring's dashpot while it does not slip; of the viscous laws
  /// −∫ M ω_r dt [J]
  std::optional<double> rollingDamping = {};
  /// −∫ M ω_r dt at the bound, with what the spring's resets take and what it holds in the end [J]
  std::optional<double> rolling = {};
  /// Of an elasto-plastic contact, between its lines of loading and unloading [J]
  std::optional<double> plastic = {};
  /// Of JKR's bond, which reaches farther on parting than when bodies meet [J]
  std::optional<double> detachment = {};
};

/// The same in space, with the two bodies on any line: components in any frame.
struct SpaceMotion {
  Vec3 normal = Vec3::UnitX();                  ///< from j to i, of length 1
  Vec3 velocity = Vec3::Zero();                 ///< of i against j [m/s]
  Vec3 spin[2] = {Vec3::Zero(), Vec3::Zero()};  ///< [rad/s]
};

/// Numbers of a collision in space besides. The frame is that of the start: n, s and b = n × s.
struct EndOutOfPlane {
  /// v_t after along b′ / speed of approach; n′, s′ and b′ are n, s and b after the smallest
  /// rotation that takes n to the normal at separation.
  double psi = 0.0;
  double spinNormal[2] = {};   ///< ω·n [rad/s]
  double spinTangent[2] = {};  ///< ω·s [rad/s]
};

/// Numbers of a collision of convex bodies besides.
struct ConvexEnd {
  double centreNormal = 0.0;  ///< centres' v_n after / speed of approach of the contact point
  double gained = 0.0;        ///< kinetic energy that the collision adds, else 0 [J]
};

/// State after a collision, at the instant of separation and with that instant's normal.
/// About the contact point: psi, beta, and of convex bodies en. About the centres' relative motion:
/// en, centrePsi, et, reboundAngle. The two kinds are different numbers: friction moves the contact
/// point K = 1 + 1/q times as much as the centres. Absent: not known.
struct CollisionEnd {
  double en = 0.0;   ///< −v_n after / v_n before
  double psi = 0.0;  ///< Ψ_f = v_t after / speed of approach; sign against Ψ_i: reversed
  std::optional<double> beta;  ///< −Ψ_f/Ψ_i; absent for Ψ_i = 0
  double centrePsi = 0.0;      ///< centres' v_t after / speed of approach
  /// Centres' v_t after / before; absent where they had none: Approach::spin, Ψ_i = 0.
  std::optional<double> et;
  double reboundAngle = 0.0;                ///< of the centres' velocity from n towards s [rad]
  double spin[2] = {};                      ///< ω_i, ω_j; in space ω·b [rad/s]
  std::optional<EndOutOfPlane> outOfPlane;  ///< of collisions in space
  double energyBefore = 0.0;                ///< of the relative motion and both spins [J]
  double energyAfter = 0.0;                 ///< [J]
  std::optional<double> duration;    ///< from the first touch to separation [s]; none if rigid
  std::optional<double> maxOverlap;  ///< [m]; none if rigid
  std::optional<EnergySplit> lost;
  std::optional<ConvexEnd> convex;  ///< of convex bodies
  /// The law has no limit of small time steps here: it jumps (jumpsAtTouch()), or a slip ended at
  /// v_t = 0 while the bound fell faster than the dashpot relaxes. Reset to the bound, the spring
  /// is caught by it again after a time ∝ v_t, so v_t grows from its rounding by a factor per
  /// reset: where that leads is a function of log dt. The outcome is one of a narrow family, whose
  /// members are further apart than 1e-4 of the larger of v_n and v_t.
  bool noLimit = false;
  /// False: a pair that coheres and still touches after longestContact; then only energyBefore is
  /// of any use.
  bool parted = true;
};

/// The motion when the disks touch first.
PairMotion motionBefore(const CollidingPair& pair, const CollisionStart& start);

/// The same in space: in components along n, s and b.
SpaceMotion spaceMotionBefore(const CollidingPair& pair, const CollisionStart& start);

/// m₁₂ v²/2 + Σ J ω²/2: kinetic energy in the frame of the pair's centre of mass [J].
double energyOf(const CollidingPair& pair, const PairMotion& motion);

/// All that follows from the motion when they part.
CollisionEnd endOf(const CollidingPair& pair, const CollisionStart& start, const PairMotion& after);

/// The same in space. @param after  in components along the start's n, s and b
CollisionEnd spaceEndOf(const CollidingPair& pair, const CollisionStart& start,
                        const SpaceMotion& after);

/// Collisions side by side in one scene: disks 2k and 2k + 1 are pair k; where there is a wall,
/// disk k and its one plane.
template <int D>
CollidingPair pairOf(const SceneOf<D>& scene, std::size_t pair);

/// Traces the free flight after the collision back to the instant when the disks parted, under JKR
/// where the scene's law lets go. An end
/// without maxOverlap and lost, which the flight does not have.
/// @param scene  as in pairOf() @param start  of that pair
/// @returns none if they never met or still touch
std::optional<CollisionEnd> collisionEnd(const Scene& scene, const Snapshot& after,
                                         std::size_t pair, const CollisionStart& start);

/// The same in space, of a linear law.
/// @param turn  takes n, s and b of the start to where they are in the scene: its columns
std::optional<CollisionEnd> collisionEnd(const SpaceScene& scene, const SpaceSnapshot& after,
                                         std::size_t pair, const CollisionStart& start,
                                         const Eigen::Matrix3d& turn);

}  // namespace crossgrain::inline oracle
