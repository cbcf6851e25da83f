"""Sliders of uncertain parameters as the page holds them."""

from typing import Any

import numpy as np
import xarray as xr

from ..report.sections.unknowns import file_unit, named
from ..results.stored_study import options
from ..uncertainty.slider_variables import HOOD
from .numbers import FEW_BITS, NOISE_BITS, Numbers

_DIMS = ("receiver", "noise_band")


def has_sliders(results: xr.Dataset) -> bool:
    """Return whether the run computed sliders at one of its speeds that are shown."""
    return "slider_value" in results and float(results["slider_speed"]) in results["speed"].values


def sliders_of(numbers: Numbers, shown: xr.Dataset) -> dict[str, Any]:
    """Return the sliders: their nodes in the units of files, and changes of levels in dB.

    Arrays are the numbers of their first elements in `numbers`: `before` by option (microphone,
    band), `change` by slider (node, microphone, band). `own` is the node of the representative
    sample, `error` by option and microphone that of several sliders together.
    """
    before = shown["slider_band_level"].transpose("option", *_DIMS)
    error = shown["slider_addition_error"].transpose("option", "receiver").values
    return {
        "speed": shown["speed"].values.tolist().index(float(shown["slider_speed"])),
        "settings": shown.sizes["slider_setting"],
        "before": [numbers.put(before.sel(option=name), NOISE_BITS) for name in options(shown)],
        "error": error.round(3).tolist(),
        "list": [_slider(numbers, shown.sel(slider=name)) for name in shown["slider"].values],
    }


def _slider(numbers: Numbers, slider: xr.Dataset) -> dict[str, Any]:
    name, values = str(slider["slider"].values), slider["slider_value"].values
    if name == HOOD:
        words, unit, factor, value = "insertion loss of a hood", "dB", 1.0, 0.0
    else:
        words, (unit, factor) = named(name), file_unit(slider, name)
        value = float(slider["representative_value"].sel(uncertain_parameter=name))
    change = slider["slider_band_change"].transpose("slider_node", *_DIMS)
    return {
        "name": words[0].upper() + words[1:],
        "unit": unit,
        "values": (values / factor).tolist(),
        "own": int(np.argmin(np.abs(values - value))),
        "change": numbers.put(change, FEW_BITS),
        "error": round(float(slider["slider_interpolation_error"]), 3),
    }
