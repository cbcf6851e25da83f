"""Tables of scores and ranks, how sure the ranks are, and published scores added up again."""

from collections.abc import Sequence
from typing import Final

import numpy as np
import xarray as xr

from ....base import rounding
from ....results import labels
from ....results.estimates import has_samples
from ....results.run_variables import ANY_WEIGHTS, OF_THE_STUDY
from ....results.stored_study import has_sources, options, parameters
from ....results.utility import utilities
from ...bands import percent
from ...option_verdict import NO_CHANGE, option_verdicts
from ...tables import DataTable, Table, columns_of

SUM_TOLERANCE: Final = 1e-6
ROUNDING: Final = 1e-9
"""Scores that differ by less share their rank."""


def scores_data(results: xr.Dataset) -> DataTable:
    """One row per option: criteria, score and rank by method, share of first probability."""
    criteria, methods = _names(results, "criterion"), _names(results, "scoring_method")
    columns = [*criteria]
    blocks = [results["criterion_value"].transpose("option", "criterion").values]
    for method in methods:
        for name in ("score", "rank"):
            columns.append(f"{name}_{method}")
            blocks.append(results[name].sel({"scoring_method": method}).values[:, None])
    columns.append("first_place_share")
    blocks.append(results["first_place_share"].values[:, None])
    if "rank_acceptability" in results:
        probability = results["rank_acceptability"].sel({"criteria_weights": ANY_WEIGHTS})
        columns += [f"share_of_rank_{number:g}" for number in probability["rank_position"].values]
        blocks.append(probability.transpose("option", "rank_position").values)
    values = np.concatenate(blocks, axis=1)
    words = {one.option: (one.judgement, one.reason) for one in option_verdicts(results)}
    cells: list[list[float]] = values.tolist()
    named = zip(options(results), cells, strict=True)
    rows: list[list[str | float]] = [
        [name, *row, *words.get(name, ("", ""))] for name, row in named
    ]
    return columns_of(("option", *columns, "verdict", "because"), rows)


def criteria_table(results: xr.Dataset) -> Table:
    """What is scored: weight, and the values that count as best and worst."""
    rows = tuple(
        (
            label,
            unit or "1",
            f"{100.0 * results['weight'].sel(criterion=criterion).item():.3g} %",
            rounding.significant(results["criterion_best"].sel(criterion=criterion).item()),
            rounding.significant(results["criterion_worst"].sel(criterion=criterion).item()),
        )
        for criterion, label, unit in _criteria(results)
    )
    head = ("Criterion", "Unit", "Weight", "Best (utility 1)", "Worst (utility 0)")
    return Table(
        "Criteria; computed ones are the worst over the speeds", head, rows, frozenset({0, 1})
    )


def scores_table(results: xr.Dataset) -> Table:
    """Score and rank by method and the probability of the first rank."""
    methods = _names(results, "scoring_method")
    head = ["Option"]
    for method in methods:
        head += [f"{labels.name(method)}, score 0 to 1", f"{labels.name(method)}, rank"]
    rows = tuple(
        _scores_row(results.sel(option=option), option, methods) for option in ranked(results)
    )
    return Table(
        "Scores and ranks, best first by the first method",
        (*head, "First, whatever the weights"),
        rows,
    )


def scope_words(results: xr.Dataset) -> str:
    """Say that the scores count further sources."""
    if not has_sources(results):
        return ""
    where = "in each sample" if has_samples(results) else "with nominal values"
    return f" The change of level counts all sources, {where}."


def criteria_of_advantage(results: xr.Dataset, option: str, other: str) -> list[str]:
    """Words of the weighted criteria, computed or given, in which an option scores better.

    The criterion that matters most to the weighted sum comes first.
    """
    scale = (results[name].values for name in ("criterion_best", "criterion_worst"))
    values = results["criterion_value"].sel(option=[option, other])
    better, worse = utilities(values.transpose("option", "criterion").values, *scale)
    lead = results["weight"].values * (better - worse)
    labels_of = results["criterion_label"].values
    return [str(labels_of[at]) for at in np.argsort(-lead, kind="stable") if lead[at] > ROUNDING]


def wrong_sums(results: xr.Dataset) -> list[str]:
    """Published options whose printed sum is not the sum of their scores."""
    if "published_score" not in results:
        return []
    gap = abs(results["published_sum"] - results["recomputed_sum"])
    return [str(name) for name in gap["published_option"].values[gap.values > SUM_TOLERANCE]]


def published_source(results: xr.Dataset) -> str:
    """Where the published scores are printed."""
    return (
        str(parameters(results)["scoring"]["published"]["source"])
        if "published_score" in results
        else ""
    )


def _scores_row(of_option: xr.Dataset, option: str, methods: list[str]) -> tuple[str, ...]:
    cells = [option]
    for method in methods:
        of_method = of_option.sel({"scoring_method": method})
        cells += [
            rounding.fixed(of_method["score"].item(), 2),
            rounding.fixed(of_method["rank"].item(), 0),
        ]
    return (*cells, f"{100.0 * of_option['first_place_share'].item():.1f} %")


def ranked(results: xr.Dataset) -> list[str]:
    """Options, the best by the first method first."""
    order = np.argsort(results["rank"].isel(scoring_method=0).values, kind="stable")
    return [options(results)[index] for index in order]


def _criteria(results: xr.Dataset) -> list[tuple[str, str, str]]:
    """Name, words and unit of every criterion, as the results keep them."""
    names = ("criterion", "criterion_label", "criterion_unit")
    return list(zip(*(_names(results, name) for name in names), strict=True))


def _names(results: xr.Dataset, dim: str) -> list[str]:
    return [str(name) for name in results[dim].values]


def acceptability_words(results: xr.Dataset, winners: Sequence[str]) -> str:
    """How sure the first rank is; files of older versions have it by the weights alone."""
    whatever = 100.0 * float(results["first_place_share"].sel(option=winners).sum())
    if "rank_acceptability" not in results or not has_samples(results):
        return f", and in {whatever:.0f} % of the weightings sampled at random"
    first = results["rank_acceptability"].isel(rank_position=0).sel(option=winners).sum("option")
    by_study = 100.0 * float(first.sel({"criteria_weights": OF_THE_STUDY}))
    return (
        f": by these weights in {by_study:.0f} % of the samples, and with samples and weights at "
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
    return f"First by differences too small to be measured: {', '.join(texts)}."
