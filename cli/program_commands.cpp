#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include "adapters/grain.hpp"
#include "adapters/registry.hpp"
#include "adapters/worker/serve.hpp"
#include "cli/option_groups.hpp"
#include "studies/core/mirrors.hpp"
#include "support/bad_input.hpp"

namespace crossgrain::inline cli {

namespace {

int help(const CLI::App& program, const std::optional<std::string>& name) {
  const CLI::App* asked = &program;
  if (name) {
    requireKnownCommand(*name);
    asked = program.get_subcommand(*name);
  }
  // App::help() would show the command that is running.
  fmt::print("{}",
             program.get_formatter()->make_help(asked, name ? "crossgrain " + *name : "crossgrain",
                                                CLI::AppFormatMode::Normal));
  return exitPassed;
}

Action declareHelp(CLI::App& app, CommandLine&) {
  const auto name = std::make_shared<std::optional<std::string>>();
  app.add_option("command", *name, "one of those that crossgrain --help lists")
      ->type_name("COMMAND");
  return [&app, name] { return help(*app.get_parent(), *name); };
}

/// @param conventions  "tension=cut", "lever_arm=radius,contact_point": of a mirror that is made
/// for
///                     an engine of the user's
int serveEngine(const std::string& name, const std::vector<std::string>& conventions) {
  const EngineEntry* entry = findEngine(name);
  if (!entry || !entry->make) throw BadInput(fmt::format("there is no engine '{}' to serve", name));
  if (conventions.empty()) return serve(*entry->make());
  return serve(*makeGrainMirror(conventionsFromWords(conventions)));
}

Action declareServe(CLI::App& app, CommandLine&) {
  const auto engine = std::make_shared<std::string>();
  const auto conventions = std::make_shared<std::vector<std::string>>();
  addArgument(app, "engine", *engine, "its name");
  app.add_option("conventions", *conventions, "that it has");
  return [engine, conventions] { return serveEngine(*engine, *conventions); };
}

}  // namespace

extern const Command helpCommand = {"help", "print the help of a command, as --help does",
                                    "crossgrain help compare", declareHelp};

extern const Command serveCommand = {"__serve", "speak the worker protocol on descriptors 3 and 4",
                                     "", declareServe};

}  // namespace crossgrain::inline cli
