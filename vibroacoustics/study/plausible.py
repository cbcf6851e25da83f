"""Values that are allowed and hardly right: a decimal point or a unit may be wrong."""

import warnings
from collections.abc import Iterator, Sequence
from typing import Final

from ..base.units import UNITS, Unit, split_key
from ..machine.machine import Machine
from ..machine.usual import Usual, usual_of
from .reader import Reader, is_number

OF_A_STUDY: Final = ("options", "receivers")
"""Tables of a study whose sizes go with those of the machine."""
MOST_LINES: Final = 12
"""Doubts that are printed; the others are counted."""


def warn_of_doubts(
    machine: Machine,
    of_machine: Reader,
    of_study: Reader | None = None,
    speeds_rpm: Sequence[float] = (),
) -> None:
    """Warn of values that are far from usual, with the unit that is likely.

    Parameters
    ----------
    machine : to which the values belong, nominal or as an option changes it
    of_machine : reader of its file
    of_study : reader of the study, of which some tables are judged
    speeds_rpm : speeds of the study, against which the machine is judged
    """
    lines = [*_doubts(machine, of_machine, tuple(type(machine).model_fields))]
    lines += [f"{of_machine.path}: {words}" for words in machine.doubts()]
    if of_study is not None:
        lines += _doubts(machine, of_study, OF_A_STUDY)
        lines += [f"{of_study.path}: {words}" for words in machine.doubts_at(speeds_rpm)]
    for line in lines[:MOST_LINES]:
        warnings.warn(line, stacklevel=3)
    if len(lines) > MOST_LINES:
        further = len(lines) - MOST_LINES
        warnings.warn(f"{of_machine.path}: {further} more values are far from usual", stacklevel=3)


def _doubts(machine: Machine, reader: Reader, tables: tuple[str, ...]) -> Iterator[str]:
    scale = machine.scale
    by_field = {usual.field: usual for usual in machine.usual()}
    for keys, (key, number) in reader.file_keys.items():
        unit = split_key(key)[1]
        if keys[0] not in tables or unit is None or not is_number(number):
            continue
        field = ".".join(keys)
        usual = by_field.get(field) or usual_of(scale, field, unit.si_suffix)
        if usual and field not in machine.unread and not usual.holds(unit.factor * number):
            lowest, highest = (f"{end / unit.factor:.3g}" for end in (usual.lowest, usual.highest))
            value = f"{reader.file_and_key((*keys[:-1], key))} = {number:g} {unit.symbol}".rstrip()
            allowed = f"usual is {lowest} to {highest} {unit.symbol}".rstrip()
            yield f"{value}: {allowed} ({usual.why}); {_likely(usual, number, unit)}"


def _likely(usual: Usual, number: float, unit: Unit) -> str:
    """The unit in which the number would be usual, of a thousand times the size first."""
    others = [other for other in UNITS.values() if other.si_suffix == unit.si_suffix]
    others.sort(key=lambda other: other.factor / unit.factor not in (1e3, 1e-3))
    fitting = (other.symbol for other in others if usual.holds(other.factor * number))
    return next((f"is it in {symbol}?" for symbol in fitting), "is a decimal point wrong?")
