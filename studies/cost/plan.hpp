#pragma once

#include <map>
#include <string>
#include <vector>

#include "cases/cost.hpp"

/// What of a study of cost fits into its budget. Times are predictions [s].
namespace crossgrain::inline studies {

/// One setting of one engine, all measures of one kind of error.
struct PlannedPoint {
  std::size_t engine = 0;
  CostKind kind = CostKind::collision;
  std::size_t setting = 0;       ///< of that engine and kind; 0 is the case as it is
  double seconds = 0.0;          ///< 0: an earlier run has it, or it is refused
  std::string notMeasured = {};  ///< why it is not; empty if it is
};

/// What each engine's references take besides its points.
using ReferenceTimes = std::vector<std::map<CostKind, double>>;

struct CostPlan {
  std::vector<PlannedPoint> points = {};  ///< in the order in which an engine's are measured
  ReferenceTimes references = {};         ///< by engine
  double common = 0.0;                    ///< of references that all engines share
  std::map<CostKind, std::string> impossible = {};  ///< kinds without references, and why
  std::vector<double> shares = {};                  ///< of the budget, by engine
  double budgetForTheRest = 0.0;                    ///< for what does not fit, all else kept
};

/// A budget shared fairly: nobody gets more than wanted, and what some leave goes to the others in
/// equal parts.
std::vector<double> fairShares(const std::vector<double>& wanted, double budget);

/// Marks as not measured what does not fit, and sets shares and the budget for the rest. Engines
/// share the budget fairly; each takes collisions before trajectories before averages, and of each
/// kind the case as it is first, then the cheapest. The first point of a kind pays for its
/// references.
/// @param budget  for everything, what is common included
void fitIntoBudget(CostPlan& plan, double budget);

/// "would take about 90 s, 8 s are left of the engine's share of 20 s"
std::string doesNotFit(double seconds, double left, double share);

/// The plan as lines: per engine how many points, how many seconds, how many do not fit.
std::string planText(const CostPlan& plan, const std::vector<std::string>& engines, double budget);

}  // namespace crossgrain::inline studies
