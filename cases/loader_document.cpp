#include "cases/loader_document.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <set>
#include <sstream>
#include <string_view>

#include "support/bad_input.hpp"
#include "support/data_folder.hpp"
#include "support/files.hpp"
#include "support/input_file.hpp"

namespace crossgrain::inline cases {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view overridePrefix = "--set ";
constexpr const char* caseExtension = ".toml";
constexpr std::size_t longestCase = std::size_t{16} << 20;  ///< [bytes]

constexpr std::string_view fragmentName = "fragment";
/// Before the names of files outside the case's own folder; no file's name begins like that.
constexpr std::string_view foreignMark = "\x1f";

/// Ways to say one thing, of one key or of some: what a later layer says in one way replaces what
/// an earlier layer said in another.
using Way = std::vector<std::string_view>;
const std::vector<std::vector<Way>> rivals = {
    {{"dt"}, {"steps_per_contact"}},
    {{"relative"}, {"absolute"}, {"share", "of"}},
    {{"small", "large"}, {"volume_fraction", "large_number_share", "large_mass_share"}},
    {{"large_number_share"}, {"large_mass_share"}},
    {{"small_mass", "large_mass"}, {"density"}},
    {{"gn"}, {"e_n"}},
    {{"kr"}, {"kr_per_kt"}, {"kr_factor"}},
    {{"w"}, {"gamma"}},
    {{"polygon"}, {"sides", "radius"}, {"box"}, {"capsule"}, {"cylinder"}, {"polyhedron"}},
};

toml::table parse(std::string_view text, const std::string& source) {
  try {
    return toml::parse(text, source);
  } catch (const toml::parse_error& error) {
    throw BadInput(location(error.source()) + std::string(error.description()));
  }
}

/// @param foreign  outside the case's own folder: nothing of it is quoted
toml::table parseFile(const fs::path& file, bool foreign) {
  if (const std::string why = fileFault(file); !why.empty())
    throw BadInput(fmt::format("{}: {}{}", file.string(), why, nearestFile(file, caseExtension)));
  if (!isUtf8(file.string()))
    throw BadInput(
        fmt::format("{}: the name is not UTF-8: results could not hold it", file.string()));
  const std::string text = readFile(file, longestCase).value_or("");
  if (!foreign) return parse(text, file.string());
  try {
    return toml::parse(text, std::string(foreignMark) + file.string());
  } catch (const toml::parse_error& error) {
    throw BadInput(location(error.source()) + "this is not TOML: no case can extend it");
  }
}

void dropRivals(toml::table& base, const toml::table& changes) {
  const auto said = [&](std::string_view key) { return changes.contains(key); };
  for (const std::vector<Way>& ways : rivals)
    for (const Way& way : ways) {
      if (std::ranges::none_of(way, said)) continue;
      for (const Way& other : ways)
        if (&other != &way)
          for (const std::string_view key : other) base.erase(key);
    }
}

/// Constants of one normal law mean nothing in another: they go with it.
void dropConstants(toml::table& base, const toml::table& changes) {
  const auto normal = changes["normal"].value<std::string_view>();
  if (!normal || *normal == base["normal"].value_or<std::string_view>("linear")) return;
  for (const std::string_view key :
       {"kn", "young", "poisson", "k2", "k3", "gn", "kt", "gt", "e_n", "e_t0"})
    base.erase(key);
}

/// Moves, because a copied node of toml++ forgets where it came from.
void merge(toml::table& base, toml::table&& changes) {
  dropRivals(base, changes);
  dropConstants(base, changes);
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

/// "cases/laws/thesis.toml" of the cases that came with the program; absent for another name.
std::optional<fs::path> shippedCase(const std::string& name) {
  const fs::path file = dataFolder() / name;
  std::error_code unknown;
  const bool named = *fs::path(name).begin() == "cases" && fs::exists(file, unknown);
  return named ? std::optional(file) : std::nullopt;
}

/// " (did you mean cases/laws/thesis.toml?)": a case that came with the program and ends in the
/// same folder and name, for a copy of a case that lies elsewhere; empty without one.
std::string shippedNamesake(const fs::path& base) {
  const fs::path cases = dataFolder() / "cases";
  std::string found;
  std::error_code stop;
  for (fs::recursive_directory_iterator at(cases, stop), end; !stop && at != end;
       at.increment(stop)) {
    if (at->path().filename() != base.filename()) continue;
    const bool sameFolder = at->path().parent_path().filename() == base.parent_path().filename();
    if (found.empty() || sameFolder)
      found = ("cases" / at->path().lexically_relative(cases)).string();
    if (sameFolder) break;
  }
  return found.empty() ? "" : fmt::format(" (did you mean {}?)", found);
}

/// Where `extends` points to, if anywhere; takes the key out of the document. A name in cases/ that
/// is not there beside the file is that of a case that came with the program.
std::optional<fs::path> takeBase(toml::table& document, const fs::path& file) {
  if (const toml::node* const misplaced = document.get("extends"))
    throw BadInput(location(misplaced->source()) +
                   "unknown key extends (did you mean case.extends?)");
  const toml::node* const node = document.at_path("case.extends").node();
  if (!node) return std::nullopt;
  const auto name = node->value_exact<std::string>();
  if (!name || name->empty())
    throw BadInput(location(node->source()) + "case.extends: must be the path of a case file");
  fs::path base = (file.parent_path() / *name).lexically_normal();
  std::error_code unknown;
  if (!fs::exists(base, unknown)) base = shippedCase(*name).value_or(base);
  if (const std::string why = fileFault(base); !why.empty()) {
    const std::string where = location(node->source());
    if (isForeign(node->source())) throw BadInput(where + "case.extends: " + why);
    const std::string shipped = shippedNamesake(base);
    throw BadInput(fmt::format("{}case.extends = \"{}\": {} (looked for {}){}", where, *name, why,
                               base.string(),
                               shipped.empty() ? nearestFile(base, caseExtension) : shipped));
  }
  document["case"].as_table()->erase("extends");
  return base;
}

/// Whether a file lies in a folder, or below it, links followed.
bool liesIn(const fs::path& file, const fs::path& folder) {
  std::error_code error;
  const fs::path inner = fs::weakly_canonical(file, error);
  const fs::path outer = fs::weakly_canonical(folder.empty() ? fs::path(".") : folder, error);
  return std::ranges::mismatch(outer, inner).in1 == outer.end();
}

/// @param chain  files on the way here, the case's own first, to find a cycle
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
  const bool foreign = chain.size() > 1 && !liesIn(file, chain.front().parent_path());
  toml::table document = parseFile(file, foreign);
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
    const bool digits = value.find_first_not_of("0123456789_+-") == std::string::npos;
    // A whole number that is no TOML has too many digits.
    if (!word || digits) return parse(text, source);
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
  const std::string quoted = isForeign(node->source()) ? "" : fmt::format("\"{}\" ", *name);
  if (!usableName(*name)) throw BadInput(where + quoted + usableNameRule);
  if (!taken.insert(*name).second) throw BadInput(where + quoted + "is there twice");
  variant.erase("name");
  return *name;
}

template <typename Node>
std::string formatted(const Node& node) {
  std::ostringstream stream;
  stream << toml::toml_formatter(node, toml::format_flags::allow_unicode_strings);
  return stream.str();
}

/// TOML distinguishes decimal numbers from whole ones by a point or an exponent.
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

void printTable(std::string& out, const toml::table& layer, const std::string& path) {
  std::string values;
  for (const auto& [key, node] : layer)
    if (!node.is_table()) values += fmt::format("{} = {}\n", printKey(key.str()), printValue(node));
  if (!values.empty() && !path.empty())
    out += fmt::format("{}[{}]\n", out.empty() ? "" : "\n", path);
  out += values;
  for (const auto& [key, node] : layer)
    if (const toml::table* const inner = node.as_table())
      printTable(out, *inner, (path.empty() ? "" : path + ".") + printKey(key.str()));
}

void applyOverrides(toml::table& document, const std::vector<std::string>& overrides) {
  for (const std::string& text : overrides) merge(document, parseOverride(text));
}

}  // namespace

bool isOverride(const toml::source_region& source) {
  return source.path && source.path->starts_with(overridePrefix);
}

bool isForeign(const toml::source_region& source) {
  return source.path && source.path->starts_with(foreignMark);
}

std::optional<fs::path> fileOf(const toml::source_region& source) {
  if (!source.path || isOverride(source) || *source.path == fragmentName) return std::nullopt;
  return source.path->substr(isForeign(source) ? foreignMark.size() : 0);
}

fs::path folderOf(const toml::source_region& source) {
  const auto file = fileOf(source);
  return file ? file->parent_path() : fs::path();
}

std::string location(const toml::source_region& source) {
  const auto file = fileOf(source);
  const std::string name = file ? file->string() : source.path ? *source.path : std::string();
  if (isOverride(source) || !source.begin) return name + ": ";
  return fmt::format("{}:{}:{}: ", name, source.begin.line, source.begin.column);
}

toml::table readTomlFile(const fs::path& file) {
  return parseFile(file, /*foreign=*/false);
}

CaseDocument readBaseDocument(const fs::path& file) {
  CaseDocument document{{}, readWithBases(file)};
  takeVariants(document.root);
  return document;
}

CaseDocument documentOf(const std::string& printed, const std::string& variant,
                        const std::string& fragment) {
  CaseDocument document{variant, parse(printed, std::string(fragmentName))};
  merge(document.root, parse(fragment, std::string(fragmentName)));
  return document;
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
    merge(document.root, parse(fragment, std::string(fragmentName)));
    documents.push_back(std::move(document));
  }
  return documents;
}

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
