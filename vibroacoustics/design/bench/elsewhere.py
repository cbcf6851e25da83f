"""Changes by the weights at the speeds of a study, and its inputs that the runs narrow."""

from collections.abc import Iterator
from typing import Final, NamedTuple

import numpy as np
import xarray as xr

from ...base.arrays import Array, ComplexArray, IndexArray
from ...base.decibel import (
    SILENCE_DB,
    energy_difference,
    energy_sum,
    level_of_amplitude,
    sound_pressure_level,
)
from ...base.errors import ParameterError
from ...base.quantiles import INTERVAL, weighted_quantiles
from ...base.vocabulary import REFERENCE_OPTION
from ...base.weighting import a_weighting
from ...results.storage import open_results
from .balanced_runs import BalancedRuns
from .prior import StudyInfluence

FEET: Final = "feet"
LEAST_SAMPLES: Final = 10.0
"""Effective samples below which the runs say nothing about inputs."""
NARROWED: Final = 0.8
"""Part of its interval that an input keeps at most to be named."""
_LEAST_RATIO: Final = 1e-4
_COMBINATIONS: Final = 2000
_SEED: Final = 1940


class ChangeElsewhere(NamedTuple):
    """Change by the weights of a machine at a speed, from the samples of its study.

    Attributes
    ----------
    observer : `feet` for the root of the sum of squares of all forces, or a microphone
    speed_rpm : speed
    change_db : low end, median and high end of the change at 1x, shape (3,)
    total_db : low end, median and high end of the change of the A-weighted total level, shape (3,);
        none without results of the study
    """

    observer: str
    speed_rpm: float
    change_db: Array
    total_db: Array | None


class NarrowedInput(NamedTuple):
    """Input of a study whose interval the runs narrow.

    Attributes
    ----------
    name : table and field
    before, after : low end, median and high end, SI, shape (3,)
    """

    name: str
    before: Array
    after: Array


def sample_weights(result: BalancedRuns) -> Array | None:
    """Weights of the samples of the study by the runs, shape (sample,); their sum is one.

    Readings differ between runs by A u. The likelihood is normal, with the scatter of the readings
    and what the samples do not hold of each coefficient. None without a study or known scatter.

    Parameters
    ----------
    result : answer for runs
    """
    runs, study = result.runs, result.study
    if study is None or not np.all(result.coefficients.freedom):
        return None
    ensemble = study.ensemble
    size = ensemble.discrepancy_ratio * np.abs(ensemble.samples.mean(axis=0)) / np.sqrt(2.0)
    exponent = np.zeros(len(ensemble.samples))
    for row, readings in enumerate(runs.readings.T):
        present = np.isfinite(readings)
        moments, present_readings = runs.weights[present], readings[present]
        deviation = result.deviation[present, row]
        cause = moments * size[row]
        covariance = np.diag(deviation**2) + cause @ cause.conj().T
        inverse = np.linalg.inv(covariance)
        ones = np.ones(len(present_readings))
        difference = present_readings - ensemble.samples[:, row] @ moments.T
        first = (difference @ inverse.T @ ones) / (ones @ inverse @ ones)
        deviations = difference - first[:, None]
        exponent -= 0.5 * np.einsum("sr,rq,sq->s", deviations.conj(), inverse, deviations).real
    weight = np.exp(exponent - exponent.max())
    return np.asarray(weight / weight.sum())


def effective(weight: Array) -> float:
    """Effective number of weighted samples (Kish, Survey Sampling, 1965)."""
    return float(1.0 / np.sum((weight / weight.sum()) ** 2))


def changes_elsewhere(result: BalancedRuns) -> list[ChangeElsewhere]:
    """Compute the change at each speed of the study for feet and microphones; empty without one.

    The machine needs the moments of least squares, known to the scatter of the runs; what acts is
    the difference of those that it has. Everything at 1x is taken for unbalance in the planes.

    Parameters
    ----------
    result : answer for runs

    Raises
    ------
    ParameterError
        Results that the file names have no such microphone or speed.
    StorageError
        Results that the file names cannot be read.
    """
    study = result.study
    if study is None:
        return []
    weight = sample_weights(result)
    if weight is None or effective(weight) < LEAST_SAMPLES:
        weight = np.full(len(study.samples), 1.0 / len(study.samples))
    needed = result.moment_samples
    if not np.all(np.isfinite(needed)):
        needed = result.answers["least squares"][None]
    rng = np.random.default_rng(_SEED)
    sample = rng.choice(len(weight), _COMBINATIONS, p=weight)
    before = -needed[np.arange(_COMBINATIONS) % len(needed)]
    return list(_changes(result, study, sample, before))


def _changes(
    result: BalancedRuns, study: StudyInfluence, sample: IndexArray, before: ComplexArray
) -> Iterator[ChangeElsewhere]:
    file = None if result.settings.study is None else result.settings.study.results
    totals = None if file is None else open_results(file)
    after = before + result.moment_kg_m
    for number, speed in enumerate(study.study.operation.speed_rpm):
        feet = study.feet[sample, number]
        sizes = [_size(feet, moment) for moment in (before, after)]
        yield ChangeElsewhere(FEET, speed, _band(_ratio_db(*sizes)), None)
        receivers = list(study.study.receivers)[: study.pressure.shape[2]]
        for column, receiver in enumerate(receivers):
            sound = study.pressure[sample, number, column, None]
            sizes = [_size(sound, moment) for moment in (before, after)]
            total = None
            if totals is not None:
                total = _total_change(result, totals, receiver, speed, *sizes)
            yield ChangeElsewhere(receiver, speed, _band(_ratio_db(*sizes)), total)


def _size(influence: ComplexArray, moment: ComplexArray) -> Array:
    """Root of the sum of squares over the rows, shape (combination,)."""
    return np.asarray(np.linalg.norm(np.einsum("srp,sp->sr", influence, moment), axis=1))


def _ratio_db(before: Array, after: Array) -> Array:
    """Change, dB; zero where there is nothing to balance."""
    ratio = np.divide(after, before, out=np.ones_like(after), where=before > 0.0)
    return level_of_amplitude(np.maximum(ratio, _LEAST_RATIO))


def _band(values: Array) -> Array:
    return np.asarray(np.quantile(values, INTERVAL))


def _total_change(
    result: BalancedRuns, results: xr.Dataset, receiver: str, speed: float, *peaks: Array
) -> Array | None:
    """Change of the total level with 1x of the bench in place of that of the results, dB.

    None where the results lack the speed.
    """
    option = "" if result.settings.study is None else result.settings.study.option
    if "level_total" not in results or receiver not in results["receiver"].values:
        raise ParameterError(f"study.results: have no level at microphone {receiver}")
    if speed not in results["speed"].values:
        return None
    has_option = option in results["option"].values
    case = {
        "speed": speed,
        "option": option if has_option else REFERENCE_OPTION,
        "receiver": receiver,
    }
    total = results["level_total"].sel(case).item()
    line = results["order_level"].sel(case | {"order": 1.0, "weighting": "A"}).item()
    other = energy_difference(total, line) if line < total else SILENCE_DB
    weighting = float(a_weighting(speed / 60.0))
    first, last = (
        energy_sum(np.stack([np.full(peak.shape, other), level + weighting]), axis=0)
        for peak, level in ((peak, sound_pressure_level(peak)) for peak in peaks)
    )
    return _band(last - first)


def narrowed_inputs(result: BalancedRuns) -> list[NarrowedInput]:
    """Return inputs of the study whose 80 % interval the runs narrow, the most narrowed first.

    Parameters
    ----------
    result : answer for runs
    """
    weight, study = sample_weights(result), result.study
    if weight is None or study is None or effective(weight) < LEAST_SAMPLES:
        return []
    inputs = []
    for table, field in study.samples[0]:
        values = np.array([sample[table, field] for sample in study.samples])
        before = weighted_quantiles(values, np.ones(len(values)), INTERVAL)
        after = weighted_quantiles(values, weight, INTERVAL)
        inputs.append(NarrowedInput(f"{table}.{field}".lstrip("."), before, after))
    return sorted((each for each in inputs if _kept(each) <= NARROWED), key=_kept)


def _kept(narrowed: NarrowedInput) -> float:
    """Width of the interval after the runs over that before."""
    width = narrowed.before[2] - narrowed.before[0]
    return float((narrowed.after[2] - narrowed.after[0]) / width) if width > 0.0 else 1.0
