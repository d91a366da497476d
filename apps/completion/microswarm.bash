# SPDX-License-Identifier: Apache-2.0
# Completion for bash: the program says what fits, see apps/support/completion.hpp.
# shellcheck shell=bash

_microswarm() {
  local -a words=() lines=()
  local i word line kind before=

  # bash breaks words at = and :, which the program expects in one piece.
  for ((i = 1; i <= COMP_CWORD; i++)); do
    word=${COMP_WORDS[i]}
    if ((${#words[@]} > 0)) && [[ $word == [=:]* || ${COMP_WORDS[i - 1]} == [=:] ]]; then
      words[-1]+=$word
    else
      words+=("$word")
    fi
  done
  word=${words[-1]}
  # Only what stands behind the last break is replaced.
  [[ $COMP_WORDBREAKS != *=* || $word != *[=:]* ]] || before=${word%"${word##*[=:]}"}

  mapfile -t lines < <("${COMP_WORDS[0]}" complete "${words[@]}" 2>/dev/null)
  kind=${lines[0]:-}
  COMPREPLY=()
  case $kind in
    words)
      for line in "${lines[@]:1}"; do
        line=${line%%$'\t'*}
        COMPREPLY+=("${line#"$before"}")
        [[ $line != *= ]] || compopt -o nospace 2>/dev/null
      done
      ;;
    files | folders)
      word=${word#"$before"}
      word=${word#--*=}
      compopt -o filenames 2>/dev/null
      if [ "$kind" = files ]; then
        mapfile -t COMPREPLY < <(compgen -f -- "$word")
      else
        mapfile -t COMPREPLY < <(compgen -d -- "$word")
      fi
      ;;
  esac
}

complete -F _microswarm microswarm
