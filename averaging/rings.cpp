#include "averaging/rings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace crossgrain {

namespace {

void require(bool held, const char* what, double value) {
  if (!held) throw std::invalid_argument(fmt::format("rings: {}, got {}", what, value));
}

}  // namespace

Rings::Rings(double innerRadius, double outerRadius, int count, double height, double diameter)
    : height_(height), diameter_(diameter) {
  require(innerRadius >= 0.0, "the inner radius must be 0 or more", innerRadius);
  require(std::isfinite(outerRadius) && outerRadius > innerRadius,
          "the outer radius must be larger than the inner one", outerRadius);
  require(count >= 1, "at least one ring is needed", count);
  require(std::isfinite(height) && height > 0.0, "the height must be positive", height);
  require(std::isfinite(diameter) && diameter > 0.0, "the reference diameter must be positive",
          diameter);
  edges_.resize(static_cast<std::size_t>(count) + 1);
  for (int k = 0; k < count; ++k)
    edges_[static_cast<std::size_t>(k)] = innerRadius + (outerRadius - innerRadius) * k / count;
  edges_.back() = outerRadius;
}

double Rings::volume(int ring) const {
  const double inner = edge(ring);
  const double outer = edge(ring + 1);
  return std::numbers::pi * (outer - inner) * (outer + inner) * height_;
}

int Rings::binOf(double r) const {
  if (r < innerRadius()) return insideBin();
  if (!(r < outerRadius())) return outsideBin();
  const double width = (outerRadius() - innerRadius()) / count();
  int ring = std::min(static_cast<int>((r - innerRadius()) / width), count() - 1);
  // The division may round across an edge.
  while (r < edge(ring)) --ring;
  while (r >= edge(ring + 1)) ++ring;
  return ring;
}

}  // namespace crossgrain
