# SPDX-License-Identifier: Apache-2.0
"""What outlives an environment, and how calls and the interpreter end."""

import os
import pathlib
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

import microswarm as ms
from microswarm import environments

FLIGHT = pathlib.Path(__file__).resolve().parents[2] / "scenarios" / "first_flight.yaml"


def test_observations_outlive_their_environment():
    maze = np.pad(np.ones((198, 198), np.uint8), 1)
    batch = environments.GatheringVectorEnv(500, maze, (5, 5), copy=False)
    kept, _ = batch.reset(seed=1)
    before = kept.copy()
    batch.close()
    del batch
    assert np.array_equal(kept, before)


@pytest.mark.parametrize("call", ["record.save(sys.argv[1])", "ms.Navigator(flight).step(0, (200, 500, 0, 40))"])
def test_calls_work_while_the_interpreter_ends(call, tmp_path):
    program = f"""
import atexit, sys
atexit.register(lambda: ({call}, print("done")))
import microswarm as ms
flight = {str(FLIGHT)!r}
record = ms.run(ms.Scenario.load(flight).set("time_limit_s", 1), progress=False)
"""
    ended = subprocess.run([sys.executable, "-c", program, str(tmp_path / "run.h5")], capture_output=True, text=True, timeout=60)
    assert ended.stdout == "done\n" and ended.returncode == 0, ended.stderr


def test_ctrl_c_ends_a_long_reset_after_which_a_reset_is_needed():
    program = """
import numpy as np
from microswarm import environments
batch = environments.GatheringVectorEnv(400, np.ones((300, 300), np.uint8), None, n_particles=10, threads=1)
print("ready", flush=True)
try:
    while True:
        batch.reset(seed=1)
except KeyboardInterrupt:
    pass
try:
    batch.step([0] * 400)
except ValueError as error:
    print(error)
batch.reset(seed=1)
batch.step([0] * 400)
"""
    with subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True) as running:
        assert running.stdout.readline() == "ready\n"
        time.sleep(0.3)
        running.send_signal(signal.SIGINT)
        out, _ = running.communicate(timeout=60)
    assert running.returncode == 0 and out in ("the last call was interrupted: a reset is needed\n", "")


def test_environments_that_take_too_much_memory_are_refused():
    maze = np.ones((300, 300), np.uint8)
    with pytest.raises(ms.InputError, match="num_envs is 20000, but one takes"):
        environments.GatheringVectorEnv(20000, maze, None, n_particles="filled", physics="physical")


def test_a_pipe_that_nobody_reads_is_refused_at_once(tmp_path):
    os.mkfifo(tmp_path / "pipe.h5")
    record = ms.run(ms.Scenario.load(FLIGHT).set("time_limit_s", 1), progress=False)
    with pytest.raises(ms.InputError, match="a pipe that nobody reads"):
        record.save(tmp_path / "pipe.h5")
