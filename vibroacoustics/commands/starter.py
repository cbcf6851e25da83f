"""Files to begin with: a shipped machine and study of each kind, put side by side in one folder."""

import re
from importlib import resources
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Any, Final

from ..base.errors import ParameterError
from ..base.hashing import canonical_json
from ..machine.machine import MACHINES
from ..study.example import marked
from ..study.schema.files import machine_schema, study_schema

STUDIES: Final = {
    "oldham-scroll": "copeland_thesis.toml",
    "minicrank-scroll": "zhao_minicrank.toml",
    "reciprocating": "mayekawa_wbhe.toml",
    "hermetic-reciprocating": "estupinan_hermetic.toml",
    "slider-link": "dagilis_slider_link.toml",
    "table": "reciprocating_table.toml",
}
"""The study that stands for a kind."""
STUDY_NAME: Final = "study.toml"
MACHINE_NAME: Final = "machine.toml"
SCHEMAS_NAME: Final = "schemas"
_SHIPPED: Final = re.compile(r'"(?:\.\./)+(?:data/)?(machines|tables)/([^"]+)"')
_ASSUMED_LEVEL: Final = re.compile(r'(?m)^level_dba = .*source = "assumed')
_OF_THE_LEVEL: Final = re.compile(r"(?m)^\[(?:overall_noise|remainder)\]\n(?:\w.*\n)+")
_CATALOGUE: Final = re.compile(r"(?m)^(catalogue_receiver = .*)$")
_NO_LEVEL: Final = """\
# The level of your whole machine, where a catalogue or a measurement gives one; what the model
# leaves of it is then added. Without these two tables levels hold only what the model holds.
"""
_HEAD: Final = """\
#:schema {schemas}/{schema}.json
# From {name} of vibroacoustics: put the values of your machine in place of these.
# Units are in the keys. A machine's value, also one that an option changes, is {{ value, source }},
# with a range where it is assumed; elsewhere a number does. Ranges are sampled where a study has
# [sources.NAME]. A source that begins with "example: " names the value that it is of: write yours
# with another value; `vibroacoustics check` counts those that are still the example's.
"""


def starting_files(kind: str) -> dict[str, bytes]:
    """Study, machine and the tables they read, by name; the schemas are not among them.


    Raises
    ------
    ParameterError
        There is no such kind, or none of the package's studies is of it.
    """
    MACHINES[kind]  # refuses what is unknown
    if kind not in STUDIES:
        raise ParameterError(f"kind = {kind}: has no study here; allowed {', '.join(STUDIES)}")
    name = STUDIES[kind]
    study = _without_published((_shipped() / "pipelines" / name).read_text(encoding="utf-8"))
    files = {STUDY_NAME: study}
    pending = _SHIPPED.findall(study)
    while pending:
        folder, file = pending.pop()
        text = (_shipped() / "data" / folder / file).read_text(encoding="utf-8")
        if _new_name(folder, file) not in files:
            pending += _SHIPPED.findall(text)
            files[_new_name(folder, file)] = text
    files = _without_assumed_level(files)
    machine = next(file for folder, file in _SHIPPED.findall(study) if folder == "machines")
    named = {
        STUDY_NAME: ("study", f"pipelines/{name}"),
        MACHINE_NAME: ("machine", f"data/machines/{machine}"),
    }
    new = {file: _rewritten(text, *named.get(file, ())).encode() for file, text in files.items()}
    return {**new, **{file: marked(new[file].decode(), new).encode() for file in named}}


def _shipped() -> Traversable:
    """Folder of the shipped files: in the package, or the repository that it is installed from."""
    package = resources.files(__package__.partition(".")[0])
    packed = package / "shipped"
    return packed if packed.is_dir() else Path(str(package)).parent


def _new_name(folder: str, file: str) -> str:
    return MACHINE_NAME if folder == "machines" else file


def _without_published(text: str) -> str:
    """A study without the published values of the machine that it was made for."""
    text = re.sub(r"(?m)^# Published values.*\n\[evidence\]\n(?:.+\n)*\n?", "", text)
    return re.sub(r'(?m)^\[scoring\]\npublished_table = ".*"\n\n?', "", text)


def _without_assumed_level(files: dict[str, str]) -> dict[str, str]:
    """Files whose machine gives no level that was assumed; what gave it stays as a comment."""
    if not _ASSUMED_LEVEL.search(files[MACHINE_NAME]):
        return files
    machine = _OF_THE_LEVEL.sub(lambda table: _commented(table[0]), files[MACHINE_NAME])
    machine = machine.replace("# [overall_noise]", f"{_NO_LEVEL}# [overall_noise]")
    study = _CATALOGUE.sub(r"# \1  # with overall_noise in machine.toml", files[STUDY_NAME])
    return {**files, MACHINE_NAME: machine, STUDY_NAME: study}


def _commented(text: str) -> str:
    return "".join(f"# {line}" for line in text.splitlines(keepends=True))


def _rewritten(text: str, schema: str = "", name: str = "") -> str:
    """A file whose others lie beside it, with a head that says where it is from."""
    text = _SHIPPED.sub(lambda match: f'"{_new_name(*match.groups())}"', text)
    if not schema:
        return text
    head = _HEAD.format(schemas=SCHEMAS_NAME, schema=schema, name=name)
    return head + text.partition("\n")[2]


def schemas() -> dict[str, bytes]:
    """Return the schemas of study and machine by the names of their files."""
    return {"study.json": as_file(study_schema()), "machine.json": as_file(machine_schema())}


def as_file(schema: dict[str, Any]) -> bytes:
    """Content of the file of a schema."""
    return canonical_json(schema).encode() + b"\n"
