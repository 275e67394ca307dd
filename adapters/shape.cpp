#include "adapters/shape.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>
#include <numbers>
#include <numeric>
#include <set>

namespace crossgrain {

std::string toString(ShapeKind kind) {
  return std::string(shapeKindNames[static_cast<std::size_t>(kind)]);
}

namespace {

using std::numbers::pi;

/// Lengths that are less than this share of a body's size are geometricRounding.
constexpr double geometricRounding = 1e-9;

template <int D>
double sizeOf(const ShapeOf<D>& shape) {
  double size = shape.rounding;
  for (const VecOf<D>& vertex : shape.vertices)
    for (const VecOf<D>& other : shape.vertices) size = std::max(size, (vertex - other).norm());
  return size;
}

/// Collects parts of a body: the second moments are about the origin until shifted() is called.
template <int D>
struct Parts {
  using Matrix = Eigen::Matrix<double, D, D>;
  double measure = 0.0;
  VecOf<D> first = VecOf<D>::Zero();
  Matrix second = Matrix::Zero();

  /// @param own  its second moments about its own centre
  void add(double size, const VecOf<D>& centre, const Matrix& own) {
    measure += size;
    first += size * centre;
    second += own + size * centre * centre.transpose();
  }
  ShapeMassOf<D> shifted() const {
    const VecOf<D> centre = first / measure;
    return {measure, centre, second - measure * centre * centre.transpose()};
  }
};

/// The triangle of the origin and a side, the strip outside the side, and the sector about its end.
void addSide(Parts<2>& parts, const Vec2& from, const Vec2& to, const Vec2& after, double r) {
  const double doubled = cross(from, to);
  const Vec2 sum = from + to;
  parts.measure += doubled / 2.0;
  parts.first += doubled / 6.0 * sum;
  parts.second +=
      doubled / 24.0 * (from * from.transpose() + to * to.transpose() + sum * sum.transpose());
  if (r == 0.0) return;
  const double length = (to - from).norm();
  const Vec2 along = (to - from) / length, next = (after - to).normalized();
  const Vec2 outward = -perpendicular(along);
  const Eigen::Matrix2d tt = along * along.transpose(), nn = outward * outward.transpose();
  parts.add(length * r, (from + to) / 2.0 + r / 2.0 * outward,
            length * r / 12.0 * (length * length * tt + r * r * nn));
  const double half = std::atan2(cross(along, next), along.dot(next)) / 2.0;
  const double turned = half < 0.0 ? half + pi : half;  // a capsule's end is half a circle
  const Vec2 middle = Eigen::Rotation2Dd(turned) * outward;
  const double s = std::sin(turned) * std::cos(turned), fourth = r * r * r * r / 4.0;
  const Vec2 across = perpendicular(middle);
  const double area = r * r * turned;
  const Vec2 centroid = 2.0 / 3.0 * r * std::sin(turned) / turned * middle;
  const Eigen::Matrix2d aboutVertex = fourth * ((turned + s) * middle * middle.transpose() +
                                                (turned - s) * across * across.transpose());
  parts.add(area, to + centroid, aboutVertex - area * centroid * centroid.transpose());
}

Eigen::Matrix3d alongZ(double across, double along) {
  return Vec3(across, across, along).asDiagonal();
}

ShapeMassOf<3> massOfRound(const ShapeOf<3>& shape) {
  const double r = shape.rounding, square = r * r;
  const double h =
      shape.vertices.size() == 2 ? (shape.vertices[1] - shape.vertices[0]).norm() / 2.0 : 0.0;
  const double cylinder = 2.0 * pi * square * h;
  Eigen::Matrix3d second = alongZ(cylinder * square / 4.0, cylinder * h * h / 3.0);
  double volume = cylinder;
  if (shape.kind != ShapeKind::cylinder) {  // the two halves of a sphere
    const double sphere = 4.0 / 3.0 * pi * square * r;
    second += alongZ(sphere * square / 5.0, sphere * (h * h + 0.75 * h * r + square / 5.0));
    volume += sphere;
  }
  const VecOf<3> middle =
      std::accumulate(shape.vertices.begin(), shape.vertices.end(), Vec3(Vec3::Zero())) /
      static_cast<double>(shape.vertices.size());
  return {volume, middle, second};
}

}  // namespace

template <int D>
double ShapeOf<D>::reach() const {
  double farthestVertex = 0.0;
  for (const VecOf<D>& vertex : vertices) farthestVertex = std::max(farthestVertex, vertex.norm());
  return kind == ShapeKind::cylinder ? std::hypot(farthestVertex, rounding)
                                     : farthestVertex + rounding;
}

template <>
ShapeMassOf<2> massOf<2>(const ShapeOf<2>& shape) {
  const double r = shape.rounding;
  const std::size_t n = shape.vertices.size();
  if (n == 1)
    return {pi * r * r, shape.vertices[0], pi * r * r * r * r / 4.0 * Eigen::Matrix2d::Identity()};
  Parts<2> parts;
  for (std::size_t k = 0; k < n; ++k)
    addSide(parts, shape.vertices[k], shape.vertices[(k + 1) % n], shape.vertices[(k + 2) % n], r);
  return parts.shifted();
}

template <>
ShapeMassOf<3> massOf<3>(const ShapeOf<3>& shape) {
  if (shape.kind == ShapeKind::capsule || shape.kind == ShapeKind::cylinder)
    return massOfRound(shape);
  Parts<3> parts;
  for (const std::vector<std::size_t>& face : facesOf(shape))
    for (std::size_t k = 2; k < face.size(); ++k) {
      const Vec3 &a = shape.vertices[face[0]], &b = shape.vertices[face[k - 1]],
                 &c = shape.vertices[face[k]], sum = a + b + c;
      const double volume = a.dot(b.cross(c)) / 6.0;
      parts.measure += volume;
      parts.first += volume / 4.0 * sum;
      parts.second +=
          volume / 20.0 *
          (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
    }
  return parts.shifted();
}

std::vector<std::vector<std::size_t>> facesOf(const ShapeOf<3>& shape) {
  const std::vector<Vec3>& at = shape.vertices;
  const std::size_t n = at.size();
  const double small = geometricRounding * sizeOf(shape);
  std::vector<std::vector<std::size_t>> faces;
  std::set<std::vector<std::size_t>> known;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j)
      for (std::size_t k = j + 1; k < n; ++k) {
        Vec3 normal = (at[j] - at[i]).cross(at[k] - at[i]);
        if (normal.norm() <= small * (at[j] - at[i]).norm()) continue;
        normal.normalize();
        std::vector<std::size_t> face;
        bool before = false, behind = false;
        for (std::size_t v = 0; v < n; ++v) {
          const double off = normal.dot(at[v] - at[i]);
          if (std::abs(off) <= small) face.push_back(v);
          before |= off > small;
          behind |= off < -small;
        }
        if (before == behind || !known.insert(face).second) continue;  // inside, or another of it
        if (before) normal = -normal;
        const Vec3 x = (at[j] - at[i]).normalized(), y = normal.cross(x);
        Vec3 middle = Vec3::Zero();
        for (const std::size_t v : face) middle += at[v] / static_cast<double>(face.size());
        std::ranges::sort(face, {}, [&](std::size_t v) {
          return std::atan2(y.dot(at[v] - middle), x.dot(at[v] - middle));
        });
        faces.push_back(std::move(face));
      }
  return faces;
}

std::vector<Vec2> outlineOf(const ShapeOf<2>& shape) {
  if (shape.rounding == 0.0) return shape.vertices;
  constexpr int most = 120;  // chords of a whole turn
  const std::size_t n = shape.vertices.size();
  std::vector<Vec2> outline;
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2& at = shape.vertices[k];
    const Vec2 before = at - shape.vertices[(k + n - 1) % n],
               after = shape.vertices[(k + 1) % n] - at;
    const double from = n == 1 ? 0.0 : std::atan2(-before.x(), before.y());  // of the normals
    double turn = n == 1 ? 2.0 * pi : std::atan2(cross(before, after), before.dot(after));
    if (turn <= 0.0) turn += 2.0 * pi;  // half a circle at the end of a capsule may round to −π
    const int chords = static_cast<int>(std::ceil(turn / (2.0 * pi) * most));
    for (int c = 0; c <= chords; ++c) {
      const double angle = from + turn * c / chords;
      outline.emplace_back(at + shape.rounding * Vec2(std::cos(angle), std::sin(angle)));
    }
  }
  return outline;
}

std::vector<Vec3> pointsIn(const ShapeOf<3>& shape) {
  constexpr int cells = 16;
  std::vector<std::pair<Vec3, double>> sides;  // of a hull: outward normals, and how far off
  for (const auto& face : facesOf(shape)) {
    const Vec3& at = shape.vertices[face[0]];
    const Vec3 normal =
        (shape.vertices[face[1]] - at).cross(shape.vertices[face[2]] - at).normalized();
    sides.emplace_back(normal, normal.dot(at));
  }
  const auto inside = [&](const Vec3& x) {
    if (!sides.empty())
      return std::ranges::all_of(sides, [&](const auto& s) { return s.first.dot(x) <= s.second; });
    const double end = shape.vertices.back().z();  // round about z
    const double beyond = std::max(std::abs(x.z()) - end, 0.0);
    const double across = x.head<2>().norm();
    return shape.kind == ShapeKind::cylinder ? beyond == 0.0 && across <= shape.rounding
                                             : std::hypot(across, beyond) <= shape.rounding;
  };
  Vec3 low, high;
  for (int k = 0; k < 3; ++k) {
    low[k] = farthest<3>(shape, -Vec3::Unit(k))[k];
    high[k] = farthest<3>(shape, Vec3::Unit(k))[k];
  }
  std::vector<Vec3> points;
  for (int k = 0; k < cells * cells * cells; ++k) {
    const Vec3 place(k % cells + 0.5, k / cells % cells + 0.5, k / (cells * cells) + 0.5);
    const Vec3 x = low + (high - low).cwiseProduct(place / cells);
    if (inside(x)) points.push_back(x);
  }
  return points;
}

template <int D>
VecOf<D> farthest(const ShapeOf<D>& shape, const VecOf<D>& direction) {
  const VecOf<D> core = *std::ranges::max_element(
      shape.vertices, {}, [&](const VecOf<D>& vertex) { return vertex.dot(direction); });
  VecOf<D> outward = direction;
  if (shape.kind == ShapeKind::cylinder) outward[D - 1] = 0.0;
  const double length = outward.norm();
  return length > 0.0 ? VecOf<D>(core + shape.rounding / length * outward) : core;
}
template Vec2 farthest<2>(const ShapeOf<2>&, const Vec2&);
template Vec3 farthest<3>(const ShapeOf<3>&, const Vec3&);

template <int D>
FrameOf<D> intoOwnFrame(ShapeOf<D>& shape) {
  using Matrix = Eigen::Matrix<double, D, D>;
  const ShapeMassOf<D> mass = massOf(shape);
  FrameOf<D> frame{mass.centre, Matrix::Identity()};
  if constexpr (D == 3) {
    const Matrix diagonal = mass.second.diagonal().asDiagonal();
    if ((mass.second - diagonal).norm() > geometricRounding * mass.second.norm()) {
      frame.axes = Eigen::SelfAdjointEigenSolver<Matrix>(mass.second).eigenvectors();
      if (frame.axes.determinant() < 0.0) frame.axes.col(0) *= -1.0;
    }
  }
  for (VecOf<D>& vertex : shape.vertices) vertex = frame.axes.transpose() * (vertex - frame.centre);
  return frame;
}
template FrameOf<2> intoOwnFrame<2>(ShapeOf<2>&);
template FrameOf<3> intoOwnFrame<3>(ShapeOf<3>&);

template <>
std::string shapeFault<2>(const ShapeOf<2>& shape) {
  const std::vector<Vec2>& at = shape.vertices;
  const std::size_t n = at.size();
  const double small = geometricRounding * sizeOf(shape);
  if (n < 3) return fmt::format("has {} vertices; a polygon has three or more", n);
  double turned = 0.0, area = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t j = (k + 1) % n;
    const Vec2 side = at[j] - at[k], next = at[(k + 2) % n] - at[j];
    if (side.norm() <= small) return fmt::format("has vertices {} and {} at one place", k, j);
    area += cross(at[k] - at[0], at[j] - at[0]) / 2.0;
    turned += std::atan2(cross(side, next), side.dot(next));
  }
  if (std::abs(area) <= small * small / geometricRounding) return "has no area";
  if (area < 0.0) return "has its vertices clockwise; they are to be counter-clockwise";
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 side = at[(k + 1) % n] - at[k], next = at[(k + 2) % n] - at[(k + 1) % n];
    const double bend = cross(side, next), straight = geometricRounding * side.norm() * next.norm();
    if (bend < -straight) return fmt::format("is not convex at vertex {}", (k + 1) % n);
    if (bend <= straight)
      return fmt::format("is straight at vertex {}, which is no corner: leave it out", (k + 1) % n);
  }
  if (turned > 3.0 * pi) return "has an outline that crosses itself";
  return {};
}

template <>
std::string shapeFault<3>(const ShapeOf<3>& shape) {
  const std::vector<Vec3>& at = shape.vertices;
  const double small = geometricRounding * sizeOf(shape);
  if (at.size() < 4)
    return fmt::format("has {} vertices; a polyhedron has four or more", at.size());
  for (std::size_t i = 0; i < at.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if ((at[i] - at[j]).norm() <= small)
        return fmt::format("has vertices {} and {} at one place", j, i);
  const auto faces = facesOf(shape);
  if (faces.size() < 4) return "has no volume";
  std::vector<int> meeting(at.size());
  for (const auto& face : faces)
    for (const std::size_t v : face) ++meeting[v];
  for (std::size_t v = 0; v < at.size(); ++v)
    if (meeting[v] < 3)
      return fmt::format("is not convex, or flat, at vertex {}, which is no corner: leave it out",
                         v);
  return {};
}

template <int D>
double depthBehind(const PlacedShapeOf<D>& body, const VecOf<D>& point, const VecOf<D>& normal) {
  const Eigen::Matrix<double, D, D> axes = matrixOf<D>(body.turn);
  const VecOf<D> lowest = farthest<D>(*body.shape, -(axes.transpose() * normal));
  return normal.dot(point - body.position - axes * lowest);
}
template double depthBehind<2>(const PlacedShapeOf<2>&, const Vec2&, const Vec2&);
template double depthBehind<3>(const PlacedShapeOf<3>&, const Vec3&, const Vec3&);

namespace {

/// Counter-clockwise, by Andrew's monotone chains.
std::vector<Vec2> hullOf(std::vector<Vec2> points) {
  const auto before = [](const Vec2& a, const Vec2& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  };
  std::ranges::sort(points, before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Vec2> hull;
  for (const int way : {0, 1}) {
    const std::size_t first = hull.size();
    for (const Vec2& point : points) {
      while (hull.size() >= first + 2 &&
             cross(hull.back() - hull[hull.size() - 2], point - hull.back()) <= 0.0)
        hull.pop_back();
      hull.push_back(point);
    }
    hull.pop_back();
    if (way == 0) std::ranges::reverse(points);
  }
  return hull;
}

}  // namespace

template <>
double overlapOf<2>(const PlacedShapeOf<2>& a, const PlacedShapeOf<2>& b) {
  std::vector<Vec2> differences;
  const Eigen::Matrix2d axesA = matrixOf<2>(a.turn), axesB = matrixOf<2>(b.turn);
  for (const Vec2& ofA : a.shape->vertices)
    for (const Vec2& ofB : b.shape->vertices)
      differences.emplace_back(a.position + axesA * ofA - b.position - axesB * ofB);
  const std::vector<Vec2> hull = hullOf(std::move(differences));
  const std::size_t n = hull.size();
  bool inside = n > 2;
  double distance = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 &from = hull[k], side = hull[(k + 1) % n] - from;
    inside &= cross(side, -from) >= 0.0;
    const double length = side.squaredNorm();
    const double share = length > 0.0 ? std::clamp(-from.dot(side) / length, 0.0, 1.0) : 0.0;
    distance = std::min(distance, (from + share * side).norm());
  }
  return (inside ? distance : -distance) + a.shape->rounding + b.shape->rounding;
}

std::vector<Vec2> sectionOf(const ShapeOf<3>& shape, const TurnOf<3>& turn, double height) {
  constexpr int around = 32;
  std::vector<Vec3> corners = shape.vertices;
  if (shape.rounding > 0.0) {
    corners.clear();
    const bool flat = shape.kind == ShapeKind::cylinder;
    for (const Vec3& end : shape.vertices)
      for (int ring = flat ? around / 4 : 0; ring <= around / 4; ++ring)
        for (int k = 0; k < around; ++k) {
          const double up = flat ? 0.0 : pi / 2.0 * (1.0 - 4.0 * ring / around);
          const double angle = 2.0 * pi * k / around, side = end.z() < 0.0 ? -1.0 : 1.0;
          corners.push_back(end + shape.rounding * Vec3(std::cos(up) * std::cos(angle),
                                                        std::cos(up) * std::sin(angle),
                                                        side * std::sin(up)));
        }
  }
  for (Vec3& corner : corners) corner = matrixOf<3>(turn) * corner;
  std::vector<Vec2> points;  // each two corners are joined inside of the body
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (std::size_t j = 0; j < corners.size(); ++j) {
      const double below = corners[i].y() - height, above = corners[j].y() - height;
      if (below > 0.0 || above <= 0.0) continue;
      const Vec3 at = corners[i] + below / (below - above) * (corners[j] - corners[i]);
      points.emplace_back(at.x(), at.z());
    }
  return hullOf(std::move(points));
}

template struct ShapeOf<2>;
template struct ShapeOf<3>;

}  // namespace crossgrain
