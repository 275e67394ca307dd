#include "adapters/scene.hpp"

namespace crossgrain {

std::string toString(Precision precision) {
  return std::string(precisionNames[static_cast<std::size_t>(precision)]);
}

std::size_t Scene::wallDiskCount() const {
  std::size_t count = 0;
  for (const WallBody& body : bodies) count += body.diskRadius.size();
  return count;
}

std::size_t Scene::planeCount() const {
  std::size_t count = 0;
  for (const WallBody& body : bodies) count += body.planes.size();
  return count;
}

}  // namespace crossgrain
