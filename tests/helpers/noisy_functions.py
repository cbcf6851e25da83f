"""Functions with known optimum and the noise of key impacts, for searches."""

from dataclasses import dataclass
from typing import Final

import numpy as np

from vibroacoustics.base.arrays import Array
from vibroacoustics.base.errors import StorageError
from vibroacoustics.design.evaluation import Evaluate, Evaluation
from vibroacoustics.design.search.active import search_active
from vibroacoustics.design.search.problem import SearchProblem

NOISE_DB: Final = 0.24
"""Standard deviation of a run: the root mean square over 169 designs of a study with key impacts is
0.22 to 0.24 dB, each from four starts (`benchmarks/active_search.py`); that of a dry unloaded ring
is 0.24 dB (`test_key_rings.py`)."""
RUNS, REPEATS, LEAST_GAIN_DB = 60, 8, 0.001


def branin(share: Array) -> Array:
    """Branin's function of two shares, least 0 at three points, greatest 20 dB."""
    x, y = 15.0 * share[:, 0] - 5.0, 15.0 * share[:, 1]
    valley = y - 5.1 / (4.0 * np.pi**2) * x**2 + 5.0 / np.pi * x - 6.0
    value = valley**2 + 10.0 * (1.0 - 1.0 / (8.0 * np.pi)) * np.cos(x) + 10.0
    return np.asarray((value - 0.39788735772973816) * 20.0 / 307.73)


def hartmann(share: Array) -> Array:
    """Hartmann's function of three shares, least 0 at one point, three local ones, 11.6 dB."""
    steepness = np.array([[3.0, 10.0, 30.0], [0.1, 10.0, 35.0]] * 2)
    centre = 1e-4 * np.array([[3689, 1170, 2673], [4699, 4387, 7470],
                              [1091, 8732, 5547], [381, 5743, 8828]])  # fmt: skip
    depth = np.array([1.0, 1.2, 3.0, 3.2])
    distance = (steepness * (share[:, None] - centre) ** 2).sum(axis=-1)
    return np.asarray(3.0 * (3.862782147819756 - np.exp(-distance) @ depth))


FUNCTIONS: Final = {"branin": (branin, 2), "hartmann": (hartmann, 3)}


@dataclass
class Figures:
    """An evaluation that counts its batches and ends after the most."""

    evaluate: Evaluate
    most: int | None = None
    batches: int = 0

    def __call__(self, designs: Array) -> Evaluation:
        if self.batches == self.most:
            raise StorageError("ended")
        self.batches += 1
        return self.evaluate(designs)


def search_problem(name: str, seed: int) -> SearchProblem:
    """A noisy function; the noise is that of the number of the run, the last column."""
    function, size = FUNCTIONS[name]

    def evaluate(designs: Array) -> Evaluation:
        rngs = [np.random.default_rng((17, size, seed, int(run) + 1)) for run in designs[:, -1]]
        noise = NOISE_DB * np.array([rng.standard_normal() for rng in rngs])
        objective = function(designs[:, :-1]) + noise
        return Evaluation(objective[:, None], np.empty((len(designs), 0)), ("",) * len(designs))

    return SearchProblem(np.zeros(size), np.ones(size), np.zeros(size, dtype=bool), evaluate)


@dataclass(frozen=True)
class Regrets:
    """How far the best design of a search is above the optimum.

    Attributes
    ----------
    repeats_db : by the mean of the repeats at the end
    true_db : without noise
    random_db : without noise, of the best of as many random designs by one run each
    runs : of the search
    """

    repeats_db: float
    true_db: float
    random_db: float
    runs: int


def regrets(name: str, seed: int) -> Regrets:
    """Regrets of an active search and of a random one; both functions are zero at their least."""
    problem, (function, size) = search_problem(name, seed), FUNCTIONS[name]
    search = search_active(problem, RUNS, REPEATS, LEAST_GAIN_DB, seed)
    repeats = search.searched.evaluation.objectives[search.promised][1:]
    designs = np.random.default_rng((23, size, seed)).random((RUNS, size))
    values = problem.evaluate(np.column_stack([designs, 1000 + np.arange(RUNS)])).objectives
    random = designs[np.argmin(values)]
    true_db, random_db = function(np.stack([search.best, random]))
    runs = len(search.searched.designs)
    return Regrets(float(repeats.mean()), float(true_db), float(random_db), runs)
