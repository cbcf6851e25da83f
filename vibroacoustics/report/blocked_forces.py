"""Analysis of blocked forces and their validation."""

from collections.abc import Mapping

import numpy as np
import xarray as xr

from ..base import rounding
from ..results.number import Number
from .analysis import Analysis, origin
from .blocks import Bullets, Part, Pictures
from .figures.predicted import blocked_charts
from .tables import DataTable, Table, data_table, phase_deg, records


def analysis_of_blocked_forces(
    blocked: xr.Dataset, further: Mapping[str, bytes] | None = None
) -> Analysis:
    """Return the validation in third octaves and over all lines, and the truncations.

    Parameters
    ----------
    blocked : of `blocked_forces`
    further : content of further files by name
    """
    tables = (_validation(blocked), _bands(blocked), _truncation(blocked))
    notes = Bullets(tuple(_notes(blocked)))
    drawn = Pictures(tuple(blocked_charts(blocked)))
    return Analysis(
        "blocked_forces",
        **origin(blocked, "Measurement"),
        about="Blocked forces (ISO 20270).",
        parts=(
            Part("validation", "On-board validation", (*tables[:2], drawn)),
            Part("method", "Truncation and precision", (tables[2], notes)),
        ),
        shown=(*tables, notes),
        tables={"blocked_forces.csv": _forces(blocked), "validation.csv": _lines(blocked)},
        further=further or {},
        in_markdown="blocked_forces.md",
    )


def _forces(blocked: xr.Dataset) -> DataTable:
    """Every blocked force at every line: amplitude with its 90 % band, and phase."""
    columns = {
        "point": blocked["force_point"],
        "frequency_hz": blocked["frequency"],
        "force_n": abs(blocked["blocked_force"]),
        "phase_deg": phase_deg(blocked["blocked_force"]),
        "low_n": blocked["blocked_force_low"],
        "high_n": blocked["blocked_force_high"],
    }
    return data_table(("force_point", "frequency"), columns)


def _lines(blocked: xr.Dataset) -> DataTable:
    """Every line of every validation: measured, predicted with its band, difference."""
    columns = {
        "validation": blocked["validation_point"],
        "quantity": blocked["validation_quantity"],
        "frequency_hz": blocked["frequency"],
        "measured_db": blocked["validation_measured"],
        "predicted_db": blocked["validation_predicted"],
        "low_db": blocked["validation_predicted_low"],
        "high_db": blocked["validation_predicted_high"],
        "difference_db": blocked["validation_difference"],
    }
    return data_table(("validation_point", "frequency"), columns)


def _validation(blocked: xr.Dataset) -> Table:
    bands = blocked["validation_band_difference"]
    rows = []
    for name in map(str, blocked["validation_point"].values):
        at, of_bands = blocked.sel(validation_point=name), bands.sel(validation_point=name)
        lines, largest = np.abs(at["validation_difference"].values), of_bands.dropna("band")
        worst = largest[int(np.argmax(np.abs(largest.values)))]
        rows.append(
            (
                name,
                str(at["validation_quantity"].item()),
                rounding.fixed(float(np.median(lines)), 2),
                rounding.fixed(float(np.quantile(lines, 0.9)), 2),
                rounding.fixed(float(np.abs(largest).mean()), 2),
                f"{rounding.signed(worst.item(), 2)} at {worst['band'].item():g} Hz",
            )
        )
    head = ("Validation", "", "lines: median", "90 % of lines", "third octaves: mean", "largest")
    caption = "Predicted against measured where no force is inverted from, dB"
    return Table(caption, head, tuple(rows), frozenset({0, 1}))


def _bands(blocked: xr.Dataset) -> Table:
    parts = ("measured", "predicted", "difference", "difference_low", "difference_high")
    columns = {part: blocked[f"validation_band_{part}"] for part in parts}
    columns |= {"name": blocked["validation_point"], "hz": blocked["band"]}
    rows = tuple(
        (
            row["name"],
            f"{row['hz']:g}",
            rounding.fixed(row["measured"]),
            rounding.fixed(row["predicted"]),
            Number(
                row["difference"],
                "dB",
                "validation_band_difference",
                {"validation_point": row["name"], "band": row["hz"]},
                low=low,
                high=high,
                text=rounding.signed(row["difference"], 2),
            ),
            f"{rounding.signed(low, 2)} to {rounding.signed(high, 2)}",
        )
        for row in records(data_table(("validation_point", "band"), columns))
        for low, high in [(row["difference_low"], row["difference_high"])]
        if np.isfinite(row["measured"])
    )
    head = ("Validation", "Hz", "measured", "predicted", "difference", "90 % band")
    return Table("Third octaves, dB re 20 µPa, or re 1 µm/s²", head, rows, frozenset({0}))


def _truncation(blocked: xr.Dataset) -> Table:
    errors = blocked["left_out_error"]
    cells = ["–" if np.isnan(error) else rounding.fixed(error, 2) for error in errors.values]
    head = ("taken", *(f"{share:.1%}" for share in errors["tried_truncation"].values))
    return Table(
        "Truncation of singular values: the one taken, and the mean error with each of a response "
        "that the forces from all others make, dB",
        head,
        ((f"{blocked['inversion_truncation'].item():.1%}", *cells),),
    )


def _notes(blocked: xr.Dataset) -> list[str]:
    frequency, condition = blocked["frequency"].values, blocked["condition_number"].values
    notes = [
        f"{frequency.size} lines from {frequency[0]:g} to {frequency[-1]:g} Hz.",
        f"Condition number: median {np.median(condition):.3g}, largest {condition.max():.3g} at "
        f"{frequency[int(np.argmax(condition))]:g} Hz.",
        f"Bands are of {blocked.attrs['draws']} draws of the random errors of the measurements.",
    ]
    if np.all(np.isnan(blocked["left_out_error"].values)):
        notes.append("As many responses as forces: no truncation could be chosen; measure more.")
    return notes
