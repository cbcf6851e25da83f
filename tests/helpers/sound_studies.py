"""Results to listen to, and their A-weighted level."""

from pathlib import Path

import numpy as np
import xarray as xr
from support import ROOT, made_up_radiation

import vibroacoustics as va
from vibroacoustics.levels import a_weighting
from vibroacoustics.sound.ingredients import Ingredients

ORDERS = "microphone,speed_rpm,order,level_db,phase_deg\n" + "\n".join(
    f"front_1m,{rpm},{order},{level},{phase}"
    for rpm in (900, 1000)
    for order, level, phase in ((1, 90.0, 10), (2, 60.0, ""))
)
THIRDS = "microphone,speed_rpm,band_hz,level_db\n" + "\n".join(
    f"front_1m,{rpm},{band},{level}"
    for rpm in (900, 1000)
    for band, level in ((16, 90.1), (31.5, 61.0), (500, 70.0), (1000, 75.0))
)


def result_with_baseline(folder: Path) -> xr.Dataset:
    """A machine by table at three speeds, with a baseline at one microphone and two of them."""
    (folder / "orders.csv").write_text(ORDERS)
    (folder / "thirds.csv").write_text(THIRDS)
    study = va.load_study(ROOT / "pipelines" / "reciprocating_table.toml")
    asked = {
        "operation.speed_rpm": [900.0, 950.0, 1200.0],
        "operation.maximum_order": 4,
        "measured.baseline": {
            "file": [str(folder / "orders.csv"), str(folder / "thirds.csv")],
            "tacho_angle_deg": 0.0,
        },
    }
    return va.run(study.replace(asked), radiation=made_up_radiation)


def a_level(parts: Ingredients) -> float:
    """A-weighted level, noise weighted at the middle of its bands, dB."""
    of_lines = 10.0 ** (a_weighting(parts.lines.frequency_hz) / 10.0)
    of_bands = 10.0 ** (a_weighting(parts.bands.centre_hz) / 10.0)
    square = 0.5 * np.abs(parts.lines.pressure_pa) ** 2 @ of_lines
    square += parts.bands.pressure_pa**2 @ of_bands
    return float(10.0 * np.log10(square / 4e-10))
