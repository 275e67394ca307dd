#pragma once

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>

/// Lines of CSV (RFC 4180).
namespace crossgrain::reports {

/// Quoted where it has to be.
inline std::string cell(const std::string& value) {
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
