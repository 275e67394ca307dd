#include <algorithm>
#include <cmath>
#include <optional>

#include "adapters/audit_forces.hpp"

namespace crossgrain {
namespace {

/// Of the first relative to the second where they touch, across the normal [m/s].
template <int D>
SpinOf<D> slidingOf(const SnapshotOf<D>& snapshot, const AuditBasisOf<D>& basis, std::size_t k) {
  const ContactsOf<D>& contacts = *snapshot.contacts;
  const auto i = static_cast<std::size_t>(contacts.i[k]);
  const auto j = static_cast<std::size_t>(contacts.j[k]);
  const VecOf<D> relative = snapshot.velocity[i] - snapshot.velocity[j], &n = contacts.normal[k];
  SpinOf<D> rims = noSpin<D>();  // a_i ω_i + a_j ω_j
  if (snapshot.spin)
    rims = basis.radius[i] * (*snapshot.spin)[i] + basis.radius[j] * (*snapshot.spin)[j];
  if constexpr (D == 2)
    return relative.dot(perpendicular(n)) - rims;
  else
    return relative - relative.dot(n) * n - rims.cross(n);
}

}  // namespace

template <int D>
bool pushesForSure(const AuditBasisOf<D>& basis, std::size_t i, std::size_t j, double overlap,
                   double parting) {
  const ContactLaw& law = basis.scene->lawOf(i, j);
  const CollidingPair pair = pairOf(basis, i, j);
  const ElasticPart elastic = elasticPart(law, pair, overlap);
  const double damper =
      std::max(dampingOf(law.damper, law.gn, elastic.stiffness, pair.reducedMass()),
               2.0 * std::sqrt(pair.reducedMass() * elastic.stiffness));
  return elastic.force > damper * parting;
}
template bool pushesForSure(const AuditBasis&, std::size_t, std::size_t, double, double);
template bool pushesForSure(const AuditBasisOf<3>&, std::size_t, std::size_t, double, double);

template <int D>
void addSliding(const SnapshotOf<D>& snapshot, const AuditBasisOf<D>& basis,
                const ContactLaw& ofAll, SlidingSense& sense) {
  constexpr double band = 0.01, certain = 2.0, clear = 3.0, digits = 1e-5;
  const SceneOf<D>& scene = *basis.scene;
  if (!snapshot.contacts || snapshot.contactInterval > 0.0 || !ofAll.soft() || ofAll.coheres() ||
      !(basis.dt > 0.0) || (scene.rotation && !snapshot.spin))
    return;
  const ContactsOf<D>& contacts = *snapshot.contacts;
  const auto isAtBound = [&](std::size_t k, const ContactLaw& law) {
    const double bound = law.mu * contacts.normalForce[k];
    return law.friction() && bound > 0.0 &&
           std::abs(sizeOf(contacts.tangentialForce[k]) - bound) <= band * bound;
  };
  std::optional<ContactPlacesOf<D>> places;
  std::optional<VelocityDoubt<D>> doubts;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const auto i = static_cast<std::size_t>(contacts.i[k]);
    const auto j = static_cast<std::size_t>(contacts.j[k]);
    if (j >= scene.disks.size()) continue;  // snapshots do not show how a wall's surface moves
    const ContactLaw law = ownLaw(basis, i, j, ofAll);
    if (!isAtBound(k, law)) continue;
    if (!doubts) {
      places = contactPlaces<D>(snapshot, basis);
      doubts.emplace(snapshot, basis, *places, ofAll);
    }
    const CollidingPair pair = pairOf(basis, i, j);
    const ElasticPart elastic = elasticPart(law, pair, contacts.overlap[k]);
    const double mass = pair.reducedMass(), load = contacts.normalForce[k];
    const VecOf<D> relative = snapshot.velocity[i] - snapshot.velocity[j];
    const double falling = elastic.stiffness * std::abs(relative.dot(contacts.normal[k])) +
                           dampingOf(law.damper, law.gn, elastic.stiffness, pair.reducedMass()) *
                               load / mass;  // of f_n, at most
    double least = law.springs() ? certain * law.mu * falling / elastic.tangential : 0.0;
    double speeds = 0.0;
    for (const std::size_t id : {i, j}) {
      least += clear * (doubts->centre[id] + doubts->rim[id]);
      const double spin = snapshot.spin ? sizeOf((*snapshot.spin)[id]) : 0.0;
      least += contacts.overlap[k] * spin;  // levers end at the surface or half an overlap before
      speeds += snapshot.velocity[id].norm() + basis.radius[id] * spin;
    }
    const SpinOf<D> sliding = slidingOf(snapshot, basis, k);
    if (!(sizeOf(sliding) > least + clear * digits * speeds)) continue;
    double power;
    if constexpr (D == 2)
      power = contacts.tangentialForce[k] * sliding;
    else
      power = contacts.tangentialForce[k].dot(sliding);
    ++(power > 0.0 ? sense.along : sense.against);
  }
}
template void addSliding(const Snapshot&, const AuditBasis&, const ContactLaw&, SlidingSense&);
template void addSliding(const SpaceSnapshot&, const AuditBasisOf<3>&, const ContactLaw&,
                         SlidingSense&);

}  // namespace crossgrain
