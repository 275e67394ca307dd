#include "runs/collide/collide.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "adapters/law_options.hpp"
#include "adapters/pair_table.hpp"
#include "cases/time_step.hpp"
#include "runs/collide/engine_sweeps.hpp"
#include "runs/common/dry_run.hpp"
#include "runs/common/progress.hpp"
#include "runs/common/records.hpp"
#include "runs/common/run_store.hpp"
#include "support/bad_input.hpp"
#include "support/interrupt.hpp"
#include "support/task_pool.hpp"

namespace crossgrain::inline runs {

using nlohmann::json;

namespace {

/// Options that matter to the law, and constants that it has.
json lawJson(const ContactLaw& law) {
  json options;
  for (const LawOption& option : lawOptions())
    if (mattersTo(law, option.name))
      options[std::string(option.name)] = option.values[option.get(law)];
  const PairCoefficients has = coefficientsOf(law);
  const std::pair<const char*, double> constants[] = {
      {"kn", has.kn}, {"gn", has.gn}, {"kt", has.kt}, {"gt", has.gt}, {"mu", has.mu}};
  for (const auto& [name, value] : constants)
    if (value > 0.0) options[name] = value;
  if (!law.soft()) options["e_n"] = law.en;
  if (!law.soft() && has.mu > 0.0) options["e_t0"] = law.et0;
  if (law.normal == NormalLaw::polynomial) options["kn3"] = law.kn3;
  return options;
}

/// The oracle on a grid fine enough for a smooth line, about 80 points, at the first v_n.
json fineOracle(const Case& setup) {
  const auto& psi = setup.collision.psi;
  const auto parts = std::max<std::size_t>(1, 80 / psi.size());
  std::vector<CollisionStart> starts;
  Case one = setup;
  for (std::size_t k = 0; k < psi.size(); ++k)
    for (std::size_t part = 0; part < (k + 1 < psi.size() ? parts : 1); ++part) {
      const double next = k + 1 < psi.size() ? psi[k + 1] : psi[k];
      const double share = static_cast<double>(part) / static_cast<double>(parts);
      one.collision.psi = {psi[k] + (next - psi[k]) * share};
      starts.push_back(collisionStarts(one).front());
    }
  return columnsOf(starts, outcomesOf(oracleCurve(setup, starts)));
}

/// The engines of any of the cases, those named first. @throws BadInput
std::vector<EngineEntry> enginesForAny(const std::vector<Case>& variants,
                                       const std::vector<std::string>& names) {
  std::vector<EngineEntry> engines = selectEngines(names);
  for (const Case& setup : variants) checkEngineSections(setup);
  if (std::ranges::any_of(variants, [](const Case& setup) { return setup.run.mirrors; }))
    for (const EngineEntry& mirror : mirrorsOf(engines)) engines.push_back(mirror);
  return engines;
}

/// An engine that can run no variant at all was asked for in vain.
void throwIfAllRefused(const EngineSweeps& engine, std::size_t cases) {
  std::string reason;
  for (std::size_t k = 0; k < cases; ++k)
    for (const json& curve : *engine.curves(k)) {
      if (curve["status"] != "refused") return;
      reason = curve["reason"];
    }
  throw UnsupportedScene(reason);
}

json effectsJson(const CollisionCase& sweep) {
  json names = json::array();
  for (const Effect effect :
       effectsOf(collisionScene(*sweep.setup, sweep.starts, sweep.steps.front())))
    names.push_back(toString(effect));
  return names;
}

/// Points that no engine is held against, and why.
json noLimitJson(const CollisionCase& sweep) {
  json points = json::array();
  for (std::size_t k = 0; k < sweep.starts.size(); ++k)
    if (const std::string reason = noLimitReason(*sweep.setup, sweep.starts, sweep.oracle, k);
        !reason.empty())
      points.push_back({{"psi_i", sweep.starts[k].psi},
                        {"v_n", sweep.starts[k].vn},
                        {"psi_f", sweep.oracle.ends[k]->psi},
                        {"reason", reason}});
  return points;
}

json variantJson(const CollisionCase& sweep) {
  const Case& setup = *sweep.setup;
  const CollidingPair pair = collidingPair(setup);
  return {{"case", setup.name},
          {"variant", setup.variant.empty() ? setup.name : setup.variant},
          {"law", lawJson(setup.law)},
          {"effects", effectsJson(sweep)},
          {"e_n_closed", toJson(closedRestitution(setup.law, pair.reducedMass()))},
          {"sticking", {{"e_t0", setup.law.soft() ? json(nullptr) : json(setup.law.et0)}}},
          {"sliding_constant", toJson(slidingConstant(setup.law, pair))},
          {"oracle", fineOracle(setup)},
          {"oracle_reason", sweep.oracle.reason},
          {"reference", columnsOf(sweep.starts, referenceOf(sweep.oracle))},
          {"no_limit", noLimitJson(sweep)},
          {"curves", json::array()}};
}

void requireInstalled(const std::vector<EngineEntry>& engines) {
  for (const EngineEntry& entry : engines)
    if (entry.missing && !entry.missing().empty())
      startEngine(entry, {}, 1.0);  // throws, saying why
}

}  // namespace

std::string collidePlan(const std::vector<Case>& variants, const RunCommand& command,
                        RunStore& store) {
  const std::vector<EngineEntry> entries = enginesForAny(variants, command.engines);
  requireInstalled(entries);
  std::vector<CollisionCase> sweeps;
  std::string head;
  for (const Case& setup : variants) {
    sweeps.push_back({&setup, collisionTimeSteps(setup)});
    head += fmt::format("{}{}: {} sweeps of {} collisions\n", setup.name,
                        setup.variant.empty() ? "" : " " + setup.variant,
                        sweeps.back().steps.size(), collisionStarts(setup).size());
  }
  std::vector<PlannedWork> works;
  for (const EngineEntry& entry : entries) {
    EngineSweeps engine(entry, command.engines, store);
    engine.start(variants.front().run.timeout);
    engine.takeUp(sweeps);
    PlannedWork work{entry.name, "cases"};
    for (std::size_t s = 0; s < sweeps.size(); ++s)
      if (sweeps[s].wants(entry, command.engines)) count(work, engine.curves(s));
    works.push_back(work);
  }
  return dryRunInWords(head, works, store, command);
}

json collideEngines(const std::vector<Case>& variants, const RunCommand& command, RunStore& store) {
  const auto started = std::chrono::steady_clock::now();
  const std::vector<EngineEntry> entries = enginesForAny(variants, command.engines);
  requireInstalled(entries);
  Progress progress(command.quiet);
  store.begin();

  std::vector<CollisionCase> sweeps;
  for (const Case& setup : variants) {
    throwIfInterrupted();
    CollisionCase sweep{&setup, collisionTimeSteps(setup), collisionStarts(setup)};
    sweep.oracle = oracleCurve(setup, sweep.starts);
    sweeps.push_back(std::move(sweep));
  }
  std::vector<EngineSweeps> engines;
  for (const EngineEntry& entry : entries) {
    engines.emplace_back(entry, command.engines, store);
    engines.back().start(variants.front().run.timeout);
    engines.back().takeUp(sweeps);
  }

  std::vector<Task> tasks;
  progress.begin("collisions", std::vector<double>(engines.size(), 1.0));
  for (std::size_t e = 0; e < engines.size(); ++e) {
    // Workers in another language are slow, so they go first.
    tasks.push_back({entries[e].command ? 2.0 : 1.0, [&, e] {
                       EngineSweeps& engine = engines[e];
                       const std::string& name = engine.entry().name;
                       engine.runRest(sweeps, [&](double f) { progress.update(e, name, f); });
                       std::string line = name + ": done";
                       if (const std::size_t before = engine.takenUp())
                         line += fmt::format(", {} of {} cases finished in an earlier run", before,
                                             sweeps.size());
                       progress.finish(e, line);
                     }});
  }
  runTasks(tasks, command.jobs);
  for (const EngineSweeps& engine : engines)
    if (isNamed(command.engines, engine.entry())) throwIfAllRefused(engine, sweeps.size());

  json results = resultsHead("collide", variants.front(), command.commandLine);
  results["case"]["variant"] = "";
  results["variants"] = json::array();
  results["orders"] = json::array();
  for (std::size_t s = 0; s < sweeps.size(); ++s) {
    json variant = variantJson(sweeps[s]);
    for (std::size_t e = 0; e < engines.size(); ++e) {
      std::vector<const json*> list;
      for (const json& curve : *engines[e].curves(s)) list.push_back(&curve);
      if (auto order = convergenceOrder(list)) {
        (*order)["case"] = variant["case"];
        (*order)["variant"] = variant["variant"];
        results["orders"].push_back(*order);
      }
      for (const json& curve : *engines[e].curves(s)) variant["curves"].push_back(curve);
    }
    results["variants"].push_back(std::move(variant));
  }
  results["engines"] = json::array();
  for (std::size_t e = 0; e < engines.size(); ++e) {
    // Refusing some variants is no failure; the curves say which.
    std::string status = "ran", reason, version;
    for (std::size_t s = 0; s < sweeps.size(); ++s)
      for (const json& curve : *engines[e].curves(s)) {
        if (curve["status"] == "failed") {
          status = "failed";
          reason = curve["reason"];
        }
        if (curve["realised"].is_object()) version = curve["realised"]["version"];
      }
    results["engines"].push_back({{"name", entries[e].name},
                                  {"summary", entries[e].summary},
                                  {"version", version},
                                  {"mirrors", entries[e].mirrors},
                                  {"status", status},
                                  {"reason", reason}});
  }
  results["elapsed_s"] =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return results;
}

}  // namespace crossgrain::inline runs
