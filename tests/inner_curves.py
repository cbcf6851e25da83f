"""Inner curves of every machine, each computed once."""

from functools import cache
from typing import Final

import xarray as xr
from machine_files import machine_file
from support import PIPELINES

import vibroacoustics as va

FILES: Final = {
    "copeland_sources": 2900.0,
    "mayekawa_wbhe": 1000.0,
    "zhao_minicrank": 1500.0,
    "dagilis_slider_link": 2950.0,
    "estupinan_hermetic": 2980.0,
}
"""Study or machine, and the speed of its curves in rpm."""


@cache
def inner(name: str) -> xr.Dataset:
    """Curves of a study with sources, or of a machine file."""
    is_study = name == "copeland_sources"
    file = PIPELINES / f"{name}.toml" if is_study else machine_file(name)
    return va.curves(va.load_study(file) if is_study else va.load_machine(file), FILES[name])
