#include "cases/case_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "cases/loader_document.hpp"

namespace crossgrain::inline cases {

namespace {

void addKeys(CaseKeys& keys, const toml::table& table, const std::string& path) {
  for (const auto& [name, node] : table) {
    const std::string key = path + std::string(name.str());
    if (const toml::table* const inner = node.as_table())
      addKeys(keys, *inner, key + ".");
    else
      keys[key] = printValue(node);
  }
}

/// Room for a value in a line that names several.
std::string shortened(const std::string& value) {
  constexpr std::size_t most = 60;
  if (value.size() <= most) return value;
  std::size_t end = most;
  while (end > 0 && (static_cast<unsigned char>(value[end]) & 0xC0) == 0x80) --end;  // inside UTF-8
  return value.substr(0, end) + "…";
}

}  // namespace

CaseKeys caseKeys(const std::string& toml) {
  CaseKeys keys;
  addKeys(keys, toml::parse(toml), "");
  return keys;
}

bool isIn(const std::string& section, const std::string& key) {
  return key == section || key.starts_with(section + ".");
}

std::string whereSaid(const Case& setup, const std::string& key) {
  std::string where = setup.file.string();
  for (const std::string& text : setup.overrides) {
    const std::string said = text.substr(0, text.find_first_of("= \t"));
    if (isIn(said, key) || isIn(key, said)) where = "--set " + text;
  }
  return where;
}

std::vector<std::string> changes(const CaseKeys& before, const CaseKeys& now) {
  std::set<std::string> keys;
  for (const CaseKeys* side : {&before, &now})
    for (const auto& [key, value] : *side) keys.insert(key);
  const auto valueOf = [](const CaseKeys& side, const std::string& key) {
    const auto found = side.find(key);
    return found == side.end() ? std::string("none") : shortened(found->second);
  };
  std::vector<std::string> changes;
  for (const std::string& key : keys) {
    const auto old = before.find(key), current = now.find(key);
    if (old == before.end() || current == now.end() || old->second != current->second)
      changes.push_back(fmt::format("{}: {} → {}", key, valueOf(before, key), valueOf(now, key)));
  }
  return changes;
}

std::string changesInWords(const std::vector<std::string>& changes) {
  constexpr std::size_t most = 8;
  std::string text;
  for (std::size_t k = 0; k < std::min(most, changes.size()); ++k)
    text += (k ? "; " : "") + changes[k];
  return changes.size() <= most ? text
                                : fmt::format("{}; and {} more", text, changes.size() - most);
}

}  // namespace crossgrain::inline cases
