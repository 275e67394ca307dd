#pragma once

namespace crossgrain::inline cli {

/// Parses a command line against the table of commands and does what it says.
/// @returns an ExitStatus @throws BadInput for a command line that cannot be understood, and
/// whatever its command throws
int runProgram(int argc, char** argv);

}  // namespace crossgrain::inline cli
