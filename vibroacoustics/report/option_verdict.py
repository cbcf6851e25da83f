"""Verdict on each option, in sentences that are made from its numbers."""

from collections.abc import Mapping, Sequence
from typing import Final, NamedTuple

import numpy as np
import xarray as xr

from ..base import rounding
from ..base.remembered import remembered
from ..results.stored_study import balancers, has_sources, other_receivers, words
from .quantities import JUDGED, LINE
from .sections.sources.words import key_impacts
from .shifts import Shift, shift

BETTER: Final = "better"
WORSE: Final = "worse"
MIXED: Final = "mixed"
UNCERTAIN: Final = "uncertain"
NO_CHANGE: Final = "no measurable change"


class OptionVerdict(NamedTuple):
    """An option, one word, why, what it makes worse, and some sentences about it."""

    option: str
    judgement: str
    reason: str
    worse_in: tuple[str, ...]
    sentences: tuple[str, ...]


def option_verdicts(results: xr.Dataset) -> list[OptionVerdict]:
    """A verdict on every option but the reference."""
    return [option_verdict(results, option) for option in balancers(results)]


@remembered
def option_verdict(results: xr.Dataset, option: str) -> OptionVerdict:
    """Judge one option by what can be measured: 1x force, moment, foot force and line, total.

    The line counts at every microphone, the total in the samples.
    """
    shifts = [shift(results, quantity, option) for quantity in JUDGED]
    elsewhere = {
        receiver: shift(results, LINE, option, receiver) for receiver in other_receivers(results)
    }
    worse_in = _worse_in(shifts, elsewhere)
    better = any(each.falls for each in shifts)
    judgement = judge(bool(worse_in), better, any(each.is_uncertain for each in shifts))
    sentences = [
        *(key_impacts(results, option) if has_sources(results) else ()),
        *words(results)["sentences"][option],
        _mass(results, option),
    ]
    reason = _reason(shifts, elsewhere, judgement)
    return OptionVerdict(option, judgement, reason, worse_in, tuple(filter(None, sentences)))


def judge(worse: bool, better: bool, unsure: bool) -> str:
    """One word: better or worse where all sure changes agree, mixed where they do not."""
    if worse and better:
        return MIXED
    if worse:
        return WORSE
    if better:
        return BETTER
    return UNCERTAIN if unsure else NO_CHANGE


def _reason(shifts: Sequence[Shift], elsewhere: Mapping[str, Shift], judgement: str) -> str:
    """Reason for which the option is better or worse, with its size, and what is uncertain."""
    if judgement == NO_CHANGE:
        least = shifts[0].least
        return f"levels < {least.level_db:g} dB, forces < {100.0 * least.force_ratio:g} %"
    louder = {} if shifts[-1].rises else elsewhere
    worse = [shift.short(better=False) for shift in shifts if shift.rises]
    worse += [
        f"{shift.short(better=False)} at {receiver}"
        for receiver, shift in louder.items()
        if shift.rises
    ]
    better = [shift.short(better=True) for shift in shifts if shift.falls]
    unsure = [
        shift.short(better=shift.fallen > shift.grown) for shift in shifts if shift.is_uncertain
    ]
    parts = {BETTER: better, WORSE: worse, UNCERTAIN: unsure}
    said = {word: ", ".join(of_word) for word, of_word in parts.items() if of_word}
    if list(said) == [judgement]:
        return said[judgement]
    return "; ".join(f"{word}: {of_word}" for word, of_word in said.items())


def _worse_in(shifts: Sequence[Shift], elsewhere: Mapping[str, Shift]) -> tuple[str, ...]:
    """Quantities that the option makes worse; the line elsewhere if it is not worse here
    already."""
    worse = [quantity_shift.quantity.words for quantity_shift in shifts if quantity_shift.rises]
    louder = [name for name, line_shift in elsewhere.items() if line_shift.rises]
    if louder and LINE.words not in worse:
        worse.append(f"{LINE.words} at {', '.join(louder)}")
    return tuple(worse)


def _mass(results: xr.Dataset, option: str) -> str:
    mass = results["reported_figure"].sel(option=option, figure="added_mass_kg").values
    if not np.nanmax(mass) > 0.0:
        return ""
    return f"It adds {rounding.span(1e3 * mass, rounding.significant)} g."
