"""Remarks on runs and answer: what makes the weights doubtful, a line each."""

from collections.abc import Iterator
from itertools import pairwise
from typing import Final, NamedTuple

import numpy as np

from ...base.arrays import Array, ComplexArray
from ...measured.trial_runs.measured_runs import SAME_SPEED_RATIO
from ...measured.trial_runs.settings import Plane
from .answers import SOUND
from .balanced_runs import BalancedRuns

WEAK_RATIO: Final = 0.3
WEAK_DEG: Final = 30.0
"""Change of a reading by a trial weight, in amplitude and in phase, that is too small."""
SPEED_RATIO: Final = 0.01
WRAP_DEG: Final = 120.0
RESONANCE_DEG: Final = 60.0
LINEAR_RATIO: Final = 0.2
_UNMADE: Final = 0.1
"""Part of a moment that holes and masses do not make, from which on it is said."""
_SAME: Final = 1e-6


class Pair(NamedTuple):
    """Two runs that differ by weights in one plane.

    Attributes
    ----------
    first, second : numbers of the runs
    plane : number of the plane
    moment : difference of the moments, kg m
    """

    first: int
    second: int
    plane: int
    moment: complex


def remarks(result: BalancedRuns) -> list[str]:
    """Return what makes the weights doubtful, the most important first.

    Parameters
    ----------
    result : answer for runs
    """
    return [
        *_idle(result),
        *_dependent(result),
        *_weak(result),
        *_wrapped(result),
        *_nonlinear(result),
        *_speeds(result),
        *_resonances(result),
        *_limits(result),
        *_scatter(result),
    ]


def pairs(weights: ComplexArray) -> list[Pair]:
    """Find runs that differ by weights in one plane only, the earlier first.

    Parameters
    ----------
    weights : moments that are in, shape (run, plane), kg m
    """
    scale = np.maximum(np.abs(weights).max(axis=0, initial=0.0), np.finfo(float).tiny)
    result = []
    for second in range(len(weights)):
        for first in range(second):
            change = weights[second] - weights[first]
            planes = np.flatnonzero(np.abs(change) > _SAME * scale).tolist()
            if len(planes) == 1:
                result.append(Pair(first, second, planes[0], complex(change[planes[0]])))
    return result


def _row(result: BalancedRuns, row: int) -> str:
    return f"{result.runs.sensors[row]} at {result.runs.speeds_rpm[row]:.0f} rpm"


def _turned_deg(ratio: ComplexArray) -> Array:
    return np.asarray(np.abs(np.angle(ratio, deg=True)))


def _idle(result: BalancedRuns) -> Iterator[str]:
    """Planes whose weights change no reading."""
    effect = np.abs(result.problem.influence).max(axis=0)
    for name, largest in zip(result.settings.planes, effect, strict=True):
        if not largest:
            yield f"plane {name}: its weights change no reading: measure where they do"


def _dependent(result: BalancedRuns) -> Iterator[str]:
    names = list(result.settings.planes)
    effect = np.abs(result.problem.influence).max(axis=0)
    alike = [names[plane] for plane in result.dependence.planes if effect[plane]]
    if not alike:
        return
    if len(result.runs.sensors) < len(names):
        yield (
            f"{len(result.runs.sensors)} readings for {len(names)} planes do not determine the "
            f"weights: add a sensor or a speed; the weights are those of the answer '{SOUND}'"
        )
        return
    size = {name: abs(moment) for name, moment in
            zip(names, result.answers["least squares"], strict=True)}  # fmt: skip
    masses = ", ".join(
        f"{name} {1e3 * size[name] / result.settings.planes[name].radius_m:.3g} g" for name in alike
    )
    yield (
        f"planes {' and '.join(alike)} act alike at all readings (condition number "
        f"{result.dependence.condition:.3g}): least squares needs large weights in opposition "
        f"({masses}); the weights are those of the answer '{SOUND}'"
    )


def _weak(result: BalancedRuns) -> Iterator[str]:
    """Planes in which no trial weight moves any reading enough."""
    readings, names = result.runs.readings, list(result.settings.planes)
    strong: set[int] = set()
    tried: dict[int, str] = {}
    for pair in pairs(result.runs.weights):
        first, second = readings[pair.first], readings[pair.second]
        clear = np.isfinite(first + second) & (np.abs(first) > 0.0)
        ratio = second[clear] / first[clear]
        tried.setdefault(pair.plane, result.runs.names[pair.second])
        if np.any((np.abs(np.abs(ratio) - 1.0) >= WEAK_RATIO) | (_turned_deg(ratio) >= WEAK_DEG)):
            strong.add(pair.plane)
    for plane, run in tried.items():
        if plane not in strong:
            yield (
                f"run {run}: the trial weight in plane {names[plane]} is weak: it changes every "
                f"reading by less than {100 * WEAK_RATIO:.0f} % and {WEAK_DEG:.0f}°: use a larger "
                "one"
            )


def _wrapped(result: BalancedRuns) -> Iterator[str]:
    """Repeats with opposite phases."""
    runs = result.runs
    for second in range(len(runs.weights)):
        for first in range(second):
            if not np.allclose(runs.weights[first], runs.weights[second], atol=1e-15):
                continue
            present = np.abs(runs.readings[first]) > 0.0
            ratio = runs.readings[second] / np.where(present, runs.readings[first], 1.0)
            likely = present & (np.abs(ratio) > 0.5) & (np.abs(ratio) < 2.0)
            for row in np.flatnonzero(likely & (_turned_deg(ratio) > WRAP_DEG)).tolist():
                yield (
                    f"{_row(result, row)}: runs {runs.names[first]} and {runs.names[second]} have "
                    f"the same weights and phases {_turned_deg(ratio)[row]:.0f}° apart: do not "
                    "average phases either side of 0° (359° and 1°) as numbers"
                )


def _nonlinear(result: BalancedRuns) -> Iterator[str]:
    """Planes whose trial weights give different coefficients."""
    runs, names = result.runs, list(result.settings.planes)
    changed = pairs(runs.weights)
    size = np.nanmax(np.abs(runs.readings), axis=0)
    for plane in sorted({pair.plane for pair in changed}):
        several = [
            ((runs.readings[p.second] - runs.readings[p.first]) / p.moment, p)
            for p in changed if p.plane == plane
        ]  # fmt: skip
        worst, which = 0.0, ("", "")
        for number, (one_coefficient, one_pair) in enumerate(several):
            for other_coefficient, other_pair in several[:number]:
                mean = 0.5 * np.abs(one_coefficient + other_coefficient)
                smaller = min(abs(one_pair.moment), abs(other_pair.moment))
                clear = mean * smaller > WEAK_RATIO * size
                apart = np.abs(one_coefficient - other_coefficient)
                largest = float(np.max(apart[clear] / mean[clear], initial=0.0))
                if largest > worst:
                    worst = largest
                    which = runs.names[other_pair.second], runs.names[one_pair.second]
        if worst > LINEAR_RATIO:
            yield (
                f"plane {names[plane]}: the weights of runs {which[0]} and {which[1]} give "
                f"influence coefficients that differ by {100 * worst:.0f} %: the machine is not "
                "linear, or a run is not as written"
            )


def _speeds(result: BalancedRuns) -> Iterator[str]:
    runs = result.runs
    share = np.abs(runs.actual_rpm / runs.speeds_rpm - 1.0)
    for number, name in enumerate(runs.names):
        if np.any(share[number] > SPEED_RATIO):
            row = int(np.nanargmax(share[number]))
            yield (
                f"run {name}: {runs.actual_rpm[number, row]:.0f} rpm, the first run "
                f"{runs.speeds_rpm[row]:.0f} rpm: readings are scaled to that, and the bands are "
                "wider"
            )


def _resonances(result: BalancedRuns) -> Iterator[str]:
    """Phases that turn between speeds, and a service speed without readings."""
    runs, speeds = result.runs, sorted(set(result.runs.speeds_rpm.tolist()))
    columns = result.coefficients.influence
    for sensor in dict.fromkeys(runs.sensors):
        rows = [row for row, name in enumerate(runs.sensors) if name == sensor]
        for low, high in pairwise(rows):
            turned = float(_turned_deg(np.vdot(columns[low], columns[high])[None])[0])
            if turned > RESONANCE_DEG:
                yield (
                    f"{sensor}: its phase turns by {turned:.0f}° from {runs.speeds_rpm[low]:.0f} "
                    f"to {runs.speeds_rpm[high]:.0f} rpm: a resonance is between them"
                )
    service = result.settings.rotor.service_speed_rpm
    if service is None or any(abs(service / each - 1.0) <= SAME_SPEED_RATIO for each in speeds):
        return
    nearest = min(speeds, key=lambda each: abs(each - service))
    yield (
        f"no reading at the service speed, {service:.0f} rpm (nearest {nearest:.0f} rpm): a "
        "resonance between them changes the answer: measure there"
    )


def _limits(result: BalancedRuns) -> Iterator[str]:
    for row, sensor in enumerate(result.runs.sensors):
        stated, size = result.settings.sensors[sensor], result.remaining(row)
        limit, highest = stated.limit or np.inf, result.after_band[2, row]
        where = f"above its limit, {limit:g} {stated.unit}"
        if size > limit:
            yield f"{_row(result, row)}: {size:.3g} {stated.unit} remain, {where}"
        elif highest > limit:
            yield f"{_row(result, row)}: up to {highest:.3g} {stated.unit} may remain, {where}"
    moments = zip(result.answers[result.chosen], result.moment_kg_m, strict=True)
    for (name, plane), (moment, made) in zip(result.settings.planes.items(), moments, strict=True):
        if abs(made - moment) > _UNMADE * abs(moment):
            yield (
                f"plane {name}: its holes and masses make {_grams(made, plane)} for "
                f"{_grams(moment, plane)} of the answer"
            )
        most = plane.maximum_mass_kg
        if most is not None and abs(moment) >= (1.0 - 1e-4) * most * plane.radius_m:
            yield f"plane {name}: the weight is at its limit, {1e3 * most:g} g"


def _grams(moment: complex, plane: Plane) -> str:
    return f"{1e3 * abs(moment) / plane.radius_m:.3g} g"


def _scatter(result: BalancedRuns) -> Iterator[str]:
    unknown = [
        sensor
        for sensor in dict.fromkeys(result.runs.sensors)
        if any(
            result.coefficients.freedom[row] == 0.0
            for row, name in enumerate(result.runs.sensors)
            if name == sensor
        )
    ]
    if unknown:
        yield (
            f"the scatter of {', '.join(unknown)} is unknown, so there are no bands: repeat a run, "
            "or state sensors.NAME.scatter"
        )
