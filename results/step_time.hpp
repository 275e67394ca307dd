#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "results/head.hpp"
#include "results/json_fields.hpp"

namespace crossgrain::inline results {

/// Names in files of the fate of a point or timing. Failed: its engine broke down, or the step
/// was beyond its stability limit; refused: its engine has no such setting; not run: the budget did
/// not allow it.
inline constexpr support::EnumNames<Status, 4> costStatusNames{{{Status::finished, "ran"},
                                                                {Status::failed, "failed"},
                                                                {Status::refused, "refused"},
                                                                {Status::notRun, "undecided"}}};

/// Time of a step of one engine on a scene of one size, shared by so many workers: a row of
/// scale.csv.
struct StepTime {
  std::string engine;
  std::size_t bodies = 0;  ///< that move
  int workers = 1;         ///< threads or ranks that share a step
  std::string workersAre;  ///< "threads", "ranks"; empty: the engine has one process
  Status status = Status::finished;
  std::string reason;
  std::uint64_t steps = 0;           ///< that each round timed
  std::vector<double> seconds;       ///< wall time of a step in each round [s]
  double step = 0.0;                 ///< their geometric mean [s]
  std::optional<double> low, high;   ///< ends of its 95 % interval; absent of a single round [s]
  std::optional<double> contacts;    ///< evaluated in a step
  std::optional<double> memory;      ///< most that its processes held together [bytes]
  std::string precision;             ///< that was used
  double dt = 0.0;                   ///< of the engine [s]
  std::vector<std::string> differs;  ///< deviations from the scene
  std::string measured;              ///< when it was begun: ISO 8601, UTC

  bool ran() const { return status == Status::finished && !seconds.empty(); }

  void fields(auto& io) {
    io("engine", engine, aName);
    io("disks", bodies);
    FIELDS(io, workers, workersAre, reason, steps, differs, measured);
    io("status", status, costStatusNames);
    io("step_s", seconds);
    io("mean_s", step);
    io("low_s", low);
    io("high_s", high);
    io("contacts_per_step", contacts);
    io("memory_bytes", memory);
    io("precision", precision, aName);
    io("dt_s", dt);
  }
};

/// Figures of a step's time and of the others of its engine. Absent where it did not run, or that
/// with which it is compared.
struct StepFigures {
  std::optional<double> step;     ///< [s]
  std::optional<double> spread;   ///< (slowest − fastest)/fastest round; of a single one none
  std::optional<double> perBody;  ///< step / bodies [s]
  std::optional<double> bytes;    ///< memory / bodies
  std::optional<double> ratio;    ///< step over that of the first engine, one worker, same size
  /// T(1, N)/(p T(p, N)): of one worker's time, shared by p, on the same scene. Absent for p = 1.
  std::optional<double> strong;
  /// T(1, N/p)/T(p, N): each worker has as many bodies as the one of the smaller scene had.
  std::optional<double> weak;
};

/// @param of  one of `times`
StepFigures stepFigures(const std::vector<StepTime>& times, const StepTime& of);

/// "1 thread", "2 threads"; "one process" of an engine that has no workers.
std::string describeWorkers(const StepTime& of);

}  // namespace crossgrain::inline results
