#pragma once

#include <string>
#include <vector>

#include "cli/command.hpp"

namespace crossgrain::inline cli {

/// Gives a program's help its form: lines that fit the terminal, commands in groups, and below all
/// of them exit statuses and environment. Commands that are added later have it too.
void formatHelp(CLI::App& program);

/// Below the options of a command's help: its examples.
std::string footerOf(const Command& command);

/// Words that can stand in place of the last one, which may be empty.
/// @param words  of a command line, without the program's name; as bash splits them, which makes
///               three of --option=value, or as other shells do
std::vector<std::string> completionsOf(const CLI::App& program,
                                       const std::vector<std::string>& words);

}  // namespace crossgrain::inline cli
