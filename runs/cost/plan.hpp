#pragma once

#include <map>
#include <string>
#include <vector>

#include "runs/cost/settings.hpp"

namespace crossgrain::inline runs {

/// One point (or all measures of one) that is to be measured.
struct PlannedPoint {
  std::size_t engine = 0;
  CostKind kind = CostKind::collision;
  std::size_t setting = 0;   ///< of that engine and kind
  double seconds = 0.0;      ///< predicted; 0: an earlier run has it, or it costs nothing more
  std::string notMeasured;   ///< why it is not; empty if it is
  bool windowsOnly = false;  ///< as of CostSetting
};

/// What each engine's references take besides its points, by kind of error [s].
using Overheads = std::vector<std::map<CostKind, double>>;

/// What is to be measured, and what it is predicted to take.
struct CostPlan {
  std::vector<PlannedPoint> points = {};
  Overheads overhead = {};                          ///< of each engine's references
  std::vector<double> shares = {};                  ///< of the budget, by engine [s]
  double common = 0.0;                              ///< of references that all engines share [s]
  std::map<CostKind, std::string> impossible = {};  ///< kinds without references, and why
  double budgetForTheRest = 0.0;                    ///< for what does not fit, all else kept [s]
};

/// A budget shared fairly: nobody gets more than wanted, and what some leave goes to the others in
/// equal parts.
std::vector<double> fairShares(const std::vector<double>& wanted, double budget);

/// Marks as not measured what does not fit. Engines share the budget fairly; each takes collisions
/// before trajectories before averages, of averages what is bounded over short windows before what
/// is measured in whole runs, and of each kind the case as it is first, then the cheapest (within a
/// kind all points tell about as much). The first point of a kind pays for its references.
/// @returns each engine's share [s]
std::vector<double> fitIntoBudget(std::vector<PlannedPoint>& points, const Overheads& overhead,
                                  double budget);

/// The budget that a later run needs for what this one leaves out, when all else is kept [s].
double budgetOfLeftOut(const std::vector<PlannedPoint>& points, const Overheads& overhead);

/// The order in which an engine's points are measured.
bool comesBefore(const PlannedPoint& one, const PlannedPoint& other);

/// "would take about 90 s; grain's share …"
std::string doesNotFit(double seconds, double left, double budget);

/// The plan as lines: per engine and kind how many points, how many seconds, how many do not fit.
std::string planInWords(const CostPlan& plan, const std::vector<std::string>& engines,
                        double budget);

}  // namespace crossgrain::inline runs
