#pragma once

#include <cstdint>
#include <span>

namespace grain {

/// Rigid disks (Walton 1992): restitution along the normal, and along the tangent while a contact
/// sticks, and Coulomb's coefficient.
struct ImpactLaw {
  double en, et0, mu;
};

/// A disk, or a point of a wall: that has no inverse mass, as it does not yield.
struct ImpactBody {
  double vx = 0.0, vy = 0.0, spin = 0.0;  ///< [m/s, rad/s]
  /// Changes of them by the step's forces, or a wall's motion.
  double kickX = 0.0, kickY = 0.0, kickSpin = 0.0;
  double inverseMass = 0.0;     ///< [1/kg]
  double inverseInertia = 0.0;  ///< 0 where nothing turns [1/(kg m²)]
};

/// A contact of two bodies, and what it has done to them.
struct Impact {
  std::size_t i, j;                   ///< bodies
  double nx, ny;                      ///< unit normal, from j to i
  double leverI = 0.0, leverJ = 0.0;  ///< l, arms of the tangential impulse [m]
  double armI = 0.0, armJ = 0.0;      ///< c, arms of the slip velocity [m]
  double overlap = 0.0;               ///< [m]
  double normal = 0.0;                ///< sum of impulses on i along n [N s]
  double tangential = 0.0;            ///< along s = z × n [N s]
  bool slid = false;                  ///< whether Coulomb's bound held
  std::int32_t plane = -1;            ///< whose point body j is, if it is one's
  const ImpactLaw* law = nullptr;     ///< of the two, where it is not that of all
};

/// The impulses of one step, of disks that touch at its beginning.
///
/// *Impacts*, of the velocities before the kick: contacts collide, two bodies at a time with the
/// velocities of that moment, until no two approach. One impact of approach velocity
/// v_n = (v_i − v_j)·n < 0 and slip v_t = (v_i − v_j)·s − (c_i ω_i + c_j ω_j), with
/// 1/m_n = 1/m_i + 1/m_j and 1/m_t = 1/m_n + c_i l_i/J_i + c_j l_j/J_j (Walton 1992, who has one
/// arm, c = l):
///
///   J_n = −(1 + e_n) m_n v_n,  J_t = −(1 + e_t0) m_t v_t limited to ±µ J_n.
///
/// It keeps momentum, and with c = l changes the energy by −½ m_n (1 − e_n²) v_n² + ½ m_t (v_t'² −
/// v_t²) with v_t' between v_t and −e_t0 v_t: never up, and by nothing for e_n = 1 without
/// friction. So whatever their order, impacts of a disk with several others do the same; computed
/// all from the velocities before, as one sum, they would not. The order is that of the contacts,
/// forward and backward in turn. It decides among outcomes that all keep to the law (Smith et al.
/// 2012 compare them).
///
/// Without friction an impact moves the velocities, in the metric of the masses, to or towards
/// their mirror image in the plane v_n = 0. Where any velocities let all contacts part, that ends
/// after finitely many for e_n = 1 (Motzkin and Schoenberg 1954) and converges for e_n < 1 (Agmon
/// 1954); an approach below 10⁻⁸ of the fastest is let be.
///
/// *The kick*, held without restitution: with the kick added, contacts get further impulses
///
///   q_n ≥ 0, v_n ≥ b, q_n (v_n − b) = 0,  |q_t| ≤ µ q_n, against slip,
///
/// b = −e_n v_n of the beginning where the contact collided, at most what the impacts left of it,
/// else 0. For one contact that is v_n⁺ = −e_n v_n⁻ (Moreau 1988; Jean 1999): velocities of a
/// leapfrog, half a step before and after the positions of the impact, so that e_n = 1 keeps
/// ½ m v² + m g x at that time to rounding, and what rests, v_n⁻ = 0, stays at rest. Reflecting the
/// velocity that already holds the kick, as sequential impulses often do, gains g dt of speed at
/// every bounce.
///
/// The second problem is solved for all contacts at once: by conjugate gradients for the impulses
/// that no bound holds, with a projected Gauss–Seidel sweep there and back as the preconditioner
/// (after Silcowitz-Hansen, Niebe and Erleben 2010). Sweeps alone would take as many rounds as a
/// heavy disk on a light one has times its mass.
///
/// A disk between walls that close in has no velocities that let it part from both: after 1000
/// rounds the rest is left to the next step. So it is, now and then, of a heap with friction that
/// still rattles.
///
/// @returns whether nothing approaches any more. Bodies have their kicks then.
bool solveImpacts(const ImpactLaw& law, std::span<ImpactBody> bodies, std::span<Impact> impacts);

}  // namespace grain
