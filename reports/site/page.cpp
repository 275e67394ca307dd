#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>

#include "reports/common/overview.hpp"
#include "reports/common/page.hpp"
#include "reports/common/sentences.hpp"
#include "reports/common/templates.hpp"
#include "reports/site/history.hpp"
#include "reports/site/site.hpp"
#include "results/schema.hpp"
#include "support/files.hpp"

namespace crossgrain::reports {

namespace {

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

Json reportRows(const std::vector<SiteReport>& reports) {
  Json rows = Json::array();
  for (const SiteReport& report : reports) {
    const ResultsHead& head = report.digest.head;
    const auto& overview = report.digest.overview;
    rows.push_back({{"folder", report.folder},
                    {"title", titleOf(head)},
                    {"started", head.started},
                    {"version", stampOf(head)},
                    {"command", head.command},
                    {"conclusion", overview ? Json(overview->conclusion) : Json::array()},
                    {"summary", overview.has_value()},
                    {"tables", report.tables}});
  }
  return rows;
}

/// The name or, where another has it, with a number.
void addOnce(std::vector<std::string>& names, const std::string& name) {
  std::string own = name;
  for (int k = 2; std::ranges::find(names, own) != names.end(); ++k)
    own = fmt::format("{}-{}", name, k);
  names.push_back(std::move(own));
}

/// "version 0.3.0 in compare quick and cost quick; version 0.2.0 in rev quick"
std::string versionsOf(const std::vector<SiteReport>& reports, const EngineRow& engine) {
  SaidOf said;
  for (const SiteReport& report : reports) {
    const auto& engines = report.digest.engines;
    const auto own = std::ranges::find(engines, engine.name, &EngineRow::name);
    if (own != engines.end() && !own->version.empty()) said.add(nameOfReport(report), own->version);
  }
  std::string words;
  for (const auto& [version, where] : said.all())
    words += fmt::format("{}version {} in {}", words.empty() ? "" : "; ", version, listed(where));
  return words;
}

void writeEnginePages(const std::vector<SiteReport>& reports, const std::filesystem::path& site) {
  const std::vector<EngineRow> engines = siteEngines(reports);
  const std::vector<std::string> pages = enginePages(engines);
  for (std::size_t e = 0; e < engines.size(); ++e) {
    const EngineRow& engine = engines[e];
    Json view = {{"style", templates().at("style.css")}, {"title", "crossgrain: " + engine.name},
                 {"kicker", "crossgrain engine"},        {"heading", engine.name},
                 {"meta", versionsOf(reports, engine)},  {"mirrors", engine.mirrors},
                 {"engineSummary", engine.summary}};
    addOverview(view, engineOverview(reports, engine.name), engines, true);
    writeFile(site / pages[e], render("engine.html", view));
  }
}

}  // namespace

std::vector<std::string> siteFolders(const std::vector<std::filesystem::path>& results) {
  std::vector<std::string> names;
  for (const std::filesystem::path& folder : results) {
    const auto plain = std::filesystem::absolute(folder).lexically_normal();
    // Of "out/" the last part is empty.
    addOnce(names,
            forAddress((plain.has_filename() ? plain : plain.parent_path()).filename().string()));
  }
  return names;
}

std::vector<std::string> enginePages(const std::vector<EngineRow>& engines) {
  std::vector<std::string> names;
  for (const EngineRow& engine : engines) addOnce(names, "engine-" + forAddress(engine.name));
  for (std::string& name : names) name += ".html";
  return names;
}

void writeIndex(const std::vector<SiteReport>& reports, const std::filesystem::path& site) {
  const Overview overview = siteOverview(reports);
  const std::string heading = counted(reports.size(), "report");
  Json view = {{"style", templates().at("style.css")},
               {"title", "crossgrain: " + heading},
               {"kicker", "crossgrain"},
               {"heading", heading},
               {"meta", ""},
               {"reports", reportRows(reports)},
               {"histories", historyViews(reports)}};
  view["hasHistory"] = !view["histories"].empty();
  addOverview(view, overview, siteEngines(reports));
  std::vector<JUnitCase> cases;
  for (const SiteReport& report : reports)
    if (report.digest.overview && report.digest.head.kind != kindThesis)
      std::ranges::move(overviewCases(*report.digest.overview, report.folder),
                        std::back_inserter(cases));
  writeFile(site / "junit.xml", junitXml("reports", cases));
  writeFile(site / "summary.md", overviewMarkdown(overview, "crossgrain: " + heading));
  writeEnginePages(reports, site);
  writeFile(site / "index.html", render("site.html", view));
}

}  // namespace crossgrain::reports
