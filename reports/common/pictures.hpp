#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/common/strokes.hpp"
#include "results/scene_picture.hpp"

namespace crossgrain::reports {

/// One drawing of a cell at one instant.
struct Picture {
  enum class Shows { origins, forces, worst };
  std::string name;  ///< of its files: origins_1_ENGINE, forces_1_ENGINE, worst_1_ENGINE
  std::string engine;
  std::string title;
  std::string scale;  ///< what the drawing's scale is, in words; may be empty
  Shows shows = Shows::origins;
  Drawing drawing;
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

/// Writes name.svg and name.pdf.
void writePicture(const Picture& picture, const std::filesystem::path& dir);

}  // namespace crossgrain::reports
