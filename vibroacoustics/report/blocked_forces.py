"""Blocked forces and their validation, as plain text, CSV and Markdown."""

import numpy as np
import xarray as xr

from ..base import rounding
from .tables import (
    Table,
    dataset_csv,
    escape_markdown,
    phase_deg,
    records,
    to_markdown,
    to_text,
)


def blocked_text(blocked: xr.Dataset) -> str:
    """The validation in third octaves and over all lines, and the truncations."""
    tables = (_validation(blocked), _bands(blocked), _truncation(blocked))
    return "\n".join([*(to_text(table, 32) for table in tables), *_notes(blocked)])


def blocked_markdown(blocked: xr.Dataset) -> bytes:
    """A short report: tables, notes and the figures beside it."""
    parts = [
        f"# {escape_markdown(blocked.attrs['title'])}",
        f"Blocked forces (ISO 20270). Computed {blocked.attrs['created_utc']}.",
        to_markdown(_validation(blocked)),
        "![On-board validation](validation.svg)",
        to_markdown(_bands(blocked)),
        "![Blocked forces](blocked_forces.svg)",
        to_markdown(_truncation(blocked)),
        "\n".join(f"- {note}" for note in _notes(blocked)),
    ]
    return ("\n\n".join(parts) + "\n").encode()


def blocked_csv(blocked: xr.Dataset) -> bytes:
    """Every blocked force at every line: amplitude with its 90 % band, and phase."""
    columns = {
        "point": blocked["force_point"],
        "frequency_hz": blocked["frequency"],
        "force_n": abs(blocked["blocked_force"]),
        "phase_deg": phase_deg(blocked["blocked_force"]),
        "low_n": blocked["blocked_force_low"],
        "high_n": blocked["blocked_force_high"],
    }
    return dataset_csv(("force_point", "frequency"), columns)


def validation_csv(blocked: xr.Dataset) -> bytes:
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
    return dataset_csv(("validation_point", "frequency"), columns)


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
            rounding.signed(row["difference"], 2),
            f"{rounding.signed(low, 2)} to {rounding.signed(high, 2)}",
        )
        for row in records(("validation_point", "band"), columns)
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
