#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/common/strokes.hpp"
#include "results/scene_picture.hpp"

namespace crossgrain::reports {

/// One drawing of a cell at one instant.
struct Picture {
  enum class Shows { origins, forces, motion, worst };
  std::string name;  ///< of its files: origins_1_ENGINE, forces_…, motion_…, worst_1_ENGINE
  std::string engine;
  std::string title;
  std::string scale;  ///< what the drawing's scale is, in words; may be empty
  Shows shows = Shows::origins;
  Drawing drawing;
  std::string film{};  ///< motionData() of what moves; else empty
};

/// Disks coloured by where they started, sectors of angle crossed with bands of radius, so that
/// shear bends the sectors. @param inner  radius of the wheel  @param diameter  half of a band; 0:
/// not known
Drawing originsDrawing(const ScenePicture& picture, double inner, double diameter);

/// Disks pale, contacts as lines whose width is full at a force of `widest` [N], centred on the
/// origin.
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

/// Writes name.svg and name.pdf.
void writePicture(const Picture& picture, const std::filesystem::path& dir);

}  // namespace crossgrain::reports
