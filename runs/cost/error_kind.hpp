#pragma once

#include <memory>
#include <string>
#include <vector>

#include "results/cost.hpp"
#include "runs/cost/plan.hpp"
#include "runs/cost/study.hpp"

namespace crossgrain::inline runs {

/// What the references of a kind of error take.
struct ReferenceCost {
  double common = 0.0;           ///< of those that all engines share [s]
  std::vector<double> own = {};  ///< of an engine's own, by engine; none: nothing [s]
  std::string impossible = {};   ///< why there can be none, and no points; empty if there can
  double budgetLeftOut = 0.0;    ///< that would allow them then [s]
};

/// One kind of error: how its points are predicted and measured, and what against.
///
///   prepare ── predicted, referenceCost ── makeReferences ── measure … ── addTo
class ErrorKind {
 public:
  virtual ~ErrorKind() = default;
  virtual CostKind kind() const = 0;
  virtual std::vector<std::string> measures() const = 0;

  /// Finds out what predictions need.
  virtual void prepare() {}
  /// What measuring a setting on an engine will take [s].
  virtual double predicted(std::size_t engine, const CostSetting& setting) const = 0;
  /// @param anew  by engine: whether some point of it is to be measured
  /// @param budget  for everything [s]
  virtual ReferenceCost referenceCost(const std::vector<bool>& anew, double budget) const;

  /// Those that all points need. Not called where they are impossible.
  virtual void makeReferences() {}
  /// Why a point cannot be measured now; empty if it can.
  virtual std::string obstacle(const PlannedPoint& point) const;
  /// What it measures is kept at once; what is kept is taken up.
  /// @returns one point per measure @throws as Engine does
  virtual std::vector<CostPoint> measure(const PlannedPoint& point) = 0;

  /// Adds its references and what else it has found out.
  virtual void addTo(CostResults& results) const = 0;
};

using ErrorKinds = std::vector<std::unique_ptr<ErrorKind>>;

/// Those that the case wants, in their order.
ErrorKinds errorKinds(CostStudy& study);

ErrorKind& errorKindOf(const ErrorKinds& kinds, CostKind kind);

}  // namespace crossgrain::inline runs
