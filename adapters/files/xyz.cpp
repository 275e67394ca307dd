/// Extended XYZ, as OVITO, ASE and others write it: the number of particles, a line of KEY=VALUE
/// with Properties=NAME:TYPE:COLUMNS:…, a line a particle; then the next time.
/// https://github.com/libAtoms/extxyz#extended-xyz-specification-and-parsing
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>

#include "adapters/files/readers.hpp"

namespace crossgrain::files {
namespace {

using Keys = std::map<std::string, std::string, std::less<>>;

/// KEY=VALUE KEY="several words" …, keys without capitals.
Keys keysOf(std::string_view line) {
  Keys keys;
  constexpr std::string_view blanks = " \t";
  for (std::size_t at = line.find_first_not_of(blanks); at != std::string_view::npos;
       at = line.find_first_not_of(blanks, at)) {
    std::size_t end = std::min(line.find_first_of(" \t=", at), line.size());
    const std::string key = lowered(line.substr(at, end - at));
    std::string_view value;
    if (end < line.size() && line[end] == '=') {
      const std::size_t first = end + 1;
      const bool quoted = first < line.size() && line[first] == '"';
      end = std::min(quoted ? line.find('"', first + 1) : line.find_first_of(blanks, first),
                     line.size());
      value = line.substr(first + quoted, end - first - quoted);
      if (quoted && end < line.size()) ++end;
    }
    keys.emplace(key, value);
    at = end;
  }
  return keys;
}

/// Names of the columns that are read, in the programs that write them; other columns are left out.
constexpr std::pair<std::string_view, Meaning> properties[] = {
    {"pos", Meaning::x},      {"position", Meaning::x},    {"velo", Meaning::vx},
    {"vel", Meaning::vx},     {"velocity", Meaning::vx},   {"velocities", Meaning::vx},
    {"spin", Meaning::spinX}, {"omega", Meaning::spinX},   {"angular_velocity", Meaning::spinX},
    {"id", Meaning::id},      {"radius", Meaning::radius}, {"diameter", Meaning::diameter},
    {"mass", Meaning::mass},  {"masses", Meaning::mass},   {"type", Meaning::kind}};

Columns columnsOf(const TextFile& text, std::string_view said, const ColumnOptions& options) {
  const auto parts = separatedWords(said, ':');
  std::vector<Meaning> meanings;
  for (std::size_t k = 0; k + 2 < parts.size(); k += 3) {
    int width = 0;
    const std::string_view count = parts[k + 2];
    const auto [end, error] = std::from_chars(count.data(), count.data() + count.size(), width);
    if (error != std::errc() || end != count.data() + count.size() || width < 1 || width > 100)
      text.fail(fmt::format("Properties: {} should be a number of columns", count));
    const std::string own = lowered(parts[k]);
    const auto* const known =
        std::ranges::find(properties, own, [](const auto& one) { return one.first; });
    for (int column = 0; column < width; ++column) {
      const auto asked = options.of(width == 1 ? std::string(parts[k])
                                               : fmt::format("{}[{}]", parts[k], column + 1));
      const bool isKnown = known != std::end(properties) && parts[k + 1] != "S" && column < 3;
      meanings.push_back(
          asked.value_or(isKnown ? following(known->second, column) : Meaning::none));
    }
  }
  if (parts.size() < 3 || parts.size() % 3 != 0)
    text.fail(fmt::format("Properties={} should be NAME:TYPE:COLUMNS, again and again", said));
  Columns columns(std::move(meanings));
  columns.checkDistinct(text);
  if (!columns.has(Meaning::x)) text.fail("Properties has no pos:R:3");
  return columns;
}

/// Along x, y, z; where it says pbc, which says nothing of the case's otherwise.
std::optional<FileBox> boxOf(const TextFile& text, const Keys& keys) {
  const auto lattice = keys.find("lattice"), pbc = keys.find("pbc");
  if (lattice == keys.end() || pbc == keys.end()) return {};
  const auto sides = words(lattice->second), periodic = words(pbc->second);
  if (sides.size() != 9 || periodic.size() != 3)
    text.fail("Lattice should have nine numbers, pbc three of T and F");
  const auto origin = keys.find("origin");
  const auto from = origin == keys.end() ? std::vector<std::string_view>{} : words(origin->second);
  FileBox box;
  for (std::size_t k = 0; k < 9; ++k) {
    const double side = numberOf(text, sides[k], "Lattice");
    const auto axis = static_cast<int>(k / 3);
    if (k % 4 != 0 && side != 0.0)
      text.fail("Lattice is tilted: the sides of a box should lie along x, y and z");
    if (k % 4 != 0) continue;
    if (from.size() == 3)
      box.low[axis] = numberOf(text, from[static_cast<std::size_t>(axis)], "Origin");
    box.high[axis] = box.low[axis] + side;
    const std::string_view word = periodic[static_cast<std::size_t>(axis)];
    box.periodic[axis] = word == "T" || word == "1" || word == "True";
    box.saidFixed[axis] = !box.periodic[axis];
  }
  return box;
}

/// @param alone  there is no other file
void addTime(const TextFile& text, const Keys& keys, bool alone, FileFrame& frame) {
  for (const char* const name : {"time", "t"})
    if (const auto found = keys.find(name); found != keys.end() && !frame.time)
      frame.time = numberOf(text, found->second, name);
  for (const char* const name : {"timestep", "step", "frame"})
    if (const auto found = keys.find(name); found != keys.end() && !frame.step)
      frame.step = wholeNumber(text, numberOf(text, found->second, name), name);
  if (frame.time)
    frame.where += fmt::format(", t = {}", *frame.time);
  else if (frame.step)
    frame.where += fmt::format(", step {}", *frame.step);
  if (frame.time || frame.step) return;
  frame.step = numberInName(text.path());
  frame.alone = alone;
  if (!frame.step && !frame.alone)
    text.fail("there is neither Time= nor Timestep= beside Properties=, and no number in the name");
}

Part readTime(TextFile& text, const ColumnOptions& options, bool alone) {
  Part part;
  FileFrame& frame = part.frame;
  const std::string_view first = text.need("the number of particles");
  const std::int64_t claimed =
      wholeNumber(text, numberOf(text, first, "the number of particles"), "their number");
  if (claimed < 0) text.fail("the number of particles should be 0 or more");
  const Keys keys = keysOf(text.need("the line of Properties=…"));
  const auto said = keys.find("properties");
  if (said == keys.end())
    text.fail("Properties= is missing: it says what the columns are (extended XYZ)");
  Columns columns = columnsOf(text, said->second, options);
  frame.where = text.path().string();
  addTime(text, keys, alone, frame);
  frame.box = boxOf(text, keys);
  const std::size_t rows = text.rows(claimed, columns.count());
  reserve(frame.particles, columns, rows);
  for (std::size_t k = 0; k < rows; ++k) {
    text.need("a particle");
    columns.read(text, ' ');
    addParticle(frame.particles, columns, text);
  }
  return part;
}

}  // namespace

double firstTimeOfXyz(const std::filesystem::path& file) {
  TextFile text(file);
  text.need("the number of particles");
  const Keys keys = keysOf(text.need("the line of Properties=…"));
  for (const char* const name : {"time", "t", "timestep", "step", "frame"})
    if (const auto found = keys.find(name); found != keys.end())
      return numberOf(text, found->second, name);
  return static_cast<double>(numberInName(file).value_or(0));
}

std::unique_ptr<FrameReader> openXyz(const Files& files, const FileOptions& options) {
  const auto columns = std::make_shared<const ColumnOptions>(options.columns);
  auto times = [columns, box = options.box, alone = files.size() == 1](TextFile& text) {
    Part part = readTime(text, *columns, alone);
    if (!part.frame.box) part.frame.box = box;
    return part;
  };
  return joinParts(std::make_unique<TextParts>(files, std::move(times)), {}, columns);
}

}  // namespace crossgrain::files
