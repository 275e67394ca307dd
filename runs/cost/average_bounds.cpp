#include "runs/cost/average_bounds.hpp"

#include <algorithm>
#include <cmath>

#include "adapters/suitability.hpp"
#include "cases/couette.hpp"
#include "cases/loader.hpp"
#include "runs/common/engine_access.hpp"
#include "runs/cost/kept.hpp"
#include "runs/lockstep/changed_cases.hpp"
#include "runs/lockstep/rules.hpp"
#include "runs/lockstep/terms.hpp"

namespace crossgrain::inline runs {

bool AverageBounds::appliesTo(std::size_t engine, const CostSetting& setting) const {
  const auto& can = study_.campaign.capabilities(engine);
  return setting.sameLaw && can && hasNormalLaw(*can, study_.setup.law) &&
         study_.campaign.packings().size() > 1;
}

double AverageBounds::predicted(std::size_t engine, const CostSetting& setting) const {
  if (!appliesTo(engine, setting)) return 0.0;
  const TimedEngine& timed = study_.engines[engine];
  return quickLockstepStarts *
         (windowTimes(study_.setup).back() / study_.stepOf(engine, setting.setup) * timed.step +
          timed.load);
}

double AverageBounds::predictedReference(std::size_t engine) const {
  const TimedEngine& timed = study_.engines[engine];
  const Cost& cost = study_.setup.cost;
  const double contacts = windowTimes(study_.setup).back() / costContactTime(study_.setup);
  // The engine at its step and at twice that; the in-house one as it is and with k_n changed.
  const double own = 1.5 * contacts * cost.boundReference * timed.step + 2.0 * timed.load;
  const double inHouse = (1.0 + static_cast<double>(yardstickChanges.size())) * contacts *
                         cost.averageReference * study_.inHouseStep;
  return quickLockstepStarts * (own + inHouse);
}

std::size_t AverageBounds::constants() const {
  return changedCases(study_.setup).size();
}

void AverageBounds::respond(
    const std::vector<AveragedPacking>& reference,
    const std::function<std::vector<AveragedPacking>(const std::string& name, const Case& setup)>&
        runsOf) {
  const std::string whole = nameOf(allSamplings(study_.setup).front());
  for (const ChangedCase& changed : changedCases(study_.setup)) {
    const auto runs = runsOf(changed.name, changed.setup);
    for (const std::string& measure : averageMeasures()) {
      CostResponse response{measure, changed.constant, responseChange, {}, {}};
      if (const auto found = weakError(runs, whole, reference, whole, measure,
                                       1.0 - study_.setup.averaging.confidence)) {
        response.response = found->error;
        if (found->interval) response.bound = found->interval->high;
      }
      responses_.push_back(response);
    }
  }
}

std::optional<double> AverageBounds::bound(double equivalent, const std::string& measure) const {
  std::optional<double> largest;
  for (const CostResponse& response : responses_) {
    if (response.measure != measure) continue;
    if (!response.bound) return std::nullopt;
    largest = std::max(largest.value_or(0.0), equivalent / response.change * *response.bound);
  }
  return largest;
}

Case AverageBounds::at(std::size_t engine, double steps) const {
  return caseWith(study_.setup, stepFragment(study_.setup, study_.entryOf(engine).name,
                                             *study_.campaign.capabilities(engine), steps));
}

const std::vector<FlowState>& AverageBounds::states() {
  if (states_.empty())
    states_ = statesAlongTheFlow(study_.setup, study_.campaign.packings(), study_.campaign.dt(),
                                 quickLockstepStarts, [](double) {});
  return states_;
}

std::vector<Scene> AverageBounds::scenesOf(std::size_t engine) {
  const Capabilities& can = *study_.campaign.capabilities(engine);
  const double dt = costContactTime(study_.setup) / study_.setup.cost.averageReference;
  std::vector<Scene> scenes;
  for (const FlowState& state : states()) {
    const Scene scene = couetteScene(study_.setup, state.packing, dt);
    scenes.push_back(sceneFor(can, study_.entryOf(engine), study_.setup, scene).scene);
    scenes.back().precision = Precision::float64;
    scenes.back().dt = dt;
  }
  return scenes;
}

const AverageBounds::Reference& AverageBounds::referenceOf(std::size_t engine) {
  if (const auto found = references_.find(engine); found != references_.end()) return found->second;
  const double steps = study_.setup.cost.boundReference;
  const std::vector<double> times = windowTimes(study_.setup);
  const auto follow = [&](double stepsPerContact) {
    return followStarts(study_.workers.of(engine), study_.entryOf(engine),
                        at(engine, stepsPerContact), states(), times);
  };
  const double diameter = 2.0 * study_.setup.particles.smallRadius;
  Reference reference;
  reference.tracks = follow(steps);
  reference.responses = windowResponses(*study_.inHouseEngine, scenesOf(engine), times, diameter);
  reference.error =
      equivalentOf(follow(steps / 2.0), reference.tracks, reference.responses, diameter);
  return references_[engine] = std::move(reference);
}

SettingWindows AverageBounds::windowsOf(const PlannedPoint& point) {
  return keptOr(study_.campaign.store(), study_.windowsName(point), study_.keyOf(point, 0), [&] {
    const Reference& reference = referenceOf(point.engine);
    const std::vector<double> times = windowTimes(study_.setup);
    const auto tracks = followStarts(study_.workers.of(point.engine), study_.entryOf(point.engine),
                                     study_.settingOf(point).setup, states(), times);
    SettingWindows windows{.dt = tracks.front().dt};
    for (const Track& track : tracks) {
      windows.wallSeconds += track.wallSeconds;
      windows.cpuSeconds += track.cpuSeconds;
      windows.steps += track.steps;
      windows.contactEvaluations += track.contactEvaluations;
    }
    const double perRotation =
        rotationTime(study_.setup) / (times.back() * static_cast<double>(tracks.size()));
    const auto scaled = [&](std::uint64_t count) {
      return static_cast<std::uint64_t>(std::llround(static_cast<double>(count) * perRotation));
    };
    windows.wallSeconds *= perRotation;
    windows.cpuSeconds *= perRotation;
    windows.steps = scaled(windows.steps);
    windows.contactEvaluations = scaled(windows.contactEvaluations);
    const auto equivalent = equivalentOf(tracks, reference.tracks, reference.responses,
                                         2.0 * study_.setup.particles.smallRadius);
    if (equivalent && reference.error) windows.equivalent = *equivalent + *reference.error;
    return windows;
  });
}

}  // namespace crossgrain::inline runs
