#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The packages on a bare Debian without a compiler, as root:
#   tests/packages/on_bare_machine.sh FOLDER_OF_DEB_FILES
# Installs microswarm and uses it, then python3-microswarm and runs a scenario with it, then libmicroswarm-dev and builds a
# project with it. Stops at what fails.
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
microswarm run /usr/share/microswarm/scenarios/first_flight.yaml --out first --json >first.json
ls first/run.h5 first/index.html first/*.png
microswarm replay first/run.h5
microswarm map info /usr/share/microswarm/scenarios/maps/retina.geojson

step "pictures and videos, which a module reads and writes"
microswarm report first/run.h5 --video first/run.mp4 --to 2
ls -l first/run.mp4

step "firmware"
ls /usr/share/microswarm/firmware/coil_driver/Makefile

step "completion"
"$project/tests/packages/completion_test.sh" microswarm /usr/share/bash-completion/completions/microswarm \
  /usr/share/zsh/vendor-completions/_microswarm

step "manual"
install man-db
man -w microswarm microswarm-run microswarm-map-segment
man --warnings microswarm-run 2>warnings | head -12
[ ! -s warnings ] || { cat warnings && exit 1; }

step "python3-microswarm"
before=$(installed_mb)
install "$packages"/python3-microswarm_*.deb
echo "with what it depends on $(($(installed_mb) - before)) MB"
hash=$(python3 -c "
import microswarm as ms
record = ms.run('/usr/share/microswarm/scenarios/first_flight.yaml', progress=False)
record.save('python.h5')
assert ms.read_record('first/run.h5').hash == record.hash
print(record.hash)")
grep -q "\"record_hash\": \"$hash\"" first.json || { echo "hash $hash is not that of the command line:" && cat first.json && exit 1; }
microswarm replay python.h5

step "libmicroswarm-dev"
if command -v c++ >/dev/null; then
  echo "microswarm brought a compiler" >&2
  exit 1
fi
install "$packages"/libmicroswarm-dev_*.deb g++ cmake make
# shellcheck disable=SC2016 # back quotes of Markdown
sed -n '/^```cpp$/,/^```$/p' "$project/README.md" | sed '1d;$d' >readme.cpp
cmake -S "$project/tests/install/consumer" -B consumer -D CMAKE_BUILD_TYPE=Release -D README="$PWD/readme.cpp" \
  -D RECORDED="$project/examples/02_run.cpp" >cmake.log ||
  { cat cmake.log && exit 1; }
cmake --build consumer
consumer/some_floors
consumer/all_floors
ls /usr/share/microswarm/matlab/{build_mex.m,microswarm_mex.c,+microswarm/run.m}

step "nothing stays"
apt-get purge -y -qq microswarm libmicroswarm-dev python3-microswarm >apt.log 2>&1 || { cat apt.log && exit 1; }
left=$(find /usr -name '*microswarm*' -not -path '/usr/src/*' -not -path "$project/*")
[ -z "$left" ] || { echo "left: $left" && exit 1; }
echo "the packages work"
