"""Analyses of a recording: its orders and levels, tracked orders, and spectra over the speed."""

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from itertools import product
from typing import Final

import numpy as np
import xarray as xr

from ..base import rounding
from ..results.bands import fixed
from ..results.number import number
from ..results.over_speed.avoid import recorded_speeds_to_avoid
from ..results.over_speed.level_curves import is_run_up, recorded_curves
from ..results.over_speed.loudest_channel import loudest_channel, orders_at_speeds
from ..results.over_speed.run_up_sound import RunUpSound, shown_channel
from ..study.order_analysis import LEAST_BLOCKS
from .analysis import Analysis, origin
from .avoid import RECORDED_RULE, recorded_avoid_table
from .blocks import Block, Bullets, Live, Part, Pictures, Text
from .charts.marks import Chart
from .conditions import coherence_claim
from .figures.channel_orders import recorded_order_charts, speed_map_charts, tracked_order_charts
from .limit_tables import limits_data, limits_words, order_limits_table
from .live.run_up_data import run_up_data
from .operating_points import (
    branch_column,
    branched_table,
    has_branches,
    omitted_points,
    shown_speeds,
)
from .run_up_tables import every_loudest, loudest_sentences, loudest_table
from .tables import (
    Cell,
    Columns,
    DataTable,
    Table,
    amplitude,
    columns_of,
    data_table,
    phase_deg,
    records,
    table_of,
    without_nan,
)
from .vibration_tables import vibration_charts, vibration_data, vibration_table

_MOST_CHANNELS: Final = 4
"""Channels whose pictures are all unfolded."""
_MOST_ROWS: Final = 20
"""Rows of tables that are not folded."""
_MOST_FAULTS: Final = 5
"""Faults of the tacho that are listed; all are counted."""
_LEAST_COHERENCE: Final = 0.8
"""Coherence of an order whose phase is shown."""
_LEVELS: Final = ("equivalent_level", "fast_maximum_level", "slow_maximum_level")
_DIMENSIONS: Final = ("channel", "speed", "order")
_COLUMNS: Final[Columns] = (
    ("Channel", "channel", str),
    ("unit", "unit", str),
    ("rpm", "speed_rpm", "{:.0f}".format),
    ("branch", "branch", str),
    ("blocks", "blocks", "{:.0f}".format),
    ("Order", "order", "{:g}".format),
    ("Peak", "amplitude_peak", amplitude),
    ("phase, °", "known_phase_deg", rounding.fixed),
    ("RMS in band", "rms_in_band", amplitude),
    ("coherence", "coherence", partial(rounding.fixed, decimals=3)),
)


def analysis_of_orders(
    results: xr.Dataset, listen: str | None = None, sound: RunUpSound | None = None
) -> Analysis:
    """Return the analysis of the orders of a recording.

    Parameters
    ----------
    results : result of `analyse_orders`
    listen : channel of the interactive map of a run-up; default: the first of sound pressure
    sound : sound of that channel; None for none

    Raises
    ------
    ParameterError
        There is no such channel.
    """
    channel = shown_channel(results, listen)
    facts, tables = Bullets(tuple(orders_facts(results))), orders_tables(results)
    curves = every_loudest(results)
    loudest = loudest_channel(curves or orders_at_speeds(results))
    in_db = [loudest_table(curves)] if curves else []
    parts = [
        Part("answer", "Loudest channel and order", ()),
        *(
            Part(
                "map",
                f"Interactive map of {channel}",
                (Live(run_up_data(results, each, sound), "run_up"),),
            )
            for each in curves
            if each.channel == channel
        ),
        *_figures(recorded_order_charts(results, curves), loudest.curves.channel),
        *(_tables_part("levels", "Levels over the speed", [table]) for table in in_db),
        _tables_part("orders", "Orders and levels", tables),
        Part("settings", "Speed and resolution", (facts,)),
    ]
    data = {"orders.csv": without_nan(data_table(_DIMENSIONS, _orders(results)))}
    shown: list[Block] = [facts, *in_db, *tables]
    if "equivalent_level" in results:
        data["levels.csv"] = levels_data(results)
    if "velocity_rms" in results:
        severity = vibration_table(results)
        pictures = [Pictures((chart,)) for chart in vibration_charts(results)]
        parts.insert(-1, Part("vibration", "Vibration severity", (severity, *pictures)))
        data["vibration.csv"] = vibration_data(results)
        shown.append(severity)
    if "order_limit" in results:
        data["orders_limits.csv"] = limits_data(results)
        limits: tuple[Block, ...] = (order_limits_table(results), *map(Text, limits_words(results)))
        parts.insert(1, Part("limits", "Limits", limits))
        shown += limits
    about = "Orders are multiples of the shaft frequency; amplitudes are peaks."
    return Analysis(
        "orders",
        about=about,
        parts=tuple(parts),
        summary=loudest_sentences(loudest),
        shown=tuple(shown),
        tables=data,
        claims=(coherence_claim(results["channel_order_coherence"]),),
        **origin(results, "Recording"),
    )


def _figures(charts: Mapping[str, Sequence[Chart]], loudest: str) -> list[Part]:
    """Pictures of the loudest channel; those of others are folded where there are many."""
    others = [chart for name, each in charts.items() if name != loudest for chart in each]
    first, is_folded = Pictures(tuple(charts[loudest])), len(charts) > _MOST_CHANNELS
    if not is_folded:
        every = Pictures((*first.pictures, *others))
        return [Part("figures", "Orders by channel", (every,))]
    return [
        Part("figures", f"Orders of {loudest}", (first,)),
        Part("others", "Orders of the other channels", (Pictures(tuple(others)),), folded=True),
    ]


def _tables_part(name: str, title: str, tables: Sequence[Table]) -> Part:
    """Tables as a section; long ones are folded."""
    rows = sum(len(table.rows) for table in tables)
    return Part(name, title, tuple(tables), folded=rows > _MOST_ROWS)


def analysis_of_tracks(tracked: xr.Dataset) -> Analysis:
    """Return the analysis of tracked orders."""
    facts, table = Bullets(tuple(tracked_facts(tracked))), tracked_table(tracked)
    return Analysis(
        "tracked_orders",
        about="Orders followed over the time (Vold-Kalman); amplitudes are peaks.",
        parts=(
            Part("figures", "Orders by channel", (Pictures(tuple(tracked_order_charts(tracked))),)),
            Part("orders", "Largest amplitudes", (table,)),
            Part("settings", "Speed and bandwidth", (facts,)),
        ),
        shown=(facts, table),
        tables={"tracked_orders.csv": tracked_data(tracked)},
        **origin(tracked, "Recording"),
    )


def analysis_of_map(mapped: xr.Dataset) -> Analysis:
    """Return the analysis of a recording over speed and frequency."""
    parts = [Part("maps", "Over speed and frequency", (Pictures(tuple(speed_map_charts(mapped))),))]
    if is_run_up(mapped["block_speed"]) and "block_level" in mapped:
        parts.insert(0, Part("avoid", "Speeds to avoid", tuple(_avoid(mapped))))
    about = f"Lines of {mapped.attrs['resolution_hz']:.3g} Hz, {mapped.attrs['window']} window."
    return Analysis("speed_map", about=about, parts=tuple(parts), **origin(mapped, "Recording"))


def _avoid(mapped: xr.Dataset) -> list[Block]:
    blocks: list[Block] = []
    is_pressure = mapped["channel_unit"].values == "Pa"
    for channel in map(str, mapped["channel"].values[is_pressure]):
        weighted = {curve.label: curve for curve in recorded_curves(mapped, channel)}["A-weighted"]
        if not np.all(np.isfinite(weighted.level_db)):
            continue
        ranges = recorded_speeds_to_avoid(weighted.speed_rpm, weighted.level_db)
        table = recorded_avoid_table(channel, ranges)
        blocks.append(table or Text(f"{channel}: none by the rule below."))
    return [*blocks, Text(RECORDED_RULE, "note")]


def orders_facts(results: xr.Dataset) -> list[str]:
    """Say where the speed comes from, and how finely orders are resolved."""
    attrs = results.attrs
    facts = [
        f"speed: {attrs['speed_source']}",
        f"crank angle zero: {attrs['angle_zero']}",
        f"resolution: {attrs['resolution_order']:.3g} orders (noise bandwidth), blocks of "
        f"{attrs['revolutions_per_block']} revolutions, {attrs['window']} window",
    ]
    facts += [*_branches(results), *_few_blocks(results)]
    if "fault_time" in results:
        facts.append(_faults_line(results["fault_time"]))
    if "left_out" in attrs:
        facts.append(f"left out: {attrs['left_out']}")
    return facts


def _branches(results: xr.Dataset) -> list[str]:
    """Name the branches of the recording; a single dwell or run-up needs no word."""
    if not has_branches(results):
        return []
    names = dict.fromkeys(results["branch"].values.tolist())
    fact = f"branches, never averaged with each other: {', '.join(names)}"
    if any(name.startswith("idle") for name in names):
        fact += " (idle: the orders are 10 dB or more below those of the running machine)"
    return [fact]


def _few_blocks(results: xr.Dataset) -> list[str]:
    """Say at how many speeds there are too few blocks for coherence and phase."""
    is_short = results["block_count"].values < LEAST_BLOCKS
    if not is_short.any():
        return []
    fewest = int(results["block_count"].min())
    where = f" at {is_short.sum()} of {is_short.size} speeds" if is_short.size > 1 else ""
    return [
        f"no coherence and phase{where}: a mean of fewer than {LEAST_BLOCKS} blocks (here from "
        f"{fewest}) may have a high coherence in noise"
    ]


def orders_tables(results: xr.Dataset) -> list[Table]:
    """Orders at some operating points, and levels of sound pressure where there are some."""
    tables = [_orders_table(results)]
    if "equivalent_level" in results:
        tables.append(_levels_table(results))
    return tables


def levels_data(results: xr.Dataset) -> DataTable:
    """Leq, LFmax, LSmax and third-octave levels of every channel of sound pressure.

    Column `left_out_s`: what is omitted at either end of the recording; `bands`: "sums" of the
    lines within a third octave, or "filters" of IEC 61260-1.
    """
    names = ("leq_db", "lfmax_db", "lsmax_db", "left_out_s", "bands")
    bands = [f"leq_{band:g}_hz_db" for band in results["band"].values]
    method = str(results.attrs.get("band_method", "sums"))
    rows: list[list[str | float]] = []
    for channel, weighting in _level_rows(results):
        levels = results.sel(channel=channel, weighting=weighting)
        values = [levels[name].item() for name in _LEVELS]
        left_out = _left_out_s(results, weighting)
        rows.append(
            [channel, weighting, *values, left_out, method, *levels.band_level.values.tolist()]
        )
    return columns_of(("channel", "weighting", *names, *bands), rows)


def _left_out_s(results: xr.Dataset, weighting: str) -> float:
    """Time that a level omits at either end: the run-in of the weighting's filter."""
    return 0.0 if weighting == "Z" else float(results.attrs.get("levels_left_out_s", 0.0))


def _faults_line(times: xr.DataArray) -> str:
    kinds = [str(name).split()[1] for name in times["fault"].values]
    counts = ", ".join(f"{kinds.count(kind)} {kind}" for kind in sorted(set(kinds)))
    shown = [f"{kind} at {time:.3f} s" for kind, time in zip(kinds, times.values, strict=True)]
    more = ["…"] if len(shown) > _MOST_FAULTS else []
    return f"tacho faults: {counts} ({', '.join(shown[:_MOST_FAULTS] + more)})"


def _orders(results: xr.Dataset) -> dict[str, xr.DataArray]:
    """Columns of orders.csv."""
    peak, coherence = results["channel_order"], results["channel_order_coherence"]
    return {
        "channel": results["channel"],
        "unit": results["channel_unit"],
        "speed_rpm": results["speed"],
        **branch_column(results),
        "blocks": results["block_count"],
        "order": results["order"],
        "frequency_hz": results["order"] * results["speed"] / 60.0,
        "amplitude_peak": abs(peak),
        "phase_deg": phase_deg(peak).where(coherence.notnull()),
        "rms_in_band": results["channel_order_rms"],
        "coherence": coherence,
    }


def _orders_table(results: xr.Dataset) -> Table:
    shown = shown_speeds(results)
    columns = _orders(results)
    coherent_phase = columns["phase_deg"].where(columns["coherence"] >= _LEAST_COHERENCE)
    every = records(data_table(_DIMENSIONS, {**columns, "known_phase_deg": coherent_phase}))
    caption = (
        "Orders: peak and phase of the coherent mean over the blocks at a speed; RMS in a band of "
        f"{results.attrs['band_order']:.3g} orders"
    )
    caption += omitted_points(results)
    rows = [row for row in every if row["speed_rpm"] in shown]
    return branched_table(caption, rows, _COLUMNS, frozenset({0, 1}), results)


def _level_rows(results: xr.Dataset) -> Iterator[tuple[str, str]]:
    """Channel and weighting of levels of sound pressure."""
    channels = results["channel"].values[results["channel_unit"].values == "Pa"]
    return product(map(str, channels), map(str, results["weighting"].values))


def _levels_table(results: xr.Dataset) -> Table:
    rows: list[tuple[Cell, ...]] = []
    for channel, weighting in _level_rows(results):
        coordinates = {"channel": channel, "weighting": weighting}
        rows.append(
            (channel, weighting, *(number(results, each, fixed, **coordinates) for each in _LEVELS))
        )
    head = ("Channel", "weighting", "Leq, dB", "LFmax, dB", "LSmax, dB")
    method = "IEC 61260-1 filters" if results.attrs.get("band_method") == "filters" else "band sums"
    caption = (
        "Sound pressure levels, dB re 20 µPa; A and C omit the first and last "
        f"{_left_out_s(results, 'A'):.3g} s, the filters' run-in; third octaves in levels.csv by "
        f"{method}"
    )
    return Table(caption, head, tuple(rows), frozenset({0, 1}))


_TRACKED_COLUMNS: Final[Columns] = (
    ("Channel", "channel", str),
    ("unit", "unit", str),
    ("Order", "order", "{:g}".format),
    ("Largest peak", "amplitude_peak", rounding.significant),
    ("at s", "time_s", "{:.2f}".format),
    ("at rpm", "speed_rpm", "{:.0f}".format),
)


def tracked_table(tracked: xr.Dataset) -> Table:
    """Return where each order of a channel is largest."""
    size = abs(tracked["tracked_order"])
    loudest = size.isel(track_time=size.argmax("track_time"))
    rows = records(data_table(("channel", "order"), _tracked(tracked, loudest)))
    caption = "Tracked orders: where each is largest"
    return table_of(caption, rows, _TRACKED_COLUMNS, frozenset({0, 1}))


def tracked_data(tracked: xr.Dataset) -> DataTable:
    """Amplitude and phase of every tracked order of every channel over the time."""
    peak = tracked["tracked_order"]
    columns = {**_tracked(tracked, abs(peak)), "phase_deg": phase_deg(peak)}
    return data_table(("channel", "order", "track_time"), columns)


def _tracked(tracked: xr.Dataset, size: xr.DataArray) -> dict[str, xr.DataArray]:
    return {
        "channel": tracked["channel"],
        "unit": tracked["channel_unit"],
        "order": tracked["order"],
        "time_s": size["track_time"],
        "speed_rpm": size["track_speed"],
        "amplitude_peak": size,
    }


def tracked_facts(tracked: xr.Dataset) -> list[str]:
    """Say where the speed comes from, and what passes around each order."""
    attrs = tracked.attrs
    return [
        f"speed: {attrs['speed_source']}",
        f"bandwidth: {attrs['bandwidth_hz']:g} Hz, {attrs['poles']} poles; noise within it grows "
        f"by up to {attrs['noise_gain']:.2g}",
    ]
