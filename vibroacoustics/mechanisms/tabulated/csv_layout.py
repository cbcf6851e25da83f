"""Forces over crank angle or by order from a CSV file, and back."""

import json
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Final

import numpy as np
import xarray as xr

from ...base.arrays import Array, ComplexArray
from ...base.column_file import Columns, read_layouts
from ...base.column_head import Layout
from ...base.csv_text import csv_bytes
from ...base.errors import ParameterError
from ...base.vocabulary import REFERENCE_OPTION
from .shaft_axes import axes_lines
from .spectra import COMPONENTS, SMALLEST_STEPS, Spectra, orders_of

VALUES: Final = tuple(f"{name}_{'n' if name[0] == 'f' else 'n_m'}" for name in COMPONENTS)
PHASES: Final = tuple(f"{name}_phase_rad" for name in COMPONENTS)
UNEVEN: Final = 0.01
"""Largest distance of an angle from its place among even ones, in steps, as rounded ones have."""
NOT_PERIODIC: Final = 1e-6
"""Largest step from a revolution's end to its start, relative to the largest value."""
HIGHEST_ORDER: Final = 10_000
ONE_SOURCE: Final = "table"
"""Name of the force where a file names no sources."""

LAYOUTS: Final = (
    Layout(("speed_rpm", "crank_angle_rad", *VALUES), optional_texts=("source",)),
    Layout(("speed_rpm", "order", *VALUES, *PHASES), optional_texts=("source",)),
)

_Groups = dict[tuple[float, str], list[int]]


def read_csv(path: Path) -> Spectra:
    """Columns `speed_rpm`, `crank_angle_deg` or `order`, `source`, force and moment."""
    columns = read_layouts(path, LAYOUTS)
    return _assembled(columns, _of_orders if "order" in columns.numbers else _of_angles)


def _assembled(
    columns: Columns, spectrum_of: Callable[[Columns, list[int]], ComplexArray]
) -> Spectra:
    groups = _groups(columns)
    speeds = tuple(sorted({speed for speed, _ in groups}))
    sources = tuple(dict.fromkeys(source for _, source in groups))
    for speed in speeds:
        for source in sources:
            if (speed, source) not in groups:
                raise ParameterError(
                    f"{columns.path}: {source} has no rows at {speed:g} rpm, as others have"
                )
    spectra = {key: spectrum_of(columns, rows) for key, rows in groups.items()}
    highest = max(spectrum.shape[-1] for spectrum in spectra.values())
    orders = np.zeros((len(speeds), len(sources), len(COMPONENTS), highest), dtype=complex)
    for (speed, source), spectrum in spectra.items():
        case = (speeds.index(speed), sources.index(source))
        orders[case][:, : spectrum.shape[-1]] = spectrum
    return Spectra(speeds, sources, orders)


def _groups(columns: Columns) -> _Groups:
    """Rows by speed and source, in the order of the file."""
    speeds = columns.numbers["speed_rpm"].tolist()
    sources = columns.texts.get("source", (ONE_SOURCE,) * len(speeds))
    groups: _Groups = {}
    for row, key in enumerate(zip(speeds, sources, strict=True)):
        if not key[0] > 0.0:
            raise columns.refusal(row, f"speed_rpm = {key[0]:g} rpm: must be above 0")
        if not key[1]:
            raise columns.refusal(row, "source: is missing")
        groups.setdefault(key, []).append(row)
    return groups


def _of_angles(columns: Columns, rows: list[int]) -> ComplexArray:
    """Orders of one source at one speed, shape (component, order)."""
    degrees = np.degrees(columns.numbers["crank_angle_rad"])
    ordered = np.array(rows)[np.argsort(degrees[rows], kind="stable")]
    values = np.stack([columns.numbers[name][ordered] for name in VALUES])
    angles = degrees[ordered]
    twice = np.flatnonzero(np.diff(angles) == 0.0)
    if twice.size:
        row = int(ordered[twice[0] + 1])
        raise columns.refusal(row, f"crank_angle_deg = {angles[twice[0]]:g}: is given twice")
    if np.isclose(angles[-1], 360.0, rtol=0.0, atol=1e-6) and angles.size > 1:
        _check_closed(columns, int(ordered[-1]), values)
        angles, values = angles[:-1], values[:, :-1]
    even = 360.0 * np.arange(angles.size) / angles.size
    uneven = np.flatnonzero(np.abs(angles - even) > UNEVEN * 360.0 / angles.size)
    if angles.size < SMALLEST_STEPS or uneven.size:
        uneven_row = int(uneven[0]) if uneven.size else 0
        raise columns.refusal(
            int(ordered[uneven_row]),
            f"crank_angle_deg = {angles[uneven_row]:g}: {angles.size} angles must be even over a "
            f"revolution from 0, in steps of {360.0 / angles.size:g}, at least {SMALLEST_STEPS}",
        )
    return orders_of(values)


def _check_closed(columns: Columns, row: int, values: Array) -> None:
    """A row at 360° repeats the one at zero."""
    jump = np.abs(values[:, -1] - values[:, 0]) - NOT_PERIODIC * np.abs(values).max(axis=1)
    if np.any(jump > 0.0):
        name, column = VALUES[int(np.argmax(jump))], int(np.argmax(jump))
        raise columns.refusal(
            row,
            f"{name} = {values[column, -1]:g} at 360°, {values[column, 0]:g} at 0°: "
            "is not periodic",
        )


def _of_orders(columns: Columns, rows: list[int]) -> ComplexArray:
    """Orders of one source at one speed, zero where the file has none, (component, order)."""
    orders = columns.numbers["order"]
    numbers: set[float] = set()
    for row in rows:
        number = float(orders[row])
        if not (number.is_integer() and 0.0 <= number <= HIGHEST_ORDER):
            raise columns.refusal(row, f"order = {number:g}: must be a whole number from 0")
        if number in numbers:
            raise columns.refusal(row, f"order = {number:g}: is given twice")
        numbers.add(number)
    values = np.zeros((len(COMPONENTS), int(orders[rows].max()) + 1), dtype=complex)
    for component, (value, phase) in enumerate(zip(VALUES, PHASES, strict=True)):
        peaks = columns.numbers[value][rows] * np.exp(1j * columns.numbers[phase][rows])
        values[component, orders[rows].astype(int)] = peaks
    values[:, 0] = values[:, 0].real
    return values


def forces_csv(results: xr.Dataset, option: str = REFERENCE_OPTION) -> bytes:
    """Orders of force and moment of a run's results, as a table by order.

    Remarks above it hold the table `[shaft_axes]` that the machine file needs. Sources that make no
    force under the option are omitted.

    Parameters
    ----------
    results : results of `run`
    option : by name
    """
    dims = ("speed", "source", "order", "axis")
    force, moment = (
        results[name].sel(option=option).transpose(*dims).fillna(0.0)
        for name in ("force_order", "moment_order")
    )
    peaks = np.concatenate([force.values, moment.values], axis=-1)
    table = orders_csv(
        (float(speed), int(order), str(source), peaks[s, n, k])
        for s, speed in enumerate(force["speed"].values)
        for n, source in enumerate(force["source"].values)
        if np.any(peaks[:, n])
        for k, order in enumerate(force["order"].values)
    )
    return _axes_remarks(results, option).encode() + table


def _axes_remarks(results: xr.Dataset, option: str) -> str:
    """Remarks with the axes of the shaft for a machine file; empty where the results lack them."""
    frames = json.loads(results.attrs.get("crank_frames", "{}"))
    if option not in frames:
        return ""
    lines = axes_lines(frames[option], "derived: by vibroacoustics.export_forces")
    return "".join(f"# {line}\n" for line in ["For the machine file:", *lines])


def orders_csv(rows: Iterable[tuple[float, int, str, ComplexArray]]) -> bytes:
    """A table by order of speed, order, source and complex peaks of force and moment."""
    head = ["speed_rpm", "order", "source"]
    for value, phase in zip(VALUES, PHASES, strict=True):
        head += [value, phase.replace("_rad", "_deg")]
    return csv_bytes(head, ([*row[:3], *_amplitude_and_phase(row[3])] for row in rows))


def _amplitude_and_phase(peaks: ComplexArray) -> list[float]:
    pairs = np.stack([np.abs(peaks), np.degrees(np.angle(peaks))], axis=-1)
    return [float(value) for value in pairs.ravel()]
