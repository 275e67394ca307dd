#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "averaging/profiles.hpp"
#include "cases/flow.hpp"
#include "results/schema.hpp"
#include "studies/core/executor.hpp"
#include "studies/flow/average.hpp"
#include "studies/flow/averages.hpp"
#include "studies/flow/file_runs.hpp"
#include "studies/flow/frame.hpp"
#include "studies/flow/run.hpp"
#include "support/bad_input.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline studies {

namespace {

/// Where bins lie, as parts of the averaged length. Rings: r = 0.12, 0.13, 0.14 and 0.20 m in the
/// thesis' cell (Lätzel 2003, Fig. 5.6); others: quarters.
const std::vector<double> ringPlaces = {0.0168 / 0.1492, 0.0268 / 0.1492, 0.0368 / 0.1492,
                                        0.0968 / 0.1492};
const std::vector<double> otherPlaces = {0.25, 0.5, 0.75};

/// Slabs in which coarse-graining functions are taken: narrow against any that is [d].
constexpr double functionSlab = 0.1;

/// Widths in units of d, closest where methods are expected to meet.
std::vector<double> widths() {
  std::vector<double> result = {0.1,  0.12, 0.15, 0.18, 0.22, 0.26,
                                0.31, 0.37, 0.45, 0.54, 0.65, 0.75};
  for (int k = 16; k <= 50; ++k) result.push_back(k / 20.0);
  for (int k = 14; k <= 20; ++k) result.push_back(k / 5.0);
  for (const double wide : {5.0, 6.0, 8.0, 10.0, 12.0, 15.0, 20.0}) result.push_back(wide);
  return result;
}

/// Directions that a bin's width is measured along: slabs have one, boxes all. @pre no rings
std::vector<int> directionsOf(const Region& region, int dimension) {
  if (region.bins == BinKind::slabs) return {region.axis};
  return dimension == 2 ? std::vector{0, 1} : std::vector{0, 1, 2};
}

template <int D>
struct PlacedBin {
  std::shared_ptr<const typename ProfileAccumulatorOf<D>::Coordinates> bins;
  std::size_t index = 0;  ///< of the bin among them
};

/// The bin of that width about a place: a ring; a slab; or a square or cube on the middle line
/// upwards. Absent where it does not fit. A ring in the plane has its two neighbours, for
/// gradients, and what is left of the cell, for the walls' stress to be where it belongs.
template <int D>
std::optional<PlacedBin<D>> binAbout(const Case& setup, const Region& region, double at,
                                     double width, const std::optional<BoxOf<D>>& box) {
  Region bin = region;
  bin.count = bin.columns = bin.rows = bin.layers = 1;
  const auto put = [&](double& low, double& high, double centre) {
    const double from = centre - 0.5 * width, to = centre + 0.5 * width;
    const bool fits = from >= low && to <= high;
    low = from;
    high = to;
    return fits;
  };
  if (region.hasRings()) {
    if (!put(bin.innerRadius, bin.outerRadius, at)) return std::nullopt;
    if constexpr (D == 2) {
      std::vector<double> edges = {region.innerRadius};
      for (const double edge : {-1.5, -0.5, 0.5, 1.5})
        if (const double r = at + edge * width; r > edges.back() && r < region.outerRadius)
          edges.push_back(r);
      edges.push_back(region.outerRadius);
      const Rings rings(std::move(edges), region.height, flowDiameter(setup));
      return PlacedBin<D>{std::make_shared<Rings>(rings),
                          static_cast<std::size_t>(rings.binOf(at))};
    }
  } else {
    const std::vector<int> along = directionsOf(region, D);
    for (const int k : along)
      if (!put(bin.low[k], bin.high[k],
               k == along.back() ? at : 0.5 * (region.low[k] + region.high[k])))
        return std::nullopt;
  }
  Case one = setup;
  one.region = bin;
  return PlacedBin<D>{coordinatesOf<D>(one, box)};
}

/// Fields by name, weight and place.
using Curves = std::map<std::tuple<std::string, std::string, double>, RevCurve>;

/// One average of the snapshots: weights that share a bin.
template <int D>
struct WidthAverage {
  double at;          ///< [m]
  std::size_t index;  ///< of the bin
  ProfileAccumulatorOf<D> accumulator;
};

/// All bins of one width that fit. A coarse-graining function of slabs reaches over the width, in a
/// narrow slab: c of heaviside and lucy is half of it, w of gauss a sixth (averaging/kernels.hpp).
template <int D>
std::vector<WidthAverage<D>> averagesOf(const Case& setup, const SceneOf<D>& scene, double width) {
  const Region& region = *setup.region;
  const double d = flowDiameter(setup);
  std::vector<Weight> plain, functions;
  for (const std::string_view name : weightNamesIn(D)) {
    Weight weight = weightsOf(setup, std::vector{std::string(name)}).front();
    if (!weight.isFunction()) {
      plain.push_back(weight);
    } else if (region.bins == BinKind::slabs) {
      weight.width = width * d / (weight.method == WeightMethod::gauss ? 6.0 : 2.0);
      functions.push_back(weight);
    }
  }
  const int along = region.hasRings() ? 0 : directionsOf(region, D).back();
  const double low = region.hasRings() ? region.innerRadius : region.low[along];
  const double high = region.hasRings() ? region.outerRadius : region.high[along];
  std::vector<WidthAverage<D>> averages;
  for (const double place : region.hasRings() ? ringPlaces : otherPlaces) {
    const double at = low + place * (high - low);
    const auto bin = binAbout<D>(setup, region, at, width * d, scene.box);
    if (!bin) continue;
    averages.push_back({at, bin->index, {bin->bins, plain, scene}});
    if (functions.empty()) continue;
    const auto slab = binAbout<D>(setup, region, at, functionSlab * d, scene.box);
    averages.push_back({at, slab->index, {slab->bins, functions, scene}});
  }
  return averages;
}

template <int D>
void addWidth(const Case& setup, const SnapshotRun& files, const std::string& name, double width,
              Curves& curves) {
  const auto source = openSnapshots<D>(files, setup, name);
  std::vector<WidthAverage<D>> averages = averagesOf<D>(setup, source->scene(), width);
  if (averages.empty()) return;
  while (const auto snapshot = source->next()) {
    throwIfInterrupted();
    for (WidthAverage<D>& one : averages) {
      if (source->disksChanged()) one.accumulator.changeDisks(source->scene());
      one.accumulator.add(*snapshot);
    }
  }
  for (const WidthAverage<D>& one : averages)
    for (const Profile& profile : one.accumulator.profiles()) {
      RevCurve& curve = curves[{profile.method, profile.field, one.at}];
      curve.method = profile.method;
      curve.field = profile.field;
      curve.unit = profile.unit;
      curve.r = one.at;
      curve.width.push_back(width);
      curve.mean.push_back(profile.mean[one.index]);
      curve.standardError.push_back(profile.standardError[one.index]);
    }
}

/// Where each weight comes closest to slicing, next to d and 2 d.
std::vector<RevMeeting> meetingsOf(const std::vector<RevCurve>& curves, int dimension,
                                   std::span<const FieldSpec> fields) {
  std::vector<RevMeeting> rows;
  for (const std::string_view method : weightNamesIn(dimension)) {
    if (method == "slicing") continue;
    for (const FieldSpec& spec : fields)
      for (const double near : {1.0, 2.0}) {
        std::optional<RevMeeting> best;
        for (const double width : widths()) {
          if (std::abs(width - near) > 0.26) continue;
          const auto found = differenceFromSlicing(curves, spec.name, method, width);
          if (found && (!best || *found < best->difference))
            best = {std::string(method), std::string(spec.name), near, width, *found};
        }
        if (best) rows.push_back(*best);
      }
  }
  return rows;
}

}  // namespace

RevResults averagePerWidth(const StudyWork& work, const AverageOptions& own) {
  const Case& setup = work.setup();
  const std::vector<SnapshotRun> runs = snapshotRuns(filesOf(work.line));
  if (runs.size() > 1)
    throw BadInput(fmt::format("--rev: takes the files of one run, and {} and {} are two",
                               runs[0].name(), runs[1].name()));
  const std::string name = own.name.value_or(defaultName(runs.front().format));
  // The average itself finds whatever does not fit, before the widths.
  const OpenRun opened = openRun(runs.front(), setup, name);
  const AveragedRun averaged = opened.average([](double) {});
  RevResults results{flowFrame(kindRev, setup, work.line.run.commandLine, opened.radius),
                     averaged.run.engine,
                     {},
                     {}};
  results.averaging.snapshots = averaged.snapshots;
  if (setup.dimension == 2) results.averaging.lineWidth = setup.averaging.lineWidth;
  results.notes = {fmt::format("Averaged from the {} snapshots of {}; nothing was run.",
                               averaged.snapshots, runs.front().name())};
  std::ranges::copy(averaged.run.remarks, std::back_inserter(results.notes));
  Progress progress(work.line.run.quiet);
  const std::vector<double> all = widths();
  progress.begin("averaging", std::vector<double>(all.size(), 1.0));
  Curves curves;
  for (std::size_t k = 0; k < all.size(); ++k) {
    inDimensionOf(setup, [&]<int D>() { addWidth<D>(setup, runs.front(), name, all[k], curves); });
    progress.update(k, "widths", 1.0);
  }
  if (curves.empty())
    throw BadInput(
        fmt::format("{}: --rev: the averaged part has no room for a bin of {} d, d = {:g} m",
                    setup.file.string(), all.front(), flowDiameter(setup)));
  const auto fields = fieldsIn(setup.dimension, setup.region->hasRings());
  for (const std::string_view method : weightNamesIn(setup.dimension))
    for (const FieldSpec& field : fields)
      for (const auto& [_, curve] : curves)
        if (curve.method == method && curve.field == field.name) results.curves.push_back(curve);
  results.meetings = meetingsOf(results.curves, setup.dimension, fields);
  return results;
}

}  // namespace crossgrain::inline studies
