"""What was predicted from measurements alone, as plain text, CSV and Markdown."""

import numpy as np
import xarray as xr

from ..base import rounding
from ..base.decibel import SILENCE_DB
from ..base.vocabulary import REFERENCE_OPTION
from .file_names import numbered
from .tables import Table, dataset_csv, escape_markdown, to_markdown, to_text


def prediction_text(predicted: xr.Dataset) -> str:
    """Levels of all lines before and after, with 90 % bands, and the truncations."""
    tables = [to_text(table, 32) for table in (_totals(predicted), _truncations(predicted))]
    return "\n".join([*tables, *_notes(predicted)])


def prediction_markdown(predicted: xr.Dataset) -> bytes:
    """A short report: tables, notes and the figures beside it."""
    pictures = [
        f"![{escape_markdown(name)}](prediction_{file}.svg)"
        for name, file in numbered(predicted, "receiver")
    ]
    parts = [
        f"# {escape_markdown(predicted.attrs['title'])}",
        f"Predicted from measurements alone. Computed {predicted.attrs['created_utc']}.",
        to_markdown(_totals(predicted)),
        *pictures,
        to_markdown(_truncations(predicted)),
        "\n".join(f"- {note}" for note in _notes(predicted)),
    ]
    return ("\n\n".join(parts) + "\n").encode()


def prediction_csv(predicted: xr.Dataset) -> bytes:
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
    return dataset_csv(("option", "receiver", "frequency"), columns)


def _changes(predicted: xr.Dataset) -> list[str]:
    return [str(name) for name in predicted["option"].values if name != REFERENCE_OPTION]


def _totals(predicted: xr.Dataset) -> Table:
    rows = [
        (
            option,
            str(receiver),
            f"dB({weighting})" if weighting != "Z" else "dB",
            rounding.fixed(_value(predicted, "predicted_total_level", REFERENCE_OPTION, at)),
            *_with_band(predicted, "predicted_total_level", option, at),
            *_with_band(predicted, "predicted_total_change", option, at, is_signed=True),
        )
        for option in _changes(predicted)
        for receiver in predicted["receiver"].values
        for weighting in ("Z", "A")
        for at in [{"receiver": receiver, "weighting": weighting}]
    ]
    head = ("Change", "Microphone", "", "measured", "predicted", "90 % band", "change", "90 % band")
    return Table(
        "All lines together: level as measured and as predicted",
        head,
        tuple(rows),
        frozenset({0, 1, 2}),
    )


def _value(predicted: xr.Dataset, name: str, option: str, at: dict[str, str]) -> float:
    return float(predicted[name].sel({"option": option, **at}))


def _with_band(
    predicted: xr.Dataset, name: str, option: str, at: dict[str, str], is_signed: bool = False
) -> tuple[str, str]:
    show = rounding.signed if is_signed else rounding.fixed
    value, low, high = (
        _value(predicted, f"{name}{end}", option, at) for end in ("", "_low", "_high")
    )
    lowest = "silence" if low <= SILENCE_DB / 2.0 else show(low)
    return show(value), f"{lowest} to {show(high)}"


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
