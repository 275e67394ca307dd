#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "support/json_text.hpp"

/// Reading of a worker's answers: nothing in them is trusted, and everything has a bound.
namespace crossgrain {

/// Longest line of an answer [bytes]. Lists of disks and contacts are in files; the rest takes some
/// hundred bytes for each wall body, so that there is room for more than 20 000 of them.
inline constexpr std::size_t longestAnswer = std::size_t{8} << 20;

/// Deepest nesting of objects and lists. Answers have five levels; parsing and copying recurse once
/// for each.
inline constexpr int deepestAnswer = 16;

/// Longest reason that a worker can give [bytes]; it becomes part of one line.
inline constexpr std::size_t longestReason = 500;

/// The JSON object of that line. @throws std::runtime_error that says what it is instead, or which
/// key it has twice: one reader would take the first and another the last
nlohmann::json parseAnswer(const std::string& line);

/// @throws std::runtime_error where an answer lacks the content for that request; it names the
/// request that it answers instead
void requireAnswerTo(const std::string& request, const nlohmann::json& answer);

/// Last words of a worker's log, of which the last 64 KiB are read: "its error: …" with the end of
/// a Python traceback or a line that begins with ERROR, else "the end of its log: …" with the last
/// three lines; empty if there is nothing.
std::string lastWords(const std::filesystem::path& log);

}  // namespace crossgrain
