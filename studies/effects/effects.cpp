#include "studies/effects/effects.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "adapters/suitability.hpp"
#include "cases/flow.hpp"
#include "law/law_options.hpp"
#include "results/schema.hpp"
#include "studies/core/study.hpp"
#include "studies/flow/campaign.hpp"
#include "studies/flow/ensemble.hpp"

namespace crossgrain::inline studies {

namespace {

const Mismatch* find(const std::vector<Mismatch>& mismatches, const std::string& name) {
  const auto found = std::ranges::find(mismatches, name, &Mismatch::name);
  return found == mismatches.end() ? nullptr : &*found;
}

/// An option that the switch would change and in which the engine differs from the case anyway.
std::string fixedOption(const std::vector<Mismatch>& differs, const ContactLaw& law,
                        const ContactLaw& switched) {
  for (const LawOption& option : lawOptions()) {
    const std::string name(option.name);
    if (lawOptionValue(law, name) != lawOptionValue(switched, name))
      if (const Mismatch* always = find(differs, name)) return always->reason;
  }
  return {};
}

template <int D>
std::string refusalOf(const Capabilities& can, const Case& setup, const EffectSwitch& off) {
  const SceneOf<D> whole = unplacedScene<D>(setup, 0.0),
                   switched = unplacedScene<D>(off.without, 0.0);
  if (whole.precision != switched.precision)
    return can.precisions.size() > 1
               ? std::string()
               : fmt::format("runs in {} only", toString(can.precisions.front()));
  const auto differs = mismatches(can, whole);
  const auto adapted = adaptScene(can, whole, setup.run.mayDiffer);
  if (off.effect && !simulatedEffects(can, adapted.scene).contains(*off.effect))
    return fmt::format("has no {}", toString(*off.effect));
  for (const Mismatch& mismatch : mismatches(can, switched))
    if (!find(differs, mismatch.name)) return mismatch.reason;
  return fixedOption(differs, whole.law, switched.law);
}

}  // namespace

std::string switchRefusal(const Capabilities& can, const Case& setup, const EffectSwitch& off) {
  return inDimensionOf(setup, [&]<int D>() { return refusalOf<D>(can, setup, off); });
}

namespace {

/// One engine with one thing switched off, or nothing (`off` null), and why not if it cannot.
struct PlannedVariant {
  std::size_t engine;
  const EffectSwitch* off;
  std::string refusal;

  std::string without() const { return off ? off->name : std::string(); }
};

class EffectCampaign {
 public:
  EffectCampaign(const Case& setup, const RunCommand& command, RunStore& store,
                 const TimingPlan& plan)
      : setup_(setup),
        plan_(plan),
        switches_(effectSwitches(setup)),
        campaign_(setup, command, selectEngines(command.engines), store) {}

  void run() {
    campaign_.askEngines();
    campaign_.preparePackings();
    campaign_.timeEngines();
    planVariants();
    const auto tasks = timingTasks();
    const auto times = runOrLoad(tasks, campaign_.store(), campaign_.progress(), "timing steps", 1);
    for (std::size_t k = 0; k < tasks.size(); ++k) {
      std::size_t which = 0;
      for (const PlannedVariant* planned : variantsThatRun(tasks[k].of.engine))
        times_[idOf(*planned)] = times[k].at(which++);
    }
    // An engine's need of an effect shows when it is asked to: single precision in space, say.
    for (PlannedVariant& planned : variants_)
      if (const auto found = times_.find(idOf(planned));
          planned.off && found != times_.end() && found->second.refused)
        planned.refusal = found->second.failure;
    campaign_.run(asVariants(variantsThatRun()));
  }

  /// The work of run().
  std::string plan(const RunCommand& command) {
    campaign_.askEngines();
    campaign_.lookForPackings();
    planVariants();
    std::vector<PlannedWork> works = campaign_.plan(asVariants(variantsThatRun()));
    for (const PlannedVariant& planned : variants_)
      if (!planned.refusal.empty())
        works.push_back({fmt::format("{} without {}", nameOf(planned), planned.without()), "runs",
                         planned.refusal});
    for (PlannedWork& work : plannedWork(timingTasks(), "timing of steps", campaign_.store()))
      works.push_back(std::move(work));
    return describeDryRun(campaign_.planHead(), works, campaign_.store(), command);
  }

  EffectsResults results() const {
    EffectsResults results{campaign_.study(kindEffects), {}, {}, plan_, {}};
    for (const EffectSwitch& off : switches_) results.switches.push_back({off.name, off.what});
    for (const PlannedVariant& planned : variants_) {
      results.variants.push_back(variantOf(planned, results.runs));
      if (auto ensemble = ensembleOf(results.runs, nameOf(planned), planned.without()))
        results.ensemble.push_back(std::move(*ensemble));
    }
    for (FlowRun& run : results.runs) run.series.reset();  // no part of this report; runs/ has it
    return results;
  }

 private:
  const Case* caseOf(const PlannedVariant& planned) const {
    return planned.off ? &planned.off->without : &setup_;
  }
  const std::string& nameOf(const PlannedVariant& planned) const {
    return campaign_.engines()[planned.engine].name;
  }

  RunId idOf(const PlannedVariant& planned) const { return {nameOf(planned), planned.without()}; }

  /// Of one engine, or of all.
  std::vector<const PlannedVariant*> variantsThatRun(const std::string& engine = {}) const {
    std::vector<const PlannedVariant*> variants;
    for (const PlannedVariant& planned : variants_)
      if (planned.refusal.empty() && (engine.empty() || nameOf(planned) == engine))
        variants.push_back(&planned);
    return variants;
  }

  std::vector<Variant> asVariants(const std::vector<const PlannedVariant*>& planned) const {
    std::vector<Variant> variants;
    for (const PlannedVariant* one : planned)
      variants.push_back({one->engine, one->without(), caseOf(*one)});
    return variants;
  }

  void planVariants() {
    for (std::size_t e = 0; e < campaign_.engines().size(); ++e) {
      if (!campaign_.refusal(e).empty()) continue;
      variants_.push_back({e, nullptr, ""});
      const auto& can = campaign_.capabilities(e);
      for (const EffectSwitch& off : switches_)
        if (can) variants_.push_back({e, &off, switchRefusal(*can, setup_, off)});
    }
  }

  /// The variants of each engine against each other, one engine after the other.
  std::vector<CachedTask<std::vector<StepTimes>>> timingTasks() const {
    std::vector<CachedTask<std::vector<StepTimes>>> tasks;
    for (std::size_t e = 0; e < campaign_.engines().size(); ++e) {
      if (!campaign_.refusal(e).empty()) continue;
      const std::string name = campaign_.engines()[e].name;
      CachedTask<std::vector<StepTimes>> task;
      task.of = {name};
      task.name = "timing-" + name;
      task.label = "timing " + name;
      task.key = campaign_.keyOf(
          e, 0, fmt::format("timing {} rounds of {} s", plan_.rounds, plan_.seconds));
      task.work = [this, name](const std::function<void(double)>& progress) {
        std::vector<TimedVariant> timed;
        for (const PlannedVariant* one : variantsThatRun(name)) timed.push_back(timedVariant(*one));
        auto times = timeSteps(timed, plan_, progress);
        const bool finished = std::ranges::all_of(
            times, [](const StepTimes& each) { return each.failure.empty() || each.refused; });
        return CachedTask<std::vector<StepTimes>>::Outcome{std::move(times), finished, "done"};
      };
      tasks.push_back(std::move(task));
    }
    return tasks;
  }

  TimedVariant timedVariant(const PlannedVariant& planned) const {
    const EngineEntry& entry = campaign_.engines()[planned.engine];
    const Case& setup = *caseOf(planned);
    const auto scratch =
        campaign_.store().scratch(fmt::format("time-{}-{}", entry.name, planned.without()));
    TimedVariant timed;
    timed.start = [&entry, &setup, scratch] {
      return startEngine(entry, scratch, setup.run.timeout);
    };
    timed.load = [this, &entry, &setup](Engine& engine, int round) {
      const auto& packings = campaign_.packings();
      const Packing& packing = packings[static_cast<std::size_t>(round) % packings.size()];
      return inDimensionOf(setup, [&]<int D>() {
        return loadScene(engine, entry, setup, flowScene<D>(setup, packing, campaign_.dt())).dt;
      });
    };
    return timed;
  }

  EffectVariant variantOf(const PlannedVariant& planned, std::span<const FlowRun> runs) const {
    EffectVariant variant;
    variant.engine = nameOf(planned);
    variant.effect = planned.without();
    variant.reason = planned.refusal;
    if (!planned.refusal.empty()) {
      variant.status = Status::refused;
      return variant;
    }
    if (const auto found = times_.find(idOf(planned)); found != times_.end())
      addTimes(variant, found->second);
    for (const FlowRun& run : runs)
      if (run.engine == variant.engine && run.without == variant.effect) addRun(variant, run);
    if (planned.off) variant.changes = effectChanges(setup_, runs, variant.engine, variant.effect);
    return variant;
  }

  void addTimes(EffectVariant& variant, const StepTimes& times) const {
    variant.step = meanStep(times);
    variant.contacts = times.contacts;
    if (!times.failure.empty()) {
      variant.status = Status::failed;
      variant.reason = times.failure;
    }
    const auto whole = times_.find({variant.engine});
    const auto ratio = whole == times_.end() ? std::nullopt : timeRatio(times, whole->second);
    if (!ratio) return;
    variant.timeRatio = ratio->value;
    variant.timeRatioError = ratio->standardError;
  }

  /// A run that failed is its variant's trouble; one that finished says what was simulated.
  static void addRun(EffectVariant& variant, const FlowRun& run) {
    if (run.status == Status::failed && variant.status == Status::finished) {
      variant.status = Status::failed;
      variant.reason = run.reason;
    }
    if (!run.finished()) return;
    variant.precision = run.effective->precision;
    variant.effects.emplace();
    for (const Effect effect : run.effective->effects)
      variant.effects->emplace_back(toString(effect));
  }

  const Case& setup_;
  TimingPlan plan_;
  std::vector<EffectSwitch> switches_;
  Campaign campaign_;
  std::vector<PlannedVariant> variants_;
  std::map<RunId, StepTimes> times_;
};

TimingPlan timingOf(const CommandLine& line) {
  TimingPlan plan;
  if (line.quick) plan.seconds = 0.02;
  return plan;
}

Outcome outcomeOfEffects(const EffectsResults& results, const CommandLine& line,
                         const EffectsOptions&) {
  Outcome outcome{exitPassed, refusals(results.engines, line.run.engines)};
  for (const EffectVariant& variant : results.variants)
    if (variant.status == Status::failed) {
      outcome.failures.push_back(variant.reason);
      outcome.status = exitEngineFailed;
    }
  return outcome;
}

}  // namespace

const Study<EffectsOptions, EffectsResults> effectsStudy = {
    "effects",
    {.packings = true},
    Keeps::oneCase,
    [](EffectsOptions&, CommandLine&) { return std::vector<StudyOption>{}; },
    [](const CommandLine& line, EffectsOptions&) {
      return std::vector{onlyFlow(line, {"effects"})};
    },
    [](const StudyWork& work, const EffectsOptions&) {
      checkEngineSections(work.setup());
      return EffectCampaign(work.setup(), work.line.run, work.store, timingOf(work.line))
          .plan(work.line.run);
    },
    [](const StudyWork& work, const EffectsOptions&) {
      checkEngineSections(work.setup());
      EffectCampaign campaign(work.setup(), work.line.run, work.store, timingOf(work.line));
      campaign.run();
      return campaign.results();
    },
    outcomeOfEffects};

}  // namespace crossgrain::inline studies
