#pragma once

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

/// Lines of CSV (RFC 4180).
namespace crossgrain::reports {

/// Whether a spreadsheet would take the text for a formula, which may run programs; numbers and a
/// sign alone are none.
inline bool looksLikeFormula(const std::string& text) {
  if (text.size() < 2 || std::string_view("=+-@\t\r").find(text[0]) == std::string_view::npos)
    return false;
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error != std::errc() || end != text.data() + text.size();
}

/// Quoted where it has to be; what would be a formula begins with an apostrophe.
inline std::string cell(const std::string& value) {
  if (looksLikeFormula(value)) return cell("'" + value);
  if (value.find_first_of(",\"\r\n") == std::string::npos) return value;
  std::string quoted = "\"";
  for (const char c : value) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

/// The shortest text that reads back as the same double; nothing where it is absent or not finite.
inline std::string cell(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? fmt::format("{}", *value) : std::string();
}

inline std::string cell(std::size_t value) {
  return fmt::format("{}", value);
}

template <class... Values>
std::string row(const Values&... values) {
  std::string line;
  ((line += cell(values) + ","), ...);
  line.back() = '\n';
  return line;
}

}  // namespace crossgrain::reports
