"""Blocked forces of a source where it stands, with validation, labelled; at shaft orders too."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np
import xarray as xr

from ..base.arrays import Array, ComplexArray
from ..base.decibel import level_of_amplitude
from ..base.errors import ParameterError
from ..base.units import shaft_frequency_hz
from ..base.vocabulary import check, label_coordinates
from ..mechanisms.tabulated.csv_layout import orders_csv
from .band import (
    TRIED,
    attributes,
    chosen_truncation,
    measured_again,
    naming_settings,
    without_bands,
)
from .blocked_variables import force_variables, inversion_variables, validation_variables
from .in_situ import (
    BlockedForces,
    InSitu,
    Measurement,
    load_blocked_forces,
    read_in_situ,
    unit_of,
    wrench_per_force,
)
from .inversion import condition_number, inverted_forces, left_out_responses

ON_ORDER: Final = 0.01
"""Largest distance of a line from an order, in orders."""
SOURCE: Final = "blocked_forces"


def blocked_orders_csv(blocked: xr.Dataset) -> bytes | None:
    """Return force and moment by order as CSV for a machine by table; None without a speed.

    Raises
    ------
    ParameterError
        No line is an order of the speed.
    """
    speed = blocked.attrs.get("speed_rpm")
    if speed is None:
        return None
    force = blocked["blocked_force_sum"].values
    peaks = np.concatenate([force, blocked["blocked_moment_sum"].values])
    shaft_hz = shaft_frequency_hz(float(speed))
    order = blocked["frequency"].values / shaft_hz
    lines = np.flatnonzero((np.abs(order - np.rint(order)) <= ON_ORDER) & (order > 0.5))
    numbers = np.rint(order[lines]).astype(int)
    if len(lines) == 0 or len(set(numbers.tolist())) < len(numbers):
        count = "no line is" if len(lines) == 0 else "several lines are"
        raise ParameterError(
            f"blocked_forces.speed_rpm = {speed:g} rpm: {count} within {ON_ORDER:g} of an order, "
            f"a multiple of {shaft_hz:g} Hz; give operating spectra at the orders"
        )
    return orders_csv(
        (float(speed), int(number), SOURCE, peaks[:, line])
        for number, line in zip(numbers, lines, strict=True)
    )


@dataclass(frozen=True)
class Inverted:
    """Forces and what they make at the validation.

    Attributes
    ----------
    force : along each set of forces, N, shape (frequency, set)
    predicted : m or Pa, shape (frequency, validation)
    measured : responses while the source ran, shape (frequency, validation)
    """

    force: ComplexArray
    predicted: ComplexArray
    measured: ComplexArray


def blocked_forces(path: str | Path, despite: Sequence[str] = ()) -> xr.Dataset:
    """Blocked forces of a source from operating responses and frequency responses (ISO 20270).

    Parameters
    ----------
    path : TOML file with the tables `measured` and `blocked_forces`; docs/blocked_forces.md
    despite : names of faults of the measurements that are accepted; no bands are stated then

    Returns
    -------
    `blocked_force` (force_point, frequency) with `_low` and `_high`, the limits of a 90 % band;
    with positions their sum `blocked_force_sum` and moment `blocked_moment_sum` (axis,
    frequency); `condition_number`; `inversion_truncation` and the `left_out_error` that it was
    chosen by; the validation at responses that the inversion did not use, line by line
    `validation_measured`, `validation_predicted` and `validation_difference`, in third octaves
    `validation_band_difference` and others

    Raises
    ------
    ParameterError
        Anything in the file or in the files that it names is missing, unknown, or outside its
        range; there are fewer responses than forces; or the measurements have a fault that is not
        accepted.
    StorageError
        A file cannot be read.

    Examples
    --------
    >>> blocked = va.blocked_forces("in_situ/in_situ.toml")
    >>> bool(abs(blocked["validation_band_difference"]).max() < 1.0)
    True
    """
    path = Path(path)
    settings = load_blocked_forces(path)
    with naming_settings(path):
        bench = read_in_situ(settings, path.parent, despite)
        _check_determined(bench)
    return _labelled(settings, bench, path)


def _check_determined(bench: InSitu) -> None:
    responses, sets = len(bench.responses), bench.sets.shape[1]
    if responses < sets:
        raise ParameterError(
            f"blocked_forces.responses: {responses} for {sets} forces: must be at least as many"
        )


def _inverted(measurement: Measurement, truncation: float) -> Inverted:
    force = inverted_forces(measurement.operating, measurement.compliance, truncation)
    predicted = (measurement.transfer @ force[..., None])[..., 0]
    return Inverted(force, predicted, measurement.validation)


def _truncation(settings: BlockedForces, measurement: Measurement) -> tuple[float, Array]:
    """The truncation, given or chosen, and what each tried one makes wrong; see docs."""
    stated = settings.measured.truncation_ratio
    rows, columns = measurement.compliance.shape[1:]
    if rows == columns:  # without one response the others do not determine the forces
        return stated or 0.0, np.full(len(TRIED), np.nan)
    made = left_out_responses(measurement.operating, measurement.compliance, TRIED)
    levels = level_of_amplitude(np.abs(made)) - level_of_amplitude(np.abs(measurement.operating))
    errors = np.abs(levels).mean(axis=(1, 2))
    return chosen_truncation(errors) if stated is None else stated, errors


def _labelled(settings: BlockedForces, bench: InSitu, path: Path) -> xr.Dataset:
    measurement = bench.measurement(bench.values)
    truncation, errors = _truncation(settings, measurement)
    again = measured_again(bench.values, bench.error, settings.measured.draws)
    samples = [_inverted(bench.measurement(values), truncation) for values in again]
    result, interface = _inverted(measurement, truncation), settings.blocked_forces
    frequency = {"frequency": bench.frequency_hz}
    variables = force_variables(
        result.force @ bench.sets.T,
        np.stack([sample.force for sample in samples]) @ bench.sets.T,
        {"force_point": list(interface.points), **frequency},
        wrench_per_force(settings) if settings.needs_positions else None,
    )
    variables |= inversion_variables(
        condition_number(measurement.compliance), truncation, errors, bench.frequency_hz
    )
    units = [unit_of(settings, name) for name in interface.validation]
    variables |= validation_variables(
        result.predicted,
        result.measured,
        np.array([sample.predicted for sample in samples]),
        np.array([sample.measured for sample in samples]),
        units,
        {"validation_point": list(interface.validation), **frequency},
    )
    about = attributes("blocked-forces", path, settings.title, settings, settings.measured)
    if interface.speed_rpm is not None:
        about["speed_rpm"] = interface.speed_rpm
    dataset = without_bands(xr.Dataset(variables, attrs=about), bench.faults)
    return check(label_coordinates(dataset))
