#include "cases/packing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "adapters/law_options.hpp"
#include "cases/couette.hpp"
#include "cases/preparation.hpp"
#include "support/bad_input.hpp"
#include "support/files.hpp"
#include "support/fingerprint.hpp"
#include "support/hdf5_file.hpp"
#include "support/input_file.hpp"
#include "support/nearest.hpp"

namespace crossgrain::inline cases {

namespace {

std::vector<Vec2> asVectors(const std::vector<double>& values) {
  std::vector<Vec2> vectors;
  for (std::size_t i = 0; i + 1 < values.size(); i += 2)
    vectors.emplace_back(values[i], values[i + 1]);
  return vectors;
}

}  // namespace

std::string contentHash(const Packing& packing) {
  std::string bytes;
  const auto add = [&](const auto& values) {
    bytes.append(reinterpret_cast<const char*>(values.data()),
                 values.size() * sizeof(values.front()));
  };
  const Disks& disks = packing.disks;
  for (const auto* values : {&disks.radius, &disks.mass, &disks.inertia, &disks.spin}) add(*values);
  add(disks.position);
  add(disks.velocity);
  std::string hash = fmt::format("{:016x} {}", fnv1a(bytes), packing.wheelAngle);
  if (packing.wallTime != 0.0) hash += fmt::format(" {}", packing.wallTime);
  if (!packing.fixed.empty()) hash += " fixed " + packing.fixed;
  return hash;
}

std::string packingHash(const Case& setup, int index, double dt) {
  // The leading tag changes whenever the preparation itself does.
  std::string text = fmt::format("preparation 2; dt {};", setup.preparation.dt.value_or(dt));
  const ContactLaw& law = setup.law;
  for (const LawOption& option : lawOptions())
    if (hasPart(law, option.part))
      text += fmt::format("{} {};", option.name, option.values[option.get(law)]);
  const auto addConstants = [&](const ContactLaw& of) {
    for (const LawConstant& constant : lawConstants())
      if (hasPart(of, constant.part)) text += fmt::format(" {}", of.*constant.value);
    text += ';';
  };
  text += "law";
  addConstants(law);
  if (setup.materials) {
    text += "pairs";
    std::ranges::for_each(setup.materials->laws, addConstants);
    const Particles& disks = setup.particles;
    for (const MaterialName* each : {&disks.smallMaterial, &disks.largeMaterial,
                                     &setup.cell.wheelMaterial, &setup.cell.ringMaterial})
      text += fmt::format(" {};", std::ranges::find(setup.materials->names, each->name) -
                                      setup.materials->names.begin());
  }
  if (setup.bottom)
    text += fmt::format("bottom {} {} {} {} {} {};", setup.bottom->mu, setup.bottom->kb,
                        setup.bottom->gb, setup.bottom->tauM, setup.bottom->gravity,
                        setup.bottom->spin);
  const Cell& cell = setup.cell;
  text += fmt::format("cell {} {} {} {} {} {};", cell.innerRadius, cell.outerRadius,
                      cell.wallRadius, wallDiskCount(cell, cell.innerRadius),
                      wallDiskCount(cell, cell.outerRadius), cell.omega);
  const Particles& disks = setup.particles;
  text += fmt::format("disks {} {} {} {} {} {} {};", disks.small, disks.large, disks.smallRadius,
                      disks.largeRadius, disks.smallMass, disks.largeMass, disks.inertiaFactor);
  if (!disks.rotation) text += "no rotation;";
  const Preparation& how = setup.preparation;
  text += fmt::format("prepare {} {} {} {} {}", how.seed, how.dilation, how.velocity,
                      how.shrinkTime, how.rotations);
  if (const std::string who = preparerKey(setup); !who.empty()) text += "; engine " + who;
  if (index > 0) text += fmt::format("; stream {}", index);
  return fmt::format("{:016x}", fnv1a(text));
}

void writePacking(const Packing& packing, const std::filesystem::path& file) {
  makeDirectory(file.parent_path());
  Hdf5File out = Hdf5File::create(file);
  const Disks& disks = packing.disks;
  out.write("radius", disks.radius);
  out.write("mass", disks.mass);
  out.write("inertia", disks.inertia);
  out.write("position", disks.position.front().data(), disks.size(), 2);
  out.write("velocity", disks.velocity.front().data(), disks.size(), 2);
  out.write("spin", disks.spin);
  out.writeAttribute("wheel_angle", packing.wheelAngle);
  out.writeAttribute("hash", packing.hash);
  out.writeChecksum();
  out.save();
}

namespace {

Packing readPackingFile(const std::filesystem::path& file, const DiskDefaults& defaults) {
  const auto bad = [&](const std::string& what) {
    return BadInput(fmt::format("{}: {}", file.string(), what));
  };
  const Hdf5File in = Hdf5File::open(file);
  for (const auto& [name, columns] : {std::pair{"radius", 1u},
                                      {"position", 2u},
                                      {"velocity", 2u},
                                      {"spin", 1u},
                                      {"mass", 1u},
                                      {"inertia", 1u}})
    if (const auto count = in.length(name); count && *count > columns * defaults.most)
      throw bad(fmt::format("{} has {} values: a case may have at most {} disks", name, *count,
                            defaults.most));
  const auto radius = in.read("radius");
  const auto position = in.read("position");
  if (!radius || !position)
    throw bad("a packing needs the datasets radius (N) and position (N x 2)");
  const std::size_t count = radius->size();
  if (count == 0) throw bad("the packing has no disks");
  const auto sized = [&](const char* name, std::size_t columns) {
    auto values = in.read(name);
    if (values && values->size() != columns * count)
      throw bad(fmt::format("{} has {} values for {} disks; {} are needed", name, values->size(),
                            count, columns * count));
    for (std::size_t k = 0; values && k < values->size(); ++k)
      if (!std::isfinite((*values)[k]))
        throw bad(fmt::format("{} of disk {} is not finite", name, k / columns));
    return values;
  };

  const auto checkPositive = [&](const std::vector<double>& values, const char* what,
                                 const char* unit) {
    for (std::size_t i = 0; i < count; ++i)
      if (!(values[i] > 0.0))
        throw bad(
            fmt::format("the {} of disk {} is {} {}; it must be > 0", what, i, values[i], unit));
  };

  Packing packing;
  Disks& disks = packing.disks;
  disks.radius = *sized("radius", 1);
  checkPositive(disks.radius, "radius", "m");
  disks.position = asVectors(*sized("position", 2));
  const auto velocity = sized("velocity", 2);
  disks.velocity = velocity ? asVectors(*velocity) : std::vector<Vec2>(count, Vec2::Zero());
  disks.spin = sized("spin", 1).value_or(std::vector<double>(count, 0.0));
  if (auto mass = sized("mass", 1))
    disks.mass = std::move(*mass);
  else
    std::ranges::transform(disks.radius, std::back_inserter(disks.mass), defaults.mass);
  checkPositive(disks.mass, "mass", "kg");
  if (auto inertia = sized("inertia", 1))
    disks.inertia = std::move(*inertia);
  else
    for (std::size_t i = 0; i < count; ++i)
      disks.inertia.push_back(defaults.inertiaFactor * disks.mass[i] * disks.radius[i] *
                              disks.radius[i]);
  checkPositive(disks.inertia, "moment of inertia", "kg m²");
  packing.wheelAngle = in.readAttribute("wheel_angle").value_or(0.0);
  if (!std::isfinite(packing.wheelAngle)) throw bad("wheel_angle is not finite");
  packing.hash = in.readTextAttribute("hash").value_or("");
  packing.asWritten = in.isAsWritten();
  return packing;
}

}  // namespace

Packing readPacking(const std::filesystem::path& file, const Case& setup, std::size_t most) {
  const Particles& kinds = setup.particles;
  const double border = 0.5 * (kinds.smallRadius + kinds.largeRadius);
  return readPacking(
      file, {[&](double radius) { return radius < border ? kinds.smallMass : kinds.largeMass; },
             kinds.inertiaFactor, most});
}

std::optional<Packing> keptPacking(const std::filesystem::path& file, const std::string& hash,
                                   const Case& setup, std::string& why, std::size_t most) {
  if (fileFault(file) == noSuchFile) return std::nullopt;
  try {
    Packing packing = readPacking(file, setup, most);
    packing.fromCache = true;
    if (packing.asWritten && packing.hash == hash) return packing;
    why = fmt::format("{}: {}", file.string(),
                      packing.asWritten ? "is another packing"
                                        : "is not what was kept, or of an earlier version");
  } catch (const BadInput& damaged) {
    why = damaged.what();
  }
  return std::nullopt;
}

Packing readPacking(const std::filesystem::path& file, const DiskDefaults& defaults) {
  tryReading(file, [&] { readPackingFile(file, defaults); });
  try {
    return readPackingFile(file, defaults);
  } catch (const BadInput&) {
    throw;
  } catch (const std::exception& error) {  // what HDF5 makes of a damaged file
    throw BadInput(error.what());
  }
}

namespace {

struct Csv {
  enum Column : std::size_t { x, y, radius, vx, vy, spin, mass, inertia, fixed, count };
};
using Column = Csv::Column;
const std::array<std::string, Csv::count> columnNames = {"x",    "y",    "radius",  "vx",   "vy",
                                                         "spin", "mass", "inertia", "fixed"};
constexpr std::size_t neededColumns = 3;  // the first ones

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r";
  const auto begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

/// What stands between the separators, trimmed.
std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> pieces;
  for (std::size_t begin = 0;;) {
    const auto end = text.find(separator, begin);
    pieces.push_back(trimmed(text.substr(begin, end - begin)));
    if (end == std::string_view::npos) return pieces;
    begin = end + 1;
  }
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

std::vector<Column> readNames(const CsvLine& line, const std::vector<std::string_view>& names) {
  std::vector<Column> columns;
  for (const std::string_view name : names) {
    const auto found = std::ranges::find(columnNames, name);
    line.check(found != columnNames.end(), "\"{}\" is no column{}", name,
               suggestion(name, columnNames));
    const auto column = static_cast<Column>(found - columnNames.begin());
    line.check(std::ranges::find(columns, column) == columns.end(), "two columns are called {}",
               name);
    columns.push_back(column);
  }
  for (std::size_t need = 0; need < neededColumns; ++need)
    line.check(std::ranges::find(columns, need) != columns.end(), "there is no column {}",
               columnNames[need]);
  return columns;
}

double readNumber(const CsvLine& line, std::string_view text, Column column) {
  double value = 0.0;
  // Tables have a plus sign where from_chars has none.
  const bool plus = text.size() > 1 && text[0] == '+' && text[1] != '-';
  const auto [end, error] =
      std::from_chars(text.data() + (plus ? 1 : 0), text.data() + text.size(), value);
  line.check(error == std::errc() && end == text.data() + text.size() && std::isfinite(value),
             "{} = {}: must be a number", columnNames[column], text.empty() ? "nothing" : text);
  return value;
}

void readDisk(const CsvLine& line, const std::vector<Column>& columns,
              const std::vector<std::string_view>& cells, const DiskDefaults& defaults,
              Start& start) {
  line.check(cells.size() == columns.size(), "has {} values for {} columns", cells.size(),
             columns.size());
  std::array<std::optional<double>, Csv::count> values;
  for (std::size_t k = 0; k < cells.size(); ++k)
    values[columns[k]] = readNumber(line, cells[k], columns[k]);
  for (const Column column : {Csv::radius, Csv::mass, Csv::inertia})
    line.check(!values[column] || *values[column] > 0.0, "{} = {}: must be > 0",
               columnNames[column], values[column].value_or(0));
  const double isFixed = values[Csv::fixed].value_or(0.0);
  line.check(isFixed == 0.0 || isFixed == 1.0, "fixed = {}: must be 0 or 1", isFixed);
  line.check(start.disks.size() + start.fixedRadius.size() < static_cast<std::size_t>(mostDisks),
             "these are more than the {} disks that a case may have", mostDisks);
  const Vec2 position(*values[Csv::x], *values[Csv::y]);
  const double a = *values[Csv::radius];
  if (isFixed == 1.0) {
    start.fixedPosition.push_back(position);
    start.fixedRadius.push_back(a);
    start.fixedLines.push_back(line.number);
    return;
  }
  Disks& disks = start.disks;
  const double m = values[Csv::mass] ? *values[Csv::mass] : defaults.mass(a);
  start.lines.push_back(line.number);
  disks.position.push_back(position);
  disks.radius.push_back(a);
  disks.velocity.emplace_back(values[Csv::vx].value_or(0.0), values[Csv::vy].value_or(0.0));
  disks.spin.push_back(values[Csv::spin].value_or(0.0));
  disks.mass.push_back(m);
  disks.inertia.push_back(values[Csv::inertia].value_or(defaults.inertiaFactor * m * a * a));
}

Start readCsv(const std::filesystem::path& file, std::string_view text,
              const DiskDefaults& defaults) {
  constexpr std::string_view byteOrderMark = "\xEF\xBB\xBF";  // spreadsheets begin with it
  if (text.starts_with(byteOrderMark)) text.remove_prefix(byteOrderMark.size());
  Start start;
  std::vector<Column> columns;
  CsvLine line{file, 0};
  for (const std::string_view content : split(text, '\n')) {
    ++line.number;
    if (content.empty() || content.front() == '#') continue;
    const auto cells = split(content, ',');
    if (columns.empty())
      columns = readNames(line, cells);
    else
      readDisk(line, columns, cells, defaults, start);
  }
  const char* const lacks = columns.empty()           ? "line of column names, as x,y,radius"
                            : start.disks.size() == 0 ? "disks that move"
                                                      : nullptr;
  if (lacks) throw BadInput(fmt::format("{}: has no {}", file.string(), lacks));
  return start;
}

}  // namespace

Start readStart(const std::filesystem::path& file, const DiskDefaults& defaults) {
  if (file.extension() != ".csv") return {readPacking(file, defaults).disks, {}, {}};
  const auto text = readFile(file);
  if (!text) throw BadInput(fmt::format("{}: {}", file.string(), noSuchFile));
  return readCsv(file, *text, defaults);
}

}  // namespace crossgrain::inline cases
