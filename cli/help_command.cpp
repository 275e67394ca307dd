#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "cli/option_groups.hpp"
#include "support/bad_input.hpp"
#include "support/nearest.hpp"

namespace crossgrain::inline cli {
namespace {

int help(const CLI::App& program, const std::optional<std::string>& name) {
  const CLI::App* asked = &program;
  if (name) {
    const std::vector<std::string> names = publicCommands();
    if (std::ranges::find(names, *name) == names.end())
      throw BadInput(fmt::format("there is no command '{}'{}", *name, suggestion(*name, names)));
    asked = program.get_subcommand(*name);
  }
  // App::help() would show the command that is running.
  fmt::print("{}",
             program.get_formatter()->make_help(asked, name ? "crossgrain " + *name : "crossgrain",
                                                CLI::AppFormatMode::Normal));
  return exitHeld;
}

Action declareHelp(CLI::App& app, CommandLine&) {
  const auto name = std::make_shared<std::optional<std::string>>();
  app.add_option("command", *name, "one of those that crossgrain --help lists")
      ->type_name("COMMAND");
  return [&app, name] { return help(*app.get_parent(), *name); };
}

}  // namespace

extern const Command helpCommand = {"help", "the help of a command, as with --help",
                                    "crossgrain help compare", declareHelp};

}  // namespace crossgrain::inline cli
