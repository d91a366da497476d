#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares the hashes of records with those that are stored in tests/golden/records.txt.

    tools/check_records.py build/release/bin/microswarm
    tools/check_records.py build/release/bin/microswarm --renew

Each line there is a hash and the arguments of `microswarm run` that it belongs to: every shipped
scenario, and every navigator. Renewing keeps the arguments, adds scenarios that are missing and
stores what is measured; the commit says why the hashes changed.
"""

import argparse
import concurrent.futures
import json
import os
import pathlib
import shlex
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
STORED = ROOT / "tests" / "golden" / "records.txt"
LIMIT = 300  # [s] of a run


def measured(program, arguments):
    """The record's hash, or what went wrong."""
    done = subprocess.run(
        [program, "run", *shlex.split(arguments), "--json"],
        cwd=ROOT,
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
    """Every scenario that ships with all that it needs."""
    folders = ("rigs", "sweeps", "demo.yaml")  # the demo's map is made by the demo
    files = (file.relative_to(ROOT) for file in (ROOT / "scenarios").rglob("*.yaml"))
    return sorted(str(file) for file in files if file.parts[1] not in folders)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--renew", action="store_true", help="store what is measured")
    options = parser.parse_args()
    program = str(pathlib.Path(options.program).resolve())
    known = stored()
    missing = [file for file in shipped() if file not in known]
    cases = [*known, *missing]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        hashes = dict(zip(cases, pool.map(lambda case: measured(program, case), cases), strict=True))
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
    print("\n".join(faults) or f"{len(cases)} records are as stored")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
