"""Results of a hammer test of the shell: before and after."""

from collections.abc import Callable, Iterator
from typing import Final

import numpy as np
import xarray as xr

from ...base import rounding
from ...base.arrays import Array
from ...base.quantiles import weighted_quantiles
from ...base.registry import register
from ...results.bands import INTERVAL, written
from ...results.estimates import (
    QUANTILES,
    effective_number,
    prior_ensemble,
    sample_numbers,
    weighted_estimate,
)
from ...results.labels import unit
from ...results.stored_study import catalogue_receiver
from ..blocks import Block, Text
from ..tables import Table
from . import Section, hold
from .unknowns import named, with_unit

NARROWED: Final = 0.8
"""Values whose band is narrowed to less than this part are listed."""
GIVEN_UP: Final = 20.0
"""Effective samples below which a warning is given."""


def test_sentence(results: xr.Dataset) -> str:
    """Say what was measured and with which tolerances it is compared."""
    about = results["shell_likelihood"].attrs
    unused = f"; {about['unused']} others have nodes without a name" if about["unused"] else ""
    return (
        f"{about['mobilities']} mobilities from {about['lowest_frequency_hz']:g} to "
        f"{about['highest_frequency_hz']:g} Hz{unused}. Samples count by how well their shell "
        "agrees with them: in the mean level of each third octave within "
        f"{about['gain_tolerance_db']:g} dB, in the natural frequencies of clear peaks within "
        f"{100.0 * about['frequency_tolerance_ratio']:g} %, in their loss factors within "
        f"{100.0 * about['loss_tolerance_ratio']:g} % (standard deviations). Each of the three "
        "counts as one measurement, however many lines there are."
    )


def peaks_sentence(results: xr.Dataset) -> str:
    """The clear peaks with their loss factors."""
    if "shell_peak_loss" not in results:
        return "The mobilities have no clear peak: frequencies and loss factors cannot be read."
    pairs = zip(results["shell_peak"].values, results["shell_peak_loss"].values, strict=True)
    peaks = ", ".join(f"{peak:.0f} Hz ({100.0 * loss:.2g} %)" for peak, loss in pairs)
    return f"Clear peaks, with loss factor: {peaks}."


def samples_sentence(results: xr.Dataset) -> str:
    """Say how many samples were weighted by the test, and how many equal ones remain."""
    weight = results["shell_likelihood"].values
    effective = effective_number(weight)
    few = " That is few: bands after the test are rough." if effective < GIVEN_UP else ""
    return (
        f"{weight.size} samples were weighted by the test: effective sample size {effective:.0f}."
        f"{few} The sound of {sample_numbers(results).tried} of them was computed."
    )


def before_and_after(results: xr.Dataset) -> Table:
    """Middle and band by the ranges alone and with the test."""
    caption = f"Before and after the hammer test: median with {INTERVAL}"
    return Table(caption, ("", "by the ranges alone", "with the test"), tuple(_rows(results)))


def _rows(results: xr.Dataset) -> Iterator[tuple[str, str, str]]:
    likelihood = results["shell_likelihood"].values
    for words, name, write in (
        ("mean level of the mobilities, model over measured, dB", "shell_gain", rounding.signed),
        ("natural frequencies, model over measured", "shell_frequency_ratio", _number),
        ("loss factors, model over measured", "shell_loss_ratio", _number),
    ):
        values = results[name].values
        if np.any(np.isfinite(values) & (likelihood > 0.0)):
            yield _row(words, values, likelihood, write)
    for name in map(str, results["shell_parameter"].values):
        values = results["shell_value"].sel(shell_parameter=name).values
        if _narrowed(values, likelihood) < NARROWED:
            words = with_unit(named(name), unit(name.rpartition(".")[2]))
            yield _row(words, values, likelihood, _number)
    ensemble = prior_ensemble(results)
    before = results["shell_level_before"].values
    after = before[:0] if ensemble is None else ensemble.level_dba
    weight = after if ensemble is None else ensemble.before
    by_ranges = _band(before, np.ones(before.size), rounding.fixed)
    words = f"modelled level at {catalogue_receiver(results)}, dB(A)"
    yield words, by_ranges, _band(after, weight, rounding.fixed)


def _row(
    words: str, values: Array, weight: Array, write: Callable[[float], str]
) -> tuple[str, str, str]:
    return words, _band(values, np.ones(values.size), write), _band(values, weight, write)


def _band(values: Array, weight: Array, write: Callable[[float], str]) -> str:
    """Middle and band of the values that are numbers."""
    finite = np.isfinite(values)
    values, weight = values[finite], weight[finite]
    if not values.size:
        return rounding.NOTHING
    interval = weighted_estimate(values, weight)
    return written(interval, effective_number(weight)).middle_and_ends(write)


def _narrowed(values: Array, weight: Array) -> float:
    """Width of the band with the test over that without."""
    before, after = (
        weighted_quantiles(values, each, QUANTILES) for each in (np.ones(values.size), weight)
    )
    width = float(before[-1] - before[0])
    return float(after[-1] - after[0]) / width if width > 0.0 else 1.0


def _number(value: float) -> str:
    return f"{value:.3g}".replace("-", "−")


def _blocks(results: xr.Dataset) -> list[Block]:
    return [
        Text(test_sentence(results)),
        Text(peaks_sentence(results)),
        before_and_after(results),
        Text(samples_sentence(results), "note"),
    ]


register(Section("shell-test", "The shell, by hammer", _blocks, hold("shell_likelihood"), 34.0))
