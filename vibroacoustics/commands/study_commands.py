"""Commands for studies: curves, run, check, radiation, new. Heavy imports wait until they run."""

import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import AbstractContextManager
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ..base.errors import ParameterError, VibroacousticsError, gathered
from ..base.fault import collected, omit
from ..base.progress import Progress, stage
from . import messages
from .command import command
from .options import (
    NoCache,
    Option,
    Plugins,
    Printing,
    StudyFile,
    StudyOut,
    load_plugins,
    resumed,
    used_cache,
)
from .outcome import Outcome, columns
from .workers import Cluster

if TYPE_CHECKING:
    import xarray as xr

    from ..study.study import Study
    from .printing import Printer


BALANCE, PERMIT = "balance", "permit"
"""Kind of `new` that writes a file of runs with trial weights."""


@command("curves", "Studies", "pipelines/copeland_sources.toml --speed 2900")
def curves_command(
    file: Annotated[Path, "FILE: Study or machine file, .toml."],
    speed: Annotated[
        float | None, "Shaft speed, rpm; default: the study's first, or of the overall noise."
    ] = None,
    option: Option = "none",
    out: Annotated[Path | None, "Folder; default: reports/NAME OF THE FILE/curves."] = None,
    plugin: Plugins = None,
    *,
    printing: Printing,
) -> Outcome:
    """Show what goes on inside a machine: curves.nc, a table and a picture of each curve."""
    from .. import report
    from ..sources.curves import curves
    from ..study.loading import load_study_or_machine

    load_plugins(plugin)
    study_or_machine = load_study_or_machine(file)
    target = printing.target(out or Path("reports") / file.stem / "curves")
    inner = curves(study_or_machine, speed, option)
    return target.outcome(report.analysis_of_curves(inner), inner, "curves.nc")


@command("run", "Studies", "pipelines/copeland_sources.toml")
def run_command(
    progress: Progress,
    study_files: Annotated[list[Path], "STUDY: Study files, .toml."],
    out: Annotated[
        Path | None,
        "Folder of the results; of several studies one in it each; "
        "default: reports/NAME OF THE STUDY.",
    ] = None,
    plugin: Plugins = None,
    no_cache: NoCache = False,
    coarse: Annotated[
        bool, "Take fewer speeds and samples and coarser grids, and report the error."
    ] = False,
    without: Annotated[
        list[str] | None, "Name of a source of the studies to omit; may be repeated."
    ] = None,
    *,
    cluster: Cluster,
    printing: Printing,
) -> Outcome:
    """Run studies and write results.nc, report.html, tables and figures of each."""
    from .summary import summary

    load_plugins(plugin)
    prints = printing.printer()
    studies = _studies(study_files, out, coarse, without or ())
    outcomes: dict[str, Outcome] = {}
    failed: dict[str, str] = {}
    with used_cache(no_cache):
        for number, (study, folder) in enumerate(studies):
            if len(studies) > 1:
                progress("all studies", number, len(studies))
            elsewhere = partial(cluster.distributing, plugin)
            work = partial(_run, study, folder, progress, prints, elsewhere)
            try:
                outcomes[folder.name] = resumed("run", study, no_cache or bool(plugin), work)
            except (VibroacousticsError, MemoryError) as error:
                if len(studies) == 1:
                    raise
                words = "not enough memory: " if isinstance(error, MemoryError) else ""
                failed[str(study_files[number])] = words + "; ".join(map(str, error.args))
        if len(studies) > 1:
            progress("all studies", len(studies), len(studies))
    if not outcomes:
        raise ParameterError(*(f"{name}: {reason}" for name, reason in failed.items()))
    for name, reason in failed.items():
        omit(name, reason)
    return summary(outcomes, len(studies) > 1, failed)


def _studies(
    files: Sequence[Path], out: Path | None, coarse: bool, without: Sequence[str]
) -> "list[tuple[Study, Path]]":
    """Studies with the folders of their results; all are read before the first one runs."""
    from ..study.coarse import coarse as coarser
    from ..study.loading import load_study
    from . import outputs

    folders: dict[Path, Path] = {}
    for file in files:
        inner = out / file.stem if out and len(files) > 1 else out
        folder = inner or Path("reports") / file.stem
        if folder in folders:
            raise ParameterError(f"{file}: two studies would write to {folder}; run one by one")
        folders[folder] = file
    studies: list[tuple[Study, Path]] = []
    loaded = gathered(partial(load_study, without=without), files)
    for read, (folder, file) in zip(loaded, folders.items(), strict=True):
        outputs.check_folder(folder, outputs.RUN_FILES)
        study = coarser(read) if coarse else read
        if coarse and not study.coarsened:
            messages.warn([f"{file}: has nothing to coarsen; it runs in full"])
        studies.append((study, folder))
    return studies


def _run(
    study: "Study",
    folder: Path,
    progress: Progress,
    prints: "Printer | None",
    elsewhere: Callable[[], AbstractContextManager[None]],
) -> Outcome:
    """Run one study, parts of it by the workers of a scheduler, and write its files."""
    from .. import pipeline
    from . import outputs
    from .summary import outcome

    start = time.monotonic()
    messages.note(f"run: {study.source_file}")
    if study.machines:
        from .several_machines import run_and_write

        with elsewhere():
            return run_and_write(study, folder, progress, prints)
    with elsewhere():
        results = pipeline.run(study, progress)
    with stage(progress, "report"):
        analysis, files = outputs.write_study(results, folder, prints)
    messages.warn(outputs.older_files(folder))
    return outcome(study, results, analysis, files, time.monotonic() - start)


@command("check", "Studies", "pipelines/copeland_sources.toml")
def check_command(
    progress: Progress,
    file: Annotated[Path, "FILE: Study or machine file, .toml."],
    plugin: Plugins = None,
    example: Annotated[
        bool, "List the values that are still the example's, and rank them by runs of the study."
    ] = False,
) -> Outcome:
    """List all errors of a study or a machine, and what a run of the study would cost."""
    from ..pipeline.cost import run_cost
    from ..radiation.cost import Cost
    from ..study.loading import load_study_or_machine
    from ..study.machine_studies import machine_studies
    from ..study.study import Study
    from ..study.summary import study_lines
    from .example_values import count_lines
    from .summary import cost_lines, machine_lines

    with collected() as left_out, stage(progress, "check"):
        load_plugins(plugin)
        checked = load_study_or_machine(file)
        if isinstance(checked, Study):
            lines, costs = [*study_lines(checked), *count_lines(checked)], list[Cost]()
            studies = machine_studies(checked) if checked.machines else {"": checked}
            for name, each in studies.items():
                cost = run_cost(each, progress)
                lines += [f"machine {name}:"] * bool(name) + list(cost_lines(cost))
                costs += cost.costs
            tables = {"cost": columns([each._asdict() for each in costs])}
        elif example:
            raise ParameterError(f"{file}: is a machine; --example needs a study that reads it")
        else:
            lines, tables = list(machine_lines(checked)), {}
    warned = left_out or messages.warned()
    what = "nothing else is wrong" if warned else "nothing is wrong"
    lines.append(f"{file}: {what}")
    if example and isinstance(checked, Study):
        further, tables["example"] = _ranked(checked, progress)
        lines += further
    return Outcome("\n".join(lines), tables=tables)


def _ranked(study: "Study", progress: Progress) -> "tuple[list[str], dict[str, list[Any]]]":
    """Rank the example's values of a study in the coarse setting, after the price is shown."""
    from ..design.example import planned, ranked
    from ..study.coarse import coarse
    from .example_values import ranking, ranking_table, show_price

    with stage(progress, "price of the ranking"):
        plan = planned(coarse(study))
    if not plan.moves:
        return ["example: no value that this study reads is the example's"], {}
    show_price(plan)
    effects = ranked(plan, progress)
    return list(ranking(plan, effects)), ranking_table(effects)


@command("radiation", "Studies", "pipelines/copeland_thesis.toml")
def radiation_command(
    progress: Progress,
    study_file: StudyFile,
    out: StudyOut = None,
    plugin: Plugins = None,
    no_cache: NoCache = False,
    *,
    cluster: Cluster,
    printing: Printing,
) -> Outcome:
    """Compute the housing's radiation alone: transfer vectors, map, directivity, sound power."""
    from .. import pipeline, report
    from ..study.loading import load_study

    load_plugins(plugin)
    study = load_study(study_file)
    target = printing.target(out or Path("reports") / study_file.stem)

    def radiated_here() -> "xr.Dataset":
        with cluster.distributing(plugin):
            return pipeline.radiate(study, progress)

    with used_cache(no_cache):
        radiated = resumed("radiation", study, no_cache or bool(plugin), radiated_here)
    return target.outcome(report.analysis_of_radiation(radiated), radiated, "transfer_vectors.nc")


@command("new", "Studies", "oldham-scroll --out my_machine", computes=False)
def new_command(
    kind: Annotated[
        str, "KIND: Kind of machine; `balance` for trial weights, `permit` for rules."
    ] = "",
    out: Annotated[Path | None, "Folder of the files; default: KIND."] = None,
    included: Annotated[
        str | None,
        typer.Option(
            "--with", help="`sources`: sources of sound of the kind, with samples of their ranges."
        ),
    ] = None,
    level: Annotated[
        float | None,
        "Level of your machine at 1 m of a catalogue or measured, dB(A); default: none.",
    ] = None,
    listed: Annotated[
        bool, typer.Option("--list", help="Print the kinds, each with its sources; write nothing.")
    ] = False,
) -> Outcome:
    """Write a commented machine file and study to begin with, and their schemas."""
    from . import starter

    if listed:
        sources = {name: ", ".join(kinds) for name, kinds in starter.kinds()}
        lines = [f"{name}: {words or 'no sources'}" for name, words in sources.items()]
        return Outcome(
            "\n".join(lines), tables={"kinds": {"kind": [*sources], "sources": [*sources.values()]}}
        )
    if not kind:
        raise ParameterError("new: KIND is missing; `vibroacoustics new --list` prints the kinds")
    if kind in (BALANCE, PERMIT):
        return _new_file(kind, out or Path(kind))
    if included not in (None, "sources"):
        raise ParameterError(f"--with {included}: unknown; allowed sources")
    files = starter.starting_files(kind, included is not None, level)
    files |= {f"{starter.SCHEMAS_NAME}/{name}": text for name, text in starter.schemas().items()}
    folder = out or Path(kind)
    _write_new(folder, files)
    study = folder / starter.STUDY_NAME
    return Outcome(
        f"next: vibroacoustics check {study}; vibroacoustics run {study}",
        {f"written {name}": folder / name for name in files},
    )


def _new_file(kind: str, folder: Path) -> Outcome:
    """Write the file to begin with for `balance` or `permit`."""
    from .balancing import template as of_balance
    from .permits import template as of_permit

    name, text = {
        BALANCE: (of_balance.BALANCING_NAME, of_balance.TEMPLATE),
        PERMIT: (of_permit.PERMIT_NAME, of_permit.TEMPLATE),
    }[kind]
    _write_new(folder, {name: text.encode()})
    return Outcome(
        f"next: vibroacoustics {kind} {folder / name}", {f"written {name}": folder / name}
    )


def _write_new(folder: Path, files: Mapping[str, bytes]) -> None:
    """Write files of which none exists.

    Raises
    ------
    StorageError
        One exists already; nothing is written.
    """
    from ..base.errors import StorageError
    from ..results.files import only_writer, replace_all, write

    with only_writer(folder) as staged:
        for name in files:
            if staged.target.status(name) is not None:
                raise StorageError(f"{folder / name}: is there already; nothing is written")
        for name, content in files.items():
            write(staged, name, content)
        replace_all(staged)
