#include "studies/collide/collide.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <numbers>

#include "cases/case_files.hpp"
#include "cases/loader.hpp"
#include "cases/time_step.hpp"
#include "results/collision.hpp"
#include "results/schema.hpp"
#include "studies/collide/score.hpp"
#include "studies/collide/sweep.hpp"
#include "studies/core/engine_access.hpp"
#include "studies/core/executor.hpp"
#include "studies/core/study.hpp"
#include "support/bad_input.hpp"
#include "support/interrupt.hpp"
#include "support/task_pool.hpp"

namespace crossgrain::inline studies {

namespace fs = std::filesystem;

namespace {

/// One case of collisions, with what its curves are compared with.
struct CollisionCase {
  const Case* setup;
  std::vector<double> steps;  ///< time steps, a sweep for each [s]
  std::vector<CollisionStart> starts;
  OracleCurve oracle = {};  ///< not of a dry run
};

/// Engines with their versions; empty: it did not answer.
using VersionedEngines = std::vector<std::pair<EngineEntry, std::string>>;

/// The curves of each engine in each case, step by step; none where it takes no part.
using CollisionCurves = std::map<RunId, std::vector<CollisionCurve>>;

RunId idOf(const EngineEntry& entry, const Case& setup) {
  return {entry.name, fullName(setup)};
}

/// Whether an engine takes part in a case: mirrors only where the case wants them.
bool takesPart(const EngineEntry& entry, const Case& setup, const std::vector<std::string>& named) {
  if (entry.mirrors.empty() || isNamed(named, entry)) return true;
  return setup.run.mirrors && standsForItsPeer(entry, setup.law);
}

/// The engines of any of the cases, those named first. @throws BadInput, Interrupted
VersionedEngines enginesForAny(const std::vector<Case>& variants, const RunCommand& command,
                               const RunStore& store) {
  std::vector<EngineEntry> engines = selectEngines(command.engines);
  for (const Case& setup : variants) checkEngineSections(setup);
  for (const EngineEntry& mirror : mirrorsOf(engines))
    if (std::ranges::any_of(
            variants, [&](const Case& setup) { return takesPart(mirror, setup, command.engines); }))
      engines.push_back(mirror);
  requireInstalled(engines);
  VersionedEngines versioned;
  for (const EngineEntry& entry : engines) {
    throwIfInterrupted();
    versioned.emplace_back(entry, "");
    try {
      const double timeout = variants.front().run.timeout;
      versioned.back().second =
          startEngine(entry, store.scratch(entry.name), timeout)->capabilities().version;
    } catch (const EngineFailure&) {  // each of its sweeps will say so
    }
  }
  return versioned;
}

/// All sweeps of a case in one worker, which is started again after a failure. Failures end up in
/// the curve that failed, and the case is not kept.
/// @throws Interrupted, BadInput
CachedTask<std::vector<CollisionCurve>>::Outcome sweepsOf(
    const EngineEntry& entry, const CollisionCase& each, const fs::path& scratch,
    const std::function<void(double)>& progress) {
  std::vector<CollisionCurve> curves;
  DeclaredOracles declared;
  std::unique_ptr<Engine> worker;
  bool failed = false;
  // The smallest first: whether it passes has a bearing on what larger ones are beyond limits by.
  std::vector<double> steps = each.steps;
  std::ranges::sort(steps);
  for (std::size_t k = 0; k < steps.size(); ++k) {
    throwIfInterrupted();
    const double dt = steps[k];
    try {
      if (!worker) worker = startAudited(entry, scratch, each.setup->run.timeout);
      const bool largest = dt == steps.back();
      const bool passesFiner = !curves.empty() && verdictOf(curves.front()) == Verdict::pass;
      CollisionCurve curve = runSweep(*worker, entry, *each.setup, dt, each.starts, each.oracle,
                                      largest, &declared, passesFiner);
      if (largest && each.setup->dimension == 2 && !collisionIn(*each.setup).isConvex())
        curve.ownScheme = schemeScore(*worker, entry, *each.setup, dt);
      // An engine that keeps its own step says the same at each of the case's, and most at the
      // last.
      std::erase_if(curves, [&](const auto& other) { return other.dt == curve.dt; });
      curves.push_back(std::move(curve));
    } catch (const Interrupted&) {
      throw;
    } catch (const BadInput&) {
      throw;
    } catch (const std::exception& error) {
      const bool refused = dynamic_cast<const UnsupportedScene*>(&error) != nullptr;
      CollisionCurve& none = curves.emplace_back();
      none.engine = entry.name;
      none.dt = refused ? each.steps.front() : dt;
      none.status = refused ? Status::refused : Status::failed;
      none.reason = error.what();
      // A law lacks what it lacks at every time step.
      if (refused) break;
      worker.reset();
      failed = true;
    }
    progress(static_cast<double>(k + 1) / static_cast<double>(steps.size()));
  }
  std::ranges::sort(curves, std::greater{}, &CollisionCurve::dt);
  return {std::move(curves), !failed, "done"};
}

/// In the order of cases, then engines. @param cases, engines  outlive the tasks
std::vector<CachedTask<std::vector<CollisionCurve>>> tasksOf(
    const std::vector<CollisionCase>& cases, const VersionedEngines& engines,
    const std::vector<std::string>& named, const RunStore& store) {
  std::vector<CachedTask<std::vector<CollisionCurve>>> tasks;
  for (const auto& [entry, version] : engines)
    for (const CollisionCase& each : cases) {
      const Case& setup = *each.setup;
      if (!takesPart(entry, setup, named)) continue;
      CachedTask<std::vector<CollisionCurve>> task;
      task.of = idOf(entry, setup);
      task.name = fmt::format("{} {} {}", entry.name, setup.name, setup.variant);
      std::ranges::replace(task.name, ' ', '-');
      task.label = entry.name + " " + fullName(setup);
      task.key = runKey(setup, entry.name, version);
      // Workers in another language are slow, so they go first.
      task.weight = entry.command ? 2.0 : 1.0;
      task.work = [&entry, &each, scratch = store.scratch(task.name)](const auto& progress) {
        return sweepsOf(entry, each, scratch, progress);
      };
      tasks.push_back(std::move(task));
    }
  return tasks;
}

/// How an engine came through all cases. Refusing some variants is no failure; the curves say
/// which.
EngineRow rowOf(const EngineEntry& entry, const std::vector<Case>& variants,
                const CollisionCurves& curves) {
  EngineRow row = engineRow(entry, "");
  std::string refusal;
  bool ran = false;
  for (const Case& setup : variants)
    if (const auto found = curves.find(idOf(entry, setup)); found != curves.end())
      for (const CollisionCurve& curve : found->second) {
        if (curve.status == Status::failed) {
          row.status = Status::failed;
          row.reason = curve.reason;
        }
        if (curve.status == Status::refused)
          refusal = curve.reason;
        else
          ran = true;
        if (curve.effective) row.version = curve.effective->version;
      }
  if (!ran && !refusal.empty()) {
    row.status = Status::refused;
    row.reason = refusal;
  }
  return row;
}

/// Engines that were named and can run no variant at all were asked for in vain, all of them.
/// @throws AllRefused
void requireAnyRun(const VersionedEngines& engines, const std::vector<EngineRow>& rows,
                   const std::vector<std::string>& named) {
  std::vector<std::string> refusals;
  for (std::size_t e = 0; e < rows.size(); ++e) {
    if (!isNamed(named, engines[e].first)) continue;
    if (rows[e].status != Status::refused) return;
    refusals.push_back(rows[e].reason);
  }
  if (!refusals.empty()) throw AllRefused(std::move(refusals));
}

/// Whether an engine that was named takes any case, if some were. One that breaks down does not
/// refuse.
bool anyTaken(const std::vector<CollisionCase>& cases, const VersionedEngines& engines,
              const std::vector<std::string>& named, const RunStore& store) {
  bool anyNamed = false;
  for (const auto& [entry, version] : engines)
    for (const CollisionCase& each : cases) {
      if (!isNamed(named, entry)) continue;
      anyNamed = true;
      const Case& setup = *each.setup;
      throwIfInterrupted();
      try {
        const auto worker = startEngine(entry, store.scratch(entry.name), setup.run.timeout);
        loadSweep(*worker, entry, setup, each.steps.front(), each.starts);
        return true;
      } catch (const UnsupportedScene&) {
      } catch (const EngineFailure&) {
        return true;
      }
    }
  return !anyNamed;
}

/// Starts fine enough for a smooth line, about 80, over the list that is swept, at the first of all
/// other values.
std::vector<CollisionStart> fineStarts(const Case& setup) {
  const auto list = sweptList(collisionIn(setup));
  const std::vector<double>& swept = collisionIn(setup).*list;
  const auto parts = std::max<std::size_t>(1, 80 / swept.size());
  std::vector<CollisionStart> starts;
  Case one = setup;
  for (std::size_t k = 0; k < swept.size(); ++k)
    for (std::size_t part = 0; part < (k + 1 < swept.size() ? parts : 1); ++part) {
      const double next = k + 1 < swept.size() ? swept[k + 1] : swept[k];
      const double fraction = static_cast<double>(part) / static_cast<double>(parts);
      collisionIn(one).*list = {swept[k] + (next - swept[k]) * fraction};
      starts.push_back(collisionStarts(one).front());
    }
  return starts;
}

/// Further words on a case in space: "J = 0.4 m a², first spin (2000, 200) rad/s".
std::string describeSpace(const Collision& c) {
  std::string words = fmt::format("J = {:g} m a²", c.inertiaFactor);
  const char* const bodies[] = {"first", "second"};
  for (const int side : {0, 1})
    if (const Vec2& spin = c.spinOutOfPlane[side]; !spin.isZero(0.0))
      words += fmt::format(", {} spin ({:g}, {:g}) rad/s", bodies[side], spin.x(), spin.y());
  if (!c.turn.isZero(0.0)) {
    const Vec3 axis = c.turn.normalized();
    words += fmt::format(", turned by {:.4g}° about ({:.3g}, {:.3g}, {:.3g})",
                         c.turn.norm() * 180.0 / std::numbers::pi, axis.x(), axis.y(), axis.z());
  }
  return words;
}

/// All but the engines' curves.
CollisionVariant variantOf(const CollisionCase& sweep) {
  const Case& setup = *sweep.setup;
  const CollidingPair pair = collidingPair(setup);
  CollisionVariant variant;
  variant.name = setup.name;
  variant.variant = setup.variant.empty() ? setup.name : setup.variant;
  variant.law = describeLaw(setup.law);
  variant.effects.emplace();
  const double dt = sweep.steps.front();
  for (const Effect effect : setup.dimension == 3
                                 ? effectsOf(spaceCollisionScene(setup, sweep.starts, dt))
                                 : effectsOf(collisionScene(setup, sweep.starts, dt)))
    variant.effects->push_back(toString(effect));
  const bool convex = collisionIn(setup).isConvex();
  if (setup.dimension == 3 && !convex) variant.space = describeSpace(collisionIn(setup));
  variant.closedEn = closedRestitution(setup.law, pair.reducedMass());
  if (!setup.law.soft() && !convex) variant.sticking.et0 = setup.law.et0;
  // Ψ_f = Ψ_i − it is of a slip along s alone.
  const auto& besides = collisionIn(setup).spinOutOfPlane;
  if (besides[0].y() == 0.0 && besides[1].y() == 0.0 && !convex)
    variant.slidingConstant = slidingConstant(setup.law, pair);
  Case unjudged = setup;
  collisionIn(unjudged).margins.clear();  // nothing is judged by it
  const std::vector<CollisionStart> fine = fineStarts(setup);
  const OracleCurve line = oracleCurve(unjudged, fine);
  variant.oracle = tableOf(fine, outcomesOf(line), convex);
  if (convex) variant.convex = convexSweep(setup, fine, line, sweep.oracle);
  variant.oracleReason = sweep.oracle.reason;
  variant.reference = tableOf(sweep.starts, referenceOf(sweep.oracle), convex);
  for (std::size_t k = 0; k < sweep.starts.size(); ++k)
    if (const std::string& why = sweep.oracle.unsure[k]; !why.empty() && sweep.oracle.ends[k]) {
      variant.noLimit.push_back(
          {sweep.starts[k].psi, sweep.starts[k].vn, sweep.oracle.ends[k]->psi, why, {}, {}});
      if (!convex) continue;
      variant.noLimit.back().orientation = sweep.starts[k].orientation * 180.0 / std::numbers::pi;
      variant.noLimit.back().spin = sweep.starts[k].spin;
    }
  return variant;
}

std::string collidePlan(const StudyWork& work, const CollideOptions&) {
  const RunCommand& command = work.line.run;
  const VersionedEngines engines = enginesForAny(work.cases, command, work.store);
  std::vector<CollisionCase> cases;
  std::string head;
  for (const Case& setup : work.cases) {
    cases.push_back({&setup, collisionTimeSteps(setup), collisionStarts(setup)});
    head += fmt::format("{}: {} sweeps of {} collisions\n", fullName(setup),
                        cases.back().steps.size(), cases.back().starts.size());
  }
  const auto tasks = tasksOf(cases, engines, command.engines, work.store);
  return describeDryRun(head, plannedWork(tasks, "cases", work.store), work.store, command);
}

/// The collisions of a folder's case files, by file name; cases of other kinds are left out.
std::vector<Case> collisionsOf(const fs::path& folder, const CommandLine& line) {
  std::vector<Case> variants;
  for (const fs::path& file : caseFilesIn(folder))
    for (Case& setup : loadCase(file, line.overrides, {}, Starts::made, line.only))
      if (isCollision(setup)) variants.push_back(std::move(setup));
  requireOwnNames(variants);
  if (variants.empty()) throw BadInput(folder.string() + ": none of its cases is a collision");
  return variants;
}

/// Name of a folder's cases together.
CaseHead headOfFolder(const fs::path& folder, const std::vector<Case>& variants) {
  std::string toml;
  for (const Case& setup : variants)
    toml += fmt::format("# {}{}{}\n\n{}\n", setup.name, setup.variant.empty() ? "" : ": ",
                        setup.variant, setup.resolvedToml);
  const fs::path last = folder.has_filename() ? folder : folder.parent_path();
  return {last.filename().string(), "", folder.string(), toml};
}

std::vector<Case> casesToCollide(const CommandLine& line, CollideOptions&) {
  const fs::path& input = line.inputs.front();
  std::vector<Case> variants = fs::is_directory(input)
                                   ? collisionsOf(input, line)
                                   : loadCase(input, line.overrides, {}, Starts::made, line.only);
  if (line.only) variants = selectedCases(variants, *line.only);
  if (!isCollision(variants.front()))
    throw BadInput(
        fmt::format("{}: collide takes two bodies that meet once, and this scene has no such pair; "
                    "crossgrain {} can run it",
                    input.string(), hasFlow(variants.front()) ? "compare" : "stability"));
  reportKeysWithoutUse(variants, "collide", line.json ? stderr : stdout);
  return variants;
}

CollideResults collide(const StudyWork& work, const CollideOptions&) {
  CollideResults results = collideEngines(work.cases, work.line.run, work.store);
  if (const fs::path& input = work.line.inputs.front(); fs::is_directory(input))
    results.head.setup = headOfFolder(input, work.cases);
  return results;
}

Outcome outcomeOfCollide(const CollideResults& results, const CommandLine&,
                         const CollideOptions& options) {
  std::map<std::string, std::string> reasons;  // the first of each engine
  for (const CollisionVariant& variant : results.variants)
    for (const CollisionCurve& curve : variant.curves)
      if (curve.status == Status::failed) reasons.emplace(curve.engine, curve.reason);
  Outcome outcome;
  for (const auto& [engine, reason] : reasons) outcome.failures.push_back(reason);
  const SweepCount count = countOf(results);
  if (count.failed > 0)
    outcome.status = exitEngineFailed;
  else if (count.judged() == 0)
    return notJudged(nothingJudged(results));
  // An engine that is true to conventions which the case lets it have does what it says. Whether
  // that is the scene's law, too, is what --strict asks.
  if (count.beyondLimits > 0)
    outcome.fails.push_back(
        fmt::format("{} of {} curves beyond the limits of the law that their engine declares",
                    count.beyondLimits, count.judged()));
  if (options.strict && count.modelDifference > 0)
    outcome.fails.push_back(
        fmt::format("--strict: {} of {} curves beyond the limits of the scene's law",
                    count.modelDifference, count.judged()));
  if (outcome.status == exitPassed && !outcome.fails.empty()) outcome.status = exitFailed;
  return outcome;
}

}  // namespace

CollideResults collideEngines(const std::vector<Case>& variants, const RunCommand& command,
                              RunStore& store) {
  const auto started = std::chrono::steady_clock::now();
  VersionedEngines engines = enginesForAny(variants, command, store);
  Progress progress(command.quiet);
  store.begin();
  printNotes();
  std::vector<CollisionCase> cases;
  for (const Case& setup : variants)
    cases.push_back({&setup, collisionTimeSteps(setup), collisionStarts(setup)});
  std::vector<Task> oracles;
  std::vector<double> weights;
  // Where all that are named refuse, their sweeps say so at once: nothing is compared with a
  // reference, nor with an engine that only stands beside them.
  const bool any = anyTaken(cases, engines, command.engines, store);
  if (!any)
    std::erase_if(engines, [&](const auto& each) { return !isNamed(command.engines, each.first); });
  for (CollisionCase& each : cases) {
    if (!any) break;
    weights.push_back(static_cast<double>(each.starts.size()));
    oracles.push_back({weights.back(), [&each, &progress, k = oracles.size()] {
                         each.oracle = oracleCurve(*each.setup, each.starts);
                         progress.update(k, each.setup->name, 1.0);
                       }});
  }
  if (any) progress.begin("solving the collisions for reference", weights);
  runTasks(oracles, command.jobs);
  const auto tasks = tasksOf(cases, engines, command.engines, store);
  const CollisionCurves curves =
      byId(tasks, runOrLoad(tasks, store, progress, "collisions", command.jobs));

  CollideResults results;
  for (const auto& [entry, version] : engines)
    results.engines.push_back(rowOf(entry, variants, curves));
  requireAnyRun(engines, results.engines, command.engines);
  results.head = headOf(kindCollide, variants.front(), command.commandLine);
  results.head.setup.variant.clear();
  for (const CollisionCase& each : cases) {
    CollisionVariant& variant = results.variants.emplace_back(variantOf(each));
    for (const auto& [entry, version] : engines) {
      const auto own = curves.find(idOf(entry, *each.setup));
      if (own == curves.end()) continue;
      if (auto order = convergenceOrder(own->second)) {
        order->name = variant.name;
        order->variant = variant.variant;
        results.orders.push_back(std::move(*order));
      }
      variant.curves.insert(variant.curves.end(), own->second.begin(), own->second.end());
    }
  }
  results.elapsed =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return results;
}

const Study<CollideOptions, CollideResults> collideStudy = {
    "collide",
    {.inputIs = "case file or folder of case files", .selection = true},
    Keeps::eachCase,
    [](CollideOptions& own, CommandLine&) {
      return std::vector<StudyOption>{
          {"--strict",
           "status 1 also for an engine that follows the law it declares, but not the scene's",
           &own.strict}};
    },
    casesToCollide,
    collidePlan,
    collide,
    outcomeOfCollide};

ConvexOutcomes convexOutcomes(const Case& setup, const CollisionStart& start) {
  return inDimensionOf(setup, [&]<int D>() {
    const ConvexTouchOf<D> touch = convexTouch<D>(setup, start);
    const ConvexImpactStart<D>& before = touch.impact;
    const ConvexImpact<D> impact = convexImpact(before);
    const auto end = [&](const ImpactOutcome<D>& after) {
      return convexEnd<D>(before, after.velocity, after.spin);
    };
    const auto name = [](const ImpactOutcome<D>& after) {
      return std::string(impactKindNames[static_cast<std::size_t>(after.kind)]);
    };
    ConvexOutcomes all{{},
                       end(impact.poisson),
                       end(impact.stronge),
                       impact.judged,
                       "",
                       freeFlight(touch, impact, start.vn)};
    if (impact.newton) all.newton = end(*impact.newton);
    all.kind = name(impact.poisson);
    if (name(impact.stronge) != all.kind) all.kind += " or " + name(impact.stronge);
    return all;
  });
}

template <int D>
std::optional<CollisionEnd> convexEndOf(const Case& setup, const SnapshotOf<D>& after,
                                        std::size_t pair, const CollisionStart& start) {
  const Collision& c = collisionIn(setup);
  const ConvexTouchOf<D> touch = convexTouch<D>(setup, start);
  const std::size_t count = touch.bodies.size();
  std::array<VecOf<D>, 2> velocity = {VecOf<D>::Zero(), VecOf<D>::Zero()};
  std::array<SpinOf<D>, 2> spin = {noSpin<D>(), noSpin<D>()};
  for (std::size_t side = 0; side < count; ++side) {
    const std::size_t i = count * pair + side;
    velocity[side] = after.velocity[i];
    if (after.spin) spin[side] = (*after.spin)[i];
    if constexpr (D == 3) {
      const Eigen::Matrix3d back = turnOf(setup).transpose();
      velocity[side] = back * velocity[side];
      spin[side] = back * spin[side];
    }
    if (c.wall) velocity[side].template head<2>() -= c.wallVelocity;
  }
  // By an impulse of as little as this of m v_n nothing has met.
  constexpr double least = 1e-3;
  if (velocity[0].x() - touch.bodies.velocity[0].x() < least * start.vn) return std::nullopt;
  return convexEnd<D>(touch.impact, velocity, spin);
}
template std::optional<CollisionEnd> convexEndOf<2>(const Case&, const Snapshot&, std::size_t,
                                                    const CollisionStart&);
template std::optional<CollisionEnd> convexEndOf<3>(const Case&, const SpaceSnapshot&, std::size_t,
                                                    const CollisionStart&);

std::vector<double> Collision::*sweptList(const Collision& collision) {
  for (const auto list : {&Collision::orientation, &Collision::psi, &Collision::spin})
    if ((collision.*list).size() > 1) return list;
  return &Collision::psi;
}

namespace {

/// "box that reaches 0.0707 m, 1 kg"
template <int D>
std::string describe(const DiskGroupOf<D>& body) {
  return fmt::format("{} that reaches {:.4g} m, {:g} kg",
                     body.shape ? toString(body.shape->kind)
                     : D == 2   ? "disk"
                                : "sphere",
                     body.radius, body.mass);
}

}  // namespace

ConvexSweep convexSweep(const Case& setup, const std::vector<CollisionStart>& starts,
                        const OracleCurve& fine, const OracleCurve& sweep) {
  const Collision& c = collisionIn(setup);
  ConvexSweep convex;
  convex.bodies = inDimensionOf(setup, [&]<int D>() {
    const auto& pair = std::get<ConvexPairOf<D>>(c.convex);
    return describe(pair.body[0]) + (c.wall ? " on a plane" : " on a " + describe(pair.body[1]));
  });
  const auto list = sweptList(c);
  convex.axis = list == &Collision::orientation ? "orientation"
                : list == &Collision::psi       ? "psi_i"
                                                : "spin_before";
  Outcomes poisson, stronge;
  for (const ConvexOutcomes& each : fine.convex) {
    poisson.emplace_back(outcomeOf(each.poisson));
    stronge.emplace_back(outcomeOf(each.stronge));
  }
  convex.poisson = tableOf(starts, poisson, true);
  convex.stronge = tableOf(starts, stronge, true);
  for (const ConvexOutcomes& each : sweep.convex) convex.kinds.push_back(each.kind);
  return convex;
}

}  // namespace crossgrain::inline studies
