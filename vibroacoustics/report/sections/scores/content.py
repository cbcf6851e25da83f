"""How the options rank, and the published scores."""

import xarray as xr

from ....base.registry import register
from ....results.stored_study import parameters
from ...blocks import Block, Pictures, Text
from ...charts.marks import Chart
from ...figures.scores import rank_acceptability
from ...figures.scores import scores as score_bars
from ...tables import DataTable, long_table
from .. import Section
from . import tables as scores


def _blocks(results: xr.Dataset) -> list[Block]:
    weightings = parameters(results)["scoring"]["random_weightings"]
    return [
        Text(
            "Each criterion gives a utility from 0 (worst) to 1 (best); scale and weights are a "
            f"choice of the study.{scores.scope_words(results)} Probabilities of ranks are over "
            f"the samples and {weightings} random weightings (SMAA-2)."
        ),
        scores.scores_table(results),
        *_too_close(results),
        Pictures((score_bars(results), *_ranks(results))),
        scores.criteria_table(results),
        Text("Values of the criteria are in scores.csv, all other values in scoring.csv.", "note"),
        *_published(results),
    ]


def _data(results: xr.Dataset) -> dict[str, DataTable]:
    """Weights and scales, ranks in the samples, published scores."""
    names = ("weight", "criterion_best", "criterion_worst", "rank_acceptability",
             "published_score", "published_sum", "recomputed_sum")  # fmt: skip
    return {"scores.csv": scores.scores_data(results), "scoring.csv": long_table(results, names)}


def _ranks(results: xr.Dataset) -> list[Chart]:
    return [rank_acceptability(results)] if "rank_acceptability" in results else []


def _too_close(results: xr.Dataset) -> list[Block]:
    words = scores.too_close_words(results)
    return [Text(words, "note")] if words else []


def _published(results: xr.Dataset) -> list[Block]:
    wrong = ", ".join(scores.wrong_sums(results))
    if not wrong:
        return []
    source = scores.published_source(results)
    return [Text(f"Published scores: the printed sum does not add up for {wrong} ({source})")]


register(Section("scores", "Scores", _blocks, position=90.0, tables=_data))
