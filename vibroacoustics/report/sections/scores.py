"""Section on the ranks of the options, and the published scores."""

from collections.abc import Sequence
from typing import Final

import numpy as np
import xarray as xr

from ...base import rounding
from ...base.registry import register
from ...base.vocabulary import REFERENCE_OPTION
from ...results import labels
from ...results.bands import percent
from ...results.estimates import has_samples
from ...results.run_variables import ANY_WEIGHTS, OF_THE_STUDY
from ...results.stored_study import has_sources, options, parameters
from ...results.utility import utilities
from ..blocks import Block, Pictures, Text
from ..figures.scores import rank_acceptability
from ..figures.scores import scores as score_bars
from ..option_verdict import BETTER, NO_CHANGE, OptionVerdict, option_verdicts
from ..tables import DataTable, Table, long_table
from . import Section, text

SUM_TOLERANCE: Final = 1e-6
ROUNDING: Final = 1e-9
"""Scores that differ by less share their rank."""


def scores_data(results: xr.Dataset) -> DataTable:
    """One row per option: criteria, score and rank by method, share of first probability."""
    columns: dict[str, list[str | float]] = {"option": [*options(results)]}
    for criterion in _names(results, "criterion"):
        columns[criterion] = results["criterion_value"].sel(criterion=criterion).values.tolist()
    for method in _names(results, "scoring_method"):
        for name in ("score", "rank"):
            of_method = results[name].sel({"scoring_method": method})
            columns[f"{name}_{method}"] = of_method.values.tolist()
    columns["first_place_share"] = results["first_place_share"].values.tolist()
    if "rank_acceptability" in results:
        probability = results["rank_acceptability"].sel({"criteria_weights": ANY_WEIGHTS})
        for number in probability["rank_position"].values:
            of_rank = probability.sel(rank_position=number)
            columns[f"share_of_rank_{number:g}"] = of_rank.values.tolist()
    words = {verdict.option: verdict for verdict in option_verdicts(results)}
    for column, name in (("verdict", "judgement"), ("because", "reason")):
        columns[column] = [getattr(words.get(each), name, "") for each in options(results)]
    return columns


def criteria_table(results: xr.Dataset) -> Table:
    """Return the criteria: weight, and the values that count as best and worst."""
    names = ("criterion_label", "criterion_unit", "weight", "criterion_best", "criterion_worst")
    every = zip(*(results[name].values.tolist() for name in names), strict=True)
    rows = tuple(
        (label, unit or "1", f"{100.0 * weight:.3g} %", *map(rounding.significant, ends))
        for label, unit, weight, *ends in every
    )
    head = ("Criterion", "Unit", "Weight", "Best (utility 1)", "Worst (utility 0)")
    caption = "Criteria; computed ones are the worst over the speeds"
    return Table(caption, head, rows, frozenset({0, 1}))


def scores_table(results: xr.Dataset) -> Table:
    """Score and rank by method and the probability of the first rank."""
    order = np.argsort(results["rank"].isel(scoring_method=0).values, kind="stable")
    columns = {"Option": [*options(results)]}
    for method in _names(results, "scoring_method"):
        scores, ranks = (results[name].sel(scoring_method=method) for name in ("score", "rank"))
        name = labels.name(method)
        columns[f"{name}, score 0 to 1"] = [rounding.fixed(score, 2) for score in scores.values]
        columns[f"{name}, rank"] = [rounding.fixed(rank, 0) for rank in ranks.values]
    first = results["first_place_share"].values
    columns["First, whatever the weights"] = [f"{100.0 * share:.1f} %" for share in first]
    rows = tuple(tuple(column[index] for column in columns.values()) for index in order)
    return Table("Scores and ranks, best first by the first method", tuple(columns), rows)


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
    return [
        str(labels_of[index])
        for index in np.argsort(-lead, kind="stable")
        if lead[index] > ROUNDING
    ]


def wrong_sums(results: xr.Dataset) -> list[str]:
    """Published options whose printed sum is not the sum of their scores."""
    if "published_score" not in results:
        return []
    gap = abs(results["published_sum"] - results["recomputed_sum"])
    return [str(name) for name in gap["published_option"].values[gap.values > SUM_TOLERANCE]]


def _names(results: xr.Dataset, dim: str) -> list[str]:
    return [str(name) for name in results[dim].values]


def acceptability_words(results: xr.Dataset, winners: Sequence[str]) -> str:
    """Say how sure the first rank is; files of older versions have it by the weights alone."""
    whatever = 100.0 * float(results["first_place_share"].sel(option=winners).sum())
    if "rank_acceptability" not in results or not has_samples(results):
        return f". It is first with {whatever:.0f} % of random weights"
    first = results["rank_acceptability"].isel(rank_position=0).sel(option=winners).sum("option")
    by_study = 100.0 * float(first.sel({"criteria_weights": OF_THE_STUDY}))
    return (
        f". It is first in {by_study:.0f} % of the samples with these weights, in {whatever:.0f} % "
        "with random weights"
    )


def too_close_words(results: xr.Dataset) -> str:
    """Options that cannot be measured apart from the reference, and how often they rank first."""
    first = dict(zip(options(results), results["first_place_share"].values.tolist(), strict=True))
    texts = [
        f"{of.option} ({percent(first[of.option])})"
        for of in option_verdicts(results)
        if of.judgement == NO_CHANGE and first[of.option] > 0.0
    ]
    if not texts:
        return ""
    return f"First by differences too small to be measured: {', '.join(texts)}."


def ranking_sentence(results: xr.Dataset, verdicts: Sequence[OptionVerdict]) -> str:
    """Say which option the study's weights prefer, and how sure that is."""
    method = str(results["scoring_method"].values[0])
    of_method = results[["score", "rank"]].sel({"scoring_method": method})
    rank = dict(zip(options(results), of_method["rank"].values.tolist(), strict=True))
    winners = [option for option in options(results) if rank[option] == 1.0]
    verb = "ranks" if len(winners) == 1 else "rank"
    score = rounding.fixed(float(of_method["score"].max()), 2)
    behind = "".join(
        _behind(results, each.option)
        for each in verdicts
        if each.judgement == BETTER and rank[each.option] > rank[REFERENCE_OPTION]
    )
    return (
        f"By the study's weights option {' and '.join(winners)} {verb} first "
        f"({labels.name(method).lower()}, score {score} of 1)"
        f"{acceptability_words(results, winners)}.{behind}{scope_words(results)}"
    )


def _behind(results: xr.Dataset, option: str) -> str:
    """Name the criterion that puts an option that betters forces or sound below the reference.

    Empty where they are apart by rounding alone.
    """
    criteria = criteria_of_advantage(results, REFERENCE_OPTION, option)
    if not criteria:
        return ""
    why = _inside_a_sentence(criteria[0])
    return f" Option {option} ranks below {REFERENCE_OPTION}, mainly by {why}."


def _inside_a_sentence(label: str) -> str:
    """A label without its capital, which a name of two capitals keeps."""
    return label if label[1:2].isupper() else label[:1].lower() + label[1:]


def _blocks(results: xr.Dataset) -> list[Block]:
    ranks = [rank_acceptability(results)] if "rank_acceptability" in results else []
    weightings = parameters(results)["scoring"]["random_weightings"]
    return [
        Text(
            "Each criterion gives a utility from 0 (worst) to 1 (best); scale and weights are a "
            f"choice of the study.{scope_words(results)} Probabilities of ranks are over "
            f"the samples and {weightings} random weightings (SMAA-2)."
        ),
        scores_table(results),
        *text(too_close_words(results), "note"),
        Pictures((score_bars(results), *ranks)),
        criteria_table(results),
        Text("Values of the criteria are in scores.csv, all other values in scoring.csv.", "note"),
        *_published(results),
    ]


def _data(results: xr.Dataset) -> dict[str, DataTable]:
    """Weights and scales, ranks in the samples, published scores."""
    names = ("weight", "criterion_best", "criterion_worst", "rank_acceptability",
             "published_score", "published_sum", "recomputed_sum")  # fmt: skip
    return {"scores.csv": scores_data(results), "scoring.csv": long_table(results, names)}


def _published(results: xr.Dataset) -> list[Block]:
    wrong = ", ".join(wrong_sums(results))
    if not wrong:
        return []
    source = parameters(results)["scoring"]["published"]["source"]
    return [Text(f"The printed sum of the published scores is wrong for {wrong}. Source: {source}")]


register(Section("scores", "Scores", _blocks, position=90.0, tables=_data))
