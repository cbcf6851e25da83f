"""The best design where each run is long and scatters: Gaussian processes choose the next run.

Jones, Schonlau and Welch (1998), Journal of Global Optimization 13, 455-492; with noise Huang,
Allen, Notz and Zeng (2006), Journal of Global Optimization 34, 441-466, one of those compared by
Picheny, Wagner and Ginsbourger (2013), Structural and Multidisciplinary Optimization 48, 607-626.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy.stats import norm, qmc

from ...base.arrays import Array, IndexArray
from ...base.errors import SolverError
from ...base.progress import Progress, no_progress
from ..evaluation import Evaluation
from .best import comparable
from .gaussian_process import Process, Runs, fitted
from .problem import History, Searched, SearchProblem

FIRST_DESIGNS: Final = 4
"""Designs of the first generation for each variable; at least `LEAST_DESIGNS`."""
LEAST_DESIGNS: Final = 12
FIRST_REPEATS: Final = 4
"""Best designs of the first generation, which are run once more."""
REPEAT_EACH: Final = 5
"""Every fifth run repeats the best design with another start."""
SHORT_OF_GAIN: Final = 3
"""Choices one after another with too little expected gain, after which the search ends."""
CANDIDATES: Final = 1024
"""Designs that fill the space, among which the next one is chosen."""
NEAR: Final = 256
"""Candidates about the best one, at each of `DISTANCES`."""
DISTANCES: Final = (0.1, 0.02, 0.004)
"""Standard deviations about the best candidate, as shares of the ranges."""
DIGITS: Final = 6
"""Decimal digits of shares of the ranges: rounding noise does not reach the next run."""
CERTAIN: Final = 1e-12
"""Least standard deviation, by which differences are divided."""
AS_MEANT: Final = -1
"""Number of the run without any scatter."""


def expected_improvement(mean: Array, deviation: Array, best: float) -> Array:
    """Compute the mean of max(best - Y, 0) of a normal Y, Jones et al. (1998), equation (15).

    Parameters
    ----------
    mean, deviation : mean and standard deviation of Y, shape (design,)
    best : value that Y shall be below
    """
    deviation = np.maximum(deviation, CERTAIN)
    share = (best - mean) / deviation
    return np.asarray((best - mean) * norm.cdf(share) + deviation * norm.pdf(share))


def augmented_improvement(mean: Array, deviation: Array, best: float, noise: float) -> Array:
    """Compute the expected improvement by a noisy run, Huang et al. (2006), equation (12).

    Parameters
    ----------
    mean, deviation : mean and standard deviation of the figure without noise, shape (design,)
    best : mean of the effective best design
    noise : variance of a run
    """
    total = np.sqrt(np.maximum(deviation**2 + noise, CERTAIN**2))
    gain = expected_improvement(mean, deviation, best)
    return np.asarray(gain * (1.0 - np.sqrt(noise) / total))


@dataclass(frozen=True)
class Models:
    """Processes of the objective, and of what must be at most zero.

    Attributes
    ----------
    objective : process of the objective
    limited : processes of the constraints, last that of failures (0.5, and -0.5 without) if any
    """

    objective: Process
    limited: tuple[Process, ...]

    def allowed(self, designs: Array) -> Array:
        """Probability that designs meet every constraint, shape (design,).

        Schonlau, Welch and Jones (1998), New Developments and Applications in Experimental Design,
        IMS Lecture Notes 34, 11-25: each constraint by itself.

        Parameters
        ----------
        designs : shares of the ranges, shape (design, variable)
        """
        probability = np.ones(len(designs))
        for process in self.limited:
            mean, deviation = process.posterior(designs)
            probability *= norm.cdf(-mean / np.maximum(deviation, CERTAIN))
        return probability

    def excess(self, designs: Array) -> Array:
        """Expected sum of what exceeds the constraints, shape (design,).

        Parameters
        ----------
        designs : shares of the ranges, shape (design, variable)
        """
        each = [np.maximum(process.posterior(designs)[0], 0.0) for process in self.limited]
        return np.asarray(np.sum(each, axis=0))

    def expected(self, designs: Array, constraints: int) -> Evaluation:
        """Return expected values of designs.

        Parameters
        ----------
        designs : shares of the ranges, shape (design, variable)
        constraints : their number
        """
        objective, *limited = (
            process.posterior(designs)[0]
            for process in (self.objective, *self.limited[:constraints])
        )
        columns = np.reshape(limited, (constraints, len(designs))).T
        return Evaluation(objective[:, None], columns, ("",) * len(designs))

    def promise(self, designs: Array) -> Array:
        """Negative expected objective; minus infinity where constraints are rather not met."""
        mean, _ = self.objective.posterior(designs)
        return np.where(self.allowed(designs) >= 0.5, -mean, -np.inf)

    def gain(self, designs: Array) -> Array:
        """Expected gain of a run, shape (design,), in the unit of the objective.

        Before any design is expected to meet the constraints: the probability that one does.

        Parameters
        ----------
        designs : shares of the ranges, shape (design, variable)
        """
        runs, allowed = self.objective.runs, self.allowed(designs)
        eligible = runs.designs[self.allowed(runs.designs) >= 0.5]
        if not len(eligible):
            return allowed
        mean, deviation = self.objective.posterior(eligible)
        effective = float(mean[np.argmin(mean + deviation)])
        values = self.objective.posterior(designs)
        return allowed * augmented_improvement(*values, effective, self.objective.noise)


@dataclass(frozen=True)
class ActiveSearch:
    """Runs of an active search, and the design that it recommends.

    Attributes
    ----------
    searched : all runs; the last column of the designs is the number of the run
    best : recommended design, shape (variable,)
    promised : rows of the runs that repeat it at the end; the first without any scatter
    models : processes of the objective and constraints, over shares of the ranges
    expected_gain : expected gain of one run more, in the unit of the objective
    """

    searched: Searched
    best: Array
    promised: slice
    models: Models
    expected_gain: float


def search_active(
    problem: SearchProblem,
    runs: int,
    repeats: int,
    least_gain: float,
    seed: int,
    *,
    progress: Progress = no_progress,
) -> ActiveSearch:
    """Look for the design with the least mean of the first objective, over all starts.

    Parameters
    ----------
    problem : problem whose `evaluate` takes designs with a further column, the number of the run
    runs : largest number of runs
    repeats : runs of the best design at the end, with starts that the search has not seen
    least_gain : expected gain of one run more, in the unit of the objective, below which it ends
    seed : seed of the random numbers; the same seed asks for the same designs
    progress : function called with the runs done

    Raises
    ------
    SolverError
        Fewer than two designs have a solution, or none is expected to meet the constraints.
    """
    search = _Search(problem, seed, progress, runs)
    search.run(search.first_designs())
    search.run(search.best_first(FIRST_REPEATS))
    models, gains = search.models(), [np.inf] * SHORT_OF_GAIN
    while search.count + repeats + 1 < runs and max(gains[-SHORT_OF_GAIN:]) >= least_gain:
        if search.count % REPEAT_EACH == 0:
            chosen = search.best_run(models)
        else:
            chosen, gain = search.maximum(models.gain, models)
            gains.append(gain)
        search.run(chosen[None])
        models = search.models(models)
    _, gain_of_more = search.maximum(models.gain, models)
    best, promise = search.maximum(models.promise, models)
    if not np.isfinite(promise):
        raise SolverError(
            f"design: no design is expected to meet the constraints after {search.count} runs: "
            "allow more, or give more runs"
        )
    promised = slice(search.count, search.count + repeats + 1)
    search.finish(best, repeats)
    return ActiveSearch(search.searched(), problem.at_shares(best), promised, models, gain_of_more)


class _Search:
    """Runs of designs as shares of the ranges, and the choice of the next."""

    def __init__(self, problem: SearchProblem, seed: int, progress: Progress, runs: int) -> None:
        self._problem, self._seed, self._progress, self._runs = problem, seed, progress, runs
        self._history = History(problem.evaluate)
        self._shares: Array = np.empty((0, len(problem.lower)))

    @property
    def count(self) -> int:
        """Number of runs so far."""
        return len(self._shares)

    def searched(self) -> Searched:
        """All runs so far."""
        return self._history.searched()

    def run(self, shares: Array) -> None:
        """Evaluate designs, each with scatter of its run."""
        self._evaluate(shares, self.count + np.arange(len(shares)))
        self._progress("runs", self.count, self._runs)

    def finish(self, best: Array, repeats: int) -> None:
        """Evaluate the best design without scatter, and with that of further runs."""
        numbers = np.append(AS_MEANT, self.count + np.arange(repeats))
        self._evaluate(np.repeat(best[None], repeats + 1, axis=0), numbers)
        self._progress("runs", self.count, self.count)

    def _evaluate(self, shares: Array, numbers: IndexArray) -> None:
        self._history(np.column_stack([self._problem.at_shares(shares), numbers]))
        self._shares = np.concatenate([self._shares, shares])

    def first_designs(self) -> Array:
        """Designs that fill the space, at most half of the runs."""
        size = self._shares.shape[1]
        count = min(max(FIRST_DESIGNS * size, LEAST_DESIGNS), self._runs // 2)
        cube = qmc.LatinHypercube(size, rng=np.random.default_rng(self._seed))
        return self._snapped(cube.random(count))

    def best_first(self, count: int) -> Array:
        """Best designs of the first generation."""
        return self._shares[np.argsort(comparable(self.searched().evaluation))[:count]]

    def best_run(self, models: Models) -> Array:
        """Design of the runs that is expected to be best, shape (variable,).

        Where none is expected to meet the constraints, that which exceeds them least.
        """
        designs = models.objective.runs.designs
        promise = models.promise(designs)
        if not np.isfinite(promise).any():
            promise = -models.excess(designs)
        return np.asarray(designs[int(np.argmax(promise))])

    def models(self, before: Models | None = None) -> Models:
        """Fit processes to all runs, from the parameters of those before.

        Raises
        ------
        SolverError
            Fewer than two designs have a solution.
        """
        evaluation = self.searched().evaluation
        failed = ~np.isfinite(evaluation.objectives[:, 0])
        solved = self._shares[~failed]
        if len(np.unique(solved, axis=0)) < 2:
            reasons = "; ".join(dict.fromkeys(filter(None, evaluation.failures)))
            raise SolverError(f"design: {failed.sum()} of {self.count} runs failed: {reasons}")
        columns = [(solved, evaluation.objectives[~failed, 0])]
        columns += [(solved, column) for column in evaluation.constraints[~failed].T]
        columns += [(self._shares, failed - 0.5)] if failed.any() else []
        first = () if before is None else (before.objective, *before.limited)
        objective, *limited = (
            fitted(Runs.of(*column), first[number : number + 1])
            for number, column in enumerate(columns)
        )
        return Models(objective, tuple(limited))

    def maximum(self, score: Callable[[Array], Array], models: Models) -> tuple[Array, float]:
        """Find the design with the greatest score, shape (variable,), and the score.

        Among designs that fill the space, those that have run and some about the best of these;
        then about the best so far, nearer and nearer.
        """
        rng = np.random.default_rng((self._seed, self.count))
        filling = qmc.Sobol(self._shares.shape[1], rng=rng).random(CANDIDATES)
        about = [self._about(self.best_run(models), distance, rng) for distance in DISTANCES]
        candidates = self._snapped(np.concatenate([self._shares, filling, *about]))
        best, greatest = self._best_of(candidates, score)
        for distance in DISTANCES:
            near = self._snapped(self._about(best, distance, rng))
            best, greatest = self._best_of(np.concatenate([best[None], near]), score)
        return best, greatest

    @staticmethod
    def _best_of(candidates: Array, score: Callable[[Array], Array]) -> tuple[Array, float]:
        scores = score(candidates)
        best = int(np.argmax(scores))
        return candidates[best], float(scores[best])

    def _about(self, share: Array, distance: float, rng: np.random.Generator) -> Array:
        steps = distance * rng.standard_normal((NEAR, share.size))
        return np.clip(share + steps, 0.0, 1.0)

    def _snapped(self, shares: Array) -> Array:
        """Shares of designs that the problem can code, rounded."""
        return np.round(self._problem.shares(self._problem.at_shares(shares)), DIGITS)
