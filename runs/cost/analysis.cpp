#include "runs/cost/analysis.hpp"

#include "runs/common/records.hpp"

namespace crossgrain::inline runs {

using nlohmann::json;

namespace {

json indexOf(const std::optional<std::size_t>& point) {
  return point ? json(*point) : json();
}

}  // namespace

json toJson(const OrderFit& fit, const std::vector<CostPoint>& points) {
  json leftOut = json::array();
  for (const LeftOut& left : fit.leftOut)
    leftOut.push_back({{"point", left.point}, {"why", left.why}});
  json entry = {{"engine", fit.engine},
                {"error_kind", fit.errorKind},
                {"measure", fit.measure},
                {"integrator", fit.integrator},
                {"order", toJson(fit.order)},
                {"stderr", toJson(fit.standardError)},
                {"half_width", toJson(fit.halfWidth)},
                {"amplitude", toJson(fit.amplitude)},
                {"dt_low_s", nullptr},
                {"dt_high_s", nullptr},
                {"used", fit.used},
                {"left_out", leftOut},
                {"theory", toJson(fit.theory)},
                {"verdict", fit.verdict},
                {"reason", fit.reason}};
  if (!fit.used.empty()) {
    entry["dt_low_s"] = points[fit.used.front()].dt;
    entry["dt_high_s"] = points[fit.used.back()].dt;
  }
  return entry;
}

json toJson(const Front& front) {
  return {{"error_kind", front.errorKind},
          {"measure", front.measure},
          {"engine", front.engine},
          {"points", front.points},
          {"errors", front.errors}};
}

json toJson(const Cheapest& row) {
  return {
      {"engine", row.engine},     {"error_kind", row.errorKind},  {"measure", row.measure},
      {"want", row.want},         {"verdict", row.verdict},       {"point", indexOf(row.point)},
      {"high", toJson(row.high)}, {"length", toJson(row.length)}, {"cheaper", indexOf(row.cheaper)},
      {"decides", row.decides}};
}

json toJson(const Advice& advice) {
  return {{"engine", advice.engine},
          {"want", advice.want},
          {"verdict", advice.verdict},
          {"knob", advice.knob},
          {"setting", advice.setting},
          {"fragment", advice.fragment},
          {"kinds", advice.kinds},
          {"wall_s", toJson(advice.wallSeconds)},
          {"cost_kind", advice.costKind},
          {"length", toJson(advice.length)},
          {"obstacle", indexOf(advice.obstacle)},
          {"decides", advice.decides},
          {"cheapest", advice.cheapest}};
}

void addCostAnalysis(json& results, const std::vector<double>& wants) {
  std::vector<CostPoint> points;
  for (const json& entry : results.at("points")) points.push_back(costPointFromJson(entry));
  const auto theory = results.value("theory", std::map<std::string, double>());
  for (const char* key : {"orders", "fronts", "cheapest", "advice"}) results[key] = json::array();
  for (const OrderFit& fit : fitOrders(points, theory))
    results["orders"].push_back(toJson(fit, points));
  for (const Front& front : paretoFronts(points)) results["fronts"].push_back(toJson(front));
  for (const Cheapest& row : cheapestTable(points, wants))
    results["cheapest"].push_back(toJson(row));
  for (const Advice& one : advice(points, wants)) results["advice"].push_back(toJson(one));
}

}  // namespace crossgrain::inline runs
