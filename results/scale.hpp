#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "results/engine_row.hpp"
#include "results/head.hpp"
#include "results/json_fields.hpp"

/// results.json of kind "scale": what a step takes as a cell grows and more workers share it.
namespace crossgrain::inline results {

/// One size of the cell.
struct ScaleCell {
  std::size_t disks = 0;        ///< that move
  std::size_t wallDisks = 0;    ///< of both walls
  double outerRadius = 0.0;     ///< [m]
  double volumeFraction = 0.0;  ///< of the whole ring, walls' share and all
  std::string packing;          ///< its fingerprint; empty: it was not needed
};

/// One engine on one size with so many workers.
struct ScalePoint {
  std::string engine;
  std::size_t disks = 0;
  int workers = 1;  ///< threads or ranks that share a step
  Status status = Status::finished;
  std::string reason;
  std::uint64_t steps = 0;           ///< that each repetition timed
  std::vector<double> seconds;       ///< wall time of a step in each repetition [s]
  std::optional<double> contacts;    ///< evaluated in a step
  std::optional<double> memory;      ///< most that its processes held together [bytes]
  std::string precision;             ///< that was used
  double dt = 0.0;                   ///< of the engine [s]
  std::vector<std::string> differs;  ///< what it does otherwise than the scene says
  std::string measured;              ///< when it was begun: ISO 8601, UTC

  /// Kept by itself as soon as it is there.
  void fields(auto& io) {
    io("engine", engine, aName);
    io("disks", disks);
    io("workers", workers);
    io("status", status, engineStatusNames);
    io("reason", reason);
    io("steps", steps);
    io("step_s", seconds);
    io("contacts_per_step", contacts);
    io("memory_bytes", memory);
    io("precision", precision, aName);
    io("dt_s", dt);
    io("differs", differs);
    io("measured", measured);
  }
};

/// What workers are to an engine: "threads", "ranks"; empty: it has one.
struct ScaleSharing {
  std::string engine, workers;
};

struct ScaleResults {
  ResultsHead head;
  std::optional<double> elapsed;  ///< [s]
  std::size_t repetitions = 0;
  std::vector<EngineRow> engines;
  std::vector<ScaleSharing> sharing;  ///< of the engines, in their order
  std::vector<ScaleCell> cells;       ///< from small to large
  std::vector<ScalePoint> points;     ///< by size, engine and workers
};

/// "1 thread", "2 threads"; "one process" of an engine that has no workers.
std::string describeWorkers(const ScaleSharing& sharing, int workers);

/// What follows from a point and the others of its engine. All of it is absent where it did not
/// run or what it is compared with did not.
struct ScaleFigures {
  std::optional<double> step;     ///< wall time of the fastest repetition's step [s]
  std::optional<double> spread;   ///< (slowest − fastest)/fastest; of one repetition none
  std::optional<double> perDisk;  ///< step / disks [s]
  std::optional<double> bytes;    ///< memory / disks
  std::optional<double> ratio;    ///< step over that of the first engine, one worker, same size
  /// T(1, N)/(p T(p, N)): of one worker's time, shared by p, on the same cell. Absent for p = 1.
  std::optional<double> strong;
  /// T(1, N/p)/T(p, N): each worker has as many disks as the one of the smaller cell had.
  std::optional<double> weak;
};

/// @param point  one of `results`
ScaleFigures scaleFigures(const ScaleResults& results, const ScalePoint& point);

/// Null where there is none.
const ScalePoint* scalePoint(const ScaleResults& results, const std::string& engine,
                             std::size_t disks, int workers);

nlohmann::json toJson(const ScaleResults& results);
/// @throws FieldError
ScaleResults scaleFromJson(const nlohmann::json& json);

}  // namespace crossgrain::inline results
