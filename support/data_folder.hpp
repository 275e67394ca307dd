#pragma once

#include <filesystem>
#include <string>

namespace crossgrain::inline support {

/// The folder with what the program reads at run time: cases/ and engines/ (scripts that a peer
/// executes). In this order: $CROSSGRAIN_DATA; share/crossgrain beside the folder that the program
/// is in, as `cmake --install` lays it out, wherever that was moved to; the sources it was built
/// of.
std::filesystem::path dataFolder();

/// A path in cases/ that is not here is meant to be the one of dataFolder(): cases/hard works from
/// anywhere. All others stay as they are.
std::filesystem::path hereOrInstalled(const std::filesystem::path& path);

/// engines/ENGINE/worker.py of dataFolder().
std::filesystem::path workerScript(const std::string& engine);
/// One line if it is not there; empty if it is.
std::string workerScriptMissing(const std::string& engine);

}  // namespace crossgrain::inline support
