#include "adapters/worker/exchange_difference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "adapters/worker/answer.hpp"
#include "adapters/worker/arrays.hpp"
#include "support/files.hpp"

namespace crossgrain {
namespace {

using nlohmann::json;

/// The arrays of one answer, contacts in the order of their ids.
struct Arrays {
  std::vector<std::string> names;  ///< in the answer's order
  std::map<std::string, std::vector<double>> values;
  std::vector<std::pair<double, double>> contacts;  ///< ids
};

void sortContacts(Arrays& arrays) {
  const auto i = arrays.values.find("contacts.i"), j = arrays.values.find("contacts.j");
  if (i == arrays.values.end() || j == arrays.values.end()) return;
  const std::size_t count = i->second.size();
  if (j->second.size() != count) return;
  for (std::size_t k = 0; k < count; ++k) arrays.contacts.emplace_back(i->second[k], j->second[k]);
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return arrays.contacts[k]; });
  std::ranges::sort(arrays.contacts);
  for (auto& [name, values] : arrays.values) {
    if (!name.starts_with("contacts.") || count == 0 || values.size() % count != 0) continue;
    const std::size_t width = values.size() / count;
    std::vector<double> sorted;
    for (const std::size_t k : order)
      for (std::size_t c = 0; c < width; ++c) sorted.push_back(values[k * width + c]);
    values = std::move(sorted);
  }
}

/// @throws std::exception where list and bytes do not fit
Arrays arraysOf(const Exchange& exchange, const std::filesystem::path& scratch) {
  Arrays arrays;
  if (!exchange.answer.contains("arrays")) return arrays;
  const std::filesystem::path file = scratch / "compared.bin";
  writeFile(file, exchange.received);
  const ArrayReader reader(file, exchange.answer.at("arrays"));
  for (const json& entry : exchange.answer.at("arrays")) {
    arrays.names.push_back(entry.at("name"));
    arrays.values[arrays.names.back()] = reader.numbers(arrays.names.back());
  }
  sortContacts(arrays);
  return arrays;
}

std::string placeOf(const std::string& name, std::size_t index, const Arrays& arrays) {
  const std::size_t count = arrays.contacts.size();
  if (!name.starts_with("contacts.") || count == 0) return fmt::format("[{}]", index);
  const auto& [i, j] = arrays.contacts[index / (arrays.values.at(name).size() / count)];
  return fmt::format(" of {} with {}", i, j);
}

std::optional<AnswerDifference> arrayDifference(const std::string& name, const Arrays& then,
                                                const Arrays& now, double tolerance) {
  const std::vector<double>& a = then.values.at(name);
  const auto other = now.values.find(name);
  if (other == now.values.end()) return AnswerDifference{name, "", "there", "not there", {}};
  const std::vector<double>& b = other->second;
  if (a.size() != b.size())
    return AnswerDifference{
        name, "", fmt::format("{} elements", a.size()), fmt::format("{}", b.size()), {}};
  double scale = 0.0;
  for (const double value : a) scale = std::max(scale, std::abs(value));
  AnswerDifference found{name, "", "", "", 0.0, 0, a.size()};
  std::size_t largest = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    const double off = std::abs(b[k] - a[k]);
    if (off <= tolerance * scale) continue;
    if (found.differ++ == 0 || off > *found.off) {
      found.off = off;
      largest = k;
    }
  }
  if (found.differ == 0) return std::nullopt;
  found.place = placeOf(name, largest, then);
  found.then = fmt::format("{}", a[largest]);
  found.now = fmt::format("{}", b[largest]);
  return found;
}

std::vector<AnswerDifference> arrayDifferences(const Exchange& then, const Exchange& now,
                                               double tolerance,
                                               const std::filesystem::path& scratch) {
  if (then.received == now.received &&
      then.answer.value("arrays", json()) == now.answer.value("arrays", json()))
    return {};
  std::vector<AnswerDifference> differences;
  try {
    const Arrays before = arraysOf(then, scratch), after = arraysOf(now, scratch);
    for (const std::string& name : before.names)
      if (auto found = arrayDifference(name, before, after, tolerance))
        differences.push_back(std::move(*found));
    for (const std::string& name : after.names)
      if (!before.values.contains(name))
        differences.push_back({name, "", "not there", "there", {}});
  } catch (const std::exception& error) {
    differences.push_back({"arrays", "", "", error.what(), {}});
  }
  return differences;
}

/// Whether a field says what the engine did, not which one it is or how long it took.
bool isCompared(const std::string& pointer) {
  return !pointer.starts_with("/arrays/") && !pointer.ends_with("seconds") &&
         pointer != "/capabilities/version" && pointer != "/realised/version" &&
         pointer != "/realised/engine";
}

bool alike(const json& a, const json& b, double tolerance) {
  if (a == b) return true;
  if (!a.is_number() || !b.is_number()) return false;
  const double x = a.get<double>(), y = b.get<double>();
  return std::abs(x - y) <= tolerance * std::max(std::abs(x), std::abs(y));
}

std::string shown(const json& value) {
  return asOneLine(value.dump(-1, ' ', false, json::error_handler_t::replace), 100);
}

void addFieldDifferences(const json& then, const json& now, double tolerance,
                         std::vector<AnswerDifference>& differences) {
  const json a = then.flatten(), b = now.flatten();
  std::set<std::string> pointers;
  for (const json* each : {&a, &b})
    for (const auto& [pointer, value] : each->items())
      if (isCompared(pointer)) pointers.insert(pointer);
  for (const std::string& pointer : pointers) {
    const auto before = a.find(pointer), after = b.find(pointer);
    const bool both = before != a.end() && after != b.end();
    if (both && alike(*before, *after, tolerance)) continue;
    AnswerDifference found;
    found.field = pointer.substr(std::min<std::size_t>(1, pointer.size()));
    std::ranges::replace(found.field, '/', '.');
    found.then = before == a.end() ? "not there" : shown(*before);
    found.now = after == b.end() ? "not there" : shown(*after);
    if (both && before->is_number() && after->is_number())
      found.off = std::abs(after->get<double>() - before->get<double>());
    differences.push_back(std::move(found));
  }
}

}  // namespace

std::vector<AnswerDifference> answerDifferences(const Exchange& then, const Exchange& now,
                                                double tolerance,
                                                const std::filesystem::path& scratch) {
  // What was last in its log need not be the same words.
  if (then.answer.is_null() && now.answer.is_null()) return {};
  if (then.answer.is_null()) return {{"failure", "", then.failure, "an answer", {}}};
  if (now.answer.is_null()) return {{"failure", "", "an answer", now.failure, {}}};
  std::vector<AnswerDifference> differences = arrayDifferences(then, now, tolerance, scratch);
  addFieldDifferences(then.answer, now.answer, tolerance, differences);
  return differences;
}

}  // namespace crossgrain
