#include "runs/collide/collide.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "cases/time_step.hpp"
#include "results/head_fields.hpp"
#include "results/schema.hpp"
#include "runs/collide/engine_sweeps.hpp"
#include "runs/collide/law_words.hpp"
#include "runs/common/executor.hpp"
#include "runs/common/run_store.hpp"
#include "runs/common/study.hpp"
#include "support/bad_input.hpp"
#include "support/interrupt.hpp"
#include "support/task_pool.hpp"

namespace crossgrain::inline runs {

namespace {

/// The oracle on a grid fine enough for a smooth line, about 80 points, at the first v_n.
CollisionTable fineOracle(const Case& setup) {
  const auto& psi = setup.collision.psi;
  const auto parts = std::max<std::size_t>(1, 80 / psi.size());
  std::vector<CollisionStart> starts;
  Case one = setup;
  one.collision.margins.clear();  // nothing is judged by it
  for (std::size_t k = 0; k < psi.size(); ++k)
    for (std::size_t part = 0; part < (k + 1 < psi.size() ? parts : 1); ++part) {
      const double next = k + 1 < psi.size() ? psi[k + 1] : psi[k];
      const double fraction = static_cast<double>(part) / static_cast<double>(parts);
      one.collision.psi = {psi[k] + (next - psi[k]) * fraction};
      starts.push_back(collisionStarts(one).front());
    }
  return tableOf(starts, outcomesOf(oracleCurve(one, starts)));
}

/// The engines of any of the cases, those named first. @throws BadInput
std::vector<EngineEntry> enginesForAny(const std::vector<Case>& variants,
                                       const std::vector<std::string>& names) {
  std::vector<EngineEntry> engines = selectEngines(names);
  for (const Case& setup : variants) checkEngineSections(setup);
  for (const EngineEntry& mirror : mirrorsOf(engines))
    if (std::ranges::any_of(variants, [&](const Case& setup) {
          return setup.run.mirrors && standsForItsPeer(mirror, setup.law);
        }))
      engines.push_back(mirror);
  return engines;
}

/// Why an engine can run no variant at all; empty where it can run any.
std::string whyAllRefused(const EngineSweeps& engine, std::size_t cases) {
  std::string reason;
  for (std::size_t k = 0; k < cases; ++k)
    for (const CollisionCurve& curve : *engine.curves(k)) {
      if (curve.status != SweepStatus::refused) return {};
      reason = curve.reason;
    }
  return reason;
}

/// Engines that were named and can run no variant at all were asked for in vain, all of them.
/// @throws UnsupportedScene
void requireAnyRun(const std::vector<EngineSweeps>& engines, const std::vector<std::string>& named,
                   std::size_t cases) {
  std::string refusal;
  for (const EngineSweeps& engine : engines) {
    if (!isNamed(named, engine.entry())) continue;
    const std::string why = whyAllRefused(engine, cases);
    if (why.empty()) return;
    if (refusal.empty()) refusal = why;
  }
  if (!refusal.empty()) throw UnsupportedScene(refusal);
}

std::vector<std::string> effectNames(const CollisionCase& sweep) {
  std::vector<std::string> names;
  for (const Effect effect :
       effectsOf(collisionScene(*sweep.setup, sweep.starts, sweep.steps.front())))
    names.push_back(toString(effect));
  return names;
}

/// Points that no engine is compared with, and why.
std::vector<NoLimitPoint> noLimitPoints(const CollisionCase& sweep) {
  std::vector<NoLimitPoint> points;
  for (std::size_t k = 0; k < sweep.starts.size(); ++k)
    if (const std::string& reason = sweep.oracle.unsure[k]; !reason.empty() && sweep.oracle.ends[k])
      points.push_back(
          {sweep.starts[k].psi, sweep.starts[k].vn, sweep.oracle.ends[k]->psi, reason});
  return points;
}

/// All but the engines' curves.
CollisionVariant variantOf(const CollisionCase& sweep) {
  const Case& setup = *sweep.setup;
  const CollidingPair pair = collidingPair(setup);
  CollisionVariant variant;
  variant.name = setup.name;
  variant.variant = setup.variant.empty() ? setup.name : setup.variant;
  variant.law = lawInWords(setup.law);
  variant.effects = effectNames(sweep);
  variant.closedEn = closedRestitution(setup.law, pair.reducedMass());
  if (!setup.law.soft()) variant.sticking.et0 = setup.law.et0;
  variant.slidingConstant = slidingConstant(setup.law, pair);
  variant.oracle = fineOracle(setup);
  variant.oracleReason = sweep.oracle.reason;
  variant.reference = tableOf(sweep.starts, referenceOf(sweep.oracle));
  variant.noLimit = noLimitPoints(sweep);
  return variant;
}

/// How an engine came through all cases.
EngineRow rowOf(const EngineSweeps& engine, std::size_t cases) {
  const EngineEntry& entry = engine.entry();
  EngineRow row{entry.name, entry.summary, "", entry.mirrors, EngineStatus::ran, ""};
  // Refusing some variants is no failure; the curves say which.
  if (const std::string why = whyAllRefused(engine, cases); !why.empty()) {
    row.status = EngineStatus::refused;
    row.reason = why;
  }
  for (std::size_t k = 0; k < cases; ++k)
    for (const CollisionCurve& curve : *engine.curves(k)) {
      if (curve.status == SweepStatus::failed) {
        row.status = EngineStatus::failed;
        row.reason = curve.reason;
      }
      if (curve.realised) row.version = curve.realised->version;
    }
  return row;
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
      if (sweeps[s].wants(entry, command.engines)) {
        ++work.total;
        work.finished += engine.curves(s).has_value();
      }
    works.push_back(work);
  }
  return dryRunInWords(head, works, store, command);
}

CollideResults collideEngines(const std::vector<Case>& variants, const RunCommand& command,
                              RunStore& store) {
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
  requireAnyRun(engines, command.engines, sweeps.size());

  CollideResults results;
  results.head = headOf(kindCollide, variants.front(), command.commandLine);
  results.head.setup.variant.clear();
  for (std::size_t s = 0; s < sweeps.size(); ++s) {
    CollisionVariant& variant = results.variants.emplace_back(variantOf(sweeps[s]));
    for (const EngineSweeps& engine : engines) {
      const std::vector<CollisionCurve>& curves = *engine.curves(s);
      if (auto order = convergenceOrder(curves)) {
        order->name = variant.name;
        order->variant = variant.variant;
        results.orders.push_back(std::move(*order));
      }
      variant.curves.insert(variant.curves.end(), curves.begin(), curves.end());
    }
  }
  for (const EngineSweeps& engine : engines)
    results.engines.push_back(rowOf(engine, sweeps.size()));
  results.elapsed =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return results;
}

}  // namespace crossgrain::inline runs
