#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "adapters/engine_entry.hpp"
#include "adapters/worker/worker_engine.hpp"
#include "cases/case.hpp"
#include "results/regression.hpp"
#include "studies/core/study.hpp"
#include "studies/regression/record_file.hpp"

/// One run as a file of every request and answer, and the same requests put to an engine again.
namespace crossgrain::inline studies {

inline constexpr const char* recordingFormat = "recording-2";

/// An exchange as a record of the file, and back. @throws std::exception where it is none
Record recordOf(const Exchange& exchange);
Exchange exchangeOf(Record record);

/// Record of one engine: a snapshot at the start and after each of `snapshots` equal
/// parts of `time`, with contacts where the engine has any, and its stats at the end.
struct RecordOptions {
  std::optional<double> time;  ///< [s]; else 0.1 s of a cell, all of what else a case is
  std::size_t snapshots = 10;
};

struct Recorded {
  std::string version;        ///< of the engine; empty if it did not say
  double time = 0.0;          ///< that was reached [s]
  std::size_t exchanges = 0;  ///< requests in the file
  std::string failure;        ///< why the run ended early; empty: it did not
};

/// Runs one engine on the first scene of a case, of a cell packing 0, and writes every request and
/// answer to a file as they pass: what breaks down next loses nothing.
/// @throws UnsupportedScene, BadInput, and then there is no file; OutputError, Interrupted
Recorded recordRun(const EngineEntry& entry, const Case& setup, const std::filesystem::path& file,
                   const RecordOptions& options);

/// Puts the requests of a recording to an engine and stops at the first answer that differs.
/// The engine is the caller's: the file names none that would be started.
/// @param tolerance  see answerDifferences()
/// @throws BadInput for what is no recording, or cannot be asked again
ReplayResults replayRun(const std::filesystem::path& recording, const EngineEntry& entry,
                        double tolerance);

/// An engine that failed, then an answer or a declaration that differs.
Outcome outcomeOf(const ReplayResults& results);

}  // namespace crossgrain::inline studies
