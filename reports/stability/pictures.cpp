#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/common/numbers.hpp"
#include "reports/stability/report.hpp"
#include "results/stability_fields.hpp"

namespace crossgrain::reports {

namespace {

double middleOf(const std::vector<double>& values) {
  std::vector<double> sorted;
  for (const double value : values)
    if (std::isfinite(value)) sorted.push_back(value);
  if (sorted.empty()) return 0.0;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::ranges::nth_element(sorted, middle);
  return *middle;
}

/// Drops disks far away from most, which would make of the rest a dot.
void dropFarAway(ScenePicture& picture) {
  constexpr double farAway = 60.0;  // radii of the largest
  const double x0 = middleOf(picture.x), y0 = middleOf(picture.y);
  double largest = 0.0;
  for (const double radius : picture.radius) largest = std::max(largest, radius);
  const double reach = largest * (farAway + 3.0 * std::sqrt(static_cast<double>(picture.x.size())));
  const auto drop = [&](std::vector<double>& x, std::vector<double>& y) {
    y.resize(x.size(), NAN);
    for (std::size_t k = 0; k < x.size(); ++k)
      if (!(std::abs(x[k] - x0) < reach && std::abs(y[k] - y0) < reach)) x[k] = y[k] = NAN;
  };
  drop(picture.x, picture.y);
  drop(picture.wallX, picture.wallY);
}

/// Half way between the outermost of the disks.
double centreOf(const std::vector<double>& places) {
  double low = INFINITY, high = -INFINITY;
  for (const double place : places)
    if (std::isfinite(place)) {
      low = std::min(low, place);
      high = std::max(high, place);
    }
  return low <= high ? 0.5 * (low + high) : 0.0;
}

/// The picture with the disks about the origin.
ScenePicture centred(ScenePicture picture) {
  dropFarAway(picture);
  const double x0 = centreOf(picture.x), y0 = centreOf(picture.y);
  for (auto* xs : {&picture.x, &picture.wallX})
    for (double& x : *xs) x -= x0;
  for (auto* ys : {&picture.y, &picture.wallY})
    for (double& y : *ys) y -= y0;
  if (picture.planes)
    for (auto& [x, y, normalX, normalY] : *picture.planes) {
      x -= x0;
      y -= y0;
    }
  return picture;
}

/// Planes as lines through the whole window.
void addPlanes(const ScenePicture& picture, Drawing& drawing) {
  if (!picture.planes) return;
  StrokeGroup lines{"#555555", drawing.halfWidth / 100.0, {}};
  for (const auto& [x, y, nx, ny] : *picture.planes) {
    const double away = x * nx + y * ny, half = 3.0 * drawing.halfWidth;
    const double footX = away * nx, footY = away * ny;
    if (std::abs(away) > drawing.halfWidth) continue;
    lines.strokes.push_back(
        {footX - half * ny, footY + half * nx, footX + half * ny, footY - half * nx});
  }
  if (!lines.strokes.empty()) drawing.groups.push_back(std::move(lines));
}

Picture pictureOf(const StabilityRun& run, std::size_t index) {
  const ScenePicture shown = centred(*run.picture);
  const auto widest = widestForce(shown);
  const std::string& variant = run.variant;
  Drawing drawing = forcesDrawing(shown, widest.value_or(1.0), 0.35);
  drawing.halfWidth *= 1.08;
  addPlanes(shown, drawing);
  return {fmt::format("worst_{}", index),
          run.engine,
          fmt::format("{}: {}{}{}", run.engine, run.name, variant.empty() ? "" : ", ", variant),
          fmt::format("{}{}{}at {} s{}", run.name, variant.empty() ? " " : ", " + variant,
                      variant.empty() ? "" : " ", readable(finite(shown.time)),
                      widest ? fmt::format("; widest line: {} N", readable(widest)) : ""),
          Picture::Shows::worst,
          std::move(drawing)};
}

}  // namespace

std::vector<Picture> stabilityPictures(const StabilityResults& results) {
  std::vector<Picture> pictures;
  for (const StabilityRun& run : results.runs)
    if (run.verdict == StabilityVerdict::unstable && run.picture)
      pictures.push_back(pictureOf(run, pictures.size() + 1));
  return pictures;
}

}  // namespace crossgrain::reports
