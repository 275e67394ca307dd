#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "cases/case.hpp"

namespace crossgrain::inline studies {

/// One comparison that a machine can run for itself.
struct PlannedJob {
  std::string name;  ///< and of its folder below results/: letters, digits, - _ . = +
  std::vector<std::string>
      words;          ///< what follows the program's name; paths from the plan's folder
  std::string setup;  ///< fingerprint of the case that it is to run, resolved
  std::vector<std::string> engines;  ///< that it is to run, by name
};

/// Jobs, and the build of this program that is to run them all.
struct JobPlan {
  std::string program;
  std::vector<PlannedJob> jobs;
};

/// What a plan is asked for: every setting × every seed × every engine beside the first.
struct JobRequest {
  std::filesystem::path file;        ///< of the case, absolute
  std::vector<std::string> engines;  ///< names
  /// What the command line is to say for each of them: a name, or an engine file's absolute path.
  std::vector<std::string> said;
  std::vector<std::string> overrides;  ///< of all jobs
  std::vector<std::string> sweeps;     ///< "key=value": those of one key are its values
  std::vector<std::string> seeds;      ///< empty: the case's own
  std::vector<std::string> others;     ///< further words of every job: "--quick"
};

/// The most jobs of a plan.
inline constexpr std::size_t mostJobs = 100'000;

/// Each value of a key with each of every other: one list of overrides for each setting.
/// @throws BadInput for what is no KEY=VALUE, a value that stands twice, or more than mostJobs
std::vector<std::vector<std::string>> sweptSettings(const std::vector<std::string>& sweeps);

/// @param caseOf  what a job's overrides make of the case: checks it, too
/// @throws BadInput as sweptSettings(), for a seed that stands twice, and what caseOf throws
JobPlan planJobs(const JobRequest& request,
                 const std::function<Case(const std::vector<std::string>& overrides)>& caseOf);

/// Of a case as it was resolved.
std::string setupFingerprint(const std::string& resolvedToml);

/// The file of a plan in its folder.
inline constexpr const char* planFile = "plan.json";

/// Writes the plan as a Slurm job array: submit, array.sh, merge.sh, jobs/N with the
/// words of job N, each ended by a NUL, merge.words likewise, and plan.json. No word of the user's
/// is in a script, so no shell reads any.
/// @param program  this program's path
/// @throws BadInput where the folder holds anything already; OutputError
void writeSlurm(const JobPlan& plan, const std::filesystem::path& folder,
                const std::filesystem::path& program);

/// @throws BadInput for a file that is no plan, or has two jobs of one name or one part
JobPlan readPlan(const std::filesystem::path& folder);

/// What came of a job.
struct JobOutcome {
  std::string name;
  std::filesystem::path results;  ///< its folder; empty: nothing there can be merged
  std::string trouble;            ///< one sentence; empty: all is well
};

/// Looks at the folder of every job: missing, unfinished and broken results, those of another job
/// or case, of another build or other versions of engines than the rest are not merged, each with a
/// sentence; of runs that failed there is one, too, but what did not fail is merged. Folders that
/// belong to no job have a sentence at the end.
std::vector<JobOutcome> lookAtJobs(const JobPlan& plan, const std::filesystem::path& folder);

}  // namespace crossgrain::inline studies
