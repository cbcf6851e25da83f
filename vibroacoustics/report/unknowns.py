"""Which unknowns the level hangs on, what the published level tells of them, what to measure."""

from typing import Final

import numpy as np
import xarray as xr

from ..base import rounding
from ..base.quantiles import weighted_quantiles
from ..base.vocabulary import REFERENCE_OPTION
from .bands import QUANTILES, band_of, band_words, draws, percent
from .drawn_words import file_unit, named
from .study import catalogue_receiver, has_draws, quoted_speed, speeds
from .tables import Table

RESOLVED: Final = 0.9
"""Q² from which shares are told."""
MATTERS: Final = 0.01
"""Unknowns with less of the variance are told as one group."""
NOT_RESOLVED: Final = "not resolved"
REMAINDER_WORDS: Final = "the level of what is not modelled"
BEFORE: Final = "before"


def quality_sentence(results: xr.Dataset) -> str:
    """How much of the level single unknowns explain, and whether shares are told."""
    quality = results["level_share_quality"]
    sizes = [
        f"{_foretold(float(value))} {_knowledge(results, str(name))}"
        for name, value in zip(quality["knowledge"].values, quality.values, strict=True)
        if np.isfinite(value)
    ]
    if not sizes:
        return "The draws are too few to tell which unknown the level hangs on."
    sentence = (
        f"Of the variance of the modelled level at {catalogue_receiver(results)} without a "
        f"balancer, unknowns taken one by one and added up foretell (Q²) {', '.join(sizes)}."
    )
    if float(np.nanmin(quality.values)) >= RESOLVED:
        return sentence
    return (
        f"{sentence} Below {percent(RESOLVED)} shares are {NOT_RESOLVED}: unknowns act together, "
        "or the draws are too few."
    )


def unknowns_table(results: xr.Dataset) -> Table:
    """Unknowns that matter: their values before and after the published level, their shares."""
    shares = results["level_share"]
    knowledge = [str(name) for name in shares["knowledge"].values]
    columns = knowledge if _any_resolved(results) else knowledge[:1]
    rows = [
        (
            _with_unit(results, name),
            *(_values(results, name, number) for number in range(-1, len(knowledge) - 1)),
            *(_share(results, name, one) for one in columns),
        )
        for name in _that_matter(shares)
    ]
    words = [_knowledge(results, name) for name in knowledge]
    shares_of = [f"share of the variance {_knowledge(results, name)}" for name in columns]
    return Table(
        f"What the modelled level hangs on: middle of the values with {band_words(results)}",
        (
            "Unknown",
            *(f"value {word}" for word in words),
            *(shares_of if _any_resolved(results) else ["share of the variance"]),
        ),
        (*rows, _others(results)),
    )


def measure_next_sentence(results: xr.Dataset) -> str:
    """The unknown whose knowledge would narrow the bands of the changes most."""
    if "change_share" not in results or len(results["option"]) < 2:
        return ""
    share = np.nan_to_num(results["change_share"].values)
    variance = np.nan_to_num(results["change_variance"].values)
    gain = share * variance[:, None]
    best = int(gain.sum(axis=0).argmax())
    speed = min(speeds(results), key=lambda one: abs(one - quoted_speed(results)))
    if gain[:, best].sum() <= 0.0:
        return (
            f"Which unknown to measure next, {draws(results).computed} draws do not tell: none "
            "narrows the band of a change by more than chance would."
        )
    option = int(gain[:, best].argmax())
    name = str(results["unknown"].values[best])
    words = named(name) if name in results["drawn_parameter"].values else REMAINDER_WORDS
    before = _width(results, option, speed)
    after = before * np.sqrt(max(1.0 - share[option, best], 0.0))
    return (
        f"Measure next, as far as {draws(results).computed} draws tell: {words}. To know it would "
        f"take about {percent(gain[:, best].sum() / variance.sum())} of the variance of what the "
        f"options change off, and narrow the band of {results['option'].values[option]} at "
        f"{speed:g} rpm, where it tells most, from {rounding.fixed(before)} to about "
        f"{rounding.fixed(after)} dB."
    )


def _foretold(quality: float) -> str:
    return percent(quality) if quality >= MATTERS else "nothing"


def _that_matter(shares: xr.DataArray) -> list[str]:
    """Names of unknowns with a share that is no group's, the largest first."""
    largest = np.nan_to_num(shares.values).max(axis=0)
    order = np.argsort(-largest, kind="stable")
    return [str(shares["drawn_parameter"].values[at]) for at in order if largest[at] >= MATTERS]


def _others(results: xr.Dataset) -> tuple[str, ...]:
    """The unknowns with less than 1 % each as one group."""
    shares = results["level_share"]
    matter = _that_matter(shares)
    others = shares.sel(
        drawn_parameter=[n for n in shares["drawn_parameter"].values if n not in matter]
    )
    knowledge = [str(name) for name in shares["knowledge"].values]
    together = [
        percent(float(others.sel(knowledge=one).sum())) if _resolved(results, one) else NOT_RESOLVED
        for one in (knowledge if _any_resolved(results) else knowledge[:1])
    ]
    count = others.sizes["drawn_parameter"]
    name = f"{count} other{'s' * (count != 1)}, less than {100.0 * MATTERS:g}\u00a0% each"
    return (name, *(rounding.NOTHING for _ in knowledge), *together)


def _any_resolved(results: xr.Dataset) -> bool:
    """Whether any share is told; where none is, one column says so."""
    knowledge = results["level_share"]["knowledge"].values
    return any(_resolved(results, str(one)) for one in knowledge)


def _resolved(results: xr.Dataset, knowledge: str) -> bool:
    return bool(results["level_share_quality"].sel(knowledge=knowledge) >= RESOLVED)


def _share(results: xr.Dataset, name: str, knowledge: str) -> str:
    if not _resolved(results, knowledge):
        return NOT_RESOLVED
    return percent(float(results["level_share"].sel(drawn_parameter=name, knowledge=knowledge)))


def _values(results: xr.Dataset, name: str, prior: int) -> str:
    """Middle and band of an unknown's values by a prior; by equal weights for -1."""
    if prior >= 0 and not has_draws(results):
        return rounding.NOTHING
    values = results["bank_value"].sel(drawn_parameter=name).values / file_unit(results, name)[1]
    before = results["shell_weight"].values if "shell_weight" in results else np.ones(values.size)
    weight = before if prior < 0 else results["bank_weight"].values[prior]
    return band_of(values, weight).middle_and_ends(rounding.three_digits)


def _width(results: xr.Dataset, option: int, speed: float) -> float:
    """Of the band of an option's change, dB."""
    there = results["level_total_by_draw"].sel(receiver=catalogue_receiver(results), speed=speed)
    change = there.isel(option=option) - there.sel(option=REFERENCE_OPTION)
    low, *_, high = weighted_quantiles(change.values, results["draw_weight"].values[0], QUANTILES)
    return float(high - low)


def _with_unit(results: xr.Dataset, name: str) -> str:
    unit = file_unit(results, name)[0]
    return f"{named(name)}, {unit}" if unit else named(name)


def _knowledge(results: xr.Dataset, name: str) -> str:
    if name != BEFORE:
        return f"with the published level, prior {name}"
    return "with the hammer test" if "shell_weight" in results else "by the ranges alone"
