#include "cli/program.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <thread>
#include <vector>

#include "adapters/registry.hpp"
#include "cases/engine_file.hpp"
#include "cli/command.hpp"
#include "cli/parse_errors.hpp"
#include "cli/reference.hpp"
#include "runs/common/version.hpp"
#include "support/bad_input.hpp"
#include "support/input_file.hpp"
#include "support/json_text.hpp"
#include "support/nearest.hpp"

namespace crossgrain::inline cli {
namespace {

/// CLI11 would only say that some subcommand is required.
void requireKnownCommand(const std::string& name) {
  const std::vector<std::string> names = publicCommands();
  const bool known =
      std::ranges::any_of(commands(), [&](const Command* each) { return name == each->name; });
  if (!known)
    throw BadInput(fmt::format("there is no command '{}'{}", name, suggestion(name, names)));
}

}  // namespace

int runProgram(int argc, char** argv) {
  for (int k = 1; k < argc; ++k)
    if (!isUtf8(argv[k]))
      throw BadInput(fmt::format("argument {} ({}) is not UTF-8: results could not hold it", k,
                                 asOneLine(argv[k], 60)));
  CommandLine line;
  line.run.jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  line.run.commandLine =
      fmt::format("crossgrain {}", fmt::join(std::vector<std::string>(argv + 1, argv + argc), " "));

  CLI::App app{
      "crossgrain: one granular scene on several engines, averaged and held against each "
      "other",
      "crossgrain"};
  app.set_version_flag("-V,--version", programVersion);
  app.require_subcommand(1);
  app.footer(footer(nullptr));

  for (const auto& file : shelvedEngines()) addEngine(loadEngineFile(file));

  std::vector<Action> actions;
  for (const Command* command : commands()) {
    CLI::App* sub = app.add_subcommand(command->name, command->what);
    if (isInternal(*command))
      sub->group("");
    else
      sub->footer(footer(command));
    actions.push_back(command->declare(*sub, line));
  }

  if (const std::string first = argc > 1 ? argv[1] : "-"; first[0] != '-')
    requireKnownCommand(first);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& asked) {  // --help, --version
    return app.exit(asked);
  } catch (const CLI::ParseError& error) {
    throw BadInput(explain(error, app));
  }
  if (line.seed) line.overrides.push_back(fmt::format("preparation.seed={}", *line.seed));
  const auto asked = std::ranges::find_if(
      commands(), [&](const Command* command) { return app.got_subcommand(command->name); });
  return actions[static_cast<std::size_t>(asked - commands().begin())]();
}

}  // namespace crossgrain::inline cli
