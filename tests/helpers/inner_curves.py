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
AS_THE_THESIS: Final = {"operation.point": None, "machine.gas.opening_law": "equalisation-angle"}
"""The pressures that it prints; a pocket opens without a course of its own."""


@cache
def inner(name: str) -> xr.Dataset:
    """Curves of a study with sources, or of a machine file."""
    is_study = name == "copeland_sources"
    if is_study:
        study = va.load_study(PIPELINES / f"{name}.toml")
        return va.curves(study.replace(AS_THE_THESIS), FILES[name])
    return va.curves(va.load_machine(machine_file(name)), FILES[name])
