#include "cli/reference.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <sstream>

namespace crossgrain::inline cli {

const std::vector<Named>& exitStatuses() {
  static const std::vector<Named> all = {
      {"0", "held; what is undecided is counted in the output"},
      {"1",
       "engines disagree, or something fell short or is unstable (an engine short of the law "
       "that it declares; short of the scene's only under --strict)"},
      {"2", "bad input: nothing was judged"},
      {"3", "an engine failed, or the disk is full (outranks 1)"},
      {"130", "interrupted"}};
  return all;
}

const std::vector<Named>& environmentVariables() {
  static const std::vector<Named> all = {
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
  return all;
}

std::vector<std::string> examplesOf(const Command& command) {
  std::vector<std::string> lines;
  std::istringstream in(command.examples);
  for (std::string line; std::getline(in, line);)
    lines.push_back(line.substr(line.find_first_not_of(' ')));
  return lines;
}

std::string footer(const Command* command) {
  std::string text;
  if (command) {
    text = "Example:\n";
    for (const std::string& example : examplesOf(*command)) text += "  " + example + "\n";
    text += "\n";
  }
  text += "Exit status:\n";
  for (const Named& status : exitStatuses())
    text += fmt::format("  {:<5}{}\n", status.name, status.what);
  text += "\nEnvironment:\n";
  for (const Named& variable : environmentVariables())
    text += fmt::format("  {}  {}\n", variable.name, variable.what);
  return text.substr(0, text.size() - 1);
}

std::string synopsis(const CLI::App& command) {
  std::string text;
  const auto add = [&](const CLI::Option& option) {
    std::string word = option.get_name();
    if (!option.get_positional()) word += " " + option.get_type_name();
    if (option.get_expected_max() > 1) word += " ...";
    text += (option.get_required() ? word : "[" + word + "]") + " ";
  };
  for (const CLI::Option* option : command.get_options())
    if (option->get_positional()) add(*option);
  for (const CLI::Option* option : command.get_options())
    if (!option->get_positional() && option->get_required()) add(*option);
  return text + "[OPTIONS]";
}

}  // namespace crossgrain::inline cli
