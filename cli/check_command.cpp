#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "cases/effect_switch.hpp"
#include "cases/flow.hpp"
#include "cases/loader.hpp"
#include "cli/option_groups.hpp"
#include "studies/check/case_check.hpp"
#include "studies/core/engine_access.hpp"
#include "studies/core/executor.hpp"
#include "studies/core/shared_conventions.hpp"
#include "studies/core/study_cases.hpp"
#include "support/scratch_folder.hpp"

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

void printCell(const json& cell) {
  fmt::print(
      "  volume fraction {:.4f}, about {:.3f} between the walls' layers; wall disks: {} on the "
      "wheel, {} on the ring\n",
      number(cell, "volume_fraction"), number(cell, "bulk_volume_fraction"),
      number(cell, "wheel_disks"), number(cell, "ring_disks"));
  fmt::print("  expected: {:.0f} to {:.0f} contacts", cell["expected_contacts"][0].get<double>(),
             cell["expected_contacts"][1].get<double>());
  if (cell["expected_pressure"].is_number())
    fmt::print(", pressure {:.1g} N/m², inertial number {:.1g} at the wheel (to a factor of three)",
               number(cell, "expected_pressure"), number(cell, "expected_inertial_number"));
  fmt::print("\n");
}

void printFlow(const json& checked) {
  const json& flow = checked["flow"];
  fmt::print("  per packing: {:.0f} steps of the case's dt, {:.4g} s{}; packings: {}\n",
             number(flow, "steps"), number(flow, "duration_s"),
             checked.contains("cell")
                 ? fmt::format(", {:g} rotations", number(checked["cell"], "rotations"))
                 : "",
             fmt::join(flow["looks"].get<std::vector<int>>(), ", then "));
  for (const auto& [list, what] : {std::pair("endpoints", "endpoint"), {"margins", "field"}})
    for (const json& margin : checked[list]) {
      const std::string unit = margin["relative"] == true ? "of the reference" : margin["unit"],
                        scale = margin["of"];
      fmt::print("  margin of {} {}: {:g}{}{}\n", what, margin[what].get<std::string>(),
                 number(margin, "value"), unit.empty() ? "" : " " + unit,
                 scale.empty() ? "" : ", a share of " + scale);
    }
}

/// "friction, rotation", "none"
std::string listed(const json& names) {
  const auto list = names.get<std::vector<std::string>>();
  return list.empty() ? "none" : fmt::format("{}", fmt::join(list, ", "));
}

void printEngine(const json& row) {
  const std::string name = row["name"];
  if (row["can"] == false) {
    const std::string reason = row["reason"];  // "yade cannot run FILE: has no …"
    const std::size_t why =
        reason.starts_with(name + " cannot run ") ? reason.find(": ") : reason.npos;
    fmt::print("  {:<16} cannot: {}\n", name, why == reason.npos ? reason : reason.substr(why + 2));
    return;
  }
  fmt::print("  {:<16} can run it{}\n", name,
             row.contains("dt_s") ? fmt::format(", dt {:.3g} s", number(row, "dt_s")) : "");
  for (const json& note : row["deviations"])
    fmt::print("    differs: {}\n", note.get<std::string>());
  if (!row["not_simulated"].empty())
    fmt::print("    does not simulate: {}\n", listed(row["not_simulated"]));
  if (!row.contains("run_s")) return;
  fmt::print("    {:.3g} µs a step: {} a packing{}\n", 1e6 * number(row, "step_s"),
             lasting(number(row, "run_s")),
             row["memory_bytes"].is_number()
                 ? fmt::format(", {:.0f} MB", number(row, "memory_bytes") / 1e6)
                 : "");
}

void printChecked(const json& checked) {
  const std::string variant = checked["variant"], name = checked["name"];
  const char* const round = checked.contains("dimension") ? "spheres" : "disks";
  fmt::print("{}: {} {}, {} wall {}, dt {:.3g} s\n", variant.empty() ? name : variant,
             number(checked, "disks"), checked.contains("shapes") ? "bodies" : round,
             number(checked, "wall_disks"), round, number(checked, "dt_s"));
  fmt::print("  effects called for: {}; left out: {}\n", listed(checked["effects"]),
             listed(checked["left_out"]));
  if (checked["steps_per_contact"].is_number())
    fmt::print("  {:.3g} steps in the shortest contact; dt may be at most {:.3g} s\n",
               number(checked, "steps_per_contact"), number(checked, "step_limit_s"));
  if (checked.contains("cell")) printCell(checked["cell"]);
  if (checked.contains("flow")) printFlow(checked);
  if (const auto shared = checked["shared_conventions"].get<std::vector<std::string>>();
      !shared.empty())
    fmt::print("  {}\n", describeShared(shared));
  for (const json& caution : checked["cautions"])
    fmt::print("  caution: {}\n", caution.get<std::string>());
  for (const json& row : checked["engines"]) printEngine(row);
  if (!checked.contains("prediction")) return;
  const json& prediction = checked["prediction"];
  fmt::print(
      "  predicted time of compare: {} on one core, {} of it for packings; steps were timed on "
      "{}\n",
      lasting(number(prediction, "total_s")), lasting(number(prediction, "preparing_s")),
      prediction["timed_on"].get<std::string>());
}

/// Engines that "all" leaves out, since they are not installed.
void printMissing(const std::vector<std::string>& named) {
  if (std::ranges::find(named, "all") == named.end()) return;
  for (const EngineEntry& entry : engineRegistry())
    if (entry.missing && !entry.missing().empty() && !isNamed(named, entry))
      fmt::print("  {:<16} not available: {}\n", entry.name, entry.missing());
}

int checkCase(const CommandLine& line, const CheckOptions& options) {
  std::vector<Case> cases = loadCase(line.inputs.front(), line.overrides);
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
    cases = loadCase(line.inputs.front(), overrides);
  }
  reportKeysWithoutUse(cases, "check", line.json ? stderr : stdout);
  printNotes();
  const ScratchFolder scratch;
  // Its lines would stand beside the one of a mistake where they are not redrawn.
  Progress progress(line.json || options.untimed || ::isatty(STDERR_FILENO) == 0);
  json all = json::array();
  for (const Case& setup : cases) {
    all.push_back(checkedCase(setup, line.run.engines, !options.untimed, scratch.path, progress));
    all.back()["shared_conventions"] = shared;
    if (line.json) continue;
    printChecked(all.back());
    printMissing(line.run.engines);
  }
  if (line.json) fmt::print("{}\n", all.dump(2));
  bool allCan = true, failed = false;
  for (const json& checked : all)
    for (const json& row : checked["engines"]) {
      if (row.value("failed", false)) {
        failed = true;
        fmt::print(stderr, "crossgrain: {}\n", row["reason"].get<std::string>());
      }
      allCan &= row["can"] == true || row["mirrors"] != "";
    }
  if (failed) return exitEngineFailed;
  return allCan ? exitPassed : exitFailed;
}

Action declareCheck(CLI::App& app, CommandLine& line) {
  const auto options = std::make_shared<CheckOptions>();
  addCase(app, line);
  addEngines(app, line, "all");
  addOverrides(app, line);
  addFlag(app, "--json", line.json, "print everything as JSON");
  addFlag(app, "--resolved", options->resolved,
          "print only the case, merged with those that it extends, as a case file");
  addFlag(app, "--no-timing", options->untimed, "do not time steps or predict run times");
  return [&line, options] { return checkCase(line, *options); };
}

}  // namespace

extern const Command checkCommand = {
    "check", "report which engines can run a case, what to expect of it, and how long it takes",
    "crossgrain check cases/couette/quick.toml --engines all\n"
    "  crossgrain check cases/couette/quick.toml --set cell.omega=0.1 --resolved",
    declareCheck};

}  // namespace crossgrain::inline cli
