#include "averaging/rings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "averaging/areas.hpp"

namespace crossgrain::inline averaging {

namespace {

void require(bool held, const char* what, double value) {
  if (!held) throw std::invalid_argument(fmt::format("rings: {}, got {}", what, value));
}

}  // namespace

Rings::Rings(double innerRadius, double outerRadius, int count, double height, double diameter)
    : height_(height), diameter_(diameter) {
  require(count >= 1, "at least one ring is needed", count);
  edges_.resize(static_cast<std::size_t>(count) + 1);
  for (int k = 0; k < count; ++k)
    edges_[static_cast<std::size_t>(k)] = innerRadius + (outerRadius - innerRadius) * k / count;
  edges_.back() = outerRadius;
  check();
}

Rings::Rings(std::vector<double> edges, double height, double diameter)
    : edges_(std::move(edges)), height_(height), diameter_(diameter) {
  require(edges_.size() >= 2, "at least two edges are needed", static_cast<double>(edges_.size()));
  check();
}

void Rings::check() const {
  require(innerRadius() >= 0.0, "the inner radius must be 0 or more", innerRadius());
  require(std::isfinite(outerRadius()) && outerRadius() > innerRadius(),
          "the outer radius must be larger than the inner one", outerRadius());
  for (std::size_t k = 1; k < edges_.size(); ++k)
    require(edges_[k] > edges_[k - 1], "every edge must lie outside the one before", edges_[k]);
  require(std::isfinite(height_) && height_ > 0.0, "the height must be positive", height_);
  require(std::isfinite(diameter_) && diameter_ > 0.0, "the reference diameter must be positive",
          diameter_);
}

double Rings::ringVolume(int ring) const {
  const double inner = edge(ring);
  const double outer = edge(ring + 1);
  return std::numbers::pi * (outer - inner) * (outer + inner) * height_;
}

int Rings::binOf(double r) const {
  if (r < innerRadius()) return insideBin();
  if (!(r < outerRadius())) return outsideBin();
  const double width = (outerRadius() - innerRadius()) / count();
  int ring = std::min(static_cast<int>((r - innerRadius()) / width), count() - 1);
  // The division may round across an edge, and widths may differ.
  while (r < edge(ring)) --ring;
  while (r >= edge(ring + 1)) ++ring;
  return ring;
}

Vec2 Rings::firstDirection(const Vec2& x) const {
  const double r = x.norm();
  return r > 0.0 ? Vec2(x / r) : Vec2(Vec2::UnitX());
}

void Rings::fractionsOf(double nearest, double farthest, auto&& within,
                        BinFractions& fractions) const {
  fractions.clear();
  int bin = binOf(nearest);
  double before = 0.0;
  // Differences of one rising sequence that ends at the whole area: they add up to 1.
  for (; bin < count() && edge(bin + 1) < farthest; ++bin) {
    const double inside = within(edge(bin + 1));
    fractions.push_back({slot(bin), std::max(inside - before, 0.0)});
    before = std::max(inside, before);
  }
  fractions.push_back({slot(bin), std::max(1.0 - before, 0.0)});
}

void Rings::discFractions(const Vec2& x, double a, Edges edges, BinFractions& fractions) const {
  double (*const areaWithin)(double, double, double) =
      edges == Edges::exact ? static_cast<double (*)(double, double, double)>(commonArea)
                            : straightCutArea;
  const double r = x.norm();
  const double area = std::numbers::pi * a * a;
  fractionsOf(
      std::max(r - a, 0.0), r + a, [&](double edge) { return areaWithin(r, a, edge) / area; },
      fractions);
}

void Rings::outlineFractions(const std::vector<Vec2>& outline, BinFractions& fractions) const {
  const double area = areaOf(outline);
  double farthest = 0.0, nearest = 0.0;
  for (const Vec2& vertex : outline) farthest = std::max(farthest, vertex.norm());
  // Inside of the first edge that any of it is within there is nothing.
  while (binOf(nearest) < count() && commonArea(outline, edge(binOf(nearest) + 1)) <= 0.0)
    nearest = edge(binOf(nearest) + 1);
  fractionsOf(
      nearest, farthest, [&](double edge) { return commonArea(outline, edge) / area; }, fractions);
}

std::optional<Slope> Rings::slope(std::size_t slot) const {
  if (count() < 3 || isOverflow(slot)) return std::nullopt;
  const int ring = static_cast<int>(slot) - 1;
  const int first = std::clamp(ring - 1, 0, count() - 3);
  const double x = centre(ring);
  Slope result{{}, x};
  for (int k = first; k < first + 3; ++k) {  // Lagrange's polynomials, differentiated at x
    double sum = 0.0, product = 1.0;
    for (int other = first; other < first + 3; ++other) {
      if (other == k) continue;
      sum += x - centre(other);
      product *= centre(k) - centre(other);
    }
    // Between neighbours of one width the ring itself does not count: it may be empty.
    if (std::abs(sum) > 1e-9 * (outerRadius() - innerRadius()) / count())
      result.terms.push_back({this->slot(k), sum / product});
  }
  return result;
}

}  // namespace crossgrain::inline averaging
