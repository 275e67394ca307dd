#pragma once

#include <array>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <tuple>
#include <vector>

#include "runs/cost/collision.hpp"
#include "runs/cost/cost.hpp"
#include "runs/cost/plan.hpp"
#include "runs/cost/point.hpp"
#include "runs/cost/trajectory.hpp"
#include "runs/couette/campaign.hpp"

namespace crossgrain::inline runs {

/// One worker per engine, started when it is first needed and again after it failed.
class Workers {
 public:
  Workers(const Campaign& campaign, double timeout) : campaign_(campaign), timeout_(timeout) {}
  Engine& of(std::size_t engine);
  void drop(std::size_t engine) { running_.erase(engine); }

 private:
  const Campaign& campaign_;
  double timeout_;
  std::map<std::size_t, std::unique_ptr<Engine>> running_;
};

/// How `measureCost` goes about it.
///
///   prepare ── plan ── measure ── results
class CostCampaign {
 public:
  CostCampaign(const Case& setup, const CaseWith& caseWith, const CostRequest& request,
               RunStore& store);

  /// What there is to measure, in place of all that follows.
  std::string dryRun();
  /// Engines, packings, settings, what a step costs, and how long the trajectories' window is.
  void prepare();
  /// What fits into the budget, told before it runs.
  void plan();
  void measure();
  nlohmann::json results() const;

 private:
  struct EngineState {
    std::array<std::vector<CostSetting>, 3> settings;  ///< by CostKind
    double start = 0.0, load = 0.0, step = 0.0;        ///< [s]
    double spent = 0.0, share = 0.0;                   ///< of the budget [s]
    bool takesPart = false;
  };

  const CostSetting& settingOf(const PlannedPoint& point) const;
  std::vector<CostPoint>& pointsOf(const PlannedPoint& point) {
    return points_[{point.kind, point.engine, point.setting}];
  }
  const EngineEntry& entryOf(std::size_t engine) const { return campaign_.engines()[engine]; }
  bool wants(CostKind kind) const;
  double stepOf(std::size_t engine, const Case& setup) const;
  double predicted(std::size_t engine, CostKind kind, const CostSetting& setting) const;
  /// Whether an averages setting is another look at the runs of the case as it is.
  static bool sharesRuns(const CostSetting& setting);

  void listSettings(std::size_t engine, const Capabilities& can);
  void timeStart(std::size_t engine);
  void measureChaos();
  void averagesReference();
  const TrajectoryReference& ownReference(std::size_t engine, const CostSetting& setting);
  TrajectoryReference keptReference(const std::string& name, const CaseKeys& key, Engine& engine,
                                    const EngineEntry& entry, const std::string& fragment,
                                    const Capabilities& can);

  void measurePoint(PlannedPoint& point);
  std::vector<CostPoint> measured(const PlannedPoint& point);
  std::vector<CostPoint> averagesOf(const PlannedPoint& point);
  std::vector<nlohmann::json> averagesRuns(const PlannedPoint& point);
  /// One row per measure that says why there is no number.
  void addWithout(const PlannedPoint& point, const std::string& status, const std::string& reason);
  void failed(const PlannedPoint& point, const std::string& reason);
  void pastLimit(const PlannedPoint& point, const std::string& reason);
  /// Whether an earlier run in the same folder has measured it, or seen it fail past its limit.
  bool isKept(const PlannedPoint& point) const;
  std::optional<std::string> knownFailure(const PlannedPoint& point) const;
  std::string averagesReferenceName(std::size_t packing) const;
  CaseKeys averagesReferenceKey(std::size_t packing) const;
  std::size_t missingReferences() const;
  /// Of what the in-house engine does for all: it need not be among the engines named.
  CaseKeys inHouseKey(std::size_t packing, const std::string& part) const;
  CaseKeys keyOf(const PlannedPoint& point, int packing) const;
  std::string nameOf(const PlannedPoint& point, int packing) const;
  nlohmann::json falls() const;
  nlohmann::json references() const;

  const Case& setup_;
  const CaseWith& caseWith_;
  const CostRequest& request_;
  Campaign campaign_;
  Workers workers_;
  std::vector<EngineState> engines_;
  const EngineEntry& inHouse_;
  std::unique_ptr<Engine> inHouseEngine_;
  double inHouseStep_ = 0.0;       ///< what a step of it takes [s]
  double common_ = 0.0;            ///< what all references of the in-house engine take [s]
  double budgetForTheRest_ = 0.0;  ///< for what does not fit [s]
  std::string noAverages_;         ///< why there are none
  std::vector<double> overhead_;
  std::vector<PlannedPoint> plan_;
  /// By kind, engine and setting, in whatever order they are measured.
  std::map<std::tuple<CostKind, std::size_t, std::size_t>, std::vector<CostPoint>> points_;
  CollisionReference collisions_;
  ChaosStudy chaos_;
  std::optional<TrajectoryReference> inHouseReference_;
  std::map<std::pair<std::size_t, std::string>, TrajectoryReference> ownReferences_;
  std::vector<nlohmann::json> averagesReference_;
  std::map<std::size_t, std::vector<nlohmann::json>> caseRuns_;  ///< of the case as it is
  std::vector<std::string> engineFailures_;
};

}  // namespace crossgrain::inline runs
