#include "adapters/worker/answer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <deque>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace crossgrain {
namespace {

using nlohmann::json;

/// The end of a file of whatever length.
std::string tailOf(const std::filesystem::path& file, std::streamoff bytes) {
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  if (!in) return {};
  const std::streamoff size = in.tellg();
  in.seekg(std::max<std::streamoff>(0, size - bytes));
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace

json parseAnswer(const std::string& line) {
  const auto holdDepth = [](int depth, json::parse_event_t, json&) {
    if (depth > deepestAnswer)
      throw std::runtime_error(
          fmt::format("has more than {} objects and lists in each other", deepestAnswer));
    return true;
  };
  json answer = json::parse(line, holdDepth, false);
  if (!answer.is_object())
    throw std::runtime_error(fmt::format("is not a JSON object: '{}'", asOneLine(line, 60)));
  return answer;
}

std::string asOneLine(const std::string& text, std::size_t longest) {
  std::string line = text.substr(0, longest);
  std::ranges::replace_if(
      line, [](unsigned char c) { return c < ' ' || c == 0x7f; }, ' ');
  // A character that the end cut is no part of it.
  if (text.size() > longest)
    while (!line.empty() && (static_cast<unsigned char>(text[line.size()]) & 0xc0) == 0x80)
      line.pop_back();
  // What no text can hold comes back from JSON as U+FFFD.
  line = json::parse(json(line).dump(-1, ' ', false, json::error_handler_t::replace));
  return text.size() <= longest ? line : line + " …";
}

std::string lastWords(const std::filesystem::path& log) {
  constexpr std::streamoff looked = std::streamoff{64} << 10;
  constexpr std::size_t lines = 3, longest = 200;
  std::istringstream in(tailOf(log, looked));
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
