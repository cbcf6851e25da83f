"""What a sweep takes is counted in loads, paths and their pairs, each once."""

import numpy as np
import pytest
from design_studies import design_table, study_with
from sources_study import SOURCES_STUDY, made_up_modes

from vibroacoustics.design import trial
from vibroacoustics.design.evaluation import Evaluation
from vibroacoustics.design.problem import Problem
from vibroacoustics.design.sweep import listing_of

VARIABLES = {
    "machine.structure.loss_factor_ratio": "range = [0.01, 0.03], points = 5",
    "machine.keys.clearance_um": "range = [10.0, 30.0], points = 12",
    "options.counterweight-half.share_ratio": "range = [0, 1], points = 3",
}
COSTS_S = {"load": 0.2, "path": 0.3, "design": 0.001, "piece": 0.01}
"""Made-up processor times."""


class Stopwatch:
    """Evaluation with made-up times: new loads and paths, designs, and each call cost some."""

    def __init__(self) -> None:
        self.seconds, self.known = 0.0, (set(), set())

    def __call__(self, designs):
        for column, known, cost in zip((0, 1), self.known, ("path", "load"), strict=True):
            new = set(designs[:, column].tolist()) - known
            known.update(new)
            self.seconds += len(new) * COSTS_S[cost]
        self.seconds += len(designs) * COSTS_S["design"] + COSTS_S["piece"]
        return Evaluation(designs[:, :1], designs[:, :0], ("",) * len(designs))


@pytest.mark.slow
def test_time_of_a_sweep_is_that_of_its_loads_paths_and_designs(monkeypatch):
    study = study_with(design_table('"counterweight-half"', VARIABLES), SOURCES_STUDY)
    problem = Problem(study, lambda study, *_: (made_up_modes(study), False))
    listing, watch = listing_of(problem), Stopwatch()
    assert (problem.splitting.paths, problem.splitting.loads) == ((0,), (1,))
    monkeypatch.setattr(trial, "evaluating", lambda _: watch)
    monkeypatch.setattr(trial.time, "process_time", lambda: watch.seconds)
    estimated = trial.tried(problem, listing)
    pieces = 12 + 4  # a piece for each load of the first path, and one for each other path
    expected = (12 * COSTS_S["load"] + 5 * COSTS_S["path"] + 180 * COSTS_S["design"]
                + pieces * COSTS_S["piece"])  # fmt: skip
    assert estimated.seconds == pytest.approx(expected, rel=0.02)
    assert estimated.spent_s == pytest.approx(
        watch.seconds - COSTS_S["load"] - COSTS_S["path"], abs=0.02
    )
    assert len(estimated.designs) == len(estimated.evaluation.failures) < 180
    counted = trial._work(problem, listing)
    np.testing.assert_array_equal(counted, [12, 5, 60, 180, pieces])
