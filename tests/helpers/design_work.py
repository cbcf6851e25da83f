"""Evaluation that tests give to workers; imports little, for every worker imports it."""

import json
import os
import signal
from pathlib import Path

import numpy as np

from vibroacoustics.base.arrays import Array
from vibroacoustics.design.evaluation import Evaluate, Evaluation


def builder(task: bytes) -> Evaluate:
    """Values whose last bits depend on how they are summed; some designs fail, some kill.

    The task holds how often a piece that begins with a design kills its worker, and a folder where
    deaths are counted.
    """
    said = json.loads(task)

    def evaluate(designs: Array) -> Evaluation:
        marker = Path(said["folder"]) / designs[0].tobytes().hex()
        deaths = len(marker.read_text()) if marker.exists() else 0
        if deaths < said["deaths"].get(str(designs[0, 0]), 0):
            marker.write_text("x" * (deaths + 1))
            os.kill(os.getpid(), signal.SIGKILL)
        objectives = np.sin(designs @ np.array([[1.0, 2.0], [0.1, 7.0], [3.0, 0.3]]))
        objectives[designs[:, 0] > 2.0] = np.nan
        reasons = tuple("too far" if one > 2.0 else "" for one in designs[:, 0])
        return Evaluation(objectives, designs[:, :1], reasons)

    return evaluate
