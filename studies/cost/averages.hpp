#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "studies/cost/study.hpp"

namespace crossgrain::inline studies {

/// An error of an endpoint with its parts, all in one unit.
struct PairedError {
  double error;                       ///< |mean paired difference|
  std::optional<double> statistical;  ///< its standard error; absent: one packing
  std::optional<double> systematic;   ///< √max(0, error² − statistical²)
  /// Ends nearest to and farthest from 0 of the difference's confidence interval.
  std::optional<double> low, high;
};

/// @param runs, reference  over packings, in the same order
/// @param alpha  chance that the interval does not hold the true error, at most
/// @param unit   that errors are in; absent: the reference's size
/// @returns absent where no packing has it in both
std::optional<PairedError> pairedError(const std::vector<CostRun>& runs,
                                       const std::vector<CostRun>& reference,
                                       const std::string& measure, double alpha,
                                       std::optional<double> unit = {});

/// The same against a closed form: runs of one start have the same bits, so that nothing is
/// statistical; of an engine whose runs differ the largest counts, and the ends are theirs.
/// @returns absent where a run has no such number
std::optional<PairedError> exactError(const std::vector<CostRun>& runs, const std::string& measure,
                                      double expected, double unit);

/// Endpoints of a flow: of closed forms against these, one start again and again; else over all
/// packings, packing by packing compared with those of the in-house engine at a smaller step. Its
/// time is that of a second of the scene.
std::unique_ptr<ErrorKind> averageErrors(CostStudy& study);

}  // namespace crossgrain::inline studies
