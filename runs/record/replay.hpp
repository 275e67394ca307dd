#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "adapters/engine_entry.hpp"
#include "adapters/worker/exchange_difference.hpp"

namespace crossgrain::inline runs {

/// What an engine answered to the requests of a recording.
struct Replayed {
  std::string engine, version;  ///< that answered now
  std::string recordedEngine, recordedVersion;
  std::string recordedStamp;  ///< of its program; empty for engines of this one
  std::string caseName;
  std::size_t asked = 0;  ///< requests, the one of `request` being the last
  /// What the engine says of itself, in answer to hello and load, that it did not: told, and the
  /// replay goes on.
  std::vector<AnswerDifference> declared;
  /// The first other request answered otherwise.
  std::string request;  ///< in words; empty: all were answered alike
  std::vector<AnswerDifference> differences;
  std::string failure;  ///< of the engine, now; it may be the one that was recorded
};

/// Asks an engine what a recording asked another and stops at the first answer that differs.
/// The engine is the caller's: the file names none that would be started.
/// @param tolerance  see answerDifferences()
/// @throws BadInput for what is no recording, or cannot be asked again
Replayed replayRun(const std::filesystem::path& recording, const EngineEntry& entry,
                   double tolerance);

}  // namespace crossgrain::inline runs
