"""Commands that write files to begin with, and their schemas. Heavy imports wait until they run."""

from pathlib import Path
from typing import Annotated, Any

from .command import command
from .options import Plugins, load_plugins
from .outcome import SCHEMA, Outcome


@command("new", "Studies", "oldham-scroll --out my_machine", computes=False)
def new_command(
    kind: Annotated[str, "KIND: Kind of machine."],
    out: Annotated[Path | None, "Folder of the files; default: KIND."] = None,
) -> Outcome:
    """Write a commented machine file and study to begin with, and their schemas."""
    from ..base.errors import StorageError
    from ..results.files import only_writer, replace_all, write
    from . import starter

    folder = out or Path(kind)
    files = starter.starting_files(kind)
    files |= {f"{starter.SCHEMAS_NAME}/{name}": text for name, text in _schemas().items()}
    with only_writer(folder) as staged:
        for name in files:
            if staged.target.status(name) is not None:
                raise StorageError(f"{folder / name}: is there already; nothing is written")
        for name, content in files.items():
            write(staged, name, content)
        replace_all(staged)
    study = folder / starter.STUDY_NAME
    return Outcome(
        f"next: vibroacoustics check {study}; vibroacoustics run {study}",
        {f"written {name}": folder / name for name in files},
    )


@command("schema", "Installation", "envelope", computes=False)
def schema_command(
    name: Annotated[
        str | None,
        "NAME: Schema to print: study, machine, data_sheet or envelope.",
    ] = None,
    out: Annotated[Path, "Folder of the files."] = Path("schemas"),
    plugin: Plugins = None,
) -> Outcome:
    """Write JSON schemas of study, machine, data sheet and of the object of --json; or print one.

    Editors take those of study and machine.
    """
    from ..results.data_sheet import data_sheet_schema
    from ..results.files import write_together
    from .arguments import chosen

    load_plugins(plugin)
    schemas = _schemas() | {"data_sheet.json": _text(data_sheet_schema())}
    schemas["envelope.json"] = _text(SCHEMA)
    if name is not None:
        known = [file.removesuffix(".json") for file in schemas]
        return Outcome(schemas[f"{chosen('NAME', name, known)}.json"].decode())
    write_together(out, schemas)
    lines = (f"#:schema {out / file}" for file in ("study.json", "machine.json"))
    return Outcome("\n".join(lines), {file: out / file for file in schemas})


def _schemas() -> dict[str, bytes]:
    """Of study and machine, by name of their file."""
    from ..study.schema.files import machine_schema, study_schema

    return {"study.json": _text(study_schema()), "machine.json": _text(machine_schema())}


def _text(schema: dict[str, Any]) -> bytes:
    from ..base.hashing import canonical_json

    return canonical_json(schema).encode() + b"\n"
