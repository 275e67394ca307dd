#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cases/packing.hpp"
#include "runs/cost/point.hpp"
#include "runs/cost/settings.hpp"

namespace crossgrain::inline runs {

/// How the snapshots of one run are averaged: all of a run is looked at in several ways at once.
struct View {
  std::string method;
  int every = 1;       ///< only every so many-th snapshot
  double share = 1.0;  ///< only the first part of the run
};

/// "slicing", "slicing/16", "slicing@0.25"
std::string nameOf(const View& view);

/// The view that a setting asks for, and all views that a run of the case as it is offers: its
/// methods, its strides, and a quarter and a half of it.
View viewOf(const Case& setup, const CostSetting& setting);
std::vector<View> allViews(const Case& setup);

/// Averages one packing on one engine over the case's rotations, after settling. An entry with, for
/// each view by name, numbers by measure: lists over rings of "azimuthal_velocity" [ΩR_i],
/// "stress_rr" [N/m²] and "volume_fraction", and of "shear_band_width" [d], "wall_slip"
/// (1 − v_φ/(ΩR_i) at the wheel, of the fit) and "stress_level" (σ_rr over all rings [N/m²]) lists
/// of one; and what a rotation costs: "wall_s", "cpu_s", "steps", "contact_evaluations"; "dt_s".
/// Null where a run has no such number.
/// @throws EngineFailure (also of a packing that blew up), UnsupportedScene, BadInput, Interrupted
nlohmann::json averagePacking(Engine& engine, const EngineEntry& entry, const Case& setup,
                              const Packing& packing, const std::vector<View>& views,
                              const std::function<void(double)>& progress);

/// An error of averages with its parts, all relative to the measure's scale: the largest value of
/// the reference's profile; of slip 1.
struct WeakError {
  double error;                       ///< rms over rings of |mean paired difference|
  std::optional<double> statistical;  ///< likewise of its standard error; absent: one packing
  std::optional<double> systematic;   ///< √max(0, error² − statistical²)
};

/// @param runs, reference  lists over packings of averagePacking()'s results, null where a run
///                         failed @returns absent where no packing has it in both
std::optional<WeakError> weakError(const std::vector<nlohmann::json>& runs, const std::string& view,
                                   const std::vector<nlohmann::json>& reference,
                                   const std::string& referenceView, const std::string& measure);

/// Names of all measures.
const std::vector<std::string>& averageMeasures();

}  // namespace crossgrain::inline runs
