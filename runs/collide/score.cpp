#include "runs/collide/score.hpp"

#include <fmt/format.h>
#include <gsl/gsl_fit.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "runs/common/records.hpp"

namespace crossgrain::inline runs {

using nlohmann::json;

ErrorUnit errorUnit(const std::vector<double>& oracle) {
  if (oracle.empty()) return {"absolute", 1.0};
  const auto [low, high] = std::ranges::minmax(oracle);
  const double range = high - low, magnitude = std::max(std::abs(low), std::abs(high));
  if (magnitude == 0.0) return {"absolute", 1.0};
  return range < 0.1 * magnitude ? ErrorUnit{"magnitude", magnitude} : ErrorUnit{"range", range};
}

json noScore() {
  return {{"max_error", nullptr},
          {"rms_error", nullptr},
          {"e_n_error", nullptr},
          {"verdict", "not judged"},
          {"limit", nullptr}};
}

namespace {

/// Null where engine and oracle have no collision in common that has this quantity.
json scoreQuantity(const Case& setup, const CollisionQuantity& quantity,
                   const std::vector<CollisionStart>& starts, const Outcomes& found,
                   const Outcomes& oracle) {
  const CollidingPair pair = collidingPair(setup);
  std::vector<double> expected;
  double largest = 0.0, squares = 0.0;
  int count = 0;
  for (std::size_t k = 0; k < starts.size(); ++k) {
    const auto valueOf = [&](const Outcomes& outcomes) {
      return outcomes[k] ? quantity.value(*outcomes[k], pair, starts[k].vn) : std::nullopt;
    };
    const auto reference = valueOf(oracle), value = valueOf(found);
    if (!reference) continue;
    expected.push_back(*reference);
    if (!value) continue;
    const double error = std::abs(*value - *reference);
    largest = std::max(largest, error);
    squares += error * error;
    ++count;
  }
  if (count == 0) return nullptr;
  const ErrorUnit unit = quantity.isShare ? ErrorUnit{"energy_before", 1.0} : errorUnit(expected);
  json score = {{"max", largest / unit.value},
                {"rms", std::sqrt(squares / count) / unit.value},
                {"unit", unit.value},
                {"unit_is", unit.name},
                {"limit", nullptr},
                {"held", nullptr}};
  const auto margin = setup.collision.margins.find(std::string(quantity.name));
  if (margin == setup.collision.margins.end()) return score;
  const double limit =
      margin->second.relative ? margin->second.value : margin->second.value / unit.value;
  score["limit"] = limit;
  score["held"] = largest / unit.value <= limit;
  score["why"] = margin->second.why;
  return score;
}

}  // namespace

json scoreSweep(const Case& setup, const std::vector<CollisionStart>& starts, const Outcomes& found,
                const Outcomes& oracle) {
  json score = noScore();
  bool judged = false, held = std::ranges::all_of(found, [](const auto&o) { return bool(o); });
  for (const CollisionQuantity& quantity : collisionQuantities()) {
    const json one = scoreQuantity(setup, quantity, starts, found, oracle);
    if (one.is_null()) continue;
    judged = judged || one["held"].is_boolean();
    held = held && one["held"] != false;
    score[std::string(quantity.name)] = one;
  }
  if (score.contains("psi_f"))
    score.update({{"max_error", score["psi_f"]["max"]},
                  {"rms_error", score["psi_f"]["rms"]},
                  {"limit", score["psi_f"]["limit"]}});
  if (score.contains("e_n"))
    score["e_n_error"] = score["e_n"]["max"].get<double>() * score["e_n"]["unit"].get<double>();
  if (judged) score["verdict"] = held ? "held" : "fell short";
  return score;
}

namespace {

/// {order, stderr} of error ∝ dt^order: the slope in log–log, its error from three steps on.
std::optional<json> fittedOrder(const std::map<double, double>& errorAt) {
  if (errorAt.size() < 2) return std::nullopt;
  std::vector<double> logStep, logError;
  for (const auto& [dt, error] : errorAt) {
    logStep.push_back(std::log(dt));
    logError.push_back(std::log(error));
  }
  double intercept = 0.0, slope = 0.0, var00 = 0.0, var01 = 0.0, var11 = 0.0, squares = 0.0;
  gsl_fit_linear(logStep.data(), 1, logError.data(), 1, logStep.size(), &intercept, &slope, &var00,
                 &var01, &var11, &squares);
  json order = {{"order", slope}, {"stderr", nullptr}};
  if (logStep.size() > 2) order["stderr"] = std::sqrt(var11);
  return order;
}

}  // namespace

std::optional<json> convergenceOrder(const std::vector<const json*>& curves) {
  json quantities = json::object(), errors = json::object();
  for (const CollisionQuantity& quantity : collisionQuantities()) {
    const std::string name(quantity.name);
    std::map<double, double> errorAt;
    for (const json* curve : curves) {
      const json& score = (*curve)["score"];
      if (!score.contains(name) || !(score[name]["rms"] > 0.0)) continue;
      errorAt.emplace((*curve)["dt"].get<double>(), score[name]["rms"].get<double>());
    }
    if (const auto order = fittedOrder(errorAt)) quantities[name] = *order;
    if (name == "psi_f")
      for (const auto& [dt, error] : errorAt) errors[fmt::format("{:.4g}", dt)] = error;
  }
  if (quantities.empty()) return std::nullopt;
  json entry = {{"engine", (*curves.front())["engine"]}, {"order", nullptr}, {"stderr", nullptr}};
  if (quantities.contains("psi_f")) entry.update(quantities["psi_f"]);
  entry["error_at"] = errors;
  entry["quantities"] = quantities;
  return entry;
}

}  // namespace crossgrain::inline runs
