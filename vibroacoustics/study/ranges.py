"""Values of the machine that a study reads and samples, and their ranges."""

from collections.abc import Iterable, Mapping
from typing import Any, get_args

from pydantic import ValidationError

from ..base.parameters import Held, Parameters
from ..base.units import si_key
from ..machine.frame import Frame
from ..machine.machine import Machine
from ..machine.shell_structure import ShellStructure
from ..machine.source import Source
from .reader import Reader
from .record import ParameterRecord
from .uncertainty import HeldRange, Range
from .wording import validated


def _sources(content: Mapping[str, Any]) -> list[Source]:
    tables = content.get("sources")
    values = tables.values() if isinstance(tables, dict) else ()
    return [source for source in values if isinstance(source, Source)]


def tables_used(content: Mapping[str, Any], machine: Machine) -> set[str]:
    """Tables of the machine that the study's sources and stops read."""
    sources, operation = _sources(content), content.get("operation")
    used = {name for source in sources for name in source.tables_read(machine)}
    if any(source.drives_shell for source in sources):
        used |= {"structure", "variation"} | _frame_tables(content.get("machine"))
    if isinstance(operation, dict) and operation.get("stopping"):
        used |= {"stopping"}
    if isinstance(operation, dict) and operation.get("turning_back"):
        used |= {"turning_back", "check_valve"}
    return used


def _frame_tables(machine: Any) -> set[str]:
    """Tables of the frame as load path, where the machine has one."""
    framed = isinstance(machine, Machine) and machine.has_table(Frame)
    return {"frame", "shaft"} if framed else set()


def is_used(record: ParameterRecord, machine: Machine, used: set[str]) -> bool:
    """Whether the study reads a value: not those of a table that only sources read,
    nor those that a choice in their table leaves `unread`."""
    table, _, key = record.field.partition(".")
    if f"{table}.{si_key(key)[0]}" in machine.unread:
        return False
    field = type(machine).model_fields.get(table)
    if si_key(key)[0] in getattr(getattr(machine, table, None), "unread", ()):
        return False
    return field is None or field.is_required() or table in used | machine.reads


def ranges_of(
    machine: Machine, records: Iterable[ParameterRecord], content: Mapping[str, Any], reader: Reader
) -> tuple[tuple[Range, ...], tuple[HeldRange, ...]]:
    """Ranges in SI of the values that are sampled, and of those that are not; none without sources.

    A value is sampled unless its class says `Held`. The field must take both ends of its range;
    that values contradict one another is seen when they are sampled.
    """
    sampled: list[Range] = []
    held: list[HeldRange] = []
    measured = bool(content.get("shell_modes"))
    for record in records if _sources(content) else ():
        *tables, key = record.field.split(".")
        if record.lowest is None or record.highest is None or not _of_machine(record, machine):
            continue
        owner, (name, factor) = owner_of(machine, tables), si_key(key)
        field = type(owner).model_fields[name]
        integer = _is_integer(field.annotation)
        ends = [_si(end, factor, integer) for end in (record.lowest, record.highest)]
        _check_ends(owner, (*tables, name), (key, record), ends, reader)
        lowest, highest = map(float, ends)
        limits = Range(
            table=".".join(tables), field=name, lowest=lowest, highest=highest, integer=integer
        )
        reason = _why_held(owner, name, measured)
        if reason is None:
            sampled.append(limits)
        else:
            held.append(HeldRange(**dict(limits), reason=reason))
    return tuple(_with_sources(item, machine, sampled) for item in sampled), tuple(held)


def _with_sources(limits: Range, machine: Machine, sampled: Iterable[Range]) -> Range:
    """A range with other sampled values that its value follows from, but is sampled apart from."""
    names = {other.name for other in sampled}
    sources = [
        source
        for derived in machine.derived
        if derived.name == limits.name
        for source in derived.sources
        if source in names
    ]
    return limits.model_copy(update={"independent_of": tuple(sources)})


def _of_machine(record: ParameterRecord, machine: Machine) -> bool:
    """Whether a record is of the machine, not of what an option changes of it."""
    return record.field.partition(".")[0] in type(machine).model_fields


def owner_of(machine: Machine, tables: Iterable[str]) -> Parameters:
    """Return the table of a machine by the names of it and of those that hold it."""
    owner: Parameters = machine
    for table in tables:
        owner = getattr(owner, table)
    return owner


def _si(end: float, factor: float, integer: bool) -> float:
    value = factor * end
    return int(value) if integer and value.is_integer() else value


def _is_integer(annotation: Any) -> bool:
    kinds = {annotation, *get_args(annotation)}
    return int in kinds and float not in kinds


def _why_held(owner: Parameters, name: str, measured: bool) -> str | None:
    """Say why a value is not sampled; none where it is."""
    field = type(owner).model_fields[name]
    if measured and isinstance(owner, ShellStructure) and name in owner.changes_modes:
        return "change modes, which are measured here"
    if not isinstance(getattr(owner, name), int | float):
        return "are lists"
    return next((item.reason for item in field.metadata if isinstance(item, Held)), None)


def _check_ends(
    owner: Parameters,
    keys: tuple[str, ...],
    written: tuple[str, ParameterRecord],
    ends: Iterable[float],
    reader: Reader,
) -> None:
    """Refuse a range with an end that the field does not take, whatever the other values are."""
    key, record = written
    for limit, end in zip((record.lowest, record.highest), ends, strict=True):
        values = {**dict(iter(owner)), keys[-1]: end}
        if isinstance(getattr(owner, keys[-1]), tuple) or _contradicts_others(owner, values):
            continue
        reader.file_keys[keys] = (key, limit)
        validated(type(owner), values, reader, keys[:-1])


def _contradicts_others(owner: Parameters, values: dict[str, Any]) -> bool:
    """Whether it is the values together that are refused, not one of them."""
    try:
        type(owner).model_validate(values)
    except ValidationError as error:
        return error.errors()[0]["type"] == "value_error"
    return False
