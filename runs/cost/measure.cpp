#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>

#include "cases/time_step.hpp"
#include "runs/common/records.hpp"
#include "runs/cost/averages.hpp"
#include "runs/cost/campaign.hpp"
#include "runs/cost/limits.hpp"
#include "support/bad_input.hpp"
#include "support/files.hpp"
#include "support/interrupt.hpp"
#include "support/task_pool.hpp"

namespace crossgrain::inline runs {

using nlohmann::json;

namespace {

/// Whether a failure is what was to be expected of so large a step.
bool isBeyondLimit(const std::string& reason) {
  return reason.find(beyondLimit) != std::string::npos;
}

std::vector<std::string> measuresOf(CostKind kind) {
  if (kind == CostKind::collision) return {"psi_f", "e_n"};
  if (kind == CostKind::averages) return averageMeasures();
  return {"position_rms_own", "position_rms_" + engineRegistry().front().name};
}

}  // namespace

void CostCampaign::measure() {
  collisions_ = wants(CostKind::collision) ? collisionReference(setup_) : CollisionReference{};
  if (wants(CostKind::averages) && noAverages_.empty()) averagesReference();
  std::vector<double> weights;
  for (const PlannedPoint& point : plan_) weights.push_back(point.seconds);
  campaign_.progress().begin("measuring, one at a time", weights);
  // Kind by kind, engines in turn: a machine that slows down does so for all.
  std::vector<std::size_t> order, rank(plan_.size());
  std::map<std::pair<std::size_t, CostKind>, std::size_t> count;
  for (std::size_t k = 0; k < plan_.size(); ++k) {
    order.push_back(k);
    rank[k] = count[{plan_[k].engine, plan_[k].kind}]++;
  }
  std::ranges::stable_sort(order, {},
                           [&](std::size_t k) { return std::pair(plan_[k].kind, rank[k]); });
  for (const std::size_t k : order) {
    throwIfInterrupted();
    const PlannedPoint& point = plan_[k];
    const std::string label =
        fmt::format("{}, {}: {} {}", entryOf(point.engine).name, toString(point.kind),
                    settingOf(point).knob, settingOf(point).setting);
    campaign_.progress().update(k, label, 0.0);
    measurePoint(plan_[k]);
    const CostPoint& first = pointsOf(point).front();
    campaign_.progress().finish(
        k, label + ": " +
               (first.status == "ran" && first.error ? fmt::format("{:.3g}", *first.error)
                : first.status == "ran"              ? "no number"
                                        : fmt::format("{}: {}", first.status, first.reason)));
  }
}

void CostCampaign::measurePoint(PlannedPoint& point) {
  EngineState& state = engines_[point.engine];
  const CostSetting& setting = settingOf(point);
  if (!setting.refusal.empty()) return addWithout(point, "refused", setting.refusal);
  if (const auto reason = knownFailure(point)) return addWithout(point, "failed", *reason);
  // Predictions may be off; an engine's share is not.
  if (point.undecided.empty() && state.spent + point.seconds > 1.2 * state.share + 5.0)
    point.undecided = undecidedReason(point.seconds, state.share - state.spent, state.share);
  if (point.kind == CostKind::averages && sharesRuns(setting) && !caseRuns_.contains(point.engine))
    point.undecided = "another look at runs of the case as it is, and there are none";
  if (!point.undecided.empty()) return addWithout(point, "undecided", point.undecided);
  const auto start = std::chrono::steady_clock::now();
  try {
    pointsOf(point) = measured(point);
  } catch (const Interrupted&) {
    throw;
  } catch (const OutputError&) {
    throw;
  } catch (const BadInput&) {
    throw;
  } catch (const UnsupportedScene& refusal) {
    addWithout(point, "refused", refusal.what());
  } catch (const std::exception& error) {
    failed(point, error.what());
  }
  state.spent += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void CostCampaign::failed(const PlannedPoint& point, const std::string& reason) {
  if (isBeyondLimit(reason)) return pastLimit(point, reason);
  workers_.drop(point.engine);
  const Case& setup = settingOf(point).setup;
  const double theory =
      point.kind == CostKind::collision ? stabilityLimit(setup) : packingLimit(setup);
  // What the case's own step bears and a longer one does not is past a limit, wherever theory puts
  // it: it knows no dashpots.
  const double limit = std::min(theory, stepOf(point.engine, setup_));
  if (stepOf(point.engine, setup) > limit)
    return pastLimit(point, fmt::format("{}: {}", beyondLimit, reason));
  engineFailures_.push_back(reason);
  addWithout(point, "failed", reason);
}

void CostCampaign::pastLimit(const PlannedPoint& point, const std::string& reason) {
  campaign_.store().keep(nameOf(point, 0) + "-failed", keyOf(point, 0), {{"reason", reason}});
  addWithout(point, "failed", reason);
}

void CostCampaign::addWithout(const PlannedPoint& point, const std::string& status,
                              const std::string& reason) {
  const CostSetting& setting = settingOf(point);
  CostPoint row =
      pointOf(entryOf(point.engine).name, setting, point.kind, stepOf(point.engine, setting.setup));
  row.status = status;
  row.reason = BadInput(reason).what();  // in one line
  for (const std::string& measure : measuresOf(point.kind)) {
    row.measure = measure;
    pointsOf(point).push_back(row);
  }
}

std::vector<CostPoint> CostCampaign::measured(const PlannedPoint& point) {
  if (point.kind == CostKind::averages) return averagesOf(point);
  const std::string name = nameOf(point, 0);
  const CaseKeys key = keyOf(point, 0);
  std::vector<CostPoint> found;
  if (const auto kept = campaign_.store().find(name, key)) {
    for (const json& entry : *kept) found.push_back(costPointFromJson(entry));
    return found;
  }
  const CostSetting& setting = settingOf(point);
  if (point.kind == CostKind::collision)
    found =
        measureCollision(workers_.of(point.engine), entryOf(point.engine), setting, collisions_);
  else {
    const TrajectoryReference& own = ownReference(point.engine, setting);
    found = measureTrajectory(workers_.of(point.engine), entryOf(point.engine), setting,
                              campaign_.packings().front(), chaos_.window.length, own,
                              *inHouseReference_);
  }
  json list = json::array();
  for (const CostPoint& each : found) list.push_back(toJson(each));
  campaign_.store().keep(name, key, list);
  return found;
}

TrajectoryReference CostCampaign::keptReference(const std::string& name, const CaseKeys& key,
                                                Engine& engine, const EngineEntry& entry,
                                                const std::string& fragment,
                                                const Capabilities& can) {
  const std::string kept = "reference-trajectory-" + name;
  TrajectoryReference reference;
  if (const auto before = campaign_.store().find(kept, key)) {
    reference.error = before->at("error");
    for (const json& at : before->at("positions")) reference.positions.emplace_back(at[0], at[1]);
    return reference;
  }
  const auto at = [&](double steps) {
    return caseWith_(fragment + stepFragment(setup_, entry.name, can, steps));
  };
  const double steps = setup_.cost.trajectoryReference;
  reference = trajectoryReference(engine, entry, at(steps), at(steps / 2.0),
                                  campaign_.packings().front(), chaos_.window.length);
  json list = json::array();
  for (const Vec2& position : reference.positions) list.push_back({position.x(), position.y()});
  campaign_.store().keep(kept, key, {{"error", reference.error}, {"positions", list}});
  return reference;
}

const TrajectoryReference& CostCampaign::ownReference(std::size_t engine,
                                                      const CostSetting& setting) {
  const EngineEntry& entry = entryOf(engine);
  if (!inHouseReference_)
    inHouseReference_ = keptReference("in-house", inHouseKey(0, "cost: reference"), *inHouseEngine_,
                                      inHouse_, "", inHouseEngine_->capabilities());
  const std::string integrator = integratorOf(setting);
  if (integrator.empty() && entry.name == inHouse_.name) return *inHouseReference_;
  const auto at = std::pair(engine, integrator);
  if (const auto found = ownReferences_.find(at); found != ownReferences_.end())
    return found->second;
  const std::string fragment =
      integrator.empty() ? integrator : fmt::format("[law]\nintegrator = \"{}\"\n\n", integrator);
  return ownReferences_[at] = keptReference(
             entry.name + integrator, campaign_.keyOf(engine, 0, "cost: reference " + integrator),
             workers_.of(engine), entry, fragment, *campaign_.capabilities(engine));
}

std::string CostCampaign::averagesReferenceName(std::size_t packing) const {
  return fmt::format("reference-averages-p{}", packing);
}

CaseKeys CostCampaign::averagesReferenceKey(std::size_t packing) const {
  return inHouseKey(packing, "cost: reference");
}

std::size_t CostCampaign::missingReferences() const {
  std::size_t missing = 0;
  for (std::size_t k = 0; k < campaign_.packings().size(); ++k)
    if (!campaign_.store().find(averagesReferenceName(k), averagesReferenceKey(k))) ++missing;
  return missing;
}

void CostCampaign::averagesReference() {
  const auto count = campaign_.packings().size();
  averagesReference_.resize(count);
  campaign_.progress().begin("reference of the averages", std::vector<double>(count, 1.0));
  const Case fine = caseWith_(stepFragment(setup_, inHouse_.name, inHouseEngine_->capabilities(),
                                           setup_.cost.averageReference));
  std::vector<Task> tasks;
  for (std::size_t k = 0; k < count; ++k)
    tasks.push_back({1.0, [&, k] {
                       const std::string name = averagesReferenceName(k);
                       const CaseKeys key = averagesReferenceKey(k);
                       const std::string label = fmt::format("reference, packing {}", k);
                       const auto kept = campaign_.store().find(name, key);
                       if (kept) {
                         averagesReference_[k] = *kept;
                       } else {
                         const auto engine = inHouse_.make();
                         averagesReference_[k] = averagePacking(
                             *engine, inHouse_, fine, campaign_.packings()[k], allViews(setup_),
                             [&](double f) { campaign_.progress().update(k, label, f); });
                         campaign_.store().keep(name, key, averagesReference_[k]);
                       }
                       campaign_.progress().finish(k, label + ": done");
                     }});
  runTasks(tasks, request_.run.jobs);
}

std::vector<json> CostCampaign::averagesRuns(const PlannedPoint& point) {
  const CostSetting& setting = settingOf(point);
  const std::vector<View> views =
      point.setting == 0 ? allViews(setup_) : std::vector<View>{viewOf(setup_, setting)};
  std::vector<json> runs;
  for (std::size_t k = 0; k < campaign_.packings().size(); ++k) {
    const auto packing = static_cast<int>(k);
    const std::string name = nameOf(point, packing);
    const CaseKeys key = keyOf(point, packing);
    if (auto kept = campaign_.store().find(name, key)) {
      runs.push_back(std::move(*kept));
      continue;
    }
    runs.push_back(averagePacking(workers_.of(point.engine), entryOf(point.engine), setting.setup,
                                  campaign_.packings()[k], views, [](double) {}));
    campaign_.store().keep(name, key, runs.back());
  }
  return runs;
}

std::vector<CostPoint> CostCampaign::averagesOf(const PlannedPoint& point) {
  const CostSetting& setting = settingOf(point);
  const std::vector<json> runs =
      sharesRuns(setting) ? caseRuns_.at(point.engine) : averagesRuns(point);
  if (point.setting == 0) caseRuns_[point.engine] = runs;

  CostPoint row =
      pointOf(entryOf(point.engine).name, setting, CostKind::averages, runs.front()["dt_s"]);
  row.wallSeconds = row.cpuSeconds = std::numeric_limits<double>::infinity();
  for (const json& run : runs) {
    row.wallSeconds = std::min(*row.wallSeconds, run["wall_s"].get<double>());
    row.cpuSeconds = std::min(*row.cpuSeconds, run["cpu_s"].get<double>());
    row.steps += run["steps"].get<std::uint64_t>() / runs.size();
    row.contactEvaluations += run["contact_evaluations"].get<std::uint64_t>() / runs.size();
  }
  const std::string view = crossgrain::nameOf(viewOf(setup_, setting));
  const std::string whole = crossgrain::nameOf(allViews(setup_).front());
  std::vector<CostPoint> points;
  for (const std::string& measure : averageMeasures()) {
    row.measure = measure;
    const auto error = weakError(runs, view, averagesReference_, whole, measure);
    row.error = error ? std::optional(error->error) : std::nullopt;
    row.statistical = error ? error->statistical : std::nullopt;
    row.systematic = error ? error->systematic : std::nullopt;
    points.push_back(row);
  }
  return points;
}

}  // namespace crossgrain::inline runs
