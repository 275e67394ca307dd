#pragma once

#include <string>
#include <vector>

#include "cli/command.hpp"

namespace crossgrain::inline cli {

/// What --help and the manual pages say of all commands.
struct Named {
  std::string name, what;
};

const std::vector<Named>& exitStatuses();

/// Those that the program reads.
const std::vector<Named>& environmentVariables();

/// The lines of Command::examples.
std::vector<std::string> examplesOf(const Command& command);

/// What stands below the options of a command's help, or of the program's (null).
std::string footer(const Command* command);

/// "case --engines NAMES --out FOLDER [options]"
std::string synopsis(const CLI::App& command);

}  // namespace crossgrain::inline cli
