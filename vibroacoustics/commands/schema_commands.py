"""Command that writes the schemas of the files, for editors. Heavy imports wait until it runs."""

from pathlib import Path
from typing import Annotated

import typer

from .options import Plugins, load_plugins

commands = typer.Typer()


@commands.command("schema")
def schema_command(
    out: Annotated[Path, typer.Option("--out", help="Folder of the two files.")] = Path("schemas"),
    plugin: Plugins = None,
) -> None:
    """Write JSON schemas of study and machine files: editors then complete and check keys."""
    from ..base.hashing import canonical_json
    from ..results.files import only_writer, replace_all, write
    from ..study.schema.files import machine_schema, study_schema

    load_plugins(plugin)
    schemas = {"study.json": study_schema(), "machine.json": machine_schema()}
    with only_writer(out) as staged:
        for name, schema in schemas.items():
            write(staged / name, canonical_json(schema).encode() + b"\n")
        replace_all(staged, out)
    for name in schemas:
        typer.echo(f"#:schema {out / name}")
