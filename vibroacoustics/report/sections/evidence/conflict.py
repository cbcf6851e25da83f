"""Prior-data conflict in words: published data beside what the model expects before them."""

from collections.abc import Callable
from typing import Final

import xarray as xr

from ....base import rounding
from ....base.vocabulary import PUBLISHED_LEVEL, PUBLISHED_SHARE
from ....results.stored_study import parameters
from ...bands import Band, percent
from ...tables import Table

CONFLICT: Final = 0.05
"""Tail of the prior predictive below which published data are in conflict with the model."""
_ALL: Final = "all together"


def applies(results: xr.Dataset) -> bool:
    """Return whether published data weigh the samples."""
    return "datum_tail" in results


def conflict_table(results: xr.Dataset) -> Table:
    """A row for each published datum, and one for all together."""
    head = ("Datum", "Published", "Expected by the model", "Tail of the prior", "")
    rows = []
    for name, tail in _tails(results).items():
        expected = published = ""
        if name != _ALL:
            published = _published(results, name)
            expected = _expected(results, name).middle_and_ends(_number(name))
        word = "conflict" if tail < CONFLICT else "no conflict"
        rows.append((name, published, expected, rounding.fixed(tail, 3), word))
    return Table(
        "Published data beside the prior predictive distribution, median (80 % interval)",
        head,
        tuple(rows),
        frozenset({0, 4}),
    )


def _tails(results: xr.Dataset) -> dict[str, float]:
    names = map(str, results["datum"].values)
    tails = dict(zip(names, results["datum_tail"].values.tolist(), strict=True))
    return {**tails, _ALL: results["conflict_tail"].item()} if len(tails) > 1 else tails


def _expected(results: xr.Dataset, name: str) -> Band:
    of_datum = results["datum_expected"].sel(datum=name).transpose("datum_quantile")
    return Band(*of_datum.values.tolist())


def _published(results: xr.Dataset, name: str) -> str:
    value, deviation = (
        float(results[of].sel(datum=name)) for of in ("datum_value", "datum_deviation")
    )
    return f"{_number(name)(value)} ± {_number(name)(deviation)}{_unit(results, name)}"


def _number(name: str) -> Callable[[float], str]:
    return percent if name == PUBLISHED_SHARE else rounding.fixed


def _unit(results: xr.Dataset, name: str) -> str:
    if name == PUBLISHED_LEVEL:
        return " dB(A)"
    below_hz = parameters(results)["machine"]["overall_noise"]["spectral_share"]["below_hz"]
    return f" of the energy below {below_hz:g} Hz"
