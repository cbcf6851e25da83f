"""Commands for the results of runs. Heavy imports wait until they are needed."""

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..base.progress import Progress
from . import messages
from .command import command
from .options import (
    LimitsFile,
    NoCache,
    Option,
    Plugins,
    Printing,
    ResultsFile,
    Speed,
    StudyFile,
    load_plugins,
    used_cache,
)
from .outcome import Outcome

if TYPE_CHECKING:
    import xarray as xr


@command("compare", "Results", "reports/mine/results.nc reports/bench/orders.nc")
def compare_command(
    first: Annotated[Path, "A: Results of `run` or `orders`, .nc."],
    others: Annotated[list[Path], "B: Results to compare with; several of `orders` are averaged."],
    pair: Annotated[
        list[str] | None,
        "CHANNEL=CHANNEL, of A and of B; may be repeated; default: channels of one name.",
    ] = None,
    option: Option = "none",
    other_option: Annotated[str | None, "Balancing option of B; default: that of A."] = None,
    specimens: Annotated[
        str | None, "Specimen of each B, with commas; default: all are of one."
    ] = None,
    tacho_angle: Annotated[
        float, "Crank angle of A where B's tacho gives its pulse, degrees."
    ] = 0.0,
    out: Annotated[Path | None, "Folder of the results; default: that of B."] = None,
    limits: LimitsFile = None,
    *,
    printing: Printing,
) -> Outcome:
    """Compare two results order by order, in level and phase: compared.html, tables, figures."""
    from math import radians

    from .. import report
    from ..results import order_comparison
    from ..results.figure_limits import Compared, check_figures
    from ..results.limits_file import read_figure_limits
    from ..results.mean_of_runs import with_scatter
    from ..results.order_limits import with_limits
    from . import arguments, outputs

    target = printing.target(out or others[0].parent)
    of_orders, of_figures = read_figure_limits(limits) if limits else ((), ())
    reference, other = outputs.open_orders(first), _second(others, specimens)
    orders = order_comparison.compare(
        reference,
        other,
        arguments.assignments("--pair", pair),
        option,
        radians(tacho_angle),
        other_option,
    )
    orders = with_limits(with_scatter(orders, other), of_orders)
    compared = Compared(orders, reference, other)
    figures = check_figures(compared, of_figures)
    analysis = report.analysis_of_comparison(compared, figures)
    broken = report.broken_lines(orders, figures)
    return target.outcome(analysis, orders, "compared_orders.nc", broken)


def _second(files: list[Path], specimens: str | None) -> "xr.Dataset":
    """The only other result, or the mean of several recordings."""
    from ..base.errors import ParameterError, gathered
    from ..results.mean_of_runs import mean_of_runs
    from . import outputs

    results = gathered(outputs.open_orders, files)
    if len(files) == 1 and specimens is None:
        return results[0]
    names = [name.strip() for name in specimens.split(",")] if specimens else []
    try:
        return mean_of_runs(results, names)
    except ParameterError as error:
        raise ParameterError(f"{', '.join(map(str, files))}: {error}") from None


@command(
    "datasheet",
    "Results",
    "reports/mine/results.nc --option lanchester --speed 2900",
)
def datasheet_command(
    results_file: ResultsFile,
    option: Option = "none",
    speed: Speed = None,
    microphone: Annotated[
        list[str] | None, "Microphone of the sound power; may be repeated; default: all."
    ] = None,
    point: Annotated[
        list[str] | None,
        "NAME=X,Y,HEIGHT: point of the housing, mm, from the axis and above the floor.",
    ] = None,
    batch: Annotated[
        float | None,
        "Assumed standard deviation of the machines of a batch, dB; default: one machine.",
    ] = None,
    out: Annotated[Path | None, "Folder; default: that of the file."] = None,
    plugin: Plugins = None,
    *,
    printing: Printing,
) -> Outcome:
    """Write the data sheet of an option, predicted: page, CSV and JSON (ISO 4871, EN 12102-1)."""
    from .. import report
    from ..declaration.sheet import data_sheet
    from . import arguments, outputs

    load_plugins(plugin)
    points_m = arguments.points("--point", point)
    target = printing.target(out or results_file.parent)
    results, _ = outputs.open_run(results_file)
    with outputs.naming(results_file):
        sheet = data_sheet(results, option, speed, microphone or None, points_m, batch)
    return target.outcome(report.analysis_of_data_sheet(sheet))


@command("listen", "Results", "reports/mine/results.nc --option none --option lanchester")
def listen_command(
    results_file: ResultsFile,
    option: Annotated[list[str] | None, "Option to listen to; default: all."] = None,
    microphone: Annotated[
        list[str] | None, "Microphone, also in a room; may be repeated; default: the first."
    ] = None,
    speed: Annotated[
        list[float] | None, "Shaft speed, rpm; may be repeated; default: the first."
    ] = None,
    seconds: Annotated[float, "Duration, s, rounded to whole revolutions; 1 to 600."] = 10.0,
    full_scale: Annotated[
        float | None,
        "Pressure at full scale, Pa; default: one that all sounds of the results fit in.",
    ] = None,
    calibration: Annotated[float | None, "Level of a further tone of 1 kHz, dB re 20 µPa."] = None,
    file_format: Annotated[
        str, typer.Option("--format", help="wav, or flac (extra `sound`).")
    ] = "wav",
    out: Annotated[Path | None, "Folder of the sounds; default: sound, beside the file."] = None,
) -> Outcome:
    """Write the sound of options at microphones, all at one gain, which the names state."""
    from . import outputs
    from .listening import listen

    results, _ = outputs.open_run(results_file)
    with outputs.naming(results_file):
        written = listen(
            results,
            out or results_file.parent / "sound",
            option or None,
            microphone or None,
            speed or None,
            duration_s=seconds,
            full_scale_pa=full_scale,
            calibration_db=calibration,
            file_format=file_format,
        )
    return Outcome(files={f"sound {number}": path for number, path in enumerate(written, 1)})


@command(
    "impulse-responses",
    "Results",
    "kitchen.toml --microphone table",
)
def impulse_responses_command(
    progress: Progress,
    study_file: StudyFile,
    microphone: Annotated[
        list[str] | None, "Microphone in the room; may be repeated; default: all."
    ] = None,
    full_scale: Annotated[
        float | None, "Pa per m/s² or rad/s² at full scale; default: one that all responses fit in."
    ] = None,
    out: Annotated[
        Path | None, "Folder of the files; default: reports/NAME OF THE STUDY/impulse_responses."
    ] = None,
    plugin: Plugins = None,
    no_cache: NoCache = False,
    *,
    printing: Printing,
) -> Outcome:
    """Write responses in a room to the shell's accelerations, for listening to measured ones."""
    from .. import pipeline
    from ..study.loading import load_study
    from . import outputs
    from .listening import check_asked, impulse_analysis

    load_plugins(plugin)
    study = load_study(study_file)
    target = printing.target(out or Path("reports") / study_file.stem / "impulse_responses")
    with outputs.naming(study_file), used_cache(no_cache):
        if study.room is not None:
            check_asked(study.room.listeners, microphone, full_scale)
        responses = pipeline.impulse_responses(study, progress)
        analysis = impulse_analysis(responses, microphone or None, full_scale)
    return target.outcome(analysis)


@command("report", "Results", "reports/copeland_sources/results.nc --pdf", computes=False)
def report_command(
    results_file: ResultsFile,
    out: Annotated[Path | None, "Folder of the report; default: that of the file."] = None,
    plugin: Plugins = None,
    *,
    printing: Printing,
) -> Outcome:
    """Write the report of results again, without computing anything; as PDF, too."""
    from . import outputs

    load_plugins(plugin)
    prints = printing.printer()
    folder = out or results_file.parent
    analysis, files = outputs.write_report_again(results_file, folder, prints)
    messages.warn(outputs.older_files(folder))
    return Outcome(files=files, analyses={"": analysis})


@command("score", "Results", "reports/mine/results.nc --scoring mine.toml")
def score_command(
    results_file: ResultsFile,
    scoring_of: Annotated[
        Path | None,
        typer.Option("--scoring", help="Study file, .toml, with other scales and weights."),
    ] = None,
    out: Annotated[
        Path | None, "Folder of what is written; default: scored, beside the file."
    ] = None,
    plugin: Plugins = None,
    *,
    printing: Printing,
) -> Outcome:
    """Score the options again: print the ranking, write results and report with it."""
    from .. import scoring
    from ..report.blocks import Bullets
    from ..results import manifest
    from ..scoring.again import scored_again
    from ..study import loading
    from . import outputs

    load_plugins(plugin)
    folder = out or results_file.parent / "scored"
    outputs.check_folder(folder, outputs.RUN_FILES)
    prints = printing.printer()
    results, _ = outputs.open_run(results_file)
    messages.warn(manifest.mixed(results_file.parent))
    settings = loading.load_study(scoring_of).scoring if scoring_of else None
    with outputs.naming(scoring_of or results_file):
        scored = scored_again(results, settings)
    analysis, files = outputs.write_study(scored, folder, prints)
    ranking = Bullets(tuple(scoring.ranking_text(scored).splitlines()))
    return Outcome(files=files, analyses={"": replace(analysis, summary=(), shown=(ranking,))})
