#include <fmt/format.h>

#include <algorithm>

#include "reports/common/overview.hpp"
#include "reports/common/sentences.hpp"
#include "reports/site/site.hpp"
#include "results/schema.hpp"

namespace crossgrain::reports {

namespace {

using Names = std::vector<std::string>;

constexpr std::size_t mostPlaces = 2;

/// Of all that is judged of an engine; absent: nothing is.
std::optional<Verdict> mostSevere(const OverviewRow& row) {
  std::optional<Verdict> worst;
  for (const OverviewCell& cell : row.cells)
    if (cell.verdict && isJudged(*cell.verdict))
      worst = worst ? moreSevere(*worst, *cell.verdict) : *cell.verdict;
  return worst;
}

/// Questions of a report that have one of these answers of an engine.
Names questionsWith(const Overview& overview, const OverviewRow& row,
                    std::initializer_list<Verdict> verdicts) {
  Names names;
  for (std::size_t k = 0; k < row.cells.size(); ++k)
    if (row.cells[k].verdict &&
        std::ranges::find(verdicts, *row.cells[k].verdict) != verdicts.end())
      names.push_back(overview.columns[k].name);
  return names;
}

OverviewCell cellOf(const SiteReport& report, const std::string& engine) {
  OverviewCell cell{Verdict::notApplicable, {}, "questions", {}, {}, {}};
  const Overview& overview = report.digest.overview;
  const OverviewRow* row = rowOf(overview, engine);
  if (!row && !engineIn(report, engine)) return cell;
  cell.anchor = pageOf(report);
  cell.verdict = std::nullopt;
  if (!row) {
    cell.words = "took part";
    return cell;
  }
  cell.verdict = mostSevere(*row);
  if (!cell.verdict) return cell;
  const Names names = questionsWith(overview, *row, {*cell.verdict});
  const auto answered = std::ranges::count_if(
      row->cells, [](const auto& one) { return one.verdict && isJudged(*one.verdict); });
  cell.value = static_cast<double>(names.size());
  cell.shown = fmt::format("{} of {} {}", names.size(), answered,
                           cell.verdict == Verdict::modelDifference ? "differ by their model"
                                                                    : lookOf(cell.verdict).words);
  if (cell.verdict != Verdict::pass) cell.words = listedShortly(names, mostPlaces);
  return cell;
}

/// "ours and theirs in compare quick; …": rows with cells in one of these states.
std::string whereWith(const Overview& overview, const Names& engines,
                      std::initializer_list<Verdict> verdicts) {
  SaidOf said;
  for (const OverviewRow& row : overview.rows)
    if (const Names where = questionsWith(overview, row, verdicts);
        !where.empty() && std::ranges::find(engines, row.name) != engines.end())
      said.add(row.name, listedShortly(where, mostPlaces));
  std::string words;
  for (const auto& [where, who] : said.all())
    words += fmt::format("{}{} in {}", words.empty() ? "" : "; ", listed(who), where);
  return words;
}

/// @param engines  that are named: no mirrors
std::vector<std::string> conclusionOf(const Overview& overview, const Names& engines) {
  Names clean;
  for (const OverviewRow& row : overview.rows)
    if (const auto worst = mostSevere(row);
        (worst == Verdict::pass || worst == Verdict::modelDifference) &&
        std::ranges::find(engines, row.name) != engines.end())
      clean.push_back(row.name);
  std::vector<std::string> sentences;
  if (!clean.empty())
    sentences.push_back(
        fmt::format("Nothing failed or is open: {}.", listedShortly(clean, 2 * mostPlaces)));
  if (const std::string failed = whereWith(overview, engines, {Verdict::fail}); !failed.empty())
    sentences.push_back(fmt::format("Failed: {}.", failed));
  if (const std::string open =
          whereWith(overview, engines, {Verdict::borderline, Verdict::undecided});
      !open.empty())
    sentences.push_back(
        fmt::format("Borderline or undecided: {}; each report has what would decide.", open));
  if (sentences.empty()) sentences.push_back("Nothing was judged in these reports.");
  return sentences;
}

/// The column of that question, made where no report before had it.
std::size_t columnOf(Overview& overview, const OverviewColumn& question) {
  auto& columns = overview.columns;
  const auto found = std::ranges::find(columns, question.name, &OverviewColumn::name);
  if (found != columns.end()) return static_cast<std::size_t>(found - columns.begin());
  columns.push_back({question.name, question.asks, ""});
  return columns.size() - 1;
}

/// How many questions came out so, and in which reports.
struct QuestionCount {
  std::size_t answered = 0;
  std::vector<std::string> places;  ///< reports, each once

  void add(const std::string& place) {
    ++answered;
    if (std::ranges::find(places, place) == places.end()) places.push_back(place);
  }
};

}  // namespace

const OverviewRow* rowOf(const Overview& overview, const std::string& engine) {
  const auto found = std::ranges::find_if(
      overview.rows, [&](const OverviewRow& row) { return row.isEngine && row.name == engine; });
  return found == overview.rows.end() ? nullptr : &*found;
}

const EngineRow* engineIn(const SiteReport& report, const std::string& engine) {
  const auto& engines = report.digest.engines;
  const auto found = std::ranges::find(engines, engine, &EngineRow::name);
  return found == engines.end() ? nullptr : &*found;
}

std::string pageOf(const SiteReport& report) {
  return report.folder + "/report.html";
}

std::vector<EngineRow> siteEngines(const std::vector<SiteReport>& reports) {
  std::vector<EngineRow> engines;
  for (const SiteReport& report : reports)
    for (const EngineRow& engine : report.digest.engines)
      if (std::ranges::find(engines, engine.name, &EngineRow::name) == engines.end())
        engines.push_back(engine);
  return engines;
}

namespace {

/// The report's name; with its folder's, "compare quick (old)", where another has the same, and
/// that its case is another than theirs.
std::string ownNameOf(const SiteReport& report, const std::vector<SiteReport>& reports) {
  const std::string name = nameOf(report.digest.head);
  const bool alone = std::ranges::count(reports, name, [](const SiteReport& one) {
                       return nameOf(one.digest.head);
                     }) < 2;
  if (alone) return name;
  return fmt::format("{} ({}{})", name, report.folder,
                     report.changedCase.empty() ? "" : ", changed case");
}

/// Reports whose answers stand below one another.
struct SiteColumn {
  std::string name, title, anchor;
  std::vector<const SiteReport*> reports;
};

/// One for each report; those of one engine each share one, as far as they are of different ones.
std::vector<SiteColumn> columnsOf(const std::vector<SiteReport>& reports) {
  std::vector<SiteColumn> columns;
  SiteColumn shared{std::string(kindConformance), "Conformance, an engine a report", "reports", {}};
  std::size_t place = 0;
  for (const SiteReport& report : reports) {
    const ResultsHead& head = report.digest.head;
    const std::string name = ownNameOf(report, reports);
    if (head.kind == kindConformance && name == nameOf(head)) {
      if (shared.reports.empty()) place = columns.size();
      shared.reports.push_back(&report);
    } else {
      columns.push_back({name, titleOf(head), pageOf(report), {&report}});
    }
  }
  if (shared.reports.size() == 1) {
    const SiteReport& report = *shared.reports.front();
    shared = {nameOf(report.digest.head), titleOf(report.digest.head), pageOf(report), {&report}};
  }
  if (!shared.reports.empty())
    columns.insert(columns.begin() + static_cast<std::ptrdiff_t>(place), std::move(shared));
  return columns;
}

/// The engine's own report's, where it has one.
OverviewCell cellOf(const SiteColumn& column, const std::string& engine) {
  const auto own = std::ranges::find_if(column.reports, [&](const SiteReport* report) {
    return engineIn(*report, engine) != nullptr;
  });
  return cellOf(own == column.reports.end() ? *column.reports.front() : **own, engine);
}

}  // namespace

Overview siteOverview(const std::vector<SiteReport>& reports) {
  Overview overview;
  overview.states = {{Verdict::pass, "every judged question passed"},
                     {std::nullopt, "took part; the report judges no single engine"},
                     {Verdict::notApplicable, "did not take part"}};
  const std::vector<SiteColumn> columns = columnsOf(reports);
  for (const SiteColumn& column : columns)
    overview.columns.push_back({column.name, column.title, column.anchor});
  const std::vector<EngineRow> all = siteEngines(reports);
  const std::vector<EnginePage> pages = enginePages(reports);
  Names engines;
  for (std::size_t e = 0; e < all.size(); ++e) {
    const auto newest = std::ranges::find(pages, all[e].name,
                                          [](const EnginePage& page) { return page.engine.name; });
    OverviewRow row{all[e].name, true, {}, newest->file};
    for (const SiteColumn& column : columns) row.cells.push_back(cellOf(column, all[e].name));
    overview.rows.push_back(std::move(row));
    if (all[e].mirrors.empty()) engines.push_back(all[e].name);
  }
  overview.conclusion = conclusionOf(overview, engines);
  return overview;
}

Overview engineOverview(const std::vector<SiteReport>& reports, const std::string& engine) {
  using enum Verdict;
  Overview overview;
  overview.rowsAre = "report";
  QuestionCount passed, differs, failed, undecidedOnes;
  for (const SiteReport& report : reports) {
    const Overview& its = report.digest.overview;
    const OverviewRow* const own = rowOf(its, engine);
    if (!own) continue;
    OverviewRow row{ownNameOf(report, reports), false, {}, pageOf(report)};
    for (std::size_t k = 0; k < own->cells.size(); ++k) {
      OverviewCell cell = own->cells[k];
      if (!cell.anchor.empty()) cell.anchor = pageOf(report) + "#" + cell.anchor;
      const std::size_t column = columnOf(overview, its.columns[k]);
      row.cells.resize(std::max(row.cells.size(), column + 1), {notApplicable});
      row.cells[column] = std::move(cell);
      const auto verdict = own->cells[k].verdict;
      if (verdict == pass) passed.add(row.name);
      if (verdict == modelDifference) differs.add(row.name);
      if (verdict == fail) failed.add(row.name);
      if (verdict == borderline || verdict == undecided) undecidedOnes.add(row.name);
    }
    overview.rows.push_back(std::move(row));
  }
  for (OverviewRow& row : overview.rows) row.cells.resize(overview.columns.size(), {notApplicable});
  const auto say = [&](const char* what, const QuestionCount& tally) {
    if (tally.answered > 0 && overview.conclusion.size() < 3)
      overview.conclusion.push_back(fmt::format("{}: {} ({}).", what,
                                                counted(tally.answered, "question"),
                                                listedShortly(tally.places, 3)));
  };
  say("Failed", failed);
  say("Borderline or undecided", undecidedOnes);
  say("Model difference (it follows the law that it declares)", differs);
  say("Passed", passed);
  if (overview.conclusion.empty()) overview.conclusion.push_back("These reports do not judge it.");
  return overview;
}

}  // namespace crossgrain::reports
