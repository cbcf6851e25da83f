"""Several recordings of a machine as one: runs of one or of several specimens."""

import json
from collections.abc import Mapping, Sequence
from typing import Any, Final

import numpy as np
import xarray as xr

from ..base.arrays import Array, ComplexArray
from ..base.decibel import amplitude_of_level, level_of_amplitude
from ..base.errors import ParameterError
from ..base.plain_bytes import canonical_json
from ..base.vocabulary import NO_ANGLE_ZERO, check, label_coordinates, stamp, stamped
from .order_comparison import (
    ORDER_TOLERANCE,
    branch_of_points,
    channel_units,
    common_orders,
    common_points,
    values_at,
)
from .scatter import Scatter, by_specimen, scatter

RUNS: Final = "runs"
"""Attribute that lists file, specimen, speed and remarks of every run, as JSON."""
OMITTED: Final = "omitted"
"""Attribute with the reason by file of every recording that is omitted, as JSON."""
LEVELS: Final = {"equivalent_level": "equivalent", "band_level": "band"}
_PARTS: Final = ("run_deviation", "specimen_deviation", "mean_uncertainty", "mean_interval")
_OF_ONE_FILE: Final = (
    "source_sha256", "part_sha256", "part_start_s", "start_time", "reading_remarks",
    "speed_source", "jitter", "tacho_faults",
)  # fmt: skip


def mean_of_runs(
    runs: Sequence[xr.Dataset], specimens: Sequence[str] = (), labels: Sequence[str] = ()
) -> xr.Dataset:
    """Energy mean of the orders and levels of several recordings, with their scatter.

    Parameters
    ----------
    runs : results of `analyse_orders`, at speeds that all have within 2 %
    specimens : name of the machine of each run; without, all are of one
    labels : name of each run, each once; default: its file, with a number where several have one

    Returns
    -------
    as of `analyse_orders`, of the channels, orders, speeds (of the first run) and bands that all
    have: `channel_order_rms` and peaks are energy means, phases those of the mean phasor,
    coherence the lowest. `order_run_deviation`, `order_specimen_deviation`,
    `order_mean_uncertainty` and `order_mean_interval` (half width, 95 %), dB; likewise for
    `equivalent` levels and every `band`. Each run has `run_order_rms`, `run_equivalent_level`,
    …, each machine `machine_order_rms`, `machine_order_deviation`, …

    Raises
    ------
    ParameterError
        A result is of no recording, the specimens or labels are not as many, or the runs have no
        channel, order or speed in common.

    Examples
    --------
    >>> orders = va.open_results("orders.nc")
    >>> mean = va.mean_of_runs([orders, orders, orders], ["a", "a", "b"])
    >>> float(mean["order_mean_uncertainty"].max())
    0.0
    """
    names = list(specimens) or ["1"] * len(runs)
    named = list(labels) or _files_apart(runs)
    for what, texts in (("specimens", names), ("labels", named)):
        if len(texts) != len(runs):
            raise ParameterError(f"{what}: {len(texts)} for {len(runs)} runs: must be as many")
    for run in runs:
        if "channel_order" not in run:
            title = run.attrs.get("title", "result")
            raise ParameterError(f"{title}: is of no recording; only recordings are averaged")
    selections = _selections(runs)
    peaks, rms, coherence = (
        np.array(
            [
                values_at(run[name], selection)
                for run, selection in zip(runs, selections, strict=True)
            ]
        )
        for name in ("channel_order", "channel_order_rms", "channel_order_coherence")
    )
    level_db = level_of_amplitude(rms)
    of_orders, (of_machine, deviation) = scatter(level_db, names), by_specimen(level_db, names)
    values = {
        "channel_order": _mean_phasor(peaks, names),
        "channel_order_rms": amplitude_of_level(of_orders.mean),
        "channel_order_coherence": coherence.min(axis=0),
        **_named("order", of_orders),
        "run_order": peaks,
        "run_order_rms": rms,
        "run_speed": np.array(
            [
                run["speed"].values[selection["speed"]]
                for run, selection in zip(runs, selections, strict=True)
            ]
        ),
        "machine_order_rms": amplitude_of_level(of_machine),
        "machine_order_deviation": deviation,
    }
    machines = list(dict.fromkeys(names))
    points = selections[0]["speed"]
    speeds = runs[0]["speed"].values[points]
    coords = {**selections[0], "speed": speeds, "run": named, "machine": machines}
    units = channel_units(runs[0])
    further = {
        "channel_unit": ("channel", [units[name] for name in selections[0]["channel"]]),
        "run_machine": ("run", names),
        "run_file": ("run", list(map(_file, runs))),
        "machine_runs": ("machine", list(map(names.count, machines))),
    }
    if "branch" in runs[0].coords:
        further["branch"] = ("speed", branch_of_points(runs[0])[points].tolist())
    result = stamped(values, coords).assign_coords(further)
    result = result.merge(_levels(runs, coords, names))
    result.attrs = _attributes(runs, names)
    return check(label_coordinates(result))


def with_scatter(compared: xr.Dataset, mean: xr.Dataset) -> xr.Dataset:
    """Compared orders with the scatter of the second result, where it is of several runs."""
    same = mean["speed"].values == compared["compared_speed"].values[:, None]
    branch, of_mean = branch_of_points(compared), branch_of_points(mean)
    if "branch" in mean.coords and set(branch) & set(of_mean):
        same &= branch[:, None] == of_mean
    chosen = {
        "channel": compared["compared_channel"].values,
        "speed": same.argmax(axis=1),
        "order": compared["order"].values,
    }
    here = {name: compared[name].values for name in chosen}
    names = [f"order_{part}" for part in _PARTS]
    if names[0] not in mean:
        return compared
    return compared.assign(
        {name: stamp(name, values_at(mean[name], chosen), here) for name in names}
    ).assign_attrs({RUNS: mean.attrs[RUNS]})


def runs_of(result: xr.Dataset) -> list[dict[str, str]]:
    """File and specimen of each run; none of a single result."""
    return list(json.loads(result.attrs.get(RUNS, "[]")))


def omitted_of(result: xr.Dataset) -> dict[str, str]:
    """Reason by file of each recording that the mean omits."""
    return dict(json.loads(result.attrs.get(OMITTED, "{}")))


def _selections(runs: Sequence[xr.Dataset]) -> list[dict[str, Any]]:
    """Channels, positions of speeds, and orders that all runs have, as each run has them."""
    first = runs[0]
    units = [channel_units(run).items() for run in runs]
    common = [name for name, unit in units[0] if all((name, unit) in other for other in units)]
    if not common:
        raise ParameterError("the recordings have no channel of one name and unit in common")
    orders = np.asarray(first["order"].values, dtype=float)
    points, problems = [], []
    for run in runs:
        try:
            off = np.abs(orders[:, None] - common_orders(first, run))
            points.append(dict(common_points(first, run).tolist()))
        except ParameterError as error:
            problems.append(f"{_file(run)}: {error}")
            continue
        orders = orders[off.min(axis=1) < ORDER_TOLERANCE]
    if problems:
        raise ParameterError(*problems)
    if not orders.size:
        raise ParameterError("the recordings have no order in common")
    shared = [point for point in points[0] if all(point in of_run for of_run in points)]
    if not shared:
        raise ParameterError("the recordings have no speed in common")
    return [
        {"channel": common, "speed": [of_run[point] for point in shared], "order": orders}
        for of_run in points
    ]


def _mean_phasor(peaks: ComplexArray, names: Sequence[str]) -> ComplexArray:
    """Energy mean of the sizes, phase of the mean phasor."""
    size = amplitude_of_level(scatter(level_of_amplitude(np.abs(peaks)), names).mean)
    return np.asarray(size * np.exp(1j * np.angle(peaks.mean(axis=0))))


def _levels(
    runs: Sequence[xr.Dataset], coords: Mapping[str, Any], names: Sequence[str]
) -> xr.Dataset:
    """Levels of sound pressure, where all runs have some."""
    levels = xr.Dataset()
    for variable, short in LEVELS.items():
        if not all(variable in run for run in runs):
            continue
        chosen = (run[variable].sel(channel=coords["channel"]) for run in runs)
        aligned = xr.align(*chosen, join="inner")
        first, stacked = aligned[0], np.array([run_values.values for run_values in aligned])
        of_levels = _scatter_of_known(stacked, names)
        of_machine, deviation = by_specimen(stacked, names)
        values = {
            variable: of_levels.mean,
            **_named(short, of_levels),
            f"run_{variable}": stacked,
            f"machine_{variable}": of_machine,
            f"machine_{short}_deviation": deviation,
        }
        here = {str(dim): first[dim].values for dim in first.dims}
        levels = levels.merge(stamped(values, {**coords, **here}))
    return levels


def _scatter_of_known(level_db: Array, names: Sequence[str]) -> Scatter:
    """Scatter where all runs have a level; channels that are no sound pressure have none."""
    is_finite = np.isfinite(level_db).all(axis=0)
    filled = []
    for values in scatter(level_db[:, is_finite], names):
        row = np.full(level_db.shape[1:], np.nan)
        row[is_finite] = values
        filled.append(row)
    return Scatter(*filled)


def _named(short: str, of_levels: Scatter) -> dict[str, Array]:
    return {f"{short}_{part}": values for part, values in zip(_PARTS, of_levels[1:], strict=True)}


def _file(run: xr.Dataset) -> str:
    return str(run.attrs.get("source_file", "recording"))


def _files_apart(runs: Sequence[xr.Dataset]) -> list[str]:
    """Files of the runs, numbered where several have one name."""
    files = list(map(_file, runs))
    return [
        file if files.count(file) == 1 else f"{file} ({files[:number].count(file) + 1})"
        for number, file in enumerate(files)
    ]


def _attributes(runs: Sequence[xr.Dataset], names: Sequence[str]) -> dict[str, Any]:
    zeros = {str(run.attrs.get("angle_zero", NO_ANGLE_ZERO)) for run in runs}
    count = len(dict.fromkeys(names))
    what = f"mean of {len(runs)} recordings of {count} machine{'s' * (count != 1)}"
    kept = {"sha256": "source_sha256", "speed": "speed_source", "remarks": "reading_remarks"}
    sources = [
        {"file": _file(run), "specimen": name}
        | {key: str(run.attrs[attr]) for key, attr in kept.items() if attr in run.attrs}
        for run, name in zip(runs, names, strict=True)
    ]
    shared = {key: value for key, value in runs[0].attrs.items() if key not in _OF_ONE_FILE}
    return {
        **shared,
        "title": f"Orders, {what}",
        "source_file": what,
        "angle_zero": NO_ANGLE_ZERO if NO_ANGLE_ZERO in zeros else sorted(zeros)[0],
        RUNS: canonical_json(sources),
    }
