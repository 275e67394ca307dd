#pragma once

#include <functional>
#include <string>
#include <vector>

#include "studies/core/study.hpp"

namespace CLI {
class App;
}

namespace crossgrain::inline cli {

/// The work of a command once its options are parsed. @returns an ExitStatus
using Action = std::function<int()>;

/// A command of the program. A new one is one of these and a line in commands.cpp; that of a study
/// stands in studies.cpp. Names that begin with "__" are for the program itself: they are listed
/// nowhere.
struct Command {
  const char* name;
  const char* what;      ///< in the list of commands, and at the head of its help
  const char* examples;  ///< lines that can be typed as they are
  /// Adds its options to `app`; both arguments outlive the action.
  Action (*declare)(CLI::App& app, CommandLine& line);
};

/// Commands by what a user wants to know. Those without a question are for the program itself.
struct CommandGroup {
  const char* question;
  std::vector<const Command*> commands;
};

/// In the order of `crossgrain --help`.
const std::vector<CommandGroup>& commandGroups();

/// All of them, in that order.
const std::vector<const Command*>& commands();

/// `crossgrain __complete WORD …` prints what can stand in place of the last word.
inline constexpr const char* completingCommand = "__complete";

/// Names of those that are for users: internal ones begin with __.
std::vector<std::string> publicCommands();

/// @throws BadInput for a name that no command has, with the one that was meant or what a removed
/// one became
void requireKnownCommand(const std::string& name);

}  // namespace crossgrain::inline cli
