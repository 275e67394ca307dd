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

/// Key that the answer to each request has. A checkpoint's has none.
constexpr std::pair<std::string_view, std::string_view> contents[] = {{"hello", "capabilities"},
                                                                      {"load", "realised"},
                                                                      {"advance", "time"},
                                                                      {"snapshot", "snapshot"},
                                                                      {"stats", "stats"}};

/// Whether a line is what a library prints around an error and not the error: rules, addresses of
/// a stack ("[host:12] [ 3] /lib/…") and the heading of these, and what MPI prints as it ends.
bool isAroundErrors(const std::string& line) {
  if (line.find_first_not_of("-=* ") == std::string::npos) return true;
  static constexpr std::string_view ofMpi[] = {
      "MPI_ABORT was invoked", "with errorcode", "NOTE: invoking MPI_ABORT",
      "You may or may not see output", "exactly when Open MPI kills"};
  if (std::ranges::any_of(ofMpi, [&](auto words) { return line.starts_with(words); })) return true;
  const std::size_t host = line.find("] ");
  if (line[0] != '[' || host == std::string::npos) return false;
  const std::string_view rest = std::string_view(line).substr(host + 2);
  static constexpr std::string_view ofStacks[] = {"[", "***", "Signal", "Failing at", "Associated"};
  return std::ranges::any_of(ofStacks, [&](auto words) { return rest.starts_with(words); });
}

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
  std::string error;  // of Python: the line after the indented ones; of others: one that says so
  bool inTraceback = false;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || isAroundErrors(line)) continue;
    if (line.starts_with("ERROR")) error = asOneLine(line, longest);
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
