"""A study beside recordings in the form of ASME V&V 20: error and validation uncertainty."""

from collections.abc import Iterator

import numpy as np
import xarray as xr

from ...base.constants import REFERENCE_PRESSURE_PA
from ...base.decibel import level_of_amplitude
from ...results.estimates import has_samples, in_samples
from ...results.figure_limits import PRESSURE, Compared
from ...results.grid_error import grid_error_db
from ...results.validation import Validation
from ..order_tables import shown_speeds
from .levels import levels_at
from .orders import known_channels, loud_orders


def is_study(result: xr.Dataset) -> bool:
    """Whether a result is a run of a study, not a recording's."""
    return "force_order" in result


def validations_of(compared: Compared) -> list[Validation]:
    """Orders and totals of a study beside those of recordings; none of two of a kind."""
    kinds = [is_study(compared.first), is_study(compared.second)]
    if sum(kinds) != 1:
        return []
    return [*_totals(compared, kinds[0]), *_orders(compared, kinds[0])]


def _orders(compared: Compared, study_first: bool) -> Iterator[Validation]:
    orders = compared.orders
    study = compared.first if study_first else compared.second
    for channel in known_channels(orders):
        there = orders.sel(channel=channel)
        unit = str(there["channel_unit"].item())
        named = channel if study_first else str(there["compared_channel"].item())
        for speed in sorted(shown_speeds(orders)):
            at_speed = there.sel(speed=speed)
            for order in loud_orders(at_speed):
                one = at_speed.sel(order=order)
                levels = [
                    _level(one[f"{name}_order_rms"], unit) for name in ("channel", "compared")
                ]
                simulation, data = levels if study_first else levels[::-1]
                spread = float(one.get("order_mean_uncertainty", np.nan))
                yield Validation(
                    f"Order {order:g} of {channel}, {speed:.0f} rpm",
                    "dB" if unit == "Pa" else f"dB re 1 {unit}",
                    simulation,
                    data,
                    _numerical(study, named),
                    0.0,
                    spread if np.isfinite(spread) else 0.0,
                    str(orders.attrs["second" if study_first else "first"]),
                )


def _totals(compared: Compared, study_first: bool) -> Iterator[Validation]:
    orders = compared.orders
    study = compared.first if study_first else compared.second
    _, _, option, _ = list(compared.sides())[0 if study_first else 1]
    for channel in known_channels(orders):
        there = orders.sel(channel=channel)
        if str(there["channel_unit"].item()) != "Pa":
            continue
        named = channel if study_first else str(there["compared_channel"].item())
        for speed in sorted(shown_speeds(orders)):
            both = levels_at(compared, channel, float(speed))
            if both is None:
                continue
            simulated, data = both if study_first else both[::-1]
            at = float(speed if study_first else there["compared_speed"].sel(speed=speed))
            spread = data.total_uncertainty_db
            yield Validation(
                f"Level in all at {channel}, {speed:.0f} rpm",
                "dB(A)",
                simulated.total_dba,
                data.total_dba,
                _numerical(study, named),
                _inputs(study, option, named, at),
                spread if np.isfinite(spread) else 0.0,
                str(orders.attrs["second" if study_first else "first"]),
            )


def _numerical(study: xr.Dataset, channel: str) -> float:
    """Of the transfer vectors' grids, for sound pressure."""
    if not channel.startswith(PRESSURE):
        return 0.0
    return grid_error_db(study, channel.removeprefix(PRESSURE))


def _inputs(study: xr.Dataset, option: str, channel: str, speed: float) -> float:
    """Spread of the total over the samples; 0 where nothing was sampled."""
    if not has_samples(study):
        return 0.0
    receiver = channel.removeprefix(PRESSURE)
    total = in_samples(study, "level_total")
    level = total.values.sel(option=option, receiver=receiver, speed=speed).values
    return float(np.sqrt(total.weight @ (level - total.weight @ level) ** 2))


def _level(rms: xr.DataArray, unit: str) -> float:
    reference = REFERENCE_PRESSURE_PA if unit == "Pa" else 1.0
    return float(level_of_amplitude(float(rms) / reference))
