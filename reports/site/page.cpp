#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>

#include "reports/common/overview.hpp"
#include "reports/common/page.hpp"
#include "reports/common/templates.hpp"
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
                    {"version", head.version},
                    {"command", head.command},
                    {"conclusion", overview ? Json(overview->conclusion) : Json::array()},
                    {"summary", overview.has_value()},
                    {"tables", report.tables}});
  }
  return rows;
}

}  // namespace

std::vector<std::string> siteFolders(const std::vector<std::filesystem::path>& results) {
  std::vector<std::string> names;
  for (const std::filesystem::path& folder : results) {
    const auto plain = std::filesystem::absolute(folder).lexically_normal();
    // Of "out/" the last part is empty.
    const std::string own =
        (plain.has_filename() ? plain : plain.parent_path()).filename().string();
    std::string name = forAddress(own);
    for (int k = 2; std::ranges::find(names, name) != names.end(); ++k)
      name = fmt::format("{}-{}", forAddress(own), k);
    names.push_back(std::move(name));
  }
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
               {"reports", reportRows(reports)}};
  addOverview(view, overview, siteEngines(reports));
  std::vector<JUnitCase> cases;
  for (const SiteReport& report : reports)
    if (report.digest.overview && report.digest.head.kind != kindThesis)
      std::ranges::move(overviewCases(*report.digest.overview, report.folder),
                        std::back_inserter(cases));
  writeFile(site / "junit.xml", junitXml("reports", cases));
  writeFile(site / "summary.md", overviewMarkdown(overview, "crossgrain: " + heading));
  writeFile(site / "index.html", render("site.html", view));
}

}  // namespace crossgrain::reports
