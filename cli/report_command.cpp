#include <fmt/format.h>

#include "cli/option_groups.hpp"
#include "reports/report.hpp"
#include "support/folder_lock.hpp"

namespace crossgrain::inline cli {

namespace fs = std::filesystem;

namespace {

int rebuildReports(const CommandLine& line) {
  for (const fs::path& folder : line.inputs) {
    const nlohmann::json results = readResults(folder);
    const FolderLock lock(folder, "report");
    writeReport(results, folder);
    fmt::print("report: {}\n", (folder / "report.html").string());
  }
  return exitHeld;
}

Action declareReport(CLI::App& app, CommandLine& line) {
  addInputs(app, line, "folder", "folders that hold a results.json", 1, anyNumber);
  return [&line] { return rebuildReports(line); };
}

}  // namespace

extern const Command reportCommand = {"report", "rebuild reports from results.json",
                                      "crossgrain report out", declareReport};

}  // namespace crossgrain::inline cli
