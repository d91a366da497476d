# SPDX-License-Identifier: Apache-2.0
"""The notebook of the examples, and what a notebook shows of a long run."""

import json

import pytest

from conftest import ROOT, SCENARIOS
from microswarm import progress

nbformat = pytest.importorskip("nbformat")
nbclient = pytest.importorskip("nbclient")
pytest.importorskip("ipykernel")

TOUR = ROOT / "examples/tour.ipynb"


def executed(notebook, monkeypatch):
    """The notebook with its outputs; a cell that fails is an error."""
    monkeypatch.setenv("MICROSWARM_SCENARIOS", str(SCENARIOS))
    monkeypatch.setenv("PYDEVD_DISABLE_FILE_VALIDATION", "1")
    return nbclient.NotebookClient(notebook, timeout=120, kernel_name="python3").execute()


def test_the_tour_is_committed_without_outputs():
    cells = json.loads(TOUR.read_text())["cells"]
    assert all(not one["outputs"] and one["execution_count"] is None for one in cells if one["cell_type"] == "code")


def test_the_tour_runs_and_draws(monkeypatch):
    cells = executed(nbformat.read(TOUR, 4), monkeypatch).cells
    outputs = [output for cell in cells for output in cell.get("outputs", [])]
    drawn = [output["data"]["text/plain"] for output in outputs if "image/png" in output.get("data", {})]
    assert [one.split(":")[0] for one in drawn] == ["<Record", "<Session", "<Record", "<Path", "<Record"]
    assert all(": solved" in one for one in drawn if one.startswith(("<Record", "<Path")))
    assert not [output for output in outputs if output["output_type"] in ("error", "stream")]


def test_a_long_run_renews_one_line(monkeypatch):
    code = f"""
import time
import microswarm as ms
class Slow:
    def step(self, seen):
        time.sleep(0.05)
        return 0, 20
scenario = ms.Scenario.load({str(SCENARIOS / "first_flight.yaml")!r}).set("time_limit_s", 3)
ms.run(scenario, navigator=Slow()).status
"""
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(code)])
    line, status = executed(notebook, monkeypatch).cells[0].outputs
    assert line.output_type == "display_data" and line.data["text/plain"].endswith(" s")
    assert "%" not in line.data["text/plain"] and status.data["text/plain"] == "'time_limit'"


def test_a_short_run_shows_no_line(monkeypatch):
    code = f"import microswarm as ms; ms.run({str(SCENARIOS / 'first_flight.yaml')!r}).status"
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(code)])
    assert [one.output_type for one in executed(notebook, monkeypatch).cells[0].outputs] == ["execute_result"]


def test_the_line_tells_the_share_and_then_the_time(monkeypatch):
    said = []

    class Line:
        def display(self, data, raw):
            said.append(("display", data["text/plain"]))

        def update(self, data, raw):
            said.append(("update", data["text/plain"]))

    monkeypatch.setattr(progress, "notebook_line", Line)
    bar = progress.Bar()
    bar(0.1)
    assert not said, "not in the first second"
    bar._began -= 10
    bar(0.5)
    bar(0.6)  # too soon after the last
    bar._began -= 0.1
    bar(0.75)
    bar.end()
    assert said == [("display", " 50 %, 10 s left"), ("update", " 75 %, 3 s left"), ("update", "10.1 s")]
