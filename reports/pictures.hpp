#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/json_view.hpp"
#include "reports/strokes.hpp"

namespace crossgrain::reports {

/// One drawing of a cell at one instant.
struct Picture {
  enum class Shows { origins, forces };
  std::string name;  ///< of its files: origins_1_ENGINE, forces_1_ENGINE
  std::string engine;
  std::string title;
  Shows shows = Shows::origins;
  Drawing drawing;
};

/// Two per engine, of its first run that has a picture:
/// - origins: disks coloured by where they started, sectors of angle crossed with bands of radius,
///   so that shear bends the sectors;
/// - forces: contacts as lines from centre to centre, width and darkness ∝ f_n on one scale for all
///   engines (widestForce), disks pale.
std::vector<Picture> comparePictures(const Json& results);

/// The normal force of the widest line [N]: 99 % of all pictures' contacts lie below. Absent
/// without contacts.
std::optional<double> widestForce(const Json& results);

/// Writes name.svg and name.pdf.
void writePicture(const Picture& picture, const std::filesystem::path& dir);

}  // namespace crossgrain::reports
