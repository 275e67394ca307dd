#include "studies/cost/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <tuple>

namespace crossgrain::inline studies {

std::vector<double> fairShares(const std::vector<double>& wanted, double budget) {
  std::vector<std::size_t> order(wanted.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](std::size_t k) { return wanted[k]; });
  std::vector<double> shares(wanted.size());
  double left = std::max(budget, 0.0);
  for (std::size_t k = 0; k < order.size(); ++k) {
    const double equal = left / static_cast<double>(order.size() - k);
    shares[order[k]] = std::min(wanted[order[k]], equal);
    left -= shares[order[k]];
  }
  return shares;
}

std::string doesNotFit(double seconds, double left, double share) {
  return fmt::format(
      "would take about {:.3g} s, {:.3g} s are left of the engine's share of {:.3g} s", seconds,
      std::max(left, 0.0), share);
}

namespace {

double referenceTime(const CostPlan& plan, std::size_t engine, CostKind kind) {
  const auto found = plan.references[engine].find(kind);
  return found == plan.references[engine].end() ? 0.0 : found->second;
}

}  // namespace

void fitIntoBudget(CostPlan& plan, double budget) {
  const std::size_t engines = plan.references.size();
  std::vector<double> wanted(engines, 0.0), spent(engines, 0.0);
  for (std::size_t e = 0; e < engines; ++e)
    for (const auto& [kind, seconds] : plan.references[e]) wanted[e] += seconds;
  for (const PlannedPoint& point : plan.points) wanted[point.engine] += point.seconds;
  plan.shares = fairShares(wanted, budget - plan.common);
  std::ranges::stable_sort(plan.points, {}, [](const PlannedPoint& point) {
    return std::tuple(point.kind, point.setting > 0, point.seconds, point.setting);
  });
  std::set<std::pair<std::size_t, CostKind>> paid, left;
  for (PlannedPoint& point : plan.points) {
    const auto why = plan.impossible.find(point.kind);
    if (why != plan.impossible.end()) point.notMeasured = why->second;
    if (!(point.seconds > 0.0)) continue;
    const std::pair group(point.engine, point.kind);
    const double share = plan.shares[point.engine];
    const double reference = referenceTime(plan, point.engine, point.kind);
    const double takes = point.seconds + (paid.contains(group) ? 0.0 : reference);
    // Sums of the same numbers in another order differ in their last digits.
    if (spent[point.engine] + takes > share * (1.0 + 1e-9) && point.notMeasured.empty())
      point.notMeasured = doesNotFit(takes, share - spent[point.engine], share);
    if (point.notMeasured.empty()) {
      spent[point.engine] += takes;
      paid.insert(group);
      continue;
    }
    plan.budgetForTheRest += point.seconds + (left.contains(group) ? 0.0 : reference);
    left.insert(group);
  }
}

std::string planText(const CostPlan& plan, const std::vector<std::string>& engines, double budget) {
  std::string text = fmt::format("plan for a budget of {:.3g} s, {:.3g} s of it for references",
                                 budget, plan.common);
  for (std::size_t e = 0; e < engines.size(); ++e) {
    int count = 0, left = 0;
    double seconds = 0.0;
    for (const PlannedPoint& point : plan.points) {
      if (point.engine != e) continue;
      ++count;
      left += !point.notMeasured.empty();
      if (point.notMeasured.empty()) seconds += point.seconds;
    }
    if (count > 0)
      text += fmt::format("\n  {:<16} {:3} settings, about {:6.1f} s{}", engines[e], count, seconds,
                          left > 0 ? fmt::format("; {} do not fit", left) : "");
  }
  return text;
}

}  // namespace crossgrain::inline studies
