#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "adapters/files/frame.hpp"

namespace crossgrain::files {

/// A named array of VTK, row by row.
struct VtkArray {
  std::string name;
  std::size_t components = 1;
  std::vector<double> values;

  std::size_t rows() const { return values.size() / components; }
  Vec3 vector(std::size_t row) const {
    return {values[3 * row], values[3 * row + 1], values[3 * row + 2]};
  }
};

/// Points and lines between them, with arrays of both.
struct VtkData {
  std::vector<Vec3> points;
  std::vector<std::pair<std::size_t, std::size_t>> lines;  ///< their points
  std::vector<VtkArray> pointArrays, lineArrays;
};

/// A type of numbers, by its name in XML and in the older format.
struct VtkType {
  std::string_view name, before;
  std::size_t size;  ///< [bytes]
  /// @param swapped  their bytes are in the other order than this machine's
  std::vector<double> (*read)(std::span<const std::byte> bytes, bool swapped);
};
/// Null: no number that is read.
const VtkType* vtkTypeOf(std::string_view VtkType::*named, std::string_view name);

/// .vtu and .vtp, or an index of them, .pvtu and .pvtp, without ghosts: numbers in text, in base64,
/// or appended, raw or in base64, packed by zlib or not.
/// @throws BadInput
VtkData readVtkXml(const std::filesystem::path& file);
/// The older format, in text or binary. @throws BadInput
VtkData readVtkLegacy(const std::filesystem::path& file);
/// Whether it has lines, which contacts are. @throws BadInput
bool legacyHasLines(const std::filesystem::path& file);

/// Adds a line to data of either format. @throws BadInput where an end is no point
void addLine(VtkData& data, const std::string& where, double from, double to);

}  // namespace crossgrain::files
