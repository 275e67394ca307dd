#pragma once

#include <filesystem>
#include <string>

namespace crossgrain {

/// engines/ENGINE/worker.py of dataFolder().
std::filesystem::path workerScript(const std::string& engine);

/// One line if it is not there; empty if it is.
std::string workerScriptMissing(const std::string& engine);

}  // namespace crossgrain
