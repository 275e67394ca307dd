#include "support/json_text.hpp"

#include <algorithm>
#include <set>
#include <vector>

#include "support/files.hpp"

namespace crossgrain::inline support {

using nlohmann::json;

json parseJson(const std::string& text, int deepest) {
  std::vector<std::set<std::string>> keys;  // of each object that is being read
  const auto hold = [&](int depth, json::parse_event_t event, json& parsed) {
    using Event = json::parse_event_t;
    if (depth > deepest)
      throw std::runtime_error(
          fmt::format("has more than {} objects and lists in each other", deepest));
    if (event == Event::object_start) keys.emplace_back();
    if (event == Event::object_end && !keys.empty()) keys.pop_back();
    if (event == Event::key && !keys.back().insert(parsed.get<std::string>()).second)
      throw std::runtime_error(fmt::format("has the key '{}' twice in one object",
                                           asOneLine(parsed.get<std::string>(), 60)));
    return true;
  };
  try {
    return json::parse(text, hold);
  } catch (const json::parse_error& error) {
    throw NotJson(fmt::format("is not JSON, byte {}: {}", error.byte,
                              asOneLine(withoutPrefix(error.what()), 200)));
  }
}

std::optional<json> readJsonFile(const std::filesystem::path& file) {
  const auto text = readFile(file);
  if (!text) return std::nullopt;
  try {
    return parseJson(*text);
  } catch (const std::runtime_error& error) {
    throw BadInput(fmt::format("{}: {}", file.string(), error.what()));
  }
}

std::string withoutPrefix(const std::string& what) {
  const std::size_t end = what.find("] ");
  return what.starts_with("[json.exception.") && end != std::string::npos ? what.substr(end + 2)
                                                                          : what;
}

std::string asOneLine(const std::string& text, std::size_t longest) {
  std::string line = text.substr(0, longest);
  std::ranges::replace_if(
      line, [](unsigned char c) { return c < ' ' || c == 0x7f; }, ' ');
  // A character that the end cut is no part of it.
  if (text.size() > longest)
    while (!line.empty() && (static_cast<unsigned char>(text[line.size()]) & 0xc0) == 0x80)
      line.pop_back();
  // Characters that no text can hold come back from JSON as U+FFFD.
  line = json::parse(json(line).dump(-1, ' ', false, json::error_handler_t::replace));
  return text.size() <= longest ? line : line + " …";
}

}  // namespace crossgrain::inline support
