"""The command line: run, radiation, orders, compare, report, score, cache, doctor and others.

Heavy imports wait until a command needs them.
"""

import gc
import sys
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from pathlib import Path
from typing import Annotated, Final

import typer

from ..base.errors import VibroacousticsError
from ..base.progress import no_progress
from . import curve_commands, messages, recording_commands

INPUT_ERROR = 2
COLLECTIONS: Final = (100_000, 10, 10)
"""Thresholds of the collector of cyclic garbage: imports and figures make next to none of it, and
at the usual 700 it takes a tenth of a run's time."""

app = typer.Typer(
    help="From mechanism to microphone: forces, feet and sound of a compressor.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
)

app.add_typer(curve_commands.commands)
app.add_typer(recording_commands.commands)

StudyFile = Annotated[Path, typer.Argument(metavar="STUDY.toml", help="The study to run.")]
Plugins = Annotated[
    list[Path] | None,
    typer.Option(
        "--plugin",
        metavar="FILE.py",
        help="Python file with options, sources, machines, readers, … of yours; it is run.",
    ),
]
NoCache = Annotated[
    bool, typer.Option("--no-cache", help="Neither read nor write the cache of the radiation.")
]
LimitsFile = Annotated[
    Path | None,
    typer.Option(
        "--limits",
        metavar="LIMITS.csv",
        help="Hold the orders against these limits: channel,order,limit,unit. "
        "The exit code is 0 where they are exceeded, too.",
    ),
]
ResultsFile = Annotated[Path, typer.Argument(metavar="RESULTS.nc", help="Results of a run.")]


def main() -> None:
    """Run the command line; an input error is one line on stderr and exit code 2."""
    gc.set_threshold(*COLLECTIONS)
    try:
        with messages.warnings_in_one_line():
            app()
    except VibroacousticsError as error:
        print(f"error: {' '.join(str(error).split())}", file=sys.stderr)
        sys.exit(INPUT_ERROR)
    except MemoryError as error:
        print(f"error: not enough memory: {error}", file=sys.stderr)
        sys.exit(INPUT_ERROR)


@app.command("run")
def run_command(
    study_file: StudyFile,
    out: Annotated[
        Path | None,
        typer.Option("--out", help="Folder of the results; default: reports/NAME OF THE STUDY."),
    ] = None,
    plugin: Plugins = None,
    no_cache: NoCache = False,
) -> None:
    """Run a study and write results.nc, report.html, tables and figures."""
    from .. import pipeline, report
    from ..study import loading
    from . import outputs

    _load(plugin)
    folder = out or Path("reports") / study_file.stem
    study = loading.load_study(study_file)
    outputs.check_folder(folder)
    with _cache(no_cache), _progress_bar() as progress:
        results = pipeline.run(study, progress)
    written = outputs.write_report(results, folder)
    typer.echo(report.comparison_text(results))
    typer.echo(f"report: {written}")
    messages.warn(outputs.older_files(folder))


@app.command("radiation")
def radiation_command(
    study_file: StudyFile,
    out: Annotated[
        Path | None,
        typer.Option("--out", help="Folder of the results; default: reports/NAME OF THE STUDY."),
    ] = None,
    plugin: Plugins = None,
    no_cache: NoCache = False,
) -> None:
    """Compute the housing's radiation alone: transfer vectors, map, directivity, sound power."""
    from .. import pipeline, report
    from ..study import loading
    from . import outputs

    _load(plugin)
    folder = out or Path("reports") / study_file.stem
    study = loading.load_study(study_file)
    outputs.check_folder(folder)
    with _cache(no_cache), _progress_bar() as progress:
        radiated = pipeline.radiate(study, progress)
    written = outputs.write_radiation(radiated, folder)
    typer.echo(report.radiation_text(radiated))
    typer.echo(f"transfer vectors: {written}")


@app.command("orders")
def orders_command(
    recording_file: Annotated[Path, typer.Argument(metavar="FILE", help="The recording.")],
    speed: Annotated[
        str | None,
        typer.Option(
            help="Channel of the tacho, or of the speed in rpm; with --tacholess, of the signal."
        ),
    ] = None,
    pulses: Annotated[int, typer.Option(help="Pulses of the tacho per revolution.")] = 1,
    index: Annotated[
        str | None, typer.Option(help="Channel with one pulse a revolution: crank angle zero.")
    ] = None,
    rpm: Annotated[float | None, typer.Option(help="Nominal speed, instead of a channel.")] = None,
    tacholess: Annotated[
        tuple[float, float] | None,
        typer.Option(metavar="LOWEST HIGHEST", help="Find the speed in the signal, rpm."),
    ] = None,
    orders: Annotated[str, typer.Option(help="Orders wanted, with commas.")] = "1,2,3,4",
    maximum_order: Annotated[float, typer.Option(help="Highest order of spectra and map.")] = 20.0,
    resolution: Annotated[float, typer.Option(help="Coarsest resolution, orders.")] = 0.25,
    speed_step: Annotated[float, typer.Option(help="Of a run-up's operating points, rpm.")] = 100.0,
    with_map: Annotated[bool, typer.Option("--map", help="Keep and draw the order map.")] = False,
    unit: Annotated[
        list[str] | None, typer.Option(metavar="CHANNEL=UNIT", help="Where the file states none.")
    ] = None,
    calibration: Annotated[
        list[str] | None,
        typer.Option(metavar="CHANNEL=FACTOR", help="Unit per unit stored in the file."),
    ] = None,
    channels: Annotated[str | None, typer.Option(help="Channels to read, with commas.")] = None,
    sample_rate: Annotated[
        float | None, typer.Option(help="Actual sample rate, Hz, instead of the file's.")
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option("--out", help="Folder of the results; default: reports/NAME OF THE FILE."),
    ] = None,
    limits: LimitsFile = None,
    plugin: Plugins = None,
) -> None:
    """Find the orders of a recording: netCDF, CSV, figures and a table."""
    from .. import pipeline, recordings, report
    from . import arguments, checking, outputs

    settings = arguments.order_analysis(
        speed, pulses, index, rpm, tacholess, orders, maximum_order, resolution, speed_step,
        with_map,
    )  # fmt: skip
    _load(plugin)
    folder = out or Path("reports") / recording_file.stem
    outputs.check_folder(folder)
    allowed = checking.read(limits)
    recording = recordings.read_recording(
        recording_file,
        units=arguments.assignments("--unit", unit),
        calibration=arguments.numbers("--calibration", calibration),
        channels=None if channels is None else channels.split(","),
        sample_rate_hz=sample_rate,
    )
    with _progress_bar() as progress:
        results = pipeline.analyse_orders(recording, settings, progress)
        results = checking.held_against(results, allowed)
        written = outputs.write_orders(results, folder)
    typer.echo(report.orders_text(results))
    checking.print_margins(results, folder / outputs.LIMITS_NAME)
    typer.echo(f"orders: {written}")


@app.command("compare")
def compare_command(
    first: Annotated[Path, typer.Argument(metavar="A.nc", help="Results of `run` or `orders`.")],
    second: Annotated[Path, typer.Argument(metavar="B.nc", help="Results to compare with.")],
    pair: Annotated[
        list[str] | None,
        typer.Option(metavar="CHANNEL_OF_A=CHANNEL_OF_B", help="Default: channels of one name."),
    ] = None,
    option: Annotated[str, typer.Option(help="Balancing option of a study.")] = "none",
    tacho_angle: Annotated[
        float, typer.Option(help="Crank angle of A where B's tacho gives its pulse, degrees.")
    ] = 0.0,
    out: Annotated[
        Path | None, typer.Option("--out", help="Folder of the results; default: that of B.")
    ] = None,
    limits: LimitsFile = None,
) -> None:
    """Compare two results order by order, in level and phase."""
    from math import radians

    from .. import report
    from ..results import order_comparison
    from . import arguments, checking, outputs

    folder = out or second.parent
    outputs.check_folder(folder)
    allowed = checking.read(limits)
    compared = order_comparison.compare(
        outputs.open_orders(first),
        outputs.open_orders(second),
        arguments.assignments("--pair", pair),
        option,
        radians(tacho_angle),
    )
    compared = checking.held_against(compared, allowed)
    written = outputs.write_comparison(compared, folder)
    typer.echo(report.comparison_of_orders_text(compared))
    checking.print_margins(compared, folder / outputs.COMPARED_LIMITS_NAME)
    typer.echo(f"compared orders: {written}")


@app.command("report")
def report_command(
    results_file: ResultsFile,
    out: Annotated[
        Path | None, typer.Option("--out", help="Folder of the report; default: that of the file.")
    ] = None,
    plugin: Plugins = None,
) -> None:
    """Write the report of results again, without computing anything."""
    from . import outputs

    _load(plugin)
    folder = out or results_file.parent
    typer.echo(f"report: {outputs.write_report_again(results_file, folder)}")
    messages.warn(outputs.older_files(folder))


@app.command("score")
def score_command(
    results_file: ResultsFile,
    scoring_of: Annotated[
        Path | None,
        typer.Option("--scoring", metavar="STUDY.toml", help="Take scales and weights from here."),
    ] = None,
    plugin: Plugins = None,
) -> None:
    """Score the options again and print the ranking."""
    from .. import scoring
    from ..results import manifest
    from ..study import loading
    from . import outputs

    _load(plugin)
    results, _ = outputs.open_run(results_file)
    messages.warn(manifest.mixed(results_file.parent))
    settings = loading.load_study(scoring_of).scoring if scoring_of else None
    typer.echo(scoring.ranking_text(scoring.score(results, settings)))


@app.command("cache")
def cache_command(
    clear: Annotated[bool, typer.Option("--clear", help="Remove all of it.")] = False,
    limit: Annotated[
        float | None,
        typer.Option(
            metavar="GB",
            min=0.0,
            max=1e6,
            help="Largest size from now on; default: 2. Oldest use goes first.",
        ),
    ] = None,
) -> None:
    """List what is cached, the least recently used first; clear it or limit its size."""
    from . import caching

    for line in caching.lines(clear, limit):
        typer.echo(line)


@app.command("doctor")
def doctor_command(
    folder: Annotated[
        Path | None, typer.Argument(metavar="[FOLDER]", help="Check the results in it, too.")
    ] = None,
) -> None:
    """Tell versions, memory, FFT, k-Wave and cache, without a network."""
    from . import doctor

    for line in doctor.findings(folder):
        typer.echo(line)


def _cache(unused: bool) -> AbstractContextManager[None]:
    """The use of the cache that is asked for."""
    from ..results import storage

    return storage.without_cache() if unused else nullcontext()


def _load(plugins: list[Path] | None) -> None:
    """Take in the files that the user names."""
    from ..base.plugin_file import load_plugin

    for file in plugins or ():
        load_plugin(file)


@contextmanager
def _progress_bar() -> Iterator[Callable[[str, int, int], None]]:
    """A bar with remaining time on stderr; silent where stderr is no terminal."""
    if not sys.stderr.isatty():
        yield no_progress
        return
    from rich.console import Console
    from rich.progress import (
        BarColumn,
        Progress,
        TaskID,
        TextColumn,
        TimeElapsedColumn,
        TimeRemainingColumn,
    )

    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        TimeElapsedColumn(),
        TextColumn("ETA"),
        TimeRemainingColumn(),
    )
    tasks: dict[str, TaskID] = {}
    with Progress(*columns, console=Console(stderr=True)) as bar:

        def advance(description: str, done: int, total: int) -> None:
            if description not in tasks:
                tasks[description] = bar.add_task(description, total=total)
            bar.update(tasks[description], completed=done, total=total)

        yield advance
