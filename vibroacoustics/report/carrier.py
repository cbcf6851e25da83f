"""Which source carries the level, and how sure that is under each prior."""

from typing import Final

import numpy as np
import xarray as xr

from ..base.decibel import power_of_level
from .bands import percent, total_by_draw
from .source_words import at_published, prior_words, ranked, source_name
from .study import catalogue_receiver, overall_noise, quoted_speed

_SURE: Final = 0.9
"""Probability from which on a sentence says so."""
_HALF: Final = 0.5
"""Share of the energy above which a source carries the level."""


def sure_sentence(results: xr.Dataset) -> str:
    """Whether the loudest modelled source carries the level of the whole machine, with draws."""
    source, _ = ranked(results, quoted_speed(results))[0]
    probability = [_carries(results, source, number) for number in range(results.sizes["prior"])]
    name = source_name(results, source)
    where = f"at {catalogue_receiver(results)} and {quoted_speed(results):g} rpm"
    noise = overall_noise(results)
    total = "level of all that is modelled" if noise is None else f"{noise['level_dba']:g} dB(A)"
    level = f"the {total} {where}"
    if min(probability) >= _SURE:
        first = f"Of {level}, without a balancer, {name} make the most"
    elif max(probability) <= 1.0 - _SURE:
        first = f"No modelled source carries {level}, without a balancer, not even {name}"
    else:
        first = f"Whether {name} carry {level}, without a balancer, is not sure"
    chance = f"{first}: the probability of more than half of the energy is"
    if noise is None:
        return f"{chance} {percent(probability[0])}. No level of the machine is published."
    priors = prior_words(results)
    what = ["what is not modelled", *["it"] * (len(priors) - 1)]
    by_prior = [
        f"{percent(one)} if {rest} lies {prior}"
        for one, rest, prior in zip(probability, what, priors, strict=True)
    ]
    return f"{chance} {', '.join(by_prior)}."


def _carries(results: xr.Dataset, source: str, prior: int) -> float:
    """Probability that a source makes more than half of the energy of the whole machine."""
    level = at_published(results, "source_level", source).transpose("draw").values
    total = total_by_draw(results, prior).transpose("draw").values
    weight = results["draw_weight"].values[prior]
    share = np.nan_to_num(power_of_level(level - total))  # none in a draw without solution
    return float(weight[share > _HALF].sum() / weight.sum())
