"""UFF datasets 58 and 58b, function types 2, 3, 4, 6 and 12: functions between nodes."""

from collections.abc import Mapping
from pathlib import Path
from typing import BinaryIO, Final

import numpy as np

from ..base.arrays import Array
from ..base.errors import ParameterError, StorageError, VibroacousticsError
from .csv_functions import Units, checked, product, ratio
from .measured_function import DIRECTIONS, KINDS, MeasuredFunction, Node
from .quantities import quantity
from .recorded import check_size
from .remarks import remark
from .uff58 import Header, datasets
from .uff58_values import ordinates

QUANTITY_TYPES: Final = {
    8: "displacement",
    9: "force",
    11: "velocity",
    12: "acceleration",
    13: "force",
    15: "sound pressure",
}
"""Specific data types, records 9 and 10, field 1."""
NO_UNIT_TYPES: Final = (0, 1)
"""Specific data types `unknown` and `general`."""
_FREQUENCY: Final = 18
_UNIT: Final = slice(47, 67)


def read_uff(path: Path, units: Mapping[str, str]) -> list[MeasuredFunction]:
    """Functions of a universal file; see `read_functions`."""
    kinds = {number: kind for kind, number in KINDS.items()}
    with path.open("rb") as file:
        contents = datasets(file)
        wanted = [header for header in contents.functions if header.function_type in kinds]
        if not wanted:
            types = sorted({header.function_type for header in contents.functions})
            raise ParameterError(
                f"holds no function of type {', '.join(map(str, kinds))} (dataset 58), only {types}"
            )
        check_size(1, sum(header.numbers for header in wanted))
        remark(path, contents.remarks)
        return [
            _function(file, header, kinds[header.function_type], units, number)
            for number, header in enumerate(wanted, 1)
        ]


def _function(
    file: BinaryIO, header: Header, kind: str, units: Mapping[str, str], number: int
) -> MeasuredFunction:
    where = f"function {number}, {kind}"
    try:
        response = _node(header.records[5][41:55], "response")
        reference = response if kind == "auto spectrum" else None
        if kind not in ("auto spectrum", "spectrum"):
            reference = _node(header.records[5][66:80], "reference")
        where = f"{where} {response}" if reference is None else f"{where} {response}/{reference}"
        unit = _units(header, kind, units)
        values, abscissa = ordinates(file, header)
        frequency = _frequency(header, abscissa)
        return MeasuredFunction(
            kind, frequency, values * (unit.factor + 0j), response, reference, *unit[:2]
        )
    except VibroacousticsError as error:
        raise type(error)(f"{where}: {error}") from None


def _node(fields: str, role: str) -> Node:
    """Node and direction of record 6: I10, I4."""
    try:
        number, direction = int(fields[:10]), int(fields[10:14] or 0)
    except ValueError:
        raise StorageError(f"{role}: node and direction {fields!r} are no numbers") from None
    if direction not in DIRECTIONS:
        raise ParameterError(f"{role}: direction {direction}: must be from -6 to 6")
    return Node(number, DIRECTIONS[direction])


def _frequency(header: Header, abscissa: Array | None) -> Array:
    kind = _type_of(header.records[7], "abscissa")
    unit = header.records[7][_UNIT].strip()
    if kind not in (0, 1, _FREQUENCY) or unit not in ("", "NONE", "Hz", "HZ", "hz"):
        raise ParameterError(f"abscissa of type {kind}, unit {unit!r}: must be frequency, Hz")
    if abscissa is not None:
        return abscissa.astype(float)
    try:
        start = float(header.records[6][30:43].replace("D", "E") or 0.0)
    except ValueError:
        raise StorageError("abscissa minimum is no number: damaged") from None
    return np.asarray(start + header.increment * np.arange(header.points))


def _units(header: Header, kind: str, units: Mapping[str, str]) -> Units:
    """SI units of response and reference and the factor of the values."""
    if kind == "coherence":
        return Units("1", "", 1.0)
    numerator, denominator = header.records[8], header.records[9]
    text = numerator[_UNIT].strip()
    both_units = ratio(text) if kind == "frequency response" else product(text)
    if both_units is not None and kind != "spectrum":
        _same_kind(_type_of(numerator, "ordinate"), both_units.response)
        return both_units
    above, above_factor = _side(numerator, "ordinate", units)
    if kind == "spectrum":
        return Units(above, "", above_factor)
    if kind == "auto spectrum":
        return Units(above, above, above_factor**2)
    below, below_factor = _side(denominator, "ordinate denominator", units)
    power = -1 if kind == "frequency response" else 1
    return Units(above, below, above_factor * below_factor**power)


def _side(record: str, role: str, units: Mapping[str, str]) -> tuple[str, float]:
    """SI unit and factor of record 9 or 10, whose quantity and unit must agree."""
    kind, text = _type_of(record, role), record[_UNIT].strip()
    if text.upper() in ("", "NONE"):
        text = units.get(QUANTITY_TYPES.get(kind, ""), "")
    if not text:
        named = QUANTITY_TYPES.get(kind, "no quantity")
        raise ParameterError(
            f"{role}: states {named} (type {kind}) and no unit: give it, as in "
            f"units: {named if kind in QUANTITY_TYPES else 'acceleration'} = 'm/s²'"
        )
    measured = checked(quantity(text), text)
    _same_kind(kind, measured.unit)
    return measured.unit, measured.factor


def _same_kind(kind: int, unit: str) -> None:
    stated = QUANTITY_TYPES.get(kind)
    if kind in NO_UNIT_TYPES or stated == quantity(unit).kind:
        return
    raise ParameterError(
        f"unit {unit} is of {quantity(unit).kind}, the file says {stated or 'another quantity'} "
        f"(type {kind})"
    )


def _type_of(record: str, role: str) -> int:
    try:
        return int(record[:10] or 0)
    except ValueError:
        raise StorageError(f"{role}: data type {record[:10]!r}: is no number: damaged") from None
