#include "tests/fuzz/damage.hpp"

#include <sys/resource.h>

#include <cctype>

namespace crossgrain::test {

namespace {

std::size_t below(Draw& draw, std::size_t limit) {
  return static_cast<std::size_t>(draw.uniform(0.0, static_cast<double>(limit)));
}

/// Values that people and programs write by mistake.
constexpr const char* strange[] = {
    "nan",  "inf",    "-1",    "0",          "1e308",  "-1e-320", "9223372036854775808",
    "true", "\"\"",   "[]",    "{}",         "[[]]",   "null",    "\"\xff\xfe\"",
    "=",    "\n[\n",  "\"",    "'''",        "#",      "1_000",   "0x7fffffffffffffff",
    "[0]",  "[1, 2]", "1.0e5", "2026-11-23", "\\u00e9"};

/// Range of the word or number around a place.
std::pair<std::size_t, std::size_t> wordAt(const std::string& text, std::size_t at) {
  const auto part = [&](std::size_t k) {
    const auto c = static_cast<unsigned char>(text[k]);
    return std::isalnum(c) != 0 || c == '.' || c == '_' || c == '-' || c == '+';
  };
  std::size_t begin = at, end = at;
  while (begin > 0 && part(begin - 1)) --begin;
  while (end < text.size() && part(end)) ++end;
  return {begin, end};
}

std::pair<std::size_t, std::size_t> lineAt(const std::string& text, std::size_t at) {
  const std::size_t before = at == 0 ? std::string::npos : text.rfind('\n', at - 1);
  const std::size_t after = text.find('\n', at);
  return {before == std::string::npos ? 0 : before + 1,
          after == std::string::npos ? text.size() : after + 1};
}

}  // namespace

std::string damagedText(std::string text, Draw& draw) {
  const std::size_t times = 1 + below(draw, 3);
  for (std::size_t k = 0; k < times && !text.empty(); ++k) {
    const std::size_t at = below(draw, text.size());
    const auto [begin, end] = wordAt(text, at);
    const auto [from, to] = lineAt(text, at);
    switch (below(draw, 6)) {
      case 0:
        text[at] = static_cast<char>(below(draw, 256));
        break;
      case 1:
      case 2:
        text.replace(begin, end - begin, draw.oneOf(strange));
        break;
      case 3:
        text.erase(from, to - from);
        break;
      case 4:
        text.insert(below(draw, text.size()), text.substr(from, to - from));
        break;
      default:
        text.insert(at, draw.oneOf(strange));
    }
  }
  return text;
}

std::string damagedBytes(std::string bytes, Draw& draw) {
  if (below(draw, 8) == 0) bytes.resize(below(draw, bytes.size()));
  const std::size_t times = 1 + below(draw, 8);
  for (std::size_t k = 0; k < times && !bytes.empty(); ++k)
    bytes[below(draw, bytes.size())] = static_cast<char>(below(draw, 256));
  return bytes;
}

nlohmann::json damagedJson(const nlohmann::json& document, Draw& draw) {
  const nlohmann::json others[] = {nullptr,
                                   true,
                                   -1,
                                   1e308,
                                   "a text",
                                   nlohmann::json::array(),
                                   0,
                                   18446744073709551615ULL,
                                   nlohmann::json::object(),
                                   {1, "b"}};
  nlohmann::json damaged = document;
  nlohmann::json* at = &damaged;
  while (at->is_structured() && !at->empty()) {
    auto child = std::next(at->begin(), static_cast<long>(below(draw, at->size())));
    if (below(draw, 12) == 0) {
      at->erase(child);
      return damaged;
    }
    at = &*child;
    if (below(draw, 6) == 0) break;
  }
  *at = draw.oneOf(others);
  return damaged;
}

std::size_t mostMemory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) << 10;
}

}  // namespace crossgrain::test
