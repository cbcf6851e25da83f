"""Sound power from recorded microphones as plain text, CSV and page."""

from typing import Final

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from ..base import rounding
from ..study.sound_power import MINIMUM_BACKGROUND_MARGIN_DB
from .blocks import Bullets, Pictures, Text
from .figures.measured_power import power_chart
from .html import html
from .page import Page, Part
from .tables import Table, to_csv, to_text

GRADES: Final = {
    2: "grade 2 (ISO 3744, engineering)",
    3: "grade 3 (ISO 3746, survey), not grade 2",
    0: "neither grade 2 (ISO 3744) nor grade 3 (ISO 3746)",
}
_COLUMNS: Final = {
    "mean_position_level": "mean_level_db",
    "background_margin": "background_margin_db",
    "background_correction": "k1_db",
    "environment_correction": "k2_db",
    "measured_power_level": "sound_power_level_db",
}


def measured_power_csv(measured: xr.Dataset) -> bytes:
    """Every band, and the A-weighted sums in the last row; empty where nothing was measured."""
    rows = [
        (f"{band:g}", *(_cell(measured[name].values[at]) for name in _COLUMNS), _bound(margin))
        for at, (band, margin) in enumerate(
            zip(measured["band"].values, measured["background_margin"].values, strict=True)
        )
    ]
    sums = [measured[f"{name}_a"].item() for name in list(_COLUMNS)[1:]]
    margin = measured["background_margin_a"].item()
    rows.append(("A", "", *(_cell(value) for value in sums), _bound(margin)))
    return to_csv(("band_hz", *_COLUMNS.values(), "is_upper_bound"), rows)


def measured_power_text(measured: xr.Dataset) -> str:
    """Level, corrections and what the grade is, for a terminal."""
    return "\n".join([to_text(_table(measured)), headline(measured), *_remarks(measured)])


def measured_power_html(measured: xr.Dataset) -> bytes:
    """The page."""
    parts = (
        Part("level", "Sound power level", (Text(headline(measured), "headline"),)),
        Part("bands", "Third octaves", (Pictures((power_chart(measured),)), _table(measured))),
        Part("remarks", "Measurement", (Bullets(tuple(_remarks(measured))),)),
    )
    attrs = measured.attrs
    about = "Sound power from microphones around the machine, as ISO 3744 has it."
    return html(Page(attrs["title"], "Recording", attrs["created_utc"], parts, about))


def headline(measured: xr.Dataset) -> str:
    """Level and grade in a sentence."""
    level = rounding.fixed(measured["measured_power_level_a"].item())
    at_most = "at most " if _bound(measured["background_margin_a"].item()) == "yes" else ""
    return f"L_WA = {at_most}{level} dB(A) re 1 pW: {GRADES[int(measured.attrs['grade'])]}."


def _table(measured: xr.Dataset) -> Table:
    bands = [f"{band:g}" for band in measured["band"].values]
    rows = [
        (band, *(rounding.fixed(float(measured[name].values[at])) for name in _COLUMNS))
        for at, band in enumerate(bands)
    ]
    sums = [measured[f"{name}_a"].item() for name in list(_COLUMNS)[1:]]
    rows.append(("A", "", *map(rounding.fixed, sums)))
    bounds = _is_upper_bound(measured["background_margin"].values)
    rows = [
        (f"{band}{' *' if bound else ''}", *cells)
        for (band, *cells), bound in zip(rows, [*bounds, False], strict=True)
    ]
    head = ("Band, Hz", "Mean Lp", "over background", "K1", "K2", "L_W")
    return Table("Sound power level in third octaves, dB", head, tuple(rows))


def _remarks(measured: xr.Dataset) -> list[str]:
    attrs, count = measured.attrs, measured.sizes["channel"]
    wanted = [int(number) for number in np.atleast_1d(attrs["positions_of_the_standard"])]
    asked = " or ".join(map(str, wanted))
    spread = rounding.fixed(float(attrs["spread_dba"]))
    remarks = [
        f"{count} microphones on a {attrs['surface']}, {attrs['surface_m2']:.3g} m²"
        + ("." if count in wanted else f"; ISO 3744 asks for {asked}."),
        f"A-weighted levels of the positions span {spread} dB"
        + (f", more than their number, {count}: use more." if attrs["spread_dba"] > count else "."),
        _background(measured),
        f"K2A = {rounding.fixed(measured['environment_correction_a'].item())} dB; "
        "grade 2 allows 4 dB, grade 3 7 dB.",
        "L_WA is the sum of the bands from 100 Hz to 10 kHz; the air's state is not corrected for.",
    ]
    empty = measured["band"].values[np.isnan(measured["measured_power_level"].values)]
    if empty.size:
        remarks.append(f"Bands from {empty[0]:g} Hz are beyond the sample rate: empty.")
    return remarks


def _background(measured: xr.Dataset) -> str:
    margin = measured["background_margin_a"].item()
    if np.isnan(margin):
        return "The background was not recorded: K1 is 0, and the level is high by what it makes."
    words = f"A-weighted, the machine is {rounding.fixed(margin)} dB above the background"
    if _is_upper_bound(measured["background_margin"].values).any():
        words += "; in bands with * by less than 6 dB: their level is an upper bound"
    return f"{words}."


def _cell(value: float) -> str | float:
    return float(value) if np.isfinite(value) else ""


def _bound(margin_db: float) -> str:
    if np.isnan(margin_db):
        return ""
    return "yes" if _is_upper_bound(margin_db) else "no"


def _is_upper_bound(margin_db: ArrayLike) -> NDArray[np.bool_]:
    """Return whether levels are upper bounds, by their margin over the background (8.2.3)."""
    return np.asarray(margin_db) < MINIMUM_BACKGROUND_MARGIN_DB
