#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <thread>

#include "cases/case_keys.hpp"
#include "cases/scaled_cell.hpp"
#include "cli/one_case.hpp"
#include "cli/option_groups.hpp"
#include "cli/outcome.hpp"
#include "reports/report.hpp"
#include "reports/scale/report.hpp"
#include "runs/common/resumable.hpp"
#include "runs/scale/scale.hpp"
#include "support/bad_input.hpp"

namespace crossgrain::inline cli {

namespace {

constexpr std::size_t mostWorkers = 1024, mostSteps = 100'000'000, mostRepetitions = 1000;

struct ScaleOptions {
  std::optional<std::string> disks, threads, steps, repetitions;
};

std::size_t soleNumber(const std::string& option, const std::string& text, std::size_t most) {
  const auto numbers = wholeNumbers(option, text, 1, most);
  if (numbers.size() > 1)
    throw BadInput(fmt::format("{} '{}': one number is wanted", option, text));
  return numbers.front();
}

/// @throws BadInput for an option that is none
ScalePlan planOf(const ScaleOptions& options, bool quick) {
  ScalePlan plan;
  plan.disks = wholeNumbers(
      "--disks", options.disks.value_or(quick ? "1000,2000" : "1000,10000,100000,1000000"),
      leastScaled, mostScaled);
  plan.workers = usualWorkers(std::thread::hardware_concurrency());
  if (options.threads) {
    plan.workers.clear();
    for (const std::size_t count : wholeNumbers("--threads", *options.threads, 1, mostWorkers))
      plan.workers.push_back(static_cast<int>(count));
  }
  if (quick) {
    plan.steps = 200;
    plan.repetitions = 2;
  }
  if (options.steps) plan.steps = soleNumber("--steps", *options.steps, mostSteps);
  if (options.repetitions)
    plan.repetitions =
        static_cast<int>(soleNumber("--repetitions", *options.repetitions, mostRepetitions));
  return plan;
}

int scale(const CommandLine& line, const ScalePlan& plan) {
  const Case cell = scaleCase(line.overrides);
  for (const std::string& key : keysWithoutUse(cell, "scale"))
    if (const std::string where = whereSaid(cell, key); where.starts_with("--set "))
      throw BadInput(fmt::format("{}: scale does not use {}", where, key));
  RunStore store(line.run, "scale", soleCase(cell));
  if (line.run.dryRun) return told(scalePlan(plan, line.overrides, line.run, store));
  const ScaleResults results = measureScale(plan, line.overrides, line.run, store);
  writeReport(results, line.run.out);
  if (line.json) {
    fmt::print("{}\n", (line.run.out / "results.json").string());
  } else {
    fmt::print("{}", reports::scaleText(results));
    printOverview(reports::scaleOverview(results));
    fmt::print("report: {}\n", (line.run.out / "report.html").string());
  }
  int status = exitHeld;
  for (const ScalePoint& point : results.points) {
    if (point.status != EngineStatus::failed) continue;
    printFailure(point.reason);
    status = exitEngineFailed;
  }
  const bool any = std::ranges::any_of(
      results.points, [](const ScalePoint& point) { return point.status == EngineStatus::ran; });
  if (any || status != exitHeld) return status;
  printFailure("nothing was timed: " + results.points.front().reason);
  return exitFellShort;
}

Action declareScale(CLI::App& app, CommandLine& line) {
  const auto options = std::make_shared<ScaleOptions>();
  addRunInTurn(app, line, "grain");
  addText(app, "--disks", options->disks,
          "sizes of the cell (default: 1000,10000,100000,1000000); 10^7 take about an hour to "
          "prepare, once",
          "N,N");
  addText(app, "--threads", options->threads,
          "threads, of lammps ranks, that share a step; one is always timed (default: 1, 2, 4, … "
          "up to the cores)",
          "P,P");
  addText(app, "--steps", options->steps,
          "timed in each repetition (default: 2*10^7 over disks, at least 50)", "N");
  addText(app, "--repetitions", options->repetitions, "of each timing (default: 3)", "N");
  addFlag(app, "--quick", line.quick, "two small cells and few steps, to see that it works");
  return [&line, options] {
    const ScalePlan plan = planOf(*options, line.quick);
    line.run.jobs = 1;
    return resumably(line.run, [&] { return scale(line, plan); });
  };
}

}  // namespace

extern const Command scaleCommand = {
    "scale", "what a step takes as the cell grows and threads or ranks share it",
    "crossgrain scale --disks 1000,10000,100000 --out out/scale\n"
    "crossgrain scale --disks 100000,200000 --engines grain,lammps --threads 1,2 --out "
    "out/threads\n"
    "crossgrain scale --disks 1000000,10000000 --steps 50 --repetitions 2 --out out/large",
    declareScale};

}  // namespace crossgrain::inline cli
