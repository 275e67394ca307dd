#include "cli/one_case.hpp"
#include "cli/option_groups.hpp"
#include "cli/outcome.hpp"
#include "reports/couette/overview.hpp"
#include "reports/report.hpp"
#include "runs/common/run_store.hpp"
#include "runs/couette/average.hpp"

namespace crossgrain::inline cli {
namespace {

int average(const CommandLine& line) {
  const Case setup = onlyCase(line, "average");
  RunStore store(line.run, "average", {});
  const CompareResults results = averageSnapshots(setup, line.snapshots, line.run.commandLine);
  store.begin();
  writeReport(results, line.run.out);
  return averaged(line, results.averaging, reports::averageOverview(results));
}

Action declareAverage(CLI::App& app, CommandLine& line) {
  addSnapshots(app, line);
  return [&line] { return average(line); };
}

}  // namespace

extern const Command averageCommand = {
    "average", "average snapshots of a file, of a run or of any other source",
    "crossgrain average out/compare/snapshots/grain-p0.h5 cases/couette/quick.toml --out "
    "out/averaged",
    declareAverage};

}  // namespace crossgrain::inline cli
