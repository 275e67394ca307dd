# Completion of crossgrain for bash: commands, options and listed values, from the program's own --help.
_crossgrain() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} words
  # Bash splits --option=value into three words.
  if [[ $current == "=" ]]; then
    current=""
  elif [[ $previous == "=" ]]; then
    previous=${COMP_WORDS[COMP_CWORD - 2]}
  fi
  if ((COMP_CWORD == 1)) || [[ ${COMP_WORDS[1]} == help && $current != -* ]]; then
    words=$(${COMP_WORDS[0]} --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]\+\) .*/\1/p; s/^  -.,\(--[a-z-]\+\).*/\1/p')
  elif [[ $current == -* ]]; then
    words=$(${COMP_WORDS[0]} "${COMP_WORDS[1]}" --help | sed -n 's/^  \(-.,\)\?\(--[a-z0-9-]\+\).*/\2/p')
  else  # the values that the option before it, or the first argument, lists as a|b|c
    words=$(${COMP_WORDS[0]} "${COMP_WORDS[1]}" --help |
      awk -v option="$previous" '/^Positionals:/ { first = 1; next } /^  / && $1 == option || first { if ($2 ~ /\|/) print $2 } { first = 0 }' | tr '|' ' ')
  fi
  COMPREPLY=($(compgen -W "$words" -- "$current"))
}
complete -o default -F _crossgrain crossgrain
