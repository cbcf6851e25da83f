"""Unknowns that the level depends on: their values, their shares, which one to measure."""

from typing import Final

import numpy as np
import xarray as xr

from ....base import rounding
from ....base.arrays import Array
from ....results.estimates import (
    effective_number,
    has_samples,
    prior_ensemble,
    sample_numbers,
    weighted_estimate,
)
from ....results.stored_study import catalogue_receiver, overall_noise
from ...bands import INTERVAL, percent, written
from ...tables import Table
from .words import file_unit, named, with_unit

NOT_RESOLVED: Final = "not resolved"
SMALLEST_DB: Final = 0.1
"""Information worth less changes no choice."""
BEFORE: Final = "before"


def resolved(results: xr.Dataset, name: str) -> Array:
    """Whether shares (quantity, unknown) are more than chance gives: they end above the floor."""
    return np.asarray(results[f"{name}_low"].values > results[f"{name}_floor"].values[:, None])


def share_words(results: xr.Dataset, name: str, quantity: int, unknown: int) -> str:
    """A share with its interval, where it is resolved; arguments as of `resolved`."""
    if not resolved(results, name)[quantity, unknown]:
        return NOT_RESOLVED
    share, low, high = (
        percent(float(results[f"{name}{end}"].values[quantity, unknown]))
        for end in ("", "_low", "_high")
    )
    return f"{share} ({low} to {high})"


def resolved_sentence(results: xr.Dataset) -> str:
    """Number of unknowns with a resolved share in the variance of the level, by knowledge."""
    shares = results["level_share"]
    if not np.isfinite(shares.values).any():
        return "The samples are too few to show which unknown the level depends on."
    counts = resolved(results, "level_share").sum(axis=1).tolist()
    words = [
        f"{count} {_knowledge(results, str(name))}"
        for name, count in zip(shares["knowledge"].values, counts, strict=True)
    ]
    return (
        f"Resolved shares in the variance of the modelled level at {catalogue_receiver(results)}, "
        f"of {shares.sizes['uncertain_parameter']} uncertain parameters: {', '.join(words)}."
    )


def unknowns_table(results: xr.Dataset) -> Table | None:
    """Unknowns with a resolved share: values before and after the published level, and shares."""
    shares = results["level_share"]
    seen = resolved(results, "level_share")
    knowledge = [str(name) for name in shares["knowledge"].values]
    columns = [number for number in range(len(knowledge)) if seen[number].any()]
    largest = np.where(seen, shares.values, 0.0).max(axis=0)
    names = [str(name) for name in shares["uncertain_parameter"].values]
    rows = tuple(
        (
            with_unit(named(names[at]), file_unit(results, names[at])[0]),
            *(_values(results, names[at], number) for number in range(-1, len(knowledge) - 1)),
            *(share_words(results, "level_share", number, at) for number in columns),
        )
        for at in np.argsort(-largest, kind="stable").tolist()
        if largest[at] > 0.0
    )
    if not rows:
        return None
    words = [_knowledge(results, name) for name in knowledge]
    values = (f"value {word}" for word in words)
    of_variance = (f"share of the variance {words[number]}" for number in columns)
    caption = f"Parameters that the modelled level depends on: median of the values with {INTERVAL}"
    return Table(caption, ("Parameter", *values, *of_variance), rows)


def most_valuable(results: xr.Dataset) -> str:
    """Return the most valuable measurement; empty where the samples do not show one."""
    if "parameter_information" in results:
        for choice in results["choice"].values.tolist():
            here = results.sel(choice=choice)
            best = _best(here)
            if float(here["perfect_information"]) >= SMALLEST_DB and best is not None:
                return named(str(results["uncertain_parameter"].values[best]))
    if not has_samples(results) or "baseline_band_level" in results:
        return ""
    if overall_noise(results) is None:
        return "the A-weighted level at a microphone, as none is published"
    return "a third-octave spectrum, which separates the sources"


def measure_next_sentence(results: xr.Dataset) -> str:
    """The unknown whose measurement is worth most before an option is chosen, if any is."""
    if "parameter_information" not in results:
        return ""
    worthless, others = [], []
    for choice in results["choice"].values.tolist():
        here = results.sel(choice=choice)
        if float(here["perfect_information"]) < SMALLEST_DB:
            worthless.append(choice)
        else:
            others.append(f"{_most_valuable(here)}.")
    if worthless:
        others.insert(0, f"No measurement would change the choice on {' or on '.join(worthless)}.")
    return " ".join(others)


def _most_valuable(results: xr.Dataset) -> str:
    """The unknown worth most for a choice, or that the samples do not show which it is."""
    gain, choice = results["parameter_information"].values, results["choice"].item()
    best = _best(results)
    everything = f"{rounding.fixed(float(results['perfect_information']))} dB"
    if best is not None:
        name = named(str(results["uncertain_parameter"].values[best]))
        return (
            f"Before an option is chosen on {choice}, measure {name}: its value is worth "
            f"{rounding.fixed(float(gain[best]))} dB in the mean, all values {everything}"
        )
    return (
        f"All unknown values together are worth {everything} for a choice on {choice}; "
        f"{sample_numbers(results).computed} samples do not show which one to measure"
    )


def _best(results: xr.Dataset) -> int | None:
    """Number of the unknown that is worth most for a choice; none if chance could give it."""
    gain = results["parameter_information"].values
    votes = results["parameter_information_votes"].values
    best = int(gain.argmax())
    certain = votes[best] == votes.sum()
    return best if certain and gain[best] > float(results["parameter_information_floor"]) else None


def _values(results: xr.Dataset, name: str, prior: int) -> str:
    """Median and interval of an unknown's values by a prior; by equal weights for -1."""
    ensemble = prior_ensemble(results)
    if ensemble is None or (prior >= 0 and not has_samples(results)):
        return rounding.NOTHING
    values = ensemble.value.sel(uncertain_parameter=name).values / file_unit(results, name)[1]
    weight = ensemble.before if prior < 0 else ensemble.weight[prior]
    known = written(weighted_estimate(values, weight), effective_number(weight))
    return known.middle_and_ends(rounding.three_digits)


def _knowledge(results: xr.Dataset, name: str) -> str:
    if name != BEFORE:
        return f"with the published data, prior {name}"
    return "with the hammer test" if "shell_weight" in results else "by the ranges alone"
