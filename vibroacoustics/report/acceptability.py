"""How sure the ranks of the options are."""

from collections.abc import Sequence

import xarray as xr

from ..base.vocabulary import REFERENCE_OPTION
from ..scoring.scores import ANY_WEIGHTS, OF_THE_STUDY
from .bands import percent
from .option_verdict import NO_CHANGE, option_verdicts
from .scores import ranked
from .study import has_draws
from .tables import Table


def acceptability_words(results: xr.Dataset, winners: Sequence[str]) -> str:
    """How sure the first rank is; files of older versions have it by the weights alone."""
    whatever = 100.0 * float(results["first_place_share"].sel(option=winners).sum())
    if "rank_acceptability" not in results or not has_draws(results):
        return f", and in {whatever:.0f} % of the weightings drawn at random"
    first = results["rank_acceptability"].isel(rank_position=0).sel(option=winners).sum("option")
    by_study = 100.0 * float(first.sel({"criteria_weights": OF_THE_STUDY}))
    return (
        f": by these weights in {by_study:.0f} % of the draws, and with draws and weights at "
        f"random in {whatever:.0f} %"
    )


def too_close_words(results: xr.Dataset) -> str:
    """Options that cannot be measured apart from the reference, and how often they rank first."""
    first = results["first_place_share"]
    texts = [
        f"{of.option} ({percent(float(first.sel(option=of.option)))})"
        for of in option_verdicts(results)
        if of.judgement == NO_CHANGE and float(first.sel(option=of.option)) > 0.0
    ]
    if not texts:
        return ""
    return (
        f"First by differences from {REFERENCE_OPTION} too small to be measured: "
        f"{', '.join(texts)}. Ranks count every difference; read these with those of "
        f"{REFERENCE_OPTION}."
    )


def acceptability_table(results: xr.Dataset) -> Table | None:
    """Probability of each rank of each option; None in files of older versions."""
    if "rank_acceptability" not in results:
        return None
    probability = results["rank_acceptability"].sel({"criteria_weights": ANY_WEIGHTS})
    rows = tuple(
        (option, *(percent(float(one)) for one in probability.sel(option=option).values))
        for option in ranked(results)
    )
    head = ("Option", *(f"Rank {number:g}" for number in probability["rank_position"].values))
    drawn = "over draws and weights together" if has_draws(results) else "over the weights"
    return Table(f"Probability of each rank, {drawn}", head, rows)
