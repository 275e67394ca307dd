#pragma once

#include <map>
#include <string>
#include <vector>

#include "runs/cost/averages.hpp"
#include "runs/cost/error_kind.hpp"

namespace crossgrain::inline runs {

/// Averages of the sheared cell over all packings, against those of the in-house engine at a
/// smaller step, packing by packing.
class AverageErrors final : public ErrorKind {
 public:
  explicit AverageErrors(CostStudy& study) : study_(study) {}
  CostKind kind() const override { return CostKind::averages; }
  std::vector<std::string> measures() const override { return averageMeasures(); }
  double predicted(std::size_t engine, const CostSetting& setting) const override;
  ReferenceCost referenceCost(const std::vector<bool>& anew, double budget) const override;
  void makeReferences() override;
  std::string obstacle(const PlannedPoint& point) const override;
  std::vector<CostPoint> measure(const PlannedPoint& point) override;
  void addTo(CostResults& results) const override;

 private:
  std::vector<AveragedPacking> runsOf(const PlannedPoint& point);
  std::string referenceName(std::size_t packing) const;
  CaseKeys referenceKey(std::size_t packing) const;
  std::vector<StatisticalFall> falls() const;

  CostStudy& study_;
  std::vector<AveragedPacking> reference_;                        ///< by packing
  std::map<std::size_t, std::vector<AveragedPacking>> caseRuns_;  ///< of the case as it is
};

}  // namespace crossgrain::inline runs
