"""Analysis of the sound power from recorded microphones."""

from dataclasses import replace
from typing import Final

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from ..base import rounding
from ..results.bands import fixed
from ..results.claim_kinds import GRADE, POWER_LEVEL
from ..results.conditional import claim_of, claims_of, stated
from ..results.number import VALUE, number
from ..study.sound_power import MINIMUM_BACKGROUND_MARGIN_DB
from .analysis import Analysis, origin
from .blocks import Bullets, Part, Pictures
from .figures.sources import power_chart
from .tables import Cell, DataTable, Table, cell

_COLUMNS: Final = {
    "mean_position_level": "mean_level_db",
    "background_margin": "background_margin_db",
    "background_correction": "k1_db",
    "environment_correction": "k2_db",
    "measured_power_level": "sound_power_level_db",
}
_NONE: Final = np.array(np.nan)
"""Sum of the mean level of the positions, which has no A-weighted one."""


def analysis_of_sound_power(measured: xr.Dataset) -> Analysis:
    """Return level, corrections and grade of a measured sound power."""
    table, remarks = _table(measured), Bullets(tuple(_remarks(measured)))
    return Analysis(
        "sound_power",
        about="Sound power from microphones around the machine, as ISO 3744 has it.",
        parts=(
            Part("level", "Sound power level", ()),
            Part("bands", "Third octaves", (Pictures((power_chart(measured),)), table)),
            Part("remarks", "Measurement", (remarks,)),
        ),
        summary=(headline(measured),),
        shown=(table, remarks),
        tables={"sound_power.csv": _bands(measured)},
        claims=claims_of(measured),
        **origin(measured, "Recording"),
    )


def _bands(measured: xr.Dataset) -> DataTable:
    """Every band, and the A-weighted sums in the last row; empty where nothing was measured.

    The last row has the claims on the A-weighted level.
    """
    margins = [*measured["background_margin"].values, measured["background_margin_a"].item()]
    columns = {head: [*measured[name].values.tolist(), measured.get(f"{name}_a", _NONE).item()]
               for name, head in _COLUMNS.items()}  # fmt: skip
    return {
        "band_hz": [*measured["band"].values.tolist(), "A"],
        **{head: [*map(cell, values)] for head, values in columns.items()},
        "is_upper_bound": [*map(_bound, margins)],
        **{
            kind.name.replace(" ", "_"): [
                *[""] * measured.sizes["band"],
                stated(claim_of(measured, kind.name)),
            ]
            for kind in (POWER_LEVEL, GRADE)
        },
    }


def headline(measured: xr.Dataset) -> str:
    """Level and grade in a sentence."""
    level, grade = (claim_of(measured, kind.name) for kind in (POWER_LEVEL, GRADE))
    return f"L_WA = {level.short}: {stated(grade)}."


def _table(measured: xr.Dataset) -> Table:
    bounds = _is_upper_bound(measured["background_margin"].values)
    rows: list[tuple[Cell, ...]] = [
        (f"{band:g}{' *' if bound else ''}", *(number(measured, name, fixed, band=band)
                                              for name in _COLUMNS))
        for band, bound in zip(measured["band"].values.tolist(), bounds, strict=True)
    ]  # fmt: skip
    *sums, level = (number(measured, f"{name}_a", fixed, "dB") for name in list(_COLUMNS)[1:])
    bound = claim_of(measured, POWER_LEVEL.name).bound
    text = f"{bound} {level.text}".lstrip()
    level = replace(level, unit="dB(A)", text=text, statistic=bound or VALUE)
    head = ("Band, Hz", "Mean Lp", "over background", "K1", "K2", "L_W")
    caption = "Sound power level in third octaves, dB"
    return Table(caption, head, (*rows, ("A", "", *sums, level)))


def _remarks(measured: xr.Dataset) -> list[str]:
    attrs, count = measured.attrs, measured.sizes["channel"]
    wanted = [int(number) for number in np.atleast_1d(attrs["positions_of_the_standard"])]
    required = " or ".join(map(str, wanted))
    spread = rounding.fixed(float(attrs["spread_dba"]))
    remarks = [
        f"{count} microphones on a {attrs['surface']}, {attrs['surface_m2']:.3g} m²"
        + ("." if count in wanted else f"; ISO 3744 asks for {required}."),
        f"A-weighted levels of the positions span {spread} dB"
        + (f", more than their number, {count}: use more." if attrs["spread_dba"] > count else "."),
        _background(measured),
        _environment(measured),
        "L_WA is the sum of the bands from 100 Hz to 10 kHz; the air's state is not corrected for.",
    ]
    empty = measured["band"].values[np.isnan(measured["measured_power_level"].values)]
    if empty.size:
        remarks.append(f"Bands from {empty[0]:g} Hz are beyond the sample rate: empty.")
    return remarks


def _environment(measured: xr.Dataset) -> str:
    if "K2" in str(measured.attrs.get("missing_for_grade", "")).split(", "):
        return (
            "The room was not stated: K2 is 0, and the level is high by what the room reflects. "
            "Give its absorption area (1e6 m² in a hemi-anechoic room), or its reverberation time "
            "and volume."
        )
    return (
        f"K2A = {rounding.fixed(measured['environment_correction_a'].item())} dB; "
        "grade 2 allows 4 dB, grade 3 7 dB."
    )


def _background(measured: xr.Dataset) -> str:
    margin = measured["background_margin_a"].item()
    if np.isnan(margin):
        return "The background was not recorded: K1 is 0, and the level is high by what it makes."
    words = f"A-weighted, the machine is {rounding.fixed(margin)} dB above the background"
    if _is_upper_bound(measured["background_margin"].values).any():
        words += "; in bands with * by less than 6 dB: their level is an upper bound"
    return f"{words}."


def _bound(margin_db: float) -> str:
    if np.isnan(margin_db):
        return ""
    return "yes" if _is_upper_bound(margin_db) else "no"


def _is_upper_bound(margin_db: ArrayLike) -> NDArray[np.bool_]:
    """Return whether levels are upper bounds, by their margin over the background (8.2.3)."""
    return np.asarray(margin_db) < MINIMUM_BACKGROUND_MARGIN_DB
