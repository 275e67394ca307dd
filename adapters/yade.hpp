#pragma once

#include <string>

#include "adapters/program_call.hpp"

namespace crossgrain {

/// How to start the worker that runs a scene on YADE: YADE executes engines/yade/worker.py, which
/// speaks the worker protocol.
/// The script is in engines/yade of dataFolder().
ProgramCall yadeCommand();

/// Why YADE cannot be run here, one line; empty if it can.
std::string yadeMissing();

}  // namespace crossgrain
