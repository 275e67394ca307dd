#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "cases/collision_scene.hpp"
#include "cases/loader_sections.hpp"
#include "cases/time_step.hpp"
#include "oracle/collision_quantities.hpp"

namespace crossgrain::inline cases {
namespace {

constexpr int mostCollisions = 100'000;  // two disks each, all in one scene

/// A number, a list, or { from, to, count } for equal steps.
void readSweep(Reader& in, const std::string& key, std::vector<double>& values,
               const Range& allowed) {
  if (!in.isTable(key)) return in.read(key, values, allowed);
  double from = 0.0, to = 0.0;
  int count = 0;
  Reader range = in.section(key);
  range.require("from", from, allowed);
  range.require("to", to, allowed);
  range.require("count", count, between(2, 10'000));
  range.finish();
  range.check(to > from, "to", "must be > {} (from)", from);
  for (int k = 0; k < count; ++k) values.push_back(from + (to - from) * k / (count - 1));
}

/// A key that is read where the case's dimension is known.
Key<Collision> later(const char* name, const char* unit, const char* standard, const char* values,
                     const char* meaning) {
  return special<Collision>({name, unit, standard, values, meaning},
                            [](Reader& in, const std::string& key, Collision&) { in.take(key); });
}

const Section<Collision>& collisionKeys() {
  constexpr const char* users = "calibrate baseline collide record stability";
  const Range speeds = positive("m/s", ", else the two never meet");
  static const Section<Collision> section(
      {.name = "collision",
       .kinds = "collision",
       .commands = "compare plan lockstep identify baseline record effects cost stability collide",
       .note = "Two disks, or a disk and a wall, with Ψ_i = v_t/\\|v_n\\| of the contact point; "
               "one sweep over `psi` for each `vn` and `steps_per_contact`. With `shape`: convex "
               "bodies ([rules](#collisions))."},
      {special<Collision>(
           {"psi", "–", "required", "", "a number, a list, or `{ from = 0, to = 4, count = 41 }`"},
           [](Reader& in, const std::string& key, Collision& c) {
             readSweep(in, key, c.psi, anyNumber());
           }),
       special<Collision>(
           {"angle", "degrees", "–", "(-90, 90)", "instead of `psi`: Ψ_i = tan(angle)"},
           [](Reader& in, const std::string& key, Collision& c) {
             if (!in.has(key)) return static_cast<void>(in.take(key));
             in.notBeside(key, "psi", ", its tangent");
             readSweep(in, key, c.psi, inside(-90.0, 90.0, "degrees"));
             for (double& psi : c.psi) psi = std::tan(psi * std::numbers::pi / 180.0);
           }),
       key("vn", &Collision::vn, speeds, "of approach, a number or a list").listed("required"),
       key("speed", &Collision::speed, speeds, "instead of `vn`: √(v_n² + v_t²)").listed("–"),
       key("approach", &Collision::approach, Names{"spin", "first_spin", "oblique"},
           "v_t is of equal spins (centres head on), the first spin, or the centres' velocities"),
       key("counter_spin", &Collision::counterSpin, anyNumber("rad/s"),
           "a list: added to the first spin, a_i/a_j of it subtracted from the second; v_t stays"),
       special<Collision>({"second", "", "\"disk\"", "disk, wall, body",
                           "`wall`: a plane of infinite mass; `body`: convex; its face meets a "
                           "corner of the first"},
                          [](Reader& in, const std::string& key, Collision& c) {
                            std::string second = "disk";
                            in.read(key, second, Names{"disk", "wall", "body"});
                            c.wall = second == "wall";
                          }),
       special<Collision>({"wall_velocity", "m/s", "[0, 0]", "",
                           "along its normal and the wall; relative motion stays"},
                          [](Reader& in, const std::string& key, Collision& c) {
                            std::vector<double> velocity(2);
                            in.read(key, velocity, anyNumber());
                            in.check(velocity.size() == 2, key,
                                     "must be [along its normal, along it] in m/s");
                            c.wallVelocity = {velocity[0], velocity[1]};
                          }),
       key("radius", &Collision::radius, positive("m"), "of both disks, or `[a, b]`")
           .listed("required without `shape`")
           .usedBy(users),
       need("mass", &Collision::mass, positive("kg"), "likewise").usedBy(users),
       special<Collision>({"material", "", "–", "", "of both, or `[a, b]`; a wall is the second"},
                          [](Reader& in, const std::string& key, Collision& c) {
                            const toml::node* const node = in.take(key);
                            if (!node) return;
                            const toml::array* const both = node->as_array();
                            in.check(!both || both->size() == 2, key, "must be one name or two");
                            for (const std::size_t side : {0u, 1u})
                              convert({both ? *both->get(side) : *node, "collision.material"},
                                      c.material.emplace_back());
                          }),
       key("inertia_factor", &Collision::inertiaFactor, aboveZeroTo(1.0), "as in `[particles]`")
           .usedBy(users),
       keyOf<Collision>(
           "first_spin", [](auto& c) -> auto& { return c.spinOutOfPlane[0]; }, anyNumber("rad/s"),
           "in space, additional spin about n (line of centres) and s (tangent)"),
       keyOf<Collision>(
           "second_spin", [](auto& c) -> auto& { return c.spinOutOfPlane[1]; }, anyNumber("rad/s"),
           "likewise"),
       special<Collision>(
           {"turn", "degrees", "[0, 0, 0]", "",
            "in space, rotation vector of the scene; before, n, s, n × s are along x, y, z"},
           [](Reader& in, const std::string& key, Collision& c) {
             std::vector<double> degrees(3);
             in.read(key, degrees, anyNumber());
             in.check(degrees.size() == 3, key, "must be [x, y, z] in degrees");
             c.turn = Vec3::Map(degrees.data()) * (std::numbers::pi / 180.0);
           }),
       later("shape", "m", "–", "a table",
             "convex body, as of `[[assembly.disks]]`, as first body"),
       later("second_shape", "m", "`shape`", "a table", "of `second = \"body\"`"),
       later("second_radius", "m", "–", "> 0", "of a disk or sphere that a convex body meets"),
       later("offset", "m", "0", "",
             "of the corner from the middle of the second's face, along s; in space [along s, "
             "along n × s]"),
       special<Collision>({"orientation", "degrees", "0", "[-360, 360]",
                           "of the convex body at the touch, counter-clockwise, a sweep like "
                           "`psi`; at 0 its x, y are along n (towards it), s"},
                          [](Reader& in, const std::string& key, Collision& c) {
                            if (!in.has(key)) return static_cast<void>(in.take(key));
                            c.orientation.clear();
                            readSweep(in, key, c.orientation, between(-360.0, 360.0, "degrees"));
                            for (double& angle : c.orientation) angle *= std::numbers::pi / 180.0;
                          }),
       later("axis", "–", "[0, 0, 1]", "", "in space, of `orientation`"),
       later("quaternion", "–", "[1, 0, 0, 0]", "", "in space, at `orientation = 0`"),
       special<Collision>({"spin", "rad/s", "0", "",
                           "of the convex body at the touch, about n × s, a sweep like `psi`"},
                          [](Reader& in, const std::string& key, Collision& c) {
                            if (!in.has(key)) return static_cast<void>(in.take(key));
                            c.spin.clear();
                            readSweep(in, key, c.spin, anyNumber("rad/s"));
                          }),
       key("steps_per_contact", &Collision::stepsPerContact, atLeast(2.0),
           "a number or a list; a rigid law takes `run.dt` instead"),
       key("start_phase", &Collision::startPhase,
           Range{.low = 0.0,
                 .high = 1.0,
                 .highOpen = true,
                 .reason = ": from 0 on, else the two overlap at the start"},
           "touch, as fraction of a step")});
  return section;
}

void checkWall(Reader& in, const Collision& c) {
  if (!c.wall) {
    in.check(!in.has("wall_velocity"), "wall_velocity", "only a wall has one (second = \"wall\")");
    return;
  }
  for (const char* const key : {"radius", "mass"})
    in.check(!in.has(key) || !in.take(key)->is_array(), key,
             "a wall has none: give the disk's alone");
  in.check(c.counterSpin == std::vector<double>{0.0}, "counter_spin", "a wall does not turn");
}

/// The middle of a body's face towards +x, from its centre of mass, and the distance from where a
/// corner meets it to its rim, at least [m].
template <int D>
std::pair<VecOf<D>, double> faceOf(const Reader& in, const ShapeOf<D>& shape, const TurnOf<D>& turn,
                                   const Eigen::Matrix<double, D - 1, 1>& offset) {
  const Eigen::Matrix<double, D, D> axes = matrixOf<D>(turn);
  const VecOf<D> own = axes.transpose() * VecOf<D>::UnitX();
  const double top = own.dot(farthest<D>(shape, own)) - shape.rounding;
  std::vector<VecOf<D>> corners;
  VecOf<D> middle = VecOf<D>::Zero();
  for (const VecOf<D>& corner : shape.vertices)
    if (top - corner.dot(own) < 1e-9 * shape.reach()) corners.emplace_back(axes * corner);
  in.check(corners.size() >= D && shape.kind != ShapeKind::cylinder,
           in.has("second_shape") ? "second_shape" : "second",
           "this body has no flat face towards n, its x axis");
  for (const VecOf<D>& corner : corners) middle += corner / static_cast<double>(corners.size());
  const VecOf<D> arm = middle + (VecOf<D>() << shape.rounding, offset).finished();
  double room = std::numeric_limits<double>::infinity();
  if constexpr (D == 2) {
    const auto [low, high] = std::ranges::minmax(corners, {}, [](const Vec2& c) { return c.y(); });
    room = std::min(arm.y() - low.y(), high.y() - arm.y());
  } else {
    std::ranges::sort(corners, {}, [&](const Vec3& corner) {
      return std::atan2(corner.z() - middle.z(), corner.y() - middle.y());
    });
    const auto flat = [](const Vec3& v) { return Vec2(v.y(), v.z()); };
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Vec2 from = flat(corners[k]), along = flat(corners[(k + 1) % corners.size()]) - from;
      room = std::min(room, cross(along.normalized(), Vec2(flat(arm) - from)));
    }
  }
  in.check(room > 1e-3 * shape.reach(), in.has("offset") ? "offset" : "second",
           "the corner misses the second body's face, or meets its rim");
  return {arm, room};
}

template <int D>
void readConvexPair(Reader& in, Collision& c) {
  const bool disk = in.has("second_radius");
  ConvexPairOf<D> pair;
  DisksInput<D> first;
  first.mass = c.mass[0];
  refuseKeysOf<D>(in, 2, {"quaternion", "axis"});
  in.read("quaternion", first.quaternion, Range{});
  in.read("axis", pair.axis, Range{});
  in.check(pair.axis.norm() > 0.0, "axis", "must not be zero");
  pair.axis.normalize();
  first.shape = readShape<D>(in.section("shape"));
  makeConvex<D>(in, first);
  pair.body[0] = first;
  c.radius[0] = c.radius[1] = pair.body[0].radius;
  std::vector<double> offset(D - 1);
  in.read("offset", offset, anyNumber("m"));
  in.check(offset.size() == D - 1, "offset",
           D == 2 ? "must be one number in m" : "must be [along s, along n × s] in m");
  in.check(!in.has("offset") || (!c.wall && !disk), "offset", "is along a second body's face");
  if (disk) {
    in.read("second_radius", c.radius[1], positive("m"));
    pair.body[1].radius = c.radius[1];
    pair.body[1].mass = c.mass[1];
    pair.body[1].moments.setConstant(c.inertiaFactor * c.mass[1] * c.radius[1] * c.radius[1]);
    pair.arm = c.radius[1] * VecOf<D>::UnitX();
  } else if (!c.wall) {
    DisksInput<D> second;
    second.mass = c.mass[1];
    second.quaternion = {1.0, 0.0, 0.0, 0.0};
    second.shape = readShape<D>(in.section(in.has("second_shape") ? "second_shape" : "shape"));
    makeConvex<D>(in, second);
    pair.body[1] = second;
    c.radius[1] = pair.body[1].radius;
    std::tie(pair.arm, pair.room) = faceOf<D>(in, *pair.body[1].shape, pair.body[1].turn,
                                              Eigen::Matrix<double, D - 1, 1>::Map(offset.data()));
  }
  c.convex = std::move(pair);
}

/// Refuses keys of disks where there are convex bodies, and the other way.
void checkShape(Reader& in, const Collision& c) {
  std::string second = c.wall ? "wall" : "disk";
  if (const toml::node* const node = in.take("second")) second = *node->value<std::string>();
  if (!in.has("shape")) {
    if (!in.has("radius")) in.failMissing("radius", "or shape");
    for (const char* const key :
         {"second_shape", "second_radius", "orientation", "axis", "quaternion", "spin", "offset"})
      in.check(!in.has(key), key, "is of convex bodies, which have a shape");
    in.check(second != "body", "second", "is of convex bodies: give shape");
    return;
  }
  in.notBeside("radius", "shape");
  for (const char* const key : {"approach", "counter_spin"})
    in.check(!in.has(key), key,
             "is of disks and spheres: the centre of a convex body moves as v_n, "
             "Ψ_i and its spin say");
  in.check(second == "body" || !in.has("second_shape"), "second_shape", "is of second = \"body\"");
  in.check(second == "disk" || !in.has("second_radius"), "second_radius",
           "is of second = \"disk\"");
  in.check(second == "disk" || !in.has("inertia_factor"), "inertia_factor",
           "is of a disk or sphere: a convex body has its own moments");
  if (second == "disk" && !in.has("second_radius"))
    in.failMissing("second_radius", "of the disk; or second = \"wall\" or \"body\"");
}

}  // namespace

void checkConvexStarts(const Reader& in, const Case& c) {
  const Collision& collision = collisionIn(c);
  in.check(!c.law.soft(), "shape",
           "bodies that meet with a corner have a rigid law: law.normal = \"rigid\"");
  in.check(c.law.et0 == 0.0, "shape", "takes law.e_t0 = 0: tangential restitution is of disks");
  in.check(
      !c.stability, "shape",
      "and [stability]: its measures of collisions are those of disks; an assembly has others");
  const char* const key = in.has("orientation")  ? "orientation"
                          : in.has("quaternion") ? "quaternion"
                                                 : "shape";
  for (const CollisionStart& start : collisionStarts(c)) {
    const auto [next, free] = inDimensionOf(c, [&]<int D>() {
      const ConvexTouchOf<D> touch = convexTouch<D>(c, start);
      return std::pair(touch.next, freeFlight(touch, convexImpact(touch.impact), start.vn));
    });
    const double degrees = start.orientation * 180.0 / std::numbers::pi;
    in.check(next > 1e-6 * collision.radius[0], key,
             "at orientation {:.6g} a face or an edge meets flat: no single corner is the nearest",
             degrees);
    in.check(free > readingTime(timeStep(c)), key,
             "at orientation {:.6g} a second corner may meet {:.2g} s after the first, within the "
             "{:g} steps after which velocities are read: take another orientation, a smaller "
             "run.dt or a slower approach",
             degrees, free, readingSteps);
  }
}

std::vector<SectionInfo> collisionSections() {
  return {collisionKeys().info(),
          marginSection({.name = "collision.margins",
                         .kinds = "collision",
                         .commands = "collide",
                         .note = "Without margins nothing is judged: exit 1."},
                        "QUANTITY", "largest error", "of the oracle's curve", false)};
}

void readCollision(Reader& in, Collision& c, int dimension) {
  const Reader margins = in.section("margins");
  collisionKeys().read(in, c);
  if (!in.has("psi") && !in.has("angle")) in.failMissing("psi");
  in.notBeside("speed", "vn", ", its part along the normal");
  if (!in.has("speed") && !in.has("vn")) in.failMissing("vn");
  checkShape(in, c);
  checkWall(in, c);
  if (in.has("shape")) dimension == 3 ? readConvexPair<3>(in, c) : readConvexPair<2>(in, c);
  for (const char* const key : {"first_spin", "second_spin", "turn"})
    in.check(dimension == 3 || !in.has(key), key,
             "only collisions in space have it (case.dimension = 3)");
  in.check(!c.wall || !in.has("second_spin"), "second_spin", "a wall does not turn");
  const auto starts =
      static_cast<double>(c.psi.size()) *
      static_cast<double>(std::max<std::size_t>(1, c.vn.size())) *
      static_cast<double>(c.counterSpin.size() * c.orientation.size() * c.spin.size());
  in.check(starts <= mostCollisions, in.has("psi") ? "psi" : "angle",
           "with all {} {:.0f} collisions: at most {}",
           c.isConvex() ? "vn, orientation and spin" : "vn and counter_spin", starts,
           mostCollisions);
  std::vector<Judged> quantities;
  for (const CollisionQuantity& quantity : scoredQuantities())
    quantities.push_back({std::string(quantity.name), ""});
  c.margins = readMargins(margins, quantities);
}

}  // namespace crossgrain::inline cases
