#include "cases/keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <map>
#include <span>

#include "cases/loader_sections.hpp"
#include "law/law_options.hpp"
#include "stability/measures.hpp"

namespace crossgrain::inline cases {
namespace {

/// "m/s^2" as "m/s²".
std::string withPowers(std::string unit) {
  for (const auto& [plain, power] : {std::pair{"^2", "²"}, {"^3", "³"}})
    if (const auto at = unit.find(plain); at != std::string::npos) unit.replace(at, 2, power);
  return unit;
}

std::string cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
    text.insert(at, 1, '\\');
  return text;
}

/// The section that gives a text first, by the text.
using FirstPlaces = std::map<std::string, std::string>;

/// The text; by its section where it is long and given before.
std::string orItsPlace(const std::string& text, const std::string& section, FirstPlaces& places) {
  constexpr std::size_t longText = 30;
  if (text.size() <= longText) return text;
  const auto [first, isNew] = places.try_emplace(text, section);
  return isNew ? text : "as in " + first->second;
}

/// Their names, as values of a key.
template <typename Named>
std::string namesOfAll(std::span<const Named> all) {
  Names names;
  for (const Named& each : all) names.emplace_back(each.name);
  return valuesOf(names);
}

/// Values with their unit: "> 0 m", "a table, m", "m"; the options of laws without their names.
std::string valuesWithUnit(const KeyInfo& key) {
  const std::string unit = key.unit == "–" ? "" : key.unit, options = namesOfAll(lawOptions());
  if (key.values.empty() || unit.empty()) {
    const bool ofLaw = key.values.starts_with(options);
    return (ofLaw ? "options of `[law]`" + key.values.substr(options.size()) : key.values) + unit;
  }
  const bool isRange = std::string_view(">[(").find(key.values.front()) != std::string::npos;
  return key.values + (isRange ? " " : ", ") + unit;
}

/// A row of a section's table.
struct Row {
  std::string keys, standard, values, meaning;
};

/// Neighbours of one default and meaning share a row, without values where these differ.
std::vector<Row> rowsOf(const SectionInfo& section, const std::string& name, FirstPlaces& places) {
  std::vector<Row> rows;
  for (const KeyInfo& key : section.keys) {
    const std::string values = orItsPlace(valuesWithUnit(key), name, places);
    const std::string meaning = orItsPlace(key.meaning, name, places);
    const std::string standard = key.standard == "–" ? "" : key.standard;
    if (!rows.empty() && !meaning.empty() && rows.back().meaning == meaning &&
        rows.back().standard == standard) {
      rows.back().keys += "`, `" + key.name;
      if (rows.back().values != values) rows.back().values.clear();
    } else {
      rows.push_back({key.name, standard, values, meaning});
    }
  }
  return rows;
}

}  // namespace

bool Range::contains(double value) const {
  if (std::isinf(value) && value > 0.0 && mayBeInfinite) return true;
  return std::isfinite(value) && !(notZero && value == 0.0) &&
         (lowOpen ? value > low : value >= low) && (highOpen ? value < high : value <= high);
}

std::string Range::interval() const {
  if (notZero) return "> 0 or < 0";
  if (std::isinf(low) && std::isinf(high)) return "";
  if (std::isinf(high)) return fmt::format("{} {}", lowOpen ? ">" : ">=", low);
  return fmt::format("{}{}, {}{}", lowOpen ? '(' : '[', low, high, highOpen ? ')' : ']');
}

std::string Range::text() const {
  const std::string which = interval(), before = std::isinf(high) || notZero ? "" : "in ";
  return (which.empty() ? "a finite number" : before + which) + (unit.empty() ? "" : " ") + unit +
         reason;
}

Range anyNumber(std::string unit) {
  return {.unit = std::move(unit)};
}

Range positive(std::string unit, std::string reason) {
  return {.low = 0.0, .lowOpen = true, .unit = std::move(unit), .reason = std::move(reason)};
}

Range above(double low, std::string unit) {
  return {.low = low, .lowOpen = true, .unit = std::move(unit)};
}

Range atLeast(double low, std::string unit) {
  return {.low = low, .unit = std::move(unit)};
}

Range between(double low, double high, std::string unit) {
  return {.low = low, .high = high, .unit = std::move(unit)};
}

Range inside(double low, double high, std::string unit) {
  return {.low = low, .high = high, .lowOpen = true, .highOpen = true, .unit = std::move(unit)};
}

Range aboveZeroTo(double high) {
  return {.low = 0.0, .high = high, .lowOpen = true};
}

std::string printed(double value) {
  return fmt::format("{}", value);
}

std::string printed(const std::string& value) {
  return value.empty() ? "–" : fmt::format("\"{}\"", value);
}

std::string printed(const Vec2& value) {
  return fmt::format("[{}, {}]", value.x(), value.y());
}

std::string printed(const Vec3& value) {
  return fmt::format("[{}, {}, {}]", value.x(), value.y(), value.z());
}

std::string printed(const std::vector<double>& values) {
  return values.empty() ? "–" : fmt::format("{}", fmt::join(values, ", "));
}

std::string printed(const Names& values) {
  return values.empty() ? "[]" : fmt::format("\"{}\"", fmt::join(values, "\", \""));
}

std::string unitOf(const Range& range) {
  return range.unit.empty() ? "–" : withPowers(range.unit);
}

std::string valuesOf(const Range& range) {
  return range.interval();
}

std::string valuesOf(const Names& names) {
  return fmt::format("{}", fmt::join(names, ", "));
}

const std::vector<SectionInfo>& caseSections() {
  static const std::vector<SectionInfo> all = [] {
    std::vector<SectionInfo> sections;
    for (const auto& part :
         {headerSections(), lawSections(), cellSections(), costSections(), runSections(),
          collisionSections(), assemblySections(), averageSections()})
      sections.insert(sections.end(), part.begin(), part.end());
    return sections;
  }();
  return all;
}

std::string keysInMarkdown() {
  std::string page =
      "## Keys\nNo default: the key is \"required\", or optional where the cell is empty. A key "
      "that is not listed does not exist. `crossgrain list keys` prints these tables.\n\n";
  FirstPlaces places = {{namesOfAll(stabilityMeasures()), "[the table](#measures-of-hard-cases)"}};
  for (const SectionInfo& section : caseSections()) {
    const std::string name = fmt::format("`{}{}{}`", section.isList ? "[[" : "[", section.name,
                                         section.isList ? "]]" : "]");
    page +=
        fmt::format("### {}{}\n", name, section.kinds.empty() ? "" : " (" + section.kinds + ")");
    if (!section.note.empty()) page += section.note + "\n";
    page += "\n| key | default | values | meaning |\n|---|---|---|---|\n";
    for (const Row& row : rowsOf(section, name, places))
      page += fmt::format("| `{}` | {} | {} | {} |\n", row.keys, cell(row.standard),
                          cell(row.values), cell(row.meaning));
    page += '\n';
  }
  page.pop_back();
  return page;
}

bool KeyUse::by(std::string_view command) const {
  return fmt::format(" {} ", commands).find(fmt::format(" {} ", command)) != std::string::npos;
}

const std::vector<KeyUse>& keyUses() {
  static const std::vector<KeyUse> uses = [] {
    std::vector<KeyUse> found;
    for (const SectionInfo& section : caseSections()) {
      const std::string name = section.name.substr(0, section.name.find(".NAME"));
      if (!section.commands.empty()) found.push_back({name, section.commands});
      for (const KeyInfo& key : section.keys)
        if (!key.commands.empty()) found.push_back({section.name + "." + key.name, key.commands});
    }
    return found;
  }();
  return uses;
}

}  // namespace crossgrain::inline cases
