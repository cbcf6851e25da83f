"""Remarks for the user on a file that was read."""

import warnings
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, Final

MAY_STAY: Final = ("rpm", "rad/s", "rad", "1")
"""Units of channels that stay at one value, or jump from one to another."""
MAY_BE_PULSES: Final = "V"
"""Unit of tachos and switches, which are at one extreme or the other for most of the time."""
_LEAST_BETWEEN: Final = 0.5
"""Share of the samples between the extremes; pulses have fewer."""


class RecordingWarning(UserWarning):
    """Warning that the file of a recording holds something that the user must know.

    Examples
    --------
    >>> import warnings
    >>> warnings.simplefilter("error", va.RecordingWarning)  # refuse such recordings
    """


class SuspectWarning(RecordingWarning):
    """Warning of a channel that no working sensor can have recorded."""


def remark(
    path: Path, lines: Iterable[str], kind: type[RecordingWarning] = RecordingWarning
) -> None:
    """Warn of each line, with the file before it."""
    for line in lines:
        warnings.warn(f"{path}: {line}", kind, stacklevel=3)


def may_be_full(unit: str, between: float) -> bool:
    """Whether a channel of a unit may have samples at its extremes, by the share between them."""
    return unit in MAY_STAY or (unit == MAY_BE_PULSES and between < _LEAST_BETWEEN)


def overload_lines(header: Mapping[str, Any], units: Iterable[str]) -> list[str]:
    """A line for each channel with samples at full scale."""
    lines = []
    for name, unit, overload in zip(header["names"], units, header["overloads"], strict=True):
        if overload is None or may_be_full(str(unit), overload["between"]):
            continue
        time_s = (header["first_sample"] + overload["first"]) / header["sample_rate_hz"]
        lines.append(
            f"channel {name!r}: {overload['samples']} samples are at full scale, the first at "
            f"{time_s:.9g} s: the recorder may have been overloaded"
        )
    return lines
