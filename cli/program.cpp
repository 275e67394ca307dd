#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gsl/gsl_errno.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <new>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <vector>

#include "adapters/registry.hpp"
#include "cases/engine_file.hpp"
#include "cli/command.hpp"
#include "cli/help.hpp"
#include "cli/outcome.hpp"
#include "reports/render/gnuplot.hpp"
#include "studies/core/engine_access.hpp"
#include "studies/core/run_store.hpp"
#include "studies/core/study.hpp"
#include "support/bad_input.hpp"
#include "support/files.hpp"
#include "support/input_file.hpp"
#include "support/interrupt.hpp"
#include "support/json_text.hpp"
#include "support/nearest.hpp"

namespace crossgrain::inline cli {
namespace {

bool isOption(const std::string& argument) {
  return argument.size() > 1 && argument[0] == '-';
}

std::vector<std::string> optionNames(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    if (!option->get_positional()) names.push_back(option->get_name());
  return names;
}

/// "case, --engines"
std::string namesOf(const std::vector<const CLI::Option*>& options) {
  std::vector<std::string> names;
  for (const CLI::Option* option : options) names.push_back(option->get_name());
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string oneTooMany(const std::string& argument, const CLI::App& command) {
  const auto arguments =
      command.get_options([](const CLI::Option* option) { return option->get_positional(); });
  return fmt::format("'{}' is one argument too many: {} takes {}", argument, command.get_name(),
                     arguments.empty() ? "none" : namesOf(arguments));
}

std::string unexpected(const std::vector<std::string>& extras, const CLI::App& command) {
  const auto unknown = std::ranges::find_if(extras, isOption);
  if (unknown != extras.end()) {
    const std::string name = unknown->substr(0, unknown->find('='));
    return fmt::format("there is no option '{}'{}", name, suggestion(name, optionNames(command)));
  }
  return oneTooMany(extras.front(), command);
}

std::string missing(const CLI::App& command) {
  const auto lacking = command.get_options(
      [](const CLI::Option* option) { return option->get_required() && option->count() == 0; });
  if (lacking.size() == 1)
    return fmt::format("{} is missing ({})", lacking.front()->get_name(),
                       lacking.front()->get_description());
  return fmt::format("{} are missing", namesOf(lacking));
}

/// CLI11's messages about one option begin with its name, "--jobs: …" or "Could not convert: --json
/// = …".
const CLI::Option* optionOf(const CLI::ParseError& error, const CLI::App& command) {
  std::string text = error.what();
  const std::string_view conversion = "Could not convert: ";
  if (text.starts_with(conversion)) text.erase(0, conversion.size());
  return command.get_option_no_throw(text.substr(0, text.find_first_of(": ")));
}

std::string wrongCount(const CLI::Option& option, const CLI::App& command) {
  if (option.get_positional() && option.count() > 0)
    return oneTooMany(option.results().back(), command);
  if (option.count() > 1) return option.get_name() + " is given twice";
  return fmt::format("{} needs a value ({})", option.get_name(), option.get_description());
}

std::string reason(const CLI::ParseError& error, const CLI::App& command) {
  if (const auto extras = command.remaining(); !extras.empty()) return unexpected(extras, command);
  const CLI::Option* option = optionOf(error, command);
  if (dynamic_cast<const CLI::RequiredError*>(&error)) return missing(command);
  if (option && dynamic_cast<const CLI::ArgumentMismatch*>(&error))
    return wrongCount(*option, command);
  if (dynamic_cast<const CLI::ExcludesError*>(&error)) {  // "--long excludes --quick"
    const std::string text = error.what(), between = " excludes ";
    const std::size_t at = text.find(between);
    return fmt::format("{} and {} do not go together", text.substr(0, at),
                       text.substr(at + between.size()));
  }
  if (option && option->get_expected_max() == 0) return option->get_name() + " takes no value";
  return error.what();
}

/// Why a command line was refused, in the words of this program, with the help that says what
/// would be right.
std::string explain(const CLI::ParseError& error, const CLI::App& app) {
  const auto commands = app.get_subcommands();
  const bool before = !app.remaining().empty();  // something stands before the command
  if (commands.empty() && !before) return "no command is given; see crossgrain --help";
  const bool ofCommand = !commands.empty() && !before;
  const CLI::App& asked = ofCommand ? *commands.front() : app;
  return fmt::format("{}; see crossgrain {}{}--help", reason(error, asked),
                     ofCommand ? asked.get_name() : "", ofCommand ? " " : "");
}

struct Removed {
  const char *name, *what;
};

/// Commands of earlier versions, and where what they did is now.
constexpr Removed removedCommands[] = {
    {"plan", "COMMAND … --shard K/N shares a command's runs among processes (docs/versions.md)"},
    {"rev", "crossgrain average FILES CASE --rev does its work"},
    {"scale", "cost CASE --disks N,N --threads P,P times steps as the scene grows and is shared"},
    {"thesis", "papers/laetzel-2003 judges the thesis' claims (README.md there)"}};

}  // namespace

/// CLI11 would only say that some subcommand is required.
void requireKnownCommand(const std::string& name) {
  const std::vector<std::string> names = publicCommands();
  for (const Removed& removed : removedCommands)
    if (name == removed.name)
      throw BadInput(fmt::format("there is no command '{}' any more: {}", name, removed.what));
  const bool known =
      std::ranges::any_of(commands(), [&](const Command* each) { return name == each->name; });
  if (!known)
    throw BadInput(fmt::format("there is no command '{}'{}", name, suggestion(name, names)));
}

namespace {

/// Parses a command line against the table of commands and does what it says.
/// @returns an ExitStatus @throws BadInput for a command line that cannot be understood, and
/// whatever its command throws
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
  formatHelp(app);

  for (const auto& file : installedEngineFiles()) addEngine(loadEngineFile(file));

  std::vector<Action> actions;
  for (const CommandGroup& group : commandGroups())
    for (const Command* command : group.commands) {
      CLI::App* sub = app.add_subcommand(command->name, command->what);
      sub->group(group.question);
      sub->footer(footerOf(*command));
      actions.push_back(command->declare(*sub, line));
    }

  const std::string first = argc > 1 ? argv[1] : "-";
  if (first == completingCommand) {
    for (const std::string& word : completionsOf(app, {argv + 2, argv + argc}))
      fmt::print("{}\n", word);
    return exitPassed;
  }
  if (first[0] != '-') requireKnownCommand(first);
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
  const int status = actions[static_cast<std::size_t>(asked - commands().begin())]();
  printNotes();
  return status;
}

/// Where standard input, output or error is closed, the next file to be opened would take its
/// number, and be read or written in its place.
void fillStandardDescriptors() {
  for (const int descriptor : {0, 1, 2})
    if (::fcntl(descriptor, F_GETFD) < 0)
      static_cast<void>(::open("/dev/null", descriptor == 0 ? O_WRONLY : O_RDONLY));
}

/// The rest of the buffer may not find a place. A reader that has seen enough (`| head`) ends
/// the program without a word, by SIGPIPE.
void flushOutput() {
  if (std::fflush(stdout) != 0 || std::ferror(stdout))
    throw std::system_error(errno, std::generic_category(), "standard output");
}

/// Every way to end, as one line on standard error and the status that goes with it.
int runAndExplain(int argc, char** argv) {
  const auto explain = [](const std::exception& error, int status) {
    printFailure(BadInput(error.what()).what());  // in one line
    return status;
  };
  try {
    const int status = runProgram(argc, argv);
    flushOutput();
    return status;
  } catch (const Interrupted& error) {
    return explain(error, exitInterrupted);
  } catch (const BadInput& error) {
    return explain(error, exitBadInput);
  } catch (const AllRefused& error) {
    for (const std::string& line : error.lines) explain(BadInput(line), exitBadInput);
    return exitBadInput;
  } catch (const UnsupportedScene& error) {
    return explain(error, exitBadInput);
  } catch (const EngineFailure& error) {
    return explain(error, exitEngineFailed);
  } catch (const OutputError& error) {
    // A folder that cannot be written is the user's to change; that the disk is full is not.
    return explain(error, error.noRoom ? exitEngineFailed : exitBadInput);
  } catch (const reports::GnuplotError& error) {
    return explain(error, error.failed ? exitEngineFailed : exitBadInput);
  } catch (const std::bad_alloc&) {
    return explain(std::runtime_error("out of memory"), exitEngineFailed);
  } catch (const std::exception& error) {
    return explain(error, exitBadInput);
  }
}

}  // namespace
}  // namespace crossgrain::inline cli

int main(int argc, char** argv) {
  gsl_set_error_handler_off();  // GSL's own would abort; its status codes are looked at
  crossgrain::fillStandardDescriptors();
  crossgrain::catchInterrupts();
  return crossgrain::runAndExplain(argc, argv);
}
