#include "reports/common/motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "reports/common/base64.hpp"
#include "reports/common/view.hpp"
#include "results/snapshot_layout.hpp"
#include "support/hdf5_file.hpp"
#include "support/hdf5_trial.hpp"
#include "support/input_file.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::reports {

namespace {

constexpr std::size_t mostFrames = 20;
constexpr std::size_t mostBodies = 60'000;  ///< of bodies in all frames: 320 kB of a page
const std::string wallColour = "#555555";

/// @throws std::runtime_error where it is not there, of another length or not finite
std::vector<double> numbers(const Hdf5File& file, const std::string& path, std::size_t length) {
  auto values = file.read(path);
  if (!values || values->size() != length ||
      !std::ranges::all_of(*values, [](double v) { return std::isfinite(v); }))
    throw std::runtime_error(path);
  return std::move(*values);
}

MotionFrame frameOf(const Hdf5File& file, const std::string& group, std::size_t disks,
                    std::size_t walls) {
  MotionFrame frame;
  frame.time = numbers(file, group + "/time", 4).front();
  auto places = numbers(file, group + "/position", 2 * disks);
  if (walls > 0) {
    const auto wallPlaces = numbers(file, group + "/wall_position", 2 * walls);
    places.insert(places.end(), wallPlaces.begin(), wallPlaces.end());
  }
  for (std::size_t k = 0; k < disks + walls; ++k) {
    frame.x.push_back(places[2 * k]);
    frame.y.push_back(places[2 * k + 1]);
  }
  const auto velocity = numbers(file, group + "/velocity", 2 * disks);
  for (std::size_t k = 0; k < disks; ++k)
    frame.speed.push_back(std::hypot(velocity[2 * k], velocity[2 * k + 1]));
  return frame;
}

std::size_t colourOf(double speed, double fastest) {
  const auto& colours = speedColours();
  std::size_t place = 0;
  while (place + 1 < colours.size() && speed >= colours[place + 1].from * fastest) ++place;
  return place;
}

/// Radii one after the other as how often each comes.
Json runLengths(const std::vector<double>& radius, double width) {
  Json runs = Json::array();
  for (std::size_t k = 0; k < radius.size();) {
    std::size_t end = k;
    while (end < radius.size() && radius[end] == radius[k]) ++end;
    runs.push_back({end - k, std::round(1e5 * radius[k] / width) / 1e5});
    k = end;
  }
  return runs;
}

}  // namespace

namespace {

std::optional<Motion> readMotionFile(const std::filesystem::path& file) {
  const Hdf5File in = Hdf5File::open(file);
  Motion motion;
  motion.radius = in.read("/disks/radius").value_or(std::vector<double>());
  const std::size_t disks = motion.radius.size();
  const auto walls = in.read("/walls/radius").value_or(std::vector<double>());
  motion.radius.insert(motion.radius.end(), walls.begin(), walls.end());
  std::size_t held = 0;
  while (in.holds(snapshotGroup(held) + "/position")) ++held;
  if (disks == 0) return std::nullopt;
  const std::size_t wanted =
      std::min({held, mostFrames, mostBodies / std::max<std::size_t>(1, motion.radius.size())});
  if (wanted < 2) return std::nullopt;
  for (std::size_t k = 1; k <= wanted; ++k)
    motion.frames.push_back(frameOf(in, snapshotGroup(k * held / wanted - 1), disks, walls.size()));
  return motion;
}

}  // namespace

std::optional<Motion> readMotion(const std::filesystem::path& file) {
  if (!whyNoFile(file).empty()) return std::nullopt;
  try {
    tryReading(file, [&] { readMotionFile(file); });
    return readMotionFile(file);
  } catch (const Interrupted&) {
    throw;
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
}

double largestSpeed(const Motion& motion) {
  double largest = 0.0;
  for (const MotionFrame& frame : motion.frames)
    for (const double speed : frame.speed) largest = std::max(largest, speed);
  return largest;
}

double reachOf(const Motion& motion) {
  double reach = 0.0;
  for (const MotionFrame& frame : motion.frames)
    for (std::size_t k = 0; k < frame.x.size(); ++k)
      reach = std::max(reach, std::hypot(frame.x[k], frame.y[k]) + motion.radius[k]);
  return reach;
}

/// Colours of viridis (van der Walt and Smith 2015): told apart in grey and by the colour-blind.
const std::vector<SpeedColour>& speedColours() {
  static const std::vector<SpeedColour> colours = [] {
    const char* const all[] = {"#440154", "#46327e", "#365c8d", "#277f8e",
                               "#1fa187", "#4ac16d", "#a0da39", "#fde725"};
    std::vector<SpeedColour> made;
    const auto count = static_cast<double>(std::size(all));
    for (const char* const colour : all)
      made.push_back(
          {std::pow(10.0, -3.0 + 3.0 * static_cast<double>(made.size()) / count), colour});
    return made;
  }();
  return colours;
}

Drawing motionStill(const Motion& motion, double fastest, double halfWidth) {
  Drawing drawing;
  drawing.halfWidth = halfWidth;
  const MotionFrame& last = motion.frames.back();
  std::map<std::pair<double, std::string>, std::vector<Stroke>> groups;
  for (std::size_t k = 0; k < last.x.size(); ++k) {
    const std::string& colour = k < last.speed.size()
                                    ? speedColours()[colourOf(last.speed[k], fastest)].colour
                                    : wallColour;
    groups[{2.0 * motion.radius[k], colour}].push_back(
        {last.x[k], last.y[k], last.x[k], last.y[k]});
  }
  for (auto& [key, strokes] : groups)
    drawing.groups.push_back({key.second, key.first, std::move(strokes)});
  return drawing;
}

std::string motionData(const Motion& motion, double fastest, double halfWidth,
                       const std::vector<std::string>& told) {
  const double width = 2.0 * halfWidth;
  std::string bytes;
  const auto part = [&](double v) {
    return static_cast<unsigned>(std::lround(std::clamp(v / width, 0.0, 1.0) * 4095.0));
  };
  for (const MotionFrame& frame : motion.frames)
    for (std::size_t k = 0; k < frame.x.size(); ++k) {
      const unsigned x = part(frame.x[k] + halfWidth), y = part(halfWidth - frame.y[k]);
      const std::size_t colour = k < frame.speed.size() ? colourOf(frame.speed[k], fastest) : 0;
      for (const unsigned byte :
           {x >> 4u, (x & 15u) << 4u | y >> 8u, y & 255u, static_cast<unsigned>(colour)})
        bytes += static_cast<char>(byte);
    }
  Json colours = Json::array();
  for (const SpeedColour& colour : speedColours()) colours.push_back(colour.colour);
  return Json{{"radii", runLengths(motion.radius, width)},
              {"colours", std::move(colours)},
              {"wall", wallColour},
              {"disks", motion.frames.front().speed.size()},
              {"told", told},
              {"data", base64(bytes)}}
      .dump();
}

}  // namespace crossgrain::reports
