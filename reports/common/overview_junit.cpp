#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

#include "reports/common/overview.hpp"

namespace crossgrain::reports {

namespace {

using Outcome = JUnitCase::Outcome;

/// Absent: the cell answers no question.
std::optional<Outcome> outcomeOf(CellState state) {
  switch (state) {
    case CellState::good:
    case CellState::modelDifference:
      return Outcome::passed;
    case CellState::bad:
      return Outcome::failed;
    case CellState::borderline:
    case CellState::undecided:
    case CellState::notMeasured:
      return Outcome::skipped;
    case CellState::figure:
    case CellState::notApplicable:
      break;
  }
  return std::nullopt;
}

/// "undecided, 0.31 margins, pressure"
std::string messageOf(const OverviewCell& cell) {
  std::vector<std::string> parts;
  if (cell.state != CellState::good && cell.state != CellState::bad) {
    std::string state(namesOf(cell.state)[static_cast<std::size_t>(cell.state)]);
    std::ranges::replace(state, '_', ' ');
    parts.push_back(std::move(state));
  }
  for (const std::string& part : {cell.shown, cell.words})
    if (!part.empty()) parts.push_back(part);
  return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace

std::vector<JUnitCase> overviewCases(const Overview& overview, const std::string& group) {
  std::vector<JUnitCase> cases;
  for (const OverviewRow& row : overview.rows)
    for (std::size_t k = 0; k < row.cells.size(); ++k)
      if (const auto outcome = outcomeOf(row.cells[k].state))
        cases.push_back({group, fmt::format("{}: {}", row.name, overview.columns[k].name), *outcome,
                         messageOf(row.cells[k])});
  return cases;
}

}  // namespace crossgrain::reports
