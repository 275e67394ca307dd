#include "averaging/layer_spin.hpp"

#include <cmath>

namespace crossgrain::inline averaging {

namespace {

Rings layersOf(const Rings& cell) {
  const double width = cell.outerRadius() - cell.innerRadius();
  return Rings(cell.innerRadius(), cell.outerRadius(),
               static_cast<int>(std::lround(3.0 * width / cell.diameter())), cell.height(),
               cell.diameter());
}

}  // namespace

LayerSpin::LayerSpin(const Rings& cell, const Scene& scene)
    : rings_(layersOf(cell)),
      radius_(scene.disks.radius),
      area_(rings_.slots()),
      spin_(rings_.slots()) {}

void LayerSpin::add(const Snapshot& snapshot) {
  if (!snapshot.spin) return;
  for (std::size_t disk = 0; disk < radius_.size(); ++disk) {
    const double a = radius_[disk];
    const std::size_t slot = rings_.slotAt(snapshot.position[disk]);
    area_[slot] += a * a;
    spin_[slot] += a * a * (*snapshot.spin)[disk];
  }
}

std::vector<FitPoint> LayerSpin::points(double scale) const {
  std::vector<FitPoint> points;
  for (int ring = 0; ring < rings_.count(); ++ring)
    if (const std::size_t slot = rings_.slot(ring); area_[slot] > 0.0)
      points.push_back({rings_.rTilde(ring), scale * spin_[slot] / area_[slot], {}});
  return points;
}

}  // namespace crossgrain::inline averaging
