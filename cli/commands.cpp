#include <string_view>

#include "cli/command.hpp"

namespace crossgrain::inline cli {

// In files of their names; diff with baseline, replay with record.
extern const Command enginesCommand, listCommand, checkCommand, collideCommand, conformanceCommand,
    lockstepCommand, identifyCommand, baselineCommand, diffCommand, recordCommand, replayCommand,
    compareCommand, effectsCommand, stabilityCommand, costCommand, averageCommand, importCommand,
    exportCommand, calibrateCommand, reportCommand, completionCommand, helpCommand, serveCommand;

const std::vector<CommandGroup>& commandGroups() {
  static const std::vector<CommandGroup> table = {
      {"Check an engine (is it right, did an upgrade change it?)",
       {&conformanceCommand, &lockstepCommand, &identifyCommand, &baselineCommand, &diffCommand,
        &recordCommand, &replayCommand}},
      {"Compare (do engines, or results that are there, agree on a scene?)",
       {&checkCommand, &compareCommand, &averageCommand, &importCommand}},
      {"Accuracy, cost, hard cases (what is an engine good for?)",
       {&collideCommand, &effectsCommand, &costCommand, &stabilityCommand}},
      {"Tools",
       {&enginesCommand, &listCommand, &calibrateCommand, &exportCommand, &reportCommand,
        &completionCommand, &helpCommand}},
      {"", {&serveCommand}}};
  return table;
}

const std::vector<const Command*>& commands() {
  static const std::vector<const Command*> all = [] {
    std::vector<const Command*> list;
    for (const CommandGroup& group : commandGroups())
      list.insert(list.end(), group.commands.begin(), group.commands.end());
    return list;
  }();
  return all;
}

std::vector<std::string> publicCommands() {
  std::vector<std::string> names;
  for (const Command* command : commands())
    if (!std::string_view(command->name).starts_with("__")) names.emplace_back(command->name);
  return names;
}

}  // namespace crossgrain::inline cli
