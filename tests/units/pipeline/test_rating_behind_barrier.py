"""Rating level at a window behind a barrier, from the study to the verdict; coarse, closed form."""

from typing import Any

import numpy as np
import pytest
import xarray as xr
from support import ROOT

import vibroacoustics as va

STUDY = va.load_study(ROOT / "docs" / "gallery" / "studies" / "neighbour.toml")
COARSE = {"radiation.maximum_frequency_hz": 110.0} | {
    f"options.{name}": None for name in STUDY.options if name != "none"
}
BARRIER = {"side": "+x", "distance_mm": 3000.0, "height_mm": 2000.0}
KEY = "radiation.surroundings.barrier"
DETOUR_M = np.hypot(3.0, 1.8) + np.hypot(5.0, 0.5) - np.hypot(8.0, 2.3)
"""Detour over the edge from 0.2 m above the ground to the window."""


def rated(changes: dict[str, Any]) -> xr.Dataset:
    at = {"speed": 2900.0, "option": "none", "rating_window": "bedroom", "receiver": "window"}
    return va.run(STUDY.replace(COARSE | changes)).sel(at)


@pytest.mark.long
def test_a_barrier_lowers_the_rating_level_behind_it() -> None:
    """By what Kurze and Anderson's formula gives between 100 Hz and 10 kHz, ground apart."""
    without, behind = rated({}), rated({KEY: BARRIER})
    drop_db = float(without["rating_level"] - behind["rating_level"])
    assert drop_db == pytest.approx(float(without["level_total"] - behind["level_total"]))
    least, most = (5.0 + 20.0 * np.log10(_ratio(hertz)) for hertz in (100.0, 10000.0))
    assert least < drop_db < most
    assert float(behind["limit_probability"]) == 1.0


def _ratio(hertz: float) -> float:
    root = np.sqrt(2.0 * np.pi * 2.0 * DETOUR_M * hertz / 343.0)
    return float(root / np.tanh(root))
