#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "reports/site/site.hpp"
#include "results/collision.hpp"
#include "results/conformance.hpp"
#include "results/cost.hpp"
#include "results/effects.hpp"
#include "results/lockstep.hpp"
#include "results/rev.hpp"
#include "results/scale.hpp"
#include "results/stability.hpp"
#include "results/thesis.hpp"

namespace crossgrain {

/// Writes everything that a results folder holds: results.json, the CSVs, plots/ and report.html.
/// The kind of report follows from results["kind"], "compare", "collide", "lockstep",
/// "effects", "cost", "scale", "stability", "thesis", "conformance", "average" or "rev"; the layout
/// of results is in reports/README.md.
///
/// Each file replaces an older one in one step, so that an interrupted run leaves no half file.
/// results.json and the CSVs come first: without gnuplot they and a report without plots are
/// still written before the error is thrown.
/// @throws std::runtime_error, one line, if something cannot be written or gnuplot is missing;
///         BadInput for JSON that is no such document
/// @returns what the report opens with
/// @param from  the folder that results.json and what runs kept beside it are in (default: dir)
reports::ReportDigest writeReport(const nlohmann::json& results, const std::filesystem::path& dir,
                                  const std::filesystem::path& from);
reports::ReportDigest writeReport(const nlohmann::json& results, const std::filesystem::path& dir);
void writeReport(const CollideResults& results, const std::filesystem::path& dir);
void writeReport(const ConformanceResults& results, const std::filesystem::path& dir);
void writeReport(const CostResults& results, const std::filesystem::path& dir);
void writeReport(const ScaleResults& results, const std::filesystem::path& dir);
void writeReport(const StabilityResults& results, const std::filesystem::path& dir);
void writeReport(const CompareResults& results, const std::filesystem::path& dir);
void writeReport(const EffectsResults& results, const std::filesystem::path& dir);
void writeReport(const LockstepResults& results, const std::filesystem::path& dir);
void writeReport(const RevResults& results, const std::filesystem::path& dir);
void writeReport(const ThesisResults& results, const std::filesystem::path& dir);

/// Writes the reports of several results into folders of their own below `site`, named after
/// theirs, and an index of all. @throws as writeReport()
/// @param results  each with the folder that it was read from
void writeSite(const std::vector<std::pair<std::filesystem::path, nlohmann::json>>& results,
               const std::filesystem::path& site);

/// Reads dir/results.json back, to rebuild its report.
/// @throws BadInput if there is none, it is not JSON, or its schema is not this version's
nlohmann::json readResults(const std::filesystem::path& dir);

}  // namespace crossgrain
