#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/common/numbers.hpp"
#include "reports/common/pictures.hpp"
#include "reports/stability/table.hpp"

namespace crossgrain::reports {

namespace {

double middleOf(const Json& values) {
  std::vector<double> sorted;
  for (const Json& value : values)
    if (const auto known = number(value)) sorted.push_back(*known);
  if (sorted.empty()) return 0.0;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::ranges::nth_element(sorted, middle);
  return *middle;
}

/// Drops disks far away from most, which would make of the rest a dot.
void dropFarAway(Json& picture) {
  constexpr double farAway = 60.0;  // radii of the largest
  const double x0 = middleOf(list(picture, "x")), y0 = middleOf(list(picture, "y"));
  double largest = 0.0;
  for (const Json& radius : list(picture, "radius"))
    largest = std::max(largest, number(radius).value_or(0.0));
  const double reach =
      largest * (farAway + 3.0 * std::sqrt(static_cast<double>(list(picture, "x").size())));
  for (const auto& [keyX, keyY] : {std::pair("x", "y"), std::pair("wall_x", "wall_y")})
    for (std::size_t k = 0; k < list(picture, keyX).size(); ++k) {
      const auto x = number(picture[keyX][k]), y = number(picture[keyY][k]);
      if (x && y && std::abs(*x - x0) < reach && std::abs(*y - y0) < reach) continue;
      picture[keyX][k] = picture[keyY][k] = nullptr;
    }
}

/// Half way between the outermost of the disks.
double centreOf(const Json& places) {
  double low = INFINITY, high = -INFINITY;
  for (const Json& place : places)
    if (const auto known = number(place)) {
      low = std::min(low, *known);
      high = std::max(high, *known);
    }
  return low <= high ? 0.5 * (low + high) : 0.0;
}

/// The picture with the disks about the origin.
Json centred(Json picture) {
  dropFarAway(picture);
  const double x0 = centreOf(list(picture, "x")), y0 = centreOf(list(picture, "y"));
  for (const auto& [key, shift] :
       {std::pair("x", x0), std::pair("y", y0), std::pair("wall_x", x0), std::pair("wall_y", y0)})
    if (picture.contains(key))
      for (Json& place : picture[key])
        if (const auto known = number(place)) place = *known - shift;
  if (picture.contains("planes"))
    for (Json& plane : picture["planes"]) {
      plane[0] = number(plane[0]).value_or(0.0) - x0;
      plane[1] = number(plane[1]).value_or(0.0) - y0;
    }
  return picture;
}

/// Planes as lines through the whole window.
void addPlanes(const Json& picture, Drawing& drawing) {
  StrokeGroup lines{"#555555", drawing.halfWidth / 100.0, {}};
  for (const Json& plane : list(picture, "planes")) {
    const double x = plane[0], y = plane[1], nx = plane[2], ny = plane[3];
    const double away = x * nx + y * ny, half = 3.0 * drawing.halfWidth;
    const double footX = away * nx, footY = away * ny;
    if (std::abs(away) > drawing.halfWidth) continue;
    lines.strokes.push_back(
        {footX - half * ny, footY + half * nx, footX + half * ny, footY - half * nx});
  }
  if (!lines.strokes.empty()) drawing.groups.push_back(std::move(lines));
}

Picture pictureOf(const Json& run, std::size_t index) {
  const Json picture = centred(member(run, "picture"));
  const auto widest = widestForce(picture);
  const std::string variant = text(run, "variant");
  Drawing drawing = forcesDrawing(picture, widest.value_or(1.0), 0.35);
  drawing.halfWidth *= 1.08;
  addPlanes(picture, drawing);
  return {fmt::format("worst_{}", index),
          text(run, "engine"),
          fmt::format("{}: {}{}{}", text(run, "engine"), text(run, "case"),
                      variant.empty() ? "" : ", ", variant),
          fmt::format("{}{}{}at {} s{}", text(run, "case"), variant.empty() ? " " : ", " + variant,
                      variant.empty() ? "" : " ", readable(number(picture, "time_s")),
                      widest ? fmt::format("; widest line: {} N", readable(widest)) : ""),
          Picture::Shows::worst,
          std::move(drawing)};
}

}  // namespace

std::vector<Picture> stabilityPictures(const Json& results) {
  std::vector<Picture> pictures;
  for (const Json& run : list(results, "runs"))
    if (text(run, "verdict") == "unstable" && member(run, "picture").is_object())
      pictures.push_back(pictureOf(run, pictures.size() + 1));
  return pictures;
}

}  // namespace crossgrain::reports
