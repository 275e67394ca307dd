#include "results/scale.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "adapters/worker/json.hpp"
#include "results/head.hpp"

namespace crossgrain::inline results {

namespace {

/// Absent where there is no such point, or it did not run.
std::optional<double> fastestStep(const ScalePoint* point) {
  if (!point || point->status != Status::finished || point->seconds.empty()) return std::nullopt;
  return std::ranges::min(point->seconds);
}

std::optional<double> quotient(std::optional<double> one, std::optional<double> other) {
  if (!one || !other || !(*other > 0.0)) return std::nullopt;
  return *one / *other;
}

}  // namespace

const ScalePoint* scalePoint(const ScaleResults& results, const std::string& engine,
                             std::size_t disks, int workers) {
  for (const ScalePoint& point : results.points)
    if (point.engine == engine && point.disks == disks && point.workers == workers) return &point;
  return nullptr;
}

std::string describeWorkers(const ScaleSharing& sharing, int workers) {
  if (sharing.workers.empty()) return "one process";
  const std::string& many = sharing.workers;
  return fmt::format("{} {}", workers, workers == 1 ? many.substr(0, many.size() - 1) : many);
}

ScaleFigures scaleFigures(const ScaleResults& results, const ScalePoint& point) {
  ScaleFigures figures;
  figures.step = fastestStep(&point);
  if (!figures.step) return figures;
  const auto disks = static_cast<double>(point.disks);
  if (point.seconds.size() > 1)
    figures.spread = quotient(std::ranges::max(point.seconds) - *figures.step, figures.step);
  figures.perDisk = *figures.step / disks;
  figures.bytes = quotient(point.memory, disks);
  if (!results.engines.empty())
    figures.ratio =
        quotient(figures.step,
                 fastestStep(scalePoint(results, results.engines.front().name, point.disks, 1)));
  const auto workers = static_cast<std::size_t>(point.workers);
  if (workers < 2) return figures;
  const auto share = [&](std::size_t of) {
    return fastestStep(scalePoint(results, point.engine, of, 1));
  };
  figures.strong = quotient(share(point.disks), point.workers * *figures.step);
  if (point.disks % workers == 0)
    figures.weak = quotient(share(point.disks / workers), figures.step);
  return figures;
}

void fields(auto& io, ScaleCell& cell) {
  io("disks", cell.disks);
  io("wall_disks", cell.wallDisks);
  io("outer_radius_m", cell.outerRadius);
  io("volume_fraction", cell.volumeFraction);
  io("packing", cell.packing);
}

void fields(auto& io, ScaleSharing& sharing) {
  io("engine", sharing.engine, aName);
  io("workers", sharing.workers);
}

void fields(auto& io, ScaleResults& results) {
  results.head.fields(io);
  io.present("elapsed_s", results.elapsed);
  io("repetitions", results.repetitions);
  io("engines", results.engines);
  io("sharing", results.sharing);
  io("cells", results.cells);
  io("points", results.points);
}

Json toJson(const ScaleResults& results) {
  return jsonOf(results);
}

ScaleResults scaleFromJson(const Json& json) {
  return readAs<ScaleResults>(json);
}

}  // namespace crossgrain::inline results
