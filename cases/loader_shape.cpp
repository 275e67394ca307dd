#include <algorithm>
#include <cmath>
#include <numbers>

#include "adapters/written_shape.hpp"
#include "cases/loader_sections.hpp"

namespace crossgrain::inline cases {
namespace {

/// The keys of a shape, one of which names its kind.
template <int D>
struct ShapeInput {
  std::vector<VecOf<D>> vertices;
  std::vector<double> box, capsule, cylinder;
  int sides = 0;
  double radius = 0.0, rounding = 0.0;
};

/// All corners, in the plane counter-clockwise.
template <int D>
std::vector<VecOf<D>> cornersOf(const VecOf<D>& half) {
  if constexpr (D == 2)
    return {{-half.x(), -half.y()}, {half.x(), -half.y()}, half, {-half.x(), half.y()}};
  std::vector<VecOf<D>> corners;
  for (int k = 0; k < 1 << D; ++k) {
    corners.push_back(half);
    for (int axis = 0; axis < D; ++axis)
      if (!(k >> axis & 1)) corners.back()[axis] *= -1.0;
  }
  return corners;
}

std::vector<Vec2> regular(int sides, double radius) {
  std::vector<Vec2> vertices;
  for (int k = 0; k < sides; ++k) {
    const double angle = 2.0 * std::numbers::pi * (k + 0.5) / sides - std::numbers::pi / 2.0;
    vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return vertices;
}

/// Two ends, along x in the plane and along z in space, with a radius around.
template <int D>
void setLong(ShapeOf<D>& shape, ShapeKind kind, double length, double radius) {
  const VecOf<D> end = length / 2.0 * VecOf<D>::Unit(D == 2 ? 0 : 2);
  shape = {kind, {-end, end}, radius};
}

}  // namespace

template <int D>
ShapeOf<D> readShape(Reader in) {
  using I = ShapeInput<D>;
  I input;
  const char* const points = D == 2 ? "polygon" : "polyhedron";
  refuseKeysOf<D>(in, 3, {"polygon", "sides", "rounding"});
  refuseKeysOf<D>(in, 2, {"polyhedron", "cylinder"});
  const std::string kind = in.onlyOne({points, "sides", "box", "capsule", "cylinder"});
  in.read(points, input.vertices, anyNumber("m"));
  in.read("sides", input.sides, between(3, 1000));
  in.read("radius", input.radius, positive("m"));
  in.read("box", input.box, positive("m"));
  in.read("capsule", input.capsule, positive("m"));
  in.read("cylinder", input.cylinder, positive("m"));
  in.read("rounding", input.rounding, atLeast(0.0, "m"));
  in.finish();
  if (kind.empty())
    in.failMissing(points, D == 2 ? "or sides, box, capsule: what the body is"
                                  : "or box, capsule, cylinder: what the body is");
  in.check(kind != "sides" || in.has("radius"), "sides", "needs radius, that of the corners");
  in.check(kind == "sides" || !in.has("radius"), "radius",
           "is of the sides of a regular polygon; a {} has none", kind);
  ShapeOf<D> shape;
  shape.rounding = input.rounding;
  if (kind == "box") {
    in.check(input.box.size() == D, "box", "must be its {} sides in m", D);
    shape.vertices = cornersOf<D>(0.5 * VecOf<D>::Map(input.box.data()));
  } else if (kind == "capsule" || kind == "cylinder") {
    const std::vector<double>& sizes = kind == "capsule" ? input.capsule : input.cylinder;
    in.check(sizes.size() == 2, kind, "must be [length, radius] in m{}",
             kind == "capsule" ? ", the length between the middles of its ends" : "");
    in.check(!in.has("rounding"), "rounding", "is of polygons; a capsule has its radius");
    setLong(shape, kind == "capsule" ? ShapeKind::capsule : ShapeKind::cylinder, sizes[0],
            sizes[1]);
  } else {
    if constexpr (D == 2)
      shape.vertices = kind == "sides" ? regular(input.sides, input.radius) : input.vertices;
    else
      shape = {ShapeKind::polyhedron, input.vertices, 0.0};
    in.check(shape.vertices.size() <= 1000, points, "has more than 1000 vertices");
    if (const std::string why = shapeFault(shape); !why.empty()) in.fail(kind, why);
  }
  return shape;
}
template ShapeOf<2> readShape<2>(Reader);
template ShapeOf<3> readShape<3>(Reader);

namespace {

/// The orientation of a group as it is given.
template <int D>
TurnOf<D> givenTurn(const Reader& in, const DisksInput<D>& group) {
  if constexpr (D == 2) {
    return group.angle * std::numbers::pi / 180.0;
  } else {
    if (!in.has("quaternion")) return noTurn<3>();
    const std::vector<double>& q = group.quaternion;
    in.check(q.size() == 4, "quaternion", "must be four numbers, [w, x, y, z]");
    const Eigen::Quaterniond given(q[0], q[1], q[2], q[3]);
    const auto turn = writtenTurn(given);
    in.check(turn.has_value(), "quaternion", "must be [w, x, y, z] of length 1, not {:g}",
             given.norm());
    return *turn;
  }
}

}  // namespace

template <int D>
void makeConvex(const Reader& in, DisksInput<D>& group) {
  in.notBeside("radius", "shape");
  in.check(group.radiusSpread == 0.0, "radius_spread", "is of disks and spheres");
  ShapeOf<D>& shape = *group.shape;
  const FrameOf<D> frame = intoOwnFrame(shape);
  group.turn = ownTurn<D>(frame, givenTurn<D>(in, group));
  group.radius = shape.reach();
  for (int k = 0; k < D; ++k) {
    const VecOf<D> along = frame.axes.transpose() * VecOf<D>::Unit(k);
    group.extents[k] = along.dot(farthest<D>(shape, along) - farthest<D>(shape, -along));
  }
  const ShapeMassOf<D> spread = massOf(shape);
  if (in.has("density")) group.mass = group.density * spread.measure;
  in.check(std::isnormal(group.mass), in.has("mass") ? "mass" : "density",
           "makes bodies weigh {} kg", group.mass);
  constexpr std::size_t numbers = D == 2 ? 1 : 3;
  if (!in.has("inertia")) {
    if constexpr (D == 2)
      group.moments = {0.0, 0.0, group.mass * momentsPerMass(spread)};
    else
      group.moments = group.mass * momentsPerMass(spread);
    return;
  }
  const std::vector<double>& given = group.inertia;
  in.check(given.size() == numbers, "inertia", "must be {}",
           D == 2 ? "one number, about z" : "[J_x, J_y, J_z]");
  for (std::size_t k = 0; k < numbers; ++k)
    group.moments[D == 2 ? 2 : static_cast<int>(k)] = given[k];
  const std::string fault =
      inertiaFault(*std::ranges::max_element(given), group.mass, group.radius);
  in.check(fault.empty(), "inertia", "{}", fault);
  // Each two moments are more than the third.
  in.check(D == 2 || group.moments.sum() >= 2.0 * group.moments.maxCoeff(), "inertia",
           "is of no body: one moment is more than the other two together");
}
template void makeConvex<2>(const Reader&, DisksInput<2>&);
template void makeConvex<3>(const Reader&, DisksInput<3>&);

}  // namespace crossgrain::inline cases
