"""Analyses of what was computed from measurements: blocked forces, and predicted changes."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from typing import Final

import numpy as np
import xarray as xr

from ..base import rounding
from ..base.arrays import Array
from ..base.decibel import SILENCE_DB
from ..base.vocabulary import REFERENCE_OPTION
from ..results.conditional import ConditionalClaim
from ..results.number import Number
from .analysis import Analysis, origin
from .blocks import Bullets, Part, Pictures
from .conditions import band_claim, truncation_claim
from .figures.predicted import blocked_charts, predicted_charts
from .tables import Cell, DataTable, Table, data_table, phase_deg, records


def analysis_of_blocked_forces(
    blocked: xr.Dataset, further: Mapping[str, bytes] | None = None
) -> Analysis:
    """Return the validation in third octaves and over all lines, and the truncations.

    Parameters
    ----------
    blocked : result of `blocked_forces`
    further : content of further files by name
    """
    tables = (_validation(blocked), _bands(blocked), _truncation(blocked))
    notes = Bullets(tuple(_notes(blocked)))
    charts = Pictures(tuple(blocked_charts(blocked)))
    return Analysis(
        "blocked_forces",
        **origin(blocked, "Measurement"),
        about="Blocked forces (ISO 20270).",
        parts=(
            Part("validation", "On-board validation", (*tables[:2], charts)),
            Part("method", "Truncation and precision", (tables[2], notes)),
        ),
        shown=(*tables, notes),
        tables={"blocked_forces.csv": _forces(blocked), "validation.csv": _validations(blocked)},
        claims=tuple(_blocked_claims(blocked)),
        further=further or {},
        in_markdown="blocked_forces.md",
    )


def _blocked_claims(blocked: xr.Dataset) -> Iterator[ConditionalClaim]:
    """Band of the forces at the line with the largest, and the choice of the truncation."""
    size = np.abs(blocked["blocked_force"].values)
    point, line = np.unravel_index(int(size.argmax()), size.shape)
    ends = (float(blocked[f"blocked_force_{end}"][point, line]) for end in ("low", "high"))
    words = " to ".join(f"{rounding.significant(end)} N" for end in ends)
    subject = f"{blocked['force_point'].values[point]} at {blocked['frequency'].values[line]:g} Hz"
    yield band_claim(blocked, words, subject)
    errors = blocked["left_out_error"].values
    yield truncation_claim(float(blocked["inversion_truncation"]), errors)


def _predicted_claims(predicted: xr.Dataset) -> Iterator[ConditionalClaim]:
    """Bands of the A-weighted levels."""
    for option in _changes(predicted):
        for receiver in map(str, predicted["receiver"].values):
            selection = {"option": option, "receiver": receiver, "weighting": "A"}
            ends = [predicted[f"predicted_total_level{end}"].sel(selection).item() for end in _ENDS]
            words = f"{_band(ends, rounding.fixed)} dB(A)"
            yield band_claim(predicted, words, f"{option}, {receiver}")


_ENDS: Final = ("", "_low", "_high")


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


def _validations(blocked: xr.Dataset) -> DataTable:
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
        at_point, of_bands = blocked.sel(validation_point=name), bands.sel(validation_point=name)
        lines, differences = (
            np.abs(at_point["validation_difference"].values),
            of_bands.dropna("band"),
        )
        worst = differences[int(np.argmax(np.abs(differences.values)))]
        sizes = (np.median(lines), np.quantile(lines, 0.9), np.abs(differences).mean())
        cells = (rounding.fixed(float(size), 2) for size in sizes)
        largest = f"{rounding.signed(worst.item(), 2)} at {worst['band'].item():g} Hz"
        rows.append((name, str(at_point["validation_quantity"].item()), *cells, largest))
    head = ("Validation", "", "lines: median", "90 % of lines", "third octaves: mean", "largest")
    caption = "Predicted against measured where no force is inverted from, dB"
    return Table(caption, head, tuple(rows), frozenset({0, 1}))


def _bands(blocked: xr.Dataset) -> Table:
    parts = ("measured", "predicted", "difference", "difference_low", "difference_high")
    columns = {part: blocked[f"validation_band_{part}"] for part in parts}
    columns |= {"name": blocked["validation_point"], "hz": blocked["band"]}
    write = partial(rounding.signed, decimals=2)
    rows = []
    for row in records(data_table(("validation_point", "band"), columns)):
        if np.isfinite(row["measured"]):
            selection = {"validation_point": row["name"], "band": row["hz"]}
            values = [row[part] for part in parts[2:]]
            sizes = (rounding.fixed(row["measured"]), rounding.fixed(row["predicted"]))
            number = _number("validation_band_difference", selection, values, "dB", write)
            band = _band(values, write)
            rows.append((row["name"], f"{row['hz']:g}", *sizes, number, band))
    head = ("Validation", "Hz", "measured", "predicted", "difference", "90 % band")
    return Table("Third octaves, dB re 20 µPa, or re 1 µm/s²", head, tuple(rows))


def _truncation(blocked: xr.Dataset) -> Table:
    row = _truncated(blocked["inversion_truncation"], blocked["left_out_error"])
    caption = (
        "Truncation of singular values: the one taken, and the mean error with each of a response "
        "that the forces from all others make, dB"
    )
    return Table(caption, ("taken", *_tried(blocked)), (row,))


def _notes(blocked: xr.Dataset) -> list[str]:
    frequency, condition = blocked["frequency"].values, blocked["condition_number"].values
    notes = [
        *_accepted(blocked),
        _counted(frequency),
        f"Condition number: median {np.median(condition):.3g}, largest {condition.max():.3g} at "
        f"{frequency[int(np.argmax(condition))]:g} Hz.",
        f"Bands are from {blocked.attrs['draws']} samples of the random measurement errors.",
    ]
    if np.all(np.isnan(blocked["left_out_error"].values)):
        notes.append(
            "No truncation could be chosen: responses are as few as forces. Measure more responses."
        )
    return notes


def analysis_of_prediction(predicted: xr.Dataset) -> Analysis:
    """Return levels of all lines before and after each change, with 90 % bands."""
    notes = Bullets(tuple(_predicted_notes(predicted)))
    totals, truncations = _totals(predicted), _truncations(predicted)
    return Analysis(
        "prediction",
        **origin(predicted, "Measurement"),
        about="Predicted from measurements alone.",
        parts=(
            Part("levels", "Levels", (totals, Pictures(tuple(predicted_charts(predicted))))),
            Part("method", "Truncation and precision", (truncations, notes)),
        ),
        shown=(totals, truncations, notes),
        tables={"prediction.csv": _lines(predicted)},
        claims=tuple(_predicted_claims(predicted)),
        in_markdown="prediction.md",
    )


def _lines(predicted: xr.Dataset) -> DataTable:
    """Every line of every microphone before and after each change, with its 90 % band."""
    levels = predicted["predicted_level"]
    after = predicted.sel(option=_changes(predicted))
    columns = {
        "change": after["option"],
        "microphone": after["receiver"],
        "frequency_hz": after["frequency"],
        "measured_db": levels.sel(option=REFERENCE_OPTION, drop=True),
        "predicted_db": after["predicted_level"],
        "low_db": after["predicted_level_low"],
        "high_db": after["predicted_level_high"],
    }
    return data_table(("option", "receiver", "frequency"), columns)


def _changes(predicted: xr.Dataset) -> list[str]:
    return [str(name) for name in predicted["option"].values if name != REFERENCE_OPTION]


def _totals(predicted: xr.Dataset) -> Table:
    def cells(name: str, unit: str, **selection: str) -> tuple[Cell, str]:
        values = [predicted[f"{name}{end}"].sel(selection).item() for end in _ENDS]
        write = rounding.signed if name.endswith("change") else rounding.fixed
        return _number(name, selection, values, unit, write), _band(values, write)

    rows = []
    for option in _changes(predicted):
        for receiver in map(str, predicted["receiver"].values):
            for weighting, unit in (("Z", "dB"), ("A", "dB(A)")):
                coordinates = {"receiver": receiver, "weighting": weighting}
                before, _ = cells(
                    "predicted_total_level", unit, option=REFERENCE_OPTION, **coordinates
                )
                after = cells("predicted_total_level", unit, option=option, **coordinates)
                change = cells("predicted_total_change", "dB", option=option, **coordinates)
                rows.append((option, receiver, unit, before, *after, *change))
    head = ("Change", "Microphone", "", "measured", "predicted", "90 % band", "change", "90 % band")
    caption = "All lines together: level as measured and as predicted"
    return Table(caption, head, tuple(rows), frozenset({0, 1, 2}))


def _band(values: Sequence[float], write: Callable[[float], str]) -> str:
    """Return the band in words."""
    if np.isnan(values[1]):
        return "unknown"
    low = "silence" if values[1] <= SILENCE_DB / 2.0 else write(values[1])
    return f"{low} to {write(values[2])}"


def _number(
    name: str,
    selection: Mapping[str, str | float],
    values: Sequence[float],
    unit: str,
    write: Callable[[float], str],
) -> Number:
    value, low, high = values
    return Number(value, unit, name, selection, low=low, high=high, text=write(value))


def _truncations(predicted: xr.Dataset) -> Table:
    """Truncation that was used, beside the error that each one is expected to make."""
    taken, errors = predicted["truncation"], predicted["truncation_error"]
    rows = [
        (option, *_truncated(taken.sel(option=option), errors.sel(option=option)))
        for option in _changes(predicted)
    ]
    caption = (
        "Truncation of singular values: the one taken, and the mean error of a line's level that "
        "each is expected to make, dB"
    )
    return Table(caption, ("Change", "taken", *_tried(predicted)), tuple(rows))


def _tried(results: xr.Dataset) -> list[str]:
    return [f"{share:.1%}" for share in results["tried_truncation"].values]


def _truncated(taken: xr.DataArray, errors: xr.DataArray) -> tuple[str, ...]:
    """The truncation that was taken, and the error with each that was tried."""
    return f"{taken.item():.1%}", *(rounding.fixed(error, 2) for error in errors.values)


def _counted(frequency: Array) -> str:
    return f"{frequency.size} lines from {frequency[0]:g} to {frequency[-1]:g} Hz."


def _accepted(results: xr.Dataset) -> list[str]:
    """Faults of the measurements that were accepted."""
    lines = str(results.attrs.get("faults", "")).splitlines()
    return [f"No bands: fault accepted, {line}." for line in lines]


def _predicted_notes(predicted: xr.Dataset) -> list[str]:
    if predicted.attrs.get("faults"):
        return [*_accepted(predicted), _counted(predicted["frequency"].values)]
    width = predicted["predicted_level_high"] - predicted["predicted_level_low"]
    after = width.sel(option=_changes(predicted))
    half = rounding.fixed(float(np.median(after)) / 2.0)
    return [
        _counted(predicted["frequency"].values),
        f"Half the width of a line's 90 % band: median {half} dB.",
        f"Bands are from {predicted.attrs['draws']} samples of the random measurement errors; "
        "what is not linear, sources that react and errors that all measurements share are not in "
        "them.",
    ]
