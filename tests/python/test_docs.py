# SPDX-License-Identifier: Apache-2.0
"""The pages run as printed: every block and every command, in the order of the page, from an empty start.

A command that names a file of the reader's, which is not shipped and has no stand-in, is refused for that file and nothing else, so its
options are checked too. What cannot run, and what other tests run, is listed below with the reason: a block that is in neither list fails.
"""

import collections
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import types

import pytest

import microswarm as ms
import readers_files
from conftest import ROOT
from pages import PAGES, blocks_of, lines_of

WALKED = [page for page in PAGES if page.startswith(("docs/tutorials/", "docs/how-to/", "docs/explanation/"))]
WALKED += ["README.md", "CONTRIBUTING.md", "docs/reference/record.md", "docs/reference/line-protocol.md"]
WALKED_ELSEWHERE = {
    "docs/tutorials/first-rig.md": "tests/tutorials walks it on a simulated board",
    "docs/how-to/learn-in-an-environment.md": "test_learning.py walks it",
}
HERE = ("python", "csv", "yaml", "bash", "shell")
EXEMPT = ("text",)  # what a program prints, and drawings
# Blocks that other tests run: how many, and which test. Another block on the page needs a test, too.
RUN_ELSEWHERE = {
    ("README.md", "cpp"): (1, "install.find_package"),
    ("docs/explanation/architecture.md", "cmake"): (1, "install.find_package"),
    ("docs/explanation/obstacle-weighted-rrt.md", "cpp"): (2, "test_declarations_are_those_of_the_headers"),
    ("docs/explanation/planners.md", "cpp"): (1, "test_declarations_are_those_of_the_headers"),
    ("docs/how-to/embed-in-cpp.md", "cmake"): (1, "install.find_package"),
    ("docs/how-to/embed-in-cpp.md", "cpp"): (1, "install.find_package"),
    ("docs/how-to/install.md", "cmake"): (1, "install.find_package"),
    ("docs/how-to/learn-in-an-environment.md", "python"): (5, "test_learning.py"),
    ("docs/how-to/sweep.md", "matlab"): (1, "tests/matlab/test_pages.m"),
    ("docs/how-to/use-from-c.md", "c"): (2, "example.c, example.c_values"),
    ("docs/how-to/use-from-matlab.md", "matlab"): (4, "tests/matlab/test_pages.m"),
    ("docs/reference/line-protocol.md", "matlab"): (1, "OwnDriver.TheServerForMatlabRunsInOctave"),
    ("docs/reference/line-protocol.md", "python"): (1, "OwnDriver.TheFewLinesOfItsPageAreADriver"),
    ("docs/reference/record.md", "matlab"): (1, "tests/matlab/test_pages.m"),
    ("docs/reference/record.md", "octave"): (1, "test_record_file.py"),
    ("docs/tutorials/first-run.md", "matlab"): (1, "tests/matlab/test_pages.m"),
    ("docs/tutorials/own-navigator.md", "cpp"): (3, "test_the_program_of_the_tutorial_is_the_example, example.04_own_navigator"),
}
# The start of a command, and why it is not run here.
NOT_RUN = {
    "lab": "a server that does not end; tests/lab",
    "learn": "minutes; tests/learning",
    "reproduce": "minutes; tests/papers",
    "rig cameras": "a camera",
    "rig check bench.yaml": "a camera and a board",
    "rig queue": "real time; tests/cli/rig_queue_test.cpp",
    "rig run scenarios": "real time; tests/rig",
    "rig simulate scenarios/papers/radar/single.yaml": "minutes; tests/cli/rig_test.cpp",
    "map se<TAB>": "keys of completion; tests/packages",
    "plan map.png --set planner.type=<TAB>": "keys of completion; tests/packages",
    "run flight.yaml --set robots.<TAB>": "keys of completion; tests/packages",
    "run /usr/share": "an installed package; tests/packages",
}
# The same of commands of other programs.
OTHERS_NOT_RUN = {
    "./dev ": "builds; .ci/run",
    "./steer ": "example.c",
    "MICROSWARM_MODULES=": "install.find_package",
    "PYTHONPATH=build/release/python": "this test runs so",
    "build/embedded ": "install.find_package",
    "c++ ": "install.find_package",
    "cc ": "example.c",
    "cmake ": "builds",
    "export ": "install.find_package, and the environment of this test",
    "man ": "an installed package; tests/packages",
    "python3 -m http.server --directory build/site": "a server that does not end; ./dev test site",
    "python3 tools/moving_picture.py out/demo": "what ./dev demo made",
    "ssh ": "another computer",
    "sudo apt ": "installs; tests/packages",
    "tests/packages/": "a bare machine",
}
TOOLS = ("diff", "h5dump", "mpirun", "sqlite3")
DEVICES = ("/dev/", "genicam:")
# Files of the reader's.
OWN = {
    "board.png", "build/demo/retina.jpg", "chip.geojson", "chip.png", "coils.yaml", "fast.avi", "frame.png", "fundus.jpg", "measured.csv",
    "out/demo/run.h5", "out/safety/safety-worlds/open-radar-13.yaml", "record.h5", "rig.yaml", "scenario.yaml", "slide.png", "swarm.mp4",
    "track.yaml", "trackpy.csv", "vessels.geojson", "~/Downloads/record.h5",
}  # fmt: skip
FAILS = {"run scenarios/first_flight.yaml --set tick=1 --set seed=-1"}  # is shown to fail
SHORTER = [("--trials 100", "--trials 3"), ("planner.max_nodes=300000", "planner.max_nodes=3000"), ("--width 1280", "--width 320")]
SHORTER += [("hours: 8", "hours: 0.001"), ("--robots 512", "--robots 8"), ("mpirun -n 64", "mpirun -n 2"), ("trials: 20", "trials: 2")]
# Of a block that is a part of a file, the keys replace those of a shipped file.
SCENARIO_KEYS = {"name", "map", "obstacles", "swarm", "start", "goal_um", "goal_tolerance_um", "navigator", "time_limit_s", "seed"}
RIG_KEYS = {"name", "coils", "field", "drive_rate_hz", "driver", "camera", "scale", "perception", "safety"}


def sections(text):
    """Keys at the left margin of a YAML text, each with its lines."""
    return {part.partition(":")[0]: part for part in re.split(r"^(?=\w)", text, flags=re.M) if re.match(r"\w", part)}


def completed(text, shipped):
    """The shipped file with the keys of a text."""
    return "\n".join((sections((ROOT / shipped).read_text(encoding="utf-8")) | sections(text)).values())


class Walk:
    """A reader who walks a page."""

    def __init__(self, page, program):
        self.page, self.program = page, program
        self.names, self.variables = {}, {}

    def block(self, block):
        """Runs a block."""
        for long, short in SHORTER:
            block.text = block.text.replace(long, short)
        if block.language == "shell":
            for line in lines_of(block):
                self.command(line)
        elif block.language in HERE and (self.page, block.language) not in RUN_ELSEWHERE:
            getattr(self, block.language)(block)

    def command(self, line):
        """Runs a line of a shell."""
        for name, value in self.variables.items():
            line = line.replace(f"${name}", value)
        if any(line.startswith(start) for start in OTHERS_NOT_RUN) and "example_" not in line:
            return
        words = shlex.split(line.split(" | ")[0], comments=True)
        if len(words) == 1 and "=" in words[0]:
            self.variables.update([words[0].split("=")])
        elif words[0] in ("microswarm", "build/release/bin/microswarm"):
            self.run(words[1:], line)
        elif words[0].startswith("build/release/examples/") or "--target example_" in line:
            build_or_run_example(words)
        else:
            assert words[0] in TOOLS, f"{self.page}: no test runs: {line}"
            self.shell(line)

    def run(self, words, line=""):
        asked = " ".join(words)
        if any(asked.startswith(start) for start in NOT_RUN) or any(device in asked for device in DEVICES):
            return
        done = subprocess.run([self.program, *words], capture_output=True, text=True)
        told = f"{self.page}: {line or asked}\n{done.stdout}{done.stderr}"
        lacks = [word for word in words if word in OWN and not pathlib.Path(word).exists()]
        if asked in FAILS:
            assert done.returncode == 2, told
        elif lacks:
            assert done.returncode == 2 and any(one in done.stderr for one in lacks) and "option" not in done.stderr, told
        else:
            assert done.returncode in ((0,) if words[0] in ("replay", "rig", "sweep") else (0, 3)), told

    def shell(self, text):
        """Lines for a shell with the program in its path, on a cluster of one machine."""
        missing = [tool for tool in TOOLS if re.search(rf"\b{tool} ", text) and not shutil.which(tool)]
        if missing:
            pytest.skip(f"not installed: {missing}")
        environment = {**os.environ, "PATH": f"{pathlib.Path(self.program).parent}:{os.environ['PATH']}", "SLURM_CPUS_PER_TASK": "1"}
        environment |= {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1"}
        done = subprocess.run(["bash", "-eu", "-c", text], capture_output=True, text=True, env=environment)
        assert done.returncode == 0, f"{self.page}: {text}\n{done.stdout}{done.stderr}"

    def bash(self, block):
        self.shell(block.text)

    def python(self, block):
        exec(compile(block.text, str(block), "exec"), self.names)  # noqa: S102

    def csv(self, block):
        pathlib.Path(re.findall(r"`([\w.]+\.csv)`", block.before)[-1]).write_text(block.text, encoding="utf-8")

    def yaml(self, block):
        """Saves a file under the name that stands before it, and lets the program read it; a part of a file replaces that of a shipped one."""
        keys = set(sections(block.text))
        named = re.findall(r"`([\w./-]+\.yaml)`", block.before)
        part_of = next((name for name in named if name.startswith("scenarios/")), None)
        file = pathlib.Path(named[-1] if named and not part_of else "part.yaml")
        assert file.name == "part.yaml" or not file.exists(), f"{block}: {file} is written twice"
        if keys >= {"scenario", "grid"}:
            command, text = ["sweep", file, "--out", file.with_suffix(".db")], block.text
        elif "entries" in keys:  # nothing of it ends in time
            command, text = ["rig", "queue", file, "--rig", "scenarios/rigs/vortex.yaml", "--dry-run", "--out", "queue"], block.text
        elif keys >= {"coils", "drives"}:
            command, text = ["rig", "field", file, "--at", "0,0,0", "--field", "3,0,0"], block.text
        elif "find" in keys:
            command, text = ["track", "tests/samples/video", "--config", file, "--out", "tracked"], block.text
        elif keys <= RIG_KEYS and keys != {"name"}:
            shutil.copy(ROOT / "scenarios/rigs/helmholtz.yaml", "helmholtz.yaml")
            command, text = ["rig", "see", "tests/samples/rig/frame.png", "--rig", file], completed(block.text, part_of or "scenarios/rigs/bench.yaml")
        else:
            assert keys <= SCENARIO_KEYS, f"{block}: what is {keys - SCENARIO_KEYS} a key of?"
            command = ["run", file]
            text = block.text if "map" in keys else completed(block.text, part_of or "scenarios/first_flight.yaml")
        file.write_text(text, encoding="utf-8")
        done = subprocess.run([self.program, *command], capture_output=True, text=True)
        assert done.returncode == (3 if "entries" in keys else 0), f"{block}:\n{text}\n{done.stdout}{done.stderr}"


def build_or_run_example(words):
    """Examples in C++ have tests of their own; here the one in Python, which writes the same record, runs in their place."""
    name = words[-1].rpartition("/")[2].removeprefix("example_")
    assert (ROOT / "examples" / f"{name}.cpp").exists(), words
    if words[0] != "cmake":
        subprocess.run([sys.executable, ROOT / "examples" / f"{name}.py"], check=True, capture_output=True)


@pytest.fixture
def in_a_folder_of_the_source(monkeypatch, tmp_path):
    folder = tmp_path / "work"
    folder.mkdir()
    for name in ("tests", "scenarios", "models"):
        (folder / name).symlink_to(ROOT / name)
    shutil.copy(ROOT / "scenarios/first_flight.yaml", tmp_path)  # a sweep's scenario is in the folder above
    monkeypatch.chdir(folder)
    monkeypatch.setenv("MICROSWARM_SCENARIOS", str(ROOT / "scenarios"))
    slow = ms.gather  # of 256 robots takes a minute
    monkeypatch.setattr(ms, "gather", lambda *a, **v: slow(*a, **{**v, "n": 8, "max_steps": 3, "progress": False}))
    monkeypatch.setitem(sys.modules, "trackpy", types.SimpleNamespace(emsd=emsd))


def emsd(tracks, mpp, fps):
    """Stands in for trackpy.emsd, which reads these columns."""
    assert mpp > 0 and fps > 0 and len(tracks[["particle", "frame", "x", "y"]]) > 0


@pytest.mark.parametrize("page", [page for page in WALKED if page not in WALKED_ELSEWHERE])
def test_a_page_runs_as_printed(page, program, in_a_folder_of_the_source):
    readers_files.OF_PAGE.get(page, lambda program: None)(program)
    walk = Walk(page, program)
    for block in blocks_of(page):
        walk.block(block)


def test_every_block_is_run():
    """No page has a block that no test runs: here, or in a test that is named."""
    counted = collections.Counter()
    for page in PAGES:
        for block in blocks_of(page):
            assert block.language, f"{block}: a block names its language; what a program prints is text"
            if block.language == "shell" and page not in WALKED:
                continue
            run_here = block.language in HERE and page in WALKED and page not in WALKED_ELSEWHERE
            known = run_here or block.language in EXEMPT or (page, block.language) in RUN_ELSEWHERE or block.language == "shell"
            assert known, f"{block}: no test runs it"
            counted[page, block.language] += 1
    for one, (count, test) in RUN_ELSEWHERE.items():
        assert counted[one] == count, f"{one}: {test} runs {count} blocks, the page has {counted[one]}"
    assert all(page in PAGES for page in (*WALKED, *WALKED_ELSEWHERE))


def test_pages_are_walked():
    blocks = [block for page in WALKED for block in blocks_of(page)]
    assert sum(line.startswith("microswarm ") for block in blocks if block.language == "shell" for line in lines_of(block)) > 90
    assert sum(block.language == "python" for block in blocks) > 12 and sum(block.language == "yaml" for block in blocks) > 8


def test_declarations_are_those_of_the_headers():
    """C++ that an explanation shows is in a header, except for blanks."""
    headers = [" ".join(header.read_text(encoding="utf-8").split()) for header in (ROOT / "src").rglob("*.hpp")]
    for page in PAGES:
        if page.startswith("docs/explanation/"):
            for block in blocks_of(page):
                if block.language == "cpp":
                    assert any(" ".join(block.text.split()) in header for header in headers), f"{block}: in no header"


def test_the_program_of_the_tutorial_is_the_example():
    shown = "\n".join(block.text for block in blocks_of("docs/tutorials/own-navigator.md") if block.language == "cpp")
    example = (ROOT / "examples/04_own_navigator.cpp").read_text(encoding="utf-8")
    assert example.endswith("loop, with metrics and a record like any other.\n" + shown)


def test_the_code_of_the_page_on_python_does_what_the_page_says(program, in_a_folder_of_the_source):
    walk = Walk("docs/how-to/use-from-python.md", program)
    for block in blocks_of(walk.page):
        if block.language == "python":
            walk.block(block)
            if "ms.Navigator(" in block.text:
                assert walk.names["command"].state == "arrived"
    made = walk.names
    assert made["found"].mask.any() and len(made["one"]) == 8 and len(made["tracks"]) == 48
    assert made["made"].steps == 3 and os.path.exists("gather.h5")
    assert made["plan"].paths_um.shape[1:] == (2, 2) and made["path"].solved
    assert made["currents_a"].shape == (100, 6) and os.path.exists("coils.yaml")
    assert abs(made["mine"].matrix() - made["coils"].matrix((1000, 0, 0))).max() < 1e-6
    assert made["table"].rows == 200
