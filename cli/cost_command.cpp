#include <fmt/format.h>

#include <memory>
#include <optional>

#include "cases/loader.hpp"
#include "cli/one_case.hpp"
#include "cli/option_groups.hpp"
#include "cli/outcome.hpp"
#include "cli/units.hpp"
#include "reports/cost/report.hpp"
#include "reports/report.hpp"
#include "runs/common/resumable.hpp"
#include "runs/cost/cost.hpp"
#include "support/bad_input.hpp"

namespace crossgrain::inline cli {

namespace {

Case costCase(const CommandLine& line) {
  std::vector<std::string> overrides;
  if (line.quick) {
    overrides = quickOverrides(loadCase(line.inputs.front(), line.overrides).front(), 0.05);
    const std::vector<std::string> costs = quickCostOverrides();
    overrides.insert(overrides.end(), costs.begin(), costs.end());
  }
  overrides.insert(overrides.end(), line.overrides.begin(), line.overrides.end());
  return loadCase(line.inputs.front(), overrides).front();
}

/// @param budget time that all may take [s]
/// @param target accuracy to print a fragment for, 0.01 is 1 %
int cost(const CommandLine& line, double budget, std::optional<double> target) {
  onlyCase(line, "cost");  // throws for a case that is none
  const Case setup = costCase(line);
  CostRequest request{line.run, budget};
  if (!line.json && !line.run.quiet)
    request.printPlan = [](const std::string& plan) { fmt::print(stderr, "{}", plan); };
  if (target) request.targets.push_back(*target);
  RunStore store(line.run, "cost", soleCase(setup));
  if (line.run.dryRun) return told(costPlan(setup, request, store));
  const CostResults results = measureCost(setup, request, store);
  writeReport(results, line.run.out);

  if (line.json)
    fmt::print("{}\n", (line.run.out / "results.json").string());
  else if (target)
    fmt::print("{}", adviceAsToml(advice(results.points, {*target}), results.points));
  else {
    fmt::print("{}", reports::costText(results));
    printOverview(reports::costOverview(results));
    fmt::print("report: {}\n", (line.run.out / "report.html").string());
    if (!line.run.quiet) printTimeSpent();
  }
  printRefusals(line, results.engines);
  for (const std::string& reason : results.engineFailures)
    fmt::print(stderr, "crossgrain: {}\n", BadInput(reason).what());
  return results.engineFailures.empty() ? exitHeld : exitEngineFailed;
}

Action declareCost(CLI::App& app, CommandLine& line) {
  struct Own {
    std::optional<std::string> budget, target;
  };
  const auto own = std::make_shared<Own>();
  addCase(app, line);
  addRun(app, line);
  addPackings(app, line);
  addText(app, "--budget", own->budget, "time that all may take, e.g. 90s, 10m, 1h (default: 12m)");
  addText(app, "--want", own->target,
          "accuracy, e.g. 1% or 1e-3: prints the cheapest setting of each engine");
  return [&line, own] {
    const double budget = secondsOf(own->budget.value_or("12m"));
    const auto target = own->target ? std::optional(fractionOf(*own->target)) : std::nullopt;
    return resumably(line.run, [&] { return cost(line, budget, target); });
  };
}

}  // namespace

extern const Command costCommand = {
    "cost", "error against time, for every engine and every setting that trades one for the other",
    "crossgrain cost cases/cost/quick.toml --engines all --out out/cost --budget 10m\n"
    "crossgrain cost cases/cost/quick.toml --engines all --out out/cost --want 1%",
    declareCost};

}  // namespace crossgrain::inline cli
