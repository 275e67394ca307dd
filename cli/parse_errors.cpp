#include "cli/parse_errors.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

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
  if (option && option->get_expected_max() == 0) return option->get_name() + " takes no value";
  return error.what();
}

}  // namespace

std::string explain(const CLI::ParseError& error, const CLI::App& app) {
  const auto commands = app.get_subcommands();
  const bool before = !app.remaining().empty();  // something stands before the command
  if (commands.empty() && !before) return "no command is given; see crossgrain --help";
  const bool ofCommand = !commands.empty() && !before;
  const CLI::App& asked = ofCommand ? *commands.front() : app;
  return fmt::format("{}; see crossgrain {}{}--help", reason(error, asked),
                     ofCommand ? asked.get_name() : "", ofCommand ? " " : "");
}

}  // namespace crossgrain::inline cli
