"""Analysis of what was predicted from measurements alone."""

import numpy as np
import xarray as xr

from ..base import rounding
from ..base.decibel import SILENCE_DB
from ..base.vocabulary import REFERENCE_OPTION
from ..results.number import Number
from .analysis import Analysis, origin
from .blocks import Block, Bullets, Part, Pictures
from .figures.predicted import predicted_charts
from .tables import Cell, DataTable, Table, data_table


def analysis_of_prediction(predicted: xr.Dataset) -> Analysis:
    """Return levels of all lines before and after each change, with 90 % bands."""
    totals, *others = blocks = _blocks(predicted)
    return Analysis(
        "prediction",
        **origin(predicted, "Measurement"),
        about="Predicted from measurements alone.",
        parts=(
            Part("levels", "Levels", (totals, Pictures(tuple(predicted_charts(predicted))))),
            Part("method", "Truncation and precision", tuple(others)),
        ),
        shown=blocks,
        tables={"prediction.csv": _lines(predicted)},
        in_markdown="prediction.md",
    )


def _blocks(predicted: xr.Dataset) -> tuple[Block, ...]:
    return _totals(predicted), _truncations(predicted), Bullets(tuple(_notes(predicted)))


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
    rows = [
        (
            option,
            str(receiver),
            unit,
            _number(predicted, "predicted_total_level", REFERENCE_OPTION, at, unit),
            *_with_band(predicted, "predicted_total_level", option, at, unit),
            *_with_band(predicted, "predicted_total_change", option, at, "dB"),
        )
        for option in _changes(predicted)
        for receiver in predicted["receiver"].values
        for weighting, unit in (("Z", "dB"), ("A", "dB(A)"))
        for at in [{"receiver": str(receiver), "weighting": weighting}]
    ]
    head = ("Change", "Microphone", "", "measured", "predicted", "90 % band", "change", "90 % band")
    return Table(
        "All lines together: level as measured and as predicted",
        head,
        tuple(rows),
        frozenset({0, 1, 2}),
    )


def _number(predicted: xr.Dataset, name: str, option: str, at: dict[str, str], unit: str) -> Number:
    selection = {"option": option, **at}
    value, low, high = (
        float(predicted[f"{name}{end}"].sel(selection)) for end in ("", "_low", "_high")
    )
    show = rounding.signed if name.endswith("change") else rounding.fixed
    return Number(value, unit, name, selection, low=low, high=high, text=show(value))


def _with_band(
    predicted: xr.Dataset, name: str, option: str, at: dict[str, str], unit: str
) -> tuple[Cell, str]:
    value = _number(predicted, name, option, at, unit)
    show = rounding.signed if name.endswith("change") else rounding.fixed
    low, high = float(value.low or 0.0), float(value.high or 0.0)
    return value, f"{'silence' if low <= SILENCE_DB / 2.0 else show(low)} to {show(high)}"


def _truncations(predicted: xr.Dataset) -> Table:
    """Which truncation was taken, beside the error that each one is expected to make."""
    tried = predicted["tried_truncation"].values
    rows = [
        (
            option,
            f"{predicted['truncation'].sel(option=option).item():.1%}",
            *(rounding.fixed(error, 2) for error in errors.values),
        )
        for option in _changes(predicted)
        for errors in [predicted["truncation_error"].sel(option=option)]
    ]
    head = ("Change", "taken", *(f"{share:.1%}" for share in tried))
    return Table(
        "Truncation of singular values: the one taken, and the mean error of a line's level that "
        "each is expected to make, dB",
        head,
        tuple(rows),
    )


def _notes(predicted: xr.Dataset) -> list[str]:
    frequency = predicted["frequency"].values
    width = predicted["predicted_level_high"] - predicted["predicted_level_low"]
    after = width.sel(option=_changes(predicted))
    half = rounding.fixed(float(np.median(after)) / 2.0)
    return [
        f"{frequency.size} lines from {frequency[0]:g} to {frequency[-1]:g} Hz.",
        f"Half the width of a line's 90 % band: median {half} dB.",
        f"Bands are of {predicted.attrs['draws']} draws of the random errors of the measurements; "
        "what is not linear, sources that react and errors that all measurements share are not in "
        "them.",
    ]
