#include <fmt/format.h>

#include <fcntl.h>
#include <spawn.h>
#include <unistd.h>
#include <cstring>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "cases/case_keys.hpp"
#include "cli/option_groups.hpp"
#include "cli/outcome.hpp"
#include "reports/common/report.hpp"
#include "reports/report.hpp"
#include "results/head.hpp"
#include "results/schema.hpp"
#include "studies/core/run_store.hpp"
#include "support/bad_input.hpp"
#include "support/files.hpp"
#include "support/folder_lock.hpp"
#include "support/json_text.hpp"

namespace crossgrain::inline cli {

namespace fs = std::filesystem;

namespace {

/// @throws BadInput if nothing here opens pages
void requireBrowser() {
  if (!isOnPath("xdg-open"))
    throw BadInput("--open: there is no program 'xdg-open' in PATH (Debian: package xdg-utils)");
}

/// Shows a page in the user's browser, which is left to itself.
/// @throws std::runtime_error, one line, if it could not be started
void openPage(const std::filesystem::path& page) {
  std::string program = "xdg-open", path = std::filesystem::absolute(page).string();
  char* const arguments[] = {program.data(), path.data(), nullptr};
  posix_spawn_file_actions_t silent;
  posix_spawn_file_actions_init(&silent);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&silent, stream, "/dev/null", O_RDWR, 0);
  pid_t child = 0;
  const int error = posix_spawnp(&child, program.c_str(), &silent, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&silent);
  if (error != 0)
    throw std::runtime_error(
        fmt::format("xdg-open could not be started: {}", std::strerror(error)));
}

struct ReportOptions {
  std::optional<std::string> site;
  bool open = false, changedCases = false;
};

int rebuildReports(const CommandLine& line, const ReportOptions& options) {
  std::vector<std::string> pages;
  for (const fs::path& folder : line.inputs) {
    const nlohmann::json results = readResults(folder);
    if (options.open) requireBrowser();
    const FolderLock lock(folder, "report");
    writeReport(results, folder);
    const fs::path page = folder / "report.html";
    if (line.json)
      pages.push_back(page.string());
    else
      fmt::print("report: {}\n", page.string());
    if (options.open) openPage(page);
  }
  if (line.json) printJson({{"reports", pages}});
  return exitPassed;
}

/// Results made elsewhere are of the same case as those beside them that bear its name, or their
/// figures would stand in one row without being comparable. Where it may differ, the entry says so.
/// @throws BadInput naming both folders and what differs
void compareCases(std::vector<SiteEntry>& entries, bool mayDiffer) {
  std::map<std::string, std::pair<fs::path, CaseKeys>> firsts;
  for (SiteEntry& entry : entries) {
    ResultsHead head;
    understood(entry.folder / "results.json", [&] { readFrom(entry.results, head); });
    const std::string name = reports::nameOf(head);
    const CaseKeys keys = resultAffectingKeys(head.setup.toml);
    const auto& [folder, before] = firsts.try_emplace(name, entry.folder, keys).first->second;
    const auto different = changes(before, keys);
    if (different.empty()) continue;
    if (!mayDiffer)
      throw BadInput(fmt::format(
          "{} and {} are both {}, and the case is not the same: {}; give it another name, or "
          "--changed-cases to have them side by side",
          folder.string(), entry.folder.string(), name, describeChanges(different)));
    entry.changedCase =
        fmt::format("{}, compared with {}", describeChanges(different), folder.string());
  }
}

/// The folders stay as they are.
int makeSite(const CommandLine& line, const ReportOptions& options) {
  const fs::path site = *options.site;
  if (fs::exists(site / "results.json"))
    throw BadInput(
        fmt::format("--out {}: holds results of its own; give a new folder, or that of "
                    "an earlier site",
                    site.string()));
  std::vector<SiteEntry> entries;
  for (const fs::path& folder : line.inputs) entries.push_back({folder, readResults(folder)});
  compareCases(entries, options.changedCases);
  if (options.open) requireBrowser();
  makeDirectory(site);
  const FolderLock lock(site, "report");
  writeSite(entries, site);
  const fs::path page = site / "index.html";
  if (line.json)
    printJson({{"site", page.string()}});
  else
    fmt::print("site: {}\n", page.string());
  if (options.open) openPage(page);
  return exitPassed;
}

Action declareReport(CLI::App& app, CommandLine& line) {
  addInputs(app, line, "folder", "folders with a results.json", 1, anyNumber);
  const auto options = std::make_shared<ReportOptions>();
  addText(app, "--out", options->site,
          "folder for a site: a copy of each report, and an index.html that lists them "
          "(default: each report is rebuilt in its own folder)",
          "SITE");
  addFlag(app, "--changed-cases", options->changedCases,
          "for a site: accept cases of one name that differ; the index says in what");
  addJson(app, line);
  addFlag(app, "--open", options->open, "open the report or site in the browser");
  return [&line, options] {
    return options->site ? makeSite(line, *options) : rebuildReports(line, *options);
  };
}

}  // namespace

extern const Command reportCommand = {
    "report", "rebuild reports from results.json, or make one site of several reports",
    "crossgrain report out/compare\n"
    "crossgrain report out/compare --open\n"
    "crossgrain report out/compare out/collide --out out/site",
    declareReport};

}  // namespace crossgrain::inline cli
