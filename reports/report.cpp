#include "reports/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <optional>
#include <stdexcept>

#include "reports/collide/report.hpp"
#include "reports/conformance/report.hpp"
#include "reports/cost/report.hpp"
#include "reports/effects/report.hpp"
#include "reports/lockstep/report.hpp"
#include "reports/render/gnuplot.hpp"
#include "reports/render/html.hpp"
#include "reports/stability/report.hpp"
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
  Names scripts;
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

/// Writes a report for a site: its page, the drawings beside it, and tables of at most
/// largestTable.
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

/// Letters, digits and "-_." of a name, "-" for all else; no hidden file's.
std::string forAddress(const std::string& name) {
  std::string safe;
  for (const char c : name) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' ||
                       (c == '.' && !safe.empty());
    if (plain)
      safe += c;
    else if (!safe.ends_with('-'))
      safe += '-';
  }
  return safe.empty() ? "report" : safe;
}

/// Folders of a site: each entry's own name, with a number where another has it.
Names siteFolders(const std::vector<SiteEntry>& entries) {
  Names names;
  for (const SiteEntry& entry : entries) {
    const auto plain = std::filesystem::absolute(entry.folder).lexically_normal();
    // Of "out/" the last part is empty.
    const std::string name =
        forAddress((plain.has_filename() ? plain : plain.parent_path()).filename().string());
    std::string own = name;
    for (int k = 2; std::ranges::find(names, own) != names.end(); ++k)
      own = fmt::format("{}-{}", name, k);
    names.push_back(std::move(own));
  }
  return names;
}

/// The most severe verdict of a report's matrix, and whose it is in which questions.
reports::Cell verdictCell(const Overview& overview) {
  auto worst = Verdict::notMeasured;
  for (const OverviewRow& row : overview.rows) worst = moreSevere(worst, mostSevere(row));
  SaidOf said;
  for (const OverviewRow& row : overview.rows) {
    Names questions;
    for (std::size_t k = 0; k < row.cells.size(); ++k)
      if (row.cells[k].verdict == worst) questions.push_back(overview.columns[k].name);
    if (!questions.empty()) said.add(row.name, listedShortly(questions, 3));
  }
  Names places;
  if (worst != Verdict::pass && isJudged(worst))
    for (const auto& [questions, who] : said.all())
      places.push_back(fmt::format("{}: {}", listedShortly(who, 3), questions));
  return {std::string(lookOf(worst).words), {listedShortly(places, 3)}, worst, true};
}

TableRow rowOf(const std::string& folder, const ReportDigest& report, const std::string& changed) {
  const ResultsHead& head = report.head;
  reports::Cell name(titleOf(head), {folder, changed.empty() ? "" : "changed case: " + changed});
  name.link = folder + "/report.html";
  Names engines;
  for (const EngineRow& engine : report.engines)
    if (engine.mirrors.empty())
      engines.push_back(engine.name + (engine.version.empty() ? "" : " " + engine.version));
  const std::string build = head.build.empty() ? "" : fmt::format(" ({})", head.build);
  return {
      {std::move(name),
       verdictCell(report.overview),
       fmt::format("{}", fmt::join(engines, ", ")),
       {head.started,
        {fmt::format("crossgrain {}{}", head.version, build), head.machine.cpu, head.machine.os}}}};
}

/// Calls with the typed results of a document.
auto withResults(const Json& document, const auto& call) {
  checkSchema(document, "results");
  const std::string kind = document.at("kind");
  if (kind == kindCollide) return call(fromJson<CollideResults>(document));
  if (kind == kindConformance) return call(fromJson<ConformanceResults>(document));
  if (kind == kindCost) return call(fromJson<CostResults>(document));
  if (kind == kindEffects) return call(fromJson<EffectsResults>(document));
  if (kind == kindLockstep) return call(fromJson<LockstepResults>(document));
  if (kind == kindRev) return call(fromJson<RevResults>(document));
  if (kind == kindStability) return call(fromJson<StabilityResults>(document));
  return call(fromJson<CompareResults>(document));
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
  const Names names = siteFolders(entries);
  Table table{{"report", "verdict", "engines", "made"}};
  std::vector<JUnitCase> cases;
  for (std::size_t k = 0; k < entries.size(); ++k) {
    const auto& [from, results, changed] = entries[k];
    const std::filesystem::path dir = site / names[k];
    // Results that lie below the site stay whole.
    const bool below = std::filesystem::exists(dir) && std::filesystem::equivalent(dir, from);
    const ReportDigest report =
        below ? writeReport(results, dir, from) : understood(from / "results.json", [&] {
          return writeForSite(reportOf(results), dir);
        });
    table.rows.push_back(rowOf(names[k], report, changed));
    std::ranges::move(overviewCases(report.overview, names[k]), std::back_inserter(cases));
  }
  table.note =
      "Verdict: the most severe of a report's matrix, and whose it is in which questions. This "
      "page needs the reports' folders beside it; results.json and tables of more than 128 KiB "
      "stay in the results folders.";
  Report index;
  index.head.setup.name = "crossgrain: " + counted(entries.size(), "report");
  writeFile(site / "junit.xml", junitXml("reports", cases));
  writeFile(site / "summary.md", tableMarkdown(table, titleOf(index.head)));
  index.section("reports", "Reports").blocks = {std::move(table)};
  writeFile(site / "index.html", html(index, {}));
}

nlohmann::json readResults(const std::filesystem::path& dir) {
  return readResultsFile(dir / "results.json");
}

}  // namespace crossgrain
