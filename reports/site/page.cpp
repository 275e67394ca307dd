#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <iterator>
#include <map>

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

/// Where results were made, and with which program.
std::string originOf(const ResultsHead& head) {
  std::string origin = fmt::format("{} · crossgrain {}", head.started, stampOf(head));
  for (const std::string& part : {head.machine.cpu, head.machine.os})
    if (!part.empty()) origin += " · " + part;
  return origin;
}

/// Where it was made, and whether of a changed case.
void addOrigin(Blocks& blocks, const SiteReport& report) {
  blocks.push_back(Paragraph{originOf(report.digest.head), Paragraph::Style::small});
  if (!report.changedCase.empty())
    blocks.push_back(
        Paragraph{"Changed case: " + report.changedCase + ".", Paragraph::Style::warning});
}

/// Results of changed cases that a site shows beside others, one line each.
std::vector<std::string> changedCaseNotes(const std::vector<SiteReport>& reports) {
  std::vector<std::string> notes;
  for (const SiteReport& report : reports)
    if (!report.changedCase.empty())
      notes.push_back(fmt::format("Changed case: {} ({}; {}): {}.", nameOf(report.digest.head),
                                  report.folder, originOf(report.digest.head), report.changedCase));
  return notes;
}

void addReports(Report& index, const std::vector<SiteReport>& reports) {
  Blocks& blocks = index.section("reports", "Reports").blocks;
  for (const SiteReport& report : reports) {
    const ResultsHead& head = report.digest.head;
    blocks.push_back(Heading{titleOf(head)});
    addOrigin(blocks, report);
    for (const std::string& sentence : report.digest.overview.conclusion)
      blocks.push_back(Paragraph{sentence});
    Links links;
    for (const char* name : {"report.html", "summary.md"})
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

/// With its version.
std::string versionedName(const EngineRow& engine) {
  return engine.version.empty() ? engine.name : engine.name + " " + engine.version;
}

/// An engine's checks of a report with such answers, the first of many, without `most` all.
Table checksOf(const std::vector<JUnitCase>& checks, const std::string& engine, std::size_t most,
               bool (*wanted)(const JUnitCase&)) {
  Table table{{"case", "check", "answer", {"why", Column::Kind::remark}}, {}};
  std::size_t left = 0;
  for (const JUnitCase& one : checks) {
    if (one.engine != engine || !wanted(one)) continue;
    if (table.rows.size() == most) {
      ++left;
      continue;
    }
    std::string name = one.name;
    if (name.starts_with(engine + ": ")) name.erase(0, engine.size() + 2);
    const std::string answer(one.broke ? "engine broke down" : lookOf(one.verdict).words);
    table.rows.push_back({{one.group, name, Cell{answer, {}, one.verdict}, one.message}});
  }
  if (left > 0) table.note = fmt::format("The report has {} more.", counted(left, "check"));
  return table;
}

/// "3 of 6 checks passed, 2 borderline; the engine broke down in 1."; empty: none is judged.
std::string describeChecks(const std::vector<JUnitCase>& checks, const std::string& engine) {
  std::map<Verdict, std::size_t> of;
  std::size_t judged = 0, broke = 0;
  for (const JUnitCase& one : checks) {
    if (one.engine != engine || (!one.broke && !isJudged(one.verdict))) continue;
    ++judged;
    ++(one.broke ? broke : of[one.verdict]);
  }
  if (judged == 0) return {};
  std::string words = fmt::format("{} of {} passed", of[Verdict::pass], counted(judged, "check"));
  for (const auto& [verdict, count] : of)
    if (verdict != Verdict::pass)
      words += fmt::format(
          ", {} {}", count,
          verdict == Verdict::modelDifference ? "differ by their model" : lookOf(verdict).words);
  if (broke > 0) words += fmt::format("; the engine broke down in {}", broke);
  return words + ".";
}

bool showsNothing(const JUnitCase& one) {
  return !one.broke && !isJudged(one.verdict);
}

bool isOpen(const JUnitCase& one) {
  return !showsNothing(one) && one.verdict != Verdict::pass;
}

/// Its numbers that the matrix does not have.
Table valuesOf(const ReportDigest& digest, const std::string& engine) {
  Table table{{"quantity", {"value", Column::Kind::number}}, {}};
  for (const DigestValue& value : digest.values)
    if (value.engine == engine) table.rows.push_back({{value.quantity, value.cell.shown}});
  return table;
}

void writeEnginePages(const std::vector<SiteReport>& reports, const std::filesystem::path& site) {
  const std::vector<EnginePage> pages = enginePages(reports);
  const std::vector<EngineRow> engines = siteEngines(reports);
  for (const EnginePage& page : pages) {
    const EngineRow& engine = page.engine;
    Report report{{{}, engines, engineOverview(page.reports, engine.name)}};
    report.head.setup.name = "crossgrain: " + versionedName(engine);
    report.wrapped = true;
    report.notes =
        nonEmpty({engine.summary, engine.mirrors.empty()
                                      ? ""
                                      : "A mirror: the in-house engine with the conventions of " +
                                            engine.mirrors + "."});
    std::ranges::move(changedCaseNotes(page.reports), std::back_inserter(report.notes));
    Links links{{{"all engines", "index.html"}}};
    for (const EnginePage& other : pages)
      if (other.engine.name == engine.name && other.file != page.file)
        links.links.emplace_back(versionedName(other.engine), other.file);
    report.section("about", "About this page").blocks = {
        Paragraph{report.overview.rows.empty()
                      ? "It took part in these reports, but none of them judges it."
                      : "Each cell links to its report; the page needs the reports' folders beside "
                        "it."},
        std::move(links)};
    addEngineReports(report, page);
    addHistory(report, reports, engine.name);
    writeFile(site / page.file, html(report, {}));
  }
}

}  // namespace

std::vector<EnginePage> enginePages(const std::vector<SiteReport>& reports) {
  std::vector<EnginePage> pages;
  std::vector<std::string> names;
  for (const EngineRow& engine : siteEngines(reports)) {
    std::vector<EnginePage> versions;
    std::vector<SiteReport> latestFirst;
    for (const SiteReport& report : reports)
      if (engineIn(report, engine.name)) latestFirst.push_back(report);
    std::ranges::stable_sort(latestFirst, std::ranges::greater(),
                             [](const SiteReport& report) { return report.digest.head.started; });
    const auto versionIn = [&](const SiteReport& report) {
      return engineIn(report, engine.name)->version;
    };
    // Where it was refused before it was asked for its version, the latest has its place.
    const auto known = std::ranges::find_if(
        latestFirst, [&](const SiteReport& report) { return !versionIn(report).empty(); });
    for (const SiteReport& report : latestFirst) {
      const SiteReport& named =
          versionIn(report).empty() && known != latestFirst.end() ? *known : report;
      const EngineRow& own = *engineIn(named, engine.name);
      auto found = std::ranges::find(versions, own.version,
                                     [](const EnginePage& page) { return page.engine.version; });
      if (found == versions.end()) found = versions.insert(versions.end(), {own, "", {}});
      found->reports.push_back(report);
    }
    for (EnginePage& page : versions) {
      addOnce(names,
              "engine-" + forAddress(page.engine.name) +
                  (page.engine.version.empty() ? "" : "-" + forAddress(page.engine.version)));
      page.file = names.back() + ".html";
      pages.push_back(std::move(page));
    }
  }
  return pages;
}

void addEngineReports(Report& page, const EnginePage& engine) {
  constexpr std::size_t most = 40;  // checks that a page shows of a report
  const std::string& name = engine.engine.name;
  for (const SiteReport& report : engine.reports) {
    Blocks& blocks = page.section(report.folder, nameOf(report.digest.head)).blocks;
    addOrigin(blocks, report);
    if (const EngineRow* const own = engineIn(report, name); own && own->status != Status::finished)
      blocks.push_back(
          Paragraph{std::string(nameOf(own->status, engineStatusNames)) + ": " + own->reason});
    const auto& checks = report.digest.checks.value_or(std::vector<JUnitCase>{});
    if (std::string words = describeChecks(checks, name); !words.empty())
      blocks.push_back(Paragraph{std::move(words)});
    for (Table table : {checksOf(checks, name, most, isOpen), valuesOf(report.digest, name)})
      if (!table.rows.empty()) blocks.push_back(std::move(table));
    if (Table without = checksOf(checks, name, most, showsNothing); !without.rows.empty()) {
      const auto count = std::ranges::count_if(
          checks, [&](const JUnitCase& one) { return one.engine == name && showsNothing(one); });
      blocks.push_back(Details{
          counted(static_cast<std::size_t>(count), "check") + " not measured or not applicable",
          {std::move(without)}});
    }
    blocks.push_back(Links{{{"report", pageOf(report)}}});
  }
}

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

void writeIndex(const std::vector<SiteReport>& reports, const std::filesystem::path& site) {
  Report index{{{}, siteEngines(reports), siteOverview(reports)}};
  index.head.setup.name = "crossgrain: " + counted(reports.size(), "report");
  index.notes = changedCaseNotes(reports);
  addHistory(index, reports);
  addReports(index, reports);
  index.section("files", "Files").blocks = {Paragraph{
      "This page needs the reports' folders beside it. They have each report's page, drawings and "
      "small tables, whose columns docs/results.md of crossgrain describes; results.json and what "
      "else there is stay in the results folders."}};
  std::vector<JUnitCase> cases;
  for (const SiteReport& report : reports)
    std::ranges::move(overviewCases(report.digest.overview, report.folder),
                      std::back_inserter(cases));
  writeFile(site / "junit.xml", junitXml("reports", cases));
  writeFile(site / "summary.md", overviewMarkdown(index.overview, titleOf(index.head)));
  writeEnginePages(reports, site);
  writeFile(site / "index.html", html(index, {}));
}

}  // namespace crossgrain::reports
