#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Complains of a member without a default in a public struct of a header.

A designated initializer that leaves such a member out is a warning of -Wextra in a user's program.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
OPENING = re.compile(r"^\s*(?:template <[^{;]*>\s*)?(struct|class|enum|union|namespace)\b([^;{]*)\{")
MEMBER = re.compile(r"^\s+(?!using |static |friend |return |template |typedef |struct |class |enum |public|private|"
                    r"constexpr |mutable |virtual |explicit |operator)(?P<type>[A-Za-z_][\w:<>,\s]*?)\s+"
                    r"(?P<names>[a-z]\w*(?:, [a-z]\w*)*);")
PLAIN = re.compile(r"^(const )?(std::)?(double|float|int|bool|char|size_t|ptrdiff_t|u?int\d+_t)$|^std::array<|^const ")
# Types without a default.
WITHOUT = {"GatheringMaze", "MergedRobots", "PartialPlan", "Waveform", "actuation::CoilSystem", "Snapshot", "Rig",
           "experiment::Experiment", "std::span<const double, 3>"}


def code_of(line):
    """The line without comment and texts."""
    return re.sub(r'"(?:[^"\\]|\\.)*"', '""', line.split("//")[0])


def members(text):
    """Line number, type and names of members without a default in public structs."""
    stack = []  # of open braces: "struct", "other", "hidden"
    pending = ""
    for number, line in enumerate(text.split("\n"), 1):
        code = code_of(line)
        if stack and stack[-1] == "struct" and re.match(r"\s*(private|protected):", code):
            stack[-1] = "hidden"
        found = MEMBER.match(code)
        if found and stack and stack[-1] == "struct" and "hidden" not in stack and not pending.strip():
            yield number, found["type"].strip(), found["names"]
        pending += code
        for i, sign in enumerate(code):
            if sign == "{":
                head = OPENING.match(pending[: len(pending) - len(code) + i + 1].split(";")[-1].split("}")[-1])
                kind = head[1] if head else "other"
                stack.append({"struct": "struct", "namespace": "namespace", "class": "hidden"}.get(kind, "other"))
            elif sign == "}":
                if stack:
                    stack.pop()
        if code.rstrip().endswith((";", "{", "}", ":")) or not code.strip() or code.lstrip().startswith("#"):
            pending = ""


def main():
    bad = 0
    for header in sorted((ROOT / "src").rglob("*.hpp")):
        for number, kind, names in members(header.read_text(encoding="utf8")):
            if PLAIN.match(kind) or kind in WITHOUT:
                continue
            print(f"{header.relative_to(ROOT)}:{number}: {names} has no default: write {names}{{}}")
            bad += 1
    return min(bad, 1)


if __name__ == "__main__":
    sys.exit(main())
