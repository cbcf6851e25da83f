"""How the options rank, and the published scores."""

import xarray as xr

from ....base.registry import register
from ....results.stored_study import parameters
from ...blocks import Block, Heading, Pictures, Text
from ...charts.marks import Chart
from ...figures.scores import rank_acceptability
from ...figures.scores import scores as score_bars
from .. import Section
from . import tables as scores


def _blocks(results: xr.Dataset) -> list[Block]:
    weightings = parameters(results)["scoring"]["random_weightings"]
    return [
        Text(
            "Each criterion gives a utility from 0 (worst) to 1 (best) on a fixed scale. The "
            "weighted sum adds the utilities times their weights; TOPSIS measures closeness to "
            "the ideal option. Scale and weights are a choice of the study, not a "
            f"result.{scores.scope_words(results)} So each rank has a probability: of each sample "
            f"of the values that are not known, by its weight, with {weightings} weightings "
            "sampled evenly from all that there are (stochastic multicriteria acceptability "
            "analysis, SMAA-2)."
        ),
        scores.scores_table(results),
        *filter(None, [scores.acceptability_table(results)]),
        *_too_close(results),
        Pictures((score_bars(results), *_ranks(results))),
        scores.criteria_table(results),
        scores.values_table(results),
        *_published(results),
    ]


def _ranks(results: xr.Dataset) -> list[Chart]:
    return [rank_acceptability(results)] if "rank_acceptability" in results else []


def _too_close(results: xr.Dataset) -> list[Block]:
    words = scores.too_close_words(results)
    return [Text(words, "note")] if words else []


def _published(results: xr.Dataset) -> list[Block]:
    table = scores.published_table(results)
    if table is None:
        return []
    wrong = ", ".join(scores.wrong_sums(results))
    return [
        Heading("Published scores"),
        Text(scores.published_source(results)),
        *([Text(f"The printed sum does not add up for {wrong}.", "strong")] if wrong else []),
        table,
    ]


register(Section("scores", "Scores", _blocks, position=90.0))
