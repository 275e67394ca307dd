#pragma once

#include <map>
#include <optional>
#include <utility>

#include "runs/cost/error_kind.hpp"
#include "runs/cost/trajectory.hpp"

namespace crossgrain::inline runs {

/// A packing's path over a window short against its chaos, against runs at a much smaller step: of
/// the engine itself, with the same integrator, and of the in-house engine.
class TrajectoryErrors final : public ErrorKind {
 public:
  explicit TrajectoryErrors(CostStudy& study) : study_(study) {}
  CostKind kind() const override { return CostKind::trajectory; }
  std::vector<std::string> measures() const override;
  /// How long the window is.
  void prepare() override;
  double predicted(std::size_t engine, const CostSetting& setting) const override;
  ReferenceCost referenceCost(const std::vector<bool>& anew, double budget) const override;
  std::vector<CostPoint> measure(const PlannedPoint& point) override;
  void addTo(CostResults& results) const override;

 private:
  /// Made when it is first needed.
  const TrajectoryReference& inHouseReference();
  const TrajectoryReference& ownReference(std::size_t engine, const CostSetting& setting);
  TrajectoryReference keptReference(const std::string& name, const CaseKeys& key, Engine& engine,
                                    const EngineEntry& entry, const std::string& fragment,
                                    const Capabilities& can) const;

  CostStudy& study_;
  ChaosStudy chaos_;
  std::optional<TrajectoryReference> inHouseReference_;
  /// By engine and integrator.
  std::map<std::pair<std::size_t, std::string>, TrajectoryReference> ownReferences_;
};

}  // namespace crossgrain::inline runs
