#pragma once

namespace crossgrain::inline contact_law {

/// The contact law of a scene and every convention that engines are known to differ in.
///
/// Signs, for a contact of i with j: n points from j to i, s = z × n, overlap δ > 0 in contact,
///   v_n = (v_i − v_j)·n (negative on approach), v_t = (v_i − v_j)·s − (c_i ω_i + c_j ω_j) with the
///   velocity arms c, which are the lever arms l unless a law says otherwise,
/// the force on i is f_n n + f_t s and its torque on i is −l_i f_t (Lätzel 2003, chapter 4).

/// f_n = f_el(δ) − γ_n v_n with an elastic part that is
enum class NormalLaw {
  linear,  ///< k_n δ  (Lätzel 2003, Eq. 4.9)
  hertz,  ///< 4/3 E₁₂ √R₁₂ δ^(3/2) (Johnson 1985, Eq. 4.22); k_t is then 8 G₁₂ √(R₁₂ δ) (Eq. 7.43)
  polynomial,  ///< k₂ δ² + k₃ δ³, as measured for a disk (Lätzel 2003, Fig. 4.4)
  rigid  ///< hard disks: restitution e_n, tangential restitution e_t0, friction µ (Walton 1992)
};

/// The factor of the dashpots' constants besides the velocity. S is the stiffness f_el′(δ), of the
/// tangential dashpot k_t(δ).
enum class Damper {
  constant,      ///< 1: γ [kg/s]
  viscoelastic,  ///< S: γ [s]; e falls as the speed rises (Brilliantov et al. 1996)
  critical  ///< √(m₁₂ S): γ [-]; e does not depend on the speed (Tsuji et al. 1992). γ = 2 is
            ///< critical for a linear law
};

enum class Tension {
  allow,  ///< f_n as it is, also where the dashpot makes it attractive near the end of a contact
  cut     ///< f_n := max(f_n, 0)
};

enum class TangentialLaw {
  none,     ///< frictionless
  coulomb,  ///< f_t = −µ f_n sign(v_t)                            (Lätzel 2003, Eq. 4.16)
  viscous,  ///< f_t = −min(γ_t |v_t|, µ f_n) sign(v_t)            (Eq. 4.18)
  spring,   ///< f_t = −min(k_t |ξ|, µ f_n) sign(ξ)                (Eq. 4.20, Cundall–Strack)
  springDashpot  ///< f* = −k_t ξ − γ_t v_t, limited to µ f_n              (Eqs. 4.22–4.25)
};

/// The factor of µ in the Coulomb bound.
enum class CoulombBound {
  compression,  ///< max(f_n, 0)
  magnitude,    ///< |f_n|
  signedForce   ///< f_n itself; a negative bound counts as its value, so friction then drives
};

/// Whether the tangential dashpot is part of the trial force that the Coulomb bound is held
/// against.
enum class Dashpot {
  inside,  ///< test |k_t ξ + γ_t v_t|
  outside  ///< test |k_t ξ|; the dashpot force is added only while the contact sticks
};

/// Value that the spring is set to when the contact slips.
enum class SpringReset {
  total,      ///< ξ = −f_t / k_t: the spring alone carries the bound (Lätzel 2003, Eq. 4.25)
  springOnly  ///< ξ = −(f_t + γ_t v_t) / k_t: spring and dashpot together carry the bound
};

/// When within a step the spring is stretched by v_t dt.
enum class SpringUpdate {
  after,    ///< force from the old ξ, then ξ += v_t dt
  before,   ///< ξ += v_t dt, then the force
  midpoint  ///< ξ += v_t dt/2, the force, ξ += v_t dt/2: second order where velocities are
};

/// The arm l_i of f_t about the disk's centre. Two disks' angular momentum changes by the moment of
/// the couple ±f_t s at the distance a_i + a_j − δ and by both torques:
///   dL/dt = (a_i + a_j − δ − l_i − l_j) f_t.
/// LAMMPS' gran/hooke/history has a_i; its pair_style granular (GranularModel::calculate_forces)
/// and LIGGGHTS (surface_model_default.h), YADE and Box2D have a_i − δ/2.
enum class LeverArm {
  radius,        ///< a_i, the thesis' choice; dL/dt = −δ f_t
  contactPoint,  ///< a_i − δ a_j/(a_i + a_j): keeps angular momentum
  overlapMiddle  ///< a_i − δ/2: keeps it too; the same for equal radii
};

/// The arm c_i of ω_i in v_t. Where it is another one than that of f_t, the law does not see the
/// velocity that f_t does work on, and Σ f_t (c − l) ω is energy from nowhere. LAMMPS' pair_style
/// granular takes a_i beside a torque at a_i − δ/2; the others take the arm of f_t.
enum class VelocityArm {
  leverArm,  ///< that of f_t
  radius,
  contactPoint,
  overlapMiddle
};

/// The arm at a wall's plane, unless it is LeverArm::radius, which stays a_i.
enum class PlaneArm {
  surface,  ///< a_i − δ: the plane does not yield, the contact point lies on it (YADE)
  middle,   ///< a_i − δ/2, half way into the overlap as between disks (Box2D, LIGGGHTS)
  radius    ///< a_i (LAMMPS: fix wall/gran with granular)
};

/// Memory of a contact's tangential motion while k_t follows the overlap.
enum class History {
  displacement,  ///< ξ, f* = −k_t(δ) ξ
  force          ///< the force, df* = −k_t(δ) v_t dt (Mindlin and Deresiewicz 1953)
};

/// The relative velocity that enters the dashpots when velocities live half a step away.
enum class DampingVelocity {
  lagged,     ///< v(t − dt/2)
  predicted,  ///< v(t − dt/2) + a(t − dt) dt/2
  implicit    ///< the velocity at t that the contact's own force brings about
};

/// Rolling resistance: a torque M on i and −M on j against ω_r = ω_i − ω_j, the types of Ai et al.
/// (2011). L is a length, N a load; what they are is a convention.
enum class RollingLaw {
  none,
  constantTorque,  ///< type A: M = −µ_r L N sign(ω_r)
  viscous,         ///< type B: M = −γ_r L² ω_r
  viscousByLoad,   ///< type B: M = −µ_r L² N ω_r, µ_r [s/m] (Zhou et al. 1999)
  spring  ///< type C: M* = −k_r θ − γ_r L² ω_r, θ = ∫ω_r dt, limited to µ_r L N (Iwashita and Oda
          ///< 1998)
};

/// L, with R₁₂ = a_i a_j/(a_i + a_j), at a wall's plane a_i: one µ_r is three strengths.
enum class RollingLength {
  effective,       ///< R₁₂ (LAMMPS, LIGGGHTS)
  twiceEffective,  ///< 2 R₁₂ (MercuryDPM)
  smallerRadius,   ///< min(a_i, a_j) (YADE: CohFrictMat)
  meanRadius       ///< (a_i + a_j)/2 (YADE: Hertz' law)
};

/// The factor of the constant k_r of a rolling spring.
enum class RollingStiffness {
  lengthSquare,  ///< L²: k_r [N/m] (LAMMPS)
  radii,         ///< a_i a_j: k_r [N/m] (YADE)
  constant       ///< 1: k_r [N m]
};

/// The dashpot of a rolling spring.
enum class RollingDamper {
  constant,  ///< γ_r L² ω_r, γ_r [kg/s] (LAMMPS)
  critical  ///< 2 γ_r √(I k_r) ω_r, γ_r the damping ratio [-], 1/I = Σ 1/(J + m a²) (LIGGGHTS)
};

/// N, the load that µ_r multiplies.
enum class RollingLoad {
  compression,     ///< max(f_n, 0)
  magnitude,       ///< |f_n|
  elastic,         ///< f_el(δ), without dashpot and cohesion (LIGGGHTS' cdt)
  whileCompressed  ///< max(f_n, 0); where that is 0 a spring has no limit (YADE's Hertz law)
};

/// Attraction. F_po is the largest pull, w the work of adhesion [J/m²], 2 γ of two equal surfaces.
enum class CohesionLaw {
  none,
  area,          ///< f_el(δ) − k_c A(δ), k_c [Pa] (LIGGGHTS' sjkr)
  dmt,           ///< f_el(δ) − F_po, F_po = 2π w R₁₂ (Derjaguin, Muller and Toporov 1975)
  jkr,           ///< in place of Hertz' force, from the first touch until the surfaces part beyond
                 ///< δ = 0; F_po = 3/2 π w R₁₂ (Johnson, Kendall and Roberts 1971)
  elastoPlastic  ///< k_n δ on loading, k₂(δ_max) on unloading, pull up to k_c δ; from δ* on elastic
                 ///< with k₂ at its limit (Walton and Braun 1986 with k_c = 0; Luding 2008, Eqs. 6
                 ///< to 8, his limit branch as in Singh, Magnanimo and Luding 2015, section 2)
};

/// A of CohesionLaw::area.
enum class CohesionArea {
  lens,              ///< of two spheres at that distance (LIGGGHTS' sjkr)
  firstOrder,        ///< 2π R₁₂ δ, the lens to first order
  twiceBetweenDisks  ///< 4π R₁₂ δ, at a wall's plane 2π R₁₂ δ (LIGGGHTS' sjkr2)
};

/// Which δ_max an elasto-plastic contact takes its k₂ from.
enum class UnloadingStiffness {
  current,  ///< that of this step
  lagged  ///< that of the step before; δ₀ is worked out from it when δ_max grows, and kept (YADE)
};

/// Until when parting surfaces pull under JKR.
enum class JkrEnd {
  largestPull,  ///< F = −F_po (LAMMPS)
  branch        ///< where the branch ends, at −5/9 F_po (Thornton and Ning 1998)
};

/// The load that stands for f_n in Coulomb's bound and in that of rolling, of a law with cohesion.
enum class CohesionLoad {
  net,                   ///< f_n, the pull included
  withoutPull,           ///< f_n without the pull
  plusTwicePullOff,      ///< f_n without its dashpot + 2 F_po (Thornton 1991; LAMMPS' jkr)
  magnitudePlusPullOff,  ///< |f_n| + F_po (YADE)
  netWithoutDashpot      ///< f_n without its dashpot (LAMMPS' dmt)
};

/// How a tangential spring, in space a vector, stays in the tangent plane when the normal turns
/// from n to n′ within a step: before it is stretched by v_t dt. In the plane nothing has to be
/// done.
enum class SpringTurn {
  rotated,  ///< by the smallest rotation that takes n to n′: |ξ| and angles stay
  firstOrder,  ///< ξ − ξ × (n × n′): |ξ| grows by half the angle's square (YADE: ScGeom::rotate)
  rescaled,  ///< ξ − (ξ·n′) n′, then to the old length (LAMMPS: pair_style granular)
  projected  ///< ξ − (ξ·n′) n′, which is shorter (LAMMPS: gran/hooke/history, LIGGGHTS)
};

/// Whether the spring turns with a pair that turns about its own line of centres.
enum class SpringTwist {
  meanSpin,  ///< by ½(ω_i + ω_j)·n dt: a rigid turn of the pair turns its forces (YADE)
  none       ///< it stays where it is in space (LAMMPS, LIGGGHTS, MercuryDPM)
};

enum class Integrator {
  positionVerlet,  ///< Störmer's scheme on positions: x(t+dt) = 2x(t) − x(t−dt) + a dt²
  velocityVerlet,
  semiImplicitEuler
};

struct LawConventions {
  Tension tension = Tension::allow;
  CoulombBound coulombBound = CoulombBound::compression;
  Dashpot dashpot = Dashpot::inside;
  SpringReset springReset = SpringReset::total;
  SpringUpdate springUpdate = SpringUpdate::after;
  LeverArm leverArm = LeverArm::radius;
  VelocityArm velocityArm = VelocityArm::leverArm;
  PlaneArm planeArm = PlaneArm::surface;
  History history = History::displacement;
  DampingVelocity dampingVelocity = DampingVelocity::predicted;
  RollingLength rollingLength = RollingLength::effective;
  RollingStiffness rollingStiffness = RollingStiffness::lengthSquare;
  RollingDamper rollingDamper = RollingDamper::constant;
  RollingLoad rollingLoad = RollingLoad::compression;
  Dashpot rollingDashpot = Dashpot::inside;       ///< of the rolling spring and its bound
  SpringReset rollingReset = SpringReset::total;  ///< of θ, where M is at its bound
  CohesionArea cohesionArea = CohesionArea::lens;
  JkrEnd jkrEnd = JkrEnd::largestPull;
  CohesionLoad cohesionLoad = CohesionLoad::withoutPull;
  UnloadingStiffness unloadingStiffness = UnloadingStiffness::current;
  SpringTurn springTurn = SpringTurn::rotated;
  SpringTwist springTwist = SpringTwist::meanSpin;
  Integrator integrator = Integrator::positionVerlet;

  /// The arm in v_t by its own name.
  LeverArm armOfVelocity() const {
    switch (velocityArm) {
      case VelocityArm::radius:
        return LeverArm::radius;
      case VelocityArm::contactPoint:
        return LeverArm::contactPoint;
      case VelocityArm::overlapMiddle:
        return LeverArm::overlapMiddle;
      case VelocityArm::leverArm:
        break;
    }
    return leverArm;
  }

  bool operator==(const LawConventions&) const = default;
};

/// Parameters of the law that a pair of bodies has.
struct ContactLaw {
  NormalLaw normal = NormalLaw::linear;
  TangentialLaw tangential = TangentialLaw::springDashpot;
  Damper damper = Damper::constant;
  double kn = 0.0;  ///< normal stiffness k_n [N/m]; Hertz: 4/3 E₁₂ [Pa]; polynomial: k₂ [N/m²]
  double kn3 = 0.0;  ///< polynomial: k₃ [N/m³]
  double gn = 0.0;   ///< normal damping γ_n [kg/s], or as `damper` says
  double kt = 0.0;   ///< tangential stiffness k_t [N/m]; Hertz: 8 G₁₂ [Pa]
  double gt = 0.0;   ///< tangential damping γ_t [kg/s], or as `damper` says
  double mu = 0.0;   ///< Coulomb's coefficient, static = dynamic [-]
  double en = 1.0;   ///< rigid law: normal restitution [-]
  double et0 = 0.0;  ///< rigid law: tangential restitution of a sticking contact [-]
  RollingLaw rolling = RollingLaw::none;
  double kr = 0.0;   ///< rolling stiffness [N/m], or [N m] as RollingStiffness says
  double gr = 0.0;   ///< rolling damping [kg/s], or as RollingDamper says
  double muR = 0.0;  ///< coefficient of rolling resistance [-]; viscousByLoad [s/m]
  CohesionLaw cohesion = CohesionLaw::none;
  double kc = 0.0;       ///< area: pull per area [Pa]; elastoPlastic: its stiffness [N/m]
  double w = 0.0;        ///< dmt, jkr: work of adhesion [J/m²]
  double kUnload = 0.0;  ///< elastoPlastic: the largest stiffness of unloading [N/m]
  /// elastoPlastic: φ, the overlap at zero force in units of 2 R₁₂ after which unloading has
  /// kUnload and no δ₀ grows [-]; 0: unloading has kUnload from the beginning, δ₀ grows on
  double plasticDepth = 0.0;
  LawConventions conventions;
  int dimension = 2;  ///< of what moves by it: 3 in space, where tangential springs are vectors

  bool soft() const { return normal != NormalLaw::rigid; }
  /// Whether stiffness, and with it the contact time, depends on how deep an impact goes.
  bool stiffens() const { return normal == NormalLaw::hertz || normal == NormalLaw::polynomial; }
  bool springs() const {
    return tangential == TangentialLaw::spring || tangential == TangentialLaw::springDashpot;
  }
  bool friction() const { return mu > 0.0 && (!soft() || tangential != TangentialLaw::none); }
  bool rolls() const { return rolling != RollingLaw::none; }
  bool inSpace() const { return dimension == 3; }
  bool coheres() const { return cohesion != CohesionLaw::none; }
  bool dashpots() const {
    return tangential == TangentialLaw::viscous || tangential == TangentialLaw::springDashpot;
  }

  bool operator==(const ContactLaw&) const = default;
};

/// Friction with the plate that the disks lie on (Lätzel 2003, Eqs. 4.27–4.29):
/// f* = −k_b ξ_b − γ_b v with a vector spring ξ_b per disk, limited to µ_b m g; its torque is
/// sign(f_M*) min(µ_b m g, |f_M*|)·(2/3)a with f_M* = −sign(ω) τ_M |f*| − γ_b ω a.
struct BottomPlate {
  double mu = 0.0;        ///< µ_b [-]
  double kb = 0.0;        ///< spring [N/m]
  double gb = 0.0;        ///< dashpot [kg/s]
  double tauM = 0.0;      ///< τ_M [-]
  double gravity = 9.81;  ///< g that presses a disk on the plate, normal to the plane [m/s²]
  bool spin = true;       ///< whether the plate also brakes spin

  bool operator==(const BottomPlate&) const = default;
};

}  // namespace crossgrain::inline contact_law
