#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "support/json_text.hpp"

/// What is taken from a worker's words: nothing in them is trusted, and all of it has a bound.
namespace crossgrain {

/// Longest line of an answer [bytes]. Lists of disks and contacts are in files; what is left are
/// some hundred bytes for each wall body, so that this holds more than 20 000 of them.
inline constexpr std::size_t longestAnswer = std::size_t{8} << 20;

/// Of objects and lists in each other. Answers have five; what takes them apart and copies them
/// calls itself for each.
inline constexpr int deepestAnswer = 16;

/// Longest reason that a worker can give [bytes]; it becomes part of one line.
inline constexpr std::size_t longestReason = 500;

/// The JSON object of that line. @throws std::runtime_error: what it is instead, or the key that it
/// has twice, of which one reader would take the first and another the last
nlohmann::json parseAnswer(const std::string& line);

/// @throws std::runtime_error where an answer holds nothing that answers that request, saying which
/// other it answers
void requireAnswerTo(const std::string& request, const nlohmann::json& answer);

/// What a worker printed last: "the end of its log: …" with its last three lines, or the error that
/// a traceback of Python there ends with; empty if there is nothing. Looks at the log's last 64
/// KiB.
std::string lastWords(const std::filesystem::path& log);

}  // namespace crossgrain
