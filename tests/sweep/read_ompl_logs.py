#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Takes logs in by the rules of OMPL's ompl_benchmark_statistics.py, into an SQLite database, and
compares what arrived with the sweep's CSV: read_ompl_logs.py FILE.csv LOG..."""

import csv
import math
import sqlite3
import sys


class Log:
    """A log's lines, each of which is known by words at fixed places."""

    def __init__(self, path):
        with open(path, encoding="utf-8") as file:
            self.lines = file.read().split("\n")
        self.next = 0

    def line(self):
        self.next += 1
        return self.lines[self.next - 1]

    def value(self, place, **words):
        """The word at `place` of a line that has the words at their places (p0, n1 for -1, ...)."""
        tokens = self.line().split()
        for where, word in words.items():
            at = int(where[1:]) * (-1 if where[0] == "n" else 1)
            assert tokens[at] == word, (tokens, where, word)
        return tokens[place]

    def block(self):
        assert self.line().startswith("<<<|")
        text = ""
        while not (line := self.line()).startswith("|>>>"):
            text += line + "\n"
        return text


def columns(database, table):
    return [row[1] for row in database.execute(f"PRAGMA table_info({table})")]


def add_columns(database, table, properties):
    for name, kind in properties:
        if name not in columns(database, table):
            database.execute(f"ALTER TABLE {table} ADD {name} {kind}")


def insert(database, table, names, values):
    marks = ",".join("?" * len(values))
    return database.execute(f"INSERT INTO {table} ({','.join(names)}) VALUES ({marks})",
                            values).lastrowid


def read(database, path):
    log = Log(path)
    log.value(-1, p1="version")
    name = log.value(-1, p0="Experiment")
    settings = []
    for _ in range(int(log.value(0, n2="experiment", n1="properties"))):
        key, value = log.line().strip().split(" = ")
        settings.append((*key.split(" "), value))
    add_columns(database, "experiments", [(key, kind) for key, kind, _ in settings])
    log.value(-1, p0="Running")
    assert log.line().startswith("Starting")
    log.block()
    int(log.value(0, n2="random", n1="seed"))
    float(log.value(0, n3="seconds", n2="per", n1="run"))
    float(log.value(0, n3="MB", n2="per", n1="run"))
    runs_per_planner = int(log.value(0, n3="runs", n2="per", n1="planner"))
    float(log.value(0, n3="collect", n2="the", n1="data"))
    enums = {}
    for _ in range(int(log.value(0, n2="enum"))):
        words = log.line().split("|")
        enums[words[0]] = words[1:]
    experiment = insert(database, "experiments", ["name"] + [key for key, _, _ in settings],
                        [name] + [value for _, _, value in settings])
    for _ in range(int(log.value(0, n1="planners"))):
        read_planner(database, log, experiment, runs_per_planner)
    assert log.lines[log.next:] == [""]
    return enums["status"]


def read_planner(database, log, experiment, runs_per_planner):
    planner = log.line()
    for _ in range(int(log.line().split()[0])):
        assert " = " in log.line()
    properties = []
    for _ in range(int(log.line().split()[0])):
        words = log.line().split()
        properties.append(("_".join(words[:-1]), words[-1]))
    add_columns(database, "runs", properties)
    names = ["experiment", "planner"] + [name for name, _ in properties]
    runs = int(log.line().split()[0])
    assert runs == runs_per_planner
    for _ in range(runs):
        values = [None if word in ("", "nan", "inf") else word for word in log.line().split("; ")[:-1]]
        insert(database, "runs", names, [experiment, planner] + values)
    assert log.line().strip() == "."


def same(stored, text):
    """SQLite's own reading of a decimal fraction may differ from the nearest double in the last bit."""
    return math.isclose(stored, float(text), rel_tol=1e-15)


def main():
    database = sqlite3.connect(":memory:")
    database.execute("CREATE TABLE experiments (id INTEGER PRIMARY KEY, name TEXT)")
    database.execute("CREATE TABLE runs (id INTEGER PRIMARY KEY, experiment INTEGER, planner TEXT)")
    for path in sys.argv[2:]:
        statuses = read(database, path)
    with open(sys.argv[1], encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    database.row_factory = sqlite3.Row
    found = database.execute("SELECT * FROM runs JOIN experiments ON experiment = experiments.id "
                             "ORDER BY runs.id").fetchall()
    goals = list(dict.fromkeys(row["goal_um"] for row in rows))  # of words, a log has their places
    for run, row in zip(found, rows, strict=True):
        assert run["planner"] == row["method"].replace(" ", "_")
        assert statuses[run["status"]] == row["status"]
        assert str(run["solved"]) == row["arrived"]
        assert same(run["length_um"], row["length_um"])
        assert same(run["time"], row["compute_s"])
        assert same(run["navigator_clearance_um"], row["navigator_clearance_um"])
        assert goals[run["goal_um"]] == row["goal_um"]


main()
