#include "reports/stability/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/sentences.hpp"

namespace crossgrain::reports {

namespace {

struct Family {
  std::string_view measure, name, asks;
  bool transform = false;  ///< of a transformed case
};
/// In the order of the columns.
constexpr std::array families = {
    Family{"energy_gain", "energy", "Is energy conserved, or lost as the law says?"},
    Family{"energy_drift", "energy", ""},
    Family{"ledger_residual", "energy", ""},
    Family{"momentum_drift", "momentum", "Are momentum and angular momentum kept?"},
    Family{"angular_momentum_drift", "momentum", ""},
    Family{"restitution_error", "bounce", "Do disks rebound as theory says?"},
    Family{"max_overlap", "passing through", "Do disks go through each other or through walls?"},
    Family{"tunnelled", "passing through", ""},
    Family{"escaped", "passing through", ""},
    Family{"kinetic_at_rest", "rest", "Do disks at rest stay at rest?"},
    Family{"creep", "rest", ""},
    Family{"pile_angle_change", "rest", ""},
    Family{"time_to_rest", "rest", ""},
    Family{"ratchet", "cycles", "Do repeated loads come back to where they were?"},
    Family{"step_limit", "time step", "How near to theory is the largest stable time step?"},
    Family{"copies_differ", "copies", "Do turned, shifted and scaled copies behave alike?"},
    Family{"restart_differs", "restart", "Does a run go on from a checkpoint as if uninterrupted?"},
    Family{"accepted", "bad starts", "Are starts refused that nothing can run?"},
    Family{"turned", "turned", "Does a turned scene do the same, turned?", true},
    Family{"mirrored", "mirrored", "Does a mirrored scene do the same, mirrored?", true},
    Family{"rescaled", "other units", "Does a scene in other units do the same?", true},
    Family{"renumbered", "renumbered", "Do disks do the same under other numbers?", true},
    Family{"restarted", "restarted", "Does a run restarted from a checkpoint go on the same?",
           true},
    Family{"split", "in one go", "Does a run without snapshots do the same?", true}};

const Family* known(const std::string& measure) {
  const auto found = std::ranges::find(families, measure, &Family::measure);
  return found == families.end() ? nullptr : &*found;
}

/// The family of hard cases that a measure belongs to; of one that is not known here its own name.
std::string familyOf(const std::string& measure) {
  const Family* family = known(measure);
  return family ? std::string(family->name) : spaced(measure);
}

struct NamedFamily {
  std::string name, asks;
};

/// Those that occur: known ones in their order, then the others.
std::vector<NamedFamily> familiesOf(const StabilityResults& results) {
  std::vector<NamedFamily> found;
  const auto occurs = [&](std::string_view name) {
    return std::ranges::any_of(
        results.cases, [&](const HardCase& hard) { return familyOf(hard.measure) == name; });
  };
  const auto add = [&](std::string name, std::string_view asks) {
    if (std::ranges::find(found, name, &NamedFamily::name) == found.end())
      found.push_back({std::move(name), std::string(asks)});
  };
  for (const Family& family : families)
    if (occurs(family.name)) add(std::string(family.name), family.asks);
  for (const HardCase& hard : results.cases) add(familyOf(hard.measure), hard.what);
  return found;
}

/// How an engine came through the cases of one family.
struct FamilyTally {
  std::size_t stable = 0, judged = 0, refused = 0, notRun = 0;
  const StabilityRun* worst = nullptr;
  std::string anchor;
};

FamilyTally familyTally(const StabilityResults& results, const std::string& engine,
                        const std::string& family) {
  FamilyTally tally;
  const std::vector<HardGroup> groups = hardGroups(results);
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const HardCase* variant : groups[g].variants) {
      if (familyOf(variant->measure) != family) continue;
      const StabilityRun* run = runOf(results, engine, *variant);
      if (!run) continue;
      tally.refused += run->verdict == Verdict::notApplicable;
      tally.notRun += run->verdict == Verdict::notMeasured;
      if (!isJudged(run->verdict)) continue;
      ++tally.judged;
      tally.stable += run->verdict == Verdict::pass;
      if (!tally.worst || isWorse(*run, *tally.worst)) {
        tally.worst = run;
        tally.anchor = fmt::format("case_{}", g + 1);
      }
    }
  return tally;
}

OverviewCell familyCell(const FamilyTally& tally) {
  OverviewCell cell{Verdict::notMeasured, {}, "stable runs", {}, {}, tally.anchor};
  if (!tally.worst) {
    if (tally.refused > 0 && tally.notRun == 0) cell.verdict = Verdict::notApplicable;
    return cell;
  }
  cell.value = static_cast<double>(tally.stable);
  cell.shown = fmt::format("{} of {}", tally.stable, tally.judged);
  if (tally.notRun > 0) cell.words = fmt::format("{} not run", tally.notRun);
  cell.verdict = tally.worst->verdict;
  if (cell.verdict != Verdict::pass) cell.words = spaced(tally.worst->name);
  return cell;
}

std::string stableEngines(const StabilityResults& results) {
  const char* const same = areTransforms(results) ? "the same" : "stable";
  SaidOf said;
  for (const EngineRow& engine : results.engines) {
    std::size_t stable = 0, degraded = 0, unstable = 0, notRun = 0;
    for (const StabilityRun& run : results.runs) {
      if (run.engine != engine.name) continue;
      stable += run.verdict == Verdict::pass;
      degraded += run.verdict == Verdict::borderline;
      unstable += run.verdict == Verdict::fail;
      notRun += run.verdict == Verdict::notMeasured;
    }
    const std::size_t judged = stable + degraded + unstable;
    const std::size_t all = judged + notRun;
    said.add(engine.name,
             judged == 0     ? "nothing could be judged"
             : stable == all ? fmt::format("{} {}", allOf(judged, "run"), same)
                             : fmt::format("{} of {} runs {}{}", stable, all, same,
                                           notRun == 0 ? "" : fmt::format(", {} not run", notRun)));
  }
  std::string sentence;
  for (const auto& [words, engines] : said.all())
    sentence += fmt::format("{}{}: {}", sentence.empty() ? "" : "; ", listed(engines), words);
  return sentence + ".";
}

/// Transformed cases that run differently, engine by engine.
std::string differentTransforms(const StabilityResults& results) {
  SaidOf said;
  for (const EngineRow& engine : results.engines) {
    std::vector<std::string> broken;
    for (const StabilityRun& run : results.runs)
      if (run.engine == engine.name && run.verdict == Verdict::fail)
        broken.push_back(fmt::format("{} {}", spaced(run.name), run.variant));
    if (!broken.empty()) said.add(engine.name, listedShortly(broken, 3));
  }
  std::string sentence;
  for (const auto& [names, engines] : said.all())
    sentence += fmt::format("{}{} with {}", sentence.empty() ? "" : "; ", listed(engines), names);
  return sentence.empty() ? sentence
                          : fmt::format("Different after a transformation: {}.", sentence);
}

/// Cases in which engines are unstable, engine by engine.
std::string unstableCases(const StabilityResults& results) {
  if (areTransforms(results)) return differentTransforms(results);
  SaidOf said;
  for (const EngineRow& engine : results.engines) {
    std::vector<std::string> unstable;
    for (const HardGroup& group : hardGroups(results))
      if (const StabilityRun* run = worstRun(results, engine.name, group);
          run && run->verdict == Verdict::fail)
        unstable.push_back(spaced(group.name));
    if (!unstable.empty()) said.add(engine.name, listedShortly(unstable, 3));
  }
  if (said.empty()) return {};
  std::string sentence;
  for (const auto& [names, engines] : said.all())
    sentence += fmt::format("{}{} in {}", sentence.empty() ? "" : "; ", listed(engines), names);
  return fmt::format("Unstable: {}.", sentence);
}

std::string stabilityNextStep(const StabilityResults& results) {
  const auto has = [&](Verdict verdict) {
    return std::ranges::find(results.runs, verdict, &StabilityRun::verdict) != results.runs.end();
  };
  if (areTransforms(results)) {
    if (has(Verdict::fail))
      return "Next: see after which step and by how much; what depends on how a scene is expressed "
             "comes from the engine.";
    if (has(Verdict::notMeasured))
      return "Next: the same command with a larger --budget, for what was not run.";
    if (has(Verdict::pass)) return "All transformations change no more than rounding does.";
  }
  if (has(Verdict::fail))
    return "Next: avoid scenes like these with those engines, or see from which step on the limit "
           "is passed.";
  if (has(Verdict::borderline))
    return "Next: see whether what is degraded is more than your scene can bear.";
  if (has(Verdict::pass)) return "Nothing here speaks against any of these engines.";
  return "Nothing was judged: every run was refused.";
}

}  // namespace

bool areTransforms(const StabilityResults& results) {
  return !results.cases.empty() && std::ranges::all_of(results.cases, [](const HardCase& one) {
    const Family* family = known(one.measure);
    return family && family->transform;
  });
}

Overview stabilityOverview(const StabilityResults& results) {
  Overview overview;
  if (areTransforms(results))
    overview.states = {{Verdict::pass, "the same, but for rounding"},
                       {Verdict::fail, "different"},
                       {Verdict::notApplicable, "cannot be done"}};
  else
    overview.states = {{Verdict::pass, "all stable"},
                       {Verdict::borderline, "some degraded"},
                       {Verdict::fail, "some unstable"},
                       {Verdict::notApplicable, "refused"}};
  const std::vector<NamedFamily> all = familiesOf(results);
  for (const NamedFamily& family : all)
    overview.columns.push_back({family.name, family.asks, "matrix"});
  for (const EngineRow& engine : results.engines) {
    OverviewRow row{engine.name, true, {}};
    for (const NamedFamily& family : all)
      row.cells.push_back(familyCell(familyTally(results, engine.name, family.name)));
    overview.rows.push_back(std::move(row));
  }
  overview.conclusion =
      nonEmpty({stableEngines(results), unstableCases(results), stabilityNextStep(results)});
  return overview;
}

std::vector<HardGroup> hardGroups(const StabilityResults& results) {
  std::vector<HardGroup> groups;
  for (const HardCase& variant : results.cases) {
    auto group = std::ranges::find(groups, variant.name, &HardGroup::name);
    if (group == groups.end()) group = groups.insert(groups.end(), {variant.name, {}});
    group->variants.push_back(&variant);
  }
  return groups;
}

const StabilityRun* runOf(const StabilityResults& results, const std::string& engine,
                          const HardCase& variant) {
  const auto found = std::ranges::find_if(results.runs, [&](const StabilityRun& run) {
    return run.engine == engine && run.name == variant.name && run.variant == variant.variant;
  });
  return found == results.runs.end() ? nullptr : &*found;
}

bool isWorse(const StabilityRun& run, const StabilityRun& than) {
  const auto badness = [](const StabilityRun& one) {
    const double value = one.value.value_or(0.0);
    return std::pair(one.verdict, one.limit > 0.0 ? value / one.limit : value);
  };
  return badness(run) > badness(than);
}

const StabilityRun* worstRun(const StabilityResults& results, const std::string& engine,
                             const HardGroup& group) {
  const StabilityRun* worst = nullptr;
  for (const HardCase* variant : group.variants) {
    const StabilityRun* run = runOf(results, engine, *variant);
    if (run && (!worst || isWorse(*run, *worst))) worst = run;
  }
  return worst;
}

}  // namespace crossgrain::reports
