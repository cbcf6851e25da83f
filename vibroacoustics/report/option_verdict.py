"""What each option does, in sentences that are made from its numbers."""

from collections.abc import Callable, Mapping, Sequence
from typing import Final, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from . import rounding
from .shifts import JUDGED, LINE, MODELLED, TOTAL, Shift, shift
from .source_changes import change_sentences, source_change
from .study import balancers, catalogue_receiver, has_inner_sources, other_receivers

Facts = dict[str, NDArray[np.float64]]
"""Reported figures of an option by name, over the speeds at which they are given."""

BETTER: Final = "better"
WORSE: Final = "worse"
MIXED: Final = "mixed"
NO_CHANGE: Final = "no change"

ALL_SOURCES: Final = "sound of all sources"


class OptionVerdict(NamedTuple):
    """An option, one word, what it makes worse, and some sentences about it."""

    option: str
    judgement: str
    worse_in: tuple[str, ...]
    sentences: tuple[str, ...]


def option_verdicts(results: xr.Dataset) -> list[OptionVerdict]:
    """A verdict on every option but the reference."""
    return [option_verdict(results, option) for option in balancers(results)]


def option_verdict(results: xr.Dataset, option: str) -> OptionVerdict:
    """Judge one option by its 1x force, moment, foot force and line, at every microphone.

    Where gas, keys and motor are modelled, the band of all sources stands for the modelled level.
    """
    inside = source_change(results, option) if has_inner_sources(results) else None
    shifts = [
        shift(results, quantity, option)
        for quantity in JUDGED
        if inside is None or quantity != MODELLED
    ]
    elsewhere = {
        receiver: shift(results, LINE, option, receiver) for receiver in other_receivers(results)
    }
    worse_in = _worse_in(shifts, elsewhere)
    if inside is not None and inside.worsens:
        worse_in = (*worse_in, ALL_SOURCES)
    better = any(own.improves for own in shifts) or (inside is not None and inside.improves)
    judgement = judge(bool(worse_in), better)
    sentences = [
        _shift_sentence(shifts, judgement, catalogue_receiver(results)),
        _elsewhere(shifts[-1], elsewhere),
        *([_total(results, option)] if inside is None else change_sentences(results, option)),
        *fact_sentences(facts(results, option), judgement),
    ]
    return OptionVerdict(option, judgement, worse_in, tuple(filter(None, sentences)))


def judge(worse: bool, better: bool) -> str:
    """One word: better or worse where all changes agree, mixed where they do not."""
    if worse and better:
        return MIXED
    if worse:
        return WORSE
    return BETTER if better else NO_CHANGE


def facts(results: xr.Dataset, option: str) -> Facts:
    """The figures that the option reports of itself."""
    table = results["option_fact"].sel(option=option).transpose("fact", "speed")
    return {
        str(name): row[np.isfinite(row)]
        for name, row in zip(table["fact"].values, table.values, strict=True)
        if np.isfinite(row).any()
    }


def fact_sentences(known: Facts, judgement: str) -> list[str]:
    """Sentences about the reported figures that have one."""
    return [text for write in _FACT_SENTENCES if (text := write(known, judgement))]


def _shift_sentence(shifts: Sequence[Shift], judgement: str, receiver: str) -> str:
    if judgement == NO_CHANGE:
        *words, last = (own.quantity.words for own in shifts)
        return f"{', '.join(words)} and {last} stay the same."
    mechanical = [own for own in shifts if not own.quantity.is_level]
    parts = [f"the {own.quantity.words} {own.sentence()}" for own in mechanical]
    return f"At 1×, {'; '.join(parts)}. ".replace("the 1× ", "the ") + (
        f"At {receiver} the 1× line {shifts[-1].sentence()}."
    )


def _worse_in(shifts: Sequence[Shift], elsewhere: Mapping[str, Shift]) -> tuple[str, ...]:
    """What the option makes worse; the line elsewhere if it is not worse here already."""
    worse = [own.quantity.words for own in shifts if own.worsens]
    louder = [name for name, own in elsewhere.items() if own.worsens]
    if louder and LINE.words not in worse:
        worse.append(f"{LINE.words} at {', '.join(louder)}")
    return tuple(worse)


def _elsewhere(here: Shift, elsewhere: Mapping[str, Shift]) -> str:
    """Warn of microphones at which the line rises although it does not at the catalogue's."""
    louder = {} if here.worsens else {at: own for at, own in elsewhere.items() if own.worsens}
    places = "; ".join(f"at {receiver} it {own.sentence()}" for receiver, own in louder.items())
    return f"Not so elsewhere: {places}." if louder else ""


def _total(results: xr.Dataset, option: str) -> str:
    gain = shift(results, TOTAL, option).gain_db
    if not np.round(gain, 3).any():
        return "The total level does not change by as much as 0.001 dB."
    return f"The total level changes by {rounding.span(gain, _milli)} dB."


def _milli(value: float) -> str:
    return rounding.signed(value, 3)


def _hanging(known: Facts, judgement: str) -> str:
    growth = known.get("hanging_multiplier")
    if growth is None:
        return ""
    size = rounding.span(growth, lambda value: rounding.fixed(value, 2))
    if growth.min() > 1.0:
        return (
            f"Hanging is unstable: a deviation grows {size}-fold a revolution (Floquet multiplier)."
        )
    state = "stable" if growth.max() < 1.0 else "stable at some of the speeds only"
    return f"Hanging is {state} (Floquet multiplier {size})."


def _settled(known: Facts, judgement: str) -> str:
    angle = known.get("settled_angle_deg")
    if angle is None:
        return ""
    where = rounding.span(abs(angle), rounding.fixed)
    return f"The pendulum settles {where}° from hanging on average; stops are not modelled."


def _stroke(known: Facts, judgement: str) -> str:
    stroke = known.get("stroke_amplitude_mm")
    if stroke is None:
        return ""
    return f"Its mass moves with an amplitude of {rounding.span(stroke, rounding.significant)} mm."


def _resonance(known: Facts, judgement: str) -> str:
    speed = known.get("resonance_speed_rpm")
    if speed is None:
        return ""
    size = rounding.span(speed, lambda value: rounding.fixed(value, 0))
    return f"Its mass resonates on the springs at {size} rpm, also on the way up to speed."


def _power(known: Facts, judgement: str) -> str:
    power = known.get("dissipated_power_w")
    if power is None:
        return ""
    cost = rounding.span(power, rounding.significant)
    if judgement == NO_CHANGE:
        return f"It buys nothing in this model and costs {cost} W."
    return f"It dissipates {cost} W."


def _mass(known: Facts, judgement: str) -> str:
    mass = known.get("added_mass_kg")
    if mass is None or mass.max() <= 0.0:
        return ""
    return f"It adds {rounding.span(1e3 * mass, rounding.significant)} g."


_FACT_SENTENCES: Final[tuple[Callable[[Facts, str], str], ...]] = (
    _hanging,
    _settled,
    _stroke,
    _resonance,
    _power,
    _mass,
)
