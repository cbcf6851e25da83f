"""Section on radiation, from the motion of the housing to the sound at the microphones."""

import json

import numpy as np
import xarray as xr

from ...base import rounding
from ...base.registry import register
from ...results.grid_error import loud_errors_db
from ...results.stored_study import options, parameters, speeds
from ..blocks import Block, Heading, Pictures, Text
from ..figures.deflection import deflection_picture
from ..figures.directivity import polar_levels
from ..figures.maps import line_map
from ..figures.radiation import green_difference, levels, transfer
from ..kwave_words import kwave_sentence, kwave_to_hz, receiver_methods
from ..shown_speeds import chosen_speeds, few_speeds
from ..tables import Table
from . import Section


def receivers_table(results: xr.Dataset) -> Table:
    """Return the positions of the microphones."""
    receivers = parameters(results)["receivers"]
    methods = receiver_methods(results)
    rows = tuple(
        (
            str(name),
            *(rounding.fixed(receivers[str(name)][key], 3) for key in ("x_m", "y_m", "height_m")),
            methods.get(str(name), (rounding.NOTHING,))[0],
        )
        for name in results["receiver"].values
    )
    head = ("Microphone", "x, m", "y, m", "Height above the floor, m", "Method")
    return Table("Microphones; x and y from the shaft", head, rows, frozenset({0, 4}))


def line_difference_sentence(results: xr.Dataset) -> str:
    """Say how far k-Wave changes the level of the 1x line."""
    if "line_difference" not in results:
        return ""
    line = results["order_level"].sel(order=1, weighting="Z")
    gap = abs(results["line_difference"]).where(line > rounding.LEVEL_FLOOR_DB)
    return (
        "The 1× line differs between the methods by at most "
        f"{rounding.fixed(float(gap.max().fillna(0.0)), 3)} dB, over all options, speeds and "
        "microphones at which it has a level."
    )


def grid_error_sentence(results: xr.Dataset) -> str:
    """Estimated error of the transfer vectors where they are loud."""
    if "transfer_vector_error" not in results:
        return "The transfer vectors are given, without an estimate of their error."
    error = loud_errors_db(results)
    if not error.size:
        return "The transfer vectors are silent."
    half, most = (_hundredth_above(float(np.quantile(error, share))) for share in (0.5, 0.95))
    how = "Error by two grids"
    if "boundary_elements" in json.loads(results.attrs.get("radiation") or "{}"):
        how = "Error of the finer of two meshes of boundary elements"
    return (
        f"{how}: below {half} dB in half, below {most} dB in 95 % of all cases. Cases count within "
        "20 dB of the loudest microphone."
    )


def _hundredth_above(value: float) -> str:
    """Upper bound in hundredths, so that a small error never reads as none."""
    return rounding.fixed((np.floor(100.0 * value) + 1.0) / 100.0, 2)


def sound_power_table(results: xr.Dataset) -> Table | None:
    """Sound power of the 1x line and of all modelled orders, if the study asks for it."""
    if "order_sound_power_level" not in results:
        return None
    line = results["order_sound_power_level"].sel(order=1, weighting="Z")
    total = results["sound_power_level"].sel(weighting="A")
    parts = [part.transpose("option", "speed").values for part in (line, total)]
    levels = np.stack(parts, axis=-1).reshape(len(options(results)), -1).tolist()
    rows = tuple(
        (option, *map(rounding.level, values))
        for option, values in zip(options(results), levels, strict=True)
    )
    what = ("1×, dB", "all, dB(A)")
    head = [f"{name} at {speed:g} rpm" for speed in speeds(results) for name in what]
    caption = (
        f"Sound power level by {total.attrs['arrangement']}, dB re 1 pW, modelled orders only; "
        "near the machine low orders read too high (a dipole by 3.6 dB at 48 Hz and 1 m)"
    )
    return Table(caption, ("Option", *head), rows)


_SENTENCES = (kwave_sentence, line_difference_sentence, grid_error_sentence)


def _blocks(results: xr.Dataset) -> list[Block]:
    power = sound_power_table(few_speeds(results))
    difference = [green_difference(results)] if kwave_to_hz(results) else []
    shapes = [deflection_picture(results)] if "deflection" in results else []
    around = [polar_levels(results)] if "polar_level" in results else []
    maps = [line_map(results)] if "map_level" in results else []
    return [
        Text(" ".join(filter(None, (part(results) for part in _SENTENCES)))),
        receivers_table(results),
        *chosen_speeds(results, "comparison.csv"),
        *([power] if power else []),
        Pictures((levels(results), *difference)),
        Heading("From velocity of the housing to sound pressure"),
        Pictures((*shapes, *around, *maps, transfer(results))),
    ]


register(Section("radiation", "Radiation and levels", _blocks, position=70.0))
