#pragma once

#include <array>
#include <string>
#include <vector>

#include "cases/packing.hpp"
#include "runs/cost/study.hpp"

namespace crossgrain::inline results {

template <>
inline Json jsonOf(const Vec2& at) {
  return jsonOf(std::array{at.x(), at.y()});
}
template <>
inline void readFrom(const Json& json, Vec2& at) {
  const auto pair = readAs<std::array<double, 2>>(json);
  at = {pair[0], pair[1]};
}

}  // namespace crossgrain::inline results

namespace crossgrain::inline runs {

/// Where one engine has taken a packing, and what it cost.
struct Track {
  std::vector<Vec2> positions;  ///< at the end [m]
  double dt = 0.0;              ///< [s]
  double wallSeconds = 0.0, cpuSeconds = 0.0;
  std::uint64_t steps = 0, contactEvaluations = 0;
};

/// Runs one packing, from springs dropped, for that time [s]. The case says the step.
/// @throws EngineFailure, UnsupportedScene, BadInput
Track followPacking(Engine& engine, const EngineEntry& entry, const Case& setup,
                    const Packing& packing, double time);

/// What packings' paths are compared with.
struct TrajectoryReference {
  std::vector<Vec2> positions;  ///< at the window's end [m]
  double error = 0.0;           ///< distance to the same at twice the step [d]
};

void fields(auto& io, TrajectoryReference& reference) {
  io("error", reference.error);
  io("positions", reference.positions);
}

/// √(Σ|a − b|²/N)/d
double rmsDistance(const std::vector<Vec2>& a, const std::vector<Vec2>& b, double diameter);

/// A packing's path over a window that is short against its chaos, against runs at a much smaller
/// step: of the engine itself with the same integrator ("position_rms_own"), and of the in-house
/// engine ("position_rms_NAME", the model included). Rms in d at the window's end. What chaos makes
/// of the reference's own error shows in `reference_error`.
class TrajectoryErrors final : public ErrorKind {
 public:
  using ErrorKind::ErrorKind;
  CostKind kind() const override { return CostKind::trajectory; }
  std::vector<std::string> measures() const override;
  double predicted(std::size_t engine, const CostSetting& setting) const override;
  double commonTime() const override;
  double ownTime(std::size_t engine) const override;
  /// The shortest time of `cost.repeats`, where a run is shorter than `cost.timed`.
  std::vector<CostPoint> measure(const PlannedPoint& point) override;
  void addTo(CostResults& results) const override;

 private:
  const Packing& packing() const { return study_.campaign.packings().front(); }
  double window() const;  ///< [s]
  /// Under which name and key, and at which case, a reference is kept; the in-house engine's own is
  /// everybody's.
  struct ReferenceRun {
    std::string name;
    CaseKeys key;
    Case fine, coarse;
  };
  bool isCommon(std::size_t engine, const std::string& integrator) const {
    return integrator.empty() && study_.entryOf(engine).name == study_.inHouse.name;
  }
  /// @param engine  absent: the in-house one, for all
  ReferenceRun referenceRun(std::optional<std::size_t> engine,
                            const std::string& integrator = {}) const;
  /// Made when it is first needed, then kept.
  TrajectoryReference referenceOf(std::optional<std::size_t> engine,
                                  const std::string& integrator = {});
  /// Integrators of the settings that an engine has.
  std::vector<std::string> integratorsOf(std::size_t engine) const;
};

}  // namespace crossgrain::inline runs
