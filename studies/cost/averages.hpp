#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "studies/cost/study.hpp"

namespace crossgrain::inline studies {

/// An error of averages with its parts, all relative to the measure's scale: the largest value of
/// the reference's profile; of slip 1.
struct PairedError {
  double error;                       ///< rms over rings of |mean paired difference|
  std::optional<double> statistical;  ///< likewise of its standard error; absent: one packing
  std::optional<double> systematic;   ///< √max(0, error² − statistical²)
  /// Rms over rings of the ends nearest to and farthest from 0 of the differences' confidence
  /// intervals, which hold for all rings at once: between them lies the true error.
  std::optional<double> low, high;
};

/// @param runs, reference  over packings, in the same order
/// @param alpha  chance that the interval does not hold the true error, at most
/// @param unit   that errors are in; absent: the largest mean of the reference
/// @returns absent where no packing has it in both
std::optional<PairedError> pairedError(const std::vector<CostRun>& runs,
                                       const std::vector<CostRun>& reference,
                                       const std::string& measure, double alpha,
                                       std::optional<double> unit = {});

/// Averages of a flow over all packings, packing by packing compared with those of the
/// in-house engine at a smaller step. Numbers of a run: one per ring of "azimuthal_velocity"
/// [ΩR_i], "stress_rr" [N/m²] and "volume_fraction"; a single one of "shear_band_width" [d],
/// "wall_slip" (1 − v_φ/(ΩR_i) at the wheel, of the fit) and "stress_level" (σ_rr over all rings
/// [N/m²]). Its time is that of a rotation. Of other flows the numbers are those of the endpoints,
/// a single one each, and the time is that of a second of the scene.
std::unique_ptr<ErrorKind> averageErrors(CostStudy& study);

}  // namespace crossgrain::inline studies
