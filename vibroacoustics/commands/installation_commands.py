"""Commands for the installation: cache, doctor and schema. Heavy imports wait until they run."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from .command import command
from .options import Plugins, load_plugins
from .outcome import SCHEMA, Outcome, columns

if TYPE_CHECKING:
    from ..results.cache import Entry


@command("cache", "Installation", "--limit 5", computes=False)
def cache_command(
    clear: Annotated[bool, "Remove all of it."] = False,
    limit: Annotated[
        float | None,
        typer.Option(
            min=0.0,
            max=1e6,
            help="Largest size from now on, GB; default: 2. Oldest use goes first.",
        ),
    ] = None,
) -> Outcome:
    """List cached results with their studies; clear the cache or limit its size."""
    from datetime import datetime

    from ..results import cache
    from ..results.files import naming

    path = cache.folder()
    removed: list[Entry] = []
    if limit is not None or path.exists():
        with cache.opened() as folder, naming(path):
            if limit is not None:
                cache.set_limit(folder, round(1e9 * limit))
            removed = cache.clear(folder) if clear else cache.tidy(folder)
    entries, most = cache.contents()
    rows: list[dict[str, Any]] = [
        {
            "used": datetime.fromtimestamp(entry.used_s).isoformat(" ", "minutes"),
            "size_mb": entry.size_bytes / 1e6,
            "name": entry.name,
            "study": entry.study or "unknown study",
        }
        for entry in entries
    ]
    lines = [f"removed {len(removed)} results, {_megabytes(removed)}"] if removed else []
    lines += ["{used}  {size_mb:9.1f} MB  {name}  {study}".format(**row) for row in rows]
    total = f"{len(entries)} results, {_megabytes(entries)} of at most {most / 1e6:g} MB"
    return Outcome("\n".join([*lines, f"{path}: {total}"]), tables={"entries": columns(rows)})


@command("doctor", "Installation", "reports/copeland_sources", computes=False)
def doctor_command(
    folder: Annotated[Path | None, "FOLDER: Folder of results to check, too."] = None,
) -> Outcome:
    """Show versions, memory, FFT, k-Wave and cache, without a network."""
    from . import doctor

    lines = list(doctor.findings(folder))
    return Outcome("\n".join(lines), tables={"findings": columns([{"finding": x} for x in lines])})


@command("schema", "Installation", "envelope", computes=False)
def schema_command(
    name: Annotated[
        str | None, "NAME: Schema to print: study, machine, data_sheet or envelope."
    ] = None,
    out: Annotated[Path, "Folder of the files."] = Path("schemas"),
    plugin: Plugins = None,
) -> Outcome:
    """Write JSON schemas of study, machine, data sheet and of the object of --json; or print one.

    Editors take those of study and machine.
    """
    from ..results.data_sheet import data_sheet_schema
    from ..results.files import write_together
    from . import starter
    from .arguments import chosen

    load_plugins(plugin)
    schemas = starter.schemas() | {"data_sheet.json": starter.as_file(data_sheet_schema())}
    schemas["envelope.json"] = starter.as_file(SCHEMA)
    if name is not None:
        names = [file.removesuffix(".json") for file in schemas]
        return Outcome(schemas[f"{chosen('NAME', name, names)}.json"].decode())
    write_together(out, schemas)
    lines = (f"#:schema {out / file}" for file in ("study.json", "machine.json"))
    return Outcome("\n".join(lines), {file: out / file for file in schemas})


def _megabytes(entries: "list[Entry]") -> str:
    return f"{sum(entry.size_bytes for entry in entries) / 1e6:.1f} MB"
