#include "runs/conformance/conformance.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "adapters/suitability.hpp"
#include "cases/loader.hpp"
#include "cases/preparation.hpp"
#include "cases/time_step.hpp"
#include "reports/collide/tally.hpp"
#include "reports/lockstep/words.hpp"
#include "results/schema.hpp"
#include "runs/collide/collide.hpp"
#include "runs/common/engine_access.hpp"
#include "runs/common/executor.hpp"
#include "runs/common/study.hpp"
#include "runs/conformance/examination.hpp"
#include "runs/lockstep/comparison.hpp"
#include "runs/lockstep/identify.hpp"
#include "runs/lockstep/lockstep.hpp"
#include "runs/lockstep/rules.hpp"
#include "runs/lockstep/terms.hpp"
#include "support/bad_input.hpp"
#include "support/data_folder.hpp"
#include "support/interrupt.hpp"
#include "support/scratch_folder.hpp"

namespace crossgrain::inline runs {

namespace {

/// The cell that engines are held against their mirrors in.
Case lockstepCase() {
  return loadCase(dataFolder() / "cases/couette/quick.toml", {"preparation.rotations=0.1"}).front();
}

/// Collisions of the laws of Lätzel's figure 4.3, or of rigid disks, at 50 steps a contact: whether
/// they converge is the business of `collide`. Without the pure spring, which has two limits of
/// small steps (README.md, known limits): no single oracle says which an engine is to reach.
std::vector<Case> collisionCases(const Capabilities& can) {
  const auto laws = can.lawOptions.find("normal");
  const bool rigid =
      laws != can.lawOptions.end() && laws->second == std::vector<std::string>{"rigid"};
  const auto file =
      dataFolder() / "cases/collision" / (rigid ? "hard-sphere.toml" : "figure-4-3.toml");
  std::vector<std::string> less = {"run.mirrors=false"};
  if (!rigid) less.emplace_back("collision.steps_per_contact=[50]");
  std::vector<Case> cases = loadCase(file, less);
  std::erase_if(cases, [](const Case& each) {
    return each.law.soft() && each.law.tangential == TangentialLaw::spring;
  });
  return cases;
}

std::vector<FlowState> flowOf(const Case& setup, std::size_t starts) {
  const double dt = timeStep(setup);
  const auto inHouse = engineRegistry().front().make();
  const Packing packing = packingOf(setup, 0, dt, *inHouse, [](double) { throwIfInterrupted(); });
  return statesAlongTheFlow(setup, {packing}, dt, starts, [](double) {});
}

std::string inWords(const Identification& found) {
  if (!found.closeEnough()) return {};
  std::vector<std::string> words;
  for (const FoundOption& option : found.options)
    if (option.contradicts())
      words.push_back(fmt::format(
          "it has {} = {}, and declares {}", option.name, fmt::join(option.values, " or "),
          option.declared.empty() ? "nothing"
                                  : fmt::format("{}", fmt::join(option.declared, " or "))));
  for (const FoundConstant& constant : found.constants)
    words.push_back(fmt::format("its {} is {:+.3g} % off the case's",
                                reports::constantSymbol(constant.name), 100.0 * constant.change));
  for (const std::string& effect : found.missing)
    if (std::ranges::find(found.declaredMissing, effect) == found.declaredMissing.end())
      words.push_back(fmt::format("it does not simulate {}, which it declares", effect));
  return fmt::format("{}", fmt::join(words, "; "));
}

/// A term explains a separation where it leaves a tenth at most, which is more than anything else
/// does by chance, and is small enough for responses to be in proportion: it was tried with 1e-4.
constexpr double termLeavesAtMost = 0.1, termAmountAtMost = 0.25;

bool explains(const NamedTerm& term) {
  return term.unexplained <= termLeavesAtMost &&
         (!term.amount || std::abs(*term.amount) <= termAmountAtMost);
}

/// Lockstep's own term where it explains what was found, and what identify finds.
std::string causeOf(Engine& engine, const EngineEntry& entry, const Case& setup,
                    const LockstepRow& row) {
  std::string cause;
  if (row.term && explains(*row.term))
    cause = "lockstep's closest term: " + reports::termInWords(row);
  const auto states = flowOf(setup, 2);
  const std::string found =
      inWords(identify(engine, entry, setup, states, timeStep(setup), [](double) {}));
  if (!found.empty()) cause += (cause.empty() ? "" : "; ") + ("found from outside: " + found);
  return cause;
}

ConformanceRow lockstepRow(const EngineEntry& entry, const std::filesystem::path& scratch) {
  const Case setup = lockstepCase();
  ConformanceRow row;
  row.part = "lockstep";
  row.name = "FollowsItsMirror";
  row.what = "it does step by step what the in-house engine does with the conventions declared";
  const auto engine = startNew(entry, scratch / "lockstep", setup.run.timeout);
  if (const std::string why = whyNoMirror(entry, engine->capabilities(), setup); !why.empty()) {
    row.outcome = ConformanceOutcome::skipped;
    row.detail = why;
    return row;
  }
  const LockstepRow found = holdAgainstMirror(
      *engine, entry, setup, flowOf(setup, quickLockstepStarts), timeStep(setup), [](double) {});
  row.detail = reports::sentenceOf(found, lockstepRules(setup.law));
  if (!found.failure.empty()) {
    row.outcome = ConformanceOutcome::brokeDown;
    row.detail = found.failure;
  } else if (found.verdict == LockstepVerdict::notMeasured ||
             found.verdict == LockstepVerdict::undecided) {
    row.outcome = ConformanceOutcome::skipped;
  } else if (found.verdict == LockstepVerdict::differs) {
    row.outcome = ConformanceOutcome::failed;
    row.faults = 1;
    row.cause = causeOf(*engine, entry, setup, found);
  }
  return row;
}

/// What explains the failures, each cause once: lockstep's first, which is the most exact.
std::string causesOf(const std::vector<ConformanceRow>& rows) {
  std::vector<std::string> causes;
  const auto add = [&](const ConformanceRow& row) {
    const std::string what = row.cause.substr(0, row.cause.find(", "));  // without the place
    if (!what.empty() && std::ranges::none_of(causes, [&](const std::string& known) {
          return known.starts_with(what);
        }))
      causes.push_back(row.cause);
  };
  for (const ConformanceRow& row : rows)
    if (row.part == "lockstep") add(row);
  std::ranges::for_each(rows, add);
  return fmt::format("{}", fmt::join(causes, "; "));
}

ConformanceRow rowOf(const CollisionVariant& variant, const CollisionCurve& curve) {
  ConformanceRow row;
  row.part = "collisions";
  row.name = variant.variant.empty() ? variant.name : variant.variant;
  row.what = "collisions of two come to what the declared law says";
  row.seconds = curve.stats ? curve.stats->wallSeconds : 0.0;
  switch (outcomeOf(curve)) {
    case SweepOutcome::held:
    case SweepOutcome::modelDifference:
      break;
    case SweepOutcome::fellShort: {
      reports::Worst worst;
      worst.look(declaredScore(curve));
      row.outcome = ConformanceOutcome::failed;
      row.faults = 1;
      row.detail = worst.words();
      if (const auto own = ownDeviation(curve))
        row.detail += fmt::format("{}off its own time stepping by {:.2g}",
                                  row.detail.empty() ? "" : "; ", *own);
      break;
    }
    case SweepOutcome::failed:
      row.outcome = ConformanceOutcome::brokeDown;
      row.detail = curve.reason;
      break;
    case SweepOutcome::notJudged:
    case SweepOutcome::refused:
      row.outcome = ConformanceOutcome::skipped;
      row.detail = curve.reason.empty() ? "nothing to hold it against" : curve.reason;
      break;
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
    rows.push_back({"collisions", cases.front().name,
                    "collisions of two come to what the declared law says",
                    ConformanceOutcome::skipped, refusal.what()});
  }
  return rows;
}

}  // namespace

ConformanceResults runConformance(const ConformanceTask& task) {
  const auto began = std::chrono::steady_clock::now();
  const EngineEntry& entry = task.entry;
  const ScratchFolder scratch;
  const auto wanted = [&](const std::string& name) {
    return !task.only || name.find(*task.only) != std::string::npos;
  };
  std::vector<conformance::Check> checks = conformance::checksOf(!entry.mirrors.empty());
  std::erase_if(checks, [&](const conformance::Check& check) { return !wanted(check.name); });

  ConformanceResults results;
  results.head = headOf(kindConformance, Case{}, task.commandLine);
  results.head.setup.name = entry.name;
  results.engine = engineRow(entry, "");
  const Capabilities can = startNew(entry, scratch.path / "hello", 60.0)->capabilities();
  results.engine.version = can.version;
  settingsFor(Case{}, entry.name, can);  // throws for one of its file that it does not have

  Progress progress(task.quiet);
  progress.begin("conformance of " + entry.name, {2.0, 1.0, 1.0});
  conformance::Examination suite = conformance::examine(
      entry, checks, scratch.path,
      [&](const std::string& check, double fraction) { progress.update(0, check, fraction); });
  results.rows = std::move(suite.rows);
  progress.finish(0, fmt::format("suite: {} checks", results.rows.size()));
  const bool alive = results.count(ConformanceOutcome::brokeDown) < 3;
  if (alive && wanted("FollowsItsMirror")) {
    results.rows.push_back(lockstepRow(entry, scratch.path));
    progress.finish(1, "lockstep");
  }
  if (alive && wanted("collisions")) {
    std::ranges::move(collisionRows(entry, can, scratch.path), std::back_inserter(results.rows));
    progress.finish(2, "collisions");
  }
  if (results.rows.empty())
    throw BadInput(fmt::format("-k '{}': no check has that in its name", *task.only));
  results.cause = causesOf(results.rows);
  if (!task.only) {
    results.declared = suite.declared.size();
    for (const std::string& one : suite.declared) {
      if (suite.examined.contains(one)) continue;
      const auto why = suite.refused.find(one);
      results.notExamined.push_back(
          why == suite.refused.end() ? one : fmt::format("{} ({})", one, why->second));
    }
  }
  for (const ConformanceRow& row : results.rows)
    if (row.outcome == ConformanceOutcome::brokeDown && results.engine.reason.empty()) {
      results.engine.status = EngineStatus::failed;
      results.engine.reason = row.detail;
    }
  results.elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  return results;
}

Outcome outcomeOf(const ConformanceResults& results) {
  using enum ConformanceOutcome;
  if (results.count(brokeDown) > 0) return {exitEngineFailed, {results.engine.reason}};
  if (results.count(failed) > 0) return {exitFellShort};
  return results.count(passed) == 0 ? notJudged("every check was skipped") : Outcome();
}

}  // namespace crossgrain::inline runs
