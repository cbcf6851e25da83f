"""Positions of the microphones, errors of the radiation, sound power."""

import json
from typing import Final

import numpy as np
import xarray as xr

from ....base import rounding
from ....results.grid_error import loud_errors_db
from ....results.stored_study import parameters
from ...kwave_words import receiver_methods
from ...tables import Table

_HOW_ERROR: Final = {
    False: "Two grids estimate the error of what is extrapolated from them",
    True: "Two meshes of boundary elements estimate the error of the finer one",
}


def receivers_table(results: xr.Dataset) -> Table:
    """Where the microphones stand."""
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
    """How far k-Wave moves the level of the 1x line."""
    if "line_difference" not in results:
        return ""
    return (
        "The level of the 1× line differs by at most "
        f"{rounding.fixed(_audible_line_difference(results), 3)} dB between the two, over all "
        "options, speeds and microphones where the line is not silent."
    )


def grid_error_sentence(results: xr.Dataset) -> str:
    """Estimated error of the transfer vectors where they are loud."""
    if "transfer_vector_error" not in results:
        return "The transfer vectors are given, without an estimate of their error."
    error = loud_errors_db(results)
    if not error.size:
        return "The transfer vectors are silent."
    half, most = (_hundredth_above(float(np.quantile(error, share))) for share in (0.5, 0.95))
    return (
        f"{_HOW_ERROR[_by_elements(results)]}: below {half} dB in half, below {most} dB in "
        "95 % of the microphones, motions and frequencies within 20 dB of the loudest microphone."
    )


def _hundredth_above(value: float) -> str:
    """What a value is below of, so that a small error never reads as none."""
    return rounding.fixed((np.floor(100.0 * value) + 1.0) / 100.0, 2)


def _by_elements(results: xr.Dataset) -> bool:
    """Whether boundary elements computed the radiation."""
    return "boundary_elements" in json.loads(results.attrs.get("radiation") or "{}")


def sound_power_table(results: xr.Dataset) -> Table | None:
    """Sound power of the 1x line and of all modelled orders, if the study asks for it."""
    if "order_sound_power_level" not in results:
        return None
    line = results["order_sound_power_level"].sel(order=1, weighting="Z")
    total = results["sound_power_level"].sel(weighting="A")
    speeds = [float(speed) for speed in total["speed"].values]
    rows = tuple(
        (
            str(option),
            *(
                rounding.level(float(part.sel(option=option, speed=speed)))
                for speed in speeds
                for part in (line, total)
            ),
        )
        for option in total["option"].values
    )
    head = [f"{what} at {speed:g} rpm" for speed in speeds for what in ("1×, dB", "all, dB(A)")]
    caption = (
        f"Sound power level by {total.attrs['arrangement']}, dB re 1 pW, modelled orders only; "
        "near the machine low orders read too high (a dipole by 3.6 dB at 48 Hz and 1 m)"
    )
    return Table(caption, ("Option", *head), rows)


def _audible_line_difference(results: xr.Dataset) -> float:
    line = results["order_level"].sel(order=1, weighting="Z")
    gap = abs(results["line_difference"]).where(line > rounding.LEVEL_FLOOR_DB)
    return float(gap.max().fillna(0.0))
