"""Gaussian process of a noisy figure over designs, each run from one start or more.

Rasmussen and Williams (2006), Gaussian Processes for Machine Learning, MIT Press (below RW).
Repeated runs of a design enter by their mean and their sum of squares: Binois, Gramacy and
Ludkovski (2018), Journal of Computational and Graphical Statistics 27, 808-821.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Final

import numpy as np
from scipy.linalg import cho_solve, cholesky
from scipy.optimize import minimize

from ...base.arrays import Array
from ...base.errors import ParameterError

LENGTHS: Final = (0.05, 10.0)
"""Lowest and highest correlation length, as a share of a variable's range."""
USUAL_LENGTH: Final = 0.5
"""Median of the prior of a correlation length; its logarithm has a standard deviation of one."""
NOISE_SHARES: Final = (1e-8, 1.0)
"""Lowest and highest noise variance, of the variance of the means of the designs."""
SIGNAL_SHARES: Final = (1e-2, 1e2)
"""Lowest and highest signal variance, likewise."""
FIRST_LENGTHS: Final = (0.15, 0.5, 1.5)
"""Correlation lengths from which the likelihood is maximised."""


@dataclass(frozen=True)
class Runs:
    """Runs of designs, repeated runs together.

    Attributes
    ----------
    designs : distinct designs as shares of the ranges, shape (design, variable)
    mean : mean of the runs of each design, shape (design,)
    count : number of runs of each design, shape (design,)
    squares : sum of squared deviations of all runs from the mean of their design
    """

    designs: Array
    mean: Array
    count: Array
    squares: float

    @classmethod
    def of(cls, designs: Array, values: Array) -> "Runs":
        """Gather repeated runs.

        Parameters
        ----------
        designs : design of each run, shape (run, variable)
        values : value of each run, shape (run,)
        """
        distinct, number = np.unique(designs, axis=0, return_inverse=True)
        count = np.bincount(number.ravel()).astype(float)
        mean = np.bincount(number.ravel(), values) / count
        return cls(distinct, mean, count, float(((values - mean[number.ravel()]) ** 2).sum()))

    @property
    def pure_error(self) -> float | None:
        """Noise variance of the repeated runs alone; None without a repeated run."""
        freedom = self.count.sum() - len(self.count)
        return self.squares / float(freedom) if freedom else None


@dataclass(frozen=True)
class Process:
    """Gaussian process with a constant unknown mean, conditioned on runs.

    Attributes
    ----------
    runs : on which it is conditioned
    signal : variance of the figure over designs
    lengths : correlation lengths as shares of the ranges, shape (variable,)
    noise : variance of one run about the figure of its design
    """

    runs: Runs
    signal: float
    lengths: Array
    noise: float
    _factor: Array = field(init=False, repr=False)

    def __post_init__(self) -> None:
        covariance = matern(self.runs.designs, self.runs.designs, self.signal, self.lengths)
        covariance[np.diag_indices_from(covariance)] += self.noise / self.runs.count
        object.__setattr__(self, "_factor", cholesky(covariance, lower=True))

    def _solve(self, right: Array) -> Array:
        return np.asarray(cho_solve((self._factor, True), right))

    @cached_property
    def _weights(self) -> tuple[Array, float, float]:
        """Inverse covariance times one and its sum; the mean by least squares (RW 2.42)."""
        ones = self._solve(np.ones(len(self.runs.mean)))
        total = float(ones.sum())
        return ones, total, float(ones @ self.runs.mean) / total

    @property
    def level(self) -> float:
        """Constant mean by generalised least squares."""
        return self._weights[2]

    @cached_property
    def _residual(self) -> Array:
        return self._solve(self.runs.mean - self.level)

    def posterior(self, designs: Array) -> tuple[Array, Array]:
        """Compute mean and standard deviation of the figure, without the noise of a run.

        RW (2.25), (2.26), and (2.41), (2.42) for the constant mean with a vague prior.

        Parameters
        ----------
        designs : shares of the ranges, shape (design, variable)

        Returns
        -------
        mean, deviation : each of shape (design,)
        """
        ones, total, level = self._weights
        across = matern(self.runs.designs, designs, self.signal, self.lengths)
        mean = level + across.T @ self._residual
        explained = np.einsum("ij,ij->j", across, self._solve(across))
        unknown_level = (1.0 - across.T @ ones) ** 2 / total
        variance = self.signal - explained + unknown_level
        return np.asarray(mean), np.sqrt(np.maximum(variance, 0.0))

    @cached_property
    def log_likelihood(self) -> float:
        """Logarithm of the marginal likelihood of all runs (RW 2.30), at `level`.

        By means and squares of repeated runs; Binois et al. (2018), equation (7).
        """
        runs, total = self.runs, float(self.runs.count.sum())
        fit = float((runs.mean - self.level) @ self._residual)
        determinant = 2.0 * float(np.log(np.diag(self._factor)).sum())
        repeated = total - len(runs.count)
        within = repeated * np.log(self.noise) + float(np.log(runs.count).sum())
        within += runs.squares / self.noise
        return float(-0.5 * (fit + determinant + within + total * np.log(2.0 * np.pi)))

    @cached_property
    def slope(self) -> Array:
        """Derivatives of `log_likelihood` by the logarithms of signal, lengths and noise.

        RW (5.9); the level is at its optimum, so that it adds nothing.
        """
        runs = self.runs
        inverse = self._solve(np.eye(len(runs.mean)))
        weight = np.outer(self._residual, self._residual) - inverse
        covariance = matern(runs.designs, runs.designs, self.signal, self.lengths)
        of_lengths = matern_by_lengths(runs.designs, self.signal, self.lengths)
        repeated = float(runs.count.sum()) - len(runs.count)
        of_noise = 0.5 * float(np.diag(weight) @ (self.noise / runs.count))
        of_noise += 0.5 * (runs.squares / self.noise - repeated)
        by_length = 0.5 * np.einsum("ij,vij->v", weight, of_lengths)
        return np.array([0.5 * float((weight * covariance).sum()), *by_length, of_noise])


def matern(first: Array, second: Array, signal: float, lengths: Array) -> Array:
    """Compute the Matérn covariance with smoothness 5/2 (RW 4.17), shape (first, second).

    Parameters
    ----------
    first, second : designs, shapes (first, variable) and (second, variable)
    signal : variance
    lengths : correlation lengths, shape (variable,)
    """
    distance = np.sqrt(5.0 * _squares(first, second, lengths).sum(axis=0))
    return np.asarray(signal * (1.0 + distance + distance**2 / 3.0) * np.exp(-distance))


def matern_by_lengths(designs: Array, signal: float, lengths: Array) -> Array:
    """Compute its derivatives by the logarithms of the lengths, shape (variable, design, design).

    Parameters
    ----------
    designs : shape (design, variable)
    signal : variance
    lengths : correlation lengths, shape (variable,)
    """
    squares = _squares(designs, designs, lengths)
    distance = np.sqrt(5.0 * squares.sum(axis=0))
    return np.asarray(signal * 5.0 / 3.0 * squares * (1.0 + distance) * np.exp(-distance))


def _squares(first: Array, second: Array, lengths: Array) -> Array:
    """Squared distances by variable, in correlation lengths, shape (variable, first, second)."""
    scaled = first.T[:, :, None] / lengths[:, None, None]
    return np.asarray((scaled - second.T[:, None, :] / lengths[:, None, None]) ** 2)


def fitted(runs: Runs, first: Sequence[Process] = ()) -> Process:
    """Fit a process by the greatest posterior density of its parameters.

    The marginal likelihood times log-normal priors of the correlation lengths (RW 5.4.1).

    Parameters
    ----------
    runs : runs of two distinct designs or more
    first : processes from whose parameters the search begins, too
    """
    if len(runs.mean) < 2:
        raise ParameterError("a Gaussian process: needs runs of two designs or more")
    spread = max(float(runs.mean.var()), 1e-12)
    size = runs.designs.shape[1]
    ends = [np.multiply(spread, SIGNAL_SHARES), np.multiply(spread, NOISE_SHARES)]
    bounds = np.log(np.array([ends[0], *np.tile(LENGTHS, (size, 1)), ends[1]]))
    noise = min(runs.pure_error or 0.01 * spread, spread)
    begins = [[spread, *[length] * size, max(noise, 1e-6 * spread)] for length in FIRST_LENGTHS]
    begins += [[process.signal, *process.lengths, process.noise] for process in first]

    def cost(logarithms: Array) -> tuple[float, Array]:
        process = _process(runs, logarithms)
        off = logarithms[1:-1] - np.log(USUAL_LENGTH)
        slope = process.slope.copy()
        slope[1:-1] -= off
        return 0.5 * float(off @ off) - process.log_likelihood, -slope

    best = None
    for begin in begins:
        start = np.clip(np.log(begin), *bounds.T)
        result = minimize(cost, start, jac=True, method="L-BFGS-B", bounds=bounds)
        if best is None or result.fun < best.fun:
            best = result
    return _process(runs, best.x)  # type: ignore[union-attr]


def _process(runs: Runs, logarithms: Array) -> Process:
    signal, *lengths, noise = np.exp(logarithms).tolist()
    return Process(runs, signal, np.array(lengths), noise)
