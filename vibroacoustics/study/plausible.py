"""Values that a study states: hardly right ones, those of criteria, titles."""

import warnings
from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import Any, Final

from ..base.errors import ParameterError
from ..base.units import UNITS, Unit, split_key
from ..base.vocabulary import REFERENCE_OPTION
from ..machine.machine import Machine
from ..machine.usual import Usual, usual_of
from .reader import Reader, is_number
from .titles import LONGEST
from .toml_files import is_table


def take_titles(content: Mapping[str, Any], reader: Reader) -> dict[str, Any]:
    """Take the key `title` out of the tables of machine and options."""
    machine, options = content.get("machine"), content.get("options")
    titles: dict[str, Any] = {"machine": "", "options": {}}
    if isinstance(machine, dict) and "title" in machine:
        titles["machine"] = _checked(machine.pop("title"), ("machine",), reader)
    tables = options if isinstance(options, dict) else {}
    for name, table in tables.items():
        if isinstance(table, dict) and "title" in table:
            keys = ("options", name)
            title = _checked(table.pop("title"), keys, reader)
            taken = {*tables, *titles["options"].values()} - {name}
            _check_free(name, title, taken, reader.file_and_key((*keys, "title")))
            titles["options"][name] = title
    return titles


def _checked(title: Any, keys: tuple[str, ...], reader: Reader) -> str:
    where = f"{reader.file_and_key((*keys, 'title'))} = {title!r}"
    if not isinstance(title, str) or not title.strip() or not title.isprintable():
        raise ParameterError(f"{where}: must be a line of text")
    if len(title) > LONGEST:
        raise ParameterError(f"{where}: has {len(title)} letters; allowed 1 to {LONGEST}")
    return title


def _check_free(name: str, title: str, taken: Collection[str], where: str) -> None:
    if name == REFERENCE_OPTION:
        raise ParameterError(f"{where} = {title!r}: every report names it {REFERENCE_OPTION}")
    if title in taken:
        raise ParameterError(f"{where} = {title!r}: is name or title of another option")


def take_given(content: Mapping[str, Any], reader: Reader) -> dict[str, dict[str, float]]:
    """Take the table `given` out of each option: its values as written, by criterion."""
    options = content.get("options")
    return {
        name: _given_values(table.pop("given"), name, content, reader)
        for name, table in (options if isinstance(options, dict) else {}).items()
        if isinstance(table, dict) and "given" in table
    }


def _given_values(
    table: Any, option: str, content: Mapping[str, Any], reader: Reader
) -> dict[str, float]:
    """Numbers of one option's table; those with a source are recorded in the scale's unit."""
    keys = ("options", option, "given")
    if not is_table(table):
        raise ParameterError(f"{reader.file_and_key(keys)}: must be a table")
    values = {}
    for name, written in table.items():
        unit = _at(content, ("scoring", "criteria", name, "unit"))
        try:
            number = reader.number((*keys, name), written, unit if isinstance(unit, str) else "")
        except ParameterError as error:
            reader.problems += error.args
            continue
        if is_number(number):
            values[name] = float(number)
        else:
            where = reader.file_and_key((*keys, name))
            reader.problems.append(f"{where} = {number}: must be a number")
    return values


def _at(content: Any, keys: tuple[str, ...]) -> Any:
    """Value under nested keys; None where one is missing."""
    for key in keys:
        content = content.get(key) if isinstance(content, dict) else None
    return content


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
