#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gsl/gsl_errno.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <thread>

#include "adapters/engine.hpp"
#include "cases/bad_input.hpp"
#include "cases/nearest.hpp"
#include "cli/calibrate.hpp"
#include "cli/commands.hpp"
#include "runs/interrupt.hpp"
#include "runs/version.hpp"

namespace crossgrain {
namespace {

CLI::Option* addEngines(CLI::App& command, CommandLine& line) {
  return command
      .add_option("--engines", line.run.engines,
                  "engines by name, separated by commas, or all; the first is the reference")
      ->delimiter(',')
      ->allow_extra_args(false);
}

void addOverrides(CLI::App& command, CommandLine& line) {
  command
      .add_option("--set", line.overrides, "key=value: changes the case, e.g. averaging.rings=40")
      ->allow_extra_args(false);
}

/// What all commands that leave results have.
void addResults(CLI::App& command, CommandLine& line) {
  addOverrides(command, line);
  command.add_option("--out", line.run.out, "folder for results: new, or of an earlier run")
      ->required()
      ->check([](const std::string& out) { return out.empty() ? "is empty" : ""; });
  command.add_flag("--json", line.json, "print the path of results.json only, for scripts");
}

/// What all commands that average a file of snapshots have.
void addSnapshots(CLI::App& command, CommandLine& line) {
  command.add_option("snapshots", line.snapshots, "HDF5 file of snapshots")->required();
  command.add_option("case", line.inputs, "case file: the cell, the law, how to average")
      ->required();
  addResults(command, line);
}

/// What all commands that run engines have.
void addRun(CLI::App& command, CommandLine& line) {
  addEngines(command, line)->required();
  addResults(command, line);
  constexpr int mostJobs = 4096;
  command.add_option("--jobs", line.run.jobs, "engines side by side (default: one per core)")
      ->check(CLI::Range(1, mostJobs));
  command.add_flag("--quiet", line.run.quiet, "no progress");
}

/// What all commands that run engines on packings have.
void addPackings(CLI::App& command, CommandLine& line, std::int64_t& seed) {
  command.add_option("--seed", seed, "preparation.seed of the case")->check(CLI::NonNegativeNumber);
  command.add_flag("--resume", line.run.resume, "take up what an earlier run in --out finished");
  command.add_flag("--quick", line.quick, "a short version, to see that everything works");
}

CLI::App* addCommand(CLI::App& app, const std::string& name, const std::string& what,
                     const std::string& example) {
  CLI::App* command = app.add_subcommand(name, what);
  command->footer("Example:\n  " + example);
  return command;
}

/// A positive number and one of some units. @throws BadInput
double numberWithUnit(const std::string& option, const std::string& text,
                      const std::map<std::string, double>& units, const char* example) {
  std::size_t end = 0;
  double value = 0.0;
  try {
    value = std::stod(text, &end);
  } catch (const std::exception&) {
    end = 0;
  }
  const auto unit = units.find(text.substr(end));
  if (end == 0 || unit == units.end() || !(value > 0.0) || !std::isfinite(value))
    throw BadInput(fmt::format("{} {}: must be like {}", option, text, example));
  return value * unit->second;
}

/// "90s", "10m", "1h" as seconds.
double secondsOf(const std::string& budget) {
  return numberWithUnit("--budget", budget, {{"", 1.0}, {"s", 1.0}, {"m", 60.0}, {"h", 3600.0}},
                        "90s, 10m or 1h");
}

/// "1%", "1e-3" as a share.
double shareOf(const std::string& want) {
  return numberWithUnit("--want", want, {{"", 1.0}, {"%", 0.01}}, "1% or 1e-3");
}

int run(int argc, char** argv) {
  CommandLine line;
  line.run.jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  line.run.commandLine =
      fmt::format("crossgrain {}", fmt::join(std::vector<std::string>(argv + 1, argv + argc), " "));
  std::int64_t seed = 0;
  std::string served;

  CLI::App app{
      "crossgrain: one granular scene on several engines, averaged and held against each "
      "other"};
  app.set_version_flag("--version", programVersion);
  app.require_subcommand(1);
  app.footer(
      "Exit status: 0 held, 1 disagreement or fell short, 2 bad input, 3 an engine failed, "
      "130 interrupted.");

  CLI::App* engines = addCommand(app, "engines", "engines found, what they can do, their settings",
                                 "crossgrain engines");
  engines->add_flag("--json", line.json, "as JSON");

  CLI::App* check = addCommand(app, "check", "who can run a case, and where engines differ from it",
                               "crossgrain check cases/couette/quick.toml --engines all");
  check->add_option("case", line.inputs, "case file")->required();
  addEngines(*check, line)->default_val("all");
  addOverrides(*check, line);

  CLI::App* collisions = addCommand(
      app, "collide", "two-particle sweeps against the oracle",
      "crossgrain collide cases/collision/figure-4-3.toml --engines grain,yade --out out");
  collisions->add_option("case", line.inputs, "case file or folder of case files")->required();
  addRun(*collisions, line);

  CLI::App* comparison =
      addCommand(app, "compare", "run, average, cross-check",
                 "crossgrain compare cases/couette/quick.toml --engines grain,yade --out out");
  comparison->add_option("case", line.inputs, "case file")->required();
  addRun(*comparison, line);
  addPackings(*comparison, line, seed);
  comparison->add_flag("--strict", line.strict, "undecided verdicts count as falling short");

  CLI::App* switching =
      addCommand(app, "effects", "what each effect of a case costs and changes",
                 "crossgrain effects cases/couette/quick.toml --engines grain --out out");
  switching->add_option("case", line.inputs, "case file")->required();
  addRun(*switching, line);
  addPackings(*switching, line, seed);

  CLI::App* hard = addCommand(
      app, "stability", "hard cases: what stays stable on which engine, and what does not",
      "crossgrain stability --engines all --out out              # all of cases/hard\n"
      "  crossgrain stability cases/hard/pile.toml --engines grain,yade --out out");
  hard->add_option("case", line.inputs, "case files or folders of them (default: cases/hard)");
  addRun(*hard, line);
  hard->add_flag("--resume", line.run.resume, "take up what an earlier run in --out finished");
  CLI::Option* quickest = hard->add_flag("--quick", line.quick, "only cases marked as quick");
  hard->add_flag("--long", line.longCases, "also cases marked as long")->excludes(quickest);
  std::string budget, want;
  CLI::App* costs = addCommand(
      app, "cost",
      "error against time, for every engine and every knob that trades one for the other",
      "crossgrain cost cases/cost/quick.toml --engines all --out out --budget 10m\n"
      "  crossgrain cost cases/cost/quick.toml --engines all --out out --resume --want 1%");
  costs->add_option("case", line.inputs, "case file")->required();
  addRun(*costs, line);
  addPackings(*costs, line, seed);
  costs->add_option("--budget", budget, "time that all may take, e.g. 90s, 10m, 1h (default: 12m)");
  costs->add_option("--want", want,
                    "accuracy, e.g. 1% or 1e-3: prints the cheapest setting of each engine");

  CLI::App* averaging = addCommand(
      app, "average", "average snapshots of a file, of a run or of any other source",
      "crossgrain average out/snapshots/grain-p0.h5 cases/couette/quick.toml --out averaged");
  addSnapshots(*averaging, line);

  CLI::App* elements =
      addCommand(app, "rev", "every field against ring width, under every weight",
                 "crossgrain rev out/snapshots/grain-p0.h5 cases/couette/quick.toml --out rev");
  addSnapshots(*elements, line);
  elements->add_flag("--quiet", line.run.quiet, "no progress");

  CalibrationRequest calibration;
  CLI::App* calibrations = addCommand(
      app, "calibrate", "law constants from wanted restitution and contact time, and back",
      "crossgrain calibrate --en 0.9 --et 0.5 --tc 1e-3 --mass 1e-3 --radius 5e-3 --mu 0.4\n"
      "  crossgrain calibrate --kn 352.1 --gn 0.19 --kt 267.1 --gt 0.15 --mu 0.44 --mass 0.275e-3 "
      "--radius 3.7e-3\n"
      "  crossgrain calibrate cases/couette/quick.toml");
  addCalibrationOptions(*calibrations, line, calibration);

  CLI::App* report =
      addCommand(app, "report", "rebuild reports from results.json", "crossgrain report out");
  report->add_option("folder", line.inputs, "folders that hold a results.json")->required();

  CLI::App* serve =
      app.add_subcommand("__serve", "speak the worker protocol on descriptors 3 and 4");
  serve->group("");
  serve->add_option("engine", served)->required();

  // CLI11 would only say that some subcommand is required.
  const std::vector<std::string> names = {"engines",   "check", "collide",   "compare",
                                          "effects",   "cost",  "stability", "average",
                                          "calibrate", "rev",   "report"};
  const std::string first = argc > 1 ? argv[1] : "-";
  if (first[0] != '-' && first != "__serve" && std::ranges::find(names, first) == names.end())
    throw BadInput(fmt::format("there is no command '{}'{}", first, suggestion(first, names)));
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& asked) {  // --help, --version
    return app.exit(asked);
  } catch (const CLI::ParseError& error) {
    throw BadInput(fmt::format("{}; see crossgrain --help", error.what()));
  }
  if (comparison->count("--seed") + switching->count("--seed") + costs->count("--seed") > 0)
    line.overrides.push_back(fmt::format("preparation.seed={}", seed));

  if (engines->parsed()) return listEngines(line);
  if (check->parsed()) return checkCase(line);
  if (collisions->parsed()) return collide(line);
  if (comparison->parsed()) return compare(line);
  if (switching->parsed()) return effects(line);
  if (hard->parsed()) return stability(line);
  if (costs->parsed()) {
    if (!budget.empty()) line.budget = secondsOf(budget);
    if (!want.empty()) line.want = shareOf(want);
    return cost(line);
  }
  if (averaging->parsed()) return average(line);
  if (elements->parsed()) return rev(line);
  if (calibrations->parsed()) return calibrate(line, calibration);
  if (report->parsed()) return rebuildReports(line);
  return serveEngine(served);
}

/// Every way to end, as one line on standard error and the status that goes with it.
int runAndExplain(int argc, char** argv) {
  const auto explain = [](const std::exception& error, int status) {
    fmt::print(stderr, "crossgrain: {}\n", BadInput(error.what()).what());  // in one line
    return status;
  };
  try {
    return run(argc, argv);
  } catch (const Interrupted& error) {
    return explain(error, exitInterrupted);
  } catch (const BadInput& error) {
    return explain(error, exitBadInput);
  } catch (const UnsupportedScene& error) {
    return explain(error, exitBadInput);
  } catch (const EngineFailure& error) {
    return explain(error, exitEngineFailed);
  } catch (const std::exception& error) {  // a folder that cannot be written, a full disk
    return explain(error, exitBadInput);
  }
}

}  // namespace
}  // namespace crossgrain

int main(int argc, char** argv) {
  gsl_set_error_handler_off();  // GSL's own would abort; its status codes are looked at
  crossgrain::catchInterrupts();
  return crossgrain::runAndExplain(argc, argv);
}
