"""Levels of two results; error and validation uncertainty of a study beside recordings."""

from collections.abc import Iterator, Mapping
from typing import Any, Final, NamedTuple

import numpy as np
import xarray as xr

from ...base import rounding
from ...base.arrays import Array
from ...base.constants import REFERENCE_PRESSURE_PA
from ...base.decibel import level_of_amplitude
from ...base.quantiles import NORMAL_90
from ...results.estimates import estimate, is_sampled
from ...results.figure_limits import PRESSURE, Compared
from ...results.grid_error import grid_error_db
from ...results.validation import OfInterval, Validation
from ..operating_points import shown_points
from ..tables import Table
from .orders import is_pressure, known_channels, loud_orders

_AMPLITUDES: Final = {
    "force ": "force_amplitude",
    "moment ": "moment_amplitude",
    "foot force ": "foot_force_amplitude",
}
"""Amplitudes over the samples by the first words of a channel; of the vector, not along an axis."""


class Levels(NamedTuple):
    """Levels of one result at a microphone; uncertainty of the mean where there are several
    runs."""

    total_dba: float
    total_uncertainty_db: float
    band_hz: Array
    band_db: Array
    band_uncertainty_db: Array


def levels_tables(compared: Compared) -> list[Table]:
    """A table for each microphone and operating point at which both results have levels."""
    sound = compared.orders.isel(channel=np.flatnonzero(is_pressure(compared.orders)))
    rows = (
        (at_channel.isel(channel=number), point)
        for number in range(sound.sizes["channel"])
        for at_channel, point in shown_points(sound)
    )
    return [table for row in rows if (table := _table(compared, *row)) is not None]


def levels_at(compared: Compared, at_point: xr.Dataset) -> tuple[Levels, Levels] | None:
    """Levels of both at a channel and operating point; none where one has none there."""
    names = {
        name: (str(at_point[name].item()), float(at_point[speed]))
        for name, speed in (("channel", "speed"), ("compared_channel", "compared_speed"))
    }
    first, second = (
        _of_study(result, option, *names[key])
        if is_study(result)
        else _of_recording(result, *names[key])
        for _, result, option, key in compared.sides()
    )
    return None if first is None or second is None else (first, second)


def _of_study(result: xr.Dataset, option: str, channel: str, speed: float) -> Levels | None:
    receiver = channel.removeprefix(PRESSURE)
    total = float(result["level_total"].sel(option=option, receiver=receiver, speed=speed))
    nothing = np.zeros(0)
    if "sources_band_level" not in result:
        return Levels(total, float("nan"), nothing, nothing, nothing)
    bands = result["sources_band_level"].sel(option=option, receiver=receiver, speed=speed)
    is_audible = bands.values > rounding.LEVEL_FLOOR_DB
    hertz = bands["noise_band"].values[is_audible]
    return Levels(total, float("nan"), hertz, bands.values[is_audible], np.full(hertz.size, np.nan))


def _of_recording(result: xr.Dataset, channel: str, _: float) -> Levels | None:
    """Levels of a whole recording, which must be at one speed."""
    if "equivalent_level" not in result or result.sizes["speed"] > 1:
        return None
    at_channel = result.sel(channel=channel)
    total, bands = at_channel["equivalent_level"], at_channel["band_level"].sel(weighting="Z")
    total_spread = at_channel.get("equivalent_mean_uncertainty", np.nan * total).sel(weighting="A")
    spread = at_channel.get("band_mean_uncertainty", np.nan * at_channel["band_level"]).sel(
        weighting="Z"
    )
    return Levels(
        total.sel(weighting="A").item(), total_spread.item(),
        bands["band"].values, bands.values, spread.values,
    )  # fmt: skip


def _table(compared: Compared, at_point: xr.Dataset, point: str) -> Table | None:
    pair = levels_at(compared, at_point)
    if pair is None:
        return None
    rows = [
        _row("all, dB(A)", *((levels.total_dba, levels.total_uncertainty_db) for levels in pair))
    ]
    first, second = (
        dict(
            zip(
                levels.band_hz,
                zip(levels.band_db, levels.band_uncertainty_db, strict=True),
                strict=True,
            )
        )
        for levels in pair
    )
    shared = sorted(first.keys() & second)
    rows += [_row(f"{band:g} Hz", first[band], second[band]) for band in shared]
    if len(rows) == 1:  # no third octave in common; levels in all are in other tables
        return None
    head = ("Band", "A", "B", "B − A, dB", "u of the mean, dB")
    caption = (
        f"{at_point['channel'].item()}, {point}: A-weighted level in all and third octaves, "
        "unweighted, dB re 20 µPa; third octaves of a study are those of the modelled sound"
    )
    shown = len(head) if any(row[-1] != rounding.NOTHING for row in rows) else -1
    return Table(caption, head[:shown], tuple(row[:shown] for row in rows))


def _row(name: str, first: tuple[float, float], second: tuple[float, float]) -> tuple[str, ...]:
    """Levels with their uncertainties, not a number where these are not known."""
    spreads = [spread for _, spread in (first, second) if np.isfinite(spread)]
    return (
        name,
        rounding.level(first[0]),
        rounding.level(second[0]),
        rounding.signed(round(second[0], 1) - round(first[0], 1)),  # of the levels that are shown
        rounding.fixed(float(np.linalg.norm(spreads)), 2) if spreads else rounding.NOTHING,
    )


def is_study(result: xr.Dataset) -> bool:
    """Whether a result is a run of a study, not a recording's."""
    return "force_order" in result


def validations_of(compared: Compared) -> list[Validation]:
    """Orders and totals of a study beside those of recordings, in the form of ASME V&V 20.

    None of two of a kind.
    """
    kinds = [is_study(compared.first), is_study(compared.second)]
    if sum(kinds) != 1:
        return []
    return [*_totals(compared, kinds[0]), *_orders(compared, kinds[0])]


def _points(compared: Compared, study_first: bool) -> Iterator[tuple[xr.Dataset, str, str]]:
    """Orders of each channel at each point, its words, and the name of the channel in the study."""
    orders = compared.orders
    for channel in known_channels(orders):
        at_channel = orders.sel(channel=channel)
        named = channel if study_first else str(at_channel["compared_channel"].item())
        for at_point, words in shown_points(at_channel):
            yield at_point, words, named


def _orders(compared: Compared, study_first: bool) -> Iterator[Validation]:
    _, study, option, _ = list(compared.sides())[0 if study_first else 1]
    for at_speed, words, named in _points(compared, study_first):
        unit = str(at_speed["channel_unit"].item())
        for order in loud_orders(at_speed):
            at_order = at_speed.sel(order=order)
            levels = [
                _level(at_order[f"{name}_order_rms"], unit) for name in ("channel", "compared")
            ]
            simulation, data = levels if study_first else levels[::-1]
            spread = float(at_order.get("order_mean_uncertainty", np.nan))
            variable, label = _sampled(study, named)
            point = {"option": option, "speed": _rpm(at_order, study_first), "order": order}
            yield OfInterval(
                f"Order {order:g} of {at_order['channel'].item()}, {words}",
                "dB" if unit == "Pa" else f"dB re 1 {unit}",
                simulation,
                data,
                _numerical(study, named),
                _inputs(study, variable, data, point | label),
                spread if np.isfinite(spread) else 0.0,
                str(at_order.attrs["second" if study_first else "first"]),
            )


def _rpm(at_speed: xr.Dataset, study_first: bool) -> float:
    """Speed of the study, rpm."""
    return float(at_speed["speed" if study_first else "compared_speed"])


def _totals(compared: Compared, study_first: bool) -> Iterator[Validation]:
    _, study, option, _ = list(compared.sides())[0 if study_first else 1]
    for at_point, words, named in _points(compared, study_first):
        is_sound = str(at_point["channel_unit"].item()) == "Pa"
        pair = levels_at(compared, at_point) if is_sound else None
        if pair is None:
            continue
        simulated, data = pair if study_first else pair[::-1]
        receiver = named.removeprefix(PRESSURE)
        point = {"option": option, "speed": _rpm(at_point, study_first), "receiver": receiver}
        spread = data.total_uncertainty_db
        yield OfInterval(
            f"Level in all at {at_point['channel'].item()}, {words}",
            "dB(A)",
            simulated.total_dba,
            data.total_dba,
            _numerical(study, named),
            _inputs(study, "level_total", data.total_dba, point),
            spread if np.isfinite(spread) else 0.0,
            str(at_point.attrs["second" if study_first else "first"]),
        )


def _numerical(study: xr.Dataset, channel: str) -> float:
    """Error of the transfer vectors' grids, for sound pressure."""
    if not channel.startswith(PRESSURE):
        return 0.0
    return grid_error_db(study, channel.removeprefix(PRESSURE))


def _inputs(study: xr.Dataset, variable: str, data: float, point: Mapping[str, Any]) -> float:
    """Standard uncertainty by the samples on the side of the data; 0 where nothing was sampled.

    A normal distribution with it has the same end of the 80 % interval there.
    """
    if not variable or not is_sampled(study, variable):
        return 0.0
    sampled = estimate(study, variable, **point)
    values = [sampled.low, sampled.value, sampled.high]
    if variable in _AMPLITUDES.values():
        values = level_of_amplitude(np.array(values) / np.sqrt(2.0)).tolist()
    low, value, high = values
    return max(high - value if data > value else value - low, 0.0) / NORMAL_90


def _sampled(study: xr.Dataset, channel: str) -> tuple[str, dict[str, str]]:
    """Variable of the orders of a channel over the samples, and its label; empty without one."""
    if channel.startswith(PRESSURE):
        return "order_level", {"receiver": channel.removeprefix(PRESSURE), "weighting": "Z"}
    for word, variable in _AMPLITUDES.items():
        if channel.startswith(word):
            where = channel.removeprefix(word).rpartition(" ")[0].strip()
            return variable, {"foot": where} if where else {}
    return "", {}


def _level(rms: xr.DataArray, unit: str) -> float:
    reference = REFERENCE_PRESSURE_PA if unit == "Pa" else 1.0
    return float(level_of_amplitude(float(rms) / reference))
