"""The page of a recording over speed and frequency."""

from collections.abc import Sequence

import numpy as np
import xarray as xr

from .blocks import Block, Pictures, Text
from .figures.style import Picture
from .html import html
from .over_speed.avoid import recorded_speeds_to_avoid
from .over_speed.avoid_table import RECORDED_RULE, recorded_avoid_table
from .over_speed.level_curves import is_run_up, recorded_curves
from .page import Page, Part


def speed_map_html(mapped: xr.Dataset, pictures: Sequence[Picture]) -> bytes:
    """The page.

    Parameters
    ----------
    mapped : of `speed_frequency_map`
    pictures : of its channels
    """
    parts = [Part("maps", "Over speed and frequency", (Pictures(tuple(pictures)),))]
    if is_run_up(mapped["block_speed"]) and "block_level" in mapped:
        parts.insert(0, Part("avoid", "Speeds to avoid", tuple(_avoid(mapped))))
    about = f"Lines of {mapped.attrs['resolution_hz']:.3g} Hz, {mapped.attrs['window']} window."
    attrs = mapped.attrs
    return html(Page(str(attrs["title"]), "Recording", attrs["created_utc"], tuple(parts), about))


def _avoid(mapped: xr.Dataset) -> list[Block]:
    blocks: list[Block] = []
    is_pressure = mapped["channel_unit"].values == "Pa"
    for channel in map(str, mapped["channel"].values[is_pressure]):
        weighted = {one.label: one for one in recorded_curves(mapped, channel)}["A-weighted"]
        if not np.all(np.isfinite(weighted.level_db)):
            continue
        ranges = recorded_speeds_to_avoid(weighted.speed_rpm, weighted.level_db)
        table = recorded_avoid_table(channel, ranges)
        blocks.append(table or Text(f"{channel}: none by the rule below."))
    return [*blocks, Text(RECORDED_RULE, "note")]
