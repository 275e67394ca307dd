#include <algorithm>
#include <cmath>

#include "oracle/impact.hpp"
#include "stability/recording.hpp"

namespace crossgrain::inline stability {

namespace {

double kineticEnergy(const Disks& disks, const Snapshot& snapshot) {
  const std::vector<double>& spin = snapshot.spin ? *snapshot.spin : disks.spin;
  double energy = 0.0;
  for (std::size_t i = 0; i < disks.size(); ++i)
    energy += 0.5 * disks.mass[i] * snapshot.velocity[i].squaredNorm() +
              0.5 * disks.inertia[i] * spin[i] * spin[i];
  return energy;
}

/// Whether the engine has impulses where the scene has springs.
bool hasNoSprings(const Recording& run) {
  return !run.scene.law.soft() ||
         std::ranges::find(run.effective.deviations, "normal", &Deviation::name) !=
             run.effective.deviations.end();
}

double tangentialEnergy(const Recording& run, const Snapshot& snapshot) {
  const ContactLaw& law = run.scene.law;
  const bool constant = law.springs() && law.normal == NormalLaw::linear;
  if (!constant || !snapshot.contacts || run.effective.pairs.empty()) return 0.0;
  const Contacts& contacts = *snapshot.contacts;
  double energy = 0.0;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const double force = contacts.tangentialForce[k];
    const double kt = run.scene.materials ? run.scene
                                                .lawOf(static_cast<std::size_t>(contacts.i[k]),
                                                       static_cast<std::size_t>(contacts.j[k]))
                                                .kt
                                          : run.effective.pairs.front().kt;
    if (kt > 0.0) energy += 0.5 * force * force / kt;
  }
  return energy;
}

}  // namespace

EnergyState energyOf(const Recording& run, const Snapshot& snapshot) {
  const Scene& scene = run.scene;
  const double t = timeOfVelocities(snapshot, run.effective.velocityLag);
  const double later = snapshot.positionTime - t;
  // Not the ledger's tangential springs: where they slip, a convention may put into them what no
  // force ever gives back.
  if (const auto& ledger = snapshot.ledger) {
    EnergyState energy{
        ledger->kinetic,
        ledger->elasticNormal + ledger->plateSprings + tangentialEnergy(run, snapshot),
        ledger->potential};
    for (std::size_t i = 0; i < snapshot.position.size(); ++i)  // at the time of the velocities
      energy.potential += later * scene.disks.mass[i] * scene.gravity.dot(snapshot.velocity[i]);
    return energy;
  }
  std::vector<Vec2> position = snapshot.position;
  for (std::size_t i = 0; i < position.size(); ++i) position[i] -= later * snapshot.velocity[i];

  EnergyState energy;
  energy.kinetic = kineticEnergy(scene.disks, snapshot);
  for (std::size_t i = 0; i < position.size(); ++i)
    energy.potential -= scene.disks.mass[i] * scene.gravity.dot(position[i]);
  if (hasNoSprings(run) && snapshot.positionTime > 0.0) return energy;
  ContactLaw law = scene.law;
  if (law.normal == NormalLaw::linear && !run.effective.pairs.empty())
    law.kn = run.effective.pairs.front().kn;
  for (const Overlap& overlap : overlapsOf(scene, position, t))
    energy.elastic += elasticEnergy(scene.materials ? scene.lawOf(overlap.i, overlap.j) : law,
                                    overlap.reducedRadius, overlap.depth);
  energy.elastic += tangentialEnergy(run, snapshot);
  return energy;
}

double energyScale(const Recording& run) {
  const Disks& disks = run.scene.disks;
  const EnergyState start = energyOf(run, run.snapshots.front());
  double scale = start.kinetic + start.elastic;
  for (std::size_t i = 0; i < disks.size(); ++i)
    scale += disks.mass[i] * run.scene.gravity.norm() * disks.radius[i];
  if (scale > 0.0) return scale;
  for (const Snapshot& snapshot : run.snapshots) {
    const EnergyState now = energyOf(run, snapshot);
    scale = std::max(scale, now.kinetic + now.elastic);
  }
  return scale;
}

}  // namespace crossgrain::inline stability
