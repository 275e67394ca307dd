#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "runs/cost/averages.hpp"
#include "runs/cost/equivalents.hpp"
#include "runs/cost/error_kind.hpp"

namespace crossgrain::inline runs {

/// What the windows of a setting come to.
struct SettingWindows {
  std::optional<double> equivalent = {};       ///< ε_eq, with that of the reference
  double dt = 0.0;                             ///< [s]
  double wallSeconds = 0.0, cpuSeconds = 0.0;  ///< of a rotation, as long as the windows go [s]
  std::uint64_t steps = 0, contactEvaluations = 0;  ///< likewise
};

/// Bounds on what a setting changes averages by. Chaos and packings scatter averages by more than
/// most settings change them, so that is not measured but bounded by
///
///   B = (ε_eq + that of the reference) / change · response
///
/// with ε_eq how far the setting is from the same engine at `boundReference` steps per t_c,
/// that of the reference how far this is from twice the step (equivalents.hpp), and the response
/// what the change of a constant does to an average of the in-house engine, the upper end of its
/// interval, of the constants tried the largest. It is taken that averages respond in proportion to
/// so small a change, and to one that is not of k_n no more than to k_n and µ.
class AverageBounds {
 public:
  explicit AverageBounds(CostStudy& study) : study_(study) {}

  /// Whether there is a bound: the law is the case's normal law, and the setting leaves it.
  bool appliesTo(std::size_t engine, const CostSetting& setting) const;
  /// What windows of a setting, and of an engine's reference, take [s].
  double predicted(std::size_t engine, const CostSetting& setting) const;
  double predictedReference(std::size_t engine) const;

  /// Sets the responses from runs with a constant changed against the reference's.
  /// @param runsOf  the in-house engine's on all packings at the reference's step: name and case
  void respond(const std::vector<AveragedPacking>& reference,
               const std::function<std::vector<AveragedPacking>(const std::string& name,
                                                                const Case& setup)>& runsOf);
  const std::vector<CostResponse>& responses() const { return responses_; }
  /// How many constants are changed.
  std::size_t constants() const;

  /// A setting's windows, which are kept at once. Not of one that it does not apply to.
  /// @throws as Engine does
  SettingWindows windowsOf(const PlannedPoint& point);
  /// B for that measure; absent without a response.
  std::optional<double> bound(double equivalent, const std::string& measure) const;

 private:
  /// What an engine's settings are held against.
  struct Reference {
    std::vector<Track> tracks;  ///< at small steps, by start
    WindowResponses responses;
    std::optional<double> error;  ///< ε_eq of the same engine at twice the step
  };

  const std::vector<FlowState>& states();
  const Reference& referenceOf(std::size_t engine);
  /// What the in-house engine is given to be the law that an engine declares, from each start.
  std::vector<Scene> scenesOf(std::size_t engine);
  Case at(std::size_t engine, double steps) const;

  CostStudy& study_;
  std::vector<FlowState> states_;
  std::map<std::size_t, Reference> references_;  ///< by engine
  std::vector<CostResponse> responses_;
};

}  // namespace crossgrain::inline runs
