#include "studies/conformance/conformance.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>

#include "adapters/suitability.hpp"
#include "cases/case_files.hpp"
#include "cases/flow.hpp"
#include "cases/loader.hpp"
#include "cases/preparation.hpp"
#include "cases/time_step.hpp"
#include "results/lockstep_text.hpp"
#include "results/schema.hpp"
#include "studies/collide/collide.hpp"
#include "studies/conformance/conformance_scenes.hpp"
#include "studies/core/engine_access.hpp"
#include "studies/core/executor.hpp"
#include "studies/core/in_space.hpp"
#include "studies/core/study.hpp"
#include "studies/lockstep/identify.hpp"
#include "studies/lockstep/lockstep.hpp"
#include "studies/lockstep/rules.hpp"
#include "studies/lockstep/terms.hpp"
#include "support/bad_input.hpp"
#include "support/data_folder.hpp"
#include "support/input_file.hpp"
#include "support/interrupt.hpp"
#include "support/numbers.hpp"
#include "support/scratch_folder.hpp"

namespace crossgrain::conformance {
namespace {

constexpr double timeout = 60.0;  // for one answer, of processor time where it computes [s]
constexpr int mostBreakdowns = 3;

constexpr const char* untriedReason = "the time of --budget was over";

/// A row of a check for which the budget had no time left.
ConformanceRow untriedRow(const std::string& part, const std::string& name,
                          const std::string& what) {
  return {part, name, what, checkUntried, untriedReason};
}

/// Findings so far that decide whether later causes stand.
struct Findings {
  std::vector<SubjectCause> subjectCauses;
  std::vector<std::size_t> ofSubjects;  ///< rows whose causes these are
  bool lawIsOff = false;
  bool planar = true;  ///< the engine has scenes of the plane
};

bool hasDimension(const Capabilities& can, int dimension) {
  return std::ranges::find(can.dimensions, dimension) != can.dimensions.end();
}

void runOne(const Check& check, CheckContext context, ConformanceRow& row, CheckReport& result,
            Findings& findings) {
  context.lawIsOff = findings.lawIsOff;
  try {
    if (!hasDimension(context.can, check.dimension) || (check.lies && !context.inSpace))
      context.skip(fmt::format("has no scenes {}",
                               check.dimension == 3 || check.lies ? "in space" : "of the plane"));
    if (check.lies && !findings.planar) context.skip(sameOfSpheres);
    check.run(context);
  } catch (const Skipped& skip) {
    row.outcome = checkSkipped;
    row.detail = skip.reason;
  } catch (const GivenUp&) {
  } catch (const EngineFailure& failure) {
    row.outcome = checkBrokeDown;
    row.detail = failure.what();
  } catch (const Interrupted&) {
    throw;
  } catch (const UnsupportedScene& left) {
    // The plane, in space, by what single precision leaves of it.
    if (context.single()) {
      row.outcome = checkSkipped;
      row.detail = left.what();
    } else {
      context.fault(left.what());
    }
  } catch (const std::exception& error) {
    context.fault(error.what());
  }
  row.faults = context.faults.size();
  result.refused.merge(context.refused);
  if (row.outcome == checkBrokeDown) return;
  result.examined.merge(context.examined);
  if (context.faults.empty()) {
    if (row.outcome == checkPassed) row.detail = fmt::format("{}", fmt::join(context.notes, "; "));
    return;
  }
  row.outcome = checkFailed;
  row.detail = context.faults.front();
  row.cause = context.cause.value_or("");
  findings.lawIsOff = context.lawIsOff;
  if (!context.subjectCauses.empty()) findings.ofSubjects.push_back(result.rows.size() - 1);
  std::ranges::move(context.subjectCauses, std::back_inserter(findings.subjectCauses));
}

/// Subject of the checks that repeat others far away, late, fast and with many disks.
constexpr const char* elsewhere = "far, late, fast and many";

/// Whether a check failed that others rest on: causes that those fit are then wrong.
bool basisFailed(const std::vector<Check>& checks, const std::vector<ConformanceRow>& rows) {
  return std::ranges::any_of(rows, [&](const ConformanceRow& row) {
    const bool wrong = row.outcome == checkFailed || row.outcome == checkBrokeDown;
    const auto of = std::ranges::find(checks, row.name, [](const Check& c) { return c.name; });
    return wrong && of != checks.end() && of->basis;
  });
}

/// Takes back causes that later findings contradict.
void withdrawCauses(const std::vector<Check>& checks, const Findings& findings,
                    std::vector<ConformanceRow>& rows) {
  if (!oneCause(findings.subjectCauses))
    for (const std::size_t row : findings.ofSubjects) rows[row].cause.clear();
  // A cause that is only elsewhere explains no failure here.
  std::size_t unexplained = 0;
  for (std::size_t k = 0; k < rows.size(); ++k)
    unexplained +=
        rows[k].outcome == checkFailed && rows[k].cause.empty() && checks[k].about != elsewhere;
  for (std::size_t k = 0; unexplained > 0 && k < rows.size(); ++k)
    if (checks[k].about == elsewhere) rows[k].cause.clear();
  if (!basisFailed(checks, rows)) return;
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (!checks[k].basis) rows[k].cause.clear();
}

}  // namespace

std::vector<Check> allChecks() {
  std::vector<Check> all;
  for (const auto& [name, checks] : {Subject{"what it declares", capabilityChecks()},
                                     {"requests and snapshots", lifecycleChecks()},
                                     {"free motion", freeMotionChecks()},
                                     {"collisions, in general", collisionChecks()},
                                     {"two bodies by the law", lawChecks()},
                                     {"conventions", conventionChecks()},
                                     {"rolling and cohesion", resistanceChecks()},
                                     {"symmetries", symmetryChecks()},
                                     {"walls that move", wallChecks()},
                                     {"contacts as shown", contactChecks()},
                                     {elsewhere, reachChecks()},
                                     {"several at once", sceneChecks()},
                                     {"springs in space", springChecks()},
                                     {"space and periodic borders", spaceChecks()},
                                     {"cylinders", cylinderChecks()},
                                     {"convex bodies", convexChecks()},
                                     {"refusals", refusalChecks()}})
    for (Check check : checks) {
      check.about = name;
      all.push_back(check);
      if (!check.inSpaceToo) continue;
      check.lies = true;
      check.name += "InSpace";
      all.push_back(std::move(check));
    }
  return all;
}

CheckReport runChecks(const EngineEntry& entry, const std::vector<Check>& checks,
                      const std::filesystem::path& scratch,
                      const std::function<void(const std::string&, double)>& progress,
                      const std::function<bool()>& timeIsUp) {
  using Clock = std::chrono::steady_clock;
  int workers = 0;
  const CheckContext::Start startOne = [&](const EngineEntry& of) {
    return startNew(of, scratch / fmt::format("{}-{}", of.name, ++workers), timeout);
  };
  // Scenes of the plane are run in space by an engine that has no others. All checks share workers:
  // one for scenes as they are, one for each way in which a plane lies in space.
  struct Shared {
    CheckContext::Start start;
    std::unique_ptr<Engine> engine = nullptr;
  };
  const auto lying = [&](PlaneFrame frame) {
    return Shared{[&, frame](const EngineEntry& of) { return runInSpace(startOne(of), frame); }};
  };
  Shared asTheyAre{startOne, startOne(entry)}, any = lying(PlaneFrame::any),
                                               flat = lying(PlaneFrame::flat);
  CheckReport result;
  result.declared = declaredBy(asTheyAre.engine->capabilities());
  const bool planar = hasDimension(asTheyAre.engine->capabilities(), 2);
  const bool spatial = hasDimension(asTheyAre.engine->capabilities(), 3);
  std::vector<ConformanceRow>& rows = result.rows;
  Findings findings;
  findings.planar = planar;
  int breakdowns = 0;
  for (const Check& check : checks) {
    throwIfInterrupted();
    progress(fmt::format("check {} of {}: {}", rows.size() + 1, checks.size(), check.name),
             static_cast<double>(rows.size()) / static_cast<double>(checks.size()));
    if (timeIsUp()) {
      rows.push_back(untriedRow("suite", check.name, check.what));
      continue;
    }
    ConformanceRow& row =
        rows.emplace_back(ConformanceRow{"suite", check.name, check.what, checkPassed, {}});
    row.about = check.about;
    if (breakdowns >= mostBreakdowns) {
      row.outcome = checkSkipped;
      row.detail = fmt::format("not tried: it broke down {} times before", breakdowns);
      continue;
    }
    const auto began = Clock::now();
    const bool asItIs = check.dimension == 3 || (planar && !(check.lies && spatial));
    auto& [start, engine] = asItIs ? asTheyAre : check.frame == PlaneFrame::flat ? flat : any;
    if (!engine) engine = start(entry);
    CheckContext context(*engine, entry, start);
    context.inSpace = !asItIs;
    context.turned = &engine == &any.engine;
    runOne(check, std::move(context), row, result, findings);
    row.seconds = std::chrono::duration<double>(Clock::now() - began).count();
    breakdowns += row.outcome == checkBrokeDown;
    // It may have died of it; the next check needs a sound one.
    if (row.outcome == checkBrokeDown || row.outcome == checkFailed) engine.reset();
  }
  withdrawCauses(checks, findings, rows);
  return result;
}

}  // namespace crossgrain::conformance

namespace crossgrain::inline studies {

namespace {

/// Collisions of the laws of Lätzel's figure 4.3, or of rigid disks, at 50 steps a contact: whether
/// they converge is the business of `collide`. Without the pure spring, which has two limits of
/// small steps (README.md, known limits): no single oracle says which an engine is to reach. Of an
/// engine of space alone those of spheres.
std::vector<Case> collisionCases(const Capabilities& can) {
  const bool space = !conformance::hasDimension(can, 2);
  const bool rigid =
      conformance::valuesOf(can, ContactLaw{}, "normal") == std::vector<std::string>{"rigid"};
  const auto file = dataFolder() / "cases" /
                    (space   ? rigid ? "space/spheres-rigid.toml" : "space/spheres.toml"
                     : rigid ? "collision/hard-sphere.toml"
                             : "collision/figure-4-3.toml");
  std::vector<std::string> less = {"run.mirrors=false"};
  if (!rigid) less.emplace_back("collision.steps_per_contact=[50]");
  std::vector<Case> cases = loadCase(file, less);
  std::erase_if(cases, [&](const Case& each) {
    // In space the dashpot's case has finer steps of its own.
    if (space) return each.law.tangential == TangentialLaw::springDashpot;
    return each.law.soft() && each.law.tangential == TangentialLaw::spring;
  });
  return cases;
}

std::vector<FlowState> flowOf(const Case& setup, std::size_t starts) {
  const double dt = timeStep(setup);
  const auto inHouse = engineRegistry().front().make();
  const Packing packing = flowPacking(setup, 0, dt, *inHouse, [](double) { throwIfInterrupted(); });
  return statesAlongTheFlow(setup, {packing}, dt, starts, [](double) {});
}

std::string contradictionsOf(const Identification& found) {
  if (!found.closeEnough()) return {};
  std::vector<std::string> parts;
  for (const FoundOption& option : found.options)
    if (option.contradicts())
      parts.push_back(fmt::format(
          "it has {} = {}, and declares {}", option.name, fmt::join(option.values, " or "),
          option.declared.empty() ? "nothing"
                                  : fmt::format("{}", fmt::join(option.declared, " or "))));
  // Several constants, or a constant beside a convention, can fit a difference that none of them
  // causes.
  if (found.constants.size() + std::min<std::size_t>(parts.size(), 1) > 1) return {};
  for (const FoundConstant& constant : found.constants)
    parts.push_back(fmt::format("its {} is {:+.3g} % off the case's",
                                results::constantSymbol(constant.name), 100.0 * constant.change));
  for (const std::string& effect : found.missing)
    if (std::ranges::find(found.declaredMissing, effect) == found.declaredMissing.end())
      parts.push_back(fmt::format("it does not simulate {}, which it declares", effect));
  return fmt::format("{}", fmt::join(parts, "; "));
}

/// A term explains a divergence where it leaves a tenth at most, which is more than anything else
/// does by chance, and is small enough for responses to be linear: it was tried with 1e-4.
constexpr double termLeavesAtMost = 0.1, termAmountAtMost = 0.25;

bool explains(const NamedTerm& term) {
  return term.unexplained <= termLeavesAtMost &&
         (!term.amount || std::abs(*term.amount) <= termAmountAtMost);
}

/// Lockstep's own term where it explains the divergence, and the contradictions that identify
/// finds.
std::string causeOf(Engine& engine, const EngineEntry& entry, const Case& setup,
                    const LockstepRow& row) {
  std::vector<std::string> causes;
  if (row.term && explains(*row.term))
    causes.push_back("lockstep's closest term: " + results::describeTerm(row));
  if (setup.dimension == 3) return fmt::format("{}", fmt::join(causes, "; "));
  const std::string found = contradictionsOf(
      identify(engine, entry, setup, flowOf(setup, 2), timeStep(setup), [](double) {}));
  if (!found.empty()) causes.push_back("found from outside: " + found);
  return fmt::format("{}", fmt::join(causes, "; "));
}

constexpr const char* mirrorProperty =
    "it does step by step what the in-house engine does with the conventions declared";

/// Flow that the engine and its mirror run in lockstep: the quick cell; of an engine of space alone
/// a shear between walls of spheres, or a pile where it has no periodic directions. Short.
Case flowCase(const Capabilities& can) {
  const bool space = !conformance::hasDimension(can, 2);
  const char* const file = !space         ? "couette/quick.toml"
                           : can.periodic ? "space/shear-3d.toml"
                                          : "space/pile.toml";
  const std::vector<std::string> less =
      space ? std::vector<std::string>{"assembly.duration=3", "average.from=1"}
            : std::vector<std::string>{"preparation.rotations=0.1"};
  return loadCase(dataFolder() / "cases" / file, less).front();
}

/// @param name      of the row
/// @param seesTrue  whether the suite's basis held; no cause is looked for without
/// @param part      how the law of the cell becomes the row's
ConformanceRow lockstepRow(const EngineEntry& entry, const std::filesystem::path& scratch,
                           const std::string& name, bool seesTrue,
                           const std::function<void(ContactLaw&)>& part) {
  ConformanceRow row{"lockstep", name, mirrorProperty, checkPassed, {}};
  const auto engine = startNew(entry, scratch / name, conformance::timeout);
  Case setup = flowCase(engine->capabilities());
  part(setup.law);
  if (const std::string why = noMirrorReason(entry, engine->capabilities(), setup); !why.empty()) {
    row.outcome = checkSkipped;
    row.detail = why;
    return row;
  }
  const LockstepRow found = holdAgainstMirror(
      *engine, entry, setup, flowOf(setup, quickLockstepStarts), timeStep(setup), [](double) {});
  row.detail = results::describe(found, lockstepRules(setup.law));
  if (!found.failure.empty()) {
    row.outcome = checkBrokeDown;
    row.detail = found.failure;
  } else if (found.verdict == Equivalence::notMeasured || found.verdict == Equivalence::undecided) {
    row.outcome = checkSkipped;
  } else if (found.verdict == Equivalence::differs) {
    row.outcome = checkFailed;
    row.faults = 1;
    if (seesTrue) row.cause = causeOf(*engine, entry, setup, found);
  }
  return row;
}

/// Under the thesis' law, and under the laws that resist rolling or cohere which the engine has
/// beside it.
std::vector<ConformanceRow> lockstepRows(const EngineEntry& entry, const Capabilities& can,
                                         const std::filesystem::path& scratch, bool seesTrue,
                                         const std::function<bool(const std::string&)>& wanted,
                                         const std::function<bool()>& timeIsUp) {
  std::vector<ConformanceRow> rows;
  const auto add = [&](const std::string& name, const auto& part) {
    if (wanted(name))
      rows.push_back(timeIsUp() ? conformance::untriedRow("lockstep", name, mirrorProperty)
                                : lockstepRow(entry, scratch, name, seesTrue, part));
  };
  add("FollowsItsMirror", [](ContactLaw&) {});
  const std::vector<RollingLaw> rolling = conformance::rollingLaws(can);
  if (!rolling.empty())
    add("FollowsItsMirrorRolling",
        [&](ContactLaw& law) { law = conformance::withRolling(law, rolling.back()); });
  for (const CohesionLaw kind : conformance::cohesionLaws(can)) {
    if (!conformance::goesWith(kind, NormalLaw::linear)) continue;
    add("FollowsItsMirrorWithCohesion",
        [&](ContactLaw& law) { law = conformance::withCohesion(law, kind); });
    break;
  }
  return rows;
}

/// Causes of the failures, each once: lockstep's first, which is the most exact.
std::string causesOf(const std::vector<ConformanceRow>& rows) {
  std::vector<std::string> causes;
  for (const bool lockstep : {true, false})
    for (const ConformanceRow& row : rows) {
      if ((row.part == "lockstep") != lockstep || row.cause.empty()) continue;
      const std::string cause = row.cause.substr(0, row.cause.find(", "));  // without the place
      if (std::ranges::none_of(causes,
                               [&](const std::string& known) { return known.starts_with(cause); }))
        causes.push_back(row.cause);
    }
  return fmt::format("{}", fmt::join(causes, "; "));
}

constexpr const char* collisionsProperty = "collisions of two come to what the declared law says";

ConformanceRow rowOf(const CollisionVariant& variant, const CollisionCurve& curve) {
  ConformanceRow row{"collisions",
                     variant.variant.empty() ? variant.name : variant.variant,
                     collisionsProperty,
                     checkPassed,
                     {}};
  row.seconds = curve.stats ? curve.stats->wallSeconds : 0.0;
  const Verdict verdict = verdictOf(curve);
  if (curve.status == Status::failed) {
    row.outcome = checkBrokeDown;
    row.detail = curve.reason;
  } else if (!isJudged(verdict)) {
    row.outcome = checkSkipped;
    row.detail = curve.reason.empty() ? "no reference to compare it with" : curve.reason;
  } else if (verdict == Verdict::fail) {
    WorstQuantity worst;
    worst.take(declaredScore(curve));
    row.outcome = checkFailed;
    row.faults = 1;
    row.detail = worst.words();
    if (const auto own = ownDeviation(curve))
      row.detail += fmt::format("{}off its own time stepping by {:.2g}",
                                row.detail.empty() ? "" : "; ", *own);
  }
  return row;
}

std::vector<ConformanceRow> collisionRows(const EngineEntry& entry, const Capabilities& can,
                                          const std::filesystem::path& scratch) {
  RunCommand command;
  command.engines = {entry.name};
  command.out = scratch / "collisions";
  command.quiet = true;
  const std::vector<Case> cases = collisionCases(can);
  std::vector<ConformanceRow> rows;
  try {
    RunStore store(command, "collide", keysOfEach(cases));
    for (const CollisionVariant& variant : collideEngines(cases, command, store).variants)
      for (const CollisionCurve& curve : variant.curves) rows.push_back(rowOf(variant, curve));
  } catch (const UnsupportedScene& refusal) {
    rows.push_back(
        {"collisions", cases.front().name, collisionsProperty, checkSkipped, refusal.what()});
  }
  return rows;
}

}  // namespace

std::vector<std::string> conformanceChecks(const std::optional<std::string>& only) {
  std::vector<std::string> names, words;
  for (const conformance::Check& check : conformance::allChecks()) names.emplace_back(check.name);
  for (const char* more : {"FollowsItsMirror", "FollowsItsMirrorRolling",
                           "FollowsItsMirrorWithCohesion", "collisions"})
    names.emplace_back(more);
  if (!only) return names;
  words = commaList(*only);
  for (const std::string& word : words)
    if (std::ranges::none_of(names, [&](const auto& name) { return fitsPattern(name, word); }))
      throw BadInput(fmt::format("-k '{}': no check has that in its name", word));
  std::erase_if(names, [&](const std::string& name) {
    return std::ranges::none_of(words, [&](const auto& word) { return fitsPattern(name, word); });
  });
  return names;
}

ConformanceResults runConformance(const ConformanceTask& task) {
  const auto began = std::chrono::steady_clock::now();
  const EngineEntry& entry = task.entry;
  const ScratchFolder scratch;
  const auto elapsed = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  };
  const auto timeIsUp = [&] { return elapsed() > task.budget; };
  std::vector<conformance::Check> checks = conformance::allChecks();
  const std::vector<std::string> names = conformanceChecks(task.only);
  const auto wanted = [&](const std::string& name) {
    return std::ranges::find(names, name) != names.end();
  };
  std::erase_if(checks, [&](const conformance::Check& check) { return !wanted(check.name); });

  ConformanceResults results;
  results.head = headOf(kindConformance, Case{}, task.commandLine);
  results.head.setup.name = entry.name;
  results.engine = engineRow(entry, "");
  const Capabilities can = startNew(entry, scratch.path / "hello", 60.0)->capabilities();
  results.engine.version = can.version;
  settingsFor(Case{}, entry.name, can);  // throws for one of its file that it does not have

  Progress progress(task.quiet);
  const bool follows = std::ranges::any_of(
      names, [](const std::string& name) { return name.starts_with("FollowsItsMirror"); });
  std::vector<double> weights;  // of the parts that there are
  if (!checks.empty()) weights.push_back(2.0);
  if (follows) weights.push_back(1.0);
  if (wanted("collisions")) weights.push_back(1.0);
  progress.begin("conformance of " + entry.name, weights);
  std::size_t part = 0;
  double reported = elapsed();  // [s]
  conformance::CheckReport suite = conformance::runChecks(
      entry, checks, scratch.path,
      [&](const std::string& check, double fraction) {
        progress.update(0, check, fraction);
        // Without a terminal a line now and then.
        if (::isatty(STDERR_FILENO) == 1 || elapsed() - reported < 5.0) return;
        reported = elapsed();
        progress.say("  " + check);
      },
      timeIsUp);
  results.rows = std::move(suite.rows);
  if (!checks.empty())
    progress.finish(part++, "suite: " + support::counted(results.rows.size(), "check"));
  const bool alive = results.count(checkBrokeDown) < 3;
  if (alive && follows) {
    const bool seesTrue = !conformance::basisFailed(checks, results.rows);
    std::ranges::move(lockstepRows(entry, can, scratch.path, seesTrue, wanted, timeIsUp),
                      std::back_inserter(results.rows));
    progress.finish(part++, "lockstep");
  }
  if (alive && wanted("collisions")) {
    if (timeIsUp())
      results.rows.push_back(
          conformance::untriedRow("collisions", "collisions", collisionsProperty));
    else
      std::ranges::move(collisionRows(entry, can, scratch.path), std::back_inserter(results.rows));
    progress.finish(part++, "collisions");
  }
  if (results.rows.empty())
    throw BadInput(fmt::format("-k '{}': no check has that in its name", *task.only));
  results.cause = causesOf(results.rows);
  if (!task.only) {
    results.declared = suite.declared.size();
    for (const SettingSpec& setting : can.settings)
      if (setting.name != "dt") results.atDefaults.push_back(setting.name);
    for (const std::string& one : suite.declared) {
      if (suite.examined.contains(one)) continue;
      const auto why = suite.refused.find(one);
      results.notExamined.push_back(
          why == suite.refused.end() ? one : fmt::format("{} ({})", one, why->second));
    }
  }
  for (const ConformanceRow& row : results.rows)
    if (row.outcome == checkBrokeDown && results.engine.reason.empty()) {
      results.engine.status = Status::failed;
      results.engine.reason = row.detail;
    }
  results.elapsed = elapsed();
  return results;
}

Outcome outcomeOf(const ConformanceResults& results, bool allowUnexamined) {
  if (results.count(checkBrokeDown) > 0) return {exitEngineFailed, {results.engine.reason}};
  if (results.count(checkFailed) > 0) return {exitFailed};
  if (const std::size_t untried = results.count(checkUntried))
    return {exitFailed,
            {fmt::format("{} of {} checks were not tried: {}", untried, results.rows.size(),
                         conformance::untriedReason)}};
  const auto part = results.partExamined();
  if (part && *part < leastExamined && !allowUnexamined)
    return {exitFailed,
            {},
            {},
            {fmt::format("{:.0f} % of what {} declares was examined, {:.0f} % have to be "
                         "(--allow-unexamined: they need not)",
                         std::floor(100.0 * *part), results.engine.name, 100.0 * leastExamined)}};
  return results.count(checkPassed) == 0 ? notJudged("every check was skipped") : Outcome();
}

}  // namespace crossgrain::inline studies
