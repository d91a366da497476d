#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Merges the units of a unity build into fewer and larger ones, for clang-tidy: most of its time goes into headers
that units share.

Writes FOLDER/merged/ with a compile_commands.json of its own, and prints the files in it, the largest first, each
with a zero byte behind it. What is no unit of several sources stays as it is, and so do programs and modules, which
may define equal names.
"""
import json
import pathlib
import shlex
import sys

UNITS = 7  # in one: the processors share four or five of them


def options(command):
    """The options in a command, without its input and output, as groups of words."""
    words = iter(shlex.split(command)[1:])
    for word in words:
        if word in ("-c", "-o"):
            next(words)
        elif word == "-isystem":
            yield word, next(words)
        else:
            yield word,


def is_library(command):
    """Whether a command compiles a unit of a library that others link."""
    return command["file"].endswith(".cxx") and "-fPIC" in command["command"] and "_EXPORTS" not in command["command"]


def merge(part, file):
    """The command that compiles the units of several commands as one file, with the options of all."""
    file.write_text("".join(f'#include "{command["file"]}"\n' for command in part))
    groups = dict.fromkeys(group for command in part for group in options(command["command"]))
    words = [word for group in groups for word in group]
    return {"directory": part[0]["directory"], "file": str(file),
            "command": shlex.join(["c++", *words, "-c", str(file)])}


def main():
    folder = pathlib.Path(sys.argv[1]).resolve()
    commands = json.loads((folder / "compile_commands.json").read_text())
    library = [command for command in commands if is_library(command)]
    merged = folder / "merged"
    merged.mkdir(exist_ok=True)
    result = [merge(library[first:first + UNITS], merged / f"units_{first}.cpp")
              for first in range(0, len(library), UNITS)]
    result += [command for command in commands if not is_library(command)]
    (merged / "compile_commands.json").write_text(json.dumps(result, indent=1))
    for command in result:
        print(command["file"], end="\0")


if __name__ == "__main__":
    main()
