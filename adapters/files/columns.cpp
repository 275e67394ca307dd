#include "adapters/files/columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <iterator>

#include "support/bad_input.hpp"
#include "support/nearest.hpp"

namespace crossgrain::files {
namespace {

/// Of CSV files, of start files of ours, and what LAMMPS and YADE users call the same: the name of
/// each meaning. Parts of a box have none.
// clang-format off
constexpr std::array<std::string_view, static_cast<std::size_t>(Meaning::count)> names = {
  "time", "step", "id", "kind", "x", "y", "z", "", "", "", "radius", "diameter", "vx", "vy", "vz",
  "spin_x", "spin_y", "spin_z", "mass", "first", "second", "nx", "ny", "nz",
  "branch_x", "branch_y", "branch_z", "fx", "fy", "fz", "tx", "ty", "tz",
  "normal_force", "tangential_force", "px", "py", "pz", "overlap",
  "rolling_x", "rolling_y", "rolling_z", "torque_x", "torque_y", "torque_z",
  "rolling_force_x", "rolling_force_y", "rolling_force_z", "wall"};
// clang-format on
static_assert(names[static_cast<std::size_t>(Meaning::wall)] == "wall");

struct Name {
  std::string_view name;
  Meaning meaning;
};

/// Further names, each listed before that of the first meaning of its kind.
constexpr Name others[] = {
    {"t", Meaning::time}, {"spin", Meaning::spinZ}, {"rolling", Meaning::rollingZ}};

/// Names of vectors, of which a group of three columns is.
constexpr Name vectors[] = {{"position", Meaning::x},     {"velocity", Meaning::vx},
                            {"spin", Meaning::spinX},     {"normal", Meaning::nx},
                            {"branch", Meaning::branchX}, {"force", Meaning::fx},
                            {"tangential", Meaning::tx},  {"point", Meaning::px},
                            {"torque", Meaning::torqueX}, {"rolling", Meaning::rollingX}};

}  // namespace

std::string lowered(std::string_view name) {
  std::string text(name);
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

Meaning meaningOf(std::string_view name) {
  const std::string own = name == "T" ? std::string(name) : lowered(name);
  if (const auto* const other = std::ranges::find(others, own, &Name::name);
      other != std::end(others))
    return other->meaning;
  const auto* const found = std::ranges::find(names, own);
  return own.empty() || found == names.end() ? Meaning::none
                                             : static_cast<Meaning>(found - names.begin());
}

std::string suggestedMeaning(std::string_view name) {
  constexpr std::pair<std::string_view, std::string_view> ofOthers[] = {
      {"r", "radius"},       {"rad", "radius"},     {"radii", "radius"},   {"d", "diameter"},
      {"m", "mass"},         {"v_x", "vx"},         {"v_y", "vy"},         {"v_z", "vz"},
      {"omega_x", "spin_x"}, {"omega_y", "spin_y"}, {"omega_z", "spin_z"}, {"omegax", "spin_x"},
      {"omegay", "spin_y"},  {"omegaz", "spin_z"},  {"w_x", "spin_x"},     {"w_y", "spin_y"},
      {"w_z", "spin_z"},     {"f_x", "fx"},         {"f_y", "fy"},         {"f_z", "fz"},
      {"id1", "first"},      {"id2", "second"},     {"delta", "overlap"}};
  const auto* const known =
      std::ranges::find(ofOthers, lowered(name), [](const auto& one) { return one.first; });
  if (known != std::end(ofOthers)) return fmt::format(" (did you mean {}?)", known->second);
  return suggestion(name, meaningNames());
}

const std::vector<std::string>& meaningNames() {
  static const std::vector<std::string> all = [] {
    std::vector<std::string> list;
    for (const std::string_view name : names) {
      for (const Name& other : others)
        if (name == "time" ? other.name == "t" : name == fmt::format("{}_x", other.name))
          list.emplace_back(other.name);
      if (!name.empty()) list.emplace_back(name);
    }
    return list;
  }();
  return all;
}

ColumnOptions::ColumnOptions(const std::string& option) {
  for (const std::string_view item : words(option)) {
    const std::size_t equals = item.find('=');
    if (equals == 0 || equals == std::string_view::npos || equals + 1 == item.size())
      throw BadInput(
          fmt::format("columns: \"{}\" should be NAME=MEANING, or NAME=MEANING,MEANING,… of "
                      "NAME[1], NAME[2], …",
                      item));
    Given& given = given_.emplace_back();
    given.name = item.substr(0, equals);
    for (const std::string_view word : separatedWords(item.substr(equals + 1)))
      given.words.emplace_back(word);
  }
}

const std::vector<std::string>* ColumnOptions::wordsOf(std::string_view name) const {
  const auto found = std::ranges::find(given_, name, &Given::name);
  if (found == given_.end()) return nullptr;
  found->used = true;
  return &found->words;
}

std::optional<Meaning> ColumnOptions::of(std::string_view name) const {
  auto [array, index] = splitIndex(name);
  const std::vector<std::string>* said = wordsOf(name);
  if (said)
    index = 1;
  else
    said = wordsOf(array);
  if (!said) return std::nullopt;
  std::size_t column = 0;
  for (const std::string& word : *said) {
    const auto* const vector = std::ranges::find(vectors, word, &Name::name);
    const bool isVector = vector != std::end(vectors) && said->size() > 1;
    const std::size_t width = isVector ? 3 : 1;
    if (word != "-" && !isVector && meaningOf(word) == Meaning::none)
      throw BadInput(fmt::format("columns: {}={}: there is no such meaning{}", name, word,
                                 suggestedMeaning(word)));
    if (index > column && index <= column + width) {
      if (word == "-") return Meaning::none;
      return isVector ? following(vector->meaning, static_cast<int>(index - column) - 1)
                      : meaningOf(word);
    }
    column += width;
  }
  return Meaning::none;
}

void ColumnOptions::checkUsed(const std::string& files) const {
  for (const Given& one : given_)
    if (!one.used) throw BadInput(fmt::format("columns: {} has no column {}", files, one.name));
}

std::pair<std::string_view, std::size_t> splitIndex(std::string_view name) {
  const std::size_t open = name.find('[');
  std::size_t k = 0;
  if (open == std::string_view::npos || name.back() != ']') return {name, 0};
  const char* const last = name.data() + name.size() - 1;
  const auto [end, error] = std::from_chars(name.data() + open + 1, last, k);
  if (error != std::errc() || end != last || k == 0) return {name, 0};
  return {name.substr(0, open), k};
}

Columns::Columns(std::vector<Meaning> meanings) {
  for (const Meaning meaning : meanings) places_.push_back(static_cast<std::uint8_t>(meaning));
}

bool Columns::has(Meaning meaning) const {
  return std::ranges::find(places_, static_cast<std::uint8_t>(meaning)) != places_.end();
}

bool Columns::hasVector(Meaning first) const {
  return has(first) || has(following(first, 1)) || has(following(first, 2));
}

void Columns::addMissing(Meaning first, std::vector<MissingComponent>& missing) const {
  const bool scaled = first == Meaning::x && hasVector(Meaning::scaledX);
  if (!hasVector(first) && !scaled) return;
  const bool axial =
      first == Meaning::spinX || first == Meaning::rollingX || first == Meaning::torqueX;
  for (int axis = 0; axis < 3; ++axis) {
    const Meaning own = following(first, axis);
    if (has(own) || (scaled && has(following(Meaning::scaledX, axis)))) continue;
    missing.push_back({std::string(names[static_cast<std::size_t>(own)]), axis, axial});
  }
}

void Columns::checkDistinct(const TextFile& text) const {
  for (const auto& [first, names] : {std::pair(Meaning::x, "x, y"), {Meaning::vx, "vx, vy"}})
    if (has(first) != has(following(first, 1)))
      text.fail(fmt::format("one of {} is missing: both are needed", names));
  for (std::size_t k = 0; k < places_.size(); ++k)
    for (std::size_t l = 0; l < k; ++l)
      if (places_[k] == places_[l] && places_[k] != unread)
        text.fail(fmt::format("columns {} and {} are the same thing: only one of them can be read",
                              l + 1, k + 1));
}

Vec3 Columns::vector(Meaning first) const {
  return {(*this)[first], (*this)[following(first, 1)], (*this)[following(first, 2)]};
}

void reserve(FileParticles& particles, const Columns& columns, std::size_t rows) {
  particles.id.reserve(rows);
  particles.position.reserve(rows);
  if (columns.has(Meaning::radius) || columns.has(Meaning::diameter))
    particles.radius.reserve(rows);
  if (columns.has(Meaning::vx)) particles.velocity.reserve(rows);
  if (columns.hasVector(Meaning::spinX)) particles.spin.reserve(rows);
  if (columns.has(Meaning::mass)) particles.mass.reserve(rows);
  if (columns.has(Meaning::kind)) particles.kind.reserve(rows);
}

void addParticle(FileParticles& particles, const Columns& columns, const TextFile& text) {
  const std::size_t row = particles.size();
  particles.id.push_back(columns.has(Meaning::id) ? wholeNumber(text, columns[Meaning::id], "id")
                                                  : static_cast<std::int64_t>(row));
  if (particles.id.back() < 0) text.fail("id: should be 0 or more");
  if (row == 0) {
    particles.firstLine = text.number();
    for (const Meaning vector : {Meaning::x, Meaning::vx, Meaning::spinX})
      columns.addMissing(vector, particles.missing);
  }
  particles.lastLine = text.number();
  particles.position.push_back(columns.vector(Meaning::x));
  if (columns.has(Meaning::radius))
    particles.radius.push_back(columns[Meaning::radius]);
  else if (columns.has(Meaning::diameter))
    particles.radius.push_back(0.5 * columns[Meaning::diameter]);
  if (columns.has(Meaning::vx)) particles.velocity.push_back(columns.vector(Meaning::vx));
  if (columns.hasVector(Meaning::spinX)) particles.spin.push_back(columns.vector(Meaning::spinX));
  if (columns.has(Meaning::mass)) particles.mass.push_back(columns[Meaning::mass]);
  if (columns.has(Meaning::kind))
    particles.kind.push_back(wholeNumber(text, columns[Meaning::kind], "type"));
}

}  // namespace crossgrain::files
