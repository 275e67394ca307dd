#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "cases/case_files.hpp"
#include "cases/loader.hpp"
#include "cli/option_groups.hpp"
#include "cli/outcome.hpp"
#include "reports/regression/regression.hpp"
#include "studies/core/engine_access.hpp"
#include "studies/core/study.hpp"
#include "studies/regression/recording.hpp"
#include "support/bad_input.hpp"
#include "support/files.hpp"

namespace crossgrain::inline cli {
namespace {

constexpr double mostSnapshots = 1e6;

EngineEntry onlyEngine(const CommandLine& line, const char* command) {
  const std::vector<EngineEntry> engines = selectEngines(line.run.engines);
  if (engines.size() != 1)
    throw BadInput(fmt::format("--engines: {} takes one engine, not {}", command, engines.size()));
  return engines.front();
}

int record(const CommandLine& line, const std::string& out, const std::optional<double>& time,
           const std::optional<double>& looks) {
  RecordOptions options;
  options.time = time;
  if (time && !(*time > 0.0 && std::isfinite(*time)))
    throw BadInput(fmt::format("--time: {:g} must be > 0 s", *time));
  if (looks)
    options.snapshots =
        static_cast<std::size_t>(wholeNumberOf("--looks", *looks, 1.0, mostSnapshots));
  const EngineEntry engine = onlyEngine(line, "record");
  const std::filesystem::path file = out;
  if (std::filesystem::exists(file))
    throw BadInput(fmt::format(
        "--out {}: this file exists, and a recording is not replaced: name another file", out));
  std::vector<Case> cases =
      loadCase(line.inputs.front(), line.overrides, {}, Starts::made, line.only);
  if (line.only) cases = selectedCases(cases, *line.only);
  const Case& setup = cases.front();
  std::FILE* const told = line.json ? stderr : stdout;
  if (cases.size() > 1)
    fmt::print(told, "{}: variant {} is recorded, one of {}; -k names another\n",
               setup.file.string(), setup.variant, cases.size());
  reportKeysWithoutUse(setup, "record", told);
  if (line.run.dryRun)
    return printPlanned(line,
                        fmt::format("would record {} on {} into {}", engine.name, setup.name, out));
  if (file.has_parent_path()) makeDirectory(file.parent_path());
  const Recorded recorded = recordRun(engine, setup, file, options);
  if (line.json)
    printJson({{"file", out},
               {"engine", engine.name},
               {"version", recorded.version},
               {"exchanges", recorded.exchanges},
               {"time_s", recorded.time},
               {"case", setup.name},
               {"failure", recorded.failure}});
  else
    fmt::print("{}: {} requests and answers of {} {}, to t = {:g} s of {}\n", out,
               recorded.exchanges, engine.name, recorded.version, recorded.time, setup.name);
  if (recorded.failure.empty()) return exitPassed;
  printFailure(recorded.failure);
  return exitEngineFailed;
}

int replay(const CommandLine& line, const std::string& file, const std::optional<double>& given) {
  const double tolerance = given.value_or(0.0);
  if (!(tolerance >= 0.0 && tolerance < 1.0))
    throw BadInput(fmt::format("--tolerance: {:g} must be from 0 to less than 1", tolerance));
  const ReplayResults found = replayRun(file, onlyEngine(line, "replay"), tolerance);
  fmt::print("{}", line.json ? toJson(found).dump() + "\n" : reports::replayText(found));
  return printOutcome(line, outcomeOf(found));
}

Action declareRecord(CLI::App& app, CommandLine& line) {
  addCase(app, line, "case file; of several variants the first is run, of a cell packing 0");
  addEngines(app, line);
  addOverrides(app, line);
  addSelection(app, line);
  addQuiet(app, line);
  addJson(app, line);
  addDryRun(app, line);
  const auto out = std::make_shared<std::string>();
  addArgument(app, "--out", *out, "file for it, which must not be there", "FILE");
  const auto time = std::make_shared<std::optional<double>>();
  addNumber(app, "--time", *time,
            "how long the engine runs, in s of the scene; of a cell 0.1, else as long as the case");
  const auto looks = std::make_shared<std::optional<double>>();
  addNumber(app, "--looks", *looks, "snapshots after the one at the start (default: 10)");
  return [&line, out, time, looks] { return record(line, *out, *time, *looks); };
}

Action declareReplay(CLI::App& app, CommandLine& line) {
  const auto file = std::make_shared<std::string>();
  addArgument(app, "recording", *file, "file that `record` wrote", "FILE");
  addEngines(app, line);
  const auto tolerance = std::make_shared<std::optional<double>>();
  addQuiet(app, line);
  addNumber(app, "--tolerance", *tolerance,
            "numbers are alike that differ by no more than this part of the largest of their array "
            "(default: 0)");
  addJson(app, line);
  return [&line, file, tolerance] { return replay(line, *file, *tolerance); };
}

}  // namespace

extern const Command recordCommand = {
    "record", "write one engine's requests and answers to a file, for replay and bug reports",
    "crossgrain record cases/couette/quick.toml --engines examples/python/engine.toml --out "
    "run.rec\n"
    "crossgrain record cases/hard/pile.toml --engines yade --time 0.5 --looks 50 --out run.rec",
    declareRecord};

extern const Command replayCommand = {
    "replay", "send the requests of a recording to an engine; report the first different answer",
    "crossgrain replay run.rec --engines examples/python/engine.toml\n"
    "crossgrain replay run.rec --engines examples/python/engine.toml --tolerance 1e-9 --json",
    declareReplay};

}  // namespace crossgrain::inline cli
