"""Analysis of a campaign: mean and scatter over runs and machines, and every run."""

from collections.abc import Iterator
from functools import partial
from typing import Final

import xarray as xr

from ..base import rounding
from ..results.bands import fixed
from ..results.conditional import ConditionalClaim
from ..results.mean_of_runs import omitted_of, runs_of
from ..results.number import number
from .analysis import Analysis, origin
from .blocks import Block, Bullets, Part, Pictures, Text
from .conditions import mean_interval_claim
from .figures.campaign import campaign_charts, order_level, reference
from .limit_tables import limits_data, limits_words, order_limits_table
from .operating_points import branch_column, branched_table, omitted_points, shown_speeds
from .tables import (
    Cell,
    Columns,
    DataTable,
    Table,
    amplitude,
    data_table,
    phase_deg,
    records,
    without_nan,
)

_MOST_CHANNELS: Final = 4
"""Channels that the sentences at the top and the tables of runs have."""
_TWO: Final = partial(rounding.fixed, decimals=2)
_SCATTER: Final = ("run_deviation", "specimen_deviation", "mean_interval")
_LEVELS: Final = {"equivalent": "equivalent_level", "band": "band_level"}
_DIMENSIONS: Final = ("channel", "speed", "order")
_ORDERS: Final[Columns] = (
    ("Channel", "channel", str),
    ("rpm", "speed_rpm", "{:.0f}".format),
    ("branch", "branch", str),
    ("Order", "order", "{:g}".format),
    ("RMS in band", "rms_in_band", amplitude),
    ("unit", "unit", str),
    ("level, dB", "level_db", rounding.fixed),
    ("runs s, dB", "run_deviation_db", _TWO),
    ("machines s, dB", "machine_deviation_db", _TWO),
    ("95 % ±, dB", "mean_interval_db", _TWO),
)
_WORDS: Final = frozenset({0, 1})
"""Columns of words of the table of omitted recordings."""
_METHOD: Final = (
    "Means are energy means: over the runs of each machine, then over the machines, each alike.",
    "Deviations are standard deviations of levels, dB: between runs of one machine, pooled over "
    "the machines; between machines without what the runs scatter (ISO 5725-2). Where each "
    "machine ran once, the latter holds both.",
    "The 95 % interval of the mean is by Student's t: of several machines from the scatter of "
    "their mean levels, of one machine from its runs, and then for that machine alone.",
)


def analysis_of_campaign(mean: xr.Dataset) -> Analysis:
    """Return the analysis of many recordings as one.

    Parameters
    ----------
    mean : result of `mean_of_runs`
    """
    levels = [_levels_table(mean)] if "equivalent_level" in mean else []
    orders = _orders_table(mean)
    several = mean.sizes["machine"] > 1
    machines = [_machines_table(mean)] if several and levels else []
    shown: list[Block] = [*levels, orders]
    parts = [
        Part("levels", "Levels", (*levels, *machines)),
        Part("figures", "Orders and third octaves", (Pictures(tuple(campaign_charts(mean))),)),
        Part("orders", "Orders", (orders,)),
        Part("runs", "Runs", (_runs_table(mean),), folded=True),
        Part("method", "Mean and scatter", (Bullets(_METHOD),)),
    ]
    tables = _data(mean)
    omitted = omitted_of(mean)
    if omitted:
        table = Table("Omitted recordings", ("Recording", "Reason"), tuple(omitted.items()), _WORDS)
        parts.insert(1, Part("omitted", "Omitted recordings", (table,)))
        tables["campaign_omitted.csv"] = {"file": [*omitted], "reason": [*omitted.values()]}
    if "order_limit" in mean:
        tables["campaign_limits.csv"] = limits_data(mean)
        limits: tuple[Block, ...] = (order_limits_table(mean), *map(Text, limits_words(mean)))
        parts.insert(0, Part("limits", "Limits of the mean", limits))
        shown += limits
    return Analysis(
        "campaign",
        about="Orders and levels of several recordings.",
        parts=tuple(parts),
        summary=tuple(_sentences(mean)),
        claims=tuple(_claims(mean)),
        shown=tuple(shown),
        tables=tables,
        **origin(mean, "Recordings"),
    )


def _sentences(mean: xr.Dataset) -> Iterator[str]:
    runs, machines = mean.sizes["run"], mean.sizes["machine"]
    speeds = mean["speed"].values
    span = f"{speeds[0]:.0f}" if speeds.size == 1 else f"{speeds[0]:.0f} to {speeds[-1]:.0f}"
    of = f"{machines} machines" if machines > 1 else "one machine"
    yield f"{runs} runs of {of} at {span} rpm."
    omitted = len(omitted_of(mean))
    if omitted:
        yield f"{omitted} of {runs + omitted} recordings are omitted; the page lists the reasons."
    for claim in _claims(mean):
        level_db = mean["equivalent_level"].sel(channel=claim.subject, weighting="A").item()
        interval = "" if claim.is_withdrawn else f" (95 %: {claim.value})"
        yield f"{claim.subject}: {rounding.fixed(level_db)} dB(A){interval}."


def _claims(mean: xr.Dataset) -> Iterator[ConditionalClaim]:
    """Intervals of the mean levels."""
    for channel in _pressures(mean)[:_MOST_CHANNELS]:
        level_db, reach = (
            mean[name].sel(channel=channel, weighting="A").item()
            for name in ("equivalent_level", "equivalent_mean_interval")
        )
        low, high = (rounding.fixed(level_db + sign * reach) for sign in (-1.0, 1.0))
        yield mean_interval_claim(channel, f"{low} to {high}", reach)


def _pressures(mean: xr.Dataset) -> list[str]:
    """Channels of sound pressure, where there are levels."""
    is_pressure = mean["channel_unit"].values == "Pa"
    names = mean["channel"].values[is_pressure] if "equivalent_level" in mean else ()
    return [str(name) for name in names]


def _levels_table(mean: xr.Dataset) -> Table:
    names = ("equivalent_level", *(f"equivalent_{part}" for part in _SCATTER))
    rows: list[tuple[Cell, ...]] = [
        (channel, weighting, *(number(mean, name, fixed, channel=channel, weighting=weighting)
                               for name in names))
        for channel in _pressures(mean)
        for weighting in map(str, mean["weighting"].values)
    ]  # fmt: skip
    head = ("Channel", "weighting", "Leq, dB", "runs s, dB", "machines s, dB", "95 % ±, dB")
    caption = "Equivalent levels: energy mean, standard deviations, interval of the mean"
    return Table(caption, head, tuple(rows), frozenset({0, 1}))


def _machines_table(mean: xr.Dataset) -> Table:
    channels = _pressures(mean)[:_MOST_CHANNELS]
    rows: list[tuple[Cell, ...]] = []
    for machine, count in zip(mean["machine"].values, mean["machine_runs"].values, strict=True):
        labels = {"machine": machine, "weighting": "A"}
        names = ("machine_equivalent_level", "machine_equivalent_deviation")
        cells = (number(mean, name, fixed, channel=channel, **labels)
                 for channel in channels for name in names)  # fmt: skip
        rows.append((str(machine), str(count), *cells))
    heads = (f"{channel}{what}" for channel in channels for what in (", dB(A)", " s, dB"))
    caption = "Machines: energy mean of their runs and standard deviation"
    return Table(caption, ("Machine", "runs", *heads), tuple(rows))


def _runs_table(mean: xr.Dataset) -> Table:
    channels, about = _pressures(mean)[:_MOST_CHANNELS], runs_of(mean)
    further = {"speed": "Speed from", "remarks": "Remarks"}
    shown = {key: head for key, head in further.items() if any(key in run for run in about)}
    rows: list[tuple[Cell, ...]] = []
    for run, of_file in zip(mean["run"].values, about, strict=True):
        speeds = mean["run_speed"].sel(run=run).values
        span = rounding.span((speeds.min(), speeds.max()), "{:.0f}".format)
        cells = (
            number(mean, "run_equivalent_level", fixed, run=run, channel=channel, weighting="A")
            for channel in channels
        )
        rows.append(
            (str(run), of_file["file"], span, *cells, *(of_file.get(key, "") for key in shown))
        )
    heads = (f"{channel}, dB(A)" for channel in channels)
    head = ("Run", "Recording", "rpm", *heads, *shown.values())
    words = frozenset({0, 1, *range(len(head) - len(shown), len(head))})
    return Table("Runs, in the order of the call", head, tuple(rows), words)


def _orders_table(mean: xr.Dataset) -> Table:
    shown = shown_speeds(mean)
    rows = [row for row in records(_orders(mean)) if row["speed_rpm"] in shown]
    units = dict.fromkeys(map(str, mean["channel_unit"].values))
    caption = (
        f"Orders: energy mean in a band of {mean.attrs['band_order']:.3g} orders; levels in "
        f"{', '.join(map(reference, units))}"
    )
    caption += omitted_points(mean)
    return branched_table(caption, rows, _ORDERS, frozenset({0, 5}), mean)


def _orders(mean: xr.Dataset) -> DataTable:
    scatter = ("run_deviation_db", "machine_deviation_db", "mean_interval_db")
    return data_table(
        _DIMENSIONS,
        {
            "channel": mean["channel"],
            "unit": mean["channel_unit"],
            "speed_rpm": mean["speed"],
            **branch_column(mean),
            "order": mean["order"],
            "rms_in_band": mean["channel_order_rms"],
            "level_db": order_level(mean["channel_order_rms"]),
            **{head: mean[f"order_{part}"] for head, part in zip(scatter, _SCATTER, strict=True)},
            "runs": xr.DataArray(mean.sizes["run"]),
            "machines": xr.DataArray(mean.sizes["machine"]),
        },
    )


def _data(mean: xr.Dataset) -> dict[str, DataTable]:
    """Tables of the mean, of each machine and of each run."""
    run = {"run": mean["run"], "machine": mean["run_machine"], "file": mean["run_file"]}
    machine = {"machine": mean["machine"], "runs": mean["machine_runs"]}
    common = {"channel": mean["channel"], "unit": mean["channel_unit"]}
    of_run = {
        **run,
        **common,
        "speed_rpm": mean["run_speed"],
        "order": mean["order"],
        "rms_in_band": mean["run_order_rms"],
        "level_db": order_level(mean["run_order_rms"]),
        "amplitude_peak": abs(mean["run_order"]),
        "phase_deg": phase_deg(mean["run_order"]),
    }
    of_machine = {
        **machine,
        **common,
        "speed_rpm": mean["speed"],
        "order": mean["order"],
        "rms_in_band": mean["machine_order_rms"],
        "level_db": order_level(mean["machine_order_rms"]),
        "run_deviation_db": mean["machine_order_deviation"],
    }
    tables = {
        "campaign_orders.csv": _orders(mean),
        "campaign_machine_orders.csv": data_table(("machine", *_DIMENSIONS), of_machine),
        "campaign_run_orders.csv": data_table(("run", *_DIMENSIONS), of_run),
    }
    if _pressures(mean):
        of_mean = {"{}_level": "level_db", "{}_run_deviation": "run_deviation_db",
                   "{}_specimen_deviation": "machine_deviation_db",
                   "{}_mean_interval": "mean_interval_db"}  # fmt: skip
        by_machine = {"machine_{}_level": "level_db", "machine_{}_deviation": "run_deviation_db"}
        tables["campaign_levels.csv"] = _levels(mean, "", {}, of_mean)
        tables["campaign_machine_levels.csv"] = _levels(mean, "machine", machine, by_machine)
        tables["campaign_run_levels.csv"] = _levels(mean, "run", run, {"run_{}_level": "level_db"})
    return {name: without_nan(table) for name, table in tables.items()}


def _levels(
    mean: xr.Dataset, dim: str, labels: dict[str, xr.DataArray], values: dict[str, str]
) -> DataTable:
    """Levels in all, without a band, then in third octaves, of channels of sound pressure.

    Parameters
    ----------
    mean : result of `mean_of_runs`
    dim : machine or run; empty for the mean
    labels : further columns
    values : column by name of the variable, `{}` for the kind of level
    """
    case = mean.sel(channel=_pressures(mean))
    joined: dict[str, list[str | float]] = {}
    for short, variable in _LEVELS.items():
        if variable not in case:
            continue
        dims = [*([dim] if dim else []), "channel", "weighting", *(["band"] * (short == "band"))]
        columns = {
            **labels,
            "channel": case["channel"],
            "weighting": case["weighting"],
            "band_hz": case["band"] if short == "band" else xr.DataArray(""),
            **{head: case[name.format(short)] for name, head in values.items()},
        }
        for head, column in data_table(dims, columns).items():
            joined.setdefault(head, []).extend(column)
    return joined
