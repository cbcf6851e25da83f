"""Forces from results of a run and from recordings, such as UFF files."""

import warnings
from pathlib import Path
from typing import TYPE_CHECKING, Final

import numpy as np

from ...base.arrays import Array, ComplexArray, IndexArray
from ...base.errors import ParameterError, StorageError
from ...base.heaps import check_heaps
from ...base.regular_file import read_bytes
from ...base.units import shaft_frequency_hz
from ...base.vocabulary import REFERENCE_OPTION
from .csv_layout import ONE_SOURCE
from .spectra import COMPONENTS, Spectra, orders_of

MAXIMUM_BYTES: Final = 2**31
"""Size of results, which are read as a whole."""
MISSED_REVOLUTION: Final = 1e-3
"""Largest part of a revolution by which a recording misses whole ones."""
if TYPE_CHECKING:
    from ...recordings.measured_function import MeasuredFunction
TIME: Final = 1
"""Function type of a time history."""
OFF_ORDER: Final = 1e-3
"""Largest distance of a frequency from a whole order."""


def read_results(path: Path) -> Spectra:
    """Orders of force and moment without an option, from the results of a run, `results.nc`.

    Raises
    ------
    ParameterError
        The file is none, or has no forces.
    """
    import xarray as xr

    try:
        content = read_bytes(path, MAXIMUM_BYTES)
        check_heaps(content)
        with xr.load_dataset(content, engine="netcdf4") as file:
            none = file.sel(option=REFERENCE_OPTION)
            parts = [_joined(none, name) for name in ("force_order", "moment_order")]
            speeds = tuple(float(speed) for speed in file["speed"].values)
            sources = tuple(str(source) for source in file["source"].values)
    except FileNotFoundError:
        raise ParameterError(f"{path}: no such file") from None
    except StorageError as error:
        raise ParameterError(f"{path}: {error}") from None
    except (KeyError, OSError, ValueError):
        raise ParameterError(f"{path}: holds no force_order and moment_order of a run") from None
    orders = np.concatenate(parts, axis=2)
    rising = np.argsort(speeds)
    acting = np.flatnonzero(np.any(orders, axis=(0, 2, 3)))
    return Spectra(
        tuple(speeds[row] for row in rising),
        tuple(sources[row] for row in acting),
        orders[rising][:, acting],
    )


def _joined(file, name: str) -> ComplexArray:  # type: ignore[no-untyped-def]
    """A complex variable of which the file holds both parts, (speed, source, axis, order)."""
    dims = ("speed", "source", "axis", "order")
    real, imaginary = (
        file[f"{name}_{part}"].transpose(*dims).fillna(0.0).values for part in ("re", "im")
    )
    return np.asarray(real + 1j * imaginary)


def read_recorded(path: Path, speed_rpm: float | None) -> Spectra:
    """Force and moment over time of whole revolutions, channels `SOURCE fx` to `SOURCE mz`.

    Channels that the file does not have are zero. Several revolutions are averaged.

    Parameters
    ----------
    path : UFF, or any other file that `read_recording` reads
    speed_rpm : at which it was recorded

    Raises
    ------
    ParameterError
        The speed is missing, a channel has another name or unit, the revolutions are not whole.
    """
    from ...recordings import read_recording
    from ...recordings.remarks import SuspectWarning

    if speed_rpm is None:
        raise ParameterError(f"{path}: recorded_speed_rpm is missing, at which it was recorded")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", SuspectWarning)  # a component may be zero
            recording = read_recording(path)
    except StorageError as error:
        raise ParameterError(*error.args) from None
    signal, rate_hz = recording["signal"], float(recording.attrs["sample_rate_hz"])
    units = [str(unit) for unit in signal["channel_unit"].values]
    revolutions = _revolutions(path, signal.sizes["time"] / rate_hz, speed_rpm)
    by_source: dict[str, dict[str, Array]] = {}
    for name, unit, samples in zip(signal["channel"].values, units, signal.values, strict=True):
        source, component = _meant(path, str(name), unit)
        by_source.setdefault(source, {})[component] = samples
    still = np.zeros(signal.sizes["time"])
    over_time = np.array(
        [[parts.get(name, still) for name in COMPONENTS] for parts in by_source.values()]
    )
    orders = orders_of(over_time)[None, ..., ::revolutions]
    return Spectra((speed_rpm,), tuple(by_source), orders)


def _revolutions(path: Path, duration_s: float, speed_rpm: float) -> int:
    turns = duration_s * shaft_frequency_hz(speed_rpm)
    if round(turns) < 1 or abs(turns - round(turns)) > MISSED_REVOLUTION:
        raise ParameterError(
            f"{path}: {turns:.6g} revolutions at {speed_rpm:g} rpm: must be whole ones"
        )
    return round(turns)


def _meant(path: Path, channel: str, unit: str) -> tuple[str, str]:
    """Source and component of a channel."""
    source, _, component = channel.replace("_", " ").rpartition(" ")
    component = component.lower()
    needed = "N" if component[:1] == "f" else "N m"
    if component not in COMPONENTS or unit != needed:
        raise ParameterError(
            f"{path}: channel {channel} [{unit}]: must be SOURCE fx, fy, fz [N], mx, my, mz [N m]"
        )
    return source.replace(" ", "_") or ONE_SOURCE, component


def holds_spectra(path: Path) -> bool:
    """Whether a universal file has no time history; also false where it cannot be read."""
    from ...recordings.uff58 import datasets

    try:
        with path.open("rb") as file:
            every = datasets(file).functions
    except (OSError, ParameterError, StorageError):
        return False
    return bool(every) and all(header.function_type != TIME for header in every)


def read_spectra(path: Path, speed_rpm: float) -> Spectra:
    """Complex peaks at whole orders; every node is a source, what is not there is zero.

    Forces are along `x`, `y`, `z`, moments about `rx`, `ry`, `rz` of their node.

    Parameters
    ----------
    path : universal file
    speed_rpm : at which it holds

    Raises
    ------
    ParameterError
        It cannot be read, holds no such spectrum, or a frequency is no whole order.
    """
    from ...recordings.functions import read_functions

    try:
        functions = read_functions(path)
    except StorageError as error:
        raise ParameterError(*error.args) from None
    parts: dict[str, dict[str, tuple[IndexArray, ComplexArray]]] = {}
    for function in functions:
        if function.kind == "spectrum" and function.response_unit in ("N", "N m"):
            try:
                component, order = _component(function), _orders(function, speed_rpm)
            except ParameterError as error:
                raise ParameterError(f"{path}: {function}: {error}") from None
            components = parts.setdefault(str(function.response.number), {})
            if component in components:
                raise ParameterError(f"{path}: {function}: is there twice")
            sign = -1.0 if function.response.direction[0] == "-" else 1.0
            components[component] = order, sign * function.values
    if not parts:
        raise ParameterError(f"{path}: holds no spectrum in N or N m")
    highest = max(int(order.max()) for of in parts.values() for order, _ in of.values())
    orders = np.zeros((1, len(parts), len(COMPONENTS), highest + 1), dtype=complex)
    for row, of_source in enumerate(parts.values()):
        for component, (order, values) in of_source.items():
            orders[0, row, COMPONENTS.index(component), order] = values
    return Spectra((speed_rpm,), tuple(parts), orders)


def _component(function: "MeasuredFunction") -> str:
    axis = function.response.direction
    component = f"{'m' if axis[1:2] == 'r' else 'f'}{axis[-1:]}"
    if component not in COMPONENTS or (component[0] == "m") != (function.response_unit == "N m"):
        raise ParameterError(
            f"unit {function.response_unit}: must be N along x, y, z or N m about rx, ry, rz"
        )
    return component


def _orders(function: "MeasuredFunction", speed_rpm: float) -> IndexArray:
    order = function.frequency_hz / shaft_frequency_hz(speed_rpm)
    off = np.abs(order - np.rint(order))
    if off.max() > OFF_ORDER:
        row = int(off.argmax())
        raise ParameterError(
            f"{function.frequency_hz[row]:g} Hz is order {order[row]:.4g} at {speed_rpm:g} rpm: "
            "must be a whole order"
        )
    return np.rint(order).astype(np.intp)
