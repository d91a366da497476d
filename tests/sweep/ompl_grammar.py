#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Reads OMPL benchmark logs strictly by the grammar of OMPL's page "How to Benchmark Planners".

    ompl_grammar.py [--ompl] LOG...

Anything else than the grammar is an error that names the line. OMPL 1.5.2 itself goes beyond its
grammar in four places. Two are taken always: a blank in the date, and the type ENUM of a property
that is an enum. Two only with --ompl: enum values and property values with blanks, and the empty
version number of Debian's build. Without --ompl each log is also damaged in many ways, all of which
must be refused.
"""

import re
import sys

NUMBER = r"-?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
INT = r"-?\d+"
WORD = r"\S+"
TYPES = ("BOOLEAN", "INTEGER", "REAL")
DATUM = rf"(?:{NUMBER}|inf|nan|)"


class Deviation(Exception):
    """A line that the grammar does not have."""


class Log:
    def __init__(self, text, ompl=False):
        if not text.endswith("\n") or "\r" in text:
            raise Deviation("the log does not end with a line's end, or has a carriage return")
        self.lines = text[:-1].split("\n")
        self.at = 0
        self.ompl = ompl
        self.read()
        if self.at != len(self.lines):
            raise Deviation(f"line {self.at + 1}: nothing more is expected")

    def fail(self, what):
        raise Deviation(f"line {self.at}: {what}")

    def line(self, pattern, what):
        """The groups of the next line, all of which must match."""
        if self.at == len(self.lines):
            raise Deviation(f"the log ends, {what} is expected")
        self.at += 1
        found = re.fullmatch(pattern, self.lines[self.at - 1])
        if not found:
            self.fail(f"{self.lines[self.at - 1]!r} is no {what}")
        return found.groups()

    def is_next(self, pattern):
        return self.at < len(self.lines) and bool(re.fullmatch(pattern, self.lines[self.at]))

    def block(self, what):
        """Lines between <<<| and |>>>; there is at least one."""
        self.line(r"<<<\|", what)
        lines = []
        while not self.is_next(r"\|>>>"):
            lines.append(self.line(r"(.*)", what)[0])
            if lines[-1].startswith(("|>>>", "<<<|")):
                self.fail("a mark within a block")
        self.line(r"\|>>>", what)
        if not lines:
            self.fail(f"{what} is empty")

    def counted(self, words, least=0):
        count = int(self.line(rf"({INT}) {words}", words)[0])
        if count < least:
            self.fail(f"{count} {words}")
        return count

    def read(self):
        if self.is_next(r"\S+ version.*"):
            self.line(rf"{WORD} version {'.*' if self.ompl else WORD}", "version")
        self.line(rf"Experiment {WORD}", "experiment")
        if self.is_next(rf"{INT} experiment properties"):
            names = [self.line(rf"({WORD}) (?:{'|'.join(TYPES)}) = {NUMBER}", "experiment property")[0]
                     for _ in range(self.counted("experiment properties", 1))]
            self.unique(names)
        self.line(rf"Running on {WORD}", "host")
        self.line(r"Starting at \d{4}-\d\d-\d\d[ T]\d\d:\d\d:\d\d(?:\.\d+)?", "date")
        self.block("setup")
        if self.is_next(r"<<<\|"):
            self.block("cpuinfo")
        self.line(rf"{INT} is the random seed", "random seed")
        self.line(rf"{NUMBER} seconds per run", "time limit")
        self.line(rf"{NUMBER} MB per run", "memory limit")
        self.runs = None
        if self.is_next(rf"{INT} runs per planner"):
            self.runs = self.counted("runs per planner", 1)
        self.line(rf"{NUMBER} seconds spent to collect the data", "total time")
        self.enums = {}
        if self.is_next(rf"{INT} enum type"):
            for _ in range(self.counted("enum type", 1)):
                value = r"[^|]+" if self.ompl else r"[^|\s]+"
                name, values = self.line(rf"(\w+)((?:\|{value})+)", "enum")
                self.enums[name] = values[1:].split("|")
        for _ in range(self.counted("planners", 1)):
            self.planner()

    def unique(self, names):
        if len({name.lower() for name in names}) < len(names):
            self.fail("two names are the same")

    def properties(self, words):
        found = []
        for _ in range(self.counted(words, 1)):
            name, kind = self.line(r"(\S(?:.*\S)?) (\S+)", "property")
            if kind not in TYPES and not (kind == "ENUM" and name in self.enums):
                self.fail(f"{kind} is no type")
            found.append((name, kind))
        self.unique([name.replace(" ", "_") for name, _ in found])
        return found

    def datum(self, text, name, kind):
        if text in ("", "inf", "nan"):
            return
        if kind != "REAL" and not re.fullmatch(INT, text):
            self.fail(f"{name} is {text}, no whole number")
        if kind == "BOOLEAN" and text not in ("0", "1"):
            self.fail(f"{name} is {text}, not 0 or 1")
        if kind == "ENUM" and not 0 <= int(text) < len(self.enums[name]):
            self.fail(f"{name} is {text}, no value of the enum")

    def planner(self):
        self.line(WORD, "planner's name")
        value = r"\S.*" if self.ompl else WORD
        for _ in range(self.counted("common properties")):
            self.line(rf"\S.*? = {value}", "planner's property")
        kinds = self.properties("properties for each run")
        runs = self.counted("runs", 1)
        if self.runs is not None and runs > self.runs:
            self.fail(f"{runs} runs, the experiment has {self.runs} per planner")
        for _ in range(runs):
            row = self.line(rf"((?:{DATUM}; ){{{len(kinds)}}})", "run with all its values")[0]
            for text, (name, kind) in zip(row.split("; ")[:-1], kinds, strict=True):
                self.datum(text, name, kind)
        if self.is_next(rf"{INT} progress properties for each run"):
            kinds = self.properties("progress properties for each run")
            sample = rf"(?:{DATUM},){{{len(kinds)}}}"
            if self.counted("runs") != runs:
                self.fail(f"progress of another number of runs than {runs}")
            for _ in range(runs):
                self.line(rf"{sample}(?:;{sample})*;?", "run's progress")
        self.line(r"\.", "end of the planner")


def damaged(text):
    """Logs with one fault each."""
    lines = text[:-1].split("\n")
    inside = False
    for i, line in enumerate(lines):
        inside = line.startswith("<<<|") or (inside and not line.startswith("|>>>"))
        optional = line.endswith((" version", "runs per planner")) or " version " in line
        free = inside and not line.startswith("<<<|")
        if not optional and not free:
            yield lines[:i] + lines[i + 1:]
        if not free and i + 1 < len(lines):
            yield lines[:i] + [line, line] + lines[i + 1:]
            yield lines[:i] + [line + "x y"] + lines[i + 1:]
        if re.match(rf"{INT} (?!is the|seconds|MB|runs per)", line):
            first, rest = line.split(" ", 1)
            yield lines[:i] + [f"{int(first) + 1} {rest}"] + lines[i + 1:]
        if "; " in line and not free:
            yield lines[:i] + [line[:-1]] + lines[i + 1:]
            yield lines[:i] + ["2; " + line.split("; ", 1)[1]] + lines[i + 1:]


def main():
    ompl = "--ompl" in sys.argv
    for path in [one for one in sys.argv[1:] if one != "--ompl"]:
        with open(path, encoding="utf-8", newline="") as file:
            text = file.read()
        try:
            Log(text, ompl)
        except Deviation as error:
            sys.exit(f"{path}: {error}")
        for lines in [] if ompl else damaged(text):
            try:
                Log("\n".join(lines) + "\n")
            except Deviation:
                continue
            with open(path + ".damaged", "w", encoding="utf-8") as file:
                file.write("\n".join(lines) + "\n")
            sys.exit(f"{path}.damaged: was taken although it is damaged")


if __name__ == "__main__":
    main()
