"""Orders and levels of many recordings in one call: each run, mean and scatter."""

import warnings
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Final, NamedTuple

import xarray as xr

from ..base.errors import ParameterError, VibroacousticsError
from ..base.processes import side_by_side
from ..base.progress import Progress, no_progress
from ..orders.analysed import analysed_channels
from ..orders.recorded_speed import check_speed_channels
from ..recordings import open_recording
from ..recordings.blocks import recording_blocks
from ..results.mean_of_runs import mean_of_runs
from ..results.order_comparison import listed
from ..study.wording import first_lines
from .campaign_settings import CampaignRun
from .recorded_orders import analyse_orders

_AVERAGED: Final = (
    "channel_order",
    "channel_order_rms",
    "channel_order_coherence",
    "equivalent_level",
    "band_level",
)
"""Variables of a run that the mean is made of."""


class _Opened(NamedTuple):
    """Unit by channel that is analysed, or what is wrong with the file."""

    units: dict[str, str]
    problem: str = ""


class _Analysed(NamedTuple):
    """Orders and levels of a run, or what is wrong with the recording; warnings."""

    results: xr.Dataset | None
    problem: str
    remarks: list[tuple[type[Warning], str]]


def analyse_campaign(
    files: Sequence[Path],
    run_of: Callable[[Path], CampaignRun],
    progress: Progress = no_progress,
) -> xr.Dataset:
    """Analyse many recordings with common settings: each run, energy mean and scatter.

    All files are opened before the first is analysed. A run with `with_map` keeps no map.

    Parameters
    ----------
    files : files of the recordings, each once
    run_of : gives labels, reading and analysis of a file, such as `load_campaign(path).run_of`
    progress : called with the advance

    Returns
    -------
    as of `mean_of_runs`

    Raises
    ------
    ParameterError
        A line for every file that cannot be read or analysed, or that has other channels.

    Examples
    --------
    >>> from pathlib import Path
    >>> tone = np.cos(2.0 * np.pi * 50.0 * np.arange(8192) / 1024.0)
    >>> for name, peak in (("a_1", 1.0), ("a_2", 2.0), ("b_1", 2.0)):
    ...     recording = va.label_recording([peak * tone], 1024.0, ["ring"], ["m/s²"])
    ...     _ = va.export_recording(recording, f"{name}.csv")
    >>> campaign = va.Campaign(
    ...     speed={"nominal_rpm": 3000.0}, analysis={"maximum_order": 4.0},
    ...     files={"{machine}_{run}.csv": {}})
    >>> mean = va.analyse_campaign(sorted(Path().glob("[ab]_?.csv")), campaign.run_of)
    >>> mean["machine_order_rms"].sel(machine="a", order=1.0).item() ** 2  # (0.5 + 2) / 2
    1.25...
    """
    runs = _checked(files, run_of, progress)
    analysed = []
    for done, each in enumerate(side_by_side(_analysed, runs)):
        progress("orders of recordings", done, len(runs))
        analysed.append(each)
    progress("orders of recordings", len(runs), len(runs))
    for run, each in zip(runs, analysed, strict=True):
        for kind, words in each.remarks:
            named = words if run.file.name in words else f"{run.file.name}: {words}"
            warnings.warn(named, kind, stacklevel=2)
    _refuse(each.problem for each in analysed)
    results = [each.results for each in analysed if each.results is not None]
    return mean_of_runs(results, [run.machine for run in runs], [run.label for run in runs])


def _checked(
    files: Sequence[Path], run_of: Callable[[Path], CampaignRun], progress: Progress
) -> list[CampaignRun]:
    """Runs of files that can all be opened and have channels of the same names and units."""
    runs: list[CampaignRun] = []
    problems: list[str] = []
    for file in files:
        try:
            runs.append(run_of(file))
        except VibroacousticsError as error:
            problems += error.args
    problems += _repeated(runs)
    opened = []
    for done, each in enumerate(side_by_side(_opened, runs)):
        progress("recordings opened", done, len(files))
        opened.append(each)
    progress("recordings opened", len(files), len(files))
    problems += [each.problem for each in opened]
    readable = [(run, each) for run, each in zip(runs, opened, strict=True) if not each.problem]
    for run, each in readable[1:]:
        first, reference = readable[0]
        if each.units != reference.units:
            problems.append(
                f"{run.file}: has the channels {listed(each.units)}; {first.file} has "
                f"{listed(reference.units)}: all must have the same names and units"
            )
    _refuse(problems)
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


def _opened(run: CampaignRun) -> _Opened:
    """Open a recording without its samples."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # they come again when the samples are read
            recording = open_recording(run.file, **run.reading)
        units = dict(zip(recording.channels, recording.channel_units, strict=True))
        check_speed_channels(recording.channels, run.analysis.speed)
        names = analysed_channels(recording.channels, run.analysis.speed)
    except VibroacousticsError as error:
        return _Opened({}, _named(run, error))
    return _Opened({name: units[name] for name in names})


def _analysed(run: CampaignRun) -> _Analysed:
    """Analyse a recording, in a process of its own."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            blocks = recording_blocks(run.file, **run.reading)
            results, problem = analyse_orders(blocks, run.analysis), ""
        except VibroacousticsError as error:
            results, problem = None, _named(run, error)
    remarks = [(each.category, str(each.message)) for each in caught]
    if results is not None:
        results = results[[name for name in _AVERAGED if name in results]]
    return _Analysed(results, problem, remarks)


def _named(run: CampaignRun, error: VibroacousticsError) -> str:
    """An error as one line that begins with the file."""
    words = "; ".join(map(str, error.args)).removeprefix(f"{run.file.name}: ")
    return words if words.startswith(f"{run.file}: ") else f"{run.file}: {words}"


def _refuse(problems: Iterator[str] | Sequence[str]) -> None:
    """Report all problems at once."""
    lines = first_lines([problem for problem in problems if problem])
    if lines:
        raise ParameterError(*lines)
