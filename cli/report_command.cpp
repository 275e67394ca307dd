#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>

#include "cli/open_page.hpp"
#include "cli/option_groups.hpp"
#include "reports/report.hpp"
#include "results/json_fields.hpp"
#include "results/schema.hpp"
#include "runs/thesis/thesis.hpp"
#include "support/bad_input.hpp"
#include "support/folder_lock.hpp"

namespace crossgrain::inline cli {

namespace fs = std::filesystem;

namespace {

/// What is concluded from runs follows from them anew; all else is as it was.
nlohmann::json concludedAnew(const nlohmann::json& results, const fs::path& folder,
                             const std::optional<fs::path>& reasons) try {
  if (results.at("kind") == kindThesis)
    return toJson(judgedAgain(thesisFromJson(results), reasons));
  if (reasons)
    throw BadInput(fmt::format("--reasons: {} is not of thesis, whose claims have reasons",
                               (folder / "results.json").string()));
  return results;
} catch (const FieldError& error) {
  throw BadInput(fmt::format("{}: {}", (folder / "results.json").string(), error.what()));
}

int rebuildReports(const CommandLine& line, const std::optional<fs::path>& reasons, bool open) {
  if (open) requireBrowser();
  for (const fs::path& folder : line.inputs) {
    const nlohmann::json results = concludedAnew(readResults(folder), folder, reasons);
    const FolderLock lock(folder, "report");
    writeReport(results, folder);
    fmt::print("report: {}\n", (folder / "report.html").string());
    if (open) openPage(folder / "report.html");
  }
  return exitHeld;
}

Action declareReport(CLI::App& app, CommandLine& line) {
  addInputs(app, line, "folder", "folders that hold a results.json", 1, anyNumber);
  const auto reasons = std::make_shared<std::optional<std::string>>();
  const auto open = std::make_shared<bool>(false);
  addText(app, "--reasons", *reasons,
          "of thesis: reasons found for refuted claims, in place of those that it was given",
          "FILE");
  addFlag(app, "--open", *open, "show them in the browser");
  return [&line, reasons, open] {
    return rebuildReports(line, *reasons ? std::optional<fs::path>(**reasons) : std::nullopt,
                          *open);
  };
}

}  // namespace

extern const Command reportCommand = {"report", "rebuild reports from results.json",
                                      "crossgrain report out\n"
                                      "crossgrain report out --open",
                                      declareReport};

}  // namespace crossgrain::inline cli
