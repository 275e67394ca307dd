#include "cases/loader_reader.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "cases/case.hpp"
#include "cases/loader_document.hpp"
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

void checkRange(const Value& value, const Range& range, double number) {
  if (std::isnan(number)) value.fail("is not a number");
  if (std::isinf(number) && !range.mayBeInfinite)
    value.fail("is infinite: must be " + range.text());
  if (!range.contains(number)) value.fail("must be " + range.text());
}

template <typename T>
T exact(const Value& value, std::string_view wanted) {
  const auto found = value.node.value_exact<T>();
  if (!found) value.failType(wanted);
  return *found;
}

template <typename Integer>
void convertInteger(const Value& value, Integer& target, const Range& range) {
  const auto found = exact<std::int64_t>(value, "a whole number");
  checkRange(value, range, static_cast<double>(found));
  if (!std::in_range<Integer>(found))
    value.fail(fmt::format("must be at most {}", std::numeric_limits<Integer>::max()));
  target = static_cast<Integer>(found);
}

template <typename Element, typename Allowed>
void convertList(const Value& value, std::vector<Element>& target, const Allowed& allowed) {
  std::vector<Element> list;
  if (const toml::array* const array = value.node.as_array()) {
    if (array->size() > longestList)
      value.fail(fmt::format("must have at most {} entries", longestList));
    for (std::size_t k = 0; k < array->size(); ++k)
      convert({*array->get(k), fmt::format("{}[{}]", value.path, k)}, list.emplace_back(), allowed);
  } else {
    convert(value, list.emplace_back(), allowed);
  }
  target = std::move(list);
}

}  // namespace

void Value::fail(std::string_view what) const {
  const std::string where = location(node.source());
  if (node.is_table()) throw BadInput(fmt::format("{}[{}]: {}", where, path, what));
  if (node.is_array() || isForeign(node.source()))
    throw BadInput(fmt::format("{}{}: {}", where, path, what));
  throw BadInput(fmt::format("{}{} = {}: {}", where, path, printValue(node), what));
}

void Value::failType(std::string_view wanted) const {
  fail(fmt::format("must be {}, is {}", wanted, typeName(node)));
}

void convert(const Value& value, bool& target, Anything) {
  target = exact<bool>(value, "true or false");
}

void convert(const Value& value, double& target, const Range& range) {
  if (!value.node.is_number()) value.failType("a number");
  // toml++ converts no whole number that no double equals; it is rounded as a decimal one is.
  const auto whole = value.node.value_exact<std::int64_t>();
  const double found = whole ? static_cast<double>(*whole) : *value.node.value_exact<double>();
  checkRange(value, range, found);
  target = found + 0.0;  // −0 is 0
}

void convert(const Value& value, int& target, const Range& range) {
  convertInteger(value, target, range);
}

void convert(const Value& value, std::uint64_t& target, const Range& range) {
  convertInteger(value, target, range);
}

void convert(const Value& value, std::string& target, Anything) {
  target = exact<std::string>(value, "a string");
}

void convert(const Value& value, std::string& target, const Sentence& sentence) {
  convert(value, target);
  if (target.find_first_not_of(" \t\r\n") == std::string::npos) value.fail(sentence.otherwise);
}

void convert(const Value& value, std::string& target, const Names& choices) {
  convert(value, target);
  if (std::ranges::find(choices, target) == choices.end())
    value.fail("unknown name" +
               (isForeign(value.node.source()) ? "" : suggestion(target, choices)));
}

void convert(const Value& value, MaterialName& target, Anything) {
  convert(value, target.name, Sentence{"a material has a name"});
  target.where = location(value.node.source()) + value.path;
}

void convert(const Value& value, std::filesystem::path& target, const ExistingFile& wanted) {
  std::string name;
  convert(value, name);
  target = (folderOf(value.node.source()) / name).lexically_normal();
  if (const std::string why = fileFault(target); !why.empty())
    value.fail(fmt::format("{} (looked for {}){}", why, target.string(),
                           nearestFile(target, wanted.extension)));
}

void convert(const Value& value, std::vector<double>& target, const Range& range) {
  convertList(value, target, range);
  if (target.empty()) value.fail("must not be empty");
}

void convert(const Value& value, Names& target, const Names& choices) {
  convertList(value, target, choices);
  std::set<std::string> seen;
  for (const std::string& name : target)
    if (!seen.insert(name).second) value.fail(fmt::format("\"{}\" is there twice", name));
}

void convert(const Value& value, Names& target, Anything all) {
  convertList(value, target, all);
}

void convert(const Value& value, std::vector<std::filesystem::path>& target,
             const ExistingFile& wanted) {
  convertList(value, target, wanted);
}

namespace {

template <int D>
void convertVector(const Value& value, VecOf<D>& target, const Range& range) {
  std::vector<double> values;
  if (value.node.is_array()) convert(value, values, range);
  if (values.size() != D)
    value.fail(fmt::format("must be {}{}{}", D == 2 ? "[x, y]" : "[x, y, z]",
                           range.unit.empty() ? "" : " in ", range.unit));
  target = VecOf<D>::Map(values.data());
}

}  // namespace

void convert(const Value& value, Vec2& target, const Range& range) {
  convertVector<2>(value, target, range);
}

void convert(const Value& value, Vec3& target, const Range& range) {
  convertVector<3>(value, target, range);
}

void convert(const Value& value, std::vector<Vec2>& target, const Range& range) {
  if (!value.node.is_array()) value.failType("a list of vectors");
  convertList(value, target, range);
}

void convert(const Value& value, std::vector<Vec3>& target, const Range& range) {
  if (!value.node.is_array()) value.failType("a list of vectors");
  convertList(value, target, range);
}

void convert(const Value& value, double (&target)[2], const Range& range) {
  std::vector<double> values;
  convert(value, values, range);
  if (values.size() > 2) value.fail("must be one number or two");
  target[0] = values.front();
  target[1] = values.back();
}

Reader::Reader(const toml::table* table, std::string path, std::string file)
    : table_(table), path_(std::move(path)), file_(std::move(file)) {}

Reader Reader::above(const Reader& base, const Names& without) const {
  Reader both = *this;
  both.below_ = base.table_;
  both.pathBelow_ = base.path_;
  both.without_ = without;
  return both;
}

const toml::node* Reader::find(std::string_view key) const {
  if (table_ && table_->contains(key)) return table_->get(key);
  const bool hidden = std::ranges::find(without_, key) != without_.end();
  return below_ && !hidden ? below_->get(key) : nullptr;
}

bool Reader::has(std::string_view key) const {
  return find(key) != nullptr;
}

bool Reader::isTable(std::string_view key) const {
  return has(key) && find(key)->is_table();
}

bool Reader::isNumber(std::string_view key) const {
  return has(key) && find(key)->is_number();
}

Names Reader::keys() const {
  Names names;
  if (table_)
    for (const auto& [key, node] : *table_) names.emplace_back(key.str());
  return names;
}

std::string Reader::pathOf(std::string_view key) const {
  const bool own = !below_ || (table_ && table_->contains(key)) || !has(key);
  const std::string& path = own ? path_ : pathBelow_;
  return path.empty() ? std::string(key) : fmt::format("{}.{}", path, key);
}

const toml::node* Reader::take(std::string_view key) {
  if (std::ranges::find(known_, key) == known_.end()) known_.emplace_back(key);
  return find(key);
}

std::string Reader::onlyOne(std::initializer_list<const char*> keys, std::string_view rule) {
  std::string given;
  for (const char* const key : keys) {
    take(key);
    if (!has(key)) continue;
    check(given.empty(), key, "stands beside {}: {}", given, rule);
    given = key;
  }
  return given;
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

void Reader::fail(std::string_view key, std::string_view message) const {
  const auto* const node = find(key);
  if (!node) failMissing(key, message);  // nothing in the file to point at
  Value{*node, pathOf(key)}.fail(message);
}

}  // namespace crossgrain::inline cases
