#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "reports/common/report.hpp"

namespace crossgrain {

/// Writes everything that a results folder holds: results.json, the CSVs, plots/, report.html,
/// summary.md and, where anything is judged, junit.xml. The layout is in docs/results.md.
///
/// Each file replaces an older one in one step, so that an interrupted run leaves no half file.
/// results.json and the CSVs come first: without gnuplot they and a report without plots are
/// still written before the error is thrown.
/// @param results  of any kind that has a report: CollideResults, CompareResults, …
/// @throws std::runtime_error, one line, if something cannot be written or gnuplot is missing
/// @returns what the report opens with
template <typename Results>
reports::ReportDigest writeReport(const Results& results, const std::filesystem::path& dir);

/// The same of a document, whose kind follows from results["kind"].
/// @param from  the folder that results.json was read from (default: dir)
/// @throws BadInput for JSON that is no such document
reports::ReportDigest writeReport(const nlohmann::json& results, const std::filesystem::path& dir,
                                  const std::filesystem::path& from);
reports::ReportDigest writeReport(const nlohmann::json& results, const std::filesystem::path& dir);

/// The report of a document, to be written or looked into.
reports::Report reportOf(const nlohmann::json& results);

/// Results that a site is made of.
struct SiteEntry {
  std::filesystem::path folder;  ///< that they were read from
  nlohmann::json results;
  std::string changedCase = {};  ///< how their case differs from another's of that name, if it does
};

/// Writes the reports of several results into folders of their own below `site`, named after
/// theirs, and an index of all. @throws as writeReport()
void writeSite(const std::vector<SiteEntry>& entries, const std::filesystem::path& site);

/// Reads dir/results.json back, to rebuild its report.
/// @throws BadInput if there is none, it is not JSON, or its schema is not this version's
nlohmann::json readResults(const std::filesystem::path& dir);

}  // namespace crossgrain
