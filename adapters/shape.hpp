#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "adapters/vec2.hpp"

namespace crossgrain {

/// Kinds of convex bodies that engines have of their own: polygons in the plane, boxes, cylinders
/// and polyhedra in space, capsules in both.
enum class ShapeKind { polygon, capsule, box, cylinder, polyhedron };

/// As in case files, declarations and messages, in enum order.
inline constexpr std::array<std::string_view, 5> shapeKindNames = {"polygon", "capsule", "box",
                                                                   "cylinder", "polyhedron"};
std::string toString(ShapeKind kind);

/// The orientation of a body, which takes vectors of its own frame to the scene's: in the plane the
/// angle about z, counter-clockwise positive [rad]; in space a unit quaternion (w, x, y, z).
template <int D>
using TurnOf = std::conditional_t<D == 2, double, Eigen::Vector4d>;

/// That of a body whose frame is along the scene's.
template <int D>
TurnOf<D> noTurn() {
  if constexpr (D == 2)
    return 0.0;
  else
    return {1.0, 0.0, 0.0, 0.0};
}

/// The matrix of an orientation.
template <int D>
Eigen::Matrix<double, D, D> matrixOf(const TurnOf<D>& turn) {
  if constexpr (D == 2)
    return Eigen::Rotation2Dd(turn).toRotationMatrix();
  else
    return Eigen::Quaterniond(turn[0], turn[1], turn[2], turn[3]).toRotationMatrix();
}

/// Whether a quaternion that people write has length 1, to six digits.
inline bool isUnit(const Eigen::Quaterniond& written) {
  return std::abs(written.norm() - 1.0) <= 1e-6;
}

/// The angle between two orientations, 0 to π [rad].
template <int D>
double turnBetween(const TurnOf<D>& a, const TurnOf<D>& b) {
  if constexpr (D == 2)
    return std::abs(std::remainder(a - b, 2.0 * std::numbers::pi));
  else
    return 2.0 * std::acos(std::min(1.0, std::abs(a.dot(b))));
}

/// A convex body in its own frame, whose origin is its centre of mass and, in space, whose axes are
/// its principal ones: all within `rounding` of the hull of `vertices`. Capsules are two vertices,
/// along x in the plane and along z in space. A cylinder has the middles of its two faces for
/// vertices, along z, and is rounded across that axis alone.
template <int D>
struct ShapeOf {
  ShapeKind kind = D == 2 ? ShapeKind::polygon : ShapeKind::box;
  std::vector<VecOf<D>> vertices;  ///< in the plane counter-clockwise [m]
  double rounding = 0.0;           ///< [m]

  /// Radius of the smallest sphere, or circle, about the centre of mass that holds it [m].
  double reach() const;

  bool operator==(const ShapeOf&) const = default;
};

/// A disk or sphere as one of them: one vertex with its radius around it.
template <int D>
ShapeOf<D> roundShape(double radius) {
  return {ShapeKind::capsule, {VecOf<D>::Zero()}, radius};
}

/// The size of a body and how its mass is spread, of density 1.
template <int D>
struct ShapeMassOf {
  double measure = 0.0;                ///< area [m²], or volume [m³]
  VecOf<D> centre = VecOf<D>::Zero();  ///< of mass [m]
  Eigen::Matrix<double, D, D> second;  ///< Σ x xᵀ about the centre [m⁴, m⁵]
};

/// Of any convex body, whether its centre of mass is the origin or not. Exact but for rounding:
/// Green's theorem over the sides of a polygon, with its strips and sectors; in space tetrahedra
/// from the centre to the faces of the hull, and closed forms of capsules and cylinders.
/// @pre polyhedra are not rounded
template <int D>
ShapeMassOf<D> massOf(const ShapeOf<D>& shape);

/// Moments of inertia about the principal axes per mass [m²]: in the plane the one about z.
template <int D>
auto momentsPerMass(const ShapeMassOf<D>& spread) {
  const Eigen::Matrix<double, D, 1> mean = spread.second.diagonal() / spread.measure;
  if constexpr (D == 2)
    return mean.sum();
  else
    return Vec3(Vec3::Constant(mean.sum()) - mean);
}

/// Point of a body that is farthest along a direction [m], in the body's frame.
template <int D>
VecOf<D> farthest(const ShapeOf<D>& shape, const VecOf<D>& direction);

/// Makes a shape of what a user gives: moves its vertices so that the centre of mass is the origin
/// and, in space, turns them so that the axes are principal. @returns the rotation from the shape's
/// frame to that in which it was given, and the centre of mass there [m]
template <int D>
struct FrameOf {
  VecOf<D> centre;
  Eigen::Matrix<double, D, D> axes;
};
template <int D>
FrameOf<D> intoOwnFrame(ShapeOf<D>& shape);

/// The orientation of a shape's own frame where that in which it was given has this one.
template <int D>
TurnOf<D> ownTurn(const FrameOf<D>& frame, const TurnOf<D>& given) {
  if constexpr (D == 2) {
    return given;
  } else {
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond(given[0], given[1], given[2], given[3]) * Eigen::Quaterniond(frame.axes);
    return {turn.w(), turn.x(), turn.y(), turn.z()};
  }
}

/// The outline of a body in its frame, counter-clockwise; what is rounded is chords of at most 3°,
/// which hold all but 5e-4 of its area.
std::vector<Vec2> outlineOf(const ShapeOf<2>& shape);

/// Cut of a body so turned with the plane y = height above its centre: x and z about that, round.
/// Round bodies are hulls of 32 points a circle. Less than three points where it does not reach.
std::vector<Vec2> sectionOf(const ShapeOf<3>& shape, const TurnOf<3>& turn, double height);

/// Points spread evenly through a body, in its frame: the middles of 16 × 16 × 16 cells of the box
/// around it that lie inside.
std::vector<Vec3> pointsIn(const ShapeOf<3>& shape);

/// The faces of a polyhedron's hull or a box: vertices of each, counter-clockwise seen from
/// outside.
std::vector<std::vector<std::size_t>> facesOf(const ShapeOf<3>& shape);

/// Why vertices are no convex body, a clause; empty: they are one. In the plane: at least three of
/// a polygon, counter-clockwise, no two at one place, none where the outline turns back or goes
/// straight on; in space at least four that do not lie in a plane, each a corner of the hull.
template <int D>
std::string shapeFault(const ShapeOf<D>& shape);

/// A body where it is.
template <int D>
struct PlacedShapeOf {
  const ShapeOf<D>* shape;
  VecOf<D> position = VecOf<D>::Zero();  ///< of its centre of mass [m]
  TurnOf<D> turn = noTurn<D>();
};

/// Depth by which a body is behind a plane [m]; < 0: in front of it by so much.
/// @param normal  of length 1, to the free side
template <int D>
double depthBehind(const PlacedShapeOf<D>& body, const VecOf<D>& point, const VecOf<D>& normal);

/// Depth by which two bodies overlap [m]: the shortest way that takes them apart; < 0: their
/// distance. Exact: in the plane by the hull of their Minkowski difference; in space along the
/// normals of faces and the shortest ways between corners and edges, one of which is the shortest
/// way of all (separating axes: Gottschalk, Lin and Manocha 1996). Of cylinders those of prisms of
/// 32 sides inside, half a hundredth of the radius less.
template <int D>
double overlapOf(const PlacedShapeOf<D>& a, const PlacedShapeOf<D>& b);

}  // namespace crossgrain
