#include "averaging/space_rings.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "averaging/volumes.hpp"

namespace crossgrain::inline averaging {

namespace {

double periodAlongZ(const std::optional<BoxOf<3>>& box) {
  if (!box) return 0.0;
  if (box->periodic[0] || box->periodic[1])
    throw std::invalid_argument(
        "bins: rings about the z axis do not go with a box that is periodic along x or y");
  return box->periodic[2] ? box->high.z() - box->low.z() : 0.0;
}

}  // namespace

SpaceRings::SpaceRings(double innerRadius, double outerRadius, int rings, double low, double high,
                       int layers, const std::optional<BoxOf<3>>& box)
    : rings_(innerRadius, outerRadius, rings, 0.0, "r"),
      layers_(low, high, layers, periodAlongZ(box), "z") {
  if (!(innerRadius >= 0.0))
    throw std::invalid_argument("bins: the inner radius must be 0 or more");
}

double SpaceRings::volume(std::size_t slot) const {
  const int ring = static_cast<int>(slot - 1) % rings_.count();
  const double inner = rings_.edge(ring), outer = rings_.edge(ring + 1);
  return std::numbers::pi * (outer - inner) * (outer + inner) * layers_.width();
}

std::size_t SpaceRings::slotAt(const Vec3& x) const {
  const auto ring = rings_.at(x.head<2>().norm()), layer = layers_.at(x.z());
  return ring && layer ? slot(*ring, *layer) : 0;
}

Eigen::Matrix3d SpaceRings::directions(const Vec3& x) const {
  const double r = x.head<2>().norm();
  const double c = r > 0.0 ? x.x() / r : 1.0, s = r > 0.0 ? x.y() / r : 0.0;
  Eigen::Matrix3d columns;
  columns << c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0;
  return columns;
}

void SpaceRings::addVolumes(const Vec3& x, double a, BinFractions& fractions) const {
  const double s = x.head<2>().norm() / a;
  std::vector<Parts::Cut> across, along;
  rings_.cut(a * s, a, across);
  layers_.cut(x.z(), a, along);
  double rest = 1.0;
  for (const auto& layer : along) {
    const auto inside = [&](double R) {
      return fractionInCylinder(s, R / a, layer.from / a, layer.to / a);
    };
    double before = across.empty() ? 0.0 : inside(rings_.edge(across.front().part));
    for (const auto& ring : across) {
      const double within = std::max(inside(rings_.edge(ring.part + 1)), before);
      fractions.push_back({slot(ring.part, layer.part), within - before});
      rest -= within - before;
      before = within;
    }
  }
  fractions.push_back({0, std::max(rest, 0.0)});
}

void SpaceRings::lineFractions(const Vec3& x, const Vec3& step, const Weight&,
                               std::vector<LineFraction>& fractions) const {
  fractions.clear();
  std::vector<double> ends = {0.0, 1.0};
  layers_.crossings(x.z(), step.z(), ends);
  // |x + s step| = R across the axis
  const double square = step.head<2>().squaredNorm(), half = x.head<2>().dot(step.head<2>());
  for (int k = 0; square > 0.0 && k <= rings_.count(); ++k) {
    const double R = rings_.edge(k);
    const double under = half * half - square * (x.head<2>().squaredNorm() - R * R);
    if (!(under > 0.0)) continue;
    for (const double root : {-std::sqrt(under), std::sqrt(under)})
      if (const double s = (-half + root) / square; s > 0.0 && s < 1.0) ends.push_back(s);
  }
  std::ranges::sort(ends);
  const std::vector<BranchPoint> points = branchPoints(1.0, 1.0);
  for (std::size_t piece = 0; piece + 1 < ends.size(); ++piece) {
    const double part = ends[piece + 1] - ends[piece];
    if (part == 0.0) continue;
    const std::size_t where = slotAt(x + 0.5 * (ends[piece] + ends[piece + 1]) * step);
    for (const auto& [place, share] : points)
      fractions.push_back({where, part * share, x + (ends[piece] + part * place) * step});
  }
}

}  // namespace crossgrain::inline averaging
