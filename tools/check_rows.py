#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares what `microswarm reproduce KEY --quick` measures with the rows that are stored for KEY.

    tools/check_rows.py build/release/bin/microswarm global
    tools/check_rows.py build/release/bin/microswarm global --renew

A stored row that `varies` is only looked for: renewing measures twice, and what differs then (times)
is such a row.
"""

import argparse
import json
import os
import pathlib
import subprocess
import sys

GOLDEN = pathlib.Path(__file__).resolve().parent.parent / "tests" / "golden"
STORED = ("figure", "quantity", "unit", "paper", "aim", "ok", "ours")
POINTS = 1.0  # of a value in %
SHARE = 0.02  # of any other value


def name(row):
    return f'{row["figure"]}: {row["quantity"]}'


def measured(program, key, settings=None):
    """Rows of KEY, without files that are no part of the repository; `settings` of the environment."""
    done = subprocess.run(
        [program, "reproduce", key, "--quick", "--json"],
        env=os.environ | {"MICROSWARM_DATA": "/nonexistent"} | (settings or {}),
        stdout=subprocess.PIPE,
        check=False,
    )
    if done.returncode not in (0, 3):
        sys.exit(f"{program} reproduce {key}: exit code {done.returncode}")
    return json.loads(done.stdout)["rows"]


def faults_of(rows):
    """What is wrong with rows whatever they should be."""
    names = [name(row) for row in rows]
    for twice in sorted({n for n in names if names.count(n) > 1}):
        yield f"{twice}: there are two such rows"
    for row in rows:
        if row["aim"] is None and not row.get("note"):
            yield f"{name(row)}: has no aim and does not say why"


def near(ours, stored, unit):
    if ours is None or stored is None:
        return ours is stored
    return abs(ours - stored) <= (POINTS if unit == "%" else SHARE * abs(stored))


def differences(rows, stored):
    now = {name(row): row for row in rows}
    then = {name(row): row for row in stored}
    for gone in then.keys() - now.keys():
        yield f"{gone}: is stored but was not measured"
    for new in now.keys() - then.keys():
        yield f"{new}: was measured but is not stored"
    for key in now.keys() & then.keys():
        varies = then[key].get("varies", False)
        for what in STORED[2:]:
            if varies and what in ("ok", "ours"):
                continue
            is_now, was = now[key][what], then[key][what]
            same = near(is_now, was, now[key]["unit"]) if what == "ours" else is_now == was
            if not same:
                yield f"{key}: {what} is {is_now}, stored is {was}"


def renewed(first, second):
    """What is stored of two measurements of the same rows."""
    out = []
    for row, again in zip(first, second, strict=True):
        kept = {what: row[what] for what in STORED}
        if row["ours"] != again["ours"]:
            kept |= {"ok": None, "ours": None, "varies": True}
        out.append(kept)
    return out


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("key", help="drrt, global, radar or gather")
    parser.add_argument("--renew", action="store_true", help="store what is measured")
    options = parser.parse_args()
    rows = measured(options.program, options.key)
    wrong = list(faults_of(rows))
    file = GOLDEN / f"{options.key}.json"
    if options.renew:
        lines = [json.dumps(row, ensure_ascii=False) for row in
                 renewed(rows, measured(options.program, options.key))]
        GOLDEN.mkdir(exist_ok=True)
        file.write_text("[\n" + ",\n".join(lines) + "\n]\n", encoding="utf-8")
    else:
        wrong += sorted(differences(rows, json.loads(file.read_text(encoding="utf-8"))))
    for line in wrong:
        print(line)
    if wrong and not options.renew:
        print(f"if that is meant: ./dev rows {options.key}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
