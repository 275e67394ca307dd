#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases/loader_sections.hpp"
#include "stability/measures.hpp"

namespace crossgrain::inline cases {
namespace {

/// [x, y] where the key is there.
void readVector(Reader& in, std::string_view key, Vec2& target, const char* unit) {
  std::vector<double> values;
  in.read(key, values, Range{});
  if (values.empty()) return;
  if (values.size() != 2)
    in.fail(key, fmt::format("must be [x, y]{}{}", *unit ? " in " : "", unit));
  target = {values[0], values[1]};
}

void requireVector(Reader& in, std::string_view key, Vec2& target, const char* unit) {
  if (!in.has(key)) in.failMissing(key);
  readVector(in, key, target, unit);
}

/// One distance for both directions, or [between columns, between rows].
Vec2 readSpacing(Reader& in, const Vec2& otherwise) {
  std::vector<double> values;
  in.read("spacing", values, positive("diameters"));
  if (values.empty()) return otherwise;
  if (values.size() > 2) in.fail("spacing", "must be one number or [columns, rows] in diameters");
  return {values.front(), values.back()};
}

std::vector<Vec2> readGrid(Reader in) {
  int columns = 1, rows = 1;
  bool triangular = false;
  in.require("columns", columns, between(1, mostDisks));
  in.require("rows", rows, between(1, mostDisks));
  in.read("triangular", triangular);
  const double lines = triangular ? std::sqrt(0.75) : 1.0;
  Vec2 spacing = readSpacing(in, {1.0, 1.0});
  if (spacing.x() == spacing.y()) spacing.y() *= lines;
  in.finish();
  const double places = static_cast<double>(columns) * rows;
  if (places > mostDisks)
    in.fail("columns", fmt::format("times {} rows are {:.3g} disks: a case may have at most {}",
                                   rows, places, mostDisks));
  return gridPlaces(columns, rows, spacing, triangular);
}

/// @param key  of the number of disks in it
std::pair<int, double> readLine(Reader in, const char* key) {
  int count = 1;
  in.require(key, count, between(1, 1000));
  const double spacing = readSpacing(in, {1.0, 1.0}).x();
  in.finish();
  return {count, spacing};
}

void readPlaces(Reader& in, std::vector<Vec2>& places) {
  const char* given = nullptr;
  const auto choose = [&](const char* key) {
    if (!in.has(key)) {
      in.take(key);
      return false;
    }
    if (given) in.fail(key, fmt::format("and {}: give one of them", given));
    given = key;
    return true;
  };
  if (choose("grid")) places = readGrid(in.section("grid"));
  if (choose("stack")) {
    const auto [count, spacing] = readLine(in.section("stack"), "count");
    places = gridPlaces(1, count, {spacing, spacing}, false);
  }
  if (choose("chain")) {
    const auto [count, spacing] = readLine(in.section("chain"), "count");
    places = gridPlaces(count, 1, {spacing, spacing}, false);
  }
  if (choose("line")) {
    Reader line = in.section("line");
    int count = 1;
    Vec2 step = Vec2::UnitX();
    line.require("count", count, between(1, mostDisks));
    readVector(line, "step", step, "diameters");
    line.finish();
    if (!line.has("step")) line.failMissing("step", "[x, y] in diameters");
    places.clear();
    for (int k = 0; k < count; ++k) places.emplace_back(k * step);
  }
  if (choose("heap")) {
    const auto [base, spacing] = readLine(in.section("heap"), "base");
    places = heapPlaces(base, spacing);
  }
}

DiskGroup readDisks(Reader in) {
  DiskGroup group;
  requireVector(in, "position", group.position, "m");
  readPlaces(in, group.places);
  readVector(in, "velocity", group.velocity, "m/s");
  in.read("spin", group.spin, Range{});
  in.require("radius", group.radius, positive("m"));
  double density = 0.0;
  in.read("mass", group.mass, positive("kg"));
  in.read("density", density, positive("kg/m^2"));
  in.read("jitter", group.jitter, atLeast(0.0, "diameters"));
  in.read("radius_spread", group.radiusSpread, between(0.0, 0.9));
  in.read("velocity_rms", group.velocityRms, atLeast(0.0, "m/s"));
  in.finish();
  if (in.has("mass") && in.has("density")) in.fail("density", "and mass: give one of them");
  if (!in.has("mass") && !in.has("density")) in.failMissing("mass", "or density");
  if (in.has("density")) group.mass = massOf(in, density, group.radius, 1.0);
  return group;
}

/// The key of each kind of motion, which says which it is; none: fixed.
void readMotion(Reader& in, Motion& motion) {
  const char* given = nullptr;
  const auto choose = [&](const char* key, Motion::Kind kind) {
    if (!in.has(key)) return;
    if (given) in.fail(key, fmt::format("and {}: a wall moves in one way", given));
    given = key;
    motion.kind = kind;
  };
  choose("velocity", Motion::Kind::translating);
  choose("amplitude", Motion::Kind::oscillating);
  choose("omega", Motion::Kind::rotating);
  readVector(in, "velocity", motion.velocity, "m/s");
  readVector(in, "amplitude", motion.amplitude, "m");
  in.read("omega", motion.angularVelocity, Range{});
  in.read("frequency", motion.frequency, positive("rad/s"));
  if (in.has("frequency") != in.has("amplitude"))
    in.has("frequency") ? in.fail("frequency", "needs an amplitude")
                        : in.failMissing("frequency", "of the oscillation, in rad/s");
}

void addBox(Reader& in, std::vector<Plane>& planes) {
  std::vector<double> box;
  in.read("box", box, Range{});
  if (box.empty()) return;
  if (box.size() != 4 || !(box[2] > box[0]) || !(box[3] > box[1]))
    in.fail("box", "must be [left, bottom, right, top] in m");
  planes.push_back({{box[0], box[1]}, {1.0, 0.0}});
  planes.push_back({{box[0], box[1]}, {0.0, 1.0}});
  planes.push_back({{box[2], box[3]}, {-1.0, 0.0}});
  planes.push_back({{box[2], box[3]}, {0.0, -1.0}});
}

WallGroup readWalls(Reader in) {
  WallGroup group;
  addBox(in, group.planes);
  Plane plane;
  readVector(in, "point", plane.point, "m");
  readVector(in, "normal", plane.normal, "");
  DiskGroup disks;
  readVector(in, "position", disks.position, "m");
  readPlaces(in, disks.places);
  in.read("radius", group.radius, positive("m"));
  readVector(in, "centre", group.centre, "m");
  readMotion(in, group.motion);
  in.finish();
  if (in.has("point") != in.has("normal"))
    in.failMissing(in.has("point") ? "normal" : "point", "a plane has both");
  if (in.has("normal") && plane.normal.isZero(0.0)) in.fail("normal", "must not be zero");
  if (in.has("point")) group.planes.push_back({plane.point, plane.normal.normalized()});
  if (in.has("position") != in.has("radius"))
    in.failMissing(in.has("position") ? "radius" : "position", "wall disks have both");
  if (in.has("position"))
    for (const Vec2& at : disks.places)
      group.position.push_back(disks.position + 2.0 * group.radius * at);
  if (group.planes.empty() && group.position.empty())
    in.failMissing("point", "or box, or position: a wall of planes or disks");
  return group;
}

void readDuration(Reader& in, Assembly& assembly) {
  const std::pair<const char*, std::optional<double>*> ways[] = {
      {"duration", &assembly.duration},
      {"contact_times", &assembly.contactTimes},
      {"steps", &assembly.steps}};
  const char* given = nullptr;
  for (const auto& [key, target] : ways) {
    if (!in.has(key)) {
      in.take(key);
      continue;
    }
    if (given) in.fail(key, fmt::format("and {}: give one of them", given));
    given = key;
    in.read(key, target->emplace(), positive(target == &assembly.duration ? "s" : ""));
  }
  if (!given) in.failMissing("duration", "or contact_times, or steps");
}

}  // namespace

void readAssembly(Reader& in, Assembly& assembly) {
  std::size_t disksSoFar = 0;
  const auto count = [&](const char* key, std::size_t more) {
    disksSoFar += more;
    if (disksSoFar > static_cast<std::size_t>(mostDisks))
      in.fail(key, fmt::format("these are more than the {} disks that a case may have", mostDisks));
  };
  for (Reader& disks : in.sections("disks")) {
    assembly.disks.push_back(readDisks(std::move(disks)));
    count("disks", assembly.disks.back().places.size());
  }
  for (Reader& walls : in.sections("walls")) {
    assembly.walls.push_back(readWalls(std::move(walls)));
    count("walls", assembly.walls.back().position.size());
  }
  readVector(in, "gravity", assembly.gravity, "m/s^2");
  in.read("inertia_factor", assembly.inertiaFactor, aboveZeroTo(1.0));
  Reader start = in.section("start");
  if (in.has("start")) readStart(start, assembly);
  in.read("rotation", assembly.rotation);
  in.read("max_overlap", assembly.maxOverlap, between(0.0, 2.0));
  in.read("seed", assembly.seed, between(0, mostSeed));
  in.read("mirror", assembly.placement.mirror);
  double degrees = 0.0;
  in.read("rotate", degrees, Range{.unit = "degrees"});
  assembly.placement.turn = degrees * std::numbers::pi / 180.0;
  readVector(in, "offset", assembly.placement.offset, "m");
  readVector(in, "boost", assembly.placement.boost, "m/s");
  readDuration(in, assembly);
  in.finish();
  if (assembly.disks.empty() && !in.has("start"))
    in.failMissing("disks", "an assembly has [[assembly.disks]], or [assembly.start] with a file");
  if (!assembly.disks.empty() && in.has("start"))
    in.fail("start", "and [[assembly.disks]]: the disks come from one of the two");
  const bool moved = std::ranges::any_of(assembly.walls, [](const WallGroup& wall) {
    return wall.motion.kind != Motion::Kind::fixed && wall.motion.kind != Motion::Kind::translating;
  });
  if (moved && !assembly.placement.boost.isZero(0.0))
    in.fail("boost", "not where a wall rotates or oscillates");
}

void readPackings(Reader& in, Case& c) {
  in.read("packings", c.preparation.packings, between(1, 10'000));
  in.read("seed", c.assembly.seed, between(0, mostSeed));
  in.finish();
  c.preparation.seed = c.assembly.seed;
}

void readStability(Reader& in, Stability& stability) {
  std::vector<std::string> names;
  for (const StabilityMeasure& measure : stabilityMeasures()) names.emplace_back(measure.name);
  in.requireText("tests", stability.tests, "must say in a sentence what it tests");
  in.require("measure", stability.measure, names);
  in.require("limit", stability.limit, atLeast(0.0));
  in.require("degraded", stability.degraded, atLeast(0.0));
  in.requireText("why", stability.why, "must give the reason");
  in.read("samples", stability.samples, between(1, 100'000));
  in.read("settle", stability.settle, Range{.low = 0.0, .high = 1.0, .highOpen = true});
  in.read("quick", stability.quick);
  in.read("long", stability.longRun);
  in.finish();
  if (stability.degraded < stability.limit)
    in.fail("degraded", fmt::format("must be >= limit = {}", stability.limit));
}

}  // namespace crossgrain::inline cases
