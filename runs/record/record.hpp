#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "adapters/engine_entry.hpp"
#include "cases/case.hpp"

namespace crossgrain::inline runs {

/// What is recorded of one engine: a snapshot at the start and after each of `looks` equal parts
/// of `time`, with contacts where the engine has any, and its stats at the end.
struct RecordOptions {
  std::optional<double> time;  ///< [s]; else 0.1 s of a cell, all of what else a case is
  std::size_t looks = 10;
};

/// What came of a recording.
struct Recorded {
  std::string version;        ///< of the engine; empty if it did not say
  double time = 0.0;          ///< that was reached [s]
  std::size_t exchanges = 0;  ///< requests in the file
  std::string failure;        ///< why the run ended early; empty: it did not
};

/// Runs one engine on the first scene of a case, of a cell packing 0, and writes every request and
/// answer to a file (adapters/worker/exchange.hpp) as they pass.
/// @throws UnsupportedScene, BadInput, and then there is no file; OutputError, Interrupted
Recorded recordRun(const EngineEntry& entry, const Case& setup, const std::filesystem::path& file,
                   const RecordOptions& options);

}  // namespace crossgrain::inline runs
