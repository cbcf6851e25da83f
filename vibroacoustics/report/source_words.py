"""Which source carries the modelled level, in sentences made from its numbers."""

from typing import Final

import xarray as xr

from ..base import rounding
from ..base.vocabulary import DERIVED_SUPPLY, REFERENCE_OPTION
from .bands import Band, band, band_words, draws, energy_share, percent
from .drawn_words import drawn_sentences
from .study import (
    catalogue_receiver,
    elsewhere,
    first_order_hz,
    has_draws,
    many_speeds,
    overall_noise,
    parameters,
    speeds,
    words,
)

LINE_FIGURE: Final = "foot_force_2x_line_n"


def source_name(results: xr.Dataset, source: str) -> str:
    """Plain words for a source of sound."""
    label = words(results)["sources"].get(source, source.replace("_", " "))
    return str(label)


def quoted_speed(results: xr.Dataset) -> float:
    """The speed at which the overall level is published."""
    return overall_noise(results)["speed_rpm"]


def ranked(results: xr.Dataset, speed: float) -> list[tuple[str, Band]]:
    """Sources without a balancer at the catalogue's microphone, the loudest first."""
    sources = [
        (str(source), _source_band(results, str(source), speed))
        for source in results["sound_source"].values
    ]
    return sorted(sources, key=lambda entry: -entry[1].middle)


def carrier_sentence(results: xr.Dataset) -> str:
    """Which source carries the modelled level, and how loud it is."""
    speed, overall = quoted_speed(results), overall_noise(results)["level_dba"]
    source, level = ranked(results, speed)[0]
    share, assumed = level.share_of(overall), _assumed_level(results, source)
    return (
        f"At {catalogue_receiver(results)} and {speed:g} rpm, without a balancer, the loudest "
        f"modelled source is: {source_name(results, source)}, "
        f"{rounding.level(level.middle)} dB(A) in the middle of the draws "
        f"({band_words(results)} {level.ends(rounding.level)}) or "
        f"{rounding.level(assumed)} dB(A) at the assumed values, which is "
        f"{percent(share.middle)} ({share.ends(percent)}) or "
        f"{percent(energy_share(assumed, overall))} of the energy of {overall:g} dB(A)."
    )


def shares_sentence(results: xr.Dataset) -> str:
    """How much of the overall level each source accounts for."""
    speed, overall = quoted_speed(results), overall_noise(results)["level_dba"]
    at = {
        "speed": speed,
        "option": REFERENCE_OPTION,
        "receiver": catalogue_receiver(results),
    }
    shares = [
        f"{source_name(results, source)} {level.share_of(overall).middle_and_ends(percent)}"
        for source, level in ranked(results, speed)
    ]
    together = band(results, "level_modelled", **at).share_of(overall)
    rest, there = band(results, "level_remainder").share_of(overall), elsewhere(results)
    what = f"what is left of it{there}" if there else "the rest"
    return (
        f"Of the energy of {overall:g} dB(A) there, in the middle of the draws with the "
        f"{band_words(results)} in brackets: {'; '.join(shares)}; all modelled sources together "
        f"{together.middle_and_ends(percent)}. Not modelled is {what}, "
        f"{rest.middle_and_ends(percent)}."
    )


def certainty_sentences(results: xr.Dataset) -> list[str]:
    """What the ranking and the bands rest on."""
    texts = [_ranking(results), left_out_sentence(results), _as_assumed(results)]
    texts += drawn_sentences(results) if has_draws(results) else []
    return [*filter(None, [*texts, _up_to(results), _not_an_order(results)])]


def left_out_sentence(results: xr.Dataset) -> str:
    """How many draws the bands rest on, and why others do not count."""
    if not has_draws(results):
        return "No value of the sources has a range: nothing was drawn, and there are no bands."
    kept, louder, unsolved = draws(results)
    overall = overall_noise(results)["level_dba"]
    failed = f" {unsolved} further draws have no solution." if unsolved else ""
    if not louder:
        return (
            f"The bands rest on {kept} draws, none of which exceeds {overall:g} dB(A) "
            f"alone{elsewhere(results)}."
            f"{failed}"
        )
    tends = (
        "; the model tends to be too loud, and the bands tell" if louder > kept else ": they tell"
    )
    return (
        f"{louder} of {kept + louder + unsolved} draws are left out because their modelled sources "
        f"alone exceed {overall:g} dB(A){elsewhere(results)}, which they "
        f"cannot{tends} only what agrees with the "
        f"published level. They rest on {kept} draws.{failed}"
    )


def _source_band(results: xr.Dataset, source: str, speed: float) -> Band:
    return band(
        results,
        "source_level",
        sound_source=source,
        speed=speed,
        option=REFERENCE_OPTION,
        receiver=catalogue_receiver(results),
    )


def _assumed_level(results: xr.Dataset, source: str) -> float:
    """At the assumed values, without a balancer, where the overall level is published, dB(A)."""
    return float(
        results["source_level"].sel(
            sound_source=source,
            speed=quoted_speed(results),
            option=REFERENCE_OPTION,
            receiver=catalogue_receiver(results),
        )
    )


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
    speed, overall = quoted_speed(results), overall_noise(results)["level_dba"]
    source, level = ranked(results, speed)[0]
    value = _assumed_level(results, source)
    if level.lowest <= value <= level.highest:
        return ""
    side = "above" if value > level.highest else "below"
    return (
        f"At the assumed values, nothing drawn, {source_name(results, source)} alone reach "
        f"{rounding.level(value)} dB(A), {side} the band: its share is not known better than from "
        f"{percent(level.share_of(overall).lowest)} to {percent(energy_share(value, overall))}."
    )


def _up_to(results: xr.Dataset) -> str:
    highest = parameters(results)["radiation"]["maximum_frequency_hz"]
    return (
        f"Sources are modelled up to {highest:g} Hz; what they make above is part of the "
        "remainder, so that an option whose keys strike can be louder than told here."
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
