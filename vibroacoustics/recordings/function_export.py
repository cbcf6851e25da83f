"""Functions between nodes out, for other tools: UFF 58, 58b and CSV as bytes."""

from collections.abc import Sequence
from typing import Final

import numpy as np

from ..base import csv_text
from ..base.arrays import Array
from ..base.errors import ParameterError
from .measured_function import DIRECTIONS, KINDS, MeasuredFunction, Node
from .quantities import quantity
from .uff_functions import QUANTITY_TYPES

_MARK: Final = f"{-1:6d}\n"
_EVEN: Final = 1e-9
"""Steps of frequency that differ by less, as a share, are even."""


def functions_uff(
    functions: Sequence[MeasuredFunction], *, single: bool = False, text: bool = False
) -> bytes:
    """Datasets 58b, complex, double precision; SI units.

    Frequencies of even steps are stored as first and step with six digits, others in the precision
    of the values, in datasets 58 with six digits.

    Parameters
    ----------
    functions : to write
    single : single precision
    text : datasets 58, readable, of six and of thirteen digits
    """
    return b"".join(_dataset(function, single, text) for function in functions)


def _dataset(function: MeasuredFunction, single: bool, text: bool) -> bytes:
    step = np.diff(function.frequency_hz)
    even = step.size > 0 and bool(np.ptp(step) <= _EVEN * function.frequency_hz[-1])
    parts = np.stack([function.values.real, function.values.imag], axis=1)
    if text:
        content, head = _as_text(function.frequency_hz, parts, even, single), f"{58:6d}\n"
    else:
        size = "<f4" if single else "<f8"
        fields = [("x", size, ()), ("y", size, (2,))][1 if even else 0 :]
        points = np.zeros(len(parts), np.dtype(fields))
        points["y"] = parts
        if not even:
            points["x"] = function.frequency_hz
        content = points.tobytes()
        head = f"{58:6d}b{1:6d}{2:6d}{11:12d}{len(content):12d}{0:6d}{0:6d}{0:12d}{0:12d}\n"
    records = _records(function, even, 5 if single else 6)
    end = b"\n" if not text else b""
    return f"{_MARK}{head}{records}".encode() + content + end + _MARK.encode()


def _as_text(frequency_hz: Array, parts: Array, even: bool, single: bool) -> bytes:
    """6E13.5, 4E20.12 or E13.5, 2E20.12."""
    value = "{:13.5e}" if single else "{:20.12e}"
    if even:
        texts = [value.format(number) for number in parts.ravel()]
        per_line = 6 if single else 4
    else:
        rows = zip(frequency_hz, *parts.T, strict=True)
        texts = [
            f.format(n)
            for row in rows
            for f, n in zip(("{:13.5e}", value, value), row, strict=True)
        ]
        per_line = 6 if single else 3
    lines = ("".join(texts[first : first + per_line]) for first in range(0, len(texts), per_line))
    return "".join(f"{line}\n" for line in lines).encode()


def _records(function: MeasuredFunction, even: bool, ordinate_type: int) -> str:
    frequency = function.frequency_hz
    start, step = (frequency[0], frequency[1] - frequency[0]) if even else (0.0, 0.0)
    above = _side(function.response_unit)
    below = _side(function.reference_unit)
    lines = [
        f"{function}"[:80], "NONE", "NONE", "NONE", "NONE",
        f"{KINDS[function.kind]:5d}{0:10d}{0:5d}{0:10d}"
        f" {'NONE':10}{_node(function.response)} {'NONE':10}{_node(function.reference)}",
        f"{ordinate_type:10d}{frequency.size:10d}{int(even):10d}"
        f"{start:13.5e}{step:13.5e}{0.0:13.5e}",
        f"{18:10d}{0:5d}{0:5d}{0:5d} {'Frequency':20} {'Hz':20}",
        above, below, _side(""),
    ]  # fmt: skip
    return "".join(f"{line:<80}\n" for line in lines)


def _node(node: Node | None) -> str:
    """Node and direction: I10, I4."""
    codes = {direction: code for code, direction in DIRECTIONS.items()}
    return f"{0:10d}{0:4d}" if node is None else f"{node.number:10d}{codes[node.direction]:4d}"


def _side(unit: str) -> str:
    """Quantity and unit; the unit in ASCII."""
    types = {kind: number for number, kind in reversed(QUANTITY_TYPES.items())}
    kind = quantity(unit).kind if unit else ""
    number = 13 if kind == "force" else types.get(kind, 0)
    shown = unit.replace("²", "^2") or "NONE"
    return f"{number:10d}{0:5d}{0:5d}{0:5d} {'NONE':20} {shown:20}"


def functions_csv(functions: Sequence[MeasuredFunction]) -> bytes:
    """A table of real and imaginary parts, read back bit by bit.

    Parameters
    ----------
    functions : to write, of the same frequencies

    Raises
    ------
    ParameterError
        They differ in their frequencies.
    """
    frequency = functions[0].frequency_hz
    head, columns = ["frequency [Hz]"], [frequency]
    for function in functions:
        if not np.array_equal(function.frequency_hz, frequency):
            raise ParameterError(f"{function}: has other frequencies than {functions[0]}")
        if function.kind == "coherence":
            head.append(f"{function.label} coherence [1]")
            columns.append(function.values.real)
            continue
        is_auto = function.kind == "auto spectrum"
        label = str(function.response) if is_auto else function.label
        for part, values in (("real", function.values.real), ("imaginary", function.values.imag)):
            head.append(f"{label} {part} [{_unit(function)}]")
            columns.append(values)
    return csv_text.csv_bytes(head, np.column_stack(columns).tolist())


def _unit(function: MeasuredFunction) -> str:
    sign = "*" if function.kind.endswith(" spectrum") else "/"
    parts = (function.response_unit, function.reference_unit)
    return sign.join(part for part in parts if part)
