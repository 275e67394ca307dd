#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "averaging/weights.hpp"
#include "cases/assembly_scene.hpp"
#include "cases/flow.hpp"
#include "cases/loader_sections.hpp"
#include "cases/time_step.hpp"

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
       .note = "Bins of `compare`, in a part of the plane or of space that does not move with "
               "walls. Each packing runs for `assembly.duration`."},
      {need("bins", &A::bins, Names(binKindNames.begin(), binKindNames.end()),
            "rings (about the origin, in space the z axis) have directions r and φ, all others x, "
            "y (and z)"),
       key("low", &A::lowCorner, anyNumber("m"), "lower left corner")
           .listed("required, not of rings"),
       key("high", &A::highCorner, anyNumber("m"), "upper right corner")
           .listed("required, not of rings"),
       key("along", &A::along, Names{"x", "y", "z"}, "axis").listed("required of slabs"),
       key("count", &A::count, bins, "").listed("required of slabs and rings"),
       key("columns", &A::columns, columns, "along x; bin 1 is lower left")
           .listed("required of a grid"),
       key("rows", &A::rows, columns, "along y").listed("required of a grid"),
       key("layers", &A::layers, columns, "along z"),
       key("bottom", &A::bottom, anyNumber("m"), "lowest z").listed("required of rings in space"),
       key("top", &A::top, anyNumber("m"), "highest z").listed("required of rings in space"),
       key("inner_radius", &A::innerRadius, atLeast(0.0, "m"), "").listed("required of rings"),
       key("outer_radius", &A::outerRadius, positive("m"), "").listed("required of rings"),
       key("height", &A::height, positive("m"), "h of the disks, not of spheres"),
       need("from", &A::from, atLeast(0.0, "s"), "averaged from then"),
       key("snapshots", &A::snapshots, between(1, 1'000'000),
           "evenly spread, a time step or more apart"),
       key("method", &A::methods, allWeightNames(),
           "in space slicing, centre or, for slabs, heaviside, lucy, gauss"),
       key("line_width", &A::lineWidth,
           Range{.low = 0.0, .high = 1000.0, .lowOpen = true, .unit = "d"},
           "w, in smallest diameters"),
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
                         .note = "Per bin, for colours. Endpoints decide verdicts."},
                        "FIELD", "a field of `profiles.csv`", "of the reference's mean", false),
          endpointsSection()};
}

void readAverage(Reader& in, Case& c) {
  c.region.emplace();
  const Reader margins = in.section("margins");
  readRegion(in, c);
  c.averaging.margins =
      readMargins(margins, judgedFields(fieldsIn(c.dimension, c.region->hasRings())));
  checkSwings(in, c);
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
