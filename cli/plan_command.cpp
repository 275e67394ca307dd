#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cases/engine_file.hpp"
#include "cli/option_groups.hpp"
#include "studies/core/engine_access.hpp"
#include "studies/core/mirrors.hpp"
#include "studies/core/shared_conventions.hpp"
#include "studies/core/study.hpp"
#include "studies/core/study_cases.hpp"
#include "studies/plan/job_plan.hpp"
#include "support/bad_input.hpp"
#include "support/input_file.hpp"

namespace crossgrain::inline cli {

namespace fs = std::filesystem;

namespace {

struct PlanOptions {
  std::string slurm, engines;
  std::vector<std::string> sweeps;
  std::optional<std::string> seeds, budget;
};

std::vector<std::string> between(const std::string& list, const std::string& option) {
  std::vector<std::string> parts = commaList(list);
  if (std::ranges::find(parts, "") != parts.end())
    throw BadInput(fmt::format("{} '{}': a part is empty", option, list));
  return parts;
}

/// Engines are known to jobs by their names, or by the absolute path of their file.
void addEnginesOf(JobRequest& request, const std::string& list) {
  for (const std::string& said : between(list, "--engines")) {
    if (said == "all") throw BadInput("--engines all: a plan names its engines one by one");
    const bool ofFile = namesEngineFile(said);
    request.said.push_back(ofFile ? fs::absolute(said).lexically_normal().string() : said);
    if (request.said.back().find(',') != std::string::npos)
      throw BadInput(fmt::format("--engines {}: its path has a comma", said));
    request.engines.push_back(ofFile ? addExternalEngine(loadEngineFile(said)) : said);
  }
  selectEngines(request.engines);  // throws for one that is unknown or named twice
}

std::vector<std::string> seedsOf(const std::string& list) {
  std::vector<std::string> seeds = between(list, "--seeds");
  for (const std::string& seed : seeds)
    if (seed.find_first_not_of("0123456789") != std::string::npos || seed.size() > 18)
      throw BadInput(fmt::format("--seeds '{}': '{}' must be a whole number >= 0", list, seed));
  return seeds;
}

int plan(const CommandLine& line, const PlanOptions& options) {
  JobRequest request;
  request.file = fs::absolute(line.inputs.front()).lexically_normal();
  addEnginesOf(request, options.engines);
  request.overrides = line.overrides;
  // Jobs have the conventions of a comparison of all of them.
  shareConventions(loadCase(line.inputs.front(), line.overrides).front(), request.engines,
                   request.overrides);
  request.sweeps = options.sweeps;
  if (options.seeds) request.seeds = seedsOf(*options.seeds);
  if (line.quick) request.others.push_back("--quick");
  if (options.budget) {
    secondsOf(*options.budget);  // throws for what is none
    request.others.push_back("--budget=" + *options.budget);
  }
  bool reported = false;
  const JobPlan jobs = planJobs(request, [&](const std::vector<std::string>& overrides) {
    CommandLine one = line;
    one.overrides = overrides;
    const Case setup = onlyFlow(one, "plan");
    if (!reported) reportKeysWithoutUse(setup, "plan", stderr);
    reported = true;
    checkEngineSections(setup);
    return setup;
  });
  writeSlurm(jobs, options.slurm, ownProgram());
  for (const PlannedJob& job : jobs.jobs) fmt::print("{}\n", job.name);
  fmt::print("{} job{} in {}; submit with {}\n", jobs.jobs.size(), jobs.jobs.size() == 1 ? "" : "s",
             options.slurm, (fs::path(options.slurm) / "submit").string());
  return exitPassed;
}

Action declarePlan(CLI::App& app, CommandLine& line) {
  const auto options = std::make_shared<PlanOptions>();
  addCase(app, line);
  addArgument(app, "--engines", options->engines,
              "engines, separated by commas: a job for each beside the first, the reference",
              "NAMES");
  addArgument(app, "--slurm", options->slurm, "new folder for the job array", "DIR");
  addOverrides(app, line);
  addTexts(app, "--sweep", options->sweeps,
           "as --set, in some of the jobs: several of one key are its values, those of several "
           "keys are combined",
           "KEY=VALUE");
  addText(app, "--seeds", options->seeds, "preparation.seed: other packings for each", "N,N");
  addText(app, "--budget", options->budget, "of each job, as of compare", "TIME");
  addFlag(app, "--quick", line.quick, "short runs, as of compare");
  return [&line, options] { return plan(line, *options); };
}

}  // namespace

extern const Command planCommand = {
    "plan", "write comparisons of many seeds, settings and engines as an array of jobs",
    "crossgrain plan cases/couette/quick.toml --engines grain,yade,lammps --seeds 1,2,3 "
    "--sweep law.mu=0.2 --sweep law.mu=0.4 --slurm jobs\n"
    "jobs/submit --time=1:00:00     # runs them, then merges them into jobs/site",
    declarePlan};

}  // namespace crossgrain::inline cli
