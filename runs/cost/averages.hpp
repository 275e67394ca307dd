#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "runs/cost/study.hpp"

namespace crossgrain::inline runs {

/// What the averages of one packing on one engine came to; kept of every run.
struct AveragedPacking {
  double dt = 0.0;                                  ///< [s]
  double wallSeconds = 0.0, cpuSeconds = 0.0;       ///< of a rotation [s]
  std::uint64_t steps = 0, contactEvaluations = 0;  ///< of a rotation
  /// By measure; absent where the run has no such number. One per ring of "azimuthal_velocity"
  /// [ΩR_i], "stress_rr" [N/m²] and "volume_fraction"; a single one of "shear_band_width" [d],
  /// "wall_slip" (1 − v_φ/(ΩR_i) at the wheel, of the fit) and "stress_level" (σ_rr over all rings
  /// [N/m²]).
  std::map<std::string, std::vector<std::optional<double>>> numbers = {};
};

void fields(auto& io, AveragedPacking& run) {
  io("dt_s", run.dt);
  io("wall_s", run.wallSeconds);
  io("cpu_s", run.cpuSeconds);
  io("steps", run.steps);
  io("contact_evaluations", run.contactEvaluations);
  io("numbers", run.numbers);
}

/// Names of all measures.
const std::vector<std::string>& averageMeasures();

/// Averages one packing on one engine over the case's rotations, after settling.
/// @throws EngineFailure (also of a packing that blew up), UnsupportedScene, BadInput, Interrupted
AveragedPacking averagePacking(Engine& engine, const EngineEntry& entry, const Case& setup,
                               const Packing& packing, const std::function<void(double)>& progress);

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
/// @returns absent where no packing has it in both
std::optional<PairedError> pairedError(const std::vector<AveragedPacking>& runs,
                                       const std::vector<AveragedPacking>& reference,
                                       const std::string& measure, double alpha);

/// Averages of the sheared cell over all packings, packing by packing compared with those of the
/// in-house engine at a smaller step with the case's law, and with the law that the engine
/// declares.
class AverageErrors final : public ErrorKind {
 public:
  using ErrorKind::ErrorKind;
  CostKind kind() const override { return CostKind::averages; }
  std::vector<std::string> measures() const override;
  double predicted(std::size_t engine, const CostSetting& setting) const override;
  double commonTime() const override;
  double ownTime(std::size_t engine) const override;
  bool isKept(const PlannedPoint& point) const override;
  void makeReferences() override;
  bool keepsPoints() const override { return false; }
  std::vector<CostPoint> measure(const PlannedPoint& point) override;
  void addTo(CostResults& results) const override;

 private:
  /// Whose runs show an engine's own law at small steps.
  struct OwnReference {
    bool isTheScenes = false;             ///< the law: they are the common reference's runs
    const EngineEntry* mirror = nullptr;  ///< whose runs they are else
    std::string reason = {};              ///< why there are none
  };

  OwnReference ownReferenceOf(std::size_t engine) const;
  /// The case at the reference's steps of that engine.
  Case fine(const std::string& engine, const Capabilities& can) const;
  /// By packing, side by side; each is kept.
  std::vector<AveragedPacking> referenceRuns(
      const std::string& name, const EngineEntry& entry, const Case& setup,
      const std::function<void(std::size_t packing, double fraction)>& progress) const;
  std::vector<AveragedPacking> ownRuns(std::size_t engine, const OwnReference& own) const;
  CaseKeys referenceKey(const std::string& name, std::size_t packing) const;
  double referenceSeconds(const std::string& name) const;
  double alpha() const;

  std::vector<AveragedPacking> reference_;  ///< by packing
};

}  // namespace crossgrain::inline runs
