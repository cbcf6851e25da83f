"""Readings and weights of all runs as arrays, in one convention of angles."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Final, NamedTuple

import numpy as np

from ...base.arrays import Array, ComplexArray
from ...base.errors import ParameterError
from ...base.fault import omit
from ...mechanics.balancing.coefficients import rank_of_runs
from ...recordings.quantities import quantity
from .reading_text import PEAK_FACTORS, parsed
from .recorded import RecordedReadings, recorded_readings
from .settings import Plane, RunWeight, TrialRuns, hole_angles_rad

SAME_SPEED_RATIO: Final = 0.05
"""Readings of speeds that differ by less are of one operating point."""


class Entry(NamedTuple):
    """A reading of a run, in the sensor's unit, its phase leading with the rotation."""

    run: int
    speed_rpm: float
    sensor: str
    value: complex
    deviation: float


@dataclass(frozen=True)
class MeasuredRuns:
    """Readings and weights of all runs.

    Angles count with the rotation from the mark; phases lead. A row is a sensor at a speed.

    Attributes
    ----------
    names : name of each run; repeats of a run have its name
    sensors : sensor of each row
    speeds_rpm : nominal speed of each row, shape (row,)
    readings : shape (run, row), in the sensor's unit; not a number where there is none
    deviation : stated or recorded standard deviation of real and imaginary part, shape (run, row);
        not a number where it is unknown
    actual_rpm : speed of each reading, shape (run, row)
    weights : moments that are in, shape (run, plane), kg m
    installed : moments that stay in after the last run, shape (plane,), kg m
    """

    names: tuple[str, ...]
    sensors: tuple[str, ...]
    speeds_rpm: Array
    readings: ComplexArray
    deviation: Array
    actual_rpm: Array
    weights: ComplexArray
    installed: ComplexArray


def measured_runs(settings: TrialRuns, folder: Path) -> MeasuredRuns:
    """Collect readings and weights; a second recording of a run at a speed is a repeat.

    Parameters
    ----------
    settings : file of the runs
    folder : folder of the file, in which recordings are
    """
    campaign = settings.campaign()
    recorded = (
        entry
        for number, run in enumerate(settings.runs.values())
        for name in run.recordings
        for entry in entries_of(
            settings, number, recorded_readings(folder / name, campaign), folder / name
        )
    )
    return collected(settings, [*_written(settings), *recorded])


def collected(settings: TrialRuns, entries: Sequence[Entry]) -> MeasuredRuns:
    """Return readings and weights as arrays.

    Parameters
    ----------
    settings : file of the runs
    entries : readings
    """
    moments, installed = moments_of_runs(settings)
    speeds = _nominal([entry.speed_rpm for entry in entries])
    rows = sorted({(speeds[i], entry.sensor) for i, entry in enumerate(entries)},
                  key=lambda row: (row[0], list(settings.sensors).index(row[1])))  # fmt: skip
    repeats: dict[tuple[int, float, str], int] = {}
    cells: list[tuple[int, int, int]] = []
    for number, entry in enumerate(entries):
        key = (entry.run, speeds[number], entry.sensor)
        repeats[key] = repeats.get(key, -1) + 1
        cells.append((entry.run, repeats[key], rows.index(key[1:])))
    runs = sorted({(run, repeat) for run, repeat, _ in cells})
    shape = (len(runs), len(rows))
    readings, deviation = np.full(shape, np.nan, dtype=complex), np.full(shape, np.nan)
    actual = np.full(shape, np.nan)
    for entry, (run, repeat, row) in zip(entries, cells, strict=True):
        where = runs.index((run, repeat)), row
        readings[where], deviation[where] = entry.value, entry.deviation
        actual[where] = entry.speed_rpm
    names = list(settings.runs)
    return MeasuredRuns(
        tuple(names[run] for run, _ in runs),
        tuple(sensor for _, sensor in rows),
        np.array([speed for speed, _ in rows]),
        readings,
        deviation,
        actual,
        moments[[run for run, _ in runs]],
        installed,
    )


def moments_of_runs(settings: TrialRuns) -> tuple[ComplexArray, ComplexArray]:
    """Moments that are in at each run, shape (run, plane), and that stay in, shape (plane,), kg m.

    Parameters
    ----------
    settings : file of the runs
    """
    installed = np.zeros(len(settings.planes), dtype=complex)
    moments = np.zeros((len(settings.runs), len(settings.planes)), dtype=complex)
    names = list(settings.planes)
    for number, run in enumerate(settings.runs.values()):
        moments[number] = installed
        for name, weight in run.weights.items():
            plane = weight.plane or name
            moments[number, names.index(plane)] += _moment(settings, settings.planes[plane], weight)
        if settings.stays(run):
            installed = moments[number].copy()
    return moments, installed


def _moment(settings: TrialRuns, plane: Plane, weight: RunWeight) -> complex:
    angle = weight.angle_rad
    if angle is None:
        angle = hole_angles_rad(plane)[(weight.hole or 1) - 1]
    radius = weight.radius_m or plane.radius_m
    turned = np.exp(1j * settings.sense * (plane.zero_rad + angle))
    return complex(weight.mass_kg * radius * turned)


def _written(settings: TrialRuns) -> Iterator[Entry]:
    """Readings that the file holds."""
    for number, run in enumerate(settings.runs.values()):
        for speed, readings in run.readings.items():
            for sensor, text in readings.items():
                value = parsed(text).value
                lead = value if settings.phases == "lead" else value.conjugate()
                stated = settings.sensors[sensor].scatter
                deviation = np.nan if stated is None else stated
                yield Entry(number, float(speed), sensor, lead, deviation)


def entries_of(
    settings: TrialRuns, number: int, recorded: RecordedReadings, path: Path
) -> Iterator[Entry]:
    """Give the readings of a recording, in the units and amplitudes of the file.

    Parameters
    ----------
    settings : file of the runs
    number : number of the run
    recorded : 1× readings, SI
    path : file of the recording

    Raises
    ------
    ParameterError
        A channel of a sensor is missing or of another quantity.
    """
    for sensor, stated in settings.sensors.items():
        if sensor not in recorded.values:
            listed = ", ".join(recorded.values)
            raise ParameterError(f"{path}: has no channel {sensor} of sensors; known are {listed}")
        measured = quantity(stated.unit)
        if recorded.units[sensor] != measured.unit:
            raise ParameterError(
                f"{path}: channel {sensor} is in {recorded.units[sensor]}: must be "
                f"{measured.kind}, as sensors.{sensor} in {stated.unit}"
            )
        factor = 1.0 / (measured.factor * PEAK_FACTORS[settings.amplitudes])
        deviation = float(np.hypot(factor * recorded.deviations[sensor], stated.scatter or 0.0))
        value = factor * recorded.values[sensor]
        yield Entry(number, recorded.speed_rpm, sensor, value, deviation)


def _nominal(speeds_rpm: list[float]) -> list[float]:
    """Nominal speed of each reading: the first of those within 5 %."""
    nominal: list[float] = []
    result = []
    for speed in speeds_rpm:
        near = [each for each in nominal if abs(speed / each - 1.0) <= SAME_SPEED_RATIO]
        if not near:
            nominal.append(speed)
            near = [speed]
        result.append(min(near, key=lambda each: abs(each - speed)))
    return result


def without_gaps(runs: MeasuredRuns, has_prior: bool) -> MeasuredRuns:
    """Omit rows whose runs do not determine the influence of every plane, with a warning each.

    Parameters
    ----------
    runs : readings and weights
    has_prior : whether a study gives influence coefficients before the runs

    Raises
    ------
    ParameterError
        No row is kept.
    """
    present = np.isfinite(runs.readings)
    planes = runs.weights.shape[1]
    needed = 1 if has_prior else 1 + planes
    kept = [
        row
        for row in range(present.shape[1])
        if rank_of_runs(runs.weights[present[:, row]]) >= needed
    ]
    if not kept:
        raise ParameterError(
            f"runs: do not determine {planes} planes: add a run with a trial weight "
            "in each plane alone, or a table [study]"
        )
    for row in sorted(set(range(present.shape[1])) - set(kept)):
        omit(
            f"{runs.sensors[row]} at {runs.speeds_rpm[row]:.0f} rpm",
            "its runs do not determine the influence of every plane",
        )
    return replace(
        runs,
        sensors=tuple(runs.sensors[row] for row in kept),
        speeds_rpm=runs.speeds_rpm[kept],
        readings=runs.readings[:, kept],
        deviation=runs.deviation[:, kept],
        actual_rpm=runs.actual_rpm[:, kept],
    )
