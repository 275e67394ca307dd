#include "reports/stability/table.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace crossgrain::reports {

std::vector<HardGroup> hardGroups(const StabilityResults& results) {
  std::vector<HardGroup> groups;
  for (const HardCase& variant : results.cases) {
    auto group = std::ranges::find(groups, variant.name, &HardGroup::name);
    if (group == groups.end()) group = groups.insert(groups.end(), {variant.name, {}});
    group->variants.push_back(&variant);
  }
  return groups;
}

const StabilityRun* runOf(const StabilityResults& results, const std::string& engine,
                          const HardCase& variant) {
  const auto found = std::ranges::find_if(results.runs, [&](const StabilityRun& run) {
    return run.engine == engine && run.name == variant.name && run.variant == variant.variant;
  });
  return found == results.runs.end() ? nullptr : &*found;
}

bool isWorse(const StabilityRun& run, const StabilityRun& than) {
  const auto badness = [](const StabilityRun& one) {
    const double value = one.value.value_or(0.0);
    return std::pair(one.verdict, one.limit > 0.0 ? value / one.limit : value);
  };
  return badness(run) > badness(than);
}

const StabilityRun* worstRun(const StabilityResults& results, const std::string& engine,
                             const HardGroup& group) {
  const StabilityRun* worst = nullptr;
  for (const HardCase* variant : group.variants) {
    const StabilityRun* run = runOf(results, engine, *variant);
    if (run && (!worst || isWorse(*run, *worst))) worst = run;
  }
  return worst;
}

}  // namespace crossgrain::reports
