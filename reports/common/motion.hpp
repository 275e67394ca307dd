#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "reports/common/strokes.hpp"

/// A short film of a scene from the snapshots that its run kept, disks coloured by their speed.
namespace crossgrain::reports {

struct MotionFrame {
  double time = 0.0;          ///< [s]
  std::vector<double> x, y;   ///< of disks, then wall disks [m]
  std::vector<double> speed;  ///< of disks [m/s]
};

struct Motion {
  std::vector<double> radius;  ///< of disks, then wall disks [m]
  std::vector<MotionFrame> frames;
};

/// Reads a file of snapshots (runs/README.md), evenly thinned to at most 20 of them, the last one
/// among them, and to fewer where there are many disks, so that a page stays small.
/// @returns absent where there is no such file, it cannot be read or has no two snapshots
std::optional<Motion> readMotion(const std::filesystem::path& file);

/// The largest speed of any disk [m/s]; 0: nothing moves.
double largestSpeed(const Motion& motion);

/// How far the scene reaches from the origin, at any time [m].
double reachOf(const Motion& motion);

/// Where colours begin, over the speed of the last one, three decades below it; and their names.
struct SpeedColour {
  double from = 0.0;
  std::string colour;  ///< "#rrggbb"
};
/// The slowest first; what is slower than the first has its colour.
const std::vector<SpeedColour>& speedColours();

/// The last frame. @param fastest  speed from which on all have the last colour [m/s]
/// @param halfWidth  of the picture [m]
Drawing motionStill(const Motion& motion, double fastest, double halfWidth);

/// What the page's script draws, as JSON: {radii [[how many, radius]], colours, wall: their colour,
/// disks, told [of each frame], data}, with lengths in parts of the picture's width; data is base64
/// of four bytes per disk and wall disk and frame: x and y from the upper left corner, 12 bits
/// each, and the colour's place.
/// @param told  what is said of each frame
std::string motionData(const Motion& motion, double fastest, double halfWidth,
                       const std::vector<std::string>& told);

}  // namespace crossgrain::reports
