# SPDX-License-Identifier: Apache-2.0
"""Runs, sessions and records, also those with a navigator of one's own."""

import gc
import json
import os
import signal
import subprocess
import sys
import threading
import time
import weakref

import numpy as np
import pytest

import microswarm as ms
from conftest import ROOT, SCENARIOS


def shipped():
    files = [*SCENARIOS.glob("*.yaml"), *SCENARIOS.glob("papers/**/*.yaml")]
    return sorted(str(one.relative_to(SCENARIOS)) for one in files)


@pytest.mark.parametrize("name", shipped())
def test_the_record_is_that_of_the_command_line(program, name):
    command = [program, "run", SCENARIOS / name, "--set", "time_limit_s=4", "--json"]
    told = subprocess.run(command, capture_output=True, text=True, check=False)
    try:
        scenario = ms.Scenario.load(SCENARIOS / name).set("time_limit_s", 4)
        record = ms.run(scenario, progress=False)
    except ms.InputError as error:
        assert told.returncode == 2 and str(error).splitlines()[0] in told.stderr
        return
    answer = json.loads(told.stdout)
    assert record.hash == answer["record_hash"]
    assert record.status == answer["status"]


def test_a_record_has_arrays_of_all_that_was_recorded(flight, tmp_path):
    record = ms.run(flight, progress=False)
    assert record.status == "time_limit" and not record.solved
    frames = record.frames
    assert frames["t_s"].dtype == np.float64
    assert np.allclose(np.diff(frames["t_s"][:-1]), 0.1)
    assert frames["state"][-1] == "end"
    assert frames["planned"].dtype == np.int64
    assert len(frames["x_um"]) == frames.rows == len(frames.to_array())
    assert frames.docs["t_s"] == "When the tick begins."
    assert record.plans.rows == len(record.plan_paths) > 0
    assert record.metrics["length_um"] == pytest.approx(frames["speed_um_per_s"].sum() * 0.1, rel=0.05)
    record.save(tmp_path / "run.h5")
    back = ms.read_record(tmp_path / "run.h5")
    assert back.hash == record.hash
    assert back.frames.to_array().tobytes() == frames.to_array().tobytes()
    assert back.replay() == (True, "")
    with pytest.raises(ms.InputError, match="nothing.h5"):
        ms.read_record(tmp_path / "nothing.h5")


def test_diagnostics_are_those_of_the_session_and_of_the_record():
    scenario = ms.Scenario.load(SCENARIOS / "papers/radar/twelve.yaml").set("time_limit_s", 2).set("record.diagnostics", True)
    with ms.Session(scenario) as session:
        assert session.diagnostics is None
        shown = []
        while session.step():
            shown.append(session.diagnostics)
        record = session.record()
    assert shown[0]["type"] == "radar"
    kept = record.diagnostics
    assert kept["radar"].rows == len(shown) - 1  # the end repeats the last one
    for row, one in enumerate(shown[:-1]):
        assert kept["radar"]["target_x_um"][row] == one["target_x_um"]
        assert kept["radar"]["best"][row] == one["best"]
        beams = kept["radar/beams"][row]
        assert beams["fate"].tolist() == one["beams"]["fate"].tolist()
        assert beams["score"].tobytes() == one["beams"]["score"].tobytes()
    assert record.replay() == (True, "")
    assert ms.run(scenario.set("record.diagnostics", False), progress=False).diagnostics == {}


def test_robots_are_an_array_of_moments():
    scenario = ms.Scenario.load(SCENARIOS / "papers/gather/t_junction.yaml").set("time_limit_s", 3)
    record = ms.run(scenario, progress=False)
    count = scenario.robots.count
    assert record.robots_um.shape == (len(record.robots_t_s), count, 2)


def test_a_session_is_stepped_changed_and_closed(flight):
    with ms.Session(flight) as session:
        assert session.step() and session.status == "running"
        view = session.view()
        assert view["t_s"] == 0 and view["obstacles_um"].shape == (2, 3)
        session.set("navigator.speed_um_per_s", 30)
        session.set("goal_um", np.array([1500, 500]))
        with pytest.raises(ms.InputError, match="cannot be changed"):
            session.set("tick_s", 1)
        while session.step():
            pass
        assert session.status == "time_limit"
        assert session.record().replay() == (True, "")
    with pytest.raises(ms.InputError, match="closed"):
        session.step()


class Straight:
    """Heads for the goal."""

    def __init__(self, goal):
        self.goal, self.prepared, self.seen = goal, 0, []

    def prepare(self):
        self.prepared += 1

    def step(self, seen):
        self.seen.append(seen)
        if seen.swarm is None:
            return None
        x, y, _, _ = seen.swarm
        return np.arctan2(self.goal[1] - y, self.goal[0] - x), 60


def test_a_navigator_of_ones_own_runs_as_ours_do(flight, tmp_path):
    own = Straight(flight.goal_um)
    record = ms.run(flight, navigator=own, progress=False)
    assert own.prepared == 1
    assert own.seen[5].obstacles_um.shape == (2, 3)
    assert record.frames["command_speed_um_per_s"][3] == 60
    record.save(tmp_path / "own.h5")
    again = ms.read_record(tmp_path / "own.h5")
    assert again.navigator == "external"
    assert again.replay() == (True, "")
    assert ms.run(flight, progress=False).navigator == ""


@pytest.mark.parametrize("answer", [3, (1, 2, 3), ("a", "b"), (float("nan"), 1), (0, -1), (0, float("inf"))])
def test_a_navigator_with_a_bad_answer_is_told(flight, answer):
    class Bad:
        def step(self, seen):
            return answer

    with pytest.raises(ms.InputError, match="step of the navigator"):
        ms.run(flight, navigator=Bad(), progress=False)


def test_an_exception_of_a_navigator_is_raised(flight):
    class Broken:
        def step(self, seen):
            raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        ms.run(flight, navigator=Broken(), progress=False)
    with pytest.raises(ms.InputError, match="method step"):
        ms.run(flight, navigator=object())


def test_two_threads_run_two_sessions(flight):
    hashes = []
    work = [threading.Thread(target=lambda: hashes.append(ms.run(flight, progress=False).hash)) for _ in range(4)]
    for one in work:
        one.start()
    for one in work:
        one.join()
    assert len(set(hashes)) == 1 and len(hashes) == 4


def test_two_threads_on_one_session_are_told(flight):
    within, go_on = threading.Event(), threading.Event()

    class Waits:
        def step(self, seen):
            within.set()
            go_on.wait(60)

    session = ms.Session(flight, navigator=Waits())
    other = threading.Thread(target=lambda: session.finish(False))
    other.start()
    assert within.wait(60)
    with pytest.raises(ms.InputError, match="in use"):
        session.view()
    assert session._repr_png_() is None and "in use" in repr(session)
    go_on.set()
    other.join()
    assert session.status == "held"


def test_ctrl_c_ends_a_long_run():
    code = f"""
import microswarm as ms
s = ms.Scenario.load({str(SCENARIOS / "first_flight.yaml")!r})
s.set("time_limit_s", 1e5).set("hold_limit_s", 1e5).set("goal_um", [1990, 990]).set("hold_at_goal_s", 1e6)
s.goal_um = [1800, 500]
print("runs", flush=True)
try:
    ms.run(s, progress=False)
except KeyboardInterrupt:
    print("interrupted")
"""
    process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True, cwd=ROOT)
    assert process.stdout.readline() == "runs\n"
    time.sleep(1)
    process.send_signal(signal.SIGINT)
    assert process.communicate(timeout=20)[0] == "interrupted\n"


def test_ctrl_c_reaches_a_navigator_that_does_not_return():
    code = f"""
import microswarm as ms, threading
class Endless:
    def step(self, seen):
        print("runs", flush=True)
        while True: pass
try:
    ms.run({str(SCENARIOS / "first_flight.yaml")!r}, navigator=Endless())
except KeyboardInterrupt:
    print("interrupted")
"""
    process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True, cwd=ROOT)
    assert process.stdout.readline() == "runs\n"
    process.send_signal(signal.SIGINT)
    assert process.communicate(timeout=20)[0] == "interrupted\n"


def test_the_interpreter_ends_while_other_threads_step():
    code = f"""
import microswarm as ms, threading, time
def steps():
    n, t = ms.Navigator({str(SCENARIOS / "first_flight.yaml")!r}), 0
    while True:
        t += 0.01
        n.step(t, swarm=(200, 500, 0, 40))
threading.Thread(target=steps, daemon=True).start()
time.sleep(0.3)
"""
    for _ in range(3):
        assert subprocess.run([sys.executable, "-c", code], cwd=ROOT, timeout=60).returncode == 0


def test_a_navigator_is_called_in_the_callers_thread_and_its_exception_ends_the_session(flight):
    threads = set()

    class Fails:
        def prepare(self):
            threads.add(threading.get_ident())

        def step(self, seen):
            threads.add(threading.get_ident())
            if seen.now_s > 0.5:
                raise ValueError("mine")
            return 0, 10

    session = ms.Session(flight, navigator=Fails())
    with pytest.raises(ValueError, match="mine"):
        session.finish()
    assert threads == {threading.get_ident()}
    with pytest.raises(ms.InputError, match="has raised an exception"):
        session.step()
    assert session.record().replay() == (True, "")
    session.close()
    session.close()


def endless():
    """A run that neither its goal nor its limits end soon."""
    scenario = ms.Scenario.load(SCENARIOS / "first_flight.yaml").set("navigator.speed_um_per_s", 0.001)
    return scenario.set("time_limit_s", 1e5).set("hold_limit_s", 1e5).set("obstacles", [])


class Waits:
    """Holds, and tells when it was called."""

    def __init__(self):
        self.called = threading.Event()

    def step(self, seen):
        self.called.set()
        return 0.0, 1e-3


@pytest.mark.parametrize("with_own", [False, True])
def test_another_thread_stops_a_session(with_own):
    own = Waits() if with_own else None
    session = ms.Session(endless(), navigator=own)
    assert session.step()

    def stop():
        if own:
            own.called.wait()
        time.sleep(0.3)
        session.stop()

    other = threading.Thread(target=stop)
    other.start()
    began = time.monotonic()
    record = session.finish(False)
    other.join()
    assert time.monotonic() - began < 20
    assert record.status == "stopped" and record.frames.rows > 2
    assert not session.step() and session.status == "stopped"
    assert record.replay() == (True, "")
    session.stop()
    session.close()
    session.stop()


def test_a_session_that_was_stopped_before_its_first_step_ends(flight):
    session = ms.Session(flight)
    session.stop()
    record = session.finish(False)
    assert record.status == "stopped" and record.frames.rows <= 1


def test_a_navigator_that_knows_its_session_is_collected(flight):
    for closes in (False, True):
        own = Straight(flight.goal_um)
        own.session = ms.Session(flight, navigator=own)
        own.session.step()
        if closes:
            own.session.close()
        gone = weakref.ref(own), weakref.ref(own.session)
        del own
        gc.collect()
        assert [one() for one in gone] == [None, None]


def test_collecting_garbage_all_the_time_does_no_harm(flight):
    before = gc.get_threshold()
    gc.set_threshold(1)
    try:
        for _ in range(3):
            own = Straight(flight.goal_um)
            own.session = ms.Session(flight, navigator=own)
            assert own.session.finish(False).status == "time_limit"
            with pytest.raises(ms.InputError):
                ms.Session(flight, navigator=3)
    finally:
        gc.set_threshold(*before)


def test_a_saved_record_takes_the_place_of_a_link(flight, tmp_path):
    record = ms.run(flight, progress=False)
    (tmp_path / "other.h5").write_text("mine")
    (tmp_path / "run.h5").symlink_to("other.h5")
    record.save(tmp_path / "run.h5")
    assert not (tmp_path / "run.h5").is_symlink()
    assert ms.read_record(tmp_path / "run.h5").hash == record.hash
    assert (tmp_path / "other.h5").read_text() == "mine"


def test_what_a_killed_process_left_is_removed_by_the_next_record(flight, tmp_path):
    code = f"""
import microswarm as ms, os, signal, threading
record = ms.run(ms.Scenario.load({str(SCENARIOS / "first_flight.yaml")!r}).set("time_limit_s", 5), progress=False)
def kill():
    while not os.listdir({str(tmp_path)!r}): pass
    os.kill(os.getpid(), signal.SIGKILL)
threading.Thread(target=kill).start()
while True:
    record.save({str(tmp_path / "run.h5")!r})
"""
    subprocess.run([sys.executable, "-c", code], cwd=ROOT, timeout=60, check=False)
    # Whether or not it was killed amid a write: a part of a process that is gone, one of ours, and a file of the user.
    (tmp_path / "run.tmp-microswarm-4194304-0.h5").write_text("part")
    (tmp_path / f"run.tmp-microswarm-{os.getpid()}-7.h5").write_text("ours")
    (tmp_path / "run.tmp.h5").write_text("theirs")
    ms.run(flight, progress=False).save(tmp_path / "run.h5")
    left = sorted(one.name for one in tmp_path.iterdir())
    assert left == ["run.h5", f"run.tmp-microswarm-{os.getpid()}-7.h5", "run.tmp.h5"]
