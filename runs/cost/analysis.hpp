#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "runs/cost/advice.hpp"
#include "runs/cost/front.hpp"
#include "runs/cost/order.hpp"
#include "runs/cost/point.hpp"

namespace crossgrain::inline runs {

/// Entries of results.json's "orders", "fronts", "cheapest" and "advice" (reports/README.md).
/// Points are given by their place in "points".
nlohmann::json toJson(const OrderFit& fit, const std::vector<CostPoint>& points);
nlohmann::json toJson(const Front& front);
nlohmann::json toJson(const Cheapest& row);
nlohmann::json toJson(const Advice& advice);

/// Sets these four from results["points"] and results["theory"].
/// @param wants  accuracies to find settings for
void addCostAnalysis(nlohmann::json& results, const std::vector<double>& wants = usualWants());

}  // namespace crossgrain::inline runs
