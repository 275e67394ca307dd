#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

/// results.json as text: its version, reading and printing it. Its layout is in docs/results.md.
namespace crossgrain::inline results {

inline constexpr std::string_view schemaVersion = "crossgrain-results-1";
inline constexpr std::string_view kindCompare = "compare";
inline constexpr std::string_view kindCollide = "collide";
inline constexpr std::string_view kindConformance = "conformance";
inline constexpr std::string_view kindDiff = "diff";  ///< printed, no report is made of it
inline constexpr std::string_view kindEffects = "effects";
inline constexpr std::string_view kindLockstep = "lockstep";
inline constexpr std::string_view kindCost = "cost";
inline constexpr std::string_view kindAverage = "average";
inline constexpr std::string_view kindRev = "rev";
inline constexpr std::string_view kindStability = "stability";

/// @throws BadInput, beginning with where, unless schema and kind are ones that are known here
void checkSchema(const nlohmann::json& results, const std::string& where);

/// One line of JSON. What is not finite is null; bytes that are not UTF-8 are replaced.
std::string toText(const nlohmann::json& results);

/// @throws BadInput naming the file
nlohmann::json readResultsFile(const std::filesystem::path& file);

}  // namespace crossgrain::inline results
