#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "averaging/error_bounds.hpp"
#include "cases/packing.hpp"
#include "results/cost_averages.hpp"
#include "runs/cost/settings.hpp"

namespace crossgrain::inline runs {

/// How the snapshots of one run are averaged: every run is sampled in several ways at once.
struct Sampling {
  std::string method;
  int every = 1;          ///< only every so many-th snapshot
  double fraction = 1.0;  ///< only the first part of the run
};

/// "slicing", "slicing/16", "slicing@0.25"
std::string nameOf(const Sampling& sampling);

/// The sampling that a setting asks for, and all that a run of the case as it is offers: its
/// methods, its strides, and a quarter and a half of it.
Sampling samplingOf(const Case& setup, const CostSetting& setting);
std::vector<Sampling> allSamplings(const Case& setup);

/// Averages one packing on one engine over the case's rotations, after settling.
/// @throws EngineFailure (also of a packing that blew up), UnsupportedScene, BadInput, Interrupted
AveragedPacking averagePacking(Engine& engine, const EngineEntry& entry, const Case& setup,
                               const Packing& packing, const std::vector<Sampling>& samplings,
                               const std::function<void(double)>& progress);

/// An error of averages with its parts, all relative to the measure's scale: the largest value of
/// the reference's profile; of slip 1.
struct WeakError {
  double error;                       ///< rms over rings of |mean paired difference|
  std::optional<double> statistical;  ///< likewise of its standard error; absent: one packing
  std::optional<double> systematic;   ///< √max(0, error² − statistical²)
  /// Rms over rings of the ends nearest to and farthest from 0 of the differences' confidence
  /// intervals, which hold for all rings at once: between them lies the true error.
  std::optional<ErrorInterval> interval;
};

/// @param runs, reference  over packings, in the same order
/// @param alpha  chance that the interval does not hold the true error, at most
/// @returns absent where no packing has it in both
std::optional<WeakError> weakError(const std::vector<AveragedPacking>& runs,
                                   const std::string& sampling,
                                   const std::vector<AveragedPacking>& reference,
                                   const std::string& referenceSampling, const std::string& measure,
                                   double alpha);

/// Names of all measures.
const std::vector<std::string>& averageMeasures();

}  // namespace crossgrain::inline runs
