#include "runs/baseline/baseline_cases.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cases/case_keys.hpp"
#include "cases/loader.hpp"
#include "support/bad_input.hpp"
#include "support/files.hpp"
#include "support/scratch_folder.hpp"

namespace crossgrain::inline runs {
namespace {

constexpr const char* packingKey = "particles.file";

}  // namespace

std::vector<Case> casesOf(const Baseline& baseline, const std::filesystem::path& file,
                          const std::vector<std::string>& overrides) {
  const ScratchFolder scratch;
  const std::filesystem::path document = scratch.path / "case.toml";
  writeFile(document, baseline.setup.toml);
  std::vector<std::string> all;
  // The packing that the flow began with need not be there any more: starts are kept.
  if (!baseline.starts.empty() && caseKeys(baseline.setup.toml).contains(packingKey)) {
    const std::filesystem::path packing = scratch.path / "packing.h5";
    writePacking(baseline.starts.front().packing, packing);
    all.push_back(fmt::format("{}={}", packingKey, packing.string()));
  }
  all.insert(all.end(), overrides.begin(), overrides.end());
  std::vector<Case> cases;
  try {
    cases = loadCase(document, all);
  } catch (const BadInput& error) {
    throw BadInput(fmt::format("{}: its case: {}", file.string(), error.what()));
  }
  for (Case& setup : cases) {
    setup.name = baseline.setup.name;
    setup.file = baseline.setup.file;
  }
  return cases;
}

std::vector<std::string> changedKeys(const std::vector<Case>& before,
                                     const std::vector<Case>& now) {
  std::vector<std::string> all;
  for (std::size_t k = 0; k < now.size() && k < before.size(); ++k) {
    CaseKeys was = caseKeys(before[k].resolvedToml), is = caseKeys(now[k].resolvedToml);
    was.erase(packingKey);
    is.erase(packingKey);
    for (const std::string& change : changes(was, is))
      if (std::ranges::find(all, change) == all.end()) all.push_back(change);
  }
  return all;
}

}  // namespace crossgrain::inline runs
