#include <algorithm>
#include <cmath>

#include "stability/measures.hpp"

namespace crossgrain::inline stability {

namespace {

/// M⁻¹K applied to displacements: normal springs k_n of the start's contacts.
template <int D>
std::vector<VecOf<D>> accelerations(const SceneOf<D>& scene,
                                    const std::vector<OverlapOf<D>>& contacts,
                                    const std::vector<VecOf<D>>& displaced) {
  const DisksOf<D>& disks = scene.disks;
  std::vector<VecOf<D>> result(disks.size(), VecOf<D>::Zero());
  for (const OverlapOf<D>& contact : contacts) {
    const bool pair = contact.j < disks.size();
    VecOf<D> apart = displaced[contact.i];
    if (pair) apart -= displaced[contact.j];
    const double kn = scene.lawOf(contact.i, contact.j).kn;
    const VecOf<D> force = kn * apart.dot(contact.normal) * contact.normal;
    result[contact.i] += force / disks.mass[contact.i];
    if (pair) result[contact.j] -= force / disks.mass[contact.j];
  }
  return result;
}

template <int D>
double lengthOf(const std::vector<VecOf<D>>& vectors) {
  double squares = 0.0;
  for (const VecOf<D>& vector : vectors) squares += vector.squaredNorm();
  return std::sqrt(squares);
}

template <int D>
std::vector<OverlapOf<D>> startContacts(const SceneOf<D>& scene) {
  return overlapsOf(scene, scene.disks.position, 0.0);
}

}  // namespace

template <int D>
double theoreticalStepLimit(const SceneOf<D>& scene) {
  const std::vector<OverlapOf<D>> contacts = startContacts(scene);
  // Power iteration, from a vector without symmetry.
  std::vector<VecOf<D>> mode;
  for (std::size_t i = 0; i < scene.disks.size(); ++i) {
    const auto k = static_cast<double>(i);
    VecOf<D>& vector = mode.emplace_back();
    vector.head(2) = Vec2(std::cos(1.0 + 2.3 * k * k), std::sin(2.0 + 1.7 * k * k));
    if (D == 3) vector[D - 1] = std::cos(3.0 + 1.1 * k * k);
  }
  double squared = 0.0;
  for (int iteration = 0; iteration < 2000; ++iteration) {
    const double length = lengthOf<D>(mode);
    for (VecOf<D>& vector : mode) vector /= length;
    mode = accelerations<D>(scene, contacts, mode);
    squared = lengthOf<D>(mode);
    if (squared == 0.0) return INFINITY;
  }
  return 2.0 / std::sqrt(squared);
}
template double theoreticalStepLimit<2>(const Scene&);
template double theoreticalStepLimit<3>(const SpaceScene&);

template <int D>
double coordinationStepLimit(const SceneOf<D>& scene) {
  double kn = scene.law.kn;
  if (scene.materials) kn = std::ranges::max(scene.materials->laws, {}, &ContactLaw::kn).kn;
  std::vector<int> count(scene.disks.size(), 0);
  for (const OverlapOf<D>& contact : startContacts(scene)) {
    ++count[contact.i];
    if (contact.j < count.size()) ++count[contact.j];
  }
  double limit = INFINITY;
  for (std::size_t i = 0; i < count.size(); ++i)
    if (count[i] > 0)
      limit = std::min(limit, 2.0 * std::sqrt(scene.disks.mass[i] / (2.0 * kn * count[i])));
  return limit;
}
template double coordinationStepLimit<2>(const Scene&);
template double coordinationStepLimit<3>(const SpaceScene&);

}  // namespace crossgrain::inline stability
