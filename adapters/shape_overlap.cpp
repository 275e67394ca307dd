#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <utility>

#include "adapters/shape.hpp"

namespace crossgrain {
namespace {

/// The hull that a body is rounded about, where it is.
struct Core {
  std::vector<Vec3> corners;
  std::set<std::pair<std::size_t, std::size_t>> edges;
  std::vector<Vec3> normals;  ///< of its faces, outward
  double rounding;

  explicit Core(const PlacedShapeOf<3>& body) : corners(body.shape->vertices) {
    const ShapeOf<3>& shape = *body.shape;
    rounding = shape.kind == ShapeKind::cylinder ? 0.0 : shape.rounding;
    if (shape.kind == ShapeKind::cylinder)
      addPrism(shape);
    else if (corners.size() > 2)
      for (const auto& face : facesOf(shape)) addFace(face);
    else if (corners.size() == 2)
      edges = {{0, 1}};
    const Eigen::Matrix3d axes = matrixOf<3>(body.turn);
    for (Vec3& corner : corners) corner = body.position + axes * corner;
    for (Vec3& normal : normals) normal = axes * normal;
  }

 private:
  void addFace(const std::vector<std::size_t>& face) {
    const Vec3& at = corners[face[0]];
    normals.push_back((corners[face[1]] - at).cross(corners[face[2]] - at).normalized());
    for (std::size_t k = 0; k < face.size(); ++k)
      edges.insert(std::minmax(face[k], face[(k + 1) % face.size()]));
  }
  /// Inside of the cylinder, its edges on it.
  void addPrism(const ShapeOf<3>& cylinder) {
    constexpr std::size_t sides = 32;
    corners.clear();
    for (const Vec3& end : cylinder.vertices)
      for (std::size_t k = 0; k < sides; ++k) {
        const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / sides;
        corners.push_back(end + cylinder.rounding * Vec3(std::cos(angle), std::sin(angle), 0.0));
      }
    normals = {Vec3::UnitZ(), -Vec3::UnitZ()};
    for (std::size_t k = 0; k < sides; ++k) {
      const std::size_t next = (k + 1) % sides;
      addFace({k, next, next + sides, k + sides});
    }
  }
};

}  // namespace

template <>
double overlapOf<3>(const PlacedShapeOf<3>& a, const PlacedShapeOf<3>& b) {
  const Core one(a), other(b);
  double widest = -std::numeric_limits<double>::infinity();  // gap between the cores
  /// @param way  from the first to the second
  const auto look = [&](const Vec3& way) {
    const double length = way.norm();
    if (!(length > 1e-12 * (a.shape->reach() + b.shape->reach()))) return;
    double end = -std::numeric_limits<double>::infinity(), begin = -end;
    for (const Vec3& corner : one.corners) end = std::max(end, corner.dot(way));
    for (const Vec3& corner : other.corners) begin = std::min(begin, corner.dot(way));
    widest = std::max(widest, (begin - end) / length);
  };
  for (const Vec3& normal : one.normals) look(normal);
  for (const Vec3& normal : other.normals) look(-normal);
  for (const Vec3& from : one.corners)
    for (const Vec3& to : other.corners) look(to - from);
  const auto edgeOf = [](const Core& core, const auto& edge) {
    return std::pair<Vec3, Vec3>(core.corners[edge.first],
                                 core.corners[edge.second] - core.corners[edge.first]);
  };
  /// Vector from a corner to an edge, the shortest.
  const auto toEdge = [](const Vec3& corner, const std::pair<Vec3, Vec3>& edge) {
    const Vec3 from = edge.first - corner;
    return Vec3(from - from.dot(edge.second) / edge.second.squaredNorm() * edge.second);
  };
  for (const auto& edge : other.edges)
    for (const Vec3& corner : one.corners) look(toEdge(corner, edgeOf(other, edge)));
  for (const auto& edge : one.edges) {
    const auto along = edgeOf(one, edge);
    for (const Vec3& corner : other.corners) look(-toEdge(corner, along));
    for (const auto& second : other.edges) {
      const Vec3 across = along.second.cross(edgeOf(other, second).second);
      look(across);
      look(-across);
    }
  }
  return one.rounding + other.rounding - widest;
}

}  // namespace crossgrain
