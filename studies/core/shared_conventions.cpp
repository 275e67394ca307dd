#include "studies/core/shared_conventions.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "adapters/suitability.hpp"
#include "cases/case_keys.hpp"
#include "law/law_options.hpp"
#include "studies/core/engine_access.hpp"
#include "studies/core/mirrors.hpp"

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

using Lacks = std::set<std::pair<std::size_t, std::string>>;

/// Parts of a law that engines lack and the case does not let differ, by engine.
Lacks lacksOf(const std::vector<Capabilities>& all, const Case& setup, const ContactLaw& law) {
  Scene scene;
  scene.law = law;
  Lacks lacks;
  for (std::size_t k = 0; k < all.size(); ++k)
    for (const Mismatch& mismatch : mismatches(all[k], scene))
      if (std::ranges::find(setup.run.mayDiffer, mismatch.name) == setup.run.mayDiffer.end())
        lacks.emplace(k, mismatch.name);
  return lacks;
}

/// The law with the open conventions shared; absent: an engine then lacks what it does not lack of
/// the case's own law. What one convention is decides whether another matters, so that each value
/// is tried with all that follows from it.
std::optional<ContactLaw> sharedLaw(const Case& setup, const std::vector<Capabilities>& soft,
                                    ContactLaw law, std::vector<std::string> open) {
  for (std::size_t k = 0; k < open.size(); ++k) {
    const std::string option = open[k];
    if (!mattersTo(law, option)) continue;
    const auto values = valuesOfAll(soft, option);
    if (!values || std::ranges::find(*values, lawOptionValue(law, option)) != values->end())
      continue;
    open.erase(open.begin() + static_cast<std::ptrdiff_t>(k));
    for (const std::string& value : *values) {
      ContactLaw changed = law;
      setLawOption(changed, option, value);
      if (auto shared = sharedLaw(setup, soft, changed, open)) return shared;
    }
    return sharedLaw(setup, soft, law, std::move(open));
  }
  const Lacks before = lacksOf(soft, setup, setup.law), now = lacksOf(soft, setup, law);
  return std::ranges::includes(before, now) ? std::optional(law) : std::nullopt;
}

}  // namespace

std::vector<std::string> sharedConventions(const Case& setup,
                                           const std::vector<Capabilities>& all) {
  std::vector<Capabilities> soft;
  for (const Capabilities& can : all)
    if (hasNormalLaw(can, setup.law)) soft.push_back(can);
  const std::vector<std::string> open = openConventions(setup);
  const ContactLaw law = sharedLaw(setup, soft, setup.law, open).value_or(setup.law);
  std::vector<std::string> overrides;
  for (const std::string& option : open)
    if (const std::string value = lawOptionValue(law, option);
        value != lawOptionValue(setup.law, option))
      overrides.push_back(fmt::format("law.{}=\"{}\"", option, value));
  return overrides;
}

std::vector<std::string> sharedConventionsOf(const Case& setup,
                                             const std::vector<std::string>& engines) {
  addMirrors(setup.run.timeout);
  if (engines.size() < 2 || std::ranges::find(engines, "all") != engines.end() ||
      std::ranges::none_of(openConventions(setup),
                           [&](const std::string& option) { return mattersTo(setup.law, option); }))
    return {};
  std::vector<Capabilities> all;
  for (const EngineEntry& entry : selectEngines(engines)) {
    if (entry.ofFiles() || (entry.missing && !entry.missing().empty())) continue;
    // The fault of one that does not answer is said where it is to run.
    if (auto can = capabilitiesOf(entry, setup.run.timeout)) all.push_back(std::move(*can));
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
