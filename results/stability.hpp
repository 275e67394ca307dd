#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "adapters/engine.hpp"
#include "results/head.hpp"
#include "results/scene_picture.hpp"
#include "results/schema.hpp"
#include "stability/verdict.hpp"

/// results.json of kind "stability": hard cases, and what engines made of them.
namespace crossgrain::inline results {

/// One variant of a hard case and what it is judged by.
struct HardCase {
  std::string name, variant, file;
  std::string tests;           ///< one sentence
  std::string measure;         ///< of stabilityMeasures()
  std::string what, unit;      ///< the measure's
  double limit = 0.0;          ///< up to here: stable
  double degradedLimit = 0.0;  ///< up to here: degraded
  std::string why;             ///< of the limits
  std::string toml;            ///< the merged document, printed

  void fields(auto& io) {
    io("case", name, aName);
    FIELDS(io, variant, file, tests, what, limit, degradedLimit, why, toml);
    io("measure", measure, aName);
    io("unit", unit, aUnit);
  }
};

/// A measure over time.
struct MeasureCurve {
  std::vector<double> time;   ///< [s]
  std::vector<double> value;  ///< in the measure's unit; NaN: not known

  void fields(auto& io) {
    io("t_s", time);
    io("value", value);
  }
};

/// One engine on one variant of a hard case.
struct StabilityRun {
  std::string engine, name, variant;  ///< name: the case's
  Status status = Status::finished;
  Verdict verdict = Verdict::notApplicable;
  std::string measure;
  std::optional<double> value;  ///< the largest that the measure was; absent: not measured
  double limit = 0.0, degradedLimit = 0.0;
  std::string unit;  ///< of value and limits
  /// Where the limit was passed first, or where an engine that failed was seen last.
  std::optional<long long> step;
  std::optional<double> time;       ///< of that [s]
  std::optional<double> worstTime;  ///< of the largest value, where the limit was passed [s]
  std::string reason;
  MeasureCurve curve;
  std::optional<ScenePicture> picture;  ///< of the worst moment, where the limit was passed
  std::optional<EffectiveParameters> effective;  ///< absent: the engine did not load the scene
  std::optional<Stats> stats;

  /// Kept by itself as soon as it is there.
  void fields(auto& io) {
    io("engine", engine, aName);
    io("case", name, aName);
    FIELDS(io, variant, status, value, limit, degradedLimit, step, reason, curve, picture, stats);
    io("verdict", verdict, stabilityNames);
    io("measure", measure, aName);
    io("unit", unit, aUnit);
    io("time_s", time);
    io.present("worst_time_s", worstTime);
    io("realised", effective);
  }
};

struct StabilityResults {
  ResultsHead head;
  std::optional<double> elapsed;  ///< [s]
  std::vector<EngineRow> engines;
  std::vector<HardCase> cases;
  std::vector<StabilityRun> runs;  ///< case by case, engine by engine

  void fields(auto& io) {
    head.fields(io);
    io.present("elapsed_s", elapsed);
    FIELDS(io, engines, cases, runs);
  }
};

}  // namespace crossgrain::inline results
