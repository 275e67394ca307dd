#include "studies/core/shared_conventions.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

#include "adapters/law_options.hpp"
#include "adapters/suitability.hpp"
#include "cases/case_keys.hpp"
#include "studies/core/engine_access.hpp"
#include "support/scratch_folder.hpp"

namespace crossgrain::inline studies {

namespace {

/// Conventions that the case leaves to their defaults.
std::vector<std::string> openConventions(const Case& setup) {
  const CaseKeys given = caseKeys(setup.resolvedToml);
  std::vector<std::string> open;
  for (const LawOption& option : lawOptions()) {
    const std::string name(option.name);
    if (isConvention(name) && !given.contains("law." + name) &&
        std::ranges::find(setup.run.mayDiffer, name) == setup.run.mayDiffer.end())
      open.push_back(name);
  }
  return open;
}

/// Values of an option that all engines have, in the first one's order; absent: no engine lists
/// it.
std::optional<std::vector<std::string>> valuesOfAll(const std::vector<Capabilities>& all,
                                                    const std::string& option) {
  std::optional<std::vector<std::string>> shared;
  for (const Capabilities& can : all) {
    const auto found = can.lawOptions.find(option);
    if (found == can.lawOptions.end()) continue;
    if (!shared)
      shared = found->second;
    else
      std::erase_if(*shared, [&](const std::string& value) {
        return std::ranges::find(found->second, value) == found->second.end();
      });
  }
  return shared;
}

}  // namespace

std::vector<std::string> sharedConventions(const Case& setup,
                                           const std::vector<Capabilities>& all) {
  std::vector<Capabilities> soft;
  for (const Capabilities& can : all)
    if (hasNormalLaw(can, setup.law)) soft.push_back(can);
  const std::vector<std::string> open = openConventions(setup);
  ContactLaw law = setup.law;
  std::vector<std::string> overrides;
  // What one convention is decides whether another matters: again until nothing changes.
  for (bool changed = true; changed;) {
    changed = false;
    for (const std::string& option : open) {
      if (!mattersTo(law, option)) continue;
      const auto values = valuesOfAll(soft, option);
      if (!values || values->empty() ||
          std::ranges::find(*values, lawOptionValue(law, option)) != values->end())
        continue;
      setLawOption(law, option, values->front());
      overrides.push_back(fmt::format("law.{}=\"{}\"", option, values->front()));
      changed = true;
    }
  }
  return overrides;
}

std::vector<std::string> sharedConventionsOf(const Case& setup,
                                             const std::vector<std::string>& engines) {
  if (engines.size() < 2 || std::ranges::find(engines, "all") != engines.end() ||
      std::ranges::none_of(openConventions(setup),
                           [&](const std::string& option) { return mattersTo(setup.law, option); }))
    return {};
  const ScratchFolder scratch;
  std::vector<Capabilities> all;
  for (const EngineEntry& entry : selectEngines(engines)) {
    if (entry.ofFiles() || (entry.missing && !entry.missing().empty())) continue;
    try {
      all.push_back(startEngine(entry, scratch.path, setup.run.timeout)->capabilities());
    } catch (const EngineFailure&) {  // what is wrong is said where the engine is to run
    }
  }
  return sharedConventions(setup, all);
}

std::string describeShared(const std::vector<std::string>& shared) {
  return fmt::format(
      "conventions that all engines named share: {} (give them, or list them in "
      "run.may_differ, to have others)",
      fmt::join(shared, ", "));
}

bool shareConventions(const Case& setup, const std::vector<std::string>& engines,
                      std::vector<std::string>& overrides) {
  const std::vector<std::string> shared = sharedConventionsOf(setup, engines);
  if (shared.empty()) return false;
  fmt::print(stderr, "note: {}: {}\n", setup.file.string(), describeShared(shared));
  overrides.insert(overrides.end(), shared.begin(), shared.end());
  return true;
}

}  // namespace crossgrain::inline studies
