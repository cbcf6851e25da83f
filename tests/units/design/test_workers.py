"""Workers beside this process: the same bits, and none lost when they die."""

import json
import os
import signal
import threading
import time
from random import Random

import numpy as np
import pytest

from vibroacoustics.base.arrays import Array
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.design.evaluation import Evaluate, Evaluation
from vibroacoustics.design.workers import cluster
from vibroacoustics.design.workers.cluster import in_pieces, opened_workers, spread

TASK = json.dumps({"pause_s": 0.02}).encode()
LONG_TASK = json.dumps({"pause_s": 0.6}).encode()
DESIGNS = np.random.default_rng(2).normal(size=(400, 3))


def builder(task: bytes) -> Evaluate:
    """Values whose last bits depend on how they are summed; some designs fail."""
    said = json.loads(task)

    def evaluate(designs: Array) -> Evaluation:
        time.sleep(said["pause_s"])
        objectives = np.sin(designs @ np.array([[1.0, 2.0], [0.1, 7.0], [3.0, 0.3]]))
        objectives[designs[:, 0] > 2.0] = np.nan
        reasons = tuple("too far" if one > 2.0 else "" for one in designs[:, 0])
        return Evaluation(objectives, designs[:, :1], reasons)

    return evaluate


def same(first: Evaluation, second: Evaluation) -> None:
    """Every bit and every reason."""
    assert first.objectives.tobytes() == second.objectives.tobytes()
    assert first.constraints.tobytes() == second.constraints.tobytes()
    assert first.failures == second.failures


def killed(task: bytes, seed: int, times: int) -> tuple[Evaluation, int]:
    """Evaluated while a worker is killed at random moments, and how often one was."""
    random, deaths = Random(seed), 0
    with opened_workers(2) as client:
        done = threading.Event()

        def kill() -> None:
            nonlocal deaths
            while deaths < times:
                if done.wait(random.uniform(0.05, 0.6)):
                    return
                alive = [one.pid for one in client.cluster.workers.values() if one.pid]
                if alive:
                    os.kill(random.choice(alive), signal.SIGKILL)
                    deaths += 1

        killer = threading.Thread(target=kill)
        killer.start()
        evaluation = spread(client, builder, task, 8, (2, 1))(DESIGNS)
        done.set()
        killer.join()
    return evaluation, deaths


def test_two_workers_equal_serial_and_one_may_die() -> None:
    """50 pieces; a worker is killed while they are evaluated."""
    serial = in_pieces(builder(TASK), 8)(DESIGNS)
    assert "too far" in serial.failures
    evaluation, deaths = killed(TASK, seed=1, times=1)
    assert deaths == 1
    same(evaluation, serial)


@pytest.mark.long
def test_workers_killed_at_ten_moments() -> None:
    evaluation, deaths = killed(LONG_TASK, seed=2, times=10)
    assert deaths == 10
    same(evaluation, in_pieces(builder(TASK), 8)(DESIGNS))


def test_scheduler_that_does_not_answer_is_one_line(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cluster, "_CONNECTION_S", 0.5)
    with (
        pytest.raises(ParameterError, match=r"scheduler tcp://127\.0\.0\.1:9: does not answer"),
        opened_workers(1, "tcp://127.0.0.1:9"),
    ):
        pass
