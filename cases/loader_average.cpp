#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "averaging/fields.hpp"
#include "averaging/weights.hpp"
#include "cases/assembly_scene.hpp"
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

/// "mean", "slope", … or the number of a bin, from 1.
void readReduction(Reader& in, const Region& region, bool isField, OwnEndpoint& endpoint) {
  const int bins =
      region.columnCount() * region.rowCount() * (region.hasRings() ? region.count : 1);
  int number = 0;
  std::string word = "mean";
  if (in.isNumber("at")) {
    in.read("at", number, between(1, bins));
    if (!isField) in.fail("at", "only a field has bins");
    endpoint.reduction = Reduction::bin;
    endpoint.bin = number - 1;
    return;
  }
  std::vector<std::string> words = {"mean"};
  const bool inLine = region.hasRings() || region.bins == BinKind::slabs;
  if (isField && inLine && bins > 2) words.emplace_back("slope");
  if (!isField) words.insert(words.end(), {"end", "rate"});
  in.read("at", word, words);
  if (word == "slope") endpoint.reduction = Reduction::slope;
  if (word == "end") endpoint.reduction = Reduction::end;
  if (word == "rate") endpoint.reduction = Reduction::rate;
}

/// With `per` each of the two is reduced, and then divided: "ratio of the means of a and b over …".
std::string definitionOf(const OwnEndpoint& endpoint, bool isField) {
  const bool ratio = !endpoint.per.empty();
  const std::string both = ratio ? endpoint.quantity + " and " + endpoint.per : endpoint.quantity;
  const auto of = [&](const char* one, const char* several) {
    return fmt::format("{} of {}", ratio ? fmt::format("ratio of the {}", several) : one, both);
  };
  const std::string value = ratio ? "ratio of " + both : both;
  switch (endpoint.reduction) {
    case Reduction::bin:
      return fmt::format("{} in bin {}", value, endpoint.bin + 1);
    case Reduction::slope:
      return of("slope", "slopes") + " over the bins";
    case Reduction::end:
      return value + " at the end";
    case Reduction::rate:
      return of("rate of change", "rates of change") + " over the averaged time";
    case Reduction::mean:
      break;
  }
  return of("mean", "means") + (isField ? " over the averaged part" : " over the averaged time");
}

std::string unitOf(const OwnEndpoint& endpoint, const Quantity& quantity) {
  if (!endpoint.per.empty()) return "-";
  const std::string unit = quantity.unit == "-" ? "1" : quantity.unit;
  if (endpoint.reduction == Reduction::slope) return unit == "m/s" ? "1/s" : unit + "/m";
  if (endpoint.reduction == Reduction::rate) return unit + "/s";
  return quantity.unit;
}

OwnEndpoint readEndpoint(Reader& in, const Region& region, Margin& margin) {
  OwnEndpoint endpoint;
  in.require("name", endpoint.name);
  in.require("quantity", endpoint.quantity);
  in.read("per", endpoint.per);
  in.take("at");
  const bool there = in.has("quantity");
  Quantity quantity;
  if (there) {
    quantity = quantityOf(in, "quantity", endpoint.quantity, region);
    readReduction(in, region, quantity.isField, endpoint);
  }
  margin = readOwnMargin(in, endpoint.name);
  if (!usableName(endpoint.name)) in.fail("name", usableNameRule);
  if (in.has("per")) {
    const Quantity below = quantityOf(in, "per", endpoint.per, region);
    if (below.isField != quantity.isField)
      in.fail("per", "must be a field where quantity is one, and a series where that is one");
    if (below.unit != quantity.unit)
      in.fail("per", fmt::format("is in {}, and {} in {}: their ratio would have a unit",
                                 below.unit, endpoint.quantity, quantity.unit));
  }
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

/// Packings that are all the same have no scatter to test with.
void checkVariety(const Reader& in, const Case& c) {
  const auto varies = [](const DiskGroup& group) {
    return group.jitter > 0.0 || group.radiusSpread > 0.0 || group.velocityRms > 0.0;
  };
  const bool files = !c.assembly.starts.files.empty();
  if (files || c.preparation.packings < 2 || std::ranges::any_of(c.assembly.disks, varies)) return;
  in.fail("bins",
          "no packing would differ from another: give assembly.disks a jitter, "
          "radius_spread or velocity_rms, or preparation.packings = 1");
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

void readAverage(Reader& in, std::vector<Reader> endpoints, Case& c) {
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
  checkVariety(in, c);
  for (Reader& each : endpoints) {
    Margin margin;
    OwnEndpoint endpoint = readEndpoint(each, region, margin);
    if (!c.averaging.endpoints.emplace(endpoint.name, std::move(margin)).second)
      each.fail("name", "two endpoints have this name");
    average.endpoints.push_back(std::move(endpoint));
  }
}

void checkAveragedTime(const Reader& in, const Case& c) {
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
}

}  // namespace crossgrain::inline cases
