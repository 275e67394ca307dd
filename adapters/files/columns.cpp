#include "adapters/files/columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <iterator>

#include "support/bad_input.hpp"
#include "support/nearest.hpp"

namespace crossgrain::files {
namespace {

struct Name {
  std::string_view name;
  Meaning meaning;
};

/// Of CSV files, of start files of ours, and what LAMMPS and YADE users call the same.
constexpr Name names[] = {{"t", Meaning::time},
                          {"time", Meaning::time},
                          {"step", Meaning::step},
                          {"id", Meaning::id},
                          {"kind", Meaning::kind},
                          {"x", Meaning::x},
                          {"y", Meaning::y},
                          {"z", Meaning::z},
                          {"radius", Meaning::radius},
                          {"diameter", Meaning::diameter},
                          {"vx", Meaning::vx},
                          {"vy", Meaning::vy},
                          {"vz", Meaning::vz},
                          {"spin", Meaning::spinZ},
                          {"spin_x", Meaning::spinX},
                          {"spin_y", Meaning::spinY},
                          {"spin_z", Meaning::spinZ},
                          {"mass", Meaning::mass},
                          {"first", Meaning::first},
                          {"second", Meaning::second},
                          {"nx", Meaning::nx},
                          {"ny", Meaning::ny},
                          {"nz", Meaning::nz},
                          {"branch_x", Meaning::branchX},
                          {"branch_y", Meaning::branchY},
                          {"branch_z", Meaning::branchZ},
                          {"fx", Meaning::fx},
                          {"fy", Meaning::fy},
                          {"fz", Meaning::fz},
                          {"tx", Meaning::tx},
                          {"ty", Meaning::ty},
                          {"tz", Meaning::tz},
                          {"normal_force", Meaning::normalForce},
                          {"tangential_force", Meaning::tangentialForce},
                          {"px", Meaning::px},
                          {"py", Meaning::py},
                          {"pz", Meaning::pz},
                          {"overlap", Meaning::overlap},
                          {"rolling", Meaning::rollingZ},
                          {"rolling_x", Meaning::rollingX},
                          {"rolling_y", Meaning::rollingY},
                          {"rolling_z", Meaning::rollingZ},
                          {"torque_x", Meaning::torqueX},
                          {"torque_y", Meaning::torqueY},
                          {"torque_z", Meaning::torqueZ},
                          {"rolling_force_x", Meaning::pseudoX},
                          {"rolling_force_y", Meaning::pseudoY},
                          {"rolling_force_z", Meaning::pseudoZ},
                          {"wall", Meaning::wall}};

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
  const auto* const found = std::ranges::find(names, own, &Name::name);
  return found == std::end(names) ? Meaning::none : found->meaning;
}

std::string suggestedMeaning(std::string_view name) {
  constexpr std::pair<std::string_view, std::string_view> others[] = {
      {"r", "radius"},       {"rad", "radius"},     {"radii", "radius"},   {"d", "diameter"},
      {"m", "mass"},         {"v_x", "vx"},         {"v_y", "vy"},         {"v_z", "vz"},
      {"omega_x", "spin_x"}, {"omega_y", "spin_y"}, {"omega_z", "spin_z"}, {"omegax", "spin_x"},
      {"omegay", "spin_y"},  {"omegaz", "spin_z"},  {"w_x", "spin_x"},     {"w_y", "spin_y"},
      {"w_z", "spin_z"},     {"f_x", "fx"},         {"f_y", "fy"},         {"f_z", "fz"},
      {"id1", "first"},      {"id2", "second"},     {"delta", "overlap"}};
  const auto* const known =
      std::ranges::find(others, lowered(name), [](const auto& one) { return one.first; });
  if (known != std::end(others)) return fmt::format(" (did you mean {}?)", known->second);
  return suggestion(name, meaningNames());
}

const std::vector<std::string>& meaningNames() {
  static const std::vector<std::string> all = [] {
    std::vector<std::string> list;
    for (const Name& one : names) list.emplace_back(one.name);
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
    const auto found = std::find_if(std::rbegin(names), std::rend(names),
                                    [&](const Name& one) { return one.meaning == own; });
    missing.push_back({std::string(found->name), axis, axial});
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
