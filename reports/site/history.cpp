#include "reports/site/site.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "reports/common/overview.hpp"
#include "reports/common/sentences.hpp"

namespace crossgrain::reports {

namespace {

/// Versions of the program and of every engine in it.
std::string versionsOf(const SiteReport& report) {
  std::string versions = stampOf(report.digest.head);
  for (const EngineRow& engine : report.digest.engines)
    versions += "\n" + engine.name + " " + engine.version;
  return versions;
}

/// The row of that engine and question, made where no report before had it.
HistoryRow& rowIn(History& history, const std::string& engine, const std::string& question) {
  const auto found = std::ranges::find_if(history.rows, [&](const HistoryRow& row) {
    return row.engine == engine && row.question == question;
  });
  if (found != history.rows.end()) return *found;
  return history.rows.emplace_back(HistoryRow{
      engine, question, std::vector<std::optional<OverviewCell>>(history.reports.size())});
}

void addRows(History& history) {
  for (std::size_t k = 0; k < history.reports.size(); ++k) {
    const ReportDigest& digest = history.reports[k]->digest;
    for (const OverviewRow& row : digest.overview.rows)
      for (std::size_t c = 0; c < row.cells.size(); ++c)
        if (row.cells[c].verdict != Verdict::notApplicable)
          rowIn(history, row.name, digest.overview.columns[c].name).cells[k] = row.cells[c];
    for (const DigestValue& value : digest.values)
      rowIn(history, value.engine, value.quantity).cells[k] = value.cell;
  }
  std::vector<std::string> engines;  // in the order of the oldest report
  for (const HistoryRow& row : history.rows)
    if (std::ranges::find(engines, row.engine) == engines.end()) engines.push_back(row.engine);
  std::ranges::stable_sort(history.rows, {}, [&](const HistoryRow& row) {
    return std::ranges::find(engines, row.engine) - engines.begin();
  });
}

/// The first and the last that there are; null where fewer than two reports have the row.
std::pair<const OverviewCell*, const OverviewCell*> endsOf(const HistoryRow& row) {
  const OverviewCell *first = nullptr, *last = nullptr;
  for (const auto& cell : row.cells) {
    if (!cell) continue;
    if (!first) first = &*cell;
    last = &*cell;
  }
  if (first == last) return {nullptr, nullptr};
  return {first, last};
}

bool answerChanged(const HistoryRow& row) {
  const auto [first, last] = endsOf(row);
  return first && first->verdict != last->verdict;
}

Table historyTable(const History& history) {
  Table table{{{"engine", Column::Kind::engines}, "question"}, {}};
  for (const SiteReport* report : history.reports)
    table.columns.emplace_back(columnNameOf(history, *report));
  table.columns.emplace_back("change");
  for (const HistoryRow& row : history.rows) {
    TableRow line{{row.engine, row.question}};
    for (std::size_t k = 0; k < row.cells.size(); ++k) {
      const auto& cell = row.cells[k];
      line.cells.push_back({cell ? cell->shown : "",
                            {cell ? cell->words : ""},
                            cell ? cell->verdict : Verdict::notMeasured,
                            true});
      line.cells.back().link = pageOf(*history.reports[k]);
    }
    line.cells.emplace_back(changeOf(row));
    table.rows.push_back(std::move(line));
  }
  return table;
}

}  // namespace

std::string stampOf(const ResultsHead& head) {
  return head.build.empty() ? head.version : fmt::format("{} ({})", head.version, head.build);
}

std::vector<std::string> changedEngines(const History& history) {
  std::vector<std::string> names;
  for (const SiteReport* report : history.reports)
    for (const EngineRow& engine : report->digest.engines) {
      const bool differs = std::ranges::any_of(history.reports, [&](const SiteReport* other) {
        const EngineRow* const there = engineIn(*other, engine.name);
        return there && there->version != engine.version;
      });
      if (differs && std::ranges::find(names, engine.name) == names.end())
        names.push_back(engine.name);
    }
  return names;
}

std::string columnNameOf(const History& history, const SiteReport& report) {
  std::string name = "crossgrain " + stampOf(report.digest.head);
  for (const std::string& changed : changedEngines(history))
    if (const EngineRow* const engine = engineIn(report, changed))
      name += fmt::format(", {} {}", engine->name, engine->version);
  return fmt::format("{}, {} ({})", name, report.digest.head.started, report.folder);
}

std::vector<History> historiesOf(const std::vector<SiteReport>& reports) {
  std::vector<History> histories;
  for (const SiteReport& report : reports) {
    const std::string name = nameOf(report.digest.head);
    auto found = std::ranges::find(histories, name, &History::name);
    if (found == histories.end()) found = histories.insert(histories.end(), {name, {}, {}});
    found->reports.push_back(&report);
  }
  std::erase_if(histories, [](const History& history) {
    std::set<std::string> versions;
    for (const SiteReport* report : history.reports) versions.insert(versionsOf(*report));
    return versions.size() < 2;
  });
  for (History& history : histories) {
    std::ranges::stable_sort(history.reports, {},
                             [](const SiteReport* report) { return report->digest.head.started; });
    addRows(history);
  }
  return histories;
}

std::string changeOf(const HistoryRow& row) {
  const auto [first, last] = endsOf(row);
  if (!first) return {};
  if (first->verdict != last->verdict)
    return fmt::format("{} → {}", lookOf(first->verdict).words, lookOf(last->verdict).words);
  if (!first->value || !last->value || first->unit != last->unit) return {};
  if (*first->value == *last->value) return "same";
  if (*first->value == 0.0) return {};
  const double change = 100.0 * (*last->value / *first->value - 1.0);
  return fmt::format("{}{:.2g} %", change < 0.0 ? "−" : "+", std::abs(change));
}

std::vector<std::string> sentencesOf(const History& history) {
  constexpr std::size_t most = 4;
  std::vector<std::string> changed, sentences;
  for (const HistoryRow& row : history.rows)
    if (answerChanged(row))
      changed.push_back(fmt::format("{}, {} ({})", row.engine, row.question, changeOf(row)));
  sentences.push_back(changed.empty() ? "No answer changed from the first to the last."
                                      : fmt::format("{} changed from the first to the last: {}.",
                                                    counted(changed.size(), "answer"),
                                                    listedShortly(changed, most)));
  std::vector<std::string> changedCases;
  for (const SiteReport* report : history.reports)
    if (!report->changedCase.empty())
      changedCases.push_back(fmt::format("{}: {}", report->folder, report->changedCase));
  if (!changedCases.empty())
    sentences.push_back(
        fmt::format("The case is not the same in all of them ({}): an answer may have changed with "
                    "the case.",
                    listedShortly(changedCases, most)));
  return sentences;
}

void addHistory(Report& index, const std::vector<SiteReport>& reports, const std::string& engine) {
  std::vector<History> histories = historiesOf(reports);
  if (!engine.empty())
    for (History& history : histories)
      std::erase_if(history.rows, [&](const HistoryRow& row) { return row.engine != engine; });
  std::erase_if(histories, [](const History& history) { return history.rows.empty(); });
  if (histories.empty()) return;
  Blocks& blocks = index.section("history", "History").blocks;
  blocks = {
      Paragraph{"The same command and case with several versions of crossgrain or of an engine, "
                "oldest first. The last column compares the first with the last report that has "
                "the row."}};
  for (const History& history : histories) {
    blocks.push_back(Heading{history.name});
    for (std::string& sentence : sentencesOf(history)) blocks.push_back(Paragraph{sentence});
    blocks.push_back(historyTable(history));
  }
}

}  // namespace crossgrain::reports
