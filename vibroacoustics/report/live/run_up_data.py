"""Data of the map of a run-up: levels over speed and order, and its sound."""

import json
from typing import Any, Final

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ...base.arrays import Array
from ...base.constants import REFERENCE_PRESSURE_PA
from ...base.decibel import level_of_power
from ...results.over_speed.loudest_orders import LoudestOrders
from ...results.over_speed.run_up_sound import RunUpSound
from ..charts.svg_marks import PALETTE
from .assets import packed

MU: Final = 255.0
"""Constant of the µ-law (ITU-T G.711): of 8 bits, its noise is 35 dB below a loud residual."""
_LARGEST: Final = 32767


def sound_data(sound: RunUpSound) -> dict[str, Any]:
    """Values for the script that plays a run-up; see `mu_law` and `RunUpSound`."""
    peak = max(float(np.abs(sound.residual).max()), 1e-30)
    parts = np.stack([sound.envelope.real, sound.envelope.imag], axis=1)
    largest = np.maximum(np.abs(parts).max(axis=(1, 2)), 1e-30)
    scaled = np.round(parts / largest[:, None, None] * _LARGEST).astype("<i2")
    return {
        "start_s": sound.start_s,
        "rate_hz": sound.sample_rate_hz,
        "residual": packed(mu_law(sound.residual / peak).tobytes()),
        "residual_peak": peak,
        "orders": sound.order.tolist(),
        "envelope_rate_hz": sound.envelope_rate_hz,
        "envelopes": packed(scaled.tobytes()),
        "envelope_peaks": largest.tolist(),
        "shaft_hz": sound.shaft_hz.round(5).tolist(),
    }


def mu_law(sample: Array) -> NDArray[np.uint8]:
    """Samples from -1 to 1 as 8 bits: 128 + 127 sign(x) ln(1 + µ|x|) / ln(1 + µ).

    Examples
    --------
    >>> from vibroacoustics.report.live.run_up_data import mu_law
    >>> mu_law(np.array([-1.0, 0.0, 1.0]))
    array([  1, 128, 255], dtype=uint8)
    """
    size = np.log1p(MU * np.abs(sample)) / np.log1p(MU)
    return np.asarray(np.round(128.0 + 127.0 * np.sign(sample) * size), dtype=np.uint8)


STEP_DB: Final = 0.25
"""Step of the levels of the map, which are within half of it."""
MOST_LEVELS: Final = 2**20
"""Largest number in a map; of longer recordings every second block is kept, or every third."""
_SMALLEST: Final = 1
"""Level of 8 bits of what is 63.5 dB and more below the highest, which is 255."""


def run_up_data(orders: xr.Dataset, curves: LoudestOrders, sound: RunUpSound | None = None) -> str:
    """JSON for the script of the interactive map.

    Levels are of root mean squares, unweighted: dB re 20 µPa of sound pressure, dB re 1 unit of
    others. They are 8-bit numbers, line by line, deflated; see `level_bytes`.

    Parameters
    ----------
    orders : result of `analyse_orders`, with `order_map` and `block_level`
    curves : overall level and loudest orders of the channel that is shown
    sound : sound of this channel; None for none
    """
    of_channel = orders.sel(channel=curves.channel)
    blocks = shown_blocks(orders.sizes["block"], orders.sizes["map_order"])
    peak = of_channel["order_map"].transpose("block", "map_order").values[blocks]
    reference = REFERENCE_PRESSURE_PA if curves.unit == "Pa" else 1.0
    levels = level_of_power(0.5 * np.abs(peak) ** 2 / reference**2)
    first_line = int(
        np.searchsorted(orders["map_order"], 0.5 * orders.attrs["band_order"], "right")
    )
    top_db = STEP_DB * float(np.ceil(levels[:, first_line:].max() / STEP_DB))
    page: dict[str, Any] = {
        "channel": curves.channel,
        "unit": curves.unit,
        "is_pressure": curves.unit == "Pa",
        "time_s": orders["block_time"].values[blocks].round(4).tolist(),
        "speed_rpm": orders["block_speed"].values[blocks].round(2).tolist(),
        "first_line": first_line,
        "lines": orders.sizes["map_order"],
        "line_order": float(orders["map_order"][1]),
        "band_order": float(orders.attrs["band_order"]),
        "noise_bandwidth_lines": float(
            orders.attrs["resolution_order"] * orders.attrs["revolutions_per_block"]
        ),
        "top_db": top_db,
        "step_db": STEP_DB,
        "levels": packed(level_bytes(levels, top_db).T.tobytes()),
        "overall_db": _overall(of_channel, blocks),
        "orders": curves.order.tolist(),
        "palette": PALETTE.hex(),
        "sound": None if sound is None else sound_data(sound),
    }
    return json.dumps(page, separators=(",", ":"), allow_nan=False)


def shown_blocks(blocks: int, lines: int) -> slice:
    """Blocks of a map that are kept, so that it has at most `MOST_LEVELS`."""
    return slice(None, None, -(-blocks * lines // MOST_LEVELS))


def level_bytes(level_db: Array, top_db: float) -> NDArray[np.uint8]:
    """Levels as 8-bit numbers n, of which each stands for top - (255 - n) step dB.

    Lower levels than those of 8 bits are 1, which stands for no level that is known.

    Parameters
    ----------
    level_db : any shape
    top_db : highest level

    Examples
    --------
    >>> from vibroacoustics.report.live.run_up_data import level_bytes
    >>> level_bytes(np.array([80.0, 79.6, -40.0]), 80.0)
    array([255, 253,   1], dtype=uint8)
    """
    steps = 255.0 + np.round((level_db - top_db) / STEP_DB)
    return np.clip(steps, _SMALLEST, 255).astype(np.uint8)


def _overall(of_channel: xr.Dataset, blocks: slice) -> list[float | None] | None:
    """A-weighted level of each block; None where it has none."""
    if "block_level" not in of_channel or of_channel["channel_unit"].item() != "Pa":
        return None
    levels = of_channel["block_level"].sel(weighting="A").values[blocks].round(2)
    return [float(level) if np.isfinite(level) else None for level in levels]
