"""Charts of the scores of the options."""

from collections.abc import Iterable
from itertools import cycle
from typing import Any

import numpy as np
import xarray as xr

from ...results.estimates import has_samples
from ...results.run_variables import ANY_WEIGHTS
from ...results.stored_study import options
from ..charts.axes import option_panel
from ..charts.layout import COLOURS, wrapped
from ..charts.marks import Axis, Bars, Chart, Panel
from ..charts.needs import needs

_FIRST, _LAST = np.array([8, 48, 107]), np.array([222, 235, 247])
"""Colours of the first and the last rank, red, green, blue."""


@needs("criterion_value", "weight")
def scores(results: xr.Dataset) -> Chart:
    """Weighted utilities that add up to each option's score, 0 worst to 1 best: a bar an option.

    Parameters
    ----------
    results : results of `run`; needs `criterion_value` (option, criterion), with scales and weights
    """
    parts = contributions(results).transpose("criterion", "option")
    labels = [wrapped(str(part["criterion_label"].item()), 50) for part in parts]
    label = "Score by weighted sum, 0 worst to 1 best"
    return Chart(
        "scores",
        "Score of every option as a stacked bar of its weighted criteria; the sums are in the "
        "table of scores.",
        "Weighted sum of the utilities: the longer a part, the better the option is by that "
        "criterion.",
        (_stacked(results, label, zip(labels, cycle(COLOURS[1:]), parts.values, strict=False)),),
    )


@needs("rank_acceptability")
def rank_acceptability(results: xr.Dataset) -> Chart:
    """Probability of each rank, a bar an option, the first rank leftmost.

    Over samples and weights of the criteria together (stochastic multicriteria acceptability
    analysis).

    Parameters
    ----------
    results : results of `run`; needs `rank_acceptability` (criteria_weights, option, rank_position)
    """
    probability = results["rank_acceptability"].sel({"criteria_weights": ANY_WEIGHTS})
    ranks = probability.transpose("rank_position", "option")
    labels = [f"rank {rank:g}" for rank in ranks["rank_position"].values]
    shares = np.linspace(_FIRST, _LAST, len(labels)).round().astype(np.uint8)
    colours = [f"#{shade.tobytes().hex()}" for shade in shares]
    sampled = "samples and weights together" if has_samples(results) else "weights"
    return Chart(
        "ranks",
        "Probability of every rank of every option as a stacked bar, the first rank leftmost; the "
        "numbers are in scoring.csv.",
        f"Probability of each rank over {sampled}. The dark left end is the first rank.",
        (_stacked(results, "Probability", zip(labels, colours, ranks.values, strict=True)),),
    )


def _stacked(results: xr.Dataset, label: str, parts: Iterable[tuple[str, str, Any]]) -> Panel:
    """A bar for each option, of parts that add up to 1 at most: label, colour, sizes (option,)."""
    names, bars = options(results), []
    base = np.zeros(len(names))
    for name, colour, sizes in parts:
        bars.append(Bars(np.arange(len(names)), sizes, base, name, colour=colour))
        base = base + sizes
    return option_panel(Axis(label, limits=(0.0, 1.0)), names, bars)


def contributions(results: xr.Dataset) -> xr.DataArray:
    """Weight times utility of each option and criterion; they add up to the weighted sum."""
    worst, best = results["criterion_worst"], results["criterion_best"]
    utility = ((worst - results["criterion_value"]) / (worst - best)).clip(0.0, 1.0)
    return utility * results["weight"]
