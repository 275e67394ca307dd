#include "cases/loader_document.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <iterator>
#include <set>
#include <string_view>

#include "cases/bad_input.hpp"

namespace crossgrain {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view overridePrefix = "--set ";

/// Two ways to say one thing: the later layer's choice replaces the earlier layer's other choice.
constexpr std::array<std::array<std::string_view, 2>, 2> rivals = {
    {{"dt", "steps_per_contact"}, {"relative", "absolute"}}};

toml::table parse(std::string_view text, const std::string& source) {
  try {
    return toml::parse(text, source);
  } catch (const toml::parse_error& error) {
    throw BadInput(location(error.source()) + std::string(error.description()));
  }
}

toml::table parseFile(const fs::path& file) {
  if (!isFile(file)) throw BadInput(file.string() + ": no such file");
  std::ifstream stream(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (!stream) throw BadInput(file.string() + ": cannot be read");
  return parse(text, file.string());
}

void dropRivals(toml::table& base, const toml::table& changes) {
  for (const auto& [one, other] : rivals) {
    if (changes.contains(one)) base.erase(other);
    if (changes.contains(other)) base.erase(one);
  }
}

/// Moves, because a copied node of toml++ forgets where it came from.
void merge(toml::table& base, toml::table&& changes) {
  dropRivals(base, changes);
  for (auto&& [key, node] : changes) {
    toml::table* const from = node.as_table();
    toml::table* const into = base.contains(key) ? base.get(key)->as_table() : nullptr;
    if (from && into) {
      merge(*into, std::move(*from));
    } else {
      base.erase(key);
      base.insert(key, std::move(node));
    }
  }
}

/// Where `extends` points to, if anywhere; takes the key out of the document.
std::optional<fs::path> takeBase(toml::table& document, const fs::path& file) {
  const toml::node* const node = document.at_path("case.extends").node();
  if (!node) return std::nullopt;
  const auto name = node->value_exact<std::string>();
  if (!name)
    throw BadInput(location(node->source()) + "case.extends: must be the path of a case file");
  const fs::path base = (file.parent_path() / *name).lexically_normal();
  if (!isFile(base))
    throw BadInput(fmt::format("{}case.extends = \"{}\": no such file (looked for {})",
                               location(node->source()), *name, base.string()));
  document["case"].as_table()->erase("extends");
  return base;
}

/// @param chain  files on the way here, to find a cycle
toml::table readWithBases(const fs::path& file, std::vector<fs::path> chain = {}) {
  const bool cycle =
      std::ranges::any_of(chain, [&](const fs::path& seen) { return fs::equivalent(seen, file); });
  chain.push_back(file);
  if (cycle) {
    std::vector<std::string> names;
    for (const fs::path& link : chain) names.push_back(link.string());
    throw BadInput(fmt::format("{}: case.extends goes round in a circle: {}",
                               chain.front().string(), fmt::join(names, " -> ")));
  }
  toml::table document = parseFile(file);
  const auto base = takeBase(document, file);
  if (!base) return document;
  toml::table merged = readWithBases(*base, std::move(chain));
  if (toml::table* const header = merged["case"].as_table()) header->erase("name");
  merge(merged, std::move(document));
  return merged;
}

/// `key.path=value`: the value is TOML; what is not, and looks like a word, is a string.
toml::table parseOverride(const std::string& text) {
  const std::string source{std::string(overridePrefix) + text};
  const auto equals = text.find('=');
  const bool control = std::ranges::any_of(text, [](unsigned char c) { return c < 0x20; });
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size() || control)
    throw BadInput(source + ": must be key.path=value");
  try {
    return toml::parse(text, source);
  } catch (const toml::parse_error&) {
    const std::string value = text.substr(equals + 1);
    const bool word = value.find_first_of("\"'[]{}\\") == std::string::npos;
    if (!word) return parse(text, source);
    return parse(text.substr(0, equals) + "=\"" + value + '"', source);
  }
}

/// Takes the list of variants out of the document.
toml::array takeVariants(toml::table& document) {
  toml::node* const node = document.get("variants");
  if (!node) return {};
  const bool tables =
      node->is_array() && std::ranges::all_of(*node->as_array(), &toml::node::is_table);
  if (!tables)
    throw BadInput(location(node->source()) + "variants: must be a list of tables, [[variants]]");
  toml::array variants = std::move(*node->as_array());
  document.erase("variants");
  return variants;
}

/// Takes the name out of a variant.
std::string takeVariantName(toml::table& variant, std::set<std::string>& taken) {
  const toml::node* const node = variant.get("name");
  if (!node) throw BadInput(location(variant.source()) + "variants: each needs a name");
  const std::string where = location(node->source()) + "variants.name: ";
  const auto name = node->value_exact<std::string>();
  if (!name) throw BadInput(where + "must be a string");
  if (!usableName(*name)) throw BadInput(fmt::format("{}\"{}\" {}", where, *name, usableNameRule));
  if (!taken.insert(*name).second) throw BadInput(where + '"' + *name + "\" is there twice");
  variant.erase("name");
  return *name;
}

void applyOverrides(toml::table& document, const std::vector<std::string>& overrides) {
  for (const std::string& text : overrides) merge(document, parseOverride(text));
}

}  // namespace

bool usableName(std::string_view name) {
  const auto allowed = [](unsigned char c) {
    return std::isalnum(c) ||
           std::string_view("._-+").find(static_cast<char>(c)) != std::string_view::npos;
  };
  return !name.empty() && name.front() != '.' && std::ranges::all_of(name, allowed);
}

bool isFile(const fs::path& file) {
  std::error_code ignored;
  return fs::is_regular_file(file, ignored);
}

bool isOverride(const toml::source_region& source) {
  return source.path && source.path->starts_with(overridePrefix);
}

std::string location(const toml::source_region& source) {
  const std::string name = source.path ? *source.path : std::string();
  if (isOverride(source) || !source.begin) return name + ": ";
  return fmt::format("{}:{}:{}: ", name, source.begin.line, source.begin.column);
}

std::vector<CaseDocument> readCaseDocuments(const fs::path& file,
                                            const std::vector<std::string>& overrides,
                                            const std::string& fragment) {
  std::vector<CaseDocument> documents;
  std::set<std::string> names;
  std::size_t count = 1;
  for (std::size_t k = 0; k < count; ++k) {
    // Read afresh for each variant: nodes can be moved but not copied with their origin.
    CaseDocument document{{}, readWithBases(file)};
    toml::array variants = takeVariants(document.root);
    if (!variants.empty()) {
      count = variants.size();
      toml::table& variant = *variants[k].as_table();
      document.variant = takeVariantName(variant, names);
      merge(document.root, std::move(variant));
    }
    applyOverrides(document.root, overrides);
    merge(document.root, parse(fragment, "fragment"));
    documents.push_back(std::move(document));
  }
  return documents;
}

}  // namespace crossgrain
