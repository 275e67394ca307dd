#include "runs/collide/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "adapters/law_options.hpp"
#include "adapters/worker/json.hpp"
#include "cases/time_step.hpp"
#include "oracle/collision_flight.hpp"
#include "runs/collide/look.hpp"
#include "runs/common/records.hpp"

namespace crossgrain::inline runs {

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

namespace {

/// Nine digits: what the oracle's and the engines' errors leave of a number, and half the file.
double shortened(double value) {
  return std::stod(fmt::format("{:.9g}", value));
}

struct Column {
  const char* name;
  std::optional<double> (*value)(const CollisionOutcome&);
  bool exact = false;  ///< to the last bit
};

template <auto member>
std::optional<double> own(const CollisionOutcome& outcome) {
  return outcome.end.*member;
}

template <int side>
std::optional<double> spin(const CollisionOutcome& outcome) {
  return outcome.end.spin[side];
}

template <double EnergySplit::*part>
std::optional<double> lost(const CollisionOutcome& outcome) {
  return outcome.end.lost ? std::optional((*outcome.end.lost).*part) : std::nullopt;
}

template <double ForceWork::*part>
std::optional<double> workOf(const CollisionOutcome& outcome) {
  return outcome.work ? std::optional((*outcome.work).*part) : std::nullopt;
}

constexpr Column columns[] = {
    {"e_n", own<&CollisionEnd::en>, true},
    {"psi_f", own<&CollisionEnd::psi>, true},
    {"beta", own<&CollisionEnd::beta>},
    {"centre_psi_f", own<&CollisionEnd::centrePsi>},
    {"e_t", own<&CollisionEnd::et>},
    {"rebound_angle", own<&CollisionEnd::reboundAngle>},
    {"spin_i", spin<0>},
    {"spin_j", spin<1>},
    {"duration", own<&CollisionEnd::duration>},
    {"max_overlap", own<&CollisionEnd::maxOverlap>},
    {"energy_before", own<&CollisionEnd::energyBefore>},
    {"energy_after", own<&CollisionEnd::energyAfter>},
    {"lost_normal_damping", workOf<&ForceWork::normal>},
    {"lost_tangential", workOf<&ForceWork::tangential>},
    {"lost_tangential_damping", lost<&EnergySplit::tangentialDamping>},
    {"lost_stiffening", lost<&EnergySplit::stiffening>},
    {"lost_sliding", lost<&EnergySplit::sliding>},
    {"lost_stored", lost<&EnergySplit::stored>},
};

}  // namespace

json columnsOf(const std::vector<CollisionStart>& starts, const Outcomes& outcomes) {
  json table;
  for (const CollisionStart& start : starts) {
    table["psi_i"].push_back(start.psi);
    table["v_n"].push_back(start.vn);
  }
  for (const Column& column : columns) {
    std::vector<std::optional<double>> values;
    for (const auto& outcome : outcomes) {
      auto value = outcome ? column.value(*outcome) : std::nullopt;
      if (value && !column.exact) value = shortened(*value);
      values.push_back(value);
    }
    if (std::ranges::any_of(values, [](const auto& value) { return bool(value); }))
      table[column.name] = toJson(values);
  }
  const auto limitless = [](const auto& outcome) { return outcome && outcome->end.limitless; };
  if (std::ranges::any_of(outcomes, limitless))
    for (const auto& outcome : outcomes) table["limitless"].push_back(limitless(outcome));
  return table;
}

double sweepEnd(const Case& setup, double dt, double engineStep) {
  const double contact = impactTimes(setup).longest;
  return dt + 2.5 * contact + 20.0 * engineStep;
}

Outcomes outcomesOf(const OracleCurve& oracle) {
  Outcomes outcomes;
  for (const auto& end : oracle.ends)
    outcomes.push_back(end ? std::optional(outcomeOf(*end)) : std::nullopt);
  return outcomes;
}

Outcomes referenceOf(const OracleCurve& oracle) {
  Outcomes outcomes = outcomesOf(oracle);
  for (auto& outcome : outcomes)
    if (outcome && outcome->end.limitless) outcome.reset();
  return outcomes;
}

std::string noLimitReason(const Case& setup, const std::vector<CollisionStart>& starts,
                          const OracleCurve& oracle, std::size_t k) {
  if (!oracle.ends[k] || !oracle.ends[k]->limitless) return {};
  return jumpsAtTouch(setup.law, collidingPair(setup), starts[k])
             ? "no limit of small time steps: the law jumps at this psi_i = mu gn/gt, sticking "
               "from the first touch on, and slipping, end elsewhere"
             : "no limit of small time steps: a slip ends while its bound falls, and the outcome "
               "goes on varying with log(dt), however small dt is";
}

namespace {

/// The sweep's outcomes; those of a run that is looked at also with overlaps and work.
Outcomes runOutcomes(Engine& engine, const EngineEntry& entry, const Case& setup,
                     const Scene& scene, const Realised& realised,
                     const std::vector<CollisionStart>& starts, bool look) {
  const double end = sweepEnd(setup, scene.dt, realised.dt);
  const Capabilities can = engine.capabilities();
  const WatchedRun watched{scene, collidingPair(setup),
                           sceneFor(can, entry, setup, scene).scene.law, realised,
                           can.slidingFlags};
  std::vector<std::optional<ContactAccount>> accounts(starts.size());
  if (look && can.instantContacts)
    accounts = lookThrough(engine, watched, end);
  else
    engine.advance(end);
  const Snapshot after = engine.snapshot(ContactReport::none);
  Outcomes outcomes;
  for (std::size_t k = 0; k < starts.size(); ++k) {
    const auto parted = collisionEnd(scene, after, k, starts[k]);
    outcomes.push_back(parted ? std::optional(CollisionOutcome{*parted, {}}) : std::nullopt);
    if (!parted || !accounts[k]) continue;
    outcomes[k]->end.maxOverlap = accounts[k]->maxOverlap;
    outcomes[k]->end.lost = accounts[k]->split;
    outcomes[k]->work = accounts[k]->work;
  }
  return outcomes;
}

}  // namespace

json runSweep(Engine& engine, const EngineEntry& entry, const Case& setup, double dt,
              const std::vector<CollisionStart>& starts, const OracleCurve& oracle, bool look) {
  const Scene scene = collisionScene(setup, starts, dt);
  const Realised realised = loadScene(engine, entry, setup, scene);
  const Outcomes found = runOutcomes(engine, entry, setup, scene, realised, starts, look);
  json points = columnsOf(starts, found);
  for (std::size_t k = 0; k < found.size(); ++k) {
    const std::string reason = noLimitReason(setup, starts, oracle, k);
    points["status"].push_back(!found[k] ? "not parted" : reason.empty() ? "parted" : "no limit");
    points["reason"].push_back(reason);
  }
  const auto missing = std::ranges::count_if(found, [](const auto& outcome) { return !outcome; });
  const double contact = impactTimes(setup).shortest;  // 0 for rigid disks
  return {{"engine", entry.name},
          {"dt", realised.dt},
          {"steps_per_contact", contact > 0.0 ? json(contact / realised.dt) : json(nullptr)},
          {"status", missing == 0 ? "finished" : "incomplete"},
          {"reason", missing == 0 ? "" : fmt::format("{} pairs did not part", missing)},
          {"realised", toJson(realised)},
          {"stats", statsJson(engine.stats())},
          {"points", points},
          {"score", scoreSweep(setup, starts, found, referenceOf(oracle))}};
}

}  // namespace crossgrain::inline runs
