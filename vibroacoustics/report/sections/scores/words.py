"""Which option ranks first, how sure that is, and why others fall behind."""

from collections.abc import Sequence

import xarray as xr

from ....base import rounding
from ....base.vocabulary import REFERENCE_OPTION
from ....results import labels
from ...option_verdict import BETTER, OptionVerdict
from .tables import acceptability_words, criteria_of_advantage, scope_words


def ranking_sentence(results: xr.Dataset, verdicts: Sequence[OptionVerdict]) -> str:
    """Which option the study's weights prefer, and how sure that is."""
    method = str(results["scoring_method"].values[0])
    of_method = results[["score", "rank"]].sel({"scoring_method": method})
    winners = [str(name) for name in of_method["option"].values[of_method["rank"].values == 1.0]]
    verb = "ranks" if len(winners) == 1 else "rank"
    score = rounding.fixed(float(of_method["score"].max()), 2)
    unlucky = [
        option.option
        for option in verdicts
        if option.judgement == BETTER
        and of_method["rank"].sel(option=option.option)
        > of_method["rank"].sel(option=REFERENCE_OPTION)
    ]
    behind = "".join(_behind(results, option) for option in unlucky)
    return (
        f"By the study's weights {' and '.join(winners)} {verb} first "
        f"({labels.name(method).lower()}, score {score} of 1)"
        f"{acceptability_words(results, winners)}.{behind}{scope_words(results)}"
    )


def _behind(results: xr.Dataset, option: str) -> str:
    """By which criteria an option that betters forces or sound falls behind the reference."""
    criteria = criteria_of_advantage(results, REFERENCE_OPTION, option)
    return (
        f" {option} ranks below {REFERENCE_OPTION} all the same: {REFERENCE_OPTION} scores better "
        f"in {' and '.join(map(_inside_a_sentence, criteria))}."
    )


def _inside_a_sentence(label: str) -> str:
    """A label without its capital, which a name of two capitals keeps."""
    return label if label[1:2].isupper() else label[:1].lower() + label[1:]
