"""Unknowns that the level depends on: which were sampled, their shares, what to measure next."""

from collections.abc import Collection, Mapping
from typing import Any, Final

import numpy as np
import xarray as xr

from ...base import rounding
from ...base.arrays import Array
from ...base.registry import register
from ...base.units import split_key
from ...results import labels
from ...results.bands import INTERVAL, percent, written
from ...results.estimates import (
    effective_number,
    has_samples,
    prior_ensemble,
    sample_numbers,
    weighted_estimate,
)
from ...results.stored_study import catalogue_receiver, overall_noise, parameters
from ..blocks import Block, Text
from ..tables import DataTable, Table, long_table
from . import Section, hold, text

_TABLES: Final = {"variation": "path through the shell", "structure": "shell"}
"""Plain words for tables; others go by their name."""


def sampled_sentences(results: xr.Dataset) -> list[str]:
    """Number of values that are sampled and that are not, and the error of projected modes."""
    ranges = parameters(results)["ranges"]
    count = f"{len(ranges)} values are" if len(ranges) > 1 else "One value is"
    texts = [f"{count} sampled by Latin hypercube.", held_sentence(results), _projection(results)]
    return [*filter(None, texts)]


def held_sentence(results: xr.Dataset) -> str:
    """Number of values that have a range and are not sampled."""
    held = parameters(results).get("held_ranges", ())
    if not held:
        return ""
    count = f"{len(held)} values with a range are" if len(held) > 1 else "One value with a range is"
    return f"{count} not sampled; inputs.csv gives ranges and reasons."


def named(name: str) -> str:
    """Plain words for a sampled value by its dotted name, without its unit."""
    table, _, field = name.rpartition(".")
    first, *parts = table.split(".")
    where = " ".join([_TABLES.get(first, first), *parts]).replace("_", " ")
    return f"{where} {labels.name(field).lower()}"


def with_unit(words: str, symbol: str) -> str:
    """Words for a value with its unit, if it has one."""
    return f"{words}, {symbol}" if symbol else words


def in_si(field: str) -> str:
    """Return the dotted name of a value in SI by its name in a file."""
    table, _, key = field.rpartition(".")
    stem, unit = split_key(key)
    return field if unit is None else f"{table}.{stem}_{unit.si_suffix}"


def file_unit(results: xr.Dataset, name: str) -> tuple[str, float]:
    """Symbol and factor to SI of the unit in which a file gives a sampled value; else SI."""
    for record in parameters(results).get("records", ()):
        unit = split_key(str(record["field"]).rpartition(".")[2])[1]
        if unit is not None and in_si(str(record["field"])) == name:
            return unit.symbol, unit.factor
    return labels.unit(name.rpartition(".")[2]), 1.0


def dotted(item: Mapping[str, Any]) -> str:
    """Return the dotted name of a range."""
    return f"{item['table']}.{item['field']}"


def _projection(results: xr.Dataset) -> str:
    """Say how far natural frequencies by projection are off."""
    if "projection_error" not in results:
        return ""
    errors = results["projection_error"]
    texts = [
        f"{named(str(name))} {percent(float(error))}"
        for name, error in zip(errors["uncertain_parameter"].values, errors.values, strict=True)
        if np.isfinite(error)
    ]
    if not texts:
        return ""
    return (
        "Wall and material change the modes by projection; largest error of a natural frequency: "
        f"{', '.join(texts)}."
    )


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
        "Shares in the variance are of the modelled level at "
        f"{catalogue_receiver(results)}. Parameters with resolved shares, of "
        f"{shares.sizes['uncertain_parameter']}: {', '.join(words)}."
    )


def unknowns_table(results: xr.Dataset, among: Collection[str] | None = None) -> Table | None:
    """Unknowns with a resolved share: values before and after the published level, and shares.

    All of them, or those among some dotted names in SI.
    """
    shares = results["level_share"]
    is_resolved = resolved(results, "level_share")
    knowledge = [str(name) for name in shares["knowledge"].values]
    columns = [number for number in range(len(knowledge)) if is_resolved[number].any()]
    largest = np.where(is_resolved, shares.values, 0.0).max(axis=0)
    names = [str(name) for name in shares["uncertain_parameter"].values]
    rows = tuple(
        (
            with_unit(named(names[index]), file_unit(results, names[index])[0]),
            *(_values(results, names[index], number) for number in range(-1, len(knowledge) - 1)),
            *(share_words(results, "level_share", number, index) for number in columns),
        )
        for index in np.argsort(-largest, kind="stable").tolist()
        if largest[index] > 0.0 and (among is None or names[index] in among)
    )
    if not rows:
        return None
    words = [_knowledge(results, name) for name in knowledge]
    values = (f"value {word}" for word in words)
    of_variance = (f"share of the variance {words[number]}" for number in columns)
    caption = f"Parameters that the modelled level depends on: median of the values with {INTERVAL}"
    return Table(caption, ("Parameter", *values, *of_variance), rows)


def most_valuable(results: xr.Dataset) -> tuple[str, str] | None:
    """Return what the most valuable measurement is for, and the measurement.

    None where the samples do not show one.
    """
    if "parameter_information" in results:
        for choice in results["choice"].values.tolist():
            here = results.sel(choice=choice)
            best = _best(here)
            if float(here["perfect_information"]) >= SMALLEST_DB and best is not None:
                measurement = named(str(results["uncertain_parameter"].values[best]))
                return f"choice on {choice}", measurement
    measured = "baseline_band_level" in results or "spectrum_measured" in results
    if measured or not has_samples(results):
        return None
    if overall_noise(results) is None:
        return "level", "the A-weighted level at a microphone, as none is published"
    return "dominant source", "a third-octave spectrum"


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
        choices = " or on ".join(worthless)
        others.insert(0, f"No value of a parameter would change the choice of option on {choices}.")
    wanted = most_valuable(results)
    if wanted is not None and not wanted[0].startswith("choice"):
        others.append(f"Most valuable measurement for the {wanted[0]}: {wanted[1]}.")
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
        f"All unknown values together are worth {everything} for the choice of option on {choice}; "
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
    interval = written(weighted_estimate(values, weight), effective_number(weight))
    return interval.middle_and_ends(rounding.three_digits)


def _knowledge(results: xr.Dataset, name: str) -> str:
    if name != BEFORE:
        return f"with the published data, prior {name}"
    return "with the hammer test" if "shell_weight" in results else "by the ranges alone"


def _blocks(results: xr.Dataset) -> list[Block]:
    table = unknowns_table(results)
    return [
        *text(measure_next_sentence(results), "strong"),
        Text(resolved_sentence(results)),
        *([table] if table else []),
        Text(
            "A share is the expected loss of variance once the parameter is known, with its 80 % "
            "bootstrap interval. It is resolved where this interval is above what chance gives. "
            "All shares are in uncertainty.csv.",
            "note",
        ),
    ]


def _data(results: xr.Dataset) -> dict[str, DataTable]:
    """Shares of all parameters, values of measurements, levels with less evidence."""
    stems = ("level_share", "parameter_information", "perfect_information", "alternative_",
             "projection_error")  # fmt: skip
    names = [name for name in map(str, results.data_vars) if name.startswith(stems)]
    return {"uncertainty.csv": long_table(results, names)}


register(Section("unknowns", "Sensitivity", _blocks, hold("level_share"), 35.0, tables=_data))
