#include "runs/cost/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <tuple>

namespace crossgrain::inline runs {

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

bool comesBefore(const PlannedPoint& one, const PlannedPoint& other) {
  const auto rank = [](const PlannedPoint& point) {
    return std::tuple(point.kind, !point.windowsOnly, point.setting > 0, point.seconds,
                      point.setting);
  };
  return rank(one) < rank(other);
}

std::string doesNotFit(double seconds, double left, double budget) {
  return fmt::format(
      "would take about {:.3g} s, {:.3g} s are left of the engine's share of {:.3g} s", seconds,
      std::max(left, 0.0), budget);
}

namespace {

double overheadOf(const Overheads& overhead, std::size_t engine, CostKind kind) {
  const auto found = overhead[engine].find(kind);
  return found == overhead[engine].end() ? 0.0 : found->second;
}

}  // namespace

std::vector<double> fitIntoBudget(std::vector<PlannedPoint>& points, const Overheads& overhead,
                                  double budget) {
  std::vector<double> wanted(overhead.size(), 0.0);
  for (std::size_t e = 0; e < overhead.size(); ++e)
    for (const auto& [kind, seconds] : overhead[e]) wanted[e] += seconds;
  for (const PlannedPoint& point : points) wanted[point.engine] += point.seconds;
  const std::vector<double> shares = fairShares(wanted, budget);
  std::vector<double> spent(overhead.size(), 0.0);
  std::set<std::pair<std::size_t, CostKind>> paid;
  std::ranges::stable_sort(points, comesBefore);
  for (PlannedPoint& point : points) {
    if (!(point.seconds > 0.0)) continue;
    const double share = shares[point.engine];
    const bool first = !paid.contains({point.engine, point.kind});
    const double takes =
        point.seconds + (first ? overheadOf(overhead, point.engine, point.kind) : 0.0);
    // Sums of the same numbers in another order differ in their last digits.
    if (spent[point.engine] + takes > share * (1.0 + 1e-9)) {
      point.notMeasured = doesNotFit(takes, share - spent[point.engine], share);
      continue;
    }
    spent[point.engine] += takes;
    paid.insert({point.engine, point.kind});
  }
  return shares;
}

double budgetOfLeftOut(const std::vector<PlannedPoint>& points, const Overheads& overhead) {
  double seconds = 0.0;
  std::set<std::pair<std::size_t, CostKind>> references;
  for (const PlannedPoint& point : points) {
    if (point.notMeasured.empty()) continue;
    seconds += point.seconds;
    references.insert({point.engine, point.kind});
  }
  for (const auto& [engine, kind] : references) seconds += overheadOf(overhead, engine, kind);
  return seconds;
}

std::string planInWords(const CostPlan& plan, const std::vector<std::string>& engines,
                        double budget) {
  std::string text = fmt::format("plan for a budget of {:.3g} s:\n", budget);
  double total = plan.common;
  for (std::size_t e = 0; e < engines.size(); ++e) {
    for (const CostKind kind : costKinds) {
      int count = 0, left = 0;
      double seconds = 0.0;
      for (const PlannedPoint& point : plan.points) {
        if (point.engine != e || point.kind != kind) continue;
        ++count;
        if (!point.notMeasured.empty())
          ++left;
        else
          seconds += point.seconds;
      }
      if (seconds > 0.0) seconds += overheadOf(plan.overhead, e, kind);
      total += seconds;
      if (count > 0)
        text += fmt::format("  {:<16} {:<11} {:3} settings, about {:6.1f} s{}\n", engines[e],
                            toString(kind), count, seconds,
                            left > 0 ? fmt::format("; {} do not fit", left) : "");
    }
  }
  return text + fmt::format("  {:<28} {:22} {:6.1f} s\n  {:<28} {:22} {:6.1f} s\n",
                            "references of the in-house engine", "", plan.common, "in all", "",
                            total);
}

}  // namespace crossgrain::inline runs
