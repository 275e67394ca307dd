#include "results/schema.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>

#include "support/bad_input.hpp"

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
  const auto known = {kindCompare, kindCollide, kindLockstep,   kindEffects,
                      kindCost,    kindAverage, kindRev,        kindStability,
                      kindThesis,  kindScale,   kindConformance};
  if (std::ranges::find(known, kind) == known.end())
    throw BadInput(fmt::format("{}: has kind \"{}\", a report is made of one of \"{}\"", where,
                               kind, fmt::join(known, "\", \"")));
}

std::string toText(const nlohmann::json& results) {
  constexpr int compact = -1;
  return results.dump(compact, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

nlohmann::json readResultsFile(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in)
    throw BadInput(
        fmt::format("{}: cannot be read; a folder that compare, collide, lockstep, effects, "
                    "cost, stability, thesis, conformance, average or rev wrote has it",
                    file.string()));
  nlohmann::json results;
  try {
    results = nlohmann::json::parse(in);
  } catch (const nlohmann::json::parse_error& error) {
    throw BadInput(
        fmt::format("{}: is not JSON, byte {}: {}", file.string(), error.byte, error.what()));
  }
  checkSchema(results, file.string());
  return results;
}

}  // namespace crossgrain::inline results
