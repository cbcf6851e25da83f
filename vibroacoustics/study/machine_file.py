"""A machine file, with the values that a study or a redesign replaces."""

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, Final

from ..base.errors import ParameterError
from ..base.units import si_key
from ..machine.machine import MACHINES, Machine
from ..machine.option import OPTIONS
from ..machine.speed_growth import SOURCE, Growth, LevelPair, growth_of_pair
from .kinds import of_kind, resolve_file_names
from .reader import Reader
from .record import ParameterRecord
from .toml_files import is_quantity, leaves, read_toml
from .wording import validated

GROWTH: Final = "speed_growth_db"
POINTS: Final = "operating_points"
"""Table of a machine file: by name, tables of values that stand in place of the machine's."""


def read_machine(
    path: Path,
    changes: Mapping[tuple[str, ...], Any],
    study: Reader,
    point: str | None = None,
    without: Iterable[str] = (),
) -> tuple[Machine, Reader]:
    """The machine of the file with the study's changes; every value of it needs a source.

    Parameters
    ----------
    path : machine file
    changes : tables of values that replace the machine's, one after the other, by their place in
        the study
    study : reader of the study
    point : one of the file's operating points; its values replace the machine's before the changes
    without : tables of the file that are omitted

    Raises
    ------
    ParameterError
        The file has no such table, or a value is refused.
    """
    content = read_toml(path)
    for name in without:
        if not isinstance(content.get(name), dict):
            raise ParameterError(
                f"{study.path}: machine.without = {name}: {path.name} has no such table"
            )
        del content[name]
    reader = Reader(path, {}, sources_required=True)
    points = _taken_points(content, path)
    _fill_in_growth(content)
    reader.origin = dict.fromkeys(leaves(content), path)
    if point is not None:
        _apply(content, (POINTS, point), points[point], reader, Reader(path, {}))
    for prefix, change in changes.items():
        _apply(content, prefix, change, reader, study)
    in_si = reader.to_si(content, ())
    resolve_file_names(in_si, reader)
    model, values = of_kind(MACHINES, in_si, f"{path}: machine")
    with MACHINES.fenced(model.kind, ParameterError):
        return validated(model, values, reader), reader


def _fill_in_growth(content: dict[str, Any]) -> None:
    """Give unmodelled noise the growth of two published levels, else that of the machine's kind."""
    noise, table = content.get("overall_noise"), content.get("remainder", {})
    if not isinstance(noise, dict) or not isinstance(table, dict) or GROWTH in table:
        return
    growth, source = _growth_of(noise), "overall_noise, at two speeds"
    kind = content.get("kind")
    if growth is None and isinstance(kind, str) and kind in MACHINES:
        growth, source = MACHINES[kind].speed_growth, SOURCE
    if growth is not None:
        lowest, highest = (round(end, 1) for end in growth.range_db)
        filled = {"value": round(growth.mean_db, 1), "source": source, "range": [lowest, highest]}
        content["remainder"] = {**table, GROWTH: filled}


def _growth_of(noise: Mapping[str, Any]) -> Growth | None:
    """The growth of two published levels; none where not both are numbers at two speeds."""
    numbers = []
    for name in ("speed_rpm", "level_dba", "other_speed_rpm", "other_level_dba"):
        value: Any = noise.get(name)
        number = value["value"] if is_quantity(value) else value
        if not isinstance(number, int | float) or number <= 0.0:
            return None  # absent, or refused with the other values of the file
        numbers.append(float(number))
    pair = LevelPair(*numbers)
    return growth_of_pair(pair) if pair.decades else None


def operating_points(path: Path) -> tuple[str, ...]:
    """Names of the operating points of a machine file."""
    return tuple(_taken_points(read_toml(path), path))


def _taken_points(content: dict[str, Any], path: Path) -> dict[str, Any]:
    """Take the table of operating points out of a machine's content."""
    points = content.pop(POINTS, {})
    if not isinstance(points, dict):
        raise ParameterError(f"{path}: {POINTS}: must be a table")
    return points


def change_of(option: str) -> tuple[str, ...]:
    """Keys of the table with which an option changes the machine."""
    return ("options", option, "change")


def take_changes(content: Mapping[str, Any], reader: Reader) -> list[tuple[str, dict[str, Any]]]:
    """Take the table `change` out of each option that changes values of the machine.

    An option without one gets an empty one; that is among the problems of the reader.
    """
    options = content.get("options")
    changes = []
    for name, option in (options if isinstance(options, dict) else {}).items():
        kind = option.get("kind") if isinstance(option, dict) else None
        if not isinstance(kind, str) or kind not in OPTIONS or not OPTIONS[kind].changes_machine:
            continue
        if "machine" in option:  # filled in here, not by a file
            reader.problems.append(f"{reader.path}: options.{name}.machine: unknown key")
            del option["machine"]
        if "change" not in option:
            reader.problems.append(f"{reader.path}: options.{name}.change: is missing")
        changes.append((name, option.pop("change", {})))
    return changes


def read_redesign(
    path: Path,
    changes: Mapping[tuple[str, ...], Any],
    study: Reader,
    point: str | None = None,
    without: Iterable[str] = (),
) -> tuple[Machine, Reader, list[ParameterRecord]]:
    """The changed machine, its reader, and the records of the change, which is the last one."""
    machine, reader = read_machine(path, changes, study, point, without)
    prefix = list(changes)[-1]
    changed = {".".join(keys) for keys in leaves(changes[prefix])}
    dotted = ".".join(prefix)
    return (
        machine,
        reader,
        [
            record.model_copy(update={"field": f"{dotted}.{record.field}"})
            for record in reader.records
            if record.field in changed
        ],
    )


def _apply(
    content: dict[str, Any],
    prefix: tuple[str, ...],
    change: Any,
    reader: Reader,
    study: Reader,
) -> None:
    """Replace values of a machine's content by those of a table of the study."""
    where = ".".join(prefix)
    if not isinstance(change, dict):
        raise ParameterError(f"{study.path}: {where}: must be a table")
    replaced = set()
    for keys in leaves(change):
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
