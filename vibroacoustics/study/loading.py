"""TOML to a validated `Study`. Every refusal is one line: file, field, value, unit, range."""

from collections.abc import Callable, Collection, Mapping
from copy import deepcopy
from functools import partial
from pathlib import Path
from typing import Any, Final

from ..base.errors import ParameterError
from ..base.fault import FaultError, collected
from ..machine.machine import Machine
from ..machine.source import SOURCES
from .automatic import fill_in_automatic
from .baseline import BaselineSettings
from .baseline_files import read_baseline
from .combinations import joined_machine, take_combinations, validate_options
from .evidence_files import read_published_table, take_evidence
from .failing import without_failing, without_source
from .kinds import resolve_file_names, validate_kinds
from .machine_file import (
    change_of,
    operating_points,
    read_machine,
    read_redesign,
    take_changes,
)
from .plausible import take_given, take_titles, warn_of_doubts
from .ranges import is_used, ranges_of, tables_used
from .reader import Reader
from .record import ParameterRecord
from .samples import warn_of_contradictions
from .structure_borne import StructureBorne
from .study import Study
from .toml_files import Written, beside, read_toml, read_with_base
from .wording import checked, first_lines, validated

_Redesign = tuple[Machine, Reader, list[ParameterRecord]]


def load_study(path: str | Path, without: Collection[str] = ()) -> Study:
    """Read a study file, the study it extends, its machine and its published table.

    Parameters
    ----------
    path : TOML file. Keys carry their unit; a value is a number or
        `{ value, source, range }`. `extends` names a study whose values it takes over.
    without : names of sources that are omitted

    Raises
    ------
    ParameterError
        Anything is missing, unknown, of the wrong type or outside its allowed range.

    Examples
    --------
    >>> study = va.load_study("pipelines/copeland_thesis.toml")
    >>> study.machine.name
    'Copeland ZP41K3E-PFJ'
    """
    written = read_with_base(Path(path))
    for name in without:
        written = without_source(written, name)
    lines = [f"source {name} is omitted: as asked for by --without" for name in without]
    return study_of(written).leaving_out(lines)


def study_of(written: Written) -> Study:
    """Read the study that a file's tables say, without options and criteria that fail."""
    with collected() as lines:
        while True:
            try:
                return _study_of(written).leaving_out(lines)
            except FaultError as fault:
                written = without_failing(written, fault)


def _study_of(written: Written) -> Study:
    path, content = written.path, deepcopy(written.content)
    reader = Reader(path, written.origin)
    titles = take_titles(content, reader)
    machine_file, overrides, without = _machine_table(content, reader)
    changes: dict[tuple[str, ...], Any] = {("machine", "override"): overrides}
    points = operating_points(machine_file)
    point, catalogue_point = (
        reader.tried(partial(_point_named, content, keys, points, reader))
        for keys in (("operation", "point"), ("catalogue_point",))
    )
    read = reader.tried(lambda: read_machine(machine_file, changes, reader, point, without))
    at_catalogue = None
    if catalogue_point not in (None, point):
        at_catalogue = reader.tried(
            lambda: read_machine(machine_file, changes, reader, catalogue_point, without)
        )
    joined = take_combinations(content, reader)
    redesigns, joined_machines = _redesigns(
        content,
        reader,
        lambda change: read_redesign(machine_file, {**changes, **change}, reader, point, without),
        joined,
    )
    reader.tried(lambda: _read_published(content, reader))
    _resolve_file_names(content, reader)
    for name in FILLED_IN:
        if name in content:
            del content[name]
            reader.problems.append(f"{path}: {name}: unknown key")
    given_values = reader.tried(lambda: take_given(content, reader))
    evidence = reader.tried(lambda: take_evidence(content, reader))
    content = reader.to_si(content, ())
    for name in _WITH_DATA_FILES:
        if isinstance(content.get(name), dict):
            resolve_file_names(content[name], reader, (name,))
    reader.tried(lambda: _read_measured(content, reader))
    plate = reader.tried(lambda: _plate(content, reader))
    content.update(source_file=path.name, given=given_values, evidence=evidence, titles=titles)
    for name, (redesigned, _, _) in redesigns.items():
        content["options"][name]["machine"] = _under(plate, redesigned)
    validate_options(
        content, joined, {n: _under(plate, each) for n, each in joined_machines.items()}, reader
    )
    validate_kinds(content, "sources", SOURCES, reader)
    if read is None:
        raise _refused_with_machine(content, reader)
    machine, machine_reader = _under(plate, read[0]), read[1]
    machine_records = machine_reader.records
    for _, _, change_records in redesigns.values():
        machine_records += change_records
    content["machine"] = machine
    content["catalogue_machine"] = at_catalogue and _under(plate, at_catalogue[0])
    if isinstance(content.get("receivers"), dict):
        content.setdefault("catalogue_receiver", next(iter(content["receivers"]), ""))
    fill_in_automatic(content, machine)
    if reader.problems:
        validated(Study, content, reader)  # raises, with what else is wrong
    used = tables_used(content, machine)
    machine_records = [record for record in machine_records if is_used(record, machine, used)]
    content["records"] = (*machine_records, *reader.records)
    ranges, held = ranges_of(machine, machine_records, content, machine_reader)
    content.update(ranges=ranges, held_ranges=held)
    study = validated(Study, content, reader).remember(written, study_of)
    warn_of_doubts(machine, machine_reader, reader, study.operation.speed_rpm)
    for redesigned, redesigned_reader, _ in redesigns.values():
        warn_of_doubts(redesigned, redesigned_reader)
    warn_of_contradictions(study)
    return study


def _redesigns(
    content: dict[str, Any],
    reader: Reader,
    read: Callable[[dict[tuple[str, ...], Any]], _Redesign],
    joined: dict[str, tuple[str, ...]],
) -> tuple[dict[str, _Redesign], dict[str, Machine]]:
    """Machines of the options, and of combinations, that change values; refused ones are taken out.

    Parameters
    ----------
    content : content of the study
    reader : gets what is refused
    read : the machine with further tables of changes, by their keys
    joined : names that each combination joins
    """
    redesigns, all_changes = {}, dict(take_changes(content, reader))
    for name, change in all_changes.items():
        redesigned = reader.tried(partial(read, {change_of(name): change}))
        if redesigned is None:
            del content["options"][name]
        else:
            redesigns[name] = redesigned
    machines: dict[str, Machine] = {}
    for option, names in joined.items():
        where = reader.file_and_key(("options", option))
        if set(names) & set(all_changes) <= set(redesigns):
            changed = reader.tried(partial(joined_machine, where, names, all_changes, read))
            machines |= {} if changed is None else {option: changed}
    return redesigns, machines


def _under(plate: StructureBorne | None, machine: Machine) -> Machine:
    return machine if plate is None else plate.under(machine)


def _refused_with_machine(content: dict[str, Any], reader: Reader) -> ParameterError:
    """Return the refusal of a study whose machine is refused, with what else is wrong with it."""
    fill_in_automatic(content, None)
    try:
        checked(Study, content, reader)
    except ParameterError as error:
        lacking = f"{reader.path}: machine"  # which is refused already
        reader.problems += [line for line in error.args if not line.startswith(lacking)]
    return ParameterError(*first_lines(reader.problems))


def load_machine(path: str | Path) -> Machine:
    """Read a machine file alone.

    Raises
    ------
    ParameterError
        See `load_study`; also where a value has no source.

    Parameters
    ----------
    path : TOML file of a machine

    Examples
    --------
    >>> va.load_machine("data/machines/mayekawa_wbhe.toml").kind
    'reciprocating'
    """
    path = Path(path)
    for point in operating_points(path):  # refused here, not where a study first names them
        _machine_alone(path, point)
    return _machine_alone(path, None)


def _machine_alone(path: Path, point: str | None) -> Machine:
    machine, reader = read_machine(path, {}, Reader(path, {}), point)
    warn_of_doubts(machine, reader)
    return machine


FILLED_IN: Final = (
    "records", "ranges", "held_ranges", "source_file", "given", "catalogue_machine", "coarsened",
    "titles", "left_out",
)  # fmt: skip


"""Here, not by a file."""


_WITH_DATA_FILES: Final = ("machines", "options", "shell_modes", "sources")


"""Tables in which every `file`, at any depth, is the name of a data file."""


def _machine_table(content: dict[str, Any], reader: Reader) -> tuple[Path, Any, list[str]]:
    """Take the table `machine` out of a study: its file, values it replaces, tables left out."""
    path = reader.path
    table = content.pop("machine", None)
    if not isinstance(table, dict) or not isinstance(table.get("file"), str):
        raise ParameterError(f"{path}: machine.file = missing: name the machine's TOML file")
    file = beside(reader.file(("machine", "file")), table.pop("file"))
    overrides, without = table.pop("override", {}), table.pop("without", [])
    if table:
        raise ParameterError(f"{path}: machine.{next(iter(table))}: unknown key")
    if not isinstance(without, list) or not all(isinstance(name, str) for name in without):
        raise ParameterError(f"{path}: machine.without = {without!r}: must be a list of tables")
    return file, overrides, without


def _point_named(
    content: Mapping[str, Any], keys: tuple[str, ...], points: Collection[str], reader: Reader
) -> str | None:
    """Operating point of the machine's file that a study names; none where it does not."""
    table = _table_at(content, keys[:-1])
    point = None if table is None else table.get(keys[-1])
    if point is None:
        return None
    where = f"{reader.file_and_key(keys)} = {point}"
    if not isinstance(point, str):
        raise ParameterError(f"{where}: must be the name of an operating point")
    if point not in points:
        allowed = ", ".join(points) or "none, as the machine's file has no operating_points"
        raise ParameterError(f"{where}: unknown; allowed {allowed}")
    return point


def _read_published(content: Mapping[str, Any], reader: Reader) -> None:
    """Put the published table of scores in place of the name of its file."""
    scoring = content.get("scoring")
    if not isinstance(scoring, dict) or "published_table" not in scoring:
        return
    name = scoring.pop("published_table")
    file = reader.file(("scoring", "published_table"))
    if not isinstance(name, str):
        raise ParameterError(f"{file}: scoring.published_table = {name!r}: must be a file name")
    scoring["published"] = read_published_table(beside(file, name))


def _read_measured(content: Mapping[str, Any], reader: Reader) -> None:
    """Put what the files of the measured baseline hold beside their names."""
    keys = ("measured", "baseline")
    baseline = _table_at(content, keys)
    if baseline is None:
        return
    settings = validated(BaselineSettings, baseline, reader, keys)
    folder = reader.file((*keys, "file"))
    receivers = _table_at(content, ("receivers",)) or {}
    paths = [beside(folder, name) for name in settings.file]
    held = read_baseline(settings, paths, list(receivers))
    baseline.update(
        file=settings.file,
        recorded_speed_rpm=settings.recorded_speed_rpm,
        third_octaves=tuple(held.third_octaves),
        orders=tuple(held.orders),
    )


def _plate(content: Mapping[str, Any], reader: Reader) -> StructureBorne | None:
    """The plate under the feet; none where there is none, or a measured floor in its stead."""
    table = _table_at(content, ("structure_borne",))
    if table is None or _table_at(content, ("measured", "floor")) is not None:
        return None
    return validated(StructureBorne, table, reader, ("structure_borne",))


def _resolve_file_names(content: Mapping[str, Any], reader: Reader) -> None:
    """Make names of files relative to the file that gives them."""
    _resolve(content, ("radiation", "body", "file"), reader)
    for name in ("floor", "sound", "shell"):
        _resolve_list(content, ("measured", name, "frequency_responses"), reader)
    patterns = _table_at(content, ("radiation", "body", "patterns"))
    for name in () if patterns is None else patterns:
        _resolve(content, ("radiation", "body", "patterns", name), reader)


def _resolve(content: Mapping[str, Any], keys: tuple[str, ...], reader: Reader) -> None:
    table = _table_at(content, keys[:-1])
    if table is not None and isinstance(table.get(keys[-1]), str):
        table[keys[-1]] = str(beside(reader.file(keys), table[keys[-1]]))


def _resolve_list(content: Mapping[str, Any], keys: tuple[str, ...], reader: Reader) -> None:
    """Resolve a list of names."""
    table = _table_at(content, keys[:-1])
    if table is not None and isinstance(table.get(keys[-1]), list):
        file = reader.file(keys)
        table[keys[-1]] = [
            str(beside(file, name)) if isinstance(name, str) else name for name in table[keys[-1]]
        ]


def _table_at(content: Any, keys: tuple[str, ...]) -> dict[str, Any] | None:
    for key in keys:
        content = content.get(key) if isinstance(content, dict) else None
    return content if isinstance(content, dict) else None


def load_study_or_machine(path: str | Path) -> Study | Machine:
    """Read a study; or, of a file that names a kind of machine by itself, that machine."""
    is_machine = "kind" in read_toml(Path(path))
    return load_machine(path) if is_machine else load_study(path)
