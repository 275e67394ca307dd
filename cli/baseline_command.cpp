#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <memory>

#include "cases/loader.hpp"
#include "cli/option_groups.hpp"
#include "runs/baseline/baseline_file.hpp"
#include "runs/baseline/keep.hpp"
#include "runs/common/study_cases.hpp"
#include "runs/lockstep/rules.hpp"
#include "support/bad_input.hpp"
#include "support/files.hpp"

namespace crossgrain::inline cli {

namespace fs = std::filesystem;

namespace {

/// Hashes of so many starts still find room in an attribute of the file.
constexpr double mostStarts = 1000.0;

std::size_t startsToKeep(const std::optional<double>& given, bool quick) {
  if (!given) return quick ? quickLockstepStarts : baselineStarts;
  if (*given != std::floor(*given) || *given < 1.0 || *given > mostStarts)
    throw BadInput(
        fmt::format("--starts: {:g} must be a whole number from 1 to {:g}", *given, mostStarts));
  return static_cast<std::size_t>(*given);
}

std::vector<Case> casesToKeep(const CommandLine& line) {
  const std::vector<Case> cases = loadCase(line.inputs.front(), line.overrides);
  if (cases.front().kind == CaseKind::collision) {
    reportKeysWithoutUse(cases.front(), "baseline", stdout);
    return cases;
  }
  return {onlyCase(line, "baseline")};
}

int keep(const CommandLine& line, const std::string& out, const std::optional<double>& given,
         bool endpoints) {
  const std::size_t starts = startsToKeep(given, line.quick);
  const fs::path file = out;
  // What an older version did cannot be made again.
  if (fs::exists(file))
    throw BadInput(
        fmt::format("--out {}: is there already, and a baseline is not replaced: name "
                    "another file, or remove it",
                    out));
  const std::vector<Case> cases = casesToKeep(line);
  if (endpoints && cases.front().averaging.endpoints.empty())
    throw BadInput(fmt::format("--endpoints: {} has no [averaging.endpoints] to keep",
                               line.inputs.front().string()));
  // Where it cannot be written is told before the work is done.
  if (file.has_parent_path()) makeDirectory(file.parent_path());
  const Baseline baseline = keepBaseline(cases, line.run, starts, endpoints);
  writeBaseline(baseline, file);
  std::vector<std::string> names;
  for (const BaselineEngine& engine : baseline.engines)
    names.push_back(fmt::format("{} {}", engine.name, engine.version));
  fmt::print("{}: kept of {}\n", out, fmt::join(names, ", "));
  return exitHeld;
}

Action declareBaseline(CLI::App& app, CommandLine& line) {
  addCase(app, line);
  addEngines(app, line);
  addOverrides(app, line);
  addPackings(app, line);
  addQuiet(app, line);
  const auto out = std::make_shared<std::string>();
  addArgument(app, "--out", *out, "file for it (HDF5), which must not be there", "FILE");
  const auto starts = std::make_shared<std::optional<double>>();
  addNumber(app, "--starts", *starts,
            "states of the flow to start from; 8 unless given, 4 with --quick");
  const auto endpoints = std::make_shared<bool>(false);
  addFlag(app, "--endpoints", *endpoints,
          "also runs and averages from every start, as compare does, and keeps the endpoints");
  return [&line, out, starts, endpoints] { return keep(line, *out, *starts, *endpoints); };
}

}  // namespace

extern const Command baselineCommand = {
    "baseline", "keeps what engines do, to the bit, for diff",
    "crossgrain baseline cases/couette/quick.toml --engines grain,yade --out before.h5\n"
    "crossgrain baseline cases/collision/figure-4-3.toml --engines grain --out before.h5",
    declareBaseline};

}  // namespace crossgrain::inline cli
