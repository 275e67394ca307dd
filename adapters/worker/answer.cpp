#include "adapters/worker/answer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <deque>
#include <iterator>
#include <set>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "support/regular_file.hpp"

namespace crossgrain {
namespace {

using nlohmann::json;

/// The end of a file of whatever length.
std::string tailOf(const std::filesystem::path& file, std::size_t bytes) {
  const RegularFile in(file);
  std::string text(std::min(bytes, in.size()), '\0');
  text.resize(in.read(in.size() - text.size(), std::as_writable_bytes(std::span(text))));
  return text;
}

/// What an answer to each request holds. A checkpoint's holds nothing.
constexpr std::pair<std::string_view, std::string_view> contents[] = {{"hello", "capabilities"},
                                                                      {"load", "realised"},
                                                                      {"advance", "time"},
                                                                      {"snapshot", "snapshot"},
                                                                      {"stats", "stats"}};

}  // namespace

json parseAnswer(const std::string& line) {
  json answer;
  try {
    answer = parseJson(line, deepestAnswer);
  } catch (const NotJson&) {
    // Said below.
  }
  if (!answer.is_object())
    throw std::runtime_error(fmt::format("is not a JSON object: '{}'", asOneLine(line, 60)));
  return answer;
}

void requireAnswerTo(const std::string& request, const json& answer) {
  const auto wanted = std::ranges::find(contents, request, [](auto& each) { return each.first; });
  if (wanted == std::end(contents) || answer.contains(wanted->second)) return;
  for (const auto& [other, content] : contents)
    if (answer.contains(content))
      throw std::runtime_error(fmt::format("it has '{}', which answers {}, and no '{}'", content,
                                           other, wanted->second));
  std::vector<std::string> there;
  for (const auto& [key, value] : answer.items()) there.push_back(key);
  throw std::runtime_error(
      fmt::format("it has no '{}' (it has: {})", wanted->second, fmt::join(there, ", ")));
}

std::string lastWords(const std::filesystem::path& log) {
  constexpr std::size_t most = std::size_t{64} << 10;
  constexpr std::size_t lines = 3, longest = 200;
  std::istringstream in(tailOf(log, most));
  std::deque<std::string> last;
  std::string error;  // of Python: the line after the indented ones says what it was
  bool inTraceback = false;
  for (std::string line; std::getline(in, line);) {
    if (line.empty()) continue;
    if (inTraceback && line[0] != ' ') {
      error = asOneLine(line, longest);
      inTraceback = false;
    }
    if (line.starts_with("Traceback (most recent call last)")) inTraceback = true;
    last.push_back(asOneLine(line, longest));
    if (last.size() > lines) last.pop_front();
  }
  if (!error.empty()) return "its error: " + error;
  if (last.empty()) return {};
  return fmt::format("the end of its log: {}", fmt::join(last, " | "));
}

}  // namespace crossgrain
