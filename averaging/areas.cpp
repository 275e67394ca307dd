#include "averaging/areas.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace crossgrain::inline averaging {

namespace {

/// x − sin x cos x for x in [0, π], given p = tan(x/2): the area of the segment of a unit circle
/// that subtends the angle 2x.
double segment(double p) {
  if (p < 0.05) {
    // (y − sin y)/2 with y = 2x: the difference would cancel, its series does not.
    const double y = 4.0 * std::atan(p);
    const double y2 = y * y;
    return y * y2 / 12.0 *
           (1.0 - y2 / 20.0 * (1.0 - y2 / 42.0 * (1.0 - y2 / 72.0 * (1.0 - y2 / 110.0))));
  }
  if (std::isinf(p)) return std::numbers::pi;
  const double q = 1.0 + p * p;
  return 2.0 * std::atan(p) - 2.0 * p * (1.0 - p * p) / (q * q);
}

/// ∫ √(1 − x²) dx from 0 to x
double underCircle(double x) {
  return 0.5 * (x * std::sqrt(1.0 - x * x) + std::asin(x));
}

}  // namespace

double commonArea(double r, double a, double R) {
  const double pi = std::numbers::pi;
  // Twice s−R, s−r, s−a and s of the triangle with sides r, a, R; R − r first, it is the small one.
  const double beyondEdge = a - (R - r);
  const double beforeEdge = a + (R - r);
  const double clearOfOrigin = (r - a) + R;
  if (beyondEdge <= 0.0) return pi * a * a;
  if (beforeEdge <= 0.0) return 0.0;
  if (clearOfOrigin <= 0.0) return pi * R * R;
  const double perimeter = r + a + R;
  const double halfAtOrigin = std::sqrt(beforeEdge * beyondEdge / (perimeter * clearOfOrigin));
  const double halfAtCentre = std::sqrt(beforeEdge * clearOfOrigin / (perimeter * beyondEdge));
  return R * R * segment(halfAtOrigin) + a * a * segment(halfAtCentre);
}

double straightCutArea(double r, double a, double R) {
  const double phi = std::acos(std::clamp((r - R) / a, -1.0, 1.0));
  return a * a * (phi - std::sin(phi) * std::cos(phi));
}

double quadrantArea(double X, double Y) {
  const double right = std::clamp(X, -1.0, 1.0);
  const double top = std::clamp(Y, -1.0, 1.0);
  const double corner = std::sqrt(1.0 - top * top);
  // Left of −corner and right of it the circle, in between the line y = Y bounds a column's height.
  const auto columns = [&](double from, double to) {
    return std::pair{std::min(from, right), std::min(to, right)};
  };
  double area = 0.0;
  if (top > 0.0)
    for (const auto& [from, to] : {columns(-1.0, -corner), columns(corner, 1.0)})
      area += 2.0 * (underCircle(to) - underCircle(from));
  const auto [from, to] = columns(-corner, corner);
  return area + top * (to - from) + underCircle(to) - underCircle(from);
}

double areaOf(const std::vector<Vec2>& outline) {
  double area = 0.0;
  for (std::size_t k = 0; k < outline.size(); ++k)  // about the first, so that little cancels
    area += 0.5 * cross(outline[k] - outline[0], outline[(k + 1) % outline.size()] - outline[0]);
  return area;
}

double commonArea(const std::vector<Vec2>& outline, double R) {
  double area = 0.0;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Vec2 &from = outline[k], side = outline[(k + 1) % outline.size()] - from;
    // |from + s side| = R, and what of s in [0, 1] is inside.
    const double square = side.squaredNorm(), half = from.dot(side) / square;
    const double root = half * half - (from.squaredNorm() - R * R) / square;
    double enters = 1.0, leaves = 1.0;
    if (root > 0.0) {
      enters = std::clamp(-half - std::sqrt(root), 0.0, 1.0);
      leaves = std::clamp(-half + std::sqrt(root), 0.0, 1.0);
    }
    const Vec2 a = from + enters * side, b = from + leaves * side, to = from + side;
    const auto sector = [R](const Vec2& p, const Vec2& q) {
      return 0.5 * R * R * std::atan2(cross(p, q), p.dot(q));
    };
    area += sector(from, a) + 0.5 * cross(a, b) + sector(b, to);
  }
  return area;
}

double quadrantArea(const std::vector<Vec2>& outline, const Vec2& corner) {
  std::vector<Vec2> left = outline, kept;
  for (const int axis : {0, 1}) {
    kept.clear();
    for (std::size_t k = 0; k < left.size(); ++k) {
      const Vec2 &from = left[k], &to = left[(k + 1) % left.size()];
      const double before = corner[axis] - from[axis], after = corner[axis] - to[axis];
      if (before >= 0.0) kept.push_back(from);
      if ((before > 0.0 && after < 0.0) || (before < 0.0 && after > 0.0))
        kept.emplace_back(from + before / (before - after) * (to - from));
    }
    left.swap(kept);
  }
  return left.empty() ? 0.0 : areaOf(left);
}

}  // namespace crossgrain::inline averaging
