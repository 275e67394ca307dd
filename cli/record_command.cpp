#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "cases/case_files.hpp"
#include "cases/loader.hpp"
#include "cli/option_groups.hpp"
#include "cli/outcome.hpp"
#include "runs/common/engine_access.hpp"
#include "runs/common/study_cases.hpp"
#include "runs/record/record.hpp"
#include "support/bad_input.hpp"
#include "support/files.hpp"

namespace crossgrain::inline cli {

namespace {

constexpr double mostLooks = 1e6;

int record(const CommandLine& line, const std::string& out, const std::optional<double>& time,
           const std::optional<double>& looks) {
  RecordOptions options;
  options.time = time;
  if (time && !(*time > 0.0 && std::isfinite(*time)))
    throw BadInput(fmt::format("--time: {:g} must be > 0 s", *time));
  if (looks && !(*looks >= 1.0 && *looks <= mostLooks && *looks == std::floor(*looks)))
    throw BadInput(
        fmt::format("--looks: {:g} must be a whole number from 1 to {:g}", *looks, mostLooks));
  if (looks) options.looks = static_cast<std::size_t>(*looks);
  const std::vector<EngineEntry> engines = selectEngines(line.run.engines);
  if (engines.size() != 1)
    throw BadInput(fmt::format("--engines: record takes one engine, not {}", engines.size()));
  const std::filesystem::path file = out;
  if (std::filesystem::exists(file))
    throw BadInput(fmt::format(
        "--out {}: is there already, and a recording is not replaced: name another file", out));
  std::vector<Case> cases = loadCase(line.inputs.front(), line.overrides);
  if (line.only) cases = selectedCases(cases, *line.only);
  const Case& setup = cases.front();
  if (cases.size() > 1)
    fmt::print("{}: variant {} is recorded, one of {}; -k names another\n", setup.file.string(),
               setup.variant, cases.size());
  reportKeysWithoutUse(setup, "record", stdout);
  if (file.has_parent_path()) makeDirectory(file.parent_path());
  const Recorded recorded = recordRun(engines.front(), setup, file, options);
  fmt::print("{}: {} requests and answers of {} {}, to t = {:g} s of {}\n", out, recorded.exchanges,
             engines.front().name, recorded.version, recorded.time, setup.name);
  if (recorded.failure.empty()) return exitHeld;
  printFailure(recorded.failure);
  return exitEngineFailed;
}

Action declareRecord(CLI::App& app, CommandLine& line) {
  addCase(app, line, "case file; of several variants the first is run, of a cell packing 0");
  addEngines(app, line);
  addOverrides(app, line);
  addSelection(app, line);
  const auto out = std::make_shared<std::string>();
  addArgument(app, "--out", *out, "file for it, which must not be there", "FILE");
  const auto time = std::make_shared<std::optional<double>>();
  addNumber(app, "--time", *time,
            "how long the engine runs, in s of the scene; of a cell 0.1, else as long as the case");
  const auto looks = std::make_shared<std::optional<double>>();
  addNumber(app, "--looks", *looks, "snapshots after the one at the start (default: 10)");
  return [&line, out, time, looks] { return record(line, *out, *time, *looks); };
}

}  // namespace

extern const Command recordCommand = {
    "record", "one engine's requests and answers as one file, for replay and bug reports",
    "crossgrain record cases/couette/quick.toml --engines examples/python/engine.toml --out "
    "run.rec\n"
    "crossgrain record cases/hard/pile.toml --engines yade --time 0.5 --looks 50 --out run.rec",
    declareRecord};

}  // namespace crossgrain::inline cli
