#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "cases/loader_sections.hpp"
#include "cases/packing.hpp"

namespace crossgrain::inline cases {
namespace {

/// One distance for both directions, or [between columns, between rows].
Vec2 readSpacing(Reader& in) {
  std::vector<double> values = {1.0};
  in.read("spacing", values, positive("diameters"));
  in.check(values.size() <= 2, "spacing", "must be one number or [columns, rows] in diameters");
  return {values.front(), values.back()};
}

std::vector<Vec2> readGrid(Reader in) {
  int columns = 1, rows = 1;
  bool triangular = false;
  in.require("columns", columns, between(1, mostDisks));
  in.require("rows", rows, between(1, mostDisks));
  in.read("triangular", triangular);
  Vec2 spacing = readSpacing(in);
  if (triangular && spacing.x() == spacing.y()) spacing.y() *= std::sqrt(0.75);
  in.finish();
  const double places = static_cast<double>(columns) * rows;
  in.check(places <= mostDisks, "columns",
           "times {} rows are {:.3g} disks: a case may have at most {}", rows, places, mostDisks);
  return gridPlaces(columns, rows, spacing, triangular);
}

/// A row, column or triangle. @param key  of the number of disks in it
std::pair<int, double> readRow(Reader in, const char* key) {
  int count = 1;
  in.require(key, count, between(1, 1000));
  const double spacing = readSpacing(in).x();
  in.finish();
  return {count, spacing};
}

std::vector<Vec2> readLine(Reader in) {
  int count = 1;
  Vec2 step = Vec2::UnitX();
  in.require("count", count, between(1, mostDisks));
  in.require("step", step, anyNumber("diameters"));
  in.finish();
  std::vector<Vec2> places;
  for (int k = 0; k < count; ++k) places.emplace_back(k * step);
  return places;
}

constexpr std::pair<const char*, const char*> arrangements[] = {
    {"grid", "`{ columns, rows, spacing = 1, triangular = false }`: to the right and upward"},
    {"stack", "`{ count, spacing = 1 }`: upward"},
    {"chain", "`{ count, spacing = 1 }`: to the right"},
    {"heap", "`{ base, spacing = 1 }`: a triangle of rows of base, base − 1, … disks"},
    {"line", "`{ count, step }`: each off by step, [x, y], from the one before"}};

/// Adds the keys of arrangements, of which one may be given.
template <typename T>
std::vector<Key<T>> withArrangements(std::vector<Key<T>> keys) {
  for (const auto& [name, meaning] : arrangements)
    keys.push_back(special<T>(
        {name, "", "–", "a table", meaning}, [](Reader& in, const std::string& key, T& target) {
          if (!in.has(key)) return static_cast<void>(in.take(key));
          Reader part = in.section(key);
          std::vector<Vec2>& places = target.places;
          if (key == "grid") {
            places = readGrid(part);
          } else if (key == "line") {
            places = readLine(part);
          } else {
            const auto [count, space] = readRow(part, key == "heap" ? "base" : "count");
            places = key == "heap"    ? heapPlaces(count, space)
                     : key == "stack" ? gridPlaces(1, count, {space, space}, false)
                                      : gridPlaces(count, 1, {space, space}, false);
          }
        }));
  return keys;
}

void checkArrangement(Reader& in) {
  in.onlyOne({"grid", "stack", "chain", "line", "heap"});
}

/// The keys of [[assembly.disks]].
struct DisksInput : DiskGroup {
  double density = 0.0;
};

const Section<DisksInput>& disksKeys() {
  using D = DisksInput;
  static const Section<D> section(
      {.name = "assembly.disks",
       .kinds = "assembly",
       .note = "One or more, unless the disks come from a file.",
       .isList = true},
      withArrangements<D>(
          {need("position", &D::position, anyNumber("m"), "[x, y] of the (first) disk"),
           need("radius", &D::radius, positive("m"), ""),
           key("mass", &D::mass, positive("kg"), "").listed("one of the two"),
           key("density", &D::density, positive("kg/m^2"), "mass over area")
               .listed("one of the two"),
           key("velocity", &D::velocity, anyNumber("m/s"), ""),
           key("spin", &D::spin, anyNumber("rad/s"), ""),
           key("jitter", &D::jitter, atLeast(0.0, "diameters"),
               "each coordinate is off by up to this"),
           key("radius_spread", &D::radiusSpread, between(0.0, 0.9),
               "radii are off by up to this share, masses as their square"),
           key("velocity_rms", &D::velocityRms, atLeast(0.0, "m/s"),
               "normally distributed, added to `velocity`"),
           keyOf<D>(
               "material", [](D& d) -> MaterialName& { return d.material; }, any,
               "of `[[law.pairs]]`")}));
  return section;
}

DiskGroup readDisks(Reader in) {
  DisksInput group;
  disksKeys().read(in, group);
  checkArrangement(in);
  in.check(!in.has("mass") || !in.has("density"), "density", "and mass: give one of them");
  if (!in.has("mass") && !in.has("density")) in.failMissing("mass", "or density");
  if (in.has("density")) group.mass = massOf(in, group.density, group.radius, 1.0);
  return group;
}

/// The keys of [[assembly.walls]].
struct WallsInput : WallGroup, Plane, Motion {
  Vec2 first = Vec2::Zero();  ///< position of the first wall disk
  std::vector<Vec2> places = {Vec2::Zero()};
  std::vector<double> box;
};

const Section<WallsInput>& wallsKeys() {
  using W = WallsInput;
  static const Section<W> section(
      {.name = "assembly.walls",
       .kinds = "assembly",
       .note = "Each a body of its own.",
       .isList = true},
      withArrangements<W>(
          {key("point", &Plane::point, anyNumber("m"), "of a plane").listed("–"),
           key("normal", &Plane::normal, Range{}, "of a plane; it points to the free side")
               .listed("–"),
           key("box", &W::box, anyNumber("m"),
               "[left, bottom, right, top]: four planes around a room"),
           key("position", &W::first, anyNumber("m"), "[x, y] of the (first) wall disk")
               .listed("–"),
           key("radius", &W::radius, positive("m"), "of wall disks").listed("–"),
           key("velocity", &Motion::velocity, anyNumber("m/s"), "it travels").listed("–"),
           key("amplitude", &Motion::amplitude, anyNumber("m"),
               "or it swings: amplitude [x, y] times sin(frequency t)")
               .listed("–"),
           key("frequency", &Motion::frequency, positive("rad/s"), "of that")
               .listed("with `amplitude`"),
           key("omega", &Motion::angularVelocity, anyNumber("rad/s"), "or it turns about a centre")
               .listed("–"),
           key("centre", &W::centre, anyNumber("m"), "of that"),
           keyOf<W>(
               "material", [](W& w) -> MaterialName& { return w.material; }, any,
               "of `[[law.pairs]]`")}));
  return section;
}

void setMotion(Reader& in, Motion& motion) {
  const std::string way = in.onlyOne({"velocity", "amplitude", "omega"}, "a wall moves in one way");
  if (way == "velocity") motion.kind = Motion::Kind::translating;
  if (way == "amplitude") motion.kind = Motion::Kind::oscillating;
  if (way == "omega") motion.kind = Motion::Kind::rotating;
  if (in.has("frequency"))
    in.check(in.has("amplitude"), "frequency", "needs an amplitude");
  else if (in.has("amplitude"))
    in.failMissing("frequency", "of the oscillation, in rad/s");
}

WallGroup readWalls(Reader in) {
  WallsInput wall;
  wallsKeys().read(in, wall);
  checkArrangement(in);
  setMotion(in, wall);
  wall.motion = wall;
  if (const std::vector<double>& box = wall.box; !box.empty()) {
    in.check(box.size() == 4 && box[2] > box[0] && box[3] > box[1], "box",
             "must be [left, bottom, right, top] in m");
    const Vec2 low(box[0], box[1]), high(box[2], box[3]);
    wall.planes = {{low, {1.0, 0.0}}, {low, {0.0, 1.0}}, {high, {-1.0, 0.0}}, {high, {0.0, -1.0}}};
  }
  if (in.has("point") != in.has("normal"))
    in.failMissing(in.has("point") ? "normal" : "point", "a plane has both");
  if (in.has("normal")) {
    in.check(!wall.normal.isZero(0.0), "normal", "must not be zero");
    wall.planes.push_back({wall.point, wall.normal.normalized()});
  }
  if (in.has("position") != in.has("radius"))
    in.failMissing(in.has("position") ? "radius" : "position", "wall disks have both");
  if (in.has("position"))
    for (const Vec2& place : wall.places)
      wall.position.push_back(wall.first + 2.0 * wall.radius * place);
  if (wall.planes.empty() && wall.position.empty())
    in.failMissing("point", "or box, or position: a wall of planes or disks");
  return wall;
}

/// The keys of [assembly.start].
struct StartInput {
  std::vector<std::filesystem::path> files;
  double density = 0.0, velocityRms = 0.0;
  MaterialName material, fixedMaterial;
};

const Section<StartInput>& startKeys() {
  static const Section<StartInput> section(
      {.name = "assembly.start",
       .kinds = "assembly",
       .note = "Disks of your own, in place of `[[assembly.disks]]`: "
               "[how](../cases/assembly/README.md#a-start-of-your-own)."},
      {need("file", &StartInput::files, ExistingFile{".csv"},
            "one CSV or HDF5 file, or a list of different ones: each is a packing"),
       key("density", &StartInput::density, positive("kg/m^2"), "mass over area")
           .listed("required where a file has no masses"),
       key("velocity_rms", &StartInput::velocityRms, atLeast(0.0, "m/s"),
           "normally distributed, added: makes `preparation.packings` packings of the files in "
           "turn"),
       key("material", &StartInput::material, any, "of its disks, a name of `[[law.pairs]]`"),
       key("fixed_material", &StartInput::fixedMaterial, any, "of those that stand still")});
  return section;
}

/// One start that counts as two packings would make a scatter too small.
void requireDifferent(const StartFiles& starts) {
  std::map<std::string, std::size_t> seen;
  for (std::size_t k = 0; k < starts.disks.size(); ++k) {
    Packing packing;
    packing.disks = starts.disks[k];
    const auto [same, isNew] = seen.emplace(contentHash(packing), k);
    if (!isNew)
      throw BadInput(fmt::format("{}: its disks are those of {}: each file must be another start",
                                 starts.files[k].string(), starts.files[same->second].string()));
  }
}

void readStartFiles(Reader& in, Assembly& assembly) {
  StartFiles& starts = assembly.starts;
  StartInput input;
  startKeys().read(in, input);
  in.check(!input.files.empty(), "file", "must name one file or more");
  starts.files = input.files;
  starts.velocityRms = input.velocityRms;
  starts.material = input.material;
  for (const auto& file : starts.files) {
    const auto mass = [&](double radius) {
      if (input.density == 0.0)
        throw BadInput(
            fmt::format("{}: has no masses, and [assembly.start] no density", file.string()));
      return massOf(in, input.density, radius, 1.0);
    };
    Start start = readStart(file, {mass, assembly.inertiaFactor});
    if (starts.disks.empty()) {
      starts.fixedPosition = start.fixedPosition;
      starts.fixedRadius = start.fixedRadius;
    }
    if (start.fixedPosition != starts.fixedPosition || start.fixedRadius != starts.fixedRadius)
      throw BadInput(fmt::format("{}: its fixed disks are not those of {}", file.string(),
                                 starts.files.front().string()));
    starts.disks.push_back(std::move(start.disks));
    starts.lines.push_back(std::move(start.lines));
    starts.lines.back().insert(starts.lines.back().end(), start.fixedLines.begin(),
                               start.fixedLines.end());
  }
  requireDifferent(starts);
  if (starts.fixedRadius.empty()) return;
  WallGroup fixed;  // disks of the file that stand still, as one more body
  fixed.position = starts.fixedPosition;
  fixed.radii = starts.fixedRadius;
  fixed.material = input.fixedMaterial;
  assembly.walls.push_back(fixed);
}

const Section<Assembly>& assemblyKeys() {
  using A = Assembly;
  static const Section<A> section(
      {.name = "assembly",
       .kinds = "assembly",
       .note = "Disks and walls put together from a few arrangements, for `crossgrain stability`, "
               "or, with `[average]`, for `crossgrain compare` and `lockstep`. With `dt` given a "
               "linear contact may be overdamped."},
      {key("duration", &A::duration, positive("s"), "how long it runs").listed("one of three"),
       key("contact_times", &A::contactTimes, positive("t_c"),
           "the same, in contact times of the lightest pair")
           .listed("one of three"),
       key("steps", &A::steps, positive(), "the same, in steps of the case's dt")
           .listed("one of three"),
       key("gravity", &A::gravity, anyNumber("m/s^2"), "in the plane"),
       key("max_overlap", &A::maxOverlap, between(0.0, 2.0),
           "largest overlap of a start, in units of the smallest radius"),
       key("inertia_factor", &A::inertiaFactor, aboveZeroTo(1.0), "as in `[particles]`"),
       key("rotation", &A::rotation, any, "as in `[particles]`"),
       key("seed", &A::seed, between(0, mostSeed),
           "of all that is random; `[preparation] seed` takes precedence"),
       keyOf<A>(
           "mirror", [](A& a) -> bool& { return a.placement.mirror; }, any,
           "the whole scene mirrored at the y axis"),
       special<A>({"rotate", "degrees", "0", "", "then turned about the origin"},
                  [](Reader& in, const std::string& key, A& a) {
                    double degrees = 0.0;
                    in.read(key, degrees, anyNumber("degrees"));
                    a.placement.turn = degrees * std::numbers::pi / 180.0;
                  }),
       keyOf<A>(
           "offset", [](A& a) -> Vec2& { return a.placement.offset; }, anyNumber("m"),
           "then shifted"),
       keyOf<A>(
           "boost", [](A& a) -> Vec2& { return a.placement.boost; }, anyNumber("m/s"),
           "then with a velocity added to all, walls too")});
  return section;
}

}  // namespace

std::vector<SectionInfo> assemblySections() {
  return {assemblyKeys().info(), disksKeys().info(), wallsKeys().info(), startKeys().info()};
}

void readAssembly(Reader& in, Assembly& target) {
  std::vector<Reader> groups = in.sections("disks"), bodies = in.sections("walls");
  Reader file = in.section("start");
  assemblyKeys().read(in, target);
  std::size_t sum = 0;
  const auto count = [&](const char* key, std::size_t more) {
    sum += more;
    in.check(sum <= static_cast<std::size_t>(mostDisks), key,
             "these are more than the {} disks that a case may have", mostDisks);
  };
  for (Reader& group : groups) {
    target.disks.push_back(readDisks(std::move(group)));
    count("disks", target.disks.back().places.size());
  }
  for (Reader& body : bodies) {
    target.walls.push_back(readWalls(std::move(body)));
    count("walls", target.walls.back().position.size());
  }
  if (in.has("start")) readStartFiles(file, target);
  if (in.onlyOne({"duration", "contact_times", "steps"}).empty())
    in.failMissing("duration", "or contact_times, or steps");
  if (target.disks.empty() && !in.has("start"))
    in.failMissing("disks", "an assembly has [[assembly.disks]], or [assembly.start] with a file");
  if (!target.disks.empty() && in.has("start"))
    in.fail("start", "and [[assembly.disks]]: the disks come from one of the two");
  const bool moved = std::ranges::any_of(target.walls, [](const WallGroup& wall) {
    return wall.motion.kind != Motion::Kind::fixed && wall.motion.kind != Motion::Kind::translating;
  });
  if (moved && !target.placement.boost.isZero(0.0))
    in.fail("boost", "not where a wall rotates or oscillates");
}

}  // namespace crossgrain::inline cases
