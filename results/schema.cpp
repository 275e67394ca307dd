#include "results/schema.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "averaging/fields.hpp"
#include "support/bad_input.hpp"
#include "support/input_file.hpp"
#include "support/json_text.hpp"

namespace crossgrain::inline results {

void checkSchema(const nlohmann::json& results, const std::string& where) {
  const auto word = [&](const char* key) {
    const auto found = results.find(key);
    return found != results.end() && found->is_string() ? found->get<std::string>() : "";
  };
  const std::string schema = word("schema");
  if (schema != schemaVersion)
    throw BadInput(fmt::format("{}: has schema \"{}\", this crossgrain reads \"{}\"", where, schema,
                               schemaVersion));
  const std::string kind = word("kind");
  const auto known = {kindCompare, kindCollide, kindLockstep,  kindEffects,    kindCost,
                      kindAverage, kindRev,     kindStability, kindConformance};
  if (std::ranges::find(known, kind) == known.end())
    throw BadInput(fmt::format("{}: has kind \"{}\", a report is made of one of \"{}\"", where,
                               kind, fmt::join(known, "\", \"")));
}

std::string toText(const nlohmann::json& results) {
  constexpr int compact = -1;
  return results.dump(compact, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

nlohmann::json readResultsFile(const std::filesystem::path& file) {
  auto results = readJsonFile(file);
  if (!results)
    throw BadInput(
        fmt::format("{}: cannot be read; a folder that compare, collide, lockstep, effects, cost, "
                    "stability, conformance, average or rev wrote has it",
                    file.string()));
  checkSchema(*results, file.string());
  return *std::move(results);
}

bool isName(std::string_view text) {
  // Mirrors were once called "grain~yade".
  std::string name(text);
  std::erase(name, '~');
  return text.empty() || usableName(name);
}

bool isField(std::string_view text) {
  return findField(text) != nullptr;
}

bool isUnit(std::string_view text) {
  constexpr std::size_t longest = 40;
  const auto allowed = [](unsigned char c) {
    return c >= 0x80 || std::isalnum(c) ||
           std::string_view(" /^()|+%-.,_·").find(static_cast<char>(c)) != std::string_view::npos;
  };
  return text.size() <= longest && std::ranges::all_of(text, allowed);
}

}  // namespace crossgrain::inline results
