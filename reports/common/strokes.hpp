#pragma once

#include <string>
#include <vector>

/// Drawings made of round-ended strokes: a disk is a stroke without length. That is little enough
/// for thousands of disks to stay small in a page.
namespace crossgrain::reports {

struct Stroke {
  double x1 = 0.0, y1 = 0.0, x2 = 0.0, y2 = 0.0;
};

/// Strokes of one colour and width; later groups cover earlier ones.
struct StrokeGroup {
  std::string colour;  ///< "#rrggbb"
  double width = 0.0;
  std::vector<Stroke> strokes;
};

/// A square window on the plane, centred on the origin, y upward.
struct Drawing {
  double halfWidth = 1.0;
  std::vector<StrokeGroup> groups;
};

/// Both scale the window to `size` [px at 96 per inch].
std::string toSvg(const Drawing& drawing, double size, const std::string& title);
std::string toPdf(const Drawing& drawing, double size);

}  // namespace crossgrain::reports
