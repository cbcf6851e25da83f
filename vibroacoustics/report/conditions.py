"""Claims of analyses, with what their results hold of the conditions."""

from collections.abc import Iterator, Sequence
from typing import Final

import numpy as np
import xarray as xr

from ..base import rounding
from ..base.arrays import Array
from ..results.bands import band
from ..results.claim_kinds import (
    BAND,
    CHANGE,
    COHERENCE,
    INTERVAL,
    KWAVE,
    MEAN_INTERVAL,
    PROMISE,
    RANKING,
    SHEET_LEVEL,
    TRUNCATION,
    UNCERTAINTY,
)
from ..results.conditional import ConditionalClaim, Finding
from ..results.data_sheet import SoundPower
from ..results.estimates import effective_samples, has_samples
from ..results.stored_study import at_catalogue, balancers, catalogue_receiver, nearest_speed
from .kwave_words import kwave_difference_db
from .quantities import TOTAL
from .shifts import level_word, shift

FEW_SAMPLES: Final = 30
"""Effective samples below which their number is said."""


def study_claims(results: xr.Dataset) -> tuple[ConditionalClaim, ...]:
    """Return the interval of the level, the change by each option, k-Wave's check, the ranking."""
    changes = [_change(results, option) for option in balancers(results)]
    return (interval_claim(results), *changes, kwave_claim(results), *_ranking(results))


def interval_claim(results: xr.Dataset) -> ConditionalClaim:
    """Return the interval of the level at the microphone of the published one."""
    level = band(results, "level_total", **at_catalogue(results, speed=nearest_speed(results)))
    is_sampled = has_samples(results)
    effective = effective_samples(results) if is_sampled else np.inf
    findings = {
        "samples": _samples(is_sampled),
        "effective samples": Finding(f"{effective:.0f}", effective >= FEW_SAMPLES),
    }
    ends = f"{level.around_middle(rounding.level)} dB(A)"
    return INTERVAL.claim(ends, findings, catalogue_receiver(results))


def _samples(is_sampled: bool) -> Finding:
    return Finding("weighted samples" if is_sampled else "nominal values", is_sampled)


def _change(results: xr.Dataset, option: str) -> ConditionalClaim:
    of_total = shift(results, TOTAL, option)
    word = level_word(of_total)
    ends = of_total.band.middle_and_ends(rounding.signed)
    findings = {
        "change": Finding(word, of_total.worsens or of_total.improves),
        "interval": Finding(word, word in {"louder", "quieter"}),
    }
    return CHANGE.claim(f"{word}, {ends} dB", findings, option)


def kwave_claim(results: xr.Dataset) -> ConditionalClaim:
    """Return the largest difference between k-Wave and the closed form."""
    difference = kwave_difference_db(results)
    if difference is None:
        return KWAVE.claim("of the closed form", {"k-Wave": Finding("not run", False)})
    value = f"within {rounding.fixed(difference, 3)} dB of the closed form"
    return KWAVE.claim(value, {"k-Wave": Finding("run", True)})


def _ranking(results: xr.Dataset) -> Iterator[ConditionalClaim]:
    if "first_place_share" not in results:
        return
    share = results["first_place_share"]
    best = str(share["option"].values[int(np.argmax(share.values))])
    value = f"{best} first with {100.0 * float(share.max()):.0f} %"
    yield RANKING.claim(value, {"samples": _samples(has_samples(results))})


def coherence_claim(coherence: xr.DataArray) -> ConditionalClaim:
    """Return at how many speeds there is a coherence, which needs a mean of enough blocks."""
    has_coherence = coherence.notnull().any([dim for dim in coherence.dims if dim != "speed"])
    count, speeds = int(has_coherence.sum()), has_coherence.size
    words = f"{count} of {speeds}"
    findings = {
        "any speed": Finding(words, count > 0),
        "every speed": Finding(words, count == speeds),
    }
    return COHERENCE.claim("stated", findings)


def mean_interval_claim(channel: str, words: str, half_width_db: float) -> ConditionalClaim:
    """Return the interval of the mean level of runs.

    Parameters
    ----------
    channel : name of the channel
    words : ends of the interval
    half_width_db : half its width; not a number of a single run
    """
    has_runs = bool(np.isfinite(half_width_db))
    return MEAN_INTERVAL.claim(
        words, {"runs": Finding("several" if has_runs else "1", has_runs)}, channel
    )


def band_claim(results: xr.Dataset, words: str, subject: str) -> ConditionalClaim:
    """Return a band of measured functions, of which accepted faults leave none."""
    faults = str(results.attrs.get("faults", "")).splitlines()
    return BAND.claim(words, {"faults": Finding(f"{len(faults)} faults", not faults)}, subject)


def truncation_claim(taken: float, errors: Array) -> ConditionalClaim:
    """Return the truncation, chosen by the errors of responses that are omitted in turn."""
    is_chosen = not bool(np.isnan(errors).all())
    finding = Finding("more" if is_chosen else "as few", is_chosen)
    return TRUNCATION.claim(f"{taken:.1%}", {"responses": finding})


def sheet_claims(power: SoundPower, level: str) -> tuple[ConditionalClaim, ConditionalClaim]:
    """Return L_WA and K_WA of a data sheet.

    Parameters
    ----------
    power : sound power of the sheet
    level : L_WA in words
    """
    has_rest = power.unmodelled_kind != "none"
    of_level = {"published level": Finding(power.unmodelled_kind, has_rest)}
    _, uncertainty = power.declared or (0, 0)
    is_declared = power.declared is not None
    return (
        SHEET_LEVEL.claim(level, of_level),
        UNCERTAINTY.claim(f"{uncertainty} dB", {"samples": _samples(is_declared)}),
    )


def promise_claim(values: Sequence[str], is_allowed: bool, is_sampled: bool) -> ConditionalClaim:
    """Return what the first of the best designs promises.

    Parameters
    ----------
    values : value of each objective
    is_allowed : whether a design meets every constraint
    is_sampled : whether the machine was sampled, not the pieces of the design alone
    """
    words = "met" if is_allowed else "not met"
    findings = {"constraints": Finding(words, is_allowed), "samples": _samples(is_sampled)}
    return PROMISE.claim("; ".join(values), findings, "design 1")
