#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the reference of the command line and of the keys of files from what the program says.

    tools/reference.py build/release/bin/microswarm            writes it
    tools/reference.py build/release/bin/microswarm --check    complains where it says something else

docs/reference/cli.md keeps its hand-written part; what stands between its two marks comes from
`microswarm COMMAND --help`. All of docs/reference/parameters.md comes from `microswarm schema KIND --keys`.
"""

import argparse
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
REFERENCE = ROOT / "docs" / "reference"
CLI, PARAMETERS = REFERENCE / "cli.md", REFERENCE / "parameters.md"
MARKS = re.compile(r"(<!-- commands: [^>]*-->\n).*?(<!-- end -->)", re.S)
OPTION = re.compile(r"  (\S.*?)(?:\s{2,}(\S.*))?$")
COLUMNS = ("key", "unit", "default", "allowed", "meaning")
KINDS = {
    "scenario": "`microswarm run FILE`; `--set KEY=VALUE` changes a key",
    "sweep": "`microswarm sweep FILE`",
    "rig": "`--rig FILE`; `--set-rig KEY=VALUE` changes a key",
    "coils": "the key `coils` of a rig, and `microswarm rig field`, `rig map`",
    "track": "`microswarm track --config FILE`, or `--set KEY=VALUE`",
    "global": "`microswarm global --set KEY=VALUE`",
}
HEAD = """# Keys of files

Written by `./dev reference` from `microswarm schema KIND --keys`; edit the `fields` of the parameters instead.

A key's unit is in its name. Nested keys are joined by dots, as in `--set navigator.planner.step_um=60`; keys within
a list are those of each of its entries. Where a key has a `type`, only the keys of that type are allowed beside it.
`microswarm schema KIND` prints the same as JSON Schema, with which editors complete and check files.
"""


def said(program, *words):
    """What the program prints."""
    return subprocess.run([program, *words], stdout=subprocess.PIPE, check=True, encoding="utf-8").stdout


# The command line.


def read_help(text):
    """Sections of a help text: their titles, '' for the first one, 'rest' for the last, and their lines."""
    sections, title = {"": []}, ""
    for line in text.splitlines():
        if re.fullmatch(r"[A-Z]\w+:", line):
            title = line[:-1]
            sections[title] = []
        elif title and line and not line.startswith(" "):
            title = "rest"
            sections.setdefault(title, []).append(line)
        else:
            sections[title].append(line)
    return sections


def entries(lines):
    """(name, meaning) of the entries of a section."""
    found = []
    for line in lines:
        if match := OPTION.match(line):
            found.append([match[1], match[2] or ""])
        elif line.strip() and found:
            found[-1][1] = f"{found[-1][1]} {line.strip()}".strip()
    return found


def option_text(name, meaning):
    """Name and meaning of an option; what CLI11 puts behind a name becomes words of the meaning."""
    words = []
    for label, before in (("Excludes", "Not with "), ("Needs", "Needs ")):
        if match := re.search(rf" {label}: ((?:--\S+ ?)+)", name):
            others = ", ".join(f"`{other}`" for other in match[1].split())
            words.append(f"{before}{others}.")
            name = name.replace(match[0].rstrip(), "")
    if " REQUIRED" in name:
        words.insert(0, "Required.")
        name = name.replace(" REQUIRED", "")
    if name.endswith(" ..."):
        name = name.removesuffix(" ...")
    if choice := re.search(r" [A-Z]+:\{([^}]*)\}(?:=(\S+))?", name):
        words.append("One of " + ", ".join(f"`{c}`" for c in choice[1].split(",")) + ".")
        words += [f"Default `{choice[2]}`."] if choice[2] else []
        name = name.replace(choice[0], "")
    meaning = meaning if not words or meaning.endswith((".", "?", "!")) else meaning + "."
    return name, " ".join([meaning, *words])


def option_row(name, meaning):
    """A row of the table of options."""
    name, meaning = option_text(name, meaning)
    return f"| `{name}` | {cell(meaning)} |\n"


def cell(text):
    return text.replace("|", "\\|").strip()


def subcommands(help_text):
    """Names of a command's subcommands; a former name stands behind a comma and is left out."""
    return [name.split(",")[0] for name, _ in entries(help_text.get("Subcommands", []))]


def command_section(program, words):
    """The section of a command, then those of its subcommands."""
    help_text = read_help(said(program, *words, "--help"))
    depth = "#" * (len(words) + 2)
    about, *usage = [line for line in help_text[""] if line.strip()]
    out = f"{depth} {' '.join(words)}\n\n{about.rstrip('.')}.\n"
    below = subcommands(help_text)
    if below:
        full = [[*words, name] for name in below]
        out += "\n" + "".join(f"- [{' '.join(name)}](#{'-'.join(name)})\n" for name in full)
        return out + "\n" + "".join(command_section(program, [*words, name]) for name in below)
    out += "\n    " + re.sub(r"^Usage: ", "", " ".join(usage)) + "\n"
    rows = entries(help_text.get("Positionals", [])) + entries(help_text.get("Options", []))
    rows = [option_row(*row) for row in rows if not row[0].startswith("-h")]
    out += "\n| | |\n|---|---|\n" + "".join(rows) if rows else ""
    if example := [line for line in help_text.get("Example", []) if line.strip()]:
        out += "\nExample:\n\n" + "".join(f"    {line[2:]}\n" for line in example)
    return out + "\n"


def commands(program):
    """What stands between the marks of cli.md."""
    names = subcommands(read_help(said(program, "--help")))
    return "\n" + "".join(command_section(program, [name]) for name in names)


# The keys of files.


def read_table(text):
    """Rows of `schema --keys`: (depth, {column: text}); a line `type: NAME` has only a key."""
    head, *lines = text.splitlines()
    at = [head.index(column) for column in COLUMNS] + [None]
    for line in lines:
        if re.match(r" *type: ", line):
            row = {column: "" for column in COLUMNS} | {"key": line}
        else:
            row = {column: line[a:b] for column, a, b in zip(COLUMNS, at, at[1:])}
        depth = (len(row["key"]) - len(row["key"].lstrip())) // 2
        yield depth, {column: value.strip() for column, value in row.items()}


def tree(rows):
    """The rows as nested lists: [row, [children]]."""
    root, trail = [], []
    for depth, row in rows:
        node = [row, []]
        del trail[depth:]
        (trail[-1][1] if trail else root).append(node)
        trail.append(node)
    return root


def default_text(text):
    """A default with as many digits as people read."""
    if not text:
        return ""
    text = re.sub(r"\d+\.\d{6,}", lambda match: f"{float(match[0]):.6g}", text)
    return "" if text in ("required", "none", '""', "[]") else f"`{text}`"


def row_text(key, row):
    allowed = "" if row["allowed"] == "true | false" else row["allowed"].replace("..", " … ")
    if "|" in allowed:
        allowed = ", ".join(f"`{word}`" for word in allowed.split(" | "))
    meaning = ("**Required.** " if row["default"] == "required" else "") + row["meaning"]
    cells = (f"`{key}`", row["unit"], default_text(row["default"]), allowed, cell(meaning))
    return f"| {' | '.join(cells)} |\n"


def is_type(node):
    return node[0]["key"].startswith("type: ")


class Page:
    """The tables of one kind of file."""

    def __init__(self):
        self.printed = {}  # keys of a group, and where they were printed first

    def table(self, path, nodes, inside=""):
        """Tables of `nodes`; keys are shown below `inside`, what has types comes after in sections."""
        rows, later = "", []
        for row, children in nodes:
            key = inside + row["key"]
            rows += self.group(path, key, row, children, later)
        text = f"| key | unit | default | range | meaning |\n|---|---|---|---|---|\n{rows}" if rows else ""
        return text + "".join(self.types(*what) for what in later)

    def group(self, path, key, row, children, later):
        """Rows of a key and what is within it."""
        full = ".".join(filter(None, [path, key]))
        types = [child for child in children if is_type(child)]
        if types:
            later.append((full, types))
            row = row | {"allowed": " | ".join(child[0]["key"][6:] for child in types)}
            if len(types) == 1:
                row["allowed"] = types[0][0]["key"][6:]
        content = repr(children)
        if len(children) > 1 and content in self.printed:
            meaning = f"{row['meaning']} Keys as of `{self.printed[content]}` above."
            return row_text(key, row | {"meaning": meaning})
        self.printed.setdefault(content, full)
        text = row_text(key, row)
        for child, below in [] if types else children:
            text += self.group(path, f"{key}.{child['key']}", child, below, later)
        return text

    def types(self, path, nodes):
        """A section for each alternative of a key."""
        text = ""
        for row, children in nodes:
            text += f"\n#### `{path}`: `{row['key'][6:]}`\n\n" + (self.table(path, children) or "No keys.\n")
        return text

    @staticmethod
    def link(kind, node):
        """An entry of the list of groups."""
        name = node[0]["key"]
        types = [child[0]["key"][6:] for child in node[1] if is_type(child)]
        text = f"- [{name}](#{kind}-{name})"
        return text + (": " if types else "") + ", ".join(f"[{t}](#{name}-{t})" for t in types) + "\n"

    def of(self, kind, roots):
        plain = [node for node in roots if not node[1]]
        text = f"\n## {kind.capitalize()}\n\nFor {KINDS[kind]}.\n\n"
        text += "".join(self.link(kind, node) for node in roots if node[1])
        text += "\n" if text.endswith(")\n") else ""
        if plain:
            text += self.table("", plain)
        for node in roots:
            if node[1]:
                text += f"\n### {kind}: `{node[0]['key']}`\n\n"
                types = any(is_type(child) for child in node[1])
                text += f"{node[0]['meaning']}\n"
                if types:
                    names = ", ".join(f"`{child[0]['key'][6:]}`" for child in node[1])
                    default = default_text(node[0]["default"])
                    text += f"`type` is one of {names}" + (f"; default {default}.\n" if default else ".\n")
                    text += self.types(node[0]["key"], node[1])
                else:
                    text += "\n" + self.table("", node[1], node[0]["key"] + ".")
        return text


def parameters(program):
    """The page of all keys."""
    links = ", ".join(f"[{kind}](#{kind})" for kind in KINDS)
    text = HEAD + f"\nFiles: {links}.\n"
    for kind in KINDS:
        text += Page().of(kind, tree(read_table(said(program, "schema", kind, "--keys"))))
    return text


def pages(program):
    """{file: text} of all that is written."""
    old = CLI.read_text(encoding="utf-8")
    generated = commands(program)
    new, count = MARKS.subn(lambda match: match[1] + generated + match[2], old)
    if count != 1:
        sys.exit(f"{CLI}: must have one `<!-- commands: … -->` and `<!-- end -->` after it")
    return {CLI: new, PARAMETERS: parameters(program)}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--check", action="store_true", help="complain instead of writing")
    options = parser.parse_args()
    wrong = False
    for file, text in pages(str(pathlib.Path(options.program).resolve())).items():
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
