#include "cli/program.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "adapters/registry.hpp"
#include "cases/engine_file.hpp"
#include "cases/engine_shelf.hpp"
#include "cli/command.hpp"
#include "cli/parse_errors.hpp"
#include "runs/common/version.hpp"
#include "support/bad_input.hpp"
#include "support/input_file.hpp"
#include "support/json_text.hpp"
#include "support/nearest.hpp"

namespace crossgrain::inline cli {
namespace {

/// What --help says of all commands.
struct Named {
  const char *name, *what;
};

constexpr Named exitStatuses[] = {
    {"0", "passed; what is undecided is counted in the output"},
    {"1",
     "engines disagree, or something failed or is unstable (an engine failed the law that it "
     "declares; the scene's only under --strict)"},
    {"2", "bad input: nothing was judged"},
    {"3", "an engine failed, or the disk is full (outranks 1)"},
    {"130", "interrupted"}};

/// Those that the program reads.
constexpr Named environmentVariables[] = {
    {"CROSSGRAIN_CACHE",
     "folder that prepared packings are kept in; else XDG_CACHE_HOME/crossgrain, else "
     "~/.cache/crossgrain. It may be removed at any time: packings are then prepared anew"},
    {"CROSSGRAIN_DATA",
     "folder that holds cases/ and the scripts in engines/ (default: share/crossgrain where the "
     "program is installed, else its sources)"},
    {"NO_COLOR", "set to anything: no colours on the terminal"},
    {"GRAIN_INSTRUCTIONS",
     "baseline, avx2 or avx512: instructions that the in-house engine uses "
     "(default: the best there are; all give the same bits)"},
    {"TMPDIR", "folder for scratch files (default: /tmp)"}};

/// Below the options of a command's help, or of the program's (null).
std::string footer(const Command* command) {
  std::string text;
  if (command) {
    std::istringstream examples(command->examples);
    text = "Example:\n";
    for (std::string line; std::getline(examples, line);)
      text += "  " + line.substr(line.find_first_not_of(' ')) + "\n";
    text += "\n";
  }
  text += "Exit status:\n";
  for (const Named& status : exitStatuses)
    text += fmt::format("  {:<5}{}\n", status.name, status.what);
  text += "\nEnvironment:\n";
  for (const Named& variable : environmentVariables)
    text += fmt::format("  {}  {}\n", variable.name, variable.what);
  return text.substr(0, text.size() - 1);
}

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

  CLI::App app{"crossgrain: one granular scene on several engines, averaged and compared",
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
