#include "runs/thesis/earlier_runs.hpp"

#include <fmt/format.h>

#include "results/schema.hpp"
#include "results/thesis_fields.hpp"
#include "runs/common/run_store.hpp"
#include "support/bad_input.hpp"
#include "support/fingerprint.hpp"

namespace crossgrain::inline runs {

std::string keyOfRun(const Case& setup, const CaseKeys& task) {
  return fmt::format("{:016x}", fnv1a(Json(keysThatMatter(setup)).dump() + Json(task).dump()));
}

EarlierRuns readEarlierRuns(const std::filesystem::path& file) {
  const nlohmann::json document = readResultsFile(file);
  const std::string name = file.string();
  if (document.at("kind") != kindThesis)
    throw BadInput(fmt::format("--from {}: its results are of 'crossgrain {}', not of a ladder",
                               name, document.at("kind").get<std::string>()));
  EarlierRuns runs;
  for (ThesisRun& run : understood(file, [&] { return thesisFromJson(document); }).runs)
    if (!run.key.empty() && run.run.status != RunStatus::failed)
      runs.emplace(run.key, std::move(run));
  return runs;
}

std::vector<std::string> madeByOthers(const std::vector<ThesisRun>& runs) {
  std::map<std::string, std::size_t> counts;
  for (const ThesisRun& run : runs)
    if (!run.program.empty() && run.program != thisProgram()) ++counts[run.program];
  std::vector<std::string> sentences;
  for (const auto& [program, count] : counts)
    sentences.push_back(fmt::format("{} of {} runs {} made by crossgrain {}, the others by {}.",
                                    count, runs.size(), count == 1 ? "was" : "were", program,
                                    thisProgram()));
  return sentences;
}

}  // namespace crossgrain::inline runs
