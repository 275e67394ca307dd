#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "cases/couette.hpp"
#include "cases/time_step.hpp"
#include "results/schema.hpp"
#include "results/thesis_fields.hpp"
#include "runs/common/study.hpp"
#include "runs/couette/frame.hpp"
#include "runs/thesis/climb.hpp"
#include "support/files.hpp"

namespace crossgrain::inline runs {

std::string Climb::plan() const {
  std::map<std::size_t, PlannedWork> works;
  for (const LadderStep& step : steps_) {
    PlannedWork& work = works[step.engine];
    work.engine = engines_[step.engine].entry.name;
    work.what = "runs";
    const auto task = taskOf(step);
    const auto kept = store_.findAs<ThesisRun>(task.name, task.key);
    std::optional<nlohmann::json> run;
    if (kept)
      run = jsonOf(kept->run);
    else if (const ThesisRun* before = earlier(step, task.key))
      run = jsonOf(before->run);
    count(work, run);
  }
  std::string head = fmt::format("{}: {} legs\n", ladder_.file.string(), ladder_.legs.size());
  for (const LadderRung& rung : ladder_.rungs) {
    double millions = 0.0;  // of the case's dt, for one engine
    for (const std::size_t leg : rung.legs) {
      const Case& setup = ladder_.legs[leg].setup;
      const double rotations = setup.averaging.settleRotations + setup.averaging.rotations;
      millions += 1e-6 * rung.packings * rotations * rotationTime(setup) / timeStep(setup);
    }
    head += fmt::format("  {}: legs {}, packings of each {}, {:.1f} million steps\n", rung.name,
                        rung.legs.size(), rung.packings, millions);
  }
  for (const std::string& refusal : refusals_) head += "  " + refusal + "\n";
  std::vector<PlannedWork> list;
  for (auto& [engine, work] : works) list.push_back(std::move(work));
  return dryRunInWords(head, list, store_, command_);
}

namespace {

ThesisLeg rowOf(const LadderLeg& leg) {
  const Case& setup = leg.setup;
  ThesisLeg row;
  row.name = leg.name;
  row.purpose = leg.purpose;
  row.file = setup.file.string();
  row.families = leg.families;
  row.cell = couetteFrame(kindThesis, setup, "", diskKinds(setup.particles)).cell;
  row.label = leg.label;
  row.kn = setup.law.kn;
  row.mu = setup.law.mu;
  row.bottomFriction = setup.bottom.has_value();
  row.settleRotations = setup.averaging.settleRotations;
  row.averagedRotations = setup.averaging.rotations;
  row.caseToml = setup.resolvedToml;
  return row;
}

}  // namespace

ThesisResults Climb::results() const {
  ThesisResults results;
  results.head = headOf(kindThesis, ladder_.legs.front().setup, command_.commandLine);
  results.head.setup = {ladder_.name, "", ladder_.file.string(),
                        readFile(ladder_.file).value_or("")};
  for (const ClimbingEngine& own : engines_)
    results.engines.push_back(
        {own.entry.name, own.entry.summary, own.version, own.entry.mirrors, EngineStatus::ran, ""});
  for (const LadderLeg& leg : ladder_.legs) results.legs.push_back(rowOf(leg));
  results.carriers = carriers_;
  results.notes = refusals_;
  for (const ThesisRun& run : runs_) {
    if (run.run.status == RunStatus::missing) {
      results.notes.push_back(fmt::format("{}, {}, packing {} was left out: {}.", run.leg,
                                          run.engine, run.packing, run.run.reason));
      continue;
    }
    results.runs.push_back(run);
    if (run.run.status != RunStatus::failed) continue;
    EngineRow& engine = *std::ranges::find(results.engines, run.engine, &EngineRow::name);
    if (engine.status == EngineStatus::failed) continue;
    engine.status = EngineStatus::failed;
    engine.reason = run.run.reason;
  }
  std::ranges::copy(madeByOthers(results.runs), std::back_inserter(results.notes));
  return results;
}

}  // namespace crossgrain::inline runs
