#include "studies/plan/job_plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "results/json_fields.hpp"
#include "studies/core/run_store.hpp"
#include "support/bad_input.hpp"
#include "support/files.hpp"
#include "support/fingerprint.hpp"

namespace crossgrain::inline studies {

namespace fs = std::filesystem;

namespace {

constexpr const char* planSchema = "crossgrain-plan-1";

/// In letters that a folder's name and an address may have; of two that would be alike the number
/// before them tells.
std::string plainLetters(const std::string& text) {
  std::string plain;
  for (const char c : text) {
    const bool stays = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                       c == '.' || c == '_' || c == '=' || c == '+';
    plain += stays ? c : '-';
  }
  constexpr std::size_t longest = 80;
  return plain.substr(0, longest);
}

void requireOnce(const char* option, const std::vector<std::string>& values) {
  std::set<std::string> seen;
  for (const std::string& value : values)
    if (!seen.insert(value).second)
      throw BadInput(fmt::format("{} {}: stands twice", option, value));
}

/// The reference and each other engine; the reference alone where there is no other.
std::vector<std::vector<std::size_t>> partsOf(std::size_t engines) {
  if (engines == 1) return {{0}};
  std::vector<std::vector<std::size_t>> parts;
  for (std::size_t e = 1; e < engines; ++e) parts.push_back({0, e});
  return parts;
}

}  // namespace

std::string setupFingerprint(const std::string& resolvedToml) {
  return fmt::format("{:016x}", fnv1a(resolvedToml));
}

std::vector<std::vector<std::string>> sweptSettings(const std::vector<std::string>& sweeps) {
  requireOnce("--sweep", sweeps);
  std::vector<std::string> keys;
  for (const std::string& each : sweeps) {
    const auto equals = each.find('=');
    if (equals == 0 || equals == std::string::npos || equals + 1 == each.size())
      throw BadInput(fmt::format("--sweep {}: must be KEY=VALUE, like law.mu=0.2", each));
    const std::string key = each.substr(0, equals);
    if (std::ranges::find(keys, key) == keys.end()) keys.push_back(key);
  }
  std::vector<std::vector<std::string>> settings = {{}};
  for (const std::string& key : keys) {
    std::vector<std::vector<std::string>> more;
    for (const auto& before : settings)
      for (const std::string& each : sweeps)
        if (each.starts_with(key + "=")) {
          more.push_back(before);
          more.back().push_back(each);
        }
    if (more.size() > mostJobs)
      throw BadInput(fmt::format("--sweep: that is more than {} settings", mostJobs));
    settings = std::move(more);
  }
  return settings;
}

JobPlan planJobs(const JobRequest& request,
                 const std::function<Case(const std::vector<std::string>& overrides)>& caseOf) {
  requireOnce("--seeds", request.seeds);
  const auto settings = sweptSettings(request.sweeps);
  const auto parts = partsOf(request.engines.size());
  const std::size_t seeds = std::max<std::size_t>(1, request.seeds.size());
  if (settings.size() * seeds * parts.size() > mostJobs)
    throw BadInput(fmt::format("that is more than {} jobs", mostJobs));
  JobPlan plan{thisProgram(), {}};
  for (const auto& setting : settings)
    for (std::size_t s = 0; s < seeds; ++s) {
      std::vector<std::string> overrides = request.overrides;
      overrides.insert(overrides.end(), setting.begin(), setting.end());
      if (!request.seeds.empty()) overrides.push_back("preparation.seed=" + request.seeds[s]);
      const Case setup = caseOf(overrides);
      for (const auto& part : parts) {
        PlannedJob job;
        std::vector<std::string> said;
        for (const std::size_t e : part) {
          job.engines.push_back(request.engines[e]);
          said.push_back(request.said[e]);
        }
        job.setup = setupFingerprint(setup.resolvedToml);
        job.name = fmt::format("{:03}-{}-{}", plan.jobs.size() + 1, plainLetters(setup.name),
                               plainLetters(fmt::format("{}", fmt::join(job.engines, "+"))));
        for (const std::string& each : setting) job.name += "-" + plainLetters(each);
        if (!request.seeds.empty()) job.name += "-seed=" + plainLetters(request.seeds[s]);
        job.words = {"compare", request.file.string()};
        for (const std::string& each : said) job.words.push_back("--engines=" + each);
        for (const std::string& each : overrides) job.words.push_back("--set=" + each);
        job.words.insert(job.words.end(), request.others.begin(), request.others.end());
        for (const std::string& word :
             {"--out=results/" + job.name, std::string("--resume"), std::string("--quiet")})
          job.words.push_back(word);
        plan.jobs.push_back(std::move(job));
      }
    }
  return plan;
}

void fields(auto& io, PlannedJob& job) {
  io("name", job.name);
  io("words", job.words);
  io("setup", job.setup);
  io("engines", job.engines);
}

void fields(auto& io, JobPlan& plan) {
  io("program", plan.program);
  io("jobs", plan.jobs);
}

namespace {

/// As bash's mapfile -d '' reads them.
std::string endedByNul(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += word + '\0';
  return text;
}

constexpr const char* arrayScript = R"sh(#!/bin/bash
#SBATCH --job-name=crossgrain
#SBATCH --output=logs/%a.log
#SBATCH --array=1-{}
# One job of a plan made by `crossgrain plan`. Its words are in jobs/N, each ended by a NUL; none is read as shell.
cd -- "${{SLURM_SUBMIT_DIR:?is set by Slurm: run ./submit}}" || exit 2
mapfile -d '' -t words < "jobs/${{SLURM_ARRAY_TASK_ID:?is set by Slurm: run ./submit}}" || exit 2
exec "${{words[@]}}"
)sh";

constexpr const char* mergeScript = R"sh(#!/bin/bash
#SBATCH --job-name=crossgrain-merge
#SBATCH --output=logs/merge.log
# Makes one site of what the jobs left, and says of each job what is not as planned.
cd -- "${SLURM_SUBMIT_DIR:?is set by Slurm: run ./submit}" || exit 2
mapfile -d '' -t words < merge.words || exit 2
exec "${words[@]}"
)sh";

constexpr const char* submitScript = R"sh(#!/bin/bash
# Submits the array and, after it, the merging. What is said here goes to both: ./submit --time=2:00:00 --cpus-per-task=4
set -eu
cd -- "$(dirname -- "${BASH_SOURCE[0]}")"
mkdir -p logs
array=$(sbatch --parsable "$@" array.sh)
merge=$(sbatch --parsable --dependency="afterany:${array%%;*}" "$@" merge.sh)
echo "jobs ${array%%;*}, merging ${merge%%;*}: results in results/, the site in site/, what was said in logs/"
)sh";

void writeProgram(const fs::path& file, const std::string& content) {
  writeFile(file, content);
  fs::permissions(file, fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec,
                  fs::perm_options::add);
}

}  // namespace

void writeSlurm(const JobPlan& plan, const fs::path& folder, const fs::path& program) {
  std::error_code none;
  if (fs::exists(folder, none) && !(fs::is_directory(folder, none) && fs::is_empty(folder, none)))
    throw BadInput(fmt::format("--slurm {}: is there already; give a new folder", folder.string()));
  makeDirectory(folder / "jobs");
  for (std::size_t k = 0; k < plan.jobs.size(); ++k) {
    std::vector<std::string> words = {program.string()};
    words.insert(words.end(), plan.jobs[k].words.begin(), plan.jobs[k].words.end());
    writeFile(folder / "jobs" / std::to_string(k + 1), endedByNul(words));
  }
  writeFile(folder / "merge.words", endedByNul({program.string(), "report", ".", "--out", "site"}));
  writeFile(folder / "array.sh", fmt::format(fmt::runtime(arrayScript), plan.jobs.size()));
  writeFile(folder / "merge.sh", mergeScript);
  writeProgram(folder / "submit", submitScript);
  Json document = jsonOf(plan);
  document["schema"] = planSchema;
  writeFile(folder / planFile, document.dump(1) + "\n");
}

JobPlan readPlan(const fs::path& folder) {
  const fs::path file = folder / planFile;
  const auto bad = [&](const std::string& why) {
    return BadInput(fmt::format("{}: {}", file.string(), why));
  };
  const auto document = readJsonFile(file);
  if (!document) throw bad("cannot be read");
  if (const auto schema = document->find("schema");
      schema == document->end() || *schema != planSchema)
    throw bad(fmt::format("is no plan: its schema is not \"{}\"", planSchema));
  const JobPlan plan = understood(file, [&] { return readAs<JobPlan>(*document); });
  std::set<std::string> names, parts;
  for (const PlannedJob& job : plan.jobs) {
    if (job.name.empty() || job.name.starts_with(".") || job.name.find('/') != std::string::npos)
      throw bad(fmt::format("'{}' is no name of a job", job.name));
    if (!names.insert(job.name).second)
      throw bad(fmt::format("has two jobs of the name {}", job.name));
    if (!parts.insert(fmt::format("{} {}", job.setup, fmt::join(job.engines, " "))).second)
      throw bad(fmt::format("the job {} does what another one does", job.name));
  }
  return plan;
}

}  // namespace crossgrain::inline studies
