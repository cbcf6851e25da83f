"""Influence coefficients of a study with their spread over its samples, before any run."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np

from ...base.arrays import ComplexArray
from ...base.errors import ParameterError, SolverError
from ...machine.feet import FOOT_NAMES
from ...measured.trial_runs.measured_runs import MeasuredRuns
from ...measured.trial_runs.reading_text import PEAK_FACTORS
from ...measured.trial_runs.settings import Sensor, StudyOfMachine, TrialRuns
from ...mechanics.balancing.coefficients import Ensemble
from ...radiation.given import Radiation
from ...recordings.quantities import quantity
from ...stages.radiation import KeptRadiation
from ...study.loading import load_study
from ...study.samples import samples_of, with_sample
from ...study.sampling import Sample
from ...study.study import Study
from ..balance import MOTION, counterweights_of, influence_of_weights
from ..engine.sound_path import SoundPaths

FOOT: Final = "foot_force_n"
PRESSURE: Final = "pressure_pa"
_DERIVATIVES: Final = {"displacement": 0, "velocity": 1, "acceleration": 2}
_LEAST_SAMPLES: Final = 10


@dataclass(frozen=True)
class StudyInfluence:
    """Influence of weights on a machine in the samples of its study.

    Attributes
    ----------
    study : study of the machine, at the speeds of the readings and at its own
    samples : values of each sample
    ensemble : influence coefficients of the rows of the readings
    feet : forces on the feet, shape (sample, speed, foot and axis, plane), N per kg m
    pressure : sound pressure, shape (sample, speed, receiver, plane), Pa per kg m: of each
        sample where a reading is of sound, of the nominal machine where only the file's results
        ask for it, else without receivers
    """

    study: Study
    samples: Sequence[Sample]
    ensemble: Ensemble
    feet: ComplexArray
    pressure: ComplexArray


def influence_of_study(
    settings: TrialRuns, runs: MeasuredRuns, radiation: Radiation | None = None
) -> StudyInfluence | None:
    """Compute what the weights do in the samples of a study; none without a study.

    Parameters
    ----------
    settings : file of the runs; its planes are counterweights of the study's option
    runs : readings, whose rows the coefficients have
    radiation : function that gives the transfer vectors

    Raises
    ------
    ParameterError
        A plane is no counterweight of the option, a sensor is nothing of the study, or the study
        has no ranges.
    """
    if settings.study is None:
        return None
    loaded = load_study(Path(settings.study.file))
    speeds = sorted({*runs.speeds_rpm.tolist(), *_further(loaded.operation.speed_rpm)})
    study = _at_speeds(loaded, speeds, settings.study.samples)
    weights = counterweights_of(study, settings.study.option)
    for plane in settings.planes:
        if plane not in weights:
            raise ParameterError(
                f"planes.{plane}: no counterweight of option {settings.study.option}; known are "
                f"{', '.join(weights)}"
            )
    figures = {name: _figure(name, settings.sensors[name]) for name in dict.fromkeys(runs.sensors)}
    wanted = list(dict.fromkeys([*figures.values(), FOOT]))
    paths = SoundPaths(KeptRadiation() if radiation is None else radiation)
    order = [list(weights).index(plane) for plane in settings.planes]
    turn = np.exp(1j * settings.study.tacho_rad)
    samples, rows, feet, pressure = [], [], [], []
    for sample, sampled in _sampled(study, settings.study, PRESSURE in wanted):
        try:
            _, influence = influence_of_weights(
                sampled, settings.study.option, weights, wanted, paths
            )
            by_figure = _by_figure(turn * influence[..., order], wanted, len(study.receivers))
        except (ParameterError, SolverError):
            continue  # values that contradict one another
        samples.append(sample)
        rows.append(_rows(settings, runs, sampled, figures, by_figure, speeds))
        feet.append(by_figure[FOOT])
        pressure.append(by_figure.get(PRESSURE, by_figure[FOOT][:, :0]))
    if settings.study.results is not None and PRESSURE not in wanted:
        _, nominal = influence_of_weights(study, settings.study.option, weights, [PRESSURE], paths)
        pressure = [turn * _peaks(nominal[..., order], len(study.receivers))] * len(samples)
    if len(samples) < _LEAST_SAMPLES:
        raise ParameterError(f"study.file: {len(samples)} samples have a solution: must be 10")
    return StudyInfluence(
        study, samples, Ensemble(np.array(rows)), np.array(feet), np.array(pressure)
    )


def _further(speeds_rpm: Sequence[float]) -> list[float]:
    """Slowest, middle and fastest speed of a study."""
    ordered = sorted(speeds_rpm)
    return [ordered[0], ordered[len(ordered) // 2], ordered[-1]]


def _at_speeds(study: Study, speeds_rpm: Sequence[float], samples: int) -> Study:
    """Study at the speeds of the readings, its supply frequencies between those that it has."""
    values: dict[str, Sequence[float] | int] = {"operation.speed_rpm": speeds_rpm}
    if study.ranges:
        values["uncertainty.random_samples"] = samples
    supply_hz = study.operation.supply_frequency_hz
    if supply_hz:
        pairs = sorted(zip(study.operation.speed_rpm, supply_hz, strict=True))
        present = np.interp(speeds_rpm, *np.array(pairs).T)
        values["operation.supply_frequency_hz"] = present.tolist()
    return study.replace(values)


def _sampled(
    study: Study, settings: StudyOfMachine, with_sound: bool
) -> Iterator[tuple[Sample, Study]]:
    """Samples and studies with them, without their sources where no sound counts."""
    samples = samples_of(study).samples
    if not samples:
        raise ParameterError(
            f"study.file = {settings.file}: has no ranges that are sampled: give its values ranges "
            "and the study [sources.NAME]"
        )
    changed: dict[str, None] = (
        {} if with_sound else {f"sources.{name}": None for name in study.sources}
    )
    plain = study.replace(changed)
    for sample in samples:
        machine = with_sample(plain.machine, plain.machine, sample)
        yield sample, plain.model_copy(update={"machine": machine})


def _by_figure(
    influence: ComplexArray, figures: Sequence[str], receivers: int
) -> dict[str, ComplexArray]:
    """Parts of the influence by figure, each of shape (speed, row, plane)."""
    sizes = {MOTION: 6, PRESSURE: receivers}
    further = influence.shape[1] - sum(sizes.get(figure, 0) for figure in figures)
    ends = np.cumsum([sizes.get(figure, further) for figure in figures])
    parts = dict(zip(figures, np.split(influence, ends[:-1], axis=1), strict=True))
    if PRESSURE in parts:
        parts[PRESSURE] = _peaks(parts[PRESSURE], receivers)
    return parts


def _peaks(pressure: ComplexArray, receivers: int) -> ComplexArray:
    """Peaks at each of the microphones, whose effective values add to a mean square."""
    return np.asarray(np.sqrt(2.0 * receivers) * pressure)


def _figure(name: str, sensor: Sensor) -> str:
    """Figure of the study that a sensor measures, by its quantity."""
    kind = quantity(sensor.unit).kind
    if kind == "sound pressure" and sensor.receiver is not None:
        return PRESSURE
    if kind == "force" and sensor.foot is not None:
        return FOOT
    if kind in _DERIVATIVES and sensor.position_m is not None:
        return MOTION
    raise ParameterError(
        f"sensors.{name}: is nothing of the study: give receiver with Pa, foot and axis with N, or "
        "position_mm and axis with a motion"
    )


def _rows(
    settings: TrialRuns,
    runs: MeasuredRuns,
    study: Study,
    figures: Mapping[str, str],
    by_figure: Mapping[str, ComplexArray],
    speeds: Sequence[float],
) -> ComplexArray:
    """Influence of the rows of the readings, in their units, shape (row, plane)."""
    rows = []
    for name, speed in zip(runs.sensors, runs.speeds_rpm.tolist(), strict=True):
        sensor, figure = settings.sensors[name], figures[name]
        at_speed = by_figure[figure][speeds.index(speed)]
        measured = quantity(sensor.unit)
        if figure == MOTION:
            omega = speed * np.pi / 30.0
            value = (1j * omega) ** _DERIVATIVES[measured.kind] * _along(sensor) @ at_speed
        elif figure == FOOT:
            value = at_speed[3 * _foot(name, sensor, study) + "xyz".index(sensor.axis or "z")]
        else:
            value = at_speed[_receiver(name, sensor, study)]
        rows.append(value / (measured.factor * PEAK_FACTORS[settings.amplitudes]))
    return np.array(rows)


def _along(sensor: Sensor) -> ComplexArray:
    """Motion of a point along an axis by translation and rotation of the body, shape (6,)."""
    along = np.eye(3)["xyz".index(sensor.axis or "z")]
    arm = np.cross(np.array(sensor.position_m), along)
    return np.asarray(np.concatenate([along, arm]), dtype=complex)


def _foot(name: str, sensor: Sensor, study: Study) -> int:
    feet = study.machine.feet
    names = list(FOOT_NAMES) if feet is None else list(feet.by_name)
    if sensor.foot not in names:
        raise ParameterError(
            f"sensors.{name}.foot = {sensor.foot}: no such foot; known are {', '.join(names)}"
        )
    return names.index(sensor.foot)


def _receiver(name: str, sensor: Sensor, study: Study) -> int:
    names = list(study.receivers)
    if sensor.receiver not in names:
        raise ParameterError(
            f"sensors.{name}.receiver = {sensor.receiver}: no such microphone; known are "
            f"{', '.join(names)}"
        )
    return names.index(sensor.receiver)
