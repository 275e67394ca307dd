#include <algorithm>
#include <cmath>

#include "stability/measures.hpp"

namespace crossgrain::inline stability {

namespace {

/// M⁻¹K applied to displacements: normal springs k_n of the start's contacts.
std::vector<Vec2> accelerations(const Scene& scene, const std::vector<Overlap>& contacts,
                                const std::vector<Vec2>& displaced) {
  const Disks& disks = scene.disks;
  std::vector<Vec2> result(disks.size(), Vec2::Zero());
  for (const Overlap& contact : contacts) {
    const bool pair = contact.j < disks.size();
    const Vec2 apart = pair ? displaced[contact.i] - displaced[contact.j] : displaced[contact.i];
    const double kn = scene.lawOf(contact.i, contact.j).kn;
    const Vec2 force = kn * apart.dot(contact.normal) * contact.normal;
    result[contact.i] += force / disks.mass[contact.i];
    if (pair) result[contact.j] -= force / disks.mass[contact.j];
  }
  return result;
}

double lengthOf(const std::vector<Vec2>& vectors) {
  double squares = 0.0;
  for (const Vec2& vector : vectors) squares += vector.squaredNorm();
  return std::sqrt(squares);
}

std::vector<Overlap> startContacts(const Scene& scene) {
  return overlapsOf(scene, scene.disks.position, 0.0);
}

}  // namespace

double theoreticalStepLimit(const Scene& scene) {
  const std::vector<Overlap> contacts = startContacts(scene);
  // Power iteration, from a vector without symmetry.
  std::vector<Vec2> mode;
  for (std::size_t i = 0; i < scene.disks.size(); ++i) {
    const auto k = static_cast<double>(i);
    mode.emplace_back(std::cos(1.0 + 2.3 * k * k), std::sin(2.0 + 1.7 * k * k));
  }
  double squared = 0.0;
  for (int iteration = 0; iteration < 2000; ++iteration) {
    const double length = lengthOf(mode);
    for (Vec2& vector : mode) vector /= length;
    mode = accelerations(scene, contacts, mode);
    squared = lengthOf(mode);
    if (squared == 0.0) return INFINITY;
  }
  return 2.0 / std::sqrt(squared);
}

double coordinationStepLimit(const Scene& scene) {
  double kn = scene.law.kn;
  if (scene.materials) kn = std::ranges::max(scene.materials->laws, {}, &ContactLaw::kn).kn;
  std::vector<int> count(scene.disks.size(), 0);
  for (const Overlap& contact : startContacts(scene)) {
    ++count[contact.i];
    if (contact.j < count.size()) ++count[contact.j];
  }
  double limit = INFINITY;
  for (std::size_t i = 0; i < count.size(); ++i)
    if (count[i] > 0)
      limit = std::min(limit, 2.0 * std::sqrt(scene.disks.mass[i] / (2.0 * kn * count[i])));
  return limit;
}

}  // namespace crossgrain::inline stability
