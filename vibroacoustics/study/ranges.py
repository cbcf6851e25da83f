"""Which values of the machine a study reads and draws, and from which ranges."""

from collections.abc import Iterable, Mapping
from typing import Any, Final

from ..base.units import si_key
from ..machine.machine import Machine
from ..machine.shell_structure import DRAWN_OF_SHELL
from ..machine.source import Source
from .reader import Reader
from .study import ParameterRecord
from .uncertainty import Range
from .wording import validated

_ALWAYS_READ: Final = {"suspension"}


def _sources(content: Mapping[str, Any]) -> list[Source]:
    tables = content.get("sources")
    found = tables.values() if isinstance(tables, dict) else ()
    return [source for source in found if isinstance(source, Source)]


def tables_used(content: Mapping[str, Any]) -> set[str]:
    """Tables of the machine that the study's sources and stops read."""
    sources, operation = _sources(content), content.get("operation")
    used = {name for source in sources for name in source.tables}
    if any(source.drives_shell for source in sources):
        used |= {"structure", "variation"}
    if isinstance(operation, dict) and operation.get("stopping"):
        used |= {"stopping"}
    return used


def is_used(record: ParameterRecord, machine: Machine, used: set[str]) -> bool:
    """Whether the study reads a value: not those of a table that only sources read."""
    table = record.field.partition(".")[0]
    field = type(machine).model_fields.get(table)
    return field is None or field.is_required() or table in used | _ALWAYS_READ


def drawn_values(content: Mapping[str, Any]) -> frozenset[tuple[str, str]]:
    """Values that are drawn from their range, by table and field."""
    sources = _sources(content)
    of_shell = any(source.drives_shell for source in sources)
    drawn = frozenset(pair for source in sources for pair in source.drawn)
    return drawn | DRAWN_OF_SHELL if of_shell else drawn


def ranges_of(
    machine: Machine,
    records: Iterable[ParameterRecord],
    drawn: frozenset[tuple[str, str]],
    reader: Reader,
) -> tuple[Range, ...]:
    """Ranges in SI of the values that are drawn; the machine must take both ends of each."""
    found = []
    for record in records:
        table, _, key = record.field.partition(".")
        field, factor = si_key(key)
        if (table, field) not in drawn or record.lowest is None or record.highest is None:
            continue
        ends = [(limit, factor * limit) for limit in (record.lowest, record.highest)]
        model = type(getattr(machine, table))
        for written, end in ends:
            reader.file_keys[table, field] = (key, written)
            values = getattr(machine, table).model_dump() | {field: end}
            validated(model, values, reader, (table,))
        lowest, highest = (end for _, end in ends)
        found.append(Range(table=table, field=field, lowest=lowest, highest=highest))
    return tuple(found)
