#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes docs/results/figures.md, the papers' values beside ours, from the rows in docs/results/figures.json.

    tools/figures_page.py                              writes it
    tools/figures_page.py --check                      complains where it says something else
    tools/figures_page.py --measure PROGRAM [KEY...]   measures the rows anew, in full, and writes it

Rows for which a paper gives no value, and those that vary from run to run, are left out: the rows in tests/golden
tell which.
"""

import json
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
GOLDEN = ROOT / "tests" / "golden"
STORED = ROOT / "docs" / "results" / "figures.json"
KEPT = ("figure", "quantity", "unit", "paper", "aim", "ok", "ours")
PAGE = ROOT / "docs" / "results" / "figures.md"
PAPERS = {"drrt": "drrt.md", "radar": "radar.md", "global": "global.md", "gather": "gather.md"}
FIGURES = {"drrt": "fig3 fig5a fig5b", "radar": "fig1 fig5-6 fig7 fig8 fig10 fig11-12 fig13",
           "global": "fig3-5 fig9-10 fig12", "gather": "fig3-6 fig9 fig10"}
HEAD = """# The papers' figures beside ours

Written by `tools/figures_page.py` from full runs, `microswarm reproduce KEY/FIGURE`, kept in [figures.json](figures.json).
The tables have all rows for which the [paper](../reference/papers.md) gives a value, but for times of computation.
An aim is the paper's value with a tolerance, which `reproduce` prints. A dash is no aim.
"""


def number(value):
    """A value with four digits."""
    if value is None:
        return "–"
    text = f"{value:.4g}" if abs(value) < 10000 else f"{value:,.0f}"
    return "0" if text == "-0" else text


def cells(row):
    unit = "" if row["unit"] == "1" else f" {row['unit']}"
    verdict = {True: "yes", False: "**no**", None: "–"}[row["ok"]]
    quantity = row["quantity"].replace("|", "\\|")
    return (row["figure"], quantity, number(row["paper"]) + unit, number(row["ours"]) + unit,
            number(row["aim"]), verdict)


def table(rows):
    head = ("figure", "quantity", "paper", "ours", "aim", "met")
    lines = [head, ("---",) * len(head), *map(cells, rows)]
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def section(key, rows):
    """The section of one paper."""
    judged = [row["ok"] for row in rows if row["ok"] is not None]
    about = f"{len(rows)} rows; of {len(judged)} that can be judged, {sum(judged)} are met. [More]({PAPERS[key]})."
    return f"\n## [{key}]\n\n{about}\n\n{table(rows)}"


def written(stored):
    """The page."""
    return HEAD + "".join(section(key, stored[key]) for key in PAPERS)


def name(row):
    return row["figure"], row["quantity"]


def published(rows, golden):
    """Those for which the paper gives a value, and which do not vary from run to run."""
    varying = {name(row) for row in golden if row.get("varies")}
    return [{field: row[field] for field in KEPT} for row in rows if row["paper"] is not None and name(row) not in varying]


def measured(program, key):
    """The rows of a paper, in full."""
    golden = json.loads((GOLDEN / f"{key}.json").read_text(encoding="utf-8"))
    rows = []
    for figure in FIGURES[key].split():
        print(f"{key}/{figure}", file=sys.stderr)
        done = subprocess.run([program, "reproduce", f"{key}/{figure}", "--json"], stdout=subprocess.PIPE, check=False)
        if done.returncode not in (0, 3):
            sys.exit(f"{program} reproduce {key}/{figure}: exit code {done.returncode}")
        rows += published(json.loads(done.stdout)["rows"], golden)
    return rows


def renew(program, keys):
    """Stores the rows of some papers anew."""
    stored = json.loads(STORED.read_text(encoding="utf-8")) if STORED.exists() else {}
    for key in keys or PAPERS:
        stored[key] = measured(program, key)
        lines = (f'"{paper}": [\n' + ",\n".join(json.dumps(row, ensure_ascii=False) for row in stored[paper]) + "\n]"
                 for paper in PAPERS if paper in stored)
        STORED.write_text("{" + ",\n".join(lines) + "}\n", encoding="utf-8")


def main():
    if sys.argv[1:2] == ["--measure"]:
        renew(sys.argv[2], sys.argv[3:])
    text = written(json.loads(STORED.read_text(encoding="utf-8")))
    if "--check" not in sys.argv[1:]:
        PAGE.write_text(text, encoding="utf-8")
    elif not PAGE.exists() or PAGE.read_text(encoding="utf-8") != text:
        sys.exit(f"{PAGE}: not as {STORED.name} has it; run tools/figures_page.py")


if __name__ == "__main__":
    main()
