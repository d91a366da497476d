#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Prints the tables of docs/results/safety.md from the rows in docs/results/safety.csv.

    tools/safety_page.py                          prints them into the page
    tools/safety_page.py --check                  complains where the page says something else
    tools/safety_page.py --take out/safety.csv…   stores rows that `reproduce radar/safety --out`
                                                  wrote, in place of those of the same name, first

A table stands between `<!-- safety: COURSE -->` and `<!-- end -->`.
"""

import argparse
import csv
import io
import math
import os
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs" / "results" / "safety.md"
STORED = ROOT / "docs" / "results" / "safety.csv"
TABLE = re.compile(r"(<!-- safety: ([^>]+) -->\n).*?(<!-- end -->)", re.S)
HEAD = (
    "navigator", "worlds", "contacts a run", "avoidable a run", "worlds with an avoidable one, %",
    "arrived, %", "time ÷ straight", "δ̄", "turning °",
)
COLUMNS = (
    "course", "navigator", "worlds", "contacts_a_run", "avoidable_a_run", "worlds_avoidable",
    "worlds_arrived", "slowness_median", "delta_mean", "turning_median_deg",
)


def interval(some, trials):
    """Wilson's 95 % interval of a share."""
    z = 1.959963984540054
    p = some / trials
    middle = (p + z * z / (2 * trials)) / (1 + z * z / trials)
    half = z / (1 + z * z / trials) * math.sqrt(p * (1 - p) / trials + z * z / (4 * trials**2))
    return (0 if some == 0 else middle - half, 1 if some == trials else middle + half)


def percent(some, trials):
    low, high = interval(some, trials)
    return f"{100 * some / trials:.3g} ({100 * low:.3g}–{100 * high:.3g})"


def number(text, digits):
    return f"{float(text):.{digits}g}" if text else "–"


def cells(row):
    trials = int(row["worlds"])
    return (
        row["navigator"], f"{trials:,}", number(row["contacts_a_run"], 3),
        number(row["avoidable_a_run"], 3), percent(int(row["worlds_avoidable"]), trials),
        percent(int(row["worlds_arrived"]), trials), number(row["slowness_median"], 4),
        number(row["delta_mean"], 3), number(row["turning_median_deg"], 4),
    )


def table(rows):
    lines = [HEAD, ("---",) * len(HEAD), *map(cells, rows)]
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def printed(page, rows):
    """The page with the tables of these rows; says which it has no rows for."""
    missing = []

    def replace(match):
        chosen = [row for row in rows if row["course"] == match[2]]
        if not chosen:
            missing.append(match[2])
        return match[1] + table(chosen) + match[3]

    return TABLE.sub(replace, page), missing


def whole(path, rows, courses):
    """The rows of a whole campaign without their last column, which must say so."""
    if not rows:
        sys.exit(f"{path}: has no rows")
    for line, row in enumerate(rows, start=2):
        if list(row) != [*COLUMNS, "extent"] or None in row.values():
            sys.exit(f"{path}:{line}: no table of a campaign: must have {', '.join(COLUMNS)}, extent")
        of = f"{path}:{line}: {row['course']}, {row['navigator']}"
        if row["course"] not in courses:
            sys.exit(f"{of}: the page has no table of that course, only {', '.join(courses)}")
        extent = row.pop("extent") or "unknown"
        if extent != "full":
            sys.exit(f"{of}: not of a whole campaign: {extent}")
        if not re.fullmatch(r"[\w *,()-]+", row["navigator"]):
            sys.exit(f"{of}: navigator must be a name")
        for key in ("worlds", "worlds_avoidable", "worlds_arrived"):
            if not row[key].isascii() or not row[key].isdigit() or int(row[key]) > int(row["worlds"]):
                sys.exit(f"{of}: {key} is '{row[key]}', must be a count of at most worlds")
        if int(row["worlds"]) == 0:
            sys.exit(f"{of}: worlds is 0")
        for key in COLUMNS[3:5] + COLUMNS[7:]:
            if row[key] and not re.fullmatch(r"\d+(\.\d+)?(e[+-]?\d+)?", row[key]):
                sys.exit(f"{of}: {key} is '{row[key]}', must be a number, at least 0")
    names = [(row["course"], row["navigator"]) for row in rows]
    for course, navigator in names:
        if names.count((course, navigator)) > 1:
            sys.exit(f"{path}: {course}, {navigator}: there are two such rows")
    return rows


def taken(stored, new):
    """The stored rows, those of the same course and navigator replaced."""
    rows = {(row["course"], row["navigator"]): row for row in stored}
    rows.update({(row["course"], row["navigator"]): row for row in new})
    return list(rows.values())


def read(path):
    try:
        with open(path, encoding="utf-8-sig", newline="") as file:
            return list(csv.DictReader(file))
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        sys.exit(f"{path}: {getattr(error, 'strerror', None) or 'no table as CSV'}")


def write(path, text):
    part = path.with_name(path.name + ".part")
    part.write_text(text, encoding="utf-8")
    os.replace(part, path)


def store(rows):
    text = io.StringIO()
    table_of = csv.DictWriter(text, COLUMNS, lineterminator="\n")
    table_of.writeheader()
    table_of.writerows(rows)
    STORED.parent.mkdir(exist_ok=True)
    write(STORED, text.getvalue())


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--check", action="store_true", help="complain instead of printing")
    parser.add_argument("--take", nargs="+", metavar="CSV", default=[], help="store these rows first")
    options = parser.parse_args()
    rows = read(STORED) if STORED.exists() else []
    page = PAGE.read_text(encoding="utf-8")
    for path in options.take:
        rows = taken(rows, whole(path, read(path), [found[2] for found in TABLE.finditer(page)]))
    text, missing = printed(page, rows)
    for course in missing:
        print(f"{STORED}: no rows of {course}", file=sys.stderr)
    if options.check:
        if text != page:
            print(f"{PAGE}: not as {STORED} has it; run tools/safety_page.py", file=sys.stderr)
        return 1 if missing or text != page else 0
    if missing:
        return 1
    if options.take:
        store(rows)
    write(PAGE, text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
