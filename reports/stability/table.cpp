#include "reports/stability/table.hpp"

#include <algorithm>

#include "reports/common/csv.hpp"
#include "reports/common/csv_row.hpp"

namespace crossgrain::reports {

namespace {

const Json nothing;

}  // namespace

std::size_t verdictRank(std::string_view verdict) {
  const auto found = std::ranges::find(verdictLooks, verdict, &VerdictLook::name);
  return found == verdictLooks.end() ? 0 : static_cast<std::size_t>(found - verdictLooks.begin());
}

std::vector<HardGroup> hardGroups(const Json& results) {
  std::vector<HardGroup> groups;
  for (const Json& variant : list(results, "cases")) {
    const std::string name = text(variant, "case");
    auto group = std::ranges::find(groups, name, &HardGroup::name);
    if (group == groups.end()) group = groups.insert(groups.end(), {name, {}});
    group->variants.push_back(&variant);
  }
  return groups;
}

const Json& runOf(const Json& results, const std::string& engine, const Json& variant) {
  for (const Json& run : list(results, "runs"))
    if (text(run, "engine") == engine && text(run, "case") == text(variant, "case") &&
        text(run, "variant") == text(variant, "variant"))
      return run;
  return nothing;
}

const Json& worstRun(const Json& results, const std::string& engine, const HardGroup& group) {
  const Json* worst = &nothing;
  const auto badness = [](const Json& run) {
    const double limit = number(run, "limit").value_or(0.0);
    const double value = number(run, "value").value_or(0.0);
    return std::pair(verdictRank(text(run, "verdict")), limit > 0.0 ? value / limit : value);
  };
  for (const Json* variant : group.variants) {
    const Json& run = runOf(results, engine, *variant);
    if (run.is_null()) continue;
    if (worst->is_null() || badness(run) > badness(*worst)) worst = &run;
  }
  return *worst;
}

std::string stabilityCsv(const Json& results) {
  std::string table =
      "engine,case,verdict,measure,value,limit,unit,step,reason,degraded_limit,variant,time_s\n";
  for (const Json& run : list(results, "runs"))
    table += row(text(run, "engine"), text(run, "case"), text(run, "verdict"), text(run, "measure"),
                 number(run, "value"), number(run, "limit"), text(run, "unit"), number(run, "step"),
                 text(run, "reason"), number(run, "degraded_limit"), text(run, "variant"),
                 number(run, "time_s"));
  return table;
}

}  // namespace crossgrain::reports
