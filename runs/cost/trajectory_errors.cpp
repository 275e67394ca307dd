#include "runs/cost/trajectory_errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <set>

#include "cases/loader.hpp"
#include "runs/cost/kept.hpp"

namespace crossgrain::inline runs {

std::vector<std::string> TrajectoryErrors::measures() const {
  return {"position_rms_own", "position_rms_" + study_.inHouse.name};
}

void TrajectoryErrors::prepare() {
  const auto start = std::chrono::steady_clock::now();
  chaos_ = keptOr(study_.campaign.store(), "chaos", study_.inHouseKey(0, "cost: chaos"), [&] {
    const Capabilities can = study_.inHouseEngine->capabilities();
    const auto at = [&](double steps) {
      return caseWith(study_.setup, stepFragment(study_.setup, study_.inHouse.name, can, steps));
    };
    const double steps = study_.setup.cost.trajectoryReference;
    const ChaosStudy chaos =
        studyChaos(*study_.inHouseEngine, study_.inHouse, study_.setup, at(steps), at(steps / 2.0),
                   study_.campaign.packings().front());
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    study_.campaign.progress().say(fmt::format("chaos: window {:.3g} s ({}), {:.2g} s",
                                               chaos.window.length, chaos.window.why,
                                               took.count()));
    return chaos;
  });
}

double TrajectoryErrors::predicted(std::size_t engine, const CostSetting& setting) const {
  const TimedEngine& timed = study_.engines[engine];
  const Cost& cost = study_.setup.cost;
  const double once = chaos_.window.length / study_.stepOf(engine, setting.setup) * timed.step;
  const double runs = once < 10.0 * cost.timed ? cost.repeats : 1;
  return runs * (once + timed.load);
}

ReferenceCost TrajectoryErrors::referenceCost(const std::vector<bool>& anew, double) const {
  // One at the reference's step and one at twice that.
  const double steps = 1.5 * study_.setup.cost.trajectoryReference;
  const double contact = costContactTime(study_.setup);
  ReferenceCost cost{.own = std::vector<double>(anew.size(), 0.0)};
  for (std::size_t e = 0; e < anew.size(); ++e) {
    if (!anew[e]) continue;
    std::set<std::string> integrators;
    for (const CostSetting& setting : study_.settingsOf(e, kind()))
      if (setting.refusal.empty()) integrators.insert(setting.integrator());
    if (study_.entryOf(e).name == study_.inHouse.name) integrators.erase("");  // the common one
    cost.own[e] = static_cast<double>(integrators.size()) * steps * chaos_.window.length / contact *
                  study_.engines[e].step;
    cost.common = steps * chaos_.window.length / contact * study_.inHouseStep;
  }
  return cost;
}

std::vector<CostPoint> TrajectoryErrors::measure(const PlannedPoint& point) {
  const CostSetting& setting = study_.settingOf(point);
  const TrajectoryReference& inHouse = inHouseReference();
  const TrajectoryReference& own = ownReference(point.engine, setting);
  return keptOr(study_.campaign.store(), study_.nameOf(point, 0), study_.keyOf(point, 0), [&] {
    return measureTrajectory(study_.workers.of(point.engine), study_.entryOf(point.engine), setting,
                             study_.campaign.packings().front(), chaos_.window.length, own,
                             inHouse);
  });
}

TrajectoryReference TrajectoryErrors::keptReference(const std::string& name, const CaseKeys& key,
                                                    Engine& engine, const EngineEntry& entry,
                                                    const std::string& fragment,
                                                    const Capabilities& can) const {
  return keptOr(study_.campaign.store(), "reference-trajectory-" + name, key, [&] {
    const auto at = [&](double steps) {
      return caseWith(study_.setup, fragment + stepFragment(study_.setup, entry.name, can, steps));
    };
    const double steps = study_.setup.cost.trajectoryReference;
    return trajectoryReference(engine, entry, at(steps), at(steps / 2.0),
                               study_.campaign.packings().front(), chaos_.window.length);
  });
}

const TrajectoryReference& TrajectoryErrors::inHouseReference() {
  if (!inHouseReference_)
    inHouseReference_ =
        keptReference("in-house", study_.inHouseKey(0, "cost: reference"), *study_.inHouseEngine,
                      study_.inHouse, "", study_.inHouseEngine->capabilities());
  return *inHouseReference_;
}

const TrajectoryReference& TrajectoryErrors::ownReference(std::size_t engine,
                                                          const CostSetting& setting) {
  const EngineEntry& entry = study_.entryOf(engine);
  const std::string integrator = setting.integrator();
  if (integrator.empty() && entry.name == study_.inHouse.name) return inHouseReference();
  const auto at = std::pair(engine, integrator);
  if (const auto found = ownReferences_.find(at); found != ownReferences_.end())
    return found->second;
  const std::string fragment =
      integrator.empty() ? integrator : fmt::format("[law]\nintegrator = \"{}\"\n\n", integrator);
  return ownReferences_[at] = keptReference(
             entry.name + integrator,
             study_.campaign.keyOf(engine, 0, "cost: reference " + integrator),
             study_.workers.of(engine), entry, fragment, *study_.campaign.capabilities(engine));
}

void TrajectoryErrors::addTo(CostResults& results) const {
  const double steps = study_.setup.cost.trajectoryReference;
  const auto add = [&](const std::string& engine, const std::string& integrator, double error) {
    results.references.push_back(
        {kind(), engine,
         fmt::format("{}t_c/{:g}", integrator.empty() ? "" : integrator + ", ", steps), error,
         "distance to the same at twice the step"});
  };
  if (inHouseReference_) add(study_.inHouse.name, "", inHouseReference_->error);
  for (const auto& [at, reference] : ownReferences_) {
    const auto& [engine, integrator] = at;
    const std::string& name = study_.entryOf(engine).name;
    add(name, integrator, reference.error);
    if (!integrator.empty() || !inHouseReference_) continue;
    const double model = rmsDistance(reference.positions, inHouseReference_->positions,
                                     2.0 * study_.setup.particles.smallRadius);
    const double unsure = reference.error + inHouseReference_->error;
    results.models.push_back({name, kind(), "position_rms_" + study_.inHouse.name, model,
                              std::max(0.0, model - unsure), model + unsure});
  }
  results.trajectory = chaos_;
}

}  // namespace crossgrain::inline runs
