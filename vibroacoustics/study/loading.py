"""TOML to a validated `Study`. Every refusal is one line: file, field, value, unit, range."""

import csv
import os
import sys
import tomllib
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, Final

from ..base.errors import ParameterError
from ..base.parameters import Kind, split_kind
from ..base.registry import Registry
from ..base.units import si_key, split_key
from ..machine.machine import MACHINES, Machine
from ..machine.option import OPTIONS
from ..machine.shell_structure import DRAWN_OF_SHELL
from ..machine.source import SOURCES, Source
from .study import ParameterRecord, Study
from .uncertainty import Range
from .wording import validated

MAXIMUM_FILE_BYTES: Final = 1_000_000
MAXIMUM_DEPTH: Final = 16
QUANTITY_KEYS: Final = {"value", "source", "range"}


def load_study(path: str | Path) -> Study:
    """Read a study file, the study it extends, its machine and its published table.

    Parameters
    ----------
    path : TOML file. Keys carry their unit; a value is a number or
        `{ value, source, range }`. `extends` names a study whose values it takes over.

    Raises
    ------
    ParameterError
        Anything is missing, unknown, of the wrong type or outside its allowed range.
    """
    path = Path(path)
    content, origin = _read_with_base(path)
    reader = _Reader(path, origin)
    machine_table = content.pop("machine", None)
    if not isinstance(machine_table, dict) or not isinstance(machine_table.get("file"), str):
        raise ParameterError(f"{path}: machine.file = missing: name the machine's TOML file")
    machine_file = _beside(origin.get(("machine", "file"), path), machine_table.pop("file"))
    overrides = machine_table.pop("override", {})
    if machine_table:
        raise ParameterError(f"{path}: machine.{next(iter(machine_table))}: unknown key")
    changes: dict[tuple[str, ...], Any] = {("machine", "override"): overrides}
    machine, machine_reader = _load_machine(machine_file, changes, reader)
    machine_records = machine_reader.records
    redesigns = {
        name: _load_redesign(machine_file, {**changes, _change_of(name): change}, reader)
        for name, change in _changes(content, path)
    }
    scoring = content.get("scoring")
    if isinstance(scoring, dict) and "published_table" in scoring:
        name = scoring.pop("published_table")
        origin_file = origin.get(("scoring", "published_table"), path)
        if not isinstance(name, str):
            raise ParameterError(
                f"{origin_file}: scoring.published_table = {name!r}: must be a file name"
            )
        scoring["published"] = _read_published_table(_beside(origin_file, name))
    _place_files(content, origin, path)
    for name in ("records", "ranges", "source_file", "given"):  # filled in here, not by a file
        if name in content:
            raise ParameterError(f"{path}: {name}: unknown key")
    given = _take_given(content, reader)
    content = reader.to_si(content, ())
    content.update(machine=machine, source_file=path.name, given=given)
    for name, (redesigned, change_records) in redesigns.items():
        content["options"][name]["machine"] = redesigned
        machine_records += change_records
    _place_kinds(content, "options", OPTIONS, reader)
    _place_kinds(content, "sources", SOURCES, reader)
    used = _tables_used(content)
    machine_records = [record for record in machine_records if _is_used(record, machine, used)]
    content["records"] = (*machine_records, *reader.records)
    content["ranges"] = _ranges(machine, machine_records, _drawn(content), machine_reader)
    return validated(Study, content, reader)


def _place_files(
    content: dict[str, Any], origin: Mapping[tuple[str, ...], Path], path: Path
) -> None:
    """Make names of files relative to the file that gives them."""
    modes = content.get("shell_modes")
    if isinstance(modes, dict) and isinstance(modes.get("file"), str):
        modes["file"] = str(_beside(origin.get(("shell_modes", "file"), path), modes["file"]))
    radiation = content.get("radiation")
    body = radiation.get("body") if isinstance(radiation, dict) else None
    if not isinstance(body, dict):
        return
    named: list[tuple[dict[str, Any], str, tuple[str, ...]]] = [(body, "file", ())]
    patterns = body.get("patterns")
    if isinstance(patterns, dict):
        named += [(patterns, name, ("patterns",)) for name in patterns]
    for table, name, prefix in named:
        if isinstance(table.get(name), str):
            file = origin.get(("radiation", "body", *prefix, name), path)
            table[name] = str(_beside(file, table[name]))


def _place_kinds(
    content: dict[str, Any], name: str, registry: Registry[type[Kind]], reader: "_Reader"
) -> None:
    """Turn each table of a table, such as that of the options, into parameters of its kind."""
    tables = content.get(name)
    if not isinstance(tables, dict):  # refused by the study
        return
    for key, table in tables.items():
        if isinstance(table, dict):
            kind, values = _of_kind(registry, table, reader.place((name, key)))
            tables[key] = validated(kind, values, reader, (name, key))


def _sources(content: Mapping[str, Any]) -> list[Source]:
    tables = content.get("sources")
    found = tables.values() if isinstance(tables, dict) else ()
    return [source for source in found if isinstance(source, Source)]


def _tables_used(content: Mapping[str, Any]) -> set[str]:
    """Tables of the machine that the study's sources and stops read."""
    sources, operation = _sources(content), content.get("operation")
    used = {name for source in sources for name in source.tables}
    if any(source.drives_shell for source in sources):
        used |= {"structure", "variation"}
    if isinstance(operation, dict) and operation.get("stopping"):
        used |= {"stopping"}
    return used


def _is_used(record: ParameterRecord, machine: Machine, used: set[str]) -> bool:
    """Whether the study reads a value: not those of a table that only sources read."""
    table = record.field.partition(".")[0]
    field = type(machine).model_fields.get(table)
    return field is None or field.is_required() or table in used | _ALWAYS_READ


_ALWAYS_READ: Final = {"suspension"}


def _drawn(content: Mapping[str, Any]) -> frozenset[tuple[str, str]]:
    """Values that are drawn from their range, by table and field."""
    sources = _sources(content)
    of_shell = any(source.drives_shell for source in sources)
    drawn = frozenset(pair for source in sources for pair in source.drawn)
    return drawn | DRAWN_OF_SHELL if of_shell else drawn


def _ranges(
    machine: Machine,
    records: Iterable[ParameterRecord],
    drawn: frozenset[tuple[str, str]],
    reader: "_Reader",
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


def _take_given(content: Mapping[str, Any], reader: "_Reader") -> dict[str, dict[str, float]]:
    """Take the table `given` out of each option: its values as written, by criterion."""
    options = content.get("options")
    return {
        name: _given_values(table.pop("given"), name, content, reader)
        for name, table in (options if isinstance(options, dict) else {}).items()
        if isinstance(table, dict) and "given" in table
    }


def _given_values(
    table: Any, option: str, content: Mapping[str, Any], reader: "_Reader"
) -> dict[str, float]:
    """Numbers of one option's table; those with a source are recorded in the scale's unit."""
    keys = ("options", option, "given")
    if not _table(table):
        raise ParameterError(f"{reader.place(keys)}: must be a table")
    values = {}
    for name, written in table.items():
        unit = _at(content, ("scoring", "criteria", name, "unit"))
        number = reader.number((*keys, name), written, unit if isinstance(unit, str) else "")
        if not _is_number(number):
            raise ParameterError(f"{reader.place((*keys, name))} = {number}: must be a number")
        values[name] = float(number)
    return values


def _at(content: Any, keys: tuple[str, ...]) -> Any:
    """Value under nested keys; None where one is missing."""
    for key in keys:
        content = content.get(key) if isinstance(content, dict) else None
    return content


def _of_kind(
    registry: Registry[type[Kind]], table: Mapping[str, Any], where: str
) -> tuple[type[Kind], dict[str, Any]]:
    """Class and values of a table, by its key `kind`."""
    try:
        return split_kind(registry, table)
    except ParameterError as error:
        text = str(error)
        raise ParameterError(f"{where}{'.' if text.startswith('kind =') else ': '}{text}") from None


def load_machine(path: str | Path) -> Machine:
    """Read a machine file alone.

    Raises
    ------
    ParameterError
        As `load_study`; also where a value has no source.
    """
    path = Path(path)
    return _load_machine(path, {}, _Reader(path, {}))[0]


def _change_of(option: str) -> tuple[str, ...]:
    return ("options", option, "change")


def _changes(content: Mapping[str, Any], path: Path) -> list[tuple[str, dict[str, Any]]]:
    """Take the table `change` out of each option that changes values of the machine."""
    options = content.get("options")
    found = []
    for name, option in (options if isinstance(options, dict) else {}).items():
        kind = option.get("kind") if isinstance(option, dict) else None
        if not isinstance(kind, str) or kind not in OPTIONS or not OPTIONS[kind].changes_machine:
            continue
        if "machine" in option:  # filled in here, not by a file
            raise ParameterError(f"{path}: options.{name}.machine: unknown key")
        if "change" not in option:
            raise ParameterError(f"{path}: options.{name}.change: is missing")
        found.append((name, option.pop("change")))
    return found


def _load_redesign(
    path: Path, changes: Mapping[tuple[str, ...], Any], study: "_Reader"
) -> tuple[Machine, list[ParameterRecord]]:
    """The changed machine, and the records of the change, which is the last one."""
    machine, reader = _load_machine(path, changes, study)
    prefix = list(changes)[-1]
    changed = {".".join(keys) for keys in _leaves(changes[prefix])}
    dotted = ".".join(prefix)
    return machine, [
        record.model_copy(update={"field": f"{dotted}.{record.field}"})
        for record in reader.records
        if record.field in changed
    ]


def _load_machine(
    path: Path, changes: Mapping[tuple[str, ...], Any], study: "_Reader"
) -> tuple[Machine, "_Reader"]:
    """The machine of the file with the study's changes; every value of it needs a source.

    Parameters
    ----------
    path : machine file
    changes : tables of values that replace the machine's, one after the other, by their place in
        the study
    study : reader of the study
    """
    content = _read_toml(path)
    reader = _Reader(path, {}, sources_required=True)
    reader.origin = dict.fromkeys(_leaves(content), path)
    for prefix, change in changes.items():
        _apply(content, prefix, change, reader, study)
    model, values = _of_kind(MACHINES, reader.to_si(content, ()), f"{path}: machine")
    return validated(model, values, reader), reader


def _apply(
    content: dict[str, Any],
    prefix: tuple[str, ...],
    change: Any,
    reader: "_Reader",
    study: "_Reader",
) -> None:
    """Replace values of a machine's content by those of a table of the study."""
    where = ".".join(prefix)
    if not isinstance(change, dict):
        raise ParameterError(f"{study.path}: {where}: must be a table")
    replaced = set()
    for keys in _leaves(change):
        quantity = (*keys[:-1], si_key(keys[-1])[0])
        if quantity in replaced:
            raise ParameterError(
                f"{study.path}: {where}.{'.'.join(keys)}: given twice, in two units"
            )
        replaced.add(quantity)
        value = change
        for key in keys:
            value = value[key]
        _override(content, keys, value, f"{study.path}: {where}.{'.'.join(keys)}")
        reader.origin[keys] = study.origin.get((*prefix, *keys), study.path)
        reader.overridden[keys] = prefix


def _override(content: dict[str, Any], keys: tuple[str, ...], value: Any, where: str) -> None:
    """Replace one existing value; a key in another unit of the same quantity replaces it too."""
    table: Any = content
    for key in keys[:-1]:
        table = table.get(key) if isinstance(table, dict) else None
    named = table if isinstance(table, dict) else {}
    same = [key for key in named if si_key(key)[0] == si_key(keys[-1])[0]]
    if not same:
        raise ParameterError(f"{where}: the machine has no such value")
    del named[same[0]]
    named[keys[-1]] = value


def _read_toml(path: Path) -> dict[str, Any]:
    try:
        if path.stat().st_size > MAXIMUM_FILE_BYTES:
            raise ParameterError(f"{path}: larger than {MAXIMUM_FILE_BYTES} bytes")
        content = tomllib.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise ParameterError(f"{path}: no such file") from None
    except OSError as error:
        raise ParameterError(f"{path}: cannot be read: {error.strerror}") from None
    except UnicodeDecodeError:
        raise ParameterError(f"{path}: is not UTF-8 text") from None
    except (ValueError, RecursionError) as error:  # TOMLDecodeError is a ValueError
        raise ParameterError(f"{path}: is not valid TOML: {error}") from None
    if _deeper_than(content, MAXIMUM_DEPTH):
        raise ParameterError(f"{path}: tables are nested deeper than {MAXIMUM_DEPTH} levels")
    return content


def _deeper_than(content: Mapping[str, Any], depth: int) -> bool:
    tables = (value for value in content.values() if isinstance(value, dict))
    return depth == 0 or any(_deeper_than(table, depth - 1) for table in tables)


def _read_with_base(path: Path) -> tuple[dict[str, Any], dict[tuple[str, ...], Path]]:
    """Merge a study over the one it extends; also tell the file that each value comes from."""
    content = _read_toml(path)
    base_name = content.pop("extends", None)
    origin = dict.fromkeys(_leaves(content), path)
    if base_name is None:
        return content, origin
    if not isinstance(base_name, str):
        raise ParameterError(f"{path}: extends = {base_name!r}: must be a file name")
    base_path = _beside(path, base_name)
    base = _read_toml(base_path)
    if "extends" in base:
        raise ParameterError(f"{base_path}: extends: a study that is extended must stand alone")
    base_origin = dict.fromkeys(_leaves(base), base_path)
    return _merge(base, content), base_origin | origin


def _beside(file: Path, name: str) -> Path:
    """A file named relative to the folder of another."""
    return Path(os.path.normpath(file.parent / name))


def _merge(base: dict[str, Any], over: Mapping[str, Any]) -> dict[str, Any]:
    given = {si_key(key)[0] for key, value in over.items() if not _table(value)}
    merged = {  # a value in another unit of the same quantity is replaced too
        key: value
        for key, value in base.items()
        if key in over or _table(value) or si_key(key)[0] not in given
    }
    for key, value in over.items():
        nested = isinstance(value, dict) and isinstance(merged.get(key), dict)
        merged[key] = _merge(merged[key], value) if nested and not _quantity(value) else value
    return merged


def _quantity(value: Any) -> bool:
    return isinstance(value, dict) and "value" in value


def _table(value: Any) -> bool:
    return isinstance(value, dict) and not _quantity(value)


def _leaves(content: Mapping[str, Any], prefix: tuple[str, ...] = ()) -> list[tuple[str, ...]]:
    """Key paths of all values; a quantity table is one value."""
    found: list[tuple[str, ...]] = []
    for key, value in content.items():
        if isinstance(value, dict) and not _quantity(value):
            found += _leaves(value, (*prefix, key))
        else:
            found.append((*prefix, key))
    return found


class _Reader:
    """Turns the values of one file to SI and keeps the record of where each comes from."""

    def __init__(
        self, path: Path, origin: dict[tuple[str, ...], Path], sources_required: bool = False
    ) -> None:
        self.path = path
        self.origin = origin
        self.sources_required = sources_required
        self.overridden: dict[tuple[str, ...], tuple[str, ...]] = {}
        self.records: list[ParameterRecord] = []
        self.file_keys: dict[tuple[str, ...], tuple[str, Any]] = {}

    def to_si(self, content: Mapping[str, Any], prefix: tuple[str, ...]) -> dict[str, Any]:
        result: dict[str, Any] = {}
        for key, value in content.items():
            keys = (*prefix, key)
            if isinstance(value, dict) and not _quantity(value):
                result[key] = self.to_si(value, keys)
                continue
            name, factor = si_key(key)
            if name in result:
                raise ParameterError(f"{self.place(keys)}: given twice, in two units")
            number = self.number(keys, value)
            self.file_keys[(*prefix, name)] = (key, number)
            result[name] = _scale(number, factor)
        return result

    def file(self, keys: tuple[str, ...]) -> Path:
        return self.origin.get(keys, self.path)

    def place(self, keys: tuple[str, ...]) -> str:
        """File and dotted key as written; a changed machine value stands in the study."""
        prefix = self.overridden.get(keys, ())
        dotted = ".".join((*prefix, *keys))
        return f"{self.file(keys)}: {dotted}" if dotted else f"{self.file(keys)}"

    def number(self, keys: tuple[str, ...], value: Any, unit: str = "") -> Any:
        """The bare value of a leaf; records its source and checks it against its own range.

        Parameters
        ----------
        keys : of the leaf
        value : number, or table with value, source and range
        unit : where the key's suffix tells none
        """
        where = self.place(keys)
        if not _quantity(value):
            if self.sources_required and _is_number(value):
                raise ParameterError(f"{where} = {value}: needs a source: {{ value, source }}")
            return tuple(value) if isinstance(value, list) else value
        unknown = set(value) - QUANTITY_KEYS
        if unknown:
            raise ParameterError(f"{where}: unknown key {sorted(unknown)[0]}")
        source = value.get("source")
        if not isinstance(source, str) or not source.strip():
            raise ParameterError(f"{where}: source is missing")
        number = value["value"]
        suffix = split_key(keys[-1])[1]
        symbol = unit or (suffix.symbol if suffix else "")
        lowest, highest = _range(where, value.get("range"))
        if source.startswith("assumed") and lowest is None:
            raise ParameterError(f"{where}: an assumed value needs a range")
        if lowest is not None and _is_number(number) and not lowest <= number <= highest:
            raise ParameterError(
                f"{where} = {number:g} {symbol}: outside its own range {lowest:g} to {highest:g}"
            )
        self.records.append(
            ParameterRecord(
                file=self.file(keys).name,
                field=".".join(keys),
                value=f"{number:g}" if _is_number(number) else str(number),
                unit=symbol,
                source=source,
                lowest=lowest,
                highest=highest,
            )
        )
        return tuple(number) if isinstance(number, list) else number


def _range(where: str, given: Any) -> tuple[float, float] | tuple[None, None]:
    if given is None:
        return None, None
    if not isinstance(given, list) or len(given) != 2 or not all(map(_is_number, given)):
        raise ParameterError(f"{where}: range must be two numbers [lowest, highest]")
    return float(given[0]), float(given[1])


def _is_number(value: Any) -> bool:
    """A finite number that a float can hold; TOML's integers have no limit."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        return False
    return abs(value) <= sys.float_info.max


def _scale(value: Any, factor: float) -> Any:
    """Convert a number or a list of numbers; leave everything else to the validation."""
    if isinstance(value, tuple):
        return tuple(_scale(item, factor) for item in value)
    if factor == 1.0 or not _is_number(value):
        return value
    return value * factor


def _read_published_table(path: Path) -> dict[str, Any]:
    """A published table of scores: `criterion,OPTION,…`, one line a criterion, last the sums."""
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except OSError as error:
        raise ParameterError(f"{path}: cannot be read: {error.strerror}") from None
    except ValueError as error:  # no UTF-8, no file name
        raise ParameterError(f"{path}: cannot be read: {error}") from None
    source = " ".join(line.lstrip("# ") for line in lines if line.startswith("#"))
    rows = list(csv.reader(line for line in lines if line.strip() and not line.startswith("#")))
    try:
        options = tuple(rows[0][1:])
        numbers = [tuple(float(cell) for cell in row[1:]) for row in rows[1:]]
        if len(rows) < 3 or any(len(row) != len(options) for row in numbers):
            raise ValueError("rows of different length")
    except (ValueError, IndexError) as error:
        raise ParameterError(f"{path}: is no table of scores: {error}") from None
    return {
        "source": source,
        "options": options,
        "criteria": tuple(row[0] for row in rows[1:-1]),
        "scores": tuple(zip(*numbers[:-1], strict=True)),
        "sums": numbers[-1],
    }
