#include "runs/cost/analysis.hpp"

#include "runs/cost/cheapest.hpp"
#include "runs/cost/cost_cells.hpp"
#include "runs/cost/front.hpp"
#include "runs/cost/order.hpp"

namespace crossgrain::inline runs {

void addCostAnalysis(CostResults& results, const std::vector<double>& targets) {
  results.orders = fitOrders(results.points, results.theory);
  results.fronts = paretoFronts(results.points);
  results.cheapest = cheapestTable(results.points, targets);
  results.advice = advice(results.points, targets);
  results.cells = costCells(results.points, results.models);
}

}  // namespace crossgrain::inline runs
