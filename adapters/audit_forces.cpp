#include "adapters/audit_forces.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

#include "adapters/near_pairs.hpp"
#include "law/law_options.hpp"

namespace crossgrain {

ElasticPart elasticPart(const ContactLaw& law, const CollidingPair& pair, double overlap) {
  const double radius = pair.reducedRadius();
  return {elasticForce(law, radius, overlap), normalStiffness(law, radius, overlap).value,
          tangentialStiffness(law, radius, overlap).value};
}

Attraction attraction(const ContactLaw& law, const CollidingPair& pair, double overlap) {
  using std::numbers::pi;
  const double radius = pair.reducedRadius(), pull = pullOff(law, radius);
  switch (law.cohesion) {
    case CohesionLaw::area: {
      const double force = -law.kc * cohesionArea(law, pair, overlap).value;
      return {force, force, 4.0 * pi * radius * law.kc};  // A′(0) is at most that
    }
    case CohesionLaw::dmt:
      return {-pull, -pull, 0.0, pull};
    case CohesionLaw::jkr: {
      // F = F_po (y⁶ − 2 y³), δ/unit = y⁴ − 4/3 y; dF/dδ has no bound at the end of the branch.
      const double unit = jkrUnit(law, radius), y = jkrRoot(overlap / unit), cube = y * y * y;
      const double force = pull * (cube - 2.0) * cube - elasticForce(law, radius, overlap);
      const double stiffness =
          pull * 6.0 * (cube - 1.0) * y * y / (std::max(4.0 * cube - 4.0 / 3.0, 2e-3) * unit);
      return {force, force, std::abs(stiffness), pull};
    }
    case CohesionLaw::elastoPlastic: {  // between loading, beyond δ* with kUnload, and the pull
      const double depth = std::max(overlap, 0.0), most = law.kUnload - law.kn;
      const double beyond = law.plasticDepth > 0.0
                                ? most * depth - law.kUnload * law.plasticDepth * 2.0 * radius
                                : 0.0;
      return {-(law.kc + law.kn) * depth, std::max(beyond, 0.0), law.kUnload + law.kc};
    }
    case CohesionLaw::none:
      break;
  }
  return {0.0, 0.0, 0.0};
}

template <int D>
ContactLaw ownLaw(const AuditBasisOf<D>& basis, std::size_t i, std::size_t j,
                  const ContactLaw& law) {
  if (!basis.scene->materials) return law;
  ContactLaw own = basis.scene->lawOf(i, j);
  for (const LawOption& option : lawOptions()) option.set(own, option.get(law));
  return own;
}

template ContactLaw ownLaw(const AuditBasis&, std::size_t, std::size_t, const ContactLaw&);
template ContactLaw ownLaw(const AuditBasisOf<3>&, std::size_t, std::size_t, const ContactLaw&);

template <int D>
VelocityDoubt<D>::VelocityDoubt(const SnapshotOf<D>& snapshot, const AuditBasisOf<D>& basis,
                                const ContactPlacesOf<D>& places, const ContactLaw& law)
    : centre(basis.scene->idCount()), rim(centre.size()), lapse_(stepsOfDoubt * basis.dt) {
  constexpr double change = 0.1;
  const SceneOf<D>& scene = *basis.scene;
  const ContactsOf<D>& contacts = *snapshot.contacts;
  std::vector<VecOf<D>> sum(centre.size(), VecOf<D>::Zero());
  std::vector<double> sizes(centre.size()), changes(centre.size());
  const ContactsByFirst shown(contacts, centre.size());
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const auto i = static_cast<std::size_t>(contacts.i[k]);
    const auto j = static_cast<std::size_t>(contacts.j[k]);
    const VecOf<D> force = contacts.force(k);
    const double size = force.norm();
    const bool began = isWithin(contacts.overlap[k], size, places, basis, i, j);
    const double much =
        began ? size
              : std::max(change * size, changeWithin(ownLaw(basis, i, j, law), contacts.overlap[k],
                                                     places, basis, i, j));
    for (const auto& [id, sign] : {std::pair(i, 1.0), {j, -1.0}}) {
      sum[id] += sign * force;
      sizes[id] += size;
      changes[id] += much;
    }
  }
  const auto addEnded = [&](std::size_t i, std::size_t j) {
    if (shown.count(contacts, i, j) > 0) return;
    const double last = lastForce(ownLaw(basis, i, j, law), places, basis, i, j);
    for (const std::size_t id : {i, j}) changes[id] += last;
  };
  const std::size_t disks = scene.disks.size(), round = basis.radius.size();
  if (std::ranges::all_of(places.position, [](const VecOf<D>& place) { return place.allFinite(); }))
    nearPairs<D>(places.position, basis.radius, disks, scene.box, addEnded);
  for (std::size_t p = 0; p < places.planes.size(); ++p)
    for (std::size_t i = 0; i < disks && places.planes[p].known; ++i) addEnded(i, round + p);

  double plate = 0.0;
  if constexpr (D == 2)
    if (scene.bottom) plate = scene.bottom->mu * scene.bottom->gravity;
  for (std::size_t i = 0; i < disks; ++i) {
    const double radius = scene.disks.radius[i], mass = scene.disks.mass[i];
    centre[i] = lapse_ * ((sum[i].norm() + changes[i]) / mass + scene.gravity.norm() + plate);
    rim[i] = lapse_ * sizes[i] * radius * radius / scene.disks.inertia[i];
  }
}

template <int D>
bool VelocityDoubt<D>::isWithin(double way, double force, const ContactPlacesOf<D>& places,
                                const AuditBasisOf<D>& basis, std::size_t i, std::size_t j) const {
  const VecOf<D> relative = places.velocity[i] - velocityOfSecond<D>(places, basis, i, j);
  const double speed = relative.norm() + lapse_ * force / pairOf(basis, i, j).reducedMass();
  return way >= 0.0 && way <= lapse_ * speed;
}

template <int D>
double VelocityDoubt<D>::changeWithin(const ContactLaw& law, double overlap,
                                      const ContactPlacesOf<D>& places,
                                      const AuditBasisOf<D>& basis, std::size_t i,
                                      std::size_t j) const {
  const CollidingPair pair = pairOf(basis, i, j);
  const VecOf<D> relative = places.velocity[i] - velocityOfSecond<D>(places, basis, i, j);
  return (elasticPart(law, pair, overlap).stiffness + attraction(law, pair, overlap).stiffness) *
         relative.norm() * lapse_;
}

template <int D>
double VelocityDoubt<D>::lastForce(const ContactLaw& law, const ContactPlacesOf<D>& places,
                                   const AuditBasisOf<D>& basis, std::size_t i,
                                   std::size_t j) const {
  const PairPlaceOf<D> place = pairPlace<D>(places, basis, i, j);
  const CollidingPair pair = pairOf(basis, i, j);
  const double separating =
      (places.velocity[i] - velocityOfSecond<D>(places, basis, i, j)).dot(place.normal);
  const bool pulls = law.conventions.tension == Tension::allow;
  const double dashpot =
      pulls
          ? dampingOf(law.damper, law.gn, elasticPart(law, pair, 0.0).stiffness, pair.reducedMass())
          : 0.0;
  double last = dashpot * std::max(separating, 0.0);
  if (law.coheres()) last += attraction(law, pair, 0.0).pullOff;
  last *= 1.0 + law.mu;
  const double gap = -place.overlap - bondRange(law, pair.reducedRadius());
  return isWithin(gap + place.uncertain, last, places, basis, i, j) ? last : 0.0;
}

template class VelocityDoubt<2>;
template class VelocityDoubt<3>;

}  // namespace crossgrain
