#include "results/cost.hpp"

#include "results/cost_fields.hpp"
#include "results/couette_fields.hpp"
#include "results/engine_fields.hpp"

namespace crossgrain::inline results {

void fields(auto& io, CostResults& results) {
  fields(io, static_cast<CouetteFrame&>(results));
  io("elapsed_s", results.elapsed);
  io("engines", results.engines);
  io("packings", results.packings);
  io("budget_s", results.budget);
  io("budget_for_the_rest_s", results.budgetForTheRest);
  io("points", results.points);
  io("references", results.references);
  io("models", results.models);
  io.present("trajectory", results.trajectory);
  io("averages", results.averages);
  io("startup", results.startup);
  io("theory", results.theory);
  io("engine_failures", results.engineFailures);
  io("orders", results.orders);
  io("fronts", results.fronts);
  io("cheapest", results.cheapest);
  io("advice", results.advice);
  io("cells", results.cells);
}

Json toJson(const CostResults& results) {
  return jsonOf(results);
}

CostResults costFromJson(const Json& json) {
  return readAs<CostResults>(json);
}

}  // namespace crossgrain::inline results
