#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/common/json_view.hpp"
#include "reports/common/strokes.hpp"

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

/// Two per engine, of its first run that has a picture:
/// - origins: disks coloured by where they started, sectors of angle crossed with bands of radius,
///   so that shear bends the sectors;
/// - forces: contacts as lines from centre to centre, width and darkness ∝ f_n, disks pale. Each
///   has its own scale (widestForce): engines' forces may differ by orders of magnitude, and what
///   is to be compared is how they are laid out.
std::vector<Picture> comparePictures(const Json& results);

/// Disks pale, contacts as lines whose width is full at a force of `widest` [N], centred on the
/// origin.
/// @param width  of a full line, in radii of the largest disk
Drawing forcesDrawing(const Json& picture, double widest, double width);

/// The normal force of the widest line [N]: 99 % of the picture's contacts lie below. Absent
/// without contacts.
std::optional<double> widestForce(const Json& picture);

/// Writes name.svg and name.pdf.
void writePicture(const Picture& picture, const std::filesystem::path& dir);

}  // namespace crossgrain::reports
