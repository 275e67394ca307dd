#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "averaging/fields.hpp"
#include "averaging/weights.hpp"
#include "cases/assembly_scene.hpp"
#include "cases/flow.hpp"
#include "cases/loader_document.hpp"
#include "cases/loader_sections.hpp"
#include "cases/time_step.hpp"
#include "support/input_file.hpp"
#include "support/nearest.hpp"

namespace crossgrain::inline cases {
namespace {

std::span<const FieldSpec> fieldsOf(const Region& region) {
  return region.hasRings() ? fieldTable() : cartesianFieldTable();
}

/// Where a quantity comes from, and its unit.
struct Quantity {
  bool isField = false;
  std::string unit;
};

/// @throws BadInput with the nearest name
Quantity quantityOf(const Reader& in, std::string_view key, const std::string& name,
                    const Region& region) {
  std::vector<std::string> known;
  for (const FieldSpec& field : fieldsOf(region)) {
    if (field.name == name) return {true, field.unit == "1" ? "-" : std::string(field.unit)};
    known.emplace_back(field.name);
  }
  for (const RegionNumber& number : regionNumbers()) {
    if (number.name == name) return {false, std::string(number.unit)};
    known.emplace_back(number.name);
  }
  in.fail(key, "there is no such field or series of these bins" + suggestion(name, known));
}

/// Of one disk.
Quantity quantityOfDisk(const Reader& in, const std::string& name) {
  std::vector<std::string> known;
  for (const RegionNumber& number : diskNumbers()) {
    if (number.name == name) return {false, std::string(number.unit)};
    known.emplace_back(number.name);
  }
  in.fail("quantity",
          "of a disk is " + fmt::format("{}", fmt::join(known, ", ")) + suggestion(name, known));
}

/// Disks of each start.
std::size_t disksOf(const Assembly& assembly) {
  std::size_t count = assembly.starts.disks.empty() ? 0 : assembly.starts.disks.front().size();
  for (const DiskGroup& group : assembly.disks) count += group.places.size();
  return count;
}

/// `at` in words or as the number of a bin, from 1; or `time`, or `reaches`; `between` of a series.
void readReduction(Reader& in, const Region& region, bool isField, OwnEndpoint& endpoint) {
  const int bins =
      region.columnCount() * region.rowCount() * (region.hasRings() ? region.count : 1);
  std::vector<double> part;
  in.read("between", part, atLeast(0.0, "s"));
  in.read("time", endpoint.level, atLeast(0.0, "s"));
  in.read("reaches", endpoint.level, Range{});
  const char* given = nullptr;
  for (const char* const key : {"at", "time", "reaches"}) {
    if (!in.has(key)) continue;
    if (given) in.fail(key, fmt::format("and {}: give one of them", given));
    given = key;
  }
  for (const char* const key : {"time", "reaches", "between"})
    if (isField && in.has(key)) in.fail(key, "is of a run over time, not of a field");
  if (in.has("between")) {
    if (part.size() != 2 || !(part[0] < part[1])) in.fail("between", "must be [from, to] in s");
    if (in.has("time")) in.fail("between", "and time: a time needs none");
    endpoint.between = {part[0], part[1]};
  }
  if (in.has("time")) endpoint.reduction = Reduction::time;
  if (in.has("reaches")) endpoint.reduction = Reduction::reaches;
  int number = 0;
  std::string word = "mean";
  if (in.isNumber("at")) {
    in.read("at", number, between(1, bins));
    if (!isField) in.fail("at", "only a field has bins");
    endpoint.reduction = Reduction::bin;
    endpoint.bin = number - 1;
    return;
  }
  std::vector<std::pair<std::string, Reduction>> words = {{"mean", Reduction::mean}};
  const bool inLine = region.hasRings() || region.bins == BinKind::slabs;
  if (isField && inLine && bins > 2) words.emplace_back("slope", Reduction::slope);
  if (!isField)
    words.insert(words.end(), {{"end", Reduction::end},
                               {"rate", Reduction::rate},
                               {"maximum", Reduction::maximum},
                               {"minimum", Reduction::minimum}});
  std::vector<std::string> choices;
  for (const auto& [name, reduction] : words) choices.push_back(name);
  in.read("at", word, choices);
  if (in.has("at"))
    endpoint.reduction =
        std::ranges::find(words, word, [](const auto& w) { return w.first; })->second;
}

/// With `per` each of the two is reduced, and then divided: "ratio of the means of a and b over …".
std::string definitionOf(const OwnEndpoint& endpoint, bool isField) {
  const bool ratio = !endpoint.per.empty();
  const std::string own = endpoint.disk
                              ? fmt::format("{} of disk {}", endpoint.quantity, *endpoint.disk)
                              : endpoint.quantity;
  const std::string both = ratio ? own + " and " + endpoint.per : own;
  const auto of = [&](const char* one, const char* several) {
    return fmt::format("{} of {}", ratio ? fmt::format("ratio of the {}", several) : one, both);
  };
  const std::string value = ratio ? "ratio of " + both : both;
  const std::string when = isField ? "averaged part"
                           : endpoint.between
                               ? fmt::format("time from {:g} to {:g} s", endpoint.between->first,
                                             endpoint.between->second)
                               : "averaged time";
  switch (endpoint.reduction) {
    case Reduction::bin:
      return fmt::format("{} in bin {}", value, endpoint.bin + 1);
    case Reduction::slope:
      return of("slope", "slopes") + " over the bins";
    case Reduction::end:
      return value + (endpoint.between ? fmt::format(" at {:g} s", endpoint.between->second)
                                       : " at the end");
    case Reduction::rate:
      return of("rate of change", "rates of change") + " over the " + when;
    case Reduction::maximum:
      return of("maximum", "maxima") + " in the " + when;
    case Reduction::minimum:
      return of("minimum", "minima") + " in the " + when;
    case Reduction::time:
      return fmt::format("{} at {:g} s", value, endpoint.level);
    case Reduction::reaches:
      return fmt::format("when {} is first {:g}{}", value, endpoint.level,
                         endpoint.between ? " in the " + when : "");
    case Reduction::mean:
      break;
  }
  return of("mean", "means") + " over the " + when;
}

std::string unitOf(const OwnEndpoint& endpoint, const Quantity& quantity) {
  if (endpoint.reduction == Reduction::reaches) return "s";
  if (!endpoint.per.empty()) return "-";
  const std::string unit = quantity.unit == "-" ? "1" : quantity.unit;
  if (endpoint.reduction == Reduction::slope) return unit == "m/s" ? "1/s" : unit + "/m";
  if (endpoint.reduction == Reduction::rate) return unit + "/s";
  return quantity.unit;
}

/// A closed form's value makes the margin one in the unit.
void readExpected(Reader& in, OwnEndpoint& endpoint, Margin& margin) {
  if (!in.has("expected")) return;
  const double expected = *endpoint.expected;
  if (!margin.relative) return;
  if (expected == 0.0) in.fail("relative", "of an expected value of 0 is nothing: give absolute");
  margin.why = fmt::format("{:g} % of the expected value: {}", 100.0 * margin.value, margin.why);
  margin.value *= std::abs(expected);
  margin.relative = false;
}

OwnEndpoint readEndpoint(Reader& in, const Case& c, Margin& margin) {
  const Region& region = c.average->region;
  OwnEndpoint endpoint;
  in.require("name", endpoint.name);
  in.require("quantity", endpoint.quantity);
  in.read("per", endpoint.per);
  const double last = static_cast<double>(disksOf(c.assembly)) - 1.0;
  int disk = 0;
  in.read("disk", disk, between(0, last));
  if (in.has("disk")) endpoint.disk = disk;
  double expected = 0.0;
  in.read("expected", expected, Range{});
  if (in.has("expected")) endpoint.expected = expected;
  for (const char* const key : {"at", "time", "reaches", "between"}) in.take(key);
  const bool there = in.has("quantity");
  Quantity quantity;
  if (there) {
    quantity = endpoint.disk ? quantityOfDisk(in, endpoint.quantity)
                             : quantityOf(in, "quantity", endpoint.quantity, region);
    readReduction(in, region, quantity.isField, endpoint);
  }
  margin = readOwnMargin(in, endpoint.name);
  if (!usableName(endpoint.name)) in.fail("name", usableNameRule);
  if (in.has("per")) {
    if (endpoint.disk) in.fail("per", "is of the averaged part, and disk of one disk");
    if (endpoint.reduction == Reduction::reaches) in.fail("per", "not where reaches is");
    const Quantity below = quantityOf(in, "per", endpoint.per, region);
    if (below.isField != quantity.isField)
      in.fail("per", "must be a field where quantity is one, and a series where that is one");
    if (below.unit != quantity.unit)
      in.fail("per", fmt::format("is in {}, and {} in {}: their ratio would have a unit",
                                 below.unit, endpoint.quantity, quantity.unit));
  }
  readExpected(in, endpoint, margin);
  endpoint.words = endpoint.name;
  std::ranges::replace(endpoint.words, '_', ' ');
  endpoint.unit = unitOf(endpoint, quantity);
  endpoint.definition = definitionOf(endpoint, quantity.isField);
  endpoint.byRatio = margin.relative;
  margin.why = endpoint.definition + "; " + margin.why;
  return endpoint;
}

void readBox(Reader& in, Region& region) {
  for (const auto& [key, corner] : {std::pair{"low", &region.low}, {"high", &region.high}}) {
    std::vector<double> values;
    in.require(key, values, Range{});
    if (in.has(key) && values.size() != 2) in.fail(key, "must be [x, y] in m");
    if (in.has(key)) *corner = {values[0], values[1]};
  }
}

void readBins(Reader& in, Region& region) {
  const std::vector<std::string> kinds(binKindNames.begin(), binKindNames.end());
  std::string kind;
  in.require("bins", kind, kinds);
  if (const auto found = std::ranges::find(kinds, kind); found != kinds.end())
    region.bins = static_cast<BinKind>(found - kinds.begin());
  if (region.hasRings()) {
    in.require("inner_radius", region.innerRadius, atLeast(0.0, "m"));
    in.require("outer_radius", region.outerRadius, positive("m"));
    in.require("count", region.count, between(1, 10'000));
    return;
  }
  readBox(in, region);
  if (region.bins == BinKind::slabs) {
    std::string along;
    in.require("along", along, std::vector<std::string>{"x", "y"});
    region.axis = along == "x" ? 0 : 1;
    in.require("count", region.count, between(1, 10'000));
  }
  if (region.bins == BinKind::grid) {
    in.require("columns", region.columns, between(1, 1'000));
    in.require("rows", region.rows, between(1, 1'000));
  }
}

bool startsDiffer(const Assembly& assembly) {
  const auto varies = [](const DiskGroup& group) {
    return group.jitter > 0.0 || group.radiusSpread > 0.0 || group.velocityRms > 0.0;
  };
  const StartFiles& starts = assembly.starts;
  return starts.files.size() > 1 || starts.velocityRms > 0.0 ||
         std::ranges::any_of(assembly.disks, varies);
}

/// Packings that are all the same have no scatter to test with; a closed form is of one start.
void checkVariety(const Reader& in, const std::vector<Reader>& endpoints, const Reader& preparation,
                  const Case& c) {
  const std::vector<OwnEndpoint>& own = c.average->endpoints;
  const auto hasExpected = [](const OwnEndpoint& one) { return one.expected.has_value(); };
  const auto first = std::ranges::find_if(own, hasExpected);
  const bool differ = startsDiffer(c.assembly);
  if (first == own.end()) {
    if (differ || !c.assembly.starts.files.empty() || c.preparation.packings < 2) return;
    in.fail("bins",
            "no packing would differ from another: give assembly.disks a jitter, "
            "radius_spread or velocity_rms, or preparation.packings = 1");
  }
  const Reader& one = endpoints[static_cast<std::size_t>(first - own.begin())];
  if (differ)
    one.fail("expected",
             "is of one start, and here packings differ: several files, or a jitter, radius_spread "
             "or velocity_rms");
  if (preparation.has("packings") && c.preparation.packings > closedFormRuns)
    preparation.fail("packings",
                     "no packing would differ from another, and endpoints with an "
                     "expected value need one start: leave it out");
  if (const auto without = std::ranges::find_if_not(own, hasExpected); without != own.end())
    endpoints[static_cast<std::size_t>(without - own.begin())].failMissing(
        "expected",
        fmt::format("{} has one: in a scene of closed forms every endpoint does", first->name));
}

void checkSwings(const Reader& in, const Assembly& assembly) {
  std::set<double> frequencies;
  for (const WallGroup& wall : assembly.walls)
    if (wall.motion.kind == Motion::Kind::oscillating) frequencies.insert(wall.motion.frequency);
  if (frequencies.size() > 1)
    in.fail("bins",
            "walls that swing must all have one frequency, as lockstep begins a run anew "
            "only after whole periods");
}

}  // namespace

void readAverage(Reader& in, std::vector<Reader>& endpoints, const Reader& preparation, Case& c) {
  Average& average = c.average.emplace();
  Region& region = average.region;
  static const std::vector<std::string> methods(weightNames.begin(), weightNames.end());
  readBins(in, region);
  in.read("height", region.height, positive("m"));
  in.require("from", region.from, atLeast(0.0, "s"));
  in.read("snapshots", region.snapshots, between(1, 1'000'000));
  in.read("method", c.averaging.methods, methods);
  in.read("line_width", c.averaging.lineWidth, positive());
  in.read("confidence", c.averaging.confidence, inside(0.0, 1.0));
  c.averaging.margins = readBinMargins(in.section("margins"), fieldsOf(region));
  in.finish();
  if (c.averaging.methods.empty()) in.fail("method", "must not be empty");
  if (region.hasRings() && !(region.outerRadius > region.innerRadius))
    in.fail("outer_radius", fmt::format("must be > inner_radius = {} m", region.innerRadius));
  if (!region.hasRings() && !((region.high - region.low).minCoeff() > 0.0))
    in.fail("high", "must lie above and to the right of low");
  checkSwings(in, c.assembly);
  for (Reader& each : endpoints) {
    Margin margin;
    OwnEndpoint endpoint = readEndpoint(each, c, margin);
    if (!c.averaging.endpoints.emplace(endpoint.name, std::move(margin)).second)
      each.fail("name", "two endpoints have this name");
    average.endpoints.push_back(std::move(endpoint));
  }
  checkVariety(in, endpoints, preparation, c);
}

void checkAveragedTime(const Reader& in, const std::vector<Reader>& endpoints, const Case& c) {
  const double duration = assemblyDuration(c);
  if (!(c.average->region.from < duration))
    in.fail("from", fmt::format("must be < {:g} s, which the run takes", duration));
  const double interval = (duration - c.average->region.from) / c.average->region.snapshots;
  const double dt = timeStep(c);
  constexpr double rounding = 1e-9;  // a snapshot at every step is no mistake
  if (interval < dt * (1.0 - rounding))
    in.fail(in.has("snapshots") ? "snapshots" : "from",
            fmt::format("{} snapshots would be {:.3g} s apart, less than the time step of {:.3g} s",
                        c.average->region.snapshots, interval, dt));
  const double first = c.average->region.from + interval;
  const auto seen = [&](double t) {
    return t >= first * (1.0 - rounding) && t <= duration * (1.0 + rounding);
  };
  for (std::size_t k = 0; k < endpoints.size(); ++k) {
    const OwnEndpoint& own = c.average->endpoints[k];
    if (own.reduction == Reduction::time && !seen(own.level))
      endpoints[k].fail("time", fmt::format("snapshots are from {:g} to {:g} s", first, duration));
    if (own.between && (own.between->second < first || own.between->first > duration))
      endpoints[k].fail("between",
                        fmt::format("snapshots are from {:g} to {:g} s", first, duration));
  }
}

}  // namespace crossgrain::inline cases
