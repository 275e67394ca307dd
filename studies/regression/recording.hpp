#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include "adapters/engine_entry.hpp"
#include "adapters/worker/worker_engine.hpp"
#include "cases/case.hpp"
#include "results/regression.hpp"
#include "studies/core/study.hpp"

/// The file format of baselines and recordings: a head, then records, each
///
///     a line of JSON, an object; "bytes" is the number of bytes that follow it
///     these bytes: arrays, in the layout of the worker protocol (adapters/worker/README.md)
///     a line with a checksum of both: 64 bits of FNV-1a as 16 hexadecimal digits
///
/// The head is a record, too. Its key "crossgrain" is the format, "baseline-3" or "recording-2".
/// One run as such a file of every request and answer, and the same requests put to an engine
/// again.
namespace crossgrain::inline studies {

struct Record {
  nlohmann::json line;
  std::string bytes;
};

/// A record as it is written.
std::string textOf(const Record& record);

/// @param head  an object, to which the format is added
std::string headText(std::string_view format, nlohmann::json head);

/// Reads such a file, whoever made it; nothing in it is trusted.
class RecordReader {
 public:
  /// @param format  "baseline-3": a file of another one is refused
  /// @throws BadInput naming the file: missing, no such file of records, damaged
  RecordReader(const std::filesystem::path& file, std::string_view format);

  const nlohmann::json& head() const { return head_; }

  /// The next record; absent at the end. @throws BadInput naming the file: cut off, malformed, or
  /// not what its checksum says
  std::optional<Record> next();

  /// The next record, which must be there. @throws BadInput
  Record require();

  /// Records read so far, besides the head.
  std::size_t count() const { return count_; }

 private:
  std::filesystem::path file_;
  std::ifstream in_;
  std::uintmax_t length_ = 0;
  std::size_t count_ = 0;
  nlohmann::json head_;
};

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
