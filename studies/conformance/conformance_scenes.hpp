#pragma once

#include <string>
#include <vector>

#include "adapters/engine.hpp"
#include "adapters/scene.hpp"
#include "law/contact_law.hpp"
#include "studies/conformance/thesis_numbers.hpp"

/// Contact laws, parts of scenes and scenes that checks and tests share.
namespace crossgrain::conformance {

// ---- laws ---------------------------------------------------------------------------------------

/// Lätzel (2003), Table 4.1; every convention at its default, the thesis' own.
inline ContactLaw thesisLaw(TangentialLaw tangential = TangentialLaw::springDashpot) {
  ContactLaw law = withThesisConstants(ContactLaw{});
  law.tangential = tangential;
  return law;
}

/// Hertz' law between alike bodies, 1/E₁₂ = 2 (1 − ν²)/E, with critical dampers; as stiff as the
/// thesis' law where small disks meet at 0.1 m/s.
inline ContactLaw hertzLaw() {
  ContactLaw law;
  law.normal = NormalLaw::hertz;
  law.damper = Damper::critical;
  law.kn = 7e5;
  law.kt = 1.2 * law.kn;  // ν = 1/3
  law.gn = 0.3;
  law.gt = 0.2;
  law.mu = thesis.mu;
  return law;
}

// ---- parts of scenes ----------------------------------------------------------------------------

/// A disk, or sphere, of J = q m a² [m, kg, m, m/s, rad/s].
template <int D>
void addRound(SceneOf<D>& scene, double radius, double mass, double q, const VecOf<D>& position,
              const VecOf<D>& velocity, const SpinOf<D>& spin) {
  DisksOf<D>& disks = scene.disks;
  disks.radius.push_back(radius);
  disks.mass.push_back(mass);
  disks.inertia.push_back(q * mass * radius * radius);
  disks.position.push_back(position);
  disks.velocity.push_back(velocity);
  disks.spin.push_back(spin);
}
/// A solid disk.
inline void addDisk(Scene& scene, double radius, double mass, const Vec2& position,
                    const Vec2& velocity, double spin = 0.0) {
  addRound<2>(scene, radius, mass, solidDisk, position, velocity, spin);
}

/// A body of one plane.
inline WallBody planeWall(const Vec2& point, const Vec2& normal) {
  WallBody body;
  body.name = "plane";
  body.planes = {{point, normal}};
  return body;
}

/// At a constant ω [rad/s].
inline Motion rotating(double omega) {
  Motion motion;
  motion.kind = Motion::Kind::rotating;
  motion.angularVelocity = omega;
  return motion;
}

// ---- scenes -------------------------------------------------------------------------------------

/// The thesis' law; its rigid side, for engines that have only that, restores e_n = 0.8 and
/// e_t0 = 0.3.
ContactLaw fullLaw();

/// The law without anything that could turn a disk.
ContactLaw frictionless(ContactLaw law);

/// Time steps in one contact of two small disks: where an outcome is compared with a theory, and
/// where only properties are that hold at every step.
inline constexpr double fineSteps = 400.0, coarseSteps = 50.0;

/// A scene without disks; its time step resolves the contact of two small disks by `steps`, at
/// Encounter::speed where that matters.
Scene emptyScene(const ContactLaw& law, double steps);

/// A body of wall disks of the small radius.
WallBody wallOf(const std::string& name, const Vec2& centre, const std::vector<Vec2>& disks,
                const Motion& motion = {});

/// Two disks that meet. Disk 0 comes from the right at `speed` relative to disk 1; the line of
/// centres makes the angle `obliqueness` with the path when they touch. Their centre of mass starts
/// at the origin and moves at `drift`.
struct Encounter {
  double radii[2] = {smallRadius, smallRadius};
  double masses[2] = {smallMass, smallMass};
  double obliqueness = 0.0;  ///< [rad]
  double spins[2] = {0.0, 0.0};
  Vec2 drift = Vec2::Zero();

  static constexpr double speed = 0.1;   ///< [m/s]
  static constexpr double gap = 1.3e-4;  ///< flown through before they touch [m]
  static constexpr double end = 0.01;    ///< by then every pair used here has parted [s]

  double reducedMass() const { return masses[0] * masses[1] / (masses[0] + masses[1]); }
};

/// An oblique impact of unequal disks that drift and spin: no symmetry hides a wrong sign.
Encounter crookedEncounter();

/// @param steps  time steps in one contact of two small disks
Scene encounterScene(const Encounter& pair, const ContactLaw& law, double steps);

/// A disk that meets a plane at 45°, a little more slowly, and turns.
Scene landingScene(const ContactLaw& law, double steps);

/// Disks that are heaped on a turning wheel between posts: many contacts of all kinds but planes.
/// There are some at busyEnd.
Scene busyScene(const ContactLaw& law);
inline constexpr double busyEnd = 0.02;  ///< [s]

/// The same on the thesis' plate: it calls for everything that a law of the thesis has.
Scene plateScene(const ContactLaw& law);

/// Every disk and wall of one and the same material: pairs could differ.
Scene withMaterials(Scene scene);

/// Everything moved by that much [m].
Scene shifted(Scene scene, const Vec2& by);

// ---- laws that an engine declares ---------------------------------------------------------------
// Of those the ones that checks try, each with constants under which its parts show in a collision
// of small disks at Encounter::speed.

/// Constants of dashpots that take away about as much, whatever they multiply: e_n is between 0.2
/// and 0.9.
void setDampers(ContactLaw& law, const std::string& damper);

/// That normal law with the engine's own conventions.
ContactLaw lawOf(const Capabilities& can, const std::string& normal);

/// The law that resists rolling like that: with spins of some 10 rad/s springs stick and slip.
/// Constants are in the units of the conventions that it has.
ContactLaw withRolling(ContactLaw law, RollingLaw rolling);

/// The law with that attraction: a fifth of the largest force, area two fifths of the stiffness.
ContactLaw withCohesion(ContactLaw law, CohesionLaw cohesion);

/// Kinds of rolling resistance and of cohesion that the engine declares; empty: none.
std::vector<RollingLaw> rollingLaws(const Capabilities& can);
std::vector<CohesionLaw> cohesionLaws(const Capabilities& can);

/// Whether that attraction goes with the law's elastic force: JKR's is one of Hertz' law.
bool goesWith(CohesionLaw cohesion, NormalLaw normal);

/// Every law with rolling resistance and every one with cohesion, each with the first normal law
/// that it goes with, alone and with rolling resistance where the engine has both.
std::vector<ContactLaw> resistingLaws(const Capabilities& can);

/// A scene that calls for every effect there is: of a soft law that also resists rolling and
/// coheres, as the engine does where it does.
/// @param law  its soft part; of a rigid one the thesis' law stands for it
Scene fullScene(const Capabilities& can, const ContactLaw& law);

}  // namespace crossgrain::conformance
