#pragma once

#include <string>

#include "reports/common/overview.hpp"
#include "reports/common/report.hpp"

namespace crossgrain::reports {

/// Everything that a report says, as plain text: matrix, notes, sections with their tables.
/// Figures and pictures are there by their names.
std::string textOf(const Report& report);

/// And what is drawn, curve by curve, and the ends of its CSV tables.
std::string wholeTextOf(const Report& report);

/// One of its CSV tables. @throws std::out_of_range where it has none of that name
const std::string& csvOf(const Report& report, const std::string& name);

/// Its checks as JUnit's XML.
std::string junitOf(const Report& report);

/// State and number of a cell: "good 0.24 × limit".
std::string shown(const OverviewCell& cell);

/// @throws std::runtime_error where the matrix has no row of that name
const OverviewRow& rowNamed(const Overview& overview, const std::string& name);

inline bool has(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

}  // namespace crossgrain::reports
