#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "runs/cost/average_bounds.hpp"
#include "runs/cost/averages.hpp"
#include "runs/cost/error_kind.hpp"

namespace crossgrain::inline runs {

/// Averages of the sheared cell over all packings, packing by packing against those of the in-house
/// engine at a smaller step with the case's law, and with the law that the engine declares. What a
/// setting changes is also bounded (AverageBounds): against the engine's own limit of small steps,
/// and against the case's law where that is the same.
class AverageErrors final : public ErrorKind {
 public:
  explicit AverageErrors(CostStudy& study) : study_(study), bounds_(study) {}
  CostKind kind() const override { return CostKind::averages; }
  std::vector<std::string> measures() const override;
  double predicted(std::size_t engine, const CostSetting& setting) const override;
  ReferenceCost referenceCost(const std::vector<bool>& anew, double budget) const override;
  void makeReferences() override;
  std::string obstacle(const PlannedPoint& point) const override;
  std::vector<CostPoint> measure(const PlannedPoint& point) override;
  void addTo(CostResults& results) const override;

 private:
  /// The reference's runs with the law of an engine.
  struct OwnReference {
    bool isTheScenes = false;             ///< the law: they are the common reference's runs
    const EngineEntry* mirror = nullptr;  ///< whose runs they are else
    std::string reason;                   ///< why there are none
    std::vector<AveragedPacking> runs;    ///< by packing
  };

  std::vector<AveragedPacking> runsOf(const PlannedPoint& point);
  /// A point without measure and error: what its setting is and takes.
  CostPoint rowOf(const PlannedPoint& point, const std::vector<AveragedPacking>& runs,
                  const std::optional<SettingWindows>& windows) const;
  /// The row with its error in a measure.
  CostPoint against(CostPoint row, const std::vector<AveragedPacking>& runs,
                    const std::vector<AveragedPacking>& reference, const CostSetting& setting,
                    const std::string& measure) const;
  /// Runs of one engine of this process on all packings, side by side; each is kept.
  std::vector<AveragedPacking> referenceRuns(
      const std::string& name, const EngineEntry& entry, const Case& setup,
      const std::function<void(std::size_t packing, double fraction)>& progress);
  /// The in-house engine's, as a stage of its own.
  std::vector<AveragedPacking> inHouseRuns(const std::string& name, const Case& setup);
  CaseKeys referenceKey(const std::string& name, std::size_t packing) const;
  std::string referenceName(const std::string& name, std::size_t packing) const;
  double referenceSeconds(const std::string& name) const;
  OwnReference ownLawOf(std::size_t engine) const;
  const OwnReference& ownReference(std::size_t engine);
  void addModel(CostResults& results, std::size_t engine, const OwnReference& own) const;
  std::vector<StatisticalFall> falls() const;
  double alpha() const;

  CostStudy& study_;
  AverageBounds bounds_;
  std::vector<AveragedPacking> reference_;                        ///< by packing
  std::map<std::size_t, OwnReference> own_;                       ///< by engine
  std::map<std::size_t, std::vector<AveragedPacking>> caseRuns_;  ///< of the case as it is
};

}  // namespace crossgrain::inline runs
