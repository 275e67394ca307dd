#include "runs/cost/planner.hpp"

namespace crossgrain::inline runs {

namespace {

/// Of one kind, engine by engine. @param anew  set for engines that have something to be measured
void addPoints(CostPlan& plan, const CostStudy& study, const ErrorKind& kind,
               std::vector<bool>& anew) {
  for (std::size_t e = 0; e < study.engines.size(); ++e) {
    const std::vector<CostSetting>& settings = study.settingsOf(e, kind.kind());
    for (std::size_t s = 0; s < settings.size(); ++s) {
      PlannedPoint point{e, kind.kind(), s, 0.0, {}, settings[s].windowsOnly};
      if (settings[s].refusal.empty() && !study.isKept(point)) {
        point.seconds = kind.predicted(e, settings[s]);
        anew[e] = true;
      }
      plan.points.push_back(point);
    }
  }
}

}  // namespace

CostPlan planCost(const CostStudy& study, const ErrorKinds& kinds, double budget) {
  const std::size_t engines = study.engines.size();
  CostPlan plan{.overhead = Overheads(engines)};
  double budgetLeftOut = 0.0;
  for (const auto& kind : kinds) {
    std::vector<bool> anew(engines, false);
    addPoints(plan, study, *kind, anew);
    const ReferenceCost cost = kind->referenceCost(anew, budget);
    plan.common += cost.common;
    budgetLeftOut += cost.budgetLeftOut;
    if (!cost.impossible.empty()) plan.impossible[kind->kind()] = cost.impossible;
    for (std::size_t e = 0; e < cost.own.size(); ++e) plan.overhead[e][kind->kind()] = cost.own[e];
  }
  plan.shares = fitIntoBudget(plan.points, plan.overhead, budget - plan.common);
  for (PlannedPoint& point : plan.points)
    if (const auto why = plan.impossible.find(point.kind); why != plan.impossible.end())
      point.notMeasured = why->second;
  plan.budgetForTheRest = budgetLeftOut + budgetOfLeftOut(plan.points, plan.overhead);
  return plan;
}

}  // namespace crossgrain::inline runs
