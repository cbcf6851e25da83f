"""Which source carries the modelled level, in sentences made from its numbers."""

from typing import Final

import numpy as np
import xarray as xr

from ..base import rounding
from ..base.decibel import power_of_level
from ..base.remembered import remembered
from ..base.vocabulary import DERIVED_SUPPLY, REFERENCE_OPTION
from ..levels.agreement import priors_of
from ..machine.remainder import Remainder
from .bands import (
    Band,
    band,
    band_words,
    energy_share,
    percent,
    sample_values,
    share_band,
    total_by_sample,
)
from .energy_words import UNMODELLED, energy_band, has_energy_shares, majority
from .sampled_words import sampled_sentences
from .study import (
    a_weighted,
    at_catalogue,
    catalogue_receiver,
    elsewhere,
    first_order_hz,
    has_samples,
    many_speeds,
    overall_noise,
    parameters,
    quoted_dba,
    quoted_speed,
    source_name,
    speeds,
    total_of,
)

LINE_FIGURE: Final = "foot_force_2x_line_n"


def ranked(results: xr.Dataset, speed: float) -> list[tuple[str, Band]]:
    """Sources without a balancer at the catalogue's microphone, the loudest first."""
    sources = [
        (
            source,
            band(
                results, "source_level", **at_catalogue(results, sound_source=source, speed=speed)
            ),
        )
        for source in map(str, results["sound_source"].values)
    ]
    return sorted(sources, key=lambda entry: -entry[1].middle)


def carrier_sentence(results: xr.Dataset) -> str:
    """Which source carries the modelled level, and how loud it is."""
    speed, overall = quoted_speed(results), quoted_dba(results)
    source, level = ranked(results, speed)[0]
    assumed, published = _assumed_level(results, source), overall_noise(results)
    if not has_samples(results):
        return (
            f"At {catalogue_receiver(results)} and {speed:g} rpm, without a balancer, the loudest "
            f"modelled source at the assumed values is: {source_name(results, source)}, "
            f"{rounding.level(assumed)} dB(A), which is {percent(energy_share(assumed, overall))} "
            f"of the energy of {f'{overall:g} dB(A)' if published else total_of(results)}."
        )
    rest = ", as the prior of what is not modelled is" if published else ""
    shares = (source_share(results, source, prior) for prior in range(results.sizes["prior"]))
    return (
        f"At {catalogue_receiver(results)} and {speed:g} rpm, without a balancer, the loudest "
        f"modelled source is: {source_name(results, source)}, "
        f"{level.middle_text(rounding.level)} dB(A) in the median of the samples "
        f"({band_words(results)} {level.ends(rounding.level)}) or "
        f"{rounding.level(assumed)} dB(A) at the assumed values; "
        f"{' or '.join(share.in_percent() for share in shares)} of the energy of "
        f"{total_of(results)} is its{rest}."
    )


def shares_sentence(results: xr.Dataset) -> str:
    """How much of the energy of the whole machine each source accounts for, by prior."""
    if not has_samples(results):
        return _unresolved(results)
    first, *others = (_shares(results, prior) for prior in range(results.sizes["prior"]))
    published = overall_noise(results)
    if published is None:
        return (
            "No level of the machine is published. Of the energy of all that is modelled, in the "
            f"median of the samples with the {band_words(results)} in brackets: {first}."
        )
    texts = [
        f"Of the energy of the whole machine there, published as {published['level_dba']:g} dB(A) "
        f"and taken as sure to ± {published.get('deviation_db', 2.0):g} dB, in the median of the "
        f"samples with the {band_words(results)} in brackets: {first}."
    ]
    names = prior_words(results)
    texts.append(f"That holds for a remainder {names[0]}.")
    texts += [f"For one {name}: {shares}." for name, shares in zip(names[1:], others, strict=True)]
    return " ".join(texts)


def prior_words(results: xr.Dataset) -> list[str]:
    """Priors of the remainder after "a remainder"; of older files those that then held."""
    table = parameters(results)["machine"].get("remainder", {})
    known = {name: value for name, value in table.items() if value is not None}
    remainder = Remainder.model_construct(**known)  # whatever it is: it is only put into words
    words_of = {prior.name: prior.words for prior in priors_of(remainder)}
    return [words_of.get(str(name), str(name)) for name in results["prior"].values]


def _shares(results: xr.Dataset, prior: int) -> str:
    """Shares of sources and remainder, one after another."""
    by_source = {
        source_name(results, source): source_share(results, source, prior)
        for source, _ in ranked(results, quoted_speed(results))
    }
    shares = [f"{name} {share.in_percent()}" for name, share in by_source.items()]
    if overall_noise(results) is None:
        return "; ".join(shares)
    modelled, rest = _modelled_and_rest(results, prior)
    there = elsewhere(results)
    what = f"what is not modelled{there}" if there else "what is not modelled"
    return (
        f"{'; '.join(shares)}; all modelled sources together {modelled.in_percent()}; "
        f"{what} {rest.in_percent()}"
    )


def _modelled_and_rest(results: xr.Dataset, prior: int) -> tuple[Band, Band]:
    """Shares of all modelled sources and of unmodelled noise."""
    if _is_of_all_samples(results, prior):
        rest = energy_band(results, UNMODELLED)
        lowest, middle, highest = (1.0 - share for share in rest[2::-1])
        return Band(lowest, middle, highest), rest
    modelled = share_band(results, at_published(results, "level_modelled"), prior)
    return modelled, share_band(results, results["level_unmodelled_by_sample"], prior)


def _is_of_all_samples(results: xr.Dataset, prior: int) -> bool:
    """Whether shares are those of all samples at the published level, not of those that go on."""
    return prior == 0 and has_energy_shares(results)


@remembered
def source_share(results: xr.Dataset, source: str, prior: int = 0) -> Band:
    """Share of a source in the energy of the machine."""
    if _is_of_all_samples(results, prior):
        return energy_band(results, source)
    return share_band(results, at_published(results, "source_level", source), prior)


def at_published(results: xr.Dataset, name: str, source: str | None = None) -> xr.DataArray:
    """A level by sample, or as given, without an option where the level is published."""
    level = results[f"{name}_by_sample" if has_samples(results) else name]
    of_source = {} if source is None else {"sound_source": source}
    return a_weighted(level.sel(at_catalogue(results, speed=quoted_speed(results), **of_source)))


def certainty_sentences(results: xr.Dataset) -> list[str]:
    """What the ranking and the bands rest on."""
    texts = [_ranking(results), left_out_sentence(results), _as_assumed(results)]
    texts += sampled_sentences(results) if has_samples(results) else []
    return [*filter(None, [*texts, _up_to(results), _not_an_order(results)])]


def left_out_sentence(results: xr.Dataset) -> str:
    """How many samples the bands rest on, and how they were weighed."""
    if "prior_sample_weight" not in results:
        return "No value of the sources has a range: nothing was sampled, and there are no bands."
    if not has_samples(results):
        return _unresolved(results)
    tried, effective, computed, unsolved = sample_values(results)
    failed = f" {unsolved} of them have no solution." if unsolved else ""
    if overall_noise(results) is None and "baseline_band_level" not in results:
        how = "by the hammer test alone" if "shell_weight" in results else "alike"
        return (
            f"{tried} samples were computed. As no level of the machine is published, they count "
            f"{how}: they are worth {effective:.0f} equal ones. The bands rest on {computed} of "
            f"them.{failed}"
        )
    where = f"where the level is published{elsewhere(results)}"
    if "baseline_band_level" in results:
        where = "where the sound was measured"
    return (
        f"{tried} samples were computed {where} and "
        f"weighed by how well they agree with it: they are worth {effective:.0f} equal ones. "
        f"The bands rest on {computed} of them.{failed}"
    )


def _unresolved(results: xr.Dataset) -> str:
    """Why there are neither shares nor bands."""
    if "prior_sample_weight" not in results:
        return "No value of the sources has a range: nothing was sampled, and there are no bands."
    tried, effective, *_ = sample_values(results)
    if overall_noise(results) is None:
        return (
            f"Shares and bands are not resolved: {tried} samples are worth no more than "
            f"{effective:.1f} that have a solution. What follows holds at the assumed values only."
        )
    overall = quoted_dba(results)
    louder = float((results["prior_sample_level"] > overall).mean())
    agree = "the measured baseline" if "baseline_band_level" in results else "it"
    return (
        f"Shares and bands are not resolved: {tried} samples, {percent(louder)} of them louder "
        f"than the published {overall:g} dB(A) by the modelled sources alone, are worth no more "
        f"than {effective:.1f} that agree with {agree}. What follows holds at the assumed values "
        "only."
    )


def _assumed_level(results: xr.Dataset, source: str) -> float:
    """At the assumed values, without a balancer, where the overall level is published, dB(A)."""
    at = at_catalogue(results, sound_source=source, speed=quoted_speed(results))
    return float(results["source_level"].sel(at))


def _ranking(results: xr.Dataset) -> str:
    (first, loudest), (second, next_one) = ranked(results, quoted_speed(results))[:2]
    names = f"{source_name(results, first)} and {source_name(results, second)}"
    if loudest.lowest > next_one.highest:
        gap = rounding.fixed(loudest.lowest - next_one.highest)
        return (
            f"The bands of {names} do not overlap ({gap} dB apart): within them the loudest "
            "modelled source stays the same."
        )
    return (
        f"The bands of {names} overlap ({loudest.ends(rounding.level)} and "
        f"{next_one.ends(rounding.level)} dB(A)): which is the louder is not sure."
    )


def _as_assumed(results: xr.Dataset) -> str:
    """Warn where the assumed values lie outside of the band of the loudest source."""
    speed, overall = quoted_speed(results), quoted_dba(results)
    source, level = ranked(results, speed)[0]
    value = _assumed_level(results, source)
    if level.lowest <= value <= level.highest:
        return ""
    side = "above" if value > level.highest else "below"
    return (
        f"At the assumed values, nothing sampled, {source_name(results, source)} alone reach "
        f"{rounding.level(value)} dB(A), {side} the band: its share is not known better than from "
        f"{percent(source_share(results, source).lowest)} to "
        f"{percent(energy_share(value, overall))}."
    )


def _up_to(results: xr.Dataset) -> str:
    highest = parameters(results)["radiation"]["maximum_frequency_hz"]
    above = "in no level" if overall_noise(results) is None else "part of the remainder"
    return (
        f"Sources are modelled up to {highest:g} Hz; what they make above is {above}, "
        "so that an option whose keys strike can be louder than told here."
    )


def _not_an_order(results: xr.Dataset) -> str:
    """Keep the motor's line apart from 2x."""
    if LINE_FIGURE not in results["figure"].values or "supply_frequency" not in results:
        return ""
    figures = results["reported_figure"].sel(option=REFERENCE_OPTION)
    motor = float(figures.sel(figure=LINE_FIGURE).max())
    foot = results["foot_force_amplitude"].sel(order=1, option=REFERENCE_OPTION)
    return (
        "The motor's line at twice the line frequency is no order of the shaft: "
        f"{_twice_line(results)}. It and its sidebands count as motor, never as 2×. "
        f"{_derived_supply(results)}Into a foot it passes at most "
        f"{rounding.significant(motor)} N, beside {rounding.significant(float(foot.max()))} N at "
        "1×: what it does to floor and pipes is not modelled."
    )


def _twice_line(results: xr.Dataset) -> str:
    """Twice the line frequency beside 2x, by speed."""
    twice = (2.0 * results["supply_frequency"].values).tolist()
    write = "{:.1f}".format if _derived_supply(results) else "{:g}".format
    if many_speeds(results):
        return (
            f"{rounding.span(twice, write)} Hz beside 2× at "
            f"{rounding.span(2.0 * first_order_hz(results), rounding.fixed)} Hz"
        )
    rows = zip(speeds(results), twice, first_order_hz(results), strict=True)
    return ", ".join(
        f"{write(line)} Hz beside 2× at {2.0 * first:.1f} Hz ({speed:g} rpm)"
        for speed, line, first in rows
    )


def _derived_supply(results: xr.Dataset) -> str:
    """Where the supply's frequency comes from, if the study does not give it."""
    if results["supply_frequency"].attrs["source"] != DERIVED_SUPPLY:
        return ""
    return "The supply's frequency is derived from speed and slip under the mean load. "


_SURE: Final = 0.9
"""Probability from which on a sentence says so."""
_HALF: Final = 0.5
"""Share of the energy above which a source carries the level."""


def sure_sentence(results: xr.Dataset) -> str:
    """Whether the loudest modelled source carries the level of the whole machine, with samples."""
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
    """Probability that a source makes more than half of the energy of the machine."""
    if _is_of_all_samples(results, prior):
        return majority(results, source)
    level = at_published(results, "source_level", source).transpose("sample").values
    total = total_by_sample(results, prior).transpose("sample").values
    weight = results["sample_weight"].values[prior]
    share = np.nan_to_num(power_of_level(level - total))  # none in a sample without solution
    return float(weight[share > _HALF].sum() / weight.sum())
