#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "runs/cost/plan.hpp"
#include "runs/cost/settings.hpp"
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

/// An engine, what it takes to start and to step, and what there is to measure on it.
struct TimedEngine {
  std::array<std::vector<CostSetting>, costKinds.size()> settings;  ///< by CostKind
  double start = 0.0, load = 0.0, step = 0.0;                       ///< [s]
  bool takesPart = false;
};

/// What planning and measuring work with: engines and packings, the settings to measure, and by
/// which names and keys the store has what is measured.
///
///   ask          of a dry run
///   prepare      of a real one
struct CostStudy {
  /// @throws BadInput for a law without a contact time
  CostStudy(const Case& setup, const RunCommand& command, RunStore& store);

  /// Which settings there are and which packings there would be; computes nothing.
  void ask();
  /// Engines, packings, settings, and what starts and steps take.
  void prepare();

  const EngineEntry& entryOf(std::size_t engine) const { return campaign.engines()[engine]; }
  std::vector<std::string> engineNames() const;
  const std::vector<CostSetting>& settingsOf(std::size_t engine, CostKind kind) const {
    return engines[engine].settings[static_cast<std::size_t>(kind)];
  }
  const CostSetting& settingOf(const PlannedPoint& point) const {
    return settingsOf(point.engine, point.kind)[point.setting];
  }
  double stepOf(std::size_t engine, const Case& setup) const;  ///< that it will take [s]
  double packingCount() const { return static_cast<double>(campaign.packings().size()); }

  /// By what it is, not by its place in lists that may grow:
  /// "averages-grain-time_step-t_c-50-p0".
  std::string nameOf(const PlannedPoint& point, int packing) const;
  /// Of the windows that bound what it changes averages by.
  std::string windowsName(const PlannedPoint& point) const { return nameOf(point, 0) + "-windows"; }
  CaseKeys keyOf(const PlannedPoint& point, int packing) const;
  /// Of what the in-house engine does for all: it need not be among the engines named.
  CaseKeys inHouseKey(std::size_t packing, const std::string& part) const;
  /// Whether an earlier command in the same folder has measured it, or seen it fail past its limit.
  bool isKept(const PlannedPoint& point) const;
  std::optional<std::string> knownFailure(const PlannedPoint& point) const;
  void keepFailure(const PlannedPoint& point, const std::string& reason) const;

  const Case& setup;
  const int jobs;
  Campaign campaign;
  Workers workers;
  std::vector<TimedEngine> engines;
  const EngineEntry& inHouse;  ///< whose runs are references for all
  std::unique_ptr<Engine> inHouseEngine;
  double inHouseStep = 0.0;  ///< what a step of it takes [s]
  /// For other reasons than a step beyond the stability limit.
  std::vector<std::string> engineFailures;

 private:
  void listSettings(std::size_t engine, const Capabilities& can);
  void timeStart(std::size_t engine);
  void timeInHouse();
};

}  // namespace crossgrain::inline runs
