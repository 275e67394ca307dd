#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>

#include "cli/option_groups.hpp"
#include "support/bad_input.hpp"

namespace crossgrain::inline cli {
namespace {

struct Shell {
  const char *name, *script;
};

/// The program itself knows the words, so that a script only asks it.
constexpr std::array shells = {Shell{"bash", R"sh(_crossgrain() {
  local IFS=$'\n'
  COMPREPLY=($("${COMP_WORDS[0]}" __complete "${COMP_WORDS[@]:1:COMP_CWORD}" 2>/dev/null))
  [[ ${COMPREPLY-} == */ ]] && compopt -o nospace
  return 0
}
complete -o default -F _crossgrain crossgrain
)sh"},
                               Shell{"zsh", R"sh(#compdef crossgrain
_crossgrain() {
  local -a found folders
  found=("${(@f)$("${words[1]}" __complete "${(@)words[2,CURRENT]}" 2>/dev/null)}")
  folders=("${(@M)found:#*/}")
  found=("${(@)found:#*/}")
  compadd -S '' -a folders
  compadd -a found
}
if [[ $funcstack[1] == _crossgrain ]]; then _crossgrain "$@"; else compdef _crossgrain crossgrain; fi
)sh"},
                               Shell{"fish", R"sh(function __crossgrain
  set -l before (commandline -opc)
  set -l typed (commandline -ct)
  $before[1] __complete $before[2..] "$typed" 2>/dev/null
end
complete -c crossgrain -f -a '(__crossgrain)'
)sh"}};

Action declareCompletion(CLI::App& app, CommandLine&) {
  const auto name = std::make_shared<std::string>();
  addArgument(app, "shell", *name, "that reads the script", "bash|zsh|fish");
  return [name] {
    const auto shell =
        std::ranges::find_if(shells, [&](const Shell& each) { return each.name == *name; });
    if (shell == shells.end())
      throw BadInput(fmt::format("completion: '{}' is none of bash, zsh, fish", *name));
    fmt::print("{}", shell->script);
    return exitPassed;
  };
}

}  // namespace

extern const Command completionCommand = {
    "completion", "print a script that completes commands, options, engines and cases in a shell",
    "crossgrain completion bash    # in ~/.bashrc: source <(crossgrain completion bash)\n"
    "crossgrain completion zsh     # into a folder of fpath, as _crossgrain\n"
    "crossgrain completion fish    # into ~/.config/fish/completions/crossgrain.fish",
    declareCompletion};

}  // namespace crossgrain::inline cli
