#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "cli/option_groups.hpp"
#include "cli/outcome.hpp"
#include "runs/common/study_cases.hpp"
#include "runs/couette/lockstep_job.hpp"
#include "runs/lockstep/identify.hpp"
#include "support/bad_input.hpp"

namespace crossgrain::inline cli {

namespace {

std::string namesOr(const std::vector<std::string>& names, const char* none) {
  return names.empty() ? none : fmt::format("{}", fmt::join(names, ", "));
}

void printOption(const FoundOption& option) {
  const std::string found = fmt::format("{}", fmt::join(option.values, " | "));
  const std::string declared = option.declared.empty()
                                   ? "does not declare this option"
                                   : fmt::format("declares {}", fmt::join(option.declared, " | "));
  fmt::print("{:<17} {:<34} {}{}\n", option.name, found, declared,
             option.contradicts() ? "   <- not what was found" : "");
}

/// A plain sentence in place of tables where there is no mirror.
void print(const std::string& engine, const Identification& found) {
  fmt::print("{}: from {} starts, followed for {:.3g} ms\n", engine, found.starts,
             1e3 * found.time);
  if (found.closeEnough()) {
    for (const FoundOption& option : found.options) printOption(option);
    for (const FoundConstant& constant : found.constants)
      fmt::print("{:<17} {:+.4g} % of the case's   <- not the case's\n", constant.name,
                 100.0 * constant.change);
    if (!found.missing.empty() || !found.declaredMissing.empty())
      fmt::print("{:<17} {:<34} {}{}\n", "does not simulate",
                 namesOr(found.missing, "(simulates all)"),
                 found.declaredMissing.empty()
                     ? "declares that it simulates all"
                     : fmt::format("declares {}", fmt::join(found.declaredMissing, ", ")),
                 found.missing == found.declaredMissing ? "" : "   <- not what was found");
  }
  fmt::print("largest separation: {:.2e} d from the case's own law, {:.2e} d from the {}\n",
             found.before, found.left,
             found.closeEnough() ? "closest mirror" : "nearest mirror tried, which is none");
}

int identifyEngine(const CommandLine& line) {
  if (line.run.engines.size() != 1 || line.run.engines.front() == "all")
    throw BadInput("identify takes one engine: --engines NAME");
  const Case setup = onlyCase(line, "identify");
  const Identification found = runIdentify(setup, line.run);
  print(line.run.engines.front(), found);
  return found.contradicts() ? exitFellShort : exitHeld;
}

Action declareIdentify(CLI::App& app, CommandLine& line) {
  addCase(app, line);
  addEngines(app, line);
  addOverrides(app, line);
  addQuiet(app, line);
  return [&line] { return identifyEngine(line); };
}

}  // namespace

extern const Command identifyCommand = {
    "identify", "which conventions and constants an engine really has, found from outside",
    "crossgrain identify cases/couette/quick.toml --engines yade", declareIdentify};

}  // namespace crossgrain::inline cli
