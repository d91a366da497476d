#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Completion in bash without a terminal, and the syntax of that for zsh:
#   completion_test.sh PROGRAM SCRIPT_FOR_BASH SCRIPT_FOR_ZSH
set -euo pipefail
program=$1 script=$2 script_for_zsh=$3
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
mkdir "$folder/maps"
touch "$folder/flight.yaml" "$folder/maps/vessels.png"
cd "$folder"
# shellcheck source=/dev/null
source "$script"

# offered WORD...: what is offered for the last of the words behind the program's name, sorted, in a line.
# = and : are words of their own, as in a terminal.
offered() {
  COMP_WORDS=("$program" "$@") COMP_CWORD=$# COMPREPLY=()
  _microswarm
  printf '%s\n' "${COMPREPLY[@]}" | sort | paste -sd ' '
}

# expect OFFERED WORD...
expect() {
  local wanted=$1 got
  shift
  got=$(offered "$@")
  [ "$got" = "$wanted" ] && return
  echo "microswarm $*: offers '$got' instead of '$wanted'" >&2
  exit 1
}

# expect_among WORDS... -- WORD...: these are offered among others.
expect_among() {
  local word wanted=() got
  while [ "$1" != -- ]; do wanted+=("$1") && shift; done
  shift
  got=$(offered "$@")
  for word in "${wanted[@]}"; do
    [[ " $got " == *" $word "* ]] && continue
    echo "microswarm $*: does not offer '$word', but '$got'" >&2
    exit 1
  done
}

expect_among run plan map rig schema -- ''
expect 'replay report reproduce' re
expect 'check convert graph info segment' map ''
expect 'segment' map s
expect_among --out --set --seed --json --help -- run --
expect '--photo' run flight.yaml --ph
expect '--set --set-rig' run --set a=1 --set # may be repeated
expect '' run --seed 1 --seed                # may not
expect 'flight.yaml maps' run ''
expect 'maps/vessels.png' map info maps/
expect 'maps' run flight.yaml --out ''
expect 'maps' run flight.yaml --out = m
expect 'flight.yaml' run flight.yaml --rig = fl
expect 'coils global queue rig scenario sweep track' schema ''
expect 'drrt dynabarn' reproduce d
expect_among planning vision -- bench ''
expect 'swarm.radius_lag_s= swarm.radius_ripple_um= swarm.radius_um=' run flight.yaml --set swarm.rad
expect_among navigator.type= seed= map.file= -- run --set ''
expect_among slide stop -- run --set robots.contact = ''
expect_among a_star drrt_star exact -- plan map.png --set planner.type = ''
expect 'a_star' plan map.png --set planner.type = a_
expect_among find.tone= -- track --set ''
expect_among camera.type= -- run --rig r.yaml --set-rig c
expect 'run' rig ru
expect '' run flight.yaml --seed ''
expect '' nonsense nonsense

bash -n "$script"
if command -v zsh >/dev/null; then zsh -n "$script_for_zsh"; fi
