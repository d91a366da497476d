# SPDX-License-Identifier: Apache-2.0
"""The pages run as printed: every block of Python and every command, in the order of the page, from an empty start.

A command that names a file of the reader's, which is not shipped, is refused for that file and nothing else, so its options are
checked too. What cannot run is listed below with the reason.
"""

import os
import pathlib
import re
import shlex
import subprocess
import sys

import pytest

import microswarm as ms
from conftest import ROOT

DOCS = ROOT / "docs"
PAGES = [str(page.relative_to(DOCS)) for folder in ("tutorials", "how-to", "explanation") for page in sorted((DOCS / folder).glob("*.md"))]
WALKED_ELSEWHERE = {
    "tutorials/first-rig.md": "tests/tutorials walks it on a simulated board",
    "how-to/learn-in-an-environment.md": "test_learning.py walks it",
}
# The start of a command, and why it is not run here.
NOT_RUN = {
    "lab": "a server that does not end; tests/lab",
    "learn": "minutes; tests/learning",
    "reproduce": "minutes; tests/papers",
    "rig cameras": "a camera",
    "rig check bench.yaml": "a camera and a board",
    "rig run scenarios": "real time; tests/rig",
    "rig simulate scenarios/papers/radar/single.yaml": "minutes; tests/cli/rig_test.cpp",
    "map se<TAB>": "keys of completion; tests/packages",
    "plan map.png --set planner.type=<TAB>": "keys of completion; tests/packages",
    "run flight.yaml --set robots.<TAB>": "keys of completion; tests/packages",
    "run /usr/share": "an installed package; tests/packages",
}
DEVICES = ("/dev/", "genicam:")
# Files of the reader's.
OWN = {
    "board.png", "build/demo/retina.jpg", "chip.geojson", "chip.png", "coils.yaml", "fast.avi", "frame.png", "fundus.jpg", "measured.csv", "out/b/run.h5",
    "out/demo/run.h5", "out/retina/cross.yaml", "out/retina/vessels.geojson", "out/safety/safety-worlds/open-radar-13.yaml", "record.h5",
    "rig.yaml", "scenario.yaml", "slide.png", "swarm.mp4", "track.yaml", "trackpy.csv", "vessels.geojson", "~/Downloads/record.h5",
}  # fmt: skip
FAILS = {"run scenarios/first_flight.yaml --set tick=1 --set seed=-1"}  # is shown to fail
SHORTER = [("--trials 100", "--trials 3"), ("planner.max_nodes=300000", "planner.max_nodes=3000"), ("--width 1280", "--width 320")]


def parts_of(page):
    """Blocks and commands of a page in their order, as (kind, text, what stands before it)."""
    text = re.sub(r"\\\n +", " ", (DOCS / page).read_text(encoding="utf-8"))
    pattern = r"^```(\w*)\n(.*?)^```|^    ((?:microswarm |\w+=\S+$|cmake --build \S+ --target example_|build/release/(?:bin|examples)/)[^\n]*)$"
    for found in re.finditer(pattern, text, flags=re.M | re.S):
        kind = "command" if found[3] else found[1]
        yield kind, found[3] or found[2], text[: found.start()]


class Walk:
    """A reader who walks a page."""

    def __init__(self, page, program):
        self.page, self.program = page, program
        self.names, self.variables = {}, {}

    def command(self, line):
        """Runs a line of a shell."""
        for name, value in self.variables.items():
            line = line.replace(f"${name}", value)
        for long, short in SHORTER:
            line = line.replace(long, short)
        words = shlex.split(line.split(" | ")[0], comments=True)
        if len(words) == 1 and "=" in words[0]:
            self.variables.update([words[0].split("=")])
        elif words[0].endswith("microswarm"):
            self.run(words[1:], line)
        else:
            build_or_run_example(words)

    def run(self, words, line):
        asked = " ".join(words)
        if any(asked.startswith(start) for start in NOT_RUN) or any(device in asked for device in DEVICES):
            return
        done = subprocess.run([self.program, *words], capture_output=True, text=True)
        told = f"{self.page}: {line}\n{done.stdout}{done.stderr}"
        lacks = [word for word in words if word in OWN and not pathlib.Path(word).exists()]
        if asked in FAILS:
            assert done.returncode == 2, told
        elif lacks:
            assert done.returncode == 2 and any(one in done.stderr for one in lacks) and "option" not in done.stderr, told
        else:
            assert done.returncode in ((0,) if words[0] == "replay" else (0, 3)), told

    def block(self, kind, text, before):
        if kind == "python":
            exec(compile(text, f"{self.page} (python)", "exec"), self.names)  # noqa: S102
        if kind == "csv":
            pathlib.Path(re.findall(r"`([\w.]+\.csv)`", before)[-1]).write_text(text, encoding="utf-8")


def build_or_run_example(words):
    """Examples in C++ have tests of their own; here the one in Python, which writes the same record, runs in their place."""
    name = words[-1].rpartition("/")[2].removeprefix("example_")
    assert (ROOT / "examples" / f"{name}.cpp").exists(), words
    if words[0] != "cmake":
        subprocess.run([sys.executable, ROOT / "examples" / f"{name}.py"], check=True, capture_output=True)


@pytest.fixture
def in_a_folder_of_the_source(monkeypatch, tmp_path):
    for name in ("tests", "scenarios", "models"):
        (tmp_path / name).symlink_to(ROOT / name)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MICROSWARM_SCENARIOS", str(ROOT / "scenarios"))
    slow = ms.gather  # of 256 robots takes a minute
    monkeypatch.setattr(ms, "gather", lambda *a, **v: slow(*a, **{**v, "n": 8, "max_steps": 3, "progress": False}))


@pytest.mark.parametrize("page", [page for page in PAGES if page not in WALKED_ELSEWHERE])
def test_a_page_runs_as_printed(page, program, in_a_folder_of_the_source):
    walk = Walk(page, program)
    for kind, text, before in parts_of(page):
        if kind == "command":
            walk.command(text)
        else:
            walk.block(kind, text, before)


def test_pages_are_walked():
    kinds = [kind for page in PAGES for kind, *_ in parts_of(page)]
    assert kinds.count("command") > 90 and kinds.count("python") > 12
    assert all((DOCS / page).exists() for page in WALKED_ELSEWHERE)


def test_the_code_of_the_page_on_python_does_what_the_page_says(program, in_a_folder_of_the_source):
    walk = Walk("how-to/use-from-python.md", program)
    for kind, text, before in parts_of(walk.page):
        if kind == "python":
            walk.block(kind, text, before)
            if "ms.Navigator(" in text:
                assert walk.names["command"].state == "arrived"
    made = walk.names
    assert made["found"].mask.any() and len(made["one"]) == 8 and len(made["tracks"]) == 48
    assert made["made"].steps == 3 and os.path.exists("gather.h5")
    assert made["plan"].paths_um.shape[1:] == (2, 2) and made["path"].solved
    assert made["currents_a"].shape == (100, 6) and os.path.exists("coils.yaml")
    assert abs(made["mine"].matrix() - made["coils"].matrix((1000, 0, 0))).max() < 1e-6
    assert made["table"].rows == 200
