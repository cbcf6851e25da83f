"""Files to begin with: a shipped machine and study of each kind, put side by side in one folder."""

import re
from collections.abc import Iterator
from importlib import resources
from pathlib import Path
from typing import Any, Final

from ..base.errors import ParameterError
from ..base.plain_bytes import canonical_json
from ..base.units import si_key
from ..machine.machine import MACHINES, Machine
from ..study.automatic import AUTO
from ..study.example import MARK, marked
from ..study.loading import load_study
from ..study.schema.files import machine_schema, study_schema
from ..study.study import Study
from ..study.toml_blocks import Block, Entry, blocks_of, text_of
from .own_machine import (
    OWN_SOURCE,
    applied_overrides,
    commented_options,
    named_for,
    with_level,
    without_published,
)

STUDIES: Final = {kind: of.template for kind, of in MACHINES.items() if of.template}
"""The study that is the template of a kind."""
WITH_SOURCES: Final = {
    kind: of.template_with_sources for kind, of in MACHINES.items() if of.template_with_sources
}
"""The template of a kind with sources of sound."""
STUDY_NAME: Final = "study.toml"
MACHINE_NAME: Final = "machine.toml"
SCHEMAS_NAME: Final = "schemas"
_SHIPPED: Final = re.compile(r'"(?:\.\./)+(?:data/)?(machines|tables)/([^"]+)"')
_HEAD: Final = """\
#:schema {schemas}/{schema}.json
# From {name} of vibroacoustics: put the values of your machine in place of these.
# Units are in the keys. A machine's value, also one that an option changes, is {{ value, source }},
# with a range where it is assumed; elsewhere a number does. Ranges are sampled where a study has
# [sources.NAME]. A source that begins with "example: " names the value that it is of: write yours
# with another value; `vibroacoustics check` counts those that are still the example's. Commented
# tables are not read by this study: remove the # of a whole table to use it.
"""


def starting_files(
    kind: str, with_sources: bool = False, level_dba: float | None = None
) -> dict[str, bytes]:
    """Study, machine and the tables they read, by name; the schemas are not among them.

    What belongs to the published machine alone is not among them: its name, errata, level, scores
    and the dimensions of its options.

    Parameters
    ----------
    kind : kind of machine
    with_sources : whether the study has the sources of sound of the kind
    level_dba : level of the user's machine at 1 m, dB(A); none where it is not known
    """
    path = shipped_folder() / "pipelines" / study_for(kind, with_sources)
    shipped = load_study(path)
    study = _with_extended(path)
    machine_file = _machine_file(study, path)
    machine = blocks_of(machine_file.read_text(encoding="utf-8"))
    study = applied_overrides(study, machine)
    study, machine = without_published(study), without_published(machine)
    _comment_unread(machine, shipped)
    named_for(kind, study, machine)
    with_level(study, machine, level_dba, shipped)
    commented_options(study)
    _make_automatic(study)
    files = {
        STUDY_NAME: _written(study, "study", f"pipelines/{path.name}"),
        MACHINE_NAME: _written(machine, "machine", f"data/machines/{machine_file.name}"),
    }
    texts = [text_of(study), text_of(machine)]
    while texts:
        for folder, name in _SHIPPED.findall(texts.pop()):
            if folder == "tables" and name not in files:
                text = (shipped_folder() / "data" / folder / name).read_text(encoding="utf-8")
                files[name] = _beside(text)
                texts.append(text)
    new = {name: text.encode() for name, text in files.items()}
    return {**new, **{name: _marked(files[name], new) for name in (STUDY_NAME, MACHINE_NAME)}}


def _marked(text: str, files: dict[str, bytes]) -> bytes:
    """Mark the sources of a file's values as the example's, but not those of the user's level."""
    return re.sub(rf'"{MARK}[^;"]*; {OWN_SOURCE}', f'"{OWN_SOURCE}', marked(text, files)).encode()


def study_for(kind: str, with_sources: bool) -> str:
    """Name of the shipped study of a kind.

    Raises
    ------
    ParameterError
        There is no such kind, none of the package's studies is of it, or it has no sources.
    """
    MACHINES[kind]  # refuses what is unknown
    studies = WITH_SOURCES if with_sources else STUDIES
    if kind not in studies:
        what = "--with sources: kind" if kind in STUDIES else "kind"
        lacks = "no sources of sound beside its moving parts" if kind in STUDIES else "no study"
        raise ParameterError(f"{what} = {kind}: has {lacks}; allowed {', '.join(studies)}")
    return studies[kind]


def shipped_folder() -> Path:
    """Folder of the shipped files: in the package, or the repository that it is installed from."""
    package = Path(str(resources.files(__package__.partition(".")[0])))
    packed = package / "shipped"
    return packed if packed.is_dir() else package.parent


def _with_extended(path: Path) -> list[Block]:
    """Blocks of a study over those of the study that it extends."""
    blocks = blocks_of(path.read_text(encoding="utf-8"))
    first = blocks[0]
    extends = first.entry("extends")
    if extends is None:
        return blocks
    first.entries.remove(extends)
    base = _with_extended(path.parent / extends.value)
    by_keys = {block.keys: block for block in base}
    for block in blocks:
        if block.keys in by_keys:
            for entry in block.entries:
                by_keys[block.keys].put(entry)
        else:
            base.append(block)
    return base


def _machine_file(study: list[Block], path: Path) -> Path:
    named = next(block for block in study if block.keys == ("machine",)).entry("file")
    if named is None:
        raise ParameterError(f"{path}: machine.file = missing: name the machine's TOML file")
    return path.parent / str(named.value)


def _comment_unread(machine: list[Block], shipped: Study) -> None:
    """Turn tables and values that the study does not read to comments."""
    read = {record.field for record in shipped.records if not record.field.startswith("options.")}
    for block in machine:
        table, owner = ".".join(block.keys), _owner(shipped.machine, block.keys)
        is_read = not block.keys or any(field.startswith(f"{table}.") for field in read)
        field = type(shipped.machine).model_fields.get(block.keys[0] if block.keys else "")
        if not is_read and (field is None or not field.is_required()):
            block.comment_out()
            continue
        for entry in block.entries:
            has_source = isinstance(entry.value, dict)
            dotted = f"{table}.{entry.key}" if table else entry.key
            entry.active = not has_source or dotted in read or _is_required(owner, entry.key)


def _owner(machine: Machine, keys: tuple[str, ...]) -> Any:
    owner: Any = machine
    for key in keys:
        owner = getattr(owner, key, None)
    return owner


def _is_required(owner: Any, key: str) -> bool:
    """Whether a table needs a value; also where it is not known what the table is."""
    field = getattr(type(owner), "model_fields", {}).get(si_key(key)[0])
    return field is None or bool(field.is_required())


def _make_automatic(study: list[Block]) -> None:
    """Leave crank angles and the highest frequency to the package."""
    for keys, name in (("operation", "crank_angle_samples"), ("radiation", "maximum_frequency_hz")):
        block = next(block for block in study if block.keys == (keys,))
        block.put(Entry(name, f'{name} = "{AUTO}"'))


def _written(blocks: list[Block], schema: str, name: str) -> str:
    head = _HEAD.format(schemas=SCHEMAS_NAME, schema=schema, name=name)
    return head + _beside(text_of(blocks))


def _beside(text: str) -> str:
    """A file whose others are in the same folder."""
    return _SHIPPED.sub(
        lambda match: f'"{MACHINE_NAME if match[1] == "machines" else match[2]}"', text
    )


def schemas() -> dict[str, bytes]:
    """Return the schemas of study and machine by the names of their files."""
    return {"study.json": as_file(study_schema()), "machine.json": as_file(machine_schema())}


def as_file(schema: dict[str, Any]) -> bytes:
    """Content of the file of a schema."""
    return canonical_json(schema).encode() + b"\n"


def kinds() -> Iterator[tuple[str, tuple[str, ...]]]:
    """Kinds with a study to begin with, each with its kinds of sources."""
    for kind in STUDIES:
        file = WITH_SOURCES.get(kind)
        blocks = _with_extended(shipped_folder() / "pipelines" / file) if file else []
        tables = [block.entry("kind") for block in blocks if block.keys[:1] == ("sources",)]
        yield kind, tuple(str(entry.value) for entry in tables if entry is not None)
