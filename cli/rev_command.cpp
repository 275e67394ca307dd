#include "cli/one_case.hpp"
#include "cli/option_groups.hpp"
#include "cli/outcome.hpp"
#include "reports/couette/overview.hpp"
#include "reports/report.hpp"
#include "runs/common/run_store.hpp"
#include "runs/couette/rev.hpp"

namespace crossgrain::inline cli {
namespace {

int rev(const CommandLine& line) {
  const Case setup = onlyCase(line, "rev");
  RunStore store(line.run, "rev", {});
  const RevResults results = revStudy(setup, line.snapshots, line.run.commandLine, line.run.quiet);
  store.begin();
  writeReport(results, line.run.out);
  return averaged(line, results.averaging, reports::revOverview(results));
}

Action declareRev(CLI::App& app, CommandLine& line) {
  addSnapshots(app, line);
  addQuiet(app, line);
  return [&line] { return rev(line); };
}

}  // namespace

extern const Command revCommand = {
    "rev", "every field against ring width, under every weight",
    "crossgrain rev out/compare/snapshots/grain-p0.h5 cases/couette/quick.toml --out out/rev",
    declareRev};

}  // namespace crossgrain::inline cli
