#include <algorithm>
#include <set>

#include "reports/common/engines.hpp"
#include "reports/common/labels.hpp"
#include "reports/common/overview.hpp"
#include "reports/common/overview_marks.hpp"

namespace crossgrain::reports {

namespace {

std::string meaningOf(const Overview& overview, CellState state) {
  const auto own = std::ranges::find(overview.states, state, &StateWords::state);
  return own == overview.states.end() ? std::string(lookOf(state).words) : own->words;
}

/// Where it leads: a part of this page, or another page.
std::string linkOf(const std::string& anchor) {
  return anchor.empty() || anchor.find('/') != std::string::npos ? anchor : "#" + anchor;
}

Json cellView(const Overview& overview, const OverviewCell& cell, const std::string& column) {
  const CellLook look = lookOf(cell.state);
  std::string title = meaningOf(overview, cell.state);
  if (!cell.words.empty()) title += ": " + cell.words;
  return {{"asked", column},
          {"mark", look.mark},
          {"class", look.cssClass},
          {"title", title},
          {"shown", cell.shown},
          {"words", symbolsHtml(cell.words)},
          {"link", linkOf(cell.anchor)},
          {"state", meaningOf(overview, cell.state)}};
}

/// What the marks stand for, of those that occur.
Json legendOf(const Overview& overview, bool wrapped) {
  std::set<CellState> seen;
  for (const OverviewRow& row : overview.rows)
    for (const OverviewCell& cell : row.cells) seen.insert(cell.state);
  if (wrapped) seen.erase(CellState::notApplicable);  // such cells are not there
  Json legend = Json::array();
  for (const CellState state : seen) {
    const CellLook look = lookOf(state);
    legend.push_back(
        {{"mark", look.mark}, {"class", look.cssClass}, {"words", meaningOf(overview, state)}});
  }
  return legend;
}

/// How many lines a row's small words take on a page of 1280 px, about.
std::size_t linesOf(const OverviewRow& row) {
  constexpr std::size_t letters = 150;  // of a line of small words over all cells
  const std::size_t each = letters / row.cells.size();
  std::size_t lines = 0;
  for (const OverviewCell& cell : row.cells)
    lines = std::max(lines, (cell.words.size() + each - 1) / each);
  return lines;
}

/// The most lines of small words that rows may have for the matrix to end within 800 px.
std::size_t mostLines(const std::vector<OverviewRow>& rows) {
  constexpr std::size_t room = 648;            // below the heads [px]
  constexpr std::size_t mark = 26, line = 16;  // of a row [px]
  for (std::size_t most = 4; most > 1; --most) {
    std::size_t height = 0;
    for (const OverviewRow& row : rows) height += mark + line * std::min(most, linesOf(row));
    if (height <= room) return most;
  }
  return 1;
}

}  // namespace

void addOverview(Json& view, const Overview& overview, const std::vector<EngineRow>& engines,
                 bool wrapped) {
  if (overview.rows.empty() || overview.columns.empty()) return;
  wrapped = wrapped || overview.columns.size() > mostColumns;
  const std::vector<LineStyle> styles = engineStyles(engines);
  Json columns = Json::array(), rows = Json::array();
  for (const OverviewColumn& column : overview.columns)
    columns.push_back({{"name", symbolsHtml(column.name)},
                       {"asks", column.asks},
                       {"link", linkOf(column.anchor)}});
  for (const OverviewRow& row : overview.rows) {
    Json cells = Json::array();
    for (std::size_t k = 0; k < row.cells.size(); ++k)
      cells.push_back(cellView(overview, row.cells[k], overview.columns[k].name));
    const auto engine = std::ranges::find(engines, row.name, &EngineRow::name);
    const bool drawn = row.isEngine && engine != engines.end();
    const LineStyle style =
        drawn ? styles[static_cast<std::size_t>(engine - engines.begin())] : LineStyle();
    rows.push_back({{"name", row.name},
                    {"page", row.anchor},
                    {"isEngine", drawn},
                    {"colour", style.colour},
                    {"dashed", style.dashed},
                    {"cells", std::move(cells)}});
  }
  Json conclusion = Json::array();
  for (const std::string& sentence : overview.conclusion)
    conclusion.push_back(symbolsHtml(sentence));
  view["overview"] = {{"many", wrapped},
                      {"tall", !wrapped && overview.rows.size() > mostRows},
                      {"lines", mostLines(overview.rows)},
                      {"rowsAre", overview.rowsAre},
                      {"columns", std::move(columns)},
                      {"rows", std::move(rows)},
                      {"legend", legendOf(overview, wrapped)},
                      {"conclusion", std::move(conclusion)}};
}

}  // namespace crossgrain::reports
