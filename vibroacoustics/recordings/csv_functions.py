"""Functions between nodes from a CSV table: `frequency [Hz],12+z/3+z real [m/s²/N],…`."""

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Final, NamedTuple

import numpy as np

from ..base.arrays import Array, ComplexArray
from ..base.errors import ParameterError, StorageError, VibroacousticsError
from .csv_head import Head, read_head
from .measured_function import MeasuredFunction, Node
from .quantities import Quantity, find_quantity, quantity
from .text_lines import lines, opened, text

ALLOWED: Final = (
    "acceleration", "velocity", "displacement", "force", "moment", "sound pressure",
)  # fmt: skip
_SQUARE: Final = re.compile(r"\(?(?P<unit>.*?)\)?(?:²|\^2|\*\*2)")


class Units(NamedTuple):
    """SI units of response and reference, the latter empty of a spectrum, and the factor to SI."""

    response: str
    reference: str
    factor: float


def ratio(text: str) -> Units | None:
    """`m/s²/N` as response and reference; None where it is no such ratio."""
    numerator, slash, denominator = text.strip().rpartition("/")
    above, below = _known(numerator), _known(denominator)
    if not slash or above is None or below is None:
        return None
    return Units(above.unit, below.unit, above.factor / below.factor)


def product(text: str) -> Units | None:
    """`Pa*N` or `(m/s²)²` as units of a mean square; None where it is neither."""
    if "*" in text:
        first, _, second = text.partition("*")
    else:
        square = _SQUARE.fullmatch(text.strip())
        if square is None or find_quantity(text) is not None:
            return None
        first = second = square["unit"]
    numerator, other = _known(first), _known(second)
    return (
        numerator and other and Units(numerator.unit, other.unit, numerator.factor * other.factor)
    )


def single(text: str) -> Units:
    """Unit of a spectrum."""
    measured = quantity(text)
    return Units(checked(measured, text).unit, "", measured.factor)


def checked(measured: Quantity, text: str) -> Quantity:
    """The quantity, if it is one that a function may have.

    Raises
    ------
    ParameterError
        It is another.
    """
    if measured.kind not in ALLOWED:
        raise ParameterError(
            f"unit {text!r} is of {measured.kind}; allowed are {', '.join(ALLOWED)}"
        )
    return measured


def _known(text: str) -> Quantity | None:
    plain = text.strip()
    if plain.startswith("(") and plain.endswith(")"):
        plain = plain[1:-1]
    measured = find_quantity(plain)
    return measured if measured is not None and measured.kind in ALLOWED else None


_NODE: Final = r"(\d{1,9})([+-]r?[xyz])?"
_COLUMN: Final = re.compile(rf"{_NODE}(?:/{_NODE})?\s+(\w+)")
_PARTS: Final = ("real", "imaginary", "amplitude", "phase", "coherence")
_PAIRS: Final = ({"real"}, {"real", "imaginary"}, {"amplitude", "phase"}, {"coherence"})
_PHASE_UNITS: Final = {"°": np.pi / 180.0, "deg": np.pi / 180.0, "rad": 1.0}
_HEAD_LINES: Final = 50

Columns = dict[str, tuple[str, Array]]
"""Unit and numbers by part."""


def read_csv(path: Path, units: Mapping[str, str]) -> list[MeasuredFunction]:
    """Functions of a table; see `read_functions`. Every column states its unit."""
    with opened(path) as file:
        rows = [text(line).rstrip("\r\n") for line in lines(file)]
    head = read_head(rows[:_HEAD_LINES])
    table = _numbers(rows[head.lines :], head)
    first, unit = head.names[0].lower(), head.units[0]
    if first not in ("frequency", "f") or unit != "Hz":
        raise ParameterError(f"first column {head.names[0]!r} [{unit}]: must be 'frequency [Hz]'")
    functions: dict[tuple[str, bool], Columns] = {}
    for number, name in enumerate(head.names[1:], 1):
        match = _COLUMN.fullmatch(name.strip())
        if match is None or match[5] not in _PARTS:
            raise ParameterError(
                f"column {name!r}: must be NODE/NODE PART, such as '12+z/3+z real', PART one of "
                f"{', '.join(_PARTS)}"
            )
        columns = functions.setdefault((name.split()[0], match[5] == "coherence"), {})
        if match[5] in columns:
            raise ParameterError(f"column {name!r}: is there twice")
        columns[match[5]] = (head.units[number], table[:, number])
    return [_function(label, table[:, 0], columns) for (label, _), columns in functions.items()]


def _numbers(rows: list[str], head: Head) -> Array:
    """All numbers, shape (row, column)."""
    table = []
    for number, row in enumerate(rows, head.lines + 1):
        if not row.strip():
            continue
        try:
            table.append([float(cell) for cell in head.cells(row)])
        except ValueError:
            raise StorageError(f"line {number}: holds something that is no number") from None
        if len(table[-1]) != len(head.names):
            raise StorageError(
                f"line {number}: has {len(table[-1])} columns, the header {len(head.names)}"
            )
    return np.array(table)


def _function(label: str, frequency_hz: Array, columns: Columns) -> MeasuredFunction:
    try:
        response, reference = _nodes(label)
        if set(columns) not in _PAIRS:
            raise ParameterError(
                f"has {' and '.join(columns)} alone: needs real and imaginary, amplitude and "
                "phase, or coherence"
            )
        unit, kind = _unit_and_kind(columns, reference)
        if kind == "auto spectrum":
            reference = response
        values = _values(columns) * unit.factor
        return MeasuredFunction(kind, frequency_hz, values, response, reference, *unit[:2])
    except VibroacousticsError as error:
        raise type(error)(f"{label}: {error}") from None


def _nodes(label: str) -> tuple[Node, Node | None]:
    response, _, reference = label.partition("/")
    return _node(response), _node(reference) if reference else None


def _node(label: str) -> Node:
    match = re.fullmatch(_NODE, label)
    assert match is not None  # noqa: S101 - the column's name holds it
    return Node(int(match[1]), match[2] or "")


def _unit_and_kind(columns: Columns, reference: Node | None) -> tuple[Units, str]:
    """Units of the values, and the kind of function that they make it."""
    named = {part: unit for part, (unit, _) in columns.items() if part != "phase"}
    if len(set(named.values())) > 1:
        raise ParameterError(f"its columns differ in unit: {', '.join(named.values())}")
    (unit, *_) = named.values()
    if "coherence" in columns:
        if unit not in ("1", "-", ""):
            raise ParameterError(f"coherence has the unit {unit!r}; must be 1")
        if reference is None:
            raise ParameterError("coherence needs a reference, as in '12+z/3+z coherence'")
        return Units("1", "", 1.0), "coherence"
    if not unit:
        raise ParameterError("states no unit: write it as in 'real [m/s²/N]'")
    square = product(unit)
    if square is not None:
        return square, "auto spectrum" if reference is None else "cross spectrum"
    if reference is None:
        return single(unit), "spectrum"
    units = ratio(unit)
    if units is None:
        raise ParameterError(
            f"unit {unit!r}: must be a response by a reference such as m/s²/N, m/N, Pa/N, or a "
            "product such as Pa*N of a cross spectrum"
        )
    return units, "frequency response"


def _values(columns: Columns) -> ComplexArray:
    """Complex values of the parts."""
    if "phase" in columns:
        unit, phase = columns["phase"]
        if unit not in _PHASE_UNITS:
            raise ParameterError(f"phase has the unit {unit!r}; allowed are °, deg, rad")
        return np.asarray(columns["amplitude"][1] * np.exp(1j * phase * _PHASE_UNITS[unit]))
    real = columns.get("real", columns.get("coherence", ("", np.zeros(0))))[1]
    imaginary = columns["imaginary"][1] if "imaginary" in columns else 0.0
    return np.asarray(real + 1j * imaginary)
