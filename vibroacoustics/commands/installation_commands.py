"""Commands for the installation: cache and doctor. Heavy imports wait until they run."""

from pathlib import Path
from typing import Annotated

import typer

from .command import command
from .outcome import Outcome, columns


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
    from . import caching

    return caching.managed(clear, limit)


@command("doctor", "Installation", "reports/copeland_sources", computes=False)
def doctor_command(
    folder: Annotated[Path | None, "FOLDER: Folder of results to check, too."] = None,
) -> Outcome:
    """Show versions, memory, FFT, k-Wave and cache, without a network."""
    from . import doctor

    lines = list(doctor.findings(folder))
    return Outcome("\n".join(lines), tables={"findings": columns([{"finding": x} for x in lines])})
