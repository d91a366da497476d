#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the reference of the command line and of the keys of files from what the program says.

    tools/reference.py build/release/bin/microswarm            writes it
    tools/reference.py build/release/bin/microswarm --check    complains where it says something else

docs/reference/cli.md keeps its hand-written part; what stands between its two marks, and all of
docs/reference/parameters.md, are tables over `microswarm describe --json`.
"""

import argparse
import json
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
REFERENCE = ROOT / "docs" / "reference"
CLI, PARAMETERS = REFERENCE / "cli.md", REFERENCE / "parameters.md"
MARKS = re.compile(r"(<!-- commands: [^>]*-->\n).*?(<!-- end -->)", re.S)
KINDS = {
    "scenario": "`microswarm run FILE`; `--set KEY=VALUE` changes a key",
    "sweep": "`microswarm sweep FILE`",
    "rig": "`--rig FILE`; `--set-rig KEY=VALUE` changes a key",
    "queue": "`microswarm rig queue FILE`",
    "coils": "the key `coils` of a rig, and `microswarm rig field`, `rig map`",
    "track": "`microswarm track --config FILE`, or `--set KEY=VALUE`",
    "global": "`microswarm global --set KEY=VALUE`",
}
HEAD = """# Keys of files

Written by `./dev reference` from `microswarm describe --json`; edit the `fields` of the parameters instead.

A key's unit is in its name. Nested keys are joined by dots, as in `--set navigator.planner.step_um=60`; keys within
a list are those of each of its entries. Where a key has a `type`, only the keys of that type are allowed beside it.
`microswarm schema KIND` prints the same as JSON Schema, with which editors complete and check files.
"""


def described(program):
    """The program as data."""
    said = subprocess.run([program, "describe", "--json"], stdout=subprocess.PIPE, check=True).stdout
    return json.loads(said)


# The command line.


def option_name(option):
    """`--out FOLDER`; words for a value stand in the meaning."""
    name = ",".join(option["names"])
    return name if option["words"] or not option["value"] else f"{name} {option['value']}"


def option_meaning(option):
    """The doc of an option with its default, then what else holds of it, as sentences."""
    doc = option["doc"] + (" (repeatable)" if option["repeatable"] else "")
    if option["default"] not in ("required", "none", "off"):
        doc += f" (default: {option['default']})"
    words = ["Required."] if option["required"] else []
    for key, before in (("excludes", "Not with"), ("needs", "Needs"), ("words", "One of")):
        if option[key]:
            words.append(f"{before} {', '.join(f'`{word}`' for word in option[key])}.")
    doc = doc if not words or doc.endswith((".", "?", "!")) else doc + "."
    return " ".join([doc, *words])


def option_row(option):
    """A row of the table of options."""
    return f"| `{option_name(option)}` | {cell(option_meaning(option))} |\n"


def cell(text):
    return text.replace("|", "\\|").strip()


def usage(words, command):
    """`microswarm map convert [OPTIONS] map out`"""
    parts = [*words, "[OPTIONS]"]
    for argument in command["arguments"]:
        name = argument["names"][0]
        parts.append(name if argument["required"] else f"[{name}]")
    return " ".join(parts + ["SUBCOMMAND"] * bool(command["commands"]))


def command_section(words, command):
    """The section of a command, then those of its subcommands."""
    words = [*words, command["name"]]
    out = f"{'#' * (len(words) + 2)} {' '.join(words)}\n\n{command['doc'].rstrip('.')}.\n"
    if below := command["commands"]:
        full = [[*words, each["name"]] for each in below]
        out += "\n" + "".join(f"- [{' '.join(name)}](#{'-'.join(name)})\n" for name in full)
        return out + "\n" + "".join(command_section(words, each) for each in below)
    out += f"\n    {usage(['microswarm', *words], command)}\n"
    rows = command["arguments"] + [each for each in command["options"] if "--help" not in each["names"]]
    out += "\n| | |\n|---|---|\n" + "".join(map(option_row, rows)) if rows else ""
    if example := command["example"]:
        out += "\nExample:\n\n" + "".join(f"    {line[2:]}\n" for line in example.splitlines())
    return out + "\n"


# The keys of files.


def default_text(text):
    """A default with as many digits as people read."""
    if not text:
        return ""
    text = re.sub(r"\d+\.\d{6,}", lambda match: f"{float(match[0]):.6g}", text)
    return "" if text in ("required", "none", '""', "[]") else f"`{text}`"


def row_text(name, key, more=""):
    words = [] if key["words"] == ["true", "false"] else [type["type"] for type in key["types"]] or key["words"]
    allowed = ", ".join(f"`{word}`" for word in words)
    if not words and not key["words"]:
        allowed = key["range"].replace("..", " … ")
    meaning = ("**Required.** " if key["default"] == "required" else "") + key["doc"] + more
    cells = (f"`{name}`", key["unit"], default_text(key["default"]), allowed, cell(meaning))
    return f"| {' | '.join(cells)} |\n"


class Page:
    """The tables of one kind of file."""

    def __init__(self):
        self.printed = {}  # keys of a group, and where they were printed first

    def table(self, path, keys, inside=""):
        """Tables of `keys`, shown below `inside`; what has types comes after in sections."""
        later = []
        rows = "".join(self.group(path, inside + key["key"], key, later) for key in keys)
        text = f"| key | unit | default | range | meaning |\n|---|---|---|---|---|\n{rows}" if rows else ""
        return text + "".join(self.types(*what) for what in later)

    def group(self, path, name, key, later):
        """Rows of a key and what is within it."""
        full = ".".join(filter(None, [path, name]))
        if key["types"]:
            later.append((full, key["types"]))
        content = repr((key["keys"], key["types"]))
        if len(key["keys"]) + len(key["types"]) > 1 and content in self.printed:
            return row_text(name, key, f" Keys as of `{self.printed[content]}` above.")
        self.printed.setdefault(content, full)
        below = "".join(self.group(path, f"{name}.{each['key']}", each, later) for each in key["keys"])
        return row_text(name, key) + below

    def types(self, path, types):
        """A section for each alternative of a key."""
        return "".join(
            f"\n#### `{path}`: `{type['type']}`\n\n" + (self.table(path, type["keys"]) or "No keys.\n")
            for type in types
        )

    @staticmethod
    def link(kind, key):
        """An entry of the list of groups."""
        name = key["key"]
        types = ", ".join(f"[{type['type']}](#{name}-{type['type']})" for type in key["types"])
        return f"- [{name}](#{kind}-{name})" + (": " if types else "") + types + "\n"

    def of(self, kind, keys):
        plain = [key for key in keys if not key["keys"] and not key["types"]]
        groups = [key for key in keys if key["keys"] or key["types"]]
        text = f"\n## {kind.capitalize()}\n\nFor {KINDS[kind]}.\n\n"
        text += "".join(self.link(kind, key) for key in groups)
        text += "\n" if text.endswith(")\n") else ""
        text += self.table("", plain) if plain else ""
        for key in groups:
            text += f"\n### {kind}: `{key['key']}`\n\n{key['doc']}\n"
            if key["types"]:
                names = ", ".join(f"`{type['type']}`" for type in key["types"])
                default = default_text(key["default"])
                text += f"`type` is one of {names}" + (f"; default {default}.\n" if default else ".\n")
                text += self.types(key["key"], key["types"])
            else:
                text += "\n" + self.table("", key["keys"], key["key"] + ".")
        return text


def pages(data):
    """{file: text} of all that is written."""
    old = CLI.read_text(encoding="utf-8")
    commands = "".join(command_section([], command) for command in data["program"]["commands"])
    new, count = MARKS.subn(lambda match: f"{match[1]}\n{commands}{match[2]}", old)
    if count != 1:
        sys.exit(f"{CLI}: must have one `<!-- commands: … -->` and `<!-- end -->` after it")
    links = ", ".join(f"[{kind}](#{kind})" for kind in KINDS)
    keys = "".join(Page().of(kind, data["keys"][kind]) for kind in KINDS)
    return {CLI: new, PARAMETERS: f"{HEAD}\nFiles: {links}.\n{keys}"}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--check", action="store_true", help="complain instead of writing")
    options = parser.parse_args()
    wrong = False
    for file, text in pages(described(options.program)).items():
        if file.exists() and file.read_text(encoding="utf-8") == text:
            continue
        wrong = True
        if options.check:
            print(f"{file}: not what the program says; run ./dev reference", file=sys.stderr)
            continue
        part = file.with_name(file.name + ".part")
        part.write_text(text, encoding="utf-8")
        part.replace(file)
    return 1 if options.check and wrong else 0


if __name__ == "__main__":
    sys.exit(main())
