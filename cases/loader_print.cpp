#include "cases/loader_print.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>
#include <vector>

namespace crossgrain::inline cases {
namespace {

template <typename Node>
std::string formatted(const Node& node) {
  std::ostringstream stream;
  stream << toml::toml_formatter(node, toml::format_flags::allow_unicode_strings);
  return stream.str();
}

/// TOML tells decimal numbers from whole ones by a point or an exponent.
std::string printNumber(double number) {
  const std::string digits = fmt::format("{}", number);
  const bool whole = digits.find_first_of(".einf") == std::string::npos;
  return whole ? digits + ".0" : digits;
}

std::string printKey(std::string_view key) {
  const auto bare = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; };
  if (!key.empty() && std::ranges::all_of(key, bare)) return std::string(key);
  return formatted(toml::value<std::string>(std::string(key)));
}

void printTable(std::string& out, const toml::table& table, const std::string& path) {
  std::string values;
  for (const auto& [key, node] : table)
    if (!node.is_table()) values += fmt::format("{} = {}\n", printKey(key.str()), printValue(node));
  if (!values.empty() && !path.empty())
    out += fmt::format("{}[{}]\n", out.empty() ? "" : "\n", path);
  out += values;
  for (const auto& [key, node] : table)
    if (const toml::table* const inner = node.as_table())
      printTable(out, *inner, (path.empty() ? "" : path + ".") + printKey(key.str()));
}

}  // namespace

std::string printValue(const toml::node& node) {
  if (const auto* const number = node.as_floating_point()) return printNumber(**number);
  std::vector<std::string> parts;
  if (const toml::array* const array = node.as_array()) {
    for (const toml::node& element : *array) parts.push_back(printValue(element));
    return fmt::format("[{}]", fmt::join(parts, ", "));
  }
  if (const toml::table* const table = node.as_table()) {
    for (const auto& [key, element] : *table)
      parts.push_back(fmt::format("{} = {}", printKey(key.str()), printValue(element)));
    return fmt::format("{{ {} }}", fmt::join(parts, ", "));
  }
  return node.visit([](const auto& value) { return formatted(value); });
}

std::string printDocument(const toml::table& root) {
  std::string out;
  printTable(out, root, "");
  return out;
}

std::string printVariant(const toml::table& root, const std::string& name) {
  std::string out =
      fmt::format("[[variants]]\nname = {}\n", formatted(toml::value<std::string>(name)));
  printTable(out, root, "variants");
  return out;
}

}  // namespace crossgrain::inline cases
