#include "reports/report.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "reports/collide/report.hpp"
#include "reports/common/overview.hpp"
#include "reports/conformance/report.hpp"
#include "reports/cost/report.hpp"
#include "reports/effects/report.hpp"
#include "reports/flow/report.hpp"
#include "reports/lockstep/report.hpp"
#include "reports/render/gnuplot.hpp"
#include "reports/render/html.hpp"
#include "reports/site/site.hpp"
#include "reports/stability/report.hpp"
#include "results/json_fields.hpp"
#include "results/schema.hpp"
#include "support/bad_input.hpp"
#include "support/files.hpp"
#include "support/json_text.hpp"
#include "support/scratch_folder.hpp"

namespace crossgrain {

namespace {

using namespace reports;
using reports::reportOf;  // beside those here

Report reportOf(const CompareResults& results) {
  return results.head.kind == kindAverage ? averageReport(results) : compareReport(results);
}

/// @returns why there are no plots, if so
std::optional<GnuplotError> draw(const Report& report, const std::filesystem::path& plots) {
  makeDirectory(plots);
  std::vector<std::string> scripts;
  for (const Figure& figure : report.figures) scripts.push_back(writeFigure(figure, plots));
  for (const Picture& picture : report.pictures) writePicture(picture, plots);
  try {
    runGnuplot(scripts, plots);
  } catch (const GnuplotError& error) {
    return error;
  }
  return std::nullopt;
}

/// Its tables and what it opens with.
void writeTexts(const Report& report, const std::filesystem::path& dir) {
  for (const auto& [name, table] : report.tables) writeFile(dir / name, table);
  writeFile(dir / "summary.md", overviewMarkdown(report.overview, titleOf(report.head)));
  if (report.checks) writeFile(dir / "junit.xml", junitXml(report.head.kind, *report.checks));
}

void writePage(const Report& report, DrawnFigures drawings,
               const std::optional<GnuplotError>& failure, const std::filesystem::path& dir) {
  if (failure) drawings.missing = failure->what();
  writeFile(dir / "report.html", html(report, drawings));
  if (failure) throw *failure;
}

/// @param document  results.json
template <typename Results>
ReportDigest write(const Results& results, Json document, const std::filesystem::path& dir) {
  const Report report = reportOf(results);
  makeDirectory(dir);
  document["overview"] = jsonOf(report.overview);
  writeFile(dir / "results.json", toText(document));
  writeTexts(report, dir);
  const auto plots = dir / "plots";
  const auto failure = draw(report, plots);
  writePage(report, {plots}, failure, dir);
  return report;
}

/// Of a site [bytes].
constexpr std::size_t largestTable = 128 << 10;

/// What a site has of a report: its page, drawings beside it, and no table that nobody reads there.
ReportDigest writeForSite(Report report, const std::filesystem::path& dir) {
  std::erase_if(report.tables,
                [](const auto& table) { return table.second.size() > largestTable; });
  makeDirectory(dir / "plots");
  writeTexts(report, dir);
  const ScratchFolder scratch;
  const auto failure = draw(report, scratch.path);
  const DrawnFigures drawings{dir / "plots", {}, true};
  for (const auto& drawn : std::filesystem::directory_iterator(scratch.path))
    if (drawn.path().extension() == ".svg")
      writeFile(drawings.folder / drawn.path().filename(), readFile(drawn.path()).value());
  writePage(report, drawings, failure, dir);
  return report;
}

/// Calls with the typed results of a document.
auto withResults(const Json& document, const auto& call) {
  checkSchema(document, "results");
  const std::string kind = document.at("kind");
  if (kind == kindCollide) return call(collideFromJson(document));
  if (kind == kindConformance) return call(conformanceFromJson(document));
  if (kind == kindCost) return call(costFromJson(document));
  if (kind == kindEffects) return call(effectsFromJson(document));
  if (kind == kindLockstep) return call(lockstepFromJson(document));
  if (kind == kindRev) return call(revFromJson(document));
  if (kind == kindStability) return call(stabilityFromJson(document));
  return call(compareFromJson(document));
}

}  // namespace

template <typename Results>
ReportDigest writeReport(const Results& results, const std::filesystem::path& dir) {
  return write(results, toJson(results), dir);
}
template ReportDigest writeReport(const CollideResults&, const std::filesystem::path&);
template ReportDigest writeReport(const CompareResults&, const std::filesystem::path&);
template ReportDigest writeReport(const ConformanceResults&, const std::filesystem::path&);
template ReportDigest writeReport(const CostResults&, const std::filesystem::path&);
template ReportDigest writeReport(const EffectsResults&, const std::filesystem::path&);
template ReportDigest writeReport(const LockstepResults&, const std::filesystem::path&);
template ReportDigest writeReport(const RevResults&, const std::filesystem::path&);
template ReportDigest writeReport(const StabilityResults&, const std::filesystem::path&);

ReportDigest writeReport(const nlohmann::json& results, const std::filesystem::path& dir,
                         const std::filesystem::path& from) {
  return understood(from / "results.json", [&] {
    return withResults(results, [&](const auto& typed) { return write(typed, results, dir); });
  });
}

ReportDigest writeReport(const nlohmann::json& results, const std::filesystem::path& dir) {
  return writeReport(results, dir, dir);
}

Report reportOf(const nlohmann::json& results) {
  return withResults(results, [](const auto& typed) { return reportOf(typed); });
}

void writeSite(const std::vector<SiteEntry>& entries, const std::filesystem::path& site) {
  makeDirectory(site);
  std::vector<std::filesystem::path> folders;
  for (const SiteEntry& entry : entries) folders.push_back(entry.folder);
  const std::vector<std::string> names = siteFolders(folders);
  std::vector<SiteReport> reports;
  for (std::size_t k = 0; k < entries.size(); ++k) {
    const std::filesystem::path& from = entries[k].folder;
    const std::filesystem::path dir = site / names[k];
    // Results that lie below the site stay whole.
    const auto write = [&] {
      return std::filesystem::exists(dir) && std::filesystem::equivalent(dir, from)
                 ? writeReport(entries[k].results, dir, from)
                 : understood(from / "results.json",
                              [&] { return writeForSite(reportOf(entries[k].results), dir); });
    };
    SiteReport report{names[k], write(), {}, entries[k].changedCase};
    for (const auto& entry : std::filesystem::directory_iterator(dir))
      if (entry.path().extension() == ".csv")
        report.tables.push_back(entry.path().filename().string());
    std::ranges::sort(report.tables);
    reports.push_back(std::move(report));
  }
  writeIndex(reports, site);
}

nlohmann::json readResults(const std::filesystem::path& dir) {
  return readResultsFile(dir / "results.json");
}

}  // namespace crossgrain
