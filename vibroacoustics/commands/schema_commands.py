"""Commands that write files to begin with, and their schemas. Heavy imports wait until they run."""

from pathlib import Path
from typing import Annotated, Any

import typer

from .options import Plugins, load_plugins, out_option

commands = typer.Typer()


@commands.command("new")
def new_command(
    kind: Annotated[str, typer.Argument(metavar="KIND", help="Of machine.")],
    out: Annotated[Path | None, out_option("Folder of the files; default: KIND.")] = None,
) -> None:
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
    for name in files:
        typer.echo(f"written: {folder / name}")
    typer.echo(f"next: vibroacoustics check {study}; vibroacoustics run {study}")


@commands.command("schema")
def schema_command(
    out: Annotated[Path, typer.Option("--out", help="Folder of the files.")] = Path("schemas"),
    plugin: Plugins = None,
) -> None:
    """Write JSON schemas: of study and machine files, for editors, and of a data sheet."""
    from ..results.data_sheet import data_sheet_schema
    from ..results.files import write_together

    load_plugins(plugin)
    schemas = _schemas() | {"data_sheet.json": _text(data_sheet_schema())}
    write_together(out, schemas)
    for name in ("study.json", "machine.json"):
        typer.echo(f"#:schema {out / name}")


def _schemas() -> dict[str, bytes]:
    """Of study and machine, by name of their file."""
    from ..study.schema.files import machine_schema, study_schema

    return {"study.json": _text(study_schema()), "machine.json": _text(machine_schema())}


def _text(schema: dict[str, Any]) -> bytes:
    from ..base.hashing import canonical_json

    return canonical_json(schema).encode() + b"\n"
