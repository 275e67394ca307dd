#include "runs/collision_sweep.hpp"

#include <fmt/format.h>
#include <gsl/gsl_fit.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "adapters/worker/json.hpp"
#include "cases/time_step.hpp"
#include "runs/records.hpp"

namespace crossgrain {

using nlohmann::json;

OracleCurve oracleCurve(const Case& setup, const std::vector<CollisionStart>& starts) {
  OracleCurve curve;
  for (const CollisionStart& start : starts) {
    try {
      curve.ends.emplace_back(oracleOutcome(setup.law, collidingPair(setup), start));
    } catch (const std::exception& none) {
      curve.ends.emplace_back();
      curve.reason = none.what();
    }
  }
  return curve;
}

void describe(json& point, const std::optional<CollisionEnd>& end, const std::string& suffix) {
  const auto put = [&](const std::string& name, const std::optional<double>& value) {
    point[name + suffix] = toJson(value);
  };
  const auto of = [&](auto member) {
    return end ? std::optional<double>(std::invoke(member, *end)) : std::nullopt;
  };
  const auto lost = [&](double EnergySplit::*part) {
    return end && end->lost ? std::optional((*end->lost).*part) : std::nullopt;
  };
  put("e_n", of(&CollisionEnd::en));
  put("psi_f", of(&CollisionEnd::psi));
  put("beta", end ? end->beta : std::nullopt);
  put("centre_psi_f", of(&CollisionEnd::centrePsi));
  put("e_t", end ? end->et : std::nullopt);
  put("rebound_angle", of(&CollisionEnd::reboundAngle));
  put("spin_i", of([](const CollisionEnd& e) { return e.spin[0]; }));
  put("spin_j", of([](const CollisionEnd& e) { return e.spin[1]; }));
  put("duration", end ? end->duration : std::nullopt);
  put("max_overlap", end ? end->maxOverlap : std::nullopt);
  put("energy_before", of(&CollisionEnd::energyBefore));
  put("energy_after", of(&CollisionEnd::energyAfter));
  put("lost_normal_damping", lost(&EnergySplit::normalDamping));
  put("lost_tangential_damping", lost(&EnergySplit::tangentialDamping));
  put("lost_stiffening", lost(&EnergySplit::stiffening));
  put("lost_sliding", lost(&EnergySplit::sliding));
  put("lost_stored", lost(&EnergySplit::stored));
  if (end && end->limitless) point["limitless" + suffix] = true;
}

namespace {

/// t_c of the case's pair, the shortest; 0 for rigid disks [s].
double contactTimeOf(const Case& setup) {
  return impactTimes(setup).shortest;
}

/// Long enough for every collision of the scene to be over: contacts last about t_c, a rigid
/// engine's a few of its own steps.
double sweepEnd(const Case& setup, double dt, double engineStep) {
  const double contact = impactTimes(setup).longest;
  return dt + 2.5 * contact + 20.0 * engineStep;
}

struct Errors {
  double largest = 0.0, squares = 0.0, largestEn = 0.0;
  int count = 0;
};

/// A margin as a limit for errors given in units of `unit`.
std::optional<double> limitOf(const Case& setup, const char* name, double unit) {
  const auto margin = setup.collision.margins.find(name);
  if (margin == setup.collision.margins.end()) return std::nullopt;
  return margin->second.relative ? margin->second.value : margin->second.value / unit;
}

/// Errors of Ψ_f in units of the oracle curve's range, so that no part of the curve is favoured; of
/// e_n as they are. A curve holds where both stay within the case's margins.
json scoreJson(const Case& setup, const Errors& errors, double range, double en, int missing) {
  json score = {{"max_error", nullptr},
                {"rms_error", nullptr},
                {"e_n_error", nullptr},
                {"verdict", "not judged"},
                {"limit", nullptr}};
  if (errors.count == 0 || range <= 0.0) return score;
  score["max_error"] = errors.largest / range;
  score["rms_error"] = std::sqrt(errors.squares / errors.count) / range;
  score["e_n_error"] = errors.largestEn;
  const auto limit = limitOf(setup, "psi_f", range);
  const auto limitEn = limitOf(setup, "e_n", en);
  if (!limit && !limitEn) return score;
  score["limit"] = toJson(limit);
  const bool held = missing == 0 && (!limit || errors.largest / range <= *limit) &&
                    (!limitEn || errors.largestEn / en <= *limitEn);
  score["verdict"] = held ? "held" : "fell short";
  return score;
}

}  // namespace

json runSweep(Engine& engine, const EngineEntry& entry, const Case& setup, double dt,
              const std::vector<CollisionStart>& starts, const OracleCurve& oracle) {
  const Scene scene = collisionScene(setup, starts, dt);
  const Realised realised = loadScene(engine, entry, setup, scene);
  engine.advance(sweepEnd(setup, dt, realised.dt));
  const Snapshot after = engine.snapshot(ContactReport::none);

  json points = json::array();
  Errors errors;
  int missing = 0;
  double low = INFINITY, high = -INFINITY, largestEn = 0.0;
  for (std::size_t k = 0; k < starts.size(); ++k) {
    const auto end = collisionEnd(scene, after, k, starts[k]);
    const auto& reference = oracle.ends[k];
    json point = {
        {"psi_i", starts[k].psi}, {"v_n", starts[k].vn}, {"status", end ? "parted" : "not parted"}};
    describe(point, end, "");
    describe(point, reference, "_reference");
    points.push_back(std::move(point));
    if (!end) ++missing;
    if (!reference) continue;
    low = std::min(low, reference->psi);
    high = std::max(high, reference->psi);
    largestEn = std::max(largestEn, reference->en);
    if (!end) continue;
    const double error = std::abs(end->psi - reference->psi);
    errors.largest = std::max(errors.largest, error);
    errors.squares += error * error;
    errors.largestEn = std::max(errors.largestEn, std::abs(end->en - reference->en));
    ++errors.count;
  }
  const double contact = contactTimeOf(setup);
  return {{"engine", entry.name},
          {"dt", realised.dt},
          {"steps_per_contact", contact > 0.0 ? json(contact / realised.dt) : json(nullptr)},
          {"status", missing == 0 ? "finished" : "incomplete"},
          {"reason", missing == 0 ? "" : fmt::format("{} pairs did not part", missing)},
          {"realised", toJson(realised)},
          {"stats", statsJson(engine.stats())},
          {"points", points},
          {"score", scoreJson(setup, errors, high - low, largestEn, missing)}};
}

std::optional<json> convergenceOrder(const std::vector<const json*>& curves) {
  std::vector<double> logStep, logError;
  json errorAt = json::object();
  for (const json* curve : curves) {
    const json& error = (*curve)["score"]["rms_error"];
    if (!error.is_number() || error.get<double>() <= 0.0) continue;
    const double dt = (*curve)["dt"];
    const double log = std::log(dt);
    if (std::ranges::find(logStep, log) != logStep.end()) continue;
    logStep.push_back(log);
    logError.push_back(std::log(error.get<double>()));
    errorAt[fmt::format("{:.4g}", dt)] = error;
  }
  if (logStep.size() < 2) return std::nullopt;
  double intercept = 0.0, slope = 0.0, var00 = 0.0, var01 = 0.0, var11 = 0.0, squares = 0.0;
  gsl_fit_linear(logStep.data(), 1, logError.data(), 1, logStep.size(), &intercept, &slope, &var00,
                 &var01, &var11, &squares);
  json order = {{"engine", (*curves.front())["engine"]}, {"order", slope}, {"error_at", errorAt}};
  order["stderr"] = logStep.size() > 2 ? json(std::sqrt(var11)) : json(nullptr);
  return order;
}

}  // namespace crossgrain
