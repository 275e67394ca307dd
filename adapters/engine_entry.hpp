#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "adapters/engine.hpp"
#include "adapters/program_call.hpp"

namespace crossgrain {

/// How to start an engine: in this process through `make`, or as a worker of its own; or the files
/// that it left.
struct EngineEntry {
  std::string name;
  std::string summary;  ///< one line for `crossgrain engines`
  /// Makes the engine in the calling process; empty for engines that are programs of their own.
  std::function<std::unique_ptr<Engine>()> make = {};
  /// The worker program; empty: `crossgrain __serve NAME`.
  std::function<ProgramCall()> command = {};
  /// Why it cannot be run here, one line; empty if it can.
  std::function<std::string()> missing = {};
  /// A mirror is the in-house engine set to a peer's conventions: that peer's name, else empty.
  std::string mirrors = {};
  /// Of a mirror: the normal laws (lawOptionValue) of scenes in which it stands for that peer.
  std::vector<std::string> mirrorsNormal = {};
  /// Values of the engine's settings where the case gives none.
  Settings settings = {};
  /// Files of runs that another program made, in place of one to start: run by run, those of one
  /// run by time; and their format.
  std::vector<std::vector<std::filesystem::path>> files = {};
  std::string format = {};

  bool ofFiles() const { return !files.empty(); }
};

}  // namespace crossgrain
