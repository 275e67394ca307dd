#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "averaging/global.hpp"
#include "averaging/weights.hpp"
#include "cases/assembly_scene.hpp"
#include "cases/flow.hpp"
#include "cases/loader_sections.hpp"
#include "cases/time_step.hpp"
#include "support/input_file.hpp"
#include "support/nearest.hpp"

namespace crossgrain::inline cases {
namespace {

/// The keys of [average].
struct AverageInput : Region, Averaging {
  std::string along;
  std::vector<double> lowCorner, highCorner;  ///< two numbers or three
  double bottom = 0.0, top = 0.0;             ///< z of rings in space
};

/// Of the plane, and then what is of space alone.
Names allWeightNames() {
  Names names(weightNames.begin(), weightNames.end());
  for (const std::string_view name : spaceWeightNames)
    if (std::ranges::find(names, name) == names.end()) names.emplace_back(name);
  return names;
}

const Section<AverageInput>& averageKeys() {
  using A = AverageInput;
  const Range bins = between(1, 10'000), columns = between(1, 1'000);
  static const Section<A> section(
      {.name = "average",
       .kinds = "assembly",
       .commands = "compare plan lockstep identify baseline effects cost average",
       .note =
           "What `compare` averages: bins in a part of the plane, or of space, that stays where "
           "it is while walls move. With it an assembly runs as long as it says, from each of "
           "`preparation.packings` packings."},
      {need(
           "bins", &A::bins, Names(binKindNames.begin(), binKindNames.end()),
           "fields of rings (about the origin, in space about the z axis) have directions r and φ, "
           "all others x and y (and z)"),
       key("low", &A::lowCorner, anyNumber("m"),
           "[x, y] of the lower left corner; in space [x, y, z]")
           .listed("required, not of rings"),
       key("high", &A::highCorner, anyNumber("m"), "of the upper right corner, likewise")
           .listed("required, not of rings"),
       key("along", &A::along, Names{"x", "y", "z"}, "the axis of slabs")
           .listed("required of slabs"),
       key("count", &A::count, bins, "number of slabs or rings")
           .listed("required of slabs and rings"),
       key("columns", &A::columns, columns, "along x; bin 1 is at the lower left corner")
           .listed("required of a grid"),
       key("rows", &A::rows, columns, "along y").listed("required of a grid"),
       key("layers", &A::layers, columns, "along z, of a grid or rings in space"),
       key("bottom", &A::bottom, anyNumber("m"), "lowest z of rings in space")
           .listed("required of rings in space"),
       key("top", &A::top, anyNumber("m"), "their highest").listed("required of rings in space"),
       key("inner_radius", &A::innerRadius, atLeast(0.0, "m"), "").listed("required of rings"),
       key("outer_radius", &A::outerRadius, positive("m"), "").listed("required of rings"),
       key("height", &A::height, positive("m"),
           "h of the disks, normal to the plane; spheres have none"),
       need("from", &A::from, atLeast(0.0, "s"), "what comes before is not averaged"),
       key("snapshots", &A::snapshots, between(1, 1'000'000),
           "evenly from there to the end, a time step or more apart"),
       key("method", &A::methods, allWeightNames(),
           "as in `[averaging]`; in space slicing, centre or, of slabs, the coarse-graining "
           "functions "
           "heaviside, lucy and gauss"),
       key("line_width", &A::lineWidth,
           Range{.low = 0.0, .high = 1000.0, .lowOpen = true, .unit = "d"},
           "as in `[averaging]`, of the smallest disks"),
       key("confidence", &A::confidence, inside(0.0, 1.0), "as in `[averaging]`")});
  return section;
}

/// Keys that only some kinds of bins have, and must have.
constexpr std::pair<const char*, std::string_view> keysOfBins[] = {
    {"low", "slabs grid whole"}, {"high", "slabs grid whole"},
    {"along", "slabs"},          {"count", "rings slabs"},
    {"columns", "grid"},         {"rows", "grid"},
    {"inner_radius", "rings"},   {"outer_radius", "rings"},
    {"bottom", "rings"},         {"top", "rings"}};

/// @throws BadInput for keys that the bins of the case's dimension lack, or have not
void checkKeysOfBins(const Reader& in, BinKind kind, int dimension) {
  const std::string_view bins = binKindNames[static_cast<std::size_t>(kind)];
  for (const char* const key : {"layers", "bottom", "top"})
    in.check(dimension == 3 || !in.has(key), key, "is of space, and case.dimension = 2");
  in.check(dimension == 2 || !in.has("height"), "height", "spheres have none: leave it out");
  in.check(!in.has("layers") || kind == BinKind::grid || kind == BinKind::rings, "layers",
           "has no meaning with bins = \"{}\"", bins);
  for (const auto& [key, kinds] : keysOfBins) {
    const bool needed = kinds.find(bins) != std::string_view::npos;
    const bool ofSpace = std::string_view(key) == "bottom" || std::string_view(key) == "top";
    if (needed && !in.has(key) && (dimension == 3 || !ofSpace)) in.failMissing(key);
    in.check(needed || !in.has(key), key, "has no meaning with bins = \"{}\"", bins);
  }
}

/// A region that reached out of the box would hold some places twice.
void checkRegionInBox(const Reader& in, const Case& c) {
  const Region& region = *c.region;
  withAssembly(c, [&]<int D>(const AssemblyOf<D>& assembly) {
    for (int k = 0; assembly.box && k < D; ++k) {
      const BoxOf<D>& box = *assembly.box;
      if (!box.periodic[static_cast<std::size_t>(k)]) continue;
      in.check(!region.hasRings() || k == 2, "bins",
               "rings are of scenes that are not periodic along x and y");
      in.check(region.low[k] >= box.low[k] && region.high[k] <= box.high[k],
               region.hasRings() ? "top" : "high",
               "the averaged part must lie in assembly.box along {}, from {:g} to {:g} m", "xyz"[k],
               box.low[k], box.high[k]);
    }
  });
}

/// Contacts are averaged in pieces as long as a bin is wide, a disk bin by bin: a bin that is much
/// thinner than a disk is a mistyped number, whose loops do not end.
void checkWidths(const Reader& in, const Case& c) {
  constexpr double thinnest = 1e-4;  // [smallest diameters]
  constexpr int mostBins = 1'000'000;
  const Region& region = *c.region;
  in.check(region.binCount() <= mostBins, "bins", "these are {} bins: at most {}",
           region.binCount(), mostBins);
  const double least = thinnest * flowDiameter(c);
  const auto check = [&](const char* key, double width, const char* along) {
    in.check(width >= least, key,
             "a bin would be {:.3g} m wide along {}: at least {:.3g} m, 10^-4 diameters of the "
             "smallest {}",
             width, along, least, c.dimension == 2 ? "disk" : "sphere");
  };
  if (region.hasRings()) {
    check("outer_radius", (region.outerRadius - region.innerRadius) / region.count, "r");
    if (c.dimension == 3) check("top", (region.high.z() - region.low.z()) / region.layers, "z");
    return;
  }
  const std::array counts = {region.columnCount(), region.rowCount(), region.layerCount()};
  constexpr std::array axes = {"x", "y", "z"};
  for (std::size_t k = 0; k < static_cast<std::size_t>(c.dimension); ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    const double width = region.high[axis] - region.low[axis];
    in.check(std::isfinite(width), "high", "is so far from low that no number holds it");
    check("high", width / counts[k], axes[k]);
  }
}

void readRegion(Reader& in, Case& c) {
  Region& region = *c.region;
  AverageInput input;
  averageKeys().read(in, input);
  region = input;
  const int dimension = c.dimension;
  checkKeysOfBins(in, region.bins, dimension);
  const auto corner = [&](const char* key, const std::vector<double>& values, Vec3& target) {
    if (!in.has(key)) return;
    in.check(values.size() == static_cast<std::size_t>(dimension), key, "must be {} in m",
             dimension == 2 ? "[x, y]" : "[x, y, z]");
    std::ranges::copy(values, target.data());
  };
  corner("low", input.lowCorner, region.low);
  corner("high", input.highCorner, region.high);
  if (region.bins == BinKind::slabs) region.axis = input.along[0] - 'x';
  in.check(region.axis < dimension, "along", "must be \"x\" or \"y\": case.dimension = 2");
  c.averaging.methods = input.methods;
  c.averaging.lineWidth = input.lineWidth;
  c.averaging.confidence = input.confidence;
  in.check(!input.methods.empty(), "method", "must not be empty");
  for (const std::string& method : input.methods) {
    const auto known = weightNamesIn(dimension);
    in.check(std::ranges::find(known, method) != known.end(), "method",
             "with case.dimension = {} methods are {}", dimension, fmt::join(known, ", "));
    in.check(region.bins == BinKind::slabs || !Weight(weightMethod(method), 1.0).isFunction(),
             "method", "{} is of slabs", method);
  }
  if (region.hasRings())
    in.check(region.outerRadius > region.innerRadius, "outer_radius",
             "must be > inner_radius = {} m", region.innerRadius);
  else
    in.check((region.high - region.low).head(dimension).minCoeff() > 0.0, "high",
             "must lie above and to the right of low{}", dimension == 2 ? "" : ", along z, too");
  if (dimension == 3 && region.hasRings()) {
    region.low.z() = input.bottom;
    region.high.z() = input.top;
    in.check(input.top > input.bottom, "top", "must be > bottom = {} m", input.bottom);
  }
  checkWidths(in, c);
  checkRegionInBox(in, c);
}

/// The keys of [[endpoints]].
struct EndpointInput : Endpoint, MarginInput {
  double time = 0.0, reaches = 0.0;
  std::vector<double> part;  ///< [from, to]
};

const Section<EndpointInput>& endpointsKeys() {
  using E = EndpointInput;
  static const Section<E> section(
      {.name = "endpoints",
       .kinds = "assembly",
       .commands = "compare plan effects cost average baseline",
       .note = "The numbers of a run that carry verdicts, with `[average]`. One with a relative "
               "margin is compared by its ratio to the reference, whose values need one sign; any "
               "other by the difference.",
       .isList = true},
      {need("name", &Endpoint::name, any, "as `case.name`; no two are alike"),
       need("quantity", &Endpoint::quantity, any,
            "a field of `profiles.csv`, or a quantity of `crossgrain list endpoints`"),
       key("disk", &Endpoint::disk, between(0, mostDisks),
           "of which `quantity` is `x`, `y`, `velocity_x`, `velocity_y` or `spin`; from 0"),
       key("wall", &Endpoint::wall, between(0, mostDisks),
           "of `[[assembly.walls]]`, from 0, of which `quantity` is `normal_force`, `force_x` …: "
           "of "
           "the disks on it"),
       key("plane", &Endpoint::plane, between(0, mostDisks),
           "of that wall, from 0; of a `box`: left, bottom, right, top, in space the planes at its "
           "lower corner across x, y and z, then those at its upper one"),
       key("area", &Endpoint::area, positive("m^2"),
           "the force on a wall is divided by it: a stress, in N/m²")
           .listed("–"),
       key("per", &Endpoint::per, any,
           "another quantity of the same kind and unit, that it is divided by"),
       special<E>(
           {"at", "–", "\"mean\"", "", "what is made of the quantity: see Endpoints of assemblies"},
           [](Reader& in, const std::string& key, E&) { in.take(key); }),
       key("time", &E::time, atLeast(0.0, "s"), "instead of `at`: the value at that time of a run")
           .listed("–"),
       key("reaches", &E::reaches, anyNumber(), "instead of `at`: when it first has this value")
           .listed("–", "the quantity's"),
       key("between", &E::part, atLeast(0.0, "s"),
           "[from, to]: the part of a run that `at` or `reaches` sees")
           .listed("all that is averaged"),
       key("expected", &Endpoint::expected, anyNumber(), "its value by a closed form")
           .listed("–", "the endpoint's"),
       key("relative", &MarginInput::relative, positive(),
           "of the reference's value, or of `expected`")
           .listed("one of the two"),
       key("absolute", &MarginInput::absolute, positive(), "")
           .listed("one of the two", "the endpoint's"),
       need("why", &MarginInput::why, Sentence{"must give the reason"}, "the reason")});
  return section;
}

std::span<const FieldSpec> fieldsOf(const Case& setup) {
  return fieldsIn(setup.dimension, setup.region->hasRings());
}

/// Where a quantity comes from, and its unit.
struct Quantity {
  bool isField = false;
  std::string unit;
};

/// @throws BadInput with the nearest name
Quantity quantityOf(const Reader& in, std::string_view key, const std::string& name,
                    const Case& setup) {
  std::vector<std::string> known;
  for (const FieldSpec& field : fieldsOf(setup)) {
    if (field.name == name) return {true, field.unit == "1" ? "-" : std::string(field.unit)};
    known.emplace_back(field.name);
  }
  for (const RegionNumber& number : regionNumbers(setup.dimension)) {
    if (number.name == name) return {false, std::string(number.unit)};
    known.emplace_back(number.name);
  }
  in.fail(key, "there is no such field or series of these bins{}", suggestion(name, known));
}

/// Of one disk.
Quantity quantityOfDisk(const Reader& in, const std::string& name, int dimension) {
  std::vector<std::string> known;
  for (const RegionNumber& number : diskNumbers(dimension)) {
    if (number.name == name) return {false, std::string(number.unit)};
    known.emplace_back(number.name);
  }
  in.fail("quantity", "of a disk is {}{}", fmt::join(known, ", "), suggestion(name, known));
}

/// Of one wall. A force against the normal is that of one plane which keeps its direction.
Quantity quantityOfWall(const Reader& in, const Endpoint& endpoint, const Case& setup) {
  std::vector<std::string> known;
  for (const RegionNumber& number : wallNumbers(setup.dimension)) known.emplace_back(number.name);
  if (std::ranges::find(known, endpoint.quantity) == known.end())
    in.fail("quantity", "of a wall is {}{}", fmt::join(known, ", "),
            suggestion(endpoint.quantity, known));
  withAssembly(setup, [&](const auto& assembly) {
    const auto& walls = assembly.walls;
    in.check(static_cast<std::size_t>(*endpoint.wall) < walls.size(), "wall",
             "there are {} walls, counted from 0", walls.size());
    const auto& wall = walls[static_cast<std::size_t>(*endpoint.wall)];
    if (endpoint.plane)
      in.check(static_cast<std::size_t>(*endpoint.plane) < wall.planes.size(), "plane",
               "assembly.walls[{}] has {} planes, counted from 0", *endpoint.wall,
               wall.planes.size());
    if (endpoint.quantity != normalForce) return;
    const bool sole = wall.planes.size() == 1 && wall.position.empty() && wall.cylinders.empty();
    if (!sole && !endpoint.plane)
      in.failMissing("plane", "normal_force is of one plane, and this wall is more, or has none");
    in.check(wall.motion.kind != MotionKind::rotating, "quantity",
             "the planes of a wall that turns keep no direction: take force_x …");
  });
  return {false, in.has("area") ? "N/m²" : "N"};
}

/// Stresses of two walls are of the scenes that have them, and nothing of any other.
void checkTwoWalls(const Reader& in, std::string_view key, const std::string& quantity,
                   const Case& setup) {
  if (quantity != "wall_normal_stress" && quantity != "wall_shear_stress") return;
  const bool between = inDimensionOf(
      setup, [&]<int D>() { return hasTwoWalls(assemblyScene<D>(setup, DisksOf<D>{}, 0.0, 1.0)); });
  in.check(between, key,
           "is of a box that is periodic in all directions but one, between two walls across it; "
           "the force on one wall is quantity = \"normal_force\", with wall = 0 …");
}

/// Disks of each start.
std::size_t disksOf(const Case& setup) {
  return withAssembly(setup, [](const auto& assembly) {
    std::size_t count = assembly.starts.disks.empty() ? 0 : assembly.starts.disks.front().size();
    for (const auto& group : assembly.disks) count += group.count();
    return count;
  });
}

/// `at` in words or as the number of a bin, from 1; or `time`, or `reaches`; `between` of a series.
void setReduction(Reader& in, const EndpointInput& input, const Region& region, bool isField,
                  Endpoint& endpoint) {
  const int bins = region.binCount();
  const std::string given = in.onlyOne({"at", "time", "reaches"});
  for (const char* const key : {"time", "reaches", "between"})
    if (isField && in.has(key)) in.fail(key, "is of a run over time, not of a field");
  if (in.has("between")) {
    const std::vector<double>& part = input.part;
    in.check(part.size() == 2 && part[0] < part[1], "between", "must be [from, to] in s");
    in.check(given != "time", "between", "and time: a time needs none");
    endpoint.between = {part[0], part[1]};
  }
  if (given == "time" || given == "reaches") {
    endpoint.reduction = given == "time" ? Reduction::time : Reduction::reaches;
    endpoint.level = given == "time" ? input.time : input.reaches;
    return;
  }
  if (in.isNumber("at")) {
    int number = 0;
    in.read("at", number, between(1, bins));
    in.check(isField, "at", "only a field has bins");
    endpoint.reduction = Reduction::bin;
    endpoint.bin = number - 1;
    return;
  }
  const bool inLine = (region.hasRings() && region.layers == 1) || region.bins == BinKind::slabs;
  std::vector<std::pair<std::string, Reduction>> words = {{"mean", Reduction::mean}};
  if (isField && inLine && bins > 2) words.emplace_back("slope", Reduction::slope);
  if (!isField)
    words.insert(words.end(), {{"end", Reduction::end},
                               {"rate", Reduction::rate},
                               {"maximum", Reduction::maximum},
                               {"minimum", Reduction::minimum}});
  Names choices;
  for (const auto& [name, reduction] : words) choices.push_back(name);
  std::string word = "mean";
  in.read("at", word, choices);
  for (const auto& [name, reduction] : words)
    if (name == word) endpoint.reduction = reduction;
}

/// With `per` each of the two is reduced, and then divided: "ratio of the means of a and b over …".
std::string definitionOf(const Endpoint& endpoint, bool isField) {
  const bool ratio = !endpoint.per.empty();
  std::string what = endpoint.quantity;
  if (endpoint.disk) what += fmt::format(" of disk {}", *endpoint.disk);
  if (endpoint.wall) what += fmt::format(" of wall {}", *endpoint.wall);
  if (endpoint.plane) what += fmt::format(", plane {}", *endpoint.plane);
  if (ratio) what += " and " + endpoint.per;
  const std::string value = ratio ? "ratio of " + what : what;
  std::string when = isField ? "averaged part" : "averaged time";
  if (endpoint.between)
    when =
        fmt::format("time from {:g} to {:g} s", endpoint.between->first, endpoint.between->second);
  const auto reduced = [&](const char* one, const char* several, const std::string& where) {
    return ratio ? fmt::format("ratio of the {} of {} {}", several, what, where)
                 : fmt::format("{} of {} {}", one, what, where);
  };
  switch (endpoint.reduction) {
    case Reduction::bin:
      return fmt::format("{} in bin {}", value, endpoint.bin + 1);
    case Reduction::end:
      return endpoint.between ? fmt::format("{} at {:g} s", value, endpoint.between->second)
                              : value + " at the end";
    case Reduction::time:
      return fmt::format("{} at {:g} s", value, endpoint.level);
    case Reduction::reaches:
      return fmt::format("when {} is first {:g}{}", value, endpoint.level,
                         endpoint.between ? " in the " + when : "");
    case Reduction::slope:
      return reduced("slope", "slopes", "over the bins");
    case Reduction::rate:
      return reduced("rate of change", "rates of change", "over the " + when);
    case Reduction::maximum:
      return reduced("maximum", "maxima", "in the " + when);
    case Reduction::minimum:
      return reduced("minimum", "minima", "in the " + when);
    case Reduction::mean:
      break;
  }
  return reduced("mean", "means", "over the " + when);
}

std::string unitOf(const Endpoint& endpoint, const Quantity& quantity) {
  if (endpoint.reduction == Reduction::reaches) return "s";
  if (!endpoint.per.empty()) return "-";
  const std::string unit = quantity.unit == "-" ? "1" : quantity.unit;
  if (endpoint.reduction == Reduction::slope) return unit == "m/s" ? "1/s" : unit + "/m";
  if (endpoint.reduction == Reduction::rate) return unit + "/s";
  return quantity.unit;
}

Endpoint readEndpoint(Reader& in, const Case& c, Margin& margin) {
  const Region& region = *c.region;
  EndpointInput input;
  endpointsKeys().read(in, input);
  Endpoint endpoint = input;
  if (endpoint.disk) {
    const auto last = static_cast<int>(disksOf(c)) - 1;
    in.check(*endpoint.disk <= last, "disk", "must be in [0, {}]", last);
  }
  in.onlyOne({"disk", "wall"});
  for (const char* const ofWall : {"plane", "area"})
    in.check(endpoint.wall || !in.has(ofWall), ofWall, "is of one wall: give wall, too");
  const Quantity quantity = endpoint.disk   ? quantityOfDisk(in, endpoint.quantity, c.dimension)
                            : endpoint.wall ? quantityOfWall(in, endpoint, c)
                                            : quantityOf(in, "quantity", endpoint.quantity, c);
  checkTwoWalls(in, "quantity", endpoint.quantity, c);
  checkTwoWalls(in, "per", endpoint.per, c);
  setReduction(in, input, region, quantity.isField, endpoint);
  margin = marginOf(in, input, {endpoint.name, ""}, nullptr);
  in.check(usableName(endpoint.name), "name", "{}", usableNameRule);
  if (in.has("per")) {
    in.check(!endpoint.disk && !endpoint.wall, "per",
             "is of the averaged part, and {} of one of them", endpoint.disk ? "disk" : "wall");
    in.check(endpoint.reduction != Reduction::reaches, "per", "not where reaches is");
    const Quantity below = quantityOf(in, "per", endpoint.per, c);
    in.check(below.isField == quantity.isField, "per",
             "must be a field where quantity is one, and a series where that is one");
    in.check(below.unit == quantity.unit, "per",
             "is in {}, and {} in {}: their ratio would have a unit", below.unit, endpoint.quantity,
             quantity.unit);
  }
  if (endpoint.expected && margin.relative) {  // a closed form makes the margin one in the unit
    in.check(*endpoint.expected != 0.0, "relative",
             "of an expected value of 0 is nothing: give absolute");
    margin.why = fmt::format("{:g} % of the expected value: {}", 100.0 * margin.value, margin.why);
    margin.value *= std::abs(*endpoint.expected);
    margin.relative = false;
  }
  endpoint.words = endpoint.name;
  std::ranges::replace(endpoint.words, '_', ' ');
  endpoint.unit = unitOf(endpoint, quantity);
  endpoint.definition = definitionOf(endpoint, quantity.isField);
  endpoint.byRatio = margin.relative;
  margin.why = endpoint.definition + "; " + margin.why;
  return endpoint;
}

bool startsDiffer(const Case& setup) {
  const auto varies = [](const auto& group) {
    return group.jitter > 0.0 || group.radiusSpread > 0.0 || group.velocityRms > 0.0 ||
           group.count() < group.places.size();
  };
  return withAssembly(setup, [&](const auto& assembly) {
    const auto& starts = assembly.starts;
    return starts.files.size() > 1 || starts.velocityRms > 0.0 ||
           std::ranges::any_of(assembly.disks, varies);
  });
}

void checkSwings(const Reader& in, const Case& setup) {
  std::set<double> frequencies;
  withAssembly(setup, [&](const auto& assembly) {
    for (const auto& wall : assembly.walls)
      if (wall.motion.kind == MotionKind::oscillating) frequencies.insert(wall.motion.frequency);
  });
  in.check(frequencies.size() < 2, "bins",
           "walls that swing must all have one frequency, as lockstep begins a run anew only after "
           "whole periods");
}

}  // namespace

std::vector<SectionInfo> averageSections() {
  return {averageKeys().info(),
          marginSection({.name = "average.margins",
                         .kinds = "assembly",
                         .note = "How far apart two engines may be in a bin, for its colour; the "
                                 "verdicts are the endpoints'."},
                        "FIELD", "a field of `profiles.csv`", "of the reference's mean", false),
          endpointsKeys().info()};
}

void readAverage(Reader& in, std::vector<Reader>& each, Case& c) {
  c.region.emplace();
  const Reader margins = in.section("margins");
  readRegion(in, c);
  c.averaging.margins = readMargins(margins, judgedFields(fieldsOf(c)));
  checkSwings(in, c);
  for (Reader& one : each) {
    Margin margin;
    Endpoint endpoint = readEndpoint(one, c, margin);
    one.check(c.averaging.endpoints.emplace(endpoint.name, std::move(margin)).second, "name",
              "two endpoints have this name");
    c.endpoints.push_back(std::move(endpoint));
  }
}

void checkVariety(const Reader& in, const std::vector<Reader>& endpoints, const Reader& preparation,
                  Starts starts, const Case& c) {
  const std::vector<Endpoint>& own = c.endpoints;
  const auto hasExpected = [](const Endpoint& one) { return one.expected.has_value(); };
  const auto first = std::ranges::find_if(own, hasExpected);
  const bool differ = startsDiffer(c);
  if (first == own.end()) {
    if (differ || starts == Starts::notMade) return;
    if (packingsAreFiles(c) || c.preparation.packings < 2) return;
    in.fail("bins",
            "no packing would differ from another: give assembly.disks a jitter, "
            "radius_spread, velocity_rms or choose, or preparation.packings = 1");
  }
  const Reader& one = endpoints[static_cast<std::size_t>(first - own.begin())];
  one.check(!differ, "expected",
            "is of one start, and here packings differ: several files, or a jitter, radius_spread "
            "or velocity_rms");
  if (preparation.has("packings"))
    preparation.check(c.preparation.packings <= closedFormRuns, "packings",
                      "no packing would differ from another, and endpoints with an expected value "
                      "need one start: leave it out");
  if (const auto without = std::ranges::find_if_not(own, hasExpected); without != own.end())
    endpoints[static_cast<std::size_t>(without - own.begin())].failMissing(
        "expected",
        fmt::format("{} has one: in a scene of closed forms every endpoint does", first->name));
}

void checkAveragedTime(const Reader& in, const std::vector<Reader>& endpoints, const Case& c) {
  const Region& region = *c.region;
  const double duration = assemblyDuration(c), dt = timeStep(c);
  in.check(region.from < duration, "from", "must be < {:g} s, which the run takes", duration);
  const double interval = (duration - region.from) / region.snapshots;
  constexpr double rounding = 1e-9;  // a snapshot at every step is no mistake
  in.check(interval >= dt * (1.0 - rounding), in.has("snapshots") ? "snapshots" : "from",
           "{} snapshots would be {:.3g} s apart, less than the time step of {:.3g} s",
           region.snapshots, interval, dt);
  const double first = region.from + interval;
  for (std::size_t k = 0; k < endpoints.size(); ++k) {
    const Endpoint& own = c.endpoints[k];
    const auto seen = [&](double from, double to, const char* key) {
      endpoints[k].check(to >= first * (1.0 - rounding) && from <= duration * (1.0 + rounding), key,
                         "snapshots are from {:g} to {:g} s", first, duration);
    };
    if (own.reduction == Reduction::time) seen(own.level, own.level, "time");
    if (own.between) seen(own.between->first, own.between->second, "between");
  }
}

}  // namespace crossgrain::inline cases
