#include "cases/start_file.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>

#include "adapters/written_shape.hpp"
#include "support/bad_input.hpp"
#include "support/files.hpp"
#include "support/input_file.hpp"
#include "support/nearest.hpp"

namespace crossgrain::inline cases {

namespace {

/// Columns of a CSV file; vectors have one for each component, one after the other.
template <int D>
struct Csv {
  static constexpr std::size_t x = 0, radius = D, vx = radius + 1, spin = vx + D,
                               mass = spin + (D == 2 ? 1 : 3), inertia = mass + 1,
                               fixed = inertia + 1, material = fixed + 1, shape = material + 1,
                               turn = shape + 1, count = turn + (D == 2 ? 1 : 4);
  static const std::array<std::string, count> names;
};
template <>
const std::array<std::string, Csv<2>::count> Csv<2>::names = {
    "x",    "y",       "radius", "vx",       "vy",    "spin",
    "mass", "inertia", "fixed",  "material", "shape", "angle"};
template <>
const std::array<std::string, Csv<3>::count> Csv<3>::names = {
    "x",    "y",       "z",     "radius",   "vx",    "vy", "vz", "spin_x", "spin_y", "spin_z",
    "mass", "inertia", "fixed", "material", "shape", "qw", "qx", "qy",     "qz"};

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r";
  const auto begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

/// Text between the separators, trimmed.
std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> pieces;
  for (std::size_t begin = 0;;) {
    const auto end = text.find(separator, begin);
    pieces.push_back(trimmed(text.substr(begin, end - begin)));
    if (end == std::string_view::npos) return pieces;
    begin = end + 1;
  }
}

/// A name may stand in quotes.
std::string unquoted(std::string_view text) {
  if (text.size() > 1 && text.front() == '"' && text.back() == '"')
    text = text.substr(1, text.size() - 2);
  return std::string(text);
}

/// One line of a CSV file, for messages: "start.csv:12: …".
struct CsvLine {
  const std::filesystem::path& file;
  int number;

  template <typename... Arguments>
  void check(bool sound, fmt::format_string<Arguments...> message, Arguments&&... arguments) const {
    if (!sound)
      throw BadInput(fmt::format("{}:{}: {}", file.string(), number,
                                 fmt::format(message, std::forward<Arguments>(arguments)...)));
  }
};

template <int D>
std::vector<std::size_t> readNames(const CsvLine& line,
                                   const std::vector<std::string_view>& names) {
  const auto& known = Csv<D>::names;
  std::vector<std::size_t> columns;
  for (const std::string_view name : names) {
    const auto found = std::ranges::find(known, name);
    line.check(found != known.end(), "\"{}\" is no column{}", name, suggestion(name, known));
    const auto column = static_cast<std::size_t>(found - known.begin());
    line.check(std::ranges::find(columns, column) == columns.end(), "two columns are called {}",
               name);
    columns.push_back(column);
  }
  const auto has = [&](std::size_t column) {
    return std::ranges::find(columns, column) != columns.end();
  };
  for (std::size_t need = 0; need <= Csv<D>::radius; ++need)
    line.check(has(need) || (need == Csv<D>::radius && has(Csv<D>::shape)), "there is no column {}",
               known[need]);
  const bool turned = std::ranges::max(columns) >= Csv<D>::turn;
  line.check(!turned || has(Csv<D>::shape), "{} is of convex bodies: there is no column shape",
             known[std::ranges::max(columns)]);
  for (std::size_t own = Csv<D>::turn; turned && own < Csv<D>::count; ++own)
    line.check(has(own), "there is no column {}: quaternions are qw, qx, qy, qz", known[own]);
  return columns;
}

double readNumber(const CsvLine& line, std::string_view text, const std::string& column) {
  double value = 0.0;
  // Tables have a plus sign where from_chars has none.
  const bool plus = text.size() > 1 && text[0] == '+' && text[1] != '-';
  const auto [end, error] =
      std::from_chars(text.data() + (plus ? 1 : 0), text.data() + text.size(), value);
  line.check(error == std::errc() && end == text.data() + text.size() && std::isfinite(value),
             "{} = {}: must be a number", column, text.empty() ? "nothing" : text);
  return value;
}

/// The numbers of a row.
template <int D>
using CsvValues = std::array<std::optional<double>, Csv<D>::count>;

/// The one that a row names.
template <int D>
const StartShapeOf<D>& shapeNamed(const CsvLine& line, const std::string& name,
                                  const std::vector<StartShapeOf<D>>& shapes) {
  const auto found = std::ranges::find(shapes, name, &StartShapeOf<D>::name);
  std::vector<std::string> known;
  for (const StartShapeOf<D>& shape : shapes) known.push_back(shape.name);
  line.check(found != shapes.end(), "shape = {}: {}{}", name,
             shapes.empty() ? "[assembly.start] has no shapes" : "is no shape of [assembly.start]",
             suggestion(name, known));
  return *found;
}

/// Adds what bodies of a start with shapes have beside a disk's numbers, which are there already.
/// @param own  null of a disk, or sphere
template <int D>
void addShape(const CsvLine& line, const CsvValues<D>& values, const StartShapeOf<D>* own,
              std::int32_t index, DisksOf<D>& disks) {
  using Columns = Csv<D>;
  TurnOf<D> turn = noTurn<D>();
  for (std::size_t column = Columns::turn; column < Columns::count; ++column)
    line.check(values[column].has_value() == values[Columns::turn].has_value(),
               "{} = nothing: quaternions are qw, qx, qy, qz", Columns::names[column]);
  if (const auto& first = values[Columns::turn]) {
    line.check(own, "{} = {}: is of convex bodies, which have a shape",
               Columns::names[Columns::turn], *first);
    if constexpr (D == 2) {
      turn = *first * std::numbers::pi / 180.0;
    } else {
      const auto part = [&](std::size_t k) { return *values[Columns::turn + k]; };
      const Eigen::Quaterniond given(*first, part(1), part(2), part(3));
      const auto unit = writtenTurn(given);
      line.check(unit.has_value(), "qw, qx, qy, qz: must be of length 1, not {:g}", given.norm());
      turn = *unit;
    }
  }
  disks.shape.push_back(index);
  disks.turn.push_back(own ? ownTurn<D>(own->frame, turn) : turn);
  const double mass = disks.mass.back(), reach = disks.radius.back();
  const auto& inertia = values[Columns::inertia];
  Vec3 moments = Vec3::Constant(disks.inertia.back());
  if constexpr (D == 2) {
    const std::string fault = own && inertia ? inertiaFault(*inertia, mass, reach) : "";
    line.check(fault.empty(), "inertia = {}: {}", inertia.value_or(0.0), fault);
    if (own && !inertia) disks.inertia.back() = mass * momentsPerMass(own->spread);
  } else {
    line.check(!own || !inertia, "inertia = {}: a convex body in space has that of its density",
               inertia.value_or(0.0));
    if (own) moments = mass * momentsPerMass(own->spread);
    disks.inertia.back() = own ? moments.mean() : disks.inertia.back();
    disks.moments.push_back(moments);
  }
}

template <int D>
void readDisk(const CsvLine& line, const std::vector<std::size_t>& columns,
              const std::vector<std::string_view>& cells, const DiskDefaults& defaults,
              const std::vector<StartShapeOf<D>>& shapes, StartOf<D>& start) {
  using Columns = Csv<D>;
  line.check(cells.size() == columns.size(), "has {} values for {} columns", cells.size(),
             columns.size());
  CsvValues<D> values;
  std::string material, shape;
  const bool mayBeEmpty = std::ranges::find(columns, Columns::shape) != columns.end();
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const std::size_t column = columns[k];
    const bool ofSome = column == Columns::radius || column >= Columns::turn;
    if (column == Columns::material || column == Columns::shape)
      (column == Columns::shape ? shape : material) = unquoted(cells[k]);
    else if (!mayBeEmpty || !ofSome || !cells[k].empty())
      values[column] = readNumber(line, cells[k], Columns::names[column]);
  }
  for (const auto column : {Columns::radius, Columns::mass, Columns::inertia})
    line.check(!values[column] || *values[column] > 0.0, "{} = {}: must be > 0",
               Columns::names[column], values[column].value_or(0));
  const double isFixed = values[Columns::fixed].value_or(0.0);
  line.check(isFixed == 0.0 || isFixed == 1.0, "fixed = {}: must be 0 or 1", isFixed);
  line.check(start.disks.size() + start.fixedRadius.size() < static_cast<std::size_t>(mostDisks),
             "these are more than the {} disks that a case may have", mostDisks);
  const auto vectorFrom = [&](std::size_t column) {
    VecOf<D> v;
    for (std::size_t k = 0; k < D; ++k) v[static_cast<int>(k)] = values[column + k].value_or(0.0);
    return v;
  };
  const StartShapeOf<D>* const own = shape.empty() ? nullptr : &shapeNamed(line, shape, shapes);
  line.check(own || values[Columns::radius], "has neither a radius nor a shape");
  line.check(!own || !values[Columns::radius],
             "shape = {}: stands beside a radius: give one of the two", shape);
  line.check(!own || isFixed == 0.0, "shape = {}: what stands still is disks, not convex bodies",
             shape);
  const VecOf<D> position = vectorFrom(Columns::x);
  const double a = own ? own->shape.reach() : *values[Columns::radius];
  if (isFixed == 1.0) {
    start.fixedPosition.push_back(position);
    start.fixedRadius.push_back(a);
    start.fixedLines.push_back(line.number);
    start.fixedMaterials.push_back(std::move(material));
    return;
  }
  DisksOf<D>& disks = start.disks;
  line.check(!own || values[Columns::mass] || defaults.density > 0.0,
             "has no mass, and [assembly.start] no density");
  const double m = values[Columns::mass] ? *values[Columns::mass]
                   : own                 ? defaults.density * own->spread.measure
                                         : defaults.mass(a);
  start.lines.push_back(line.number);
  start.materials.push_back(std::move(material));
  disks.position.push_back(position);
  disks.radius.push_back(a);
  disks.velocity.push_back(vectorFrom(Columns::vx));
  if constexpr (D == 2)
    disks.spin.push_back(values[Columns::spin].value_or(0.0));
  else
    disks.spin.push_back(vectorFrom(Columns::spin));
  disks.mass.push_back(m);
  disks.inertia.push_back(values[Columns::inertia].value_or(defaults.inertiaFactor * m * a * a));
  if (!shapes.empty())
    addShape(line, values, own, own ? static_cast<std::int32_t>(own - shapes.data()) : -1, disks);
}

template <int D>
StartOf<D> readCsv(const std::filesystem::path& file, std::string_view text,
                   const DiskDefaults& defaults, const std::vector<StartShapeOf<D>>& shapes) {
  constexpr std::string_view byteOrderMark = "\xEF\xBB\xBF";  // spreadsheets begin with it
  if (text.starts_with(byteOrderMark)) text.remove_prefix(byteOrderMark.size());
  StartOf<D> start;
  std::vector<std::size_t> columns;
  CsvLine line{file, 0};
  for (const std::string_view content : split(text, '\n')) {
    ++line.number;
    if (content.empty() || content.front() == '#') continue;
    const auto cells = split(content, ',');
    if (columns.empty())
      columns = readNames<D>(line, cells);
    else
      readDisk(line, columns, cells, defaults, shapes, start);
  }
  const char* const lacks = columns.empty()           ? "line of column names, as x,y,radius"
                            : start.disks.size() == 0 ? "disks that move"
                                                      : nullptr;
  if (lacks) throw BadInput(fmt::format("{}: has no {}", file.string(), lacks));
  return start;
}

}  // namespace

template <int D>
StartOf<D> readStart(const std::filesystem::path& file, const DiskDefaults& defaults,
                     const std::vector<StartShapeOf<D>>& shapes) {
  if (file.extension() != ".csv") {
    Packing packing = readPacking<D>(file, defaults);
    return {std::move(disksIn<D>(packing)), {}, {}};
  }
  const auto text = readFile(file);
  if (!text) throw BadInput(fmt::format("{}: {}", file.string(), noSuchFile));
  return readCsv<D>(file, *text, defaults, shapes);
}
template StartOf<2> readStart<2>(const std::filesystem::path&, const DiskDefaults&,
                                 const std::vector<StartShapeOf<2>>&);
template StartOf<3> readStart<3>(const std::filesystem::path&, const DiskDefaults&,
                                 const std::vector<StartShapeOf<3>>&);

}  // namespace crossgrain::inline cases
