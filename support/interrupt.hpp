#pragma once

#include <stdexcept>
#include <string>

namespace crossgrain::inline support {

/// The user pressed Ctrl-C (or sent SIGTERM); what was finished is on disk.
struct Interrupted : std::runtime_error {
  explicit Interrupted(const std::string& what = "interrupted") : std::runtime_error(what) {}
};

/// From now on SIGINT and SIGTERM only set a flag; a second SIGINT ends the program at once.
void catchInterrupts();

bool interrupted();

/// @throws Interrupted if the flag is set
void throwIfInterrupted();

}  // namespace crossgrain::inline support
