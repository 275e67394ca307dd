#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "cases/case_files.hpp"
#include "cases/effect_switch.hpp"
#include "cases/flow.hpp"
#include "cases/loader.hpp"
#include "cli/option_groups.hpp"
#include "cli/outcome.hpp"
#include "reports/common/text.hpp"
#include "studies/check/case_check.hpp"
#include "studies/core/engine_access.hpp"
#include "studies/core/executor.hpp"
#include "studies/core/mirrors.hpp"
#include "studies/core/study.hpp"
#include "support/scratch_folder.hpp"
#include "support/terminal.hpp"

namespace crossgrain::inline cli {

using nlohmann::json;

namespace {

struct CheckOptions {
  bool resolved = false, untimed = false;
};

/// "0.4 s", "12 min", "3.1 h"
std::string lasting(double seconds) {
  if (seconds < 100.0) return fmt::format("{:.2g} s", seconds);
  if (seconds < 6000.0) return fmt::format("{:.3g} min", seconds / 60.0);
  return fmt::format("{:.3g} h", seconds / 3600.0);
}

double number(const json& at, const char* key) {
  return at[key].get<double>();
}

/// A line of the text, or several.
template <typename... Values>
void say(fmt::format_string<Values...> text, Values&&... values) {
  printText(fmt::format(text, std::forward<Values>(values)...));
}

void printCell(const json& cell) {
  say("  volume fraction {:.4f}, about {:.3f} between the walls' layers; wall disks: {} on the "
      "wheel, {} on the ring\n",
      number(cell, "volume_fraction"), number(cell, "bulk_volume_fraction"),
      number(cell, "wheel_disks"), number(cell, "ring_disks"));
  say("  expected: {:.0f} to {:.0f} contacts{}\n", cell["expected_contacts"][0].get<double>(),
      cell["expected_contacts"][1].get<double>(),
      cell["expected_pressure"].is_number()
          ? fmt::format(
                ", pressure {:.1g} N/m², inertial number {:.1g} at the wheel (to a factor of "
                "three)",
                number(cell, "expected_pressure"), number(cell, "expected_inertial_number"))
          : "");
}

void printFlow(const json& checked, bool verbose) {
  const json& flow = checked["flow"];
  say("  per packing: {:.0f} steps of the case's dt, {:.4g} s{}; packings: {}\n",
      number(flow, "steps"), number(flow, "duration_s"),
      checked.contains("cell")
          ? fmt::format(", {:g} rotations", number(checked["cell"], "rotations"))
          : "",
      fmt::join(flow["looks"].get<std::vector<int>>(), ", then "));
  if (!verbose) return;
  for (const auto& [list, what] : {std::pair("endpoints", "endpoint"), {"margins", "field"}})
    for (const json& margin : checked[list]) {
      const std::string unit = margin["relative"] == true ? "of the reference" : margin["unit"],
                        scale = margin["of"];
      say("  margin of {} {}: {:g}{}{}\n", what, margin[what].get<std::string>(),
          number(margin, "value"), unit.empty() ? "" : " " + unit,
          scale.empty() ? "" : ", a share of " + scale);
    }
}

/// "friction, rotation", "none"
std::string listed(const json& names) {
  const auto list = names.get<std::vector<std::string>>();
  return list.empty() ? "none" : fmt::format("{}", fmt::join(list, ", "));
}

/// @param inFull  differences one by one
void printEngine(const json& row, bool inFull) {
  const std::string name = row["name"];
  const std::string head = fmt::format("  {:<16} ", name);
  const auto entry = [&](const std::string& text) {
    fmt::print("{}\n", wrapped(head + text, terminalWidth(STDOUT_FILENO), displayWidth(head)));
  };
  if (row["can"] == false) {
    const std::string reason = row["reason"];  // "yade cannot run FILE: has no …"
    const std::size_t why =
        reason.starts_with(name + " cannot run ") ? reason.find(": ") : reason.npos;
    entry("cannot: " + (why == reason.npos ? reason : reason.substr(why + 2)));
    return;
  }
  std::string text = "can run it";
  if (row.contains("dt_s")) text += fmt::format(", dt {:.3g} s", number(row, "dt_s"));
  std::string cost;
  if (row.contains("run_s")) {
    cost = fmt::format("{:.3g} µs a step: {} a packing", 1e6 * number(row, "step_s"),
                       lasting(number(row, "run_s")));
    if (row["memory_bytes"].is_number())
      cost += fmt::format(", {:.0f} MB", number(row, "memory_bytes") / 1e6);
  }
  const std::size_t differences = row["deviations"].size() + row["not_simulated"].size();
  if (!inFull) {
    if (!cost.empty()) text += fmt::format(", {} a packing", lasting(number(row, "run_s")));
    if (differences > 0) text += ", " + counted(differences, "difference");
    return entry(text);
  }
  entry(text);
  if (!cost.empty()) say("    {}\n", cost);
  for (const json& note : row["deviations"]) say("    differs: {}\n", note.get<std::string>());
  if (!row["not_simulated"].empty())
    say("    does not simulate: {}\n", listed(row["not_simulated"]));
}

void printChecked(const json& checked, const CommandLine& line) {
  const std::string variant = checked["variant"], name = checked["name"];
  const char* const round = checked.contains("dimension") ? "sphere" : "disk";
  const auto count = [&](const char* key, const std::string& noun) {
    return counted(checked[key].get<std::size_t>(), noun);
  };
  say("{}: {}, {}, dt {:.3g} s\n", variant.empty() ? name : variant,
      count("disks", checked.contains("shapes") ? "body" : round),
      count("wall_disks", std::string("wall ") + round), number(checked, "dt_s"));
  say("  effects called for: {}; left out: {}\n", listed(checked["effects"]),
      listed(checked["left_out"]));
  if (checked["steps_per_contact"].is_number())
    say("  {:.3g} steps in the shortest contact; dt may be at most {:.3g} s\n",
        number(checked, "steps_per_contact"), number(checked, "step_limit_s"));
  if (checked.contains("cell")) printCell(checked["cell"]);
  if (checked.contains("flow")) printFlow(checked, line.verbose);
  if (const auto shared = checked["shared_conventions"].get<std::vector<std::string>>();
      !shared.empty())
    say("  {}\n", describeShared(shared));
  for (const json& caution : checked["cautions"])
    say("  caution: {}\n", caution.get<std::string>());
  bool differs = false;
  for (const json& row : checked["engines"]) {
    if (row["mirrors"] != "" && !line.verbose) continue;
    const bool inFull =
        line.verbose || std::ranges::find(line.run.engines, row["name"].get<std::string>()) !=
                            line.run.engines.end();
    printEngine(row, inFull);
    differs |= !inFull && !row["deviations"].empty();
  }
  if (differs) say("  -v prints the differences from the scene\n");
  if (!checked.contains("prediction")) return;
  const json& prediction = checked["prediction"];
  const auto looks = checked["flow"]["looks"].get<std::vector<int>>();
  const double packings = looks.back(), first = looks.front() / packings;
  say("  predicted time of compare: {} on one core for all {} packings, {} of it to prepare "
      "them{}; "
      "steps were timed on {}\n",
      lasting(number(prediction, "total_s")), packings, lasting(number(prediction, "preparing_s")),
      first < 1.0 ? fmt::format(" ({} for the first {}, after which decided engines stop)",
                                lasting(first * number(prediction, "total_s")), looks.front())
                  : "",
      prediction["timed_on"].get<std::string>());
}

/// Engines that "all" leaves out, since they are not installed.
void printMissing(const std::vector<std::string>& named) {
  if (std::ranges::find(named, "all") == named.end()) return;
  std::vector<std::string> names;
  for (const EngineEntry& entry : engineRegistry())
    if (entry.missing && !entry.missing().empty() && !isNamed(named, entry))
      names.push_back(entry.name);
  if (!names.empty())
    say("  not installed: {} (`crossgrain engines` says why)\n", fmt::join(names, ", "));
}

int checkCase(const CommandLine& line, const CheckOptions& options) {
  const auto load = [&](const std::vector<std::string>& overrides) {
    std::vector<Case> loaded = loadCase(line.inputs.front(), overrides);
    return line.only ? selectedCases(loaded, *line.only) : loaded;
  };
  std::vector<Case> cases = load(line.overrides);
  if (options.resolved) {
    fmt::print("{}", resolvedFile(cases));
    return exitPassed;
  }
  std::vector<std::string> shared;  // as compare takes them
  if (cases.size() == 1 && hasFlow(cases.front()))
    shared = sharedConventionsOf(cases.front(), line.run.engines);
  if (!shared.empty()) {
    std::vector<std::string> overrides = line.overrides;
    overrides.insert(overrides.end(), shared.begin(), shared.end());
    cases = load(overrides);
  }
  reportKeysWithoutUse(cases, "check", line.json ? stderr : stdout);
  printNotes();
  const ScratchFolder scratch;
  // Where progress is not redrawn it is one line, and not beside that of a mistake.
  const bool redrawn = ::isatty(STDERR_FILENO) == 1;
  const bool quiet = line.json || line.run.quiet || options.untimed;
  Progress progress(quiet || !redrawn);
  const auto beforeTiming = [&](std::size_t engines) {
    constexpr std::size_t few = 4;
    if (!quiet && !redrawn && engines > few)
      say("timing steps of {} engines; --no-timing leaves that out\n", engines);
    std::fflush(stdout);
  };
  json all = json::array();
  for (const Case& setup : cases) {
    all.push_back(checkedCase(setup, line.run.engines, !options.untimed, scratch.path, progress,
                              beforeTiming));
    all.back()["shared_conventions"] = shared;
    if (line.json) continue;
    printChecked(all.back(), line);
    printMissing(line.run.engines);
  }
  if (line.json) fmt::print("{}\n", all.dump(2));
  bool failed = false, any = false;
  Outcome outcome;
  for (const json& checked : all) {
    for (const json& row : checked["engines"]) {
      const bool isMirror = row["mirrors"] != "";
      any |= row["can"] == true && !isMirror;
      if (row.value("failed", false)) {
        failed = true;
        printLines(stderr, fmt::format("crossgrain: {}\n", row["reason"].get<std::string>()));
      }
      const std::string name = row["name"];
      // One that was not named need not be made for such scenes.
      if (row["can"] == false && !isMirror &&
          std::ranges::find(line.run.engines, name) != line.run.engines.end())
        reports::addOnce(outcome.fails, name + " cannot run it");
    }
  }
  if (failed) return exitEngineFailed;
  if (!any) {  // nothing that was asked for can be done
    outcome.status = exitBadInput;
    outcome.failures.emplace_back("no engine that was asked for can run it");
  } else if (!outcome.fails.empty()) {
    outcome.status = exitFailed;
  }
  return printOutcome(line, outcome);
}

Action declareCheck(CLI::App& app, CommandLine& line) {
  const auto options = std::make_shared<CheckOptions>();
  addCase(app, line);
  addEngines(app, line, "all");
  addOverrides(app, line);
  addSelection(app, line);
  addFlag(app, "--json", line.json, "print everything as JSON");
  addQuiet(app, line);
  addVerbose(app, line);
  addFlag(app, "--resolved", options->resolved,
          "print only the case, merged with those that it extends, as a case file");
  addFlag(app, "--no-timing", options->untimed, "do not time steps or predict run times");
  return [&line, options] { return checkCase(line, *options); };
}

}  // namespace

extern const Command checkCommand = {
    "check", "report which engines can run a case, what to expect of it, and how long it takes",
    "crossgrain check cases/couette/quick.toml --engines all\n"
    "crossgrain check cases/couette/quick.toml --set cell.omega=0.1 --resolved",
    declareCheck};

}  // namespace crossgrain::inline cli
