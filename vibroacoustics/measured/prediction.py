"""Sound pressure after changes of mounts, masses and absorbers, with a band, as labelled arrays."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Final

import numpy as np
import xarray as xr

from ..base.arrays import Array, ComplexArray
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import level_of_power, power_of_level, sound_pressure_level
from ..base.vocabulary import REFERENCE_OPTION, WEIGHTINGS, check, label_coordinates, stamp
from ..base.weighting import WEIGHTING
from .assembly import Bench, assemble
from .band import (
    TRIED,
    amplitude_band,
    attributes,
    chosen_truncation,
    measured_again,
    naming_settings,
    power_band,
    truncation_errors,
    without_bands,
)
from .change import absorber_stiffness, changed_response, mass_stiffness
from .settings import Change, Prediction, load_prediction


@dataclass(frozen=True)
class Elements:
    """Elements of a change between points.

    Attributes
    ----------
    elongation : elongation of each element by the points' displacements, shape (element, point)
    stiffness : change of its dynamic stiffness, N/m, shape (frequency, element, element)
    """

    elongation: Array
    stiffness: ComplexArray


def points_of(settings: Prediction) -> list[str]:
    """Points that any change acts on, in the order of the file."""
    used: set[str] = set()
    for change in settings.changes.values():
        used.update(*(settings.mounts[name].ends for name in change.mounts))
        used.update(*(mass.points for mass in change.masses.values()))
        used.update(*(absorber.points for absorber in change.absorbers.values()))
    return [name for name in settings.measured.points if name in used]


def elements_of(settings: Prediction, change: Change, frequency_hz: Array) -> Elements:
    """The elements of a change."""
    points = points_of(settings)
    rows, stiffness = [], []
    for name, new in change.mounts.items():
        old = settings.mounts[name]
        rows.append(_row(points, *old.ends))
        along = settings.measured.points[old.ends[0]].direction
        before, after = (mount.dynamic_stiffness(frequency_hz, along) for mount in (old, new))
        stiffness.append(after - before)
    for mass in change.masses.values():
        rows += [_row(points, point) for point in mass.points]
        stiffness += [mass_stiffness(frequency_hz, mass.mass_kg)] * len(mass.points)
    for absorber in change.absorbers.values():
        rows += [_row(points, point) for point in absorber.points]
        absorber_n_per_m = absorber_stiffness(
            frequency_hz,
            absorber.mass_kg,
            absorber.stiffness_n_per_m,
            absorber.loss_factor_ratio,
        )
        stiffness += [absorber_n_per_m] * len(absorber.points)
    matrices = np.einsum("ef,eg->feg", np.array(stiffness), np.eye(len(rows)))
    return Elements(np.array(rows), matrices)


def _row(points: Sequence[str], first: str, second: str = "") -> Array:
    """Elongation: the first point's displacement less the second's."""
    return np.array([float(name == first) - float(name == second) for name in points])


SAMPLES_OF_TRUNCATION: Final = 10


def predict(path: str | Path, despite: Sequence[str] = ()) -> xr.Dataset:
    """Predict levels after changes from measurements alone, with a 90 % band.

    Parameters
    ----------
    path : TOML file with the tables `measured`, `mounts` and `changes`; docs/measured_changes.md
    despite : names of faults of the measurements that are accepted; no bands are stated then

    Returns
    -------
    `predicted_pressure`, `predicted_level` (option, receiver, frequency),
    `predicted_total_level`, `predicted_total_change` (option, receiver, weighting), each level
    with `_low` and `_high`; `truncation` and what it was chosen by. The option `none` is the
    state as measured.

    Raises
    ------
    ParameterError
        Anything in the file or in the files that it names is missing, unknown, or outside its
        range; or the measurements have a fault that is not accepted.
    StorageError
        A file cannot be read.
    SolverError
        The changed structure resonates without damping at a frequency.

    Examples
    --------
    >>> predicted = va.predict("bench/bench.toml")
    >>> predicted["predicted_total_change"].sel(option="softer", weighting="A").round(1).values
    array([-3.8, -3.7])
    """
    path = Path(path)
    settings = load_prediction(path)
    with naming_settings(path):
        bench = assembled(settings, path, despite)
    return _labelled(settings, bench, path)


def assembled(settings: Prediction, path: Path, despite: Sequence[str]) -> Bench:
    """Measurements that the changes of a file need, tested against physics."""
    points = points_of(settings)
    mounts = [each for each in settings.mounts.values() if {*each.ends} <= {*points}]
    ends = [[mount.ends[side] for mount in mounts] for side in (0, 1)] if mounts else []
    return assemble(settings.measured, points, path.parent, ends, despite)


def _changed(bench: Bench, elements: Elements, truncation: float) -> ComplexArray:
    """Sound pressure after a change, shape (receiver, frequency)."""
    by_line = bench.values.T
    signs = bench.sign
    elongation = elements.elongation * signs
    transfer = by_line[:, bench.transfer] @ elongation.T
    compliance = elongation @ by_line[:, bench.compliance] @ elongation.T
    return changed_response(
        by_line[:, bench.pressure],
        transfer,
        compliance,
        by_line[:, bench.response] @ elongation.T,
        elements.stiffness,
        truncation,
    ).T


def _labelled(settings: Prediction, bench: Bench, path: Path) -> xr.Dataset:
    again = measured_again(bench.values, bench.error, settings.measured.draws)
    samples = [replace(bench, values=values) for values in again]
    measured = bench.values[bench.pressure]
    pressures, sampled = (
        [measured],
        [np.array([sample.values[sample.pressure] for sample in samples])],
    )
    truncations, errors = [0.0], [[0.0] * len(TRIED)]
    for change in settings.changes.values():
        elements = elements_of(settings, change, bench.frequency_hz)
        truncation, tried = _truncation(settings, bench, samples, elements)
        truncations.append(truncation)
        errors.append(tried.tolist())
        pressures.append(_changed(bench, elements, truncation))
        sampled.append(np.array([_changed(sample, elements, truncation) for sample in samples]))
    lines = {
        "option": [REFERENCE_OPTION, *settings.changes],
        "receiver": list(settings.measured.microphones),
        "frequency": bench.frequency_hz,
    }
    by_sample = np.stack(sampled, axis=1)
    variables = line_variables(np.array(pressures), by_sample, lines)
    variables |= total_variables(np.array(pressures), by_sample, lines)
    tried_at = {"option": lines["option"], "tried_truncation": list(TRIED)}
    variables["truncation"] = stamp("truncation", truncations, {"option": lines["option"]})
    variables["truncation_error"] = stamp("truncation_error", errors, tried_at)
    about = attributes("predict", path, settings.title, settings, settings.measured)
    about["reference_pressure_pa"] = REFERENCE_PRESSURE_PA
    dataset = without_bands(xr.Dataset(variables, attrs=about), bench.faults)
    return check(label_coordinates(dataset))


def _truncation(
    settings: Prediction, bench: Bench, samples: Sequence[Bench], elements: Elements
) -> tuple[float, Array]:
    """The truncation, given or chosen, and what each tried one makes wrong."""
    tries = [
        lambda share, sample=sample: _changed(sample, elements, share)
        for sample in samples[:SAMPLES_OF_TRUNCATION]
    ]
    errors = truncation_errors(_changed(bench, elements, 0.0), tries)
    stated = settings.measured.truncation_ratio
    return chosen_truncation(errors) if stated is None else stated, errors


def line_variables(
    pressure: ComplexArray, sampled: ComplexArray, coords: Mapping[str, Any]
) -> dict[str, xr.DataArray]:
    """Pressure and level of each line with its band.

    Parameters
    ----------
    pressure : peak, Pa, shape (option, receiver, frequency)
    sampled : samples by measurements with errors, shape (sample, option, receiver, frequency)
    coords : coordinates of these three
    """
    low, high = amplitude_band(pressure, sampled)
    return {
        "predicted_pressure": stamp("predicted_pressure", pressure, coords),
        "predicted_level": stamp("predicted_level", sound_pressure_level(pressure), coords),
        "predicted_level_low": stamp("predicted_level_low", sound_pressure_level(low), coords),
        "predicted_level_high": stamp("predicted_level_high", sound_pressure_level(high), coords),
    }


def total_variables(
    pressure: ComplexArray, sampled: ComplexArray, coords: Mapping[str, Any]
) -> dict[str, xr.DataArray]:
    """Level of all lines and its change against the first option; see `line_variables`."""
    frequency = np.asarray(coords["frequency"])
    coordinates = {
        "option": coords["option"],
        "receiver": coords["receiver"],
        "weighting": list(WEIGHTINGS),
    }
    power, powers = _powers(pressure, frequency), _powers(sampled, frequency)
    ratio, ratios = power / power[:1], powers / powers[:, :1]
    low, high = map(level_of_power, power_band(power, powers))
    change_low, change_high = map(level_of_power, power_band(ratio, ratios))
    change_low[0] = change_high[0] = 0.0  # of the reference against itself
    return {
        "predicted_total_level": stamp("predicted_total_level", level_of_power(power), coordinates),
        "predicted_total_level_low": stamp("predicted_total_level_low", low, coordinates),
        "predicted_total_level_high": stamp("predicted_total_level_high", high, coordinates),
        "predicted_total_change": stamp(
            "predicted_total_change", level_of_power(ratio), coordinates
        ),
        "predicted_total_change_low": stamp("predicted_total_change_low", change_low, coordinates),
        "predicted_total_change_high": stamp(
            "predicted_total_change_high", change_high, coordinates
        ),
    }


def _powers(pressure: ComplexArray, frequency_hz: Array) -> Array:
    """Mean square of all lines re (20 µPa)², by weighting, shape (..., receiver, weighting)."""
    square = np.abs(pressure) ** 2 / 2.0 / REFERENCE_PRESSURE_PA**2
    gains = np.array([power_of_level(WEIGHTING[name](frequency_hz)) for name in WEIGHTINGS])
    return np.asarray(square @ gains.T)
