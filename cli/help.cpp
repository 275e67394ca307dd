#include "cli/help.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <sstream>

#include "support/terminal.hpp"

namespace crossgrain::inline cli {
namespace {

struct Named {
  const char *name, *what;
};

constexpr Named exitStatuses[] = {
    {"0",
     "passed; undecided and borderline verdicts and refused engines are counted in the output"},
    {"1",
     "engines disagree, a check failed, a run is unstable, or nothing was judged (one engine alone "
     "and --quick: only with --strict)"},
    {"2", "bad input, or no engine named can run the case; nothing was run"},
    {"3", "an engine failed, or the disk is full (outranks 1)"},
    {"130", "interrupted"}};

/// Those that the program reads.
constexpr Named environmentVariables[] = {
    {"COLUMNS", "width of a line (default: the terminal's, else 80)"},
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

constexpr std::size_t leftColumn = 26;

std::size_t width() {
  return terminalWidth(STDOUT_FILENO);
}

/// A name and what it is, in two columns; below each other where the name is too long.
std::string entry(const std::string& name, const std::string& what, std::size_t column) {
  std::string line = padded("  " + name, column), text;
  if (displayWidth(line) > column || line.back() != ' ') {
    text = wrapped("  " + name, width(), 6) + "\n";
    line = std::string(column, ' ');
  }
  return text + wrapped(line + what, width(), column) + "\n";
}

class Help final : public CLI::Formatter {
 public:
  std::string make_option(const CLI::Option* option, bool isPositional) const override {
    return entry(make_option_name(option, isPositional) + make_option_opts(option),
                 make_option_desc(option), leftColumn);
  }
  std::string make_subcommand(const CLI::App* command) const override {
    return entry(command->get_name(), command->get_description(), 15);
  }
  std::string make_description(const CLI::App* app) const override {
    return wrapped(app->get_description(), width(), 0) + "\n\n";
  }
  std::string make_usage(const CLI::App* app, std::string name) const override {
    return wrappedLines(CLI::Formatter::make_usage(app, std::move(name)), width());
  }
  std::string make_footer(const CLI::App* app) const override {
    if (app->get_parent()) return app->get_footer();
    std::string text = "Exit status:\n";
    for (const Named& status : exitStatuses) text += entry(status.name, status.what, 7);
    text += "\nEnvironment:\n";
    for (const Named& variable : environmentVariables)
      text += entry(variable.name, variable.what, 22);
    return text + "\n" + app->get_footer();
  }
};

}  // namespace

void formatHelp(CLI::App& program) {
  program.formatter(std::make_shared<Help>());
  program.footer("Help of a command, with examples: crossgrain COMMAND --help\n");
}

std::string footerOf(const Command& command) {
  std::istringstream examples(command.examples);
  std::string text = "Examples:\n";
  for (std::string line; std::getline(examples, line);) {
    const std::size_t comment = line.find("    #");
    if (comment != line.npos) text += "  " + line.substr(comment + 4) + "\n";
    text += wrapped("  " + line.substr(0, comment), width(), 6, " \\") + "\n";
  }
  return text + "\nExit status and environment: crossgrain --help\n";
}

}  // namespace crossgrain::inline cli
