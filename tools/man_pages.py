#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the manual pages of the program and of each of its commands from what `--help` says.

    tools/man_pages.py build/release/bin/microswarm build/release/man

makes microswarm.1, microswarm-run.1, microswarm-map-info.1 … Their date is SOURCE_DATE_EPOCH, or today.
"""

import argparse
import os
import pathlib
import re
import time

from reference import entries, option_text, read_help, said, subcommands


def plain(text):
    """Text in which nothing is a command of roff."""
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return re.sub(r"^(?=[.'])", "\\\\&", text, flags=re.M)


def prose(text):
    """Text whose `words` in back quotes are bold."""
    parts = text.split("`")
    parts = [f"\\fB{plain(part)}\\fR" if i % 2 else plain(part) for i, part in enumerate(parts)]
    return re.sub(r"^(?=[.'])", "\\\\&", "".join(parts), flags=re.M)


def option_name(name):
    """`--out FOLDER`: options are bold, what stands for a value is in italics."""
    name = name.replace(",-", ", -")
    words = [f"\\fB{plain(word)}\\fR" if word.startswith("-") else f"\\fI{plain(word)}\\fR" for word in name.split(" ")]
    return " ".join(words)


def sentence(text):
    return text if not text or text.endswith((".", "?", "!")) else text + "."


def section(title, body):
    return f".SH {title}\n{body}" if body else ""


def options(lines):
    """The entries of a list of options or arguments."""
    text = ""
    for row in entries(lines):
        name, meaning = option_text(*row)
        text += f".TP\n{option_name(name)}\n{prose(sentence(meaning))}\n"
    return text


def command_list(words, lines):
    """The entries of a list of commands, each with the name of its page."""
    return "".join(
        f".TP\n\\fB{plain('-'.join([*words, name.split(',')[0]]))}\\fR(1)\n{prose(sentence(meaning))}\n"
        for name, meaning in entries(lines)
    )


def exit_status(lines):
    """What the program's help says of exit codes."""
    text = " ".join(lines)
    found = re.search(r"Exit codes: (.*)", text)
    return prose(found[1]) + "\n" if found else ""


def example(lines):
    body = "".join(plain(line.removeprefix("  ")) + "\n" for line in lines if line.strip())
    return f".nf\n{body}.fi\n" if body else ""


def page(words, help_text, head):
    """The page of a command, of which `words` are the names from the program's on."""
    name = "-".join(words)
    about, *usage = [line for line in help_text[""] if line.strip()]
    usage = re.sub(r"^Usage: ", "", " ".join(usage)).removeprefix(" ".join(words)).strip()
    above = "" if len(words) == 1 else f"\\fB{plain('-'.join(words[:-1]))}\\fR(1)\n"
    return "".join(
        [
            f'.\\" Written by tools/man_pages.py.\n.TH {plain(name.upper())} 1 {head}\n',
            section("NAME", f"{plain(name)} \\- {plain(about.rstrip('.'))}\n"),
            section("SYNOPSIS", f"\\fB{plain(' '.join(words))}\\fR {plain(usage)}\n"),
            section("COMMANDS", command_list(words, help_text.get("Subcommands", []))),
            section("ARGUMENTS", options(help_text.get("Positionals", []))),
            section("OPTIONS", options(help_text.get("Options", []))),
            section('"EXIT STATUS"', exit_status(help_text.get("rest", [])) if len(words) == 1 else ""),
            section("EXAMPLE", example(help_text.get("Example", []))),
            section('"SEE ALSO"', above),
        ]
    )


def pages(program, words, head):
    """(name, text) of the page of a command, then of those below it."""
    help_text = read_help(said(program, *words[1:], "--help"))
    yield "-".join(words), page(words, help_text, head)
    for name in subcommands(help_text):
        yield from pages(program, [*words, name], head)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("folder", type=pathlib.Path)
    given = parser.parse_args()
    day = time.strftime("%Y-%m-%d", time.gmtime(int(os.environ.get("SOURCE_DATE_EPOCH", time.time()))))
    version = said(given.program, "--version").strip()
    head = f'"{day}" "microswarm {version}" "Manual of microswarm"'
    given.folder.mkdir(parents=True, exist_ok=True)
    for old in given.folder.glob("*.1"):
        old.unlink()
    for name, text in pages(given.program, ["microswarm"], head):
        (given.folder / f"{name}.1").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
