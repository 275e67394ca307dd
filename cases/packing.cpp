#include "cases/packing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "cases/couette.hpp"
#include "cases/preparation.hpp"
#include "law/law_options.hpp"
#include "support/bad_input.hpp"
#include "support/files.hpp"
#include "support/fingerprint.hpp"
#include "support/hdf5_file.hpp"
#include "support/input_file.hpp"
#include "support/nearest.hpp"

namespace crossgrain::inline cases {

namespace {

template <int D>
std::vector<VecOf<D>> asVectors(const std::vector<double>& values) {
  std::vector<VecOf<D>> vectors;
  for (std::size_t i = 0; i + D <= values.size(); i += D)
    vectors.emplace_back(VecOf<D>::Map(&values[i]));
  return vectors;
}

/// Angular velocities, one number or three each.
template <int D>
std::vector<SpinOf<D>> asSpins(std::vector<double> values) {
  if constexpr (D == 2)
    return values;
  else
    return asVectors<3>(values);
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
  const DisksOf<3>& spheres = packing.spheres;
  for (const auto* values : {&spheres.radius, &spheres.mass, &spheres.inertia}) add(*values);
  for (const auto* values : {&spheres.position, &spheres.velocity, &spheres.spin}) add(*values);
  add(disks.turn);
  add(spheres.turn);
  add(disks.shape);
  add(spheres.shape);
  std::string hash = fmt::format("{:016x} {}", fnv1a(bytes), packing.wheelAngle);
  if (packing.wallTime != 0.0) hash += fmt::format(" {}", packing.wallTime);
  if (!packing.fixed.empty()) hash += " fixed " + packing.fixed;
  return hash;
}

std::string packingHash(const Case& setup, int index, double dt) {
  // The leading tag changes whenever the preparation itself does.
  std::string text = fmt::format("preparation 2; dt {};", couetteIn(setup).filling.dt.value_or(dt));
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
    const Particles& disks = couetteIn(setup).particles;
    for (const MaterialName* each :
         {&disks.smallMaterial, &disks.largeMaterial, &couetteIn(setup).cell.wheelMaterial,
          &couetteIn(setup).cell.ringMaterial})
      text += fmt::format(" {};", std::ranges::find(setup.materials->names, each->name) -
                                      setup.materials->names.begin());
  }
  if (setup.bottom)
    text += fmt::format("bottom {} {} {} {} {} {};", setup.bottom->mu, setup.bottom->kb,
                        setup.bottom->gb, setup.bottom->tauM, setup.bottom->gravity,
                        setup.bottom->spin);
  const Cell& cell = couetteIn(setup).cell;
  text += fmt::format("cell {} {} {} {} {} {};", cell.innerRadius, cell.outerRadius,
                      cell.wallRadius, wallDiskCount(cell, cell.innerRadius),
                      wallDiskCount(cell, cell.outerRadius), cell.omega);
  const Particles& disks = couetteIn(setup).particles;
  text += fmt::format("disks {} {} {} {} {} {} {};", disks.small, disks.large, disks.smallRadius,
                      disks.largeRadius, disks.smallMass, disks.largeMass, disks.inertiaFactor);
  if (!disks.rotation) text += "no rotation;";
  const Filling& how = couetteIn(setup).filling;
  text += fmt::format("prepare {} {} {} {} {}", setup.preparation.seed, how.dilation, how.velocity,
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

template <int D>
Packing readPackingFile(const std::filesystem::path& file, const DiskDefaults& defaults) {
  constexpr unsigned vector = D, spins = D == 2 ? 1 : 3;  // columns
  const auto bad = [&](const std::string& what) {
    return BadInput(fmt::format("{}: {}", file.string(), what));
  };
  const Hdf5File in = Hdf5File::open(file);
  for (const auto& [name, columns] : {std::pair{"radius", 1u},
                                      {"position", vector},
                                      {"velocity", vector},
                                      {"spin", spins},
                                      {"mass", 1u},
                                      {"inertia", 1u}})
    if (const auto count = in.length(name); count && *count > columns * defaults.most)
      throw bad(fmt::format("{} has {} values: a case may have at most {} disks", name, *count,
                            defaults.most));
  const auto radius = in.read("radius");
  const auto position = in.read("position");
  if (!radius || !position)
    throw bad(fmt::format("a packing needs the datasets radius (N) and position (N x {})", D));
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
  DisksOf<D>& disks = disksIn<D>(packing);
  disks.radius = *sized("radius", 1);
  checkPositive(disks.radius, "radius", "m");
  const auto orZero = [&](const char* name, unsigned columns) {
    return sized(name, columns).value_or(std::vector<double>(columns * count, 0.0));
  };
  disks.position = asVectors<D>(*sized("position", vector));
  disks.velocity = asVectors<D>(orZero("velocity", vector));
  disks.spin = asSpins<D>(orZero("spin", spins));
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
  const Particles& kinds = couetteIn(setup).particles;
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

template <int D>
Packing readPacking(const std::filesystem::path& file, const DiskDefaults& defaults) {
  tryReading(file, [&] { readPackingFile<D>(file, defaults); });
  try {
    return readPackingFile<D>(file, defaults);
  } catch (const BadInput&) {
    throw;
  } catch (const std::exception& error) {  // what HDF5 makes of a damaged file
    throw BadInput(error.what());
  }
}
template Packing readPacking<2>(const std::filesystem::path&, const DiskDefaults&);

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
      line.check(isUnit(given), "qw, qx, qy, qz: must be of length 1, which is {:g}", given.norm());
      const Eigen::Quaterniond unit = given.normalized();
      turn = {unit.w(), unit.x(), unit.y(), unit.z()};
    }
  }
  disks.shape.push_back(index);
  disks.turn.push_back(own ? ownTurn<D>(own->frame, turn) : turn);
  const double mass = disks.mass.back(), reach = disks.radius.back();
  const auto& inertia = values[Columns::inertia];
  Vec3 moments = Vec3::Constant(disks.inertia.back());
  if constexpr (D == 2) {
    line.check(!own || !inertia || *inertia <= mass * reach * reach,
               "inertia = {}: is more than a body of {:g} kg that reaches {:g} m can have",
               inertia.value_or(0.0), mass, reach);
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
  line.check(!own || !values[Columns::radius], "shape = {}: and a radius: give one of them", shape);
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
