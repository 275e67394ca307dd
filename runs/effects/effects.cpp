#include "runs/effects/effects.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "adapters/law_options.hpp"
#include "adapters/suitability.hpp"
#include "cases/couette.hpp"
#include "runs/common/records.hpp"
#include "runs/couette/agreement_table.hpp"
#include "runs/couette/campaign.hpp"
#include "runs/effects/changes.hpp"

namespace crossgrain::inline runs {

using nlohmann::json;

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

}  // namespace

std::string switchRefusal(const Capabilities& can, const Case& setup, const EffectSwitch& off) {
  const Scene whole = couetteScene(setup, {}, 0.0), switched = couetteScene(off.without, {}, 0.0);
  if (whole.precision != switched.precision)
    return can.precisions.size() > 1
               ? std::string()
               : fmt::format("runs in {} only", toString(can.precisions.front()));
  const auto differs = mismatches(can, whole);
  const Adapted adapted = adaptScene(can, whole, setup.run.mayDiffer);
  if (off.effect && !simulatedEffects(can, adapted.scene).contains(*off.effect))
    return fmt::format("has no {}", toString(*off.effect));
  for (const Mismatch& mismatch : mismatches(can, switched))
    if (!find(differs, mismatch.name)) return mismatch.reason;
  return fixedOption(differs, whole.law, switched.law);
}

namespace {

/// One engine with one thing switched off, or nothing (`off` null), and why not if it cannot.
struct PlannedLeg {
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
    planLegs();
    timeLegs();
    campaign_.run(legsThatRun());
  }

  /// What run() would do.
  std::string plan(const RunCommand& command) {
    campaign_.askEngines();
    campaign_.lookForPackings();
    planLegs();
    std::vector<PlannedWork> works = campaign_.plan(legsThatRun());
    for (const PlannedLeg& leg : legs_)
      if (!leg.refusal.empty())
        works.push_back(
            {fmt::format("{} without {}", campaign_.engines()[leg.engine].name, leg.without()),
             "runs", leg.refusal});
    for (std::size_t e = 0; e < campaign_.engines().size(); ++e) {
      if (!campaign_.refusal(e).empty()) continue;
      PlannedWork timing{campaign_.engines()[e].name, "timing of steps"};
      count(timing, campaign_.store().find(timingName(e), timingKey(e)));
      works.push_back(timing);
    }
    return dryRunInWords(campaign_.planHead(), works, campaign_.store(), command);
  }

  json results() const {
    json results = campaign_.results("effects");
    results["switches"] = json::array();
    for (const EffectSwitch& off : switches_)
      results["switches"].push_back({{"effect", off.name}, {"what", off.what}});
    results["timing"] = {{"rounds", plan_.rounds}, {"seconds", plan_.seconds}};
    results["legs"] = json::array();
    for (const PlannedLeg& leg : legs_) {
      results["legs"].push_back(legJson(leg, results["runs"]));
      json ensemble =
          ensembleOf(results["runs"], campaign_.engines()[leg.engine].name, leg.without());
      if (ensemble.is_null()) continue;
      if (leg.off) ensemble["without"] = leg.without();
      results["ensemble"].push_back(std::move(ensemble));
    }
    for (json& run : results["runs"])  // what no part of this report shows; runs/ has it
      for (const char* bulky : {"series", "picture", "distributions"}) run.erase(bulky);
    return results;
  }

 private:
  const Case* caseOf(const PlannedLeg& leg) const { return leg.off ? &leg.off->without : &setup_; }

  std::vector<Leg> legsThatRun() const {
    std::vector<Leg> legs;
    for (const PlannedLeg& leg : legs_)
      if (leg.refusal.empty()) legs.push_back({leg.engine, leg.without(), caseOf(leg)});
    return legs;
  }

  std::string timingName(std::size_t e) const { return "timing-" + campaign_.engines()[e].name; }
  CaseKeys timingKey(std::size_t e) const {
    return campaign_.keyOf(e, 0,
                           fmt::format("timing {} rounds of {} s", plan_.rounds, plan_.seconds));
  }

  void planLegs() {
    for (std::size_t e = 0; e < campaign_.engines().size(); ++e) {
      if (!campaign_.refusal(e).empty()) continue;
      legs_.push_back({e, nullptr, ""});
      const auto& can = campaign_.capabilities(e);
      for (const EffectSwitch& off : switches_)
        if (can) legs_.push_back({e, &off, switchRefusal(*can, setup_, off)});
    }
  }

  void timeLegs() {
    const std::size_t engines = campaign_.engines().size();
    campaign_.progress().begin("timing steps", std::vector<double>(engines, 1.0));
    for (std::size_t e = 0; e < engines; ++e) timeEngine(e);
  }

  void timeEngine(std::size_t e) {
    const std::string& name = campaign_.engines()[e].name;
    std::vector<const PlannedLeg*> timed;
    for (const PlannedLeg& leg : legs_)
      if (leg.engine == e && leg.refusal.empty()) timed.push_back(&leg);
    if (timed.empty()) return;
    const std::string kept = timingName(e);
    const CaseKeys key = timingKey(e);
    json times = campaign_.store().find(kept, key).value_or(json::array());
    if (times.empty()) {
      std::vector<TimedLeg> legs;
      for (const PlannedLeg* leg : timed) legs.push_back(timedLeg(*leg));
      bool failed = false;
      for (const StepTimes& one : timeSteps(legs, plan_, [&](double fraction) {
             campaign_.progress().update(e, "timing " + name, fraction);
           })) {
        times.push_back(toJson(one));
        failed = failed || !one.failure.empty();
      }
      if (!failed) campaign_.store().keep(kept, key, times);
    }
    for (std::size_t k = 0; k < timed.size(); ++k)
      times_[timed[k]] = stepTimesFromJson(times.at(k));
    campaign_.progress().finish(e, "timed " + name);
  }

  TimedLeg timedLeg(const PlannedLeg& leg) {
    const EngineEntry& entry = campaign_.engines()[leg.engine];
    const Case& setup = *caseOf(leg);
    const auto scratch =
        campaign_.store().scratch(fmt::format("time-{}-{}", entry.name, leg.without()));
    TimedLeg timed;
    timed.engine = startEngine(entry, scratch, setup.run.timeout);
    timed.load = [this, &entry, &setup, engine = timed.engine.get()] {
      const Scene scene = couetteScene(setup, campaign_.packings().front(), campaign_.dt());
      return loadScene(*engine, entry, setup, scene).dt;
    };
    return timed;
  }

  json legJson(const PlannedLeg& leg, const json& runs) const {
    const std::string& engine = campaign_.engines()[leg.engine].name;
    json row = {{"engine", engine},
                {"effect", leg.without()},
                {"status", leg.refusal.empty() ? "ran" : "refused"},
                {"reason", leg.refusal}};
    if (!leg.refusal.empty()) return row;
    if (const auto found = times_.find(&leg); found != times_.end())
      addTimes(row, leg, found->second);
    for (const json& run : runs)
      if (run["engine"] == engine && run.value("without", "") == leg.without()) addRun(row, run);
    if (leg.off) row.update(effectChanges(setup_, runs, engine, leg.without()));
    return row;
  }

  void addTimes(json& row, const PlannedLeg& leg, const StepTimes& times) const {
    row["step_s"] = toJson(shortestStep(times));
    row["contacts_per_step"] = toJson(times.contacts);
    if (!times.failure.empty()) {
      row["status"] = "failed";
      row["reason"] = times.failure;
    }
    for (const auto& [other, whole] : times_) {
      if (other->engine != leg.engine || other->off) continue;
      const auto ratio = timeRatio(times, whole);
      row["time_ratio"] = ratio ? json(ratio->value) : json(nullptr);
      row["time_ratio_stderr"] = ratio ? toJson(ratio->standardError) : json(nullptr);
    }
  }

  /// A run that failed is the leg's trouble; of one that finished the leg tells what was simulated.
  static void addRun(json& row, const json& run) {
    if (run["status"] == "failed" && row["status"] == "ran") {
      row["status"] = "failed";
      row["reason"] = run["reason"];
    }
    if (run["status"] != "finished") return;
    row["precision"] = run["realised"]["precision"];
    row["effects"] = run["realised"]["effects"];
  }

  const Case& setup_;
  TimingPlan plan_;
  std::vector<EffectSwitch> switches_;
  Campaign campaign_;
  std::vector<PlannedLeg> legs_;
  std::map<const PlannedLeg*, StepTimes> times_;
};

}  // namespace

json measureEffects(const Case& setup, const RunCommand& command, RunStore& store,
                    const TimingPlan& plan) {
  checkEngineSections(setup);
  EffectCampaign campaign(setup, command, store, plan);
  campaign.run();
  return campaign.results();
}

std::string effectsPlan(const Case& setup, const RunCommand& command, RunStore& store,
                        const TimingPlan& plan) {
  checkEngineSections(setup);
  return EffectCampaign(setup, command, store, plan).plan(command);
}

}  // namespace crossgrain::inline runs
