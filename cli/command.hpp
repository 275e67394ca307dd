#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "runs/common/run_store.hpp"

namespace CLI {
class App;
}

namespace crossgrain::inline cli {

/// Exit statuses, as design and README promise them.
enum ExitStatus {
  exitHeld = 0,
  exitFellShort = 1,
  exitBadInput = 2,
  exitEngineFailed = 3,  ///< or the machine: no room on the disk
  exitInterrupted = 130
};

/// What the option groups (option_groups.hpp) read; options of one command only are its own file's.
struct CommandLine {
  RunCommand run;
  std::vector<std::filesystem::path> inputs;  ///< case files, or result folders
  std::filesystem::path snapshots;            ///< file to average
  std::vector<std::string> overrides;         ///< --set, then what other options stand for
  std::optional<std::int64_t> seed;           ///< --seed: preparation.seed
  std::optional<std::string> only;            ///< -k: part of the cases
  bool quick = false;
  bool json = false;
};

/// What a command does once its options are parsed. @returns an ExitStatus
using Action = std::function<int()>;

/// A command of the program. A new one is a file that defines one of these, and a line in
/// commands.cpp. Names that begin with "__" are for the program itself: they are listed nowhere.
struct Command {
  const char* name;
  const char* what;      ///< in the list of commands, and at the head of its help
  const char* examples;  ///< lines that can be typed as they are
  /// Adds its options to `app`; both arguments outlive the action.
  Action (*declare)(CLI::App& app, CommandLine& line);
};

/// All of them, in the order of `crossgrain --help`.
const std::vector<const Command*>& commands();

bool isInternal(const Command& command);

/// The names of all others.
std::vector<std::string> publicCommands();

}  // namespace crossgrain::inline cli
