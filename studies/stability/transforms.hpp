#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <limits>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "adapters/engine.hpp"
#include "results/stability.hpp"
#include "stability/transform.hpp"
#include "studies/stability/run.hpp"

/// Changes of a case after which it must run as before, such as other units or a turned scene. The
/// check needs no second engine and no theory.
namespace crossgrain::inline studies {

/// Part of a budget that one piece of work has; it counts from construction.
class TimeShare {
 public:
  /// @param seconds  infinite: as long as it takes
  explicit TimeShare(double seconds = std::numeric_limits<double>::infinity()) : all_(seconds) {}

  /// To be called before what is likely to take `seconds`. @throws OutOfTime where it would end
  /// later
  void require(double seconds) const;

 private:
  using Clock = std::chrono::steady_clock;
  double all_;  ///< [s]
  Clock::time_point began_ = Clock::now();
};

/// Budget that several pieces of work share. Each has an equal part of the time left when it
/// begins, so that a slow engine takes no other's time, and time that quick ones leave is used.
class TimeBudget {
 public:
  /// @param seconds  for all, from now on; infinite: as long as it takes
  /// @param pieces   of work, of which `jobs` are done at a time
  TimeBudget(double seconds, std::size_t pieces, int jobs)
      : all_(seconds), pieces_(pieces), jobs_(static_cast<std::size_t>(jobs)) {}

  /// Of the next piece; any thread may ask.
  TimeShare next();

 private:
  using Clock = std::chrono::steady_clock;
  double all_;  ///< [s]
  Clock::time_point began_ = Clock::now();
  std::mutex mutex_;
  std::size_t pieces_;  ///< not begun
  std::size_t jobs_;
};

/// Factor of a setting with that unit ("m", "m/s") in other units; absent: the unit is not known
/// here.
std::optional<double> factorOf(const std::string& unit, const Units& units);

/// An engine's settings for a scene in other units: those with a unit are multiplied, defaults
/// given explicitly. A 0 stays 0, whatever its unit.
/// @throws UnsupportedScene naming a setting whose unit is not known
Settings inUnits(Settings settings, const std::vector<SettingSpec>& specs, const Units& units);

// Criteria of verdicts, fixed before any engine was measured, each with its reason.

/// A fault shows in its first contacts; much later chaos has had its part.
inline constexpr std::uint64_t transformSteps = 2000;

/// Number of nudged runs. A scene in another description is rounded differently, at its start and
/// in every step. Each step may do as much harm as a rounding of the start: after n steps 1 + n
/// times the farthest that the engine's own run goes apart when its start is nudged. Nudges are
/// random; of several, one is likely to lie along the direction that grows most.
inline constexpr int transformNudges = 4;

/// Beyond this nothing is compared: runs that far apart do not share their contacts, whose overlaps
/// are as deep [d].
inline constexpr double transformBlind = 1e-2;

/// Factors of other units. Powers of two, whose products are not rounded; of a length a power of
/// four, as Hertz' law takes its root. All make numbers smaller, where a tolerance without a unit
/// shows: lengths, forces and speeds become a thousandth.
inline constexpr double transformSmaller = 0x1p-10, transformSlower = 0x1p10;

/// Seed of the random order of disks and of nudges.
inline constexpr std::uint64_t transformSeed = 22;

/// Origin of the run that the case's own is compared with.
enum class TransformRun {
  another,  ///< of the transformed scene
  restart,  ///< taken up from a checkpoint in the middle, by another worker
  oneGo     ///< of one advance, where the run itself has some forty snapshots
};

/// One transform, as in reports: a measure is a column, a name one of its rows.
struct CaseTransform {
  std::string measure, name;
  std::string must;  ///< requirement, one sentence
  Transform change = {};
  TransformRun run = TransformRun::another;
};

/// All of them, in the order of reports.
/// @param disks  of the scene
std::vector<CaseTransform> caseTransforms(std::size_t disks, int dimension = 2);

/// The name of a row: that of the transform, behind the case's variant where there is one.
std::string variantOf(const Case& setup, const CaseTransform& transform);

/// Rows that describe the transforms in reports of a case.
std::vector<HardCase> transformRows(const Case& setup);

/// One row for each of caseTransforms(): the value is how far the farthest disk is off [d] where
/// that is most by what rounding may do, the limit is what it may do there. Unstable: beyond that,
/// or the engine failed; refused: the engine cannot do what the transform takes, with the reason;
/// not run: what would have ended after its time.
/// @param task  its case needs no [stability]; `original` is not used
/// @throws Interrupted
std::vector<StabilityRun> runTransforms(const StabilityTask& task, const TimeShare& time,
                                        const std::function<void(double)>& progress);

/// StabilityProtocol::invariances: the same as one figure, the largest distance by what rounding
/// may do; the reason names what breaks.
/// @throws UnsupportedScene where nothing could be compared, EngineFailure
void judgeInvariances(StabilityRun& row, const StabilityTask& task,
                      const std::function<void(double)>& progress);

}  // namespace crossgrain::inline studies
