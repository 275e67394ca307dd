#pragma once

#include <string>

#include "adapters/program_call.hpp"

namespace crossgrain {

/// How to start the worker that runs a scene on LAMMPS: Python executes engines/lammps/worker.py,
/// which calls LAMMPS' C library and speaks the worker protocol.
/// The script is in engines/lammps of dataFolder().
ProgramCall lammpsCommand();

/// Why LAMMPS cannot be run here, one line; empty if it can.
std::string lammpsMissing();

}  // namespace crossgrain
