#include "adapters/audit_forces.hpp"

#include <algorithm>
#include <numbers>
#include <numeric>
#include <utility>

#include "adapters/near_pairs.hpp"
#include "law/law_options.hpp"

namespace crossgrain {

ElasticPart elasticPart(const ContactLaw& law, double overlap, double reducedRadius) {
  const double depth = std::max(overlap, 0.0);
  switch (law.normal) {
    case NormalLaw::linear:
      return {law.kn * overlap, law.kn, law.kt};
    case NormalLaw::hertz: {
      const double root = std::sqrt(reducedRadius * depth);
      return {law.kn * root * depth, 1.5 * law.kn * root, law.kt * root};
    }
    case NormalLaw::polynomial:
      return {(law.kn + law.kn3 * depth) * depth * depth,
              (2.0 * law.kn + 3.0 * law.kn3 * depth) * depth, law.kt};
    case NormalLaw::rigid:
      break;
  }
  return {0.0, 0.0, 0.0};
}

Attraction attraction(const ContactLaw& law, double overlap, double radius, double reach) {
  using std::numbers::pi;
  const double elastic = elasticPart(law, overlap, radius).force;
  switch (law.cohesion) {
    case CohesionLaw::area: {
      const double round = 2.0 * pi * radius;  // A′(0)
      double area = round * overlap;
      if (law.conventions.cohesionArea == CohesionArea::twiceBetweenDisks && reach > 0.0)
        area *= 2.0;
      if (law.conventions.cohesionArea == CohesionArea::lens) {
        // The lens of two spheres: π h² with h² = a_i² − x², x from the centre of i to its plane.
        const double a =
            reach > 0.0 ? 0.5 * (reach + std::sqrt(std::max(reach * (reach - 4.0 * radius), 0.0)))
                        : radius;
        const double d = reach - overlap, b = reach - a;
        const double x = reach > 0.0 ? (d * d + a * a - b * b) / (2.0 * d) : radius - overlap;
        area = pi * (a * a - x * x);
      }
      return {-law.kc * area, -law.kc * area, 2.0 * law.kc * round};
    }
    case CohesionLaw::dmt: {
      const double pull = 2.0 * pi * law.w * radius;
      return {-pull, -pull, 0.0, pull};
    }
    case CohesionLaw::jkr: {
      // F/F_po = x³ − 2 x^1.5, δ R/a_p² = x² − 4/3 √x, x = a/a_p, by bisection.
      const double width = std::cbrt(1.5 * pi * law.w * radius * radius / law.kn);
      const double wanted = overlap * radius / (width * width), pull = 1.5 * pi * law.w * radius;
      double low = 1.0 / std::cbrt(9.0), high = 2.0 + 2.0 * std::sqrt(std::max(wanted, 0.0));
      for (int k = 0; k < 100; ++k) {
        const double x = 0.5 * (low + high);
        (x * x - 4.0 / 3.0 * std::sqrt(x) < wanted ? low : high) = x;
      }
      const double force = pull * (low * low * low - 2.0 * std::pow(low, 1.5)) - elastic;
      // dF/dδ; it has no bound at the end of the branch.
      const double slope = 2.0 * low - 2.0 / 3.0 / std::sqrt(low);
      const double stiffness = pull * (3.0 * low * low - 3.0 * std::sqrt(low)) /
                               std::max(slope, 1e-3) * radius / (width * width);
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

double damping(Damper damper, double constant, double stiffness, double reducedMass) {
  if (damper == Damper::constant) return constant;
  if (damper == Damper::viscoelastic) return constant * stiffness;
  return constant * std::sqrt(reducedMass * stiffness);
}

template <int D>
double reducedMass(const SceneOf<D>& scene, std::size_t i, std::size_t j) {
  const double mass = scene.disks.mass[i];
  return j < scene.disks.size() ? mass * scene.disks.mass[j] / (mass + scene.disks.mass[j]) : mass;
}

template double reducedMass(const Scene&, std::size_t, std::size_t);
template double reducedMass(const SpaceScene&, std::size_t, std::size_t);

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

/// Pairs by their first: each has few, whose list is looked through faster than a tree.
class ListedPairs {
 public:
  template <int D>
  ListedPairs(const ContactsOf<D>& contacts, std::size_t bodies)
      : begin_(bodies + 1), second_(contacts.size()) {
    for (const std::int32_t i : contacts.i) ++begin_[static_cast<std::size_t>(i) + 1];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t k = 0; k < contacts.size(); ++k)
      second_[next[static_cast<std::size_t>(contacts.i[k])]++] = contacts.j[k];
  }
  bool contains(std::size_t i, std::size_t j) const {
    const auto at = [&](std::size_t k) {
      return second_.begin() + static_cast<std::ptrdiff_t>(begin_[k]);
    };
    return std::find(at(i), at(i + 1), static_cast<std::int32_t>(j)) != at(i + 1);
  }

 private:
  std::vector<std::size_t> begin_;
  std::vector<std::int32_t> second_;
};

template <int D>
VelocityDoubt<D>::VelocityDoubt(const SnapshotOf<D>& snapshot, const AuditBasisOf<D>& basis,
                                const ContactPlacesOf<D>& places, const ContactLaw& law)
    : centre(basis.scene->idCount()), rim(centre.size()), lapse_(stepsOfDoubt * basis.dt) {
  constexpr double change = 0.1;
  const SceneOf<D>& scene = *basis.scene;
  const ContactsOf<D>& contacts = *snapshot.contacts;
  std::vector<VecOf<D>> sum(centre.size(), VecOf<D>::Zero());
  std::vector<double> sizes(centre.size()), changes(centre.size());
  const ListedPairs shown(contacts, centre.size());
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
    if (shown.contains(i, j)) return;
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
  const double speed = relative.norm() + lapse_ * force / reducedMass(*basis.scene, i, j);
  return way >= 0.0 && way <= lapse_ * speed;
}

template <int D>
double VelocityDoubt<D>::changeWithin(const ContactLaw& law, double overlap,
                                      const ContactPlacesOf<D>& places,
                                      const AuditBasisOf<D>& basis, std::size_t i,
                                      std::size_t j) const {
  const double radius = reducedRadius<D>(basis, i, j);
  const double reach = j < basis.radius.size() ? basis.radius[i] + basis.radius[j] : 0.0;
  const VecOf<D> relative = places.velocity[i] - velocityOfSecond<D>(places, basis, i, j);
  return (elasticPart(law, overlap, radius).stiffness +
          attraction(law, overlap, radius, reach).stiffness) *
         relative.norm() * lapse_;
}

template <int D>
double VelocityDoubt<D>::lastForce(const ContactLaw& law, const ContactPlacesOf<D>& places,
                                   const AuditBasisOf<D>& basis, std::size_t i,
                                   std::size_t j) const {
  const PairPlaceOf<D> place = pairPlace<D>(places, basis, i, j);
  const double radius = reducedRadius<D>(basis, i, j);
  const double separating =
      (places.velocity[i] - velocityOfSecond<D>(places, basis, i, j)).dot(place.normal);
  const double reach = j < basis.radius.size() ? basis.radius[i] + basis.radius[j] : 0.0;
  const double mass = reducedMass(*basis.scene, i, j);
  const bool pulls = law.conventions.tension == Tension::allow;
  const double dashpot =
      pulls ? damping(law.damper, law.gn, elasticPart(law, 0.0, radius).stiffness, mass) : 0.0;
  double last = dashpot * std::max(separating, 0.0);
  if (law.coheres()) last += attraction(law, 0.0, radius, reach).pullOff;
  last *= 1.0 + law.mu;
  const double gap = -place.overlap - bondReach(law, radius);
  return isWithin(gap + place.uncertain, last, places, basis, i, j) ? last : 0.0;
}

template class VelocityDoubt<2>;
template class VelocityDoubt<3>;

}  // namespace crossgrain
