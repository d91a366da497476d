#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares the hashes of records with those that are stored in tests/golden/records.txt.

    tools/check_records.py build/release/bin/microswarm
    tools/check_records.py build/release/bin/microswarm --renew
    tools/check_records.py build/release/bin/microswarm --masked

Each line there is a hash and the arguments of `microswarm run` that it belongs to: every shipped
scenario, and every navigator. Renewing keeps the arguments, adds scenarios that are missing and
stores what is measured; the commit says why the hashes changed. Masked, the C library and
OpenCV are told that the CPU has neither FMA nor AVX2: then they compute other last bits, and nothing
may depend on them. Every third line is compared so, and a sweep and some figures with those of the CPU as it is.
"""

import argparse
import concurrent.futures
import csv
import json
import os
import pathlib
import shlex
import subprocess
import sys
import tempfile

import check_rows

ROOT = pathlib.Path(__file__).resolve().parent.parent
STORED = ROOT / "tests" / "golden" / "records.txt"
LIMIT = 300  # [s] of a run
MASK = {  # the C library's, and OpenCV's
    "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-FMA,-AVX2,-FMA4",
    "OPENCV_CPU_DISABLE": "AVX2,AVX512-SKX,AVX,FP16",
}
EVERY_MASKED = 3
SWEEP = "scenarios/sweeps/first_flight.yaml"
FIGURES = ("drrt/fig3", "drrt/follower", "radar/fig8")


def measured(program, arguments, mask):
    """The record's hash, or what went wrong."""
    done = subprocess.run(
        [program, "run", *shlex.split(arguments), "--json"],
        cwd=ROOT,
        env=os.environ | mask,
        capture_output=True,
        text=True,
        timeout=LIMIT,
        check=False,
    )
    if done.returncode not in (0, 3):
        return f"exit code {done.returncode}: {done.stderr.strip()}"
    return json.loads(done.stdout)["record_hash"]


def stored():
    """Arguments and their hash, in the file's order."""
    lines = STORED.read_text(encoding="utf-8").splitlines() if STORED.exists() else []
    pairs = [line.split(maxsplit=1) for line in lines if line and not line.startswith("#")]
    return {arguments: hash_ for hash_, arguments in pairs}


def shipped():
    """Every shipped scenario."""
    folders = ("maps", "queues", "rigs", "sweeps")
    files = (file.relative_to(ROOT) for file in (ROOT / "scenarios").rglob("*.yaml"))
    return sorted(str(file) for file in files if file.parts[1] not in folders)


def trials(program, mask):
    """The hashes of the records of a sweep."""
    with tempfile.TemporaryDirectory() as folder:
        table = pathlib.Path(folder) / "trials.csv"
        command = [program, "sweep", SWEEP, "--out", f"{folder}/trials.db", "--csv", str(table)]
        subprocess.run(command, cwd=ROOT, env=os.environ | mask, capture_output=True, timeout=LIMIT,
                       check=True)
        with table.open(encoding="utf-8", newline="") as rows:
            return [row["record_hash"] for row in csv.DictReader(rows)]


def figures(program, mask):
    """The rows of some figures, but for those that vary from run to run: times."""
    files = [STORED.with_name(f"{key.partition('/')[0]}.json") for key in FIGURES]
    varying = {check_rows.name(row) for file in files
               for row in json.loads(file.read_text(encoding="utf-8")) if row.get("varies")}
    rows = [row for key in FIGURES for row in check_rows.measured(program, key, mask)]
    return {check_rows.name(row): row["ours"] for row in rows if check_rows.name(row) not in varying}


def masked_faults(program):
    """Where a sweep and figures differ with the mask and without."""
    if trials(program, MASK) != trials(program, {}):
        yield f"{SWEEP}: other records without FMA"
    plain, masked = figures(program, {}), figures(program, MASK)
    for row in plain.keys() | masked.keys():
        if plain.get(row) != masked.get(row):
            yield f"{row}: is {masked.get(row)} without FMA, {plain.get(row)} with it"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    what = parser.add_mutually_exclusive_group()
    what.add_argument("--renew", action="store_true", help="store what is measured")
    what.add_argument("--masked", action="store_true", help="as on a CPU without FMA")
    options = parser.parse_args()
    program = str(pathlib.Path(options.program).resolve())
    known = stored()
    missing = [file for file in shipped() if file not in known]
    if options.masked:
        known = {case: known[case] for case in [*known][::EVERY_MASKED]}
    cases = [*known, *missing]
    mask = MASK if options.masked else {}
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        found = pool.map(lambda case: measured(program, case, mask), cases)
        hashes = dict(zip(cases, found, strict=True))
    faults = [f"{case}: {found}" for case, found in hashes.items() if " " in found]
    if options.renew and not faults:
        text = "# Hashes of records, see tools/check_records.py\n"
        text += "".join(f"{hashes[case]}  {case}\n" for case in cases)
        part = STORED.with_suffix(".part")
        part.write_text(text, encoding="utf-8")
        part.replace(STORED)
        return 0
    if not options.renew:
        faults += [f"{case}: no hash is stored" for case in missing if " " not in hashes[case]]
        faults += [
            f"{case}: hash is {hashes[case]}, stored is {hash_}"
            for case, hash_ in known.items()
            if hashes[case] != hash_ and " " not in hashes[case]
        ]
    if options.masked:
        faults += masked_faults(program)
    print("\n".join(faults) or f"{len(cases)} records are as stored")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
