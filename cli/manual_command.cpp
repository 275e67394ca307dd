#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <fstream>
#include <memory>

#include "cli/option_groups.hpp"
#include "cli/reference.hpp"
#include "runs/common/run_store.hpp"
#include "support/bad_input.hpp"

namespace crossgrain::inline cli {

namespace fs = std::filesystem;

namespace {

/// Text as roff takes it: no line begins with a control character, minus signs stay minus signs.
std::string roff(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
    if (c == '\n') out += "\\&";
  }
  return out.starts_with('.') || out.starts_with('\'') ? "\\&" + out : out;
}

std::string entry(const std::string& term, const std::string& what) {
  return fmt::format(".TP\n{}\n{}\n", term, roff(what));
}

std::string head(const std::string& page, const std::string& what) {
  return fmt::format(".TH {} 1 \"\" \"crossgrain {}\" \"User commands\"\n.SH NAME\n{} \\- {}\n",
                     roff(page), programVersion, roff(page), roff(what));
}

/// "--jobs N", "case FILE"
std::string optionTerm(const CLI::Option& option) {
  const std::string value = option.get_expected_max() > 0 ? option.get_type_name() : "";
  return fmt::format("\\fB{}\\fR{}", roff(option.get_name(false, true)),
                     value.empty() ? "" : " \\fI" + roff(value) + "\\fR");
}

std::string optionEntries(const CLI::App& command, bool positional) {
  std::string text;
  for (const CLI::Option* option : command.get_options())
    if (option->get_positional() == positional)
      text += entry(optionTerm(*option), option->get_description());
  return text;
}

std::string ending() {
  std::string text = ".SH EXIT STATUS\n";
  for (const Named& status : exitStatuses()) text += entry(status.name, status.what);
  text += ".SH ENVIRONMENT\n";
  for (const Named& variable : environmentVariables()) text += entry(variable.name, variable.what);
  return text;
}

std::string commandPage(const Command& command, const CLI::App& app) {
  std::string text = head("crossgrain-" + app.get_name(), command.what);
  text +=
      fmt::format(".SH SYNOPSIS\n\\fBcrossgrain {}\\fR {}\n", app.get_name(), roff(synopsis(app)));
  if (const std::string arguments = optionEntries(app, true); !arguments.empty())
    text += ".SH ARGUMENTS\n" + arguments;
  text += ".SH OPTIONS\n" + optionEntries(app, false);
  text += ".SH EXAMPLES\n.nf\n";
  for (const std::string& example : examplesOf(command)) text += roff(example) + "\n";
  return text + ".fi\n" + ending() + ".SH SEE ALSO\n.BR crossgrain (1)\n";
}

std::string mainPage(const CLI::App& program) {
  std::string text = head("crossgrain", program.get_description());
  text += ".SH SYNOPSIS\n\\fBcrossgrain\\fR \\fICOMMAND\\fR [\\fIOPTIONS\\fR]\n.SH COMMANDS\n";
  for (const Command* command : commands())
    if (!isInternal(*command))
      text += entry(fmt::format("\\fBcrossgrain\\-{}\\fR(1)", command->name), command->what);
  return text + ".SH OPTIONS\n" + optionEntries(program, false) + ending();
}

/// One page for the program and one for each command, as files crossgrain[-COMMAND].1.
int writePages(const CLI::App& program, const fs::path& folder) {
  fs::create_directories(folder);
  const auto write = [&](const std::string& name, const std::string& text) {
    std::ofstream out(folder / (name + ".1"));
    out << text;
    if (!out.flush()) throw BadInput(fmt::format("{}: cannot be written", folder.string()));
  };
  write("crossgrain", mainPage(program));
  for (const Command* command : commands())
    if (!isInternal(*command))
      write(fmt::format("crossgrain-{}", command->name),
            commandPage(*command, *program.get_subcommand(command->name)));
  return exitHeld;
}

Action declareManual(CLI::App& app, CommandLine&) {
  const auto folder = std::make_shared<std::string>();
  addArgument(app, "folder", *folder, "for the pages");
  return [&app, folder] { return writePages(*app.get_parent(), *folder); };
}

}  // namespace

extern const Command manualCommand = {"__manual", "write manual pages", "", declareManual};

}  // namespace crossgrain::inline cli
