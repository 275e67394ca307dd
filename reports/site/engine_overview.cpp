#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "reports/common/page.hpp"
#include "reports/common/sentences.hpp"
#include "reports/site/site.hpp"
#include "results/schema.hpp"

namespace crossgrain::reports {

namespace {

/// The column of that question, made where no report before had it.
std::size_t columnOf(Overview& overview, const OverviewColumn& question) {
  auto& columns = overview.columns;
  const auto found = std::ranges::find(columns, question.name, &OverviewColumn::name);
  if (found != columns.end()) return static_cast<std::size_t>(found - columns.begin());
  columns.push_back({question.name, question.asks, ""});
  return columns.size() - 1;
}

/// How many questions came out so, and in which reports.
struct Tally {
  std::size_t answered = 0;
  std::vector<std::string> places;  ///< reports, each once

  void add(const std::string& place) {
    ++answered;
    if (std::ranges::find(places, place) == places.end()) places.push_back(place);
  }
};

}  // namespace

Overview engineOverview(const std::vector<SiteReport>& reports, const std::string& engine) {
  using enum CellState;
  constexpr std::size_t mostPlaces = 3;
  Overview overview;
  overview.rowsAre = "report";
  Tally holds, differs, falls, open;
  for (const SiteReport& report : reports) {
    const auto& its = report.digest.overview;
    const OverviewRow* const own = its ? rowOf(*its, engine) : nullptr;
    if (!own) continue;
    OverviewRow row{ownNameOf(report, reports), false, {}, pageOf(report)};
    for (std::size_t k = 0; k < own->cells.size(); ++k) {
      OverviewCell cell = own->cells[k];
      if (!cell.anchor.empty()) cell.anchor = pageOf(report) + "#" + cell.anchor;
      const std::size_t column = columnOf(overview, its->columns[k]);
      row.cells.resize(std::max(row.cells.size(), column + 1), {notApplicable});
      row.cells[column] = std::move(cell);
      if (report.digest.head.kind == kindThesis) continue;  // its claims are not the engine's
      const CellState state = own->cells[k].state;
      if (state == good) holds.add(row.name);
      if (state == modelDifference) differs.add(row.name);
      if (state == bad) falls.add(row.name);
      if (state == borderline || state == undecided) open.add(row.name);
    }
    overview.rows.push_back(std::move(row));
  }
  for (OverviewRow& row : overview.rows) row.cells.resize(overview.columns.size(), {notApplicable});
  const auto say = [&](const char* what, const Tally& tally) {
    if (tally.answered > 0 && overview.conclusion.size() < 3)
      overview.conclusion.push_back(fmt::format("{}: {} ({}).", what,
                                                counted(tally.answered, "question"),
                                                listedShortly(tally.places, mostPlaces)));
  };
  say("Falls short", falls);
  say("Borderline or undecided", open);
  say("Differs by its model, true to the law that it declares", differs);
  say("Holds", holds);
  if (overview.conclusion.empty())
    overview.conclusion.push_back("Nothing is judged of it in these reports.");
  return overview;
}

}  // namespace crossgrain::reports
