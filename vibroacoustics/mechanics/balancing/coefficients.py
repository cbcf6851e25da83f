"""Influence coefficients from runs with trial weights: plain functions on arrays.

A reading b of each row (a sensor at a speed) is b₀ + A u by the moments u of the weights that are
in. Every run gives one equation a row; b₀ and A follow from all runs together.
"""

from dataclasses import dataclass
from typing import Final, NamedTuple

import numpy as np

from ...base.arrays import Array, ComplexArray

SAMPLES: Final = 400
_SEED: Final = 21940


class Ensemble(NamedTuple):
    """Influence coefficients before any run, as of the samples of a model.

    Attributes
    ----------
    samples : shape (sample, row, plane), unit of the reading per kg m
    discrepancy_ratio : standard deviation of what the samples do not hold, of each mean coefficient
    """

    samples: ComplexArray
    discrepancy_ratio: float = 0.03


@dataclass(frozen=True)
class Coefficients:
    """Readings without weights and influence coefficients, with their scatter.

    Attributes
    ----------
    mean : b₀, then A, shape (row, 1 + plane)
    factor : deviation from the mean by independent standard normal values, shape
        (row, 1 + plane, value)
    freedom : degrees of freedom of the scatter of each row, infinite where it is stated, zero where
        it is unknown, shape (row,)
    """

    mean: ComplexArray
    factor: ComplexArray
    freedom: Array

    @property
    def response(self) -> ComplexArray:
        """Readings without weights, shape (row,)."""
        return self.mean[:, 0]

    @property
    def influence(self) -> ComplexArray:
        """Influence coefficients, shape (row, plane)."""
        return self.mean[:, 1:]

    def sampled(self, count: int = SAMPLES) -> ComplexArray:
        """Return samples of b₀ and A, shape (sample, row, 1 + plane); equal in every call.

        The scatter of few repeats makes them Student's t, row by row.
        """
        rng = np.random.default_rng(_SEED)
        normal = rng.standard_normal((count, self.factor.shape[-1]))
        finite = np.isfinite(self.freedom) & (self.freedom > 0.0)
        freedom = np.where(finite, self.freedom, 1.0)
        # Rows whose scatter is estimated from the same repeats have the same quantile.
        quantile = rng.permutation((np.arange(count) + 0.5) / count)
        scale = np.ones((count, len(freedom)))
        for each in np.unique(freedom[finite]):
            scale[:, finite & (freedom == each)] = _inflation(each, quantile)[:, None]
        scale[:, self.freedom == 0.0] = np.nan
        deviation = np.einsum("rpv,sv->srp", self.factor, normal)
        return np.asarray(self.mean + deviation * scale[..., None])


def _inflation(freedom: float, quantile: Array) -> Array:
    """Root of ν/χ² at quantiles, shape (sample,)."""
    from scipy.stats import chi2

    return np.asarray(np.sqrt(freedom / chi2.ppf(quantile, freedom)))


def design_matrix(weights: ComplexArray) -> ComplexArray:
    """Equations of the runs, shape (run, 1 + plane).

    Parameters
    ----------
    weights : moments that are in, shape (run, plane), kg m
    """
    return np.concatenate([np.ones((len(weights), 1)), weights], axis=1)


def rank_of_runs(weights: ComplexArray) -> int:
    """Number of unknowns, of b₀ and of one A for each plane, that runs determine.

    Parameters
    ----------
    weights : moments that are in, shape (run, plane), kg m
    """
    design = design_matrix(weights)
    scale = np.maximum(np.abs(design).max(axis=0, initial=0.0), np.finfo(float).tiny)
    return int(np.linalg.matrix_rank(np.asarray(design / scale, dtype=complex), tol=1e-6))


class Scatter(NamedTuple):
    """Scatter of the readings of a row about the linear model.

    Attributes
    ----------
    squares : sum of squared deviations, real and imaginary parts, shape (row,)
    freedom : its degrees of freedom, shape (row,)
    """

    squares: Array
    freedom: Array


def scatter_of_runs(
    readings: ComplexArray, weights: ComplexArray, by_speed: ComplexArray | None = None
) -> Scatter:
    """Return what repeats and further runs differ from the best linear model of all runs.

    Parameters
    ----------
    readings : shape (run, row); not a number where a run has no reading
    weights : moments that are in, shape (run, plane), kg m
    by_speed : change of readings with an unknown factor of each row, shape (run, row)
    """
    design = design_matrix(weights)
    design = design / np.maximum(np.abs(design).max(axis=0), np.finfo(float).tiny)
    squares, freedom = np.zeros(readings.shape[1]), np.zeros(readings.shape[1])
    for row, column in enumerate(readings.T):
        present = np.isfinite(column)
        equations = design[present]
        if by_speed is not None and np.any(change := by_speed[present, row]):
            equations = np.column_stack([equations, change / np.abs(change).max()])
        fit, _, rank, _ = np.linalg.lstsq(equations, column[present], rcond=1e-9)
        freedom[row] = 2.0 * (present.sum() - rank)
        if freedom[row]:
            squares[row] = np.sum(np.abs(column[present] - equations @ fit) ** 2)
    return Scatter(squares, freedom)


def coefficients(
    readings: ComplexArray,
    weights: ComplexArray,
    deviation: Array,
    freedom: Array,
    prior: Ensemble | None = None,
    by_speed: ComplexArray | None = None,
) -> Coefficients:
    """Find b₀ and A by least squares over all runs together, from a prior where there is one.

    Without a prior: min Σ |b - b₀ - A u|²/σ². A prior has A = mean + X z with independent standard
    normal z, and the sum has |z|² too (Tarantola, Inverse Problem Theory, 2005, section 3.2.1).

    Parameters
    ----------
    readings : shape (run, row); not a number where a run has no reading
    weights : moments that are in, shape (run, plane), kg m
    deviation : standard deviation of the real and of the imaginary part, shape (run, row)
    freedom : degrees of freedom of each row's deviation, shape (row,); see `Coefficients`
    prior : influence coefficients before the runs
    by_speed : change of readings by one standard deviation of an exponent of the speed, which is
        unknown in each row, shape (run, row)
    """
    rows, planes = readings.shape[1], weights.shape[1]
    middle = np.zeros((rows, 1 + planes), dtype=complex)
    scale = np.abs(weights).max(axis=0, initial=0.0)
    scale[scale == 0.0] = 1.0
    columns = _flat_columns(rows, scale)
    flat = columns.shape[-1]
    if prior is not None:
        middle[:, 1:] = prior.samples.mean(axis=0)
        flat = 2 * rows
        columns = np.concatenate([columns[..., :flat], _prior_columns(prior)], axis=-1)
    run, row = np.nonzero(np.isfinite(readings))
    design = design_matrix(weights)[run]
    error = deviation[run, row]
    equations = np.einsum("ep,epv->ev", design, columns[row]) / error[:, None]
    targets = (readings[run, row] - np.einsum("ep,ep->e", design, middle[row])) / error
    if by_speed is not None and np.any(by_speed):
        further = np.zeros((len(run), 2 * rows), dtype=complex)
        change = by_speed[run, row] / error
        further[np.arange(len(run)), row] = change
        further[np.arange(len(run)), rows + row] = 1j * change
        equations = np.concatenate([equations, further], axis=1)
        columns = np.concatenate([columns, np.zeros((rows, 1 + planes, 2 * rows))], axis=-1)
    regular = np.eye(columns.shape[-1])[flat:]
    stacked = np.concatenate([equations.real, equations.imag, regular])
    values = np.concatenate([targets.real, targets.imag, np.zeros(len(regular))])
    size = np.sqrt(np.sum(stacked**2, axis=0))
    outer, spread, directions = np.linalg.svd(stacked / size, full_matrices=False)
    inverse = directions.T / spread / size[:, None]
    mean = middle + columns @ (inverse @ (outer.T @ values))
    return Coefficients(mean, columns @ inverse, freedom)


def _flat_columns(rows: int, scale: Array) -> ComplexArray:
    """Real and imaginary part of b₀, then of A, of each row, (row, 1 + plane, value)."""
    columns = np.zeros((1 + scale.size, 2, rows, rows, 1 + scale.size), dtype=complex)
    for number, each in enumerate([1.0, *scale]):
        for row in range(rows):
            columns[number, :, row, row, number] = np.array([1.0, 1j]) / each
    return np.moveaxis(columns.reshape(-1, rows, 1 + scale.size), 0, -1)


def _prior_columns(prior: Ensemble) -> ComplexArray:
    """Deviations of the samples and of what they do not hold, (row, 1 + plane, value)."""
    count, rows, planes = prior.samples.shape
    middle = prior.samples.mean(axis=0)
    anomalies = (prior.samples - middle) / np.sqrt(max(count - 1, 1))
    size = prior.discrepancy_ratio * np.abs(middle) / np.sqrt(2.0)
    single = np.zeros((2, rows * planes, rows * planes), dtype=complex)
    np.einsum("aii->ai", single)[:] = np.array([[1.0], [1j]]) * size.ravel()
    further = single.reshape(-1, rows, planes)
    values = np.moveaxis(np.concatenate([anomalies, further]), 0, -1)
    return np.concatenate([np.zeros((rows, 1, values.shape[-1])), values], axis=1)
