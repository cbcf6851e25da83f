"""How the score of each option comes about."""

from itertools import cycle

import numpy as np
import xarray as xr
from matplotlib import colormaps
from matplotlib.figure import Figure

from ...results.estimates import has_samples
from ...results.run_variables import ANY_WEIGHTS
from ...results.stored_study import options
from ..charts.needs import needs
from .panels import one_panel, stacked_bars
from .style import COLOURS, Picture, png, wrap


@needs("criterion_value", "weight")
def scores(results: xr.Dataset) -> Figure:
    """Weighted utilities that add up to each option's score, 0 worst to 1 best: a bar an option.

    Parameters
    ----------
    results : of `run`; needs `criterion_value` (option, criterion), with scales and weights

    Raises
    ------
    ParameterError
        The results hold none.

    Examples
    --------
    >>> results = va.open_results("results.nc")
    >>> va.plot.scores(results).savefig("scores.png")
    """
    names, colours = options(results), cycle(COLOURS[1:])
    parts = [
        (wrap(str(part["criterion_label"].item()), 50), next(colours), part.values)
        for part in contributions(results).transpose("criterion", "option")
    ]
    return one_panel(
        0.8 + 0.26 * len(names), lambda axes: stacked_bars(axes, names, parts),
        "Score by weighted sum, 0 worst to 1 best", columns=1, rows=len(parts) + 1,
    )  # fmt: skip


def score_figures(results: xr.Dataset) -> list[Picture]:
    """Weighted utilities that add up to the weighted sum, and how sure each rank is."""
    pictures = [
        Picture(
            "scores",
            "Score of every option as a stacked bar of its weighted criteria; the sums are in the "
            "table of scores.",
            "Weighted sum of the utilities: the longer a part, the better the option is by that "
            "criterion.",
            png(scores(results)),
        )
    ]
    if "rank_acceptability" not in results:
        return pictures
    sampled = "samples and weights together" if has_samples(results) else "weights"
    return [
        *pictures,
        Picture(
            "ranks",
            "Probability of every rank of every option as a stacked bar, the first rank leftmost; "
            "the numbers are in the table of ranks.",
            f"Probability of each rank over {sampled}: the more of the dark left end, the surer an "
            "option is among the first.",
            png(rank_acceptability(results)),
        ),
    ]


@needs("rank_acceptability")
def rank_acceptability(results: xr.Dataset) -> Figure:
    """Probability of each rank, a bar an option, the first rank leftmost.

    Over samples and weights of the criteria together (stochastic multicriteria acceptability
    analysis).

    Parameters
    ----------
    results : of `run`; needs `rank_acceptability` (criteria_weights, option, rank_position)

    Raises
    ------
    ParameterError
        The results hold none.

    Examples
    --------
    >>> results = va.open_results("results.nc")
    >>> va.plot.rank_acceptability(results).savefig("ranks.png")
    """
    probability = results["rank_acceptability"].sel({"criteria_weights": ANY_WEIGHTS})
    names = options(results)
    shades = colormaps["Blues"](np.linspace(0.95, 0.15, probability.sizes["rank_position"]))
    parts = [
        (f"rank {part['rank_position'].item():g}", shade, part.values)
        for shade, part in zip(
            shades, probability.transpose("rank_position", "option"), strict=True
        )
    ]
    return one_panel(
        0.8 + 0.26 * len(names), lambda axes: stacked_bars(axes, names, parts),
        "Probability", columns=4, rows=(len(names) + 3) // 4 + 1,
    )  # fmt: skip


def contributions(results: xr.Dataset) -> xr.DataArray:
    """Weight times utility of each option and criterion; they add up to the weighted sum."""
    worst, best = results["criterion_worst"], results["criterion_best"]
    utility = ((worst - results["criterion_value"]) / (worst - best)).clip(0.0, 1.0)
    return utility * results["weight"]
