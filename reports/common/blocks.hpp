#pragma once

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "adapters/engine.hpp"
#include "reports/common/report.hpp"
#include "reports/common/text.hpp"
#include "results/flow_frame.hpp"

/// Blocks that several studies' reports are made of, and lines of CSV (RFC 4180).
namespace crossgrain::reports {

/// A scene as an engine took it. Both must outlive it.
struct EffectiveScene {
  std::string engine;
  const EffectiveParameters* effective;
  const Names* calledFor;  ///< effects of this scene; null: not known
};
/// Deviations of engines from the scene, pair coefficients after their mixing rules, and effects
/// called for and simulated.
void addDetails(Report& report, const std::vector<EffectiveScene>& effective);

/// Seed and hash of each packing.
void addPackings(Report& report, const std::vector<PackingRow>& packings);

/// Version and description of each engine; why it did not run.
void addEngines(Report& report);

/// A column for each of these engines, after the first ones.
std::vector<Column> engineColumns(std::vector<Column> first, const auto& engines) {
  for (const EngineRow& engine : engines) first.emplace_back(engine.name, Column::Kind::engine);
  return first;
}

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

/// Part of a row.
template <class... Values>
std::string cells(const Values&... values) {
  std::string line;
  ((line += cell(values) + ","), ...);
  line.pop_back();
  return line;
}

template <class... Values>
std::string row(const Values&... values) {
  return cells(values...) + "\n";
}

}  // namespace crossgrain::reports
