#include "runs/cost/campaign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <set>

#include "cases/couette.hpp"
#include "cases/time_step.hpp"
#include "runs/common/records.hpp"
#include "runs/cost/averages.hpp"
#include "runs/couette/run.hpp"
#include "support/bad_input.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline runs {

using nlohmann::json;

namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

constexpr CostKind allKinds[] = {CostKind::collision, CostKind::trajectory, CostKind::averages};

}  // namespace

Engine& Workers::of(std::size_t engine) {
  auto& worker = running_[engine];
  const EngineEntry& entry = campaign_.engines()[engine];
  if (!worker) worker = startEngine(entry, campaign_.store().scratch(entry.name), timeout_);
  return *worker;
}

CostCampaign::CostCampaign(const Case& setup, const CaseWith& caseWith, const CostRequest& request,
                           RunStore& store)
    : setup_(setup),
      caseWith_(caseWith),
      request_(request),
      campaign_(setup, request.run, selectEngines(request.run.engines), store),
      workers_(campaign_, setup.run.timeout),
      engines_(campaign_.engines().size()),
      inHouse_(engineRegistry().front()),
      inHouseEngine_(inHouse_.make()),
      overhead_(engines_.size(), 0.0) {
  costContactTime(setup);  // throws, before anything runs, for a law without one
}

bool CostCampaign::wants(CostKind kind) const {
  return std::ranges::find(setup_.cost.kinds, toString(kind)) != setup_.cost.kinds.end();
}

bool CostCampaign::sharesRuns(const CostSetting& setting) {
  return setting.knob == "method" || setting.knob == "snapshots";
}

const CostSetting& CostCampaign::settingOf(const PlannedPoint& point) const {
  return engines_[point.engine].settings[static_cast<std::size_t>(point.kind)][point.setting];
}

void CostCampaign::prepare() {
  campaign_.askEngines();
  campaign_.preparePackings();
  campaign_.timeEngines();
  campaign_.progress().begin("timing starts and steps", std::vector<double>(engines_.size(), 1.0));
  for (std::size_t e = 0; e < engines_.size(); ++e) {
    throwIfInterrupted();
    const auto& can = campaign_.capabilities(e);
    if (!campaign_.refusal(e).empty()) continue;
    try {
      timeStart(e);
    } catch (const EngineFailure& failure) {
      engineFailures_.push_back(failure.what());
      continue;
    }
    if (!can) continue;
    listSettings(e, *can);
    engines_[e].takesPart = true;
    campaign_.progress().finish(
        e, fmt::format("{}: {:.3g} µs a step", entryOf(e).name, 1e6 * engines_[e].step));
  }
  measureChaos();
}

void CostCampaign::listSettings(std::size_t engine, const Capabilities& can) {
  for (const CostKind kind : allKinds)
    if (wants(kind))
      engines_[engine].settings[static_cast<std::size_t>(kind)] =
          costSettings(setup_, kind, entryOf(engine).name, can, caseWith_);
}

void CostCampaign::timeStart(std::size_t engine) {
  constexpr int warmUp = 50, steps = 200;
  EngineState& state = engines_[engine];
  const Clock::time_point start = Clock::now();
  Engine& worker = workers_.of(engine);
  worker.capabilities();
  state.start = secondsSince(start);
  const Scene scene = couetteScene(setup_, campaign_.packings().front(), campaign_.dt());
  const Clock::time_point load = Clock::now();
  const double dt = loadScene(worker, entryOf(engine), setup_, scene).dt;
  state.load = secondsSince(load);
  worker.advance(warmUp * dt);
  const double before = worker.stats().wallSeconds;
  worker.advance((warmUp + steps) * dt);
  state.step = (worker.stats().wallSeconds - before) / steps;
}

void CostCampaign::measureChaos() {
  const Clock::time_point start = Clock::now();
  constexpr int steps = 2000;
  const Scene scene = couetteScene(setup_, campaign_.packings().front(), campaign_.dt());
  const Track track =
      followPacking(*inHouseEngine_, inHouse_, setup_, scene, {steps * campaign_.dt()});
  inHouseStep_ = track.wallSeconds / static_cast<double>(track.steps);
  if (!wants(CostKind::trajectory)) return;
  const Capabilities can = inHouseEngine_->capabilities();
  const CaseKeys key = inHouseKey(0, "cost: chaos");
  if (const auto kept = campaign_.store().find("chaos", key)) {
    chaos_ = chaosStudyFromJson(*kept);
    return;
  }
  const double steps0 = setup_.cost.trajectoryReference;
  chaos_ = studyChaos(*inHouseEngine_, inHouse_, setup_,
                      caseWith_(stepFragment(setup_, inHouse_.name, can, steps0)),
                      caseWith_(stepFragment(setup_, inHouse_.name, can, steps0 / 2.0)),
                      campaign_.packings().front());
  campaign_.store().keep("chaos", key, toJson(chaos_));
  campaign_.progress().say(fmt::format("chaos: window {:.3g} s ({}), {:.2g} s",
                                       chaos_.window.length, chaos_.window.why,
                                       secondsSince(start)));
}

double CostCampaign::stepOf(std::size_t engine, const Case& setup) const {
  return engineStep(setup, entryOf(engine).name, *campaign_.capabilities(engine));
}

double CostCampaign::predicted(std::size_t engine, CostKind kind,
                               const CostSetting& setting) const {
  const EngineState& state = engines_[engine];
  const Cost& cost = setup_.cost;
  const double dt = stepOf(engine, setting.setup);
  if (kind == CostKind::collision) {
    // 2.5 t_c and some steps, of fewer disks than the packing has: an upper bound.
    const double once = (2.5 * costContactTime(setting.setup) / dt + 21.0) * state.step;
    return collisionPhases * once + cost.repeats * std::max(1.3 * cost.timed, once) +
           (collisionPhases + cost.repeats) * state.load;
  }
  if (kind == CostKind::trajectory) {
    const double once = chaos_.window.length / dt * state.step;
    const double runs = once < 10.0 * cost.timed ? cost.repeats : 1;
    return runs * (once + state.load);
  }
  if (sharesRuns(setting)) return 0.0;
  const Averaging& averaging = setting.setup.averaging;
  const double length =
      (averaging.settleRotations + averaging.rotations) * rotationTime(setting.setup);
  constexpr double look = 1e-3;
  return static_cast<double>(campaign_.packings().size()) *
         (length / dt * state.step + state.load +
          look * averaging.rotations * averaging.snapshotsPerRotation);
}

void CostCampaign::plan() {
  const double contact = costContactTime(setup_);
  const double window = chaos_.window.length;
  double referenceLeftOut = 0.0;
  if (wants(CostKind::averages)) {
    const double length =
        (setup_.averaging.settleRotations + setup_.averaging.rotations) * rotationTime(setup_);
    const double takes =
        length * setup_.cost.averageReference / contact * inHouseStep_ *
        static_cast<double>(missingReferences()) /
        std::min<double>(request_.run.jobs, static_cast<double>(campaign_.packings().size()));
    constexpr double largestShare = 0.8;
    if (takes > largestShare * request_.budget)
      noAverages_ = fmt::format("the reference alone would take about {:.3g} s of {:.3g} s", takes,
                                request_.budget);
    else
      common_ += takes;
    if (!noAverages_.empty()) referenceLeftOut = takes / largestShare;
  }
  bool newTrajectories = false;
  for (std::size_t e = 0; e < engines_.size(); ++e) {
    const EngineState& state = engines_[e];
    bool ownTrajectories = false;
    std::set<std::string> integrators;
    for (const CostSetting& setting : state.settings[1])
      if (setting.refusal.empty()) integrators.insert(integratorOf(setting));
    if (entryOf(e).name == inHouse_.name) integrators.erase("");  // it is the common one
    for (const CostKind kind : allKinds) {
      const auto& settings = state.settings[static_cast<std::size_t>(kind)];
      for (std::size_t s = 0; s < settings.size(); ++s) {
        PlannedPoint point{e, kind, s, 0.0, {}};
        if (settings[s].refusal.empty() && !isKept(point)) {
          point.seconds = predicted(e, kind, settings[s]);
          ownTrajectories |= kind == CostKind::trajectory;
        }
        plan_.push_back(point);
      }
    }
    if (ownTrajectories)
      overhead_[e] = static_cast<double>(integrators.size()) * 1.5 *
                     setup_.cost.trajectoryReference * window / contact * state.step;
    newTrajectories |= ownTrajectories;
  }
  if (newTrajectories)
    common_ += 1.5 * setup_.cost.trajectoryReference * window / contact * inHouseStep_;
  const std::vector<double> shares = fitIntoBudget(plan_, overhead_, request_.budget - common_);
  for (std::size_t e = 0; e < engines_.size(); ++e) engines_[e].share = shares[e];
  // A window's reference that does not fit takes the trajectories with it.
  std::vector<std::string> names;
  for (const EngineEntry& entry : campaign_.engines()) names.push_back(entry.name);
  for (PlannedPoint& point : plan_) {
    const bool open = point.seconds > 0.0;
    if (point.kind == CostKind::trajectory && open &&
        overhead_[point.engine] > shares[point.engine])
      point.undecided =
          undecidedReason(overhead_[point.engine], shares[point.engine], shares[point.engine]);
    if (point.kind == CostKind::averages && !noAverages_.empty()) point.undecided = noAverages_;
  }
  budgetForTheRest_ = referenceLeftOut + budgetOfLeftOut(plan_, overhead_);
  if (request_.tellPlan)
    request_.tellPlan(planInWords(plan_, names, overhead_, common_, request_.budget));
}

bool CostCampaign::isKept(const PlannedPoint& point) const {
  const int last =
      point.kind == CostKind::averages ? static_cast<int>(campaign_.packings().size()) - 1 : 0;
  return knownFailure(point) || campaign_.store().find(nameOf(point, last), keyOf(point, last));
}

std::optional<std::string> CostCampaign::knownFailure(const PlannedPoint& point) const {
  const auto kept = campaign_.store().find(nameOf(point, 0) + "-failed", keyOf(point, 0));
  return kept ? std::optional(kept->at("reason").get<std::string>()) : std::nullopt;
}

/// By what it is, not by its place in lists that may grow: "averages-grain-time_step-t_c-50-p0".
std::string CostCampaign::nameOf(const PlannedPoint& point, int packing) const {
  const CostSetting& setting = settingOf(point);
  std::string what = fmt::format("{}-{}", setting.knob, setting.setting);
  std::ranges::replace_if(
      what, [](unsigned char c) { return !std::isalnum(c) && c != '.' && c != '_'; }, '-');
  return fmt::format("{}-{}-{}-p{}", toString(point.kind), entryOf(point.engine).name, what,
                     packing);
}

CaseKeys CostCampaign::inHouseKey(std::size_t packing, const std::string& part) const {
  CaseKeys key = runKey(setup_, inHouse_.name, inHouseEngine_->capabilities().version);
  key["packing"] = campaign_.packings()[packing].hash;
  key["part"] = part;
  return key;
}

CaseKeys CostCampaign::keyOf(const PlannedPoint& point, int packing) const {
  return campaign_.keyOf(
      point.engine, packing,
      fmt::format("cost: {} {}", toString(point.kind), settingOf(point).fragment));
}

namespace {

void checkEngineNames(const Case& setup) {
  checkEngineSections(setup);
  for (const auto& [name, values] : setup.cost.settings)
    if (!findEngine(name))
      throw BadInput(fmt::format("{}: [cost.settings.{}]: there is no such engine",
                                 setup.file.string(), name));
}

}  // namespace

std::string costPlan(const Case& setup, const CaseWith& caseWith, const CostRequest& request,
                     RunStore& store) {
  checkEngineNames(setup);
  return CostCampaign(setup, caseWith, request, store).dryRun();
}

json measureCost(const Case& setup, const CaseWith& caseWith, const CostRequest& request,
                 RunStore& store) {
  checkEngineNames(setup);
  CostCampaign campaign(setup, caseWith, request, store);
  campaign.prepare();
  campaign.plan();
  campaign.measure();
  return campaign.results();
}

}  // namespace crossgrain::inline runs
