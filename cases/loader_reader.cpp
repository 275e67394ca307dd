#include "cases/loader_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "cases/loader_document.hpp"
#include "cases/loader_print.hpp"
#include "support/input_file.hpp"
#include "support/nearest.hpp"

namespace crossgrain::inline cases {
namespace {

constexpr std::size_t longestList = 10'000;

std::string typeName(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "a list";
    case toml::node_type::string:
      return "a string";
    case toml::node_type::integer:
      return "a whole number";
    case toml::node_type::floating_point:
      return "a decimal number";
    case toml::node_type::boolean:
      return "a boolean";
    default:
      return "a date or time";
  }
}

/// One value under its full path, e.g. "run.may_differ[2]".
struct Value {
  const toml::node& node;
  std::string path;

  [[noreturn]] void fail(std::string_view what) const {
    const std::string where = location(node.source());
    if (node.is_table()) throw BadInput(fmt::format("{}[{}]: {}", where, path, what));
    // What a file outside the case's own folder holds is nobody's business but its owner's.
    const bool quoted = !node.is_array() && !isForeign(node.source());
    if (!quoted) throw BadInput(fmt::format("{}{}: {}", where, path, what));
    throw BadInput(fmt::format("{}{} = {}: {}", where, path, printValue(node), what));
  }
  [[noreturn]] void failType(std::string_view wanted) const {
    fail(fmt::format("must be {}, is {}", wanted, typeName(node)));
  }
  void check(const Range& range, double value) const {
    if (std::isnan(value)) fail("is not a number");
    if (std::isinf(value) && !range.mayBeInfinite) fail("is infinite: must be " + range.text());
    if (!range.contains(value)) fail("must be " + range.text());
  }
};

void convert(const Value& value, bool& target) {
  const auto found = value.node.value_exact<bool>();
  if (!found) value.failType("true or false");
  target = *found;
}

void convert(const Value& value, double& target, const Range& range) {
  if (!value.node.is_number()) value.failType("a number");
  // Of a whole number that no double is toml++ gives none; it is rounded as a decimal one is.
  const auto whole = value.node.value_exact<std::int64_t>();
  const double found = whole ? static_cast<double>(*whole) : *value.node.value_exact<double>();
  value.check(range, found);
  target = found + 0.0;  // −0 is 0
}

template <typename Integer>
void convertInteger(const Value& value, Integer& target, const Range& range) {
  const auto found = value.node.value_exact<std::int64_t>();
  if (!found) value.failType("a whole number");
  value.check(range, static_cast<double>(*found));
  if (!std::in_range<Integer>(*found))
    value.fail(fmt::format("must be at most {}", std::numeric_limits<Integer>::max()));
  target = static_cast<Integer>(*found);
}

void convert(const Value& value, std::string& target) {
  const auto found = value.node.value_exact<std::string>();
  if (!found) value.failType("a string");
  target = *found;
}

void convert(const Value& value, std::string& target, std::span<const std::string> choices) {
  convert(value, target);
  if (std::ranges::find(choices, target) == choices.end())
    value.fail("unknown name" +
               (isForeign(value.node.source()) ? "" : suggestion(target, choices)));
}

/// Of a text that may be anything.
struct AnyText {};
void convert(const Value& value, std::string& target, AnyText) {
  convert(value, target);
}

template <typename Element, typename Constraint>
void convertList(const Value& value, std::vector<Element>& target, const Constraint& constraint) {
  std::vector<Element> list;
  if (const toml::array* const array = value.node.as_array()) {
    if (array->size() > longestList)
      value.fail(fmt::format("must have at most {} entries", longestList));
    for (std::size_t k = 0; k < array->size(); ++k)
      convert({*array->get(k), fmt::format("{}[{}]", value.path, k)}, list.emplace_back(),
              constraint);
  } else {
    convert(value, list.emplace_back(), constraint);
  }
  target = std::move(list);
}

}  // namespace

bool Range::contains(double value) const {
  if (std::isinf(value) && value > 0.0 && mayBeInfinite) return true;
  return std::isfinite(value) && !(notZero && value == 0.0) &&
         (lowOpen ? value > low : value >= low) && (highOpen ? value < high : value <= high);
}

std::string Range::text() const {
  const std::string tail = unit.empty() ? "" : " " + unit;
  if (notZero) return "> 0 or < 0" + tail;
  if (std::isinf(low) && std::isinf(high)) return "a finite number" + tail;
  if (std::isinf(high)) return fmt::format("{} {}{}", lowOpen ? ">" : ">=", low, tail);
  return fmt::format("in {}{}, {}{}{}", lowOpen ? '(' : '[', low, high, highOpen ? ')' : ']', tail);
}

Range positive(std::string unit) {
  return above(0.0, std::move(unit));
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
  return {.low = 0.0, .high = high, .lowOpen = true, .unit = {}};
}

Range eitherSign(std::string unit) {
  return {.unit = std::move(unit), .notZero = true};
}

Reader::Reader(const toml::table* table, std::string path, std::string file)
    : table_(table), path_(std::move(path)), file_(std::move(file)) {}

bool Reader::has(std::string_view key) const {
  return table_ && table_->contains(key);
}

std::vector<std::string> Reader::keys() const {
  std::vector<std::string> names;
  if (table_)
    for (const auto& [key, node] : *table_) names.emplace_back(key.str());
  return names;
}

std::string Reader::pathOf(std::string_view key) const {
  return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

const toml::node* Reader::take(std::string_view key) {
  if (std::ranges::find(known_, key) == known_.end()) known_.emplace_back(key);
  return table_ ? table_->get(key) : nullptr;
}

void Reader::read(std::string_view key, bool& target) {
  if (const toml::node* const node = take(key)) convert({*node, pathOf(key)}, target);
}

void Reader::read(std::string_view key, double& target, const Range& range) {
  if (const toml::node* const node = take(key)) convert({*node, pathOf(key)}, target, range);
}

void Reader::read(std::string_view key, int& target, const Range& range) {
  if (const toml::node* const node = take(key)) convertInteger({*node, pathOf(key)}, target, range);
}

void Reader::read(std::string_view key, std::uint64_t& target, const Range& range) {
  if (const toml::node* const node = take(key)) convertInteger({*node, pathOf(key)}, target, range);
}

void Reader::read(std::string_view key, std::string& target) {
  if (const toml::node* const node = take(key)) convert({*node, pathOf(key)}, target);
}

void Reader::read(std::string_view key, std::string& target, std::span<const std::string> choices) {
  if (const toml::node* const node = take(key)) convert({*node, pathOf(key)}, target, choices);
}

void Reader::read(std::string_view key, std::vector<double>& target, const Range& range) {
  const toml::node* const node = take(key);
  if (!node) return;
  convertList({*node, pathOf(key)}, target, range);
  if (target.empty()) fail(key, "must not be empty");
}

void Reader::read(std::string_view key, std::vector<std::string>& target,
                  std::span<const std::string> choices) {
  const toml::node* const node = take(key);
  if (!node) return;
  convertList({*node, pathOf(key)}, target, choices);
  std::set<std::string> seen;
  for (const std::string& name : target)
    if (!seen.insert(name).second) fail(key, fmt::format("\"{}\" is there twice", name));
}

void Reader::read(std::string_view key, std::vector<std::string>& target) {
  if (const toml::node* const node = take(key))
    convertList({*node, pathOf(key)}, target, AnyText{});
}

void Reader::requireText(std::string_view key, std::string& target, std::string_view otherwise) {
  require(key, target);
  if (has(key) && target.find_first_not_of(" \t\r\n") == std::string::npos) fail(key, otherwise);
}

std::optional<std::filesystem::path> Reader::readFile(std::string_view key,
                                                      const std::string& extension) {
  if (!has(key)) {
    take(key);
    return std::nullopt;
  }
  std::string name;
  read(key, name);
  return fileNamed(key, name, extension);
}

void Reader::read(std::string_view key, std::vector<std::filesystem::path>& target,
                  const std::string& extension) {
  std::vector<std::string> names;
  read(key, names);
  for (const std::string& name : names) target.push_back(fileNamed(key, name, extension));
}

std::filesystem::path Reader::fileNamed(std::string_view key, const std::string& name,
                                        const std::string& extension) const {
  const toml::node& node = *table_->get(key);
  const std::filesystem::path file = (folderOf(node.source()) / name).lexically_normal();
  if (const std::string why = whyNoFile(file); !why.empty())
    fail(key,
         fmt::format("{} (looked for {}){}", why, file.string(), nearestFile(file, extension)));
  return file;
}

bool Reader::isTable(std::string_view key) const {
  return has(key) && table_->get(key)->is_table();
}

bool Reader::isNumber(std::string_view key) const {
  return has(key) && table_->get(key)->is_number();
}

Reader Reader::section(std::string_view key) {
  const toml::node* const node = take(key);
  if (node && !node->is_table()) Value{*node, pathOf(key)}.failType("a table");
  return {node ? node->as_table() : nullptr, pathOf(key), file_};
}

std::vector<Reader> Reader::sections(std::string_view key) {
  const toml::node* const node = take(key);
  if (!node) return {};
  const toml::array* const array = node->as_array();
  if (!array) Value{*node, pathOf(key)}.failType("a list of tables");
  std::vector<Reader> tables;
  for (std::size_t k = 0; k < array->size(); ++k) {
    const toml::node& each = *array->get(k);
    const std::string path = fmt::format("{}[{}]", pathOf(key), k);
    if (!each.is_table()) Value{each, path}.failType("a table");
    tables.push_back({each.as_table(), path, file_});
  }
  return tables;
}

void Reader::finish() const {
  if (table_)
    for (const auto& [key, node] : *table_)
      if (std::ranges::find(known_, key.str()) == known_.end())
        throw BadInput(isForeign(key.source())
                           ? location(key.source()) + "a key that no case has"
                           : fmt::format("{}unknown key {}{}", location(key.source()),
                                         pathOf(key.str()), suggestion(key.str(), known_)));
  if (!missing_.empty()) failMissing(missing_.front());
}

void Reader::failMissing(std::string_view key, std::string_view reason) const {
  const std::string where = table_ ? location(table_->source()) : file_ + ": ";
  throw BadInput(
      fmt::format("{}{} is missing{}{}", where, pathOf(key), reason.empty() ? "" : ": ", reason));
}

void Reader::fail(std::string_view key, std::string_view what) const {
  Value{*table_->get(key), pathOf(key)}.fail(what);
}

}  // namespace crossgrain::inline cases
