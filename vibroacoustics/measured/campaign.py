"""Orders and levels of many recordings in one call: each run, mean and scatter."""

import warnings
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Final

import xarray as xr

from ..base.errors import ParameterError, VibroacousticsError
from ..base.fault import omit
from ..base.plain_bytes import canonical_json
from ..base.processes import side_by_side
from ..base.progress import Progress, no_progress
from ..orders.analysed import analysed_channels
from ..orders.recorded_speed import check_speed_channels
from ..recordings.blocks import recording_blocks
from ..recordings.equality import identities
from ..recordings.second_file import blocks_with_speed
from ..results.mean_of_runs import OMITTED, mean_of_runs
from ..study.wording import first_lines
from .campaign_settings import CampaignRun
from .recorded_orders import analyse_orders
from .sorting_out import AnalysedRun, sorted_out

_AVERAGED: Final = (
    "channel_order",
    "channel_order_rms",
    "channel_order_coherence",
    "equivalent_level",
    "band_level",
)
"""Variables of a run that the mean is made of."""

LEAST_RUNS: Final = 2
"""Recordings of which a mean is made."""


def analyse_campaign(
    files: Sequence[Path],
    run_of: Callable[[Path], CampaignRun],
    progress: Progress = no_progress,
) -> xr.Dataset:
    """Analyse many recordings with common settings: each run, energy mean and scatter.

    Recordings that cannot be averaged with the others are omitted, each with a warning. A run with
    `with_map` keeps no map.

    Parameters
    ----------
    files : files of the recordings, each once
    run_of : gives labels, reading and analysis of a file, such as `load_campaign(path).run_of`
    progress : called with the advance

    Returns
    -------
    as of `mean_of_runs`; attribute `omitted`: reason by file, as JSON

    Raises
    ------
    ParameterError
        A file has no label or settings, or a label of another one; or fewer than two recordings
        can be averaged: a line for every file that is omitted.

    Warns
    -----
    LeftOutWarning
        A recording is omitted: it cannot be read or analysed, has a dead channel or impossible
        values, repeats another one, or lacks a channel, band or speed that most have.

    Examples
    --------
    >>> from pathlib import Path
    >>> tone = np.cos(2.0 * np.pi * 50.0 * np.arange(8192) / 1024.0)
    >>> for name, peak in (("a_1", 1.0), ("a_2", 2.0), ("b_1", 3.0)):
    ...     recording = va.label_recording([peak * tone], 1024.0, ["ring"], ["m/s²"])
    ...     _ = va.export_recording(recording, f"{name}.csv")
    >>> campaign = va.Campaign(
    ...     speed={"nominal_rpm": 3000.0}, analysis={"maximum_order": 4.0},
    ...     files={"{machine}_{run}.csv": {}})
    >>> mean = va.analyse_campaign(sorted(Path().glob("[ab]_?.csv")), campaign.run_of)
    >>> mean["machine_order_rms"].sel(machine="a", order=1.0).item() ** 2  # (0.5 + 2) / 2
    1.25...
    """
    runs = _runs(files, run_of)
    analysed = []
    for done, each in enumerate(side_by_side(_analysed, runs, on_loss=_lost)):
        progress("orders of recordings", done, len(runs))
        analysed.append(each)
    progress("orders of recordings", len(runs), len(runs))
    analysed = sorted_out(analysed)
    kept = [each for each in analysed if not each.reason]
    omitted = {str(each.file): each.reason for each in analysed if each.reason}
    try:
        mean = _mean(kept, min(LEAST_RUNS, len(runs)))
    except ParameterError as error:
        reasons = (f"{file}: {reason}" for file, reason in omitted.items())
        raise ParameterError(*reasons, *error.args) from None
    for each in kept:
        for kind, words in each.warned:
            named = words if each.file.name in words else f"{each.file.name}: {words}"
            warnings.warn(named, kind, stacklevel=2)
    for file, reason in omitted.items():
        omit(file, reason)
    return mean.assign_attrs({OMITTED: canonical_json(omitted)} if omitted else {})


def _mean(kept: Sequence[AnalysedRun], least: int) -> xr.Dataset:
    """Mean of the recordings that are not omitted."""
    results = [each.results for each in kept if each.results is not None]
    if len(results) < least:
        raise ParameterError(f"{len(results)} recordings can be averaged: must be at least {least}")
    runs = [each.run for each in kept]
    return mean_of_runs(results, [run.machine for run in runs], [run.label for run in runs])


def _runs(files: Sequence[Path], run_of: Callable[[Path], CampaignRun]) -> list[CampaignRun]:
    """Runs of files that have labels and settings, each label once."""
    runs: list[CampaignRun] = []
    problems: list[str] = []
    for file in files:
        try:
            runs.append(run_of(file))
        except VibroacousticsError as error:
            problems += error.args
    problems += _repeated(runs)
    if problems:
        raise ParameterError(*first_lines(problems))
    return runs


def _repeated(runs: Sequence[CampaignRun]) -> Iterator[str]:
    """A line for each file or label that comes twice."""
    first: dict[str, Path] = {}
    for run in runs:
        other = first.setdefault(run.label, run.file)
        if other is not run.file:
            yield (
                f"{run.file}: has the label {run.label!r}, as {other}: give machine and run of "
                "each file once, in [files]"
            )


def _analysed(run: CampaignRun) -> AnalysedRun:
    """Analyse a recording, in a process of its own."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            sound = recording_blocks(run.file, **run.reading)
            blocks = blocks_with_speed(sound, run.speed_file)
            check_speed_channels(blocks.channels, run.analysis.speed)
            names = analysed_channels(blocks.channels, run.analysis.speed)
            results = analyse_orders(blocks, run.analysis)
        except VibroacousticsError as error:
            return AnalysedRun(run, None, _reason(run.file, error))
    units = dict(zip(blocks.channels, blocks.channel_units, strict=True))
    return AnalysedRun(
        run,
        results[[name for name in _AVERAGED if name in results]],
        "",
        [(each.category, str(each.message)) for each in caught],
        {name: units[name] for name in names},
        {name: each for name, each in sound.deviations.items() if name in names},
        sound.suspects,
        identities(blocks, names),
    )


def _lost(run: CampaignRun, how: str) -> AnalysedRun:
    return AnalysedRun(run, None, f"two processes that analysed it ended ({how})")


def _reason(file: Path, error: VibroacousticsError) -> str:
    """An error as one line without the file."""
    words = "; ".join(map(str, error.args))
    return words.removeprefix(f"{file.name}: ").removeprefix(f"{file}: ")
