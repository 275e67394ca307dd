#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/site/site.hpp"

/// Answers to one case, from one version to the next.
namespace crossgrain::reports {

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

/// Which answers changed, and whether the case did, at most three sentences.
std::vector<std::string> sentencesOf(const History& history);

/// The section of the index; none where no case has several versions.
void addHistory(Report& index, const std::vector<SiteReport>& reports);

}  // namespace crossgrain::reports
