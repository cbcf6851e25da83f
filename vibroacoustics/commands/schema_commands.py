"""Commands that write files to begin with, and their schemas. Heavy imports wait until they run."""

from pathlib import Path
from typing import Annotated

import typer

from .options import Plugins, load_plugins

commands = typer.Typer()


@commands.command("new")
def new_command(
    kind: Annotated[str, typer.Argument(metavar="KIND", help="Of machine.")],
    out: Annotated[
        Path | None, typer.Option("--out", help="Folder of the files; default: KIND.")
    ] = None,
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
            if (folder / name).exists():
                raise StorageError(f"{folder / name}: is there already; nothing is written")
        for name, content in files.items():
            write(staged / name, content)
        replace_all(staged, folder)
    study = folder / starter.STUDY_NAME
    for name in files:
        typer.echo(f"written: {folder / name}")
    typer.echo(f"next: vibroacoustics check {study}; vibroacoustics run {study}")


@commands.command("schema")
def schema_command(
    out: Annotated[Path, typer.Option("--out", help="Folder of the two files.")] = Path("schemas"),
    plugin: Plugins = None,
) -> None:
    """Write JSON schemas of study and machine files: editors then complete and check keys."""
    from ..results.files import only_writer, replace_all, write

    load_plugins(plugin)
    schemas = _schemas()
    with only_writer(out) as staged:
        for name, content in schemas.items():
            write(staged / name, content)
        replace_all(staged, out)
    for name in schemas:
        typer.echo(f"#:schema {out / name}")


def _schemas() -> dict[str, bytes]:
    """Both schemas by name of their file."""
    from ..base.hashing import canonical_json
    from ..study.schema.files import machine_schema, study_schema

    schemas = {"study.json": study_schema(), "machine.json": machine_schema()}
    return {name: canonical_json(schema).encode() + b"\n" for name, schema in schemas.items()}
