#include <fmt/format.h>

#include <cmath>

#include "cases/effect_switch.hpp"
#include "cli/one_case.hpp"
#include "cli/option_groups.hpp"
#include "cli/outcome.hpp"
#include "reports/effects/report.hpp"
#include "reports/report.hpp"
#include "runs/common/resumable.hpp"
#include "runs/effects/effects.hpp"

namespace crossgrain::inline cli {

namespace {

/// "grain  without friction  0.583 ± 0.012 of the time per step, 21 of 42 rings changed"
void printVariant(const EffectVariant& variant) {
  if (!variant.isSwitched()) return;
  if (variant.status != EngineStatus::ran) {
    fmt::print("{:<16} without {:<22} {}: {}\n", variant.engine, variant.effect,
               nameOf(variant.status), variant.reason);
    return;
  }
  int judged = 0, changed = 0;
  for (const ChangedField& field : variant.changes.fields)
    for (const RingChange& ring : field.rings) {
      judged += ring.resolved.has_value();
      changed += ring.resolved == true;
    }
  fmt::print("{:<16} without {:<22} {:.3f} of the time per step, {}\n", variant.engine,
             variant.effect, variant.timeRatio.value_or(NAN),
             judged == 0 ? "too few packings to tell what changed"
                         : fmt::format("{} of {} rings changed", changed, judged));
}

int effects(const CommandLine& line) {
  const Case setup = onlyCase(line, "effects");
  TimingPlan plan;
  if (line.quick) plan.seconds = 0.02;
  RunStore store(line.run, "effects", soleCase(setup));
  if (line.run.dryRun) return told(effectsPlan(setup, line.run, store, plan));
  const EffectsResults results = measureEffects(setup, line.run, store, plan);
  writeReport(results, line.run.out);
  if (line.json)
    fmt::print("{}\n", (line.run.out / "results.json").string());
  else {
    fmt::print("{}\n", effectsInWords(effectsOf(setup)));
    for (const EffectVariant& variant : results.variants) printVariant(variant);
    printOverview(reports::effectsOverview(results));
    fmt::print("report: {}\n", (line.run.out / "report.html").string());
    if (!line.run.quiet) printTimeSpent();
  }
  printRefusals(line, results.engines);
  int status = exitHeld;
  for (const EffectVariant& variant : results.variants) {
    if (variant.status != EngineStatus::failed) continue;
    printFailure(variant.reason);
    status = exitEngineFailed;
  }
  return status;
}

Action declareEffects(CLI::App& app, CommandLine& line) {
  addCase(app, line);
  addRun(app, line);
  addPackings(app, line);
  return [&line] { return resumably(line.run, [&] { return effects(line); }); };
}

}  // namespace

extern const Command effectsCommand = {
    "effects", "what each effect of a case costs and changes",
    "crossgrain effects cases/couette/quick.toml --engines grain --out out/effects",
    declareEffects};

}  // namespace crossgrain::inline cli
