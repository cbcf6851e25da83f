"""Recordings of a campaign that its mean omits, each with the reason."""

from collections import Counter
from collections.abc import Hashable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Final, NamedTuple, TypeVar

import numpy as np
import xarray as xr

from ..recordings.remarks import MAY_STAY
from ..recordings.suspects import Suspect, quiet
from ..results.order_comparison import SPEED_TOLERANCE, listed
from .campaign_settings import CampaignRun

MOST_BELOW_DB: Final = 60.0
"""A channel further below its median over the recordings is dead. Assumed, 40 to 80 dB: machines of
one campaign differ by 20 dB or less."""
_LEAST_OF_MEDIAN: Final = 3
"""Recordings of which two determine the median."""

Label = TypeVar("Label", bound=Hashable)


class AnalysedRun(NamedTuple):
    """Orders and levels of a recording, or what is wrong with it.

    Attributes
    ----------
    run : labels and reading
    results : result of `analyse_orders`; None where it fails
    reason : why the recording is omitted; empty where it is not
    warned : warnings of reading and analysis
    units : unit by channel that is analysed
    deviations : standard deviation by channel, SI
    suspects : channels that are dead or impossible
    marks : result of `identities`
    """

    run: CampaignRun
    results: xr.Dataset | None
    reason: str = ""
    warned: Sequence[tuple[type[Warning], str]] = ()
    units: Mapping[str, str] = {}
    deviations: Mapping[str, float] = {}
    suspects: Sequence[Suspect] = ()
    marks: Sequence[tuple[str, Hashable]] = ()

    @property
    def file(self) -> Path:
        """File of the recording."""
        return self.run.file


def sorted_out(analysed: Sequence[AnalysedRun]) -> list[AnalysedRun]:
    """Recordings with the reason of each that is omitted.

    Omitted are those that cannot be analysed, have a dead or impossible channel that not all have,
    repeat an earlier one, or lack a channel, band or speed that more than half of them have.
    """
    for reasons in (_other_channels, _suspected, _repeated, _far_below, _lower_rate, _other_speed):
        omitted = reasons([each for each in analysed if not each.reason])
        analysed = [each._replace(reason=each.reason or omitted.get(each.file, ""))
                    for each in analysed]  # fmt: skip
    return list(analysed)


def _most_have(sets: Iterable[Iterable[Label]]) -> set[Label]:
    """Labels that more than half of some sets have."""
    each = [set(labels) for labels in sets]
    counts = Counter(label for labels in each for label in labels)
    return {label for label, count in counts.items() if 2 * count > len(each)}


def _other_channels(runs: Sequence[AnalysedRun]) -> dict[Path, str]:
    usual = _most_have(run.units.items() for run in runs)
    words = listed(dict(sorted(usual)))
    return {
        run.file: f"has the channels {listed(run.units)}; most recordings have {words}"
        for run in runs
        if not usual <= set(run.units.items())
    }


def _suspected(runs: Sequence[AnalysedRun]) -> dict[Path, str]:
    """Dead or impossible channels; what all recordings have in common is a warning."""
    kinds = [{(each.channel, each.kind) for each in run.suspects} for run in runs]
    common = set.intersection(*kinds) if kinds else set()
    omitted = {}
    for run in runs:
        lines = [each.line for each in run.suspects if (each.channel, each.kind) not in common]
        if lines:
            omitted[run.file] = "; ".join(lines)
    return omitted


def _repeated(runs: Sequence[AnalysedRun]) -> dict[Path, str]:
    first: dict[Hashable, Path] = {}
    omitted: dict[Path, str] = {}
    for run in runs:
        for mark in run.marks:
            if mark in first:
                again = f"has {mark[0]} of {first[mark]}: the recording counts once"
                omitted.setdefault(run.file, again)
            first.setdefault(mark, run.file)
    return omitted


def _far_below(runs: Sequence[AnalysedRun]) -> dict[Path, str]:
    """Channels that are far below their median over the recordings."""
    omitted: dict[Path, str] = {}
    for name in sorted({name for run in runs for name in run.deviations}):
        having = [run for run in runs if name in run.deviations]
        unit = having[0].units.get(name, MAY_STAY[0])
        if unit in MAY_STAY or len(having) < _LEAST_OF_MEDIAN:
            continue
        median = float(np.median([run.deviations[name] for run in having]))
        for run in having:
            suspect = quiet(name, run.deviations[name], median, MOST_BELOW_DB, "its median")
            if suspect is not None:
                omitted.setdefault(run.file, suspect.line)
    return omitted


def _lower_rate(runs: Sequence[AnalysedRun]) -> dict[Path, str]:
    """Recordings whose sample rate does not hold the third octaves or default orders of most."""
    omitted: dict[Path, str] = {}
    for name, words in (("band", "third octaves from {:g} Hz"), ("order", "orders from {:g}")):
        labels = {
            run.file: (run.results[name].values.tolist(), run.results.attrs["sample_rate_hz"])
            for run in runs
            if run.results is not None
            and name in run.results
            and (name == "band" or run.run.analysis.orders is None)
        }
        usual = _most_have(each for each, _ in labels.values())
        for file, (each, rate_hz) in labels.items():
            if lacking := usual - set(each):
                omitted[file] = (
                    f"sample rate = {rate_hz:g} Hz: lacks the {words.format(min(lacking))}, "
                    "which most recordings have"
                )
    return omitted


def _other_speed(runs: Sequence[AnalysedRun]) -> dict[Path, str]:
    """Recordings without a speed near one of that in the middle of all recordings."""
    speeds = {run.file: run.results["speed"].values for run in runs if run.results is not None}
    if not speeds:
        return {}
    usual = sorted(speeds.values(), key=np.median)[(len(speeds) - 1) // 2]
    words = ", ".join(map("{:.0f}".format, usual))
    return {
        file: f"speed = {', '.join(map('{:.0f}'.format, each))} rpm: none is within "
        f"{100.0 * SPEED_TOLERANCE:g} % of {words} rpm, as of most recordings"
        for file, each in speeds.items()
        if not np.any(np.abs(each[:, None] - usual) <= SPEED_TOLERANCE * usual)
    }
