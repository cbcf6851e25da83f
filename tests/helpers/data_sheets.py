"""A study whose machine is a monopole on a hard floor, with a baseline of known sound power."""

from pathlib import Path

import numpy as np
import xarray as xr
from support import ROOT

import vibroacoustics as va
from vibroacoustics.levels.bands import bands_between
from vibroacoustics.radiation.arrangements import hemisphere_positions

SPEED_RPM = 1200.0
BANDS = bands_between(3, 100.0, 10_000.0)
POWER_DB = 78.0 + 6.0 * np.sin(0.9 * np.arange(len(BANDS)))
"""Of the baseline by band, re 1 pW."""
POSITIONS_M = hemisphere_positions(2.0)
NAMES = [f"p{number}" for number in range(1, 11)]
STRENGTH = 0.3
"""p = STRENGTH ω v exp(-jkr)/r for the velocity v up and down, Pa."""


def study_of(folder: Path) -> va.Study:
    """The machine by table with ten microphones on a hemisphere and, in its folder, a baseline."""
    radius = np.linalg.norm(POSITIONS_M, axis=1)
    rows = [
        f"{name},{SPEED_RPM:g},{band.nominal_hz:g},{power - 10.0 * np.log10(2.0 * np.pi * r**2)}"
        for name, r in zip(NAMES, radius, strict=True)
        for band, power in zip(BANDS, POWER_DB, strict=True)
    ]
    (folder / "thirds.csv").write_text("\n".join(["microphone,speed_rpm,band_hz,level_db", *rows]))
    receivers = [
        f"[receivers.{name}]\nx_mm = {1e3 * x}\ny_mm = {1e3 * y}\nheight_mm = {1e3 * z}\n"
        for name, (x, y, z) in zip(NAMES, POSITIONS_M, strict=True)
    ]
    (folder / "study.toml").write_text(
        f'extends = "{ROOT / "pipelines" / "reciprocating_table.toml"}"\ntitle = "Monopole"\n'
        f"[operation]\nspeed_rpm = [{SPEED_RPM}]\n"
        '[measured.baseline]\nfile = "thirds.csv"\n' + "\n".join(receivers)
    )
    study = va.load_study(folder / "study.toml")
    few = {name: study.options[name] for name in ("none", "lanchester")}
    return study.model_copy(update={"options": few})


def results_of(study: va.Study) -> xr.Dataset:
    """Its run with the monopole as radiation."""
    hertz = np.arange(10.0, 501.0, 10.0)
    omega = 2.0 * np.pi * hertz
    at = [(one.x_m, one.y_m, one.height_m) for one in study.receivers.values()]
    radius = np.linalg.norm(at, axis=1)[:, None]
    vectors = np.zeros((len(at), 6, hertz.size), dtype=complex)
    vectors[:, 2] = STRENGTH * omega * np.exp(-1j * omega * radius / 343.0) / radius
    return va.run(study, radiation=va.given_radiation(vectors, hertz))


def modelled_power_db(results: xr.Dataset, option: str) -> np.ndarray:
    """Closed form by band: W rho c = 2π r² p²; not a number where no order lies in a band."""
    at = results.sel(option=option, speed=SPEED_RPM)
    velocity = at["velocity_order"].sum("source").sel(dof="tz").values
    hertz = at["order_frequency"].values
    square = 0.5 * np.abs(STRENGTH * 2.0 * np.pi * hertz * velocity) ** 2 * 2.0 * np.pi / 20e-6**2
    energy = [square[(hertz >= band.lower_hz) & (hertz < band.upper_hz)].sum() for band in BANDS]
    return 10.0 * np.log10(np.where(np.array(energy) > 1e-4, energy, np.nan))
