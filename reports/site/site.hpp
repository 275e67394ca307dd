#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "reports/common/report.hpp"

/// Several reports in one folder, and the page that leads to them.
namespace crossgrain::reports {

struct SiteReport {
  std::string folder;  ///< in the site's, where its report.html is
  ReportDigest digest;
  std::vector<std::string> tables;  ///< names of its CSV files
  /// How its case differs from an earlier report's of that name: "law.mu: 0.44 → 0.5, compared with
  /// out/compare"; empty: it does not
  std::string changedCase = {};
};

/// Where it is, from the site's own pages.
std::string pageOf(const SiteReport& report);

/// The engine's row; null where the matrix has none.
const OverviewRow* rowOf(const Overview& overview, const std::string& engine);

/// The engine as it took part in a report; null if it did not.
const EngineRow* engineIn(const SiteReport& report, const std::string& engine);

/// Of all reports, each once, so that its colour is that of its reports.
std::vector<EngineRow> siteEngines(const std::vector<SiteReport>& reports);

/// Engines × reports: in each cell the most severe state that the report's own matrix has
/// of the engine, and in how many of its questions.
Overview siteOverview(const std::vector<SiteReport>& reports);

/// One engine's answers: reports × questions, each cell as its report has it.
Overview engineOverview(const std::vector<SiteReport>& reports, const std::string& engine);

/// The page of one version of an engine.
struct EnginePage {
  EngineRow engine;
  std::string file;                 ///< "engine-NAME-VERSION.html"
  std::vector<SiteReport> reports;  ///< that version took part in
};

/// Of all engines in the order of siteEngines(); of each its versions, the one of the latest report
/// first.
std::vector<EnginePage> enginePages(const std::vector<SiteReport>& reports);

/// What page says of each report of its engine: where it was made, how many checks passed, which
/// did not and why, and its numbers.
void addEngineReports(Report& page, const EnginePage& engine);

/// Writes index.html, a page for each engine and version, summary.md and junit.xml.
/// @throws std::runtime_error where they cannot be written
void writeIndex(const std::vector<SiteReport>& reports, const std::filesystem::path& site);

/// Names of folders in a site, of results in these: their own, in letters that an address may have,
/// each once.
std::vector<std::string> siteFolders(const std::vector<std::filesystem::path>& results);

// Answers to one case, from one version to the next.

/// One engine's answers to one question, or its values of one quantity.
struct HistoryRow {
  std::string engine, question;
  std::vector<std::optional<OverviewCell>> cells;  ///< one for each report; absent: it has none
};

/// Reports of one command on one case that stem from more than one version of crossgrain or of an
/// engine.
struct History {
  std::string name;                        ///< "compare quick"
  std::vector<const SiteReport*> reports;  ///< the oldest first
  std::vector<HistoryRow> rows;
};

/// "0.3.0 (7902f0e)"
std::string stampOf(const ResultsHead& head);

std::vector<History> historiesOf(const std::vector<SiteReport>& reports);

/// Change from the first that has the row to the last: "passed → failed", "+1.2 %",
/// "same"; empty where only one has it.
std::string changeOf(const HistoryRow& row);

/// Names of engines of whom reports of the history have different versions.
std::vector<std::string> changedEngines(const History& history);

/// "crossgrain 0.3.0 (7902f0e), theirs 2.1, 2026-11-26T09:46:01Z (compare-2)": what
/// distinguishes a report of the history from the others, where and when it was made.
std::string columnNameOf(const History& history, const SiteReport& report);

/// Which answers changed, and whether the case did, at most three sentences.
std::vector<std::string> sentencesOf(const History& history);

/// The section of the index, or of an engine's page; none where no case has several versions.
/// @param engine  whose rows alone are shown; empty: all
void addHistory(Report& index, const std::vector<SiteReport>& reports,
                const std::string& engine = {});

}  // namespace crossgrain::reports
