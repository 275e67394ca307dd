#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>

#include "results/compare.hpp"
#include "results/schema.hpp"
#include "studies/core/run_store.hpp"
#include "studies/plan/job_plan.hpp"
#include "support/bad_input.hpp"

namespace crossgrain::inline studies {

namespace fs = std::filesystem;

namespace {

/// What results.json of a job says of itself.
struct JobResults {
  std::string setup;                            ///< fingerprint
  std::map<std::string, std::string> versions;  ///< of engines that the user named
  std::size_t runs = 0, failed = 0;
};

/// @throws BadInput
JobResults resultsIn(const fs::path& folder) {
  const fs::path file = folder / "results.json";
  const Json document = readResultsFile(file);
  if (document.at("kind") != kindCompare)
    throw BadInput(fmt::format("results.json is of {}, not of compare",
                               document.at("kind").get<std::string>()));
  if (!document.contains("case")) throw BadInput("results.json has no case");
  const CompareResults results = understood(file, [&] { return compareFromJson(document); });
  JobResults found;
  found.setup = setupFingerprint(results.head.setup.toml);
  for (const EngineRow& engine : results.engines)
    if (engine.mirrors.empty()) found.versions[engine.name] = engine.version;
  found.runs = results.runs.size();
  found.failed =
      static_cast<std::size_t>(std::ranges::count(results.runs, Status::failed, &FlowRun::status));
  return found;
}

bool belongsTo(const PlannedJob& job, const JobResults& results) {
  if (results.setup != job.setup || results.versions.size() != job.engines.size()) return false;
  return std::ranges::all_of(
      job.engines, [&](const std::string& name) { return results.versions.contains(name); });
}

/// A version, and the job that it was first seen in, by engine.
using Versions = std::map<std::string, std::pair<std::string, std::string>>;

std::string whoseElse(const JobPlan& plan, const PlannedJob& job, const JobResults& results) {
  for (const PlannedJob& other : plan.jobs)
    if (other.name != job.name && belongsTo(other, results))
      return fmt::format("doubled: its folder holds the results of {}", other.name);
  return results.setup == job.setup ? "holds the results of other engines than its own"
                                    : "holds the results of another case than its own";
}

/// Of this program, and of engines that a job before had; empty: they are the same.
std::string otherVersion(const JobPlan& plan, const PlannedJob& job, const fs::path& folder,
                         const JobResults& results, Versions& versions) {
  const std::string program = programOf(folder);
  if (program != plan.program)
    return fmt::format("of another version: of {}, and the plan is of {}",
                       program.empty() ? "an unknown build" : "crossgrain " + program,
                       plan.program);
  for (const auto& [engine, version] : results.versions) {
    const auto& [first, of] = *versions.insert({engine, {version, job.name}}).first;
    if (of.first != version)
      return fmt::format("of another version: of {} {}, and {} is of {}", engine, version,
                         of.second, of.first);
  }
  return {};
}

JobOutcome outcomeOf(const JobPlan& plan, const PlannedJob& job, const fs::path& folder,
                     Versions& versions) {
  const auto lost = [&](const std::string& why) { return JobOutcome{job.name, {}, why}; };
  std::error_code none;
  if (!fs::exists(folder, none)) return lost("missing: it has not begun");
  if (!fs::exists(folder / "results.json", none))
    return lost("unfinished: it has left no results.json; submitted again it goes on");
  JobResults results;
  try {
    results = resultsIn(folder);
  } catch (const std::exception& error) {
    return lost(fmt::format("broken: {}", error.what()));
  }
  if (!belongsTo(job, results)) return lost(whoseElse(plan, job, results));
  if (const std::string why = otherVersion(plan, job, folder, results, versions); !why.empty())
    return lost(why);
  JobOutcome outcome{job.name, folder, ""};
  if (results.failed > 0)
    outcome.trouble =
        fmt::format("{} of {} runs failed; the others are merged", results.failed, results.runs);
  return outcome;
}

}  // namespace

std::vector<JobOutcome> lookAtJobs(const JobPlan& plan, const fs::path& folder) {
  std::vector<JobOutcome> outcomes;
  Versions versions;
  for (const PlannedJob& job : plan.jobs)
    outcomes.push_back(outcomeOf(plan, job, folder / "results" / job.name, versions));
  std::vector<std::string> names;
  std::error_code none;
  for (fs::directory_iterator each(folder / "results", none), end; !none && each != end;
       each.increment(none))
    names.push_back(each->path().filename().string());
  std::ranges::sort(names);
  for (const std::string& name : names)
    if (std::ranges::find(plan.jobs, name, &PlannedJob::name) == plan.jobs.end())
      outcomes.push_back({name, {}, "belongs to no job of this plan"});
  return outcomes;
}

}  // namespace crossgrain::inline studies
