#include <algorithm>
#include <cmath>
#include <numbers>

#include "law/cohesion.hpp"
#include "oracle/calibration.hpp"
#include "oracle/impact.hpp"
#include "stability/recording.hpp"

namespace crossgrain::inline stability {

template <int D>
bool hasNoSprings(const RecordingOf<D>& run) {
  return !run.scene.law.soft() ||
         std::ranges::find(run.effective.deviations, "normal", &Deviation::name) !=
             run.effective.deviations.end();
}
template bool hasNoSprings<2>(const Recording&);
template bool hasNoSprings<3>(const SpaceRecording&);

namespace {

double square(double value) {
  return value * value;
}
double square(const Vec3& value) {
  return value.squaredNorm();
}

}  // namespace

template <int D>
double kineticEnergy(const DisksOf<D>& disks, const SnapshotOf<D>& snapshot) {
  const std::vector<SpinOf<D>>& spin = snapshot.spin ? *snapshot.spin : disks.spin;
  double energy = 0.0;
  for (std::size_t i = 0; i < disks.size(); ++i) {
    energy += 0.5 * disks.mass[i] * snapshot.velocity[i].squaredNorm();
    if constexpr (D == 2)
      energy += 0.5 * disks.inertia[i] * square(spin[i]);
    else
      energy += spinEnergy(disks, i, spin[i], turnIn(snapshot, i));
  }
  return energy;
}
template double kineticEnergy<2>(const Disks&, const Snapshot&);
template double kineticEnergy<3>(const DisksOf<3>&, const SpaceSnapshot&);

namespace {

template <int D>
double tangentialEnergy(const RecordingOf<D>& run, const SnapshotOf<D>& snapshot) {
  const ContactLaw& law = run.scene.law;
  const bool constant = law.springs() && law.normal == NormalLaw::linear;
  if (!constant || !snapshot.contacts || !run.effective.effects.contains(Effect::tangentialSpring))
    return 0.0;
  const std::vector<PairCoefficients>& pairs = run.effective.pairs;
  const ContactsOf<D>& contacts = *snapshot.contacts;
  double energy = 0.0;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const double kt = run.scene.materials ? run.scene
                                                .lawOf(static_cast<std::size_t>(contacts.i[k]),
                                                       static_cast<std::size_t>(contacts.j[k]))
                                                .kt
                      : pairs.empty() ? law.kt
                                      : pairs.front().kt;
    if (kt > 0.0) energy += 0.5 * square(contacts.tangentialForce[k]) / kt;
  }
  return energy;
}

/// ½ M²/k_r(…) of a rolling spring's torques, which a dashpot may be part of.
template <int D>
double rollingEnergy(const RecordingOf<D>& run, const SnapshotOf<D>& snapshot) {
  if (run.law.rolling != RollingLaw::spring || !snapshot.contacts) return 0.0;
  const ContactsOf<D>& contacts = *snapshot.contacts;
  const std::vector<double> radius = run.scene.radii();
  double energy = 0.0;
  for (std::size_t k = 0; k < contacts.rollingTorque.size(); ++k) {
    const double a = radius[static_cast<std::size_t>(contacts.i[k])];
    const auto j = static_cast<std::size_t>(contacts.j[k]);
    const bool plane = j >= radius.size();
    const ContactLaw& law =
        run.scene.materials ? run.scene.lawOf(static_cast<std::size_t>(contacts.i[k]), j) : run.law;
    CollidingPair pair{};
    pair.radius[0] = a;
    pair.radius[1] = plane ? 0.0 : radius[j];
    pair.plane = plane;
    const double stiffness = law.kr * rollingSquare(law, pair);
    energy += 0.5 * square(contacts.rollingTorque[k]) / stiffness;
  }
  return energy;
}

/// JKR's energy at an overlap, 0 at the first touch, negative where the bond holds: with the radius
/// of contact a = a_p y² the integral of F_po (y⁶ − 2 y³) over δ = (a_p²/R)(y⁴ − 4/3 y) is
/// F_po (a_p²/R)(2/5 y¹⁰ − 4/3 y⁷ + 2/3 y⁴) (Johnson, Kendall and Roberts 1971).
double jkrEnergy(const ContactLaw& law, double radius, double overlap) {
  const double unit = jkrUnit(law, radius);
  const auto integral = [](double y) {
    const double power = y * y * y * y;
    return power * (0.4 * power * y * y - 4.0 / 3.0 * y * y * y + 2.0 / 3.0);
  };
  return pullOff(law, radius) * unit *
         (integral(jkrRoot(overlap / unit)) - integral(std::cbrt(4.0 / 3.0)));
}

/// Of the normal force without its dashpot [J]. Areas are those to first order. An elasto-plastic
/// contact's is not a matter of its overlap alone: plasticEnergy().
template <int D>
double bodyEnergy(const ContactLaw& law, const OverlapOf<D>& at) {
  const double elastic = elasticEnergy(law, at.reducedRadius, at.depth);
  const double round = std::numbers::pi * at.reducedRadius;
  if (law.cohesion == CohesionLaw::dmt) return elastic - pullOff(law, at.reducedRadius) * at.depth;
  if (law.cohesion == CohesionLaw::jkr) return jkrEnergy(law, at.reducedRadius, at.depth);
  if (law.cohesion == CohesionLaw::area) {
    const bool twice = law.conventions.cohesionArea == CohesionArea::twiceBetweenDisks &&
                       at.smallerRadius != at.reducedRadius;
    return elastic - (twice ? 2.0 : 1.0) * round * law.kc * at.depth * at.depth;
  }
  return law.cohesion == CohesionLaw::elastoPlastic ? 0.0 : elastic;
}

/// Energy that unloading gives back, ½ f²/k₂ with the stiffest k₂ there is: no more than there is.
template <int D>
double plasticEnergy(const ContactLaw& law, const SnapshotOf<D>& snapshot) {
  if (law.cohesion != CohesionLaw::elastoPlastic || !snapshot.contacts) return 0.0;
  double energy = 0.0;
  for (const double force : snapshot.contacts->normalForce)
    energy += 0.5 * force * force / law.kUnload;
  return energy;
}

/// Of JKR's bonds beyond the end of geometric contact, as far as they are shown [J].
template <int D>
double stretchedBonds(const ContactLaw& law, const RecordingOf<D>& run,
                      const SnapshotOf<D>& snapshot) {
  if (law.cohesion != CohesionLaw::jkr || !snapshot.contacts) return 0.0;
  const ContactsOf<D>& contacts = *snapshot.contacts;
  const std::vector<double> radius = run.scene.radii();
  double energy = 0.0;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    if (contacts.overlap[k] > 0.0) continue;
    const double a = radius[static_cast<std::size_t>(contacts.i[k])];
    const auto j = static_cast<std::size_t>(contacts.j[k]);
    energy += jkrEnergy(law, j < radius.size() ? a * radius[j] / (a + radius[j]) : a,
                        contacts.overlap[k]);
  }
  return energy;
}

}  // namespace

template <int D>
EnergyState energyOf(const RecordingOf<D>& run, const SnapshotOf<D>& snapshot) {
  const SceneOf<D>& scene = run.scene;
  const double t = timeOfVelocities(snapshot, run.effective.velocityLag);
  const double later = snapshot.positionTime - t;
  // Not the ledger's tangential springs: where they slip, a convention may put into them what no
  // force ever gives back.
  if (const auto& ledger = snapshot.ledger) {
    EnergyState energy{ledger->kinetic,
                       ledger->elasticNormal + ledger->plateSprings + ledger->elasticRolling +
                           tangentialEnergy(run, snapshot),
                       ledger->potential};
    for (std::size_t i = 0; i < snapshot.position.size(); ++i)  // at the time of the velocities
      energy.potential += later * scene.disks.mass[i] * scene.gravity.dot(snapshot.velocity[i]);
    return energy;
  }
  std::vector<VecOf<D>> position = snapshot.position;
  for (std::size_t i = 0; i < position.size(); ++i) position[i] -= later * snapshot.velocity[i];

  EnergyState energy;
  energy.kinetic = kineticEnergy(scene.disks, snapshot);
  for (std::size_t i = 0; i < position.size(); ++i)
    energy.potential -= scene.disks.mass[i] * scene.gravity.dot(position[i]);
  if (hasNoSprings(run) && snapshot.positionTime > 0.0) return energy;
  ContactLaw law = scene.law;
  if (law.normal == NormalLaw::linear && !run.effective.pairs.empty())
    law.kn = run.effective.pairs.front().kn;
  for (const OverlapOf<D>& overlap : overlapsOf(scene, position, t))
    energy.elastic +=
        bodyEnergy(scene.materials ? scene.lawOf(overlap.i, overlap.j) : law, overlap);
  energy.elastic += plasticEnergy(law, snapshot) + stretchedBonds(law, run, snapshot);
  energy.elastic += tangentialEnergy(run, snapshot) + rollingEnergy(run, snapshot);
  return energy;
}
template EnergyState energyOf<2>(const Recording&, const Snapshot&);
template EnergyState energyOf<3>(const SpaceRecording&, const SpaceSnapshot&);

template <int D>
double energyScale(const RecordingOf<D>& run) {
  const DisksOf<D>& disks = run.scene.disks;
  const EnergyState start = energyOf(run, run.snapshots.front());
  double scale = start.kinetic + std::abs(start.elastic);
  for (std::size_t i = 0; i < disks.size(); ++i)
    scale += disks.mass[i] * run.scene.gravity.norm() * disks.radius[i];
  if (scale > 0.0) return scale;
  for (const SnapshotOf<D>& snapshot : run.snapshots) {
    const EnergyState now = energyOf(run, snapshot);
    scale = std::max(scale, now.kinetic + std::abs(now.elastic));
  }
  return scale;
}
template double energyScale<2>(const Recording&);
template double energyScale<3>(const SpaceRecording&);

}  // namespace crossgrain::inline stability
