#include "runs/cost/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <chrono>

#include "cases/couette.hpp"
#include "runs/cost/kept.hpp"
#include "runs/cost/trajectory.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline runs {

namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

Engine& Workers::of(std::size_t engine) {
  auto& worker = running_[engine];
  const EngineEntry& entry = campaign_.engines()[engine];
  if (!worker) worker = startNew(entry, campaign_.store().scratch(entry.name), timeout_);
  return *worker;
}

CostStudy::CostStudy(const Case& of, const RunCommand& command, RunStore& store)
    : setup(of),
      jobs(command.jobs),
      campaign(setup, command, selectEngines(command.engines), store),
      workers(campaign, setup.run.timeout),
      engines(campaign.engines().size()),
      inHouse(engineRegistry().front()),
      inHouseEngine(inHouse.make()) {
  costContactTime(setup);  // throws, before anything runs, for a law without one
}

void CostStudy::ask() {
  campaign.askEngines();
  campaign.lookForPackings();
  for (std::size_t e = 0; e < engines.size(); ++e)
    if (const auto& can = campaign.capabilities(e)) listSettings(e, *can);
}

void CostStudy::prepare() {
  campaign.askEngines();
  campaign.preparePackings();
  campaign.timeEngines();
  campaign.progress().begin("timing starts and steps", std::vector<double>(engines.size(), 1.0));
  for (std::size_t e = 0; e < engines.size(); ++e) {
    throwIfInterrupted();
    const auto& can = campaign.capabilities(e);
    if (!campaign.refusal(e).empty()) continue;
    try {
      timeStart(e);
    } catch (const EngineFailure& failure) {
      engineFailures.push_back(failure.what());
      continue;
    }
    if (!can) continue;
    listSettings(e, *can);
    engines[e].takesPart = true;
    campaign.progress().finish(
        e, fmt::format("{}: {:.3g} µs a step", entryOf(e).name, 1e6 * engines[e].step));
  }
  timeInHouse();
}

void CostStudy::listSettings(std::size_t engine, const Capabilities& can) {
  for (const CostKind kind : costKinds)
    if (std::ranges::find(setup.cost.kinds, kind) != setup.cost.kinds.end())
      engines[engine].settings[static_cast<std::size_t>(kind)] =
          costSettings(setup, kind, entryOf(engine).name, can);
}

void CostStudy::timeStart(std::size_t engine) {
  constexpr int warmUp = 50, steps = 200;
  TimedEngine& timed = engines[engine];
  const Clock::time_point start = Clock::now();
  Engine& worker = workers.of(engine);
  worker.capabilities();
  timed.start = secondsSince(start);
  const Scene scene = couetteScene(setup, campaign.packings().front(), campaign.dt());
  const Clock::time_point load = Clock::now();
  const double dt = loadScene(worker, entryOf(engine), setup, scene).dt;
  timed.load = secondsSince(load);
  worker.advance(warmUp * dt);
  const double before = worker.stats().wallSeconds;
  worker.advance((warmUp + steps) * dt);
  timed.step = (worker.stats().wallSeconds - before) / steps;
}

void CostStudy::timeInHouse() {
  constexpr int steps = 2000;
  const Scene scene = couetteScene(setup, campaign.packings().front(), campaign.dt());
  const Track track = followPacking(*inHouseEngine, inHouse, setup, scene, {steps * campaign.dt()});
  inHouseStep = track.wallSeconds / static_cast<double>(track.steps);
}

std::vector<std::string> CostStudy::engineNames() const {
  std::vector<std::string> names;
  for (const EngineEntry& entry : campaign.engines()) names.push_back(entry.name);
  return names;
}

double CostStudy::stepOf(std::size_t engine, const Case& of) const {
  return engineStep(of, entryOf(engine).name, *campaign.capabilities(engine));
}

std::string CostStudy::nameOf(const PlannedPoint& point, int packing) const {
  const CostSetting& setting = settingOf(point);
  std::string what = fmt::format("{}-{}", setting.knob, setting.setting);
  std::ranges::replace_if(
      what, [](unsigned char c) { return !std::isalnum(c) && c != '.' && c != '_'; }, '-');
  return fmt::format("{}-{}-{}-p{}", toString(point.kind), entryOf(point.engine).name, what,
                     packing);
}

CaseKeys CostStudy::keyOf(const PlannedPoint& point, int packing) const {
  return campaign.keyOf(
      point.engine, packing,
      fmt::format("cost: {} {}", toString(point.kind), settingOf(point).fragment));
}

CaseKeys CostStudy::inHouseKey(std::size_t packing, const std::string& part) const {
  CaseKeys key = runKey(setup, inHouse.name, inHouseEngine->capabilities().version);
  key["packing"] = campaign.packings()[packing].hash;
  key["part"] = part;
  return key;
}

bool CostStudy::isKept(const PlannedPoint& point) const {
  if (settingOf(point).windowsOnly)
    return campaign.store().find(windowsName(point), keyOf(point, 0)).has_value();
  const int last =
      point.kind == CostKind::averages ? static_cast<int>(campaign.packings().size()) - 1 : 0;
  return knownFailure(point) || campaign.store().find(nameOf(point, last), keyOf(point, last));
}

std::optional<std::string> CostStudy::knownFailure(const PlannedPoint& point) const {
  const auto kept =
      findAs<KeptFailure>(campaign.store(), nameOf(point, 0) + "-failed", keyOf(point, 0));
  return kept ? std::optional(kept->reason) : std::nullopt;
}

void CostStudy::keepFailure(const PlannedPoint& point, const std::string& reason) const {
  campaign.store().keep(nameOf(point, 0) + "-failed", keyOf(point, 0), jsonOf(KeptFailure{reason}));
}

}  // namespace crossgrain::inline runs
