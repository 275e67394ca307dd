#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "results/scene_picture.hpp"

/// Pictures of scenes, made of round-ended strokes: a disk is a stroke without length. That is
/// little enough for thousands of disks to stay small in a page.
namespace crossgrain::reports {

struct Stroke {
  double x1 = 0.0, y1 = 0.0, x2 = 0.0, y2 = 0.0;
};

/// Strokes of one colour and width; later groups cover earlier ones. Its outlines, x0, y0, x1 …,
/// are filled with that colour.
struct StrokeGroup {
  std::string colour;  ///< "#rrggbb"
  double width = 0.0;
  std::vector<Stroke> strokes;
  std::vector<std::vector<double>> outlines = {};
};

/// A shaded sphere.
struct Ball {
  double x = 0.0, y = 0.0, radius = 0.0;
  std::string colour;
};

/// A part of the plane, y upward. Nothing is in an empty one.
struct Window {
  double left = INFINITY, right = -INFINITY, bottom = INFINITY, top = -INFINITY;

  double width() const { return right - left; }
  double height() const { return top - bottom; }
  double larger() const { return std::max(width(), height()); }
  /// Widens it by so much of its larger side, or makes an empty one of side 2.
  void widen(double share);
  /// Widens it so that the other is within, too.
  void add(const Window& other);
};

/// Balls lie behind the groups; those later in the list cover earlier ones.
struct Drawing {
  Window window;
  std::vector<StrokeGroup> groups;
  std::vector<Ball> balls = {};
};

/// One drawing of a cell at one instant.
struct Picture {
  enum class Shows { scene, strip, origins, forces, worst };
  std::string name;  ///< of its files: scene_1_ENGINE, strip_…, origins_…, forces_…, worst_1_ENGINE
  std::string engine;
  std::string title;
  std::string scale;  ///< the drawing's scale in words; may be empty
  Shows shows = Shows::scene;
  Drawing drawing;
};

/// Disks coloured by the root of their speed, from dark to bright at `fastest` [m/s], or by their
/// size where no speed is known (fastest 0).
Drawing sceneDrawing(const ScenePicture& picture, double fastest);

/// Scenes side by side in their order, on one scale of colours.
Drawing stripDrawing(const std::vector<ScenePicture>& pictures, double fastest);

/// The speed that 98 % of the picture's disks are below [m/s]; 0 where no speed is known.
double fastestOf(const ScenePicture& picture);

/// Speed that takes the smallest body a hundredth of its diameter in the time since the start: what
/// is slower is at rest, and its speed is the engine's noise [m/s].
double restingSpeed(const ScenePicture& picture);

/// Disks coloured by where they started, sectors of angle crossed with bands of radius, so that
/// shear bends the sectors. @param inner  radius of the wheel  @param diameter  half of a band; 0:
/// not known
Drawing originsDrawing(const ScenePicture& picture, double inner, double diameter);

/// Disks pale, contacts as lines whose width is full at a force of `widest` [N].
/// @param width  of a full line, in radii of the largest disk
Drawing forcesDrawing(const ScenePicture& picture, double widest, double width);

/// The normal force of the widest line [N]: 99 % of the picture's contacts lie below. Absent
/// without contacts.
std::optional<double> widestForce(const ScenePicture& picture);

/// Of its contacts that have a force: how many there are, how many have at least `force` [N], and
/// their mean [N].
struct ForceCount {
  std::size_t contacts = 0, above = 0;
  double mean = 0.0;
};
ForceCount countForces(const ScenePicture& picture, double force);

/// Both scale the larger side of the window to `size` [px at 96 per inch].
std::string toSvg(const Drawing& drawing, double size, const std::string& title);
std::string toPdf(const Drawing& drawing, double size);

/// Writes name.svg and name.pdf.
void writePicture(const Picture& picture, const std::filesystem::path& dir);

}  // namespace crossgrain::reports
