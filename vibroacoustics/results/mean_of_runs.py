"""Several recordings of a machine as one: runs of one or of several specimens."""

import json
from collections.abc import Sequence
from typing import Any, Final

import numpy as np
import xarray as xr

from ..base.arrays import Array, ComplexArray
from ..base.decibel import amplitude_of_level, level_of_amplitude
from ..base.errors import ParameterError
from ..base.hashing import canonical_json
from ..base.vocabulary import NO_ANGLE_ZERO, check, label_coordinates, stamp
from .order_comparison import (
    ORDER_TOLERANCE,
    channel_units,
    common_orders,
    common_speeds,
    values_at,
)
from .scatter import Scatter, scatter

RUNS: Final = "runs"
"""Attribute that lists file and specimen of every run, as JSON."""
LEVELS: Final = {"equivalent_level": "equivalent", "band_level": "band"}
_PARTS: Final = ("run_deviation", "specimen_deviation", "mean_uncertainty")


def mean_of_runs(runs: Sequence[xr.Dataset], specimens: Sequence[str] = ()) -> xr.Dataset:
    """Energy mean of the orders and levels of several recordings, with their scatter.

    Parameters
    ----------
    runs : of `analyse_orders`, at speeds that all have within 2 %
    specimens : name of the machine of each run; without, all are of one

    Returns
    -------
    as of `analyse_orders`, of the channels, orders, speeds (of the first run) and bands that all
    have: `channel_order_rms` and peaks are energy means, phases those of the mean phasor,
    coherence the lowest. `order_run_deviation`, `order_specimen_deviation` and
    `order_mean_uncertainty`, dB, and the same of `equivalent` levels and of every `band`

    Raises
    ------
    ParameterError
        A result is of no recording, the specimens are not as many, or the runs have no channel,
        order or speed in common.

    Examples
    --------
    >>> orders = va.open_results("orders.nc")
    >>> mean = va.mean_of_runs([orders, orders, orders], ["a", "a", "b"])
    >>> float(mean["order_mean_uncertainty"].max())
    0.0
    """
    names = list(specimens) or ["1"] * len(runs)
    if len(names) != len(runs):
        raise ParameterError(f"specimens: {len(names)} for {len(runs)} runs: must be as many")
    for run in runs:
        if "channel_order" not in run:
            title = run.attrs.get("title", "result")
            raise ParameterError(f"{title}: is of no recording; only recordings are averaged")
    at = [_selection(runs, run) for run in runs]
    peaks, rms, coherence = (
        np.array([values_at(run[name], there) for run, there in zip(runs, at, strict=True)])
        for name in ("channel_order", "channel_order_rms", "channel_order_coherence")
    )
    of_orders = scatter(level_of_amplitude(rms), names)
    mean = {
        "channel_order": _mean_phasor(peaks, names),
        "channel_order_rms": amplitude_of_level(of_orders.mean),
        "channel_order_coherence": coherence.min(axis=0),
        **_named("order", of_orders),
    }
    labelled = {name: stamp(name, values, at[0]) for name, values in mean.items()}
    units = channel_units(runs[0])
    coords = {"channel_unit": ("channel", [units[name] for name in at[0]["channel"]])}
    result = xr.Dataset(labelled, coords=coords).merge(_levels(runs, at[0]["channel"], names))
    result.attrs = _attributes(runs, names)
    return check(label_coordinates(result))


def with_scatter(compared: xr.Dataset, mean: xr.Dataset) -> xr.Dataset:
    """Compared orders with the scatter of the second result, where it is of several runs."""
    there = {
        "channel": compared["compared_channel"].values,
        "speed": compared["compared_speed"].values,
        "order": compared["order"].values,
    }
    here = {name: compared[name].values for name in there}
    names = [f"order_{part}" for part in _PARTS]
    if names[0] not in mean:
        return compared
    return compared.assign(
        {name: stamp(name, values_at(mean[name], there), here) for name in names}
    ).assign_attrs({RUNS: mean.attrs[RUNS]})


def runs_of(result: xr.Dataset) -> list[dict[str, str]]:
    """File and specimen of each run; none of a single result."""
    return list(json.loads(result.attrs.get(RUNS, "[]")))


def _selection(runs: Sequence[xr.Dataset], run: xr.Dataset) -> dict[str, Any]:
    """Channels, speeds and orders of one run that all have."""
    first = runs[0]
    units = [channel_units(one).items() for one in runs]
    common = [name for name, unit in units[0] if all((name, unit) in other for other in units)]
    if not common:
        raise ParameterError("the recordings have no channel of one name and unit in common")
    orders = np.asarray(first["order"].values, dtype=float)
    for one in runs:
        off = np.abs(orders[:, None] - common_orders(first, one))
        orders = orders[off.min(axis=1) < ORDER_TOLERANCE]
    if not orders.size:
        raise ParameterError("the recordings have no order in common")
    speeds = [dict(common_speeds(first, one).tolist()) for one in runs]
    shared = [speed for speed in speeds[0] if all(speed in of_run for of_run in speeds)]
    if not shared:
        raise ParameterError("the recordings have no speed in common")
    of_run = dict(common_speeds(first, run).tolist())
    return {"channel": common, "speed": [of_run[one] for one in shared], "order": orders}


def _mean_phasor(peaks: ComplexArray, names: Sequence[str]) -> ComplexArray:
    """Energy mean of the sizes, phase of the mean phasor."""
    size = amplitude_of_level(scatter(level_of_amplitude(np.abs(peaks)), names).mean)
    return np.asarray(size * np.exp(1j * np.angle(peaks.mean(axis=0))))


def _levels(runs: Sequence[xr.Dataset], channels: list[str], names: Sequence[str]) -> xr.Dataset:
    """Levels of sound pressure, where all runs have some."""
    levels = xr.Dataset()
    for variable, short in LEVELS.items():
        if not all(variable in run for run in runs):
            continue
        aligned = xr.align(*(run[variable].sel(channel=channels) for run in runs), join="inner")
        first, stacked = aligned[0], np.array([one.values for one in aligned])
        of_levels = _scatter_of_known(stacked, names)
        coords = {str(dim): first[dim].values for dim in first.dims}
        levels[variable] = stamp(variable, of_levels.mean, coords)
        for name, values in _named(short, of_levels).items():
            levels[name] = stamp(name, values, coords)
    return levels


def _scatter_of_known(level_db: Array, names: Sequence[str]) -> Scatter:
    """Scatter where all runs have a level; channels that are no sound pressure have none."""
    known = np.isfinite(level_db).all(axis=0)
    filled = []
    for values in scatter(level_db[:, known], names):
        one = np.full(level_db.shape[1:], np.nan)
        one[known] = values
        filled.append(one)
    return Scatter(*filled)


def _named(short: str, of_levels: Scatter) -> dict[str, Array]:
    return {f"{short}_{part}": values for part, values in zip(_PARTS, of_levels[1:], strict=True)}


def _attributes(runs: Sequence[xr.Dataset], names: Sequence[str]) -> dict[str, Any]:
    files = [str(run.attrs.get("source_file", "recording")) for run in runs]
    zeros = {str(run.attrs.get("angle_zero", NO_ANGLE_ZERO)) for run in runs}
    count = len(dict.fromkeys(names))
    what = f"mean of {len(runs)} recordings of {count} specimen{'s' * (count != 1)}"
    known = [{"file": file, "specimen": name} for file, name in zip(files, names, strict=True)]
    return {
        **runs[0].attrs,
        "title": f"Orders, {what}",
        "source_file": what,
        "angle_zero": NO_ANGLE_ZERO if NO_ANGLE_ZERO in zeros else sorted(zeros)[0],
        RUNS: canonical_json(known),
    }
