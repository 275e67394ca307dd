#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases/assembly_scene.hpp"
#include "cases/loader_sections.hpp"

namespace crossgrain::inline cases {
namespace {

/// One distance for all directions, or one for each: between columns, rows and, in space, layers.
template <int D>
VecOf<D> readSpacing(Reader& in) {
  std::vector<double> values = {1.0};
  in.read("spacing", values, positive("diameters"));
  in.check(values.size() == 1 || values.size() == D, "spacing",
           "must be one number or [columns, rows{}] in diameters", D == 2 ? "" : ", layers");
  if (values.size() == 1) values.resize(D, values.front());
  return VecOf<D>::Map(values.data());
}

/// Columns, rows and layers are along x, y and z, or along the axes that the key of that name has.
template <int D>
std::vector<VecOf<D>> readGrid(Reader in) {
  std::array<int, 3> counts = {1, 1, 1};
  bool triangular = false;
  refuseKeysOf<D>(in, 2, {"layers", "axes"});
  in.require("columns", counts[0], between(1, mostDisks));
  in.require("rows", counts[1], between(1, mostDisks));
  in.read("triangular", triangular);
  VecOf<D> spacing = readSpacing<D>(in);
  std::string axes = "xyz";
  if constexpr (D == 3) {
    in.read("layers", counts[2], between(1, mostDisks));
    in.read("axes", axes, Names{"xyz", "xzy", "yxz", "yzx", "zxy", "zyx"});
  }
  if (triangular && (spacing.array() == spacing[0]).all()) {
    spacing[1] *= std::sqrt(0.75);
    if constexpr (D == 3) spacing[2] *= std::sqrt(2.0 / 3.0);
  }
  in.finish();
  const double places = static_cast<double>(counts[0]) * counts[1] * counts[2];
  in.check(places <= mostDisks, "columns",
           "times {} rows{} are {:.3g} disks: a case may have at most {}", counts[1],
           D == 2 ? "" : fmt::format(" and {} layers", counts[2]), places, mostDisks);
  if constexpr (D == 2) {
    return gridPlaces(counts[0], counts[1], spacing, triangular);
  } else {
    std::vector<Vec3> found = latticePlaces(counts, spacing, triangular);
    for (Vec3& place : found) {
      const Vec3 before = place;
      for (std::size_t k = 0; k < 3; ++k) place[axes[k] - 'x'] = before[static_cast<int>(k)];
    }
    return found;
  }
}

/// A row, column or triangle. @param key  of the number of disks in it
std::pair<int, double> readRow(Reader in, const char* key) {
  int count = 1;
  in.require(key, count, between(1, 1000));
  const double spacing = readSpacing<2>(in).x();
  in.finish();
  return {count, spacing};
}

template <int D>
std::vector<VecOf<D>> readLine(Reader in) {
  int count = 1;
  VecOf<D> step = VecOf<D>::UnitX();
  in.require("count", count, between(1, mostDisks));
  in.require("step", step, anyNumber("diameters"));
  in.finish();
  std::vector<VecOf<D>> places;
  for (int k = 0; k < count; ++k) places.emplace_back(k * step);
  return places;
}

std::vector<Vec3> readCircles(Reader in) {
  double inner = 0.0, outer = 0.0, spacing = 1.0;
  int layers = 1;
  std::string axis = "z";
  in.read("inner", inner, atLeast(0.0, "diameters"));
  in.require("outer", outer, positive("diameters"));
  in.read("spacing", spacing, positive("diameters"));
  double rise = spacing;
  in.read("layers", layers, between(1, mostDisks));
  in.read("rise", rise, positive("diameters"));
  in.read("axis", axis, Names{"x", "y", "z"});
  in.finish();
  in.check(outer >= inner, "outer", "must be at least inner, {:g} diameters", inner);
  const double most = std::numbers::pi * std::pow(outer / spacing + 1.0, 2) * layers;
  in.check(most <= mostDisks, "outer",
           "and layers are about {:.3g} disks: a case may have at most {}", most, mostDisks);
  std::vector<Vec3> places = circlePlaces(inner, outer, spacing, layers, rise);
  for (Vec3& place : places)
    for (char to = axis[0]; to != 'z'; to = to == 'x' ? 'y' : 'z')
      place = Vec3(place.y(), place.z(), place.x());  // what was along z is along y, then along x
  return places;
}

struct Arrangement {
  const char *name, *meaning;
  bool inSpace;
};
constexpr Arrangement arrangements[] = {
    {"grid",
     "`{ columns, rows, spacing = 1, triangular = false }`: right and up. In space also `layers = "
     "1`, `axes = \"xyz\"` of columns, rows, layers; triangular: close-packed",
     true},
    {"stack", "`{ count, spacing = 1 }`, up", false},
    {"chain", "`{ count, spacing = 1 }`, right", true},
    {"heap", "`{ base, spacing = 1 }`: rows of base, base − 1, … disks", false},
    {"line", "`{ count, step }`: step [x, y]", true},
    {"circles",
     "in space: `{ inner = 0, outer, spacing = 1, layers = 1, rise = spacing, axis = \"z\" }`: "
     "about `position`, radii inner, inner + spacing … outer; layers along the axis",
     true}};

/// Adds the keys of arrangements, of which one may be given.
template <int D, typename T>
std::vector<Key<T>> withArrangements(std::vector<Key<T>> keys) {
  for (const auto& [name, meaning, inSpace] : arrangements) {
    if (D == 3 && !inSpace) continue;
    keys.push_back(
        special<T>({name, "diameters", "–", "a table", meaning},
                   [](Reader& in, const std::string& key, T& target) {
                     if (!in.has(key)) return static_cast<void>(in.take(key));
                     Reader part = in.section(key);
                     std::vector<VecOf<D>>& places = target.places;
                     if (key == "grid") {
                       places = readGrid<D>(part);
                     } else if (key == "line") {
                       places = readLine<D>(part);
                     } else if (key == "circles") {
                       if constexpr (D == 3) places = readCircles(part);
                     } else {
                       const auto [count, space] = readRow(part, key == "heap" ? "base" : "count");
                       if constexpr (D == 2)
                         places = key == "heap"    ? heapPlaces(count, space)
                                  : key == "stack" ? gridPlaces(1, count, {space, space}, false)
                                                   : gridPlaces(count, 1, {space, space}, false);
                       else
                         places = latticePlaces({count, 1, 1}, Vec3::Constant(space), false);
                     }
                   }));
  }
  return keys;
}

void checkArrangement(Reader& in) {
  in.onlyOne({"grid", "stack", "chain", "line", "heap", "circles"});
}

template <int D>
const Section<DisksInput<D>>& disksKeys() {
  using I = DisksInput<D>;
  static const Section<I> section(
      {.name = "assembly.disks",
       .kinds = "assembly",
       .note = "In space spheres: vectors and `spin` have three numbers. With `shape` [convex "
               "bodies](#convex-bodies): `position` is the centre of mass.",
       .isList = true},
      withArrangements<D, I>(
          {need("position", &I::position, anyNumber("m"), "[x, y] of the (first) disk"),
           key("radius", &I::radius, positive("m"), "").listed("required without `shape`"),
           special<I>(
               {"shape", "m", "–", "a table",
                "a convex body, one of: `{ polygon = [[x, y], …] }`, counter-clockwise about any "
                "origin; `{ sides, radius }`, a regular polygon on its side; `{ box = [a, "
                "b] }`, in space `[a, b, c]`; `{ capsule = [length, radius] }`, along x, in "
                "space along z; in space also `{ cylinder = [length, radius] }`, along z, "
                "and `{ polyhedron = [[x, y, z], …] }`. In the plane `rounding` = 0 (m) goes "
                "with polygons and boxes: the body is all within it of them"},
               [](Reader& in, const std::string& name, I& group) {
                 if (in.has(name))
                   group.shape = readShape<D>(in.section(name));
                 else
                   in.take(name);
               }),
           key("angle", &I::angle, between(-360.0, 360.0, "degrees"),
               "of a convex body, in the plane"),
           key("quaternion", &I::quaternion, Range{},
               "[w, x, y, z], of a convex body, to the scene's frame")
               .listed("[1, 0, 0, 0]"),
           key("random_turn", &I::randomTurn, any, "uniformly random"),
           key("inertia", &I::inertia, positive("kg m^2"),
               "of a convex body; in space [J_x, J_y, J_z] about principal axes")
               .listed("by density"),
           key("mass", &I::mass, positive("kg"), "").listed("one of the two"),
           key("density", &I::density, densities<D>(), densityMeaning).listed("one of the two"),
           key("velocity", &I::velocity, anyNumber("m/s"), ""),
           key("spin", &I::spin, anyNumber("rad/s"), ""),
           key("choose", &I::choose, between(1, mostDisks),
               "number of places, random in each packing")
               .listed("all"),
           key("jitter", &I::jitter, atLeast(0.0, "diameters"),
               "largest random shift of each coordinate"),
           key("radius_spread", &I::radiusSpread, between(0.0, 0.9),
               "radii vary by up to this share, masses as the square (in space cube)"),
           key("velocity_rms", &I::velocityRms, atLeast(0.0, "m/s"), "normally distributed, added"),
           keyOf<I>(
               "material", [](I& d) -> MaterialName& { return d.material; }, any,
               "of `[[law.pairs]]`")}));
  return section;
}

template <int D>
DiskGroupOf<D> readDisks(Reader in) {
  DisksInput<D> group;
  refuseKeysOf<D>(in, 3, {"stack", "heap", "angle"});
  refuseKeysOf<D>(in, 2, {"circles", "quaternion"});
  disksKeys<D>().read(in, group);
  checkArrangement(in);
  in.check(group.count() <= group.places.size(), "choose", "must be at most {}, the places there",
           group.places.size());
  in.notBeside("density", "mass");
  if (!in.has("mass") && !in.has("density")) in.failMissing("mass", "or density");
  if (group.shape) {
    makeConvex(in, group);
    return group;
  }
  for (const char* const ofShapes : {"angle", "quaternion", "random_turn", "inertia"})
    in.check(!in.has(ofShapes), ofShapes, "is of convex bodies, which have a shape");
  if (!in.has("radius")) in.failMissing("radius", "or shape");
  if (in.has("density")) group.mass = massOfOne<D>(in, group.density, group.radius);
  return group;
}

/// Makes a direction one of length 1. The square of what is shorter than this is no number.
void normalise(const Reader& in, const char* key, auto& direction) {
  constexpr double shortest = 1e-100;
  in.check(direction.norm() > shortest, key, "must not be zero, or of a length below {:g}",
           shortest);
  direction.normalize();
}

/// Into a body with a cylinder, which turns about its axis or stands still.
void readCylinder(Reader in, WallGroupOf<3>& wall) {
  Cylinder& cylinder = wall.cylinders.emplace_back();
  double omega = 0.0;
  in.read("point", cylinder.point, anyNumber("m"));
  in.require("axis", cylinder.axis, Range{});
  in.require("radius", cylinder.radius, positive("m"));
  in.read("omega", omega, anyNumber("rad/s"));
  in.finish();
  normalise(in, "axis", cylinder.axis);
  if (omega == 0.0) return;
  wall.centre = cylinder.point;
  wall.motion.kind = MotionKind::rotating;
  wall.motion.angularVelocity = omega * cylinder.axis;
}

/// The keys of [[assembly.walls]].
template <int D>
struct WallsInput : WallGroupOf<D>, PlaneOf<D>, MotionOf<D> {
  VecOf<D> first = VecOf<D>::Zero();  ///< position of the first wall disk
  std::vector<VecOf<D>> places = {VecOf<D>::Zero()};
  std::vector<double> box;
};

template <int D>
const Section<WallsInput<D>>& wallsKeys() {
  using I = WallsInput<D>;
  using Moved = MotionOf<D>;
  static const Section<I> section = [] {
    std::vector<Key<I>> keys = {
        key("point", &PlaneOf<D>::point, anyNumber("m"), "of a plane").listed("–"),
        key("normal", &PlaneOf<D>::normal, Range{}, "to the free side").listed("–"),
        key("box", &I::box, anyNumber("m"),
            "[left, bottom, right, top], four planes; in space lower and upper corner, six planes"),
        special<I>(
            {"cylinder", "", "–", "a table",
             "in space: `{ point = [0, 0, 0], axis, radius, omega = 0 }` [m, rad/s]: hollow, "
             "without ends, spheres inside. All of the wall turns about the axis at omega"},
            [](Reader& in, const std::string& name, I& wall) {
              if (!in.has(name)) return static_cast<void>(in.take(name));
              if constexpr (D == 3) readCylinder(in.section(name), wall);
            }),
        key("position", &I::first, anyNumber("m"), "[x, y] of the (first) wall disk").listed("–"),
        key("radius", &I::radius, positive("m"), "of wall disks").listed("–"),
        key("velocity", &Moved::velocity, anyNumber("m/s"), "travels").listed("–"),
        key("amplitude", &Moved::amplitude, anyNumber("m"),
            "or swings: amplitude [x, y] times sin(frequency t)")
            .listed("–"),
        key("frequency", &Moved::frequency, positive("rad/s"), "").listed("with `amplitude`")};
    if constexpr (D == 2) {
      keys.push_back(key("omega", &Moved::angularVelocity, anyNumber("rad/s"),
                         "or turns about `centre`; in the plane")
                         .listed("–"));
      keys.push_back(key("centre", &I::centre, anyNumber("m"), ""));
    }
    keys.push_back(keyOf<I>(
        "material", [](I& w) -> MaterialName& { return w.material; }, any, "of `[[law.pairs]]`"));
    return Section<I>({.name = "assembly.walls",
                       .kinds = "assembly",
                       .note = "Each a body of its own.",
                       .isList = true},
                      withArrangements<D, I>(std::move(keys)));
  }();
  return section;
}

template <int D>
void setMotion(Reader& in, MotionOf<D>& motion) {
  const std::string way = in.onlyOne({"velocity", "amplitude", "omega"}, "a wall moves in one way");
  if (way == "velocity") motion.kind = MotionKind::translating;
  if (way == "amplitude") motion.kind = MotionKind::oscillating;
  if (way == "omega") motion.kind = MotionKind::rotating;
  if (in.has("frequency"))
    in.check(in.has("amplitude"), "frequency", "needs an amplitude");
  else if (in.has("amplitude"))
    in.failMissing("frequency", "of the oscillation, in rad/s");
}

/// Around a room between two corners: first the planes of the lower one.
template <int D>
std::vector<PlaneOf<D>> planesAround(const VecOf<D>& low, const VecOf<D>& high) {
  std::vector<PlaneOf<D>> planes;
  for (const double inward : {1.0, -1.0})
    for (int k = 0; k < D; ++k) {
      planes.push_back({inward > 0.0 ? low : high, VecOf<D>::Zero()});
      planes.back().normal[k] = inward;
    }
  return planes;
}

template <int D>
WallGroupOf<D> readWalls(Reader in) {
  WallsInput<D> wall;
  refuseKeysOf<D>(in, 3, {"stack", "heap", "omega", "centre"});
  refuseKeysOf<D>(in, 2, {"circles", "cylinder"});
  wallsKeys<D>().read(in, wall);
  checkArrangement(in);
  setMotion<D>(in, wall);
  for (const char* const way : {"velocity", "amplitude"})
    in.check(!in.has(way) || wall.cylinders.empty(), way,
             "is not of a wall with a cylinder, which stands still or turns about its axis");
  if (wall.cylinders.empty()) wall.motion = wall;
  if (std::vector<double>& box = wall.box; !box.empty()) {
    const bool sized = box.size() == 2 * D;
    if (!sized) box.assign(2 * D, 0.0);
    const VecOf<D> low = VecOf<D>::Map(box.data()), high = VecOf<D>::Map(box.data() + D);
    in.check(sized && ((high - low).array() > 0.0).all(), "box", "must be {} in m",
             D == 2 ? "[left, bottom, right, top]" : "the lower [x, y, z] and the upper one");
    wall.planes = planesAround<D>(low, high);
  }
  if (in.has("point") != in.has("normal"))
    in.failMissing(in.has("point") ? "normal" : "point", "a plane has both");
  if (in.has("normal")) {
    normalise(in, "normal", wall.normal);
    wall.planes.push_back({wall.point, wall.normal});
  }
  if (in.has("position") != in.has("radius"))
    in.failMissing(in.has("position") ? "radius" : "position", "wall disks have both");
  if (in.has("position"))
    for (const VecOf<D>& place : wall.places)
      wall.WallGroupOf<D>::position.push_back(wall.first + 2.0 * wall.radius * place);
  if (wall.planes.empty() && wall.cylinders.empty() && wall.WallGroupOf<D>::position.empty())
    in.failMissing("point", D == 2 ? "or box, or position: a wall of planes or disks"
                                   : "or box, cylinder or position: a wall of planes or spheres");
  return wall;
}

template <int D>
const Section<AssemblyOf<D>>& assemblyKeys() {
  using A = AssemblyOf<D>;
  static const Section<A> section = [] {
    std::vector<Key<A>> keys = {
        key("duration", &A::duration, positive("s"), "of the run").listed("one of three"),
        key("contact_times", &A::contactTimes, positive("t_c"), "of the lightest pair")
            .listed("one of three"),
        key("steps", &A::steps, positive(), "of the case's dt").listed("one of three"),
        key("gravity", &A::gravity, anyNumber("m/s^2"), ""),
        key("max_overlap", &A::maxOverlap, between(0.0, 2.0),
            "largest of a start, in smallest radii"),
        key("inertia_factor", &A::inertiaFactor, aboveZeroTo(1.0),
            "as in `[particles]`; in space 0.4"),
        key("rotation", &A::rotation, any, "as in `[particles]`"),
        key("seed", &A::seed, between(0, mostSeed), "`preparation.seed` takes precedence")};
    if constexpr (D == 2) {
      keys.push_back(keyOf<A>(
          "mirror", [](A& a) -> bool& { return a.placement.mirror; }, any,
          "mirrored at the y axis; this and the next three in the plane only"));
      keys.push_back(special<A>({"rotate", "degrees", "0", "", "then, about the origin"},
                                [](Reader& in, const std::string& key, A& a) {
                                  double degrees = 0.0;
                                  in.read(key, degrees, anyNumber("degrees"));
                                  a.placement.turn = degrees * std::numbers::pi / 180.0;
                                }));
      keys.push_back(keyOf<A>(
          "offset", [](A& a) -> Vec2& { return a.placement.offset; }, anyNumber("m"),
          "then shifted"));
      keys.push_back(keyOf<A>(
          "boost", [](A& a) -> Vec2& { return a.placement.boost; }, anyNumber("m/s"),
          "then, added to all velocities, walls too"));
    }
    return Section<A>(
        {.name = "assembly",
         .kinds = "assembly",
         .note = "Disks, or spheres, and walls, for `stability` or, with `[average]`, `compare` "
                 "and `lockstep`. With `dt` given a linear contact may be overdamped."},
        std::move(keys));
  }();
  return section;
}

constexpr std::initializer_list<const char*> placementKeys = {"mirror", "rotate", "offset",
                                                              "boost"};

}  // namespace

std::vector<SectionInfo> assemblySections() {
  return {assemblyKeys<2>().info(), disksKeys<2>().info(), wallsKeys<2>().info(), boxSection(),
          startSection()};
}

template <int D>
void readAssembly(Reader& in, AssemblyOf<D>& target) {
  std::vector<Reader> groups = in.sections("disks"), bodies = in.sections("walls");
  Reader file = in.section("start"), box = in.section("box");
  refuseKeysOf<D>(in, 3, placementKeys);
  assemblyKeys<D>().read(in, target);
  std::size_t sum = 0;
  const auto count = [&](const char* key, std::size_t more) {
    sum += more;
    in.check(sum <= static_cast<std::size_t>(mostDisks), key,
             "these are more than the {} disks that a case may have", mostDisks);
  };
  for (Reader& group : groups) {
    target.disks.push_back(readDisks<D>(std::move(group)));
    count("disks", target.disks.back().count());
  }
  for (Reader& body : bodies) {
    target.walls.push_back(readWalls<D>(std::move(body)));
    count("walls", target.walls.back().position.size());
  }
  if (in.has("start")) readStartFiles(file, target);
  checkCylinders(in, target);
  if (in.onlyOne({"duration", "contact_times", "steps"}).empty())
    in.failMissing("duration", "or contact_times, or steps");
  if (target.disks.empty() && !in.has("start"))
    in.failMissing("disks", "an assembly has [[assembly.disks]], or [assembly.start] with a file");
  if (!target.disks.empty() && in.has("start"))
    in.fail("start", "and [[assembly.disks]]: the disks come from one of the two");
  if (in.has("box")) {
    for (const char* const key : placementKeys)
      in.check(!in.has(key), key, "not where assembly.box has periodic directions");
    readBox(box, target);
  }
  const bool moved = std::ranges::any_of(target.walls, [](const WallGroupOf<D>& wall) {
    return wall.motion.kind != MotionKind::fixed && wall.motion.kind != MotionKind::translating;
  });
  if (moved && !target.placement.boost.isZero(0.0))
    in.fail("boost", "not where a wall rotates or oscillates");
}
template void readAssembly<2>(Reader&, Assembly&);
template void readAssembly<3>(Reader&, AssemblyOf<3>&);

}  // namespace crossgrain::inline cases
