#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the manual pages of the program and of each of its commands from `microswarm describe --json`.

    tools/man_pages.py build/release/bin/microswarm build/release/man

makes microswarm.1, microswarm-run.1, microswarm-map-info.1 … Their date is SOURCE_DATE_EPOCH, or today.
"""

import argparse
import os
import pathlib
import re
import time

from reference import described, option_meaning, option_name, usage


def plain(text):
    """Text in which nothing is a command of roff."""
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return re.sub(r"^(?=[.'])", "\\\\&", text, flags=re.M)


def prose(text):
    """Text whose `words` in back quotes are bold."""
    parts = text.split("`")
    parts = [f"\\fB{plain(part)}\\fR" if i % 2 else plain(part) for i, part in enumerate(parts)]
    return re.sub(r"^(?=[.'])", "\\\\&", "".join(parts), flags=re.M)


def name_text(option):
    """`--out FOLDER`: options are bold, what stands for a value is in italics."""
    words = option_name(option).replace(",-", ", -").split(" ")
    return " ".join(f"\\fB{plain(w)}\\fR" if w.startswith("-") else f"\\fI{plain(w)}\\fR" for w in words)


def sentence(text):
    return text if not text or text.endswith((".", "?", "!")) else text + "."


def section(title, body):
    return f".SH {title}\n{body}" if body else ""


def options(listed):
    """The entries of a list of options or arguments."""
    return "".join(f".TP\n{name_text(each)}\n{prose(sentence(option_meaning(each)))}\n" for each in listed)


def command_list(words, commands):
    """The entries of a list of commands, each with the name of its page."""
    return "".join(
        f".TP\n\\fB{plain('-'.join([*words, each['name']]))}\\fR(1)\n{prose(sentence(each['doc']))}\n"
        for each in commands
    )


def example(text):
    body = "".join(plain(line.removeprefix("  ")) + "\n" for line in text.splitlines())
    return f".nf\n{body}.fi\n" if body else ""


def page(words, command, head):
    """The page of a command, of which `words` are the names from the program's on."""
    name, line = "-".join(words), " ".join(words)
    exit_codes = " ".join(command.get("footer", "").split()).partition("Exit codes: ")[2]
    above = "" if len(words) == 1 else f"\\fB{plain('-'.join(words[:-1]))}\\fR(1)\n"
    return "".join(
        [
            f'.\\" Written by tools/man_pages.py.\n.TH {plain(name.upper())} 1 {head}\n',
            section("NAME", f"{plain(name)} \\- {plain(command['doc'].rstrip('.'))}\n"),
            section("SYNOPSIS", f"\\fB{plain(line)}\\fR {plain(usage([], command))}\n"),
            section("COMMANDS", command_list(words, command["commands"])),
            section("ARGUMENTS", options(command["arguments"])),
            section("OPTIONS", options(command["options"])),
            section('"EXIT STATUS"', prose(exit_codes) + "\n" if exit_codes else ""),
            section("EXAMPLE", example(command.get("example", ""))),
            section('"SEE ALSO"', above),
        ]
    )


def pages(words, command, head):
    """(name, text) of the page of a command, then of those below it."""
    words = [*words, command["name"]]
    yield "-".join(words), page(words, command, head)
    for each in command["commands"]:
        yield from pages(words, each, head)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("folder", type=pathlib.Path)
    given = parser.parse_args()
    day = time.strftime("%Y-%m-%d", time.gmtime(int(os.environ.get("SOURCE_DATE_EPOCH", time.time()))))
    data = described(given.program)
    head = f'"{day}" "microswarm {data["version"]}" "Manual of microswarm"'
    given.folder.mkdir(parents=True, exist_ok=True)
    for old in given.folder.glob("*.1"):
        old.unlink()
    for name, text in pages([], data["program"], head):
        (given.folder / f"{name}.1").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
