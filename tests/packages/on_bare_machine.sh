#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The packages on a bare Debian without a compiler, as root:
#   tests/packages/on_bare_machine.sh FOLDER_OF_DEB_FILES
# Installs microswarm and uses it, then libmicroswarm-dev and builds a project with it. Stops at what fails.
set -euo pipefail
packages=$(cd "$1" && pwd)
project=$(cd "$(dirname "$0")/../.." && pwd)
export DEBIAN_FRONTEND=noninteractive
work=$(mktemp -d)
trap 'rm -r "$work"' EXIT
cd "$work"

step() { echo "== $*"; }

# install FILE...: with what they depend on.
install() {
  apt-get install -y -qq --no-install-recommends "$@" >apt.log 2>&1 || { cat apt.log && return 1; }
  apt-get clean
}

# installed_mb: the size of all packages that are installed.
installed_mb() { dpkg-query -W -f='${Installed-Size}\n' | awk '{ sum += $1 } END { print int(sum / 1024) }'; }

if command -v c++ >/dev/null; then
  echo "this machine has a compiler" >&2
  exit 1
fi
apt-get update -qq

step "microswarm alone"
before=$(installed_mb)
install "$packages"/microswarm_*.deb
echo "with what it depends on $(($(installed_mb) - before)) MB"
microswarm --version

step "a shipped scenario"
microswarm run /usr/share/microswarm/scenarios/first_flight.yaml --out first
ls first/run.h5 first/index.html first/*.png
microswarm replay first/run.h5
microswarm map info /usr/share/microswarm/scenarios/maps/retina.geojson

step "pictures and videos, which a module reads and writes"
microswarm report first/run.h5 --video first/run.mp4 --to 2
ls -l first/run.mp4

step "completion"
"$project/tests/packages/completion_test.sh" microswarm /usr/share/bash-completion/completions/microswarm \
  /usr/share/zsh/vendor-completions/_microswarm

step "manual"
install man-db
man -w microswarm microswarm-run microswarm-map-segment
man --warnings microswarm-run 2>warnings | head -12
[ ! -s warnings ] || { cat warnings && exit 1; }

step "libmicroswarm-dev"
if command -v c++ >/dev/null; then
  echo "microswarm brought a compiler" >&2
  exit 1
fi
install "$packages"/libmicroswarm-dev_*.deb g++ cmake make
# shellcheck disable=SC2016 # back quotes of Markdown
sed -n '/^```cpp$/,/^```$/p' "$project/README.md" | sed '1d;$d' >readme.cpp
cmake -S "$project/tests/install/consumer" -B consumer -D CMAKE_BUILD_TYPE=Release -D PROGRAM="$PWD/readme.cpp" >cmake.log ||
  { cat cmake.log && exit 1; }
cmake --build consumer
consumer/some_floors
consumer/all_floors

step "nothing stays"
apt-get purge -y -qq microswarm libmicroswarm-dev >apt.log 2>&1 || { cat apt.log && exit 1; }
left=$(find /usr -name '*microswarm*' -not -path '/usr/src/*' -not -path "$project/*")
[ -z "$left" ] || { echo "left: $left" && exit 1; }
echo "the packages work"
