#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes docs/results/figures.md, the papers' values beside ours, from the rows in tests/golden.

    tools/figures_page.py            writes it
    tools/figures_page.py --check    complains where it says something else

Rows for which a paper gives no value, and those that vary from run to run, are left out.
"""

import json
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
GOLDEN = ROOT / "tests" / "golden"
PAGE = ROOT / "docs" / "results" / "figures.md"
PAPERS = {"drrt": "drrt.md", "radar": "radar.md", "global": "global.md", "gather": "gather.md"}
HEAD = """# The papers' figures beside ours

Written by `tools/figures_page.py` from the rows that the tests compare with: `microswarm reproduce KEY --quick`, renewed by
`./dev rows KEY`. Shown are all rows for which the [paper](../reference/papers.md) gives a value, but for times of computation.
An aim is the paper's value with a tolerance, which `reproduce` prints. A dash is no aim, or too few trials to judge it.
Full runs, without `--quick`, are discussed on the pages linked below.
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
    shown = [row for row in rows if row["paper"] is not None and not row.get("varies")]
    judged = [row["ok"] for row in shown if row["ok"] is not None]
    about = f"{len(shown)} rows; of {len(judged)} that can be judged, {sum(judged)} are met. [More]({PAPERS[key]})."
    return f"\n## [{key}]\n\n{about}\n\n{table(shown)}"


def written(golden):
    """The page."""
    rows = {key: json.loads((golden / f"{key}.json").read_text(encoding="utf-8")) for key in PAPERS}
    return HEAD + "".join(section(key, rows[key]) for key in PAPERS)


def main():
    text = written(GOLDEN)
    if "--check" not in sys.argv[1:]:
        PAGE.write_text(text, encoding="utf-8")
    elif not PAGE.exists() or PAGE.read_text(encoding="utf-8") != text:
        sys.exit(f"{PAGE}: not as tests/golden has it; run tools/figures_page.py")


if __name__ == "__main__":
    main()
