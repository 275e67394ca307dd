#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cases/packing.hpp"
#include "studies/cost/study.hpp"

namespace crossgrain::inline studies {

/// Where one engine has taken a packing, and what it cost.
struct Track {
  std::vector<Vec3> positions;  ///< at the end, in the plane z = 0 [m]
  CostRun cost;                 ///< without numbers
};

/// Runs one packing, from springs dropped, for that time [s]. The case says the step. Through a
/// periodic border positions go on.
/// @throws EngineFailure, UnsupportedScene, BadInput
Track followPacking(Engine& engine, const EngineEntry& entry, const Case& setup,
                    const Packing& packing, double time);

/// √(Σ|a − b|²/N)/d
double rmsDistance(const std::vector<Vec3>& a, const std::vector<Vec3>& b, double diameter);

/// Paths of packings over a window that is short against their chaos, against runs at a much
/// smaller step: of the engine itself with the same integrator ("position_rms_own"), and of the
/// in-house engine ("position_rms_NAME", the model included). Rms in d at the window's end, mean
/// over packings with Student's interval. What chaos makes of the reference's own error shows in
/// `reference_error`.
std::unique_ptr<ErrorKind> trajectoryErrors(CostStudy& study);

}  // namespace crossgrain::inline studies
