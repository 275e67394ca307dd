#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>

#include "reports/common/overview.hpp"
#include "reports/common/sentences.hpp"
#include "reports/render/html.hpp"
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

void addReports(Report& index, const std::vector<SiteReport>& reports) {
  Blocks& blocks = index.section("reports", "Reports").blocks;
  for (const SiteReport& report : reports) {
    const ResultsHead& head = report.digest.head;
    blocks.push_back(Heading{titleOf(head)});
    blocks.push_back(Paragraph{fmt::format("{} · crossgrain {}", head.started, stampOf(head)),
                               Paragraph::Style::small});
    for (const std::string& sentence : report.digest.overview.conclusion)
      blocks.push_back(Paragraph{sentence});
    Links links;
    for (const char* name : {"report.html", "summary.md", "results.json"})
      links.links.emplace_back(name, report.folder + "/" + name);
    for (const std::string& name : report.tables)
      links.links.emplace_back(name, report.folder + "/" + name);
    blocks.push_back(std::move(links));
    if (!head.command.empty()) blocks.push_back(Code{head.command});
  }
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
    Report report{{{}, engines, engineOverview(reports, engine.name)}};
    report.head.setup.name = "crossgrain: " + engine.name;
    report.wrapped = true;
    report.notes = nonEmpty(
        {versionsOf(reports, engine), engine.summary,
         engine.mirrors.empty()
             ? ""
             : "A mirror: the in-house engine with the conventions of " + engine.mirrors + "."});
    report.section("reports", "Reports").blocks = {
        Paragraph{report.overview.rows.empty()
                      ? "It took part in these reports, and none has an answer of it."
                      : "Each cell links to the report that it is of; this page needs the folders "
                        "beside it."},
        Links{{{"all engines", "index.html"}}}};
    writeFile(site / pages[e], html(report, {}, {}));
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
  Report index{{{}, siteEngines(reports), siteOverview(reports)}};
  index.head.setup.name = "crossgrain: " + counted(reports.size(), "report");
  addHistory(index, reports);
  addReports(index, reports);
  index.section("files", "Files").blocks = {Paragraph{
      "Each report is one file that opens offline; this page needs the folders beside it. "
      "Columns of the tables: docs/results.md of crossgrain."}};
  std::vector<JUnitCase> cases;
  for (const SiteReport& report : reports)
    if (report.digest.head.kind != kindThesis)
      std::ranges::move(overviewCases(report.digest.overview, report.folder),
                        std::back_inserter(cases));
  writeFile(site / "junit.xml", junitXml("reports", cases));
  writeFile(site / "summary.md", overviewMarkdown(index.overview, titleOf(index.head)));
  writeEnginePages(reports, site);
  writeFile(site / "index.html", html(index, {}, {}));
}

}  // namespace crossgrain::reports
