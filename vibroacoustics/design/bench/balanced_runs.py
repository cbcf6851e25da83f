"""Weights that balance a machine on the bench, from its runs with trial weights."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Final, NamedTuple

import numpy as np

from ...base.arrays import Array, ComplexArray
from ...base.quantiles import INTERVAL
from ...measured.band import naming_settings
from ...measured.trial_runs.measured_runs import (
    MeasuredRuns,
    measured_runs,
    moments_of_runs,
    without_gaps,
)
from ...measured.trial_runs.scatter import Deviations, at_nominal_speed, deviations, slopes
from ...measured.trial_runs.settings import Plane, TrialRuns, hole_angles_rad, load_trial_runs
from ...mechanics.balancing.bands import residual_samples
from ...mechanics.balancing.coefficients import Coefficients, coefficients, rank_of_runs
from ...mechanics.balancing.planes import Dependence
from ...radiation.given import Radiation
from ...recordings.quantities import quantity
from .answers import SOUND, BenchProblem, PlaneLimits, answers_of
from .prior import StudyInfluence, influence_of_study

KINDS: Final = {"sound pressure": "microphones", "force": "feet"}
_NO_EFFECT: Final = 1e-9
VIBRATION: Final = "vibration"


class PlacedWeight(NamedTuple):
    """Weight to add.

    Attributes
    ----------
    plane : name of the plane
    hole : number of the hole, from one; none without holes
    mass_kg : mass at the radius of the plane
    angle_rad : angle from the zero of the plane, in the convention of the file

    Examples
    --------
    >>> va.PlacedWeight("fan", 3, 0.012, 1.05).hole
    3
    """

    plane: str
    hole: int | None
    mass_kg: float
    angle_rad: float


@dataclass(frozen=True)
class BalancedRuns:
    """Weights that balance a machine, and the readings that remain with them.

    A row is a sensor at a speed; its values are in the sensor's unit and of the kind of amplitudes
    of the file. Bands hold 80 %; they are not a number where no repeats show the scatter.

    Attributes
    ----------
    settings : file of the runs
    measured : readings and weights of the runs at the speeds of the file
    runs : readings and weights with all readings brought to the speeds of the first run
    coefficients : readings without weights and influence coefficients
    problem : readings with the weights that stay in, and influence
    answers : moments to add by aim, each of shape (plane,), kg m
    chosen : name of the recommended answer
    weights : weights to add
    moment_kg_m : moments of these weights, shape (plane,), kg m
    after_band : low end, median and high end of the amplitudes that remain, shape (3, row)
    expected_band : low end, median and high end of the next readings, which have a scatter of
        their own, shape (3, row)
    moment_samples : moments of least squares of samples of the coefficients, shape (sample, plane)
    deviation : standard deviation of a reading's real and of its imaginary part, shape (run, row)
    study : influence of weights in the samples of the machine's study, if the file names one

    Examples
    --------
    >>> balanced = va.balance_runs("fan/balancing.toml")
    >>> [(each.plane, each.hole, round(1e3 * each.mass_kg)) for each in balanced.weights]
    [('front', 2, 7), ('front', 3, 27), ('rear', 4, 13), ('rear', 5, 9)]
    >>> bool(np.all(np.abs(balanced.after) < np.abs(balanced.before)))
    True
    """

    settings: TrialRuns
    measured: MeasuredRuns
    runs: MeasuredRuns
    coefficients: Coefficients
    problem: BenchProblem
    answers: Mapping[str, ComplexArray]
    chosen: str
    weights: tuple[PlacedWeight, ...]
    moment_kg_m: ComplexArray
    after_band: Array
    expected_band: Array
    moment_samples: ComplexArray
    deviation: Array
    study: StudyInfluence | None

    @property
    def before(self) -> ComplexArray:
        """Readings with the weights that stay in, shape (row,)."""
        return self.problem.response

    @property
    def after(self) -> ComplexArray:
        """Readings with the weights to add, too, shape (row,)."""
        return self.problem.residual(self.moment_kg_m)

    @property
    def dependence(self) -> Dependence:
        """Condition number, and planes that act alike."""
        return self.problem.dependence()

    def remaining(self, row: int) -> float:
        """Amplitude that remains: the median of its band, else its value; zero if rounding noise.

        Parameters
        ----------
        row : number of the row
        """
        value = float(self.after_band[1, row])
        if np.isfinite(value):
            return value
        size = abs(self.after[row])
        return float(size if size > _NO_EFFECT * abs(self.before[row]) else 0.0)


def balance_runs(path: str | Path, radiation: Radiation | None = None) -> BalancedRuns:
    """Find weights that balance a machine on the bench, from its runs with trial weights.

    Least squares over all runs gives the readings without weights and the influence coefficients
    (Goodman, J. Eng. Ind. 86 (1964) 273), then the weights; see `balance` for those of a study.

    Parameters
    ----------
    path : TOML file of the runs; docs/balancing.md has its tables
    radiation : function that gives the transfer vectors of a study that the file names

    Raises
    ------
    ParameterError
        Anything in the file is missing, unknown or outside its range, or the runs do not determine
        the influence of every plane.
    StorageError
        A recording cannot be read.

    Examples
    --------
    >>> balanced = va.balance_runs("fan/balancing.toml")
    >>> balanced.chosen
    'least squares'
    """
    path = Path(path)
    settings = load_trial_runs(path)
    with naming_settings(path):
        runs = without_gaps(measured_runs(settings, path.parent), settings.study is not None)
        return balanced(settings, runs, influence_of_study(settings, runs, radiation))


def balanced(
    settings: TrialRuns, runs: MeasuredRuns, study: StudyInfluence | None = None
) -> BalancedRuns:
    """Return what `balance_runs` does, of readings that are arrays.

    Parameters
    ----------
    settings : file of the runs
    runs : readings and weights
    study : influence of weights in the samples of the machine's study
    """
    measured = runs
    runs, scatter, by_speed = _corrected(settings, measured)
    prior = None if study is None else study.ensemble
    fitted = coefficients(
        runs.readings, runs.weights, scatter.deviation, scatter.freedom, prior, by_speed
    )
    fitted = _with_effect(fitted, runs)
    problem = BenchProblem(
        fitted.response + fitted.influence @ runs.installed,
        fitted.influence,
        _row_weights(settings, runs, fitted.response + fitted.influence @ runs.installed),
        [_limits_of(settings, plane) for plane in settings.planes.values()],
    )
    names = list(settings.planes)
    answers = answers_of(problem, names, _groups(settings, runs.sensors))
    chosen = SOUND if SOUND in answers else settings.answer
    pieces = problem.pieces(answers[chosen], settings.answer)
    moment = np.array([sum((piece.vector for piece in each), 0j) for each in pieces])
    samples = fitted.sampled()
    residual = residual_samples(fitted, runs.installed + moment)
    is_read = np.isfinite(runs.readings)
    noise = np.nanmean(np.where(is_read, scatter.deviation, np.nan), axis=0)
    expected = residual + noise * _noise(residual.shape)
    return BalancedRuns(
        settings,
        measured,
        runs,
        fitted,
        problem,
        answers,
        chosen,
        _placed(settings, [(name, *piece) for name, each in zip(names, pieces, strict=True)
                           for piece in each]),
        moment,
        np.quantile(np.abs(residual), INTERVAL, axis=0),
        np.quantile(np.abs(expected), INTERVAL, axis=0),
        _sampled_moments(problem.weight, samples, runs.installed),
        scatter.deviation,
        study,
    )  # fmt: skip


def _with_effect(fitted: Coefficients, runs: MeasuredRuns) -> Coefficients:
    """Coefficients without rounding noise, in readings of zero and planes without effect."""
    largest = np.abs(runs.weights).max(axis=0)
    effect = np.abs(fitted.influence).max(axis=0) * largest
    scale = np.nanmax(np.abs(runs.readings))
    idle = (effect < _NO_EFFECT * scale) & (largest > 0.0)
    mean = fitted.mean.copy()
    mean[:, 1:][:, idle] = 0.0
    mean[np.abs(mean[:, 0]) < _NO_EFFECT * scale, 0] = 0.0
    return replace(fitted, mean=mean)


def _corrected(
    settings: TrialRuns, runs: MeasuredRuns
) -> tuple[MeasuredRuns, Deviations, ComplexArray]:
    """Readings at the nominal speeds, their standard deviations, and change with the speed."""
    units = {name: sensor.unit for name, sensor in settings.sensors.items()}
    growth = slopes(runs.readings, runs.sensors, runs.speeds_rpm, units)
    nominal = at_nominal_speed(runs.readings, runs.actual_rpm, runs.speeds_rpm, growth)
    scatter = deviations(nominal, runs.weights, runs.deviation, runs.sensors)
    return replace(runs, readings=nominal.readings), scatter, np.nan_to_num(nominal.by_speed)


def _noise(shape: tuple[int, ...]) -> ComplexArray:
    """Standard normal real and imaginary parts, equal in every call."""
    rng = np.random.default_rng(1)
    return np.asarray(rng.standard_normal(shape) + 1j * rng.standard_normal(shape))


def _row_weights(settings: TrialRuns, runs: MeasuredRuns, response: ComplexArray) -> Array:
    """Weights of rows: over the limits of their sensors; else over the largest of their unit."""
    limits = [settings.sensors[name].limit for name in runs.sensors]
    if all(limit is not None for limit in limits):
        return np.array([1.0 / (limit or 1.0) for limit in limits])
    units = np.array([settings.sensors[name].unit for name in runs.sensors])
    if len(set(units.tolist())) == 1:
        return np.ones(len(units))
    sizes = np.array([np.abs(response[units == unit]).max() for unit in units])
    return np.asarray(1.0 / np.where(sizes > 0.0, sizes, 1.0))


def _groups(settings: TrialRuns, sensors: Sequence[str]) -> dict[str, Array]:
    """Whether each row is of a microphone, a foot or a vibration; only kinds that the file has."""
    kinds = [KINDS.get(quantity(settings.sensors[name].unit).kind, VIBRATION) for name in sensors]
    return {name: np.array([kind == name for kind in kinds]) for name in dict.fromkeys(kinds)}


def _limits_of(settings: TrialRuns, plane: Plane) -> PlaneLimits:
    holes = np.array(hole_angles_rad(plane))
    largest = np.inf if plane.maximum_mass_kg is None else plane.radius_m * plane.maximum_mass_kg
    masses = np.array(plane.masses_kg)
    return PlaneLimits(settings.sense * (plane.zero_rad + holes), plane.radius_m * masses, largest)


def _placed(
    settings: TrialRuns, pieces: Sequence[tuple[str, int | None, float, float]]
) -> tuple[PlacedWeight, ...]:
    """Weights of pieces, at the radius and in the angles of their planes."""
    return tuple(
        PlacedWeight(
            name,
            hole,
            moment / settings.planes[name].radius_m,
            shown_angle(settings, settings.planes[name], angle),
        )
        for name, hole, moment, angle in pieces
    )


def shown_angle(settings: TrialRuns, plane: Plane, angle_rad: float) -> float:
    """Angle of a moment from the zero of its plane, in the convention of the file, 0 to 2π.

    Parameters
    ----------
    settings : file of the runs
    plane : plane of the weight
    angle_rad : angle with the rotation from the mark
    """
    angle = (settings.sense * angle_rad - plane.zero_rad) % (2.0 * np.pi)
    return float(0.0 if 2.0 * np.pi - angle < 1e-9 else angle)


def _sampled_moments(weight: Array, samples: ComplexArray, installed: ComplexArray) -> ComplexArray:
    """Moments of least squares of each sample, shape (sample, plane), kg m."""
    if not np.all(np.isfinite(samples)):
        return np.full((len(samples), len(installed)), np.nan, dtype=complex)
    influence = weight[:, None] * samples[..., 1:]
    response = weight * (samples[..., 0] + samples[..., 1:] @ installed)
    return np.asarray(-(np.linalg.pinv(influence) @ response[..., None])[..., 0])


def other_reading(balanced_by: BalancedRuns) -> ComplexArray | None:
    """Moments to add if trial weights were removed where the file says left in, or the reverse.

    None where it makes no difference, or where its runs do not determine every plane. The shape is
    (plane,), kg m.

    Parameters
    ----------
    balanced_by : answer for the file
    """
    settings, runs = balanced_by.settings, balanced_by.measured
    other = "removed" if settings.trial_weights == "left in" else "left in"
    changed = settings.model_copy(update={"trial_weights": other})
    moments, installed = moments_of_runs(changed)
    order = list(settings.runs)
    weights = moments[[order.index(name) for name in runs.names]]
    is_same = np.allclose(weights, runs.weights)
    if (
        is_same
        or rank_of_runs(weights) <= weights.shape[1]
        or not np.all(np.isfinite(runs.readings))
    ):
        return None
    again = replace(runs, weights=weights, installed=installed)
    return balanced(changed, again).answers["least squares"]
