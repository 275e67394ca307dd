#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "averaging/global.hpp"
#include "cases/assembly_scene.hpp"
#include "cases/endpoints.hpp"
#include "cases/flow.hpp"
#include "cases/loader_sections.hpp"
#include "support/input_file.hpp"
#include "support/nearest.hpp"

namespace crossgrain::inline cases {
namespace {

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
       .note = "Numbers that decide verdicts, with `[average]`. A relative margin compares by the "
               "ratio to the reference, whose values need one sign; others by the difference.",
       .isList = true},
      {need("name", &Endpoint::name, any, "unique, as `case.name`"),
       need("quantity", &Endpoint::quantity, any,
            "a field of `profiles.csv`, or a quantity of `crossgrain list endpoints`"),
       key("disk", &Endpoint::disk, between(0, mostDisks),
           "from 0, for `x` …, `velocity_x` …, `spin` (in space `spin_x` …), of a convex body "
           "`angle` and, in space, `own_spin_x` …"),
       key("wall", &Endpoint::wall, between(0, mostDisks),
           "of `[[assembly.walls]]`, from 0, for `normal_force`, `force_x` …"),
       key("plane", &Endpoint::plane, between(0, mostDisks),
           "of that wall, from 0; of a `box`: left, bottom, right, top; in space across x, y, z at "
           "the lower corner, then the upper"),
       key("area", &Endpoint::area, positive("m^2"), "makes a stress of a wall's force")
           .listed("–"),
       key("per", &Endpoint::per, any, "divisor: a quantity of the same kind and unit"),
       special<E>({"at", "–", "\"mean\"", "", "reduction (Endpoints of assemblies)"},
                  [](Reader& in, const std::string& key, E&) { in.take(key); }),
       key("time", &E::time, atLeast(0.0, "s"), "instead of `at`: the value then").listed("–"),
       key("reaches", &E::reaches, anyNumber(), "instead of `at`: when it first has this value")
           .listed("–", "the quantity's"),
       key("between", &E::part, atLeast(0.0, "s"), "[from, to], for `at` or `reaches`")
           .listed("all that is averaged"),
       key("expected", &Endpoint::expected, anyNumber(), "by a closed form")
           .listed("–", "the endpoint's"),
       key("relative", &MarginInput::relative, positive(),
           "of the reference's value, or of `expected`")
           .listed("one of the two"),
       key("absolute", &MarginInput::absolute, positive(), "")
           .listed("one of the two", "the endpoint's"),
       need("why", &MarginInput::why, Sentence{"must give the reason"}, "")});
  return section;
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
  for (const FieldSpec& field : fieldsIn(setup.dimension, setup.region->hasRings())) {
    if (field.name == name) return {true, field.unit == "1" ? "-" : std::string(field.unit)};
    known.emplace_back(field.name);
  }
  for (const RegionNumber& number : regionNumbers(setup.dimension)) {
    if (number.name == name) return {false, std::string(number.unit)};
    known.emplace_back(number.name);
  }
  in.fail(key, "there is no such field or series of these bins{}", suggestion(name, known));
}

/// Of one disk or one wall.
Quantity quantityOfOne(const Reader& in, const char* one, const std::string& name,
                       std::span<const RegionNumber> numbers) {
  std::vector<std::string> known;
  for (const RegionNumber& number : numbers) {
    if (number.name == name) return {false, std::string(number.unit)};
    known.emplace_back(number.name);
  }
  in.fail("quantity", "of a {} is {}{}", one, fmt::join(known, ", "), suggestion(name, known));
}

/// Of one wall. A force against the normal is that of one plane which keeps its direction.
Quantity quantityOfWall(const Reader& in, const Endpoint& endpoint, const Case& setup) {
  Quantity quantity = quantityOfOne(in, "wall", endpoint.quantity, wallNumbers(setup.dimension));
  if (in.has("area")) quantity.unit = "N/m²";
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
  return quantity;
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
std::string definitionOf(const Endpoint& endpoint, bool isField, const char* disk) {
  const bool ratio = !endpoint.per.empty();
  std::string what = endpoint.quantity;
  if (endpoint.disk) what += fmt::format(" of {} {}", disk, *endpoint.disk);
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
  const auto disks =
      static_cast<int>(withAssembly(c, [](const auto& assembly) { return assembly.diskCount(); }));
  in.check(!endpoint.disk || *endpoint.disk < disks, "disk", "must be in [0, {}]", disks - 1);
  in.onlyOne({"disk", "wall"});
  for (const char* const ofWall : {"plane", "area"})
    in.check(endpoint.wall || !in.has(ofWall), ofWall, "is of one wall: give wall, too");
  const Quantity quantity =
      endpoint.disk   ? quantityOfOne(in, "disk", endpoint.quantity, diskNumbers(c.dimension))
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
  endpoint.definition = definitionOf(endpoint, quantity.isField, anyConvex(c) ? "body" : "disk");
  endpoint.byRatio = margin.relative;
  margin.why = endpoint.definition + "; " + margin.why;
  return endpoint;
}

bool startsDiffer(const Case& setup) {
  const auto varies = [](const auto& group) {
    return group.jitter > 0.0 || group.randomTurn || group.radiusSpread > 0.0 ||
           group.velocityRms > 0.0 || group.count() < group.places.size();
  };
  return withAssembly(setup, [&](const auto& assembly) {
    const auto& starts = assembly.starts;
    return starts.files.size() > 1 || starts.velocityRms > 0.0 ||
           std::ranges::any_of(assembly.disks, varies);
  });
}

}  // namespace

SectionInfo endpointsSection() {
  return endpointsKeys().info();
}

void readEndpoints(std::vector<Reader>& endpoints, const Reader& average, const Reader& preparation,
                   Starts starts, Case& c) {
  for (Reader& one : endpoints) {
    Margin margin;
    Endpoint endpoint = readEndpoint(one, c, margin);
    one.check(c.averaging.endpoints.emplace(endpoint.name, std::move(margin)).second, "name",
              "two endpoints have this name");
    c.endpoints.push_back(std::move(endpoint));
  }
  const std::vector<Endpoint>& own = c.endpoints;
  const auto hasExpected = [](const Endpoint& one) { return one.expected.has_value(); };
  const auto first = std::ranges::find_if(own, hasExpected);
  const bool differ = startsDiffer(c);
  if (first == own.end()) {
    if (differ || starts == Starts::notMade) return;
    if (packingsAreFiles(c) || c.preparation.packings < 2) return;
    average.fail("bins",
                 "no packing would differ from another: give assembly.disks a jitter, "
                 "radius_spread, velocity_rms, random_turn or choose, or preparation.packings = 1");
  }
  const Reader& one = endpoints[static_cast<std::size_t>(first - own.begin())];
  one.check(!differ, "expected",
            "is of one start, and here packings differ: several files, or a jitter, radius_spread, "
            "random_turn or velocity_rms");
  if (preparation.has("packings"))
    preparation.check(c.preparation.packings <= closedFormRuns, "packings",
                      "no packing would differ from another, and endpoints with an expected value "
                      "need one start: leave it out");
  if (const auto without = std::ranges::find_if_not(own, hasExpected); without != own.end())
    endpoints[static_cast<std::size_t>(without - own.begin())].failMissing(
        "expected",
        fmt::format("{} has one: in a scene of closed forms every endpoint does", first->name));
}

}  // namespace crossgrain::inline cases
