#include <string_view>

#include "cli/command.hpp"

namespace crossgrain::inline cli {

// In files of their names; diff with baseline, replay with record.
extern const Command enginesCommand, listCommand, checkCommand, collideCommand, conformanceCommand,
    lockstepCommand, identifyCommand, baselineCommand, diffCommand, recordCommand, replayCommand,
    compareCommand, effectsCommand, stabilityCommand, costCommand, averageCommand, importCommand,
    exportCommand, calibrateCommand, reportCommand, helpCommand, serveCommand;

const std::vector<const Command*>& commands() {
  static const std::vector<const Command*> table = {
      &enginesCommand,  &listCommand,     &checkCommand,    &collideCommand,   &conformanceCommand,
      &lockstepCommand, &identifyCommand, &baselineCommand, &diffCommand,      &recordCommand,
      &replayCommand,   &compareCommand,  &effectsCommand,  &stabilityCommand, &costCommand,
      &importCommand,   &averageCommand,  &exportCommand,   &calibrateCommand, &reportCommand,
      &helpCommand,     &serveCommand};
  return table;
}

bool isInternal(const Command& command) {
  return std::string_view(command.name).starts_with("__");
}

std::vector<std::string> publicCommands() {
  std::vector<std::string> names;
  for (const Command* command : commands())
    if (!isInternal(*command)) names.emplace_back(command->name);
  return names;
}

}  // namespace crossgrain::inline cli
