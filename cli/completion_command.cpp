#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <map>
#include <string>

#include "adapters/registry.hpp"
#include "cli/option_groups.hpp"

namespace crossgrain::inline cli {
namespace {

/// What a value of an option can be, by the name of its type; none: anything, or a file.
std::vector<std::string> valuesOf(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  if (type == "COMMAND") return publicCommands();
  std::vector<std::string> values;
  if (type == "NAMES") {
    values.emplace_back("all");
    for (const EngineEntry& engine : engineRegistry()) values.push_back(engine.name);
  }
  if (type.find('|') != std::string::npos) values = CLI::detail::split(type, '|');
  return values;
}

std::vector<std::string> optionWords(const CLI::App& command) {
  std::vector<std::string> words;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) words.push_back("--" + name);
  return words;
}

/// Bash's, which needs no other package. Where it has nothing to say, bash completes files.
std::string bashCompletion(const CLI::App& program) {
  std::string words, values;
  std::map<std::string, std::vector<std::string>> valuesByOption;
  for (const std::string& name : publicCommands()) {
    const CLI::App& command = *program.get_subcommand(name);
    std::vector<std::string> arguments;
    for (const CLI::Option* option : command.get_options()) {
      if (option->get_positional()) {
        const auto more = valuesOf(*option);
        arguments.insert(arguments.end(), more.begin(), more.end());
      } else if (const auto some = valuesOf(*option); !some.empty()) {
        valuesByOption[option->get_name()] = some;
      }
    }
    words += fmt::format("    {}) options=\"{}\" words=\"{}\" ;;\n", name,
                         fmt::join(optionWords(command), " "), fmt::join(arguments, " "));
  }
  for (const auto& [option, some] : valuesByOption)
    values += fmt::format("    {}) words=\"{}\" ;;\n", option, fmt::join(some, " "));
  return fmt::format(R"(# Completion of crossgrain for bash, made by the program itself.
_crossgrain() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD - 1]}}
  local options="{1}" words="{0}" given=""
  # Bash takes --option=value apart.
  if [[ $current == "=" ]]; then
    current=""
  elif [[ $previous == "=" ]]; then
    previous=${{COMP_WORDS[COMP_CWORD - 2]}}
  fi
  if ((COMP_CWORD > 1)); then
    options="" words=""
    case ${{COMP_WORDS[1]}} in
{2}    esac
  fi
  case $previous in
{3}  esac
  if [[ $current == -* ]]; then
    words=$options
  elif [[ $current == *,* ]]; then
    given=${{current%,*}},
  fi
  COMPREPLY=($(compgen -P "$given" -W "$words" -- "${{current##*,}}"))
}}
complete -o default -F _crossgrain crossgrain
)",
                     fmt::join(publicCommands(), " "), fmt::join(optionWords(program), " "), words,
                     values);
}

Action declareCompletion(CLI::App& app, CommandLine&) {
  return [&app] {
    fmt::print("{}", bashCompletion(*app.get_parent()));
    return exitHeld;
  };
}

}  // namespace

extern const Command completionCommand = {"__completion", "write the completion for bash", "",
                                          declareCompletion};

}  // namespace crossgrain::inline cli
