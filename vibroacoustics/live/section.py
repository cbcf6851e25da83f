"""Sliders, spectrum and sound of the page, where a browser runs its script, and their data."""

import json
from typing import Any, Final

import numpy as np
import xarray as xr

from ..base.registry import register
from ..levels.measured_points import BASELINE_BANDS
from ..report.blocks import Block, Live, Text
from ..report.sections import Section, hold
from ..report.shown_speeds import chosen_speeds, few_speeds
from ..results.stored_study import catalogue_receiver, options
from .cases import case_of
from .lines import Lines, lines_at
from .mounts import put_matrices
from .moving import moving_of
from .numbers import Numbers
from .sliders import has_sliders, sliders_of

MOST_MICROPHONES: Final = 10
HEADROOM: Final = 2.0
"""Full scale over the largest pressure of the nominal options: sliders may be louder."""
_CREST: Final = 4.0
"""Peak over effective value of the noise that full scale leaves room for."""


def live_data(results: xr.Dataset) -> str:
    """JSON for the script of the page.

    Lines are those of all sources together at the speeds and microphones that are shown. The page
    holds loads of the moving parts, matrices of the mounts, pressure per velocity and the pressure
    of other sources. With a baseline or measured sound by force nothing varies, and it holds the
    pressure of each option.
    """
    shown = _shown(results)
    middle_hz = {band.nominal_hz: band.middle_hz for band in BASELINE_BANDS}
    bands = np.array([middle_hz[nominal] for nominal in shown["noise_band"].values.tolist()])
    moving = None if has_sliders(shown) else moving_of(shown)
    numbers = Numbers()
    page: dict[str, Any] = {
        "speeds": shown["speed"].values.tolist(),
        "microphones": [str(name) for name in shown["receiver"].values],
        "options": options(shown),
        "bands": bands.tolist(),
    }
    if has_sliders(shown):
        page["sliders"] = sliders_of(numbers, shown)
    if moving is not None and moving.weight is not None:
        page["weight"] = moving.weight._asdict()
    if moving is not None:
        page["mounts"] = [put_matrices(matrices) for matrices in moving.mounts]
        page["mounts_move"] = moving.mounts_move
        page["machine"] = [moving.machines.number(name) for name in page["options"]]
    always = frozenset() if moving is None else moving.orders()
    lines = [lines_at(shown, speed, bands, always) for speed in page["speeds"]]
    page["cases"] = [case_of(numbers, of_case, moving, s) for s, of_case in enumerate(lines)]
    page["full_scale_pa"] = full_scale_pa(lines)
    page["numbers"] = numbers.text
    return json.dumps(page, separators=(",", ":"), allow_nan=False)


def full_scale_pa(lines: list[Lines]) -> float:
    """Pressure of a digital sample of 1, the same for all: 1, 2 or 5 times a power of ten."""
    peak = max(
        float(
            np.max(
                np.abs(of_case.pressure).sum(axis=-1) + _CREST * np.sqrt(of_case.noise.sum(axis=-1))
            )
        )
        for of_case in lines
    )
    wanted = HEADROOM * max(peak, 1e-6)
    exponent = f"{wanted:e}".split("e")[1]
    sizes = (float(f"{digit}e{exponent}") for digit in (1, 2, 5, 10))
    return next(size for size in sizes if size >= wanted)


def _shown(results: xr.Dataset) -> xr.Dataset:
    """Results at few speeds and microphones, those of the published level first."""
    few = few_speeds(results)
    names = [str(name) for name in few["receiver"].values]
    names.sort(key=lambda name: name != catalogue_receiver(results))
    return few.sel(receiver=names[:MOST_MICROPHONES])


def _blocks(results: xr.Dataset) -> list[Block]:
    return [
        Text(
            "In report.html, where a browser runs its script, levels, spectrum and sound follow "
            f"sliders, at computed speeds and at {MOST_MICROPHONES} microphones at most. "
            f"{_values_words(results)}",
            "note",
        ),
        *chosen_speeds(results, "comparison.csv"),
        Live(live_data(results)),
    ]


def _values_words(results: xr.Dataset) -> str:
    if not has_sliders(results):
        return "They are those of the pipeline with the nominal values."
    return (
        "Levels begin at the median of the samples. Sliders add the change that they make to the "
        f"representative sample at {float(results['slider_speed']):g} rpm."
    )


register(Section("live", "Try it", _blocks, hold("noise_band_level", "pressure_line"), 25.0))
