#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "adapters/files/frame.hpp"
#include "adapters/files/text_file.hpp"

namespace crossgrain::files {

/// Quantity in a column of numbers. Components of a vector follow one another.
// clang-format off
enum class Meaning : std::uint8_t {
  time, step,
  id, kind,
  x, y, z,
  scaledX, scaledY, scaledZ,      ///< places as fractions of the box
  radius, diameter,
  vx, vy, vz,
  spinX, spinY, spinZ,
  mass,
  first, second,
  nx, ny, nz,                     ///< unit vector from second to first
  branchX, branchY, branchZ,      ///< centre of the first − centre of the second
  fx, fy, fz,                     ///< force on the first
  tx, ty, tz,                     ///< its tangential part
  normalForce,                    ///< > 0 pushes
  tangentialForce,                ///< its size
  px, py, pz,                     ///< where they touch
  overlap,
  rollingX, rollingY, rollingZ,   ///< torque of rolling resistance on the first
  torqueX, torqueY, torqueZ,      ///< the whole torque on the first, about its centre
  pseudoX, pseudoY, pseudoZ,      ///< rolling pseudo-force it: R* n × it is the torque
  wall,                           ///< first of eight columns: contact with a wall (lammps.cpp)
  count,
  none = unread
};
// clang-format on

/// The k-th component of the vector that begins with `first`.
constexpr Meaning following(Meaning first, int k) {
  return static_cast<Meaning>(static_cast<int>(first) + k);
}

/// Further places of a row, of what one format alone has.
inline constexpr std::size_t extraMeanings = 128;
constexpr Meaning extraMeaning(std::size_t k) {
  return static_cast<Meaning>(static_cast<std::size_t>(Meaning::count) + k);
}

/// The meaning that a name has in CSV files and in FileOptions::columns, whatever its capitals
/// (but for T, which is a temperature as well); none: no such name.
Meaning meaningOf(std::string_view name);
/// All such names.
const std::vector<std::string>& meaningNames();
/// " (did you mean vx?)": what other programs call so, else the nearest of meaningNames().
std::string suggestedMeaning(std::string_view name);
/// Without capitals.
std::string lowered(std::string_view name);

/// FileOptions::columns, word by word.
class ColumnOptions {
 public:
  /// @throws BadInput
  explicit ColumnOptions(const std::string& option);

  /// Words given for an array, or for a column without index; null: none.
  const std::vector<std::string>* wordsOf(std::string_view name) const;
  /// The meaning of column "name" or "name[k]", k from 1; absent: none is given. "-" is
  /// Meaning::none. A vector's name among others stands for three columns.
  /// @throws BadInput where a word has no meaning
  std::optional<Meaning> of(std::string_view name) const;
  bool empty() const { return given_.empty(); }
  /// @throws BadInput where something was said of a column that `files` do not have
  void checkUsed(const std::string& files) const;

 private:
  struct Given {
    std::string name;
    std::vector<std::string> words;
    mutable bool used = false;
  };
  std::vector<Given> given_;
};

/// "c_q[12]" → "c_q", 12; without an index the whole and 0.
std::pair<std::string_view, std::size_t> splitIndex(std::string_view name);

/// The columns of a table, and one row of it.
class Columns {
 public:
  Columns() = default;
  explicit Columns(std::vector<Meaning> meanings);

  bool has(Meaning meaning) const;
  /// Whether any of the three components is there.
  bool hasVector(Meaning first) const;
  /// Components that are not there of a vector that is. Places may be parts of the box.
  void addMissing(Meaning first, std::vector<MissingComponent>& missing) const;
  std::size_t count() const { return places_.size(); }
  /// @throws BadInput naming two columns of one meaning
  void checkDistinct(const TextFile& text) const;

  void read(const TextFile& text, char separator) {
    readRow(text, separator, places_, values_.data());
  }
  double operator[](Meaning meaning) const { return values_[static_cast<std::size_t>(meaning)]; }
  double& operator[](Meaning meaning) { return values_[static_cast<std::size_t>(meaning)]; }
  /// Components that are not there are 0: addMissing() has them.
  Vec3 vector(Meaning first) const;

 private:
  std::vector<std::uint8_t> places_;
  std::array<double, static_cast<std::size_t>(Meaning::count) + extraMeanings> values_{};
};

/// Room for `rows` more, in what the columns fill.
void reserve(FileParticles& particles, const Columns& columns, std::size_t rows);
/// Adds the row that was read. Ids are the file's, without such a column the row. @throws BadInput
void addParticle(FileParticles& particles, const Columns& columns, const TextFile& text);

}  // namespace crossgrain::files
